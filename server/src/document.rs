//! What the shell does with whole documents: makes files of them.

use espalier_export::{
    About, ExportError,
    picture::{self, Look},
};
use espalier_growth::{SIMULATION_VERSION, species::Species};
use espalier_mesh::Style;
use espalier_session::{Document, DocumentError, style_options};

/// Pixels of a picture across and down.
const PICTURE: (usize, usize) = (1000, 1000);
/// What writes files, as they name it.
const PROGRAM: &str = concat!("Espalier ", env!("CARGO_PKG_VERSION"));

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

/// What is known of a document's plants beyond the document.
#[derive(Clone, Copy, Debug, Default)]
pub struct Provenance<'a> {
    /// The species whose schedule grew them.
    pub species: Option<&'static Species>,
    /// The seed of all randomness.
    pub seed: Option<u32>,
    /// Who made them.
    pub author: Option<&'a str>,
    /// Under which licence they may be used.
    pub licence: Option<&'a str>,
}

/// The plants of a stored document in a file format.
pub fn export(bytes: &[u8], format: Format) -> Result<Vec<u8>, FileError> {
    Ok(file(&mut Document::from_bytes(bytes)?, Provenance::default(), format)?)
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

/// The plants of a document in a file format, in a picture on their species' stand.
pub fn file(document: &mut Document, from: Provenance<'_>, format: Format) -> Result<Vec<u8>, ExportError> {
    let (parameters, appearance) = (document.parameters(), *document.appearance());
    let style = Style::new(style_options(&parameters));
    match format {
        Format::Glb => {
            let Provenance { species, seed, author, licence } = from;
            let (simulation, species) = (SIMULATION_VERSION, species.map(|species| species.name));
            let about = About {
                program: PROGRAM,
                simulation,
                species,
                seed,
                parameters: &parameters,
                author,
                licence,
            };
            espalier_export::glb(document.portrait(), &style, &appearance, &about)
        }
        Format::Skeleton => Ok(espalier_export::skeleton_json(document.portrait(), &style)),
        Format::Picture => {
            let stand = from.species.map(|species| species.stand).unwrap_or_default();
            let look = Look { appearance, stand };
            Ok(picture::draw(document.portrait(), &style, &look, PICTURE.0, PICTURE.1).png())
        }
    }
}
