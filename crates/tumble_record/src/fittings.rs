//! What holds bodies together and what pushes them, as pictures in space show it: springs, joints, contact points and their forces.

use glam::{DQuat, DVec3};
use tumble_math::{Pose, Spatial, SpatialRotation};

use crate::dim::RecordDim;
use crate::mesh::Mesh;
use crate::recording::{AnchorRecord, BodyKind, Recording, Sample};
use crate::stage::Stage;

/// Colour of springs and joints (sRGB, 8 bits).
pub const HOLD: [u8; 3] = [0x4c, 0x53, 0x61];
/// Colour of contact points.
const CONTACT: [u8; 3] = [0x22, 0x26, 0x2e];
/// Colour of forces.
const FORCE: [u8; 3] = [0xd8, 0x1b, 0x43];

/// Thickness of springs and of the shafts of arrows, as a share of a body's size [1].
const THIN: f64 = 0.025;
/// Length of the arrow of a typical force, as a share of a body's size [1].
const TYPICAL_LENGTH: f64 = 1.2;
/// Length at which arrows are cut, as a share of a body's size [1].
const LONGEST: f64 = 5.0;

/// Something that is no body.
#[derive(Clone, Debug)]
pub struct Fitting {
    /// Its surface, in world axes.
    pub mesh: Mesh,
    /// Its colour (sRGB, 8 bits).
    pub color: [u8; 3],
}

/// How the fittings of a recording are drawn.
#[derive(Clone, Copy, Debug)]
pub struct Fittings {
    /// A body's size [m].
    size: f64,
    /// Length of the arrow of one newton [m/N].
    per_newton: f64,
}

impl Fittings {
    /// Chooses sizes for a recording.
    pub fn new<D: RecordDim>(recording: &Recording<D>, stage: &Stage) -> Self {
        let force = typical_impulse(recording) / recording.dt;
        let per_newton = if force > 0.0 { TYPICAL_LENGTH * stage.size / force } else { 0.0 };
        Self { size: stage.size, per_newton }
    }

    /// What is to be seen of a sample.
    pub fn of<D: RecordDim>(&self, recording: &Recording<D>, sample: &Sample<D>) -> Vec<Fitting> {
        let mut fittings = Vec::new();
        let thin = THIN * self.size;
        let mut add = |color, draw: &dyn Fn(&mut Mesh)| {
            let mut mesh = Mesh::default();
            draw(&mut mesh);
            fittings.push(Fitting { mesh, color });
        };
        let is_there = |from: f64, until: Option<f64>| sample.time >= from && until.is_none_or(|end| sample.time < end);
        for spring in recording.springs.iter().filter(|spring| is_there(spring.from, spring.until)) {
            let Some([from, to]) = places(&spring.a, &spring.b, sample) else { continue };
            let wide = (0.06 * spring.rest_length).min(0.12 * from.distance(to)).max(2.0 * thin);
            add(HOLD, &|mesh| mesh.add_coil(from, to, wide, thin));
        }
        for joint in recording.joints.iter().filter(|joint| is_there(joint.from, joint.until)) {
            let Some([from, to]) = places(&joint.a, &joint.b, sample) else { continue };
            add(HOLD, &|mesh| mesh.add_ball(to, 2.5 * thin));
            if joint.kind == "distance" {
                add(HOLD, &|mesh| {
                    mesh.add_ball(from, 2.5 * thin);
                    mesh.add_tube(&[from, to], thin);
                });
            }
        }
        let is_pushed = |body: usize| recording.bodies.get(body).is_some_and(|body| body.kind == BodyKind::Dynamic);
        for contact in &sample.contacts {
            let point = D::embed(contact.point);
            if !point.is_finite() {
                continue;
            }
            add(CONTACT, &|mesh| mesh.add_ball(point, 1.6 * thin));
            let arrow = D::embed(contact.impulse_on_b()) * (self.per_newton / recording.dt);
            let arrow = arrow.clamp_length_max(LONGEST * self.size);
            for (body, sign) in [(contact.a, -1.0), (contact.b, 1.0)] {
                if is_pushed(body) && arrow.length() > 2.0 * thin {
                    add(FORCE, &|mesh| mesh.add_arrow(point, point + arrow * sign, thin));
                }
            }
        }
        fittings
    }
}

/// A spring or a joint that moves, for files whose meshes keep their shape.
#[derive(Clone, Debug)]
pub struct Hold {
    /// What it is called.
    pub name: String,
    /// Its surface, along y from the origin.
    pub mesh: Mesh,
    /// Where it is in each sample; nothing while it is not there.
    pub placements: Vec<Option<Placement>>,
}

/// Where a mesh is, and by which factor it is longer along its y axis.
#[derive(Clone, Copy, Debug)]
pub struct Placement {
    /// Where it is and how it is turned.
    pub pose: Pose<Spatial>,
    /// Factor along its own y axis [1].
    pub stretch: f64,
}

/// The springs and joints of a recording.
pub fn holds<D: RecordDim>(recording: &Recording<D>, stage: &Stage) -> Vec<Hold> {
    let thin = THIN * stage.size;
    let springs = recording.springs.iter().enumerate().map(|(number, spring)| {
        let draw = |length: f64| {
            let wide = (0.06 * spring.rest_length).min(0.12 * length).max(2.0 * thin);
            let mut mesh = Mesh::default();
            mesh.add_coil(DVec3::ZERO, DVec3::Y * length, wide, thin);
            mesh
        };
        let there = (spring.from, spring.until);
        between(recording, format!("spring {number}"), (&spring.a, &spring.b), there, draw)
    });
    let joints = recording.joints.iter().map(|joint| {
        let is_rod = joint.kind == "distance";
        let draw = |length: f64| {
            let mut mesh = Mesh::default();
            mesh.add_ball(DVec3::ZERO, 2.5 * thin);
            if is_rod {
                mesh.add_tube(&[DVec3::ZERO, DVec3::Y * length], thin);
            }
            mesh
        };
        // All but rods are where the second body is held.
        let ends = (if is_rod { &joint.a } else { &joint.b }, &joint.b);
        between(recording, joint.name.clone(), ends, (joint.from, joint.until), draw)
    });
    springs.chain(joints).collect()
}

/// A mesh between two anchors, drawn for the length that it has when it appears; the placements of a ball have no length.
fn between<D: RecordDim>(
    recording: &Recording<D>,
    name: String,
    (a, b): (&AnchorRecord<D>, &AnchorRecord<D>),
    (from, until): (f64, Option<f64>),
    draw: impl Fn(f64) -> Mesh,
) -> Hold {
    let ends = recording.samples.iter().map(|sample| {
        let is_there = sample.time >= from && until.is_none_or(|end| sample.time < end);
        places(a, b, sample).filter(|_| is_there)
    });
    let ends: Vec<Option<[DVec3; 2]>> = ends.collect();
    let first = ends.iter().flatten().next().map_or(DVec3::ZERO, |[from, to]| *to - *from);
    let (start, length) = (first.normalize_or(DVec3::Y), first.length());
    // Turned from where it pointed first, so that only a full turn back is without a nearest way.
    let upright = DQuat::from_rotation_arc(DVec3::Y, start);
    let placements = ends.into_iter().map(|ends| {
        let [from, to] = ends?;
        let turn = DQuat::from_rotation_arc(start, (to - from).normalize_or(start)) * upright;
        let rotation = SpatialRotation::try_from_quaternion(turn).unwrap_or_default();
        let stretch = if length > 0.0 { from.distance(to) / length } else { 1.0 };
        Some(Placement { pose: Pose { position: from, rotation }, stretch })
    });
    Hold { name, mesh: draw(length), placements: placements.collect() }
}

/// Where both ends are, unless one of them is nowhere [m].
fn places<D: RecordDim>(a: &AnchorRecord<D>, b: &AnchorRecord<D>, sample: &Sample<D>) -> Option<[DVec3; 2]> {
    let ends = [D::embed(a.in_world(sample)?), D::embed(b.in_world(sample)?)];
    ends.iter().all(|end| end.is_finite()).then_some(ends)
}

/// The impulse below which half of all impulse is given: many tiny ones count little, and one great one not for all [N·s].
fn typical_impulse<D: RecordDim>(recording: &Recording<D>) -> f64 {
    let contacts = recording.samples.iter().flat_map(|sample| &sample.contacts);
    let mut impulses: Vec<f64> = contacts
        .map(|contact| D::embed(contact.impulse_on_b()).length())
        .filter(|impulse| *impulse > 0.0 && impulse.is_finite())
        .collect();
    impulses.sort_by(f64::total_cmp);
    let half = 0.5 * impulses.iter().sum::<f64>();
    let mut sum = 0.0;
    let reached = impulses.iter().find(|impulse| {
        sum += **impulse;
        sum >= half
    });
    reached.copied().unwrap_or(0.0)
}
