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

mod flight;

use bevy_ecs::prelude::*;
use tumble_collision::FeatureId;
use tumble_math::{Dim, Linear};

use super::problem::PairQuery;
use super::{Colliders, Detection, PointMemory};
use crate::body::{AngularVelocity, BodyIndex, LinearVelocity, PreviousVelocity};
use crate::fault::Fault;
use crate::geometry::Geometry;
use crate::joint::JointProblem;
use crate::notice::Notices;
use crate::part::Response;
use crate::{Clock, Settings};

use flight::{Course, Meeting, Point, PointState};

/// Most parts of a step: impacts that follow each other more closely are answered at the end of the step.
pub const MOST_PARTS: u32 = 1000;
/// Arrivals within this part of the step after the first are simultaneous [1].
const SIMULTANEOUS: f64 = 1e-12;

/// What is to be done with the part of the step that phases 1 to 3 have prepared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Pass {
    /// Find its first impact, and end it there.
    #[default]
    Look,
    /// It was taken back, to be prepared again as a shorter one that ends with the impact.
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
    flights: Vec<Flight>,
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

/// A pair with points that may arrive.
#[derive(Clone, Copy, Debug)]
struct Flight {
    entity: Entity,
    /// First of its points in the list of all.
    first: u32,
    count: u32,
    /// When its first point arrives; `None` if none does in this part [s].
    arrival: Option<f64>,
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
        Pass::TakenBack => {
            impacts.pass = Pass::Look;
            forget_accelerations::<D>(bodies.iter_mut().map(|(.., previous)| previous));
            return;
        }
        Pass::GivenUp => {
            notices.too_many_impacts(clock.step + 1);
            land_all(&mut pairs);
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
    if part - end <= shortest {
        if impacts.arrives {
            forget_accelerations::<D>(bodies.iter_mut().map(|(.., previous)| previous));
        }
        return;
    }
    clock.cut(end);
    impacts.pass = Pass::TakenBack;
    joints.take_back_part();
    for (_, mut velocity, mut spin, previous) in &mut bodies {
        velocity.bypass_change_detection().0 = previous.linear;
        spin.bypass_change_detection().0 = previous.angular;
    }
    for (.., mut memory) in &mut pairs {
        for point in memory.bypass_change_detection().0.as_mut() {
            let point: &mut PointMemory<D::Vector> = point;
            point.pending = D::Vector::ZERO;
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
        previous.bypass_change_detection().drive = None;
    }
}

/// No point flies any more: contacts are answered as without cuts.
fn land_all<D: Geometry>(pairs: &mut PairQuery<D>) {
    for (.., mut memory) in pairs {
        memory.bypass_change_detection().0.as_mut().iter_mut().for_each(|point| point.flies = false);
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
        for (entity, pair, manifold, memory) in pairs {
            if pair.response == Response::Sensor || D::points(&manifold.0).is_empty() {
                continue;
            }
            let meeting = Meeting::new(pair, manifold, colliders, detection, courses, settings);
            let first = points.len();
            let poses = pair.bodies.map(|body| courses[body as usize].from);
            for (point, memory) in D::points(&manifold.0).iter().zip(memory.0.as_ref()) {
                let (rate, bend) = meeting.rates(D::normal(&manifold.0), point.point, &poses, 0.0);
                let state = match memory.touches {
                    false => PointState::Apart,
                    true => PointState::of_touching(settings, D::normal(&manifold.0), rate, bend),
                };
                points.push(Point { feature: point.feature, state });
            }
            let extents = pair.colliders.map(|collider| colliders.as_slice()[collider as usize].extent());
            let fastest = meeting.fastest(extents, part);
            let arrival = meeting.first_arrival(&points[first..], settings, fastest, part);
            let count = (points.len() - first) as u32;
            flights.push(Flight { entity, first: first as u32, count, arrival });
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
            let there = arrives
                .then(|| Meeting::new(pair, manifold, colliders, detection, &self.courses, settings).manifold(end).0);
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
