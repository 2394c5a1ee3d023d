//! Options of `espalier library`.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};

use super::{
    ImportFile, parse_import,
    results::{Export, parse_export, parse_format},
};
use crate::{
    export_options::ExportOptions, formats::FormatRow, import_options::ImportOptions, library::Address,
    review::Language, store::Sort,
};

pub(super) const NOTES: &str = "\
TREE is the identifier of a tree, as `ls` prints it, or its name where no other tree has it.
Where a server runs, --url asks it, as in --url http://127.0.0.1:7700 or --url https://trees.example; it may be another machine's. Who is
not let in there by sitting at the machine needs a --token (`espalier token create`). Without --url the file is read, also beside a server
that uses it; put and restore then need it for themselves.";

/// What to do with the library.
#[derive(Debug, Subcommand)]
pub enum LibraryCommand {
    /// List the trees.
    Ls(List),
    /// List the trees that have all these words, each anywhere in the name, a tag, the note or the species.
    Find(Find),
    /// List the sessions, those first in which something was done last; `/s/NAME` leads to each.
    Sessions(Sessions),
    /// Write the document of a tree to a file, as it was saved.
    Get(Get),
    /// Save a file as a new tree, or as the newest version of one.
    Put(Put),
    /// Write a tree in any format.
    Export(ExportTree),
    /// List the versions of a tree, the newest first.
    Versions(Versions),
    /// Make what a version holds the newest version.
    Restore(RestoreVersion),
    /// Write what people have said of a tree to an HTML file, to read, send and print.
    Review(Review),
}

/// Options of `ls`.
#[derive(Clone, Debug, Args)]
pub struct List {
    /// The order.
    #[arg(long, value_enum, default_value_t = Order::Newest)]
    pub sort: Order,
    /// Only trees of this species, by its short name.
    #[arg(long, value_name = "NAME")]
    pub species: Option<String>,
    /// Only trees with this tag; may be given again.
    #[arg(long = "tag", value_name = "TAG")]
    pub tags: Vec<String>,
    /// Those that were deleted and can be taken back.
    #[arg(long)]
    pub deleted: bool,
    #[command(flatten)]
    pub from: Listing,
}

/// Orders of trees.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Order {
    /// The one saved last first.
    Newest,
    /// The one saved last last.
    Oldest,
    /// By name.
    Name,
    /// The one with the most metamers first.
    Largest,
    /// The one with the fewest metamers first.
    Smallest,
}

impl From<Order> for Sort {
    fn from(order: Order) -> Self {
        match order {
            Order::Newest => Self::Newest,
            Order::Oldest => Self::Oldest,
            Order::Name => Self::Name,
            Order::Largest => Self::Largest,
            Order::Smallest => Self::Smallest,
        }
    }
}

/// What a list is made from, and in which form.
#[derive(Clone, Debug, Args)]
pub struct Listing {
    /// Print a JSON object for each on a line.
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub place: Where,
}

/// Options of `find`.
#[derive(Debug, Args)]
pub struct Find {
    /// The words.
    #[arg(required = true, value_name = "WORD")]
    pub words: Vec<String>,
    #[command(flatten)]
    pub list: List,
}

/// Options of `sessions`.
#[derive(Debug, Args)]
pub struct Sessions {
    /// Only those in which something was done that is not saved.
    #[arg(long)]
    pub unsaved: bool,
    #[command(flatten)]
    pub from: Listing,
}

/// Where the library is.
#[derive(Clone, Debug, Args)]
pub struct Where {
    /// Ask the server at this address; ESPALIER_URL if neither this nor a file is given.
    #[arg(long, value_name = "URL", conflicts_with = "database")]
    pub url: Option<Address>,
    /// A token to come in with at the server.
    #[arg(long, env = "ESPALIER_TOKEN", value_name = "TOKEN", hide_env_values = true)]
    pub token: Option<String>,
    /// SQLite file; ESPALIER_DATABASE, or else ./data/espalier.db, if nothing is given.
    #[arg(long, value_name = "FILE")]
    pub database: Option<PathBuf>,
}

/// A version of a tree.
#[derive(Debug, Args)]
pub struct Of {
    /// The tree.
    pub tree: String,
    /// The number of the version; the newest if not given.
    #[arg(long, value_name = "NUMBER")]
    pub version: Option<u32>,
    #[command(flatten)]
    pub place: Where,
}

/// Options of `get`.
#[derive(Debug, Args)]
pub struct Get {
    #[command(flatten)]
    pub of: Of,
    /// The file, or `-` for standard output.
    pub file: PathBuf,
}

/// Options of `review`.
#[derive(Debug, Args)]
pub struct Review {
    /// The tree.
    pub tree: String,
    /// The file, or `-` for standard output.
    pub file: PathBuf,
    /// In which language.
    #[arg(long, value_enum, default_value_t = Language::En)]
    pub language: Language,
    #[command(flatten)]
    pub place: Where,
}

/// Options of `put`.
#[derive(Debug, Args)]
pub struct Put {
    /// The file: .espalier, or one that `espalier import` takes.
    #[arg(value_parser = parse_import)]
    pub file: ImportFile,
    /// The name of the new tree; that of the file if not given.
    #[arg(long, conflicts_with = "to")]
    pub name: Option<String>,
    /// Save it as the newest version of this tree.
    #[arg(long, value_name = "TREE")]
    pub to: Option<String>,
    /// What is said of it.
    #[arg(long, default_value = "")]
    pub note: String,
    #[command(flatten)]
    pub options: ImportOptions,
    #[command(flatten)]
    pub place: Where,
}

/// Options of `export`.
#[derive(Debug, Args)]
pub struct ExportTree {
    #[command(flatten)]
    pub of: Of,
    /// The file, in the format of its ending, or `-` for standard output.
    #[arg(id = "export", value_name = "OUT", value_parser = parse_export)]
    pub out: Export,
    /// The format, by its ending, whatever the file is called.
    #[arg(long, value_name = "ENDING", value_parser = parse_format)]
    pub format: Option<&'static FormatRow>,
    #[command(flatten)]
    pub options: ExportOptions,
}

/// Options of `versions`.
#[derive(Debug, Args)]
pub struct Versions {
    /// The tree.
    pub tree: String,
    #[command(flatten)]
    pub from: Listing,
}

/// Options of `restore`.
#[derive(Debug, Args)]
pub struct RestoreVersion {
    /// The tree.
    pub tree: String,
    /// The number of the version.
    pub number: u32,
    #[command(flatten)]
    pub place: Where,
}
