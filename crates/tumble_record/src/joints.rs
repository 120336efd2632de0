//! Keeps track of the joints of a simulation while it is recorded, and of what they pull.

use std::borrow::Cow;

use bevy_ecs::entity::Entity;
use bevy_ecs::world::World;
use tumble_math::Linear;
use tumble_sim::{Anchor, BodyIndex, BodyTable, Clock, Joint, JointMotion, JointProblem, JointTable};

use crate::dim::RecordDim;
use crate::recording::{JointForce, JointRecord, Sample};
use crate::springs::recorded_anchor;

/// The joints that are in the world, in the order of their table.
#[derive(Debug, Default)]
pub struct JointLog {
    present: Vec<Present>,
}

/// A joint of the table.
#[derive(Clone, Copy, Debug)]
struct Present {
    entity: Entity,
    /// Its index in the recording.
    index: usize,
    /// 1, or −1 where the table has its two bodies the other way round.
    sign: f64,
}

impl JointLog {
    /// Adds joints that are new, and notes the time of those that are gone [s].
    pub fn follow<D: RecordDim>(
        &mut self,
        world: &World,
        body_of: impl Fn(Entity) -> Option<usize>,
        time: f64,
        recorded: &mut Vec<JointRecord<D>>,
    ) {
        let entries = world.resource::<JointTable<D>>().entries();
        let is_known = |(present, entity): (&Present, Entity)| present.entity == entity;
        if self.present.len() == entries.len()
            && self.present.iter().zip(entries.iter().map(|entry| entry.entity)).all(is_known)
        {
            return;
        }
        let end = |anchor: &Anchor<D::Vector>| recorded_anchor(anchor, &body_of);
        let rank = |anchor: &Anchor<D::Vector>| match *anchor {
            Anchor::World(_) => world.resource::<BodyTable>().entries().len() as u32,
            Anchor::Body(entity, _) => world.get::<BodyIndex>(entity).map_or(u32::MAX, |index| index.0),
        };
        let before = std::mem::take(&mut self.present);
        for entry in entries {
            let Some(joint) = world.get::<Joint<D::Vector>>(entry.entity) else { continue };
            let (Some(a), Some(b)) = (end(&joint.a), end(&joint.b)) else { continue };
            let known = before.iter().find(|known| known.entity == entry.entity).map(|known| known.index);
            let index = known.unwrap_or_else(|| {
                recorded.push(JointRecord {
                    name: entry.name.clone(),
                    kind: Cow::Borrowed(joint.kind.word()),
                    a,
                    b,
                    axis: joint.kind.axis(),
                    from: time,
                    until: None,
                });
                recorded.len() - 1
            });
            let is_as_written = entry.bodies[1] == rank(&joint.b);
            self.present.push(Present { entity: entry.entity, index, sign: if is_as_written { 1.0 } else { -1.0 } });
        }
        for gone in before.iter().filter(|gone| !self.present.iter().any(|present| present.index == gone.index)) {
            recorded[gone.index].until = Some(time);
        }
    }

    /// What each joint did in the step that ended with this sample.
    pub fn forces<D: RecordDim>(
        &self,
        world: &World,
        recorded: &[JointRecord<D>],
        sample: &Sample<D>,
    ) -> Vec<JointForce<D>> {
        let (table, problem) = (world.resource::<JointTable<D>>(), world.resource::<JointProblem<D>>());
        let per_dt = 1.0 / world.resource::<Clock>().dt;
        let forces = self.present.iter().filter_map(|present| {
            let order = table.entries().iter().position(|entry| entry.entity == present.entity)?;
            let entry = &table.entries()[order];
            let (impulse, about_centre) = problem.given(order);
            let torque = if entry.kind.holds_directions() {
                about_centre - D::torque(problem.arm_b(entry), impulse)
            } else {
                // A force through the anchor, and nothing else.
                D::Angular::ZERO
            };
            Some(JointForce {
                joint: present.index,
                point: recorded[present.index].b.in_world(sample)?,
                force: impulse * (present.sign * per_dt),
                torque: torque * (present.sign * per_dt),
            })
        });
        forces.collect()
    }
}

#[cfg(test)]
mod tests {
    use bevy_ecs::name::Name;
    use glam::{DVec2, dvec2};
    use tumble_shape::Rod;
    use tumble_sim::{Amount, JointKind, Part, Position, Settings, Simulation};

    use super::*;
    use crate::Record;

    #[test]
    fn a_beam_pulls_at_its_weld_with_its_weight_whichever_end_it_is() -> Result<(), Box<dyn std::error::Error>> {
        // 2 kg, held 0.5 m beside its centre: m g up, and m g/2 against the turn of gravity.
        let weight = 2.0 * 9.81;
        for (sign, kind, torque) in [
            (1.0, JointKind::Fixed, 0.5 * weight),
            (-1.0, JointKind::Fixed, 0.5 * weight),
            (1.0, JointKind::Prismatic { axis: DVec2::X }, 0.5 * weight),
        ] {
            let mut simulation = Simulation::new(Settings::default());
            let beam = simulation.spawn(Position(dvec2(0.5, 3.0)));
            simulation
                .attach(beam, Part::new(Rod::try_new(dvec2(-0.5, 0.0), dvec2(0.5, 0.0), 0.0)?, Amount::Mass(2.0)));
            let (wall, held) = (Anchor::World(dvec2(0.0, 3.0)), Anchor::Body(beam, dvec2(-0.5, 0.0)));
            let (a, b) = if sign > 0.0 { (wall, held) } else { (held, wall) };
            simulation.spawn((Name::new("weld"), Joint { a, b, kind }));
            simulation.record(1)?;
            simulation.step()?;
            simulation.step()?;
            let recording = simulation.take_recording().ok_or("it was recorded")?;
            assert_eq!((&*recording.joints[0].name, &*recording.joints[0].kind), ("weld", kind.word()));
            let given = recording.samples[2].joints[0];
            // Round-off of forces of 20 N.
            assert!((given.force - dvec2(0.0, sign * weight)).length() < 1e-11, "{given:?}");
            assert!((given.torque - sign * torque).abs() < 1e-11, "{given:?}");
            assert!((given.point - dvec2(0.0, 3.0)).length() < 1e-12, "{given:?}");
        }
        Ok(())
    }

    #[test]
    fn a_pin_has_no_torque_and_joints_are_there_from_and_until() -> Result<(), Box<dyn std::error::Error>> {
        let mut simulation = Simulation::new(Settings { dt: 0.1, ..Settings::default() });
        let rod = simulation.spawn(Position(dvec2(0.0, -0.5)));
        simulation.attach(rod, Part::new(Rod::try_new(DVec2::ZERO, dvec2(0.0, 1.0), 0.0)?, Amount::Mass(1.0)));
        let pin =
            Joint { a: Anchor::World(DVec2::ZERO), b: Anchor::Body(rod, dvec2(0.0, 0.5)), kind: JointKind::Revolute };
        simulation.record(1)?;
        simulation.step()?;
        let place = tumble_sim::LinearVelocity(DVec2::ZERO);
        simulation.world_mut().entity_mut(rod).insert((Position(dvec2(0.0, -0.5)), place));
        let pin = simulation.spawn((Name::new("pin"), pin));
        simulation.step()?;
        simulation.world_mut().despawn(pin);
        simulation.step()?;
        let recording = simulation.take_recording().ok_or("it was recorded")?;
        let counts: Vec<usize> = recording.samples.iter().map(|sample| sample.joints.len()).collect();
        assert_eq!(counts, [0, 0, 1, 0]);
        assert_eq!((recording.joints[0].from, recording.joints[0].until), (0.2, Some(0.30000000000000004)));
        let given = recording.samples[2].joints[0];
        assert!((given.force.y - 9.81).abs() < 1e-11 && given.torque == 0.0, "{given:?}");
        Ok(())
    }
}
