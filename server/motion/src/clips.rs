//! Motion for files: a loop of sway without a seam, and one gust from rest to rest.

mod gust;

use glam::DVec3;

use crate::{
    Limbs, Rig,
    answers::Answers,
    exposure::Exposure,
    flutter::Air,
    joints::Joints,
    shelter::{Solid, shares},
    sway::limited,
    wind::{Direction, Weather, Wind},
    wood::Wood,
};

/// Seconds of the loop, and of the gust.
pub const LOOP: f64 = 8.0;
/// The same of the gust.
pub const GUST: f64 = 12.0;
/// Keys in a second.
pub const KEYS_A_SECOND: u32 = 30;

/// What moves plants, and what they stand in.
#[derive(Clone, Debug, PartialEq)]
pub struct Conditions {
    weather: Weather,
    /// The share of the open wind's speed that each row gets.
    shares: Vec<f64>,
    /// How each joint turns under what lies on it.
    loads: Vec<DVec3>,
}

impl Conditions {
    /// A wind among obstacles, and how joints turn under what lies on them, as [`crate::loads::turns`] has it.
    pub fn new(wood: &Wood, weather: Weather, solids: &[Solid], loads: Vec<DVec3>) -> Self {
        let along = Wind::new(&weather, LOOP).axis(Direction::Along);
        Self { weather, shares: shares(wood, along, solids), loads }
    }

    /// A wind in the open, and nothing that lies on plants.
    pub fn open(wood: &Wood, weather: Weather) -> Self {
        Self::new(wood, weather, &[], Vec::new())
    }

    /// How much of the wind reaches what each joint bears.
    pub fn exposure(&self, joints: &Joints, wood: &Wood) -> Exposure {
        Exposure::of(joints, wood, &self.shares)
    }

    /// The air around rows in the loop.
    pub fn air(&self, plants: (&Joints, &Limbs, &Wood)) -> Air {
        let (joints, _, wood) = plants;
        Air::new(Wind::new(&self.weather, LOOP), self.exposure(joints, wood), plants)
    }

    /// How each joint turns under what lies on it, radians; beyond the end not at all.
    pub fn loads(&self) -> &[DVec3] {
        &self.loads
    }
}
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

/// Sway and gust. Each joint answers the gust by itself; how bodies answer it together says [`blow`].
pub fn clips(joints: &Joints, wood: &Wood, conditions: &Conditions) -> [Clip; 2] {
    let wind = Wind::new(&conditions.weather, LOOP);
    let answers = Answers::under(joints, &wind, &conditions.exposure(joints, wood), &conditions.loads);
    [sway(&answers), gust::alone(&answers)]
}

/// Has jointed bodies, one for each piece between two bones of some rigs, stepped through the gust of a wind, and writes
/// down in its clip how the joints turn that the rigs show.
///
/// # Errors
/// That of `go_on`, which is asked at each key, soon after it has occurred. The clip is of no use then.
pub fn blow<E>(
    gust: &mut Clip,
    rigs: &[Rig],
    plants: (&Joints, &Limbs, &Wood),
    conditions: &Conditions,
    go_on: impl FnMut() -> Result<(), E>,
) -> Result<(), E> {
    gust::together(gust, rigs, plants, conditions, go_on)
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
            bends.iter().map(|&bend| limited(bend)).collect()
        })
        .collect();
    keys.push(keys[0].clone());
    Clip { name: "Sway", length: LOOP, keys }
}

fn keys(seconds: f64) -> u32 {
    (seconds * f64::from(KEYS_A_SECOND)).round() as u32 + 1
}
