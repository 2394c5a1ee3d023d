//! File formats out. Documented in `docs/formats.md`.

mod about;
mod assembly;
mod billboard;
mod colour;
mod error;
mod foliage;
pub mod glb;
mod gltf;
mod hull;
mod lightmap;
mod mean_materials;
mod model;
pub mod mtg;
mod obj;
mod painted;
pub mod picture;
pub mod ply;
mod png;
pub mod qsm;
mod sink;
pub mod skeleton;
mod structure;
mod surface;
mod usd;
mod zip;

pub use about::About;
pub use error::ExportError;
pub use glb::glb;
pub use model::{Detail, Model};
pub use mtg::mtg;
pub use obj::obj;
pub use ply::{Sampling, ply};
pub use qsm::qsm_csv;
pub use sink::{Sink, in_memory};
pub use skeleton::{Origin, skeleton_json};
pub use usd::{usda, usdz};
