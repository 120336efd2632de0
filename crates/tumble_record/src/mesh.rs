//! Surfaces of shapes as triangles, for every picture in space: replay, glTF, frames.

mod lines;
mod planar;
mod spatial;

use glam::DVec3;
use tumble_math::trig;

/// A surface of triangles in the body frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Places of the corners [m].
    pub positions: Vec<DVec3>,
    /// Unit vectors out of the solid, one per corner.
    pub normals: Vec<DVec3>,
    /// Brightness of each corner; round shapes have darker fields, so that one sees them roll [1].
    pub shades: Vec<f64>,
    /// Corners of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// What it is drawn as.
    pub look: Look,
}

/// What a mesh is drawn as.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Look {
    /// A body.
    #[default]
    Solid,
    /// A stretch of something without end: a floor, a wall.
    Ground,
}

/// How shapes become meshes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Detail {
    /// Radius at which thin rods are drawn [m].
    pub thin: f64,
    /// Half of the length of what has no end [m].
    pub ground: f64,
    /// Middle of what has no end, in the body frame [m].
    pub middle: DVec3,
    /// Half the thickness of shapes of the plane [m].
    pub half_thickness: f64,
}

/// Pieces around a round shape.
const SECTORS: usize = 32;
/// Brightness of the darker fields [1].
const DARKER: f64 = 0.8;

/// Darker fields around a round shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Fields {
    /// None, and fewer pieces: for small things.
    None,
    /// Two, from end to end.
    Stripes,
    /// Two, which change places half way.
    Board,
}

/// A ring of a surface of revolution.
#[derive(Clone, Copy, Debug)]
struct Ring {
    /// Place along the axis [m].
    along: f64,
    /// Distance from the axis [m].
    radius: f64,
    /// Normal: along the axis, and away from it.
    normal: (f64, f64),
}

impl Mesh {
    /// Adds a flat polygon without inward corners, counter-clockwise about its normal.
    fn add_polygon(&mut self, points: &[DVec3], normal: DVec3) {
        let first = self.positions.len() as u32;
        self.positions.extend(points);
        self.normals.extend(points.iter().map(|_| normal));
        self.shades.extend(points.iter().map(|_| 1.0));
        self.triangles.extend((2..points.len() as u32).map(|i| [first, first + i - 1, first + i]));
    }

    /// Adds a strip of quadrilaterals between rings about an axis; rings go up along it.
    fn add_revolution(&mut self, from: DVec3, axis: DVec3, rings: &[Ring], fields: Fields) {
        let sectors = if fields == Fields::None { SECTORS / 4 } else { SECTORS };
        let side = axis.any_orthonormal_vector();
        let other = axis.cross(side);
        let around = |sector: usize| {
            let (sin, cos) = trig::sin_cos(std::f64::consts::TAU * (sector % sectors) as f64 / sectors as f64);
            side * cos + other * sin
        };
        for (level, pair) in rings.windows(2).enumerate() {
            for sector in 0..sectors {
                let field = match fields {
                    Fields::None => 0,
                    Fields::Stripes => sector * 4 / sectors,
                    Fields::Board => sector * 4 / sectors + usize::from(2 * level + 2 > rings.len()),
                };
                let first = self.positions.len() as u32;
                for (ring, sector) in
                    [(pair[0], sector), (pair[0], sector + 1), (pair[1], sector + 1), (pair[1], sector)]
                {
                    let out = around(sector);
                    self.positions.push(from + axis * ring.along + out * ring.radius);
                    self.normals.push(axis * ring.normal.0 + out * ring.normal.1);
                    self.shades.push(if field.is_multiple_of(2) { 1.0 } else { DARKER });
                }
                self.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
            }
        }
    }

    /// Adds a cylinder with flat ends.
    fn add_cylinder(&mut self, from: DVec3, axis: DVec3, length: f64, radius: f64) {
        let ring = |along, radius, normal| Ring { along, radius, normal };
        let down = [ring(0.0, 0.0, (-1.0, 0.0)), ring(0.0, radius, (-1.0, 0.0))];
        let side = [ring(0.0, radius, (0.0, 1.0)), ring(length, radius, (0.0, 1.0))];
        let up = [ring(length, radius, (1.0, 0.0)), ring(length, 0.0, (1.0, 0.0))];
        for rings in [down, side, up] {
            self.add_revolution(from, axis, &rings, Fields::Stripes);
        }
    }

    /// Largest distance of a corner from the origin of the body frame [m].
    pub fn reach(&self) -> f64 {
        self.positions.iter().map(|point| point.length()).fold(0.0, f64::max)
    }
}

/// Rings of a half circle or of a part of it, from one angle to another; 0 is the equator, a quarter turn the top.
fn arc(centre: f64, radius: f64, from: f64, to: f64, steps: usize) -> impl Iterator<Item = Ring> {
    (0..=steps).map(move |step| {
        let (sin, cos) = trig::sin_cos(from + (to - from) * step as f64 / steps as f64);
        // The poles lie on the axis, without the round-off of a cosine.
        let cos = if cos.abs() < 1e-12 { 0.0 } else { cos };
        Ring { along: centre + radius * sin, radius: radius * cos, normal: (sin, cos) }
    })
}
