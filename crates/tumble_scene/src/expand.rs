//! From what a scene writes to the bodies it means: repeats unrolled, part lists filled in, jitter drawn.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use tumble_math::{Linear, Planar, Vector};
use xxhash_rust::xxh3::xxh3_64;

use crate::dim::SceneDim;
use crate::format::{AsCounts, BodyEntry, Dialect, Jitter, PartEntry, Repeat, Scene};

/// Bodies that a scene may expand to.
pub const MOST_BODIES: u64 = 1_000_000;

/// One body of the flat list.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpandedBody<D: SceneDim = Planar> {
    /// Its index in the scene's list of bodies, for messages.
    pub entry: usize,
    /// The body without `repeat` and without part lists; `ignores` names single bodies.
    pub body: BodyEntry<D>,
}

impl<D: SceneDim> Scene<D> {
    /// All bodies, sorted by name, so that the index of a body is its id.
    ///
    /// Lists that do not exist contribute no parts; validation has refused such scenes.
    pub fn expand(&self) -> Vec<ExpandedBody<D>> {
        let mut expanded: Vec<ExpandedBody<D>> = Vec::new();
        for (index, entry) in self.bodies.iter().enumerate() {
            let ignores: Vec<String> = entry.ignores.iter().flat_map(|name| self.names_meant_by(name)).collect();
            let parts = self.flat_parts(entry);
            for copy in copies(entry) {
                let (moved, turned_degrees) = jitter(self.seed, &copy.name, copy.jitter);
                let mut body = BodyEntry {
                    name: copy.name,
                    parts: parts.clone(),
                    ignores: ignores.clone(),
                    repeat: None,
                    ..entry.clone()
                };
                D::displace(&mut body, copy.offset + moved, turned_degrees);
                expanded.push(ExpandedBody { entry: index, body });
            }
        }
        expanded.sort_by(|a, b| a.body.name.cmp(&b.body.name));
        expanded
    }

    /// Names of the single bodies that a name stands for: itself, or all copies of a repeated body.
    pub fn names_meant_by(&self, name: &str) -> Vec<String> {
        match self.bodies.iter().find(|entry| entry.name == name && entry.repeat.is_some()) {
            Some(entry) => copies(entry).map(|copy| copy.name).collect(),
            None => vec![name.to_owned()],
        }
    }

    /// The parts of a body with those of the lists it names.
    pub fn flat_parts(&self, entry: &BodyEntry<D>) -> Vec<D::Part> {
        self.parts_of(entry).cloned().collect()
    }

    /// The parts of a body with those of the lists it names, where they stand in the scene.
    pub(crate) fn parts_of<'s>(&'s self, entry: &'s BodyEntry<D>) -> impl Iterator<Item = &'s D::Part> {
        entry.parts.iter().flat_map(|part| match part.list() {
            Some(name) => self.part_lists.get(name).map_or(&[][..], Vec::as_slice),
            None => std::slice::from_ref(part),
        })
    }
}

/// A copy of a repeated body, before jitter.
pub(crate) struct Copy<D: Dialect> {
    pub name: String,
    pub offset: D::Vector,
    pub jitter: Jitter<D>,
}

/// Number of bodies an entry stands for.
pub(crate) fn count<D: Dialect>(entry: &BodyEntry<D>) -> u64 {
    match &entry.repeat {
        None => 1,
        Some(Repeat::Grid(grid)) => grid.count.counts().into_iter().map(u64::from).fold(1, u64::saturating_mul),
        Some(Repeat::Line(line)) => u64::from(line.count),
    }
}

/// All copies of an entry, or the body itself.
pub(crate) fn copies<D: Dialect>(entry: &BodyEntry<D>) -> Box<dyn Iterator<Item = Copy<D>> + '_> {
    let name = &entry.name;
    match &entry.repeat {
        None => {
            Box::new(std::iter::once(Copy { name: name.clone(), offset: D::Vector::ZERO, jitter: Jitter::default() }))
        }
        Some(Repeat::Grid(grid)) => Box::new(cells(grid.count.counts()).map(move |cell| {
            let mut steps = D::Vector::ZERO;
            let mut name = name.clone();
            for (axis, number) in cell.into_iter().enumerate() {
                steps[axis] = f64::from(number);
                name += &format!("-{number}");
            }
            Copy { name, offset: grid.spacing.scale_by(steps), jitter: grid.jitter }
        })),
        Some(Repeat::Line(line)) => Box::new((0..line.count).map(move |index| Copy {
            name: format!("{name}-{index}"),
            offset: line.spacing * f64::from(index),
            jitter: line.jitter,
        })),
    }
}

/// Every cell of a grid with so many cells along each axis, the last axis first.
fn cells(counts: Vec<u32>) -> impl Iterator<Item = Vec<u32>> {
    let total: u64 = counts.iter().copied().map(u64::from).product();
    (0..total).map(move |index| {
        let mut rest = index;
        let mut cell: Vec<u32> = counts
            .iter()
            .rev()
            .map(|&count| {
                let number = rest % u64::from(count);
                rest /= u64::from(count);
                number as u32
            })
            .collect();
        cell.reverse();
        cell
    })
}

/// Displacement [m] and turn [degrees] of a copy. Each name has a random stream of its own, so neither the order of the file nor the number of
/// copies changes where a copy stands.
fn jitter<D: SceneDim>(seed: u64, name: &str, jitter: Jitter<D>) -> (D::Vector, D::Angular) {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(xxh3_64(name.as_bytes()));
    let mut shares = D::Vector::ZERO;
    for axis in 0..D::Vector::AXES {
        shares[axis] = symmetric(&mut random);
    }
    (jitter.at.scale_by(shares), D::random_turn(jitter.angle_degrees, || symmetric(&mut random)))
}

/// A number from −1 to 1, a multiple of 2⁻⁵².
fn symmetric(random: &mut ChaCha8Rng) -> f64 {
    const HALF_RANGE: f64 = (1_u64 << 52) as f64;
    (random.next_u64() >> 11) as f64 / HALF_RANGE - 1.0
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, dvec2};

    use super::*;
    use crate::format::{Part, RepeatGrid, RepeatLine, RodPart};

    fn grid(count: (u32, u32), jitter: Jitter) -> BodyEntry {
        let repeat = Some(Repeat::Grid(RepeatGrid { count, spacing: dvec2(2.0, 3.0), jitter }));
        BodyEntry { name: "crate".into(), at: dvec2(10.0, 20.0), repeat, ..BodyEntry::default() }
    }

    fn named<'b>(bodies: &'b [ExpandedBody], name: &str) -> &'b BodyEntry {
        &bodies.iter().find(|body| body.body.name == name).expect("the name exists").body
    }

    #[test]
    fn grid_counts_columns_then_rows_from_where_the_body_stands() {
        let bodies = Scene { bodies: vec![grid((3, 4), Jitter::default())], ..Scene::default() }.expand();
        assert_eq!(bodies.len(), 12);
        assert_eq!(named(&bodies, "crate-0-0").at, dvec2(10.0, 20.0));
        assert_eq!(named(&bodies, "crate-2-3").at, dvec2(14.0, 29.0));
    }

    #[test]
    fn line_repeats_along_its_spacing_and_ids_are_ranks_of_names() {
        let line = RepeatLine { count: 11, spacing: dvec2(0.5, 0.0), jitter: Jitter::default() };
        let body = BodyEntry { name: "d".into(), repeat: Some(Repeat::Line(line)), ..BodyEntry::default() };
        let bodies = Scene { bodies: vec![body], ..Scene::default() }.expand();
        let names: Vec<&str> = bodies.iter().map(|body| body.body.name.as_str()).collect();
        assert_eq!(names, ["d-0", "d-1", "d-10", "d-2", "d-3", "d-4", "d-5", "d-6", "d-7", "d-8", "d-9"]);
        assert_eq!(bodies[2].body.at, dvec2(5.0, 0.0));
    }

    #[test]
    fn jitter_stays_within_bounds_and_depends_on_seed_and_name_alone() {
        let shaken = Jitter { at: dvec2(0.1, 0.0), angle_degrees: 5.0 };
        let expand = |seed, count| Scene { seed, bodies: vec![grid(count, shaken)], ..Scene::default() }.expand();
        let small = expand(7, (2, 2));
        let large = expand(7, (20, 20));
        assert_eq!(named(&small, "crate-1-1"), named(&large, "crate-1-1"));
        assert_ne!(named(&small, "crate-1-1"), named(&expand(8, (2, 2)), "crate-1-1"));
        let plain = Scene { bodies: vec![grid((20, 20), Jitter::default())], ..Scene::default() }.expand();
        let mut widest = DVec2::ZERO;
        for (with, without) in large.iter().zip(&plain) {
            widest = widest.max((with.body.at - without.body.at).abs());
            assert!(with.body.angle_degrees.abs() <= 5.0);
        }
        // Of 400 uniform draws the largest is below 95 % of the bound with probability 0.95^400 ≈ 1e-9.
        assert!(widest.x <= 0.1 + 1e-14 && widest.x > 0.095 && widest.y == 0.0, "{widest}");
    }

    #[test]
    fn the_draws_never_change() {
        // Golden figures: another generator or another order of draws would move every jittered scene.
        let (moved, turned) = jitter::<Planar>(0, "crate-0-0", Jitter { at: DVec2::ONE, angle_degrees: 1.0 });
        assert_eq!((moved.x, moved.y, turned), (0.7053920516291847, -0.5138157193870596, 0.8397653889198375));
    }

    #[test]
    fn part_lists_are_filled_in_and_ignored_families_spelled_out() {
        let rod = Part::Rod(RodPart { to: dvec2(1.0, 0.0), ..RodPart::default() });
        let mut scene = Scene { bodies: vec![grid((1, 2), Jitter::default())], ..Scene::default() };
        scene.part_lists.insert("hammer".into(), vec![rod.clone(), rod.clone()]);
        let parts = vec![Part::List("hammer".into()), rod.clone()];
        let floor = BodyEntry { name: "floor".into(), parts, ignores: vec!["crate".into()], ..BodyEntry::default() };
        scene.bodies.push(floor);
        let bodies = scene.expand();
        assert_eq!(named(&bodies, "floor").parts, vec![rod; 3]);
        assert_eq!(named(&bodies, "floor").ignores, ["crate-0-0", "crate-0-1"]);
    }
}
