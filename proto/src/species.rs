//! Species as a picker offers them.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

use crate::parameters::Parameters;

/// Forms of leaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum LeafKind {
    /// Egg-shaped.
    Ovate,
    /// Nearly as broad as long, on a long stalk.
    Round,
    /// Long and narrow.
    Lanceolate,
    /// With round lobes.
    Lobed,
    /// Like a hand.
    Palmate,
    /// A fan.
    Fan,
    /// Many leaflets on one stalk.
    Compound,
    /// Tufts of needles.
    Needle,
    /// Scales that hide the twig.
    Scale,
    /// Flowers before the leaves.
    Blossom,
}

/// Patterns of bark.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum BarkKind {
    /// Plain.
    Smooth,
    /// With furrows along the stem.
    Furrowed,
    /// In plates, and red where it peels above.
    Plated,
    /// White with black marks.
    Papery,
    /// In patches of many colours.
    Flaking,
    /// With bands around the stem.
    Banded,
    /// In fine strips.
    Stringy,
}

/// Round fruit among the leaves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Fruit {
    /// Red, green and blue in sRGB.
    pub tint: [u8; 3],
    /// Diameter in internodes.
    pub size: f32,
    /// Fruits to a leaf.
    pub share: f32,
}

/// A set of parameters with a name, from `GET /api/species`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Species {
    /// Its short name, as the command line takes it.
    pub slug: String,
    /// Its name.
    pub name: String,
    /// Its botanical name, or that of the style.
    pub botanical: String,
    /// What tells it from others, in one sentence.
    pub sentence: String,
    /// What its leaves look like.
    pub leaf: LeafKind,
    /// Colour of the leaves: red, green and blue in sRGB.
    pub leaf_tint: [u8; 3],
    /// The fruit it bears, if any is to be seen.
    pub fruit: Option<Fruit>,
    /// What its bark looks like.
    pub bark: BarkKind,
    /// Colour of the bark: red, green and blue in sRGB.
    pub bark_tint: [u8; 3],
    /// What `set_parameters` is given when it is picked.
    pub parameters: Parameters,
}
