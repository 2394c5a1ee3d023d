//! File formats out. Documented in `docs/formats.md`.

pub mod glb;
mod gltf;
pub mod picture;
pub mod skeleton;

pub use glb::{ExportError, glb};
pub use skeleton::skeleton_json;
