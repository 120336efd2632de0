//! Settings of a simulation.

use bevy_ecs::prelude::*;
use tumble_math::{Dim, Linear, Planar};
use tumble_solver::soft_step::SoftSettings;
use tumble_solver::velocity_lcp::{Restitution, VelocitySettings, VelocitySolver};

use crate::rest::SleepSettings;

/// Where steps are cut at impacts, slower bounces are rest: what is left of the Zeno time 2 v/(g (1 − ε)) is then below 1e-9 s up to
/// ε = 0.97 [length scales per second].
const SLOWEST_BOUNCE: f64 = 1e-10;

/// How positions follow velocities.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Integrator {
    /// v += a Δt, then x += v Δt (R7). First order; bounded energy error for oscillations.
    #[default]
    SymplecticEuler,
    /// x += v₀ Δt + ½ a Δt², v += a Δt: exact under constant force. Where the force changes, the next step adds half of the change to
    /// the velocity it starts from (velocity Verlet): second order. Where contacts or filters change the velocity, x moves with the
    /// mean of the velocities before and after.
    Ballistic,
}

/// Which law answers contacts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ContactModel {
    /// One-by-one impulses, and a velocity filter for rest.
    #[default]
    Impulse,
    /// Springs and dampers on overlapping points.
    Penalty,
    /// Forces at all resting contacts at once, from conditions on accelerations; impacts one by one.
    RestingLcp,
    /// Velocity complementarity: all contacts at once, exact friction.
    VelocityLcp,
    /// Soft contacts in substeps: for very many contacts.
    SoftStep,
}

impl ContactModel {
    /// All models.
    pub const ALL: [Self; 5] = [Self::Penalty, Self::Impulse, Self::RestingLcp, Self::VelocityLcp, Self::SoftStep];

    /// Its word on the command line and in outputs.
    pub fn word(self) -> &'static str {
        match self {
            Self::Penalty => "penalty",
            Self::Impulse => "impulse",
            Self::RestingLcp => "resting-lcp",
            Self::VelocityLcp => "velocity-lcp",
            Self::SoftStep => "soft-step",
        }
    }
}

/// Settings of the penalty model; see [`tumble_solver::penalty`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PenaltySettings {
    /// Which force law.
    pub law: PenaltyLaw,
}

impl Default for PenaltySettings {
    fn default() -> Self {
        Self { law: PenaltyLaw::SpringDamper(SpringDamperSettings::default()) }
    }
}

/// Force laws of the penalty model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PenaltyLaw {
    /// All contacts; spring, damper, regularised Coulomb friction.
    SpringDamper(SpringDamperSettings),
    /// The homework's floor to the letter (R9): rod ends on half-planes only.
    Lecture {
        /// w: force per depth [N/m].
        stiffness: f64,
        /// μ: force per slip speed [N·s/m].
        viscosity: f64,
    },
}

/// Spring and damper of the penalty model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringDamperSettings {
    /// k of every contact point; `None` chooses it per pair such that Δt is a tenth of the stable bound [N/m].
    pub stiffness: Option<f64>,
    /// c of every contact point; `None` chooses it from the restitution of the pair [N·s/m].
    pub damping: Option<f64>,
    /// Slip speed at which friction reaches μ_s N [m/s]. Default 0.01: smaller creeps less, and jitters sooner.
    pub slip_speed: f64,
}

impl Default for SpringDamperSettings {
    fn default() -> Self {
        Self { stiffness: None, damping: None, slip_speed: 0.01 }
    }
}

/// Settings of the impulse model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImpulseSettings {
    /// Most sweeps of the velocity filter, and of the position filter, per step [1].
    ///
    /// Default as many as keep the velocity filter near 50 000 single points (the position filter near 200 000), but at least 10 (30) and
    /// at most 500: small scenes are solved to the tolerance, and large ones take several steps to settle. More settles tall
    /// stacks sooner.
    pub iterations: Option<u32>,
    /// A sweep that changes no point's speed by more than this is the last [m/s per length scale]. Default 1e-12.
    pub tolerance: f64,
    /// A point that approaches faster than this is colliding [m/s]. Default 1e-9 length scales per second, and besides a hundredth
    /// of what gravity adds along the normal in a step (half of it for pairs without restitution): slower approaches are left to
    /// the velocity filter of the next step.
    pub colliding_above: Option<f64>,
    /// Most one-by-one impulses per step and contact point, on average [1]. Default as many as keep their number near 20 000, but at
    /// least 2 and at most 200; what is left approaching then is answered by the next step's velocity filter, and reported.
    pub impulses_per_contact: Option<u32>,
    /// Part of an overlap beyond the slop that is taken out per step [1]. Default 0.2.
    pub recovery: f64,
}

impl Default for ImpulseSettings {
    fn default() -> Self {
        Self { iterations: None, tolerance: 1e-12, colliding_above: None, impulses_per_contact: None, recovery: 0.2 }
    }
}

/// Settings of the velocity complementarity model.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VelocityLcpSettings {
    /// How an island of contacts is solved. Default `Auto`: by pivoting up to some size, then by Newton's method and sweeps.
    pub solver: VelocitySolver,
    /// Which law gives back speed. Default Poisson's, which never creates energy.
    pub restitution: Restitution,
}

/// Settings of a simulation. `Settings::default()` has Δt = 0.01 s and gravity 9.81 m/s² downwards.
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
pub struct Settings<D: Dim = Planar> {
    /// Length of a step Δt [s].
    pub dt: f64,
    /// Acceleration of free fall [m/s²].
    pub gravity: D::Vector,
    /// Size of a typical body; tolerances are multiples of it [m]. Default 1.
    pub length_scale: f64,
    /// Overlap that is left alone, so that resting contacts do not flicker on and off [m]. Default 0.005 length scales.
    pub slop: Option<f64>,
    /// Farthest travel within a step against which contacts are made beforehand [m]. Default 2 length scales. A body that
    /// moves further in a step is reported, and may pass through thin things.
    pub speculative_limit: Option<f64>,
    /// How positions follow velocities. The soft-step model takes symplectic Euler's way in its substeps, whatever stands here.
    pub integrator: Integrator,
    /// Whether the step is cut at every impact, so that bounces happen at their times and not at ends of steps. Bodies then move
    /// ballistically, whatever `integrator` says. The penalty and soft-step models cut no steps, and ignore it. Default false.
    pub time_of_impact: bool,
    /// Which law answers contacts.
    pub contact: ContactModel,
    /// Settings of the penalty model.
    pub penalty: PenaltySettings,
    /// Settings of the impulse model.
    pub impulse: ImpulseSettings,
    /// Settings of the velocity complementarity model.
    pub velocity_lcp: VelocityLcpSettings,
    /// Settings of the soft-step model.
    pub soft_step: SoftSettings,
    /// When bodies that rest fall asleep; `None` for never, which is the default. Only under the soft-step model; the others ignore it.
    pub sleep: Option<SleepSettings>,
}

impl<D: Dim> Settings<D> {
    /// Default settings without gravity.
    pub fn weightless() -> Self {
        Self {
            dt: 0.01,
            gravity: D::Vector::ZERO,
            length_scale: 1.0,
            slop: None,
            speculative_limit: None,
            integrator: Integrator::default(),
            time_of_impact: false,
            contact: ContactModel::default(),
            penalty: PenaltySettings::default(),
            impulse: ImpulseSettings::default(),
            velocity_lcp: VelocityLcpSettings::default(),
            soft_step: SoftSettings::default(),
            sleep: None,
        }
    }

    /// Overlap that is left alone [m].
    pub fn slop(&self) -> f64 {
        self.slop.unwrap_or(0.005 * self.length_scale)
    }

    /// Whether steps are cut at impacts.
    pub fn cuts_at_impacts(&self) -> bool {
        self.time_of_impact && !matches!(self.contact, ContactModel::Penalty | ContactModel::SoftStep)
    }

    /// How positions follow velocities, with what [`time_of_impact`](Self::time_of_impact) and the contact model say.
    pub fn moves_by(&self) -> Integrator {
        match self.contact {
            ContactModel::SoftStep => Integrator::SymplecticEuler,
            _ if self.cuts_at_impacts() => Integrator::Ballistic,
            _ => self.integrator,
        }
    }

    /// Speed that gravity adds along a normal in half a step; 1e-10 length scales per second where steps are cut at impacts [m/s].
    ///
    /// Slower than this is rest: a rebound would not leave the surface within the step.
    pub fn rest_speed(&self, normal: D::Vector) -> f64 {
        if self.cuts_at_impacts() {
            return SLOWEST_BOUNCE * self.length_scale;
        }
        0.5 * self.gravity.dot(normal).abs() * self.dt
    }

    /// A point that approaches faster than this is colliding, unless [`rest_speed`](Self::rest_speed) says otherwise [m/s].
    pub fn colliding_above(&self) -> f64 {
        let default = if self.cuts_at_impacts() { SLOWEST_BOUNCE } else { 1e-9 };
        self.impulse.colliding_above.unwrap_or(default * self.length_scale)
    }

    /// Most sweeps over `rows` contact points [1].
    pub fn sweeps(&self, rows: usize) -> u32 {
        let budget = || (50_000 / rows.max(1)).clamp(10, 500) as u32;
        self.impulse.iterations.unwrap_or_else(budget)
    }

    /// Most one-by-one impulses per contact point, on average over `rows` of them [1].
    pub fn impulses_per_contact(&self, rows: usize) -> u32 {
        let budget = || (20_000 / rows.max(1)).clamp(2, 200) as u32;
        self.impulse.impulses_per_contact.unwrap_or_else(budget)
    }

    /// Most sweeps of the position filter over `rows` contact points [1].
    ///
    /// More than the velocity filter gets, because what it leaves undone is an overlap; most steps end after a few.
    pub fn position_sweeps(&self, rows: usize) -> u32 {
        let budget = || (200_000 / rows.max(1)).clamp(30, 500) as u32;
        self.impulse.iterations.unwrap_or_else(budget)
    }

    /// How the velocity complementarity model is to solve.
    pub(crate) fn velocity(&self) -> VelocitySettings {
        VelocitySettings {
            solver: self.velocity_lcp.solver,
            restitution: self.velocity_lcp.restitution,
            colliding_above: self.colliding_above(),
            ..VelocitySettings::default()
        }
    }

    /// Farthest travel within a step against which contacts are made beforehand [m].
    pub fn speculative_limit(&self) -> f64 {
        self.speculative_limit.unwrap_or(2.0 * self.length_scale)
    }

    /// Points nearer than this touch [m].
    pub fn touch_tolerance(&self) -> f64 {
        1e-9 * self.length_scale
    }
}

impl Default for Settings<Planar> {
    fn default() -> Self {
        Self { gravity: glam::DVec2::new(0.0, -9.81), ..Self::weightless() }
    }
}
