//! Replay: one HTML file that plays a recording in a browser, without a network.
//!
//! Page, style, scripts and data are in the file. Numbers for the picture are 32-bit floats relative to the middle of the
//! scene (better than 1e-6 of its size), in base64. A scene of the plane is a drawing; one of space is drawn with light and
//! shadow by WebGL, and a page without it says so. A long recording is thinned to at most [`MOST_POSES`] poses and
//! [`MOST_CONTACTS`] contact points by leaving out whole samples, evenly, and the page says so; the file then stays below
//! 30 MB. Once drawn, the `body` element has `data-ready="true"`, `data-bodies`, `data-samples` and `data-time`.
//! The address may end in `#t=1.5` to open at a time.

mod encode;

use std::io::{self, Write};

use glam::DVec3;
use serde::Serialize;
use tumble_math::{Linear, Vector};

use crate::dim::{Home, RecordDim};
use crate::mesh::Look;
use crate::recording::{AuditRow, BodyKind, BodyState, JointRecord, Recording, Sample, ShapeRecord, SpringRecord};
use crate::stage::Stage;
use crate::thin::keep_extremes;
pub(crate) use encode::base64;
use encode::{floats, words};

/// Most poses (samples × bodies) in a replay: about 10 MB.
pub const MOST_POSES: usize = 600_000;
/// Most contact points in a replay, over all samples: about 16 MB.
pub const MOST_CONTACTS: usize = 400_000;
/// Stretches of the energy plot of which the extremes are kept; finer than its pixels.
const ENERGY_STRETCHES: usize = 1000;

const PAGE: &str = include_str!("replay.html");
const STYLE: &str = include_str!("replay.css");
const DATA: &str = include_str!("data.js");
const PLAYER: [&str; 2] = [include_str!("energy.js"), include_str!("player.js")];
const VIEW_OF_PLANE: [&str; 2] = [include_str!("pen.js"), include_str!("view.js")];
const VIEW_OF_SPACE: [&str; 3] = [include_str!("pen.js"), include_str!("light.js"), include_str!("space.js")];

/// Writes `replay.html`.
pub fn write_replay<D: RecordDim>(recording: &Recording<D>, mut out: impl Write) -> io::Result<()> {
    let data = serde_json::to_string(&Data::new(recording))?;
    // Names may contain `</script>` or `<!--`; a JSON string says `<` in another way too.
    let data = data.replace('<', "\\u003c");
    let view = if D::HOME == Home::Space { VIEW_OF_SPACE.concat() } else { VIEW_OF_PLANE.concat() };
    let scripts = [DATA, &view, PLAYER[0], PLAYER[1]].concat();
    let mut rest = PAGE;
    for (mark, content) in [("{{STYLE}}", STYLE), ("{{DATA}}", &data), ("{{SCRIPT}}", &scripts)] {
        let (before, after) = rest.split_once(mark).expect("the page has each mark once, in this order");
        out.write_all(before.as_bytes())?;
        out.write_all(content.as_bytes())?;
        rest = after;
    }
    out.write_all(rest.as_bytes())
}

/// What the page reads.
#[derive(Serialize)]
#[serde(bound = "")]
struct Data<'a, D: RecordDim> {
    scene: &'a str,
    about: &'a str,
    contact: &'a str,
    dt: f64,
    gravity: D::Vector,
    bodies: Vec<Body<'a, D>>,
    springs: &'a [SpringRecord<D>],
    joints: &'a [JointRecord<D>],
    /// Number of samples before thinning.
    recorded_samples: usize,
    steps: Vec<u64>,
    times: Vec<f64>,
    /// Middle of the scene; poses and contact points are relative to it [m].
    origin: D::Vector,
    /// Position and orientation of each body in each sample; NaN while it is not in the world.
    poses: String,
    /// Index of the first contact of each sample, and the number of all.
    contact_starts: String,
    /// Point, impulse on b and normal impulse of each contact.
    contact_numbers: String,
    /// Indices of a and b of each contact.
    contact_pairs: String,
    audit: Audit,
    /// What a picture in space is made of; none in the plane.
    stage: Option<Scenery>,
}

/// What a picture in space is made of.
#[derive(Serialize)]
struct Scenery {
    meshes: Vec<Surface>,
    /// Unit vector against gravity.
    up: DVec3,
    /// Two corners of the box around all that moves, relative to the origin [m].
    span: [DVec3; 2],
}

/// A mesh.
#[derive(Serialize)]
struct Surface {
    /// Place, normal and brightness of each corner: seven numbers.
    corners: String,
    /// Corners of each triangle.
    triangles: String,
    ground: bool,
}

#[derive(Serialize)]
#[serde(bound = "")]
struct Body<'a, D: RecordDim> {
    name: &'a str,
    kind: &'static str,
    /// Outlines; of the plane.
    shapes: &'a [ShapeRecord<D>],
    /// Index of the mesh of each shape, and whether it is a sensor; of space.
    parts: Vec<(usize, bool)>,
    /// Largest distance of its surface from its centre of mass; of space [m].
    reach: f64,
}

/// Curves over the steps, thinned without losing a peak.
#[derive(Serialize)]
struct Audit {
    times: Vec<f64>,
    kinetic: String,
    potential: String,
    total: String,
    deepest_overlap: String,
    contacts: String,
}

impl<'a, D: RecordDim> Data<'a, D> {
    fn new(recording: &'a Recording<D>) -> Self {
        let samples = thinned(recording);
        let origin = middle(&samples);
        let stage = (D::HOME == Home::Space).then(|| Stage::new(recording));
        let contacts = || samples.iter().flat_map(|sample| &sample.contacts);
        Self {
            scene: &recording.scene,
            about: &recording.about,
            contact: &recording.contact,
            dt: recording.dt,
            gravity: recording.gravity,
            bodies: (0..recording.bodies.len()).map(|body| Body::new(recording, body, stage.as_ref())).collect(),
            springs: &recording.springs,
            joints: &recording.joints,
            recorded_samples: recording.samples.len(),
            steps: samples.iter().map(|sample| sample.step).collect(),
            times: samples.iter().map(|sample| sample.time).collect(),
            origin,
            poses: floats(samples.iter().flat_map(|sample| {
                (0..recording.bodies.len()).flat_map(move |body| pose_numbers(sample.state(body), origin))
            })),
            contact_starts: words([0].into_iter().chain(samples.iter().scan(0, |count, sample| {
                *count += sample.contacts.len();
                Some(*count)
            }))),
            contact_numbers: floats(contacts().flat_map(|contact| {
                let (point, impulse) = (contact.point - origin, contact.impulse_on_b());
                components(point).chain(components(impulse)).chain([contact.normal_impulse])
            })),
            contact_pairs: words(contacts().flat_map(|contact| [contact.a, contact.b])),
            audit: Audit::new(&recording.audit),
            stage: stage.as_ref().map(|stage| Scenery::new(stage, D::embed(origin))),
        }
    }
}

impl<'a, D: RecordDim> Body<'a, D> {
    fn new(recording: &'a Recording<D>, body: usize, stage: Option<&Stage>) -> Self {
        let record = &recording.bodies[body];
        let kind = match record.kind {
            BodyKind::Dynamic => "dynamic",
            BodyKind::Kinematic => "kinematic",
            BodyKind::Static => "static",
        };
        let Some(stage) = stage else {
            return Self { name: &record.name, kind, shapes: &record.shapes, parts: Vec::new(), reach: 0.0 };
        };
        let parts: Vec<(usize, bool)> = stage.bodies[body].parts.iter().map(|part| (part.mesh, part.sensor)).collect();
        let reach = stage.bodies[body].reach;
        Self { name: &record.name, kind, shapes: &[], parts, reach }
    }
}

impl Scenery {
    fn new(stage: &Stage, origin: DVec3) -> Self {
        let meshes = stage.meshes.iter().map(|mesh| Surface {
            corners: floats(mesh.positions.iter().zip(&mesh.normals).zip(&mesh.shades).flat_map(
                |((position, normal), shade)| {
                    [position.x, position.y, position.z, normal.x, normal.y, normal.z, *shade]
                },
            )),
            triangles: words(mesh.triangles.iter().flatten().map(|corner| *corner as usize)),
            ground: mesh.look == Look::Ground,
        });
        Self { meshes: meshes.collect(), up: stage.up, span: stage.span.map(|corner| corner - origin) }
    }
}

impl Audit {
    fn new<D: RecordDim>(rows: &[AuditRow<D>]) -> Self {
        let column = |value: fn(&AuditRow<D>) -> f64| rows.iter().map(value).collect::<Vec<f64>>();
        let curves = [column(|row| row.kinetic), column(|row| row.potential), column(|row| row.total)];
        let kept = keep_extremes(rows.len(), ENERGY_STRETCHES, &[&curves[0], &curves[1], &curves[2]]);
        let encoded = |value: fn(&AuditRow<D>) -> f64| floats(kept.iter().map(|&index| value(&rows[index])));
        Self {
            times: kept.iter().map(|&index| rows[index].time).collect(),
            kinetic: encoded(|row| row.kinetic),
            potential: encoded(|row| row.potential),
            total: encoded(|row| row.total),
            deepest_overlap: encoded(|row| row.deepest_overlap),
            contacts: encoded(|row| row.contacts as f64),
        }
    }
}

/// Components of a vector, in order.
fn components<V: Vector>(vector: V) -> impl Iterator<Item = f64> {
    (0..V::AXES).map(move |axis| vector[axis])
}

/// How many numbers a pose has.
fn pose_length<D: RecordDim>() -> usize {
    D::Vector::AXES + D::COLUMNS.orientation.len()
}

/// Position relative to the origin, then orientation.
fn pose_numbers<D: RecordDim>(state: Option<&BodyState<D>>, origin: D::Vector) -> Vec<f64> {
    let Some(state) = state else { return vec![f64::NAN; pose_length::<D>()] };
    let mut numbers = state.numbers().as_ref()[..pose_length::<D>()].to_vec();
    for (axis, number) in numbers.iter_mut().take(D::Vector::AXES).enumerate() {
        *number -= origin[axis];
    }
    numbers
}

/// Returns every n-th sample and the last one, with the smallest n that keeps poses and contacts below their caps.
fn thinned<D: RecordDim>(recording: &Recording<D>) -> Vec<&Sample<D>> {
    let count = recording.samples.len();
    // The caps are those of the plane: in space poses and contacts have more numbers.
    let most_poses = MOST_POSES * 3 / pose_length::<D>();
    let most_contacts = MOST_CONTACTS * 5 / (2 * D::Vector::AXES + 1);
    let poses = count * recording.bodies.len();
    let mut stride = poses.div_ceil(most_poses).max(1);
    let every = |stride: usize| {
        let kept = recording.samples.iter().step_by(stride);
        // The last sample shows how it ended.
        kept.chain(recording.samples.last().filter(|_| count > 0 && !(count - 1).is_multiple_of(stride)))
    };
    let contacts = |stride| every(stride).map(|sample| sample.contacts.len()).sum::<usize>();
    while stride < count && contacts(stride) > most_contacts {
        stride += 1;
    }
    every(stride).collect()
}

/// Returns the middle of the box around all finite positions [m].
fn middle<D: RecordDim>(samples: &[&Sample<D>]) -> D::Vector {
    let positions = samples.iter().flat_map(|sample| sample.states.iter().flatten()).map(|state| state.position);
    positions
        .filter(|position| position.is_finite())
        .fold(None, |span: Option<(D::Vector, D::Vector)>, position| {
            Some(span.map_or((position, position), |(low, high)| (low.min(position), high.max(position))))
        })
        .map_or(D::Vector::ZERO, |(low, high)| low * 0.5 + high * 0.5)
}
