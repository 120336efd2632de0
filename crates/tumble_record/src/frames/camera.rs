//! Where a picture is seen from.

use glam::DVec3;
use tumble_math::{Vector, trig};

use crate::dim::RecordDim;
use crate::recording::{BodyKind, Recording};
use crate::stage::{Stage, room};

/// Half of the angle that the height of a picture spans [rad].
const HALF_ANGLE: f64 = 0.26;
/// Share of the picture that is left free at each side [1].
const MARGIN: f64 = 0.05;

/// A camera with perspective.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it stands [m].
    pub eye: DVec3,
    /// Unit vectors to the right, up, and into the picture.
    pub axes: [DVec3; 3],
    /// Tangent of half the angle of the picture's height [1].
    pub slope: f64,
    /// Nearest distance that is drawn [m].
    pub near: f64,
}

impl Camera {
    /// Looks at all that moves, at all times, from the right and from above; at a planar scene nearly from the front.
    pub fn looking_at<D: RecordDim>(recording: &Recording<D>, stage: &Stage, aspect: f64) -> Self {
        let [right, up, towards] = room(stage.up);
        let (azimuth, elevation) = if D::Vector::AXES == 2 { (0.16, 0.12) } else { (0.55, 0.3) };
        let ((sin_a, cos_a), (sin_e, cos_e)) = (trig::sin_cos(azimuth), trig::sin_cos(elevation));
        // A planar scene is seen along z, whichever way is up in it.
        let (right, towards) = if D::Vector::AXES == 2 { (up.cross(DVec3::Z), DVec3::Z) } else { (right, towards) };
        let level = towards * cos_a + right * sin_a;
        let forward = -(level * cos_e + up * sin_e);
        let to_right = forward.cross(up).normalize();
        let axes = [to_right, to_right.cross(forward), forward];
        let slope = trig::tan(HALF_ANGLE);
        // Balls around the bodies, as the camera would see them from the origin.
        let balls: Vec<(DVec3, f64)> = recording
            .samples
            .iter()
            .flat_map(|sample| (0..recording.bodies.len()).map(move |body| (sample, body)))
            .filter(|(_, body)| recording.bodies[*body].kind != BodyKind::Static)
            .filter_map(|(sample, body)| {
                let place = Stage::pose(sample, body)?.position;
                Some((DVec3::from_array(axes.map(|axis| axis.dot(place))), stage.bodies[body].reach))
            })
            .collect();
        let least = |axis: usize| balls.iter().map(|(seen, reach)| seen[axis] - reach).reduce(f64::min).unwrap_or(-1.0);
        let most = |axis: usize| balls.iter().map(|(seen, reach)| seen[axis] + reach).reduce(f64::max).unwrap_or(1.0);
        let middle = DVec3::from_array([0, 1, 2].map(|axis| 0.5 * (least(axis) + most(axis))));
        let free = 1.0 - 2.0 * MARGIN;
        // Each ball must lie within the picture: |across| + reach ≤ (distance + depth) · slope.
        let distance = balls.iter().map(|(seen, reach)| {
            let [x, y, depth] = (*seen - middle).to_array();
            let wide = (x.abs() + reach) / (slope * aspect * free);
            wide.max((y.abs() + reach) / (slope * free)) - depth
        });
        let distance = distance.reduce(f64::max).filter(|distance| *distance > 0.0).unwrap_or(10.0);
        let middle = axes[0] * middle.x + axes[1] * middle.y + axes[2] * middle.z;
        Self { eye: middle - forward * distance, axes, slope, near: 0.02 * distance }
    }

    /// A point as the camera sees it: to the right, up, and away from it [m].
    pub fn view(&self, point: DVec3) -> DVec3 {
        let offset = point - self.eye;
        DVec3::from_array(self.axes.map(|axis| axis.dot(offset)))
    }
}
