//! Where the figures of a pair came from.

use std::fmt;

use crate::format::{Coefficient, Surface, Take};

/// Where each figure of a pair came from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PairOrigins {
    /// That of μ_s.
    pub static_friction: Origin,
    /// That of μ_k.
    pub kinetic_friction: Origin,
    /// That of ε.
    pub restitution: Origin,
}

/// Where a figure came from; its `Display` is a phrase such as `pair, middle of 0.2 to 0.6`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Origin {
    /// Who said it.
    pub source: Source,
    /// What was made of it.
    pub remarks: Vec<Remark>,
}

/// Who said a figure.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Source {
    /// Nobody: it is 0.
    #[default]
    Unset,
    /// A table lists the pair.
    Pair,
    /// The entry of a material, about contact with itself.
    Material(String),
    /// The root of the product of what two materials bring along [1].
    Combined(f64, f64),
    /// Of two materials this one bounces more.
    Bouncier(String),
}

/// What was made of a figure in a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Remark {
    /// It is one number out of a range.
    OutOf(Coefficient, Take),
    /// It is the other coefficient of friction, of which the symbol is given.
    Like(&'static str),
    /// It is for the other state of the surfaces.
    Surface(Surface),
}

impl fmt::Display for Origin {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        match &self.source {
            Source::Unset => formatter.write_str("not set")?,
            Source::Pair => formatter.write_str("pair")?,
            Source::Material(name) | Source::Bouncier(name) => write!(formatter, "\"{name}\"")?,
            Source::Combined(a, b) => write!(formatter, "√({} · {})", short(*a), short(*b))?,
        }
        self.remarks.iter().try_for_each(|remark| write!(formatter, ", {remark}"))
    }
}

impl fmt::Display for Remark {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::OutOf(Coefficient { low, high }, take) => {
                let place = match take {
                    Take::Low => "low end",
                    Take::Midpoint => "middle",
                    Take::High => "high end",
                };
                write!(formatter, "{place} of {low} to {high}")
            }
            Self::Like(symbol) => write!(formatter, "like {symbol}"),
            Self::Surface(Surface::Dry) => formatter.write_str("of dry surfaces"),
            Self::Surface(Surface::Lubricated) => formatter.write_str("of lubricated surfaces"),
        }
    }
}

/// A number without the digits that only rounding made.
fn short(value: f64) -> f64 {
    const DIGITS: f64 = 1e6;
    (value * DIGITS).round() / DIGITS
}
