//! Shapes from OBJ and STL files: what they become, and what is said of those that cannot be used.

use std::fmt::Write;
use std::fs;

use glam::{DVec3, dvec3};
use tempfile::TempDir;
use tumble_math::Spatial;
use tumble_scene::format::{HullPart, MeshPart, SpatialPart};
use tumble_scene::{FromScene, Loaded, Surface, SurfaceError, ToScene};
use tumble_shape::{ConvexHull, TriangleMesh};
use tumble_sim::{Amount, BodyKind, Part, Position, Settings, Simulation};

type Fallible<T = ()> = Result<T, Box<dyn std::error::Error>>;

/// A box of 2 × 4 × 6 around the origin, with faces of four corners.
const BOX: &str = "o box
v -1 -2 -3\nv 1 -2 -3\nv 1 2 -3\nv -1 2 -3\nv -1 -2 3\nv 1 -2 3\nv 1 2 3\nv -1 2 3
f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8
";

/// Two triangles over a square of 4 m, by corners of their own.
const SQUARE: [[[f32; 3]; 3]; 2] =
    [[[0.0, 0.0, 0.0], [0.0, 0.0, 4.0], [4.0, 0.5, 4.0]], [[0.0, 0.0, 0.0], [4.0, 0.5, 4.0], [4.0, 0.5, 0.0]]];

fn ascii_stl(triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut text = String::from("solid square\n");
    for corners in triangles {
        text += "facet normal 0 1 0\nouter loop\n";
        for [x, y, z] in corners {
            writeln!(text, "vertex {x} {y} {z}").expect("a string takes all");
        }
        text += "endloop\nendfacet\n";
    }
    (text + "endsolid square\n").into_bytes()
}

fn binary_stl(triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for corners in triangles {
        bytes.extend([0; 12]);
        bytes.extend(corners.iter().flatten().flat_map(|number| number.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

/// A folder with a file in it.
fn folder_with(name: &str, bytes: impl AsRef<[u8]>) -> Fallible<TempDir> {
    let folder = tempfile::tempdir()?;
    fs::write(folder.path().join(name), bytes)?;
    Ok(folder)
}

fn scene_with(part: &str, kind: &str) -> String {
    format!(
        r#"(format: 1, dimension: Spatial, duration: 1,
    bodies: [(name: "rock", kind: {kind}, parts: [
        {part},
    ])],
)"#
    )
}

/// Loads a scene that stands in a folder.
fn load(folder: &TempDir, part: &str, kind: &str) -> Result<Loaded<Spatial>, String> {
    let path = folder.path().join("scene.ron");
    fs::write(&path, scene_with(part, kind)).expect("the folder can be written");
    let folder = format!("{}{}", folder.path().display(), std::path::MAIN_SEPARATOR);
    Loaded::load(path).map_err(|mistakes| mistakes.to_string().replace(&folder, ""))
}

#[test]
fn hull_of_a_file_is_the_hull_of_its_points_in_metres() -> Fallible {
    let folder = folder_with("box.obj", BOX)?;
    let loaded = load(&folder, r#"HullFile(file: "box.obj", scale: 0.5, density: 3)"#, "Dynamic")?;
    let SpatialPart::Hull(HullPart { points, density: Some(3.0), .. }) = &loaded.scene.bodies[0].parts[0] else {
        panic!("{:?}", loaded.scene.bodies[0].parts);
    };
    assert_eq!(points.len(), 8);
    assert!(points.iter().all(|point| point.abs() == dvec3(0.5, 1.0, 1.5)), "{points:?}");
    let simulation = Simulation::from_loaded(&loaded)?;
    // 1 m × 2 m × 3 m at 3 kg/m³; round-off of a sum over six faces.
    assert!((simulation.body("rock")?.mass() - 18.0).abs() < 1e-13);
    Ok(())
}

#[test]
fn ground_of_a_file_joins_corners_at_the_same_place_in_every_format() -> Fallible {
    let obj = "v 0 0 0\nv 0 0 4\nv 4 0.5 4\nv 4 0.5 0\ng one\nf 1 2 3\ng two\nf 1 3 4\n";
    for (name, bytes) in [
        ("ground.obj", obj.as_bytes().to_vec()),
        ("ground.stl", ascii_stl(&SQUARE)),
        ("binary.STL", binary_stl(&SQUARE)),
    ] {
        let folder = folder_with(name, bytes)?;
        let loaded = load(&folder, &format!(r#"MeshFile(file: "{name}", thickness: 1)"#), "Static")?;
        let SpatialPart::Mesh(MeshPart { points, triangles, thickness: 1.0, .. }) = &loaded.scene.bodies[0].parts[0]
        else {
            panic!("{:?}", loaded.scene.bodies[0].parts);
        };
        let corners = [DVec3::ZERO, dvec3(0.0, 0.0, 4.0), dvec3(4.0, 0.5, 4.0), dvec3(4.0, 0.5, 0.0)];
        assert_eq!((&points[..], &triangles[..]), (&corners[..], &[(0, 1, 2), (0, 2, 3)][..]), "{name}");
    }
    Ok(())
}

#[test]
fn faces_of_a_file_are_flat_to_single_precision() -> Fallible {
    // A cube turned by an angle that no single-precision number has; its squares are not flat to 1e-9.
    let turned = glam::DQuat::from_xyzw(0.1, 0.2, 0.3, 0.9).normalize();
    let mut text = String::new();
    for corner in 0..8 {
        let sign = |bit: u32| if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let point = (turned * dvec3(sign(0), sign(1), sign(2))).as_vec3();
        writeln!(text, "v {} {} {}", point.x, point.y, point.z)?;
    }
    text += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    let folder = folder_with("cube.obj", text)?;
    let surface = Surface::read(&folder.path().join("cube.obj"), 1.0)?;
    let faces = |tolerance| ConvexHull::try_with_tolerance(&surface.points, tolerance).map(|hull| hull.faces().len());
    assert_eq!((faces(1e-6)?, faces(1e-9)?), (6, 12));

    // The scene keeps them flat, and so does what is written of it.
    let loaded = load(&folder, r#"HullFile(file: "cube.obj", density: 1)"#, "Dynamic")?;
    let mut simulation = Simulation::from_loaded(&loaded)?;
    let written = simulation.to_scene()?;
    let again = Loaded::<Spatial>::parse(&written.to_ron(), "again.ron")?;
    assert_eq!(again.scene.bodies[0].parts, loaded.scene.bodies[0].parts);
    let mut again = Simulation::from_loaded(&again)?;
    for _ in 0..10 {
        simulation.step()?;
        again.step()?;
    }
    assert_eq!(simulation.body("rock")?.position(), again.body("rock")?.position());
    Ok(())
}

#[test]
fn ground_comes_back_from_a_simulation_as_points_and_triangles() -> Fallible {
    let field = "HeightField(spacing: (1, 1), heights: [[0, 0.2, 0], [0, 0.5, 0.1]], thickness: 2)";
    let field = Loaded::<Spatial>::parse(&scene_with(field, "Static"), "scene.ron")?;
    let mut simulation = Simulation::from_loaded(&field)?;
    let written = simulation.to_scene()?;
    let SpatialPart::Mesh(mesh) = &written.bodies[0].parts[..][0] else { panic!("{written:?}") };
    assert_eq!((mesh.points.len(), mesh.triangles.len(), mesh.thickness), (6, 4, 2.0));
    let mut again = Simulation::from_scene(&written)?;
    assert_eq!(again.to_scene()?.bodies, written.bodies);

    // Two grounds that touch nowhere are one list of triangles; two that share a place are not what they were.
    let mut simulation = Simulation::<Spatial>::with_settings(Settings::weightless());
    let square = [DVec3::ZERO, DVec3::Z, dvec3(1.0, 0.0, 1.0)];
    let body = simulation.spawn((Position(DVec3::ZERO), BodyKind::Static));
    for offset in [DVec3::ZERO, dvec3(5.0, 0.0, 0.0)] {
        let mesh = TriangleMesh::try_new(square.map(|corner| corner + offset), [[0, 1, 2]], 1.0)?;
        for facet in mesh.facets() {
            simulation.attach(body, Part::new(facet, Amount::Density(1.0)));
        }
    }
    assert_eq!(simulation.to_scene()?.bodies[0].parts.len(), 1);
    let across = [dvec3(1.0, 0.0, 1.0), dvec3(1.0, 0.5, 0.0), DVec3::ZERO];
    for facet in TriangleMesh::try_new(across, [[0, 1, 2]], 1.0)?.facets() {
        simulation.attach(body, Part::new(facet, Amount::Density(1.0)));
    }
    let refused = simulation.to_scene().expect_err("they share a side that was open").to_string();
    assert!(refused.contains("grounds of triangles that meet"), "{refused}");
    Ok(())
}

#[test]
fn a_file_that_gives_no_shape_is_named_with_its_place_and_reason() -> Fallible {
    let flat = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
    let thin = "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n";
    let cases: [(&str, &[u8], &str, &str); 9] = [
        ("flat.obj", flat.as_bytes(), "HullFile", "a convex hull needs at least four points, but has 3"),
        ("thin.obj", thin.as_bytes(), "MeshFile", "the corners of triangle 0 lie on one line"),
        ("empty.obj", b"", "HullFile", "it has no triangle"),
        ("nan.obj", b"v 0 0 0\nv NaN 0 0\nv 0 1 0\nf 1 2 3\n", "HullFile", "corner 1 of triangle 0 is not finite"),
        ("range.obj", b"v 0 0 0\nv 1 0 0\nf 1 2 3\n", "HullFile", "no sound OBJ file: face vertex index out of bounds"),
        ("words.obj", b"v one two three\n", "HullFile", "no sound OBJ file: position parse error"),
        ("empty.stl", b"", "MeshFile", "no sound STL file"),
        ("short.stl", &binary_stl(&SQUARE)[..150], "MeshFile", "no sound STL file"),
        ("rock.ply", b"ply", "HullFile", "its name must end in .obj or .stl"),
    ];
    for (name, bytes, part, reason) in cases {
        let folder = folder_with(name, bytes)?;
        let (fields, kind) = if part == "MeshFile" { (", thickness: 1", "Static") } else { ("", "Dynamic") };
        let message = load(&folder, &format!(r#"{part}(file: "{name}"{fields})"#), kind).expect_err(name);
        assert!(message.contains(&format!("the file \"{name}\" gives no shape: ")), "{message}");
        assert!(message.contains(reason), "{message}");
        assert!(message.contains("scene.ron:3:"), "{message}");
        assert_eq!(message.matches("error:").count(), 1, "{message}");
    }
    Ok(())
}

#[test]
fn a_missing_file_is_told_as_it_stands_in_the_scene() -> Fallible {
    let folder = tempfile::tempdir()?;
    let message = load(&folder, r#"HullFile(file: "no.obj")"#, "Dynamic").expect_err("there is no file");
    insta::assert_snapshot!(message, @r#"
    error: the file "no.obj" gives no shape: it cannot be read: No such file or directory (os error 2)
     --> scene.ron:3:24
      |
    3 |         HullFile(file: "no.obj"),
      |                        ^^^^^^^^ named here
    "#);
    let message = load(&folder, r#"HullFile(file: "no.obj", scale: -1)"#, "Dynamic").expect_err("a wrong scale");
    assert!(message.contains("a scale must be positive, and this one is -1"), "{message}");
    Ok(())
}

#[test]
fn scenes_built_in_code_read_their_files_themselves() -> Fallible {
    let folder = folder_with("box.obj", BOX)?;
    let surface = Surface::read(&folder.path().join("box.obj"), 1.0)?;
    assert_eq!((surface.points.len(), surface.triangles.len()), (8, 12));
    // Round-off of a sum over six faces of about 50 m³ each.
    assert!((ConvexHull::try_new(&surface.points)?.volume() - 48.0).abs() < 1e-12);
    assert_eq!(Surface::read(&folder.path().join("box"), 1.0), Err(SurfaceError::UnknownFormat));

    let mut scene = load(&folder, r#"HullFile(file: "box.obj")"#, "Dynamic")?.scene;
    scene.bodies[0].parts = vec![SpatialPart::HullFile(tumble_scene::format::HullFilePart {
        file: "box.obj".to_owned(),
        ..Default::default()
    })];
    let refused = Simulation::from_scene(&scene).expect_err("nobody read the file").to_string();
    assert!(refused.contains("it is read when a scene is loaded"), "{refused}");
    Ok(())
}
