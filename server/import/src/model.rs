//! The triangles of model files, glTF 2.0 and OBJ.
//!
//! A file is read in pieces, in the order in which its parts are needed. What is held of it at any time is its JSON, the
//! vertices of one part, and the triangles so far; the limits bound all three, and how often parts may repeat.

mod accessor;
mod budget;
mod components;
mod container;
mod document;
mod instances;
mod levels;
mod obj;
mod packed;
mod polygon;
mod scene;
mod simplify;
mod source;
mod weld;

use std::io::{Read, Seek};

use glam::Vec3;

use self::{budget::Budget, source::Source};

/// How much of a file is read, and how much of that is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Different places of corners that are kept.
    pub vertices: usize,
    /// Triangles that are kept; a file with more is simplified.
    pub triangles: usize,
    /// Triangles that are read; a file with more is refused.
    pub most_triangles: usize,
}

/// Triangles in metres. Corners at the very same place are one vertex, and none is left over.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangles {
    /// Places of the corners.
    pub vertices: Vec<Vec3>,
    /// The corners of each triangle, counter-clockwise from outside, as numbers of vertices.
    pub corners: Vec<[u32; 3]>,
}

/// How much a file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Different places of corners.
    pub vertices: usize,
    /// Triangles.
    pub triangles: usize,
}

/// What was read of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// What is kept, within the limits.
    pub triangles: Triangles,
    /// How much the file holds, where that is more than is kept.
    pub simplified_from: Option<Size>,
}

/// Bytes are not a model that can be read; each message ends a sentence.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ImportError {
    /// Neither glTF nor OBJ.
    #[error("it is neither glTF nor OBJ ({0})")]
    NotModel(String),
    /// Its JSON is none, or not that of glTF.
    #[error("it is not a glTF file ({0})")]
    NotGltf(String),
    /// Another version of glTF.
    #[error("it is glTF {0}, and version 2 is read")]
    Version(String),
    /// Its geometry lies in other files.
    #[error("its buffer {0} lies in another file; export it as one .glb")]
    ExternalBuffer(usize),
    /// Something that is not read: sparse geometry, another compression, or what a future may bring.
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
    /// A line of an OBJ file is not what the format allows.
    #[error("line {line}: {what}; allowed: {allowed}")]
    Line {
        /// Which, counted from 1.
        line: u64,
        /// What is wrong with it.
        what: String,
        /// What is allowed there.
        allowed: String,
    },
    /// Points or lines alone, or nothing.
    #[error("it shows no triangles")]
    Empty,
    /// More than is read.
    #[error("it has more than {} triangles, or repeats its parts too often; simplify it first", .0.most_triangles)]
    TooLarge(Limits),
    /// NaN or infinite.
    #[error("a vertex is not at a finite place")]
    NotFinite,
    /// Its bytes cannot be got.
    #[error("its bytes cannot be read: {0}")]
    Unread(String),
}

/// Reads a model: glTF 2.0 as GLB or as JSON with embedded buffers, or OBJ. All triangles that it shows become one mesh,
/// simplified where there are more than the limits keep.
///
/// # Errors
/// Where it is none of these, is damaged, needs what is not read, or has more than is read.
pub fn read_model(file: &mut (impl Read + Seek), limits: &Limits) -> Result<Model, ImportError> {
    let mut source = Source::open(file)?;
    let mut budget = Budget::new(limits);
    let found = match container::kind(&mut source)? {
        container::Kind::Gltf => scene::triangles(container::open(source)?, &mut budget)?,
        container::Kind::Text => obj::triangles(source, &mut budget)?,
    };
    let found = found.weld();
    if found.corners.is_empty() {
        return Err(ImportError::Empty);
    }
    let size = Size { vertices: found.vertices.len(), triangles: found.corners.len() };
    if size.vertices <= limits.vertices && size.triangles <= limits.triangles {
        return Ok(Model { triangles: found, simplified_from: None });
    }
    Ok(Model { triangles: simplify::simplified(found, limits)?, simplified_from: Some(size) })
}

fn damaged(problem: impl Into<String>) -> ImportError {
    ImportError::Damaged(problem.into())
}
