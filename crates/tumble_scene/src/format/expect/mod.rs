//! Expectations: what a run of the scene must show.
//!
//! Each says when, what and how closely, and `because` of what; `under` names the contact models for which it is claimed
//! (default: all).

/// Declares an expectation: its own fields, with those that say when at the place of `[when]`, and after them why and for which models.
macro_rules! expectation {
    (
        $(#[$about:meta])*
        $name:ident$(<$dialect:ident>)? {
            $($(#[$field_about:meta])* $field:ident: $type:ty,)*
            $([when] $($(#[$later_about:meta])* $later:ident: $later_type:ty,)*)?
        }
    ) => {
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields)]
        $(#[$about])*
        pub struct $name$(<$dialect: Dialect = Planar>)? {
            $($(#[$field_about])* pub $field: $type,)*
            $(
                /// When [s].
                #[serde(default)]
                pub at: Option<f64>,
                /// Whether it holds throughout the run. Default false.
                #[serde(default)]
                pub always: bool,
                /// When it begins to hold [s]. Default the start, if `until` is given.
                #[serde(default)]
                pub from: Option<f64>,
                /// When it ceases to hold [s]. Default the end, if `from` is given.
                #[serde(default)]
                pub until: Option<f64>,
                $($(#[$later_about])* pub $later: $later_type,)*
            )?
            /// Why this must be so. Default empty.
            #[serde(default)]
            pub because: String,
            /// Contact models for which it is claimed. Default all.
            #[serde(default)]
            pub under: Vec<ContactModel>,
        }
    };
}

mod event;
mod force;
mod state;
mod world;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tumble_math::Planar;

use super::{ContactModel, Dialect};

pub use event::{Event, HappensExpectation, NeverExpectation, OrderExpectation};
pub use force::{ForceExpectation, FrictionExpectation, JointForceExpectation, JointForcePart, TargetForce};
pub use state::{
    AngleExpectation, AtRestExpectation, FingerprintExpectation, OrientationExpectation, ScalarExpectation,
    TiltExpectation, VectorExpectation,
};
pub use world::{DepthExpectation, EnergyNeverRisesExpectation, KeptExpectation};

/// Something a run must show.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(bound = "D: Dialect")]
#[schemars(bound = "D: Dialect")]
pub enum Expectation<D: Dialect = Planar> {
    /// Position of a body's centre of mass [m].
    Position(VectorExpectation<D>),
    /// First coordinate of a body's centre of mass [m].
    X(ScalarExpectation),
    /// Second coordinate of a body's centre of mass [m].
    Y(ScalarExpectation),
    /// Third coordinate of a body's centre of mass, in space [m].
    Z(ScalarExpectation),
    /// Angle of a body, counted over turns, in the plane [degrees].
    Angle(AngleExpectation),
    /// Orientation of a body, in space.
    Orientation(OrientationExpectation),
    /// Angle between an axis of a body and a direction, in space [degrees].
    Tilt(TiltExpectation),
    /// Velocity of a body's centre of mass [m/s].
    Velocity(VectorExpectation<D>),
    /// Velocity of a body's centre of mass along x [m/s].
    VelocityX(ScalarExpectation),
    /// Velocity of a body's centre of mass along y [m/s].
    VelocityY(ScalarExpectation),
    /// Velocity of a body's centre of mass along z, in space [m/s].
    VelocityZ(ScalarExpectation),
    /// Magnitude of the velocity of a body's centre of mass [m/s].
    Speed(ScalarExpectation),
    /// Rate of turn of a body: a number in the plane, a vector along world axes in space [rad/s].
    AngularVelocity(D::AngularExpectation),
    /// Rate of turn of a body about x, world axes, in space [rad/s].
    AngularVelocityX(ScalarExpectation),
    /// Rate of turn of a body about y, world axes, in space [rad/s].
    AngularVelocityY(ScalarExpectation),
    /// Rate of turn of a body about z, world axes, in space [rad/s].
    AngularVelocityZ(ScalarExpectation),
    /// Magnitude of the rate of turn of a body, in space [rad/s].
    TurnRate(ScalarExpectation),
    /// A body that has come to rest.
    AtRest(AtRestExpectation),
    /// Total energy never rises above its lowest value so far.
    EnergyNeverRises(EnergyNeverRisesExpectation),
    /// Total energy stays what it was at the start [J].
    EnergyKept(KeptExpectation),
    /// Total momentum stays what it was at the start [kg·m/s].
    MomentumKept(KeptExpectation),
    /// Angular momentum about the origin stays what it was at the start [kg·m²/s].
    AngularMomentumKept(KeptExpectation),
    /// Deepest overlap of any two bodies [m].
    Depth(DepthExpectation),
    /// Vector sum of the contact forces on a body [N].
    ContactForceSum(ForceExpectation<D>),
    /// Magnitude of the vector sum of the friction forces on a body [N].
    FrictionForce(FrictionExpectation),
    /// Force or torque of a joint [N], [N·m].
    JointForce(JointForceExpectation),
    /// Events that happen one before the other.
    Order(OrderExpectation),
    /// An event that happens at a time.
    Happens(HappensExpectation),
    /// An event that does not happen.
    Never(NeverExpectation),
    /// Every bit of the final state.
    Fingerprint(FingerprintExpectation),
}

/// When an expectation must hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum When {
    /// At one time [s].
    At(f64),
    /// From a time until another, ends included; infinite for the end of the run [s].
    Throughout {
        /// The first time [s].
        from: f64,
        /// The last time [s].
        until: f64,
    },
}

impl When {
    /// From the start to the end.
    pub const WHOLE_RUN: Self = Self::Throughout { from: 0.0, until: f64::INFINITY };

    /// Reads the fields of an expectation; without any of them, the whole run.
    fn of(at: Option<f64>, from: Option<f64>, until: Option<f64>) -> Self {
        match at {
            Some(time) => Self::At(time),
            None => Self::Throughout { from: from.unwrap_or(0.0), until: until.unwrap_or(f64::INFINITY) },
        }
    }
}

/// Does the same with the claim of any expectation.
macro_rules! each_claim {
    ($expectation:expr, $e:ident => $do:expr) => {
        match $expectation {
            Self::Position($e) | Self::Velocity($e) => $do,
            Self::X($e)
            | Self::Y($e)
            | Self::Z($e)
            | Self::VelocityX($e)
            | Self::VelocityY($e)
            | Self::VelocityZ($e)
            | Self::Speed($e)
            | Self::AngularVelocityX($e)
            | Self::AngularVelocityY($e)
            | Self::AngularVelocityZ($e)
            | Self::TurnRate($e) => $do,
            Self::Angle($e) => $do,
            Self::AngularVelocity($e) => $do,
            Self::Orientation($e) => $do,
            Self::Tilt($e) => $do,
            Self::AtRest($e) => $do,
            Self::EnergyNeverRises($e) => $do,
            Self::EnergyKept($e) | Self::MomentumKept($e) | Self::AngularMomentumKept($e) => $do,
            Self::Depth($e) => $do,
            Self::ContactForceSum($e) => $do,
            Self::FrictionForce($e) => $do,
            Self::JointForce($e) => $do,
            Self::Order($e) => $do,
            Self::Happens($e) => $do,
            Self::Never($e) => $do,
            Self::Fingerprint($e) => $do,
        }
    };
}

impl<D: Dialect> Expectation<D> {
    /// The variant's name, as it stands in a file.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Position(_) => "Position",
            Self::X(_) => "X",
            Self::Y(_) => "Y",
            Self::Z(_) => "Z",
            Self::Angle(_) => "Angle",
            Self::Orientation(_) => "Orientation",
            Self::Tilt(_) => "Tilt",
            Self::Velocity(_) => "Velocity",
            Self::VelocityX(_) => "VelocityX",
            Self::VelocityY(_) => "VelocityY",
            Self::VelocityZ(_) => "VelocityZ",
            Self::Speed(_) => "Speed",
            Self::AngularVelocity(_) => "AngularVelocity",
            Self::AngularVelocityX(_) => "AngularVelocityX",
            Self::AngularVelocityY(_) => "AngularVelocityY",
            Self::AngularVelocityZ(_) => "AngularVelocityZ",
            Self::TurnRate(_) => "TurnRate",
            Self::AtRest(_) => "AtRest",
            Self::EnergyNeverRises(_) => "EnergyNeverRises",
            Self::EnergyKept(_) => "EnergyKept",
            Self::MomentumKept(_) => "MomentumKept",
            Self::AngularMomentumKept(_) => "AngularMomentumKept",
            Self::Depth(_) => "Depth",
            Self::ContactForceSum(_) => "ContactForceSum",
            Self::FrictionForce(_) => "FrictionForce",
            Self::JointForce(_) => "JointForce",
            Self::Order(_) => "Order",
            Self::Happens(_) => "Happens",
            Self::Never(_) => "Never",
            Self::Fingerprint(_) => "Fingerprint",
        }
    }

    /// What all claims have in common.
    pub fn claim(&self) -> &dyn Claim {
        each_claim!(self, e => e)
    }

    /// Claims it for every contact model, whatever the scene says.
    pub fn claim_under_all(&mut self) {
        each_claim!(self, e => e.claim_under_all());
    }

    /// Why it must be so, as written, and the contact models for which it is claimed (empty: all).
    pub fn because_and_under(&self) -> (&str, &[ContactModel]) {
        let claim = self.claim();
        (claim.because(), claim.under())
    }

    /// Whether it is claimed for a contact model.
    pub fn is_claimed_under(&self, model: ContactModel) -> bool {
        let (_, under) = self.because_and_under();
        under.is_empty() || under.contains(&model)
    }

    /// When it must hold; the whole run for those that say nothing.
    pub fn when(&self) -> When {
        self.claim().when()
    }
}

/// What all claims have in common.
pub trait Claim {
    /// Why it must be so, as written.
    fn because(&self) -> &str;

    /// Contact models for which it is claimed; empty for all.
    fn under(&self) -> &[ContactModel];

    /// Claims it for every contact model.
    fn claim_under_all(&mut self);

    /// When it must hold; the whole run for those that say nothing.
    fn when(&self) -> When;

    /// Names of the bodies that it is about, as written.
    fn bodies(&self) -> Vec<&str>;
}

/// Says of a kind of claim when it holds and which bodies it is about.
macro_rules! claim {
    ($type:ident$(<$d:ident>)?, |$e:ident| $when:expr, $bodies:expr) => {
        impl$(<$d: Dialect>)? Claim for $type$(<$d>)? {
            fn because(&self) -> &str {
                &self.because
            }

            fn under(&self) -> &[ContactModel] {
                &self.under
            }

            fn claim_under_all(&mut self) {
                self.under.clear();
            }

            fn when(&self) -> When {
                #[allow(unused_variables)]
                let $e = self;
                $when
            }

            fn bodies(&self) -> Vec<&str> {
                #[allow(unused_variables)]
                let $e = self;
                $bodies
            }
        }
    };
}

/// The moment or window that a claim gives by `at`, `from` and `until`.
macro_rules! written {
    ($e:ident) => {
        When::of($e.at, $e.from, $e.until)
    };
}

claim!(VectorExpectation<D>, |e| written!(e), vec![&e.of]);
claim!(ScalarExpectation, |e| written!(e), vec![&e.of]);
claim!(AngleExpectation, |e| written!(e), vec![&e.of]);
claim!(OrientationExpectation, |e| written!(e), vec![&e.of]);
claim!(TiltExpectation, |e| written!(e), vec![&e.of]);
claim!(AtRestExpectation, |e| When::of(None, Some(e.from), None), e.of.as_deref().into_iter().collect());
claim!(DepthExpectation, |e| written!(e), Vec::new());
claim!(ForceExpectation<D>, |e| written!(e), [Some(&*e.on), e.by.as_deref()].into_iter().flatten().collect());
claim!(FrictionExpectation, |e| written!(e), [Some(&*e.on), e.by.as_deref()].into_iter().flatten().collect());
claim!(JointForceExpectation, |e| written!(e), Vec::new());
claim!(HappensExpectation, |e| When::At(e.at), e.event.bodies().into());
claim!(OrderExpectation, |e| When::WHOLE_RUN, e.events.iter().flat_map(Event::bodies).collect());
claim!(NeverExpectation, |e| When::WHOLE_RUN, e.event.bodies().into());
claim!(EnergyNeverRisesExpectation, |e| When::WHOLE_RUN, Vec::new());
claim!(KeptExpectation, |e| When::WHOLE_RUN, Vec::new());
claim!(FingerprintExpectation, |e| When::WHOLE_RUN, Vec::new());
