//! How bodies and boxes of space are turned, and their inertia.

use glam::{DQuat, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tumble_math::{Rotation, SpatialRotation, SymmetricTensor, Vector};

/// How something is turned, from its own axes to those around it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum OrientationEntry {
    /// A turn about an axis.
    Turn(Turn),
    /// Several turns one after the other, each about an axis that does not turn along.
    Turns(Vec<Turn>),
    /// The quaternion (x, y, z, w) of any length but zero; w is the cosine of half the angle of a unit one.
    Quaternion(f64, f64, f64, f64),
}

impl OrientationEntry {
    /// The rotation; `None` if an axis or the quaternion has no direction.
    pub fn rotation(&self) -> Option<SpatialRotation> {
        match self {
            Self::Turn(turn) => SpatialRotation::IDENTITY.then(turn),
            Self::Turns(turns) => turns.iter().try_fold(SpatialRotation::IDENTITY, |sum, turn| sum.then(turn)),
            Self::Quaternion(x, y, z, w) => SpatialRotation::try_from_quaternion(DQuat::from_xyzw(*x, *y, *z, *w)),
        }
    }
}

/// Turning by what a scene writes.
trait Then: Sized {
    /// This rotation and then a turn about an axis that stays; `None` if that has no direction.
    fn then(self, turn: &Turn) -> Option<Self>;
}

impl Then for SpatialRotation {
    fn then(self, turn: &Turn) -> Option<Self> {
        let axis = Vector::try_normalize(turn.axis)?;
        Some(self.turned(axis * turn.angle_degrees.to_radians()))
    }
}

/// A turn about an axis, by the right-hand rule.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Turn {
    /// Direction of the axis, of any length but zero [1].
    #[schemars(with = "(f64, f64, f64)")]
    pub axis: DVec3,
    /// By how much [degrees].
    pub angle_degrees: f64,
}

/// Inertia about the centre of mass, along the axes of the design frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum InertiaEntry {
    /// Moments about x, y and z, which are principal axes [kg·m²].
    Diagonal(f64, f64, f64),
    /// All entries of the symmetric tensor.
    Tensor(TensorEntry),
}

impl From<InertiaEntry> for SymmetricTensor {
    fn from(entry: InertiaEntry) -> Self {
        match entry {
            InertiaEntry::Diagonal(xx, yy, zz) => Self::from_diagonal(DVec3::new(xx, yy, zz)),
            InertiaEntry::Tensor(TensorEntry { xx, yy, zz, xy, xz, yz }) => {
                Self { diagonal: DVec3::new(xx, yy, zz), off_diagonal: DVec3::new(yz, xz, xy) }
            }
        }
    }
}

impl From<SymmetricTensor> for InertiaEntry {
    fn from(tensor: SymmetricTensor) -> Self {
        let (d, o) = (tensor.diagonal, tensor.off_diagonal);
        if o == DVec3::ZERO {
            return Self::Diagonal(d.x, d.y, d.z);
        }
        Self::Tensor(TensorEntry { xx: d.x, yy: d.y, zz: d.z, xy: o.z, xz: o.y, yz: o.x })
    }
}

/// Entries of a symmetric tensor of inertia: I = ∫ (|r|² 1 − r rᵀ) dm.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TensorEntry {
    /// Moment about x: ∫ (y² + z²) dm [kg·m²].
    pub xx: f64,
    /// Moment about y: ∫ (z² + x²) dm [kg·m²].
    pub yy: f64,
    /// Moment about z: ∫ (x² + y²) dm [kg·m²].
    pub zz: f64,
    /// Entry of x and y, −∫ x y dm [kg·m²]. Default 0.
    #[serde(default)]
    pub xy: f64,
    /// Entry of x and z, −∫ x z dm [kg·m²]. Default 0.
    #[serde(default)]
    pub xz: f64,
    /// Entry of y and z, −∫ y z dm [kg·m²]. Default 0.
    #[serde(default)]
    pub yz: f64,
}
