//! A plant that sways in its wind, as an animated picture without a seam.

use espalier_growth::Obstacle;
use espalier_mesh::Style;
use espalier_motion::{
    Node, Pose,
    clips::LOOP,
    flutter::{self, Air, Blade, Stirring},
};
use espalier_plant::Plant;
use espalier_settings::{Appearance, WindLook};
use glam::{DVec3, Quat, Vec3};

use super::{
    Camera, Look,
    scene::{Meshes, Stage},
};
use crate::{
    ExportError, Sink,
    foliage::cards::Stalk,
    png,
    swaying::{Rider, Swaying},
};

/// Moments of the loop that the picture has room for.
const FRAMED: usize = 12;
/// So many pictures of one loop, from a camera that stands still. `metres` is the length of an internode; obstacles shelter
/// the plant, and are not seen.
///
/// # Errors
/// Where the file cannot be written.
pub fn swaying(
    plant: &Plant,
    style: &Style,
    (look, metres, around): (&Look, f32, &[Obstacle]),
    size: [usize; 2],
    camera: Camera,
    frames: u16,
    out: &mut dyn Sink,
) -> Result<(), ExportError> {
    let motion = Swaying::of(plant, style, &look.appearance.wind, metres, around);
    let meshes = Meshes::of(plant, style, &look.appearance, Some(&motion));
    let stirred = Stirred::of(&motion, &look.appearance);
    let room: Vec<Vec3> = (0..FRAMED)
        .flat_map(|at| meshes.moved(&Posed::at(&stirred, metres, at as f32 / FRAMED as f32)).corners())
        .collect();
    let at = |frame: u16| {
        let posed = Posed::at(&stirred, metres, f32::from(frame) / f32::from(frames));
        Stage::on(meshes.moved(&posed), look.stand, room.clone())
    };
    // The room holds what is seen at any moment, and the camera stands still.
    let view = at(0).steady_views(camera, size, 1).swap_remove(0);
    png::animated(size, [LOOP as u16, frames], |frame, go_on| at(frame).seen_while(&view, size, go_on), out)
}

/// What moves besides joints, all through the loop.
struct Stirred<'a> {
    motion: &'a Swaying,
    air: Air,
    stirring: Stirring,
}

impl<'a> Stirred<'a> {
    fn of(motion: &'a Swaying, look: &Appearance) -> Self {
        let air = motion.air();
        let WindLook { flutter, snow, rain, .. } = look.wind;
        let stirring = Stirring {
            lee: air.lee(),
            much: f64::from(flutter * look.leaves.shape.nature().flutter),
            covered: flutter::covered(f64::from(snow)),
            wet: f64::from(rain),
        };
        Self { motion, air, stirring }
    }
}

/// How all rows stand at a moment of the loop.
pub(super) struct Posed<'a> {
    stirred: &'a Stirred<'a>,
    nodes: Vec<Node>,
    /// Internodes in a metre.
    per_metre: f64,
    /// Seconds since the loop began.
    time: f64,
}

impl<'a> Posed<'a> {
    fn at(stirred: &'a Stirred<'a>, metres: f32, gone: f32) -> Self {
        let Swaying { joints, wood, clips: [sway, _], .. } = stirred.motion;
        let key = (gone * (sway.keys.len() - 1) as f32).round() as usize;
        let time = sway.time(key);
        let pose = Pose::of(joints, wood, &sway.keys[key]);
        let node = |row| stirred.air.node(&pose, joints, wood, row, time);
        let nodes = (0..wood.len() as u32).map(node).collect();
        Self { stirred, nodes, per_metre: 1.0 / f64::from(metres), time }
    }

    /// Where a vertex that goes along with a row has come, and how it has turned.
    pub(super) fn moved(&self, rider: Rider, place: Vec3) -> (Vec3, Quat) {
        let motion = self.stirred.motion;
        let rest = place.as_dvec3() / self.per_metre;
        let carried = |row: u32| {
            let node = self.nodes[row as usize];
            node.place + node.turn * (rest - motion.wood.place(row))
        };
        let below = motion.joints.below(rider.row).filter(|_| rider.share < 1.0);
        let to: DVec3 = match below {
            Some(below) => carried(below).lerp(carried(rider.row), f64::from(rider.share)),
            None => carried(rider.row),
        };
        ((to * self.per_metre).as_vec3(), self.nodes[rider.row as usize].turn.as_quat())
    }

    /// Where the base of a leaf has come with its row, and how the leaf has turned about it besides.
    pub(super) fn fluttered(&self, rider: Rider, stalk: &Stalk) -> (Vec3, Quat) {
        let Stirred { motion: Swaying { joints, wood, .. }, air, stirring } = self.stirred;
        let (base, turn) = self.moved(rider, stalk.base);
        let blade = Blade {
            base: base.as_dvec3(),
            direction: (turn * stalk.direction).as_dvec3(),
            side: (turn * stalk.side).as_dvec3(),
            own: stalk.own.truncate().as_dvec3().to_array(),
        };
        let speed = air.speed(joints, wood, rider.row, self.time);
        (base, flutter::turn(stirring, &blade, speed, self.time, air.period()).as_quat())
    }
}

#[cfg(test)]
mod tests {
    use espalier_plant::{AxisId, Internode};
    use espalier_settings::LeafKind;

    use super::*;
    use crate::{in_memory, picture::given_up::GivenUp};

    #[test]
    fn snow_bends_what_is_in_the_picture() {
        let mut plant = Plant::new(Vec3::ZERO);
        plant.begin_step();
        // A rod that rises and leans, so that a load bends it.
        for at in 1..=24 {
            let end = Vec3::new(at as f32, 0.5 * at as f32, 0.0);
            plant.extend(AxisId::new(0), &Internode { end, normal: Vec3::Z, laterals: &[] });
        }
        plant.end_step();
        let style = Style::default();
        let tip = |snow: f32| {
            let wind = WindLook { speed: 3.0, snow, ..Default::default() };
            let look = Appearance { wind, ..Appearance::default() };
            let motion = Swaying::of(&plant, &style, &look.wind, 0.2, &[]);
            let row = motion.wood.len() as u32 - 1;
            let rider = Rider { row, share: 1.0, flutter: 0.0 };
            let rest = (motion.wood.place(row) * 5.0).as_vec3();
            Posed::at(&Stirred::of(&motion, &look), 0.2, 0.25).moved(rider, rest).0.y
        };
        assert!(tip(0.4) < tip(0.0) - 0.1, "{} under snow, {} without", tip(0.4), tip(0.0));
    }

    #[test]
    fn a_picture_in_the_wind_that_is_given_up_is_drawn_no_further() {
        let plant = Plant::new(Vec3::ZERO);
        // Small pictures, and some of which each has two bands.
        for (size, frames) in [([24, 24], 12), ([1200, 950], 2)] {
            let mut out = GivenUp::default();
            let look = (&Look::default(), 0.2, &[][..]);
            let drawn = swaying(&plant, &Style::default(), look, size, Camera::default(), frames, &mut out);
            assert!(
                matches!(drawn, Err(ExportError::Write(std::io::ErrorKind::ConnectionAborted))),
                "{drawn:?}"
            );
            assert_eq!(out.asked, 2);
            assert!(out.file.get_ref().len() < 1000, "no picture was drawn to its end but the first");
        }
    }

    #[test]
    fn leaves_flutter_as_their_kind_does_and_stream_to_lee_in_a_storm() {
        let mut plant = Plant::new(Vec3::ZERO);
        plant.begin_step();
        for height in 1..=12 {
            let end = Vec3::Y * height as f32;
            plant.extend(AxisId::new(0), &Internode { end, normal: Vec3::X, laterals: &[] });
        }
        plant.end_step();
        let style = Style::default();
        // How far a blade turns from how its twig carries it, on average through the loop, and how far to lee that is.
        let turned = |shape, speed: f32| {
            let wind = WindLook { speed, ..WindLook::default() };
            let leaves = espalier_settings::LeafLook { shape, ..Default::default() };
            let look = Appearance { wind, leaves, ..Appearance::default() };
            let motion = Swaying::of(&plant, &style, &look.wind, 0.2, &[]);
            let stirred = Stirred::of(&motion, &look);
            let rider = Rider { row: 12, share: 1.0, flutter: 0.0 };
            let stalk = Stalk {
                base: Vec3::Y * 12.0,
                direction: -Vec3::Y,
                side: Vec3::Z,
                own: glam::Vec4::splat(0.3),
            };
            let of = |frame: u32| {
                let posed = Posed::at(&stirred, 0.2, frame as f32 / 60.0);
                let (_, turn) = posed.fluttered(rider, &stalk);
                let carried = posed.moved(rider, stalk.base).1 * stalk.direction;
                (turn.to_axis_angle().1, (turn * carried - carried).dot(Vec3::X))
            };
            let all: Vec<(f32, f32)> = (0..60).map(of).collect();
            all.iter().fold([0.0; 2], |[a, b], (angle, lee)| [a + angle / 60.0, b + lee / 60.0])
        };
        let [[calm, _], [round, streams], [ovate, _], [needle, _]] = [
            (LeafKind::Ovate, 0.5),
            (LeafKind::Round, 18.0),
            (LeafKind::Ovate, 18.0),
            (LeafKind::Needle, 18.0),
        ]
        .map(|(shape, speed)| turned(shape, speed));
        assert!(streams > 0.4, "{streams}");
        assert!(
            calm < 0.1 * ovate && needle < 0.35 * ovate && ovate < round,
            "{calm} {needle} {ovate} {round}"
        );
    }

    #[test]
    fn the_pictures_of_a_loop_differ_and_the_same_plant_gives_the_same_file() {
        let mut plant = Plant::new(Vec3::ZERO);
        plant.begin_step();
        for height in 1..=24 {
            let end = Vec3::Y * height as f32;
            plant.extend(AxisId::new(0), &Internode { end, normal: Vec3::X, laterals: &[Vec3::X] });
        }
        plant.end_step();
        let file = |frames| {
            let look = (&Look::default(), 0.2, &[][..]);
            in_memory(|out| {
                swaying(&plant, &Style::default(), look, [40, 60], Camera::default(), frames, out)
            })
        };
        let twice = [file(3), file(3)].map(|file| file.expect("it is drawn"));
        assert_eq!(twice[0], twice[1]);
        let decoder = ::png::Decoder::new(std::io::Cursor::new(&twice[0]));
        let mut reader = decoder.read_info().expect("a PNG file");
        assert_eq!(reader.info().animation_control().map(|control| control.num_frames), Some(3));
        let mut frame = || {
            let mut pixels = vec![0; reader.output_buffer_size().expect("it fits")];
            reader.next_frame(&mut pixels).expect("a frame");
            pixels
        };
        let frames = [frame(), frame(), frame()];
        assert!(frames[0] != frames[1] && frames[1] != frames[2]);
    }
}
