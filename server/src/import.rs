//! Files that become trees: structure of other programs, and documents of this one.

use std::{
    borrow::Cow,
    fmt,
    io::{self, Write},
};

use espalier_growth::{
    WORLD_EXTENT,
    species::{self, Species, Stage},
};
use espalier_import::{Fault, FaultKind, Units, WoodFormat, WoodNote, WoodOptions, read_wood};
use espalier_proto::{
    NotAllowed, Problem, ProblemCode, Reason,
    library::{self, ImportNoteKind},
    text::misleads,
};
use espalier_session::{Document, DocumentError, TransplantError};
use espalier_settings::{Appearance, ParameterValues, ParametersPatch};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{
    Deserialize, Deserializer,
    de::{Error, Visitor},
};

use crate::{
    live::OpenError,
    similar::{asked_for, similar},
};

/// A file format that a tree is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Structure.
    Wood(WoodFormat),
    /// A whole document.
    Document,
}

/// Each format, how the names of its files end, and what is in them.
pub const FORMATS: &[(Format, &str, &str)] = &[
    (Format::Wood(WoodFormat::Qsm), "csv", "cylinders of a QSM"),
    (Format::Wood(WoodFormat::Mtg), "mtg", "a multiscale tree graph"),
    (Format::Wood(WoodFormat::Skeleton), "json", "a skeleton"),
    (Format::Document, "espalier", "a document"),
];

/// The field of a problem with a file as a whole.
const BODY: &str = "body";

/// How a file is taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Import {
    /// What it is.
    pub format: Format,
    /// The units of the file, where it does not know.
    pub units: Units,
    /// The seed of all randomness, where the file has none.
    pub seed: u32,
    /// The species that it gets whatever the file says.
    pub species: Option<&'static Species>,
    /// Parameters that are set whatever the file says, in turn.
    pub parameters: Vec<ParametersPatch>,
    /// The most metamers.
    pub metamers: u32,
}

/// What has become of a file.
#[derive(Debug)]
pub struct Imported {
    /// The document.
    pub document: Document,
    /// What whoever takes it should know.
    pub notes: Vec<ImportNote>,
}

/// What whoever takes a file should know although it became a tree; each message is a sentence or two.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ImportNote {
    /// Of the file itself.
    #[error(transparent)]
    File(#[from] WoodNote),
    /// It names a species that nobody knows.
    #[error("No species here is called `{0}`; what the file does not say itself is as by default.")]
    Species(String),
}

impl ImportNote {
    /// As the API tells it.
    pub fn to_proto(&self) -> library::ImportNote {
        let (note, found) = match self {
            Self::File(WoodNote::NoLineEnd) => (ImportNoteKind::MayBeCutOff, None),
            Self::File(WoodNote::Thick { percent }) => {
                (ImportNoteKind::ThickTrunk, Some(percent.to_string()))
            }
            Self::Species(name) => (ImportNoteKind::UnknownSpecies, Some(name.clone())),
        };
        library::ImportNote { note, found, message: self.to_string() }
    }

    /// Says it to whoever gave the command.
    pub fn print(&self) {
        // A reader that has gone is no error of ours.
        let _ = writeln!(io::stderr(), "Note: {self}");
    }
}

/// A file cannot become a tree; each message ends a sentence.
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] Fault),
    /// What is in it does not fit together.
    #[error(transparent)]
    Wood(#[from] TransplantError),
    /// It is no document.
    #[error(transparent)]
    Document(#[from] DocumentError),
}

/// The format whose files end like this.
pub fn format_of(ending: &str) -> Result<Format, String> {
    let found = FORMATS.iter().find(|(_, known, _)| known.eq_ignore_ascii_case(ending));
    found.map(|&(format, ..)| format).ok_or_else(|| {
        let all: Vec<_> = FORMATS.iter().map(|(format, ..)| format.description()).collect();
        let meant = similar(ending, endings())
            .map(|known| format!("unknown format `{ending}`: did you mean `{known}`? "))
            .unwrap_or_default();
        format!("{meant}a file must be one of: {}", all.join(", "))
    })
}

impl<'de> Deserialize<'de> for Format {
    /// Of how the names of its files end.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Ending;

        impl Visitor<'_> for Ending {
            type Value = Format;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(&endings().join(", "))
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<Format, E> {
                format_of(text).map_err(|_| {
                    let found = format!("{text}{}", asked_for(text, endings()));
                    E::custom(NotAllowed::new(found, endings().join(", ")))
                })
            }
        }

        deserializer.deserialize_str(Ending)
    }
}

impl JsonSchema for Format {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "ImportFormat".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "string", "enum": endings() })
    }
}

/// How the names of all files end.
fn endings() -> Vec<&'static str> {
    FORMATS.iter().map(|(_, ending, _)| *ending).collect()
}

impl Format {
    /// How the names of its files end.
    pub fn ending(self) -> &'static str {
        FORMATS.iter().find(|(format, ..)| *format == self).map_or("", |(_, ending, _)| *ending)
    }

    /// What is in its files, and how their names end.
    fn description(self) -> String {
        let row = FORMATS.iter().find(|(format, ..)| *format == self);
        row.map(|(_, ending, what)| format!("{what} (.{ending})")).unwrap_or_default()
    }
}

/// The document of a file.
pub fn document(bytes: &[u8], import: &Import) -> Result<Imported, ImportError> {
    let format = match import.format {
        Format::Wood(format) => format,
        Format::Document => {
            return Ok(Imported { document: Document::from_bytes(bytes)?, notes: Vec::new() });
        }
    };
    let set = import.parameters.iter().fold(ParametersPatch::default(), |all, patch| all.patched(patch));
    let wanted = ParameterValues::default().patched(&set);
    // What the length of an internode turns into places must be a length.
    wanted.check().map_err(TransplantError::from)?;
    let options = WoodOptions {
        internode_length: set.internode_length,
        units: import.units,
        shoot: wanted.max_shoot_length,
        nodes: import.metamers as usize,
        extent: WORLD_EXTENT,
    };
    let file = read_wood(format, bytes, &options)?;
    let species = import.species.or_else(|| file.species.as_deref().and_then(species::find));
    let age = file.wood.nodes.last().map_or(0, |node| node.birth);
    let grown = species.map_or_else(ParameterValues::default, |species| parameters_at(species, age).clone());
    let parameters = grown.patched(&file.parameters).patched(&set);
    let looks = species.map_or_else(Appearance::default, |species| species.appearance);
    let seed = file.seed.unwrap_or(import.seed);
    let document = Document::transplanted(&file.wood, seed, &parameters, looks)?;
    let unknown = file.species.filter(|_| species.is_none()).map(|name| ImportNote::Species(excerpt(&name)));
    Ok(Imported { document, notes: file.notes.into_iter().map(ImportNote::from).chain(unknown).collect() })
}

/// The parameters that a species has at an age.
fn parameters_at(species: &Species, age: u32) -> &ParameterValues {
    let (mut begins, mut parameters) = (0, &species.parameters);
    for stage in &species.schedule {
        match stage {
            Stage::Grow(steps) => begins += steps,
            Stage::Change(values) if begins < age => parameters = values,
            Stage::Change(_) | Stage::Sow(..) | Stage::Brush(_) => {}
        }
    }
    parameters
}

/// As much of a name as a sentence tells again.
pub(crate) fn excerpt(name: &str) -> String {
    const LONGEST: usize = 40;
    name.chars().filter(|&letter| !misleads(letter)).take(LONGEST).collect()
}

impl Import {
    /// Why a file is refused: the place in it that is at fault, or the body as a whole, and what is allowed there.
    pub fn refusal(&self, error: &ImportError) -> Problem {
        let (code, place, allowed) = match error {
            ImportError::File(fault) => {
                let code = match fault.kind {
                    FaultKind::Malformed => ProblemCode::Malformed,
                    FaultKind::OutOfRange => ProblemCode::OutOfRange,
                    FaultKind::TooMany => ProblemCode::TooMany,
                };
                (code, fault.place.as_ref().map(ToString::to_string), fault.allowed.clone())
            }
            ImportError::Wood(TransplantError::Parameters(error)) => {
                let place = format!("parameters.{}", error.field);
                (ProblemCode::OutOfRange, Some(place), Some(error.allowed.clone()))
            }
            ImportError::Document(DocumentError::Later(what)) => {
                let problem = OpenError::Later(what.clone()).problem();
                return problem.at(BODY, "a document that this version of Espalier reads");
            }
            ImportError::Wood(_) | ImportError::Document(_) => (ProblemCode::Malformed, None, None),
        };
        // It tells names again that stand in the file.
        let cause: String = error.to_string().chars().filter(|&letter| !misleads(letter)).collect();
        let message = format!("The file cannot become a tree: {cause}.");
        let problem = Problem { code, cause: Some(cause), ..Problem::new(Reason::NotATreeFile, message) };
        let field = place.unwrap_or_else(|| BODY.into());
        problem.at(field, allowed.unwrap_or_else(|| self.format.description()))
    }
}

#[cfg(test)]
mod tests {
    use espalier_proto::{Action, Steps, library::IMPORT_ENDINGS};
    use espalier_session::Principal;
    use serde_json::json;

    use super::*;
    use crate::{export_options::ExportOptions, formats as exports};

    fn exported(document: &mut Document, format: exports::Format) -> Vec<u8> {
        let options = ExportOptions::default();
        let written = espalier_export::in_memory(|out| exports::write(document, None, format, &options, out));
        written.unwrap_or_else(|error| panic!("{error}"))
    }

    const SCAN: &str = include_str!("../../tests/fuzz/seeds/rtwig.csv");

    fn import(format: Format, parameters: &[ParametersPatch]) -> Import {
        let parameters = parameters.to_vec();
        Import { format, units: Units::of(1.0), seed: 1, species: None, parameters, metamers: 1000 }
    }

    fn of_wood(format: WoodFormat, bytes: &[u8]) -> Document {
        read(bytes, format, &[]).document
    }

    fn read(bytes: &[u8], format: WoodFormat, parameters: &[ParametersPatch]) -> Imported {
        let import = Import { metamers: 100_000, ..import(Format::Wood(format), parameters) };
        document(bytes, &import).unwrap_or_else(|error| panic!("{error}"))
    }

    /// A decimetre each.
    fn short() -> ParametersPatch {
        ParametersPatch { internode_length: Some(0.1), ..ParametersPatch::default() }
    }

    fn command(value: serde_json::Value) -> espalier_proto::Command {
        espalier_session::read_command(&value.to_string()).unwrap_or_else(|problem| panic!("{problem}"))
    }

    #[test]
    fn a_scan_is_bent_pruned_grown_on_and_taken_back() {
        let mut scan = read(SCAN.as_bytes(), WoodFormat::Qsm, &[short()]).document;
        let (metamers, hash) = (scan.metamers(), scan.plant().hash());
        assert_eq!(metamers, 19);
        assert!(!scan.figures().can_undo);
        let mut act = |value| scan.apply(&Principal::visitor(), &command(value)).map(|()| scan.metamers());
        // The branch is the last but the top of the trunk; its tip is moved up.
        let rows: Vec<u32> = (1..20).collect();
        let tip = rows[rows.len() - 1];
        assert!(
            act(json!({"kind": "bend_begin", "bend": 1, "base": 1, "touches": [tip], "stretch": 0.5}))
                .is_ok()
        );
        assert!(act(json!({"kind": "bend_move", "bend": 1, "targets": [[3.0, 9.0, 0.0]]})).is_ok());
        assert!(act(json!({"kind": "bend_end", "bend": 1})).is_ok());
        let grown = act(json!({"kind": "grow", "steps": 3})).unwrap_or(0);
        assert!(grown > metamers, "{grown}");
        let pruned =
            act(json!({"kind": "prune", "rows": [tip]})).unwrap_or_else(|problem| panic!("{problem}"));
        assert!(pruned < grown, "{pruned}");
        for _ in 0..3 {
            scan.apply(&Principal::visitor(), &Action::Undo {}.into())
                .unwrap_or_else(|problem| panic!("{problem}"));
        }
        assert_eq!(scan.plant().hash(), hash);
        assert!(scan.apply(&Principal::visitor(), &Action::Undo {}.into()).is_err());
        let ungrow = Action::Ungrow { steps: Steps::nearest(100) };
        scan.apply(&Principal::visitor(), &ungrow.into()).unwrap_or_else(|problem| panic!("{problem}"));
        assert_eq!(scan.metamers(), 0);
    }

    #[test]
    fn a_tree_goes_out_and_comes_in_with_its_looks_seed_and_parameters() {
        let species = species::find("scots-pine").unwrap_or_else(|| panic!("it is a species"));
        let mut before = Document::new(77);
        let grow = Action::Grow { steps: Steps::nearest(6), until: None, bud: None };
        for action in espalier_session::script(species).into_iter().take(2).chain([grow]) {
            before.apply(&Principal::visitor(), &action.into()).unwrap_or_else(|problem| panic!("{problem}"));
        }
        let file = exported(&mut before, exports::Format::Skeleton);
        let after = of_wood(WoodFormat::Skeleton, &file);
        assert_eq!((after.seed(), after.metamers()), (77, before.metamers()));
        assert_eq!((after.parameters(), after.appearance()), (before.parameters(), before.appearance()));
        let again = Document::from_bytes(&after.to_saved_bytes()).map(|document| document.hash());
        assert_eq!(again, Ok(after.hash()));
        let file = exported(&mut before, exports::Format::Document);
        let same = document(&file, &import(Format::Document, &[]));
        assert!(same.is_ok_and(|same| same.document.plant().hash() == before.plant().hash()));
    }

    #[test]
    fn a_scan_gets_the_species_that_is_asked_for() {
        let read = |format, bytes: &[u8], species: Option<&str>| {
            let species = species.and_then(species::find);
            let import = Import { species, ..import(Format::Wood(format), &[]) };
            document(bytes, &import).unwrap_or_else(|error| panic!("{error}")).document
        };
        let plain = read(WoodFormat::Qsm, SCAN.as_bytes(), None);
        let oak = read(WoodFormat::Qsm, SCAN.as_bytes(), Some("oak"));
        let known = species::find("oak").unwrap_or_else(|| panic!("it is a species"));
        assert_eq!(*plain.appearance(), Appearance::default());
        assert_eq!(*oak.appearance(), known.appearance);
        let internode_length = oak.parameters().internode_length;
        assert_eq!(internode_length, plain.parameters().internode_length, "what the file has it keeps");
        let age = oak.plant().step();
        let expected = ParameterValues { internode_length, ..parameters_at(known, age).clone() };
        assert_eq!(oak.parameters(), expected);
        assert_ne!(oak.parameters(), plain.parameters());
        // It goes before what the file says.
        let mut before = Document::new(1);
        let file = exported(&mut before, exports::Format::Skeleton);
        let file = String::from_utf8_lossy(&file).replace("\"species\":null", "\"species\":\"cherry\"");
        let [own, other] = [None, Some("oak")]
            .map(|species| *read(WoodFormat::Skeleton, file.as_bytes(), species).appearance());
        assert_eq!(Some(own), species::find("cherry").map(|cherry| cherry.appearance));
        assert_eq!(other, known.appearance);
    }

    #[test]
    fn clients_know_the_formats() {
        let mut ours: Vec<_> = FORMATS.iter().map(|(_, ending, _)| *ending).collect();
        let mut theirs = IMPORT_ENDINGS.to_vec();
        ours.sort_unstable();
        theirs.sort_unstable();
        assert_eq!(ours, theirs);
    }

    #[test]
    fn internodes_are_as_long_as_asked_for() {
        let patch = ParametersPatch { internode_length: Some(0.05), ..ParametersPatch::default() };
        let scan = read(SCAN.as_bytes(), WoodFormat::Qsm, &[patch]).document;
        // Of 1 m, 0.3 m and 0.5 m, and one internode to the branch.
        assert_eq!((scan.metamers(), scan.parameters().internode_length), (20 + 6 + 10 + 1, 0.05));
    }

    #[test]
    fn internodes_are_as_long_as_the_file_has_them() {
        let scan = of_wood(WoodFormat::Qsm, SCAN.as_bytes());
        // The median of 1 m, 0.5 m and 0.3 m.
        assert_eq!((scan.metamers(), scan.parameters().internode_length), (2 + 1 + 1, 0.5));
    }

    #[test]
    fn leaves_hang_where_they_hung_and_as_many() {
        for name in ["oak", "cherry", "scots-pine", "weeping-willow"] {
            let species = species::find(name).unwrap_or_else(|| panic!("{name} is a species"));
            let mut before = Document::new(3);
            for action in espalier_session::script(species).into_iter().take(2) {
                before
                    .apply(&Principal::visitor(), &action.into())
                    .unwrap_or_else(|problem| panic!("{problem}"));
            }
            let steps = species_steps(species).min(12);
            let grow = Action::Grow { steps: Steps::nearest(steps), until: None, bud: None };
            before.apply(&Principal::visitor(), &grow.into()).unwrap_or_else(|problem| panic!("{problem}"));
            let plant = before.plant();
            let dead = plant.metamer_count() as u32 - plant.living_count();
            assert!(dead > 1, "{name} must have shed twigs");
            let skeleton = exported(&mut before, exports::Format::Skeleton);
            let graph = exported(&mut before, exports::Format::Mtg);
            for (format, file) in [(WoodFormat::Skeleton, &skeleton), (WoodFormat::Mtg, &graph)] {
                let after = of_wood(format, file);
                assert_eq!(after.seed(), 3, "{name}");
                assert_eq!(after.parameters(), before.parameters(), "{name}, {format:?}");
                assert_eq!(after.appearance(), before.appearance(), "{name}, {format:?}");
                if format == WoodFormat::Skeleton {
                    // Rows decide which way leaves point and which have come or gone, and skeletons know these.
                    for season in [0.2, 1.0, 2.2] {
                        let [before, after] = [before.clone(), after.clone()].map(|mut document| {
                            let look = json!({"kind": "set_appearance", "appearance": {"leaves": {"season": season}}});
                            let done = document.apply(&Principal::visitor(), &command(look));
                            done.unwrap_or_else(|problem| panic!("{problem}"));
                            let file = exported(&mut document, exports::Format::Skeleton);
                            let file: serde_json::Value = serde_json::from_slice(&file).unwrap_or_default();
                            file["leaves"].clone()
                        });
                        assert!(before == after && !before.is_null(), "{name} in {season}");
                    }
                }
                // In summer all of them are out; in spring and autumn chance decides, by rows, which graphs do not know.
                let [before, after] = [before.clone(), after].map(|mut document| {
                    let summer = json!({"kind": "set_appearance", "appearance": {"leaves": {"season": 1.0}}});
                    document
                        .apply(&Principal::visitor(), &command(summer))
                        .unwrap_or_else(|problem| panic!("{problem}"));
                    leaves_of(&exported(&mut document, exports::Format::Skeleton))
                });
                assert!(before == after, "{name}, {format:?}");
            }
        }
    }

    /// Steps of a species' life without a stroke.
    fn species_steps(species: &Species) -> u32 {
        let steps = species.schedule.iter();
        steps.map(|stage| if let Stage::Grow(steps) = stage { *steps } else { 0 }).sum()
    }

    /// How many leaves each metamer of a skeleton bears.
    fn leaves_of(skeleton: &[u8]) -> std::collections::BTreeMap<u64, usize> {
        let file: serde_json::Value = serde_json::from_slice(skeleton).unwrap_or_default();
        let leaves = file["leaves"].as_array().cloned().unwrap_or_default();
        assert!(!leaves.is_empty());
        let mut all = std::collections::BTreeMap::new();
        for leaf in leaves {
            *all.entry(leaf["metamer"].as_u64().unwrap_or(u64::MAX)).or_default() += 1;
        }
        all
    }

    #[test]
    fn what_is_taken_with_a_doubt_is_said() {
        assert_eq!(read(SCAN.as_bytes(), WoodFormat::Qsm, &[]).notes, []);
        let cut = read(SCAN.trim_end().as_bytes(), WoodFormat::Qsm, &[]);
        assert_eq!(cut.notes, [ImportNote::File(WoodNote::NoLineEnd)]);
        let mut document = Document::new(1);
        let file = exported(&mut document, exports::Format::Skeleton);
        let file = String::from_utf8_lossy(&file).replace("\"species\":null", "\"species\":\"triffid\"");
        let strange = read(file.as_bytes(), WoodFormat::Skeleton, &[]);
        assert_eq!(strange.notes, [ImportNote::Species("triffid".into())]);
        let turned = String::from_utf8_lossy(file.as_bytes()).replace("triffid", "tri\u{202e}ff\u{2066}id");
        let turned = read(turned.as_bytes(), WoodFormat::Skeleton, &[]);
        assert_eq!(
            turned.notes,
            [ImportNote::Species("triffid".into())],
            "nothing turns the sentence around"
        );
    }

    #[test]
    fn problems_have_a_code_and_a_place() {
        let problem = |bytes: &str, parameters: &[ParametersPatch]| {
            let import = import(Format::Wood(WoodFormat::Qsm), parameters);
            let refusal = document(bytes.as_bytes(), &import).err().map(|error| import.refusal(&error));
            refusal.map(|problem| (problem.code, problem.field))
        };
        let at = |place: &str| Some(place.to_owned());
        let thin = SCAN.replace("0.02,0.5", "-0.02,0.5");
        assert_eq!(problem(&thin, &[]), Some((ProblemCode::OutOfRange, at("line 3, column 10"))));
        assert_eq!(problem("a,b\n1,2\n", &[]), Some((ProblemCode::Malformed, at("line 1"))));
        let import = import(Format::Wood(WoodFormat::Qsm), &[]);
        let turned =
            document("a\u{202e},b\n1,2\n".as_bytes(), &import).map_err(|error| import.refusal(&error));
        assert!(turned.is_err_and(|problem| problem.message.contains("`a`, `b`")));
        let zero = ParametersPatch { internode_length: Some(0.0), ..ParametersPatch::default() };
        let place = at("parameters.internode_length");
        assert_eq!(problem(SCAN, &[zero]), Some((ProblemCode::OutOfRange, place)));
        let tiny = ParametersPatch { internode_length: Some(0.005), ..ParametersPatch::default() };
        let many = SCAN.replace("20,30,6,0.05,1,1,0", "20,30,9.9,0.05,1,1,0");
        assert_eq!(problem(&many, &[tiny]), Some((ProblemCode::TooMany, at("line 3"))));
        let thick = SCAN.replace("0.02,0.5", "1e30,0.5");
        assert_eq!(problem(&thick, &[]), Some((ProblemCode::OutOfRange, at("line 3, column 10"))));
    }

    #[test]
    fn the_ending_says_the_format() {
        assert_eq!(format_of("MTG"), Ok(Format::Wood(WoodFormat::Mtg)));
        assert!(
            format_of("glb")
                .is_err_and(|all| all.contains("cylinders of a QSM (.csv)") && all.contains(".espalier"))
        );
    }
}
