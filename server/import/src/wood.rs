//! Wood from files of structure: MTG, QSM as comma-separated values, and skeletons.
//!
//! Any bytes at all give wood or a fault; work and memory are bounded by the file's size and the limit of nodes.

mod internode;
mod mtg;
mod pieces;
mod qsm;
mod skeleton;

use std::fmt;

use espalier_plant::Wood;
use espalier_settings::ParametersPatch;

/// Steps of birth that a file may name.
const MAX_STEP: u32 = 100_000;
/// Columns of a table, and features that a graph may declare: no program writes so many.
const MAX_COLUMNS: usize = 1000;
/// Tips of shed twigs that a file may have, all together.
const MAX_SHED: u32 = 1_000_000_000;

/// A format of structure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WoodFormat {
    /// A multiscale tree graph of OpenAlea.
    Mtg,
    /// Cylinders as comma-separated values.
    Qsm,
    /// A skeleton as JSON.
    Skeleton,
}

/// What the numbers of a file count, in metres: those who measure trees write lengths in centimetres and diameters in
/// millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Units {
    /// Of places and lengths.
    pub length: f64,
    /// Of diameters and radii.
    pub diameter: f64,
}

impl Units {
    /// Both alike.
    pub const fn of(metres: f64) -> Self {
        Self { length: metres, diameter: metres }
    }
}

/// What turns metres into internodes, and what bounds the work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WoodOptions {
    /// Length of one internode in metres; if it is not given, what the file says, or how long its pieces are.
    pub internode_length: Option<f32>,
    /// The units of the file; skeletons know their own.
    pub units: Units,
    /// Internodes that an axis is given in one step, where the file does not say when it grew.
    pub shoot: u32,
    /// The most nodes.
    pub nodes: usize,
    /// How far from the first trunk's base wood may be on each axis, in internodes.
    pub extent: f32,
}

/// What a file holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WoodFile {
    /// The wood.
    pub wood: Wood,
    /// The parameters it grew by, as far as the file says.
    pub parameters: ParametersPatch,
    /// The short name of its species.
    pub species: Option<String>,
    /// The seed of its randomness.
    pub seed: Option<u32>,
    /// What whoever takes it should know.
    pub notes: Vec<WoodNote>,
}

/// What whoever takes a file should know although it could be read; the message is a sentence.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum WoodNote {
    /// Nobody can say whether the last number is whole.
    #[error("The last line has no line end; the file may have been cut off there.")]
    NoLineEnd,
    /// As where diameters are in another unit than lengths, which most files of measured trees do not say.
    #[error(
        "Its trunk is as thick as {percent} % of its height; if that cannot be, its diameters are in another unit \
         (`diameter_unit`)."
    )]
    Thick {
        /// Its diameter at the foot, of its height.
        percent: u32,
    },
}

/// What kind of fault it is; programs branch on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaultKind {
    /// It is not a file of this format, or its parts contradict each other.
    Malformed,
    /// A number lies outside its range.
    OutOfRange,
    /// More than the limit allows.
    TooMany,
}

/// Where a file is at fault.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// A line, counted from 1.
    Line(u64),
    /// A line, and a cell or character of it, both counted from 1.
    Cell(u64, u64),
    /// A member of JSON: `metamers[3].parent`.
    Member(String),
}

/// A file cannot be read; the message ends a sentence.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{}{what}{}",
    place.as_ref().map(|place| format!("{place}: ")).unwrap_or_default(),
    allowed.as_ref().map(|allowed| format!("; allowed: {allowed}")).unwrap_or_default()
)]
pub struct Fault {
    /// What kind.
    pub kind: FaultKind,
    /// Where.
    pub place: Option<Place>,
    /// What is wrong.
    pub what: String,
    /// What is allowed there, where that is less than any file of the format.
    pub allowed: Option<String>,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Cell(line, column) => write!(f, "line {line}, column {column}"),
            Self::Member(path) => f.write_str(path),
        }
    }
}

/// Reads a file of structure.
///
/// # Errors
/// Where it is not of this format, a number is out of range, parts contradict each other, or there is too much of it.
pub fn read_wood(format: WoodFormat, bytes: &[u8], options: &WoodOptions) -> Result<WoodFile, Fault> {
    let (pieces, about) = match format {
        WoodFormat::Mtg => mtg::read(bytes, options)?,
        WoodFormat::Qsm => (qsm::read(bytes, options)?, About::default()),
        WoodFormat::Skeleton => return skeleton::read(bytes, options),
    };
    let (wood, length) = pieces::join(&pieces, about.internode_length, options)?;
    let parameters = ParametersPatch { internode_length: Some(length), ..ParametersPatch::default() };
    let cut_off = (!bytes.ends_with(b"\n")).then_some(WoodNote::NoLineEnd);
    let notes = cut_off.into_iter().chain(pieces::too_thick(&pieces)).collect();
    Ok(WoodFile { wood, parameters, species: about.species, seed: about.seed, notes })
}

/// What a file says of all its pieces.
#[derive(Clone, Debug, Default)]
struct About {
    internode_length: Option<f32>,
    species: Option<String>,
    seed: Option<u32>,
}

fn malformed(place: Option<Place>, what: impl Into<String>) -> Fault {
    Fault { kind: FaultKind::Malformed, place, what: what.into(), allowed: None }
}

fn out_of_range(place: Option<Place>, what: impl Into<String>, allowed: impl Into<String>) -> Fault {
    Fault { kind: FaultKind::OutOfRange, place, what: what.into(), allowed: Some(allowed.into()) }
}

fn too_many(place: Option<Place>, options: &WoodOptions) -> Fault {
    let (what, allowed) = ("it has too many nodes".into(), Some(format!("up to {} nodes", options.nodes)));
    Fault { kind: FaultKind::TooMany, place, what, allowed }
}

fn too_many_columns(line: u64) -> Fault {
    let allowed = Some(format!("up to {MAX_COLUMNS} columns"));
    let what = "it has too many columns".into();
    Fault { kind: FaultKind::TooMany, place: Some(Place::Line(line)), what, allowed }
}

/// A number as text, which must be finite.
fn number(text: &str, place: Place, name: &str) -> Result<f64, Fault> {
    let read: f64 = text.trim().parse().map_err(|_| {
        malformed(Some(place.clone()), format!("{name} is `{}`, which is no number", excerpt(text)))
    })?;
    if read.is_finite() {
        return Ok(read);
    }
    Err(out_of_range(Some(place), format!("{name} is {read}"), "finite numbers"))
}

/// As much of a text as a message tells again.
fn excerpt(text: &str) -> String {
    const LONGEST: usize = 40;
    text.chars().filter(|c| !c.is_control()).take(LONGEST).collect()
}
