//! A small flat tree that shows what parameters do.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// The answer to `POST /api/v1/schematic`: a tree that grew in a plane, metamer by metamer in birth order (`SC1`).
///
/// All lists but `segments` have one entry for each metamer.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct Schematic {
    /// Four numbers for each metamer, in internode lengths: x and y of where it begins, x and y of where it ends.
    /// The trunk begins at (0, 0), y points up.
    pub segments: Vec<f32>,
    /// The metamer it grows from, by its place in these lists; -1 for the first of the trunk. Never a later one.
    pub parents: Vec<i32>,
    /// Radius at its end, in internode lengths.
    pub radii: Vec<f32>,
    /// 0 for the trunk, 1 for its branches, 2 for theirs.
    pub orders: Vec<u32>,
    /// Vigor of the shoot, 0 (weak) to 1.
    pub vigor: Vec<f32>,
    /// Light it receives, 0 (dark) to 1.
    pub light: Vec<f32>,
    /// How many leaves it bears.
    pub leaves: Vec<u32>,
    /// The step in which it was born, 1 and up.
    pub born: Vec<u32>,
}
