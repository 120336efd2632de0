//! Channels: quantities of a recording over time, named on the command line as `NAME[:BODY]`.

use std::fmt;
use std::str::FromStr;

use crate::names::{did_you_mean, listed, nearest};
use crate::recording::{AuditRow, BodyKind, BodyRecord, BodyState, JointForce, JointRecord, Recording, Sample};

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
    /// Angular momentum about the origin [kg·m²/s].
    AngularMomentum,
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
    /// Centre of mass, horizontally [m].
    X,
    /// Centre of mass, vertically [m].
    Y,
    /// Angle, accumulated over turns [rad].
    Angle,
    /// Velocity along x [m/s].
    Vx,
    /// Velocity along y [m/s].
    Vy,
    /// Rate of turning [rad/s].
    Omega,
    /// Speed of the centre of mass [m/s].
    Speed,
    /// Kinetic energy ½ m v² + ½ I ω² [J].
    Kinetic,
    /// Sum of the normal forces of its contacts, each normal impulse of the step divided by dt [N].
    NormalForce,
    /// Sum of the friction forces on it, each tangent impulse of the step divided by dt [N].
    ///
    /// Positive along the pushing normal turned a quarter clockwise: to the right, for a body that stands on a floor.
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
    /// Its torque on its second body about the anchor [N·m].
    Torque,
}

/// Name, title and unit of the quantities of a joint.
const JOINT_QUANTITIES: [(JointQuantity, &str, &str, &str); 4] = [
    (JointQuantity::Force, "joint_force", "force of the joint", "N"),
    (JointQuantity::ForceX, "joint_force_x", "force of the joint along x", "N"),
    (JointQuantity::ForceY, "joint_force_y", "force of the joint along y", "N"),
    (JointQuantity::Torque, "joint_torque", "torque of the joint", "N·m"),
];

/// Name, title and unit of the quantities of the world.
const WORLD_QUANTITIES: [(WorldQuantity, &str, &str, &str); 10] = [
    (WorldQuantity::Kinetic, "kinetic", "kinetic energy", "J"),
    (WorldQuantity::Potential, "potential", "potential energy", "J"),
    (WorldQuantity::Total, "total", "total energy", "J"),
    (WorldQuantity::MomentumX, "momentum_x", "momentum along x", "kg·m/s"),
    (WorldQuantity::MomentumY, "momentum_y", "momentum along y", "kg·m/s"),
    (WorldQuantity::AngularMomentum, "angular_momentum", "angular momentum about the origin", "kg·m²/s"),
    (WorldQuantity::DeepestOverlap, "deepest_overlap", "deepest overlap", "m"),
    (WorldQuantity::Contacts, "contacts", "touching points", "1"),
    (WorldQuantity::Iterations, "iterations", "solver iterations", "1"),
    (WorldQuantity::Residual, "residual", "solver residual", "1"),
];

/// Name, title and unit of the quantities of a body.
const BODY_QUANTITIES: [(BodyQuantity, &str, &str, &str); 11] = [
    (BodyQuantity::X, "x", "x of the centre of mass", "m"),
    (BodyQuantity::Y, "y", "y of the centre of mass", "m"),
    (BodyQuantity::Angle, "angle", "angle", "rad"),
    (BodyQuantity::Vx, "vx", "velocity along x", "m/s"),
    (BodyQuantity::Vy, "vy", "velocity along y", "m/s"),
    (BodyQuantity::Omega, "omega", "angular velocity", "rad/s"),
    (BodyQuantity::Speed, "speed", "speed", "m/s"),
    (BodyQuantity::Kinetic, "kinetic", "kinetic energy", "J"),
    (BodyQuantity::NormalForce, "normal_force", "normal force", "N"),
    (BodyQuantity::FrictionForce, "friction_force", "friction force", "N"),
    (BodyQuantity::Contacts, "contacts", "touching points", "1"),
];

/// A quantity asked for: `total` energy of the world, `y:ball` of a body, `y` of every moving body, `joint_force:pin` of a joint.
///
/// ```
/// use tumble_record::Channel;
/// let height: Channel = "y:ball".parse()?;
/// assert_eq!(height.to_string(), "y:ball");
/// assert!("hight:ball".parse::<Channel>().is_err());
/// # Ok::<(), tumble_record::ChannelError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Channel {
    /// Of the world.
    World(WorldQuantity),
    /// Of one body.
    Body(BodyQuantity, String),
    /// Of every moving body, one curve each.
    EveryBody(BodyQuantity),
    /// Of one joint.
    Joint(JointQuantity, String),
    /// Of every joint, one curve each.
    EveryJoint(JointQuantity),
}

/// Most bodies whose curves share one plot; more could not be told apart.
pub const MOST_CURVES: usize = 12;

/// Values over time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// What the curve is called in a legend.
    pub label: String,
    /// Times, ascending [s].
    pub times: Vec<f64>,
    /// A value for each time.
    pub values: Vec<f64>,
}

/// A channel that does not exist, in words that lead to one that does.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ChannelError {
    /// No quantity has this name.
    #[error("unknown channel `{name}`{}; of the world: {}; of a body (NAME:BODY): {}; of a joint (NAME:JOINT): {}", did_you_mean(.suggestion), world_names().join(", "), body_quantity_names().join(", "), joint_quantity_names().join(", "))]
    UnknownName {
        /// The name that was given.
        name: String,
        /// The nearest name that exists.
        suggestion: Option<String>,
    },
    /// The quantity belongs to the world, not to a body.
    #[error("channel `{name}` is of the whole world: leave out `:{body}`; of a body (NAME:BODY): {}", body_quantity_names().join(", "))]
    NotOfABody {
        /// The name that was given.
        name: String,
        /// The body that was given.
        body: String,
    },
    /// No body has this name.
    #[error("channel `{channel}`: there is no body `{body}`{}; bodies: {}", did_you_mean(.suggestion), listed(.bodies))]
    UnknownBody {
        /// The channel that was given.
        channel: String,
        /// The body that was given.
        body: String,
        /// The nearest name that exists.
        suggestion: Option<String>,
        /// Names of all bodies.
        bodies: Vec<String>,
    },
    /// No joint has this name.
    #[error("channel `{channel}`: there is no joint `{joint}`{}; joints: {}", did_you_mean(.suggestion), listed(.joints))]
    UnknownJoint {
        /// The channel that was given.
        channel: String,
        /// The joint that was given.
        joint: String,
        /// The nearest name that exists.
        suggestion: Option<String>,
        /// Names of all joints.
        joints: Vec<String>,
    },
    /// No joints, or more than curves that can be told apart.
    #[error("channel `{channel}` would show {} joints, 1 to {MOST_CURVES} fit: name one as `{channel}:JOINT`; joints: {}", .joints.len(), listed(.joints))]
    NotSoManyJoints {
        /// The channel that was given.
        channel: String,
        /// Names of the joints.
        joints: Vec<String>,
    },
    /// More moving bodies than curves that can be told apart.
    #[error("channel `{channel}` would show {} bodies, at most {MOST_CURVES} fit: name one as `{channel}:BODY`; bodies: {}", .bodies.len(), listed(.bodies))]
    TooManyBodies {
        /// The channel that was given.
        channel: String,
        /// Names of the moving bodies.
        bodies: Vec<String>,
    },
}

impl FromStr for Channel {
    type Err = ChannelError;

    /// Reads `NAME[:BODY]` or `NAME[:JOINT]`; whether the body or joint exists is asked by [`Channel::check`].
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (name, body) = match text.split_once(':') {
            Some((name, body)) => (name, Some(body)),
            None => (text, None),
        };
        if let Some(&(quantity, ..)) = JOINT_QUANTITIES.iter().find(|quantity| quantity.1 == name) {
            return Ok(body.map_or(Self::EveryJoint(quantity), |joint| Self::Joint(quantity, joint.to_owned())));
        }
        let of_body = BODY_QUANTITIES.iter().find(|quantity| quantity.1 == name).map(|quantity| quantity.0);
        let of_world = WORLD_QUANTITIES.iter().find(|quantity| quantity.1 == name).map(|quantity| quantity.0);
        match (of_world, of_body, body) {
            (_, Some(quantity), Some(body)) => Ok(Self::Body(quantity, body.to_owned())),
            (Some(quantity), _, None) => Ok(Self::World(quantity)),
            (None, Some(quantity), None) => Ok(Self::EveryBody(quantity)),
            (Some(_), None, Some(body)) => {
                Err(ChannelError::NotOfABody { name: name.to_owned(), body: body.to_owned() })
            }
            (None, None, _) => {
                let names = world_names().into_iter().chain(body_quantity_names()).chain(joint_quantity_names());
                Err(ChannelError::UnknownName { name: name.to_owned(), suggestion: nearest(name, names) })
            }
        }
    }
}

impl fmt::Display for Channel {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Body(_, name) | Self::Joint(_, name) => write!(formatter, "{}:{name}", self.name()),
            Self::World(_) | Self::EveryBody(_) | Self::EveryJoint(_) => formatter.write_str(self.name()),
        }
    }
}

impl Channel {
    /// Returns the name without the body, as on the command line.
    pub fn name(&self) -> &'static str {
        self.description().0
    }

    /// Returns what the quantity is, in words, with the name of the body.
    pub fn title(&self) -> String {
        let title = self.description().1;
        match self {
            Self::Body(_, name) | Self::Joint(_, name) => format!("{name}: {title}"),
            Self::World(_) | Self::EveryBody(_) | Self::EveryJoint(_) => title.to_owned(),
        }
    }

    /// Returns the unit (`m/s`); `1` for counts.
    pub fn unit(&self) -> &'static str {
        self.description().2
    }

    /// Returns a file name for the plot, without extension: `y-ball`.
    ///
    /// Characters that a file name cannot safely have become `_`, followed by a hash of the name, so that two bodies never share a file.
    pub fn file_stem(&self) -> String {
        let (Self::Body(_, body) | Self::Joint(_, body)) = self else { return self.name().to_owned() };
        let is_safe = |letter: char| letter.is_ascii_alphanumeric() || "._-".contains(letter);
        let safe: String = body.chars().take(100).map(|letter| if is_safe(letter) { letter } else { '_' }).collect();
        if safe == *body {
            return format!("{}-{body}", self.name());
        }
        let hash = xxhash_rust::xxh3::xxh3_64(body.as_bytes());
        format!("{}-{safe}-{:08x}", self.name(), hash >> 32)
    }

    /// Checks that the bodies or joints asked for exist and are not too many.
    pub fn check(&self, recording: &Recording) -> Result<(), ChannelError> {
        self.bodies(&recording.bodies)?;
        self.joints(&recording.joints).map(|_| ())
    }

    /// Returns the curves: one for the world or a body, one for each moving body if none was named.
    pub fn series(&self, recording: &Recording) -> Result<Vec<Series>, ChannelError> {
        let bodies = self.bodies(&recording.bodies)?;
        Ok(match self {
            Self::World(quantity) => vec![world_series(recording, *quantity)],
            Self::Body(quantity, _) | Self::EveryBody(quantity) => {
                bodies.into_iter().map(|body| body_series(recording, *quantity, body)).collect()
            }
            Self::Joint(quantity, _) | Self::EveryJoint(quantity) => {
                let joints = self.joints(&recording.joints)?.into_iter();
                joints.map(|joint| joint_series(recording, *quantity, joint)).collect()
            }
        })
    }

    /// Returns the indices of the bodies asked for.
    fn bodies(&self, bodies: &[BodyRecord]) -> Result<Vec<usize>, ChannelError> {
        let names = |indices: &[usize]| indices.iter().map(|&index| bodies[index].name.clone()).collect::<Vec<_>>();
        match self {
            Self::World(_) | Self::Joint(..) | Self::EveryJoint(_) => Ok(Vec::new()),
            Self::Body(_, name) => match bodies.iter().position(|body| body.name == *name) {
                Some(index) => Ok(vec![index]),
                None => Err(ChannelError::UnknownBody {
                    channel: self.to_string(),
                    body: name.clone(),
                    suggestion: nearest(name, bodies.iter().map(|body| body.name.as_str())),
                    bodies: bodies.iter().map(|body| body.name.clone()).collect(),
                }),
            },
            Self::EveryBody(_) => {
                let moving: Vec<usize> =
                    (0..bodies.len()).filter(|&index| bodies[index].kind != BodyKind::Static).collect();
                if moving.len() > MOST_CURVES {
                    return Err(ChannelError::TooManyBodies { channel: self.to_string(), bodies: names(&moving) });
                }
                Ok(moving)
            }
        }
    }

    /// Returns the indices of the joints asked for.
    fn joints(&self, joints: &[JointRecord]) -> Result<Vec<usize>, ChannelError> {
        let names = || joints.iter().map(|joint| joint.name.clone()).collect::<Vec<_>>();
        match self {
            Self::Joint(_, name) => match joints.iter().position(|joint| joint.name == *name) {
                Some(index) => Ok(vec![index]),
                None => Err(ChannelError::UnknownJoint {
                    channel: self.to_string(),
                    joint: name.clone(),
                    suggestion: nearest(name, joints.iter().map(|joint| joint.name.as_str())),
                    joints: names(),
                }),
            },
            Self::EveryJoint(_) if !(1..=MOST_CURVES).contains(&joints.len()) => {
                Err(ChannelError::NotSoManyJoints { channel: self.to_string(), joints: names() })
            }
            Self::EveryJoint(_) => Ok((0..joints.len()).collect()),
            Self::World(_) | Self::Body(..) | Self::EveryBody(_) => Ok(Vec::new()),
        }
    }

    /// Returns name, title and unit.
    fn description(&self) -> (&'static str, &'static str, &'static str) {
        let found = match self {
            Self::World(quantity) => WORLD_QUANTITIES
                .iter()
                .find(|(listed, ..)| listed == quantity)
                .map(|(_, name, title, unit)| (*name, *title, *unit)),
            Self::Body(quantity, _) | Self::EveryBody(quantity) => BODY_QUANTITIES
                .iter()
                .find(|(listed, ..)| listed == quantity)
                .map(|(_, name, title, unit)| (*name, *title, *unit)),
            Self::Joint(quantity, _) | Self::EveryJoint(quantity) => JOINT_QUANTITIES
                .iter()
                .find(|(listed, ..)| listed == quantity)
                .map(|(_, name, title, unit)| (*name, *title, *unit)),
        };
        found.expect("the tables list every quantity")
    }
}

/// Returns the names of the quantities of the world.
pub fn world_names() -> Vec<&'static str> {
    WORLD_QUANTITIES.iter().map(|(_, name, ..)| *name).collect()
}

/// Returns the names of the quantities of a body.
pub fn body_quantity_names() -> Vec<&'static str> {
    BODY_QUANTITIES.iter().map(|(_, name, ..)| *name).collect()
}

/// Returns the names of the quantities of a joint.
pub fn joint_quantity_names() -> Vec<&'static str> {
    JOINT_QUANTITIES.iter().map(|(_, name, ..)| *name).collect()
}

/// Reads a quantity off the audit; steps in which nothing was solved have no iterations and no residual.
pub(crate) fn world_series(recording: &Recording, quantity: WorldQuantity) -> Series {
    let value = |row: &AuditRow| match quantity {
        WorldQuantity::Kinetic => Some(row.kinetic),
        WorldQuantity::Potential => Some(row.potential),
        WorldQuantity::Total => Some(row.total),
        WorldQuantity::MomentumX => Some(row.momentum.x),
        WorldQuantity::MomentumY => Some(row.momentum.y),
        WorldQuantity::AngularMomentum => Some(row.angular_momentum),
        WorldQuantity::DeepestOverlap => Some(row.deepest_overlap),
        WorldQuantity::Contacts => Some(row.contacts as f64),
        WorldQuantity::Iterations => row.iterations.map(|count| count as f64),
        WorldQuantity::Residual => row.residual,
    };
    let (times, values) = recording.audit.iter().filter_map(|row| Some((row.time, value(row)?))).unzip();
    Series { label: Channel::World(quantity).title(), times, values }
}

/// Reads a quantity of a body off the samples.
fn body_series(recording: &Recording, quantity: BodyQuantity, body: usize) -> Series {
    let record = &recording.bodies[body];
    let (times, values) = recording
        .states(body)
        .map(|(sample, state)| (sample.time, body_value(quantity, recording.dt, record, body, sample, state)))
        .unzip();
    Series { label: record.name.clone(), times, values }
}

/// Reads a quantity of a joint off the samples, but the start, when no step has acted yet.
fn joint_series(recording: &Recording, quantity: JointQuantity, joint: usize) -> Series {
    let value = |given: &JointForce| match quantity {
        JointQuantity::Force => given.force.length(),
        JointQuantity::ForceX => given.force.x,
        JointQuantity::ForceY => given.force.y,
        JointQuantity::Torque => given.torque,
    };
    let samples = recording.samples.iter().filter(|sample| sample.step > 0);
    let given =
        samples.filter_map(|sample| Some((sample.time, sample.joints.iter().find(|given| given.joint == joint)?)));
    let (times, values) = given.map(|(time, given)| (time, value(given))).unzip();
    Series { label: recording.joints[joint].name.clone(), times, values }
}

/// Returns the value of a quantity of a body in one sample.
fn body_value(
    quantity: BodyQuantity,
    dt: f64,
    record: &BodyRecord,
    body: usize,
    sample: &Sample,
    state: &BodyState,
) -> f64 {
    let contacts = || sample.contacts.iter().filter(|contact| contact.a == body || contact.b == body);
    match quantity {
        BodyQuantity::X => state.position.x,
        BodyQuantity::Y => state.position.y,
        BodyQuantity::Angle => state.angle,
        BodyQuantity::Vx => state.velocity.x,
        BodyQuantity::Vy => state.velocity.y,
        BodyQuantity::Omega => state.angular_velocity,
        BodyQuantity::Speed => state.velocity.length(),
        BodyQuantity::Kinetic if record.kind != BodyKind::Dynamic => 0.0,
        BodyQuantity::Kinetic => {
            let moving = half_product(record.mass, state.velocity.length_squared());
            moving + half_product(record.inertia, state.angular_velocity * state.angular_velocity)
        }
        BodyQuantity::NormalForce => contacts().map(|contact| contact.normal_impulse / dt).sum(),
        BodyQuantity::FrictionForce => contacts().map(|contact| contact.tangent_impulse / dt).sum(),
        BodyQuantity::Contacts => contacts().count() as f64,
    }
}

/// Returns ½ m v²; an infinite mass that does not move has no energy.
fn half_product(mass: f64, squared_speed: f64) -> f64 {
    if squared_speed == 0.0 { 0.0 } else { 0.5 * mass * squared_speed }
}
