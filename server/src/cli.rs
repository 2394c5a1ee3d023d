//! The command line.

mod groups;
pub mod library;
mod members;
mod people;
mod results;
mod serve;

use std::{env, num::NonZeroUsize, ops::RangeInclusive, path::PathBuf};

use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;
use espalier_growth::species;
use espalier_proto::Steps;
use espalier_settings::{ParameterValues, ParametersPatch};

use crate::{import, import_options::ImportOptions, load::Load, recipe::SeedRange, similar::similar};

pub use self::{
    groups::{Group, GroupOfRole, Members, NamedGroup, NewGroup},
    members::{Member, MembersOf, NewMember, RemovedMember, Shared},
    people::{
        Audit, Device, Invite, Listed, NamedUser, NewToken, NewUser, RemovedUser, Revoked, RoleOfUser, Scope,
        Token, User,
    },
    results::{NoFormat, Results},
    serve::Serve,
};

const EXAMPLES: &str = "\
Examples:
  espalier                                   serve on port 7700; the tree is drawn in a browser
  espalier serve --port 8080 --database trees.db
  espalier grow --metamers 20000 --seed 3 --export tree.glb
  espalier grow --species scots-pine --export pine.png
  espalier grow --species oak --seeds 1-50 --export 'oak-{seed}.glb'
  espalier import scan.csv --grow 3 --export scan.glb
  espalier replay strokes.jsonl --export tree.json --stats json
  espalier library ls
  espalier library export 'Old oak' oak.glb
  espalier backup trees-2026-05-01.db       while a server is running

Without a command, espalier serves. Every option of `serve` can be set by the environment variable named in
`espalier serve --help`.";

/// Budgets of metamers; ids of metamers must fit many times over.
const BUDGETS: RangeInclusive<i64> = 1..=100_000_000;

const REPLAY_NOTES: &str = "\
SCRIPT has one command in JSON on each line, the same as on the wire; empty lines are skipped. For example:
  {\"kind\":\"stroke_begin\",\"stroke\":1}
  {\"kind\":\"stroke_move\",\"stroke\":1,\"samples\":[{\"position\":[0,2,0],\"radius\":3}]}
  {\"kind\":\"stroke_end\",\"stroke\":1}
  {\"kind\":\"grow\",\"steps\":20}
A line that cannot be read or done stops the replay with exit code 2, and nothing is exported.";

const COMPLETIONS_NOTES: &str = "\
For example, for bash and for fish:
  espalier completions bash > ~/.local/share/bash-completion/completions/espalier
  espalier completions fish > ~/.config/fish/completions/espalier.fish";

/// Draw living trees: a server with its tablet client, and tools for scripts.
#[derive(Debug, Parser)]
#[command(version, after_help = EXAMPLES, args_conflicts_with_subcommands = true)]
pub struct Cli {
    /// What to do; without it, serve.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// Options of `serve`, which may stand without it.
    #[command(flatten)]
    pub serve: Serve,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Serve the tablet client and its sessions.
    Serve(Serve),
    /// Do the commands of a script, without a server.
    Replay(Replay),
    /// Grow a tree on its own, without a server.
    Grow(Grow),
    /// Make a tree of a scan or a file of another program, without a server.
    Import(Import),
    /// List the species, or draw them all on one sheet.
    Species(Species),
    /// Print a link and a QR code that let somebody in who does not sit at this machine.
    Invite(Invite),
    /// Add those who log in with a password, list them, or remove them.
    #[command(subcommand)]
    User(User),
    /// Give several of those who log in a role together.
    #[command(subcommand)]
    Group(Group),
    /// Give trees and collections to users and groups.
    #[command(subcommand)]
    Member(Member),
    /// List the devices that are let in, or let one in no longer.
    #[command(subcommand)]
    Device(Device),
    /// Let a program in, by a token that it sends.
    #[command(subcommand)]
    Token(Token),
    /// List, take out and put in trees of the library.
    Library(Library),
    /// List who came in, and what they deleted, restored or took away.
    Audit(Audit),
    /// Copy the database to a file; a server may go on using it.
    Backup(Backup),
    /// Put a backup in the place of the database; what was there is kept beside it.
    Restore(Restore),
    /// Read all that is in the database and say what is damaged.
    Check(Check),
    /// Measure how long people wait on a server where many draw.
    Load(Load),
    /// Print what makes a shell complete options and names.
    Completions(Completions),
    /// Write the manual's pages, one for each command.
    Man(Man),
}

/// Where the environment names the database.
const DATABASE: &str = "ESPALIER_DATABASE";
/// Where it is if nobody says so.
const USUAL_DATABASE: &str = "./data/espalier.db";

/// The database of a command that names none.
pub fn usual_database() -> PathBuf {
    env::var_os(DATABASE).filter(|path| !path.is_empty()).unwrap_or_else(|| USUAL_DATABASE.into()).into()
}

/// Where everything is kept.
#[derive(Clone, Debug, Args)]
pub struct Database {
    /// SQLite file; `serve` makes it together with its folder if it does not exist.
    #[arg(
        id = "database",
        long = "database",
        env = DATABASE,
        default_value = USUAL_DATABASE,
        value_name = "FILE"
    )]
    pub path: PathBuf,
}

/// Options of `replay`.
#[derive(Debug, Args)]
#[command(after_help = REPLAY_NOTES)]
pub struct Replay {
    /// The script, JSON lines; `-` reads standard input.
    pub script: PathBuf,
    /// Seed of all randomness.
    #[arg(long, default_value_t = 1)]
    pub seed: u32,
    #[command(flatten)]
    pub start: Start,
    #[command(flatten)]
    pub results: Results,
}

/// Options of `grow`.
#[derive(Debug, Args)]
pub struct Grow {
    /// Grow until so many metamers are alive.
    #[arg(
        long,
        required_unless_present_any = ["species", "steps", "grammar", "design"],
        value_parser = clap::value_parser!(u32).range(1..)
    )]
    pub metamers: Option<u32>,
    /// Grow for so many steps.
    #[arg(long, value_name = "N", value_parser = parse_steps)]
    pub steps: Option<Steps>,
    /// Grow a tree of a species to its age; `espalier species` lists them.
    #[arg(long, value_name = "NAME", value_parser = parse_species)]
    pub species: Option<&'static species::Species>,
    /// Plant what a grammar writes; `-` for standard input.
    #[arg(long, value_name = "FILE", conflicts_with = "species")]
    pub grammar: Option<PathBuf>,
    /// Derive the grammar so deep; as deep as its text says if nothing is said.
    #[arg(long, value_name = "N", requires = "grammar", value_parser = parse_steps)]
    pub depth: Option<Steps>,
    /// The space that the grammar may ask for as `inside(0)`: a file with a `within` as `set_grammar` has it, in JSON.
    #[arg(long, value_name = "FILE", requires = "grammar")]
    pub space: Option<PathBuf>,
    /// Something to grow around: a model (.glb, .gltf, .obj; metres), or obstacles as `place_obstacle` has them, one a
    /// line, in JSON (.json, .jsonl); may be given again.
    #[arg(long = "obstacle", value_name = "FILE")]
    pub obstacles: Vec<PathBuf>,
    /// Plant a design: a file of one, `-` for standard input, or the name of a template, as `chokkan`.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["species", "grammar"])]
    pub design: Option<PathBuf>,
    /// Seed of all randomness.
    #[arg(long, default_value_t = 1)]
    pub seed: u32,
    /// Grow a tree for each of these seeds, one after the other; `{seed}` in the name of the export is its seed.
    #[arg(long, value_name = "FROM-TO", conflicts_with = "seed")]
    pub seeds: Option<SeedRange>,
    #[command(flatten)]
    pub start: Start,
    #[command(flatten)]
    pub results: Results,
}

/// The place of the seed in the name of an export.
pub const SEED: &str = "{seed}";

/// Options of `import`.
#[derive(Debug, Args)]
pub struct Import {
    /// The file: .csv (cylinders of a QSM), .mtg (a multiscale tree graph), .json (a skeleton) or .espalier.
    #[arg(value_parser = parse_import)]
    pub file: ImportFile,
    #[command(flatten)]
    pub options: ImportOptions,
    /// Grow on for so many steps.
    #[arg(long, value_name = "STEPS", value_parser = clap::value_parser!(u32).range(1..))]
    pub grow: Option<u32>,
    /// Seed of all randomness, where the file has none.
    #[arg(long, default_value_t = 1)]
    pub seed: u32,
    #[command(flatten)]
    pub start: Start,
    #[command(flatten)]
    pub results: Results,
}

/// A file to read, in the format that its name tells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ImportFile {
    /// Where.
    pub path: PathBuf,
    /// As what.
    pub format: import::Format,
}

/// Options of `species`.
#[derive(Debug, Args)]
pub struct Species {
    /// Print them as JSON, each with its programme and looks, as `GET /api/v1/species` tells them.
    #[arg(long, conflicts_with = "sheet")]
    pub json: bool,
    /// Grow every species to its age and draw all of them into a PNG file.
    #[arg(long, value_name = "OUT")]
    pub sheet: Option<PathBuf>,
    /// Seed of all randomness.
    #[arg(long, default_value_t = 1)]
    pub seed: u32,
    /// Threads; one for each core if not given.
    #[arg(long)]
    pub threads: Option<NonZeroUsize>,
}

/// Options of `library`.
#[derive(Debug, Args)]
#[command(after_help = library::NOTES)]
pub struct Library {
    /// What to do with it.
    #[command(subcommand)]
    pub command: library::LibraryCommand,
}

/// Options of `backup`.
#[derive(Debug, Args)]
pub struct Backup {
    /// The copy; it is written beside its place and moved there when it is whole.
    pub file: PathBuf,
    #[command(flatten)]
    pub database: Database,
    /// Take the place of a file that is there already.
    #[arg(long)]
    pub replace: bool,
}

/// Options of `restore`.
#[derive(Debug, Args)]
pub struct Restore {
    /// The backup; it stays as it is.
    pub file: PathBuf,
    #[command(flatten)]
    pub database: Database,
}

/// Options of `check`.
#[derive(Debug, Args)]
pub struct Check {
    #[command(flatten)]
    pub database: Database,
}

/// Options of `completions`.
#[derive(Debug, Args)]
#[command(after_help = COMPLETIONS_NOTES)]
pub struct Completions {
    /// The shell.
    pub shell: Shell,
}

/// Options of `man`.
#[derive(Debug, Args)]
pub struct Man {
    /// The folder to write them to; it is made if it does not exist.
    pub folder: PathBuf,
}

/// What a scene starts with.
#[derive(Debug, Args)]
pub struct Start {
    /// Set a parameter of growth, as in docs/command-line.md; may be given again.
    #[arg(long = "parameter", value_name = "NAME=VALUE", value_parser = parse_parameter)]
    pub parameters: Vec<ParametersPatch>,
    /// Metamers the scene may hold, dead ones included; a million for `replay` and without bound for `grow` if not given.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(BUDGETS))]
    pub budget: Option<u32>,
}

fn parse_import(path: &str) -> Result<ImportFile, String> {
    let path = PathBuf::from(path);
    let ending = path.extension().map(|extension| extension.to_string_lossy().into_owned());
    let format = import::format_of(&ending.unwrap_or_default())?;
    Ok(ImportFile { path, format })
}

fn parse_steps(text: &str) -> Result<Steps, String> {
    let steps = text.parse().ok().and_then(|steps: u32| Steps::try_from(steps).ok());
    steps.ok_or_else(|| format!("allowed: {} to {}", Steps::LEAST.get(), Steps::MOST.get()))
}

fn parse_species(slug: &str) -> Result<&'static species::Species, String> {
    species::find(slug).ok_or_else(|| {
        match similar(slug, species::all().iter().map(|species| species.slug)) {
            Some(known) => format!("there is no such species; a similar name is `{known}`"),
            None => "there is no such species; `espalier species` lists them".to_owned(),
        }
    })
}

fn parse_parameter(text: &str) -> Result<ParametersPatch, String> {
    let (name, value) = text.split_once('=').ok_or("write it as NAME=VALUE")?;
    if !ParameterValues::NAMES.contains(&name) {
        return Err(unknown_parameter(name));
    }
    // Numbers and switches are JSON as they stand; a choice is a text.
    let value = serde_json::from_str(value).unwrap_or_else(|_| value.into());
    let fields = serde_json::Map::from_iter([(name.to_owned(), value)]);
    serde_json::from_value(fields.into()).map_err(|error| error.to_string())
}

/// Says that there is none of this name, and which name may have been meant.
fn unknown_parameter(name: &str) -> String {
    match similar(name, ParameterValues::NAMES.iter().copied()) {
        Some(known) => format!("there is no parameter `{name}`; a similar name is `{known}`"),
        None => format!("there is no parameter `{name}`; there are {}", ParameterValues::NAMES.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use clap::{CommandFactory, error::ErrorKind};

    use super::*;

    fn parse(line: &str) -> Result<Cli, clap::Error> {
        Cli::try_parse_from(line.split_whitespace())
    }

    #[test]
    fn the_definition_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn without_a_command_it_serves() {
        let cli = parse("espalier").unwrap();
        assert!(cli.command.is_none());
        assert_eq!((cli.serve.host.to_string(), cli.serve.port), ("127.0.0.1".into(), 7700));
        assert_eq!(cli.serve.database.path, PathBuf::from("./data/espalier.db"));
        assert_eq!(parse("espalier --port 0").unwrap().serve.port, 0);
        assert!(
            matches!(parse("espalier serve --port 1").unwrap().command, Some(Command::Serve(serve)) if serve.port == 1)
        );
    }

    #[test]
    fn parameters_are_numbers_switches_and_choices() {
        let patch = |text| parse_parameter(text).unwrap();
        assert_eq!(patch("apical_control=0.6").apical_control, Some(0.6));
        assert_eq!(patch("trunk_upward=false").trunk_upward, Some(false));
        assert_eq!(patch("vigor_model=priority").vigor_model, Some(espalier_settings::VigorModel::Priority));
        assert!(parse_parameter("vigor_model=luck").unwrap_err().contains("borchert_honda"));
        assert!(parse_parameter("leaf_size=big").unwrap_err().contains("expected 0.1 to 3"));
        assert!(parse_parameter("apical_controll=0.6").unwrap_err().ends_with("`apical_control`"));
        assert!(parse_parameter("sap=1").unwrap_err().contains("internode_length, "));
    }

    #[test]
    fn a_name_that_was_mistyped_is_told_a_similar_one() {
        assert!(parse_species("scots-pin").unwrap_err().ends_with("`scots-pine`"));
        assert!(parse_species("triffid").unwrap_err().contains("espalier species"));
        assert!(parse_species("oka").unwrap_err().ends_with("`oak`"));
        assert!(parse_import("a.cvs").unwrap_err().starts_with("unknown format `cvs`: did you mean `csv`?"));
        assert_eq!("1-50".parse(), Ok(SeedRange(1..=50)));
        assert_eq!("7".parse(), Ok(SeedRange(7..=7)));
    }

    #[test]
    fn bad_options_are_refused() {
        for (line, kind) in [
            ("espalier --port 70000", ErrorKind::ValueValidation),
            ("espalier --host example", ErrorKind::ValueValidation),
            ("espalier grow", ErrorKind::MissingRequiredArgument),
            ("espalier grow --metamers 0", ErrorKind::ValueValidation),
            ("espalier grow --steps 1001", ErrorKind::ValueValidation),
            ("espalier grow --species triffid", ErrorKind::ValueValidation),
            ("espalier grow --species oak --seeds 3-", ErrorKind::ValueValidation),
            ("espalier grow --species oak --seeds 3-1", ErrorKind::ValueValidation),
            ("espalier grow --species oak --seeds 1-3 --seed 2", ErrorKind::ArgumentConflict),
            ("espalier species --json --sheet a.png", ErrorKind::ArgumentConflict),
            ("espalier completions dos", ErrorKind::InvalidValue),
            ("espalier --metamer-budget 0", ErrorKind::ValueValidation),
            ("espalier --memory 63M", ErrorKind::ValueValidation),
            ("espalier --memory much", ErrorKind::ValueValidation),
            ("espalier grow --metamers 9 --budget 0", ErrorKind::ValueValidation),
            ("espalier grow --metamers 9 --parameter leaf_size", ErrorKind::ValueValidation),
            ("espalier grow --metamers 9 --parameter sap=1", ErrorKind::ValueValidation),
            ("espalier grow --metamers 9 --parameter leaf_size=big", ErrorKind::ValueValidation),
            ("espalier grow --metamers 9 --stats xml", ErrorKind::InvalidValue),
            ("espalier grow --metamers 9 --threads 0", ErrorKind::ValueValidation),
            ("espalier replay a.jsonl --export a.txt", ErrorKind::ValueValidation),
            ("espalier grow --metamers 9 --lod 1", ErrorKind::MissingRequiredArgument),
            ("espalier grow --metamers 9 --export a.glb --lod 7", ErrorKind::ValueValidation),
            ("espalier grow --metamers 9 --format glb", ErrorKind::MissingRequiredArgument),
            ("espalier grow --metamers 9 --export - --format fbx", ErrorKind::ValueValidation),
            ("espalier import tree.glb", ErrorKind::ValueValidation),
            ("espalier import tree.csv --unit 0", ErrorKind::ValueValidation),
            ("espalier library put tree.csv --unit 0", ErrorKind::ValueValidation),
            ("espalier library put tree.csv --internode-length 2", ErrorKind::ValueValidation),
            ("espalier library", ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand),
            ("espalier library find", ErrorKind::MissingRequiredArgument),
            ("espalier library export oak oak.fbx", ErrorKind::ValueValidation),
            ("espalier library put a.csv --name A --to B", ErrorKind::ArgumentConflict),
            ("espalier import tree.csv --grow 0", ErrorKind::ValueValidation),
            ("espalier dig", ErrorKind::InvalidSubcommand),
        ] {
            assert_eq!(parse(line).unwrap_err().kind(), kind, "{line}");
        }
    }
}
