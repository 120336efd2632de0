//! Shapes of space.

use std::f64::consts::PI;

use glam::{DVec3, dvec3};
use tumble_math::{Bounds, Pose, Spatial};

use crate::judge::spatial::{Core, separation};
use crate::plan::PlanDim;

/// A shape of space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpatialShape {
    /// A box.
    Box {
        /// Half of its sides [m].
        half_extents: DVec3,
    },
    /// A ball.
    Sphere {
        /// Its radius [m].
        radius: f64,
    },
    /// All that is nearer than a radius to a line along y.
    Capsule {
        /// Half the length of the line [m].
        half_length: f64,
        /// The radius [m].
        radius: f64,
    },
    /// The regular body of twenty triangles.
    Icosahedron {
        /// Radius of the sphere through its corners [m].
        radius: f64,
    },
}

/// Corners of a regular icosahedron on a sphere of a radius: cyclic permutations of (0, ±1, ±φ), scaled [m].
pub fn icosahedron(radius: f64) -> [DVec3; 12] {
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let long = radius * golden / (1.0 + golden * golden).sqrt();
    let short = long / golden;
    let mut corners = [DVec3::ZERO; 12];
    for (i, signs) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)].into_iter().enumerate() {
        let (a, b) = (signs.0 * short, signs.1 * long);
        corners[3 * i] = dvec3(0.0, a, b);
        corners[3 * i + 1] = dvec3(a, b, 0.0);
        corners[3 * i + 2] = dvec3(b, 0.0, a);
    }
    corners
}

impl SpatialShape {
    /// A box with half its sides [m].
    pub fn block(x: f64, y: f64, z: f64) -> Self {
        Self::Box { half_extents: dvec3(x, y, z) }
    }

    /// Volume [m³].
    pub fn volume(&self) -> f64 {
        match *self {
            Self::Box { half_extents } => 8.0 * half_extents.x * half_extents.y * half_extents.z,
            Self::Sphere { radius } => 4.0 / 3.0 * PI * radius * radius * radius,
            Self::Capsule { half_length, radius } => PI * radius * radius * (2.0 * half_length + 4.0 / 3.0 * radius),
            Self::Icosahedron { radius } => {
                // 5 (3 + √5) a³/12, where the edge a is 4 R / √(10 + 2 √5).
                let edge = 4.0 * radius / (10.0 + 2.0 * 5.0_f64.sqrt()).sqrt();
                5.0 * (3.0 + 5.0_f64.sqrt()) * edge * edge * edge / 12.0
            }
        }
    }
}

impl PlanDim for Spatial {
    type Shape = SpatialShape;
    type Core = Core;

    fn measure(shape: &SpatialShape) -> f64 {
        shape.volume()
    }

    fn core(shape: &SpatialShape, place: impl Fn(DVec3) -> DVec3) -> Core {
        match *shape {
            SpatialShape::Box { half_extents } => Core::block(half_extents, place),
            SpatialShape::Sphere { radius } => Core::round(place(DVec3::ZERO), place(DVec3::ZERO), radius),
            SpatialShape::Capsule { half_length, radius } => {
                Core::round(place(dvec3(0.0, -half_length, 0.0)), place(dvec3(0.0, half_length, 0.0)), radius)
            }
            SpatialShape::Icosahedron { radius } => Core::icosahedron(radius, place),
        }
    }

    fn bounds(core: &Core) -> Bounds<DVec3> {
        core.bounds()
    }

    fn separation(a: &Core, b: &Core) -> f64 {
        separation(a, b)
    }

    fn write_numbers(pose: &Pose<Self>, velocity: DVec3, spin: DVec3, numbers: &mut Vec<f64>) {
        numbers.extend(pose.position.to_array());
        numbers.extend(pose.rotation.quaternion().to_array());
        numbers.extend(velocity.to_array());
        numbers.extend(spin.to_array());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn icosahedron_has_the_volume_of_its_twenty_pyramids() {
        let corners = icosahedron(0.5);
        let edge = corners[1..].iter().map(|corner| corner.distance(corners[0])).fold(f64::INFINITY, f64::min);
        let near = |i: usize, k: usize| corners[i].distance(corners[k]) < 1.01 * edge;
        let (mut faces, mut volume) = (0, 0.0);
        for i in 0..12 {
            for j in 0..i {
                for k in 0..j {
                    if near(i, j) && near(j, k) && near(i, k) {
                        faces += 1;
                        volume += corners[i].dot(corners[j].cross(corners[k])).abs() / 6.0;
                    }
                }
            }
        }
        assert_eq!(faces, 20);
        // Rounding of some dozens of operations.
        assert!((volume - SpatialShape::Icosahedron { radius: 0.5 }.volume()).abs() < 1e-14);
    }
}
