//! Lines, balls and arrows: what pictures show besides bodies.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec3;
use tumble_math::trig;

use super::{Fields, Mesh, Ring, arc};

/// Corners around a tube.
const AROUND: usize = 8;
/// Windings of a coil.
const WINDINGS: usize = 9;
/// Pieces of a winding.
const PIECES: usize = 12;

impl Mesh {
    /// Adds a small ball.
    pub fn add_ball(&mut self, centre: DVec3, radius: f64) {
        let rings: Vec<Ring> = arc(0.0, radius, -FRAC_PI_2, FRAC_PI_2, 6).collect();
        self.add_revolution(centre, DVec3::Y, &rings, Fields::None);
    }

    /// Adds an arrow from one point to another; its head is three times as wide as its shaft, whose radius is given [m].
    pub fn add_arrow(&mut self, from: DVec3, to: DVec3, radius: f64) {
        let (axis, length) = ((to - from).normalize_or(DVec3::Y), from.distance(to));
        let (wide, head) = (3.0 * radius, (7.0 * radius).min(0.6 * length));
        let slant = (wide * wide + head * head).sqrt();
        let ring = |along, radius, normal| Ring { along, radius, normal };
        let neck = length - head;
        let shaft = [ring(0.0, radius, (0.0, 1.0)), ring(neck, radius, (0.0, 1.0))];
        let back = [ring(neck, 0.0, (-1.0, 0.0)), ring(neck, wide, (-1.0, 0.0))];
        let out = (wide / slant, head / slant);
        for rings in [shaft, back, [ring(neck, wide, out), ring(length, 0.0, out)]] {
            self.add_revolution(from, axis, &rings, Fields::None);
        }
    }

    /// Adds a tube along a line of points; its ends are open.
    pub fn add_tube(&mut self, points: &[DVec3], radius: f64) {
        let mut side = DVec3::ZERO;
        for pair in points.windows(2) {
            let axis = (pair[1] - pair[0]).normalize_or_zero();
            if axis == DVec3::ZERO {
                continue;
            }
            // The side of the piece before, as far as it is square to this one: the tube does not twist.
            side = (side - axis * axis.dot(side)).try_normalize().unwrap_or_else(|| axis.any_orthonormal_vector());
            let other = axis.cross(side);
            let first = self.positions.len() as u32;
            for corner in 0..AROUND {
                let (sin, cos) = trig::sin_cos(TAU * corner as f64 / AROUND as f64);
                let out = side * cos + other * sin;
                for point in pair {
                    self.positions.push(*point + out * radius);
                    self.normals.push(out);
                    self.shades.push(1.0);
                }
            }
            for corner in 0..AROUND as u32 {
                let [a, b] = [corner, (corner + 1) % AROUND as u32].map(|corner| first + 2 * corner);
                self.triangles.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
            }
        }
    }

    /// Adds a coil between two points, with straight ends; `wide` is the radius of its windings, `radius` that of the wire [m].
    pub fn add_coil(&mut self, from: DVec3, to: DVec3, wide: f64, radius: f64) {
        let along = to - from;
        let axis = along.normalize_or(DVec3::Y);
        let side = axis.any_orthonormal_vector();
        let other = axis.cross(side);
        let mut points = vec![from];
        for piece in 0..=WINDINGS * PIECES {
            let (sin, cos) = trig::sin_cos(TAU * (piece % PIECES) as f64 / PIECES as f64);
            let share = 0.12 + 0.76 * piece as f64 / (WINDINGS * PIECES) as f64;
            points.push(from + along * share + (side * cos + other * sin) * wide);
        }
        points.push(to);
        self.add_tube(&points, radius);
    }
}
