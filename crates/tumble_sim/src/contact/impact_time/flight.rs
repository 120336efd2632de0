//! The ways of bodies through a part of a step, and when the gaps between them close.

use tumble_collision::{FeatureId, Gap, Search, first_arrival, parabola_arrival};
use tumble_math::{Dim, Linear, Pose, Rotation};

use crate::Settings;
use crate::contact::detect::BodyMotion;
use crate::contact::{Colliders, ContactManifold, ContactPair, Detection};
use crate::geometry::{ContactQuery, Geometry, Posed};

/// Flights lower than this are told from their speed alone: gaps have lost their digits, in length scales.
const LOWEST_FLIGHT: f64 = 1e-9;
/// Gap below which the parabola of a gap is followed, in length scales.
const NEAR: f64 = 1e-6;

/// The way of a body through the part.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course<D: Dim> {
    pub(super) from: Pose<D>,
    pub(super) velocity: D::Vector,
    pub(super) angular_velocity: D::Angular,
    pub(super) acceleration: D::Vector,
    pub(super) angular_acceleration: D::Angular,
}

impl<D: Geometry> Course<D> {
    /// One that stays where it is.
    pub(super) fn still(motion: &BodyMotion<D>) -> Self {
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

/// A contact point of a pair.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub(super) feature: FeatureId,
    pub(super) state: PointState,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum PointState {
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
    /// What a touching point does whose gap has this rate and bend.
    pub(super) fn of_touching<D: Geometry>(settings: &Settings<D>, normal: D::Vector, rate: f64, bend: f64) -> Self {
        if rate <= settings.rest_speed(normal) {
            return Self::Resting;
        }
        if bend >= 0.0 {
            return Self::Leaving { apex: f64::INFINITY };
        }
        let height = 0.5 * rate * rate / -bend;
        match parabola_arrival(&Gap { separation: 0.0, rate, bend }) {
            Some(back) if height < LOWEST_FLIGHT * settings.length_scale => Self::Skipping { back },
            _ => Self::Leaving { apex: rate / -bend },
        }
    }

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
pub(super) struct Meeting<'a, D: Geometry> {
    shapes: [&'a D::Shape; 2],
    courses: [&'a Course<D>; 2],
    query: ContactQuery<'a, D>,
}

impl<'a, D: Geometry> Meeting<'a, D> {
    pub(super) fn new(
        pair: &ContactPair,
        manifold: &'a ContactManifold<D>,
        colliders: &'a Colliders<D>,
        detection: &Detection<D>,
        courses: &'a [Course<D>],
        settings: &Settings<D>,
    ) -> Self {
        let reach = |body: u32| detection.motions()[body as usize].reach;
        Self {
            shapes: pair.colliders.map(|collider| &colliders.as_slice()[collider as usize].shape),
            courses: pair.bodies.map(|body| &courses[body as usize]),
            query: ContactQuery {
                margin: reach(pair.bodies[0]) + reach(pair.bodies[1]),
                flush_tolerance: 2.0 * settings.slop() + settings.touch_tolerance(),
                previous: &manifold.0,
            },
        }
    }

    /// No faster than this does the gap close before `until`, of parts that reach this far from the centres of their bodies [m/s].
    pub(super) fn fastest(&self, extents: [f64; 2], until: f64) -> f64 {
        self.courses[0].fastest(extents[0], until) + self.courses[1].fastest(extents[1], until)
    }

    pub(super) fn manifold(&self, time: f64) -> (D::Manifold, [Pose<D>; 2]) {
        let poses = self.courses.map(|course| course.pose(time));
        let [a, b] = &poses;
        let [shape_a, shape_b] = self.shapes;
        (D::collide(Posed { shape: shape_a, pose: a }, Posed { shape: shape_b, pose: b }, &self.query), poses)
    }

    /// Rate and bend of the gap of a point, the normal taken as steady.
    pub(super) fn rates(&self, normal: D::Vector, point: D::Vector, poses: &[Pose<D>; 2], time: f64) -> (f64, f64) {
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

    /// When the first point of a pair arrives.
    pub(super) fn first_arrival(
        &self,
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
            let search = Search {
                from,
                until,
                fastest,
                near: NEAR * settings.length_scale,
                slowest: settings.colliding_above(),
            };
            if let Some(arrival) = first_arrival(&search, |time| self.gap(time, wanted)) {
                first = Some(first.map_or(arrival, |known| known.min(arrival)));
                break;
            }
        }
        first
    }
}
