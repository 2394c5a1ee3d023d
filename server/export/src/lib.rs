//! File formats out. Documented in `docs/formats.md`.

mod colour;
mod foliage;
pub mod glb;
mod gltf;
mod painted;
pub mod picture;
mod png;
pub mod skeleton;
mod surface;

pub use glb::{About, ExportError, glb};
pub use skeleton::skeleton_json;
