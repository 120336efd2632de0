//! The numbers of a velocity problem: contacts that know each other only through W.

use tumble_math::{Dim, Linear, Matrix, Vector};

use crate::contact::tangential;
use crate::coupling::Coupling;
use crate::impact::impulse_for;
use crate::{Slip, Surface};

/// u = W λ + q with c ≤ λ_n ⟂ u_n ≥ 0 and |λ_t| ≤ μ λ_n against u_t, one entry per contact.
#[derive(Clone, Debug, Default)]
pub(super) struct Problem<D: Dim> {
    /// W.
    pub coupling: Coupling<D>,
    /// q: velocity without the impulses, less what is asked for [m/s].
    pub q: Vec<D::Vector>,
    /// μ that holds now [1].
    pub friction: Vec<f64>,
    /// c: impulse that the normal gives in any case; 0 except when Poisson's law gives back [N·s].
    pub held: Vec<f64>,
    /// Whether a contact sticks, by which μ was chosen.
    pub slip: Vec<Slip>,
    /// λ [N·s].
    pub impulses: Vec<D::Vector>,
}

impl<D: Dim> Problem<D> {
    /// u_i [m/s].
    #[inline]
    pub fn velocity(&self, contact: usize) -> D::Vector {
        self.coupling.velocity(contact, &self.impulses) + self.q[contact]
    }

    /// How far a contact is from its conditions, as a speed: the natural map with impulses times W_ii [m/s].
    pub fn residual_of(&self, contact: usize) -> f64 {
        let velocity = self.velocity(contact);
        let impulse = self.impulses[contact];
        // A minimum hides what is no number.
        if !(velocity.is_finite() && impulse.is_finite()) {
            return f64::NAN;
        }
        let own = self.coupling.own(contact);
        let yielding = own.column(0)[0];
        let normal = velocity[0].min((impulse[0] - self.held[contact]) * yielding);
        // The least stiff tangent stands for all; the plane has only one.
        let stiffness = tangent_yield::<D>(own);
        if stiffness <= 0.0 {
            return normal.abs();
        }
        let tried = tangential(impulse - velocity * (1.0 / stiffness));
        let friction = tangential(impulse) - within(tried, self.friction[contact] * impulse[0].max(0.0));
        normal.abs().max(friction.length() * stiffness)
    }

    /// Largest residual of some contacts [m/s]; NaN shows.
    pub fn residual(&self, contacts: &[u32]) -> f64 {
        contacts
            .iter()
            .map(|i| self.residual_of(*i as usize))
            .fold(0.0, |most, r| if r > most || r.is_nan() { r } else { most })
    }

    /// Solves one contact with all others as they are; returns its impulse.
    ///
    /// With u = W_ii λ + q̄ it is held at c if it opens so; else it sticks if its friction suffices; else it slides.
    pub fn solve_alone(&self, contact: usize) -> D::Vector {
        let own = self.coupling.own(contact);
        let alone = self.velocity(contact) - own.apply(self.impulses[contact]);
        let (friction, held) = (self.friction[contact], self.held[contact]);
        if held > 0.0 {
            // One tangent is solved outright. Two are by steps that suit the stiffer one, from where they are.
            let (mut impulse, most_steps) = match D::Vector::AXES {
                2 => (D::Vector::ZERO, 1),
                _ => (tangential(self.impulses[contact]), 100),
            };
            impulse[0] = held;
            let stiffness = tangent_yield::<D>(own);
            for _ in 0..if stiffness > 0.0 { most_steps } else { 0 } {
                let before = tangential(impulse);
                let slip = tangential(alone + own.apply(impulse));
                impulse = within(before - slip * (1.0 / stiffness), friction * held);
                let change = (impulse - before).length();
                impulse[0] = held;
                if change <= 1e-16 * friction * held {
                    break;
                }
            }
            if (alone + own.apply(impulse))[0] >= 0.0 {
                return impulse;
            }
        } else if alone[0] >= 0.0 {
            return D::Vector::ZERO;
        }
        // Most contacts stick, and need no square root to know it.
        let sticking = self.coupling.stopping(contact, alone);
        let (bound, along) = (friction * sticking[0], tangential(sticking));
        if sticking[0] > held && along.dot(along) <= bound * bound {
            return sticking;
        }
        let surface = Surface { static_friction: friction, kinetic_friction: friction, restitution: 0.0 };
        impulse_for(own, alone, 0.0, &surface)
    }

    /// Puts the impulse of a contact within its bounds, which an iterative method may leave by its tolerance.
    pub fn clamp(&mut self, contact: usize) {
        let impulse = &mut self.impulses[contact];
        let normal = impulse[0].max(0.0);
        let friction = within(tangential(*impulse), self.friction[contact] * normal);
        *impulse = friction;
        impulse[0] = normal;
    }

    /// Whether friction is used up and the contact slips all the same, faster than a tolerance [m/s].
    pub fn slips(&self, contact: usize, tolerance: f64) -> bool {
        let impulse = self.impulses[contact];
        let used_up = tangential(impulse).length() >= self.friction[contact] * impulse[0] * (1.0 - 1e-12);
        used_up && tangential(self.velocity(contact)).length() > tolerance
    }
}

/// W_tt: the largest of the tangents' own [1/kg].
fn tangent_yield<D: Dim>(own: &D::Matrix) -> f64 {
    (1..D::Vector::AXES).map(|axis| own.column(axis)[axis]).fold(0.0, f64::max)
}

/// The point of a disc nearest to a tangential vector.
fn within<V: Linear>(tangent: V, radius: f64) -> V {
    let size = tangent.length();
    if size > radius { tangent * (radius / size) } else { tangent }
}
