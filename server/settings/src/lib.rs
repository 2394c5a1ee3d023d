//! What can be set: one table each for the parameters of growth ([`parameters`]) and for looks ([`looks`]).
//!
//! A row of a table holds everything that is known of a setting: name, type, default, range, step, symbol, unit,
//! group, and one sentence. From the rows come the struct of values, the patch that changes some of them, the checks,
//! the texts of errors, JSON, the TypeScript types and tables, and the tables of `PROTOCOL.md`.
//! Reading JSON checks types; ranges are checked by `check`, so that what is out of range has an error of its own.

mod appearance;
mod bark_nature;
mod choice;
mod leaf_nature;
pub mod looks;
mod ornament_nature;
pub mod parameters;
mod schema;
mod setting;
mod table;
mod value;

pub use appearance::{Appearance, AppearancePatch};
pub use bark_nature::{BARK_BEGINS, BARK_SQUARES, BarkNature, LIMB_ENDS, Mixture, THINNEST_BARK};
pub use leaf_nature::{Change, Course, LeafNature};
pub use looks::{
    Background, BackgroundPatch, BarkKind, BarkLook, BarkPatch, FlowerKind, FlowerLook, FlowerPatch,
    FruitKind, FruitLook, FruitPatch, Ground, LeafKind, LeafLook, LeafPatch, Place, Sky, WindLook, WindPatch,
};
pub use ornament_nature::{
    FLOWER_SALT, FRUIT_SALT, GIVEN_FLOWER, GIVEN_FRUIT, OrnamentNature, THICKEST_BEARING,
};
pub use parameters::{ParameterValues, ParametersPatch, VigorModel};
pub use setting::{Kind, OutOfRange, Setting, Unit};
pub use value::{Tint, Value};
