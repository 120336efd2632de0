//! Recordings of the plane.

use glam::{DQuat, DVec2, DVec3};
use serde::{Deserialize, Serialize};
use tumble_math::{Planar, PlanarRotation, trig};
use tumble_shape::PlanarShape;

use super::{Columns, Home, RecordDim, TurnAxis};
use crate::mesh::{Detail, Mesh};
use crate::recording::{BodyState, ContactRecord};

/// Outline of a shape of the plane, in the body frame [m].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Geometry {
    /// Straight rod with round ends; radius 0 is the thin rod.
    Rod {
        /// One end of the axis [m].
        from: DVec2,
        /// Other end of the axis [m].
        to: DVec2,
        /// Distance from the axis to the surface [m].
        radius: f64,
    },
    /// Filled circle.
    Disc {
        /// Centre [m].
        centre: DVec2,
        /// Radius [m].
        radius: f64,
    },
    /// Convex polygon.
    Polygon {
        /// Corners, counter-clockwise [m].
        points: Vec<DVec2>,
    },
    /// Everything on the far side of a line.
    HalfPlane {
        /// Any point of the surface [m].
        point: DVec2,
        /// Unit vector out of the solid [1].
        normal: DVec2,
    },
}

impl RecordDim for Planar {
    type Orientation = f64;
    type Tangent = f64;
    type Outline = Geometry;
    type Numbers = [f64; 6];

    const INFINITE_INERTIA: f64 = f64::INFINITY;
    const HOME: Home = Home::Plane;
    const COLUMNS: Columns = Columns {
        point: &["x", "y"],
        orientation: &["angle"],
        velocity: &["vx", "vy"],
        angular_velocity: &["omega"],
        normal: &["nx", "ny"],
        tangent_impulse: &["tangent_impulse"],
        momentum: &["momentum_x", "momentum_y"],
        angular_momentum: &["angular_momentum"],
        force: &["fx", "fy"],
        torque: &["torque"],
    };

    fn orientation(rotation: &PlanarRotation) -> f64 {
        rotation.angle()
    }

    fn rotation(angle: &f64) -> PlanarRotation {
        PlanarRotation::from_angle(*angle)
    }

    fn outline(shape: &PlanarShape) -> Geometry {
        match shape {
            PlanarShape::Rod(rod) => Geometry::Rod { from: rod.from(), to: rod.to(), radius: rod.radius() },
            PlanarShape::Disc(disc) => Geometry::Disc { centre: disc.centre(), radius: disc.radius() },
            PlanarShape::ConvexPolygon(polygon) => Geometry::Polygon { points: polygon.points().to_vec() },
            PlanarShape::HalfPlane(plane) => {
                Geometry::HalfPlane { point: plane.normal() * plane.offset(), normal: plane.normal() }
            }
        }
    }

    fn tangent_impulse(normal: DVec2, impulse_on_b: DVec2) -> f64 {
        impulse_on_b.dot(DVec2::new(normal.y, -normal.x))
    }

    fn tangent_vector(normal: DVec2, tangent_impulse: f64) -> DVec2 {
        DVec2::new(normal.y, -normal.x) * tangent_impulse
    }

    /// Positive along the pushing normal turned a quarter clockwise: changing sides turns the normal and the force alike.
    fn friction<'a>(contacts: impl Iterator<Item = (&'a ContactRecord, f64)>) -> f64 {
        contacts.map(|(contact, _)| contact.tangent_impulse).sum()
    }

    fn numbers(state: &BodyState) -> [f64; 6] {
        let BodyState { position, orientation, velocity, angular_velocity } = *state;
        [position.x, position.y, orientation, velocity.x, velocity.y, angular_velocity]
    }

    fn embed(vector: DVec2) -> DVec3 {
        vector.extend(0.0)
    }

    fn quaternion(angle: &f64) -> DQuat {
        let (sin, cos) = trig::sin_cos(0.5 * angle);
        DQuat::from_xyzw(0.0, 0.0, sin, cos)
    }

    fn mesh(outline: &Geometry, detail: &Detail) -> Mesh {
        Mesh::of_planar(outline, detail)
    }

    fn angle(angle: &f64) -> Option<f64> {
        Some(*angle)
    }

    fn about(angular: f64, axis: TurnAxis) -> Option<f64> {
        (axis == TurnAxis::Plane).then_some(angular)
    }
}
