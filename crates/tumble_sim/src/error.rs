//! Why a simulation cannot go on.

use thiserror::Error;

use crate::schedule::StepSystems;

/// A body or joint that cannot be simulated.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum BodyError {
    /// A dynamic body without mass.
    #[error("body \"{body}\" has no mass: give it a part with a positive density, or a mass")]
    NoMass {
        /// Name of the body.
        body: String,
    },
    /// A mass property that is not positive.
    #[error("{quantity} of body \"{body}\" is {value}; it must be positive and finite")]
    NotPositive {
        /// Name of the body.
        body: String,
        /// `mass`, `inertia` or `density`.
        quantity: &'static str,
        /// What it is.
        value: f64,
    },
    /// A dynamic body that could be turned by any torque without resistance.
    #[error("body \"{body}\" has no inertia: give it an inertia, or lock its rotation")]
    NoInertia {
        /// Name of the body.
        body: String,
    },
    /// A part without bounds on a dynamic body.
    #[error("body \"{body}\" has a half-plane and is dynamic: half-planes belong to static or kinematic bodies")]
    Unbounded {
        /// Name of the body.
        body: String,
    },
    /// Two bodies with one id.
    #[error("bodies \"{first}\" and \"{second}\" have the same id {id}")]
    SameId {
        /// Name of one.
        first: String,
        /// Name of the other.
        second: String,
        /// Their id.
        id: u64,
    },
    /// A joint that holds a body which is not there.
    #[error("joint \"{joint}\" holds a body that does not exist")]
    JointWithoutBody {
        /// Name of the joint.
        joint: String,
    },
    /// A joint between a body and itself, or the world and itself.
    #[error("joint \"{joint}\" holds one body to itself")]
    JointToItself {
        /// Name of the joint.
        joint: String,
    },
    /// A length or an axis that no joint can have.
    #[error("{quantity} of joint \"{joint}\" is {value}; it must be positive and finite")]
    BadJoint {
        /// Name of the joint.
        joint: String,
        /// `length` or `axis`.
        quantity: &'static str,
        /// What it is.
        value: f64,
    },
    /// Two bodies with one name.
    #[error("two bodies are named \"{name}\"")]
    SameName {
        /// The name.
        name: String,
    },
}

/// A step that failed.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum StepError {
    /// The state of a body is not a number any more.
    #[error("{quantity} of body \"{body}\" is not finite after {phase:?} in step {step}")]
    NotFinite {
        /// Name of the body.
        body: String,
        /// Which quantity.
        quantity: &'static str,
        /// The phase that produced it.
        phase: StepSystems,
        /// The step, counted from 1.
        step: u64,
    },
    /// So many bodies are in one place that their pairs do not fit into any memory.
    #[error(
        "body \"{body}\" is in a crowd of more than {most} pairs that may touch in step {step}: are all bodies in one place?"
    )]
    Crowded {
        /// Name of a body in the thick of it.
        body: String,
        /// Most pairs that are looked at.
        most: usize,
        /// The step, counted from 1.
        step: u64,
    },
    /// A body cannot be simulated.
    #[error(transparent)]
    Body(#[from] BodyError),
    /// The length of a step is not positive.
    #[error("dt is {0} s; it must be positive and finite")]
    TimeStep(f64),
}

/// No body has this name.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("no body is named \"{0}\"")]
pub struct UnknownBody(pub String);
