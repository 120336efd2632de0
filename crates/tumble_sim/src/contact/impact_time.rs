//! Cutting the step at impacts, for [`Settings::time_of_impact`].
//!
//! Phases 1 to 3 give every body its velocity after the rest of the step. Between, bodies move ballistically,
//!
//! ```text
//! x(τ) = x₀ + v₀ τ + ½ (v₁ − v₀) τ²/h        and turn alike,  0 ≤ τ ≤ h
//! ```
//!
//! so every gap is a function of τ. The first τ at which a gap closes is where this part of the step has to end: phases 1 to 3
//! are taken back, done again for a part of that length, and phases 4 to 6 follow. The next part begins with the rebound, and so on until the step is full.
//!
//! A point that has bounced *flies* until it arrives again, however small its gap; a point that separates no faster than
//! [`Settings::rest_speed`] rests, and the velocity filter holds it. A flight too low to be told from round-off returns after 2 u/|a|, from the
//! surface it left. That lets bounces shrink by their law to the end of their Zeno time, and then rest.

use bevy_ecs::prelude::*;
use tumble_collision::{FeatureId, Gap, Search, first_arrival, parabola_arrival};
use tumble_math::{Dim, Linear, Pose, Rotation};

use super::detect::BodyMotion;
use super::problem::PairQuery;
use super::{Colliders, ContactManifold, ContactPair, Detection, PointMemory};
use crate::body::{AngularVelocity, BodyIndex, LinearVelocity, PreviousVelocity};
use crate::fault::Fault;
use crate::geometry::{ContactQuery, Geometry, Posed};
use crate::joint::JointProblem;
use crate::notice::Notices;
use crate::{Clock, Settings};

/// Most parts of a step: impacts that follow each other more closely are answered at the end of the step.
pub const MOST_PARTS: u32 = 1000;
/// Flights lower than this are told from their speed alone: gaps have lost their digits, in length scales.
const LOWEST_FLIGHT: f64 = 1e-9;
/// Gap below which the parabola of a gap is followed, in length scales.
const NEAR: f64 = 1e-6;
/// Arrivals within this part of the step after the first are simultaneous [1].
const SIMULTANEOUS: f64 = 1e-12;

/// What is to be done with the part of the step that phases 1 to 3 have prepared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Pass {
    /// Find its first impact.
    #[default]
    Look,
    /// It ends with an impact that was found.
    Cut,
    /// It was taken back, to be prepared again as a shorter one.
    TakenBack,
    /// There have been too many: take it as it is.
    GivenUp,
}

/// Where the step is being cut.
#[derive(Resource, Debug)]
pub struct ImpactTimes<D: Geometry> {
    pub(crate) pass: Pass,
    parts: u32,
    courses: Vec<Course<D>>,
    flights: Vec<Flight<D>>,
    points: Vec<Point>,
    /// Whether something arrives at the end of the part.
    pub(crate) arrives: bool,
}

impl<D: Geometry> Default for ImpactTimes<D> {
    fn default() -> Self {
        Self {
            pass: Pass::Look,
            parts: 0,
            courses: Vec::new(),
            flights: Vec::new(),
            points: Vec::new(),
            arrives: false,
        }
    }
}

impl<D: Geometry> ImpactTimes<D> {
    /// Begins a step.
    pub(crate) fn begin_step(&mut self) {
        (self.pass, self.parts, self.arrives) = (Pass::Look, 0, false);
    }

    /// Begins the next part of a step.
    pub(crate) fn begin_part(&mut self) {
        self.parts += 1;
        self.arrives = false;
        self.pass = if self.parts < MOST_PARTS { Pass::Look } else { Pass::GivenUp };
    }
}

/// Whether the part that was prepared is to be taken.
pub(crate) fn is_taken<D: Geometry>(impacts: Res<ImpactTimes<D>>) -> bool {
    impacts.pass != Pass::TakenBack
}

/// The way of a body through the part.
#[derive(Clone, Copy, Debug)]
struct Course<D: Dim> {
    from: Pose<D>,
    velocity: D::Vector,
    angular_velocity: D::Angular,
    acceleration: D::Vector,
    angular_acceleration: D::Angular,
}

impl<D: Geometry> Course<D> {
    /// One that stays where it is.
    fn still(motion: &BodyMotion<D>) -> Self {
        Self {
            from: motion.pose,
            velocity: D::Vector::ZERO,
            angular_velocity: D::Angular::ZERO,
            acceleration: D::Vector::ZERO,
            angular_acceleration: D::Angular::ZERO,
        }
    }

    fn pose(&self, time: f64) -> Pose<D> {
        Pose {
            position: self.from.position + (self.velocity + self.acceleration * (0.5 * time)) * time,
            rotation: self
                .from
                .rotation
                .turned((self.angular_velocity + self.angular_acceleration * (0.5 * time)) * time),
        }
    }

    /// Velocity and acceleration of a point of the body that is at `arm` from its centre.
    fn point(&self, arm: D::Vector, time: f64) -> (D::Vector, D::Vector) {
        let spin = self.angular_velocity + self.angular_acceleration * time;
        let around = D::spin(spin, arm);
        let velocity = self.velocity + self.acceleration * time + around;
        let acceleration = self.acceleration + D::spin(self.angular_acceleration, arm) + D::spin(spin, around);
        (velocity, acceleration)
    }

    /// No point within `extent` of the centre is faster before `until` [m/s].
    fn fastest(&self, extent: f64, until: f64) -> f64 {
        let velocity = self.velocity.length().max((self.velocity + self.acceleration * until).length());
        let end = self.angular_velocity + self.angular_acceleration * until;
        velocity + self.angular_velocity.length().max(end.length()) * extent
    }
}

/// A pair with points that may arrive.
#[derive(Clone, Copy, Debug)]
struct Flight<D: Geometry> {
    entity: Entity,
    /// First of its points in the list of all.
    first: u32,
    count: u32,
    /// When its first point arrives; `None` if none does in this part [s].
    arrival: Option<f64>,
    dim: std::marker::PhantomData<D>,
}

/// A contact point of a pair.
#[derive(Clone, Copy, Debug)]
struct Point {
    feature: FeatureId,
    state: PointState,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum PointState {
    /// The velocity filter holds it.
    Resting,
    /// It has a gap, or flies.
    Apart,
    /// It leaves the surface, and can arrive again only after `apex` [s].
    Leaving { apex: f64 },
    /// It leaves, too slowly for its gap to be seen, and is back at `back` [s].
    Skipping { back: f64 },
}

impl PointState {
    /// Whether a search that begins at `from` has to heed the point.
    fn is_awaited(self, from: f64) -> bool {
        match self {
            Self::Apart => true,
            Self::Leaving { apex } => apex <= from,
            Self::Resting | Self::Skipping { .. } => false,
        }
    }
}

/// Two parts and their ways.
struct Meeting<'a, D: Geometry> {
    shapes: [&'a D::Shape; 2],
    courses: [&'a Course<D>; 2],
    query: ContactQuery<'a, D>,
}

impl<D: Geometry> Meeting<'_, D> {
    fn manifold(&self, time: f64) -> (D::Manifold, [Pose<D>; 2]) {
        let poses = self.courses.map(|course| course.pose(time));
        let [a, b] = &poses;
        let [shape_a, shape_b] = self.shapes;
        (D::collide(Posed { shape: shape_a, pose: a }, Posed { shape: shape_b, pose: b }, &self.query), poses)
    }

    /// Rate and bend of the gap of a point, the normal taken as steady.
    fn rates(&self, normal: D::Vector, point: D::Vector, poses: &[Pose<D>; 2], time: f64) -> (f64, f64) {
        let [a, b] = [0, 1].map(|k| self.courses[k].point(point - poses[k].position, time));
        (normal.dot(b.0 - a.0), normal.dot(b.1 - a.1))
    }

    /// The smallest gap of the points that `wanted` lets through.
    fn gap(&self, time: f64, wanted: impl Fn(FeatureId) -> bool) -> Gap {
        let (manifold, poses) = self.manifold(time);
        let nearest = D::points(&manifold)
            .iter()
            .filter(|point| wanted(point.feature))
            .min_by(|one, other| one.separation.total_cmp(&other.separation));
        let Some(point) = nearest else { return Gap { separation: self.query.margin, ..Gap::default() } };
        let (rate, bend) = self.rates(D::normal(&manifold), point.point, &poses, time);
        Gap { separation: point.separation, rate, bend }
    }
}

/// Finds the first impact of the part of the step that is about to be taken, and cuts the part there.
pub fn look_for_impacts<D: Geometry>(
    mut clock: ResMut<Clock>,
    settings: Res<Settings<D>>,
    colliders: Res<Colliders<D>>,
    detection: Res<Detection<D>>,
    fault: Res<Fault>,
    mut impacts: ResMut<ImpactTimes<D>>,
    mut joints: ResMut<JointProblem<D>>,
    mut notices: ResMut<Notices>,
    mut pairs: PairQuery<D>,
    mut bodies: Query<(
        &BodyIndex,
        &mut LinearVelocity<D::Vector>,
        &mut AngularVelocity<D::Angular>,
        &mut PreviousVelocity<D::Vector, D::Angular>,
    )>,
) {
    if !fault.is_none() {
        return;
    }
    let impacts = &mut *impacts;
    let part = clock.part();
    match impacts.pass {
        Pass::Look => {}
        Pass::Cut | Pass::TakenBack => {
            impacts.pass = Pass::Cut;
            forget_accelerations::<D>(bodies.iter_mut().map(|(.., previous)| previous));
            return;
        }
        Pass::GivenUp => {
            notices.too_many_impacts(clock.step + 1);
            land_all(&detection, &mut pairs);
            return;
        }
    }
    impacts.courses.clear();
    impacts.courses.extend(detection.motions().iter().map(Course::still));
    for (index, velocity, spin, previous) in &bodies {
        let course = &mut impacts.courses[index.0 as usize];
        (course.velocity, course.angular_velocity) = (previous.linear, previous.angular);
        course.acceleration = (velocity.0 - previous.linear) * (1.0 / part);
        course.angular_acceleration = (spin.0 - previous.angular) * (1.0 / part);
    }

    impacts.find_flights(&settings, &colliders, &detection, &pairs, part);
    let first = impacts.flights.iter().filter_map(|flight| flight.arrival).fold(f64::INFINITY, f64::min);
    let shortest = SIMULTANEOUS * clock.dt;
    let end = first.max(shortest).min(part);
    impacts.mark_arrivals(&settings, &colliders, &detection, &mut pairs, end, end + shortest);
    impacts.arrives = first.is_finite();
    if impacts.arrives {
        forget_accelerations::<D>(bodies.iter_mut().map(|(.., previous)| previous));
    }
    if part - end <= shortest {
        return;
    }
    clock.cut(end);
    impacts.pass = Pass::TakenBack;
    joints.take_back_part();
    for (_, mut velocity, mut spin, previous) in &mut bodies {
        velocity.bypass_change_detection().0 = previous.linear;
        spin.bypass_change_detection().0 = previous.angular;
    }
    for entity in detection.solid_pairs() {
        if let Ok((.., mut memory)) = pairs.get_mut(entity) {
            for point in memory.bypass_change_detection().0.as_mut() {
                let point: &mut PointMemory<D::Vector> = point;
                point.pending = D::Vector::ZERO;
            }
        }
    }
}

/// Impacts make accelerations jump, which the trapezoidal rule of the integrator would take for a smooth change.
fn forget_accelerations<'a, D: Dim>(previous: impl Iterator<Item = Mut<'a, PreviousVelocity<D::Vector, D::Angular>>>)
where
    D::Vector: 'a,
    D::Angular: 'a,
{
    for mut previous in previous {
        previous.bypass_change_detection().accelerations = None;
    }
}

/// No point flies any more: contacts are answered as without cuts.
fn land_all<D: Geometry>(detection: &Detection<D>, pairs: &mut PairQuery<D>) {
    for entity in detection.solid_pairs() {
        if let Ok((.., mut memory)) = pairs.get_mut(entity) {
            memory.bypass_change_detection().0.as_mut().iter_mut().for_each(|point| point.flies = false);
        }
    }
}

fn meeting<'a, D: Geometry>(
    pair: &ContactPair,
    manifold: &'a ContactManifold<D>,
    colliders: &'a Colliders<D>,
    detection: &Detection<D>,
    courses: &'a [Course<D>],
    settings: &Settings<D>,
) -> Meeting<'a, D> {
    let reach = |body: u32| detection.motions()[body as usize].reach;
    Meeting {
        shapes: pair.colliders.map(|collider| &colliders.as_slice()[collider as usize].shape),
        courses: pair.bodies.map(|body| &courses[body as usize]),
        query: ContactQuery {
            margin: reach(pair.bodies[0]) + reach(pair.bodies[1]),
            flush_tolerance: 2.0 * settings.slop() + settings.touch_tolerance(),
            previous: &manifold.0,
        },
    }
}

impl<D: Geometry> ImpactTimes<D> {
    /// Lists the pairs whose points may arrive, and when the first of each does.
    fn find_flights(
        &mut self,
        settings: &Settings<D>,
        colliders: &Colliders<D>,
        detection: &Detection<D>,
        pairs: &PairQuery<D>,
        part: f64,
    ) {
        let Self { courses, flights, points, .. } = self;
        flights.clear();
        points.clear();
        for entity in detection.solid_pairs() {
            let Ok((_, pair, manifold, memory)) = pairs.get(entity) else { continue };
            let meeting = meeting(pair, manifold, colliders, detection, courses, settings);
            let first = points.len();
            let poses = pair.bodies.map(|body| courses[body as usize].from);
            for (point, memory) in D::points(&manifold.0).iter().zip(memory.0.as_ref()) {
                let (rate, bend) = meeting.rates(D::normal(&manifold.0), point.point, &poses, 0.0);
                let state = match memory.touches {
                    false => PointState::Apart,
                    true => departing(settings, D::normal(&manifold.0), rate, bend),
                };
                points.push(Point { feature: point.feature, state });
            }
            let fastest: f64 = (0..2)
                .map(|k| meeting.courses[k].fastest(colliders.as_slice()[pair.colliders[k] as usize].extent, part))
                .sum();
            let arrival = first_of_pair(&meeting, &points[first..], settings, fastest, part);
            let count = (points.len() - first) as u32;
            flights.push(Flight { entity, first: first as u32, count, arrival, dim: std::marker::PhantomData });
        }
    }

    /// Tells the points that arrive at the end of the part from those that fly on.
    fn mark_arrivals(
        &mut self,
        settings: &Settings<D>,
        colliders: &Colliders<D>,
        detection: &Detection<D>,
        pairs: &mut PairQuery<D>,
        end: f64,
        until: f64,
    ) {
        for flight in &self.flights {
            let Ok((_, pair, manifold, mut memory)) = pairs.get_mut(flight.entity) else { continue };
            let points = &self.points[flight.first as usize..(flight.first + flight.count) as usize];
            let arrives = flight.arrival.is_some_and(|arrival| arrival <= until);
            let there =
                arrives.then(|| meeting(pair, manifold, colliders, detection, &self.courses, settings).manifold(end).0);
            let closed = |feature: FeatureId| {
                let points = there.as_ref().map_or(&[][..], |manifold| D::points(manifold));
                points.iter().any(|point| point.feature == feature && point.separation <= settings.touch_tolerance())
            };
            for (memory, point) in memory.bypass_change_detection().0.as_mut().iter_mut().zip(points) {
                memory.flies = match point.state {
                    PointState::Resting => false,
                    PointState::Apart => !closed(point.feature),
                    PointState::Leaving { apex } => apex >= end || !closed(point.feature),
                    PointState::Skipping { back } => back > until,
                };
                memory.hopped = memory.touches && point.state != PointState::Resting && !memory.flies;
            }
        }
    }
}

/// What a touching point does whose gap has this rate and bend.
fn departing<D: Geometry>(settings: &Settings<D>, normal: D::Vector, rate: f64, bend: f64) -> PointState {
    if rate <= settings.rest_speed(normal) {
        return PointState::Resting;
    }
    if bend >= 0.0 {
        return PointState::Leaving { apex: f64::INFINITY };
    }
    let height = 0.5 * rate * rate / -bend;
    match parabola_arrival(&Gap { separation: 0.0, rate, bend }) {
        Some(back) if height < LOWEST_FLIGHT * settings.length_scale => PointState::Skipping { back },
        _ => PointState::Leaving { apex: rate / -bend },
    }
}

/// When the first point of a pair arrives.
fn first_of_pair<D: Geometry>(
    meeting: &Meeting<'_, D>,
    points: &[Point],
    settings: &Settings<D>,
    fastest: f64,
    part: f64,
) -> Option<f64> {
    let mut first = points
        .iter()
        .filter_map(|point| match point.state {
            PointState::Skipping { back } if back <= part => Some(back),
            _ => None,
        })
        .reduce(f64::min);
    // A pair at rest has points that rest, and nothing to wait for.
    if points.iter().all(|point| matches!(point.state, PointState::Resting | PointState::Skipping { .. })) {
        return first;
    }
    let mut begins = vec![0.0];
    begins.extend(points.iter().filter_map(|point| match point.state {
        PointState::Leaving { apex } if apex < part => Some(apex),
        _ => None,
    }));
    begins.sort_unstable_by(f64::total_cmp);
    for (i, &from) in begins.iter().enumerate() {
        let until = begins.get(i + 1).copied().unwrap_or(part).min(first.unwrap_or(part));
        if from > until {
            break;
        }
        let wanted = |feature: FeatureId| {
            points.iter().find(|point| point.feature == feature).is_none_or(|point| point.state.is_awaited(from))
        };
        let search =
            Search { from, until, fastest, near: NEAR * settings.length_scale, slowest: settings.colliding_above() };
        if let Some(arrival) = first_arrival(&search, |time| meeting.gap(time, wanted)) {
            first = Some(first.map_or(arrival, |known| known.min(arrival)));
            break;
        }
    }
    first
}
