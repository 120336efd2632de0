//! What came of each expectation.

use tumble_math::Vector;
use tumble_record::Fingerprint;

use super::print::seconds;
use crate::format::{
    AngleExpectation, AtRestExpectation, DepthExpectation, Dialect, JointForceExpectation, ScalarExpectation,
    TiltExpectation, VectorExpectation,
};

/// What came of all expectations of a scene, in their order; its `Display` is one line for each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Verdict {
    /// One for each expectation of the scene.
    pub outcomes: Vec<Outcome>,
}

impl Verdict {
    /// Whether no expectation failed.
    pub fn passed(&self) -> bool {
        self.failures().next().is_none()
    }

    /// The outcomes that failed.
    pub fn failures(&self) -> impl Iterator<Item = &Outcome> {
        self.outcomes.iter().filter(|outcome| outcome.status == Status::Failed)
    }

    /// Number of outcomes of a status.
    pub fn count(&self, status: Status) -> usize {
        self.outcomes.iter().filter(|outcome| outcome.status == status).count()
    }
}

/// What came of one expectation; its `Display` is one line.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Its place in the scene's list, counted from 0.
    pub index: usize,
    /// What is expected of whom and when: `Speed of "box" at 2 s`.
    pub name: String,
    /// Unit of the numbers measured and expected; empty where there is none.
    pub unit: &'static str,
    /// Met, failed or not claimed.
    pub status: Status,
    /// What was measured, in the unit; none if it could not be, or was not claimed.
    pub measured: Option<Measured>,
    /// What is right, in the unit; none where it depends on a run that could not be measured.
    pub expected: Option<Expected>,
    /// When it was measured: for a window the time of the worst sample, none for an average [s].
    pub time: Option<f64>,
    /// Name of the body that was measured; of several the worst.
    pub body: Option<String>,
    /// Why nothing could be measured, which has failed.
    pub obstacle: Option<NotMeasured>,
    /// Why it must be so, as written in the scene.
    pub because: String,
}

/// Whether an expectation was met.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// It was met.
    Met,
    /// It was not met, or never reached.
    Failed,
    /// It is not claimed for the contact model that ran.
    NotClaimed,
}

/// What was measured.
#[derive(Clone, Debug, PartialEq)]
pub enum Measured {
    /// A number.
    Number(f64),
    /// A vector, world axes.
    Vector(WorldVector),
    /// How a body moved at one time.
    Rest {
        /// Speed of its centre of mass [m/s].
        speed: f64,
        /// Magnitude of its rate of turn [rad/s].
        turn: f64,
        /// Distance from where it was at the first sample of the window [m].
        drift: f64,
    },
    /// When each event first happened; none if it did not [s].
    Times(Vec<Option<f64>>),
    /// Digest of the final state.
    Fingerprint(Fingerprint),
}

impl Measured {
    /// A vector of either dimension.
    pub(crate) fn of_vector<V: Vector>(vector: V) -> Self {
        Self::Vector(WorldVector::new(vector))
    }

    /// The number, if it is one.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            _ => None,
        }
    }

    /// The vector, if it is one.
    pub fn vector(&self) -> Option<WorldVector> {
        match self {
            Self::Vector(vector) => Some(*vector),
            _ => None,
        }
    }
}

/// A vector of the plane or of space, world axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorldVector {
    components: [f64; 3],
    axes: usize,
}

impl WorldVector {
    pub(super) fn new<V: Vector>(vector: V) -> Self {
        let mut components = [0.0; 3];
        for (axis, component) in components.iter_mut().enumerate().take(V::AXES) {
            *component = vector[axis];
        }
        Self { components, axes: V::AXES }
    }

    /// Two components in the plane, three in space.
    pub fn components(&self) -> &[f64] {
        &self.components[..self.axes]
    }

    /// Euclidean distance to another one.
    pub fn distance(&self, other: &Self) -> f64 {
        let square = |(one, other): (&f64, &f64)| (one - other) * (one - other);
        self.components.iter().zip(&other.components).map(square).sum::<f64>().sqrt()
    }
}

/// A value and how far from it is still right; the tolerance itself is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    /// The value.
    pub is: f64,
    /// Largest distance from it.
    pub within: f64,
}

impl Near {
    /// A value without tolerance must be hit exactly; validation has refused such scenes.
    fn of(is: Option<f64>, within: Option<f64>) -> Option<Self> {
        is.map(|is| Self { is, within: within.unwrap_or(0.0) })
    }
}

/// What is right.
#[derive(Clone, Debug, PartialEq)]
pub enum Expected {
    /// A number near a value and strictly between bounds, each where given.
    Number {
        /// The value with its tolerance.
        near: Option<Near>,
        /// Lower bound.
        above: Option<f64>,
        /// Upper bound.
        below: Option<f64>,
    },
    /// A number that is at most this.
    AtMost(f64),
    /// A vector near a value.
    Vector {
        /// The value.
        is: WorldVector,
        /// Largest distance from it.
        within: f64,
    },
    /// A body that hardly moves.
    Rest {
        /// Upper bound of the speed [m/s].
        speed_below: f64,
        /// Upper bound of the magnitude of the rate of turn [rad/s].
        turn_below: f64,
        /// Upper bound of the drift [m].
        drift_below: Option<f64>,
    },
    /// Times that strictly rise.
    Order,
    /// No time: the event does not happen.
    Never,
    /// The final state, as 32 hexadecimal digits in either case.
    Fingerprint(String),
}

impl Expected {
    /// A vector near a value.
    pub(super) fn near_vector<V: Vector>(is: V, within: f64) -> Self {
        Self::Vector { is: WorldVector::new(is), within }
    }

    /// The same as was measured.
    pub(super) fn same(measured: Measured, within: f64) -> Self {
        match measured {
            Measured::Vector(is) => Self::Vector { is, within },
            measured => Self::near(measured.number().unwrap_or(f64::NAN), within),
        }
    }

    /// A number near a value.
    pub(super) fn near(is: f64, within: f64) -> Self {
        Self::Number { near: Some(Near { is, within }), above: None, below: None }
    }

    /// The value, if it is a number.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number { near, .. } => near.map(|near| near.is),
            _ => None,
        }
    }

    /// The vector, if it is one.
    pub fn vector(&self) -> Option<WorldVector> {
        match self {
            Self::Vector { is, .. } => Some(*is),
            _ => None,
        }
    }

    /// How far from the value is still right, where there is a value.
    pub fn tolerance(&self) -> Option<f64> {
        match self {
            Self::Number { near, .. } => near.map(|near| near.within),
            Self::Vector { within, .. } => Some(*within),
            _ => None,
        }
    }
}

impl<D: Dialect> From<&VectorExpectation<D>> for Expected {
    fn from(e: &VectorExpectation<D>) -> Self {
        Self::near_vector(e.is, e.within)
    }
}

impl From<&ScalarExpectation> for Expected {
    fn from(e: &ScalarExpectation) -> Self {
        Self::Number { near: Near::of(e.is, e.within), above: e.above, below: e.below }
    }
}

impl From<&JointForceExpectation> for Expected {
    fn from(e: &JointForceExpectation) -> Self {
        Self::Number { near: Near::of(e.is, e.within), above: e.above, below: e.below }
    }
}

impl From<&AngleExpectation> for Expected {
    fn from(e: &AngleExpectation) -> Self {
        let near = Near::of(e.is_degrees, e.within_degrees);
        Self::Number { near, above: e.above_degrees, below: e.below_degrees }
    }
}

impl From<&TiltExpectation> for Expected {
    fn from(e: &TiltExpectation) -> Self {
        let near = Near::of(e.is_degrees, e.within_degrees);
        Self::Number { near, above: e.above_degrees, below: e.below_degrees }
    }
}

impl From<&AtRestExpectation> for Expected {
    fn from(e: &AtRestExpectation) -> Self {
        Self::Rest { speed_below: e.speed_below, turn_below: e.turn_below, drift_below: e.drift_below }
    }
}

impl From<&DepthExpectation> for Expected {
    fn from(e: &DepthExpectation) -> Self {
        Self::AtMost(e.below)
    }
}

/// Why an expectation could not be measured.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NotMeasured {
    /// The recording ends before the time, or before a window is over.
    #[error("not reached, the recording ends at {}", seconds(*end))]
    NotReached {
        /// Time of the last sample [s].
        end: f64,
    },
    /// Nothing was recorded.
    #[error("not reached, nothing was recorded")]
    NothingRecorded,
    /// No sample lies in the window.
    #[error("no sample lies in the window")]
    EmptyWindow,
    /// The recording has no row of audits for the time.
    #[error("the recording has no audit for it")]
    NoAudit,
    /// No body of this name was recorded.
    #[error("there is no body \"{name}\"")]
    UnknownBody {
        /// The name.
        name: String,
    },
    /// No joint of this name was recorded.
    #[error("there is no joint \"{name}\"")]
    UnknownJoint {
        /// The name.
        name: String,
    },
    /// Rest is expected of every dynamic body, and none was recorded.
    #[error("there is no dynamic body")]
    NoDynamicBody,
    /// A body is not in the world at a time when it is needed.
    #[error("\"{body}\" is not in the world at {}", seconds(*time))]
    BodyAbsent {
        /// Name of the body.
        body: String,
        /// The time [s].
        time: f64,
    },
    /// Weight is expected on a body that is not dynamic.
    #[error("\"{body}\" is not dynamic and has no weight")]
    NoWeight {
        /// Name of the body.
        body: String,
    },
    /// An event did not happen as often as it should.
    #[error("not reached, it happened only {times}×")]
    TooFewEvents {
        /// How often it happened.
        times: usize,
    },
}
