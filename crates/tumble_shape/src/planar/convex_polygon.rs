//! Convex polygon: a filled polygon without inward corners.

use glam::DVec2;
use tumble_math::{Planar, PlanarRotation, Pose};

use crate::{MassProperties, ShapeError};

/// Sine of the turn below which a corner counts as the middle of a straight side [1].
///
/// A thousand times what rounding leaves of a straight corner, and far below any corner that is meant.
const STRAIGHT: f64 = 1e-12;

/// A filled polygon without inward corners, stored counter-clockwise.
///
/// Points given clockwise are accepted and reordered (the first stays first); points in the middle of a straight side are dropped.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvexPolygon {
    points: Box<[DVec2]>,
    normals: Box<[DVec2]>,
}

impl ConvexPolygon {
    /// A polygon through points in order, either way round [m].
    pub fn try_new(points: impl Into<Vec<DVec2>>) -> Result<Self, ShapeError> {
        let mut points: Vec<DVec2> = points.into();
        if !points.iter().all(|point| point.is_finite()) {
            return Err(ShapeError::NotFinite);
        }
        if points.len() < 3 {
            return Err(ShapeError::TooFewPoints { count: points.len() });
        }
        refuse_repeated_points(&points)?;
        refuse_one_line(&points)?;
        refuse_crossing_sides(&points)?;

        // Without crossings the signed area tells the way round.
        let clockwise = twice_signed_area(&points) < 0.0;
        let turn_sign = if clockwise { -1.0 } else { 1.0 };
        if let Some(corner) = (0..points.len()).find(|&i| turn_sign * turn_at(&points, i) < -STRAIGHT) {
            return Err(ShapeError::NotConvex { corner });
        }
        let straight: Vec<bool> = (0..points.len()).map(|i| turn_at(&points, i).abs() <= STRAIGHT).collect();
        let mut straight = straight.into_iter();
        points.retain(|_| !straight.next().unwrap_or(false));
        if points.len() < 3 {
            return Err(ShapeError::NoArea);
        }
        if clockwise {
            points[1..].reverse();
        }
        Ok(Self::from_counter_clockwise(points.into()))
    }

    /// A box around a point [m] with half its width and height [m], turned counter-clockwise by an angle [rad].
    pub fn rectangle(centre: DVec2, half_extents: DVec2, angle: f64) -> Result<Self, ShapeError> {
        if !(centre.is_finite() && half_extents.is_finite() && angle.is_finite()) {
            return Err(ShapeError::NotFinite);
        }
        let DVec2 { x, y } = half_extents;
        if !(x > 0.0 && y > 0.0) {
            return Err(ShapeError::HalfExtentNotPositive { x, y });
        }
        let pose = Pose::<Planar> { position: centre, rotation: PlanarRotation::from_angle(angle) };
        let corners = [DVec2::new(-x, -y), DVec2::new(x, -y), DVec2::new(x, y), DVec2::new(-x, y)];
        Self::try_new(corners.map(|corner| pose.transform_point(corner)))
    }

    fn from_counter_clockwise(points: Box<[DVec2]>) -> Self {
        let normals = (0..points.len()).map(|i| {
            let along = side(&points, i);
            DVec2::new(along.y, -along.x) * (1.0 / along.length())
        });
        Self { normals: normals.collect(), points }
    }

    /// Corners, counter-clockwise [m].
    #[inline]
    pub fn points(&self) -> &[DVec2] {
        &self.points
    }

    /// Outward unit normals; the i-th belongs to the side from corner i to the next.
    #[inline]
    pub fn normals(&self) -> &[DVec2] {
        &self.normals
    }

    /// Area inside [m²].
    pub fn area(&self) -> f64 {
        0.5 * twice_signed_area(&self.points)
    }

    /// The polygon turned and then moved by a pose.
    pub fn posed(&self, pose: &Pose<Planar>) -> Self {
        Self {
            points: self.points.iter().map(|&point| pose.transform_point(point)).collect(),
            normals: self.normals.iter().map(|&normal| super::turned_unit(&pose.rotation, normal)).collect(),
        }
    }

    /// Mass properties at an area density [kg/m²].
    ///
    /// The polygon is cut into triangles that share one corner o; a triangle o, o + p, o + q has twice the area p × q, and
    ///
    /// ```text
    /// centre of mass     o + (p + q)/3
    /// inertia about o    ρ (p × q) (p·p + p·q + q·q) / 12
    /// ```
    ///
    /// (integrate |s p + t q|² over s, t ≥ 0, s + t ≤ 1: ∫s² = ∫t² = 1/12, ∫st = 1/24.) The first sum takes a corner of the polygon
    /// as o, the second the centre of mass found by it, so that every term is positive and none cancels.
    pub fn mass_properties(&self, area_density: f64) -> MassProperties<Planar> {
        let origin = self.points[0];
        let mut twice_area = 0.0;
        let mut moment = DVec2::ZERO;
        for pair in self.points[1..].windows(2) {
            let (p, q) = (pair[0] - origin, pair[1] - origin);
            let twice_triangle = p.perp_dot(q);
            twice_area += twice_triangle;
            moment += (p + q) * twice_triangle;
        }
        let centre = origin + moment * (1.0 / (3.0 * twice_area));
        let second_moment: f64 = (0..self.points.len())
            .map(|i| {
                let (p, q) = (self.points[i] - centre, next(&self.points, i) - centre);
                p.perp_dot(q) * (p.dot(p) + p.dot(q) + q.dot(q))
            })
            .sum();
        MassProperties { mass: 0.5 * area_density * twice_area, centre, inertia: area_density * second_moment / 12.0 }
    }
}

fn next(points: &[DVec2], i: usize) -> DVec2 {
    points[if i + 1 == points.len() { 0 } else { i + 1 }]
}

fn side(points: &[DVec2], i: usize) -> DVec2 {
    next(points, i) - points[i]
}

/// Sine of the turn from the side that arrives at corner i to the one that leaves; positive to the left [1].
fn turn_at(points: &[DVec2], i: usize) -> f64 {
    let arriving = side(points, if i == 0 { points.len() - 1 } else { i - 1 });
    let leaving = side(points, i);
    arriving.perp_dot(leaving) / (arriving.length() * leaving.length())
}

fn twice_signed_area(points: &[DVec2]) -> f64 {
    let origin = points[0];
    points[1..].windows(2).map(|pair| (pair[0] - origin).perp_dot(pair[1] - origin)).sum()
}

fn refuse_repeated_points(points: &[DVec2]) -> Result<(), ShapeError> {
    for second in 1..points.len() {
        if let Some(first) = points[..second].iter().position(|&point| point == points[second]) {
            return Err(ShapeError::RepeatedPoint { first, second });
        }
    }
    Ok(())
}

fn refuse_one_line(points: &[DVec2]) -> Result<(), ShapeError> {
    // The farthest point from the first gives the line's direction with the least rounding.
    let reach = |point: &DVec2| point.distance_squared(points[0]);
    let along =
        points.iter().fold(DVec2::ZERO, |far, p| if reach(p) > far.length_squared() { p - points[0] } else { far });
    let off_line = |point: &DVec2| along.perp_dot(point - points[0]).abs() > STRAIGHT * along.length_squared();
    if points.iter().any(off_line) { Ok(()) } else { Err(ShapeError::NoArea) }
}

fn refuse_crossing_sides(points: &[DVec2]) -> Result<(), ShapeError> {
    let count = points.len();
    for first in 0..count {
        // Neighbouring sides share a corner; they meet elsewhere only when the path turns back on itself.
        let second = (first + 1) % count;
        let turns_back =
            turn_at(points, second).abs() <= STRAIGHT && side(points, first).dot(side(points, second)) < 0.0;
        if turns_back {
            return Err(ShapeError::SelfCrossing { first, second });
        }
        for second in first + 2..count {
            if (second + 1) % count != first && sides_meet(points, first, second) {
                return Err(ShapeError::SelfCrossing { first, second });
            }
        }
    }
    Ok(())
}

/// Whether two sides share a point.
fn sides_meet(points: &[DVec2], first: usize, second: usize) -> bool {
    let (a, b) = (points[first], next(points, first));
    let (c, d) = (points[second], next(points, second));
    let side_of = |from: DVec2, to: DVec2, point: DVec2| (to - from).perp_dot(point - from);
    let (c_of_ab, d_of_ab) = (side_of(a, b, c), side_of(a, b, d));
    let (a_of_cd, b_of_cd) = (side_of(c, d, a), side_of(c, d, b));
    if c_of_ab * d_of_ab < 0.0 && a_of_cd * b_of_cd < 0.0 {
        return true;
    }
    let between = |from: DVec2, to: DVec2, point: DVec2| (point - from).dot(point - to) <= 0.0;
    (c_of_ab == 0.0 && between(a, b, c))
        || (d_of_ab == 0.0 && between(a, b, d))
        || (a_of_cd == 0.0 && between(c, d, a))
        || (b_of_cd == 0.0 && between(c, d, b))
}
