//! Claims about the state of bodies.

use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tumble_math::Planar;

use crate::format::{ContactModel, Dialect, OrientationEntry};

expectation! {
    /// A vector near a value. Say when by one of `at`, `always: true`, or `from` and/or `until`.
    #[derive(Default)]
    #[serde(bound = "D: Dialect")]
    #[schemars(bound = "D: Dialect")]
    VectorExpectation<D> {
        /// Name of the body; that of a repeated body claims it for every copy.
        of: String,
        [when]
        /// The value, in the unit of the expectation.
        #[schemars(with = "D::VectorText")]
        is: D::Vector,
        /// Largest distance from the value, in the same unit.
        within: f64,
    }
}

expectation! {
    /// A number near a value, or between bounds. Say when by one of `at`, `always: true`, or `from` and/or `until`.
    #[derive(Default)]
    ScalarExpectation {
        /// Name of the body; that of a repeated body claims it for every copy.
        of: String,
        [when]
        /// The value, in the unit of the expectation; needs `within`.
        #[serde(default)]
        is: Option<f64>,
        /// Largest distance from the value, in the same unit.
        #[serde(default)]
        within: Option<f64>,
        /// Lower bound, in the same unit. Default none.
        #[serde(default)]
        above: Option<f64>,
        /// Upper bound, in the same unit. Default none.
        #[serde(default)]
        below: Option<f64>,
    }
}

expectation! {
    /// An angle near a value, or between bounds. Say when by one of `at`, `always: true`, or `from` and/or `until`.
    #[derive(Default)]
    AngleExpectation {
        /// Name of the body; that of a repeated body claims it for every copy.
        of: String,
        [when]
        /// The angle [degrees]; needs `within_degrees`.
        #[serde(default)]
        is_degrees: Option<f64>,
        /// Largest difference from the angle [degrees].
        #[serde(default)]
        within_degrees: Option<f64>,
        /// Lower bound [degrees]. Default none.
        #[serde(default)]
        above_degrees: Option<f64>,
        /// Upper bound [degrees]. Default none.
        #[serde(default)]
        below_degrees: Option<f64>,
    }
}

expectation! {
    /// A body of space turned in a certain way. Say when by one of `at`, `always: true`, or `from` and/or `until`.
    #[derive(Default)]
    OrientationExpectation {
        /// Name of the body; that of a repeated body claims it for every copy.
        of: String,
        [when]
        /// How the design frame is turned. Default not at all.
        #[serde(default)]
        is: Option<OrientationEntry>,
        /// Largest angle of the turn that is missing [degrees].
        within_degrees: f64,
    }
}

expectation! {
    /// The angle between an axis of a body of space and a direction, from 0 to 180 degrees. Say when by one of `at`, `always: true`, or `from`
    /// and/or `until`.
    #[derive(Default)]
    TiltExpectation {
        /// Name of the body; that of a repeated body claims it for every copy.
        of: String,
        /// The axis of the body, design frame, of any length but zero [1]. Default (0, 1, 0).
        #[serde(default)]
        #[schemars(with = "Option<(f64, f64, f64)>")]
        axis: Option<DVec3>,
        /// The direction, world axes, of any length but zero [1]. Default where the axis pointed in the first sample.
        #[serde(default)]
        #[schemars(with = "Option<(f64, f64, f64)>")]
        against: Option<DVec3>,
        [when]
        /// The angle [degrees]; needs `within_degrees`.
        #[serde(default)]
        is_degrees: Option<f64>,
        /// Largest difference from the angle [degrees].
        #[serde(default)]
        within_degrees: Option<f64>,
        /// Lower bound [degrees]. Default none.
        #[serde(default)]
        above_degrees: Option<f64>,
        /// Upper bound [degrees]. Default none.
        #[serde(default)]
        below_degrees: Option<f64>,
    }
}

expectation! {
    /// A body, or every dynamic body, at rest from a time on.
    AtRestExpectation {
        /// Name of the body; that of a repeated body claims it for every copy. Default every dynamic body.
        #[serde(default)]
        of: Option<String>,
        /// From when on [s].
        from: f64,
        /// Largest speed from then on [m/s]. Default 0.001.
        #[serde(default = "default_rest_speed")]
        speed_below: f64,
        /// Largest rate of turn from then on [rad/s]. Default 0.001.
        #[serde(default = "default_rest_speed")]
        turn_below: f64,
        /// Largest distance from where the body was at that time [m]. Default no bound.
        #[serde(default)]
        drift_below: Option<f64>,
    }
}

expectation! {
    /// Every bit of the final state.
    #[derive(Default)]
    FingerprintExpectation {
        /// The fingerprint: 32 hexadecimal digits.
        is: String,
    }
}

fn default_rest_speed() -> f64 {
    1e-3
}
