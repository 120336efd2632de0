//! Bodies and their parts.

use std::collections::{BTreeMap, BTreeSet};

use tumble_math::{Bounds, Linear, Vector};

use super::{Findings, single_names};
use crate::diagnostics::Diagnostic;
use crate::dim::SceneDim;
use crate::expand::{MOST_BODIES, copies, count};
use crate::format::{BodyEntry, BodyKind, Groups, PartEntry, Repeat, Scene};
use crate::materials::MaterialLibrary;
use crate::path::ScenePath;
use crate::shapes::body_mass;

/// Group names a scene can tell apart, one bit each.
const MOST_GROUPS: usize = 32;

/// The names a scene may refer to.
pub(super) struct BodyNames {
    /// Single bodies, repeats unrolled.
    pub single: BTreeSet<String>,
    /// Names of repeated bodies, which stand for all their copies where that makes sense.
    pub families: BTreeSet<String>,
}

impl BodyNames {
    pub fn of<D: SceneDim>(scene: &Scene<D>) -> Self {
        let families = scene.bodies.iter().filter(|body| body.repeat.is_some()).map(|body| body.name.clone());
        Self { single: single_names(scene), families: families.collect() }
    }

    /// Reports a name that is neither that of a single body nor of a family.
    pub fn check_any(&self, path: &ScenePath, name: &str, found: &mut Findings) {
        if !self.single.contains(name) && !self.families.contains(name) {
            let allowed: Vec<&str> = self.families.union(&self.single).map(String::as_str).collect();
            found.unknown(path, "body", name, &allowed);
        }
    }

    /// Reports a name that is not that of a single body.
    pub fn check(&self, path: &ScenePath, name: &str, found: &mut Findings) {
        if self.single.contains(name) {
            return;
        }
        if self.families.contains(name) {
            let copy = self.single.iter().find(|single| single.starts_with(&format!("{name}-")));
            let label = copy.map_or_else(String::new, |copy| format!("name one of them, such as \"{copy}\""));
            return found.error(path, format!("\"{name}\" stands for many bodies"), label);
        }
        let allowed: Vec<&str> = self.single.iter().map(String::as_str).collect();
        found.unknown(path, "body", name, &allowed);
    }
}

pub(super) fn check<D: SceneDim>(scene: &Scene<D>, library: &MaterialLibrary, names: &BodyNames, found: &mut Findings) {
    let checker = Checker { scene, library, names };
    for (list, parts) in &scene.part_lists {
        let path = ScenePath::root().field("part_lists").key(list);
        for (index, part) in parts.iter().enumerate() {
            let path = path.index(index);
            match part.list() {
                Some(_) => found.error(&path, "a list of parts cannot contain another list", "write its parts here"),
                None => checker.part(&path, part, found),
            }
        }
    }
    for (index, body) in scene.bodies.iter().enumerate() {
        checker.body(&ScenePath::root().field("bodies").index(index), body, found);
    }
    unique_names(scene, found);
    groups(scene, found);
    length_scale(scene, found);
}

struct Checker<'s, D: SceneDim> {
    scene: &'s Scene<D>,
    library: &'s MaterialLibrary,
    names: &'s BodyNames,
}

impl<D: SceneDim> Checker<'_, D> {
    fn body(&self, path: &ScenePath, body: &BodyEntry<D>, found: &mut Findings) {
        if body.name.is_empty() || body.name.chars().any(char::is_control) {
            found.error(&path.field("name"), "a body needs a name", "empty, or with control characters");
        }
        self.material(&path.field("material"), body.material.as_deref(), found);
        for (index, part) in body.parts.iter().enumerate() {
            let path = path.field("parts").index(index);
            self.part(&path, part, found);
            self.part_of_body(&path, part, body, found);
        }
        if let Some(mass) = body.mass {
            found.positive(&path.field("mass"), &format!("the mass of \"{}\"", body.name), mass);
        }
        if let Some((message, label)) = body.inertia.as_ref().and_then(D::inertia_mistake) {
            found.error(&path.field("inertia"), format!("the inertia of \"{}\" {message}", body.name), label);
        }
        if let Some((field, label)) = D::rotation_mistake(body) {
            found.error(&path.field(field), format!("the {field} of \"{}\" has no direction", body.name), label);
        }
        found.not_negative(&path.field("drag").field("linear"), "linear drag", body.drag.linear);
        found.not_negative(&path.field("drag").field("quadratic"), "quadratic drag", body.drag.quadratic);
        found.not_negative(&path.field("drag").field("turning"), "drag against turning", body.drag.turning);
        self.mass(path, body, found);
        motion(path, body, found);
        repeat(path, body, found);
        for (index, other) in body.ignores.iter().enumerate() {
            let path = path.field("ignores").index(index);
            if *other == body.name && body.repeat.is_none() {
                found.error(&path, format!("\"{other}\" ignores itself"), "a body never collides with itself");
            } else {
                self.names.check_any(&path, other, found);
            }
        }
    }

    fn material(&self, path: &ScenePath, material: Option<&str>, found: &mut Findings) {
        if let Some(material) = material.filter(|material| !self.library.knows(material)) {
            let allowed: Vec<&str> = self.library.names().collect();
            found.unknown(path, "material", material, &allowed);
        }
    }

    /// Checks a part wherever it stands.
    fn part(&self, path: &ScenePath, part: &D::Part, found: &mut Findings) {
        self.material(&path.field("material"), part.shared().material, found);
        if let Err(error) = D::shapes(part) {
            found.error(path, "this part has no proper shape", error.to_string());
        }
        let (density, mass) = part.shared().density_and_mass;
        if let Some(density) = density {
            found.positive(&path.field("density"), "a density", density);
        }
        if let Some(mass) = mass {
            found.positive(&path.field("mass"), "a mass", mass);
        }
        if density.is_some() && mass.is_some() {
            let diagnostic = Diagnostic::error("a part has either a density or a mass")
                .about(path.field("mass"))
                .labelled("one of the two is too much")
                .also_about(path.field("density"), "the other");
            found.add(diagnostic);
        }
    }

    /// Checks whether a part suits the body it belongs to.
    fn part_of_body(&self, path: &ScenePath, part: &D::Part, body: &BodyEntry<D>, found: &mut Findings) {
        let mut parts = std::slice::from_ref(part);
        if let Some(name) = part.list() {
            match self.scene.part_lists.get(name) {
                Some(list) => parts = list,
                None => {
                    let allowed: Vec<&str> = self.scene.part_lists.keys().map(String::as_str).collect();
                    found.unknown(path, "list of parts", name, &allowed);
                }
            }
        }
        if let Some(ground) = parts.iter().find_map(PartEntry::without_mass)
            && body.kind == BodyKind::Dynamic
        {
            let message =
                format!("{ground} has no end and no mass, so the dynamic body \"{}\" cannot have one", body.name);
            found.error(path, message, "write `kind: Static` or `kind: Kinematic` for this body");
        }
    }

    /// Checks that a dynamic body has mass and inertia that can be computed with.
    fn mass(&self, path: &ScenePath, body: &BodyEntry<D>, found: &mut Findings) {
        let parts = self.scene.flat_parts(body);
        let is_sound = parts.iter().all(|part| {
            let (density, mass) = part.shared().density_and_mass;
            D::shapes(part).is_ok() && density.is_none_or(|density| density > 0.0) && mass.is_none_or(|mass| mass > 0.0)
        });
        let overrides_are_sound = body.mass.is_none_or(|mass| mass > 0.0)
            && body.inertia.as_ref().is_none_or(|inertia| D::inertia_mistake(inertia).is_none());
        let refers_well =
            body.parts.iter().all(|part| part.list().is_none_or(|name| self.scene.part_lists.contains_key(name)));
        if body.kind != BodyKind::Dynamic || !is_sound || !overrides_are_sound || !refers_well {
            return;
        }
        match body_mass(body, &parts) {
            Some(total) => {
                if let Some(label) = D::mass_mistake(&total) {
                    let message = format!("\"{}\" has a mass that cannot be computed with", body.name);
                    found.error(&path.field("name"), message, label);
                }
            }
            None if parts.iter().any(|part| part.without_mass().is_some()) => {}
            None => {
                let message = format!("the dynamic body \"{}\" has no mass", body.name);
                found.error(&path.field("parts"), message, "give it parts, or both `mass` and `inertia`");
            }
        }
    }
}

fn motion<D: SceneDim>(path: &ScenePath, body: &BodyEntry<D>, found: &mut Findings) {
    let moves = body.velocity != D::Vector::ZERO || body.angular_velocity != D::Angular::ZERO;
    let field = if body.velocity == D::Vector::ZERO { "angular_velocity" } else { "velocity" };
    if body.kind == BodyKind::Static && moves {
        found.error(
            &path.field(field),
            "a static body never moves",
            "write `kind: Kinematic` for a body that follows its velocity",
        );
    }
    let keyframes = &body.keyframes;
    if keyframes.is_empty() {
        return;
    }
    for (index, frame) in keyframes.iter().enumerate() {
        if D::keyframe_rotation(frame).is_none() {
            let path = path.field("keyframes").index(index).field("orientation");
            found.error(&path, "the orientation of a keyframe has no direction", "an axis or the quaternion is zero");
        }
    }
    if body.kind != BodyKind::Kinematic {
        found.error(
            &path.field("keyframes"),
            "only a kinematic body follows keyframes",
            "write `kind: Kinematic` for this body",
        );
    } else if moves {
        found.error(&path.field(field), "a body with keyframes takes its velocity from them", "remove this");
    }
    for (index, pair) in keyframes.windows(2).enumerate() {
        if pair[1].time <= pair[0].time {
            let path = path.field("keyframes").index(index + 1).field("time");
            found.error(
                &path,
                "times of keyframes must rise",
                format!("{} s does not come after {} s", pair[1].time, pair[0].time),
            );
        }
    }
}

fn repeat<D: SceneDim>(path: &ScenePath, body: &BodyEntry<D>, found: &mut Findings) {
    let Some(repeat) = &body.repeat else { return };
    let path = path.field("repeat");
    let jitter = match repeat {
        Repeat::Grid(grid) => grid.jitter,
        Repeat::Line(line) => line.jitter,
    };
    match count(body) {
        0 => found.error(&path.field("count"), "a repeated body needs at least one copy", "no copies"),
        1..=MOST_BODIES => {}
        many => {
            let message = format!("\"{}\" is repeated too often", body.name);
            found.error(&path.field("count"), message, format!("{many} copies; at most {MOST_BODIES} are allowed"));
        }
    }
    let least = (0..D::Vector::AXES).map(|axis| jitter.at[axis]).fold(f64::INFINITY, f64::min);
    found.not_negative(&path.field("jitter").field("at"), "jitter", least);
    found.not_negative(&path.field("jitter").field("angle_degrees"), "jitter", jitter.angle_degrees);
}

/// Reports names that two bodies share, copies of repeated bodies included.
fn unique_names<D: SceneDim>(scene: &Scene<D>, found: &mut Findings) {
    let mut taken: BTreeMap<String, usize> = BTreeMap::new();
    for (index, body) in scene.bodies.iter().enumerate().filter(|(_, body)| count(body) <= MOST_BODIES) {
        for copy in copies(body) {
            if let Some(&first) = taken.get(&copy.name) {
                let at = |index| ScenePath::root().field("bodies").index(index).field("name");
                let from_repeat = if body.repeat.is_some() || scene.bodies[first].repeat.is_some() {
                    ", repeats included"
                } else {
                    ""
                };
                let diagnostic = Diagnostic::error(format!("two bodies are named \"{}\"{from_repeat}", copy.name))
                    .about(at(index))
                    .labelled("again here")
                    .also_about(at(first), "first here");
                found.add(diagnostic);
                // One report per entry is enough.
                break;
            }
            taken.insert(copy.name, index);
        }
    }
    let total: u64 = scene.bodies.iter().map(count).fold(0, u64::saturating_add);
    if total > MOST_BODIES && scene.bodies.iter().all(|body| count(body) <= MOST_BODIES) {
        let path = ScenePath::root().field("bodies");
        found.error(
            &path,
            "the scene has too many bodies",
            format!("{total} of them; at most {MOST_BODIES} are allowed"),
        );
    }
}

/// Reports too many group names, and names beside bits.
fn groups<D: SceneDim>(scene: &Scene<D>, found: &mut Findings) {
    let mut names: BTreeSet<&str> = BTreeSet::new();
    let mut by_name: Option<ScenePath> = None;
    let mut by_bits: Option<ScenePath> = None;
    for (path, groups) in all_groups(scene) {
        match groups {
            Groups::Bits(u32::MAX) => {}
            Groups::Bits(_) => by_bits = by_bits.or(Some(path)),
            Groups::Names(list) => {
                names.extend(list.iter().map(String::as_str));
                if names.len() > MOST_GROUPS {
                    let message = format!("a scene can tell {MOST_GROUPS} collision groups apart");
                    return found.error(&path, message, format!("here the count reaches {}", names.len()));
                }
                by_name = by_name.or(Some(path));
            }
        }
    }
    if let (Some(by_name), Some(by_bits)) = (by_name, by_bits) {
        let diagnostic = Diagnostic::error("collision groups are given by name and as bits")
            .about(by_bits)
            .labelled("as bits here")
            .also_about(by_name, "by name here")
            .help("use one of the two throughout the scene");
        found.add(diagnostic);
    }
}

/// Every set of groups in a scene and where it stands.
fn all_groups<D: SceneDim>(scene: &Scene<D>) -> Vec<(ScenePath, &Groups)> {
    let mut all = Vec::new();
    for (index, body) in scene.bodies.iter().enumerate() {
        let path = ScenePath::root().field("bodies").index(index);
        all.push((path.field("groups"), &body.groups));
        all.push((path.field("collides_with"), &body.collides_with));
        for (index, part) in body.parts.iter().enumerate() {
            all.extend(groups_of_part(&path.field("parts").index(index), part));
        }
    }
    for (name, parts) in &scene.part_lists {
        let path = ScenePath::root().field("part_lists").key(name);
        for (index, part) in parts.iter().enumerate() {
            all.extend(groups_of_part(&path.index(index), part));
        }
    }
    all
}

fn groups_of_part<'p>(path: &ScenePath, part: &'p impl PartEntry) -> impl Iterator<Item = (ScenePath, &'p Groups)> {
    let (groups, collides_with) = part.shared().groups;
    let (in_groups, with_groups) = (path.field("groups"), path.field("collides_with"));
    [(in_groups, groups), (with_groups, collides_with)].into_iter().filter_map(|(path, groups)| Some((path, groups?)))
}

/// Warns if bodies are so small or large that the tolerances do not suit them.
fn length_scale<D: SceneDim>(scene: &Scene<D>, found: &mut Findings) {
    /// A body smaller than this many length scales is as small as ten slops.
    const SMALL: f64 = 0.05;
    /// Bodies all larger than this are simulated with needlessly fine tolerances.
    const LARGE: f64 = 100.0;
    if scene.length_scale <= 0.0 {
        return;
    }
    let mut sizes = Vec::new();
    for (index, body) in scene.bodies.iter().enumerate().filter(|(_, body)| body.kind == BodyKind::Dynamic) {
        let bounds = scene.flat_parts(body).iter().fold(Bounds::empty(), |bounds, part| {
            let shapes = D::shapes(part).unwrap_or_default();
            shapes.iter().filter_map(D::bounds).fold(bounds, Bounds::join)
        });
        let size = bounds.size();
        let size = (0..D::Vector::AXES).map(|axis| size[axis]).fold(f64::NEG_INFINITY, f64::max);
        if size.is_finite() && size > 0.0 {
            sizes.push((index, size / scene.length_scale, size));
        }
    }
    let path = |index| ScenePath::root().field("bodies").index(index).field("name");
    let help = "set `length_scale` to the size of a typical body";
    if let Some((index, _, size)) = sizes.iter().copied().find(|(_, relative, _)| *relative < SMALL) {
        let message =
            format!("\"{}\" is very small for a length scale of {} m", scene.bodies[index].name, scene.length_scale);
        let label = format!("{size} m across, so the default overlap left alone is more than a tenth of it");
        found.add(Diagnostic::warning(message).about(path(index)).labelled(label).help(help));
    } else if let Some((index, _, size)) =
        sizes.first().copied().filter(|_| sizes.iter().all(|(_, relative, _)| *relative > LARGE))
    {
        let message = format!("all dynamic bodies are very large for a length scale of {} m", scene.length_scale);
        found.add(Diagnostic::warning(message).about(path(index)).labelled(format!("{size} m across")).help(help));
    }
}
