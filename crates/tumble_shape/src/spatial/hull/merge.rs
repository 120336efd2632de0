//! Triangles that lie in one plane, to a tolerance, become one polygon.
//!
//! ```text
//!    ┌─────────┐        The largest triangle left begins a region; neighbours join as long as
//!    │ ╲   1  ╱│        all their corners lie within the tolerance of its plane. The border of
//!    │  ╲  · ╱ │        the region is the polygon: points inside it (·) are dropped, and so
//!    │ 1 ╲ ╱ 1 │        are points in the middle of a straight side, which only two regions share.
//!    └─────────┘
//! ```

use glam::DVec3;

use super::quick::Triangle;

/// No region yet, or no corner.
const NONE: usize = usize::MAX;

/// Polygons, each as the numbers of its corners, counter-clockwise seen from outside; `None` when the regions make no polyhedron.
pub(super) fn polygons(points: &[DVec3], triangles: &[Triangle], tolerance: f64) -> Option<Vec<Vec<usize>>> {
    let (region_of, regions) = regions(points, triangles, tolerance);
    if region_of.contains(&NONE) {
        return None;
    }
    let mut loops = Vec::with_capacity(regions);
    for region in 0..regions {
        loops.push(border(triangles, &region_of, region, points.len())?);
    }
    // A corner of a polyhedron has three polygons or more around it.
    let mut around = vec![0_u32; points.len()];
    for &corner in loops.iter().flatten() {
        around[corner] += 1;
    }
    for polygon in &mut loops {
        polygon.retain(|&corner| around[corner] >= 3);
    }
    let corners = around.iter().filter(|&&count| count >= 3).count();
    let sides: usize = loops.iter().map(Vec::len).sum();
    // Euler: corners − edges + faces = 2, with every edge counted twice as a side.
    let closed = 2 * (corners + loops.len()) == sides + 4;
    (closed && loops.len() >= 4 && loops.iter().all(|polygon| polygon.len() >= 3)).then_some(loops)
}

/// The region of every triangle, and the number of regions.
fn regions(points: &[DVec3], triangles: &[Triangle], tolerance: f64) -> (Vec<usize>, usize) {
    let places = |triangle: &Triangle| triangle.corners.map(|corner| points[corner]);
    let twice_area = |triangle: &Triangle| {
        let [a, b, c] = places(triangle);
        (b - a).cross(c - a)
    };
    let mut by_size: Vec<usize> = (0..triangles.len()).collect();
    let sizes: Vec<f64> = triangles.iter().map(|triangle| twice_area(triangle).length_squared()).collect();
    by_size.sort_by(|&one, &other| sizes[other].total_cmp(&sizes[one]).then(one.cmp(&other)));
    let thin: Vec<Option<usize>> =
        triangles.iter().map(|triangle| across_longest_side(places(triangle), triangle, tolerance)).collect();

    let mut region_of = vec![NONE; triangles.len()];
    let mut count = 0;
    for seed in by_size {
        if region_of[seed] != NONE || thin[seed].is_some() {
            continue;
        }
        let normal = twice_area(&triangles[seed]).normalize_or_zero();
        let on = points[triangles[seed].corners[0]];
        region_of[seed] = count;
        let mut stack = vec![seed];
        while let Some(triangle) = stack.pop() {
            for across in triangles[triangle].neighbours {
                let flat = || places(&triangles[across]).iter().all(|&p| normal.dot(p - on).abs() <= tolerance);
                if region_of[across] == NONE && flat() {
                    region_of[across] = count;
                    stack.push(across);
                }
            }
        }
        count += 1;
    }
    join_thin(triangles, &thin, &mut region_of);
    (region_of, count)
}

/// Gives the triangles without a plane of their own to the region across their longest side, or to any other that has one.
fn join_thin(triangles: &[Triangle], thin: &[Option<usize>], region_of: &mut [usize]) {
    loop {
        let left: Vec<usize> = (0..triangles.len()).filter(|&triangle| region_of[triangle] == NONE).collect();
        let mut joined = false;
        for &triangle in &left {
            let region = thin[triangle].map_or(NONE, |across| region_of[across]);
            region_of[triangle] = region;
            joined |= region != NONE;
        }
        if !joined {
            let beside = |triangle: usize| triangles[triangle].neighbours.into_iter().map(|beside| region_of[beside]);
            let next = left.iter().find_map(|&i| beside(i).find(|&region| region != NONE).map(|region| (i, region)));
            let Some((triangle, region)) = next else { return };
            region_of[triangle] = region;
        }
    }
}

/// For a triangle so thin that its own plane is noise, the neighbour across its longest side.
fn across_longest_side([a, b, c]: [DVec3; 3], triangle: &Triangle, tolerance: f64) -> Option<usize> {
    let lengths = [a.distance(b), b.distance(c), c.distance(a)];
    let longest = (0..3).fold(0, |longest, side| if lengths[side] > lengths[longest] { side } else { longest });
    let altitude = (b - a).cross(c - a).length() / lengths[longest];
    (altitude <= 4.0 * tolerance || altitude.is_nan()).then_some(triangle.neighbours[longest])
}

/// Corners along the border of a region; `None` unless the border is one loop that visits no corner twice.
fn border(triangles: &[Triangle], region_of: &[usize], region: usize, points: usize) -> Option<Vec<usize>> {
    let mut after = vec![NONE; points];
    let mut sides = 0;
    let mut start = None;
    for (triangle, Triangle { corners, neighbours }) in triangles.iter().enumerate() {
        if region_of[triangle] != region {
            continue;
        }
        for side in (0..3).filter(|&side| region_of[neighbours[side]] != region) {
            let (from, to) = (corners[side], corners[(side + 1) % 3]);
            if after[from] != NONE {
                return None;
            }
            after[from] = to;
            sides += 1;
            start = Some(start.map_or(from, |start: usize| start.min(from)));
        }
    }
    let start = start?;
    let mut polygon = vec![start];
    let mut corner = after[start];
    while corner != start && polygon.len() <= sides {
        polygon.push(corner);
        corner = after[corner];
    }
    (polygon.len() == sides).then_some(polygon)
}
