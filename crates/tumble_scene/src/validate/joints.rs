//! Joints: that they hold two things of which one can move, and that they fit at the start.

use std::collections::BTreeMap;

use glam::DVec2;
use tumble_math::{PlanarRotation, Rotation};

use super::Findings;
use super::bodies::BodyNames;
use crate::diagnostics::Diagnostic;
use crate::expand::{ExpandedBody, MOST_BODIES, count};
use crate::format::{AnchorEntry, BodyEntry, BodyKind, JointEntry, JointKind, Scene};
use crate::path::ScenePath;
use crate::shapes::body_mass;

pub(super) fn check(scene: &Scene, bodies: &BodyNames, found: &mut Findings) {
    if scene.joints.is_empty() {
        return;
    }
    let total = scene.bodies.iter().map(count).fold(0, u64::saturating_add);
    let expanded = if total > MOST_BODIES { Vec::new() } else { scene.expand() };
    let known = by_name(&expanded);
    let mut taken: BTreeMap<&str, usize> = BTreeMap::new();
    for (index, joint) in scene.joints.iter().enumerate() {
        let path = ScenePath::root().field("joints").index(index);
        name(joint, &path, &mut taken, index, found);
        let before = found.list.len();
        ends(joint, &path, bodies, &known, found);
        quantities(joint, &path, found);
        if found.list.len() == before {
            fit(joint, &path, &known, scene, found);
        }
    }
}

fn name<'s>(
    joint: &'s JointEntry,
    path: &ScenePath,
    taken: &mut BTreeMap<&'s str, usize>,
    index: usize,
    found: &mut Findings,
) {
    let path = path.field("name");
    if joint.name.is_empty() || joint.name.chars().any(char::is_control) {
        found.error(&path, "a joint needs a name", "empty, or with control characters");
    }
    if let Some(first) = taken.insert(&joint.name, index) {
        taken.insert(&joint.name, first);
        let diagnostic = Diagnostic::error(format!("two joints are named \"{}\"", joint.name))
            .about(path)
            .labelled("again here")
            .also_about(ScenePath::root().field("joints").index(first).field("name"), "first here");
        found.add(diagnostic);
    }
}

/// Checks that the joint holds two different things, of which one is moved by forces.
fn ends(
    joint: &JointEntry,
    path: &ScenePath,
    bodies: &BodyNames,
    known: &BTreeMap<&str, &BodyEntry>,
    found: &mut Findings,
) {
    for (field, anchor) in [("a", &joint.a), ("b", &joint.b)] {
        if let AnchorEntry::Body { name, .. } = anchor {
            bodies.check(&path.field(field).field("name"), name, found);
        }
    }
    match (&joint.a, &joint.b) {
        (AnchorEntry::World { .. }, AnchorEntry::World { .. }) => {
            found.error(&path.field("b"), "a joint must hold a body", "both ends hold the world");
        }
        (AnchorEntry::Body { name: a, .. }, AnchorEntry::Body { name: b, .. }) if a == b => {
            let message = format!("joint \"{}\" holds \"{a}\" to itself", joint.name);
            found.error(&path.field("b").field("name"), message, "the same body as at the other end");
        }
        (a, b) => {
            let is_moved = |anchor: &AnchorEntry| match anchor {
                AnchorEntry::World { .. } => false,
                // What is unknown has been reported.
                AnchorEntry::Body { name, .. } => {
                    known.get(name.as_str()).is_none_or(|body| body.kind == BodyKind::Dynamic)
                }
            };
            if !is_moved(a) && !is_moved(b) {
                let message = format!("joint \"{}\" holds nothing that forces move", joint.name);
                found.error(&path.field("name"), message, "one end must hold a dynamic body");
            }
        }
    }
}

fn quantities(joint: &JointEntry, path: &ScenePath, found: &mut Findings) {
    let path = path.field("kind");
    match joint.kind {
        JointKind::Distance { length: Some(length) } => {
            found.positive(&path.field("length"), &format!("the length of joint \"{}\"", joint.name), length);
        }
        JointKind::Prismatic { axis } if axis.try_normalize().is_none() => {
            let message = format!("the axis of joint \"{}\" has no direction", joint.name);
            found.error(&path.field("axis"), message, "it must not be (0, 0)");
        }
        _ => {}
    }
}

/// Reports a joint that does not fit at the start.
fn fit(joint: &JointEntry, path: &ScenePath, known: &BTreeMap<&str, &BodyEntry>, scene: &Scene, found: &mut Findings) {
    let Some([a, b]) = both_ends(joint, known) else { return };
    if matches!(joint.kind, JointKind::Distance { length: None }) && a.point == b.point {
        let message = format!("the length of joint \"{}\" must be positive", joint.name);
        return found.error(&path.field("kind"), message, "the anchors coincide at the start");
    }
    let (gap, slop) = (gap(joint.kind, &a, &b), scene.slop_or_default());
    if gap > slop && !joint.allow_gap {
        let [at_a, at_b] = [a.point, b.point].map(|point| format!("({:.6}, {:.6})", point.x, point.y));
        let diagnostic = Diagnostic::error(format!("joint \"{}\" is open by {gap:.3e} m at the start", joint.name))
            .about(path.field("name"))
            .labelled(format!("it holds {at_a} and {at_b}; the slop is {slop} m"))
            .help("move the bodies or the anchors, or say `allow_gap: true`");
        found.add(diagnostic);
    }
}

/// Indices of the joints of a sound scene that are open by more than the slop.
pub(crate) fn open_joints(scene: &Scene) -> Vec<usize> {
    let expanded = scene.expand();
    let known = by_name(&expanded);
    let is_open = |joint: &JointEntry| {
        both_ends(joint, &known).is_some_and(|[a, b]| gap(joint.kind, &a, &b) > scene.slop_or_default())
    };
    (0..scene.joints.len()).filter(|&index| is_open(&scene.joints[index])).collect()
}

/// By how much the anchors are not where the joint wants them [m].
fn gap(kind: JointKind, a: &End, b: &End) -> f64 {
    let between = b.point - a.point;
    match kind {
        JointKind::Revolute | JointKind::Fixed => between.length(),
        JointKind::Distance { length } => length.map_or(0.0, |length| (between.length() - length).abs()),
        JointKind::Prismatic { axis } => a.rotation.rotate(axis).normalize_or_zero().perp_dot(between).abs(),
    }
}

fn by_name(expanded: &[ExpandedBody]) -> BTreeMap<&str, &BodyEntry> {
    expanded.iter().map(|body| (body.body.name.as_str(), &body.body)).collect()
}

fn both_ends(joint: &JointEntry, known: &BTreeMap<&str, &BodyEntry>) -> Option<[End; 2]> {
    Some([End::of(&joint.a, known)?, End::of(&joint.b, known)?])
}

/// Where an anchor is at the start.
struct End {
    /// World axes [m].
    point: DVec2,
    /// From the design frame to world axes.
    rotation: PlanarRotation,
}

impl End {
    /// `None` for a body that is not known, or has no centre of mass.
    fn of(anchor: &AnchorEntry, known: &BTreeMap<&str, &BodyEntry>) -> Option<Self> {
        match anchor {
            AnchorEntry::World { point } => Some(Self { point: *point, rotation: PlanarRotation::default() }),
            AnchorEntry::Body { name, point } => {
                let body = known.get(name.as_str())?;
                let rotation = PlanarRotation::from_degrees(body.angle_degrees);
                let centre = || match body.kind {
                    BodyKind::Dynamic => body_mass(body, &body.parts).map(|mass| mass.centre),
                    _ => Some(body.centre.unwrap_or(DVec2::ZERO)),
                };
                let point = point.or_else(centre)?;
                Some(Self { point: body.at + rotation.rotate(point), rotation })
            }
        }
    }
}
