//! Separation in the plane: of points, lines and boxes that are rounded by a radius.
//!
//! Cores that share a point are at least as deep in each other as on the axis where it is least; for convex polygons that axis is the
//! normal of a side. A line has four: across it both ways, and along it both ways. Cores apart are as far from each other as their sides.

use glam::DVec2;

use super::gap;

/// A convex core.
#[derive(Clone, Debug)]
pub struct Core {
    /// Its corners, counter-clockwise: one, two or more [m].
    pub corners: Vec<DVec2>,
    /// The radius by which it is rounded [m].
    pub radius: f64,
}

impl Core {
    /// Its sides; a point is a side without length.
    fn sides(&self) -> impl Iterator<Item = [DVec2; 2]> + '_ {
        let count = self.corners.len();
        (0..count).map(move |i| [self.corners[i], self.corners[(i + 1) % count]])
    }

    /// Unit vectors on which a gap shows if there is one.
    fn axes(&self) -> impl Iterator<Item = DVec2> + '_ {
        let is_line = self.corners.len() == 2;
        let along = self.sides().filter_map(|[from, to]| (to - from).try_normalize());
        along.flat_map(move |along| [Some(along.perp()), is_line.then_some(along)].into_iter().flatten())
    }
}

/// How far apart two cores are, negative when they overlap [m].
pub fn separation(a: &Core, b: &Core) -> f64 {
    let axes = a.axes().chain(b.axes());
    let widest = axes.map(|axis| gap(&a.corners, &b.corners, axis)).fold(f64::NEG_INFINITY, f64::max);
    let two_points = widest == f64::NEG_INFINITY;
    let apart = if widest > 0.0 || two_points { distance(a, b) } else { widest };
    apart - a.radius - b.radius
}

/// Distance of two cores that share no point [m].
fn distance(a: &Core, b: &Core) -> f64 {
    let mut nearest = f64::INFINITY;
    for [a_from, a_to] in a.sides() {
        for [b_from, b_to] in b.sides() {
            // Of two lines that do not cross, one end is nearest.
            let ends =
                [(a_from, [b_from, b_to]), (a_to, [b_from, b_to]), (b_from, [a_from, a_to]), (b_to, [a_from, a_to])];
            for (end, line) in ends {
                nearest = nearest.min(end.distance(nearest_on(line, end)));
            }
        }
    }
    nearest
}

fn nearest_on([from, to]: [DVec2; 2], point: DVec2) -> DVec2 {
    let along = to - from;
    let squared = along.length_squared();
    if squared == 0.0 {
        return from;
    }
    from + along * ((point - from).dot(along) / squared).clamp(0.0, 1.0)
}
