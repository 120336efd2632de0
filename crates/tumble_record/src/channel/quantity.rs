//! The quantities that channels can show, with their names.

use crate::dim::Home;

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

/// What a channel says about a quantity.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry<Q> {
    /// The quantity.
    pub quantity: Q,
    /// Its name on the command line.
    pub name: &'static str,
    /// What it is, in words.
    pub title: &'static str,
    /// Its unit; `1` for counts.
    pub unit: &'static str,
    /// Where it is at home.
    pub home: Home,
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

/// Finds a quantity in its list.
pub(super) fn describe<Q: Copy + PartialEq>(list: &[Entry<Q>], quantity: Q) -> Description {
    let entry = list.iter().find(|entry| entry.quantity == quantity).expect("the lists have every quantity");
    Description { name: entry.name, title: entry.title, unit: entry.unit, home: entry.home }
}

/// Finds the quantity of a name in a list.
pub(super) fn named<Q: Copy>(list: &[Entry<Q>], name: &str) -> Option<Q> {
    list.iter().find(|entry| entry.name == name).map(|entry| entry.quantity)
}

/// What channels say about the quantities of a joint.
pub(super) const JOINT_QUANTITIES: [Entry<JointQuantity>; 5] = [
    Entry {
        quantity: JointQuantity::Force,
        name: "joint_force",
        title: "force of the joint",
        unit: "N",
        home: Home::Both,
    },
    Entry {
        quantity: JointQuantity::ForceX,
        name: "joint_force_x",
        title: "force of the joint along x",
        unit: "N",
        home: Home::Both,
    },
    Entry {
        quantity: JointQuantity::ForceY,
        name: "joint_force_y",
        title: "force of the joint along y",
        unit: "N",
        home: Home::Both,
    },
    Entry {
        quantity: JointQuantity::ForceZ,
        name: "joint_force_z",
        title: "force of the joint along z",
        unit: "N",
        home: Home::Space,
    },
    Entry {
        quantity: JointQuantity::Torque,
        name: "joint_torque",
        title: "torque of the joint",
        unit: "N·m",
        home: Home::Both,
    },
];

/// What channels say about the quantities of the world.
pub(super) const WORLD_QUANTITIES: [Entry<WorldQuantity>; 14] = [
    Entry { quantity: WorldQuantity::Kinetic, name: "kinetic", title: "kinetic energy", unit: "J", home: Home::Both },
    Entry {
        quantity: WorldQuantity::Potential,
        name: "potential",
        title: "potential energy",
        unit: "J",
        home: Home::Both,
    },
    Entry { quantity: WorldQuantity::Total, name: "total", title: "total energy", unit: "J", home: Home::Both },
    Entry {
        quantity: WorldQuantity::MomentumX,
        name: "momentum_x",
        title: "momentum along x",
        unit: "kg·m/s",
        home: Home::Both,
    },
    Entry {
        quantity: WorldQuantity::MomentumY,
        name: "momentum_y",
        title: "momentum along y",
        unit: "kg·m/s",
        home: Home::Both,
    },
    Entry {
        quantity: WorldQuantity::MomentumZ,
        name: "momentum_z",
        title: "momentum along z",
        unit: "kg·m/s",
        home: Home::Space,
    },
    Entry {
        quantity: WorldQuantity::AngularMomentum,
        name: "angular_momentum",
        title: "angular momentum about the origin",
        unit: "kg·m²/s",
        home: Home::Plane,
    },
    Entry {
        quantity: WorldQuantity::AngularMomentumX,
        name: "angular_momentum_x",
        title: "angular momentum about the x axis",
        unit: "kg·m²/s",
        home: Home::Space,
    },
    Entry {
        quantity: WorldQuantity::AngularMomentumY,
        name: "angular_momentum_y",
        title: "angular momentum about the y axis",
        unit: "kg·m²/s",
        home: Home::Space,
    },
    Entry {
        quantity: WorldQuantity::AngularMomentumZ,
        name: "angular_momentum_z",
        title: "angular momentum about the z axis",
        unit: "kg·m²/s",
        home: Home::Space,
    },
    Entry {
        quantity: WorldQuantity::DeepestOverlap,
        name: "deepest_overlap",
        title: "deepest overlap",
        unit: "m",
        home: Home::Both,
    },
    Entry {
        quantity: WorldQuantity::Contacts,
        name: "contacts",
        title: "touching points",
        unit: "1",
        home: Home::Both,
    },
    Entry {
        quantity: WorldQuantity::Iterations,
        name: "iterations",
        title: "solver iterations",
        unit: "1",
        home: Home::Both,
    },
    Entry {
        quantity: WorldQuantity::Residual,
        name: "residual",
        title: "solver residual",
        unit: "1",
        home: Home::Both,
    },
];

/// What channels say about the quantities of a body.
pub(super) const BODY_QUANTITIES: [Entry<BodyQuantity>; 16] = [
    Entry { quantity: BodyQuantity::X, name: "x", title: "x of the centre of mass", unit: "m", home: Home::Both },
    Entry { quantity: BodyQuantity::Y, name: "y", title: "y of the centre of mass", unit: "m", home: Home::Both },
    Entry { quantity: BodyQuantity::Z, name: "z", title: "z of the centre of mass", unit: "m", home: Home::Space },
    Entry { quantity: BodyQuantity::Angle, name: "angle", title: "angle", unit: "rad", home: Home::Plane },
    Entry { quantity: BodyQuantity::Vx, name: "vx", title: "velocity along x", unit: "m/s", home: Home::Both },
    Entry { quantity: BodyQuantity::Vy, name: "vy", title: "velocity along y", unit: "m/s", home: Home::Both },
    Entry { quantity: BodyQuantity::Vz, name: "vz", title: "velocity along z", unit: "m/s", home: Home::Space },
    Entry { quantity: BodyQuantity::Omega, name: "omega", title: "angular velocity", unit: "rad/s", home: Home::Plane },
    Entry {
        quantity: BodyQuantity::Wx,
        name: "wx",
        title: "angular velocity about x",
        unit: "rad/s",
        home: Home::Space,
    },
    Entry {
        quantity: BodyQuantity::Wy,
        name: "wy",
        title: "angular velocity about y",
        unit: "rad/s",
        home: Home::Space,
    },
    Entry {
        quantity: BodyQuantity::Wz,
        name: "wz",
        title: "angular velocity about z",
        unit: "rad/s",
        home: Home::Space,
    },
    Entry { quantity: BodyQuantity::Speed, name: "speed", title: "speed", unit: "m/s", home: Home::Both },
    Entry { quantity: BodyQuantity::Kinetic, name: "kinetic", title: "kinetic energy", unit: "J", home: Home::Both },
    Entry {
        quantity: BodyQuantity::NormalForce,
        name: "normal_force",
        title: "normal force",
        unit: "N",
        home: Home::Both,
    },
    Entry {
        quantity: BodyQuantity::FrictionForce,
        name: "friction_force",
        title: "friction force",
        unit: "N",
        home: Home::Both,
    },
    Entry { quantity: BodyQuantity::Contacts, name: "contacts", title: "touching points", unit: "1", home: Home::Both },
];

/// Returns the names of the quantities of the world.
pub fn world_names() -> Vec<&'static str> {
    WORLD_QUANTITIES.iter().map(|entry| entry.name).collect()
}

/// Returns the names of the quantities of a body.
pub fn body_quantity_names() -> Vec<&'static str> {
    BODY_QUANTITIES.iter().map(|entry| entry.name).collect()
}

/// Returns the names of the quantities of a joint.
pub fn joint_quantity_names() -> Vec<&'static str> {
    JOINT_QUANTITIES.iter().map(|entry| entry.name).collect()
}
