//! How flowers and fruits stand on a tree: for every client and every export.

use crate::looks::{FlowerKind, FruitKind};

/// Keeps the places and numbers of flowers apart from those of leaves and fruits.
pub const FLOWER_SALT: u32 = 0x1f3d;
/// The same for fruits.
pub const FRUIT_SALT: u32 = 0x6b21;
/// Wood with a greater radius than this, in internodes, bears nothing.
pub const THICKEST_BEARING: f32 = 0.6;

impl FlowerKind {
    /// How many stand at a place.
    pub fn together(self) -> u8 {
        match self {
            Self::None => 0,
            Self::Rosette => 7,
            Self::Catkin => 2,
            Self::Panicle => 1,
        }
    }
}

impl FruitKind {
    /// How many hang at a place.
    pub fn together(self) -> u8 {
        match self {
            Self::None => 0,
            Self::Round | Self::Cone => 1,
            Self::Nut | Self::Winged => 2,
        }
    }
}
