//! Messages about the begin and end of touch.

use bevy_ecs::prelude::*;

use super::PairKey;
use crate::part::Response;

/// Which end of a touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TouchPhase {
    /// Two parts touch that did not in the step before.
    Began,
    /// Two parts no longer touch.
    Ended,
}

/// Two parts began or ceased to touch. Of one time: in the order of pairs, by body ids and part numbers.
#[derive(Message, Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// Began or ended.
    pub phase: TouchPhase,
    /// The two parts.
    pub pair: PairKey,
    /// Sensor if one of the parts is.
    pub response: Response,
    /// When it was found: the end of the step, or of a part of one that was cut at an impact [s].
    pub time: f64,
}
