//! Colours: pairs of one colour share no body that moves, so that they can be solved side by side.
//!
//! A pair gets its colour when it begins to act, the lowest that is free at both bodies, and keeps it until it ends: so the order of solving
//! is a matter of who met whom first, not of where pairs lie in memory. Pairs with a body that cannot move have colours of their own behind
//! all others: solved last, they have the last word, and what carries a pile holds firmly.

/// Colours for pairs of two moving bodies.
const BETWEEN: u32 = 48;
/// The colour of pairs that found no other: they are solved one by one.
pub const OVERFLOW: usize = 63;
/// All colours.
pub const COLOURS: usize = 64;

/// The colour of a pair, as long as the colours of its time are not forgotten.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PairColour {
    /// 0 for a pair without a colour.
    age: u32,
    number: u8,
}

impl PairColour {
    /// Of a pair that does not act.
    pub const NONE: Self = Self { age: 0, number: 0 };

    /// Whether pairs of this colour may share bodies, so that they are solved one by one.
    pub fn shares_bodies(self) -> bool {
        self.number() == OVERFLOW
    }

    pub(super) fn number(self) -> usize {
        self.number as usize
    }
}

/// Which colours each body has.
#[derive(Clone, Debug)]
pub struct Colours {
    of_body: Vec<u64>,
    moving: Vec<bool>,
    age: u32,
}

impl Default for Colours {
    fn default() -> Self {
        Self { of_body: Vec::new(), moving: Vec::new(), age: 1 }
    }
}

impl Colours {
    /// Tells which bodies move; where that has changed, all colours are forgotten.
    pub fn begin(&mut self, moving: impl ExactSizeIterator<Item = bool>) {
        let mut same = self.moving.len() == moving.len();
        self.moving.resize(moving.len(), false);
        for (known, moves) in self.moving.iter_mut().zip(moving) {
            same &= *known == moves;
            *known = moves;
        }
        if !same {
            self.forget();
        }
    }

    /// Forgets the colours of all pairs.
    pub fn forget(&mut self) {
        self.age += 1;
        self.of_body.clear();
        self.of_body.resize(self.moving.len(), 0);
    }

    /// Whether a pair has a colour.
    #[inline]
    pub fn know(&self, colour: PairColour) -> bool {
        colour.age == self.age
    }

    /// A colour for a pair that begins to act.
    pub fn choose(&mut self, bodies: [u32; 2]) -> PairColour {
        let moving = bodies.map(|body| self.moving[body as usize]);
        let mut taken = 0;
        for (body, moves) in bodies.into_iter().zip(moving) {
            if moves {
                taken |= self.of_body[body as usize];
            }
        }
        let (first, beyond) = if moving == [true; 2] { (0, BETWEEN) } else { (BETWEEN, OVERFLOW as u32) };
        let free = first + (taken >> first).trailing_ones();
        let number = if free < beyond { free } else { OVERFLOW as u32 };
        if number != OVERFLOW as u32 {
            self.each_moving(bodies, |colours| *colours |= 1 << number);
        }
        PairColour { age: self.age, number: number as u8 }
    }

    /// Takes the colour of a pair back that does not act any more.
    pub fn release(&mut self, bodies: [u32; 2], colour: PairColour) {
        if self.know(colour) && colour.number() != OVERFLOW {
            self.each_moving(bodies, |colours| *colours &= !(1 << colour.number));
        }
    }

    pub(super) fn of(&self, number: u8) -> PairColour {
        PairColour { age: self.age, number }
    }

    fn each_moving(&mut self, bodies: [u32; 2], change: impl Fn(&mut u64)) {
        for body in bodies {
            if self.moving[body as usize] {
                change(&mut self.of_body[body as usize]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

        #[test]
        fn no_two_pairs_of_a_colour_share_a_moving_body_as_pairs_come_and_go(
            pairs in prop::collection::vec((0_u32..40, 0_u32..40, any::<bool>()), 0..600),
            immovable in 0_u32..10,
        ) {
            let mut colours = Colours::default();
            colours.begin((0..40).map(|body| body >= immovable));
            let mut present: Vec<([u32; 2], PairColour)> = Vec::new();
            for (a, b, ends) in pairs.into_iter().filter(|(a, b, _)| a != b) {
                if ends && !present.is_empty() {
                    let (bodies, colour) = present.swap_remove(a as usize % present.len());
                    colours.release(bodies, colour);
                    continue;
                }
                let colour = colours.choose([a, b]);
                prop_assert!(colours.know(colour) && colour.number() < COLOURS);
                present.push(([a, b], colour));
                let mut seen = std::collections::HashSet::new();
                for (bodies, colour) in present.iter().filter(|(_, colour)| colour.number() != OVERFLOW) {
                    let moving = bodies.iter().filter(|body| **body >= immovable);
                    prop_assert_eq!((colour.number() as u32) < BETWEEN, moving.clone().count() == 2);
                    for body in moving {
                        prop_assert!(seen.insert((colour.number(), *body)), "body {} twice in colour {:?}", body, colour);
                    }
                }
            }
            colours.forget();
            prop_assert!(present.iter().all(|(_, colour)| !colours.know(*colour)));
        }
    }
}
