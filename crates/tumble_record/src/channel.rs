//! Channels: quantities of a recording over time, named on the command line as `NAME[:BODY]`.

mod quantity;
mod values;

use std::fmt;
use std::str::FromStr;

use crate::dim::{Home, RecordDim};
use crate::names::{did_you_mean, listed, nearest};
use crate::recording::{BodyKind, BodyRecord, JointRecord, Recording};

pub use quantity::{
    BodyQuantity, JointQuantity, WorldQuantity, body_quantity_names, joint_quantity_names, world_names,
};
pub(crate) use values::world_series;

use quantity::{BODY_QUANTITIES, Description, JOINT_QUANTITIES, WORLD_QUANTITIES, describe, named};
use values::{body_series, joint_series};

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
    /// The quantity exists only in the other dimension.
    #[error("channel `{channel}` is of {home}, this scene is of {scene}")]
    NotHere {
        /// The channel that was given.
        channel: String,
        /// Where the quantity is at home.
        home: &'static str,
        /// Where the scene is.
        scene: &'static str,
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
        if let Some(quantity) = named(&JOINT_QUANTITIES, name) {
            return Ok(body.map_or(Self::EveryJoint(quantity), |joint| Self::Joint(quantity, joint.to_owned())));
        }
        let (of_body, of_world) = (named(&BODY_QUANTITIES, name), named(&WORLD_QUANTITIES, name));
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
        self.description().name
    }

    /// Returns what the quantity is, in words, with the name of the body.
    pub fn title(&self) -> String {
        let title = self.description().title;
        match self {
            Self::Body(_, name) | Self::Joint(_, name) => format!("{name}: {title}"),
            Self::World(_) | Self::EveryBody(_) | Self::EveryJoint(_) => title.to_owned(),
        }
    }

    /// Returns the unit (`m/s`); `1` for counts.
    pub fn unit(&self) -> &'static str {
        self.description().unit
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

    /// Checks that the dimension has the quantity, and that the bodies or joints asked for exist and are not too many.
    pub fn check<D: RecordDim>(&self, recording: &Recording<D>) -> Result<(), ChannelError> {
        let home = self.description().home;
        if home != Home::Both && home != D::HOME {
            return Err(ChannelError::NotHere { channel: self.to_string(), home: home.word(), scene: D::HOME.word() });
        }
        self.bodies(&recording.bodies)?;
        self.joints(&recording.joints).map(|_| ())
    }

    /// Returns the curves: one for the world or a body, one for each moving body if none was named.
    pub fn series<D: RecordDim>(&self, recording: &Recording<D>) -> Result<Vec<Series>, ChannelError> {
        self.check(recording)?;
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
    fn bodies<D: RecordDim>(&self, bodies: &[BodyRecord<D>]) -> Result<Vec<usize>, ChannelError> {
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
    fn joints<D: RecordDim>(&self, joints: &[JointRecord<D>]) -> Result<Vec<usize>, ChannelError> {
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

    /// Returns what the lists say about the quantity.
    fn description(&self) -> Description {
        match self {
            Self::World(quantity) => describe(&WORLD_QUANTITIES, *quantity),
            Self::Body(quantity, _) | Self::EveryBody(quantity) => describe(&BODY_QUANTITIES, *quantity),
            Self::Joint(quantity, _) | Self::EveryJoint(quantity) => describe(&JOINT_QUANTITIES, *quantity),
        }
    }
}
