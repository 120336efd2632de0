//! Surfaces of solids from files: OBJ and STL, as points and triangles.

use std::fs::File;
use std::io::{Cursor, Read};
use std::path::Path;

use glam::DVec3;
use thiserror::Error;
use tumble_shape::join_corners;

/// Bytes that a file may have.
const LARGEST_FILE: u64 = 256 << 20;

/// Points, and triangles over them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Corners, each place once, in the order in which triangles name them [m].
    pub points: Vec<DVec3>,
    /// Triangles, as numbers of corners counted from 0; counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// Why a file gives no surface.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SurfaceError {
    /// It cannot be opened or read.
    #[error("it cannot be read: {0}")]
    Unreadable(String),
    /// It is too large.
    #[error("it is larger than {} MiB", LARGEST_FILE >> 20)]
    TooLarge,
    /// Its name ends in neither `.obj` nor `.stl`.
    #[error("its name must end in .obj or .stl, which says how it is read")]
    UnknownFormat,
    /// It does not follow its format.
    #[error("it is no sound {format} file: {problem}")]
    Malformed {
        /// The format.
        format: &'static str,
        /// What is wrong.
        problem: String,
    },
    /// It has no triangle.
    #[error("it has no triangle")]
    Empty,
    /// A coordinate is infinite or NaN.
    #[error("corner {corner} of triangle {triangle} is not finite")]
    NotFinite {
        /// The triangle, counted from 0.
        triangle: usize,
        /// Its corner, counted from 0.
        corner: usize,
    },
}

impl Surface {
    /// Reads the surface in an OBJ or STL file, all of its objects as one.
    ///
    /// Coordinates are multiplied by `scale` [m per unit of the file]. Corners at the same place are one. Polygons of an OBJ file are cut into
    /// triangles; its materials and textures are not read.
    pub fn read(path: &Path, scale: f64) -> Result<Self, SurfaceError> {
        let extension = path.extension().map(|extension| extension.to_ascii_lowercase());
        let triangles = match extension.as_ref().and_then(|extension| extension.to_str()) {
            Some("obj") => obj_triangles(&bytes_of(path)?)?,
            Some("stl") => stl_triangles(&bytes_of(path)?)?,
            _ => return Err(SurfaceError::UnknownFormat),
        };
        if triangles.is_empty() {
            return Err(SurfaceError::Empty);
        }
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(corner) = corners.iter().position(|corner| !(*corner * scale).is_finite()) {
                return Err(SurfaceError::NotFinite { triangle, corner });
            }
        }
        let (points, triangles) = join_corners(triangles.iter().map(|corners| corners.map(|corner| corner * scale)));
        Ok(Self { points, triangles })
    }
}

fn bytes_of(path: &Path) -> Result<Vec<u8>, SurfaceError> {
    if path.is_dir() {
        return Err(SurfaceError::Unreadable("it is a folder".to_owned()));
    }
    let unreadable = |error: std::io::Error| SurfaceError::Unreadable(error.to_string());
    let mut bytes = Vec::new();
    File::open(path).map_err(unreadable)?.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > LARGEST_FILE { Err(SurfaceError::TooLarge) } else { Ok(bytes) }
}

fn obj_triangles(mut bytes: &[u8]) -> Result<Vec<[DVec3; 3]>, SurfaceError> {
    let options =
        tobj::LoadOptions { triangulate: true, ignore_points: true, ignore_lines: true, ..Default::default() };
    let no_materials = |_: &Path| Err(tobj::LoadError::OpenFileFailed);
    let (models, _) = tobj::load_obj_buf(&mut bytes, &options, no_materials)
        .map_err(|error| SurfaceError::Malformed { format: "OBJ", problem: error.to_string() })?;
    let mut triangles = Vec::new();
    for mesh in models.iter().map(|model| &model.mesh) {
        let (places, _) = mesh.positions.as_chunks::<3>();
        let (corners, _) = mesh.indices.as_chunks::<3>();
        triangles.extend(corners.iter().map(|corners| corners.map(|corner| DVec3::from(places[corner as usize]))));
    }
    Ok(triangles)
}

fn stl_triangles(bytes: &[u8]) -> Result<Vec<[DVec3; 3]>, SurfaceError> {
    let malformed = |error: std::io::Error| SurfaceError::Malformed { format: "STL", problem: error.to_string() };
    let mut reader = Cursor::new(bytes);
    let mut triangles = Vec::new();
    for triangle in stl_io::create_stl_reader(&mut reader).map_err(malformed)? {
        let corners = triangle.map_err(malformed)?.vertices;
        triangles.push(corners.map(|corner| DVec3::from(corner.0.map(f64::from))));
    }
    Ok(triangles)
}
