//! Motion for files: a loop of sway without a seam, and one gust from rest to rest.

use glam::DVec3;

use crate::{
    answers::{Answer, Answers},
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
/// When the gust comes, when it goes, and from when on what still swings is brought to rest, s.
const COMES: f64 = 0.5;
const GOES: f64 = 4.5;
const CALMS: f64 = 9.5;
/// How much stronger its load is than that of the mean wind.
const STRONGER: f64 = 1.6;
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

/// Sway and gust in a wind, with the crowns' own shelter.
pub fn clips(joints: &Joints, wood: &Wood, weather: &Weather) -> [Clip; 2] {
    let wind = Wind::new(weather, LOOP);
    let along = wind.axis(Direction::Along);
    let exposure = Exposure::of(joints, wood, &behind_crowns(wood, along));
    let answers = Answers::of(joints, &wind, &exposure);
    [sway(&answers), gust(&answers)]
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

/// The load comes and goes at once, and each joint answers by itself as a damped oscillator does.
fn gust(answers: &Answers) -> Clip {
    let of = |time: f64| -> Vec<DVec3> {
        let calmed = ((GUST - time) / (GUST - CALMS)).clamp(0.0, 1.0);
        let left = calmed * calmed * (3.0 - 2.0 * calmed);
        let bend = |answer: &Answer| {
            let share = risen(answer, time - COMES) - risen(answer, time - GOES);
            (STRONGER * left * share * answer.mean).clamp_length_max(FURTHEST)
        };
        answers.all().iter().map(bend).collect()
    };
    let keys = (0..keys(GUST)).map(|key| of(f64::from(key) / f64::from(KEYS_A_SECOND))).collect();
    Clip { name: "Gust", length: GUST, keys }
}

/// How far an oscillator has come, of where a load holds it that came so long ago; by and by, as gusts come within a second.
fn risen(answer: &Answer, gone: f64) -> f64 {
    if gone <= 0.0 {
        return 0.0;
    }
    let Answer { rate, damping, .. } = *answer;
    let damped = rate * (1.0 - damping * damping).sqrt();
    let (sin, cos) = libm::sincos(damped * gone);
    let step = 1.0 - libm::exp(-damping * rate * gone) * (cos + damping * rate / damped * sin);
    // Stiff limbs follow the load itself, which takes its time.
    let come = (gone / 1.2).min(1.0);
    step * come * come * (3.0 - 2.0 * come)
}

fn keys(seconds: f64) -> u32 {
    (seconds * f64::from(KEYS_A_SECOND)).round() as u32 + 1
}
