//! One run of principal pivoting: which rows are finished, and how the next is driven without breaking them.

use crate::active_set::{Side, sides_of, solve_sides};
use crate::factor::{SingularUpdate, UpdatedInverse};
use crate::matrix::{Matrix, add_scaled, dot, largest};
use crate::problem::{Bound, Lcp, natural_map_entry};

/// Why a run stopped early.
pub(super) enum Stop {
    /// Too many pivots, or too many of zero length.
    Cap,
    /// A zero pivot in this row.
    Singular(usize),
    /// Numbers overflowed.
    NotFinite,
    /// Nothing blocks in this direction of z.
    Ray(Vec<f64>),
}

/// What is known about a row during a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// Not looked at yet, or not in order: z is held, w is whatever it is.
    Waiting,
    /// In C: w = 0.
    Active,
    /// At its lower bound with w ≥ 0.
    Lower,
    /// At its upper bound with w ≤ 0.
    Upper,
}

/// What limits a push.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Event {
    /// The w of the driven row is zero.
    DriverDone,
    /// The driven or an active row meets a bound.
    Bound(usize, State),
    /// The w of a row at its bound is zero.
    Release(usize),
}

/// z and w on their way, and which rows are finished.
pub(super) struct Run<'a> {
    problem: &'a Lcp,
    m: &'a Matrix,
    row_norms: Vec<f64>,
    /// The unknowns so far.
    pub z: Vec<f64>,
    w: Vec<f64>,
    state: Vec<State>,
    /// C, in the order of the rows of the inverse.
    active: Vec<usize>,
    inverse: UpdatedInverse,
    /// Friction rows of each normal, with μ.
    frictions: Vec<Vec<(usize, f64)>>,
    /// Pivots so far, block pivots among them.
    pub pivots: usize,
    idle_pivots: usize,
}

impl<'a> Run<'a> {
    /// All rows waiting at the z nearest to zero.
    pub fn cold(problem: &'a Lcp) -> Self {
        let n = problem.dimension();
        let mut z = vec![0.0; n];
        problem.clamp(&mut z);
        let mut frictions = vec![Vec::new(); n];
        for (row, bound) in problem.bounds().iter().enumerate() {
            if let Bound::Friction { normal, coefficient } = *bound {
                frictions[normal].push((row, coefficient));
            }
        }
        let m = problem.matrix();
        Self {
            problem,
            m,
            row_norms: (0..n).map(|i| m.row(i).iter().map(|m| m.abs()).sum()).collect(),
            w: problem.w(&z),
            z,
            state: vec![State::Waiting; n],
            active: Vec::new(),
            inverse: UpdatedInverse::empty(n),
            frictions,
            pivots: 0,
            idle_pivots: 0,
        }
    }

    /// Starts from the sides on which `z` stands, bettered by block pivots; `None` when that leads nowhere.
    pub fn warm(problem: &'a Lcp, z: &[f64]) -> Option<Self> {
        let mut start = z.to_vec();
        problem.clamp(&mut start);
        let mut sides = sides_of(problem, &start, &problem.w(&start));
        let mut solved = solve_sides(problem, &sides)?;
        // All wrong rows change sides at once, as long as they become fewer (Júdice and Pires 1994).
        let mut fewest = usize::MAX;
        let mut block_pivots = 0;
        loop {
            let next = sides_of(problem, &solved, &problem.w(&solved));
            let wrong = next.iter().zip(&sides).filter(|(a, b)| a != b).count();
            if wrong >= fewest || wrong == 0 {
                break;
            }
            fewest = wrong;
            let Some(better) = solve_sides(problem, &next) else { break };
            (sides, solved) = (next, better);
            block_pivots += 1;
        }
        // What is left of them must at least be within its bounds.
        for _ in 0..5 {
            let slack = 1e-12 * largest(&solved);
            let mut fits = true;
            for i in 0..solved.len() {
                let (lower, upper) = problem.limits(i, &solved);
                if sides[i] == Side::Between && (solved[i] < lower - slack || solved[i] > upper + slack) {
                    sides[i] = if solved[i] < lower { Side::Lower } else { Side::Upper };
                    fits = false;
                }
            }
            if fits {
                return Self::at(problem, &sides, solved, block_pivots);
            }
            solved = solve_sides(problem, &sides)?;
            block_pivots += 1;
        }
        None
    }

    /// A run whose finished rows are those of `sides` that are in order at z.
    fn at(problem: &'a Lcp, sides: &[Side], z: Vec<f64>, pivots: usize) -> Option<Self> {
        let mut run = Self { pivots, ..Self::cold(problem) };
        run.z = z;
        problem.clamp(&mut run.z);
        run.w = problem.w(&run.z);
        let noise = run.noise();
        for (i, &side) in sides.iter().enumerate() {
            run.state[i] = match side {
                Side::Between => State::Active,
                Side::Lower if run.w[i] >= -noise => State::Lower,
                Side::Upper if run.w[i] <= noise => State::Upper,
                _ if matches!(problem.bounds()[i], Bound::Friction { .. }) => return None,
                _ => State::Waiting,
            };
        }
        run.active = (0..sides.len()).filter(|&i| run.state[i] == State::Active).collect();
        run.rebuild().is_ok().then_some(run)
    }

    /// Below this a w is zero.
    fn noise(&self) -> f64 {
        let norm = self.row_norms.iter().fold(0.0, |most: f64, norm| most.max(*norm));
        1e-13 * largest(self.problem.q()).max(norm * largest(&self.z))
    }

    /// Drives rows until none is out of order: free rows, then normals and boxes, then friction.
    pub fn drive_all(&mut self, cap: usize) -> Result<(), Stop> {
        while let Some(row) = self.next_out_of_order() {
            self.drive(row, cap)?;
        }
        Ok(())
    }

    /// The next row to drive, if any; rows found in order on the way are put to their side.
    fn next_out_of_order(&mut self) -> Option<usize> {
        let noise = self.noise();
        let mut first = [None; 3];
        for i in 0..self.z.len() {
            if self.state[i] != State::Waiting {
                continue;
            }
            let (lower, upper) = self.problem.limits(i, &self.z);
            let (w, z) = (self.w[i], self.z[i]);
            let class = match self.problem.bounds()[i] {
                Bound::Free => 0,
                Bound::Nonnegative | Bound::Box { .. } => 1,
                Bound::Friction { .. } => 2,
            };
            if z <= lower && w >= -noise && class == 1 {
                self.state[i] = State::Lower;
            } else if z >= upper && w <= noise && class == 1 {
                self.state[i] = State::Upper;
            } else if natural_map_entry(z, w, lower, upper).abs() > noise {
                first[class] = first[class].or(Some(i));
            }
        }
        first.into_iter().flatten().next()
    }

    /// Pushes one row until it is in order.
    fn drive(&mut self, driver: usize, cap: usize) -> Result<(), Stop> {
        let sign = if self.w[driver] < 0.0 { 1.0 } else { -1.0 };
        self.turn_frictions(driver);
        loop {
            let direction = self.direction(driver, sign);
            if !largest(&direction).is_finite() {
                return Err(Stop::NotFinite);
            }
            let mut rate = vec![0.0; self.w.len()];
            self.m.multiply(&direction, &mut rate);
            let Some((step, event)) = self.first_event(driver, &direction, &rate) else {
                return Err(Stop::Ray(direction));
            };
            add_scaled(&mut self.z, step, &direction);
            add_scaled(&mut self.w, step, &rate);
            self.pivots += 1;
            self.idle_pivots = if step > 0.0 { 0 } else { self.idle_pivots + 1 };
            // Steps of zero length that outnumber all rows several times are going round.
            if self.pivots > cap || self.idle_pivots > 20 + 4 * self.z.len() {
                return Err(Stop::Cap);
            }
            let done = matches!(event, Event::DriverDone) || matches!(event, Event::Bound(row, _) if row == driver);
            self.change_side(driver, sign, event)?;
            if self.inverse.updates() > self.active.len().max(50) {
                self.refresh()?;
            }
            if done {
                return Ok(());
            }
        }
    }

    /// Δz: the driven row moves by `sign`, active rows answer, friction at its limit follows.
    fn direction(&self, driver: usize, sign: f64) -> Vec<f64> {
        let column = self.folded_column(driver);
        let answer = self.inverse.multiply(&column);
        let mut direction = vec![0.0; self.z.len()];
        direction[driver] = sign;
        self.active.iter().zip(&answer).for_each(|(&i, a)| direction[i] = -sign * a);
        for normal in 0..self.frictions.len() {
            for (row, slope) in self.followers(normal) {
                direction[row] = slope * direction[normal];
            }
        }
        // The driver may itself be friction that was at its limit.
        direction[driver] = sign;
        direction
    }

    /// Friction rows that follow a normal, with ±μ.
    fn followers(&self, normal: usize) -> impl Iterator<Item = (usize, f64)> {
        self.frictions[normal].iter().filter_map(|&(row, coefficient)| match self.state[row] {
            State::Lower => Some((row, -coefficient)),
            State::Upper => Some((row, coefficient)),
            State::Waiting | State::Active => None,
        })
    }

    /// Entry of M E.
    fn folded(&self, row: usize, column: usize) -> f64 {
        let m = self.m.row(row);
        m[column] + self.followers(column).map(|(follower, slope)| slope * m[follower]).sum::<f64>()
    }

    /// (M E) in the active rows of one column.
    fn folded_column(&self, column: usize) -> Vec<f64> {
        self.active.iter().map(|&i| self.folded(i, column)).collect()
    }

    /// How far the push may go, and what stops it.
    fn first_event(&self, driver: usize, direction: &[f64], rate: &[f64]) -> Option<(f64, Event)> {
        let size = largest(direction);
        let mut first: Option<(f64, Event)> = None;
        let mut offer = |step: f64, event: Event| {
            if first.is_none_or(|(least, _)| step < least) {
                first = Some((step.max(0.0), event));
            }
        };
        let moves = |j: usize| rate[j].abs() > 1e-12 * self.row_norms[j] * size;
        if self.w[driver] * rate[driver] < 0.0 && moves(driver) {
            offer(-self.w[driver] / rate[driver], Event::DriverDone);
        }
        for j in 0..self.z.len() {
            let side = if j == driver { State::Active } else { self.state[j] };
            match side {
                State::Active => {
                    let (lower, upper) = self.problem.limits(j, &self.z);
                    let limit_rate = match self.problem.bounds()[j] {
                        Bound::Friction { normal, coefficient } => coefficient * direction[normal],
                        _ => 0.0,
                    };
                    let (to_upper, to_lower) = (direction[j] - limit_rate, direction[j] + limit_rate);
                    // Rounding alone never closes a gap.
                    let threshold = 1e-13 * size;
                    if to_upper > threshold && upper.is_finite() {
                        offer((upper - self.z[j]) / to_upper, Event::Bound(j, State::Upper));
                    }
                    if to_lower < -threshold && lower.is_finite() {
                        offer((self.z[j] - lower) / -to_lower, Event::Bound(j, State::Lower));
                    }
                }
                State::Lower if rate[j] < 0.0 && moves(j) && self.is_guarded(j, driver) => {
                    offer(self.w[j].max(0.0) / -rate[j], Event::Release(j));
                }
                State::Upper if rate[j] > 0.0 && moves(j) && self.is_guarded(j, driver) => {
                    offer((-self.w[j]).max(0.0) / rate[j], Event::Release(j));
                }
                State::Waiting | State::Lower | State::Upper => {}
            }
        }
        first
    }

    /// Friction under an unloaded normal may slide either way: both of its bounds are zero.
    fn is_guarded(&self, row: usize, driver: usize) -> bool {
        match self.problem.bounds()[row] {
            Bound::Friction { normal, .. } => self.state[normal] == State::Active || normal == driver,
            _ => true,
        }
    }

    /// Puts the friction of a normal that takes up load on the side that opposes its slip.
    fn turn_frictions(&mut self, normal: usize) {
        for k in 0..self.frictions[normal].len() {
            let row = self.frictions[normal][k].0;
            if matches!(self.state[row], State::Lower | State::Upper) {
                self.state[row] = if self.w[row] >= 0.0 { State::Lower } else { State::Upper };
            }
        }
    }

    /// Carries out what an event asks for.
    fn change_side(&mut self, driver: usize, sign: f64, event: Event) -> Result<(), Stop> {
        let singular = |row: usize| move |SingularUpdate| Stop::Singular(row);
        match event {
            Event::DriverDone => {
                self.w[driver] = 0.0;
                self.activate(driver).map_err(singular(driver))
            }
            Event::Bound(row, side) => {
                let (lower, upper) = self.problem.limits(row, &self.z);
                self.z[row] = if side == State::Upper { upper } else { lower };
                if row != driver {
                    self.deactivate(row).map_err(singular(row))?;
                }
                let opposes = (side == State::Upper) == (sign > 0.0);
                self.state[row] = if row == driver && !opposes && upper > lower { State::Waiting } else { side };
                self.fold(row, 1.0).map_err(singular(row))
            }
            Event::Release(row) => {
                self.w[row] = 0.0;
                self.fold(row, -1.0).map_err(singular(row))?;
                self.state[row] = State::Waiting;
                self.turn_frictions(row);
                self.activate(row).map_err(singular(row))
            }
        }
    }

    /// Adds the row to C.
    fn activate(&mut self, row: usize) -> Result<(), SingularUpdate> {
        let left: Vec<f64> = self.active.iter().map(|&k| self.folded(row, k)).collect();
        let column = self.folded_column(row);
        self.inverse.append(&left, &column, self.folded(row, row))?;
        self.active.push(row);
        self.state[row] = State::Active;
        Ok(())
    }

    /// Takes the row out of C, with any friction that sticks because of it.
    fn deactivate(&mut self, row: usize) -> Result<(), SingularUpdate> {
        for k in 0..self.frictions[row].len() {
            let friction = self.frictions[row][k].0;
            if self.state[friction] == State::Active {
                self.remove(friction)?;
                self.state[friction] = State::Lower;
                self.z[friction] = 0.0;
            }
        }
        self.remove(row)
    }

    fn remove(&mut self, row: usize) -> Result<(), SingularUpdate> {
        if let Some(at) = self.active.iter().position(|&i| i == row) {
            self.inverse.swap_remove(at)?;
            self.active.swap_remove(at);
        }
        Ok(())
    }

    /// Adds friction that is at its limit to the column of its normal, or takes it out again.
    fn fold(&mut self, row: usize, times: f64) -> Result<(), SingularUpdate> {
        let Bound::Friction { normal, coefficient } = self.problem.bounds()[row] else { return Ok(()) };
        let slope = match self.state[row] {
            State::Lower => -coefficient,
            State::Upper => coefficient,
            State::Waiting | State::Active => return Ok(()),
        };
        let Some(at) = self.active.iter().position(|&i| i == normal) else { return Ok(()) };
        let change: Vec<f64> = self.active.iter().map(|&i| times * slope * self.m[(i, row)]).collect();
        self.inverse.add_to_column(at, &change)
    }

    /// Computes the inverse afresh.
    fn rebuild(&mut self) -> Result<(), SingularUpdate> {
        let k = self.active.len();
        self.inverse.rebuild(Matrix::from_fn(k, k, |r, c| self.folded(self.active[r], self.active[c])))
    }

    /// Takes accumulated rounding out of the inverse and of z and w.
    fn refresh(&mut self) -> Result<(), Stop> {
        self.rebuild().map_err(|SingularUpdate| Stop::Singular(self.active.first().copied().unwrap_or(0)))?;
        let defect: Vec<f64> = self.active.iter().map(|&i| self.problem.q()[i] + dot(self.m.row(i), &self.z)).collect();
        let correction = self.inverse.multiply(&defect);
        for (k, &i) in self.active.iter().enumerate() {
            self.z[i] -= correction[k];
        }
        for (normal, frictions) in self.frictions.iter().enumerate() {
            for &(row, coefficient) in frictions {
                match self.state[row] {
                    State::Lower => self.z[row] = -coefficient * self.z[normal],
                    State::Upper => self.z[row] = coefficient * self.z[normal],
                    State::Waiting | State::Active => {}
                }
            }
        }
        self.w = self.problem.w(&self.z);
        self.active.iter().for_each(|&i| self.w[i] = 0.0);
        Ok(())
    }
}
