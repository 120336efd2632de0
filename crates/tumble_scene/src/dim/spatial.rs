//! Scenes of space.

use std::path::Path;

use glam::{DQuat, DVec3};
use tumble_math::{Bounds, Pose, Rotation, Spatial, SpatialRotation, SymmetricTensor};
use tumble_record::RecordDim;
use tumble_shape::{
    Capsule, Cone, ConvexHull, Cuboid, Cylinder, HalfSpace, MassProperties, SpatialRod, SpatialShape,
    SpatialShapeError, Sphere, TriangleMesh,
};

use super::{AngularClaim, PartError, PartFields, SceneDim};
use crate::engine::SceneEngine;
use crate::exact::{quaternion_before_normalization, spatial_before_normalization};
use crate::expect::Measured;
use crate::format::{
    BodyEntry, CapsulePart, ConePart, CylinderPart, HalfSpacePart, HeightFieldPart, HullFilePart, HullPart,
    InertiaEntry, Keyframe, MeshFilePart, MeshPart, OrientationEntry, SpatialBoxPart, SpatialJointKind, SpatialPart,
    SpatialRodPart, SpherePart, VectorExpectation,
};
use crate::surface::Surface;

impl SceneDim for Spatial {
    fn scene_engine() -> &'static SceneEngine<Self> {
        static SPATIAL: SceneEngine<Spatial> = SceneEngine::new();
        &SPATIAL
    }

    fn shapes(part: &SpatialPart) -> Result<Vec<SpatialShape>, PartError> {
        let shape: SpatialShape = match part {
            SpatialPart::Sphere(part) => Sphere::try_new(part.at, part.radius)?.into(),
            SpatialPart::Box(part) => {
                let rotation = rotation_of(part.orientation.as_ref()).ok_or(PartError::Orientation)?;
                Cuboid::try_new(part.at, part.size * 0.5, rotation)?.into()
            }
            SpatialPart::Capsule(part) => Capsule::try_new(part.from, part.to, part.radius)?.into(),
            SpatialPart::Rod(part) => SpatialRod::try_new(part.from, part.to, part.radius)?.into(),
            SpatialPart::Cylinder(part) => Cylinder::try_new(part.from, part.to, part.radius)?.into(),
            SpatialPart::Cone(part) => Cone::try_new(part.base, part.tip, part.radius)?.into(),
            SpatialPart::Hull(part) => hull(part)?.into(),
            SpatialPart::HullFile(HullFilePart { file, .. }) | SpatialPart::MeshFile(MeshFilePart { file, .. }) => {
                return Err(unread(file, "it is read when a scene is loaded"));
            }
            SpatialPart::HalfSpace(part) => HalfSpace::try_new(part.normal, part.offset)?.into(),
            SpatialPart::Mesh(part) => {
                let triangles: Vec<[u32; 3]> = part.triangles.iter().map(|&(a, b, c)| [a, b, c]).collect();
                return Ok(pieces(&TriangleMesh::try_new(part.points.clone(), triangles, part.thickness)?));
            }
            SpatialPart::HeightField(part) => return Ok(pieces(&height_field(part)?)),
            SpatialPart::List(_) => return Ok(Vec::new()),
        };
        Ok(vec![shape])
    }

    fn read_file(part: &mut SpatialPart, folder: Option<&Path>) -> Result<(), PartError> {
        let read = match part {
            SpatialPart::HullFile(part) => SpatialPart::Hull(hull_of_file(part, folder)?),
            SpatialPart::MeshFile(part) => SpatialPart::Mesh(mesh_of_file(part, folder)?),
            _ => return Ok(()),
        };
        *part = read;
        Ok(())
    }

    fn are_pieces(one: &SpatialShape, other: &SpatialShape) -> bool {
        matches!((one, other), (SpatialShape::Facet(one), SpatialShape::Facet(other)) if one.thickness() == other.thickness())
    }

    fn part(shapes: &[&SpatialShape], fields: PartFields) -> Option<SpatialPart> {
        let (density, mass) = fields.density_and_mass();
        let PartFields { material, sensor, groups, collides_with, .. } = fields;
        Some(match shapes.first()? {
            SpatialShape::Sphere(sphere) => {
                let (at, radius) = (sphere.centre(), sphere.radius());
                SpatialPart::Sphere(SpherePart { at, radius, density, mass, material, sensor, groups, collides_with })
            }
            SpatialShape::SpatialRod(rod) => {
                let ([from, to], radius) = (*rod.ends(), rod.radius());
                let part = SpatialRodPart { from, to, radius, density, mass, material, sensor, groups, collides_with };
                SpatialPart::Rod(part)
            }
            SpatialShape::Capsule(capsule) => {
                let ([from, to], radius) = (*capsule.ends(), capsule.radius());
                let part = CapsulePart { from, to, radius, density, mass, material, sensor, groups, collides_with };
                SpatialPart::Capsule(part)
            }
            SpatialShape::Cuboid(cuboid) => {
                let (at, size) = (cuboid.centre(), cuboid.half_extents() * 2.0);
                let rotation = DQuat::from_mat3(cuboid.axes());
                let is_turned = *cuboid.axes() != glam::DMat3::IDENTITY;
                let rotation = SpatialRotation::try_from_quaternion(rotation).filter(|_| is_turned);
                let orientation = rotation.as_ref().map(written);
                let part =
                    SpatialBoxPart { size, at, orientation, density, mass, material, sensor, groups, collides_with };
                SpatialPart::Box(part)
            }
            SpatialShape::ConvexHull(hull) => {
                let points = hull.vertices().to_vec();
                let flat_within = Some(hull.relative_tolerance()).filter(|tolerance| *tolerance != FLAT_WITHIN);
                let part = HullPart { points, flat_within, density, mass, material, sensor, groups, collides_with };
                SpatialPart::Hull(part)
            }
            SpatialShape::Cylinder(cylinder) => {
                let ([from, to], radius) = (*cylinder.ends(), cylinder.radius());
                let part = CylinderPart { from, to, radius, density, mass, material, sensor, groups, collides_with };
                SpatialPart::Cylinder(part)
            }
            SpatialShape::Cone(cone) => {
                let (base, tip, radius) = (cone.base(), cone.tip(), cone.radius());
                let part = ConePart { base, tip, radius, density, mass, material, sensor, groups, collides_with };
                SpatialPart::Cone(part)
            }
            SpatialShape::HalfSpace(plane) => {
                let (normal, offset) = (spatial_before_normalization(plane.normal()), plane.offset());
                SpatialPart::HalfSpace(HalfSpacePart { normal, offset, material, sensor, groups, collides_with })
            }
            SpatialShape::Facet(first) => {
                let facets = shapes.iter().filter_map(|shape| match shape {
                    SpatialShape::Facet(facet) => Some(facet),
                    _ => None,
                });
                let mesh = TriangleMesh::from_facets(&facets.collect::<Vec<_>>())?;
                let (points, thickness) = (mesh.vertices().to_vec(), first.thickness());
                let triangles = mesh.triangles().iter().map(|&[a, b, c]| (a, b, c)).collect();
                let part = MeshPart { points, triangles, thickness, material, sensor, groups, collides_with };
                SpatialPart::Mesh(part)
            }
        })
    }

    fn bounds(shape: &SpatialShape) -> Option<Bounds<DVec3>> {
        shape.bounds(&Pose::<Self>::default())
    }

    fn inertia(entry: &InertiaEntry) -> SymmetricTensor {
        (*entry).into()
    }

    fn inertia_mistake(entry: &InertiaEntry) -> Option<(String, String)> {
        // Any mass will do to look at the moments.
        let mistake = MassProperties::try_given(1.0, DVec3::ZERO, (*entry).into()).err()?;
        Some(("is that of no body".to_owned(), mistake.to_string()))
    }

    fn inertia_entry(inertia: SymmetricTensor) -> InertiaEntry {
        inertia.into()
    }

    fn mass_mistake(of: &MassProperties<Self>) -> Option<String> {
        MassProperties::try_given(of.mass, of.centre, of.inertia).err().map(|error| error.to_string())
    }

    fn design_rotation(body: &BodyEntry<Self>) -> SpatialRotation {
        rotation_of(body.orientation.as_ref()).unwrap_or_default()
    }

    fn rotation_mistake(body: &BodyEntry<Self>) -> Option<(&'static str, &'static str)> {
        let is_wrong = rotation_of(body.orientation.as_ref()).is_none();
        is_wrong.then_some(("orientation", "an axis or the quaternion is zero"))
    }

    fn write_rotation(body: &mut BodyEntry<Self>, rotation: SpatialRotation) {
        body.orientation = entry_of(&rotation);
    }

    fn random_turn(most_degrees: f64, mut draw: impl FnMut() -> f64) -> DVec3 {
        let (x, y, z) = (draw(), draw(), draw());
        DVec3::new(x, y, z) * most_degrees
    }

    fn displace(body: &mut BodyEntry<Self>, offset: DVec3, degrees: DVec3) {
        body.at += offset;
        body.keyframes.iter_mut().for_each(|frame| frame.at += offset);
        if degrees != DVec3::ZERO {
            let turn = DVec3::new(degrees.x.to_radians(), degrees.y.to_radians(), degrees.z.to_radians());
            let rotation = Self::design_rotation(body).turned(turn);
            Self::write_rotation(body, rotation);
            for frame in &mut body.keyframes {
                let rotation = Self::keyframe_rotation(frame).unwrap_or_default().turned(turn);
                Self::write_keyframe_rotation(frame, rotation);
            }
        }
    }

    fn keyframe_rotation(frame: &Keyframe<Self>) -> Option<SpatialRotation> {
        rotation_of(frame.orientation.as_ref())
    }

    fn write_keyframe_rotation(frame: &mut Keyframe<Self>, rotation: SpatialRotation) {
        frame.orientation = entry_of(&rotation);
    }

    fn joint(kind: &SpatialJointKind, [a, b]: [DVec3; 2]) -> tumble_sim::SpatialJointKind {
        match *kind {
            SpatialJointKind::Spherical => tumble_sim::SpatialJointKind::Spherical,
            SpatialJointKind::Revolute { axis } => tumble_sim::SpatialJointKind::Revolute { axis },
            SpatialJointKind::Distance { length } => {
                tumble_sim::SpatialJointKind::Distance { length: length.unwrap_or_else(|| a.distance(b)) }
            }
            SpatialJointKind::Fixed => tumble_sim::SpatialJointKind::Fixed,
            SpatialJointKind::Prismatic { axis } => tumble_sim::SpatialJointKind::Prismatic { axis },
        }
    }

    fn joint_entry(kind: &tumble_sim::SpatialJointKind) -> SpatialJointKind {
        match *kind {
            tumble_sim::SpatialJointKind::Spherical => SpatialJointKind::Spherical,
            tumble_sim::SpatialJointKind::Revolute { axis } => SpatialJointKind::Revolute { axis },
            tumble_sim::SpatialJointKind::Distance { length } => SpatialJointKind::Distance { length: Some(length) },
            tumble_sim::SpatialJointKind::Fixed => SpatialJointKind::Fixed,
            tumble_sim::SpatialJointKind::Prismatic { axis } => SpatialJointKind::Prismatic { axis },
        }
    }

    fn angular_claim(claim: &VectorExpectation<Self>) -> AngularClaim<'_> {
        AngularClaim::Vector(claim)
    }

    fn measured(angular: DVec3) -> Measured {
        Measured::of_vector(angular)
    }

    fn shown_torque(torque: DVec3) -> f64 {
        torque.length()
    }

    fn in_space(rotation: &SpatialRotation) -> Option<SpatialRotation> {
        Some(*rotation)
    }

    fn orientation_between(from: &DQuat, to: &DQuat, share: f64) -> DQuat {
        let (from, to) = (Self::rotation(from), Self::rotation(to));
        from.turned(from.turn_to(&to).rotation_vector() * share).quaternion()
    }

    fn joint_gap(kind: &SpatialJointKind, between: DVec3, rotation_of_a: &SpatialRotation) -> f64 {
        match *kind {
            SpatialJointKind::Spherical | SpatialJointKind::Revolute { .. } | SpatialJointKind::Fixed => {
                between.length()
            }
            SpatialJointKind::Distance { length } => length.map_or(0.0, |length| (between.length() - length).abs()),
            SpatialJointKind::Prismatic { axis } => {
                rotation_of_a.rotate(axis).normalize_or_zero().cross(between).length()
            }
        }
    }

    fn joint_axis(kind: &SpatialJointKind) -> Option<DVec3> {
        match kind {
            SpatialJointKind::Revolute { axis } | SpatialJointKind::Prismatic { axis } => Some(*axis),
            _ => None,
        }
    }
}

/// The rotation of an entry; `None` for one that means nothing.
fn rotation_of(entry: Option<&OrientationEntry>) -> Option<SpatialRotation> {
    entry.map_or(Some(SpatialRotation::IDENTITY), OrientationEntry::rotation)
}

/// The entry of a rotation; none for one that does not turn.
fn entry_of(rotation: &SpatialRotation) -> Option<OrientationEntry> {
    (*rotation != SpatialRotation::IDENTITY).then(|| written(rotation))
}

/// The entry of a rotation, which becomes that rotation to the last bit where one can be found.
fn written(rotation: &SpatialRotation) -> OrientationEntry {
    let [x, y, z, w] = quaternion_before_normalization(rotation.quaternion()).to_array();
    OrientationEntry::Quaternion(x, y, z, w)
}

fn pieces(mesh: &TriangleMesh) -> Vec<SpatialShape> {
    mesh.facets().map(SpatialShape::from).collect()
}

/// Distance from a plane that counts as in it, for points that are written in a scene, as a share of a hull's longest extent [1].
const FLAT_WITHIN: f64 = 1e-9;
/// The same for points in a file, which are rounded to single precision [1].
const FLAT_WITHIN_IN_FILES: f64 = 1e-6;

fn hull(part: &HullPart) -> Result<ConvexHull, SpatialShapeError> {
    ConvexHull::try_with_tolerance(&part.points, part.flat_within.unwrap_or(FLAT_WITHIN))
}

fn unread(file: &str, problem: impl ToString) -> PartError {
    PartError::File { file: file.to_owned(), problem: problem.to_string() }
}

/// The surface in a file, relative to the folder of the scene.
fn surface(file: &str, scale: Option<f64>, folder: Option<&Path>) -> Result<Surface, PartError> {
    let folder = folder.ok_or_else(|| unread(file, "this scene is in no folder, so it reads no files"))?;
    let scale = scale.unwrap_or(1.0);
    if scale <= 0.0 {
        return Err(unread(file, format!("a scale must be positive, and this one is {scale}")));
    }
    Surface::read(&folder.join(file), scale).map_err(|error| unread(file, error))
}

/// The hull of a file's surface, with the corners that it has.
fn hull_of_file(part: &HullFilePart, folder: Option<&Path>) -> Result<HullPart, PartError> {
    let HullFilePart { file, scale, flat_within, density, mass, material, sensor, groups, collides_with } =
        part.clone();
    let points = surface(&file, scale, folder)?.points;
    let flat_within = Some(flat_within.unwrap_or(FLAT_WITHIN_IN_FILES));
    let mut read = HullPart { points, flat_within, density, mass, material, sensor, groups, collides_with };
    read.points = hull(&read).map_err(|error| unread(&file, error))?.vertices().to_vec();
    Ok(read)
}

/// The ground that a file's surface is.
fn mesh_of_file(part: &MeshFilePart, folder: Option<&Path>) -> Result<MeshPart, PartError> {
    let MeshFilePart { file, scale, thickness, material, sensor, groups, collides_with } = part.clone();
    let Surface { points, triangles } = surface(&file, scale, folder)?;
    TriangleMesh::try_new(points.clone(), triangles.clone(), thickness).map_err(|error| unread(&file, error))?;
    let triangles = triangles.into_iter().map(|[a, b, c]| (a, b, c)).collect();
    Ok(MeshPart { points, triangles, thickness, material, sensor, groups, collides_with })
}

/// The ground over a grid in the plane of x and z; its cells are cut along the diagonal from small x and z to large ones.
fn height_field(part: &HeightFieldPart) -> Result<TriangleMesh, PartError> {
    let columns = part.heights.first().map_or(0, Vec::len);
    let odd = part.heights.iter().enumerate().find(|(_, row)| row.len() != columns);
    if let Some((row, heights)) = odd {
        return Err(PartError::Rows { row, count: heights.len(), first: columns });
    }
    let (along_x, along_z) = part.spacing;
    let rows = part.heights.iter().enumerate();
    let points = rows.flat_map(|(row, heights)| {
        heights
            .iter()
            .enumerate()
            .map(move |(column, &height)| DVec3::new(column as f64 * along_x, height, row as f64 * along_z))
    });
    let points: Vec<DVec3> = points.collect();
    let corner = |row: usize, column: usize| (row * columns + column) as u32;
    let mut triangles = Vec::new();
    for row in 1..part.heights.len() {
        for column in 1..columns {
            let (near, far) = (corner(row - 1, column - 1), corner(row, column));
            // Counter-clockwise seen from above, where x points to the right and z towards the viewer.
            triangles.push([near, far, corner(row - 1, column)]);
            triangles.push([near, corner(row, column - 1), far]);
        }
    }
    Ok(TriangleMesh::try_new(points, triangles, part.thickness)?)
}
