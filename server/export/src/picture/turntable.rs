//! Pictures of a plant from any side, one or many in one PNG file.

use std::io;

use espalier_mesh::Style;
use espalier_plant::Plant;
use glam::Vec3;

use super::{Camera, Canvas, Look, scene::Stage};
use crate::{ExportError, Sink, png};

/// Seconds that a turntable takes to go around.
const ROUND: u16 = 4;

/// A picture from a camera as PNG, or so many from cameras all around, beginning with it, as an animated one.
///
/// While it is drawn the file is flushed time and again: one that nobody wants any more fails there.
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
        let view = stage.view(camera, size);
        let picture = stage.seen_while(&view, size, || out.flush())?;
        return Ok(out.write_all(&picture.png())?);
    }
    let views = stage.steady_views(camera, size, frames);
    let draw = |number: u16, go_on: &mut dyn FnMut() -> io::Result<()>| {
        stage.seen_while(&views[usize::from(number)], size, go_on)
    };
    png::animated(size, [ROUND, frames], draw, out)
}

/// So many square pictures from all around, beginning with the front, side by side from the left to the right.
/// `between` is called before each.
pub fn strip(
    plant: &Plant,
    style: &Style,
    look: &Look,
    (side, frames): (usize, u16),
    mut between: impl FnMut(),
) -> Canvas {
    let stage = Stage::of(plant, style, look);
    let mut strip = Canvas::new(side * usize::from(frames), side, Vec3::ZERO);
    for (number, view) in stage.steady_views(Camera::default(), [side; 2], frames).iter().enumerate() {
        between();
        strip.paste(&stage.seen(view, [side; 2]), number * side, 0);
    }
    strip
}

#[cfg(test)]
mod tests {
    use espalier_plant::{AxisId, Internode};

    use super::*;
    use crate::picture::given_up::GivenUp;

    #[test]
    fn a_picture_that_is_given_up_is_drawn_no_further() {
        let plant = Plant::new(Vec3::ZERO);
        // A still of two bands, a turntable of small pictures, and one whose first picture has two bands.
        for (size, frames) in [([1200, 950], 1), ([24, 24], 12), ([1200, 950], 2)] {
            let mut out = GivenUp::default();
            let (style, look) = (Style::default(), Look::default());
            let drawn = turntable(&plant, &style, &look, size, Camera::default(), frames, &mut out);
            assert!(matches!(drawn, Err(ExportError::Write(io::ErrorKind::ConnectionAborted))), "{drawn:?}");
            assert_eq!(out.asked, 2);
            assert!(out.file.get_ref().len() < 1000, "no picture was drawn to its end but the first");
        }
    }

    #[test]
    fn a_strip_shows_a_plant_from_all_sides_in_turn() {
        let mut plant = Plant::new(Vec3::ZERO);
        plant.begin_step();
        // It leans to the right, as seen from the front.
        for at in 1..=6 {
            let end = Vec3::new(0.5, 1.0, 0.0) * at as f32;
            plant.extend(AxisId::new(0), &Internode { end, normal: Vec3::Z, laterals: &[] });
        }
        plant.end_step();
        let mut begun = 0;
        let strip = strip(&plant, &Style::default(), &Look::default(), (48, 4), || begun += 1);
        assert_eq!((strip.width(), strip.height(), begun), (192, 48, 4));
        // The leftmost and the rightmost dark pixel of the upper half of each picture, from its middle.
        let lean = |picture: usize| {
            let dark = (0..24).flat_map(|y| (0..48).map(move |x| (x, y)));
            let dark =
                dark.filter(|&(x, y)| strip.get(48 * picture + x, y).y < 0.3).map(|(x, _)| x as f32 - 23.5);
            let (sum, count) = dark.fold((0.0, 0), |(sum, count), x| (sum + x, count + 1));
            assert!(count > 0, "picture {picture} shows the plant");
            sum / count as f32
        };
        assert!(lean(0) > 3.0 && lean(2) < -3.0, "{} {}", lean(0), lean(2));
        assert!(lean(1).abs() < 3.0 && lean(3).abs() < 3.0, "{} {}", lean(1), lean(3));
    }
}
