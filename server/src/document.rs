//! What the shell does with whole documents: makes files of them.

use espalier_export::{
    ExportError,
    picture::{self, Look},
};
use espalier_growth::species::Stand;
use espalier_mesh::Style;
use espalier_session::{Document, DocumentError, style_options};

/// Pixels of a picture across and down.
const PICTURE: (usize, usize) = (1000, 1000);

/// A document cannot be made a file.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// The bytes are no document.
    #[error(transparent)]
    Document(#[from] DocumentError),
    /// The format cannot hold it.
    #[error(transparent)]
    Export(#[from] ExportError),
}

/// The plants of a stored document as glTF binary.
pub fn glb(bytes: &[u8]) -> Result<Vec<u8>, FileError> {
    Ok(file(&mut Document::from_bytes(bytes)?, Stand::Ground, Format::Glb)?)
}

/// A file format for plants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// glTF binary.
    Glb,
    /// The skeleton as JSON.
    Skeleton,
    /// A picture as PNG.
    Picture,
}

/// Each format, how the names of its files end, and what is in them.
pub const FORMATS: &[(Format, &str, &str)] = &[
    (Format::Glb, "glb", "triangles"),
    (Format::Skeleton, "json", "skeleton"),
    (Format::Picture, "png", "picture"),
];

/// The plants of a document in a file format, in a picture on such a stand.
pub fn file(document: &mut Document, stand: Stand, format: Format) -> Result<Vec<u8>, ExportError> {
    let (parameters, appearance) = (document.parameters(), *document.appearance());
    let style = Style::new(style_options(&parameters));
    match format {
        Format::Glb => {
            espalier_export::glb(document.portrait(), &style, &appearance, parameters.internode_length)
        }
        Format::Skeleton => Ok(espalier_export::skeleton_json(document.portrait(), &style)),
        Format::Picture => {
            let look = Look { appearance, stand };
            Ok(picture::draw(document.portrait(), &style, &look, PICTURE.0, PICTURE.1).png())
        }
    }
}
