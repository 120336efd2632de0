use super::TouchPhase::{Begin, End};
use super::*;

fn with_touches(touches: &[Touch]) -> Recording {
    Recording { touches: touches.to_vec(), ..recording() }
}

#[test]
fn order_is_met_by_strictly_rising_first_occurrences() {
    let recording = with_touches(&[
        touch(2, BOX, FLOOR, Begin),
        touch(4, BOX, CRATE_0, Begin),
        touch(6, BOX, FLOOR, End),
        touch(8, BOX, FLOOR, Begin),
    ]);
    // Names in either order.
    let met =
        met(&recording, r#"Order(events: [Touch("floor", "box"), Touch("box", "crate-0"), Part("box", "floor")])"#);
    let Some(Measured::Times(times)) = met.measured else { panic!("times are measured") };
    assert!(times.iter().zip([0.2, 0.4, 0.6]).all(|(time, right)| (time.unwrap() - right).abs() <= ROUNDING));
    failed(&recording, r#"Order(events: [Touch("box", "crate-0"), Touch("box", "floor")])"#);
    // An event that never comes leaves the order unfinished, wherever it stands.
    failed(&recording, r#"Order(events: [Touch("box", "floor"), Part("box", "crate-0")])"#);
    failed(&recording, r#"Order(events: [Part("box", "crate-0"), Touch("box", "floor")])"#);
}

#[test]
fn events_of_one_step_have_no_order() {
    let recording = with_touches(&[touch(2, BOX, CRATE_0, Begin), touch(2, BOX, FLOOR, Begin)]);
    failed(&recording, r#"Order(events: [Touch("box", "crate-0"), Touch("box", "floor")])"#);
    failed(&recording, r#"Order(events: [Touch("box", "floor"), Touch("box", "crate-0")])"#);
}

#[test]
fn touch_begins_with_the_first_part_and_ends_with_the_last() {
    let recording = with_touches(&[
        touch(2, BOX, FLOOR, Begin),
        touch(3, BOX, FLOOR, Begin),
        touch(5, BOX, FLOOR, End),
        // One part takes over from another within a step.
        touch(7, BOX, FLOOR, End),
        touch(7, BOX, FLOOR, Begin),
        touch(9, BOX, FLOOR, End),
        touch(12, BOX, FLOOR, Begin),
    ]);
    for (event, occurrence, at) in [("Touch", 1, 0.2), ("Part", 1, 0.9), ("Touch", 2, 1.2)] {
        let happens =
            format!(r#"Happens(event: {event}("box", "floor"), occurrence: {occurrence}, at: {at}, within: 1e-9)"#);
        assert_measured(&met(&recording, &happens), at);
    }
    let third = failed(&recording, r#"Happens(event: Touch("box", "floor"), occurrence: 3, at: 1.2, within: 1e9)"#);
    assert_eq!(third.obstacle, Some(NotMeasured::TooFewEvents { times: 2 }));
}

#[test]
fn event_at_another_time_has_failed_with_its_time() {
    let recording = with_touches(&[touch(5, BOX, FLOOR, Begin)]);
    met(&recording, r#"Happens(event: Touch("box", "floor"), at: 0.45, within: 0.06)"#);
    assert_measured(&failed(&recording, r#"Happens(event: Touch("box", "floor"), at: 0.45, within: 0.04)"#), 0.5);
    failed(&recording, r#"Happens(event: Touch("box", "floor"), occurrence: 0, at: 0.5, within: 0.1)"#);
}

#[test]
fn never_needs_the_whole_run_unless_it_happened() {
    let recording = with_touches(&[touch(5, BOX, FLOOR, Begin)]);
    met(&recording, r#"Never(event: Part("box", "floor"))"#);
    met(&recording, r#"Never(event: Touch("box", "crate-0"))"#);
    let happened = failed(&recording, r#"Never(event: Touch("floor", "box"))"#);
    assert_eq!(happened.time, Some(0.5));
    let stopped = Recording { touches: recording.touches, ..stopped_after(12) };
    let unknown = failed(&stopped, r#"Never(event: Part("box", "floor"))"#);
    assert!(matches!(unknown.obstacle, Some(NotMeasured::NotReached { .. })));
    assert_eq!(failed(&stopped, r#"Never(event: Touch("box", "floor"))"#).time, Some(0.5));
}

#[test]
fn name_of_a_repeated_body_in_an_event_means_any_copy() {
    let recording = with_touches(&[
        touch(3, BOX, CRATE_1, Begin),
        touch(4, BOX, CRATE_0, Begin),
        touch(6, BOX, CRATE_1, End),
        touch(8, BOX, CRATE_0, End),
    ]);
    assert_measured(&met(&recording, r#"Happens(event: Touch("crate", "box"), at: 0.3, within: 1e-9)"#), DT * 3.0);
    assert_measured(&met(&recording, r#"Happens(event: Part("crate", "box"), at: 0.8, within: 1e-9)"#), 0.8);
    failed(&recording, r#"Never(event: Touch("box", "crate"))"#);
}
