//! Frames: the recording as pictures, drawn without any display.
//!
//! A small renderer of triangles: a depth buffer, a sun with a shadow map, a soft sky, four samples per pixel. The camera stands so
//! that all that moves is in the picture at any time. Springs, joints, contact points and the forces there are drawn too; what bodies hide of
//! them shines through faintly. The same recording gives the same bytes.

mod camera;
mod paint;
mod raster;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::thread;

use crate::dim::RecordDim;
use crate::files::{FileAction, FileError, write_file};
use crate::fittings::Fittings;
use crate::recording::Recording;
use crate::stage::Stage;
use camera::Camera;
use paint::Painter;

/// How many pictures, and how large.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameSettings {
    /// Number of pictures, evenly spaced over the recording, the first and the last state included; at least 1.
    pub count: usize,
    /// Width of a picture [px].
    pub width: usize,
    /// Height of a picture [px].
    pub height: usize,
}

impl Default for FrameSettings {
    fn default() -> Self {
        Self { count: 60, width: 800, height: 450 }
    }
}

/// A picture: red, green and blue of each pixel, row by row from the top (sRGB, 8 bits).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Width [px].
    pub width: usize,
    /// Height [px].
    pub height: usize,
    /// Three bytes for each pixel.
    pub pixels: Vec<u8>,
}

/// Draws the pictures of a recording.
#[derive(Debug)]
pub struct Frames<'a, D: RecordDim> {
    recording: &'a Recording<D>,
    settings: FrameSettings,
    stage: Stage,
    fittings: Fittings,
    camera: Camera,
}

impl<'a, D: RecordDim> Frames<'a, D> {
    /// Prepares the pictures of a recording.
    pub fn new(recording: &'a Recording<D>, settings: FrameSettings) -> Self {
        let settings = FrameSettings {
            count: settings.count.max(1),
            width: settings.width.clamp(16, 8192),
            height: settings.height.clamp(16, 8192),
        };
        let stage = Stage::new(recording);
        let fittings = Fittings::new(recording, &stage);
        let camera = Camera::looking_at(recording, &stage, settings.width as f64 / settings.height as f64);
        Self { recording, settings, stage, fittings, camera }
    }

    /// Number of pictures.
    pub fn count(&self) -> usize {
        self.settings.count
    }

    /// Draws a picture by its number.
    pub fn picture(&self, number: usize) -> Picture {
        let sample = self.recording.samples.get(self.sample_of(number));
        let fittings = sample.map(|sample| self.fittings.of(self.recording, sample)).unwrap_or_default();
        let mut painter = Painter::new(&self.stage, &self.camera, self.settings.width, self.settings.height);
        if let Some(sample) = sample {
            for (index, body) in self.stage.bodies.iter().enumerate() {
                if let Some(pose) = Stage::pose(sample, index) {
                    painter.place(body, &pose);
                }
            }
        }
        fittings.iter().for_each(|fitting| painter.add_fitting(fitting));
        painter.picture()
    }

    /// The sample nearest to the time of a picture.
    fn sample_of(&self, number: usize) -> usize {
        let samples = &self.recording.samples;
        let (Some(first), Some(last)) = (samples.first(), samples.last()) else { return 0 };
        let share = number as f64 / (self.settings.count.max(2) - 1) as f64;
        let time = first.time + share.min(1.0) * (last.time - first.time);
        let after = samples.partition_point(|sample| sample.time < time).min(samples.len() - 1);
        let nearer = after > 0 && time - samples[after - 1].time < samples[after].time - time;
        after - usize::from(nearer)
    }

    /// Time from one picture to the next [s].
    fn interval(&self) -> f64 {
        let samples = &self.recording.samples;
        let span = samples.last().zip(samples.first()).map_or(0.0, |(last, first)| last.time - first.time);
        span / (self.settings.count.max(2) - 1) as f64
    }
}

impl Picture {
    /// The picture as a PNG file.
    pub fn to_png(&self) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header().map_err(io::Error::other)?;
        writer.write_image_data(&self.pixels).map_err(io::Error::other)?;
        writer.finish().map_err(io::Error::other)?;
        Ok(bytes)
    }
}

/// Writes `frames/0000.png`, … and `scene.gif`, which plays at the speed of the recording, into a folder; returns their paths.
///
/// # Errors
///
/// When a file cannot be written.
pub fn write_frames<D: RecordDim>(
    recording: &Recording<D>,
    settings: FrameSettings,
    folder: &Path,
) -> Result<Vec<PathBuf>, FileError> {
    let frames = Frames::new(recording, settings);
    let mut animation = Animation::new(frames.settings, frames.interval());
    let pictures = folder.join("frames");
    fs::create_dir_all(&pictures).map_err(|reason| FileError::new(FileAction::CreateFolder, &pictures, reason))?;
    let place = |number: usize| pictures.join(format!("{number:04}.png"));
    // Pictures of an earlier, longer series would continue this one.
    for old in (frames.count()..).map(place).take_while(|path| path.is_file()) {
        fs::remove_file(&old).map_err(|reason| FileError::new(FileAction::Remove, &old, reason))?;
    }
    let mut paths = Vec::new();
    let numbers: Vec<usize> = (0..frames.count()).collect();
    // Pictures do not know of each other: as many at once as the machine likes, in their order.
    let at_once = thread::available_parallelism().map_or(1, usize::from);
    let draw = |number: usize| {
        let picture = frames.picture(number);
        let png = picture.to_png()?;
        Ok((picture, png))
    };
    for numbers in numbers.chunks(at_once) {
        let drawn: Vec<io::Result<(Picture, Vec<u8>)>> = thread::scope(|scope| {
            let painters: Vec<_> = numbers.iter().map(|number| scope.spawn(|| draw(*number))).collect();
            painters.into_iter().map(|painter| painter.join().expect("drawing does not panic")).collect()
        });
        for (number, drawn) in numbers.iter().zip(drawn) {
            let path = place(*number);
            let (picture, png) = drawn.map_err(|reason| FileError::new(FileAction::Write, &path, reason))?;
            write_file(&path, |out| out.write_all(&png))?;
            animation.add(&picture);
            paths.push(path);
        }
    }
    let path = folder.join("scene.gif");
    write_file(&path, |out| out.write_all(&animation.finish()?))?;
    paths.push(path);
    Ok(paths)
}

/// A GIF in the making; a mistake of its encoder shows at the end.
struct Animation {
    encoder: Result<gif::Encoder<Vec<u8>>, gif::EncodingError>,
    settings: FrameSettings,
    /// Time from one picture to the next [s].
    interval: f64,
    count: usize,
}

impl Animation {
    fn new(settings: FrameSettings, interval: f64) -> Self {
        let encoder = gif::Encoder::new(Vec::new(), settings.width as u16, settings.height as u16, &[]);
        let encoder = encoder.and_then(|mut encoder| encoder.set_repeat(gif::Repeat::Infinite).map(|()| encoder));
        Self { encoder, settings, interval, count: 0 }
    }

    fn add(&mut self, picture: &Picture) {
        let Ok(encoder) = &mut self.encoder else { return };
        let (width, height) = (self.settings.width as u16, self.settings.height as u16);
        let mut frame = gif::Frame::from_rgb_speed(width, height, &picture.pixels, 10);
        // Hundredths of a second, rounded so that the sum stays right.
        let until = |pictures: usize| (100.0 * self.interval * pictures as f64).round();
        frame.delay = (until(self.count + 1) - until(self.count)).clamp(2.0, 65535.0) as u16;
        self.count += 1;
        if let Err(error) = encoder.write_frame(&frame) {
            self.encoder = Err(error);
        }
    }

    fn finish(self) -> io::Result<Vec<u8>> {
        self.encoder.map_err(io::Error::other)?.into_inner().map_err(io::Error::other)
    }
}
