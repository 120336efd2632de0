//! Numbers of a file that become, when it is read, the numbers of a simulation to the last bit.

use glam::{DQuat, DVec2, DVec3};
use tumble_math::{SpatialRotation, Vector};

/// The number of degrees that means an angle [rad].
pub(crate) fn degrees(angle: f64) -> f64 {
    preimage(angle, angle.to_degrees(), f64::to_radians)
}

/// The point that a shift takes to `wanted` [m].
pub(crate) fn before_shift<V: Vector>(wanted: V, shift: V) -> V {
    let mut found = wanted - shift;
    for axis in 0..V::AXES {
        found[axis] = preimage(wanted[axis], found[axis], |x| x + shift[axis]);
    }
    found
}

/// The direction whose unit vector is `wanted`, to the last bit: a unit vector itself may change when it is made one again.
pub(crate) fn before_normalization(wanted: DVec2) -> DVec2 {
    let becomes_wanted = |direction: &DVec2| direction.try_normalize() == Some(wanted);
    // Lengths from 1 to 2 stand for all of them: doubling a vector changes no rounding.
    let mut candidates = (0..512).flat_map(|part| {
        let near = wanted * (1.0 + f64::from(part) / 512.0);
        neighbours(near.x).into_iter().flat_map(move |x| neighbours(near.y).map(|y| DVec2::new(x, y)))
    });
    candidates.find(becomes_wanted).unwrap_or(wanted)
}

/// The direction whose unit vector is `wanted`, to the last bit where one is found among its multiples.
pub(crate) fn spatial_before_normalization(wanted: DVec3) -> DVec3 {
    let becomes_wanted = |direction: &DVec3| Vector::try_normalize(*direction) == Some(wanted);
    multiples().map(|factor| wanted * factor).find(becomes_wanted).unwrap_or(wanted)
}

/// The quaternion that becomes `wanted` when it is made unit, to the last bit where one is found among its multiples.
pub(crate) fn quaternion_before_normalization(wanted: DQuat) -> DQuat {
    let becomes_wanted = |quaternion: &DQuat| {
        SpatialRotation::try_from_quaternion(*quaternion).is_some_and(|rotation| rotation.quaternion() == wanted)
    };
    multiples().map(|factor| wanted * factor).find(becomes_wanted).unwrap_or(wanted)
}

/// Factors from 1 to 2, which stand for all of them: doubling a vector changes no rounding.
fn multiples() -> impl Iterator<Item = f64> {
    const PARTS: u32 = 512;
    (0..PARTS).map(|part| 1.0 + f64::from(part) / f64::from(PARTS))
}

/// A number, and the three next to it on either side.
fn neighbours(number: f64) -> [f64; 7] {
    let (up, down) = (number.next_up(), number.next_down());
    let (up_2, down_2) = (up.next_up(), down.next_down());
    [number, up, down, up_2, down_2, up_2.next_up(), down_2.next_down()]
}

/// The number that a function takes to `wanted`, sought next to a guess; the guess if it is not there.
///
/// Rounding makes the guess miss by a few last bits at most, so a few neighbours on both sides are enough.
fn preimage(wanted: f64, guess: f64, function: impl Fn(f64) -> f64) -> f64 {
    let (mut up, mut down) = (guess, guess);
    for _ in 0..8 {
        for candidate in [up, down] {
            if function(candidate) == wanted {
                return candidate;
            }
        }
        (up, down) = (up.next_up(), down.next_down());
    }
    guess
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    use super::*;

    proptest! {
        #![proptest_config(ProptestConfig { cases: 2000, rng_seed: RngSeed::Fixed(3), failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn degrees_of_an_angle_mean_that_angle(written in -1e4..1e4_f64) {
            let angle = written.to_radians();
            prop_assert_eq!(degrees(angle).to_radians(), angle);
        }

        #[test]
        fn a_shifted_point_is_found_again(x in -1e3..1e3_f64, y in -1.0..1.0_f64, shift in -1e2..1e2_f64) {
            let (point, shift) = (DVec2::new(x, y), DVec2::new(shift, -shift));
            prop_assert_eq!(before_shift(point + shift, shift) + shift, point + shift);
        }

        #[test]
        fn a_direction_gives_its_unit_vector_again(x in -10.0..10.0_f64, y in 0.1..10.0_f64) {
            let unit = DVec2::new(x, y).normalize();
            prop_assert_eq!(before_normalization(unit).normalize(), unit);
        }
    }
}
