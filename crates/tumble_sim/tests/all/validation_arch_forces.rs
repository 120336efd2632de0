//! The masonry arch: does it stand? A complementarity problem of forces between stones that cannot slip (case E12).
//!
//! Gauss's principle: stones accelerate such that no joint closes, and joints push only where they do not open. The arch stands just if
//! that leaves no acceleration.

use tumble_lcp::{Bound, Lcp, Lemke, Matrix};
use tumble_math::trig;

/// A stone: centre of mass, mass and inertia about it.
struct Stone {
    centre: [f64; 2],
    mass: f64,
    inertia: f64,
}

/// Corner of a joint, at an angle around the centre of the arch.
fn corner(radius: f64, angle: f64) -> [f64; 2] {
    let (sine, cosine) = trig::sin_cos(angle);
    [radius * cosine, radius * sine]
}

/// A polygon of density 1.
fn stone(corners: [[f64; 2]; 4]) -> Stone {
    let (mut area, mut first, mut second) = (0.0, [0.0; 2], 0.0);
    for k in 0..4 {
        let ([ax, ay], [bx, by]) = (corners[k], corners[(k + 1) % 4]);
        let twice = ax * by - ay * bx;
        area += 0.5 * twice;
        first = [first[0] + twice * (ax + bx) / 6.0, first[1] + twice * (ay + by) / 6.0];
        second += twice * (ax * ax + ax * bx + bx * bx + ay * ay + ay * by + by * by) / 12.0;
    }
    let centre = first.map(|moment| moment / area);
    Stone { centre, mass: area, inertia: second - area * (centre[0] * centre[0] + centre[1] * centre[1]) }
}

/// The largest acceleration of the stones of a semicircular arch of mean radius 1 whose joints do not slip, in units of gravity.
fn unrest(stones: usize, thickness: f64) -> f64 {
    let [inner, outer] = [1.0 - 0.5 * thickness, 1.0 + 0.5 * thickness];
    let angle = |k: usize| std::f64::consts::PI * k as f64 / stones as f64;
    let arch: Vec<Stone> = (0..stones)
        .map(|k| {
            let (a, b) = (angle(k), angle(k + 1));
            stone([corner(inner, a), corner(outer, a), corner(outer, b), corner(inner, b)])
        })
        .collect();
    // Per joint, between stone k − 1 (or the ground) and stone k (or the ground): normals at both corners, and one tangent.
    let mut rows: Vec<Vec<f64>> = Vec::new();
    let mut bounds = Vec::new();
    for k in 0..=stones {
        let (sine, cosine) = trig::sin_cos(angle(k));
        let (normal, tangent) = ([-sine, cosine], [cosine, sine]);
        for (direction, radius, bound) in
            [(normal, inner, Bound::Nonnegative), (normal, outer, Bound::Nonnegative), (tangent, 1.0, Bound::Free)]
        {
            let point = corner(radius, angle(k));
            let mut row = vec![0.0; 3 * stones];
            for (number, side) in [(k.checked_sub(1), -1.0), (Some(k).filter(|k| *k < stones), 1.0)] {
                let Some(number) = number else { continue };
                let arm = [point[0] - arch[number].centre[0], point[1] - arch[number].centre[1]];
                row[3 * number] = side * direction[0];
                row[3 * number + 1] = side * direction[1];
                row[3 * number + 2] = side * (arm[0] * direction[1] - arm[1] * direction[0]);
            }
            rows.push(row);
            bounds.push(bound);
        }
    }
    // Gravity 1 and mass-weighted coordinates: M = J M⁻¹ Jᵀ.
    let weights: Vec<f64> =
        arch.iter().flat_map(|stone| [1.0 / stone.mass, 1.0 / stone.mass, 1.0 / stone.inertia]).collect();
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).zip(&weights).map(|((a, b), w)| a * b * w).sum::<f64>();
    let matrix = Matrix::from_fn(rows.len(), rows.len(), |i, j| product(&rows[i], &rows[j]));
    let falling: Vec<f64> = (0..3 * stones).map(|c| if c % 3 == 1 { -1.0 } else { 0.0 }).collect();
    let q = rows.iter().map(|row| row.iter().zip(&falling).map(|(a, b)| a * b).sum()).collect();
    let problem = Lcp::new(matrix, q).unwrap().with_bounds(bounds).unwrap();
    let solved = Lemke::default().solve(&problem).unwrap();
    let mut accelerations = falling;
    for (row, force) in rows.iter().zip(&solved.z) {
        accelerations.iter_mut().zip(row).zip(&weights).for_each(|((a, entry), weight)| *a += weight * entry * force);
    }
    accelerations.iter().fold(0.0, |largest, a| a.abs().max(largest))
}

#[test]
fn e12_arch_stands_from_its_least_thickness_on() {
    let cases = [
        (5, 0.0949796),
        (7, 0.0957034),
        (9, 0.101525),
        (16, 0.107076),
        (17, 0.105462),
        (48, 0.107219),
        (160, 0.107458),
    ];
    for (stones, least) in cases {
        // A thousandth too thin, or too thick. What is too thin begins to fall with some thousandths of g; the other rests, to the bar of
        // the solver.
        let [below, above] = [0.999, 1.001].map(|part| unrest(stones, least * part));
        assert!(below > 1e-4 && above < 1e-8, "{stones} stones: {below:e} {above:e}");
    }
}
