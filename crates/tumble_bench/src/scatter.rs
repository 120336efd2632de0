//! Small irregularities that are the same for every engine and on every machine.

/// A sequence of numbers without visible order: a linear congruential generator (D. E. Knuth's MMIX) whose high bits are mixed.
#[derive(Clone, Copy, Debug)]
pub struct Scatter(u64);

impl Scatter {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next number, in [−1, 1), a multiple of 2⁻²³: exact in single precision too.
    pub fn signed(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mixed = ((self.0 >> 33) ^ (self.0 >> 18)) as u32;
        f64::from(mixed >> 8) / f64::from(1_u32 << 23) - 1.0
    }

    /// The next number, in [0, 1).
    pub fn unit(&mut self) -> f64 {
        0.5 * (self.signed() + 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_fill_their_range_evenly() {
        let mut scatter = Scatter::new(7);
        let mut counts = [0_u32; 8];
        for _ in 0..8000 {
            let number = scatter.unit();
            assert!((0.0..1.0).contains(&number));
            counts[(number * 8.0) as usize] += 1;
        }
        // 1000 each with a deviation of 30: five of them.
        assert!(counts.iter().all(|count| (850..1150).contains(count)), "{counts:?}");
    }
}
