//! Triangles to pixels.

use glam::{DVec2, DVec3};

/// A pixel that a triangle covers.
#[derive(Clone, Copy, Debug)]
pub struct Fragment {
    /// Index of the pixel, row by row.
    pub pixel: usize,
    /// Depth: one over the distance [1/m].
    pub depth: f64,
    /// Weights of the three corners, corrected for perspective.
    pub weights: [f64; 3],
}

/// Calls a function for each pixel whose centre lies in a triangle; both windings count.
pub fn fill(corners: &[DVec3; 3], width: usize, height: usize, mut paint: impl FnMut(Fragment)) {
    let [a, b, c] = corners.map(|corner| corner.truncate());
    let area = (b - a).perp_dot(c - a);
    if area == 0.0 || !area.is_finite() {
        return;
    }
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    let range = |low: f64, high: f64, count: usize| {
        let first = (low - 0.5).ceil().max(0.0);
        let last = (high - 0.5).floor().min(count as f64 - 1.0);
        (first <= last).then_some(first as usize..=last as usize)
    };
    let (Some(columns), Some(rows)) = (range(low.x, high.x, width), range(low.y, high.y, height)) else { return };
    for row in rows {
        for column in columns.clone() {
            let at = DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
            let w0 = (b - at).perp_dot(c - at) / area;
            let w1 = (c - at).perp_dot(a - at) / area;
            let w2 = 1.0 - w0 - w1;
            if w0 < 0.0 || w1 < 0.0 || w2 < 0.0 {
                continue;
            }
            let parts = [w0 * corners[0].z, w1 * corners[1].z, w2 * corners[2].z];
            let depth = parts[0] + parts[1] + parts[2];
            paint(Fragment { pixel: row * width + column, depth, weights: parts.map(|part| part / depth) });
        }
    }
}

/// Cuts off what is nearer to the camera than a distance; points are as the camera sees them, z away from it.
pub fn cut_near(polygon: &[(DVec3, DVec3, f64)], near: f64) -> Vec<(DVec3, DVec3, f64)> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (index, from) in polygon.iter().enumerate() {
        let to = &polygon[(index + 1) % polygon.len()];
        if from.0.z >= near {
            kept.push(*from);
        }
        if (from.0.z >= near) != (to.0.z >= near) {
            let share = (near - from.0.z) / (to.0.z - from.0.z);
            kept.push((from.0.lerp(to.0, share), from.1.lerp(to.1, share), from.2 + share * (to.2 - from.2)));
        }
    }
    kept
}
