//! What the shell does with whole documents: makes files of them.

use espalier_export::{
    ExportError, Sink,
    picture::{self, Look},
};
use espalier_growth::species::{self, Species, Stage};
use espalier_proto::thumbnail::MAX_THUMBNAIL_BYTES;
use espalier_session::{Document, DocumentError, style_options};
use espalier_settings::{Appearance, ParameterValues};

use crate::{
    export_options::ExportOptions,
    formats::{self, Format, FormatRow},
    memory::Full,
};

/// Pixels of a thumbnail across and down: the first whose file is not too large to be kept.
const THUMBNAILS: [usize; 3] = [512, 384, 256];

/// A document cannot be made a file.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// The bytes are no document.
    #[error(transparent)]
    Document(#[from] DocumentError),
    /// The format cannot hold it.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// There is no memory left for it.
    #[error(transparent)]
    Memory(#[from] Full),
    /// The disk is full, or there is none.
    #[error(transparent)]
    Disk(#[from] std::io::Error),
}

impl FileError {
    /// What the disk said, if it was the disk.
    pub fn on_disk(&self) -> Option<std::io::ErrorKind> {
        match self {
            Self::Export(ExportError::Write(kind)) => Some(*kind),
            Self::Disk(error) => Some(error.kind()),
            _ => None,
        }
    }
}

/// A stored document that becomes a file.
#[derive(Debug)]
pub struct Stored(Document);

/// A picture of the plants of a document, as pages make them; the last one where all are too large to be kept.
pub fn thumbnail(document: &mut Document) -> Vec<u8> {
    let (parameters, appearance) = (document.parameters(), *document.appearance());
    let stand = species_of(&parameters, &appearance).map(|species| species.stand).unwrap_or_default();
    let style = document.style();
    let mut png = Vec::new();
    for side in THUMBNAILS {
        png = picture::draw(document.portrait(), &style, &Look { appearance, stand }, side, side).png();
        if png.len() <= MAX_THUMBNAIL_BYTES {
            break;
        }
    }
    png
}

impl Stored {
    /// # Errors
    /// Where the bytes are no document.
    pub fn read(bytes: &[u8]) -> Result<Self, DocumentError> {
        Ok(Self(Document::from_bytes(bytes)?))
    }

    /// Pictures of its plants from all around, side by side, as a PNG file; `between` is called before each.
    pub fn strip(&mut self, side: usize, frames: u16, between: impl FnMut()) -> Vec<u8> {
        let Self(document) = self;
        let (parameters, appearance) = (document.parameters(), *document.appearance());
        let species = species_of(&parameters, &appearance);
        let look = Look { appearance, stand: species.map(|species| species.stand).unwrap_or_default() };
        let style = document.style();
        picture::strip(document.portrait(), &style, &look, (side, frames), between).png()
    }

    /// A picture of it as pages make them.
    pub fn thumbnail(&mut self) -> Vec<u8> {
        thumbnail(&mut self.0)
    }

    /// About how many bytes its file has.
    pub fn expected(&self, row: &FormatRow, options: &ExportOptions) -> u64 {
        row.expected(self.0.metamers(), leaves_per_node(&self.0), options)
    }

    /// Bytes of memory that hold its file while it is made.
    pub fn held(&self, row: &FormatRow, options: &ExportOptions) -> u64 {
        row.held(self.0.metamers(), leaves_per_node(&self.0), options)
    }

    /// Writes its file.
    pub fn write(
        &mut self,
        format: Format,
        options: &ExportOptions,
        out: &mut dyn Sink,
    ) -> Result<(), ExportError> {
        formats::write(&mut self.0, None, format, options, out)
    }
}

/// How many leaves a node of a document has at most.
pub fn leaves_per_node(document: &Document) -> u32 {
    style_options(&document.parameters()).leaves_per_node.into()
}

/// The short name of the species that a document grows by, or which it looks and grows like.
pub fn species_in(document: &Document) -> Option<String> {
    let like = || species_of(&document.parameters(), document.appearance());
    document.species().or_else(|| like().map(|species| species.slug.to_owned()))
}

/// The species that grows by these parameters at some stage of its life and looks like this; none where somebody has
/// changed them, or where several do.
pub fn species_of(parameters: &ParameterValues, looks: &Appearance) -> Option<&'static Species> {
    let changes_to = |stage: &Stage| matches!(stage, Stage::Change(values) if **values == *parameters);
    let is_it = |species: &&Species| {
        let grows_so = species.parameters == *parameters || species.schedule.iter().any(changes_to);
        // Species differ in leaves, flowers, fruits and bark; the background and the wind are no part of one.
        grows_so && species.appearance.among(looks) == *looks
    };
    let mut found = species::all().iter().filter(is_it);
    found.next().filter(|_| found.next().is_none())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_species_is_known_by_its_parameters_and_looks() {
        let mut known = 0;
        for species in species::all() {
            let found = species_of(&species.parameters, &species.appearance);
            // Some differ in their lives alone.
            assert!(found.is_none_or(|found| found.slug == species.slug), "{}", species.slug);
            known += usize::from(found.is_some());
        }
        assert!(known > species::all().len() / 2, "{known}");
        let changed = ParameterValues { apical_control: 0.4321, ..ParameterValues::default() };
        assert_eq!(species_of(&changed, &Appearance::default()), None);
    }
}
