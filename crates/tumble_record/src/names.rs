//! Words about names that do not exist: the nearest one that does, and a list of them.

/// Words an error's suggestion.
pub(crate) fn did_you_mean(suggestion: &Option<String>) -> String {
    suggestion.as_ref().map_or_else(String::new, |name| format!(" (did you mean `{name}`?)"))
}

/// Lists names, the first dozen of them.
pub(crate) fn listed(names: &[String]) -> String {
    let shown = names.iter().take(12).map(String::as_str).collect::<Vec<_>>().join(", ");
    match names.len() {
        0 => "none".to_owned(),
        count @ 13.. => format!("{shown} and {} more", count - 12),
        _ => shown,
    }
}

/// Returns the nearest of the candidates, if it is near enough to be a slip of the fingers.
pub(crate) fn nearest<'a>(wanted: &str, candidates: impl Iterator<Item = &'a str>) -> Option<String> {
    let allowed = 1 + wanted.chars().count() / 3;
    candidates
        .map(|candidate| (edit_distance(wanted, candidate), candidate))
        .filter(|(distance, _)| *distance <= allowed)
        .min()
        .map(|(_, candidate)| candidate.to_owned())
}

/// Returns how many letters must be inserted, removed or replaced to turn one text into the other (Levenshtein 1965).
fn edit_distance(from: &str, to: &str) -> usize {
    let to: Vec<char> = to.chars().collect();
    let mut row: Vec<usize> = (0..=to.len()).collect();
    for (i, letter) in from.chars().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, other) in to.iter().enumerate() {
            let replaced = diagonal + usize::from(letter != *other);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[to.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edit_distance_counts_letters() {
        for (from, to, distance) in
            [("", "", 0), ("", "abc", 3), ("kitten", "sitting", 3), ("ball", "ball", 0), ("é", "e", 1)]
        {
            assert_eq!(edit_distance(from, to), distance, "{from} → {to}");
            assert_eq!(edit_distance(to, from), distance, "{to} → {from}");
        }
    }

    #[test]
    fn nearest_name_is_offered_only_when_it_is_near() {
        assert_eq!(nearest("omeg", ["angle", "omega"].into_iter()), Some("omega".to_owned()));
        assert_eq!(nearest("banana", ["angle", "omega"].into_iter()), None);
    }

    #[test]
    fn long_lists_are_cut_short() {
        let names: Vec<String> = (0..200).map(|index| format!("crate-{index}")).collect();
        assert!(listed(&names).ends_with("crate-11 and 188 more"));
        assert_eq!(listed(&[]), "none");
    }
}
