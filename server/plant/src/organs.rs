//! Leaves, flowers and fruits that a metamer is given one by one, each with its direction and length.
//!
//! They stand at the metamer's node. In a plant they are counted from the metamer's own normal, so that they turn with it
//! however it is carried; drawings and clients, which do not know how a metamer is rolled, count from the shortest turn
//! of the upright.

use std::{
    f64::consts::{PI, TAU},
    sync::Arc,
};

use glam::{DVec3, Quat, Vec3};

/// The most organs of a metamer: four bits say how many leaves it bears.
pub const MOST_ORGANS: usize = 15;
/// The shortest and the longest organ, in internodes.
pub const ORGAN_LENGTHS: [f32; 2] = [0.02, 40.0];
/// One step of a length's code multiplies the length by e to the power of this.
const LENGTH_STEP: f64 = 0.03;
/// Cosine of the angle from straight down up to which a heading counts as straight down.
const STRAIGHT_DOWN: f32 = -0.9999;
/// Steps of a roll in a turn.
const ROLLS: u32 = 64;

/// The organs of a metamer.
pub type Organs = Arc<[Organ]>;

/// What an organ is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OrganKind {
    /// A leaf.
    Leaf,
    /// A flower.
    Flower,
    /// A fruit.
    Fruit,
}

impl OrganKind {
    /// All of them; the place of each is its number in files and frames.
    pub const ALL: [Self; 3] = [Self::Leaf, Self::Flower, Self::Fruit];
}

/// One organ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Organ {
    /// What it is.
    pub kind: OrganKind,
    /// How far around the metamer it points, in 1/256 of a turn.
    pub azimuth: u8,
    /// How far it points away from the metamer's heading, in 1/255 of half a turn.
    pub inclination: u8,
    /// How far it is rolled about its direction, in 1/64 of a turn: 0 where its upper side looks along the metamer.
    pub roll: u8,
    /// 0 for what the look of the plant says, else the code of its length.
    pub length: u8,
}

/// How an organ stands: unit vectors from its base to its tip, and out of its upper side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stance {
    /// From its base to its tip.
    pub direction: Vec3,
    /// Out of its upper side, perpendicular to that.
    pub normal: Vec3,
}

/// Two unit vectors across a heading from which azimuths of organs are counted, the second after the first.
pub type Sides = [Vec3; 2];

/// X and Z, turned as the shortest turn from Y to a unit heading does.
pub fn shortest_sides(heading: Vec3) -> Sides {
    if heading.y < STRAIGHT_DOWN {
        let side = Vec3::X.reject_from_normalized(heading).normalize();
        return [side, side.cross(heading)];
    }
    // In 64 bits, for near straight down the sum of both vectors is short.
    let [x, y, z] = heading.to_array().map(f64::from);
    let side = (DVec3::X - DVec3::new(x, 1.0 + y, z) * (x / (1.0 + y))).as_vec3().normalize();
    [side, side.cross(heading)]
}

/// The normal of a metamer with a unit heading, and what follows it.
pub fn own_sides(heading: Vec3, normal: Vec3) -> Sides {
    let side = normal.reject_from_normalized(heading).normalize_or(heading.any_orthonormal_vector());
    [side, side.cross(heading)]
}

impl Organ {
    /// An organ on a metamer with a unit heading, with a length in internodes if it has one of its own.
    pub fn new(kind: OrganKind, heading: Vec3, sides: Sides, stance: &Stance, length: Option<f32>) -> Self {
        let length = length.map_or(0, encode);
        Self { kind, azimuth: 0, inclination: 0, roll: 0, length }.standing(heading, sides, stance)
    }

    /// The same organ in another stance.
    fn standing(self, heading: Vec3, sides: Sides, stance: &Stance) -> Self {
        let Stance { direction, normal } = *stance;
        let [u, w] = sides;
        let part = |of: Vec3, along: Vec3| f64::from(of.dot(along));
        let turn = libm::atan2(part(direction, w), part(direction, u)) / TAU;
        let away = libm::acos(part(direction, heading).clamp(-1.0, 1.0)) / PI;
        let [azimuth, inclination] = [(turn * 256.0), (away * 255.0)].map(|steps| libm::round(steps) as i32);
        let (azimuth, inclination) = (azimuth.rem_euclid(256) as u8, inclination as u8);
        let organ = Self { azimuth, inclination, ..self };
        let [_, upper, side] = organ.frame(heading, sides);
        let roll = libm::atan2(part(normal, side), part(normal, upper)) / TAU * f64::from(ROLLS);
        Self { roll: (libm::round(roll) as i32).rem_euclid(ROLLS as i32) as u8, ..organ }
    }

    /// The direction, across it towards the heading, and across both.
    fn frame(&self, heading: Vec3, [u, w]: Sides) -> [Vec3; 3] {
        let angles = [f64::from(self.azimuth) / 256.0 * TAU, f64::from(self.inclination) / 255.0 * PI];
        let [(sin, cos), (away_sin, away_cos)] = angles.map(libm::sincos);
        let [sin, cos, away_sin, away_cos] = [sin, cos, away_sin, away_cos].map(|number| number as f32);
        let aside = cos * u + sin * w;
        [away_cos * heading + away_sin * aside, away_sin * heading - away_cos * aside, cos * w - sin * u]
    }

    /// How it stands on a metamer with a unit heading.
    pub fn stance(&self, heading: Vec3, sides: Sides) -> Stance {
        let [direction, upper, side] = self.frame(heading, sides);
        let (sin, cos) = libm::sincos(f64::from(self.roll) / f64::from(ROLLS) * TAU);
        Stance { direction, normal: cos as f32 * upper + sin as f32 * side }
    }

    /// The same stance on the same metamer, counted from other sides.
    pub fn seen_from(self, heading: Vec3, from: Sides, to: Sides) -> Self {
        self.standing(heading, to, &self.stance(heading, from))
    }

    /// The organ as a metamer bears it that a motion has turned from one heading to another: counted from its own normal.
    pub fn carried(self, drawn: Vec3, turn: Quat, heading: Vec3, normal: Vec3) -> Self {
        let Stance { direction, normal: upper } = self.stance(drawn, shortest_sides(drawn));
        let stance = Stance { direction: turn * direction, normal: turn * upper };
        self.standing(heading, own_sides(heading, normal), &stance)
    }

    /// Its length in internodes, if it has one of its own.
    pub fn length(&self) -> Option<f32> {
        let steps = f64::from(self.length.checked_sub(1)?) * LENGTH_STEP;
        Some((f64::from(ORGAN_LENGTHS[0]) * libm::exp(steps)) as f32)
    }

    /// All of it in one number, for files, frames and hashes: from the lowest byte on azimuth, inclination, length, and
    /// the roll with the kind above its six bits.
    pub fn to_number(self) -> u32 {
        let last = self.roll | (self.kind as u8) << 6;
        u32::from_le_bytes([self.azimuth, self.inclination, self.length, last])
    }

    /// The organ of a number; none where there is no such kind.
    pub fn from_number(number: u32) -> Option<Self> {
        let [azimuth, inclination, length, last] = number.to_le_bytes();
        let kind = *OrganKind::ALL.get(usize::from(last >> 6))?;
        Some(Self { kind, azimuth, inclination, roll: last & 63, length })
    }
}

fn encode(length: f32) -> u8 {
    let [shortest, longest] = ORGAN_LENGTHS;
    let steps = libm::log(f64::from(length.clamp(shortest, longest) / shortest)) / LENGTH_STEP;
    1 + libm::round(steps).clamp(0.0, 254.0) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn organs_stand_as_they_were_set() {
        let down = Vec3::new(0.002, -1.0, 0.001).normalize();
        for heading in [Vec3::Y, Vec3::NEG_Y, down, Vec3::X, Vec3::new(0.3, 0.9, -0.2).normalize()] {
            let sides = shortest_sides(heading);
            for direction in [Vec3::Y, Vec3::Z, Vec3::new(-0.5, 0.1, 0.8).normalize(), -heading, heading] {
                for around in [Vec3::X, Vec3::new(0.2, -0.7, 0.4)] {
                    let Some(normal) = around.reject_from_normalized(direction).try_normalize() else {
                        continue;
                    };
                    let organ =
                        Organ::new(OrganKind::Leaf, heading, sides, &Stance { direction, normal }, None);
                    let found = organ.stance(heading, sides);
                    assert!(found.direction.dot(direction) > 0.9995, "{heading} {direction} {found:?}");
                    assert!(found.normal.dot(normal) > 0.995, "{heading} {normal} {found:?}");
                    assert!(found.normal.dot(found.direction).abs() < 1e-4, "{heading} {found:?}");
                    assert!((found.normal.length() - 1.0).abs() < 1e-4);
                    assert_eq!(organ.length(), None);
                }
            }
        }
    }

    /// An organ square to an upright metamer lies with its upper side up.
    #[test]
    fn no_roll_looks_along_the_metamer() {
        let organ = Organ { kind: OrganKind::Leaf, azimuth: 64, inclination: 128, roll: 0, length: 0 };
        let Stance { direction, normal } = organ.stance(Vec3::Y, shortest_sides(Vec3::Y));
        assert!(direction.dot(Vec3::Z) > 0.999 && normal.dot(Vec3::Y) > 0.999, "{direction} {normal}");
    }

    #[test]
    fn lengths_are_kept_to_two_percent() {
        let stance = Stance { direction: Vec3::X, normal: Vec3::Y };
        let kept = |length| {
            Organ::new(OrganKind::Fruit, Vec3::Y, shortest_sides(Vec3::Y), &stance, Some(length)).length()
        };
        for (length, wanted) in [
            (0.02f32, 0.02f32),
            (0.1, 0.1),
            (0.37, 0.37),
            (6.5, 6.5),
            (40.0, 40.0),
            (1e-6, 0.02),
            (1e6, 40.0),
        ] {
            let found = kept(length).expect("it has one");
            assert!((found / wanted - 1.0).abs() < 0.02, "{length} {found}");
        }
    }

    #[test]
    fn numbers_hold_all_of_an_organ() {
        for (kind, azimuth) in OrganKind::ALL.into_iter().zip([0, 100, 255]) {
            let organ = Organ { kind, azimuth, inclination: 255 - azimuth, roll: azimuth / 4, length: 7 };
            assert_eq!(Organ::from_number(organ.to_number()), Some(organ));
        }
        assert_eq!(Organ::from_number(3 << 30), None);
    }
}
