//! One run as a line of CSV.

use std::fmt;
use std::str::FromStr;

/// What came of a run; [`Line::HEADER`] names the columns.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Who ran.
    pub engine: String,
    /// Its version.
    pub version: String,
    /// The scene.
    pub scene: String,
    /// Bodies of the scene, those included that nothing moves.
    pub bodies: usize,
    /// Threads that the engine might use.
    pub threads: u32,
    /// Steps taken.
    pub steps: u32,
    /// Time of a step, mean over all of them [ms].
    pub ms_mean: f64,
    /// Time of a step, median [ms].
    pub ms_median: f64,
    /// Time that 95 % of the steps stay below [ms].
    pub ms_p95: f64,
    /// Touching pairs of parts at the end, as the judge counts them.
    pub contacts: usize,
    /// Deepest overlap at the end [m].
    pub max_overlap: f64,
    /// Mean overlap of touching pairs at the end [m].
    pub mean_overlap: f64,
    /// How far the body that was highest has moved [m].
    pub top_drift: f64,
    /// Kinetic energy of the centres of mass at the end [J].
    pub kinetic_energy: f64,
    /// Memory of the world before its first step, per body [bytes].
    pub bytes_per_body: f64,
    /// What the steps added to that, per touching pair; nothing where no pair touches [bytes].
    pub bytes_per_contact: Option<f64>,
    /// Digest of all bits of the final state.
    pub fingerprint: u128,
}

impl Line {
    /// Names of the columns.
    pub const HEADER: &'static str = "engine,version,scene,bodies,threads,steps,ms_mean,ms_median,ms_p95,contacts,max_overlap,\
        mean_overlap,top_drift,kinetic_energy,bytes_per_body,bytes_per_contact,fingerprint";
}

impl fmt::Display for Line {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { engine, version, scene, bodies, threads, steps, .. } = self;
        write!(formatter, "{engine},{version},{scene},{bodies},{threads},{steps}")?;
        write!(formatter, ",{:.6},{:.6},{:.6}", self.ms_mean, self.ms_median, self.ms_p95)?;
        write!(formatter, ",{},{:.6},{:.6}", self.contacts, self.max_overlap, self.mean_overlap)?;
        write!(formatter, ",{:.4},{:.4},{:.1},", self.top_drift, self.kinetic_energy, self.bytes_per_body)?;
        if let Some(bytes) = self.bytes_per_contact {
            write!(formatter, "{bytes:.1}")?;
        }
        write!(formatter, ",{:032x}", self.fingerprint)
    }
}

/// A line does not fit the header.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LineError {
    /// It has too few or too many fields.
    #[error("{found} fields instead of {expected}: {line}", expected = Line::HEADER.split(',').count())]
    Fields {
        /// How many there are.
        found: usize,
        /// The line.
        line: String,
    },
    /// A field cannot be read.
    #[error("`{value}` is no value of column `{column}`")]
    Value {
        /// Its column.
        column: &'static str,
        /// What stands there.
        value: String,
    },
}

impl FromStr for Line {
    type Err = LineError;

    fn from_str(line: &str) -> Result<Self, LineError> {
        let fields: Vec<&str> = line.trim_end().split(',').collect();
        if fields.len() != Self::HEADER.split(',').count() {
            return Err(LineError::Fields { found: fields.len(), line: line.to_owned() });
        }
        let mut columns = Self::HEADER.split(',').zip(fields);
        let mut text = || columns.next().unwrap_or_default();
        Ok(Self {
            engine: text().1.to_owned(),
            version: text().1.to_owned(),
            scene: text().1.to_owned(),
            bodies: value(text())?,
            threads: value(text())?,
            steps: value(text())?,
            ms_mean: value(text())?,
            ms_median: value(text())?,
            ms_p95: value(text())?,
            contacts: value(text())?,
            max_overlap: value(text())?,
            mean_overlap: value(text())?,
            top_drift: value(text())?,
            kinetic_energy: value(text())?,
            bytes_per_body: value(text())?,
            bytes_per_contact: match text() {
                (_, "") => None,
                field => Some(value(field)?),
            },
            fingerprint: {
                let (column, digits) = text();
                u128::from_str_radix(digits, 16).map_err(|_| LineError::Value { column, value: digits.to_owned() })?
            },
        })
    }
}

fn value<T: FromStr>((column, value): (&'static str, &str)) -> Result<T, LineError> {
    value.parse().map_err(|_| LineError::Value { column, value: value.to_owned() })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "box2d,3.2.0,pyramid2d,5051,2,400,3.710000,3.700000,3.900000,14842,0.021300,0.006100,0.7320,2.7000,812.5,\
        96.0,000102030405060708090a0b0c0d0e0f";

    #[test]
    fn a_line_reads_what_it_writes() {
        let line: Line = TEXT.parse().expect("all columns are there");
        assert_eq!(line.to_string(), TEXT);
        let nothing_touches = TEXT.replace(",96.0,", ",,");
        let line: Line = nothing_touches.parse().expect("the column may be empty");
        assert_eq!((line.bytes_per_contact, line.to_string()), (None, nothing_touches));
    }

    #[test]
    fn a_wrong_line_names_the_column() {
        let wrong = TEXT.replace("14842", "many").parse::<Line>();
        assert_eq!(wrong, Err(LineError::Value { column: "contacts", value: "many".to_owned() }));
        assert!(matches!("a,b".parse::<Line>(), Err(LineError::Fields { found: 2, .. })));
    }
}
