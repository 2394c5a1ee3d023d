//! A plant that sways in its wind, as an animated picture without a seam.

use std::f32::consts::TAU;

use espalier_growth::Obstacle;
use espalier_mesh::Style;
use espalier_motion::{Node, Pose, clips::LOOP};
use espalier_plant::Plant;
use glam::{DVec3, Quat, Vec3};

use super::{
    Camera, Look,
    scene::{Meshes, Stage},
};
use crate::{
    ExportError, Sink, png,
    swaying::{Rider, Swaying},
};

/// Moments of the loop that the picture has room for.
const FRAMED: usize = 12;
/// How far what a metamer bears turns about its node in a breeze that makes all leaves move, in radians, and how often in
/// a loop at least and at most.
const FLUTTER: f32 = 0.22;
const OFTEN: [f32; 2] = [14.0, 30.0];

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
    let room: Vec<Vec3> = (0..FRAMED)
        .flat_map(|at| meshes.moved(&Posed::at(&motion, metres, at as f32 / FRAMED as f32)).corners())
        .collect();
    let at = |frame: u16| {
        let posed = Posed::at(&motion, metres, f32::from(frame) / f32::from(frames));
        Stage::on(meshes.moved(&posed), look.stand, room.clone())
    };
    // The room holds what is seen at any moment, and the camera stands still.
    let view = at(0).steady_views(camera, size, 1).swap_remove(0);
    png::animated(size, [LOOP as u16, frames], |frame, go_on| at(frame).seen_while(&view, size, go_on), out)
}

/// How all rows stand at a moment of the loop.
pub(super) struct Posed<'a> {
    motion: &'a Swaying,
    nodes: Vec<Node>,
    /// Internodes in a metre.
    per_metre: f64,
    /// Which share of the loop has gone.
    gone: f32,
}

impl<'a> Posed<'a> {
    fn at(motion: &'a Swaying, metres: f32, gone: f32) -> Self {
        let Swaying { joints, wood, clips: [sway, _], .. } = motion;
        let key = (gone * (sway.keys.len() - 1) as f32).round() as usize;
        let pose = Pose::of(joints, wood, &sway.keys[key]);
        let nodes = (0..wood.len() as u32).map(|row| pose.node(joints, wood, row)).collect();
        Self { motion, nodes, per_metre: 1.0 / f64::from(metres), gone }
    }

    /// Where a vertex that goes along with a row has come, and how it has turned.
    pub(super) fn moved(&self, rider: Rider, place: Vec3, is_leaf: bool) -> (Vec3, Quat) {
        let rest = place.as_dvec3() / self.per_metre;
        let carried = |row: u32| {
            let node = self.nodes[row as usize];
            node.place + node.turn * (rest - self.motion.wood.place(row))
        };
        let own = self.nodes[rider.row as usize];
        let below = self.motion.joints.below(rider.row).filter(|_| rider.share < 1.0);
        let to: DVec3 = match below {
            Some(below) => carried(below).lerp(carried(rider.row), f64::from(rider.share)),
            None => carried(rider.row),
        };
        let (to, turn) = ((to * self.per_metre).as_vec3(), own.turn.as_quat());
        if !is_leaf {
            return (to, turn);
        }
        let node = (own.place * self.per_metre).as_vec3();
        let quiver = self.quiver(rider.row);
        (node + quiver * (to - node), quiver * turn)
    }

    /// How what a row bears flutters: a whole number of times in a loop, each in its own time and about its own axis.
    fn quiver(&self, row: u32) -> Quat {
        let [a, b, c] =
            [0, 1, 2].map(|salt| espalier_mesh::leaves::hash(3 * row + salt) as f32 / u32::MAX as f32);
        let often = (OFTEN[0] + a * (OFTEN[1] - OFTEN[0])).round();
        let (sin, _) = libm::sincosf(TAU * (often * self.gone + b));
        let (x, z) = libm::sincosf(TAU * c);
        Quat::from_scaled_axis(FLUTTER * self.motion.stir * sin * Vec3::new(x, 0.4, z))
    }
}

#[cfg(test)]
mod tests {
    use espalier_plant::{AxisId, Internode};

    use super::*;
    use crate::in_memory;

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
            let look = espalier_settings::looks::WindLook { speed: 3.0, snow, ..Default::default() };
            let motion = Swaying::of(&plant, &style, &look, 0.2, &[]);
            let row = motion.wood.len() as u32 - 1;
            let rider = Rider { row, share: 1.0, flutter: 0.0 };
            let rest = (motion.wood.place(row) * 5.0).as_vec3();
            Posed::at(&motion, 0.2, 0.25).moved(rider, rest, false).0.y
        };
        assert!(tip(0.4) < tip(0.0) - 0.1, "{} under snow, {} without", tip(0.4), tip(0.0));
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
