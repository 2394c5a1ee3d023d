//! Pictures of a plant from any side, one or many in one PNG file.

use espalier_mesh::Style;
use espalier_plant::Plant;
use glam::Vec3;

use super::{
    Look,
    scene::{Framing, Stage},
};
use crate::{ExportError, Sink, png};

/// Seconds that a turntable takes to go around.
const ROUND: u16 = 4;

/// Where a picture is taken from, in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// How far the eye has gone around the plant, from the front to the right.
    pub turn: f32,
    /// How high it stands above the horizon, more than 0 and less than 90.
    pub rise: f32,
}

impl Default for Camera {
    /// From the front, looking down a little.
    fn default() -> Self {
        Self { turn: 0.0, rise: 5.710_593 }
    }
}

impl Camera {
    /// The unit vector to the eye.
    fn eye(self) -> Vec3 {
        let [turn, rise] = [self.turn, self.rise].map(|degrees| libm::sincosf(degrees.to_radians()));
        Vec3::new(turn.0 * rise.1, rise.0, turn.1 * rise.1)
    }
}

/// A picture from a camera as PNG, or so many from cameras all around, beginning with it, as an animated one.
///
/// # Errors
/// Where the file cannot be written.
pub fn turntable(
    plant: &Plant,
    style: &Style,
    look: &Look,
    size: [usize; 2],
    camera: Camera,
    frames: u16,
    out: &mut dyn Sink,
) -> Result<(), ExportError> {
    let stage = Stage::of(plant, style, look);
    if frames <= 1 {
        let view = stage.framed(camera.eye(), size, &Framing::default());
        return Ok(out.write_all(&stage.seen(&view, size).png())?);
    }
    let eye = |frame: u16| {
        Camera { turn: camera.turn + 360.0 * f32::from(frame) / f32::from(frames), ..camera }.eye()
    };
    let steady = Framing { is_steady: true, ..Framing::default() };
    let most =
        (0..frames).map(|frame| stage.framed(eye(frame), size, &steady).scale()).fold(f32::MAX, f32::min);
    let pictures = (0..frames).map(|frame| {
        let view = stage.framed(eye(frame), size, &Framing { most, ..steady });
        stage.seen(&view, size).pixels()
    });
    png::animated(size, [ROUND, frames], pictures, out)
}
