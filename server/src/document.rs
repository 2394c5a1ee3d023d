//! What the shell does with whole documents: makes files of them.

use espalier_export::{
    About, ExportError, Origin, Sampling, Sink,
    picture::{self, Look},
};
use espalier_growth::{
    SIMULATION_VERSION,
    species::{self, Species, Stage},
};
use espalier_mesh::Style;
use espalier_proto::library::ExportFormat;
use espalier_session::{Document, DocumentError, style_options};
use espalier_settings::{Appearance, ParameterValues};

use crate::export_options::{ExportOptions, Size, option};

/// Pixels of a picture across and down.
const PICTURE: Size = Size(1000, 1000);
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
    /// The disk is full, or there is none.
    #[error(transparent)]
    Disk(#[from] std::io::Error),
}

/// A file format for plants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// glTF binary.
    Glb,
    /// Wavefront OBJ with its materials and textures, in a ZIP file.
    Obj,
    /// USD as text.
    Usda,
    /// The same with its textures.
    Usdz,
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

/// What is known of a format.
#[derive(Debug)]
pub struct FormatRow {
    /// Which it is.
    pub format: Format,
    /// How the names of its files end.
    pub ending: &'static str,
    /// What is in them.
    pub what: &'static str,
    /// Their media type.
    pub media_type: &'static str,
    /// What can be asked for, as in [`option`].
    pub options: &'static [&'static str],
    /// About how many bytes a file has at least, and for each metamer and each leaf at the finest level.
    pub bytes: [f64; 3],
}

const fn row(
    format: Format,
    [ending, what, media_type]: [&'static str; 3],
    options: &'static [&'static str],
    bytes: [f64; 3],
) -> FormatRow {
    FormatRow { format, ending, what, media_type, options, bytes }
}

/// Every format.
pub const FORMATS: &[FormatRow] = &[
    row(
        Format::Glb,
        ["glb", "triangles", "model/gltf-binary"],
        &[
            option::LOD,
            option::QUANTISED,
            option::COMPRESSED,
            option::INSTANCED,
            option::HULL,
            option::BY_LIMB,
            option::AUTHOR,
            option::LICENCE,
        ],
        [600e3, 500.0, 400.0],
    ),
    row(
        Format::Obj,
        ["obj.zip", "triangles for any program", "application/zip"],
        option::MESHES,
        [600e3, 900.0, 700.0],
    ),
    row(Format::Usda, ["usda", "triangles as USD", "model/vnd.usda"], option::SCENES, [4e3, 900.0, 700.0]),
    row(
        Format::Usdz,
        ["usdz", "triangles as USD with textures", "model/vnd.usdz+zip"],
        option::SCENES,
        [600e3, 900.0, 700.0],
    ),
    row(Format::Skeleton, ["json", "skeleton", "application/json"], &[], [1e3, 160.0, 150.0]),
    row(Format::Mtg, ["mtg", "axes and metamers for OpenAlea", "text/plain"], &[], [1e3, 80.0, 0.0]),
    row(Format::Qsm, ["csv", "cylinders as TreeQSM has them", "text/csv"], &[], [1e3, 170.0, 0.0]),
    row(
        Format::Cloud,
        ["ply", "labelled points", "application/octet-stream"],
        &[option::POINTS],
        [29e6, 0.0, 0.0],
    ),
    row(
        Format::Picture,
        ["png", "picture", "image/png"],
        &[option::SIZE, option::TURN, option::RISE, option::FRAMES],
        [300e3, 0.0, 0.0],
    ),
    row(Format::Document, ["espalier", "document", "application/octet-stream"], &[], [10e3, 45.0, 0.0]),
];

/// Shares of the bytes of the finest level that each level of detail has, and all together.
const LEVELS: [f64; 4] = [1.0, 0.35, 0.1, 0.0];

/// The shares of the bytes for metamers and for leaves that options leave.
const SHARES: &[(&str, [f64; 2])] =
    &[(option::QUANTISED, [0.55, 0.5]), (option::COMPRESSED, [0.4, 0.3]), (option::INSTANCED, [1.0, 0.12])];

impl FormatRow {
    /// The row as clients read it.
    pub fn described(&self) -> ExportFormat {
        let [least, metamer, leaf] = self.bytes;
        ExportFormat {
            ending: self.ending.to_owned(),
            options: self.options.iter().map(|&option| option.to_owned()).collect(),
            bytes: [least, metamer, leaf],
            levels: LEVELS,
            shares: SHARES
                .iter()
                .filter(|(option, _)| self.options.contains(option))
                .map(|&(option, shares)| (option.to_owned(), shares))
                .collect(),
        }
    }
}

/// A stored document that becomes a file.
#[derive(Debug)]
pub struct Stored(Document);

impl Stored {
    /// # Errors
    /// Where the bytes are no document.
    pub fn read(bytes: &[u8]) -> Result<Self, DocumentError> {
        Ok(Self(Document::from_bytes(bytes)?))
    }

    /// About how many bytes its file has.
    pub fn expected(&self, row: &FormatRow, options: &ExportOptions) -> u64 {
        use espalier_export::Detail;
        let leaves = f64::from(style_options(&self.0.parameters()).leaves_per_node);
        let metamers = f64::from(self.0.metamers());
        let level = match options.model().detail {
            Detail::Set => LEVELS.iter().sum(),
            Detail::Level(level) => LEVELS[usize::from(level)],
        };
        let [least, metamer, leaf] = row.bytes;
        let given = options.given();
        let shares = SHARES.iter().filter(|(option, _)| given.contains(option));
        let [wood, foliage] = shares.fold([1.0, 1.0], |[a, b], (_, [c, d])| [a * c, b * d]);
        let least = least * f64::from(options.frames());
        (least + level * metamers * (metamer * wood + 0.5 * leaves * leaf * foliage)) as u64
    }

    /// Writes its file.
    pub fn write(
        &mut self,
        format: Format,
        options: &ExportOptions,
        out: &mut dyn Sink,
    ) -> Result<(), ExportError> {
        write(&mut self.0, None, format, options, out)
    }
}

/// Writes the plants of a document in a file format, in a picture on the stand of the species whose schedule grew them.
pub fn write(
    document: &mut Document,
    species: Option<&'static Species>,
    format: Format,
    options: &ExportOptions,
    out: &mut dyn Sink,
) -> Result<(), ExportError> {
    let (parameters, appearance) = (document.parameters(), *document.appearance());
    let style = Style::new(style_options(&parameters));
    let (seed, metres) = (document.seed(), parameters.internode_length);
    let species = species.or_else(|| species_of(&parameters, &appearance));
    let about = About {
        program: PROGRAM,
        simulation: SIMULATION_VERSION,
        species: species.map(|species| species.name),
        seed: Some(seed),
        parameters: &parameters,
        author: options.author.as_deref(),
        licence: options.licence.as_deref(),
    };
    let model = options.model();
    match format {
        Format::Glb => espalier_export::glb(document.portrait(), &style, &appearance, &about, &model, out),
        Format::Obj => espalier_export::obj(document.portrait(), &style, &appearance, &about, &model, out),
        Format::Usda => espalier_export::usda(document.portrait(), &style, &appearance, &about, &model, out),
        Format::Usdz => espalier_export::usdz(document.portrait(), &style, &appearance, &about, &model, out),
        Format::Skeleton => {
            let species = species.map(|species| species.slug);
            let origin = Origin { species, seed, parameters: &parameters, looks: &appearance };
            espalier_export::skeleton_json(document.portrait(), &style, &origin, out)
        }
        Format::Mtg => espalier_export::mtg(document.plant(), &style, metres, out),
        Format::Qsm => espalier_export::qsm_csv(document.plant(), &style, metres, out),
        Format::Cloud => {
            let sampling = Sampling { points: options.points(), seed };
            espalier_export::ply(document.portrait(), &style, &appearance, metres, sampling, out)
        }
        Format::Document => Ok(out.write_all(&document.to_saved_bytes())?),
        Format::Picture => {
            let stand = species.map(|species| species.stand).unwrap_or_default();
            let look = Look { appearance, stand };
            let Size(width, height) = options.size.unwrap_or(PICTURE);
            let frames = options.frames();
            picture::turntable(
                document.portrait(),
                &style,
                &look,
                [width, height],
                options.camera(),
                frames,
                out,
            )
        }
    }
}

/// The species that grows by these parameters at some stage of its life and looks like this; none where somebody has
/// changed them, or where several do.
fn species_of(parameters: &ParameterValues, looks: &Appearance) -> Option<&'static Species> {
    let changes_to = |stage: &Stage| matches!(stage, Stage::Change(values) if **values == *parameters);
    let is_it = |species: &&Species| {
        let grows_so = species.parameters == *parameters || species.schedule.iter().any(changes_to);
        // Species differ in leaves, flowers, fruits and bark; the background is no part of one.
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
