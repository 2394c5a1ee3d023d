//! File formats out: what is known of each, and what writes it.

use espalier_export::{
    About, Detail, ExportError, Origin, Sampling, Sink,
    picture::{self, Look},
};
use espalier_growth::{SIMULATION_VERSION, species::Species};
use espalier_proto::{library::ExportFormat, text::Name};
use espalier_session::Document;

use crate::{
    document::species_of,
    export_options::{ExportOptions, Size, option},
    memory,
};

/// A picture that nobody says more of: pixels across and down, and how many pictures a file has.
const STILL: (Size, u16) = (Size(1000, 1000), 1);
/// The same of a loop of sway.
const LOOP: (Size, u16) = (Size(480, 540), 80);
/// What writes files, as they name it.
const PROGRAM: &str = concat!("Espalier ", env!("CARGO_PKG_VERSION"));

/// A file format for plants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// glTF binary.
    Glb,
    /// Wavefront OBJ with its materials and textures, in a ZIP file.
    Obj,
    /// A model with textures of pivots, in a ZIP file.
    Pivots,
    /// USD as text.
    Usda,
    /// The same with its textures, in a ZIP file.
    UsdaZip,
    /// The same with its textures in one file.
    Usdz,
    /// The skeleton as JSON.
    Skeleton,
    /// A multiscale tree graph.
    Mtg,
    /// Cylinders as comma-separated values.
    Qsm,
    /// The joints by which trees sway, as comma-separated values.
    Joints,
    /// A point cloud with labels.
    Cloud,
    /// A picture as PNG.
    Picture,
    /// A loop of sway as an animated PNG.
    Sway,
    /// The whole document.
    Document,
}

impl Format {
    /// Whether its files are written from beginning to end, so that what is written stays as it is.
    pub fn is_forward(self) -> bool {
        !matches!(self, Self::Glb | Self::Obj | Self::Pivots | Self::UsdaZip | Self::Usdz)
    }

    /// How large its pictures are and how many a file has, where nobody says more; none where it has none.
    fn pictures(self) -> Option<(Size, u16)> {
        match self {
            Self::Picture => Some(STILL),
            Self::Sway => Some(LOOP),
            _ => None,
        }
    }
}

/// What is drawn where somebody may say more.
fn drawn((size, frames): (Size, u16), options: &ExportOptions) -> (Size, u16) {
    (options.size.unwrap_or(size), options.frames.map_or(frames, |frames| frames.0))
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
    /// What the page calls it, in English and German.
    pub label: [&'static str; 2],
    /// What the page says it is good for, in English and German.
    pub text: [&'static str; 2],
    /// What can be asked for, as in [`option`].
    pub options: &'static [&'static str],
    /// About how many bytes a file has at least, and for each metamer and each leaf at the finest level; measured, as
    /// `client/test/export-sizes.json` has it.
    pub bytes: [f64; 3],
}

impl FormatRow {
    /// What such a file of a document of so many bytes takes of memory while it is made.
    pub fn weight(&self, bytes: usize, options: &ExportOptions) -> u64 {
        match self.picture(options) {
            Some((Size(width, height), _)) => memory::picture(bytes, width * height),
            None => memory::export(bytes),
        }
    }

    /// Pixels of all its pictures together; 0 where it is none.
    pub fn pixels(&self, options: &ExportOptions) -> u64 {
        let pixels = |(Size(width, height), frames): (Size, u16)| (width * height) as u64 * u64::from(frames);
        self.picture(options).map_or(0, pixels)
    }

    /// How large a picture is, and how many of them one file has.
    fn picture(&self, options: &ExportOptions) -> Option<(Size, u16)> {
        self.format.pictures().map(|plain| drawn(plain, options))
    }
}

const fn row(
    format: Format,
    [ending, what, media_type]: [&'static str; 3],
    [label, text]: [[&'static str; 2]; 2],
    options: &'static [&'static str],
    bytes: [f64; 3],
) -> FormatRow {
    FormatRow { format, ending, what, media_type, label, text, options, bytes }
}

/// The project's own format.
pub const DOCUMENT: FormatRow = row(
    Format::Document,
    ["espalier", "document", "application/octet-stream"],
    [
        ["Document", "Dokument"],
        [
            "The whole tree with its history, to be opened in Espalier again.",
            "Der ganze Baum mit seiner Geschichte, um ihn wieder in Espalier zu öffnen.",
        ],
    ],
    &[],
    [60e3, 75.0, 0.0],
);

/// Every format.
pub const FORMATS: &[FormatRow] = &[
    row(
        Format::Glb,
        ["glb", "triangles", "model/gltf-binary"],
        [
            ["Model (glTF)", "Modell (glTF)"],
            [
                "Wood, leaves, flowers and fruits with their textures, in metres, for Blender, game engines and browsers.",
                "Holz, Blätter, Blüten und Früchte mit ihren Texturen, in Metern, für Blender, Spiele-Engines und Browser.",
            ],
        ],
        &[
            option::LOD,
            option::QUANTISED,
            option::COMPRESSED,
            option::INSTANCED,
            option::HULL,
            option::BY_LIMB,
            option::LIGHTMAP,
            option::SWAY,
            option::WIND_WEIGHTS,
            option::AUTHOR,
            option::LICENCE,
        ],
        [530e3, 1250.0, 787.0],
    ),
    row(
        Format::Obj,
        ["obj.zip", "triangles for any program", "application/zip"],
        [
            ["Model (OBJ)", "Modell (OBJ)"],
            [
                "The same triangles with materials and textures in a ZIP file, for programs that do not read glTF.",
                "Dieselben Dreiecke mit Materialien und Texturen in einer ZIP-Datei, für Programme, die kein glTF lesen.",
            ],
        ],
        option::MESHES,
        [600e3, 1250.0, 690.0],
    ),
    row(
        Format::Pivots,
        ["pivots.zip", "triangles with pivots for Unreal", "application/zip"],
        [
            ["Model with pivots (Unreal)", "Modell mit Drehpunkten (Unreal)"],
            [
                "A glTF model and the textures of Pivot Painter 2, by which Unreal sways each limb in a shader.",
                "Ein glTF-Modell und die Texturen von Pivot Painter 2, nach denen Unreal jeden Ast im Shader schwingt.",
            ],
        ],
        option::PIVOTS,
        [540e3, 1400.0, 880.0],
    ),
    row(
        Format::Usda,
        ["usda", "triangles as USD", "model/vnd.usda"],
        [
            ["Scene (USD, text)", "Szene (USD, Text)"],
            [
                "The same triangles as USD in text, each vertex with its colour and without textures.",
                "Dieselben Dreiecke als USD in Textform, jede Ecke mit ihrer Farbe und ohne Texturen.",
            ],
        ],
        option::SCENES,
        [4e3, 3300.0, 1800.0],
    ),
    row(
        Format::UsdaZip,
        ["usda.zip", "triangles as USD with textures beside it", "application/zip"],
        [
            ["Scene with textures (USD, text)", "Szene mit Texturen (USD, Text)"],
            [
                "USD in text and its textures as files of their own in a ZIP file, for programs that edit both.",
                "USD in Textform und seine Texturen als eigene Dateien in einer ZIP-Datei, für Programme, die beides bearbeiten.",
            ],
        ],
        option::SCENES,
        [600e3, 1200.0, 660.0],
    ),
    row(
        Format::Usdz,
        ["usdz", "triangles as USD with textures", "model/vnd.usdz+zip"],
        [
            ["Scene (USDZ)", "Szene (USDZ)"],
            [
                "USD with its textures in one file, which tablets and film programs show.",
                "USD mit seinen Texturen in einer Datei, die Tablets und Filmprogramme zeigen.",
            ],
        ],
        option::SCENES,
        [560e3, 3300.0, 1800.0],
    ),
    row(
        Format::Skeleton,
        ["json", "skeleton", "application/json"],
        [
            ["Skeleton (JSON)", "Skelett (JSON)"],
            [
                "Each internode with its place, thickness, order and birth, for programs of your own.",
                "Jedes Internodium mit Ort, Dicke, Ordnung und Geburt, für eigene Programme.",
            ],
        ],
        &[],
        [1e3, 200.0, 190.0],
    ),
    row(
        Format::Mtg,
        ["mtg", "axes and metamers for OpenAlea", "text/plain"],
        [
            ["Tree graph (MTG)", "Baumgraph (MTG)"],
            ["Axes and internodes for OpenAlea.", "Achsen und Internodien für OpenAlea."],
        ],
        &[],
        [1e3, 80.0, 0.0],
    ),
    row(
        Format::Qsm,
        ["csv", "cylinders as TreeQSM has them", "text/csv"],
        [
            ["Cylinders (QSM)", "Zylinder (QSM)"],
            [
                "Each internode as a cylinder, in the columns of TreeQSM.",
                "Jedes Internodium als Zylinder, in den Spalten von TreeQSM.",
            ],
        ],
        &[],
        [1e3, 140.0, 0.0],
    ),
    row(
        Format::Joints,
        ["joints.csv", "joints that sway", "text/csv"],
        [
            ["Joints (CSV)", "Gelenke (CSV)"],
            [
                "The limbs that sway in wind, each with its frequency, damping and compliance, for programs of your own.",
                "Die Äste, die im Wind schwingen, jeder mit Frequenz, Dämpfung und Nachgiebigkeit, für eigene Programme.",
            ],
        ],
        &[],
        [1e3, 25.0, 0.0],
    ),
    row(
        Format::Cloud,
        ["ply", "labelled points", "application/octet-stream"],
        [
            ["Point cloud (PLY)", "Punktwolke (PLY)"],
            [
                "Points of wood and leaves, each with what it lies on.",
                "Punkte auf Holz und Blättern, jeder mit dem, worauf er liegt.",
            ],
        ],
        &[option::POINTS],
        [29e6, 0.0, 0.0],
    ),
    row(
        Format::Picture,
        ["png", "picture", "image/png"],
        [
            ["Turntable (PNG)", "Drehbild (PNG)"],
            [
                "An animated picture that goes around the tree once, made by the server.",
                "Ein bewegtes Bild, das einmal um den Baum geht, vom Server gemacht.",
            ],
        ],
        option::PICTURES,
        [300e3, 0.0, 0.0],
    ),
    row(
        Format::Sway,
        ["sway.png", "moving picture of a tree in wind", "image/png"],
        [
            ["Sway (PNG)", "Schwingen (PNG)"],
            [
                "An animated picture of the tree in its wind that goes on without a seam, made by the server.",
                "Ein bewegtes Bild des Baums in seinem Wind, das ohne Naht weitergeht, vom Server gemacht.",
            ],
        ],
        option::PICTURES,
        [270e3, 0.0, 0.0],
    ),
    DOCUMENT,
];

/// Shares of the bytes of the finest level that each level of detail has.
const LEVELS: [f64; 4] = [1.0, 0.22, 0.036, 0.0022];
/// The same of text that is deflated, beside pictures of the same size at each level.
const PACKED_LEVELS: [f64; 4] = [1.0, 0.26, 0.07, 0.003];
/// The same of USD, which says more of each mesh.
const USD_LEVELS: [f64; 4] = [1.0, 0.22, 0.048, 0.0008];

/// Bytes of the keys of a bone in glTF, where it has few, and in USD.
const BONE: f64 = 4e3;
const USD_BONE: f64 = 17e3;

/// The shares of the bytes for metamers and for leaves that options leave.
const SHARES: &[(&str, [f64; 2])] = &[
    (option::QUANTISED, [0.58, 0.58]),
    (option::COMPRESSED, [0.5, 0.5]),
    (option::INSTANCED, [1.0, 0.08]),
    (option::LIGHTMAP, [1.12, 1.12]),
    (option::SWAY, [1.23, 1.23]),
    (option::WIND_WEIGHTS, [1.25, 1.25]),
];

impl FormatRow {
    /// How the names of files of each format end.
    pub fn endings() -> impl Iterator<Item = &'static str> {
        FORMATS.iter().map(|row| row.ending)
    }

    /// Whether its files are text, for people to read.
    pub fn is_text(&self) -> bool {
        matches!(self.format, Format::Usda | Format::Skeleton | Format::Mtg | Format::Qsm | Format::Joints)
    }

    fn levels(&self) -> [f64; 4] {
        match self.format {
            Format::Obj | Format::UsdaZip => PACKED_LEVELS,
            Format::Usda | Format::Usdz => USD_LEVELS,
            _ => LEVELS,
        }
    }

    fn bone(&self) -> f64 {
        match self.format {
            Format::Usda | Format::UsdaZip | Format::Usdz => USD_BONE,
            _ => BONE,
        }
    }

    /// About how many bytes a file has of so many metamers with so many leaves each.
    pub fn expected(&self, metamers: u32, leaves: u32, options: &ExportOptions) -> u64 {
        let level = match options.model().detail {
            Detail::Set => self.levels().iter().sum(),
            Detail::Level(level) => self.levels()[usize::from(level)],
        };
        let [least, metamer, leaf] = self.bytes;
        let given = options.given();
        let shares = SHARES.iter().filter(|(option, _)| given.contains(option));
        let [wood, foliage] = shares.fold([1.0, 1.0], |[a, b], (_, [c, d])| [a * c, b * d]);
        let bones = options.model().sway.unwrap_or_default();
        let pixels = |(Size(width, height), frames): (Size, u16)| (width * height) as f64 * f64::from(frames);
        let drawn = match (self.picture(options), self.format.pictures()) {
            (Some(wanted), Some((size, _))) => pixels(wanted) / pixels((size, 1)),
            _ => 1.0,
        };
        let points = f64::from(options.points()) / f64::from(ExportOptions::default().points());
        let least = least * drawn * points + self.bone() * f64::from(bones);
        let leaves = 0.5 * f64::from(leaves) * leaf * foliage;
        (least + level * f64::from(metamers) * (metamer * wood + leaves)) as u64
    }

    /// Bytes of memory that hold such a file while it is made, where it does not go to the disk as it comes.
    pub fn held(&self, metamers: u32, leaves: u32, options: &ExportOptions) -> u64 {
        let is_held = self.format == Format::Pivots || options.model().compressed;
        if is_held { self.expected(metamers, leaves, options) * 3 / 2 } else { 0 }
    }

    /// The row as clients read it.
    pub fn described(&self) -> ExportFormat {
        let [least, metamer, leaf] = self.bytes;
        ExportFormat {
            ending: self.ending.to_owned(),
            label: self.label.map(str::to_owned),
            text: self.text.map(str::to_owned),
            options: self.options.iter().map(|&option| option.to_owned()).collect(),
            bytes: [least, metamer, leaf],
            levels: self.levels(),
            shares: SHARES
                .iter()
                .filter(|(option, _)| self.options.contains(option))
                .map(|&(option, shares)| (option.to_owned(), shares))
                .collect(),
        }
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
    let style = document.style();
    let (seed, metres) = (document.seed(), parameters.internode_length);
    let species = species.or_else(|| species_of(&parameters, &appearance));
    let obstacles = document.solids();
    let about = About {
        program: PROGRAM,
        simulation: SIMULATION_VERSION,
        species: species.map(|species| species.name),
        seed: Some(seed),
        parameters: &parameters,
        obstacles: &obstacles,
        author: options.author.as_ref().map(Name::as_str),
        licence: options.licence.as_ref().map(Name::as_str),
    };
    let slug = species.map(|species| species.slug);
    let origin = Origin { species: slug, seed, parameters: &parameters, looks: &appearance };
    let model = options.model();
    match format {
        Format::Glb => espalier_export::glb(document.portrait(), &style, &appearance, &about, &model, out),
        Format::Obj => espalier_export::obj(document.portrait(), &style, &appearance, &about, &model, out),
        Format::Pivots => {
            espalier_export::pivots(document.portrait(), &style, &appearance, &about, &model, out)
        }
        Format::Usda => espalier_export::usda(document.portrait(), &style, &appearance, &about, &model, out),
        Format::UsdaZip => {
            espalier_export::usda_zip(document.portrait(), &style, &appearance, &about, &model, out)
        }
        Format::Usdz => espalier_export::usdz(document.portrait(), &style, &appearance, &about, &model, out),
        Format::Skeleton => espalier_export::skeleton_json(document.portrait(), &style, &origin, out),
        Format::Mtg => espalier_export::mtg(document.plant(), &style, &origin, out),
        Format::Qsm => espalier_export::qsm_csv(document.plant(), &style, metres, out),
        Format::Joints => {
            espalier_export::joints_csv(document.portrait(), &style, &appearance, &obstacles, metres, out)
        }
        Format::Cloud => {
            let sampling = Sampling { points: options.points(), seed };
            espalier_export::ply(document.portrait(), &style, &appearance, metres, sampling, out)
        }
        Format::Document => Ok(out.write_all(&document.to_bytes_for_people())?),
        Format::Picture => {
            let stand = species.map(|species| species.stand).unwrap_or_default();
            let look = Look { appearance, stand };
            let (Size(width, height), frames) = drawn(STILL, options);
            picture::turntable(
                document.portrait(),
                &style,
                &look,
                [width, height],
                options.camera(metres),
                frames,
                out,
            )
        }
        Format::Sway => {
            let stand = species.map(|species| species.stand).unwrap_or_default();
            let look = Look { appearance, stand };
            let (Size(width, height), frames) = drawn(LOOP, options);
            let (plant, look, size) = (document.portrait(), (&look, metres, &obstacles[..]), [width, height]);
            picture::swaying(plant, &style, look, size, options.camera(metres), frames, out)
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io;

    use espalier_proto::Command;
    use espalier_session::Principal;

    use super::*;

    #[test]
    fn ex1_formats_have_a_name_of_their_own_and_a_sentence_in_both_languages() {
        for language in [0, 1] {
            let mut names: Vec<_> = FORMATS.iter().map(|row| row.label[language]).collect();
            names.sort_unstable();
            assert!(names.windows(2).all(|pair| pair[0] != pair[1] && !pair[0].is_empty()), "{names:?}");
            let is_sentence =
                |row: &FormatRow| row.text[language].len() > 20 && row.text[language].ends_with('.');
            assert!(FORMATS.iter().all(is_sentence));
        }
    }

    #[test]
    fn lm19_files_that_are_made_in_memory_take_no_more_than_is_counted() {
        let mut document = grown();
        let (metamers, leaves) = (document.metamers(), crate::document::leaves_per_node(&document));
        let packed = ExportOptions { compressed: true, ..ExportOptions::default() };
        let plain = ExportOptions::default();
        for (row, options, is_held) in FORMATS.iter().flat_map(|row| {
            let is_packed = row.options.contains(&option::COMPRESSED);
            let packed = is_packed.then_some((row, &packed, true));
            packed.into_iter().chain([(row, &plain, row.format == Format::Pivots)])
        }) {
            let held = row.held(metamers, leaves, options);
            assert_eq!(held > 0, is_held, "{}", row.ending);
            if is_held {
                let write = |out: &mut dyn Sink| write(&mut document, None, row.format, options, out);
                let file = espalier_export::in_memory(write).unwrap();
                assert!(file.len() as u64 <= held, "{}: {} of {held} bytes", row.ending, file.len());
            }
        }
    }

    /// A seedling of some steps.
    fn grown() -> Document {
        let mut document = Document::new(7);
        let begin: Command = serde_json::from_str(r#"{"kind":"grow","steps":4}"#).unwrap();
        document.begin(&Principal::visitor(), &begin).unwrap();
        while document.advance() {}
        document
    }

    /// A file that cannot go back.
    struct Forward(usize);

    impl io::Write for Forward {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.0 += bytes.len();
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    impl io::Seek for Forward {
        fn seek(&mut self, _: io::SeekFrom) -> io::Result<u64> {
            Err(io::ErrorKind::NotSeekable.into())
        }
    }

    #[test]
    fn ex2_files_that_are_sent_while_they_are_made_are_written_from_beginning_to_end() {
        let mut document = grown();
        let options = ExportOptions { size: Some(Size(16, 16)), ..ExportOptions::default() };
        for row in FORMATS {
            let mut out = Forward(0);
            let made = write(&mut document, None, row.format, &options, &mut out);
            assert_eq!(made.is_ok(), row.format.is_forward(), "{}: {made:?}", row.ending);
            assert!(out.0 > 0 || !row.format.is_forward());
        }
    }
}
