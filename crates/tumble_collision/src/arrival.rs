//! When a gap that changes smoothly in time closes: the first root of a separation.
//!
//! Far from the surface the search advances by what the gap could close at the fastest (conservative advancement; Mirtich 1996), which never steps
//! over a root. Near it, it follows the parabola through gap, rate and bend, which converges faster than Newton's method and
//! is exact for a body in free fall.

/// A gap at one instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gap {
    /// Separation; negative when overlapping [m].
    pub separation: f64,
    /// Its rate of change; negative when closing [m/s].
    pub rate: f64,
    /// Its second derivative [m/s²].
    pub bend: f64,
}

/// Where and how to search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// Start of the interval [s].
    pub from: f64,
    /// End of the interval, included [s].
    pub until: f64,
    /// No faster than this does the gap close [m/s].
    pub fastest: f64,
    /// Gap below which the parabola is followed [m].
    pub near: f64,
    /// A gap that closes no faster than this rests, or grazes, and has not arrived [m/s].
    pub slowest: f64,
}

/// Looks by which careful steps must have come to an end; later ones are at least a hundredth of the interval.
const PATIENCE: u32 = 100;
/// Most rounds along parabolas: each squares the error or better.
const ROUNDS: u32 = 12;

/// First time in the interval at which the gap closes, moving towards closing; `None` when it does not.
///
/// A gap that has not arrived after a hundred careful steps is searched more coarsely, and may then be missed if it opens again
/// within a hundredth of the interval.
pub fn first_arrival(search: &Search, mut gap_at: impl FnMut(f64) -> Gap) -> Option<f64> {
    let span = search.until - search.from;
    let mut time = search.from;
    let mut looks = 0;
    while time <= search.until {
        let gap = gap_at(time);
        if gap.separation <= search.near
            && let Some(arrival) = along_parabolas(search, time, gap, &mut gap_at)
        {
            return Some(arrival);
        }
        let careful = gap.separation.max(search.near) / search.fastest;
        let least = if looks < PATIENCE { 0.0 } else { 0.01 * span };
        if time == search.until || careful <= 0.0 || careful.is_nan() {
            break;
        }
        time = (time + careful.max(least)).min(search.until);
        looks += 1;
    }
    None
}

/// Time at which the parabola through a gap meets zero next, from now; negative for one that closes and has gone through [s].
///
/// ```text
/// s + u τ + ½ a τ² = 0
/// ```
pub fn parabola_arrival(gap: &Gap) -> Option<f64> {
    let Gap { separation: s, rate: u, bend: a } = *gap;
    let discriminant = u * u - 2.0 * a * s;
    if discriminant < 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    if u < 0.0 {
        return Some(2.0 * s / (root - u));
    }
    (a < 0.0).then(|| (u + root) / -a)
}

fn along_parabolas(search: &Search, from: f64, gap: Gap, gap_at: &mut impl FnMut(f64) -> Gap) -> Option<f64> {
    let (mut time, mut gap) = (from, gap);
    for _ in 0..ROUNDS {
        let ahead = parabola_arrival(&gap)?;
        let next = (time + ahead).max(search.from);
        if next > search.until {
            return None;
        }
        let settled = (next - time).abs() <= 4.0 * f64::EPSILON * search.until.abs();
        (time, gap) = (next, gap_at(next));
        if settled || gap.separation == 0.0 {
            break;
        }
    }
    let arrived = gap.separation.abs() <= 1e-3 * search.near && gap.rate < -search.slowest;
    arrived.then_some(time)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ball over a floor: gap, rate and bend in closed form.
    fn thrown(height: f64, speed: f64) -> impl FnMut(f64) -> Gap {
        move |t| Gap { separation: height + speed * t - 4.905 * t * t, rate: speed - 9.81 * t, bend: -9.81 }
    }

    fn search(until: f64, fastest: f64) -> Search {
        Search { from: 0.0, until, fastest, near: 1e-6, slowest: 1e-9 }
    }

    #[test]
    fn a_fall_arrives_when_the_closed_form_says() {
        let arrival = first_arrival(&search(1.0, 9.81), thrown(1.0, 0.0)).expect("it falls one metre in 0.45 s");
        // A few rounding errors of a time near 0.5.
        assert!((arrival - (2.0_f64 / 9.81).sqrt()).abs() < 4e-16, "{arrival}");
    }

    #[test]
    fn a_gap_that_ends_open_never_arrives() {
        assert_eq!(first_arrival(&search(0.45, 9.81), thrown(1.0, 0.0)), None);
        // Grazes at zero speed: the vertex of an upward parabola.
        let grazing = |t: f64| Gap { separation: (t - 0.5) * (t - 0.5), rate: 2.0 * (t - 0.5), bend: 2.0 };
        assert_eq!(first_arrival(&search(1.0, 1.0), grazing), None);
    }

    #[test]
    fn the_first_of_two_dips_is_found() {
        // Dips below zero near 0.25 and, deeper, near 0.75.
        let omega = 4.0 * std::f64::consts::PI;
        let dips = |t: f64| {
            let (sin, cos) = tumble_math::trig::sin_cos(omega * t);
            Gap { separation: 0.9 + cos - 0.2 * t, rate: -omega * sin - 0.2, bend: -omega * omega * cos }
        };
        let arrival = first_arrival(&search(1.0, omega + 0.2), dips).expect("it dips");
        assert!(arrival > 0.2 && arrival < 0.25, "{arrival}");
        assert!(dips(arrival).separation.abs() < 1e-15);
    }

    #[test]
    fn a_flight_that_has_just_begun_arrives_at_its_end() {
        // Up at 1 mm/s from the surface itself: back after 2 u / g.
        let arrival = parabola_arrival(&Gap { separation: 0.0, rate: 1e-3, bend: -9.81 }).expect("it falls back");
        assert!((arrival - 2e-3 / 9.81).abs() < 1e-19);
        assert_eq!(parabola_arrival(&Gap { separation: 0.0, rate: 1e-3, bend: 0.0 }), None);
    }

    #[test]
    fn nothing_arrives_by_standing_still() {
        let still = |_: f64| Gap { separation: 0.5, rate: 0.0, bend: 0.0 };
        assert_eq!(first_arrival(&search(1.0, 0.0), still), None);
        assert_eq!(first_arrival(&search(1.0, 1.0), still), None);
    }
}
