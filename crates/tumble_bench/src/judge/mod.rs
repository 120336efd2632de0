//! How well a scene kept its bodies apart, from poses alone, by the same rules for every engine.
//!
//! Every shape is a convex core rounded by a radius. Overlapping cores are measured by separating axes, cores apart by their distance; see
//! [`planar`] and [`spatial`]. No engine's own contacts are asked.

pub mod planar;
pub mod spatial;

use tumble_math::{Bounds, Linear, Pose, Vector};

use crate::plan::{Kind, Plan, PlanDim};

/// Parts nearer than this touch [m].
pub const TOUCHING: f64 = 0.01;

/// What the judge finds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Verdict {
    /// Pairs of parts, on different bodies and one of them dynamic, that touch.
    pub touching: usize,
    /// Deepest overlap; NaN where a pose is not finite [m].
    pub max_overlap: f64,
    /// Mean overlap of the touching pairs; NaN where a pose is not finite [m].
    pub mean_overlap: f64,
}

/// A part of a body where it is.
struct Piece<D: PlanDim> {
    body: usize,
    kind: Kind,
    core: D::Core,
    bounds: Bounds<D::Vector>,
}

/// Looks at the bodies of a plan in these poses.
pub fn judge<D: PlanDim>(plan: &Plan<D>, poses: &[Pose<D>]) -> Verdict {
    let mut pieces: Vec<Piece<D>> = Vec::new();
    for (body, (entry, pose)) in plan.bodies.iter().zip(poses).enumerate() {
        for part in &entry.parts {
            let core = D::core(&part.shape, |point| pose.transform_point(part.pose.transform_point(point)));
            let bounds = D::bounds(&core).grown(0.5 * TOUCHING);
            if !bounds.min.is_finite() || !bounds.max.is_finite() {
                return Verdict { touching: 0, max_overlap: f64::NAN, mean_overlap: f64::NAN };
            }
            pieces.push(Piece { body, kind: entry.kind, core, bounds });
        }
    }
    // From left to right: a piece can touch those to its right until they begin beyond its right end.
    pieces.sort_by(|one, other| one.bounds.min[0].total_cmp(&other.bounds.min[0]));
    let mut verdict = Verdict::default();
    let mut sum = 0.0;
    for (i, one) in pieces.iter().enumerate() {
        for other in pieces[i + 1..].iter().take_while(|other| other.bounds.min[0] <= one.bounds.max[0]) {
            let one_moves = one.kind == Kind::Dynamic || other.kind == Kind::Dynamic;
            if !one_moves || one.body == other.body || !one.bounds.overlaps(&other.bounds) {
                continue;
            }
            let separation = D::separation(&one.core, &other.core);
            if separation < TOUCHING {
                let overlap = (-separation).max(0.0);
                verdict.touching += 1;
                verdict.max_overlap = verdict.max_overlap.max(overlap);
                sum += overlap;
            }
        }
    }
    verdict.mean_overlap = sum / verdict.touching.max(1) as f64;
    verdict
}

/// Largest gap between the shadows of two sets of points on an axis: negative when they overlap [m].
fn gap<V: Vector>(a: &[V], b: &[V], axis: V) -> f64 {
    let ((a_low, a_high), (b_low, b_high)) = (shadow(a, axis), shadow(b, axis));
    (b_low - a_high).max(a_low - b_high)
}

fn shadow<V: Vector>(points: &[V], axis: V) -> (f64, f64) {
    points
        .iter()
        .map(|point| point.dot(axis))
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), along| (low.min(along), high.max(along)))
}
