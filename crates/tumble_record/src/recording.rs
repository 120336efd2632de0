//! The plain data of a run: bodies, samples, audit rows, touches.

use std::borrow::Cow;

use glam::DVec2;
use serde::{Deserialize, Serialize};
use tumble_math::{Planar, Pose};
use tumble_sim::Ledger;

use crate::dim::RecordDim;
use crate::fingerprint::{Fingerprint, FingerprintHasher};

/// Everything that is kept of one run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(bound = "")]
pub struct Recording<D: RecordDim = Planar> {
    /// Name of the scene.
    pub scene: String,
    /// One sentence about the scene; may be empty.
    pub about: String,
    /// Name of the contact model, as on the command line (`impulse`).
    pub contact: String,
    /// Length of a step [s].
    pub dt: f64,
    /// Typical size of a body, to which tolerances are relative [m].
    pub length_scale: f64,
    /// Acceleration of gravity; pictures have it point down [m/s²].
    #[serde(default)]
    pub gravity: D::Vector,
    /// All bodies that were ever in the world; everything else refers to them by their index here.
    pub bodies: Vec<BodyRecord<D>>,
    /// All springs that were ever in the world, in the order they appeared.
    #[serde(default)]
    pub springs: Vec<SpringRecord<D>>,
    /// All joints that were ever in the world, in the order they appeared.
    #[serde(default)]
    pub joints: Vec<JointRecord<D>>,
    /// States and contacts at the sampled steps, in the order of time.
    pub samples: Vec<Sample<D>>,
    /// Sums over the whole world, one row per step; empty when audits were off.
    pub audit: Vec<AuditRow<D>>,
    /// Begin and end of touch, in the order they were sent.
    pub touches: Vec<Touch>,
}

/// What does not change about a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(bound = "")]
pub struct BodyRecord<D: RecordDim = Planar> {
    /// Stable id; decides every order that can touch a number.
    pub id: u64,
    /// Unique name.
    pub name: String,
    /// Who moves it.
    pub kind: BodyKind,
    /// Mass; infinite for static and kinematic bodies [kg].
    pub mass: f64,
    /// Inertia about the centre of mass, in body axes; infinite for static and kinematic bodies [kg·m²].
    pub inertia: D::Inertia,
    /// Shapes attached to it.
    pub shapes: Vec<ShapeRecord<D>>,
}

/// Who moves a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum BodyKind {
    /// Forces do.
    Dynamic,
    /// Its prescribed velocity does.
    Kinematic,
    /// Nobody does.
    Static,
}

/// A shape on a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(bound = "")]
pub struct ShapeRecord<D: RecordDim = Planar> {
    /// Its outline in the body frame: origin at the centre of mass, turning with the body.
    pub geometry: D::Outline,
    /// Whether it only reports touches and never pushes.
    pub sensor: bool,
}

/// A spring between two points.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(bound = "")]
pub struct SpringRecord<D: RecordDim = Planar> {
    /// One end.
    pub a: AnchorRecord<D>,
    /// The other end.
    pub b: AnchorRecord<D>,
    /// Length without force [m].
    pub rest_length: f64,
    /// Since when it is there [s].
    pub from: f64,
    /// From when on it is gone; `None` if it stayed to the end [s].
    pub until: Option<f64>,
}

/// A joint between two bodies, or a body and the world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(bound = "")]
pub struct JointRecord<D: RecordDim = Planar> {
    /// Unique name.
    pub name: String,
    /// What it lets the two do, in a word: `revolute`, `distance`, `fixed`, `prismatic`.
    pub kind: Cow<'static, str>,
    /// Where it holds the first body.
    pub a: AnchorRecord<D>,
    /// Where it holds the second body.
    pub b: AnchorRecord<D>,
    /// Direction of sliding, in the frame of the first body; only of prismatic joints [1].
    pub axis: Option<D::Vector>,
    /// Since when it is there [s].
    pub from: f64,
    /// From when on it is gone; `None` if it stayed to the end [s].
    pub until: Option<f64>,
}

/// What a joint did to its second body in a step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(bound = "")]
pub struct JointForce<D: RecordDim = Planar> {
    /// Index of the joint.
    pub joint: usize,
    /// Where it holds the second body [m].
    pub point: D::Vector,
    /// Force at that point, in world axes, mean over the step [N].
    pub force: D::Vector,
    /// Torque about that point, in world axes, counter-clockwise in the plane, mean over the step [N·m].
    pub torque: D::Angular,
}

/// Where a spring or a joint is held.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(bound = "")]
pub struct AnchorRecord<D: RecordDim = Planar> {
    /// Index of the body; `None` for a point of the world.
    pub body: Option<usize>,
    /// The point, in the body frame, or in world axes without a body [m].
    pub point: D::Vector,
}

/// The world at one sampled step.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(bound = "")]
pub struct Sample<D: RecordDim = Planar> {
    /// Steps taken so far; 0 is the start.
    pub step: u64,
    /// Simulated time [s].
    pub time: f64,
    /// State of each body, in the order of [`Recording::bodies`]; `None`, or missing at the end, while a body is not in the world.
    pub states: Vec<Option<BodyState<D>>>,
    /// Touching points.
    pub contacts: Vec<ContactRecord<D>>,
    /// Forces of the joints that are in the world, those of the step that ended here.
    #[serde(default)]
    pub joints: Vec<JointForce<D>>,
}

impl<D: RecordDim> AnchorRecord<D> {
    /// Returns where it is in a sample, or nothing while its body is not in the world [m].
    pub fn in_world(&self, sample: &Sample<D>) -> Option<D::Vector> {
        let Some(body) = self.body else { return Some(self.point) };
        Some(sample.state(body)?.pose().transform_point(self.point))
    }
}

impl<D: RecordDim> Sample<D> {
    /// Returns the state of a body by its index, or nothing while it is not in the world.
    pub fn state(&self, body: usize) -> Option<&BodyState<D>> {
        self.states.get(body)?.as_ref()
    }
}

/// Where a body is and how it moves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(bound = "")]
pub struct BodyState<D: RecordDim = Planar> {
    /// Centre of mass [m].
    pub position: D::Vector,
    /// Body axes to world axes: in the plane the angle, accumulated over turns [rad], in space a unit quaternion.
    pub orientation: D::Orientation,
    /// Velocity of the centre of mass [m/s].
    pub velocity: D::Vector,
    /// Rate of turning in world axes, counter-clockwise in the plane [rad/s].
    pub angular_velocity: D::Angular,
}

/// One touching point between two bodies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(bound = "")]
pub struct ContactRecord<D: RecordDim = Planar> {
    /// Index of the body with the smaller id.
    pub a: usize,
    /// Index of the other body.
    pub b: usize,
    /// Where they touch [m].
    pub point: D::Vector,
    /// Unit vector from a to b [1].
    pub normal: D::Vector,
    /// Gap along the normal, negative when overlapping [m].
    pub separation: f64,
    /// Impulse on b along the normal, summed over the step [N·s].
    pub normal_impulse: f64,
    /// Impulse on b along the surface, summed over the step: along the tangent (n_y, −n_x), in space a vector in world axes [N·s].
    pub tangent_impulse: D::Tangent,
    /// Kind of contact: the name of a variant of the collision layer's closed list.
    pub kind: Cow<'static, str>,
}

impl ContactRecord {
    /// Returns the unit tangent (n_y, −n_x): the normal turned a quarter clockwise [1].
    pub fn tangent(&self) -> DVec2 {
        DVec2::new(self.normal.y, -self.normal.x)
    }
}

impl<D: RecordDim> ContactRecord<D> {
    /// Returns the friction impulse on b, summed over the step [N·s].
    pub fn friction_on_b(&self) -> D::Vector {
        D::tangent_vector(self.normal, self.tangent_impulse)
    }

    /// Returns the impulse on b, summed over the step [N·s].
    pub fn impulse_on_b(&self) -> D::Vector {
        self.normal * self.normal_impulse + self.friction_on_b()
    }
}

/// Sums over the whole world after one step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(bound = "")]
pub struct AuditRow<D: RecordDim = Planar> {
    /// Steps taken so far; 0 is the start.
    pub step: u64,
    /// Simulated time [s].
    pub time: f64,
    /// Kinetic energy of the dynamic bodies [J].
    pub kinetic: f64,
    /// Potential energy of gravity and springs [J].
    pub potential: f64,
    /// Kinetic plus potential energy [J].
    pub total: f64,
    /// Momentum [kg·m/s].
    pub momentum: D::Vector,
    /// Angular momentum about the world origin [kg·m²/s].
    pub angular_momentum: D::Angular,
    /// Largest overlap of a touching pair, 0 when none overlaps [m].
    pub deepest_overlap: f64,
    /// Number of touching points.
    pub contacts: u64,
    /// Sweeps of the contact solver, if one ran.
    pub iterations: Option<u64>,
    /// What the contact solver left unsolved, in its own measure.
    pub residual: Option<f64>,
    /// The books of the step.
    #[serde(default)]
    pub ledger: Ledger,
}

/// Two bodies that began or ceased to touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum TouchPhase {
    /// They did not touch before this step.
    Begin,
    /// They no longer touch.
    End,
}

/// Message that two bodies began or ceased to touch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Touch {
    /// Step in which it was found.
    pub step: u64,
    /// Time at the end of that step [s].
    pub time: f64,
    /// Index of the body with the smaller id.
    pub a: usize,
    /// Index of the other body.
    pub b: usize,
    /// Begin or end.
    pub phase: TouchPhase,
    /// Whether a sensor was involved, so that no force acts.
    pub sensor: bool,
}

impl<D: RecordDim> Recording<D> {
    /// Returns the index of the body of this name.
    pub fn body(&self, name: &str) -> Option<usize> {
        self.bodies.iter().position(|body| body.name == name)
    }

    /// Returns the names of all bodies, in the order of the recording.
    pub fn body_names(&self) -> impl Iterator<Item = &str> {
        self.bodies.iter().map(|body| body.name.as_str())
    }

    /// Returns the state of a body over time: (sample, state) for each sample in which it is in the world.
    pub fn states(&self, body: usize) -> impl Iterator<Item = (&Sample<D>, &BodyState<D>)> {
        self.samples.iter().filter_map(move |sample| Some((sample, sample.state(body)?)))
    }

    /// Returns the fingerprint of a sample: its step, then id, pose and velocity of each body in the order of ids.
    pub fn fingerprint(&self, sample: &Sample<D>) -> Fingerprint {
        let mut present: Vec<(u64, &BodyState<D>)> =
            self.bodies.iter().enumerate().filter_map(|(index, body)| Some((body.id, sample.state(index)?))).collect();
        present.sort_by_key(|(id, _)| *id);
        let mut hasher = FingerprintHasher::new(sample.step);
        for (id, state) in present {
            hasher.body(id, state.numbers().as_ref());
        }
        hasher.finish()
    }
}

impl<D: RecordDim> BodyState<D> {
    /// Returns position, orientation, velocity, rate of turn: the order of the columns of `trajectory.csv` and of the fingerprint.
    ///
    /// In the plane x, y, angle, vx, vy, ω; in space x, y, z, qx, qy, qz, qw, vx, vy, vz, ωx, ωy, ωz.
    pub fn numbers(&self) -> D::Numbers {
        D::numbers(self)
    }

    /// Returns where it is and how it is turned.
    pub fn pose(&self) -> Pose<D> {
        Pose { position: self.position, rotation: D::rotation(&self.orientation) }
    }
}

impl BodyState {
    /// Returns the angle from the world axes, accumulated over turns [rad].
    pub fn angle(&self) -> f64 {
        self.orientation
    }
}
