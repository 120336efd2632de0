//! The samples of a recording by time.

use tumble_record::{AuditRow, BodyState, Recording, Sample};

use super::{Finding, NotMeasured};
use crate::dim::SceneDim;
use crate::format::When;

/// Part of a step by which a time may miss a step through rounding of decimals and products [1].
const ROUND_OFF: f64 = 1e-6;

/// A recording and how long it should be.
pub(super) struct Timeline<'r, D: SceneDim> {
    pub recording: &'r Recording<D>,
    /// The step with which the run should end.
    last_step: u64,
}

/// A body's state, at the time of a step.
pub(super) struct StateAt<D: SceneDim> {
    pub state: BodyState<D>,
    /// Time of the step [s].
    pub time: f64,
}

impl<'r, D: SceneDim> Timeline<'r, D> {
    pub fn new(recording: &'r Recording<D>, duration: f64) -> Self {
        let mut timeline = Self { recording, last_step: 0 };
        timeline.last_step = timeline.nearest_step(duration);
        timeline
    }

    /// The step that ends nearest to a time.
    fn nearest_step(&self, time: f64) -> u64 {
        (time / self.recording.dt).round() as u64
    }

    /// Refuses what needs steps that were not recorded.
    fn reach(&self, step: u64) -> Result<&'r Sample<D>, NotMeasured> {
        let last = self.recording.samples.last().ok_or(NotMeasured::NothingRecorded)?;
        if last.step < step { Err(NotMeasured::NotReached { end: last.time }) } else { Ok(last) }
    }

    /// The last sample, unless the run stopped early.
    pub fn end(&self) -> Result<&'r Sample<D>, NotMeasured> {
        self.reach(self.last_step)
    }

    /// Refuses a window that was not over when the recording ended.
    pub fn reach_end_of(&self, when: When) -> Result<(), NotMeasured> {
        let step = match when {
            When::At(time) => self.nearest_step(time),
            When::Throughout { until, .. } if until == f64::INFINITY => self.last_step,
            When::Throughout { until, .. } => (until / self.recording.dt + ROUND_OFF).floor() as u64,
        };
        self.reach(step).map(|_| ())
    }

    /// Passes on a failure at once, and anything else only if the window was over when the recording ended.
    pub fn conclude(&self, finding: Option<Finding>, when: When) -> Result<Finding, NotMeasured> {
        if let Some(finding) = &finding
            && !finding.judgement().holds
        {
            return Ok(finding.clone());
        }
        self.reach_end_of(when)?;
        finding.ok_or(NotMeasured::EmptyWindow)
    }

    /// Whether a time lies in a window, ends included.
    pub fn contains(&self, when: When, time: f64) -> bool {
        let round_off = ROUND_OFF * self.recording.dt;
        match when {
            When::At(_) => false,
            When::Throughout { from, until } => time >= from - round_off && time <= until + round_off,
        }
    }

    /// The samples of a window.
    pub fn samples(&self, when: When) -> impl Iterator<Item = &'r Sample<D>> {
        self.recording.samples.iter().filter(move |sample| self.contains(when, sample.time))
    }

    /// State of a body at the step nearest to a time, interpolated between samples if that step was not sampled.
    pub fn state_at(&self, body: usize, time: f64) -> Result<StateAt<D>, NotMeasured> {
        let step = self.nearest_step(time);
        self.reach(step)?;
        let samples = &self.recording.samples;
        let next = samples.partition_point(|sample| sample.step < step);
        let after = &samples[next];
        if after.step == step {
            return Ok(StateAt { state: *self.state(after, body)?, time: after.time });
        }
        // A recording that begins later than asked has nothing before.
        let before = next.checked_sub(1).map(|index| &samples[index]).ok_or(NotMeasured::EmptyWindow)?;
        let share = (step - before.step) as f64 / (after.step - before.step) as f64;
        let state = interpolate(self.state(before, body)?, self.state(after, body)?, share);
        Ok(StateAt { state, time: before.time + share * (after.time - before.time) })
    }

    /// State of a body in a sample.
    pub fn state(&self, sample: &'r Sample<D>, body: usize) -> Result<&'r BodyState<D>, NotMeasured> {
        sample.state(body).ok_or_else(|| {
            let body = self.recording.bodies[body].name.clone();
            NotMeasured::BodyAbsent { body, time: sample.time }
        })
    }

    /// The sample nearest to a time among those after at least one step, the earlier of two.
    pub fn sample_after_a_step_near(&self, time: f64) -> Result<&'r Sample<D>, NotMeasured> {
        let step = self.nearest_step(time);
        self.reach(step)?;
        let moved = self.recording.samples.iter().filter(|sample| sample.step > 0);
        moved.min_by_key(|sample| sample.step.abs_diff(step)).ok_or(NotMeasured::EmptyWindow)
    }

    /// The audit rows; refused if they do not go as far as the samples.
    pub fn audits(&self) -> Result<&'r [AuditRow<D>], NotMeasured> {
        let end = self.recording.samples.last().ok_or(NotMeasured::NothingRecorded)?;
        let rows = &self.recording.audit;
        if rows.last().is_some_and(|row| row.step >= end.step) { Ok(rows) } else { Err(NotMeasured::NoAudit) }
    }

    /// The first audit row.
    pub fn audit_of_start(&self) -> Result<&'r AuditRow<D>, NotMeasured> {
        self.audits()?.first().ok_or(NotMeasured::NoAudit)
    }

    /// The audit row of the step nearest to a time.
    pub fn audit_at(&self, time: f64) -> Result<&'r AuditRow<D>, NotMeasured> {
        let step = self.nearest_step(time);
        self.reach(step)?;
        let rows = self.audits()?;
        let index = rows.binary_search_by_key(&step, |row| row.step).map_err(|_| NotMeasured::NoAudit)?;
        Ok(&rows[index])
    }
}

/// The state at a share of the way from one to another.
fn interpolate<D: SceneDim>(from: &BodyState<D>, to: &BodyState<D>, share: f64) -> BodyState<D> {
    BodyState {
        position: from.position + (to.position - from.position) * share,
        orientation: D::orientation_between(&from.orientation, &to.orientation, share),
        velocity: from.velocity + (to.velocity - from.velocity) * share,
        angular_velocity: from.angular_velocity + (to.angular_velocity - from.angular_velocity) * share,
    }
}
