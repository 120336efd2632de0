//! The quantities that channels can show, with their names.

use crate::dim::Home::{self, Both, Plane, Space};

/// A quantity of the whole world, from the audit: one value per step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WorldQuantity {
    /// Kinetic energy [J].
    Kinetic,
    /// Potential energy [J].
    Potential,
    /// Kinetic plus potential energy [J].
    Total,
    /// Momentum along x [kg·m/s].
    MomentumX,
    /// Momentum along y [kg·m/s].
    MomentumY,
    /// Momentum along z; in space [kg·m/s].
    MomentumZ,
    /// Angular momentum about the origin; in the plane [kg·m²/s].
    AngularMomentum,
    /// Angular momentum about the x axis; in space [kg·m²/s].
    AngularMomentumX,
    /// Angular momentum about the y axis; in space [kg·m²/s].
    AngularMomentumY,
    /// Angular momentum about the z axis; in space [kg·m²/s].
    AngularMomentumZ,
    /// Largest overlap [m].
    DeepestOverlap,
    /// Number of touching points [1].
    Contacts,
    /// Sweeps of the contact solver [1].
    Iterations,
    /// What the contact solver left unsolved.
    Residual,
}

/// A quantity of one body: one value per sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BodyQuantity {
    /// Centre of mass along x [m].
    X,
    /// Centre of mass along y [m].
    Y,
    /// Centre of mass along z; in space [m].
    Z,
    /// Angle, accumulated over turns; in the plane [rad].
    Angle,
    /// Velocity along x [m/s].
    Vx,
    /// Velocity along y [m/s].
    Vy,
    /// Velocity along z; in space [m/s].
    Vz,
    /// Rate of turning; in the plane [rad/s].
    Omega,
    /// Rate of turning about the world's x axis; in space [rad/s].
    Wx,
    /// Rate of turning about the world's y axis; in space [rad/s].
    Wy,
    /// Rate of turning about the world's z axis; in space [rad/s].
    Wz,
    /// Speed of the centre of mass [m/s].
    Speed,
    /// Kinetic energy ½ m v² + ½ ω · I ω [J].
    Kinetic,
    /// Sum of the normal forces of its contacts, each normal impulse of the step divided by dt [N].
    NormalForce,
    /// Sum of the friction forces on it, each tangent impulse of the step divided by dt [N]; in space its magnitude.
    ///
    /// In the plane positive along the pushing normal turned a quarter clockwise: to the right, for a body that stands on a floor.
    /// The sign is the same whether the body is a or b, because changing sides turns the normal and the force alike.
    FrictionForce,
    /// Number of its touching points [1].
    Contacts,
}

/// A quantity of one joint: one value per sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointQuantity {
    /// Magnitude of its force [N].
    Force,
    /// Its force on its second body along x [N].
    ForceX,
    /// Its force on its second body along y [N].
    ForceY,
    /// Its force on its second body along z; in space [N].
    ForceZ,
    /// Its torque on its second body about the anchor; in space its magnitude [N·m].
    Torque,
}

/// What the lists say about a quantity, whatever it belongs to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Description {
    /// Its name on the command line.
    pub name: &'static str,
    /// What it is, in words.
    pub title: &'static str,
    /// Its unit; `1` for counts.
    pub unit: &'static str,
    /// Where it is at home.
    pub home: Home,
}

/// A quantity and what a channel says about it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry<Q> {
    /// The quantity.
    pub quantity: Q,
    /// What is said about it.
    pub description: Description,
}

impl<Q> Entry<Q> {
    const fn of(quantity: Q, name: &'static str, title: &'static str, unit: &'static str, home: Home) -> Self {
        Self { quantity, description: Description { name, title, unit, home } }
    }
}

/// Finds a quantity in its list.
pub(super) fn describe<Q: Copy + PartialEq>(list: &[Entry<Q>], quantity: Q) -> Description {
    list.iter().find(|entry| entry.quantity == quantity).expect("the lists have every quantity").description
}

/// Finds the quantity of a name in a list.
pub(super) fn named<Q: Copy>(list: &[Entry<Q>], name: &str) -> Option<Q> {
    list.iter().find(|entry| entry.description.name == name).map(|entry| entry.quantity)
}

/// What channels say about the quantities of a joint.
pub(super) const JOINT_QUANTITIES: [Entry<JointQuantity>; 5] = [
    Entry::of(JointQuantity::Force, "joint_force", "force of the joint", "N", Both),
    Entry::of(JointQuantity::ForceX, "joint_force_x", "force of the joint along x", "N", Both),
    Entry::of(JointQuantity::ForceY, "joint_force_y", "force of the joint along y", "N", Both),
    Entry::of(JointQuantity::ForceZ, "joint_force_z", "force of the joint along z", "N", Space),
    Entry::of(JointQuantity::Torque, "joint_torque", "torque of the joint", "N·m", Both),
];

/// What channels say about the quantities of the world.
pub(super) const WORLD_QUANTITIES: [Entry<WorldQuantity>; 14] = [
    Entry::of(WorldQuantity::Kinetic, "kinetic", "kinetic energy", "J", Both),
    Entry::of(WorldQuantity::Potential, "potential", "potential energy", "J", Both),
    Entry::of(WorldQuantity::Total, "total", "total energy", "J", Both),
    Entry::of(WorldQuantity::MomentumX, "momentum_x", "momentum along x", "kg·m/s", Both),
    Entry::of(WorldQuantity::MomentumY, "momentum_y", "momentum along y", "kg·m/s", Both),
    Entry::of(WorldQuantity::MomentumZ, "momentum_z", "momentum along z", "kg·m/s", Space),
    Entry::of(
        WorldQuantity::AngularMomentum,
        "angular_momentum",
        "angular momentum about the origin",
        "kg·m²/s",
        Plane,
    ),
    Entry::of(
        WorldQuantity::AngularMomentumX,
        "angular_momentum_x",
        "angular momentum about the x axis",
        "kg·m²/s",
        Space,
    ),
    Entry::of(
        WorldQuantity::AngularMomentumY,
        "angular_momentum_y",
        "angular momentum about the y axis",
        "kg·m²/s",
        Space,
    ),
    Entry::of(
        WorldQuantity::AngularMomentumZ,
        "angular_momentum_z",
        "angular momentum about the z axis",
        "kg·m²/s",
        Space,
    ),
    Entry::of(WorldQuantity::DeepestOverlap, "deepest_overlap", "deepest overlap", "m", Both),
    Entry::of(WorldQuantity::Contacts, "contacts", "touching points", "1", Both),
    Entry::of(WorldQuantity::Iterations, "iterations", "solver iterations", "1", Both),
    Entry::of(WorldQuantity::Residual, "residual", "solver residual", "1", Both),
];

/// What channels say about the quantities of a body.
pub(super) const BODY_QUANTITIES: [Entry<BodyQuantity>; 16] = [
    Entry::of(BodyQuantity::X, "x", "x of the centre of mass", "m", Both),
    Entry::of(BodyQuantity::Y, "y", "y of the centre of mass", "m", Both),
    Entry::of(BodyQuantity::Z, "z", "z of the centre of mass", "m", Space),
    Entry::of(BodyQuantity::Angle, "angle", "angle", "rad", Plane),
    Entry::of(BodyQuantity::Vx, "vx", "velocity along x", "m/s", Both),
    Entry::of(BodyQuantity::Vy, "vy", "velocity along y", "m/s", Both),
    Entry::of(BodyQuantity::Vz, "vz", "velocity along z", "m/s", Space),
    Entry::of(BodyQuantity::Omega, "omega", "angular velocity", "rad/s", Plane),
    Entry::of(BodyQuantity::Wx, "wx", "angular velocity about x", "rad/s", Space),
    Entry::of(BodyQuantity::Wy, "wy", "angular velocity about y", "rad/s", Space),
    Entry::of(BodyQuantity::Wz, "wz", "angular velocity about z", "rad/s", Space),
    Entry::of(BodyQuantity::Speed, "speed", "speed", "m/s", Both),
    Entry::of(BodyQuantity::Kinetic, "kinetic", "kinetic energy", "J", Both),
    Entry::of(BodyQuantity::NormalForce, "normal_force", "normal force", "N", Both),
    Entry::of(BodyQuantity::FrictionForce, "friction_force", "friction force", "N", Both),
    Entry::of(BodyQuantity::Contacts, "contacts", "touching points", "1", Both),
];

/// Returns the names of the quantities of the world.
pub fn world_names() -> Vec<&'static str> {
    WORLD_QUANTITIES.iter().map(|entry| entry.description.name).collect()
}

/// Returns the names of the quantities of a body.
pub fn body_quantity_names() -> Vec<&'static str> {
    BODY_QUANTITIES.iter().map(|entry| entry.description.name).collect()
}

/// Returns the names of the quantities of a joint.
pub fn joint_quantity_names() -> Vec<&'static str> {
    JOINT_QUANTITIES.iter().map(|entry| entry.description.name).collect()
}
