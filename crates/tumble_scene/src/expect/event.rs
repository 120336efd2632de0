//! What is expected of events: touch and part of bodies.

use tumble_record::{Touch, TouchPhase};

use super::{Expected, Finding, Measured, NotMeasured, Run};
use crate::dim::SceneDim;
use crate::format::{Event, HappensExpectation};

impl<D: SceneDim> Run<'_, D> {
    /// First occurrences that come one after the other.
    pub(super) fn order(&self, events: &[Event]) -> Result<Finding, NotMeasured> {
        let times: Result<Vec<Option<f64>>, NotMeasured> =
            events.iter().map(|event| Ok(self.occurrences(event)?.first().copied())).collect();
        Ok(Finding { measured: Measured::Times(times?), expected: Expected::Order, time: None, body: None })
    }

    /// The occurrence that is meant, near a time [s].
    pub(super) fn happens(&self, e: &HappensExpectation) -> Result<Finding, NotMeasured> {
        let occurrences = self.occurrences(&e.event)?;
        let place = (e.occurrence as usize).checked_sub(1);
        let Some(&time) = place.and_then(|place| occurrences.get(place)) else {
            return Err(NotMeasured::TooFewEvents { times: occurrences.len() });
        };
        let expected = Expected::near(e.at, e.within);
        Ok(Finding { measured: Measured::Number(time), expected, time: Some(time), body: None })
    }

    /// No occurrence in the whole run.
    pub(super) fn never(&self, event: &Event) -> Result<Finding, NotMeasured> {
        let first = self.occurrences(event)?.first().copied();
        if first.is_none() {
            self.timeline.end()?;
        }
        Ok(Finding { measured: Measured::Times(vec![first]), expected: Expected::Never, time: first, body: None })
    }

    /// When an event happened [s], each time.
    fn occurrences(&self, event: &Event) -> Result<Vec<f64>, NotMeasured> {
        let [one, other] = event.bodies();
        let (one, other) = (self.bodies(one)?, self.bodies(other)?);
        let is_meant = |touch: &&Touch| {
            let is = |bodies: &[usize], body| bodies.binary_search(&body).is_ok();
            (is(&one, touch.a) && is(&other, touch.b)) || (is(&one, touch.b) && is(&other, touch.a))
        };
        let touches: Vec<&Touch> = self.timeline.recording.touches.iter().filter(is_meant).collect();
        let mut times = Vec::new();
        let mut touching_parts = 0_usize;
        // What is found at one time counts as a whole: parts may take over from each other in a step.
        for step in touches.chunk_by(|earlier, later| earlier.time == later.time) {
            let touched = touching_parts > 0;
            let begun = step.iter().filter(|touch| touch.phase == TouchPhase::Begin).count();
            touching_parts = (touching_parts + begun).saturating_sub(step.len() - begun);
            let happened = match event {
                Event::Touch(..) => !touched && touching_parts > 0,
                Event::Part(..) => touched && touching_parts == 0,
            };
            if happened {
                times.push(step[0].time);
            }
        }
        Ok(times)
    }
}
