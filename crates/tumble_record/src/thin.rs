//! Thinning: fewer points that draw the same curve.

/// Returns the indices to keep, ascending: for each of `buckets` equal stretches its ends and the extremes of each curve.
///
/// At one stretch per pixel the thinned curve covers the same pixels as the full one: no peak is lost. All indices are
/// kept when that is not more.
pub(crate) fn keep_extremes(count: usize, buckets: usize, curves: &[&[f64]]) -> Vec<usize> {
    if count <= buckets * (2 + 2 * curves.len()) {
        return (0..count).collect();
    }
    let mut kept = Vec::new();
    for bucket in 0..buckets {
        let (start, end) = (bucket * count / buckets, (bucket + 1) * count / buckets);
        kept.extend([start, end - 1]);
        for curve in curves {
            let finite = || (start..end).filter(|&index| curve[index].is_finite());
            kept.extend(finite().min_by(|&a, &b| curve[a].total_cmp(&curve[b])));
            kept.extend(finite().max_by(|&a, &b| curve[a].total_cmp(&curve[b])));
        }
    }
    kept.sort_unstable();
    kept.dedup();
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn peaks_and_ends_survive_thinning() {
        let mut curve: Vec<f64> = (0..100_000).map(|index| f64::from(index % 7)).collect();
        curve[54_321] = 99.0;
        curve[12_345] = -99.0;
        curve[3] = f64::NAN;
        let kept = keep_extremes(curve.len(), 100, &[&curve]);
        assert!(kept.len() <= 400, "two ends and two extremes per stretch");
        for index in [0, 12_345, 54_321, 99_999] {
            assert!(kept.binary_search(&index).is_ok(), "{index} is kept");
        }
    }

    #[test]
    fn short_curves_are_kept_whole() {
        assert_eq!(keep_extremes(5, 10, &[&[0.0; 5]]), [0, 1, 2, 3, 4]);
        assert!(keep_extremes(0, 10, &[&[]]).is_empty());
    }
}
