//! Which steps are sampled.

use std::ops::RangeInclusive;

/// Every n-th step, and all steps of some spans.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sampling {
    every: u32,
    /// Ascending and apart.
    spans: Vec<RangeInclusive<u64>>,
}

impl Sampling {
    /// Every n-th step; 0 counts as 1.
    pub fn every(every: u32) -> Self {
        Self { every: every.max(1), spans: Vec::new() }
    }

    /// The same and all steps of these spans, in any order.
    pub fn and(mut self, spans: impl IntoIterator<Item = RangeInclusive<u64>>) -> Self {
        self.spans.extend(spans.into_iter().filter(|span| !span.is_empty()));
        self.spans.sort_by_key(|span| *span.start());
        self.spans.dedup_by(|next, last| {
            let joins = *next.start() <= last.end().saturating_add(1);
            if joins {
                *last = *last.start()..=*last.end().max(next.end());
            }
            joins
        });
        self
    }

    /// Whether a step is sampled.
    pub fn takes(&self, step: u64) -> bool {
        let begun = self.spans.partition_point(|span| *span.start() <= step);
        step.is_multiple_of(u64::from(self.every))
            || begun.checked_sub(1).is_some_and(|last| self.spans[last].contains(&step))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_nth_step_and_all_of_the_spans_are_taken() {
        let empty = RangeInclusive::new(40, 39);
        let sampling = Sampling::every(10).and([23..=25, 3..=3, 24..=27, empty, 28..=28]).and([99..=u64::MAX]);
        let taken: Vec<u64> = (0..103).filter(|step| sampling.takes(*step)).collect();
        let expected = [0, 3, 10, 20, 23, 24, 25, 26, 27, 28, 30, 40, 50, 60, 70, 80, 90, 99, 100, 101, 102];
        assert_eq!(taken, expected);
        assert!((0..20).all(|step| Sampling::every(0).takes(step)), "0 counts as 1");
    }
}
