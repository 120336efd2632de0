//! Joints: that they hold two things of which one can move, and that they fit at the start.

use std::collections::BTreeMap;

use tumble_math::{Linear, Rotation, Vector};

use super::Findings;
use super::bodies::BodyNames;
use crate::diagnostics::Diagnostic;
use crate::dim::{SceneDim, Shown};
use crate::expand::{ExpandedBody, MOST_BODIES, count};
use crate::format::{AnchorEntry, BodyEntry, BodyKind, JointEntry, JointKindEntry, Scene};
use crate::path::ScenePath;
use crate::shapes::body_mass;

pub(super) fn check<D: SceneDim>(scene: &Scene<D>, bodies: &BodyNames, found: &mut Findings) {
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

fn name<'s, D: SceneDim>(
    joint: &'s JointEntry<D>,
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
fn ends<D: SceneDim>(
    joint: &JointEntry<D>,
    path: &ScenePath,
    bodies: &BodyNames,
    known: &BTreeMap<&str, &BodyEntry<D>>,
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
            let is_moved = |anchor: &AnchorEntry<D>| match anchor {
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

fn quantities<D: SceneDim>(joint: &JointEntry<D>, path: &ScenePath, found: &mut Findings) {
    let path = path.field("kind");
    if let Some(Some(length)) = joint.kind.length() {
        found.positive(&path.field("length"), &format!("the length of joint \"{}\"", joint.name), length);
    }
    if D::joint_axis(&joint.kind).is_some_and(|axis| axis.try_normalize().is_none()) {
        let message = format!("the axis of joint \"{}\" has no direction", joint.name);
        found.error(&path.field("axis"), message, format!("it must not be {}", Shown(D::Vector::ZERO, 0)));
    }
}

/// Reports a joint that does not fit at the start.
fn fit<D: SceneDim>(
    joint: &JointEntry<D>,
    path: &ScenePath,
    known: &BTreeMap<&str, &BodyEntry<D>>,
    scene: &Scene<D>,
    found: &mut Findings,
) {
    let Some([a, b]) = both_ends(joint, known) else { return };
    if joint.kind.length() == Some(None) && a.point == b.point {
        let message = format!("the length of joint \"{}\" must be positive", joint.name);
        return found.error(&path.field("kind"), message, "the anchors coincide at the start");
    }
    let (gap, slop) = (gap(joint, &a, &b), scene.slop_or_default());
    if gap > slop && !joint.allow_gap {
        let [at_a, at_b] = [a.point, b.point].map(|point| Shown(point, 6));
        let diagnostic = Diagnostic::error(format!("joint \"{}\" is open by {gap:.3e} m at the start", joint.name))
            .about(path.field("name"))
            .labelled(format!("it holds {at_a} and {at_b}; the slop is {slop} m"))
            .help("move the bodies or the anchors, or say `allow_gap: true`");
        found.add(diagnostic);
    }
}

/// Indices of the joints of a sound scene that are open by more than the slop.
pub(crate) fn open_joints<D: SceneDim>(scene: &Scene<D>) -> Vec<usize> {
    let expanded = scene.expand();
    let known = by_name(&expanded);
    let is_open = |joint: &JointEntry<D>| {
        both_ends(joint, &known).is_some_and(|[a, b]| gap(joint, &a, &b) > scene.slop_or_default())
    };
    (0..scene.joints.len()).filter(|&index| is_open(&scene.joints[index])).collect()
}

/// By how much the anchors are not where the joint wants them [m].
fn gap<D: SceneDim>(joint: &JointEntry<D>, a: &End<D>, b: &End<D>) -> f64 {
    D::joint_gap(&joint.kind, b.point - a.point, &a.rotation)
}

fn by_name<D: SceneDim>(expanded: &[ExpandedBody<D>]) -> BTreeMap<&str, &BodyEntry<D>> {
    expanded.iter().map(|body| (body.body.name.as_str(), &body.body)).collect()
}

fn both_ends<D: SceneDim>(joint: &JointEntry<D>, known: &BTreeMap<&str, &BodyEntry<D>>) -> Option<[End<D>; 2]> {
    Some([End::of(&joint.a, known)?, End::of(&joint.b, known)?])
}

/// Where an anchor is at the start.
struct End<D: SceneDim> {
    /// World axes [m].
    point: D::Vector,
    /// From the design frame to world axes.
    rotation: D::Rotation,
}

impl<D: SceneDim> End<D> {
    /// `None` for a body that is not known, or has no centre of mass.
    fn of(anchor: &AnchorEntry<D>, known: &BTreeMap<&str, &BodyEntry<D>>) -> Option<Self> {
        match anchor {
            AnchorEntry::World { point } => Some(Self { point: *point, rotation: D::Rotation::default() }),
            AnchorEntry::Body { name, point } => {
                let body = known.get(name.as_str())?;
                let rotation = D::design_rotation(body);
                let centre = || match body.kind {
                    BodyKind::Dynamic => body_mass(body, &body.parts).map(|mass| mass.centre),
                    _ => Some(body.centre.unwrap_or(D::Vector::ZERO)),
                };
                let point = point.or_else(centre)?;
                Some(Self { point: body.at + rotation.rotate(point), rotation })
            }
        }
    }
}
