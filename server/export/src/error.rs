//! Why a plant could not be exported.

use std::io::ErrorKind;

/// Why a plant could not be exported.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ExportError {
    /// Nothing can be that large or small.
    #[error("an internode cannot be {0} m long")]
    Scale(f32),
    /// The format counts bytes in 32 bits.
    #[error("the file would be larger than 4 GiB")]
    TooLarge,
    /// The plant is so large that a position in metres is infinite.
    #[error("the tree is too large to be measured in metres")]
    NotFinite,
    /// This program was built without the feature `meshopt`.
    #[error("this program cannot compress meshes")]
    NoCompression,
    /// The file takes no more bytes.
    #[error("the file cannot be written: {0}")]
    Write(ErrorKind),
}
