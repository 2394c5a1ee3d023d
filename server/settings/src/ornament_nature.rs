//! How flowers and fruits stand on a tree: for every client and every export.

use serde::Serialize;
use ts_rs::TS;

use crate::{
    looks::{FlowerKind, FlowerLook, FruitKind, FruitLook},
    value::Tint,
};

/// Keeps the places and numbers of flowers apart from those of leaves and fruits.
pub const FLOWER_SALT: u32 = 0x1f3d;
/// The same for fruits.
pub const FRUIT_SALT: u32 = 0x6b21;
/// Wood with a greater radius than this, in internodes, bears nothing.
pub const THICKEST_BEARING: f32 = 0.6;

/// What flowers show that a metamer is given (`LF5`) where the look has none.
pub const GIVEN_FLOWER: FlowerKind = FlowerKind::Rosette;
/// The same of fruits.
pub const GIVEN_FRUIT: FruitKind = FruitKind::Round;

impl FlowerLook {
    /// The look of a plant of which metamers are given flowers: where it has none, these alone are shown.
    pub fn with_given(self) -> Self {
        let is_none = self.kind == FlowerKind::None;
        if is_none { Self { kind: GIVEN_FLOWER, share: 0.0, ..self } } else { self }
    }
}

impl FruitLook {
    /// The look of a plant of which metamers are given fruits: where it has none, these alone are shown.
    pub fn with_given(self) -> Self {
        let is_none = self.kind == FruitKind::None;
        if is_none { Self { kind: GIVEN_FRUIT, share: 0.0, ..self } } else { self }
    }
}

/// What stands to reason of a kind of flower or fruit. Lengths are in its own.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, TS)]
pub struct OrnamentNature {
    /// How many there are at a place.
    pub together: u8,
    /// Half of its width.
    pub reach: f32,
    /// Whether it hangs (-1), stands as a leaf does (0) or upright (1), or anything between.
    pub hang: f32,
    /// How far it turns its face to the eye, 0 to 1; below 0 for a disc that looks where a leaf points.
    pub turn: f32,
    /// Its stalk.
    pub stalk: f32,
    /// How much it shines.
    pub gloss: f32,
    /// Its second colour in sRGB.
    pub second: Tint,
}

impl FlowerKind {
    /// What this kind is by nature; nothing of no flower.
    pub fn nature(self) -> Option<OrnamentNature> {
        Some(match self {
            Self::None => return None,
            Self::Rosette => OrnamentNature {
                together: 7,
                reach: 0.5,
                hang: 0.35,
                turn: -1.0,
                stalk: 0.55,
                gloss: 0.3,
                second: [214, 170, 72],
            },
            Self::Catkin => OrnamentNature {
                together: 2,
                reach: 0.11,
                hang: -1.0,
                turn: 0.25,
                stalk: 0.0,
                gloss: 0.0,
                second: [226, 206, 120],
            },
            Self::Panicle => OrnamentNature {
                together: 1,
                reach: 0.27,
                hang: 0.85,
                turn: 0.25,
                stalk: 0.0,
                gloss: 0.2,
                second: [222, 150, 90],
            },
        })
    }
}

impl FruitKind {
    /// What this kind is by nature; nothing of no fruit. All hang.
    pub fn nature(self) -> Option<OrnamentNature> {
        Some(match self {
            Self::None => return None,
            Self::Round => OrnamentNature {
                together: 1,
                reach: 0.5,
                hang: -0.95,
                turn: 0.9,
                stalk: 0.0,
                gloss: 2.4,
                second: [206, 170, 70],
            },
            Self::Cone => OrnamentNature {
                together: 1,
                reach: 0.27,
                hang: -0.75,
                turn: 0.4,
                stalk: 0.0,
                gloss: 0.3,
                second: [184, 140, 92],
            },
            Self::Nut => OrnamentNature {
                together: 2,
                reach: 0.33,
                hang: -0.8,
                turn: 0.5,
                stalk: 0.0,
                gloss: 1.4,
                second: [150, 134, 96],
            },
            Self::Winged => OrnamentNature {
                together: 2,
                reach: 0.5,
                hang: -0.9,
                turn: 0.35,
                stalk: 0.0,
                gloss: 0.5,
                second: [196, 172, 120],
            },
        })
    }
}
