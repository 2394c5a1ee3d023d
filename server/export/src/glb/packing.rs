//! Vertices and triangles compressed by meshoptimizer (`EXT_meshopt_compression`).

use super::ExportError;

/// The extension's name.
pub(super) const EXTENSION: &str = "EXT_meshopt_compression";

/// Vertices of so many bytes each.
#[cfg(feature = "meshopt")]
pub(super) fn vertices(bytes: &[u8], stride: usize) -> Result<Vec<u8>, ExportError> {
    /// The effort that the encoder takes if not told otherwise.
    const LEVEL: i32 = 2;
    /// Readers of the extension know no later one.
    const VERSION: i32 = 0;
    fn packed<const STRIDE: usize>(bytes: &[u8]) -> Option<Vec<u8>> {
        let vertices: &[[u8; STRIDE]] = bytes.as_chunks().0;
        meshopt::encode_vertex_buffer_level(vertices, LEVEL, Some(VERSION)).ok()
    }
    let packed = match stride {
        24 => packed::<24>(bytes),
        28 => packed::<28>(bytes),
        32 => packed::<32>(bytes),
        36 => packed::<36>(bytes),
        40 => packed::<40>(bytes),
        44 => packed::<44>(bytes),
        48 => packed::<48>(bytes),
        52 => packed::<52>(bytes),
        60 => packed::<60>(bytes),
        64 => packed::<64>(bytes),
        68 => packed::<68>(bytes),
        72 => packed::<72>(bytes),
        76 => packed::<76>(bytes),
        80 => packed::<80>(bytes),
        88 => packed::<88>(bytes),
        _ => None,
    };
    packed.ok_or(ExportError::NoCompression)
}

/// Triangles of so many vertices.
#[cfg(feature = "meshopt")]
pub(super) fn triangles(indices: &[u32], vertices: usize) -> Result<Vec<u8>, ExportError> {
    meshopt::encode_index_buffer(indices, vertices).map_err(|_| ExportError::NoCompression)
}

#[cfg(not(feature = "meshopt"))]
pub(super) fn vertices(_: &[u8], _: usize) -> Result<Vec<u8>, ExportError> {
    Err(ExportError::NoCompression)
}

#[cfg(not(feature = "meshopt"))]
pub(super) fn triangles(_: &[u32], _: usize) -> Result<Vec<u8>, ExportError> {
    Err(ExportError::NoCompression)
}
