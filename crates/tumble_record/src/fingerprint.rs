//! Fingerprint of a state: equal bits give equal digits, one different bit gives others.
//!
//! xxh3-128 over 64-bit little-endian words: the step, then for each body in the order of ids the id and its numbers
//! (pose, then velocity). The sign of a zero is dropped, because −0 and 0 move alike.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::Xxh3;

/// 128-bit digest of the state of a world; shown as 32 hex digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Fingerprint(pub u128);

/// Takes in a state, body by body, in the plane or in space.
#[derive(Clone)]
pub struct FingerprintHasher {
    hasher: Xxh3,
}

impl FingerprintHasher {
    /// Begins the fingerprint of the state after `step` steps.
    pub fn new(step: u64) -> Self {
        let mut hasher = Xxh3::new();
        hasher.update(&step.to_le_bytes());
        Self { hasher }
    }

    /// Adds a body: its pose, then its velocity, as plain numbers. Call in the order of ids.
    pub fn body(&mut self, id: u64, numbers: &[f64]) {
        self.hasher.update(&id.to_le_bytes());
        for &number in numbers {
            let unsigned_zero = if number == 0.0 { 0.0 } else { number };
            self.hasher.update(&unsigned_zero.to_bits().to_le_bytes());
        }
    }

    /// Returns the fingerprint of what was added so far.
    pub fn finish(&self) -> Fingerprint {
        Fingerprint(self.hasher.digest128())
    }
}

impl fmt::Display for Fingerprint {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{:032x}", self.0)
    }
}

/// The text is not a fingerprint.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{text}` is not a fingerprint: 32 hex digits are expected")]
pub struct ParseFingerprintError {
    /// The text that was given.
    pub text: String,
}

impl FromStr for Fingerprint {
    type Err = ParseFingerprintError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let is_hex = text.len() == 32 && text.bytes().all(|byte| byte.is_ascii_hexdigit());
        let digits = is_hex.then(|| u128::from_str_radix(text, 16).ok()).flatten();
        digits.map(Self).ok_or_else(|| ParseFingerprintError { text: text.to_owned() })
    }
}

impl TryFrom<String> for Fingerprint {
    type Error = ParseFingerprintError;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        text.parse()
    }
}

impl From<Fingerprint> for String {
    fn from(fingerprint: Fingerprint) -> Self {
        fingerprint.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fingerprint_of(step: u64, bodies: &[(u64, [f64; 6])]) -> Fingerprint {
        let mut hasher = FingerprintHasher::new(step);
        for (id, numbers) in bodies {
            hasher.body(*id, numbers);
        }
        hasher.finish()
    }

    const STATE: [f64; 6] = [1.0, -2.5, 0.1, 0.0, 1e-300, 7.25];

    #[test]
    fn fingerprint_never_changes_between_versions() {
        // Golden: xxh3-128 of the words 3, 7, STATE in little endian.
        assert_eq!(fingerprint_of(3, &[(7, STATE)]).to_string(), "5d5f9de7a774a3dacc39bfe55c43e369");
    }

    #[test]
    fn fingerprint_equals_the_hash_of_the_concatenated_words() {
        let mut bytes = Vec::new();
        bytes.extend(3_u64.to_le_bytes());
        bytes.extend(7_u64.to_le_bytes());
        STATE.iter().for_each(|number| bytes.extend(number.to_le_bytes()));
        assert_eq!(fingerprint_of(3, &[(7, STATE)]).0, xxhash_rust::xxh3::xxh3_128(&bytes));
    }

    #[test]
    fn sign_of_zero_does_not_count() {
        let negative = STATE.map(|number| if number == 0.0 { -0.0 } else { number });
        assert!(negative[3].is_sign_negative());
        assert_eq!(fingerprint_of(0, &[(0, STATE)]), fingerprint_of(0, &[(0, negative)]));
    }

    #[test]
    fn one_bit_step_id_or_order_changes_the_fingerprint() {
        let reference = fingerprint_of(1, &[(0, STATE), (1, STATE)]);
        let mut nudged = STATE;
        nudged[5] = f64::from_bits(nudged[5].to_bits() + 1);
        for other in [
            fingerprint_of(2, &[(0, STATE), (1, STATE)]),
            fingerprint_of(1, &[(0, STATE), (2, STATE)]),
            fingerprint_of(1, &[(1, STATE), (0, STATE)]),
            fingerprint_of(1, &[(0, STATE), (1, nudged)]),
            fingerprint_of(1, &[(0, STATE)]),
        ] {
            assert_ne!(reference, other);
        }
    }

    #[test]
    fn text_round_trips_with_leading_zeros() {
        for fingerprint in [Fingerprint(0), Fingerprint(0xabc), Fingerprint(u128::MAX)] {
            assert_eq!(fingerprint.to_string().len(), 32);
            assert_eq!(fingerprint.to_string().parse(), Ok(fingerprint));
        }
    }

    #[test]
    fn anything_but_32_hex_digits_is_refused() {
        let signed = format!("+{}", "0".repeat(31));
        for text in ["", "12", signed.as_str(), &"g".repeat(32), &"0".repeat(33)] {
            assert_eq!(text.parse::<Fingerprint>(), Err(ParseFingerprintError { text: text.to_owned() }));
        }
    }
}
