//! Verdicts in words.

use std::fmt;

use super::judge::Judgement;
use super::{Expected, Measured, Near, Outcome, Status, Verdict, WorldVector};
use crate::format::{Dialect, Event, Expectation, JointForcePart, When};

/// Parts of a tolerance that printed digits show [1].
const TOLERANCE_PARTS: f64 = 100.0;

/// Parts of the distance from a limit that printed digits show [1].
const LIMIT_PARTS: f64 = 10.0;

/// Error that printed times may have [s].
const TIME_RESOLUTION: f64 = 1e-5;

/// What is expected of whom and when: `Speed of "box" at 2 s`.
pub(super) fn title<D: Dialect>(expectation: &Expectation<D>) -> String {
    let name = expectation.name();
    let moment = moment(expectation.when());
    match expectation {
        Expectation::Position(_)
        | Expectation::Velocity(_)
        | Expectation::X(_)
        | Expectation::Y(_)
        | Expectation::Z(_)
        | Expectation::VelocityX(_)
        | Expectation::VelocityY(_)
        | Expectation::VelocityZ(_)
        | Expectation::Speed(_)
        | Expectation::TurnRate(_)
        | Expectation::AngularVelocity(_)
        | Expectation::AngularVelocityX(_)
        | Expectation::AngularVelocityY(_)
        | Expectation::AngularVelocityZ(_)
        | Expectation::Angle(_)
        | Expectation::Orientation(_)
        | Expectation::Tilt(_) => {
            let of = expectation.claim().bodies().concat();
            format!("{name} of \"{of}\" {moment}")
        }
        Expectation::AtRest(e) => match &e.of {
            Some(of) => format!("{name} of \"{of}\" {moment}"),
            None => format!("{name} of every dynamic body {moment}"),
        },
        Expectation::Depth(_) => format!("{name} {moment}"),
        Expectation::ContactForceSum(e) => format!("{name} on \"{}\"{} {moment}", e.on, by(e.by.as_deref())),
        Expectation::FrictionForce(e) => format!("{name} on \"{}\"{} {moment}", e.on, by(e.by.as_deref())),
        Expectation::JointForce(e) => format!("{name}{} of \"{}\" {moment}", part(e.part), e.of),
        Expectation::Order(e) => {
            let events: Vec<String> = e.events.iter().map(event).collect();
            format!("{name} of {}", events.join(", "))
        }
        Expectation::Happens(e) if e.occurrence == 1 => format!("{name} {}", event(&e.event)),
        Expectation::Happens(e) => format!("{name} {} number {}", event(&e.event), e.occurrence),
        Expectation::Never(e) => format!("{name} {}", event(&e.event)),
        Expectation::EnergyNeverRises(_)
        | Expectation::EnergyKept(_)
        | Expectation::MomentumKept(_)
        | Expectation::AngularMomentumKept(_)
        | Expectation::Fingerprint(_) => name.to_owned(),
    }
}

/// The unit of what an expectation measures; empty where it has none or several.
pub(super) fn unit<D: Dialect>(expectation: &Expectation<D>) -> &'static str {
    match expectation {
        Expectation::Position(_)
        | Expectation::X(_)
        | Expectation::Y(_)
        | Expectation::Z(_)
        | Expectation::Depth(_) => "m",
        Expectation::Angle(_) | Expectation::Orientation(_) | Expectation::Tilt(_) => "degrees",
        Expectation::Velocity(_)
        | Expectation::VelocityX(_)
        | Expectation::VelocityY(_)
        | Expectation::VelocityZ(_)
        | Expectation::Speed(_) => "m/s",
        Expectation::AngularVelocity(_)
        | Expectation::AngularVelocityX(_)
        | Expectation::AngularVelocityY(_)
        | Expectation::AngularVelocityZ(_)
        | Expectation::TurnRate(_) => "rad/s",
        Expectation::EnergyNeverRises(_) | Expectation::EnergyKept(_) => "J",
        Expectation::MomentumKept(_) => "kg·m/s",
        Expectation::AngularMomentumKept(_) => "kg·m²/s",
        Expectation::ContactForceSum(_) | Expectation::FrictionForce(_) => "N",
        Expectation::JointForce(e) if e.part == JointForcePart::Torque => "N·m",
        Expectation::JointForce(_) => "N",
        Expectation::Order(_) | Expectation::Happens(_) | Expectation::Never(_) => "s",
        Expectation::AtRest(_) | Expectation::Fingerprint(_) => "",
    }
}

fn moment(when: When) -> String {
    match when {
        When::At(time) => format!("at {time} s"),
        When::Throughout { from: 0.0, until: f64::INFINITY } => "always".to_owned(),
        When::Throughout { from, until: f64::INFINITY } => format!("from {from} s"),
        When::Throughout { from: 0.0, until } => format!("until {until} s"),
        When::Throughout { from, until } => format!("from {from} s until {until} s"),
    }
}

fn by(name: Option<&str>) -> String {
    name.map_or_else(String::new, |name| format!(" by \"{name}\""))
}

fn part(part: JointForcePart) -> &'static str {
    match part {
        JointForcePart::Magnitude => "",
        JointForcePart::X => " along x",
        JointForcePart::Y => " along y",
        JointForcePart::Z => " along z",
        JointForcePart::Torque => " (torque)",
    }
}

fn event(event: &Event) -> String {
    match event {
        Event::Touch(a, b) => format!("Touch(\"{a}\", \"{b}\")"),
        Event::Part(a, b) => format!("Part(\"{a}\", \"{b}\")"),
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, outcome) in self.outcomes.iter().enumerate() {
            let separator = if index == 0 { "" } else { "\n" };
            write!(formatter, "{separator}{outcome}")?;
        }
        Ok(())
    }
}

impl fmt::Display for Status {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.pad(match self {
            Self::Met => "ok",
            Self::Failed => "FAILED",
            Self::NotClaimed => "skipped",
        })
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{:<7} {}: ", self.status, self.name)?;
        match (&self.measured, &self.obstacle) {
            (Some(measured), _) => {
                write!(formatter, "{}", measured_text(measured, self.unit, self.resolution()))?;
                // The worst of many is named; what the title says already is not.
                if let Some(body) = self.body.as_ref().filter(|body| !self.name.contains(&format!("\"{body}\""))) {
                    write!(formatter, " of \"{body}\"")?;
                }
                if let Some(time) = self.time.map(seconds)
                    && self.names_its_time()
                    && !self.name.ends_with(&format!(" at {time}"))
                {
                    write!(formatter, " at {time}")?;
                }
            }
            (None, Some(obstacle)) => write!(formatter, "{obstacle}")?,
            (None, None) => write!(formatter, "not claimed for this contact model")?,
        }
        if let Some(expected) = &self.expected {
            write!(formatter, ", expected {}", expected_text(expected))?;
        }
        if !self.because.is_empty() {
            write!(formatter, " ({})", self.because)?;
        }
        Ok(())
    }
}

impl Outcome {
    /// The error that printing may make: it shows parts of the tolerance, and on which side of the limit a number is.
    fn resolution(&self) -> f64 {
        let (Some(measured), Some(expected)) = (&self.measured, &self.expected) else { return f64::INFINITY };
        let tolerance = expected.tolerance().unwrap_or(f64::INFINITY);
        let from_limit = Judgement::of(measured, expected).badness.abs();
        (tolerance / TOLERANCE_PARTS).min(from_limit / LIMIT_PARTS)
    }

    /// Whether what was measured is not a time itself, so that its time is worth a word.
    fn names_its_time(&self) -> bool {
        !matches!(self.expected, Some(Expected::Never | Expected::Order | Expected::Fingerprint(_))) && self.unit != "s"
    }
}

fn measured_text(measured: &Measured, unit: &str, resolution: f64) -> String {
    match measured {
        Measured::Number(value) => format!("{} {unit}", number(*value, resolution)),
        Measured::Vector(value) => format!("{} {unit}", vector(value, resolution)),
        Measured::Rest { speed, turn, drift } => {
            let [speed, turn, drift] = [speed, turn, drift].map(|value| number(*value, f64::INFINITY));
            format!("{speed} m/s, {turn} rad/s, drift {drift} m")
        }
        Measured::Times(times) => {
            let word = |time: &Option<f64>| time.map_or("never".to_owned(), seconds);
            times.iter().map(word).collect::<Vec<_>>().join(", ")
        }
        Measured::Fingerprint(fingerprint) => fingerprint.to_string(),
    }
}

fn expected_text(expected: &Expected) -> String {
    match expected {
        Expected::Number { near, above, below } => {
            let near = near.map(|Near { is, within }| {
                format!("{} ± {}", number(is, within / TOLERANCE_PARTS), as_written(within))
            });
            let above = above.map(|bound| format!("above {}", as_written(bound)));
            let below = below.map(|bound| format!("below {}", as_written(bound)));
            [near, above, below].into_iter().flatten().collect::<Vec<_>>().join(" and ")
        }
        Expected::AtMost(bound) => format!("at most {}", as_written(*bound)),
        Expected::Vector { is, within } => {
            format!("{} ± {}", vector(is, within / TOLERANCE_PARTS), as_written(*within))
        }
        Expected::Rest { speed_below, turn_below, drift_below } => {
            let [speed, turn] = [*speed_below, *turn_below].map(as_written);
            let drift = drift_below.map_or_else(String::new, |bound| format!(", drift below {} m", as_written(bound)));
            format!("below {speed} m/s, below {turn} rad/s{drift}")
        }
        Expected::Order => "in this order".to_owned(),
        Expected::Never => "never".to_owned(),
        Expected::Fingerprint(digits) => digits.clone(),
    }
}

fn vector(value: &WorldVector, resolution: f64) -> String {
    let components: Vec<String> = value.components().iter().map(|value| number(*value, resolution)).collect();
    format!("({})", components.join(", "))
}

/// A time.
pub(super) fn seconds(time: f64) -> String {
    format!("{} s", number(time, TIME_RESOLUTION))
}

/// All digits of a number.
fn as_written(value: f64) -> String {
    // Adding zero drops the sign of a zero.
    if is_plain(value) { format!("{}", value + 0.0) } else { format!("{value:e}") }
}

/// Whether a number reads well without an exponent.
fn is_plain(value: f64) -> bool {
    value == 0.0 || !value.is_finite() || (1e-4..1e7).contains(&value.abs())
}

/// A number with five digits, or as many as it takes to err by no more than the resolution.
fn number(value: f64, resolution: f64) -> String {
    const FEWEST_DIGITS: usize = 5;
    const MOST_DIGITS: usize = 17;
    let roundings = (FEWEST_DIGITS..MOST_DIGITS).filter_map(|digits| format!("{value:.*e}", digits - 1).parse().ok());
    let near_enough = |rounded: &f64| (rounded - value).abs() <= resolution;
    as_written(roundings.into_iter().find(near_enough).unwrap_or(value))
}
