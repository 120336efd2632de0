//! Recordings of space.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};
use tumble_math::{Spatial, SpatialRotation, SymmetricTensor};
use tumble_shape::{ConvexHull, SpatialShape};

use super::{Columns, Home, RecordDim, TurnAxis};
use crate::mesh::{Detail, Mesh};
use crate::recording::{BodyState, ContactRecord};

/// Outline of a shape of space, in the body frame [m].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum SpatialGeometry {
    /// Filled ball.
    Sphere {
        /// Centre [m].
        centre: DVec3,
        /// Radius [m].
        radius: f64,
    },
    /// Straight line with round ends and sides: a capsule, or a rod; radius 0 is the thin rod.
    Rod {
        /// One end of the axis [m].
        from: DVec3,
        /// Other end of the axis [m].
        to: DVec3,
        /// Distance from the axis to the surface [m].
        radius: f64,
    },
    /// Polyhedron without inward corners: a box, a hull.
    Polyhedron {
        /// Corners [m].
        points: Vec<DVec3>,
        /// Corners of each face by their place in `points`, counter-clockwise seen from outside.
        faces: Vec<Vec<u32>>,
    },
    /// Round cylinder with flat ends.
    Cylinder {
        /// Centre of one end [m].
        from: DVec3,
        /// Centre of the other end [m].
        to: DVec3,
        /// Radius [m].
        radius: f64,
    },
    /// Cone with a flat round base.
    Cone {
        /// Centre of the base [m].
        base: DVec3,
        /// Tip [m].
        tip: DVec3,
        /// Radius of the base [m].
        radius: f64,
    },
    /// Everything on the far side of a plane.
    HalfSpace {
        /// Any point of the surface [m].
        point: DVec3,
        /// Unit vector out of the solid [1].
        normal: DVec3,
    },
    /// Triangle of ground.
    Triangle {
        /// Corners, counter-clockwise seen from above the ground [m].
        points: [DVec3; 3],
    },
}

impl RecordDim for Spatial {
    type Orientation = DQuat;
    type Tangent = DVec3;
    type Outline = SpatialGeometry;
    type Numbers = [f64; 13];

    const INFINITE_INERTIA: SymmetricTensor = SymmetricTensor::from_diagonal(DVec3::INFINITY);
    const HOME: Home = Home::Space;
    const COLUMNS: Columns = Columns {
        point: &["x", "y", "z"],
        orientation: &["qx", "qy", "qz", "qw"],
        velocity: &["vx", "vy", "vz"],
        angular_velocity: &["wx", "wy", "wz"],
        normal: &["nx", "ny", "nz"],
        tangent_impulse: &["tx", "ty", "tz"],
        momentum: &["momentum_x", "momentum_y", "momentum_z"],
        angular_momentum: &["angular_momentum_x", "angular_momentum_y", "angular_momentum_z"],
        force: &["fx", "fy", "fz"],
        torque: &["torque_x", "torque_y", "torque_z"],
    };

    fn orientation(rotation: &SpatialRotation) -> DQuat {
        rotation.quaternion()
    }

    fn rotation(quaternion: &DQuat) -> SpatialRotation {
        SpatialRotation::try_from_quaternion(*quaternion).unwrap_or_default()
    }

    fn outline(shape: &SpatialShape) -> SpatialGeometry {
        let rod = |ends: &[DVec3; 2], radius| SpatialGeometry::Rod { from: ends[0], to: ends[1], radius };
        match shape {
            SpatialShape::Sphere(sphere) => {
                SpatialGeometry::Sphere { centre: sphere.centre(), radius: sphere.radius() }
            }
            SpatialShape::SpatialRod(line) => rod(line.ends(), line.radius()),
            SpatialShape::Capsule(capsule) => rod(capsule.ends(), capsule.radius()),
            SpatialShape::Cuboid(cuboid) => polyhedron(cuboid.hull()),
            SpatialShape::ConvexHull(hull) => polyhedron(hull),
            SpatialShape::Cylinder(cylinder) => {
                let [from, to] = *cylinder.ends();
                SpatialGeometry::Cylinder { from, to, radius: cylinder.radius() }
            }
            SpatialShape::Cone(cone) => {
                SpatialGeometry::Cone { base: cone.base(), tip: cone.tip(), radius: cone.radius() }
            }
            SpatialShape::HalfSpace(half_space) => {
                let normal = half_space.normal();
                SpatialGeometry::HalfSpace { point: normal * half_space.offset(), normal }
            }
            SpatialShape::Facet(facet) => {
                let prism = facet.prism();
                let sides = prism.sides(&prism.faces()[0]);
                let corner = |side: usize| prism.vertices()[sides[side].vertex as usize];
                SpatialGeometry::Triangle { points: [corner(0), corner(1), corner(2)] }
            }
        }
    }

    fn tangent_impulse(normal: DVec3, impulse_on_b: DVec3) -> DVec3 {
        impulse_on_b - normal * impulse_on_b.dot(normal)
    }

    fn tangent_vector(_normal: DVec3, tangent_impulse: DVec3) -> DVec3 {
        tangent_impulse
    }

    /// Magnitude of the sum.
    fn friction<'a>(contacts: impl Iterator<Item = (&'a ContactRecord<Self>, f64)>) -> f64 {
        contacts.fold(DVec3::ZERO, |sum, (contact, sign)| sum + contact.tangent_impulse * sign).length()
    }

    fn numbers(state: &BodyState<Self>) -> [f64; 13] {
        let BodyState { position: x, orientation: q, velocity: v, angular_velocity: w } = *state;
        [x.x, x.y, x.z, q.x, q.y, q.z, q.w, v.x, v.y, v.z, w.x, w.y, w.z]
    }

    fn embed(vector: DVec3) -> DVec3 {
        vector
    }

    fn quaternion(quaternion: &DQuat) -> DQuat {
        *quaternion
    }

    fn mesh(outline: &SpatialGeometry, detail: &Detail) -> Mesh {
        Mesh::of_spatial(outline, detail)
    }

    fn angle(_quaternion: &DQuat) -> Option<f64> {
        None
    }

    fn about(angular: DVec3, axis: TurnAxis) -> Option<f64> {
        match axis {
            TurnAxis::Plane => None,
            TurnAxis::X => Some(angular.x),
            TurnAxis::Y => Some(angular.y),
            TurnAxis::Z => Some(angular.z),
        }
    }
}

fn polyhedron(hull: &ConvexHull) -> SpatialGeometry {
    let faces = hull.faces().iter().map(|face| hull.sides(face).iter().map(|side| side.vertex).collect());
    SpatialGeometry::Polyhedron { points: hull.vertices().to_vec(), faces: faces.collect() }
}
