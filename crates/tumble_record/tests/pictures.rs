//! Plots say what they show and survive any data.

mod common;

use tumble_record::plot::Plot;
use tumble_record::{Channel, Series};

fn series(label: &str, values: &[f64]) -> Series {
    let times = (0..values.len()).map(|index| index as f64 * 0.1).collect();
    Series { label: label.to_owned(), times, values: values.to_vec() }
}

fn plot(series: Vec<Series>) -> String {
    Plot { title: "title".to_owned(), value_label: "speed [m/s]".to_owned(), series, ..Plot::default() }.to_svg()
}

/// Whether every coordinate of a line is a number within the page, 960 px wide with 8 units to a pixel.
fn is_drawable(svg: &str) -> bool {
    let lines = svg.lines().filter_map(|line| line.split_once("points=\"")?.1.split_once('"'));
    let mut numbers = lines.flat_map(|(points, _)| points.split([' ', ',']).filter(|text| !text.is_empty()));
    numbers.all(|text| text.parse::<f64>().is_ok_and(|number| (-8.0..=961.0 * 8.0).contains(&number)))
}

#[test]
fn energy_plot_names_its_axes_units_and_curves() {
    let svg = Plot::energy(&common::falling_rods(0.5, 10)).to_svg();
    for text in ["time [s]", "energy [J]", "kinetic", "potential", "total", "falling_rods", "penalty"] {
        assert!(svg.contains(text), "`{text}` is missing");
    }
    let lines = svg.matches("<polyline fill=\"none\" opacity=\"1\" stroke=\"#0072B2\"").count();
    assert_eq!(lines, 2, "one kinetic curve, and its piece in the legend");
    assert!(is_drawable(&svg));
}

#[test]
fn channel_plot_has_a_curve_and_a_legend_entry_per_moving_body() {
    let recording = common::falling_rods(0.1, 10);
    let every: Channel = "y".parse().expect("a channel");
    let svg = Plot::channel(&recording, &every).expect("few bodies").to_svg();
    assert!(svg.contains("y [m]") && svg.contains("star") && svg.contains("lift"));
    assert!(!svg.contains("floor"), "the floor does not move");
    let one: Channel = "y:star".parse().expect("a channel");
    let svg = Plot::channel(&recording, &one).expect("a body").to_svg();
    assert!(svg.contains("star: y of the centre of mass"));
}

#[test]
fn names_cannot_break_the_markup() {
    let svg = plot(vec![series("</svg><b>&\"'\u{1}", &[0.0, 1.0]), series("b", &[1.0, 0.0])]);
    assert!(!svg.contains("<b>"));
    assert!(!svg.contains('\u{1}'));
    assert_eq!(svg.matches("</svg>").count(), 1);
}

#[test]
fn curves_that_are_odd_are_drawn_all_the_same() {
    let odd: [&[f64]; 14] = [
        &[],
        &[1.0],
        &[f64::NAN],
        &[0.0, 0.0, 0.0],
        &[5.0, 5.0, 5.0],
        &[1.0, f64::NAN, 2.0, f64::INFINITY, 3.0],
        &[f64::NEG_INFINITY, f64::INFINITY],
        &[1e300, -1e300],
        &[f64::MAX, f64::MIN],
        &[5e-324, 0.0],
        &[1e-300, 2e-300],
        &[1.0, 1.0 + f64::EPSILON],
        &[1e9, 1e9 + 1.0],
        &[-3.0, -3.0 - 1e-14],
    ];
    for values in odd {
        let svg = plot(vec![series("a", values)]);
        assert!(svg.ends_with("</svg>\n") && svg.contains("speed [m/s]"), "{values:?}");
        assert!(is_drawable(&svg), "{values:?}");
    }
    assert!(plot(Vec::new()).contains("time [s]"), "no curve at all");
}

#[test]
fn curve_has_a_gap_where_it_is_not_finite() {
    let curves = |svg: &str| svg.matches("stroke=\"#0072B2\"").count();
    assert_eq!(curves(&plot(vec![series("a", &[1.0, 2.0, 3.0, 4.0, 5.0])])), 1);
    assert_eq!(curves(&plot(vec![series("a", &[1.0, 2.0, f64::NAN, 4.0, 5.0])])), 2);
}

#[test]
fn million_points_make_a_small_file() {
    let values: Vec<f64> = (0..1_000_000).map(|index| f64::from(index % 1000)).collect();
    let svg = plot(vec![series("a", &values)]);
    assert!(svg.len() < 200_000, "four points per pixel at most: {} bytes", svg.len());
}

/// Writes the pictures to the folder in `TUMBLE_PICTURES`, to look at them.
#[test]
#[ignore = "for the eye; set TUMBLE_PICTURES to a folder"]
fn pictures_to_look_at() {
    let Some(folder) = std::env::var_os("TUMBLE_PICTURES").map(std::path::PathBuf::from) else { return };
    let recording = common::falling_rods(4.0, 10);
    let write = |name: &str, svg: String| std::fs::write(folder.join(name), svg).expect("it can be written");
    write("energy.svg", Plot::energy(&recording).to_svg());
    for name in ["y", "normal_force:star", "friction_force:T", "angle:L", "contacts", "omega"] {
        let channel: Channel = name.parse().expect("a channel");
        write(&format!("{}.svg", channel.file_stem()), Plot::channel(&recording, &channel).expect("a body").to_svg());
    }
}
