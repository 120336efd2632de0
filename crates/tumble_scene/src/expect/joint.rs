//! What is expected of the forces of joints: the impulses of a step divided by dt.

use tumble_math::Linear;
use tumble_record::{JointForce, Sample};

use super::judge::worst;
use super::{Finding, Measured, NotMeasured, Run, component};
use crate::dim::SceneDim;
use crate::format::{JointForceExpectation, JointForcePart, When};

impl<D: SceneDim> Run<'_, D> {
    /// A number of the force of a joint on its second body: of the step at a time, or of the worst step of a window.
    pub(super) fn joint_force(&self, e: &JointForceExpectation, when: When) -> Result<Finding, NotMeasured> {
        let recording = self.timeline.recording;
        let unknown = || NotMeasured::UnknownJoint { name: e.of.clone() };
        let joint = recording.joints.iter().position(|joint| joint.name == e.of).ok_or_else(unknown)?;
        let finding = |sample: &Sample<D>| {
            // A joint that is not in the world gives no force.
            let given = sample.joints.iter().find(|given| given.joint == joint);
            let measured = Measured::Number(given.map_or(0.0, |given| part(given, e.part)));
            Finding { measured, expected: e.into(), time: Some(sample.time), body: None }
        };
        match when {
            When::At(time) => Ok(finding(self.timeline.sample_after_a_step_near(time)?)),
            When::Throughout { .. } => {
                let samples = self.timeline.samples(when).filter(|sample| sample.step > 0);
                self.timeline.conclude(worst(samples.map(finding)), when)
            }
        }
    }
}

fn part<D: SceneDim>(given: &JointForce<D>, part: JointForcePart) -> f64 {
    match part {
        JointForcePart::Magnitude => given.force.length(),
        JointForcePart::X => component(given.force, 0),
        JointForcePart::Y => component(given.force, 1),
        JointForcePart::Z => component(given.force, 2),
        JointForcePart::Torque => D::shown_torque(given.torque),
    }
}
