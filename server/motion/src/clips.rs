//! Motion for files: a loop of sway without a seam, and one gust from rest to rest.

mod gust;

use glam::DVec3;

use crate::{
    Limbs, Rig,
    answers::Answers,
    exposure::Exposure,
    joints::Joints,
    shelter::behind_crowns,
    wind::{Direction, Weather, Wind},
    wood::Wood,
};

/// Seconds of the loop, and of the gust.
pub const LOOP: f64 = 8.0;
/// The same of the gust.
pub const GUST: f64 = 12.0;
/// Keys in a second.
pub const KEYS_A_SECOND: u32 = 30;
/// The furthest that a joint turns, as in [`crate::Sway`], radians.
const FURTHEST: f64 = 1.1;

/// The bends of all joints at even times; the first and the last are the same.
#[derive(Clone, Debug, PartialEq)]
pub struct Clip {
    /// What it is called.
    pub name: &'static str,
    /// Seconds from the first to the last.
    pub length: f64,
    /// Key by key, joint by joint.
    pub keys: Vec<Vec<DVec3>>,
}

impl Clip {
    /// When a key stands, s.
    pub fn time(&self, key: usize) -> f64 {
        key as f64 / f64::from(KEYS_A_SECOND)
    }
}

/// Sway and gust in a wind, with the crowns' own shelter. Each joint answers the gust by itself; how bodies answer it
/// together says [`blow`].
pub fn clips(joints: &Joints, wood: &Wood, weather: &Weather) -> [Clip; 2] {
    let wind = Wind::new(weather, LOOP);
    let along = wind.axis(Direction::Along);
    let exposure = Exposure::of(joints, wood, &behind_crowns(wood, along));
    let answers = Answers::of(joints, &wind, &exposure);
    [sway(&answers), gust::alone(&answers)]
}

/// Has jointed bodies, one for each piece between two bones of some rigs, stepped through the gust of a wind, and writes
/// down in its clip how the joints turn that the rigs show.
pub fn blow(gust: &mut Clip, rigs: &[Rig], joints: &Joints, limbs: &Limbs, wood: &Wood, weather: &Weather) {
    gust::together(gust, rigs, joints, limbs, wood, weather);
}

/// How far each joint turns at most in some clips, radians.
pub fn reaches(clips: &[Clip], joints: usize) -> Vec<f64> {
    let mut reach = vec![0.0f64; joints];
    for key in clips.iter().flat_map(|clip| &clip.keys) {
        reach.iter_mut().zip(key).for_each(|(reach, bend)| *reach = reach.max(bend.length()));
    }
    reach
}

fn sway(answers: &Answers) -> Clip {
    let count = keys(LOOP);
    let mut bends = Vec::new();
    let mut keys: Vec<Vec<DVec3>> = (0..count - 1)
        .map(|key| {
            answers.bends(f64::from(key) / f64::from(KEYS_A_SECOND), &mut bends);
            bends.iter().map(|bend| bend.clamp_length_max(FURTHEST)).collect()
        })
        .collect();
    keys.push(keys[0].clone());
    Clip { name: "Sway", length: LOOP, keys }
}

fn keys(seconds: f64) -> u32 {
    (seconds * f64::from(KEYS_A_SECOND)).round() as u32 + 1
}
