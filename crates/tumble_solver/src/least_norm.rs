//! Of all impulses that do the same to the bodies, the smallest: a table on four legs presses on each alike.
//!
//! Given a solution λ, every λ + ν with W ν = 0 leaves all velocities as they are. With E the freedom that the contacts leave (none
//! where one opens, the direction of λ where it slides, all where it sticks), λ = E z and B = Eᵀ W E, the smallest is
//!
//! ```text
//! z_min = Q Qᵀ z             Q: orthonormal basis of the rows of B (Gram–Schmidt, largest row first)
//! ```
//!
//! If that leaves a bound (a pull, or too much friction), the way there is followed up to the bound, the contact is tied to it, and the
//! rest goes on. So the result pushes only, and does not depend on which of the many solutions was given.

use tumble_lcp::Matrix as Dense;
use tumble_math::{Dim, Linear, Matrix, Vector};

use crate::contact::tangential;

/// Part of a row's length below which what is left of it after Gram–Schmidt is rounding [1].
const DEPENDENT_BELOW: f64 = 1e-10;

/// What a contact may still do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Freedom<V> {
    /// Nothing: it opens.
    None,
    /// More or less in this direction.
    Along(V),
    /// Anything within its cone.
    All,
}

/// Moves the impulses of an island to the smallest that give the same velocities; `w` is its W, rows contact by contact.
pub(crate) fn make_smallest<D: Dim>(
    impulses: &mut [D::Vector],
    freedoms: &mut [Freedom<D::Vector>],
    friction: &[f64],
    w: &Dense,
) {
    // Each round ties one contact.
    for _ in 0..=2 * impulses.len() {
        let columns = columns::<D>(freedoms);
        let z: Vec<f64> = columns.iter().map(|(k, direction)| direction.dot(impulses[*k])).collect();
        let Some(change) = towards_smallest(&gram::<D>(&columns, w), &z) else { return };
        let mut changes = vec![D::Vector::ZERO; impulses.len()];
        for ((k, direction), change) in columns.iter().zip(&change) {
            changes[*k] += *direction * *change;
        }
        let mut step = 1.0;
        let mut first = None;
        for k in 0..impulses.len() {
            let friction = matches!(freedoms[k], Freedom::All).then_some(friction[k]);
            let most = reach(impulses[k], changes[k], friction);
            if most < step {
                (step, first) = (most, Some(k));
            }
        }
        impulses.iter_mut().zip(&changes).for_each(|(impulse, change)| *impulse += *change * step);
        let Some(k) = first else { return };
        // What rounding leaves of a normal that is used up is no direction.
        let pushes = impulses[k][0] > 1e-12 * changes[k].length();
        freedoms[k] = match (freedoms[k], impulses[k].try_normalize()) {
            (Freedom::All, Some(direction)) if pushes => Freedom::Along(direction),
            _ => {
                impulses[k] = D::Vector::ZERO;
                Freedom::None
            }
        };
    }
}

/// The columns of E: contact and direction.
fn columns<D: Dim>(freedoms: &[Freedom<D::Vector>]) -> Vec<(usize, D::Vector)> {
    let mut columns = Vec::new();
    for (k, freedom) in freedoms.iter().enumerate() {
        match freedom {
            Freedom::None => {}
            Freedom::Along(direction) => columns.push((k, *direction)),
            Freedom::All => columns.extend((0..D::Vector::AXES).map(|axis| (k, D::Vector::unit(axis)))),
        }
    }
    columns
}

/// B = Eᵀ W E.
fn gram<D: Dim>(columns: &[(usize, D::Vector)], w: &Dense) -> Vec<Vec<f64>> {
    let axes = D::Vector::AXES;
    let block = |i: usize, j: usize| {
        D::Matrix::from_columns(|column| {
            let mut velocity = D::Vector::ZERO;
            (0..axes).for_each(|row| velocity[row] = w[(axes * i + row, axes * j + column)]);
            velocity
        })
    };
    let entry = |(i, e): &(usize, D::Vector), (j, f): &(usize, D::Vector)| e.dot(block(*i, *j).apply(*f));
    columns.iter().map(|row| columns.iter().map(|column| entry(row, column)).collect()).collect()
}

/// Q Qᵀ z − z; `None` when the rows are independent, and z is the only solution.
fn towards_smallest(rows: &[Vec<f64>], z: &[f64]) -> Option<Vec<f64>> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let lengths: Vec<f64> = rows.iter().map(|row| dot(row, row).sqrt()).collect();
    let mut left: Vec<(usize, Vec<f64>)> =
        rows.iter().cloned().enumerate().filter(|(i, _)| lengths[*i] > 0.0).collect();
    let mut basis: Vec<Vec<f64>> = Vec::new();
    loop {
        let part = |(i, row): &(usize, Vec<f64>)| dot(row, row).sqrt() / lengths[*i];
        let best = (0..left.len()).fold(None, |best: Option<(usize, f64)>, at| {
            let part = part(&left[at]);
            if best.is_none_or(|(_, most)| part > most) { Some((at, part)) } else { best }
        });
        let Some((at, _)) = best.filter(|(_, part)| *part > DEPENDENT_BELOW) else { break };
        let (_, mut unit) = left.swap_remove(at);
        // Once more against the basis, so that it is orthogonal to rounding.
        for known in &basis {
            let along = dot(known, &unit);
            unit.iter_mut().zip(known).for_each(|(u, k)| *u -= along * k);
        }
        let length = dot(&unit, &unit).sqrt();
        unit.iter_mut().for_each(|u| *u /= length);
        for (_, row) in &mut left {
            let along = dot(&unit, row);
            row.iter_mut().zip(&unit).for_each(|(r, u)| *r -= along * u);
        }
        basis.push(unit);
    }
    if basis.len() == z.len() {
        return None;
    }
    let mut change: Vec<f64> = z.iter().map(|z| -z).collect();
    for unit in &basis {
        let along = dot(unit, z);
        change.iter_mut().zip(unit).for_each(|(c, u)| *c += along * u);
    }
    Some(change)
}

/// How much of a change keeps a contact pushing and within its friction, at most 1; friction that is tied to its normal keeps itself.
fn reach<V: Vector>(impulse: V, change: V, friction: Option<f64>) -> f64 {
    let mut most = 1.0_f64;
    if change[0] < 0.0 && impulse[0] + change[0] < 0.0 {
        most = impulse[0] / -change[0];
    }
    let Some(friction) = friction else { return most };
    let holds = |step: f64| {
        let moved = impulse + change * step;
        tangential(moved).length() <= friction * moved[0].max(0.0)
    };
    if !holds(most) {
        // The bound is met once, because the cone is convex and the start is within it.
        let (mut inside, mut outside) = (0.0, most);
        for _ in 0..60 {
            let middle = 0.5 * (inside + outside);
            *(if holds(middle) { &mut inside } else { &mut outside }) = middle;
        }
        most = inside;
    }
    most
}
