//! One contact, solved exactly: it opens, sticks, or slides.
//!
//! ```text
//! open    r = 0                    if q_n ≥ 0
//! stick   r = −W⁻¹ q               if |r_t| ≤ μ r_n
//! slide   r_t = μ r_n e,  |e| = 1,  u_n = 0,  u_t = −s e with s ≥ 0
//! ```
//!
//! Sliding: u_n = 0 gives r_n = −q_n / (W_nn + μ W_nt · e); then u_t ∥ e asks for
//!
//! ```text
//! e⊥ · (g + H e) = 0,   g = W_nn q_t − q_n W_tn,   H = μ (q_t W_nt − q_n W_tt)
//! ```
//!
//! a quartic in the tangent of half the angle of e, whose real roots are bracketed by those of its derivatives.

use super::problem::natural_map;

/// W of one contact, 3 × 3; in the plane the second tangent is decoupled.
pub(super) type Block = [[f64; 3]; 3];

/// The impulse of one contact with velocity q at r = 0. Where none solves it (W not positive definite), the best of the candidates.
pub(super) fn solve_contact(w: &Block, q: [f64; 3], mu: f64) -> [f64; 3] {
    if q[0] >= 0.0 {
        return [0.0; 3];
    }
    if let Some(stick) = solve_3x3(w, q).map(|x| x.map(|x| -x)) {
        let radius = mu * stick[0];
        if stick[0] >= 0.0 && stick[1] * stick[1] + stick[2] * stick[2] <= radius * radius {
            return stick;
        }
    }
    // In units of 1 / W_nn impulses and velocities are alike.
    let unit = if w[0][0] > 0.0 { 1.0 / w[0][0] } else { 1.0 };
    let frictionless = [unit * -q[0], 0.0, 0.0];
    let mut best = (frictionless, f64::INFINITY);
    let mut offer = |r: [f64; 3]| {
        let u = velocity(w, q, r).map(|u| unit * u);
        let defect = natural_map(r, u, mu).iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        if r.iter().all(|x| x.is_finite()) && defect < best.1 {
            best = (r, defect);
        }
    };
    offer(frictionless);
    for e in sliding_directions(w, q, mu) {
        let across = w[0][0] + mu * (w[0][1] * e[0] + w[0][2] * e[1]);
        if across > 0.0 {
            let normal = -q[0] / across;
            offer([normal, mu * normal * e[0], mu * normal * e[1]]);
        }
    }
    best.0
}

/// u = W r + q.
fn velocity(w: &Block, q: [f64; 3], r: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| w[i][0] * r[0] + w[i][1] * r[1] + w[i][2] * r[2] + q[i])
}

/// Directions in which friction may act while sliding, among them all that satisfy e⊥ · (g + H e) = 0.
fn sliding_directions(w: &Block, q: [f64; 3], mu: f64) -> Vec<[f64; 2]> {
    let g = [w[0][0] * q[1] - q[0] * w[1][0], w[0][0] * q[2] - q[0] * w[2][0]];
    let h: [[f64; 2]; 2] =
        std::array::from_fn(|i| std::array::from_fn(|j| mu * (q[i + 1] * w[0][j + 1] - q[0] * w[i + 1][j + 1])));
    let mut directions = Vec::new();
    // e = ±(1 − t², 2 t) / (1 + t²) with |t| ≤ 1: each sign covers half of the circle.
    for sign in [1.0, -1.0] {
        let (g, twist) = ([sign * g[0], sign * g[1]], h[1][1] - h[0][0]);
        let quartic = [
            g[1] + h[1][0],
            2.0 * (twist - g[0]),
            -2.0 * h[1][0] - 4.0 * h[0][1],
            -2.0 * (twist + g[0]),
            h[1][0] - g[1],
        ];
        for t in stationary_points(&quartic) {
            let square = t * t;
            directions.push([sign * (1.0 - square) / (1.0 + square), sign * 2.0 * t / (1.0 + square)]);
        }
    }
    directions
}

/// The real roots of a polynomial in [−1, 1] and the points between which they were sought (double roots are among those).
fn stationary_points(coefficients: &[f64]) -> Vec<f64> {
    if coefficients.len() < 2 {
        return Vec::new();
    }
    let derivative: Vec<f64> = coefficients.iter().enumerate().skip(1).map(|(k, c)| k as f64 * c).collect();
    let value = |t: f64| coefficients.iter().rev().fold(0.0, |sum, c| sum * t + c);
    let slope = |t: f64| derivative.iter().rev().fold(0.0, |sum, c| sum * t + c);
    let mut marks = vec![-1.0];
    marks.extend(stationary_points(&derivative));
    marks.push(1.0);
    marks.sort_by(f64::total_cmp);
    let roots: Vec<f64> = marks
        .windows(2)
        .filter(|pair| value(pair[0]) * value(pair[1]) < 0.0)
        .map(|pair| monotone_root(&value, &slope, pair[0], pair[1]))
        .collect();
    marks.extend(roots);
    marks
}

/// The root between two points of different sign: Newton's step where it stays inside and is short, halving otherwise.
fn monotone_root(value: &dyn Fn(f64) -> f64, slope: &dyn Fn(f64) -> f64, low: f64, high: f64) -> f64 {
    let (mut negative, mut positive) = if value(low) < 0.0 { (low, high) } else { (high, low) };
    let mut t = 0.5 * (low + high);
    for _ in 0..100 {
        let f = value(t);
        *(if f < 0.0 { &mut negative } else { &mut positive }) = t;
        let newton = t - f / slope(t);
        let middle = 0.5 * (negative + positive);
        let inside = (newton - negative) * (newton - positive) < 0.0;
        let next = if inside && (newton - middle).abs() < 0.49 * (positive - negative).abs() { newton } else { middle };
        if next == t || f == 0.0 {
            break;
        }
        t = next;
    }
    t
}

/// x with A x = b by Gaussian elimination with partial pivoting; `None` when a pivot is lost in rounding.
fn solve_3x3(a: &Block, b: [f64; 3]) -> Option<[f64; 3]> {
    let mut rows: [[f64; 4]; 3] = std::array::from_fn(|i| [a[i][0], a[i][1], a[i][2], b[i]]);
    // In units in which the diagonal is one, so that mass ratios do not look like rank.
    let unit: [f64; 3] = std::array::from_fn(|i| if a[i][i] > 0.0 { 1.0 / a[i][i].sqrt() } else { 1.0 });
    for (i, row) in rows.iter_mut().enumerate() {
        row.iter_mut().for_each(|x| *x *= unit[i]);
        (0..3).for_each(|j| row[j] *= unit[j]);
    }
    for k in 0..3 {
        let pivot = (k..3).fold(k, |best, i| if rows[i][k].abs() > rows[best][k].abs() { i } else { best });
        rows.swap(k, pivot);
        let pivot_row = rows[k];
        if pivot_row[k].is_nan() || pivot_row[k].abs() <= 1e-14 {
            return None;
        }
        for row in rows.iter_mut().skip(k + 1) {
            let factor = row[k] / pivot_row[k];
            (k..4).for_each(|j| row[j] -= factor * pivot_row[j]);
        }
    }
    let mut x = [0.0; 3];
    for i in (0..3).rev() {
        let known: f64 = (i + 1..3).map(|j| rows[i][j] * x[j]).sum();
        x[i] = (rows[i][3] - known) / rows[i][i];
    }
    Some(std::array::from_fn(|i| x[i] * unit[i]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_real_roots_of_a_quartic_are_among_the_points() {
        // (t − 0.1)(t + 0.2)(t − 0.7)² and its double root.
        let quartic = [-0.0098, 0.077, 0.33, -1.3, 1.0];
        let points = stationary_points(&quartic);
        for root in [0.1, -0.2, 0.7] {
            // A double root is as accurate as the square root of rounding.
            assert!(points.iter().any(|t| (t - root).abs() < 1e-7), "{root}: {points:?}");
        }
    }
}
