//! File formats in: the triangles of glTF 2.0 and OBJ files, and wood from files of structure.
//!
//! Of models only what an obstacle needs is read: triangles, where the nodes of the scene put them. Any bytes at all give
//! a mesh, wood or an error, and the work is bounded by the limits and the file's size, so files from outside are safe
//! to try.

mod model;
mod wood;

pub use self::{
    model::{ImportError, Limits, Model, Size, Triangles, read_model},
    wood::{Fault, FaultKind, Place, Units, WoodFile, WoodFormat, WoodNote, WoodOptions, read_wood},
};
