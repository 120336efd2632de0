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

/// sin(x)/x and (1 − cos x)/x², of x²: what turning by a vector needs, without dividing by its length.
///
/// Up to a quarter radian by their series, which then end below round-off.
#[inline]
pub fn sinc_and_versinc(squared: f64) -> (f64, f64) {
    let s = squared;
    if s < 0.0625 {
        let sinc =
            1.0 - s * (1.0 / 6.0 - s * (1.0 / 120.0 - s * (1.0 / 5040.0 - s * (1.0 / 362_880.0 - s / 39_916_800.0))));
        let versinc = 0.5
            - s * (1.0 / 24.0 - s * (1.0 / 720.0 - s * (1.0 / 40_320.0 - s * (1.0 / 3_628_800.0 - s / 479_001_600.0))));
        (sinc, versinc)
    } else {
        // By the half angle: 1 − cos x would lose digits.
        let x = s.sqrt();
        let (sin, cos) = sin_cos(0.5 * x);
        (2.0 * sin * cos / x, 2.0 * sin * sin / s)
    }
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
