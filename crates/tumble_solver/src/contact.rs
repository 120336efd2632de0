//! One contact point as a row of a contact problem.

use serde::{Deserialize, Serialize};
use tumble_math::{Dim, Linear, Matrix, Vector};

use crate::SolverBody;

/// Friction and restitution of a pair of surfaces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Surface {
    /// μ_s: while sticking, friction is at most this times the normal force (L10) [1].
    pub static_friction: f64,
    /// μ_k: while sliding, friction is this times the normal force (L10) [1].
    pub kinetic_friction: f64,
    /// ε: part of the approach speed that is given back (L5) [1].
    pub restitution: f64,
}

/// Whether the two surfaces slide on each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Slip {
    /// At rest against each other, held by up to μ_s.
    #[default]
    Sticking,
    /// Sliding, braked by μ_k.
    Sliding,
}

/// One contact point between bodies `a` and `b`, everything in world axes.
///
/// Impulses are in the contact frame: component 0 along the normal (from a to b), the others along the tangents. They act on b, and
/// their opposite on a.
#[derive(Clone, Copy, Debug)]
pub struct ContactRow<D: Dim> {
    /// Index of the first body.
    pub a: u32,
    /// Index of the second body.
    pub b: u32,
    /// Columns: normal, tangents.
    pub frame: D::Matrix,
    /// Centre of mass of a → point [m].
    pub arm_a: D::Vector,
    /// Centre of mass of b → point [m].
    pub arm_b: D::Vector,
    /// Gap, negative when overlapping [m].
    pub separation: f64,
    /// Speed at which the velocity filter lets the gap close; 0 for a point that touches [m/s].
    pub allowance: f64,
    /// Friction and restitution of the pair.
    pub surface: Surface,
    /// Impulse of the present solve; on entry the one to begin with (warm starting) [N·s].
    pub impulse: D::Vector,
    /// Whether the point slides.
    pub slip: Slip,
}

impl<D: Dim> ContactRow<D> {
    /// Unit normal, from a to b.
    #[inline]
    pub fn normal(&self) -> D::Vector {
        self.frame.column(0)
    }

    /// Velocity of b relative to a at the point, in the contact frame: component 0 is the separating speed (L3) [m/s].
    #[inline]
    pub fn relative_velocity(&self, bodies: &[SolverBody<D>]) -> D::Vector {
        let b = bodies[self.b as usize].point_velocity(self.arm_b);
        let a = bodies[self.a as usize].point_velocity(self.arm_a);
        self.frame.apply_transposed(b - a)
    }

    /// Rate at which the gap opens, negative when approaching [m/s].
    #[inline]
    pub fn separating_speed(&self, bodies: &[SolverBody<D>]) -> f64 {
        let b = bodies[self.b as usize].point_velocity(self.arm_b);
        let a = bodies[self.a as usize].point_velocity(self.arm_a);
        self.normal().dot(b - a)
    }

    /// Applies an impulse of the contact frame: +J to b, −J to a [N·s].
    #[inline]
    pub fn apply(&self, bodies: &mut [SolverBody<D>], impulse: D::Vector) {
        let impulse = self.frame.apply(impulse);
        bodies[self.b as usize].apply_impulse(self.arm_b, impulse);
        bodies[self.a as usize].apply_impulse(self.arm_a, -impulse);
    }

    /// K = J M⁻¹ Jᵀ: relative velocity per impulse, in the contact frame [1/kg].
    ///
    /// Its first entry is the denominator of the lecture's impulse (L5).
    pub fn compliance(&self, bodies: &[SolverBody<D>]) -> D::Matrix {
        let (a, b) = (&bodies[self.a as usize], &bodies[self.b as usize]);
        D::Matrix::from_columns(|axis| {
            let impulse = self.frame.column(axis);
            self.frame.apply_transposed(b.yield_at(self.arm_b, impulse) + a.yield_at(self.arm_a, impulse))
        })
    }

    /// n · K n: how fast the gap opens per normal impulse [1/kg].
    #[inline]
    pub fn normal_compliance(&self, bodies: &[SolverBody<D>]) -> f64 {
        let normal = self.normal();
        let b = bodies[self.b as usize].yield_at(self.arm_b, normal);
        let a = bodies[self.a as usize].yield_at(self.arm_a, normal);
        normal.dot(a + b)
    }
}

/// The tangential part of a vector of the contact frame.
#[inline]
pub fn tangential<V: Vector>(mut vector: V) -> V {
    vector[0] = 0.0;
    vector
}

/// The nearest tangential vector that is no longer than `bound`: the projection onto the friction disc, in the plane an interval.
#[inline]
pub(crate) fn within_disc<V: Vector>(mut tangential: V, bound: f64) -> V {
    if V::AXES == 2 {
        // No square root: it would take as long as everything else that a sweep does to a point.
        tangential[1] = tangential[1].max(-bound).min(bound);
        return tangential;
    }
    let squared = tangential.dot(tangential);
    if squared > bound * bound { tangential * (bound / squared.sqrt()) } else { tangential }
}
