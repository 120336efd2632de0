//! Light, shadow and sky.

use glam::{DVec2, DVec3};
use tumble_math::{Pose, Rotation, Spatial};

use super::Picture;
use super::camera::Camera;
use super::raster::{cut_near, fill};
use crate::fittings::Fitting;
use crate::mesh::{Look, Mesh};
use crate::stage::{Stage, StageBody, room};

/// Samples per pixel along each axis.
const SAMPLES: usize = 2;
/// Points of the shadow map along each axis.
const SHADOW_POINTS: usize = 1200;
/// Colour of the sky at the horizon and at the top (sRGB).
const SKY: [DVec3; 2] = [DVec3::new(0.93, 0.95, 0.97), DVec3::new(0.66, 0.77, 0.90)];

/// A picture in the making.
pub struct Painter<'a> {
    stage: &'a Stage,
    camera: &'a Camera,
    width: usize,
    height: usize,
    solids: Vec<Solid<'a>>,
    sun: Sun,
}

/// A mesh in its place.
struct Solid<'a> {
    mesh: &'a Mesh,
    pose: Pose<Spatial>,
    color: DVec3,
    veil: Veil,
}

/// What a solid leaves to be seen of what is behind it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Veil {
    /// A body: nothing.
    Opaque,
    /// A sensor: most.
    Air,
    /// A fitting: nothing, and it shines faintly through what hides it.
    Shining,
}

/// Share of a sensor in a colour [1].
const AIR: f64 = 0.25;
/// Share of a hidden fitting in a colour [1].
const SHINING: f64 = 0.3;

/// Where the light comes from, and how far it gets.
struct Sun {
    /// Unit vectors across the light, and towards the sun.
    axes: [DVec3; 3],
    middle: DVec3,
    /// Half of the length of the shadow map [m].
    half: f64,
    /// Height towards the sun of what is lit first, for each point of the map [m].
    lit: Vec<f64>,
}

impl<'a> Painter<'a> {
    /// An empty picture.
    pub fn new(stage: &'a Stage, camera: &'a Camera, width: usize, height: usize) -> Self {
        let up = stage.up;
        let level = camera.axes[0];
        let backward = level.cross(up);
        let sun = Sun::new(up - level * 0.55 + backward * 0.4, stage.span);
        Self { stage, camera, width: width * SAMPLES, height: height * SAMPLES, solids: Vec::new(), sun }
    }

    /// Adds a body.
    pub fn place(&mut self, body: &StageBody, pose: &Pose<Spatial>) {
        for part in &body.parts {
            let mesh = &self.stage.meshes[part.mesh];
            let veil = if part.sensor { Veil::Air } else { Veil::Opaque };
            self.solids.push(Solid { mesh, pose: *pose, color: shares(body.color), veil });
        }
    }

    /// Adds what is no body.
    pub fn add_fitting(&mut self, fitting: &'a Fitting) {
        let (mesh, color) = (&fitting.mesh, shares(fitting.color));
        self.solids.push(Solid { mesh, pose: Pose::default(), color, veil: Veil::Shining });
    }

    /// Draws what was added.
    pub fn picture(mut self) -> Picture {
        for solid in self.solids.iter().filter(|solid| solid.veil == Veil::Opaque && solid.mesh.look == Look::Solid) {
            self.sun.shine_on(solid);
        }
        let rows = (0..self.height).map(|row| self.sky(row * self.width));
        let mut colors: Vec<DVec3> = rows.flat_map(|sky| std::iter::repeat_n(sky, self.width)).collect();
        let mut depths = vec![0.0; colors.len()];
        // Bodies first, so that it is known what they hide; sensors last, over all of it.
        for veil in [Veil::Opaque, Veil::Shining, Veil::Air] {
            for solid in self.solids.iter().filter(|solid| solid.veil == veil) {
                self.draw(solid, &mut colors, &mut depths);
            }
        }
        self.reduced(&colors)
    }

    fn draw(&self, solid: &Solid<'_>, colors: &mut [DVec3], depths: &mut [f64]) {
        let world: Vec<DVec3> = solid.mesh.positions.iter().map(|point| solid.pose.transform_point(*point)).collect();
        let normals: Vec<DVec3> = solid.mesh.normals.iter().map(|normal| solid.pose.rotation.rotate(*normal)).collect();
        for triangle in &solid.mesh.triangles {
            let corners = triangle.map(|corner| {
                let corner = corner as usize;
                (self.camera.view(world[corner]), normals[corner], solid.mesh.shades[corner])
            });
            let cut = cut_near(&corners, self.camera.near);
            for last in 2..cut.len() {
                let piece = [cut[0], cut[last - 1], cut[last]];
                let screen = piece.map(|(seen, ..)| self.on_screen(seen));
                fill(&screen, self.width, self.height, |fragment| {
                    let depth = &mut depths[fragment.pixel];
                    let is_hidden = fragment.depth <= depth.abs();
                    // A negative depth marks what already shines through here: once is enough.
                    if is_hidden && (solid.veil != Veil::Shining || depth.is_sign_negative()) {
                        return;
                    }
                    let blend = |of: fn(&(DVec3, DVec3, f64)) -> DVec3| {
                        let [a, b, c] = fragment.weights;
                        of(&piece[0]) * a + of(&piece[1]) * b + of(&piece[2]) * c
                    };
                    let (seen, normal) = (blend(|corner| corner.0), blend(|corner| corner.1));
                    let shade = blend(|corner| DVec3::splat(corner.2)).x;
                    let color = self.lit(solid, seen, normal, shade, self.sky(fragment.pixel));
                    let behind = &mut colors[fragment.pixel];
                    match solid.veil {
                        Veil::Air => *behind = behind.lerp(color, AIR),
                        Veil::Shining if is_hidden => {
                            *behind = behind.lerp(solid.color, SHINING);
                            *depth = -*depth;
                        }
                        Veil::Opaque | Veil::Shining => {
                            *depth = fragment.depth;
                            *behind = color;
                        }
                    }
                });
            }
        }
    }

    /// Colour of a point of a surface.
    fn lit(&self, solid: &Solid<'_>, seen: DVec3, normal: DVec3, shade: f64, sky: DVec3) -> DVec3 {
        let [right, up, forward] = self.camera.axes;
        let world = self.camera.eye + right * seen.x + up * seen.y + forward * seen.z;
        let towards = (self.camera.eye - world).normalize_or(-forward);
        let normal = normal.normalize_or(self.stage.up);
        // A surface is seen from outside, or it is a triangle without an inside.
        let normal = if normal.dot(towards) < 0.0 { -normal } else { normal };
        let sun = self.sun.axes[2];
        let open = if normal.dot(sun) > 0.0 { self.sun.share(world + normal * (2.0 * self.sun.texel())) } else { 0.0 };
        let direct = normal.dot(sun).max(0.0) * open;
        let around = 0.5 + 0.5 * normal.dot(self.stage.up);
        let mut color = solid.color * shade;
        let mut fog = 0.0;
        if solid.mesh.look == Look::Ground {
            let [low, high] = self.stage.span;
            let size = (high - low).length();
            let far = (world - 0.5 * (low + high)).length() / size;
            fog = ((far - 1.0) / 4.0).clamp(0.0, 1.0);
            color *= self.tile(world, normal, size / 10.0);
        }
        let gloss = if solid.mesh.look == Look::Solid {
            let half = (towards + sun).normalize_or(sun);
            let s = normal.dot(half).max(0.0);
            let s2 = s * s;
            let s8 = s2 * s2 * s2 * s2;
            0.12 * s8 * s8 * s8 * open
        } else {
            0.0
        };
        // Light adds up in linear space, of which the square of sRGB is near enough for the eye.
        let linear = color * color * (0.26 + 0.22 * around + 0.72 * direct) + DVec3::splat(gloss);
        DVec3::from_array(linear.to_array().map(f64::sqrt)).lerp(sky, fog)
    }

    /// A faint board on the ground, to tell distances by.
    fn tile(&self, world: DVec3, normal: DVec3, length: f64) -> f64 {
        let [right, _, towards] = room(normal);
        let odd = |axis: DVec3| (axis.dot(world) / length).floor().rem_euclid(2.0) == 1.0;
        if odd(right) == odd(towards) { 1.0 } else { 0.965 }
    }

    fn on_screen(&self, seen: DVec3) -> DVec3 {
        let scale = 0.5 * self.height as f64 / self.camera.slope;
        let middle = DVec2::new(0.5 * self.width as f64, 0.5 * self.height as f64);
        let place = middle + DVec2::new(seen.x, -seen.y) * (scale / seen.z);
        place.extend(1.0 / seen.z)
    }

    /// Colour of the sky behind a pixel.
    fn sky(&self, pixel: usize) -> DVec3 {
        let row = (pixel / self.width) as f64 / self.height as f64;
        SKY[1].lerp(SKY[0], (row * 1.4).min(1.0))
    }

    /// The mean of the samples of each pixel.
    fn reduced(&self, colors: &[DVec3]) -> Picture {
        let (width, height) = (self.width / SAMPLES, self.height / SAMPLES);
        let mut pixels = Vec::with_capacity(3 * width * height);
        for row in 0..height {
            for column in 0..width {
                let mut sum = DVec3::ZERO;
                for sample in 0..SAMPLES * SAMPLES {
                    let (down, along) = (row * SAMPLES + sample / SAMPLES, column * SAMPLES + sample % SAMPLES);
                    sum += colors[down * self.width + along];
                }
                let mean = sum / (SAMPLES * SAMPLES) as f64;
                pixels.extend(mean.to_array().map(|part| (part.clamp(0.0, 1.0) * 255.0).round() as u8));
            }
        }
        Picture { width, height, pixels }
    }
}

/// A colour as shares of white (sRGB).
fn shares(color: [u8; 3]) -> DVec3 {
    DVec3::from_array(color.map(|part| f64::from(part) / 255.0))
}

impl Sun {
    fn new(towards: DVec3, [low, high]: [DVec3; 2]) -> Self {
        let [right, towards, other] = room(towards.normalize());
        let half = 0.75 * (high - low).length();
        let lit = vec![f64::NEG_INFINITY; SHADOW_POINTS * SHADOW_POINTS];
        Self { axes: [right, other, towards], middle: 0.5 * (low + high), half, lit }
    }

    /// Length of a point of the map [m].
    fn texel(&self) -> f64 {
        2.0 * self.half / SHADOW_POINTS as f64
    }

    /// Place on the map, in points, and height towards the sun [m].
    fn on_map(&self, world: DVec3) -> DVec3 {
        let [x, y, height] = self.axes.map(|axis| axis.dot(world - self.middle));
        let point = |along: f64| (along + self.half) / self.texel();
        DVec3::new(point(x), point(y), height)
    }

    fn shine_on(&mut self, solid: &Solid<'_>) {
        let seen: Vec<DVec3> =
            solid.mesh.positions.iter().map(|point| self.on_map(solid.pose.transform_point(*point))).collect();
        let lit = &mut self.lit;
        for triangle in &solid.mesh.triangles {
            let corners = triangle.map(|corner| seen[corner as usize]);
            // Light is parallel: heights are linear over the map, and no perspective is to be corrected.
            let flat = corners.map(|corner| corner.truncate().extend(1.0));
            fill(&flat, SHADOW_POINTS, SHADOW_POINTS, |fragment| {
                let [a, b, c] = fragment.weights;
                let height = a * corners[0].z + b * corners[1].z + c * corners[2].z;
                lit[fragment.pixel] = lit[fragment.pixel].max(height);
            });
        }
    }

    /// Share of the sun that a point sees: the mean over five by five points of the map, so that edges are soft [1].
    fn share(&self, world: DVec3) -> f64 {
        let place = self.on_map(world);
        let inside = 2.0..SHADOW_POINTS as f64 - 2.0;
        if !inside.contains(&place.x) || !inside.contains(&place.y) {
            return 1.0;
        }
        let (column, row) = (place.x as usize - 2, place.y as usize - 2);
        let height = place.z + 1.5 * self.texel();
        let rows = (row..row + 5).map(|row| &self.lit[row * SHADOW_POINTS + column..][..5]);
        let dark = rows.flatten().filter(|lit| **lit > height).count();
        1.0 - dark as f64 / 25.0
    }
}
