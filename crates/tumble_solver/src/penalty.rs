//! Penalty contact: overlapping points push back like springs with dampers (R9, L4).
//!
//! ```text
//! f_n = k δ + c δ̇                     δ = −separation, δ̇ = −v_n
//! f_t = −min(μ(v_t) f_n, |v_t| / (K_tt Δt)) v_t/|v_t|
//! ```
//!
//! The damper acts as long as the surfaces overlap, also while they part: only so does one contact give back the part ε of its approach
//! speed whatever that speed is, with the damping ratio
//!
//! ```text
//! ζ = −ln ε / √(π² + ln² ε)           half a period of a damped spring, v⁺ = −v⁻ exp(−πζ/√(1−ζ²))
//! ```
//!
//! so the stiffer the spring, the nearer the answer to the impulse answer (L4). With several contacts on one body it tends to the
//! *simultaneous* answer, which one-by-one impulses do not.
//!
//! Good at: smooth forces, simultaneous contacts, simplicity. Bad at: rest (sinks by m g/k, creeps under friction), stiffness
//! (Δt has a bound). Choose it to see forces, or where softness is meant.

use tumble_math::{Dim, Linear, Matrix, Vector, trig};

use crate::contact::tangential;
use crate::{ContactRow, SolverBody};

/// Spring and damper of a contact, and how fast friction builds up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringDamper {
    /// k [N/m].
    pub stiffness: f64,
    /// c [N·s/m].
    pub damping: f64,
    /// Slip speed at which friction reaches μ_s N; below it friction is smaller, so the point creeps [m/s].
    pub slip_speed: f64,
}

/// ζ of a contact that gives back the part ε of its approach speed; 1 (no rebound) for ε = 0 [1].
pub fn damping_ratio(restitution: f64) -> f64 {
    if restitution <= 0.0 {
        return 1.0;
    }
    let ln = trig::ln(restitution);
    -ln / (std::f64::consts::PI * std::f64::consts::PI + ln * ln).sqrt()
}

/// The largest stable Δt of symplectic Euler for a damped spring of angular frequency ω [s].
///
/// ```text
/// v⁺ = v − Δt (ω² x + 2ζω v),  x⁺ = x + Δt v⁺    is stable iff    Δt ω < 2 (√(1 + ζ²) − ζ)
/// ```
/// by the Jury conditions of its characteristic polynomial.
pub fn stable_step(frequency: f64, damping_ratio: f64) -> f64 {
    stable_product(damping_ratio) / frequency
}

fn stable_product(damping_ratio: f64) -> f64 {
    2.0 * ((1.0 + damping_ratio * damping_ratio).sqrt() - damping_ratio)
}

/// Stiffness of a contact of compliance `compliance` for which Δt is a tenth of the stable bound [N/m].
pub fn default_stiffness(compliance: f64, damping_ratio: f64, dt: f64) -> f64 {
    let frequency = 0.1 * stable_product(damping_ratio) / dt;
    frequency * frequency / compliance
}

/// c = 2 ζ √(k / K) of a contact with normal compliance K [N·s/m].
pub fn damping_coefficient(stiffness: f64, compliance: f64, damping_ratio: f64) -> f64 {
    2.0 * damping_ratio * (stiffness / compliance).sqrt()
}

/// Force of one point on b, in the contact frame [N]; zero without overlap.
pub fn contact_force<D: Dim>(
    row: &ContactRow<D>,
    bodies: &[SolverBody<D>],
    contact: &SpringDamper,
    dt: f64,
) -> D::Vector {
    if row.separation >= 0.0 {
        return D::Vector::ZERO;
    }
    let velocity = row.relative_velocity(bodies);
    let normal = -contact.stiffness * row.separation - contact.damping * velocity[0];
    let mut force = D::Vector::ZERO;
    let slip = tangential(velocity);
    let speed = slip.length();
    if speed > 0.0 && normal > 0.0 {
        // More than this would turn the slip round within the step.
        let direction = slip * (1.0 / speed);
        let compliance = row.compliance(bodies).apply(direction).dot(direction);
        let stopping = if compliance > 0.0 { speed / (compliance * dt) } else { 0.0 };
        let coulomb = friction_at(speed / contact.slip_speed, row) * normal;
        force = direction * -coulomb.min(stopping);
    }
    force[0] = normal;
    force
}

/// Regularised Coulomb coefficient at a slip speed relative to [`SpringDamper::slip_speed`] [1].
///
/// Rises to μ_s at 1, with slope 0 there, and falls smoothly to μ_k at 2.
fn friction_at<D: Dim>(relative_speed: f64, row: &ContactRow<D>) -> f64 {
    let (static_friction, kinetic_friction) = (row.surface.static_friction, row.surface.kinetic_friction);
    let s = relative_speed;
    if s < 1.0 {
        static_friction * s * (2.0 - s)
    } else if s < 2.0 {
        let t = s - 1.0;
        static_friction + (kinetic_friction - static_friction) * t * t * (3.0 - 2.0 * t)
    } else {
        kinetic_friction
    }
}

/// Stiffness and viscous friction of the homework's floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LectureFloor {
    /// w: force per depth [N/m].
    pub stiffness: f64,
    /// μ: force per slip speed; viscous, not Coulomb's coefficient [N·s/m].
    pub viscosity: f64,
}

/// Force of the floor on a rod end, to the letter of R9, in the contact frame [N].
///
/// f = [−μ ẋ_k, −w (y_k − c)] while y_k ≤ c and ẏ_k < 0; no force otherwise. `height` is y_k − c along the floor's normal,
/// `velocity` the end's velocity in the floor's frame, normal first.
pub fn lecture_force<V: Vector>(height: f64, velocity: V, floor: &LectureFloor) -> V {
    if height > 0.0 || velocity[0] >= 0.0 {
        return V::ZERO;
    }
    let mut force = tangential(velocity) * -floor.viscosity;
    force[0] = -floor.stiffness * height;
    force
}

/// The sum of both bodies' largest point compliances: no point of the pair yields more than this [1/kg].
pub fn compliance_bound<D: Dim>(a: &SolverBody<D>, extent_a: f64, b: &SolverBody<D>, extent_b: f64) -> f64 {
    body_bound(a, extent_a) + body_bound(b, extent_b)
}

/// 1/m + r²/I of the point farthest from the centre of mass, over the least inert axes [1/kg].
fn body_bound<D: Dim>(body: &SolverBody<D>, extent: f64) -> f64 {
    let translation = (0..D::Vector::AXES).map(|axis| body.inverse_mass[axis]).fold(0.0, f64::max);
    // The largest yield of any point at this distance, found by probing the axes: exact in the plane.
    let rotation = (0..D::Vector::AXES)
        .flat_map(|arm| (0..D::Vector::AXES).map(move |direction| (arm, direction)))
        .map(|(arm, direction)| {
            let (arm, direction) = (D::Vector::unit(arm) * extent, D::Vector::unit(direction));
            let spun = D::spin(tumble_math::Inertia::apply(&body.inverse_inertia, D::torque(arm, direction)), arm);
            spun.dot(direction)
        })
        .fold(0.0, f64::max);
    translation + rotation
}
