//! Comparing what was measured with what is right.

use super::{Expected, Finding, Measured, Near, Outcome};

/// How far a measurement is from being wrong, or beyond it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Judgement {
    /// Whether it is right.
    pub holds: bool,
    /// Grows as the measurement gets worse; comparable between measurements of one expectation. Infinite for what is not a number.
    pub badness: f64,
}

impl Judgement {
    /// Judges a badness, for a comparison that said `holds`: what is not a number is never right.
    fn new(holds: bool, badness: f64) -> Self {
        if badness.is_nan() { Self { holds: false, badness: f64::INFINITY } } else { Self { holds, badness } }
    }

    /// The worse of two.
    fn and(self, other: Self) -> Self {
        if self.is_better_than(other) { other } else { self }
    }

    /// Whether the other is wrong and this is not, or else has the greater badness.
    fn is_better_than(self, other: Self) -> bool {
        (self.holds && !other.holds) || (self.holds == other.holds && self.badness < other.badness)
    }
}

impl Outcome {
    /// How far what was measured is from what is right, in the unit of the outcome; of rest, the drift [m]. None where nothing was measured, or
    /// no value is given.
    pub fn error(&self) -> Option<f64> {
        match (self.expected.as_ref()?, self.measured.as_ref()?) {
            (Expected::Number { near: Some(near), .. }, Measured::Number(number)) => Some((number - near.is).abs()),
            (Expected::Vector { is, .. }, Measured::Vector(vector)) => Some(vector.distance(is)),
            (Expected::Rest { .. }, Measured::Rest { drift, .. }) => Some(*drift),
            _ => None,
        }
    }

    /// How much of its tolerance what was measured uses: 1 at the limit, more if it failed. None where nothing was measured, or no
    /// tolerance is given [1].
    pub fn ratio(&self) -> Option<f64> {
        let part = |distance: f64, within: f64| if distance == 0.0 { 0.0 } else { distance / within };
        match (self.expected.as_ref()?, self.measured.as_ref()?) {
            (Expected::Number { near: Some(near), .. }, Measured::Number(number)) => {
                Some(part((number - near.is).abs(), near.within))
            }
            (Expected::AtMost(bound), Measured::Number(number)) => Some(part(number.max(0.0), *bound)),
            (Expected::Vector { is, within }, Measured::Vector(vector)) => Some(part(vector.distance(is), *within)),
            (Expected::Rest { speed_below, turn_below, drift_below }, Measured::Rest { speed, turn, drift }) => {
                let drift = drift_below.map_or(0.0, |below| part(*drift, below));
                Some(part(*speed, *speed_below).max(part(*turn, *turn_below)).max(drift))
            }
            _ => None,
        }
    }
}

impl Finding {
    pub fn judgement(&self) -> Judgement {
        Judgement::of(&self.measured, &self.expected)
    }
}

impl Judgement {
    /// Compares what was measured with what is right.
    pub fn of(measured: &Measured, expected: &Expected) -> Self {
        match (expected, measured) {
            (Expected::Number { near, above, below }, &Measured::Number(number)) => {
                let claims = [
                    near.map(|near| is_near(number, near)),
                    above.map(|bound| is_below(bound, number)),
                    below.map(|bound| is_below(number, bound)),
                ];
                all(claims.into_iter().flatten())
            }
            (&Expected::AtMost(bound), &Measured::Number(number)) => Judgement::new(number <= bound, number - bound),
            (Expected::Vector { is, within }, Measured::Vector(vector)) => {
                let (distance, within) = (vector.distance(is), *within);
                Judgement::new(distance <= within, distance - within)
            }
            (&Expected::Rest { speed_below, turn_below, drift_below }, &Measured::Rest { speed, turn, drift }) => {
                // Ratios, because the three bounds have different units.
                let ratio = |number: f64, bound: f64| Judgement::new(number < bound, number / bound);
                let drift = drift_below.map(|bound| ratio(drift, bound));
                all([ratio(speed, speed_below), ratio(turn, turn_below)].into_iter().chain(drift))
            }
            (Expected::Order, Measured::Times(times)) => {
                let rise = times.is_sorted_by(|one, next| matches!((one, next), (Some(one), Some(next)) if one < next));
                Judgement::new(rise, 0.0)
            }
            (Expected::Never, Measured::Times(times)) => Judgement::new(times.iter().all(Option::is_none), 0.0),
            (Expected::Fingerprint(digits), Measured::Fingerprint(fingerprint)) => {
                Judgement::new(digits.parse() == Ok(*fingerprint), 0.0)
            }
            _ => unreachable!("an expectation is measured in its own kind"),
        }
    }
}

fn is_near(number: f64, Near { is, within }: Near) -> Judgement {
    let distance = (number - is).abs();
    Judgement::new(distance <= within, distance - within)
}

fn is_below(number: f64, bound: f64) -> Judgement {
    Judgement::new(number < bound, number - bound)
}

/// The worst of several; without any, what says nothing is not right.
fn all(claims: impl Iterator<Item = Judgement>) -> Judgement {
    claims.reduce(Judgement::and).unwrap_or(Judgement { holds: false, badness: f64::INFINITY })
}

/// The worst of several findings, the first of equally bad ones; none if there is none.
pub(super) fn worst(findings: impl IntoIterator<Item = Finding>) -> Option<Finding> {
    let judged = findings.into_iter().map(|finding| (finding.judgement(), finding));
    judged.reduce(|worst, next| if worst.0.is_better_than(next.0) { next } else { worst }).map(|(_, finding)| finding)
}
