//! File formats in: the triangles of glTF 2.0 files, and wood from files of structure.
//!
//! Of glTF only what an obstacle needs is read: triangles, where the nodes of the scene put them. Any bytes at all give
//! a mesh, wood or an error, and the work is bounded by the limits and the file's size, so files from outside are safe
//! to try.

mod accessor;
mod container;
mod document;
mod scene;
mod wood;

use glam::Vec3;

pub use self::wood::{Fault, FaultKind, Place, WoodFile, WoodFormat, WoodOptions, read_wood};

/// The most a file may hold; more is refused before it is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Different places of corners.
    pub vertices: usize,
    /// Triangles.
    pub triangles: usize,
}

/// The triangles of a scene, in metres. Corners at the very same place are one vertex, and none is left over.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangles {
    /// Places of the corners.
    pub vertices: Vec<Vec3>,
    /// The corners of each triangle, counter-clockwise from outside, as numbers of vertices.
    pub corners: Vec<[u32; 3]>,
}

/// Bytes are not a mesh that can be read; each message ends a sentence.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ImportError {
    /// Neither GLB nor the JSON of a glTF file.
    #[error("it is not a glTF file ({0})")]
    NotGltf(String),
    /// Another version of glTF.
    #[error("it is glTF {0}, and version 2 is read")]
    Version(String),
    /// Its geometry lies in other files.
    #[error("its buffer {0} lies in another file; export it as one .glb")]
    ExternalBuffer(usize),
    /// Something that is not read: compressed, quantised or sparse geometry, or what a future may bring.
    #[error("it needs {0}, which is not read; export it without")]
    Unsupported(String),
    /// Parts contradict each other.
    #[error("it is damaged: {0}")]
    Damaged(String),
    /// A member of its JSON is not what the format allows there.
    #[error("{field} {what}; allowed: {allowed}")]
    Member {
        /// Which: `nodes[0].children`.
        field: String,
        /// What is wrong with it, as what is said of it.
        what: String,
        /// What is allowed there.
        allowed: String,
    },
    /// Points or lines alone, or nothing.
    #[error("it shows no triangles")]
    Empty,
    /// Larger than the limits allow.
    #[error("it has more than {} triangles or {} vertices; simplify it first", .0.triangles, .0.vertices)]
    TooLarge(Limits),
    /// NaN or infinite.
    #[error("a vertex is not at a finite place")]
    NotFinite,
}

/// Reads a glTF file, GLB or JSON with embedded buffers: all triangles of its scene, as one mesh.
pub fn read(bytes: &[u8], limits: Limits) -> Result<Triangles, ImportError> {
    let triangles = scene::triangles(&container::open(bytes)?, limits)?;
    if triangles.corners.is_empty() { Err(ImportError::Empty) } else { Ok(triangles) }
}

fn damaged(problem: impl Into<String>) -> ImportError {
    ImportError::Damaged(problem.into())
}
