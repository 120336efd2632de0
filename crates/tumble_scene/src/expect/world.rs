//! What is expected of the whole world, from the audit of every step: energy, momentum, overlap.

use tumble_record::AuditRow;

use super::judge::worst;
use super::{Expected, Finding, Measured, NotMeasured, Run};
use crate::dim::SceneDim;
use crate::format::{DepthExpectation, When};

impl<D: SceneDim> Run<'_, D> {
    /// Largest rise of the total energy above its lowest value so far [J].
    pub(super) fn energy_never_rises(&self, slack: f64) -> Result<Finding, NotMeasured> {
        let mut lowest = self.timeline.audit_of_start()?.total;
        self.worst_row(When::WHOLE_RUN, Expected::AtMost(slack), |row| {
            // `f64::min` passes over what is not a number; the difference does not.
            lowest = lowest.min(row.total);
            Measured::Number(row.total - lowest)
        })
    }

    /// Total energy against that of the start [J].
    pub(super) fn energy_kept(&self, within: f64) -> Result<Finding, NotMeasured> {
        let expected = Expected::near(self.timeline.audit_of_start()?.total, within);
        self.worst_row(When::WHOLE_RUN, expected, |row| Measured::Number(row.total))
    }

    /// Total momentum against that of the start [kg·m/s].
    pub(super) fn momentum_kept(&self, within: f64) -> Result<Finding, NotMeasured> {
        let expected = Expected::near_vector(self.timeline.audit_of_start()?.momentum, within);
        self.worst_row(When::WHOLE_RUN, expected, |row| Measured::of_vector(row.momentum))
    }

    /// Angular momentum about the origin against that of the start [kg·m²/s].
    pub(super) fn angular_momentum_kept(&self, within: f64) -> Result<Finding, NotMeasured> {
        let expected = Expected::same(D::measured(self.timeline.audit_of_start()?.angular_momentum), within);
        self.worst_row(When::WHOLE_RUN, expected, |row| D::measured(row.angular_momentum))
    }

    /// Deepest overlap of any two bodies [m].
    pub(super) fn depth(&self, e: &DepthExpectation, when: When) -> Result<Finding, NotMeasured> {
        let measured = |row: &AuditRow<D>| Measured::Number(row.deepest_overlap);
        match when {
            When::At(time) => {
                let row = self.timeline.audit_at(time)?;
                Ok(Finding { measured: measured(row), expected: e.into(), time: Some(row.time), body: None })
            }
            When::Throughout { .. } => self.worst_row(when, e.into(), measured),
        }
    }

    /// The worst audit row of a window.
    fn worst_row(
        &self,
        when: When,
        expected: Expected,
        mut measure: impl FnMut(&AuditRow<D>) -> Measured,
    ) -> Result<Finding, NotMeasured> {
        let rows = self.timeline.audits()?.iter().filter(|row| self.timeline.contains(when, row.time));
        let findings = rows.map(|row| Finding {
            measured: measure(row),
            expected: expected.clone(),
            time: Some(row.time),
            body: None,
        });
        self.timeline.conclude(worst(findings), when)
    }
}
