//! Transcendental functions with the same bits on every machine.
//!
//! The platform's own differ between systems in the last bits; these come from `libm`, which computes them with + − × ÷ √ alone.
//! Clippy bans the others outside this module.

/// Sine of an angle [rad].
#[inline]
pub fn sin(angle: f64) -> f64 {
    libm::sin(angle)
}

/// Cosine of an angle [rad].
#[inline]
pub fn cos(angle: f64) -> f64 {
    libm::cos(angle)
}

/// Sine and cosine of an angle [rad].
#[inline]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    libm::sincos(angle)
}

/// Tangent of an angle [rad].
#[inline]
pub fn tan(angle: f64) -> f64 {
    libm::tan(angle)
}

/// Angle in (−π, π] whose direction is (x, y) [rad].
#[inline]
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// Inverse tangent [rad].
#[inline]
pub fn atan(x: f64) -> f64 {
    libm::atan(x)
}

/// Inverse sine [rad].
#[inline]
pub fn asin(x: f64) -> f64 {
    libm::asin(x)
}

/// Inverse cosine [rad].
#[inline]
pub fn acos(x: f64) -> f64 {
    libm::acos(x)
}

/// Exponential function.
#[inline]
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// Natural logarithm.
#[inline]
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// Hyperbolic cosine.
#[inline]
pub fn cosh(x: f64) -> f64 {
    libm::cosh(x)
}

/// Hyperbolic tangent.
#[inline]
pub fn tanh(x: f64) -> f64 {
    libm::tanh(x)
}

/// `base` to the power `exponent`.
#[inline]
pub fn pow(base: f64, exponent: f64) -> f64 {
    libm::pow(base, exponent)
}
