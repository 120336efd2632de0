//! Shapes of the plane.

use std::f64::consts::PI;

use glam::{DVec2, dvec2};
use tumble_math::{Bounds, Planar, Pose};

use crate::judge::planar::{Core, separation};
use crate::plan::{Body, PlanDim};

/// A shape of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlanarShape {
    /// A box.
    Box {
        /// Half of its width and height [m].
        half_extents: DVec2,
    },
    /// A disc.
    Disc {
        /// Its radius [m].
        radius: f64,
    },
    /// All that is nearer than a radius to a line along x.
    Capsule {
        /// Half the length of the line [m].
        half_length: f64,
        /// The radius [m].
        radius: f64,
    },
}

impl PlanarShape {
    /// A box with half its width and height [m].
    pub fn block(half_width: f64, half_height: f64) -> Self {
        Self::Box { half_extents: dvec2(half_width, half_height) }
    }

    /// ∫ r² dA about the shape's centre [m⁴].
    pub fn polar_moment(&self) -> f64 {
        match *self {
            Self::Box { half_extents } => self.area() * half_extents.length_squared() / 3.0,
            Self::Disc { radius } => self.area() * radius * radius / 2.0,
            Self::Capsule { half_length: l, radius: r } => {
                // A box between two half discs, whose centres lie 4 r/3π beyond the ends of the line (Steiner's theorem twice).
                let middle = 4.0 * l * r * (l * l + r * r) / 3.0;
                let caps = PI * r * r * (r * r / 2.0 + l * l + 2.0 * l * 4.0 * r / (3.0 * PI));
                middle + caps
            }
        }
    }

    /// Area [m²].
    pub fn area(&self) -> f64 {
        match *self {
            Self::Box { half_extents } => 4.0 * half_extents.x * half_extents.y,
            Self::Disc { radius } => PI * radius * radius,
            Self::Capsule { half_length, radius } => 4.0 * half_length * radius + PI * radius * radius,
        }
    }
}

impl Body<Planar> {
    /// ∫ r² dA of all parts about the body's origin [m⁴].
    pub fn polar_moment(&self) -> f64 {
        let about_origin = |part: &crate::plan::Part<Planar>| {
            part.shape.polar_moment() + part.shape.area() * part.pose.position.length_squared()
        };
        self.parts.iter().map(about_origin).sum()
    }
}

impl PlanDim for Planar {
    type Shape = PlanarShape;
    type Core = Core;

    fn measure(shape: &PlanarShape) -> f64 {
        shape.area()
    }

    fn core(shape: &PlanarShape, place: impl Fn(DVec2) -> DVec2) -> Core {
        match *shape {
            PlanarShape::Box { half_extents: DVec2 { x, y } } => {
                let corners = [dvec2(-x, -y), dvec2(x, -y), dvec2(x, y), dvec2(-x, y)];
                Core { corners: corners.map(place).into(), radius: 0.0 }
            }
            PlanarShape::Disc { radius } => Core { corners: vec![place(DVec2::ZERO)], radius },
            PlanarShape::Capsule { half_length, radius } => {
                Core { corners: vec![place(dvec2(-half_length, 0.0)), place(dvec2(half_length, 0.0))], radius }
            }
        }
    }

    fn bounds(core: &Core) -> Bounds<DVec2> {
        Bounds::around(core.corners.iter().copied()).grown(core.radius)
    }

    fn separation(a: &Core, b: &Core) -> f64 {
        separation(a, b)
    }

    fn write_numbers(pose: &Pose<Self>, velocity: DVec2, spin: f64, numbers: &mut Vec<f64>) {
        numbers.extend([pose.position.x, pose.position.y, pose.rotation.angle(), velocity.x, velocity.y, spin]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moment_of_a_capsule_lies_between_those_of_its_line_and_of_a_disc() {
        let of = |half_length, radius| PlanarShape::Capsule { half_length, radius }.polar_moment();
        let disc = PlanarShape::Disc { radius: 0.3 }.polar_moment();
        // Without length it is a disc; without width, a line of mass 4 l r whose moment is m l²/3. Both limits are off by terms of first
        // order in the small size, 1e-9 of the whole.
        assert!((of(1e-9, 0.3) - disc).abs() < 1e-8 * disc);
        let line = 4.0 * 0.5 * 1e-9 * 0.25 / 3.0;
        assert!((of(0.5, 1e-9) - line).abs() < 1e-8 * line);
    }

    #[test]
    fn moment_of_a_capsule_equals_the_sum_over_a_fine_grid() {
        let (half_length, radius): (f64, f64) = (0.48, 0.2);
        let cell = 1e-3;
        let mut sum = 0.0;
        for i in -700..700 {
            for k in -250..250 {
                let point = dvec2(f64::from(i) + 0.5, f64::from(k) + 0.5) * cell;
                let nearest = dvec2(point.x.clamp(-half_length, half_length), 0.0);
                if point.distance(nearest) <= radius {
                    sum += point.length_squared() * cell * cell;
                }
            }
        }
        let moment = PlanarShape::Capsule { half_length, radius }.polar_moment();
        // Cells on the rim are in or out as a whole: a few thousand of them, with random signs.
        assert!((moment - sum).abs() < 1e-4 * moment, "{moment} against {sum}");
    }
}
