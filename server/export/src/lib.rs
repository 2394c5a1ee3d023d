//! File formats out. Documented in `docs/formats.md`.

mod colour;
mod foliage;
pub mod glb;
mod gltf;
pub mod mtg;
mod painted;
pub mod picture;
pub mod ply;
mod png;
pub mod qsm;
pub mod skeleton;
mod structure;
mod surface;

pub use glb::{About, ExportError, glb};
pub use mtg::mtg;
pub use ply::{Sampling, ply};
pub use qsm::qsm_csv;
pub use skeleton::{Origin, skeleton_json};
