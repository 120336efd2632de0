//! Lemke's method: complementary pivoting along a path from a covering vector.
//!
//! **Idea.** Add so much of a positive vector d to q that z = 0 is a solution; then take it away again, pivoting so that every row but
//! one stays complementary. The path never branches and never returns.
//!
//! **Equations.** w = M z + q + d z₀. The basis B is made of columns of I (basic w), −M (basic z) and −d (z₀); x_B = B⁻¹ q. After a
//! variable leaves, its complement enters. Ratio test: min xᵢ / αᵢ over αᵢ > 0, α = B⁻¹ a_entering; ties are decided by the rows of
//! [x_B, B⁻¹] / αᵢ in lexicographic order, which makes cycling impossible (Cottle, Pang, Stone 1992, section 4.9). B⁻¹ is updated
//! by one elementary matrix per pivot and rebuilt from an LU factorization now and then; the answer is refined on the original M.
//!
//! **Good at.** Solves every copositive-plus problem (all positive semidefinite ones, P-matrices, frictional contact in polyhedral
//! form) or proves it infeasible. Any bounds, by [plain form](crate::Bound).
//!
//! **Bad at.** O(n²) per pivot with pivots ∝ n in practice, but 2ⁿ in the worst case (Murty); for matrices outside its classes a
//! secondary ray says nothing.
//!
//! **When to choose.** Up to a few hundred rows, when M is not symmetric, or when certainty is wanted.

use crate::active_set::polish;
use crate::factor::{Definiteness, UpdatedInverse, definiteness};
use crate::matrix::{Matrix, dot, largest};
use crate::outcome::{Method, Report, Solution, SolveError, judge_pivoting};
use crate::problem::Lcp;
use crate::proximal::proximal;
use crate::standard::{Standard, equilibrate};

/// The vector d that covers negative q.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Covering {
    /// All ones.
    #[default]
    Ones,
    /// Numbers between 1 and 2, different for each seed: another path, which may miss a secondary ray.
    Spread(u32),
}

/// Whether rows are brought into similar units first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scaling {
    /// M, q as given.
    None,
    /// Rows and columns times powers of two, which rounds nothing.
    #[default]
    PowersOfTwo,
}

/// Settings of Lemke's method.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lemke {
    /// The covering vector. Default: ones.
    pub covering: Covering,
    /// Units. Default: powers of two.
    pub scaling: Scaling,
    /// Pivots after which the method gives up. Default: 1000 + 50 n.
    pub max_pivots: Option<usize>,
}

impl Lemke {
    /// Solves from scratch.
    pub fn solve(&self, problem: &Lcp) -> Result<Solution, SolveError> {
        self.solve_from(problem, &vec![0.0; problem.dimension()])
    }

    /// Solves, starting from the basis in which the positive entries of `z` are basic: few pivots when z is nearly right.
    pub fn solve_from(&self, problem: &Lcp, z: &[f64]) -> Result<Solution, SolveError> {
        if z.len() != problem.dimension() || z.iter().any(|z| !z.is_finite()) {
            return Err(SolveError::NotFinite);
        }
        // The guarantees of the path hold from z = 0; from elsewhere it may meet a ray where there is a solution.
        let cold = vec![0.0; z.len()];
        let run = |problem: &Lcp, z: &[f64]| match self.run(problem, z) {
            Err(
                SolveError::SecondaryRay { .. } | SolveError::SingularPivot { .. } | SolveError::NotConverged { .. },
            ) if z != cold => self.run(problem, &cold),
            end => end,
        };
        match run(problem, z) {
            // Pivots lost in rounding: the same on M made regular, as long as that is what M is near.
            Err(
                error @ (SolveError::SingularPivot { .. }
                | SolveError::SecondaryRay { .. }
                | SolveError::NotConverged { .. }),
            ) if problem.has_friction() || definiteness(problem.matrix()) != Definiteness::Indefinite => {
                proximal(problem, run).map_err(|_| error)
            }
            end => end,
        }
    }

    fn run(&self, problem: &Lcp, z: &[f64]) -> Result<Solution, SolveError> {
        let standard = Standard::of(problem);
        let (mut matrix, mut q) = (standard.matrix.clone(), standard.q.clone());
        let units = match self.scaling {
            Scaling::None => vec![1.0; q.len()],
            Scaling::PowersOfTwo => equilibrate(&mut matrix, &mut q).of_x,
        };
        if !(largest(matrix.entries()).is_finite() && largest(&q).is_finite()) {
            return Err(SolveError::NotFinite);
        }
        let recover = |x: &[f64]| standard.recover(problem, &in_units(x, &units));
        let cap = self.max_pivots.unwrap_or(1000 + 50 * q.len());
        let warm: Vec<bool> = standard.project(z).iter().map(|&x| x > 0.0).collect();
        let mut path = Path::new(&matrix, &q, warm);
        let end = path.follow(self.covering, cap);
        let (x, pivots) = (path.z(), path.pivots);
        match end {
            PathEnd::Solution => judge_pivoting(problem, polish(problem, recover(&x)), Method::Lemke, pivots),
            PathEnd::Ray(ray) => {
                // z₀ may be zero already, tied with the row that opened the ray.
                let here = recover(&x);
                if problem.residual(&here) <= 1e-9 * problem.scale(&here) {
                    let here = judge_pivoting(problem, polish(problem, here), Method::Lemke, pivots);
                    if here.is_ok() {
                        return here;
                    }
                }
                let ray = in_units(&ray, &units);
                // On a copositive-plus problem the ray itself is a Farkas vector; otherwise a linear program may find one.
                let from_ray = [standard.recover_certificate(problem, &ray)];
                let certificate = from_ray
                    .into_iter()
                    .chain(
                        infeasibility(&matrix, &q)
                            .map(|y| standard.recover_certificate(problem, &in_units(&y, &units))),
                    )
                    .find(|y| problem.is_infeasibility_certificate(y));
                if let Some(certificate) = certificate {
                    return Err(SolveError::Infeasible { certificate });
                }
                let residual = problem.residual(&recover(&x));
                let report = Report { method: Method::Lemke, iterations: pivots, residual };
                let origin = standard.recover(problem, &vec![0.0; ray.len()]);
                let ray = standard.recover(problem, &ray).iter().zip(&origin).map(|(end, start)| end - start).collect();
                Err(SolveError::SecondaryRay { ray, report })
            }
            PathEnd::Singular => Err(SolveError::SingularPivot { row: 0 }),
            PathEnd::NotFinite => Err(SolveError::NotFinite),
            PathEnd::OutOfPivots => {
                let z = polish(problem, recover(&x));
                let report = Report { method: Method::Lemke, iterations: pivots, residual: problem.residual(&z) };
                Err(SolveError::CyclingStopped { z, report })
            }
        }
    }
}

/// x in the original units.
fn in_units(x: &[f64], units: &[f64]) -> Vec<f64> {
    x.iter().zip(units).map(|(x, unit)| x * unit).collect()
}

/// A vector y ≥ 0 with Mᵀ y ≤ 0 and qᵀ y < 0, if z ≥ 0, M z + q ≥ 0 is infeasible; the caller checks it.
///
/// The feasibility of a linear system is itself an LCP, [[0, −Mᵀ], [M, 0]] with (0, q); it is skew, so Lemke's method decides it.
fn infeasibility(matrix: &Matrix, q: &[f64]) -> Option<Vec<f64>> {
    let n = q.len();
    // Twice the size and only worth it where the answer is wanted: beyond this it would dominate everything else.
    if n > 300 {
        return None;
    }
    let skew = Matrix::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
        (true, false) => -matrix[(j - n, i)],
        (false, true) => matrix[(i - n, j)],
        _ => 0.0,
    });
    let padded: Vec<f64> = std::iter::repeat_n(0.0, n).chain(q.iter().copied()).collect();
    let mut path = Path::new(&skew, &padded, vec![false; 2 * n]);
    match path.follow(Covering::Ones, 1000 + 50 * n) {
        PathEnd::Ray(ray) => Some(ray[n..].to_vec()),
        _ => None,
    }
}

/// How a path ends.
enum PathEnd {
    Solution,
    Ray(Vec<f64>),
    Singular,
    NotFinite,
    OutOfPivots,
}

/// A variable of the extended problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Variable {
    W(usize),
    Z(usize),
    Artificial,
}

impl Variable {
    fn complement(self) -> Self {
        match self {
            Self::W(i) => Self::Z(i),
            Self::Z(i) => Self::W(i),
            Self::Artificial => Self::Artificial,
        }
    }
}

/// The state of one run.
struct Path<'a> {
    matrix: &'a Matrix,
    /// Mᵀ, whose rows are the columns that enter.
    columns: Matrix,
    q: &'a [f64],
    /// The column of z₀ in the system, −d.
    artificial: Vec<f64>,
    basis: Vec<Variable>,
    inverse: UpdatedInverse,
    /// Values of the basic variables.
    x: Vec<f64>,
    pivots: usize,
}

impl<'a> Path<'a> {
    /// Starts from the basis in which z is basic where `warm` says so, or from all w when that basis is singular.
    fn new(matrix: &'a Matrix, q: &'a [f64], warm: Vec<bool>) -> Self {
        let n = q.len();
        let mut path = Self {
            matrix,
            columns: matrix.transpose(),
            q,
            artificial: vec![-1.0; n],
            basis: (0..n).map(Variable::W).collect(),
            inverse: UpdatedInverse::identity(n),
            x: q.to_vec(),
            pivots: 0,
        };
        if warm.contains(&true) {
            path.basis = (0..n).map(|i| if warm[i] { Variable::Z(i) } else { Variable::W(i) }).collect();
            if !path.rebuild() {
                path.basis = (0..n).map(Variable::W).collect();
                path.inverse = UpdatedInverse::identity(n);
                path.x = q.to_vec();
            }
        }
        path
    }

    /// The column of a variable.
    fn column(&self, variable: Variable) -> Vec<f64> {
        match variable {
            Variable::W(i) => (0..self.q.len()).map(|k| f64::from(u8::from(k == i))).collect(),
            Variable::Z(i) => self.columns.row(i).iter().map(|m| -m).collect(),
            Variable::Artificial => self.artificial.clone(),
        }
    }

    /// B⁻¹ a for the column a of a variable.
    fn image(&self, variable: Variable) -> Vec<f64> {
        match variable {
            Variable::W(i) => (0..self.q.len()).map(|k| self.inverse.row(k)[i]).collect(),
            _ => self.inverse.multiply(&self.column(variable)),
        }
    }

    /// z of the plain problem.
    fn z(&self) -> Vec<f64> {
        let mut z = vec![0.0; self.q.len()];
        for (variable, &x) in self.basis.iter().zip(&self.x) {
            if let Variable::Z(i) = variable {
                z[*i] = x;
            }
        }
        z
    }

    /// Pivots until z₀ leaves, a ray opens, or `cap` is reached.
    fn follow(&mut self, covering: Covering, cap: usize) -> PathEnd {
        let n = self.q.len();
        if self.x.iter().all(|&x| x >= 0.0) {
            return PathEnd::Solution;
        }
        let d: Vec<f64> = (0..n).map(|i| covering_entry(covering, i)).collect();
        // In terms of the starting basis, so that z₀ covers every negative basic variable.
        self.artificial = (0..n)
            .map(|i| {
                let in_row = |(k, variable): (usize, &Variable)| match *variable {
                    Variable::W(j) => {
                        if i == j {
                            d[k]
                        } else {
                            0.0
                        }
                    }
                    Variable::Z(j) => -self.matrix[(i, j)] * d[k],
                    Variable::Artificial => 0.0,
                };
                -self.basis.iter().enumerate().map(in_row).sum::<f64>()
            })
            .collect();
        let mut entering = Variable::Artificial;
        // The first step makes z₀ just large enough: the same ratio test with all denominators positive.
        let mut image: Vec<f64> = d;
        loop {
            let mut leaving_row = self.leaving_row(&image);
            // A ray, or a pivot much smaller than its column, may be rounding: look again with a fresh inverse.
            let doubtful = leaving_row.is_none_or(|row| image[row] < 1e-5 * largest(&image));
            if doubtful && entering != Variable::Artificial && self.inverse.updates() > 0 && self.rebuild() {
                image = self.image(entering);
                leaving_row = self.leaving_row(&image);
            }
            let Some(row) = leaving_row else { return PathEnd::Ray(self.ray(entering, &image)) };
            if entering == Variable::Artificial {
                image.iter_mut().for_each(|a| *a = -*a);
            }
            let leaving = self.basis[row];
            if !self.pivot(row, entering, &image) {
                return if self.x.iter().all(|x| x.is_finite()) { PathEnd::Singular } else { PathEnd::NotFinite };
            }
            if leaving == Variable::Artificial {
                return PathEnd::Solution;
            }
            if self.pivots >= cap {
                return PathEnd::OutOfPivots;
            }
            entering = leaving.complement();
            image = self.image(entering);
            if !largest(&image).is_finite() {
                return PathEnd::NotFinite;
            }
        }
    }

    /// The row that the ratio test picks, z₀ first among ties and the lexicographic order after it.
    fn leaving_row(&self, image: &[f64]) -> Option<usize> {
        let threshold = 1e-10 * largest(image);
        let mut best: Option<usize> = None;
        for i in (0..image.len()).filter(|&i| image[i] > threshold) {
            best = match best {
                Some(b) if !self.comes_before(i, b, image) => Some(b),
                _ => Some(i),
            };
        }
        best
    }

    /// Compares rows of [x, B⁻¹] / α in lexicographic order.
    fn comes_before(&self, i: usize, j: usize, image: &[f64]) -> bool {
        let differs = |a: f64, b: f64| (a - b).abs() > 1e-12 * (a.abs() + b.abs());
        let (a, b) = (self.x[i] / image[i], self.x[j] / image[j]);
        if differs(a, b) {
            return a < b;
        }
        if self.basis[i] == Variable::Artificial || self.basis[j] == Variable::Artificial {
            return self.basis[i] == Variable::Artificial;
        }
        let (row, other) = (self.inverse.row(i), self.inverse.row(j));
        // Entries that ought to be zero are as large as rounding in the largest of their row.
        let noise = 1e-13 * (largest(row) / image[i] + largest(other) / image[j]);
        for (a, b) in row.iter().zip(other) {
            let (a, b) = (a / image[i], b / image[j]);
            if differs(a, b) && (a - b).abs() > noise {
                return a < b;
            }
        }
        false
    }

    /// Exchanges the basic variable of a row for another; false when the basis becomes singular.
    fn pivot(&mut self, row: usize, entering: Variable, image: &[f64]) -> bool {
        let step = self.x[row] / image[row];
        self.pivots += 1;
        self.basis[row] = entering;
        // Rebuilding costs about as much as n updates, so that it is rare enough not to show.
        let updated = self.inverse.replace_column(row, image).is_ok();
        if !updated || self.inverse.updates() > self.q.len().max(50) {
            return self.rebuild();
        }
        let noise = 1e-14 * largest(&self.x);
        for (i, x) in self.x.iter_mut().enumerate() {
            *x = if i == row { step } else { *x - step * image[i] };
            if x.abs() <= noise {
                *x = 0.0;
            }
        }
        self.x.iter().all(|x| x.is_finite())
    }

    /// Computes B⁻¹ and x afresh; false when B is singular.
    fn rebuild(&mut self) -> bool {
        let columns: Vec<Vec<f64>> = self.basis.iter().map(|&variable| self.column(variable)).collect();
        let n = columns.len();
        if self.inverse.rebuild(Matrix::from_fn(n, n, |i, j| columns[j][i])).is_err() {
            return false;
        }
        self.x = (0..n).map(|i| dot(self.inverse.row(i), self.q)).collect();
        let noise = 1e-14 * largest(&self.x);
        self.x.iter_mut().filter(|x| x.abs() <= noise).for_each(|x| *x = 0.0);
        self.x.iter().all(|x| x.is_finite())
    }

    /// Direction in z along which nothing blocks.
    fn ray(&self, entering: Variable, image: &[f64]) -> Vec<f64> {
        let mut ray = vec![0.0; self.q.len()];
        for (variable, &a) in self.basis.iter().zip(image) {
            if let Variable::Z(i) = variable {
                ray[*i] = (-a).max(0.0);
            }
        }
        if let Variable::Z(i) = entering {
            ray[i] = 1.0;
        }
        ray
    }
}

/// One entry of the covering vector.
fn covering_entry(covering: Covering, i: usize) -> f64 {
    match covering {
        Covering::Ones => 1.0,
        Covering::Spread(seed) => {
            // Multiples of the golden ratio, modulo one, are spread evenly and never repeat.
            let turn = 0.618_033_988_749_894_9 * (i as f64 + 1.0) * f64::from(seed.wrapping_add(1));
            1.0 + turn - turn.floor()
        }
    }
}
