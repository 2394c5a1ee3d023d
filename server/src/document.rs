//! What the shell does with whole documents: makes files of them.

use espalier_export::{
    About, ExportError, Origin, Sampling,
    picture::{self, Look},
};
use espalier_growth::{
    SIMULATION_VERSION,
    species::{self, Species, Stage},
};
use espalier_mesh::Style;
use espalier_session::{Document, DocumentError, style_options};
use espalier_settings::{Appearance, ParameterValues};

/// Pixels of a picture across and down.
const PICTURE: (usize, usize) = (1000, 1000);
/// What writes files, as they name it.
const PROGRAM: &str = concat!("Espalier ", env!("CARGO_PKG_VERSION"));
/// Points of a cloud: some two thousand a square metre of a grown tree.
const POINTS: u32 = 1_000_000;

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
    /// A multiscale tree graph.
    Mtg,
    /// Cylinders as comma-separated values.
    Qsm,
    /// A point cloud with labels.
    Cloud,
    /// A picture as PNG.
    Picture,
    /// The whole document.
    Document,
}

/// Each format, how the names of its files end, and what is in them.
pub const FORMATS: &[(Format, &str, &str)] = &[
    (Format::Glb, "glb", "triangles"),
    (Format::Skeleton, "json", "skeleton"),
    (Format::Mtg, "mtg", "axes and metamers for OpenAlea"),
    (Format::Qsm, "csv", "cylinders as TreeQSM has them"),
    (Format::Cloud, "ply", "labelled points"),
    (Format::Picture, "png", "picture"),
    (Format::Document, "espalier", "document"),
];

/// The plants of a document in a file format, in a picture on their species' stand.
pub fn file(document: &mut Document, from: Provenance<'_>, format: Format) -> Result<Vec<u8>, ExportError> {
    let (parameters, appearance) = (document.parameters(), *document.appearance());
    let style = Style::new(style_options(&parameters));
    let (seed, metres) = (document.seed(), parameters.internode_length);
    let species = from.species.or_else(|| species_of(&parameters, &appearance));
    match format {
        Format::Glb => {
            let about = About {
                program: PROGRAM,
                simulation: SIMULATION_VERSION,
                species: species.map(|species| species.name),
                seed: Some(seed),
                parameters: &parameters,
                author: from.author,
                licence: from.licence,
            };
            espalier_export::glb(document.portrait(), &style, &appearance, &about)
        }
        Format::Skeleton => {
            let species = species.map(|species| species.slug);
            let origin = Origin { species, seed, parameters: &parameters, looks: &appearance };
            espalier_export::skeleton_json(document.portrait(), &style, &origin)
        }
        Format::Mtg => espalier_export::mtg(document.plant(), &style, metres),
        Format::Qsm => espalier_export::qsm_csv(document.plant(), &style, metres),
        Format::Cloud => {
            let sampling = Sampling { points: POINTS, seed };
            espalier_export::ply(document.portrait(), &style, &appearance, metres, sampling)
        }
        Format::Document => Ok(document.to_saved_bytes()),
        Format::Picture => {
            let stand = species.map(|species| species.stand).unwrap_or_default();
            let look = Look { appearance, stand };
            Ok(picture::draw(document.portrait(), &style, &look, PICTURE.0, PICTURE.1).png())
        }
    }
}

/// The species that grows by these parameters at some stage of its life and looks like this; none where somebody has
/// changed them, or where several do.
fn species_of(parameters: &ParameterValues, looks: &Appearance) -> Option<&'static Species> {
    let changes_to = |stage: &Stage| matches!(stage, Stage::Change(values) if **values == *parameters);
    let is_it = |species: &&Species| {
        let grows_so = species.parameters == *parameters || species.schedule.iter().any(changes_to);
        // What surrounds it is nobody's.
        grows_so && Appearance { background: looks.background, ..species.appearance } == *looks
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
