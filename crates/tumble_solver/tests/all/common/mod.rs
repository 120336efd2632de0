//! Bodies and contact points for tests: a floor with index 0, other bodies above it.

use glam::{DVec2, dvec2};
use tumble_math::{Dim, Planar};
use tumble_solver::{ContactRow, Slip, SolverBody, Surface};

pub type Body = SolverBody<Planar>;
pub type Row = ContactRow<Planar>;

pub const FLOOR: Body =
    Body { velocity: DVec2::ZERO, angular_velocity: 0.0, inverse_mass: DVec2::ZERO, inverse_inertia: 0.0 };

pub fn body(mass: f64, inertia: f64) -> Body {
    Body { inverse_mass: DVec2::splat(1.0 / mass), inverse_inertia: 1.0 / inertia, ..FLOOR }
}

/// A box of uniform density.
pub fn block(mass: f64, size: DVec2) -> Body {
    body(mass, mass * size.length_squared() / 12.0)
}

pub fn moving(body: Body, velocity: DVec2, angular_velocity: f64) -> Body {
    Body { velocity, angular_velocity, ..body }
}

pub fn surface(friction: f64, restitution: f64) -> Surface {
    Surface { static_friction: friction, kinetic_friction: friction, restitution }
}

/// A touching point between two bodies.
pub fn contact(ends: [u32; 2], normal: DVec2, arms: [DVec2; 2], surface: Surface) -> Row {
    Row {
        a: ends[0],
        b: ends[1],
        frame: Planar::contact_frame(normal),
        arm_a: arms[0],
        arm_b: arms[1],
        separation: 0.0,
        allowance: 0.0,
        surface,
        impulse: DVec2::ZERO,
        slip: Slip::Sticking,
    }
}

/// A point of a body on the floor; its tangent is +x.
pub fn on_floor(body: u32, arm: DVec2, surface: Surface) -> Row {
    contact([0, body], DVec2::Y, [DVec2::ZERO, arm], surface)
}

/// ½ m v² + ½ I ω² of all bodies that can move [J].
pub fn kinetic_energy(bodies: &[Body]) -> f64 {
    let of = |body: &Body| {
        let linear = if body.inverse_mass.x > 0.0 { body.velocity.length_squared() / body.inverse_mass.x } else { 0.0 };
        let angular =
            if body.inverse_inertia > 0.0 { body.angular_velocity.powi(2) / body.inverse_inertia } else { 0.0 };
        0.5 * (linear + angular)
    };
    bodies.iter().map(of).sum()
}

/// Rows of boxes of size 1 × 1, each box on two of the row below, as a wall that grows narrower by one box per row.
pub fn pyramid(rows: u32, surface: Surface) -> (Vec<Body>, Vec<Row>) {
    let size = DVec2::ONE;
    let (mut bodies, mut contacts) = (vec![FLOOR], Vec::new());
    let mut below: Vec<(u32, f64)> = Vec::new();
    for row in 0..rows {
        let count = rows - row;
        let mut own = Vec::new();
        for k in 0..count {
            // Boxes half a box apart, so that neighbours do not touch.
            let x = 1.5 * (f64::from(k) - 0.5 * f64::from(count - 1));
            let index = bodies.len() as u32;
            bodies.push(block(1.0, size));
            own.push((index, x));
            if row == 0 {
                contacts.push(on_floor(index, dvec2(-0.5, -0.5), surface));
                contacts.push(on_floor(index, dvec2(0.5, -0.5), surface));
            }
            for &(other, at) in below.iter().filter(|(_, at)| (at - x).abs() < 1.0) {
                // Both ends of the overlap of the two sides.
                for end in [(x - 0.5).max(at - 0.5), (x + 0.5).min(at + 0.5)] {
                    let arms = [dvec2(end - at, 0.5), dvec2(end - x, -0.5)];
                    contacts.push(contact([other, index], DVec2::Y, arms, surface));
                }
            }
        }
        below = own;
    }
    (bodies, contacts)
}

/// Boxes on top of each other.
pub fn stack(boxes: u32, surface: Surface) -> (Vec<Body>, Vec<Row>) {
    let (mut bodies, mut contacts) = (vec![FLOOR], Vec::new());
    for index in 1..=boxes {
        bodies.push(block(1.0, DVec2::ONE));
        for x in [-0.5, 0.5] {
            if index == 1 {
                contacts.push(on_floor(index, dvec2(x, -0.5), surface));
            } else {
                contacts.push(contact([index - 1, index], DVec2::Y, [dvec2(x, 0.5), dvec2(x, -0.5)], surface));
            }
        }
    }
    (bodies, contacts)
}

/// Gives every body that can move a velocity.
pub fn accelerate(bodies: &mut [Body], change: DVec2) {
    bodies.iter_mut().filter(|body| body.inverse_mass.x > 0.0).for_each(|body| body.velocity += change);
}
