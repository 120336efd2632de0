//! Random problems whose answers are known: to test solvers and to measure them.
//!
//! Each is made backwards: choose z and w that complement each other, then q = w − M z. The same seed gives the same problem.

use crate::matrix::Matrix;
use crate::operator::WeightedGram;
use crate::problem::{Bound, Lcp};

/// A kind of problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// A Aᵀ + 0.1 I: the solution is unique.
    PositiveDefinite,
    /// A Aᵀ of rank n/3: w is unique, z need not be.
    Semidefinite,
    /// A Aᵀ + S with S skew: positive definite and not symmetric; unique.
    NonsymmetricDefinite,
    /// Negative off the diagonal and dominant on it: unique.
    MMatrix,
    /// Positive definite with its rows scaled by 1/50 to 1: a P-matrix that is not semidefinite; unique.
    PMatrix,
    /// Positive entries: strictly copositive, so a solution exists; often several.
    Copositive,
    /// Positive definite with zᵢ = wᵢ = 0 in a third of the rows: unique.
    Degenerate,
    /// Semidefinite with a vector y ≥ 0, M y = 0, q · y < 0: no solution.
    Infeasible,
    /// Normal impulses in a pile of boxes in the plane, three contacts between neighbours: semidefinite.
    Contact,
    /// The same with friction rows, μ = 0.4.
    FrictionalContact,
}

impl Family {
    /// All of them.
    pub const ALL: [Self; 10] = [
        Self::PositiveDefinite,
        Self::Semidefinite,
        Self::NonsymmetricDefinite,
        Self::MMatrix,
        Self::PMatrix,
        Self::Copositive,
        Self::Degenerate,
        Self::Infeasible,
        Self::Contact,
        Self::FrictionalContact,
    ];

    /// A problem of this family with about `n` rows (contacts come in threes), and its z where that was chosen first.
    pub fn sample(self, n: usize, seed: u64) -> Sample {
        let mut random = Random(seed);
        let gaussian_like = |random: &mut Random, columns: usize| {
            Matrix::from_fn(n, columns, |_, _| random.signed() + random.signed() + random.signed())
        };
        let gram = |a: &Matrix, shift: f64| {
            let mut m = a.product(&a.transpose());
            (0..n).for_each(|i| m[(i, i)] += shift);
            m
        };
        let matrix = match self {
            Self::PositiveDefinite | Self::Degenerate => gram(&gaussian_like(&mut random, n), 0.1),
            Self::Semidefinite => gram(&gaussian_like(&mut random, n.div_ceil(3)), 0.0),
            Self::NonsymmetricDefinite => {
                let mut m = gram(&gaussian_like(&mut random, n), 0.1);
                for i in 0..n {
                    for j in 0..i {
                        let skew = 5.0 * random.signed();
                        m[(i, j)] += skew;
                        m[(j, i)] -= skew;
                    }
                }
                m
            }
            Self::MMatrix => {
                let mut m = Matrix::from_fn(n, n, |_, _| -random.unit());
                for i in 0..n {
                    m[(i, i)] = 0.0;
                    m[(i, i)] = 0.1 + random.unit() - m.row(i).iter().sum::<f64>();
                }
                m
            }
            Self::PMatrix => {
                let mut m = gram(&gaussian_like(&mut random, n), 0.1);
                for i in 0..n {
                    let factor = 0.02 / (0.02 + random.unit());
                    m.row_mut(i).iter_mut().for_each(|m| *m *= factor);
                }
                m
            }
            Self::Copositive => Matrix::from_fn(n, n, |_, _| 0.05 + random.unit()),
            Self::Infeasible => return infeasible(n, &mut random),
            Self::Contact => return pile(n.div_ceil(3), Friction::Absent, &mut random),
            Self::FrictionalContact => return pile(n.div_ceil(6), Friction::Present, &mut random),
        };
        let idle = if self == Self::Degenerate { 1.0 / 3.0 } else { 0.0 };
        complementary(matrix, idle, &mut random)
    }
}

/// A problem, and a solution where one is known.
#[derive(Clone, Debug)]
pub struct Sample {
    /// The problem.
    pub problem: Lcp,
    /// A z that solves it.
    pub z: Option<Vec<f64>>,
}

/// q from a random complementary pair, with a part `idle` of the rows where both are zero.
fn complementary(matrix: Matrix, idle: f64, random: &mut Random) -> Sample {
    let n = matrix.rows();
    let (mut z, mut w) = (vec![0.0; n], vec![0.0; n]);
    for i in 0..n {
        let choice = random.unit();
        let value = 0.1 + random.unit();
        if choice >= idle {
            let pushes = choice < 0.5 * (1.0 + idle);
            *(if pushes { &mut z[i] } else { &mut w[i] }) = value;
        }
    }
    let mut q = vec![0.0; n];
    matrix.multiply(&z, &mut q);
    q.iter_mut().zip(&w).for_each(|(q, w)| *q = w - *q);
    Sample { problem: plain(matrix, q), z: Some(z) }
}

/// A Aᵀ with y in its kernel, and q against y.
fn infeasible(n: usize, random: &mut Random) -> Sample {
    let y: Vec<f64> = (0..n).map(|_| random.unit() + 0.1).collect();
    let square: f64 = y.iter().map(|y| y * y).sum();
    let mut a = Matrix::from_fn(n, n.div_ceil(2), |_, _| random.signed());
    for column in 0..a.columns() {
        let along: f64 = (0..n).map(|i| y[i] * a[(i, column)]).sum::<f64>() / square;
        (0..n).for_each(|i| a[(i, column)] -= along * y[i]);
    }
    let q: Vec<f64> = y.iter().map(|y| 0.3 * random.signed() - y).collect();
    let against: f64 = q.iter().zip(&y).map(|(q, y)| q * y).sum();
    // Large enough a step against y whatever the random part did.
    let q = q.iter().zip(&y).map(|(q, y)| q - (against.max(0.0) / square) * y).collect();
    Sample { problem: plain(a.product(&a.transpose()), q), z: None }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Friction {
    Absent,
    Present,
}

/// Boxes of unit half-width upon each other, three contacts per interface, falling and drifting with random speeds.
fn pile(boxes: usize, friction: Friction, random: &mut Random) -> Sample {
    let (mut rows, mut weights, mut velocities, mut bounds) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for level in 0..boxes {
        let mass = 0.5 + random.unit();
        weights.extend([1.0 / mass, 1.0 / mass, 1.5 / mass]);
        velocities.extend([0.3 * random.signed(), -0.1 - 0.1 * random.unit(), 0.05 * random.signed()]);
        for x in [-1.0, 0.0, 1.0] {
            // Velocity of the lower face of this box less that of the upper face of the one below.
            let (above, below) = (3 * level, 3 * level.saturating_sub(1));
            let mut normal = vec![(above + 1, 1.0), (above + 2, x)];
            let mut tangent = vec![(above, 1.0), (above + 2, 1.0)];
            if level > 0 {
                normal.extend([(below + 1, -1.0), (below + 2, -x)]);
                tangent.extend([(below, -1.0), (below + 2, 1.0)]);
            }
            rows.push(normal);
            bounds.push(Bound::Nonnegative);
            if friction == Friction::Present {
                bounds.push(Bound::Friction { normal: rows.len() - 1, coefficient: 0.4 });
                rows.push(tangent);
            }
        }
    }
    let q = rows
        .iter()
        .map(|row: &Vec<(usize, f64)>| row.iter().map(|&(column, value)| value * velocities[column]).sum())
        .collect();
    let problem = WeightedGram::new(rows, weights)
        .and_then(|gram| Lcp::new(gram.to_matrix(), q).ok())
        .and_then(|problem| problem.with_bounds(bounds).ok())
        .expect("a pile is finite and its parts fit");
    Sample { problem, z: None }
}

fn plain(matrix: Matrix, q: Vec<f64>) -> Lcp {
    Lcp::new(matrix, q).expect("families are finite and their parts fit")
}

/// SplitMix64 (Steele, Lea, Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }

    /// Between 0 and 1.
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Between −1 and 1.
    fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }
}
