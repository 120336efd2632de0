//! The separating axes of two boxes: the classic fifteen.
//!
//! With R the axes of b in those of a, t the vector between the centres and h the half extents (Gottschalk 1996),
//!
//! ```text
//! face of a    |t · a_i| − h_a,i − Σ h_b,j |R_ij|
//! face of b    |t · b_j| − h_b,j − Σ h_a,i |R_ij|
//! edges        |t · n| − Σ h_a,i |a_i · n| − Σ h_b,j |b_j · n|,   n = a_i × b_j / |a_i × b_j|
//! ```
//!
//! A box looks alike from both sides of an axis, so every one of these is a true separation, and no arcs need to be compared.

use glam::DVec3;
use tumble_shape::{ConvexHull, Cuboid};

use super::axis::{Axis, AxisOf, FlushFaces, Found, Limits, Search};
use super::place::Place;

/// Squared sine below which two edges count as parallel [1].
const PARALLEL: f64 = 1e-16;

/// Searches the axes of boxes a and b, b's frame standing in a's.
pub(super) fn search(a: &Cuboid, b: &Cuboid, b_in_a: &Place, limits: &Limits) -> Search {
    let (h_a, h_b) = (a.half_extents(), b.half_extents());
    // Everything along a's own axes.
    let frame = a.axes();
    let to_own = |v: DVec3| DVec3::new(frame.x_axis.dot(v), frame.y_axis.dot(v), frame.z_axis.dot(v));
    let t = to_own(b_in_a.point(b.centre()) - a.centre());
    let b_axes = b_in_a.axes * *b.axes();
    let r = [to_own(b_axes.x_axis), to_own(b_axes.y_axis), to_own(b_axes.z_axis)];
    let abs = r.map(DVec3::abs);

    let t_b = DVec3::new(r[0].dot(t), r[1].dot(t), r[2].dot(t));
    let along_a = t.abs() - h_a - (abs[0] * h_b.x + abs[1] * h_b.y + abs[2] * h_b.z);
    let along_b = t_b.abs() - h_b - DVec3::new(abs[0].dot(h_a), abs[1].dot(h_a), abs[2].dot(h_a));

    if let Some(i) = (0..3).find(|&i| along_a[i] > limits.margin) {
        return Search::Apart(frame.col(i) * 1.0_f64.copysign(t[i]));
    }
    if let Some(j) = (0..3).find(|&j| along_b[j] > limits.margin) {
        return Search::Apart(b_axes.col(j) * 1.0_f64.copysign(t_b[j]));
    }

    let mut flush = FlushFaces::NONE;
    let mut face_a = Axis { of: AxisOf::FaceA(0), normal: DVec3::ZERO, separation: f64::NEG_INFINITY };
    let mut face_b = face_a;
    for i in 0..3 {
        let upper = t[i] >= 0.0;
        let unit = frame.col(i);
        let normal = if upper { unit } else { -unit };
        flush.note(normal, along_a[i], limits);
        if along_a[i] > face_a.separation {
            face_a = Axis { of: AxisOf::FaceA(2 * i + usize::from(upper)), normal, separation: along_a[i] };
        }
    }
    for j in 0..3 {
        // The face of b that looks at a.
        let upper = t_b[j] < 0.0;
        let unit = b_axes.col(j);
        let normal = if upper { -unit } else { unit };
        flush.note(normal, along_b[j], limits);
        if along_b[j] > face_b.separation {
            face_b = Axis { of: AxisOf::FaceB(2 * j + usize::from(upper)), normal, separation: along_b[j] };
        }
    }

    let mut edges: Option<(f64, DVec3, usize, usize)> = None;
    let mut least = face_a.separation.max(face_b.separation);
    for j in 0..3 {
        let (j1, j2) = ((j + 1) % 3, (j + 2) % 3);
        let (u, u_abs, abs_1, abs_2) = (r[j], abs[j], abs[j1], abs[j2]);
        for i in 0..3 {
            // n = a_i × b_j has the components (0, −u_k, u_l) in the axes i, k, l.
            let (k, l) = ((i + 1) % 3, (i + 2) % 3);
            let squared = u[k] * u[k] + u[l] * u[l];
            if squared <= PARALLEL {
                continue;
            }
            let distance = (t[l] * u[k] - t[k] * u[l]).abs();
            // |b_j1 · (a_i × b_j)| = |a_i · b_j2|.
            let reach = h_a[k] * u_abs[l] + h_a[l] * u_abs[k] + h_b[j1] * abs_2[i] + h_b[j2] * abs_1[i];
            let scaled = distance - reach;
            // Compares without the root: scaled / √squared > least.
            let larger = if least >= 0.0 {
                scaled > 0.0 && scaled * scaled > least * least * squared
            } else {
                scaled >= 0.0 || scaled * scaled < least * least * squared
            };
            if larger {
                least = scaled / squared.sqrt();
                let mut n = DVec3::ZERO;
                n[k] = -u[l];
                n[l] = u[k];
                let sign = if n.dot(t) < 0.0 { -1.0 } else { 1.0 };
                edges = Some((least, n * (sign / squared.sqrt()), i, j));
            }
        }
    }
    let edges = edges.map(|(separation, n, i, j)| {
        let edge_a = edge_towards(a.hull(), i, n);
        let edge_b = edge_towards(b.hull(), j, -DVec3::new(r[0].dot(n), r[1].dot(n), r[2].dot(n)));
        Axis { of: AxisOf::Edges(edge_a, edge_b), normal: *frame * n, separation }
    });
    if let Some(axis) = edges.filter(|axis| axis.separation > limits.margin) {
        return Search::Apart(axis.normal);
    }
    Search::Near(Found { face_a, face_b, edges, flush })
}

/// The edge along a box's axis that is farthest in a direction given along the box's axes.
fn edge_towards(hull: &ConvexHull, axis: usize, direction: DVec3) -> usize {
    let corner = (0..3).filter(|&i| i != axis && direction[i] > 0.0).fold(0, |corner, i| corner | 1 << i);
    let ends = [corner, corner | 1 << axis];
    hull.edges().iter().position(|edge| edge.vertices == ends).unwrap_or(0)
}

/// The separation of two boxes along a unit vector from a to b, in a's frame [m].
pub(super) fn along(a: &Cuboid, b: &Cuboid, b_in_a: &Place, normal: DVec3) -> f64 {
    let reach = |cuboid: &Cuboid, direction: DVec3| {
        let seen = DVec3::new(
            cuboid.axes().x_axis.dot(direction),
            cuboid.axes().y_axis.dot(direction),
            cuboid.axes().z_axis.dot(direction),
        );
        seen.abs().dot(cuboid.half_extents())
    };
    let between = b_in_a.point(b.centre()) - a.centre();
    normal.dot(between) - reach(a, normal) - reach(b, b_in_a.unturned(normal))
}
