//! Core and core: separating axes, the side a thin rod remembers, and the rule against ghost bumps.
//!
//! The rules are told in [`super`].

use glam::DVec2;

use super::core::Owner;
use super::core::{Axis, Core, axes_of};
use super::corner;
use super::face::Cut;
use crate::manifold::{ContactKind, PlanarManifold};
use crate::narrow::PlanarQuery;

/// Cosine of the largest angle between the remembered normal and a side that may continue it [1].
const REMEMBERED: f64 = 0.5;

/// Share of the smaller core's length by which it may be beyond the other and still be put back [1].
const REACH_OF_MEMORY: f64 = 0.25;

/// Share of the flush tolerance by which b's side must be better than a's to become the reference side [1].
///
/// Without it, two sides lying flush would take turns from step to step.
const REFERENCE_PREFERENCE: f64 = 0.1;

/// How much of the flush tolerance still counts, so that an overlap equal to it is flush whatever rounding does [1].
const FLUSH_SLACK: f64 = 1.0 + 1e-6;

/// Rounding of heights above a side, relative to the size of the pair [1].
const ROUND_OFF: f64 = 1e-14;

/// Contact points of two cores.
pub(super) fn collide(a: &Core, b: &Core, origin: DVec2, query: &PlanarQuery) -> PlanarManifold {
    let previous = query.previous.filter(|previous| !previous.is_empty());
    if let Some(manifold) = previous.and_then(|previous| ends_in_line(a, b, previous, origin, query)) {
        return manifold;
    }
    let fallback = previous.map_or(DVec2::Y, |previous| previous.normal);
    let preference = REFERENCE_PREFERENCE * query.flush_tolerance;
    let candidates = Candidates::new(a, b, query.flush_tolerance * FLUSH_SLACK, preference);
    let Some(best) = candidates.best else {
        return corner::closest(a, b, fallback, origin, query.margin);
    };
    // A separation along any axis is a lower bound of the distance. Memory may still say that the shapes overlap.
    let remembers = previous.is_some() && (a.is_rod() || b.is_rod());
    if let Some(previous) = previous.filter(|_| remembers)
        && let Some(cut) = remembered_side(a, b, &best, previous)
    {
        return cut.manifold(origin, query.margin);
    }
    let out_of_reach = best.separation - a.radius - b.radius > query.margin;
    if out_of_reach || candidates.pass_corner_by_corner(a, b) {
        return PlanarManifold::EMPTY;
    }

    let cut = Cut::new(&best, a, b);
    let lowest = cut.lowest();
    // Two flat cores on one line have no separating side, and are apart when neither faces the other.
    let apart = best.separation > 0.0 || (a.is_flat() && b.is_flat() && lowest == f64::INFINITY);
    let tolerance = preference + ROUND_OFF * (best.separation.abs() + b.vertex(0).length() + a.vertex(0).length());
    if apart && lowest > best.separation + tolerance {
        return corner::closest(a, b, fallback, origin, query.margin);
    }
    if lowest == f64::INFINITY {
        // Overlapping, yet the facing side lies beside the reference side: the deepest corner alone.
        let corners = match best.owner {
            Owner::A => (best.side, best.support),
            Owner::B => (best.support, best.side),
        };
        return corner::along(a, b, corners, best.normal_a_to_b(), origin, query.margin);
    }
    cut.manifold(origin, query.margin)
}

/// The separating axes that matter.
struct Candidates {
    /// The one with the largest separation; of almost equal ones a's.
    best: Option<Axis>,
    /// Those with a separation within ± the flush tolerance. Shapes larger than the tolerance have at most two each, so that eight
    /// are plenty; more are left out.
    flush: [Option<Axis>; 8],
}

impl Candidates {
    #[inline]
    fn new(a: &Core, b: &Core, flush_tolerance: f64, preference: f64) -> Self {
        let mut candidates = Self { best: None, flush: [None; 8] };
        let mut flush_count = 0;
        let mut least = f64::NEG_INFINITY;
        for (owner, core, other) in [(Owner::A, a, b), (Owner::B, b, a)] {
            for axis in axes_of(owner, core, other) {
                if axis.separation > least {
                    least = axis.separation;
                    candidates.best = Some(axis);
                }
                if flush_tolerance > 0.0
                    && axis.separation.abs() <= flush_tolerance
                    && flush_count < candidates.flush.len()
                {
                    candidates.flush[flush_count] = Some(axis);
                    flush_count += 1;
                }
            }
            if owner == Owner::A {
                least += preference;
            }
        }
        candidates
    }

    /// Whether two sharp shapes pass each other corner by corner, no deeper than the flush tolerance.
    fn pass_corner_by_corner(&self, a: &Core, b: &Core) -> bool {
        let rule_holds = a.radius == 0.0 && b.radius == 0.0 && !(a.is_flat() && b.is_flat());
        let across_best = |axis: &Axis| self.best.is_some_and(|best| axis.is_across(&best));
        rule_holds && self.flush.iter().flatten().any(across_best)
    }
}

/// What a thin rod touches on the side it was on before, if memory has to decide.
fn remembered_side(a: &Core, b: &Core, best: &Axis, previous: &PlanarManifold) -> Option<Cut> {
    let agreement = |axis: &Axis| axis.normal_a_to_b().dot(previous.normal);
    // Apart and facing as before: geometry needs no help.
    if best.separation > 0.0 && agreement(best) >= 0.0 {
        return None;
    }
    let axes = axes_of(Owner::A, a, b).chain(axes_of(Owner::B, b, a));
    let remembered = axes
        .filter(|axis| agreement(axis) >= REMEMBERED)
        .reduce(|best, axis| if axis.separation > best.separation { axis } else { best })?;
    if best.separation > 0.0 {
        // Beyond each other: passed through a moment ago, if side faced corner then and does now, and not too far for that.
        let reach = REACH_OF_MEMORY * a.length().min(b.length());
        let faced = previous.points().iter().all(|point| point.kind.is_on_face());
        if remembered.separation < -reach || !faced || Cut::new(best, a, b).lowest() == f64::INFINITY {
            return None;
        }
    }
    let cut = Cut::new(&remembered, a, b);
    (cut.lowest() < f64::INFINITY).then_some(cut)
}

/// Two thin rods that met end to end and are still in line: the same ends along the same normal, near or a little through.
fn ends_in_line(
    a: &Core,
    b: &Core,
    previous: &PlanarManifold,
    origin: DVec2,
    query: &PlanarQuery,
) -> Option<PlanarManifold> {
    let [point] = previous.points() else { return None };
    if point.kind != ContactKind::VertexVertex || !(a.is_rod() && b.is_rod()) {
        return None;
    }
    let (i, j) = point.feature.as_vertices().filter(|&(i, j)| i < 2 && j < 2)?;
    let between = b.vertex(j) - a.vertex(i);
    let separation = previous.normal.dot(between);
    let in_line = previous.normal.perp_dot(between).abs() <= query.flush_tolerance;
    let reach = REACH_OF_MEMORY * a.length().min(b.length());
    let near = -reach <= separation && separation <= query.flush_tolerance;
    (in_line && near).then(|| corner::along(a, b, (i, j), previous.normal, origin, query.margin))
}
