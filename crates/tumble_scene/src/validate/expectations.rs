//! Expectations.

use super::Findings;
use super::bodies::BodyNames;
use crate::dim::{AngularClaim, SceneDim};
use crate::format::{
    AngleExpectation, Dialect, Event, Expectation, JointForceExpectation, JointForcePart, OrientationExpectation,
    ScalarExpectation, Scene, TiltExpectation, VectorExpectation,
};
use crate::path::ScenePath;

pub(super) fn check<D: SceneDim>(scene: &Scene<D>, bodies: &BodyNames, found: &mut Findings) {
    for (index, expectation) in scene.expect.iter().enumerate() {
        let path = ScenePath::root().field("expect").index(index);
        Checker { scene, bodies, path }.check(expectation, found);
    }
}

struct Checker<'s, D: SceneDim> {
    scene: &'s Scene<D>,
    bodies: &'s BodyNames,
    path: ScenePath,
}

/// The fields that say when.
struct WhenFields {
    at: Option<f64>,
    always: bool,
    from: Option<f64>,
    until: Option<f64>,
}

/// The fields that say what, with the ending of their names.
struct ValueFields {
    suffix: &'static str,
    is: Option<f64>,
    within: Option<f64>,
    above: Option<f64>,
    below: Option<f64>,
}

impl<D: SceneDim> Checker<'_, D> {
    fn check(&self, expectation: &Expectation<D>, found: &mut Findings) {
        match expectation {
            Expectation::Position(e) | Expectation::Velocity(e) => self.vector(e, found),
            Expectation::X(e)
            | Expectation::Y(e)
            | Expectation::Z(e)
            | Expectation::VelocityX(e)
            | Expectation::VelocityY(e)
            | Expectation::VelocityZ(e)
            | Expectation::Speed(e)
            | Expectation::AngularVelocityX(e)
            | Expectation::AngularVelocityY(e)
            | Expectation::AngularVelocityZ(e)
            | Expectation::TurnRate(e) => self.scalar(e, found),
            Expectation::AngularVelocity(e) => match D::angular_claim(e) {
                AngularClaim::Scalar(e) => self.scalar(e, found),
                AngularClaim::Vector(e) => self.vector(e, found),
            },
            Expectation::Orientation(e) => self.orientation(e, found),
            Expectation::Tilt(e) => self.tilt(e, found),
            Expectation::Angle(e) => self.angle(e, found),
            Expectation::AtRest(e) => {
                if let Some(of) = &e.of {
                    self.body("of", of, found);
                }
                self.time("from", Some(e.from), found);
                found.positive(&self.path.field("speed_below"), "a bound", e.speed_below);
                found.positive(&self.path.field("turn_below"), "a bound", e.turn_below);
                if let Some(drift) = e.drift_below {
                    found.positive(&self.path.field("drift_below"), "a bound", drift);
                }
            }
            Expectation::EnergyNeverRises(e) => found.not_negative(&self.path.field("slack"), "a slack", e.slack),
            Expectation::EnergyKept(e) | Expectation::MomentumKept(e) | Expectation::AngularMomentumKept(e) => {
                found.not_negative(&self.path.field("within"), "a tolerance", e.within);
            }
            Expectation::Depth(e) => {
                self.when(&WhenFields { at: e.at, always: e.always, from: e.from, until: e.until }, false, found);
                found.not_negative(&self.path.field("below"), "a depth", e.below);
            }
            Expectation::ContactForceSum(e) => {
                self.force(&e.on, e.by.as_deref(), [e.at, e.from, e.until], e.within, found)
            }
            Expectation::FrictionForce(e) => {
                self.force(&e.on, e.by.as_deref(), [e.at, e.from, e.until], e.within, found);
                found.not_negative(&self.path.field("is"), "a magnitude", e.is);
            }
            Expectation::JointForce(e) => self.joint_force(e, found),
            Expectation::Order(e) => {
                if e.events.len() < 2 {
                    found.error(&self.path.field("events"), "an order needs at least two events", "name them here");
                }
                for (index, event) in e.events.iter().enumerate() {
                    self.event(&self.path.field("events").index(index), event, found);
                }
            }
            Expectation::Happens(e) => {
                self.event(&self.path.field("event"), &e.event, found);
                self.time("at", Some(e.at), found);
                found.not_negative(&self.path.field("within"), "a tolerance", e.within);
                if e.occurrence == 0 {
                    found.error(&self.path.field("occurrence"), "occurrences are counted from 1", "the first one is 1");
                }
            }
            Expectation::Never(e) => self.event(&self.path.field("event"), &e.event, found),
            Expectation::Fingerprint(e) => {
                if e.is.len() != 32 || !e.is.bytes().all(|byte| byte.is_ascii_hexdigit()) {
                    let label = format!("{} characters", e.is.chars().count());
                    found.error(&self.path.field("is"), "a fingerprint has 32 hexadecimal digits", label);
                }
            }
        }
    }

    fn body(&self, field: &str, name: &str, found: &mut Findings) {
        self.bodies.check_any(&self.path.field(field), name, found);
    }

    /// Reports a time before the start or past the end.
    fn time(&self, field: &str, time: Option<f64>, found: &mut Findings) {
        let Some(time) = time else { return };
        let path = self.path.field(field);
        let end = self.scene.duration;
        found.not_negative(&path, "a time", time);
        // A time may be written as a rounded decimal, so the end has the tolerance of one part in 10⁹.
        if time > end * (1.0 + 1e-9) {
            found.error(&path, "this is after the end of the run", format!("{time} s, but the run takes {end} s"));
        }
    }

    fn when(&self, when: &WhenFields, is_needed: bool, found: &mut Findings) {
        let WhenFields { at, always, from, until } = *when;
        for (field, time) in [("at", at), ("from", from), ("until", until)] {
            self.time(field, time, found);
        }
        let ways = [at.is_some(), always, from.is_some() || until.is_some()];
        match ways.into_iter().filter(|way| *way).count() {
            0 if is_needed => {
                found.error(
                    &self.path,
                    "this expectation does not say when",
                    "add `at: TIME`, `always: true`, or `from: TIME`",
                );
            }
            0 | 1 => {}
            _ => {
                let field = if at.is_some() { "at" } else { "always" };
                let label = "use one of `at`, `always`, or `from` and `until`";
                found.error(&self.path.field(field), "this expectation says in two ways when it holds", label);
            }
        }
        if let (Some(from), Some(until)) = (from, until)
            && until < from
        {
            found.error(
                &self.path.field("until"),
                "a window must end after it begins",
                format!("{until} s is before {from} s"),
            );
        }
    }

    fn vector<W: Dialect>(&self, e: &VectorExpectation<W>, found: &mut Findings) {
        self.body("of", &e.of, found);
        self.when(&WhenFields { at: e.at, always: e.always, from: e.from, until: e.until }, true, found);
        found.not_negative(&self.path.field("within"), "a tolerance", e.within);
    }

    fn orientation(&self, e: &OrientationExpectation, found: &mut Findings) {
        self.body("of", &e.of, found);
        self.when(&WhenFields { at: e.at, always: e.always, from: e.from, until: e.until }, true, found);
        found.not_negative(&self.path.field("within_degrees"), "a tolerance", e.within_degrees);
        if e.is.as_ref().is_some_and(|orientation| orientation.rotation().is_none()) {
            let label = "an axis or the quaternion is zero";
            found.error(&self.path.field("is"), "this orientation has no direction", label);
        }
    }

    fn tilt(&self, e: &TiltExpectation, found: &mut Findings) {
        self.body("of", &e.of, found);
        self.when(&WhenFields { at: e.at, always: e.always, from: e.from, until: e.until }, true, found);
        let value = ValueFields {
            suffix: "_degrees",
            is: e.is_degrees,
            within: e.within_degrees,
            above: e.above_degrees,
            below: e.below_degrees,
        };
        self.value(&value, found);
        for (field, direction) in [("axis", e.axis), ("against", e.against)] {
            if direction.is_some_and(|direction| direction.try_normalize().is_none()) {
                found.error(&self.path.field(field), "this has no direction", "it must not be (0, 0, 0)");
            }
        }
    }

    fn scalar(&self, e: &ScalarExpectation, found: &mut Findings) {
        self.body("of", &e.of, found);
        self.when(&WhenFields { at: e.at, always: e.always, from: e.from, until: e.until }, true, found);
        self.value(&ValueFields { suffix: "", is: e.is, within: e.within, above: e.above, below: e.below }, found);
    }

    fn angle(&self, e: &AngleExpectation, found: &mut Findings) {
        self.body("of", &e.of, found);
        self.when(&WhenFields { at: e.at, always: e.always, from: e.from, until: e.until }, true, found);
        let value = ValueFields {
            suffix: "_degrees",
            is: e.is_degrees,
            within: e.within_degrees,
            above: e.above_degrees,
            below: e.below_degrees,
        };
        self.value(&value, found);
    }

    fn joint_force(&self, e: &JointForceExpectation, found: &mut Findings) {
        if !self.scene.joints.iter().any(|joint| joint.name == e.of) {
            let allowed: Vec<&str> = self.scene.joints.iter().map(|joint| joint.name.as_str()).collect();
            found.unknown(&self.path.field("of"), "joint", &e.of, &allowed);
        }
        self.when(&WhenFields { at: e.at, always: e.always, from: e.from, until: e.until }, true, found);
        self.value(&ValueFields { suffix: "", is: e.is, within: e.within, above: e.above, below: e.below }, found);
        if e.part == JointForcePart::Magnitude
            && let Some(is) = e.is
        {
            found.not_negative(&self.path.field("is"), "a magnitude", is);
        }
    }

    fn value(&self, value: &ValueFields, found: &mut Findings) {
        let ValueFields { suffix, is, within, above, below } = *value;
        if is.is_none() && above.is_none() && below.is_none() {
            let label = format!("add `is{suffix}` and `within{suffix}`, or `above{suffix}`, or `below{suffix}`");
            found.error(&self.path, "this expectation does not say what", label);
        }
        match (is, within) {
            (Some(_), None) => {
                let label = format!("add `within{suffix}`");
                found.error(&self.path.field(&format!("is{suffix}")), "a value needs a tolerance", label);
            }
            (None, Some(_)) => {
                let label = format!("add `is{suffix}`");
                found.error(&self.path.field(&format!("within{suffix}")), "a tolerance needs a value", label);
            }
            (_, Some(within)) => {
                found.not_negative(&self.path.field(&format!("within{suffix}")), "a tolerance", within)
            }
            (None, None) => {}
        }
        if let (Some(above), Some(below)) = (above, below)
            && above >= below
        {
            let label = format!("nothing is above {above} and below {below}");
            found.error(&self.path.field(&format!("below{suffix}")), "these bounds exclude every value", label);
        }
    }

    fn force(
        &self,
        on: &str,
        by: Option<&str>,
        [at, from, until]: [Option<f64>; 3],
        within: f64,
        found: &mut Findings,
    ) {
        self.body("on", on, found);
        if let Some(by) = by {
            self.body("by", by, found);
        }
        self.when(&WhenFields { at, always: false, from, until }, true, found);
        found.not_negative(&self.path.field("within"), "a tolerance", within);
    }

    fn event(&self, path: &ScenePath, event: &Event, found: &mut Findings) {
        let [a, b] = event.bodies();
        self.bodies.check_any(&path.index(0), a, found);
        self.bodies.check_any(&path.index(1), b, found);
        // Copies of one repeated body do meet.
        if a == b && !self.bodies.families.contains(a) {
            found.error(&path.index(1), "an event is between two bodies", format!("\"{a}\" on both sides"));
        }
    }
}
