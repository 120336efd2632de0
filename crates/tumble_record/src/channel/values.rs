//! Reading channels off a recording.

use tumble_math::{Inertia, Linear, Vector};

use super::{BodyQuantity, Channel, JointQuantity, Series, WorldQuantity};
use crate::dim::{RecordDim, TurnAxis};
use crate::recording::{AuditRow, BodyKind, BodyState, JointForce, Recording, Sample};

/// Reads a quantity off the audit; steps in which nothing was solved have no iterations and no residual.
pub(crate) fn world_series<D: RecordDim>(recording: &Recording<D>, quantity: WorldQuantity) -> Series {
    let value = |row: &AuditRow<D>| match quantity {
        WorldQuantity::Kinetic => Some(row.kinetic),
        WorldQuantity::Potential => Some(row.potential),
        WorldQuantity::Total => Some(row.total),
        WorldQuantity::MomentumX => along(row.momentum, 0),
        WorldQuantity::MomentumY => along(row.momentum, 1),
        WorldQuantity::MomentumZ => along(row.momentum, 2),
        WorldQuantity::AngularMomentum => D::about(row.angular_momentum, TurnAxis::Plane),
        WorldQuantity::AngularMomentumX => D::about(row.angular_momentum, TurnAxis::X),
        WorldQuantity::AngularMomentumY => D::about(row.angular_momentum, TurnAxis::Y),
        WorldQuantity::AngularMomentumZ => D::about(row.angular_momentum, TurnAxis::Z),
        WorldQuantity::DeepestOverlap => Some(row.deepest_overlap),
        WorldQuantity::Contacts => Some(row.contacts as f64),
        WorldQuantity::Iterations => row.iterations.map(|count| count as f64),
        WorldQuantity::Residual => row.residual,
    };
    let (times, values) = recording.audit.iter().filter_map(|row| Some((row.time, value(row)?))).unzip();
    Series { label: Channel::World(quantity).title(), times, values }
}

/// Reads a quantity of a body off the samples.
pub(super) fn body_series<D: RecordDim>(recording: &Recording<D>, quantity: BodyQuantity, body: usize) -> Series {
    let values = recording.states(body).filter_map(|(sample, state)| {
        let value = body_value(quantity, recording, body, sample, state)?;
        Some((sample.time, value))
    });
    let (times, values) = values.unzip();
    Series { label: recording.bodies[body].name.clone(), times, values }
}

/// Reads a quantity of a joint off the samples, but the start, when no step has acted yet.
pub(super) fn joint_series<D: RecordDim>(recording: &Recording<D>, quantity: JointQuantity, joint: usize) -> Series {
    let value = |given: &JointForce<D>| match quantity {
        JointQuantity::Force => Some(given.force.length()),
        JointQuantity::ForceX => along(given.force, 0),
        JointQuantity::ForceY => along(given.force, 1),
        JointQuantity::ForceZ => along(given.force, 2),
        JointQuantity::Torque => D::about(given.torque, TurnAxis::Plane).or(Some(given.torque.length())),
    };
    let samples = recording.samples.iter().filter(|sample| sample.step > 0);
    let given = samples.filter_map(|sample| {
        let given = sample.joints.iter().find(|given| given.joint == joint)?;
        Some((sample.time, value(given)?))
    });
    let (times, values) = given.unzip();
    Series { label: recording.joints[joint].name.clone(), times, values }
}

/// Returns the value of a quantity of a body in one sample; none where the dimension does not have it.
fn body_value<D: RecordDim>(
    quantity: BodyQuantity,
    recording: &Recording<D>,
    body: usize,
    sample: &Sample<D>,
    state: &BodyState<D>,
) -> Option<f64> {
    let (dt, record) = (recording.dt, &recording.bodies[body]);
    let contacts = || sample.contacts.iter().filter(|contact| contact.a == body || contact.b == body);
    match quantity {
        BodyQuantity::X => along(state.position, 0),
        BodyQuantity::Y => along(state.position, 1),
        BodyQuantity::Z => along(state.position, 2),
        BodyQuantity::Angle => D::angle(&state.orientation),
        BodyQuantity::Vx => along(state.velocity, 0),
        BodyQuantity::Vy => along(state.velocity, 1),
        BodyQuantity::Vz => along(state.velocity, 2),
        BodyQuantity::Omega => D::about(state.angular_velocity, TurnAxis::Plane),
        BodyQuantity::Wx => D::about(state.angular_velocity, TurnAxis::X),
        BodyQuantity::Wy => D::about(state.angular_velocity, TurnAxis::Y),
        BodyQuantity::Wz => D::about(state.angular_velocity, TurnAxis::Z),
        BodyQuantity::Speed => Some(state.velocity.length()),
        BodyQuantity::Kinetic if record.kind != BodyKind::Dynamic => Some(0.0),
        BodyQuantity::Kinetic => {
            let (v, w) = (state.velocity, state.angular_velocity);
            let spin = record.inertia.in_world(&D::rotation(&state.orientation)).apply(w);
            Some(0.5 * (record.mass * v.dot(v) + w.dot(spin)))
        }
        BodyQuantity::NormalForce => Some(contacts().map(|contact| contact.normal_impulse / dt).sum()),
        BodyQuantity::FrictionForce => {
            Some(D::friction(contacts().map(|contact| (contact, if contact.b == body { 1.0 } else { -1.0 }))) / dt)
        }
        BodyQuantity::Contacts => Some(contacts().count() as f64),
    }
}

/// Component of a vector; none along an axis that it does not have.
fn along<V: Vector>(vector: V, axis: usize) -> Option<f64> {
    (axis < V::AXES).then(|| vector[axis])
}
