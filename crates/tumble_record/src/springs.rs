//! Keeps track of the springs of a simulation while it is recorded.

use bevy_ecs::entity::Entity;
use tumble_sim::{Anchor, Spring};

use crate::dim::RecordDim;
use crate::recording::{AnchorRecord, SpringRecord};

/// An anchor as it is recorded, given the index of each recorded body; nothing for one of another body.
pub fn recorded_anchor<D: RecordDim>(
    anchor: &Anchor<D::Vector>,
    body_of: impl Fn(Entity) -> Option<usize>,
) -> Option<AnchorRecord<D>> {
    match *anchor {
        Anchor::World(point) => Some(AnchorRecord { body: None, point }),
        Anchor::Body(entity, point) => body_of(entity).map(|body| AnchorRecord { body: Some(body), point }),
    }
}

/// The springs that are in the world, and where each stands in the recording.
#[derive(Debug, Default)]
pub struct SpringLog {
    present: Vec<(Entity, usize)>,
}

impl SpringLog {
    /// Adds springs that are new, and notes the time of those that are gone [s].
    pub fn follow<'w, D: RecordDim>(
        &mut self,
        springs: impl Iterator<Item = (Entity, &'w Spring<D::Vector>)> + Clone,
        body_of: impl Fn(Entity) -> Option<usize>,
        time: f64,
        recorded: &mut Vec<SpringRecord<D>>,
    ) {
        if self.present.iter().map(|(entity, _)| *entity).eq(springs.clone().map(|(entity, _)| entity)) {
            return;
        }
        let end = |anchor: &Anchor<D::Vector>| recorded_anchor(anchor, &body_of);
        let before = std::mem::take(&mut self.present);
        for (entity, spring) in springs {
            let known = before.iter().find(|(known, _)| *known == entity).map(|(_, index)| *index);
            let (Some(a), Some(b)) = (end(&spring.a), end(&spring.b)) else { continue };
            let index = known.unwrap_or_else(|| {
                recorded.push(SpringRecord { a, b, rest_length: spring.rest_length, from: time, until: None });
                recorded.len() - 1
            });
            self.present.push((entity, index));
        }
        for (_, index) in before.iter().filter(|(_, index)| !self.present.iter().any(|(_, present)| present == index)) {
            recorded[*index].until = Some(time);
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, dvec2};
    use tumble_shape::Disc;
    use tumble_sim::{Amount, Part, Position, Settings, Simulation};

    use super::*;
    use crate::Record;

    #[test]
    fn springs_are_recorded_with_their_ends_and_the_time_they_are_there() -> Result<(), Box<dyn std::error::Error>> {
        let mut simulation = Simulation::new(Settings { dt: 0.1, ..Settings::default() });
        let ball = simulation.spawn(Position(DVec2::ZERO));
        simulation.attach(ball, Part::new(Disc::try_new(DVec2::ZERO, 0.1)?, Amount::Mass(1.0)));
        let spring = |at: f64| Spring {
            a: Anchor::World(dvec2(0.0, at)),
            b: Anchor::Body(ball, dvec2(0.1, 0.0)),
            stiffness: 10.0,
            damping: 0.0,
            rest_length: at,
        };
        let first = simulation.spawn(spring(1.0));
        simulation.record(1)?;
        simulation.step()?;
        simulation.spawn(spring(2.0));
        simulation.step()?;
        simulation.world_mut().despawn(first);
        simulation.step()?;
        let recording = simulation.take_recording().ok_or("it was recorded")?;
        let held = AnchorRecord { body: Some(0), point: dvec2(0.1, 0.0) };
        let expected = |at: f64, from: u64, until: Option<u64>| SpringRecord {
            a: AnchorRecord { body: None, point: dvec2(0.0, at) },
            b: held,
            rest_length: at,
            from: 0.1 * from as f64,
            until: until.map(|step| 0.1 * step as f64),
        };
        assert_eq!(recording.springs, [expected(1.0, 0, Some(3)), expected(2.0, 2, None)]);
        Ok(())
    }
}
