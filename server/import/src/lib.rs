//! File formats in: glTF 2.0 meshes as obstacles.
//!
//! Only what an obstacle needs is read: triangles, where the nodes of the scene put them. Any bytes at all give
//! a mesh or an error, so files from outside are safe to try.

mod accessor;
mod container;
mod document;
mod scene;

use espalier_growth::{ObstacleError, TriangleMesh};

/// Bytes a file may have.
pub const MAX_BYTES: usize = 64 << 20;

/// Bytes are not a mesh that can be an obstacle.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ImportError {
    /// Larger than [`MAX_BYTES`].
    #[error("the file has {0} bytes; at most 67108864 are allowed")]
    TooLarge(usize),
    /// Neither GLB nor the JSON of a glTF file.
    #[error("this is not a glTF file: {0}")]
    NotGltf(String),
    /// Another version of glTF.
    #[error("the file is glTF {0}; version 2 is read")]
    Version(String),
    /// Its geometry lies in other files.
    #[error("the buffer {0} lies in another file; save as GLB or with embedded buffers")]
    ExternalBuffer(usize),
    /// Its geometry is compressed.
    #[error("the mesh is compressed ({0}); save it without compression")]
    Compressed(String),
    /// Something else that is not read.
    #[error("the file needs {0}, which is not read")]
    Unsupported(String),
    /// Parts contradict each other.
    #[error("the file is damaged: {0}")]
    Damaged(String),
    /// The scale is not a positive number.
    #[error("the scale is {0}; it must be greater than 0")]
    Scale(f32),
    /// The mesh cannot be an obstacle.
    #[error(transparent)]
    Mesh(#[from] ObstacleError),
}

/// Reads a glTF file, GLB or JSON with embedded buffers: all triangles of its scene, as one mesh. `scale` is the
/// internodes to a unit of the file, which is a metre.
pub fn obstacle_mesh(bytes: &[u8], scale: f32) -> Result<TriangleMesh, ImportError> {
    if bytes.len() > MAX_BYTES {
        return Err(ImportError::TooLarge(bytes.len()));
    }
    if !(scale.is_finite() && scale > 0.0) {
        return Err(ImportError::Scale(scale));
    }
    let file = container::open(bytes)?;
    let (mut vertices, triangles) = scene::triangles(&file)?;
    for vertex in &mut vertices {
        *vertex *= scale;
    }
    Ok(TriangleMesh::new(vertices, triangles)?)
}

fn damaged(problem: impl Into<String>) -> ImportError {
    ImportError::Damaged(problem.into())
}
