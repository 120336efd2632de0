//! A plausible recording for tests of pictures: an L, a T and a star of thin rods and a disc fall on a floor.
//!
//! Penalty springs hold the rod ends and the disc up; good enough to look at, and to make every kind of data.

use std::borrow::Cow;

use glam::DVec2;
use tumble_record::{
    AnchorRecord, AuditRow, BodyKind, BodyRecord, BodyState, ContactRecord, Geometry, Recording, Sample, ShapeRecord,
    SpringRecord, Touch, TouchPhase,
};

pub mod space;

const DT: f64 = 1e-3;
const GRAVITY: f64 = 9.81;

/// Rods around their common centre of mass, in the body frame.
fn rods(lines: &[[f64; 4]]) -> Vec<Geometry> {
    let length = |line: &[f64; 4]| DVec2::new(line[2] - line[0], line[3] - line[1]).length();
    let total: f64 = lines.iter().map(length).sum();
    let centre: DVec2 =
        lines.iter().map(|line| DVec2::new(line[0] + line[2], line[1] + line[3]) * (0.5 * length(line) / total)).sum();
    let end = |x, y| DVec2::new(x, y) - centre;
    lines.iter().map(|l| Geometry::Rod { from: end(l[0], l[1]), to: end(l[2], l[3]), radius: 0.0 }).collect()
}

fn solid(geometry: Geometry) -> ShapeRecord {
    ShapeRecord { geometry, sensor: false }
}

fn body(id: u64, name: &str, kind: BodyKind, shapes: Vec<ShapeRecord>) -> BodyRecord {
    BodyRecord { id, name: name.to_owned(), kind, mass: 1.0, inertia: 0.12, shapes }
}

fn end_of(body: usize) -> AnchorRecord {
    AnchorRecord { body: Some(body), point: DVec2::ZERO }
}

/// A spring for the eye: it pulls nobody.
fn spring(a: AnchorRecord, body: usize) -> SpringRecord {
    SpringRecord { a, b: end_of(body), rest_length: 1.0, from: 0.0, until: None }
}

/// Records `seconds` of the fall, with a sample every `every` steps.
pub fn falling_rods(seconds: f64, every: u64) -> Recording {
    let shapes = [
        rods(&[[0.0, 0.0, 0.0, 0.9], [0.0, 0.0, 0.6, 0.0]]),
        rods(&[[-0.5, 0.0, 0.5, 0.0], [0.0, 0.0, 0.0, -0.8]]),
        rods(&[[-0.5, 0.0, 0.5, 0.0], [-0.25, -0.433, 0.25, 0.433], [-0.25, 0.433, 0.25, -0.433]]),
        vec![Geometry::Disc { centre: DVec2::ZERO, radius: 0.3 }],
        vec![Geometry::Polygon {
            points: [[-0.35, -0.2], [0.35, -0.2], [0.35, 0.2], [-0.35, 0.2]].map(DVec2::from).into(),
        }],
    ];
    let names = ["L", "T", "star", "disc", "crate \"9\", </script><b>heavy</b>"];
    let mut bodies: Vec<BodyRecord> = names
        .iter()
        .zip(shapes)
        .enumerate()
        .map(|(id, (name, shapes))| body(id as u64, name, BodyKind::Dynamic, shapes.into_iter().map(solid).collect()))
        .collect();
    let half_plane = |x, y, nx, ny| solid(Geometry::HalfPlane { point: DVec2::new(x, y), normal: DVec2::new(nx, ny) });
    bodies.push(body(
        5,
        "floor",
        BodyKind::Static,
        vec![half_plane(0.0, 0.0, 0.0, 1.0), half_plane(-3.0, 0.0, 1.0, 0.0)],
    ));
    let beam = Geometry::Rod { from: DVec2::new(-0.4, 0.0), to: DVec2::new(0.4, 0.0), radius: 0.05 };
    bodies.push(body(6, "lift", BodyKind::Kinematic, vec![solid(beam)]));
    let gate = Geometry::Polygon { points: [[-0.4, 0.0], [0.4, 0.0], [0.4, 1.0], [-0.4, 1.0]].map(DVec2::from).into() };
    bodies.push(body(7, "gate", BodyKind::Static, vec![ShapeRecord { geometry: gate, sensor: true }]));

    let start = |x, y, angle, angular_velocity| BodyState {
        position: DVec2::new(x, y),
        orientation: angle,
        velocity: DVec2::new(0.3, 0.0),
        angular_velocity,
    };
    let mut states = vec![
        start(-2.0, 2.2, 0.3, 0.5),
        start(-0.7, 2.8, 0.7, -2.0),
        start(0.7, 2.0, 0.1, 3.0),
        start(1.9, 1.6, 0.0, 0.0),
        start(3.0, 2.4, 0.4, 1.0),
        BodyState::default(),
        BodyState { position: DVec2::new(-2.2, 0.3), velocity: DVec2::new(0.0, 0.15), ..BodyState::default() },
        BodyState { position: DVec2::new(2.2, 0.0), ..BodyState::default() },
    ];
    let mut recording = Recording {
        scene: "falling_rods".to_owned(),
        about: "An L, a T and a star of thin rods, a disc and a crate fall on a floor.".to_owned(),
        contact: "penalty".to_owned(),
        dt: DT,
        length_scale: 1.0,
        bodies,
        springs: vec![spring(AnchorRecord { body: None, point: DVec2::new(0.0, 4.0) }, 0), spring(end_of(2), 4)],
        ..Recording::default()
    };
    let mut touched = false;
    let steps = (seconds / DT) as u64;
    for step in 0..=steps {
        let time = step as f64 * DT;
        let contacts = if step == 0 { Vec::new() } else { advance(&recording.bodies, &mut states) };
        recording.audit.push(audit(&recording.bodies, &states, &contacts, step, time));
        if !touched && !contacts.is_empty() {
            touched = true;
            let (a, b) = (contacts[0].a, contacts[0].b);
            recording.touches.push(Touch { step, time, a, b, phase: TouchPhase::Begin, sensor: false });
        }
        if step % every == 0 || step == steps {
            let states = states.iter().copied().map(Some).collect();
            recording.samples.push(Sample { step, time, states, contacts, ..Sample::default() });
        }
    }
    recording
}

/// Moves all bodies by one step, and returns the contacts with the floor.
fn advance(bodies: &[BodyRecord], states: &mut [BodyState]) -> Vec<ContactRecord> {
    let mut contacts = Vec::new();
    for (index, (record, state)) in bodies.iter().zip(states).enumerate() {
        if record.kind == BodyKind::Dynamic {
            let mut force = DVec2::new(0.0, -GRAVITY * record.mass);
            let mut torque = 0.0;
            for arm in record.shapes.iter().flat_map(|shape| lowest_arms(&shape.geometry, state.orientation)) {
                let point = state.position + arm;
                let velocity = state.velocity + state.angular_velocity * arm.perp();
                let normal_force = (-4000.0 * point.y - 25.0 * velocity.y).max(0.0);
                if point.y >= 0.0 || normal_force == 0.0 {
                    continue;
                }
                let friction = -0.4 * normal_force * (velocity.x / 0.02).clamp(-1.0, 1.0);
                let push = DVec2::new(friction, normal_force);
                force += push;
                torque += arm.perp_dot(push);
                // The body is a, the floor is b: normal (0, −1), tangent (−1, 0), impulses act on the floor.
                contacts.push(ContactRecord {
                    a: index,
                    b: 5,
                    point,
                    normal: DVec2::NEG_Y,
                    separation: point.y,
                    normal_impulse: normal_force * DT,
                    tangent_impulse: friction * DT,
                    kind: Cow::Borrowed("vertex_on_half_plane"),
                });
            }
            state.velocity += force / record.mass * DT;
            state.angular_velocity += torque / record.inertia * DT;
        }
        state.position += state.velocity * DT;
        state.orientation += state.angular_velocity * DT;
    }
    contacts
}

/// Arms from the centre of mass to the points that can touch a floor, in world axes.
fn lowest_arms(geometry: &Geometry, angle: f64) -> Vec<DVec2> {
    let (sin, cos) = libm::sincos(angle);
    let turn = |point: &DVec2| DVec2::new(cos, sin).rotate(*point);
    match geometry {
        Geometry::Rod { from, to, .. } => vec![turn(from), turn(to)],
        Geometry::Disc { centre, radius } => vec![turn(centre) - DVec2::new(0.0, *radius)],
        Geometry::Polygon { points } => points.iter().map(turn).collect(),
        Geometry::HalfPlane { .. } => Vec::new(),
    }
}

fn audit(bodies: &[BodyRecord], states: &[BodyState], contacts: &[ContactRecord], step: u64, time: f64) -> AuditRow {
    let mut row = AuditRow { step, time, contacts: contacts.len() as u64, iterations: Some(1), ..AuditRow::default() };
    for (record, state) in bodies.iter().zip(states).filter(|(record, _)| record.kind == BodyKind::Dynamic) {
        row.kinetic += 0.5 * record.mass * state.velocity.length_squared();
        row.kinetic += 0.5 * record.inertia * state.angular_velocity * state.angular_velocity;
        row.potential += record.mass * GRAVITY * state.position.y;
        row.momentum += record.mass * state.velocity;
    }
    row.total = row.kinetic + row.potential;
    row.deepest_overlap = contacts.iter().map(|contact| -contact.separation).fold(0.0, f64::max);
    row
}
