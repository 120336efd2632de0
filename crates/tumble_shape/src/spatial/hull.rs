//! From a cloud of points to the polygons around it.
//!
//! 1. The points are put on a lattice of integers ([`lattice`]), without those that have another one nearly in the same place.
//! 2. Quickhull ([`quick`]) decides on integers which triangles are the hull: exactly, whatever the cloud.
//! 3. Triangles in one plane, to the tolerance, are merged to polygons ([`merge`]), now with the points as they were given.

mod lattice;
mod merge;
mod quick;

use glam::DVec3;
use tumble_math::Bounds;

use super::SpatialShapeError;
use lattice::LatticePoint;

/// Polygons of the hull of points, as numbers of the points, counter-clockwise seen from outside.
///
/// `relative_tolerance` times the longest side of the cloud's box counts as flat [1].
pub(super) fn polygons(points: &[DVec3], relative_tolerance: f64) -> Result<Vec<Vec<usize>>, SpatialShapeError> {
    if !points.iter().all(|point| point.is_finite()) {
        return Err(SpatialShapeError::NotFinite);
    }
    if !(1e-11..=1e-2).contains(&relative_tolerance) {
        return Err(SpatialShapeError::Tolerance { tolerance: relative_tolerance });
    }
    if points.len() < 4 {
        return Err(SpatialShapeError::TooFewPoints { count: points.len() });
    }
    let bounds = Bounds::around(points.iter().copied());
    let extent = bounds.size().max_element();
    // What is smaller than this against its distance from the origin is rounding.
    let rounding = 8.0 * f64::EPSILON * (bounds.min.abs().max(bounds.max.abs())).max_element();
    let tolerance = (relative_tolerance * extent).max(rounding);
    if extent <= 4.0 * tolerance || !extent.is_finite() {
        let one_place = SpatialShapeError::OnePlace { tolerance };
        return Err(if extent.is_finite() { one_place } else { SpatialShapeError::NotFinite });
    }

    let lattice = lattice::snap(points, bounds.centre(), extent);
    let first = first_four(points, &lattice, tolerance)?;
    let distinct = apart(points, first, 4.0 * tolerance);
    let kept: Vec<LatticePoint> = distinct.iter().map(|&i| lattice[i]).collect();
    let places: Vec<DVec3> = distinct.iter().map(|&i| points[i]).collect();
    let number = |i: usize| distinct.binary_search(&i).unwrap_or(0);
    let triangles = quick::triangulate(&kept, first.map(number));
    let merged = merge::polygons(&places, &triangles, tolerance);
    let polygons = merged.unwrap_or_else(|| triangles.iter().map(|triangle| triangle.corners.to_vec()).collect());
    let original = |polygon: Vec<usize>| polygon.into_iter().map(|i| distinct[i]).collect();
    Ok(polygons.into_iter().map(original).collect())
}

/// Four points that span a volume: two far apart, one far from their line, one far from the plane of the three.
fn first_four(points: &[DVec3], lattice: &[LatticePoint], tolerance: f64) -> Result<[usize; 4], SpatialShapeError> {
    let farthest = |measure: &dyn Fn(DVec3) -> f64| {
        let mut best = (0, f64::NEG_INFINITY);
        for (i, &point) in points.iter().enumerate() {
            let value = measure(point);
            if value > best.1 {
                best = (i, value);
            }
        }
        best
    };
    let (a, _) = farthest(&|p| -p.x);
    let (b, _) = farthest(&|p| p.distance_squared(points[a]));
    let along = (points[b] - points[a]).normalize_or_zero();
    let (c, from_line) = farthest(&|p| (p - points[a]).cross(along).length());
    if from_line <= 4.0 * tolerance {
        return Err(SpatialShapeError::OneLine { tolerance });
    }
    let normal = along.cross(points[c] - points[a]).normalize_or_zero();
    let (d, from_plane) = farthest(&|p| normal.dot(p - points[a]).abs());
    let flat = lattice::height(lattice::normal(lattice[a], lattice[b], lattice[c]), lattice[a], lattice[d]) == 0;
    if from_plane <= 4.0 * tolerance || flat {
        return Err(SpatialShapeError::OnePlane { tolerance });
    }
    Ok([a, b, c, d])
}

/// Numbers of the points that are further apart than a distance [m], in order. Of near ones the first stays, but always those to
/// begin with.
fn apart(points: &[DVec3], first: [usize; 4], distance: f64) -> Vec<usize> {
    let rest = |i: usize| !first.contains(&i);
    let mut by_x: Vec<usize> = (0..points.len()).collect();
    by_x.sort_by(|&i, &j| points[i].x.total_cmp(&points[j].x).then(i.cmp(&j)));
    let mut place = vec![0; points.len()];
    by_x.iter().enumerate().for_each(|(at, &i)| place[i] = at);

    let mut kept = vec![false; points.len()];
    let candidates = first.into_iter().chain((0..points.len()).filter(|&i| rest(i)));
    for i in candidates {
        let near = |&j: &usize| kept[j] && points[j].distance_squared(points[i]) <= distance * distance;
        let within = |&&j: &&usize| (points[j].x - points[i].x).abs() <= distance;
        let mut before = by_x[..place[i]].iter().rev().take_while(within);
        let mut after = by_x[place[i] + 1..].iter().take_while(within);
        kept[i] = !(before.any(near) || after.any(near));
    }
    (0..points.len()).filter(|&i| kept[i]).collect()
}
