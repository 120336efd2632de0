//! How a gap accelerates without contact forces: every term of b.
//!
//! The gap of a point is measured between two *features*: a corner or a point of a side itself, or the centre of a round. With p_a, p_b
//! the features, ρ n = p_b − p_a (ρ the sum of radii, plus the gap),
//!
//! ```text
//! d = n · (p_b − p_a) − radii
//! ḋ = n · (ṗ_b − ṗ_a)                                    since n · ṅ = 0
//! d̈ = n · (p̈_b − p̈_a) + 2 ṅ · (ṗ_b − ṗ_a) − ρ |ṅ|²       since ṅ · (p_b − p_a) = 0,  n · n̈ = −|ṅ|²
//! p̈ = a + α × f + ω × (ω × f)                            f: centre of mass → feature
//! ```
//!
//! ṅ = ω × n of the body that carries the normal (its side lies against the other's corner or round), or ṅ = (ṗ_b − ṗ_a)_t / ρ where the
//! normal is the line between two centres (Baraff and Witkin, part D, with the curvature of rounds added). Two edges that cross turn it
//! both: ṅ · u = −n · (ω × u) for the direction u of each.
//!
//! The slip of a point at rest changes by the acceleration of the two material points there, whose arms r = f + o follow the normal:
//!
//! ```text
//! d/dt (v + ω × r) = a + α × r + ω × (ω × f + ȯ),   o = (radius) n,   ȯ = (radius) ṅ
//! ```
//!
//! so a disc that rolls on a straight floor has none of it from turning. A *circle* is round about its axis u alone: the rim of a cylinder or
//! cone, or a cross-section where its side touches. The point runs round it, always on the side of the outward normal ν:
//!
//! ```text
//! o = r m,  m = (ν − s u)/q,   s = ν · u,  q = √(1 − s²)                its height along ν is r q
//! d²/dt² (r q) = −r (ṡ²/q³ + s s̈/q)
//! ```

use tumble_math::{Dim, Linear, Matrix, Vector};

use crate::contact::tangential;
use crate::{ContactRow, SolverBody};

/// What turns the normal of a contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum NormalCarrier<V> {
    /// A side of body a.
    #[default]
    A,
    /// A side of body b.
    B,
    /// The line between the two features: two rounds, or a corner and a round.
    Line,
    /// Two edges that cross, in space: unit vectors along a's and b's, world axes.
    Edges(V, V),
}

/// What the gap of a contact is measured between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap<D: Dim> {
    /// Centre of mass of a → its feature, world axes [m].
    pub feature_a: D::Vector,
    /// Centre of mass of b → its feature, world axes [m].
    pub feature_b: D::Vector,
    /// What turns the normal.
    pub carrier: NormalCarrier<D::Vector>,
    /// Where the feature of a, or that of b, is the centre of a circle: its axis, a unit vector in world axes. Only with a side of the other
    /// body.
    pub circles: [Option<D::Vector>; 2],
}

/// Sine of the angle between axis and normal below which a circle lies flat: no point of it is the lowest [1].
const FLAT: f64 = 1e-6;
/// Squared sine of the angle below which two edges are parallel: no normal is square to both alone [1].
const PARALLEL: f64 = 1e-12;

impl<D: Dim> Gap<D> {
    /// A corner against a side: the features are the contact point itself.
    pub fn corner(row: &ContactRow<D>, carrier: NormalCarrier<D::Vector>) -> Self {
        Self { feature_a: row.arm_a, feature_b: row.arm_b, carrier, circles: [None; 2] }
    }

    /// What velocities add to the acceleration of the gap and of the slip, in the contact frame [m/s²].
    pub fn drift(&self, row: &ContactRow<D>, bodies: &[SolverBody<D>]) -> D::Vector {
        let (a, b) = (&bodies[row.a as usize], &bodies[row.b as usize]);
        let normal = row.normal();
        let (offset_a, offset_b) = (row.arm_a - self.feature_a, row.arm_b - self.feature_b);
        let distance = normal.dot(offset_a - offset_b) + row.separation;
        let velocity = b.point_velocity(self.feature_b) - a.point_velocity(self.feature_a);
        let normal_rate = self.normal_rate(normal, distance, velocity, [a, b]);
        let turning = |body: &SolverBody<D>, rate: D::Vector| D::spin(body.angular_velocity, rate);
        let feature_rate = |body: &SolverBody<D>, feature| D::spin(body.angular_velocity, feature);
        let (rate_a, rate_b) = (feature_rate(a, self.feature_a), feature_rate(b, self.feature_b));

        let features = turning(b, rate_b) - turning(a, rate_a);
        let mut opening =
            normal.dot(features) + 2.0 * normal_rate.dot(velocity) - distance * normal_rate.dot(normal_rate);
        let mut offset_rates = [normal_rate * normal.dot(offset_a), normal_rate * normal.dot(offset_b)];
        if self.circles != [None; 2] {
            let carrier = if self.carrier == NormalCarrier::A { a } else { b };
            let normal_bend = turning(carrier, normal_rate);
            opening += normal_bend.dot(offset_a - offset_b - normal * (distance - row.separation));
            for (k, (body, offset)) in [(a, offset_a), (b, offset_b)].into_iter().enumerate() {
                let sign = if k == 0 { 1.0 } else { -1.0 };
                let outward = Outward { normal: normal * sign, rate: normal_rate * sign, bend: normal_bend * sign };
                if let Some(circle) = self.circles[k].and_then(|axis| outward.round::<D>(axis, offset, body)) {
                    opening -= circle.rise;
                    offset_rates[k] = circle.rate;
                }
            }
        }
        let material = turning(b, rate_b + offset_rates[1]) - turning(a, rate_a + offset_rates[0]);
        let mut drift = tangential(row.frame.apply_transposed(material));
        drift[0] = opening;
        drift
    }

    /// ṅ, for features that move at this velocity relative to each other.
    fn normal_rate(
        &self,
        normal: D::Vector,
        distance: f64,
        velocity: D::Vector,
        [a, b]: [&SolverBody<D>; 2],
    ) -> D::Vector {
        let along_line = || match distance > 0.0 {
            true => (velocity - normal * normal.dot(velocity)) * (1.0 / distance),
            false => D::Vector::ZERO,
        };
        match self.carrier {
            NormalCarrier::A => D::spin(a.angular_velocity, normal),
            NormalCarrier::B => D::spin(b.angular_velocity, normal),
            NormalCarrier::Line => along_line(),
            NormalCarrier::Edges(of_a, of_b) => {
                let cosine = of_a.dot(of_b);
                let squared_sine = 1.0 - cosine * cosine;
                if squared_sine < PARALLEL {
                    return along_line();
                }
                let leaning = |body: &SolverBody<D>, edge| -normal.dot(D::spin(body.angular_velocity, edge));
                let (lean_a, lean_b) = (leaning(a, of_a), leaning(b, of_b));
                (of_a * (lean_a - cosine * lean_b) + of_b * (lean_b - cosine * lean_a)) * (1.0 / squared_sine)
            }
        }
    }
}

/// The normal out of a body, and how it turns.
struct Outward<V> {
    normal: V,
    /// ν̇ [1/s].
    rate: V,
    /// ν̈, without angular accelerations [1/s²].
    bend: V,
}

/// What a contact point does that runs round a circle.
struct Rounding<V> {
    /// ȯ [m/s].
    rate: V,
    /// d²/dt² of the circle's height along the normal, without angular accelerations [m/s²].
    rise: f64,
}

impl<V: Vector> Outward<V> {
    /// A circle of a body about an axis, and the offset of the contact point from its centre; `None` where it has no lowest point.
    fn round<D: Dim<Vector = V>>(&self, axis: V, offset: V, body: &SolverBody<D>) -> Option<Rounding<V>> {
        let (radius, out) = (offset.length(), offset.try_normalize()?);
        let (across, along) = (self.normal.dot(out), self.normal.dot(axis));
        if across < FLAT {
            return None;
        }
        let axis_rate = D::spin(body.angular_velocity, axis);
        let along_rate = self.rate.dot(axis) + self.normal.dot(axis_rate);
        let axis_bend = D::spin(body.angular_velocity, axis_rate);
        let along_bend = 2.0 * self.rate.dot(axis_rate) + self.normal.dot(axis_bend) + self.bend.dot(axis);
        let turned = self.rate - axis * along_rate - axis_rate * along;
        Some(Rounding {
            rate: (turned - out * out.dot(turned)) * (radius / across),
            rise: -radius * (along_rate * along_rate / (across * across * across) + along * along_bend / across),
        })
    }
}
