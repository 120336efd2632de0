//! One-by-one impulses: colliding contacts, worst first, again and again until none is colliding (L5, L6).
//!
//! Each contact that approaches gets the impulse that turns its approach round, as if it were alone:
//!
//! ```text
//! v_n⁺ = −ε v_n⁻                                          Newton's law of restitution (L5)
//! sticking:  v_t⁺ = 0           if that needs |j_t| ≤ μ_s j_n
//! sliding:   j_t = μ_k j_n d    with d against the final slip, otherwise (L10)
//! ```
//!
//! both with the full compliance K of the point, so that the tangential impulse feeds back into the normal one. Without friction
//! this is the lecture's j = −(1 + ε) v_n⁻ / K_nn.
//!
//! Always the point that approaches fastest is next; of equals, the first row. Beyond 400 points the order is found once per round.
//!
//! Good at: single impacts, chains (Newton's cradle), exactness. Bad at: simultaneous impacts of one body, where the answer
//! depends on the order. Known limit: Newton's law with friction can create energy in
//! rare configurations (Kane's paradox; Wang and Mason 1992).

use tumble_math::{Dim, Linear, Matrix, Vector};

use crate::contact::tangential;
use crate::island::can_move;
use crate::joint::{JointBlock, Joints};
use crate::{ContactRow, Ending, Report, SolverBody, Surface};

/// When to begin and when to give up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImpactSettings {
    /// A point that approaches faster than this is colliding [m/s].
    pub colliding_above: f64,
    /// Most impulses per contact point, on average [1].
    pub impulses_per_contact: u32,
}

/// How the approach of one point is to be read.
///
/// Velocities at the end of a step contain a whole step of acceleration, also for a point that met the surface on the way, and
/// their round-off and solver error for a point that rests. Restitution must not answer either.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Approach {
    /// Added to the approach speed of the first impulse before restitution reads it [m/s].
    pub correction: f64,
    /// Extra separating speed of a rebound: ½|a|Δt for symplectic Euler, whose velocities run half a step ahead of its positions [m/s].
    pub half_step: f64,
    /// A rebound no faster than this would not leave the surface within the step, and is rest [m/s].
    pub rest_below: f64,
    /// Approach speed that is no collision but the error of an earlier solver: until its first impulse, the point is colliding only
    /// beyond it [m/s].
    pub ignored: f64,
    /// The point is colliding when it approaches faster than this, besides [`ImpactSettings::colliding_above`] [m/s].
    pub threshold: f64,
}

/// Resolves all colliding contacts of `rows`.
///
/// `approaches[i]` corrects the first impulse of point i; `given[i]` is set to the sum of impulses at point i, in its
/// contact frame [N·s]. The report counts impulses; its residual is the fastest approach left.
pub fn resolve_one_by_one<D: Dim>(
    bodies: &mut [SolverBody<D>],
    rows: &[ContactRow<D>],
    approaches: &mut [Approach],
    given: &mut Vec<D::Vector>,
    settings: &ImpactSettings,
) -> Report {
    resolve(bodies, rows, approaches, given, &mut None, settings)
}

/// The same with joints: each impulse meets the compliance of its point with joints held, and they are held after it.
pub fn resolve_one_by_one_with_joints<D: Dim>(
    bodies: &mut [SolverBody<D>],
    rows: &[ContactRow<D>],
    approaches: &mut [Approach],
    given: &mut Vec<D::Vector>,
    joints: Joints<'_, D>,
    settings: &ImpactSettings,
) -> Report {
    joints.block.stop(bodies, joints.rows);
    resolve(bodies, rows, approaches, given, &mut Some(joints), settings)
}

fn resolve<D: Dim>(
    bodies: &mut [SolverBody<D>],
    rows: &[ContactRow<D>],
    approaches: &mut [Approach],
    given: &mut Vec<D::Vector>,
    joints: &mut Option<Joints<'_, D>>,
    settings: &ImpactSettings,
) -> Report {
    given.clear();
    given.resize(rows.len(), D::Vector::ZERO);
    let mut report = Report::default();
    // Points that are not colliding are all alike to the queue, so that most changes of speed leave it as it is.
    let excess = |bodies: &[SolverBody<D>], i: usize, approach: &Approach| {
        (-rows[i].separating_speed(bodies) - approach.ignored - approach.threshold - settings.colliding_above).max(0.0)
    };
    if !(0..rows.len()).any(|i| excess(bodies, i, &approaches[i]) > 0.0) {
        return report;
    }

    let cap = (rows.len() as u64 * u64::from(settings.impulses_per_contact)).min(u64::from(u32::MAX)) as u32;
    let mut order = Order::of(bodies, rows);
    while let Some(worst) =
        order.next(joints.as_ref().map(|joints| &*joints.block), |i| excess(bodies, i, &approaches[i]))
    {
        if report.iterations == cap {
            report.ending = Ending::NotConverged;
            break;
        }
        report.iterations += 1;
        let row = &rows[worst];
        let velocity = row.relative_velocity(bodies);
        let rebound = rebound_speed(-velocity[0], row.surface.restitution, &mut approaches[worst]);
        let compliance = match joints {
            Some(joints) => joints.block.compliance(joints.rows, row),
            None => row.compliance(bodies),
        };
        let impulse = impulse_for(&compliance, velocity, rebound, &row.surface);
        row.apply(bodies, impulse);
        if let Some(joints) = joints {
            joints.block.stop_near([row.a, row.b], bodies, joints.rows);
        }
        given[worst] += impulse;
    }
    let left = |(row, approach): (&ContactRow<D>, &Approach)| {
        -row.separating_speed(bodies) - approach.ignored - approach.threshold
    };
    report.residual = rows.iter().zip(approaches.iter()).map(left).fold(0.0, f64::max);
    report
}

/// Separating speed after an impact at `approach` speed; uses up the correction [m/s].
fn rebound_speed(approach: f64, restitution: f64, reading: &mut Approach) -> f64 {
    let Approach { correction, half_step, rest_below, threshold, .. } = *reading;
    *reading = Approach { threshold, ..Approach::default() };
    let rebound = restitution * (approach + correction).max(0.0);
    if rebound > rest_below { rebound + half_step } else { 0.0 }
}

/// The impulse, in the contact frame, after which a point separates at `rebound` and sticks or slides [N·s].
///
/// `compliance` is K, `velocity` the relative velocity before, both in the contact frame.
pub fn impulse_for<V: Vector, M: Matrix<V>>(compliance: &M, velocity: V, rebound: f64, surface: &Surface) -> V {
    let target = V::unit(0) * rebound;
    let sticking = compliance.try_inverse().map(|inverse| inverse.apply(target - velocity));
    if let Some(impulse) = sticking
        && tangential(impulse).length() <= surface.static_friction * impulse[0]
    {
        return impulse;
    }

    let slide = |friction_direction: V| {
        let direction = V::unit(0) + friction_direction * surface.kinetic_friction;
        let yielding = compliance.apply(direction)[0];
        (yielding > 0.0).then(|| direction * ((rebound - velocity[0]) / yielding))
    };
    let Some(frictionless) = slide(V::ZERO) else { return V::ZERO };
    // Friction acts against the final slip, which friction itself changes: begin with the slip that would be without it.
    let mut direction = against(velocity + compliance.apply(frictionless), velocity);
    for _ in 0..8 {
        let Some(impulse) = slide(direction) else { break };
        let slip = tangential(velocity + compliance.apply(impulse));
        let consistent = against(slip, slip);
        if slip.dot(direction) <= 0.0 && (consistent - direction).length() < 1e-12 || slip == V::ZERO {
            return impulse;
        }
        direction = consistent;
    }
    // Neither slides consistently (possible for μ_k > μ_s, or where friction jams the point): it sticks.
    sticking.filter(|impulse| impulse[0] > 0.0).unwrap_or(frictionless)
}

/// Unit tangent against a slip; against `fallback` where there is none.
fn against<V: Vector>(slip: V, fallback: V) -> V {
    let direction = tangential(slip).try_normalize().or_else(|| tangential(fallback).try_normalize());
    -direction.unwrap_or(V::ZERO)
}

/// Up to this many points the worst is looked for after every impulse; beyond, once per round.
const POINTS_WORST_FIRST: usize = 400;

/// Chooses the next colliding point.
struct Order {
    neighbours: Neighbours,
    ends: Vec<[u32; 2]>,
    method: Method,
}

enum Method {
    /// Always the worst. The excess of every point is kept, and looked at again where the last impulse acted.
    WorstFirst { excesses: Vec<f64>, last: Option<usize> },
    /// In rounds: the colliding points of a round in falling order of excess, those skipped that an earlier impulse of the round has
    /// stopped; again until a round finds none. For many points, where always looking for the worst would cost more than the impulses.
    Rounds {
        round: Vec<(f64, u32)>,
        next: usize,
        /// Points where an impulse of this round has acted, each once: only those can collide in the next round.
        stirred: Vec<u32>,
        is_stirred: Vec<bool>,
    },
}

impl Order {
    fn of<D: Dim>(bodies: &[SolverBody<D>], rows: &[ContactRow<D>]) -> Self {
        let method = if rows.len() > POINTS_WORST_FIRST {
            let all = (0..rows.len() as u32).collect();
            Method::Rounds { round: Vec::new(), next: 0, stirred: all, is_stirred: vec![true; rows.len()] }
        } else {
            Method::WorstFirst { excesses: Vec::new(), last: None }
        };
        let ends = rows.iter().map(|row| [row.a, row.b]).collect();
        Self { neighbours: Neighbours::of(bodies, rows), ends, method }
    }

    /// The next colliding point; of equals, the first. `excess` is by how much a point is colliding now, 0 if it is not.
    fn next<D: Dim>(&mut self, joints: Option<&JointBlock<D>>, excess: impl Fn(usize) -> f64) -> Option<usize> {
        match &mut self.method {
            Method::WorstFirst { excesses, last } => {
                match last {
                    Some(last) => {
                        self.neighbours.for_each_stirred(self.ends[*last], joints, |i| {
                            excesses[i as usize] = excess(i as usize);
                        });
                    }
                    None => excesses.extend((0..self.ends.len()).map(excess)),
                }
                let mut worst = 0.0;
                *last = None;
                for (i, excess) in excesses.iter().enumerate() {
                    if *excess > worst {
                        (worst, *last) = (*excess, Some(i));
                    }
                }
                *last
            }
            Method::Rounds { round, next, stirred, is_stirred } => loop {
                while let Some(&(_, i)) = round.get(*next) {
                    *next += 1;
                    if excess(i as usize) > 0.0 {
                        self.neighbours.for_each_stirred(self.ends[i as usize], joints, |neighbour| {
                            if !std::mem::replace(&mut is_stirred[neighbour as usize], true) {
                                stirred.push(neighbour);
                            }
                        });
                        return Some(i as usize);
                    }
                }
                *next = 0;
                round.clear();
                for i in stirred.drain(..) {
                    is_stirred[i as usize] = false;
                    let excess = excess(i as usize);
                    if excess > 0.0 {
                        round.push((excess, i));
                    }
                }
                round.sort_unstable_by(|x, y| y.0.total_cmp(&x.0).then(x.1.cmp(&y.1)));
                if round.is_empty() {
                    return None;
                }
            },
        }
    }
}

/// The rows at each body that can move, so that an impulse updates only those.
struct Neighbours {
    starts: Vec<u32>,
    rows: Vec<u32>,
}

impl Neighbours {
    fn of<D: Dim>(bodies: &[SolverBody<D>], rows: &[ContactRow<D>]) -> Self {
        let movable = |body: u32| can_move(&bodies[body as usize]);
        let ends = |row: &ContactRow<D>| [row.a, row.b].into_iter().filter(|body| movable(*body));
        let mut starts = vec![0_u32; bodies.len() + 1];
        for body in rows.iter().flat_map(ends) {
            starts[body as usize + 1] += 1;
        }
        for i in 0..bodies.len() {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut sorted = vec![0_u32; starts[bodies.len()] as usize];
        for (i, row) in rows.iter().enumerate() {
            for body in ends(row) {
                sorted[next[body as usize] as usize] = i as u32;
                next[body as usize] += 1;
            }
        }
        Self { starts, rows: sorted }
    }

    /// Calls with every row that an impulse between two bodies changes: those at either body, and at bodies joined to them. A row may come
    /// twice, which costs a look and changes nothing.
    fn for_each_stirred<D: Dim>(&self, ends: [u32; 2], joints: Option<&JointBlock<D>>, mut stirred: impl FnMut(u32)) {
        let at = |body: u32| &self.rows[self.starts[body as usize] as usize..self.starts[body as usize + 1] as usize];
        match joints {
            Some(joints) => joints.reached_by(ends).for_each(|body| at(body).iter().for_each(|row| stirred(*row))),
            None => ends.iter().for_each(|body| at(*body).iter().for_each(|row| stirred(*row))),
        }
    }
}
