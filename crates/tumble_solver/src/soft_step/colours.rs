//! Colours: pairs of one colour share no body that moves, so that they can be solved side by side.
//!
//! Greedy in the order of the pairs. Pairs with a body that cannot move have colours of their own behind all others: solved last, they
//! have the last word, and what carries a pile holds firmly.

/// Colours for pairs of two moving bodies.
const BETWEEN: u32 = 48;
/// The colour of pairs that found no other: they are solved one by one.
pub const OVERFLOW: usize = 63;
/// All colours.
pub const COLOURS: usize = 64;

/// Which colours each body has.
#[derive(Clone, Debug, Default)]
pub struct Colours {
    of_body: Vec<u64>,
}

impl Colours {
    /// No pairs yet, among so many bodies.
    pub fn begin(&mut self, bodies: usize) {
        self.of_body.clear();
        self.of_body.resize(bodies, 0);
    }

    /// The colour of the next pair; `moving` says which of its bodies move.
    pub fn choose(&mut self, bodies: [u32; 2], moving: [bool; 2]) -> usize {
        let mut taken = 0;
        for (body, moves) in bodies.into_iter().zip(moving) {
            if moves {
                taken |= self.of_body[body as usize];
            }
        }
        let first = if moving == [true; 2] { 0 } else { BETWEEN };
        let beyond = if moving == [true; 2] { BETWEEN } else { OVERFLOW as u32 };
        let colour = first + (taken >> first).trailing_ones();
        if colour >= beyond {
            return OVERFLOW;
        }
        for (body, moves) in bodies.into_iter().zip(moving) {
            if moves {
                self.of_body[body as usize] |= 1 << colour;
            }
        }
        colour as usize
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

        #[test]
        fn no_two_pairs_of_a_colour_share_a_moving_body(
            pairs in prop::collection::vec((0_u32..40, 0_u32..40), 0..400),
            immovable in 0_u32..10,
        ) {
            let mut colours = Colours::default();
            colours.begin(40);
            let mut seen = std::collections::HashSet::new();
            for (a, b) in pairs.into_iter().filter(|(a, b)| a != b) {
                let moving = [a, b].map(|body| body >= immovable);
                let colour = colours.choose([a, b], moving);
                prop_assert!(colour < COLOURS);
                if colour != OVERFLOW {
                    prop_assert_eq!((colour as u32) < BETWEEN, moving == [true; 2]);
                    for body in [a, b].into_iter().filter(|body| *body >= immovable) {
                        prop_assert!(seen.insert((colour, body)), "body {} twice in colour {}", body, colour);
                    }
                }
            }
        }
    }
}
