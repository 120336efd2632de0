//! Plots, frames and models say what they show and survive any data.

use std::collections::BTreeSet;

use crate::common;
use tumble_math::{Planar, Spatial};
use tumble_record::frames::{FrameSettings, Frames, Picture, write_frames};
use tumble_record::gltf::to_gltf;
use tumble_record::plot::Plot;
use tumble_record::{Channel, RecordDim, Recording, Series};

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

const SMALL: FrameSettings = FrameSettings { count: 3, width: 160, height: 90 };

/// How many pixels of a picture differ from those of another.
fn different(one: &Picture, other: &Picture) -> usize {
    one.pixels.chunks(3).zip(other.pixels.chunks(3)).filter(|(one, other)| one != other).count()
}

fn frames_show_the_motion<D: RecordDim>(recording: &Recording<D>) {
    let frames = Frames::new(recording, SMALL);
    let pictures: Vec<Picture> = (0..frames.count()).map(|number| frames.picture(number)).collect();
    let empty = Frames::new(&Recording { samples: Vec::new(), ..recording.clone() }, SMALL).picture(0);
    for picture in &pictures {
        assert_eq!((picture.width, picture.height, picture.pixels.len()), (160, 90, 3 * 160 * 90));
        // Bodies that fill the picture from margin to margin, though most of it may be sky and ground.
        assert!(different(picture, &empty) > 160 * 90 / 50, "bodies are seen");
        let colors: BTreeSet<&[u8]> = picture.pixels.chunks(3).collect();
        assert!(colors.len() > 100, "light and shadow: {} colours", colors.len());
    }
    assert!(different(&pictures[0], &pictures[2]) > 160 * 90 / 100, "bodies have moved");
    assert_eq!(Frames::new(recording, SMALL).picture(1), pictures[1], "the same bytes again");
}

#[test]
fn frames_of_the_plane_show_the_motion() {
    frames_show_the_motion(&common::falling_rods(1.0, 10));
}

#[test]
fn frames_of_space_show_the_motion() {
    frames_show_the_motion(&common::space::assortment(1.0, 4).expect("a sound world"));
}

#[test]
fn frames_of_nothing_are_sky() {
    for picture in [
        Frames::new(&Recording::<Planar>::default(), SMALL).picture(0),
        Frames::new(&Recording::<Spatial>::default(), SMALL).picture(2),
    ] {
        let rows: Vec<&[u8]> = picture.pixels.chunks(3 * 160).collect();
        assert!(rows.iter().all(|row| row.chunks(3).all(|pixel| pixel == &row[..3])), "each row in one colour");
        assert!(rows[0] != rows[89], "brighter towards the horizon");
    }
}

#[test]
fn frames_are_files_that_read_back_and_are_the_same_bytes_again() -> Result<(), Box<dyn std::error::Error>> {
    let recording = common::space::assortment(0.5, 4)?;
    let folders = [tempfile::tempdir()?, tempfile::tempdir()?];
    for folder in &folders {
        let paths = write_frames(&recording, SMALL, folder.path())?;
        let names: Vec<_> = paths.iter().map(|path| path.strip_prefix(folder.path()).expect("in the folder")).collect();
        let expected = ["frames/0000.png", "frames/0001.png", "frames/0002.png", "scene.gif"];
        assert!(names.iter().zip(expected).all(|(name, expected)| name.as_os_str() == expected), "{names:?}");
        for (number, path) in paths[..3].iter().enumerate() {
            let mut reader = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(path)?)).read_info()?;
            let mut pixels = vec![0; reader.output_buffer_size().ok_or("it fits into memory")?];
            reader.next_frame(&mut pixels)?;
            assert_eq!(pixels, Frames::new(&recording, SMALL).picture(number).pixels);
        }
        let mut decoder = gif::DecodeOptions::new().read_info(std::fs::File::open(&paths[3])?)?;
        assert_eq!((decoder.width(), decoder.height(), decoder.repeat()), (160, 90, gif::Repeat::Infinite));
        // Half a second in two intervals of 25 hundredths, and as long for the last picture.
        let mut delays = Vec::new();
        while let Some(frame) = decoder.read_next_frame()? {
            delays.push(frame.delay);
        }
        assert_eq!(delays, [25, 25, 25]);
    }
    for name in ["frames/0001.png", "scene.gif"] {
        let bytes = folders.each_ref().map(|folder| std::fs::read(folder.path().join(name)).expect("it is there"));
        assert!(bytes[0] == bytes[1], "{name}");
    }
    Ok(())
}

/// The bytes of a data address.
fn decoded(uri: &str) -> Vec<u8> {
    const DIGITS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let (_, text) = uri.split_once("base64,").expect("base64");
    let (mut bytes, mut bits, mut count) = (Vec::new(), 0_u32, 0);
    for letter in text.bytes().filter(|letter| *letter != b'=') {
        bits = bits << 6 | DIGITS.iter().position(|digit| *digit == letter).expect("a digit") as u32;
        count += 6;
        if count >= 8 {
            count -= 8;
            bytes.push((bits >> count) as u8);
        }
    }
    bytes
}

/// Checks a file as a viewer would read it; returns how many nodes move.
fn check_gltf<D: RecordDim>(recording: &Recording<D>) -> usize {
    let text = to_gltf(recording);
    // Validates everything that the format demands of the parts and of what they refer to.
    let file = gltf::Gltf::from_slice(text.as_bytes()).expect("valid glTF");
    let buffers: Vec<Vec<u8>> = file
        .buffers()
        .map(|buffer| match buffer.source() {
            gltf::buffer::Source::Uri(uri) => decoded(uri),
            gltf::buffer::Source::Bin => panic!("all is in one file"),
        })
        .collect();
    let data = |buffer: gltf::Buffer<'_>| buffers.get(buffer.index()).map(Vec::as_slice);
    assert!(file.buffers().all(|buffer| buffer.length() == buffers[buffer.index()].len()));
    for mesh in file.meshes() {
        for primitive in mesh.primitives() {
            let reader = primitive.reader(data);
            let positions: Vec<[f32; 3]> = reader.read_positions().expect("positions").collect();
            let bounds = primitive.bounding_box();
            for axis in 0..3 {
                let along = positions.iter().map(|position| position[axis]);
                assert_eq!(along.clone().fold(f32::INFINITY, f32::min), bounds.min[axis]);
                assert_eq!(along.fold(f32::NEG_INFINITY, f32::max), bounds.max[axis]);
            }
            for normal in reader.read_normals().expect("normals") {
                let length = normal.iter().map(|part| part * part).sum::<f32>().sqrt();
                assert!((length - 1.0).abs() < 1e-6, "rounding of 32 bits: {length}");
            }
            let corners = reader.read_indices().expect("triangles").into_u32();
            assert!(corners.into_iter().all(|corner| (corner as usize) < positions.len()));
        }
    }
    let mut moving = BTreeSet::new();
    for channel in file.animations().flat_map(|animation| animation.channels().collect::<Vec<_>>()) {
        let reader = channel.reader(data);
        let times: Vec<f32> = reader.read_inputs().expect("times").collect();
        assert!(times.windows(2).all(|pair| pair[0] < pair[1]), "time goes on");
        let node = channel.target().node();
        let Some(body) = recording.body(node.name().expect("a name")) else { continue };
        let states: Vec<_> = recording.states(body).map(|(_, state)| state).collect();
        match reader.read_outputs().expect("values") {
            gltf::animation::util::ReadOutputs::Translations(places) => {
                let places: Vec<[f32; 3]> = places.collect();
                assert_eq!(places.len(), times.len());
                for (place, state) in places.iter().zip(&states) {
                    assert_eq!(*place, D::embed(state.position).as_vec3().to_array());
                }
                moving.insert(node.index());
            }
            gltf::animation::util::ReadOutputs::Rotations(turns) => {
                let turns: Vec<[f32; 4]> = turns.into_f32().collect();
                assert_eq!(turns.len(), times.len());
                let dot = |a: &[f32; 4], b: &[f32; 4]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f32>();
                assert!(turns.windows(2).all(|pair| dot(&pair[0], &pair[1]) > 0.0), "the shorter way");
                for (turn, state) in turns.iter().zip(&states) {
                    let exact = D::quaternion(&state.orientation).as_quat().to_array();
                    // The same rotation, whichever sign; rounding of 32 bits.
                    assert!((dot(turn, &exact).abs() - 1.0).abs() < 1e-6, "{turn:?} {exact:?}");
                }
            }
            _ => assert_eq!(channel.target().property(), gltf::animation::Property::Scale),
        }
    }
    moving.len()
}

#[test]
fn gltf_is_valid_and_has_the_samples_of_every_moving_body() {
    let space = common::space::assortment(1.0, 4).expect("a sound world");
    assert_eq!(check_gltf(&space), 11, "all but the floor");
    // The lift, four thrown bodies and the one that falls straight.
    assert_eq!(check_gltf(&common::falling_rods(1.0, 10)), 6);
    assert_eq!(check_gltf(&Recording::<Planar>::default()), 0);
    assert_eq!(check_gltf(&Recording::<Spatial>::default()), 0);
}

#[test]
fn gltf_stretches_springs_from_end_to_end() {
    let recording = common::falling_rods(1.0, 10);
    let text = to_gltf(&recording);
    let file = gltf::Gltf::from_slice(text.as_bytes()).expect("valid glTF");
    let bytes = file.buffers().next().map(|buffer| match buffer.source() {
        gltf::buffer::Source::Uri(uri) => decoded(uri),
        gltf::buffer::Source::Bin => panic!("all is in one file"),
    });
    let node = file.nodes().find(|node| node.name() == Some("spring 0")).expect("the spring");
    let (mut places, mut turns, mut sizes) = (Vec::new(), Vec::new(), Vec::new());
    for channel in file.animations().flat_map(|animation| animation.channels().collect::<Vec<_>>()) {
        if channel.target().node().index() != node.index() {
            continue;
        }
        match channel.reader(|_| bytes.as_deref()).read_outputs().expect("values") {
            gltf::animation::util::ReadOutputs::Translations(all) => places.extend(all),
            gltf::animation::util::ReadOutputs::Rotations(all) => turns.extend(all.into_f32()),
            gltf::animation::util::ReadOutputs::Scales(all) => sizes.extend(all),
            gltf::animation::util::ReadOutputs::MorphTargetWeights(_) => panic!("nothing morphs"),
        }
    }
    let spring = &recording.springs[0];
    let ends =
        |sample| [&spring.a, &spring.b].map(|end| end.in_world(sample).expect("it is there").extend(0.0).as_vec3());
    let (place, turn, size) = node.transform().decomposed();
    let length = ends(&recording.samples[0]);
    let length = length[0].distance(length[1]);
    for (index, sample) in recording.samples.iter().enumerate() {
        let [from, to] = ends(sample);
        let place = glam::Vec3::from(*places.get(index).unwrap_or(&place));
        let turn = glam::Quat::from_array(*turns.get(index).unwrap_or(&turn));
        let size = sizes.get(index).unwrap_or(&size)[1];
        // Rounding of 32 bits, at a few metres.
        assert!(
            (place - from).length() < 1e-5 && (place + turn * glam::Vec3::Y * (size * length) - to).length() < 1e-5
        );
    }
    assert!(sizes.iter().any(|size| (size[1] - 1.0).abs() > 0.01), "it is stretched");
}

#[test]
fn frames_show_contacts_and_springs() {
    let mut recording = common::falling_rods(1.0, 10);
    let touching = recording.samples.iter().rposition(|sample| !sample.contacts.is_empty()).expect("bodies bounce");
    recording.samples.truncate(touching + 1);
    let last = |recording: &Recording| {
        let settings = FrameSettings { count: 2, width: 480, height: 270 };
        Frames::new(recording, settings).picture(1)
    };
    let all = last(&recording);
    recording.springs.clear();
    let without_springs = last(&recording);
    recording.samples.iter_mut().for_each(|sample| sample.contacts.clear());
    let bodies_only = last(&recording);
    // A spring is some pixels wide, and so are a contact and the arrow of its force.
    assert!(different(&all, &without_springs) > 10, "{}", different(&all, &without_springs));
    assert!(different(&without_springs, &bodies_only) > 10, "{}", different(&without_springs, &bodies_only));
}

#[test]
fn gltf_turns_the_way_up_to_y_and_hides_who_is_away() {
    let mut recording = common::space::assortment(0.1, 1).expect("a sound world");
    recording.samples[3].states[4] = None;
    recording.gravity = -glam::DVec3::Z * 9.81;
    assert_eq!(check_gltf(&recording), 11);
    let file = gltf::Gltf::from_slice(to_gltf(&recording).as_bytes()).expect("valid glTF");
    let root = file.scenes().next().expect("a scene").nodes().next().expect("a root");
    let (_, turn, _) = root.transform().decomposed();
    let up = glam::Quat::from_array(turn) * glam::Vec3::Z;
    assert!((up - glam::Vec3::Y).length() < 1e-6, "{up}");
    let scales = file.animations().flat_map(|animation| animation.channels().collect::<Vec<_>>());
    let scales = scales.filter(|channel| channel.target().property() == gltf::animation::Property::Scale);
    let name = recording.bodies[4].name.clone();
    assert!(scales.map(|channel| channel.target().node().name().map(str::to_owned)).eq([Some(name)]));
}
