//! What every picture in space is made of: meshes, colours, the way up, and what the camera looks at.

use glam::{DQuat, DVec3};
use tumble_math::{Pose, Rotation, Spatial, SpatialRotation, Vector};

use crate::dim::RecordDim;
use crate::mesh::{Detail, Look, Mesh};
use crate::recording::{BodyKind, BodyRecord, BodyState, Recording, Sample};

/// Colours of dynamic bodies in turn (sRGB, 8 bits).
pub const PALETTE: [[u8; 3]; 8] = [
    [0x2f, 0x7f, 0xc1],
    [0xd9, 0x74, 0x2b],
    [0x2a, 0xa3, 0x7a],
    [0xc0, 0x58, 0x9a],
    [0xb9, 0x8d, 0x00],
    [0x4f, 0xa3, 0xd8],
    [0xa5, 0x54, 0x4a],
    [0x6f, 0x7f, 0xd0],
];
/// Colour of static bodies.
const STATIC: [u8; 3] = [0xa9, 0xaf, 0xb9];
/// Colour of kinematic bodies.
const KINEMATIC: [u8; 3] = [0x8a, 0x6f, 0xbf];
/// Colour of what has no end.
const GROUND: [u8; 3] = [0xd3, 0xd7, 0xdd];

/// The bodies of a recording as meshes in space; a planar one lies at z = 0.
#[derive(Clone, Debug)]
pub struct Stage {
    /// Each different mesh once.
    pub meshes: Vec<Mesh>,
    /// The bodies, in the order of the recording.
    pub bodies: Vec<StageBody>,
    /// Unit vector against gravity; y without gravity.
    pub up: DVec3,
    /// Two corners of the box around all that moves, at all times [m].
    pub span: [DVec3; 2],
    /// Largest extent of a moving body, in the middle of their list [m].
    pub size: f64,
}

/// A body as pictures show it.
#[derive(Clone, Debug)]
pub struct StageBody {
    /// Its shapes.
    pub parts: Vec<StagePart>,
    /// Its colour (sRGB, 8 bits).
    pub color: [u8; 3],
    /// Largest distance of its surface from its centre of mass; 0 of what has no end [m].
    pub reach: f64,
}

/// A shape as pictures show it.
#[derive(Clone, Copy, Debug)]
pub struct StagePart {
    /// Index of its mesh.
    pub mesh: usize,
    /// Whether it only reports touches, and is drawn as air.
    pub sensor: bool,
}

impl Stage {
    /// Sets the stage for a recording.
    pub fn new<D: RecordDim>(recording: &Recording<D>) -> Self {
        let up = -D::embed(recording.gravity);
        let up = up.try_normalize().unwrap_or(DVec3::Y);
        let size = typical_size(recording);
        let draft = Detail { thin: 0.02 * size, ground: 0.0, middle: DVec3::ZERO, half_thickness: 0.25 * size };
        let reaches: Vec<f64> = recording
            .bodies
            .iter()
            .map(|body| body.shapes.iter().map(|shape| D::mesh(&shape.geometry, &draft)))
            .map(|meshes| meshes.filter(|mesh| mesh.look == Look::Solid).map(|mesh| mesh.reach()).fold(0.0, f64::max))
            .collect();
        let span = span(recording, &reaches);
        let ground = 12.0 * (span[1] - span[0]).length().max(size);
        let mut stage = Self { meshes: Vec::new(), bodies: Vec::new(), up, span, size };
        let mut outlines: Vec<&D::Outline> = Vec::new();
        for (index, body) in recording.bodies.iter().enumerate() {
            let pose = recording.samples.iter().find_map(|sample| sample.state(index)).map(pose_of).unwrap_or_default();
            let middle = pose.inverse_transform_point(0.5 * (span[0] + span[1]));
            let detail = Detail { ground, middle, ..draft };
            let mut ground_only = !body.shapes.is_empty();
            let mut parts = Vec::new();
            for shape in &body.shapes {
                let known = outlines.iter().position(|outline| **outline == shape.geometry);
                let known = known.filter(|&mesh| stage.meshes[mesh].look == Look::Solid);
                let mesh = known.unwrap_or_else(|| {
                    outlines.push(&shape.geometry);
                    stage.meshes.push(D::mesh(&shape.geometry, &detail));
                    stage.meshes.len() - 1
                });
                ground_only &= stage.meshes[mesh].look == Look::Ground;
                parts.push(StagePart { mesh, sensor: shape.sensor });
            }
            let color = match body.kind {
                BodyKind::Static if ground_only => GROUND,
                BodyKind::Static => STATIC,
                BodyKind::Kinematic => KINEMATIC,
                BodyKind::Dynamic => PALETTE[index % PALETTE.len()],
            };
            stage.bodies.push(StageBody { parts, color, reach: reaches[index] });
        }
        stage
    }

    /// The body axes of a body in a sample, in space; nothing while it is not in the world or not finite.
    pub fn pose<D: RecordDim>(sample: &Sample<D>, body: usize) -> Option<Pose<Spatial>> {
        sample.state(body).map(pose_of).filter(|pose| pose.position.is_finite() && pose.rotation.is_finite())
    }
}

fn pose_of<D: RecordDim>(state: &BodyState<D>) -> Pose<Spatial> {
    let rotation = SpatialRotation::try_from_quaternion(D::quaternion(&state.orientation)).unwrap_or_default();
    Pose { position: D::embed(state.position), rotation }
}

/// Largest extent of a moving body, in the middle of their list; 1 without any [m].
fn typical_size<D: RecordDim>(recording: &Recording<D>) -> f64 {
    let none = Detail { thin: 0.0, ground: 0.0, middle: DVec3::ZERO, half_thickness: 0.0 };
    let reach = |body: &BodyRecord<D>| {
        let meshes = body.shapes.iter().map(|shape| D::mesh(&shape.geometry, &none));
        meshes.filter(|mesh| mesh.look == Look::Solid).map(|mesh| mesh.reach()).fold(0.0, f64::max)
    };
    let moving = recording.bodies.iter().filter(|body| body.kind != BodyKind::Static);
    let mut sizes: Vec<f64> = moving.map(reach).filter(|size| *size > 0.0 && size.is_finite()).collect();
    sizes.sort_by(f64::total_cmp);
    sizes.get(sizes.len() / 2).copied().unwrap_or(1.0)
}

/// The box around all that moves, at all times; around the origin if nothing does [m].
fn span<D: RecordDim>(recording: &Recording<D>, reaches: &[f64]) -> [DVec3; 2] {
    let mut corners: Option<[DVec3; 2]> = None;
    for sample in &recording.samples {
        for (index, body) in recording.bodies.iter().enumerate() {
            if body.kind == BodyKind::Static {
                continue;
            }
            let Some(pose) = Stage::pose(sample, index) else { continue };
            let mut reach = DVec3::splat(reaches[index]);
            if D::Vector::AXES == 2 {
                reach.z = 0.0;
            }
            let (low, high) = (pose.position - reach, pose.position + reach);
            corners = Some(corners.map_or([low, high], |[l, h]| [l.min(low), h.max(high)]));
        }
    }
    corners.unwrap_or([DVec3::NEG_ONE, DVec3::ONE])
}

/// A frame of axes to look along: to the right, up, and towards the reader, for a scene whose way up is given.
pub fn room(up: DVec3) -> [DVec3; 3] {
    let helper = if up.x.abs() < 0.9 { DVec3::X } else { DVec3::Y };
    let right = (helper - up * up.dot(helper)).normalize();
    [right, up, right.cross(up)]
}

/// Rotation that takes the way up to y.
pub fn to_y_up(up: DVec3) -> DQuat {
    let [right, up, towards] = room(up);
    // The columns of the inverse are the axes of the room.
    DQuat::from_mat3(&glam::DMat3::from_cols(right, up, towards)).conjugate()
}
