//! The name that was probably meant.

/// The allowed name that differs least from the one written, unless it differs too much.
pub(crate) fn nearest<'n>(written: &str, allowed: impl IntoIterator<Item = &'n str>) -> Option<&'n str> {
    // A third of the letters may be wrong, and case never matters.
    let limit = written.chars().count().div_ceil(3);
    let lower = written.to_lowercase();
    let best =
        allowed.into_iter().map(|name| (edits(&lower, &name.to_lowercase()), name)).min_by_key(|(edits, _)| *edits);
    best.filter(|(edits, _)| *edits <= limit).map(|(_, name)| name)
}

/// A label and a help text about an unknown name: the nearest one, and all allowed ones unless they are many.
pub(crate) fn nearest_or_all(written: &str, kind: &str, allowed: &[&str]) -> (String, String) {
    const MOST_NAMES: usize = 24;
    let label = match nearest(written, allowed.iter().copied()) {
        Some(near) => format!("did you mean \"{near}\"?"),
        None => format!("unknown {kind}"),
    };
    let quoted: Vec<String> = allowed.iter().take(MOST_NAMES).map(|name| format!("\"{name}\"")).collect();
    let help = match (allowed.len(), allowed.len().saturating_sub(MOST_NAMES)) {
        (0, _) => format!("the scene has no {kind} at all"),
        (_, 0) => format!("there is {}", quoted.join(", ")),
        (_, more) => format!("there is {} and {more} more", quoted.join(", ")),
    };
    (label, help)
}

/// Letters to insert, delete, replace or swap with a neighbour (optimal string alignment, Levenshtein 1966 with Damerau's swap).
fn edits(from: &str, to: &str) -> usize {
    let from: Vec<char> = from.chars().collect();
    let to: Vec<char> = to.chars().collect();
    let mut before_last = vec![0; to.len() + 1];
    let mut last: Vec<usize> = (0..=to.len()).collect();
    for row in 1..=from.len() {
        let mut current = vec![row; to.len() + 1];
        for column in 1..=to.len() {
            let differs = usize::from(from[row - 1] != to[column - 1]);
            current[column] = (last[column] + 1).min(current[column - 1] + 1).min(last[column - 1] + differs);
            let swapped = row > 1 && column > 1 && from[row - 1] == to[column - 2] && from[row - 2] == to[column - 1];
            if swapped {
                current[column] = current[column].min(before_last[column - 2] + 1);
            }
        }
        before_last = std::mem::replace(&mut last, current);
    }
    last[to.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edits_counts_each_kind_of_slip_once() {
        assert_eq!(edits("density", "density"), 0);
        assert_eq!(edits("desnity", "density"), 1);
        assert_eq!(edits("densty", "density"), 1);
        assert_eq!(edits("densitty", "density"), 1);
        assert_eq!(edits("", "abc"), 3);
    }

    #[test]
    fn nothing_is_near_a_name_that_is_altogether_different() {
        assert_eq!(nearest("velocty", ["velocity", "gravity"]), Some("velocity"));
        assert_eq!(nearest("dynamic", ["Dynamic"]), Some("Dynamic"));
        assert_eq!(nearest("colour", ["velocity", "gravity"]), None);
    }
}
