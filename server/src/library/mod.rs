//! `espalier library`: the library of saved trees, without a page.

mod carrier;
mod lines;
mod site;

use std::{
    fs,
    io::{self, Write},
    path::PathBuf,
};

use espalier_proto::{Problem, text};
use espalier_session::DocumentError;
use serde::Serialize;

pub use self::site::Address;
use self::{
    carrier::{Carrier, Listed},
    lines::{SessionOfList, TreeLine, VersionLine},
    site::SiteError,
};
use crate::{
    cli::{
        self,
        library::{
            ExportTree, Find, Get, LibraryCommand, List, Listing, Of, Put, RestoreVersion, Review, Sessions,
            Versions,
        },
    },
    document::Stored,
    export_options::{ExportOptions, NotOfFormat},
    formats::DOCUMENT,
    import,
    output::{OutputError, Target},
    progress::Bar,
    similar::{asked_for, no_species},
    store::{OpenError, StoreError},
};

/// It could not be done; each message is one sentence.
#[derive(Debug, thiserror::Error)]
pub enum LibraryError {
    /// The database cannot be used.
    #[error(transparent)]
    Database(#[from] OpenError),
    /// A server uses it, and it alone writes documents.
    #[error("A server is using the database {}: name it with --url, as in --url http://127.0.0.1:7700, or stop it first.", .0.display())]
    InUse(PathBuf),
    /// Reading or writing failed.
    #[error("The library cannot be used: {}.", .0.in_words())]
    Store(#[from] StoreError),
    /// The server does not do it.
    #[error(transparent)]
    Site(SiteError),
    /// The environment names no server.
    #[error("ESPALIER_URL names no server: {0}.")]
    Address(String),
    /// No tree has this identifier or name.
    #[error("There is no tree {0:?} in the library{1}; `espalier library ls` lists all.")]
    NoTree(String, String),
    /// No species has this short name.
    #[error("{0} `espalier species` lists all.")]
    NoSpecies(String),
    /// Several trees have this name.
    #[error(
        "{count} trees are called {name:?}; give the identifier of one, as `espalier library ls` prints it."
    )]
    Ambiguous {
        /// The name.
        name: String,
        /// How many have it.
        count: usize,
    },
    /// The tree has no such version.
    #[error("The tree has no version {0}; `espalier library versions` lists all.")]
    NoVersion(u32),
    /// The document cannot be read.
    #[error("The tree cannot be read: {0}.")]
    Document(#[from] DocumentError),
    /// A name or note cannot be taken.
    #[error("The tree cannot be saved: {0}.")]
    Text(#[from] Problem),
    /// The format has no such option, or none is named.
    #[error("The export cannot be done: {0}.")]
    Options(#[from] NotOfFormat),
    /// Standard output has no ending.
    #[error(transparent)]
    NoFormat(#[from] cli::NoFormat),
    /// The file cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A file cannot be read.
    #[error("The file {} cannot be read: {cause}.", path.display())]
    Read {
        /// Which file.
        path: PathBuf,
        /// Why not.
        cause: io::Error,
    },
    /// A file cannot be written.
    #[error("The file {} cannot be written: {cause}.", path.display())]
    Written {
        /// Which file.
        path: PathBuf,
        /// Why not.
        cause: io::Error,
    },
    /// A file cannot become a tree.
    #[error("The file {} cannot become a tree: {cause}.", path.display())]
    Import {
        /// Which file.
        path: PathBuf,
        /// Why not.
        cause: import::ImportError,
    },
    /// The runtime cannot be made.
    #[error("The program's threads cannot be started: {0}.")]
    Threads(#[from] io::Error),
}

impl LibraryError {
    /// Whether the call is wrong.
    pub fn is_usage(&self) -> bool {
        matches!(
            self,
            Self::Text(_)
                | Self::Options(_)
                | Self::NoSpecies(_)
                | Self::Address(_)
                | Self::NoFormat(_)
                | Self::Output(OutputError::Terminal(_))
                | Self::Read { .. }
                | Self::Import { .. }
        )
    }
}

/// `espalier library`.
pub fn run(command: &LibraryCommand) -> Result<(), LibraryError> {
    let work = async {
        match command {
            LibraryCommand::Ls(list) => ls(list, &[]).await,
            LibraryCommand::Find(Find { words, list }) => ls(list, words).await,
            LibraryCommand::Sessions(options) => sessions(options).await,
            LibraryCommand::Get(options) => get(options).await,
            LibraryCommand::Put(options) => put(options).await,
            LibraryCommand::Export(options) => export(options).await,
            LibraryCommand::Versions(options) => versions(options).await,
            LibraryCommand::Restore(options) => restore(options).await,
            LibraryCommand::Review(options) => review(options).await,
        }
    };
    tokio::runtime::Builder::new_current_thread().enable_all().build()?.block_on(work)
}

async fn ls(list: &List, words: &[String]) -> Result<(), LibraryError> {
    let trees = Carrier::of(&list.from.place)?.trees(&Listed::of(list, words)).await?;
    if let Some(unknown) = list.species.as_deref().filter(|_| trees.is_empty()).and_then(no_species) {
        return Err(LibraryError::NoSpecies(unknown));
    }
    print(TreeLine::HEADS, &trees, TreeLine::cells, &list.from);
    Ok(())
}

async fn sessions(Sessions { unsaved, from }: &Sessions) -> Result<(), LibraryError> {
    let sessions = Carrier::of(&from.place)?.sessions(*unsaved).await?;
    print(SessionOfList::HEADS, &sessions, SessionOfList::cells, from);
    Ok(())
}

async fn versions(Versions { tree, from }: &Versions) -> Result<(), LibraryError> {
    let carrier = Carrier::of(&from.place)?;
    let versions = carrier.versions(&found(&carrier, tree).await?.id).await?;
    print(VersionLine::HEADS, &versions, VersionLine::cells, from);
    Ok(())
}

async fn get(Get { of, file }: &Get) -> Result<(), LibraryError> {
    let mut stored = Stored::read(&document_of(of).await?)?;
    let target = Target { path: file.clone(), row: &DOCUMENT };
    Ok(target.write(|out| stored.write(target.row.format, &ExportOptions::default(), out))?)
}

/// The program makes the file itself, whoever has the document: it is a hundredth of what is made of it.
async fn export(options: &ExportTree) -> Result<(), LibraryError> {
    let target = options.out.target(options.format)?;
    options.options.check(target.row.options)?;
    target.check()?;
    let bar = Bar::turning("reading the tree");
    let mut stored = Stored::read(&document_of(&options.of).await?)?;
    drop(bar);
    Ok(target.write(|out| stored.write(target.row.format, &options.options, out))?)
}

async fn review(Review { tree, file, language, place }: &Review) -> Result<(), LibraryError> {
    let carrier = Carrier::of(place)?;
    let html = carrier.review(&found(&carrier, tree).await?.id, *language).await?;
    if file.as_os_str() == "-" {
        say(html.trim_end());
        return Ok(());
    }
    fs::write(file, html).map_err(|cause| LibraryError::Written { path: file.clone(), cause })
}

async fn put(put: &Put) -> Result<(), LibraryError> {
    let path = &put.file.path;
    let bytes = fs::read(path).map_err(|cause| LibraryError::Read { path: path.clone(), cause })?;
    let file_name = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    let name = text::name("name", put.name.as_deref().unwrap_or(&file_name))?;
    let carrier = Carrier::of(&put.place)?;
    let tree = match &put.to {
        Some(tree) => Some(found(&carrier, tree).await?.id),
        None => None,
    };
    let bar = Bar::turning("making a tree of the file");
    let made = carrier.put(tree.as_deref(), put, name, bytes).await;
    drop(bar);
    let (id, number, notes) = made?;
    for note in notes {
        // A reader that has gone is no error of ours.
        let _ = writeln!(io::stderr(), "Note: {note}");
    }
    say(&format!("{id} has version {number}."));
    Ok(())
}

async fn restore(options: &RestoreVersion) -> Result<(), LibraryError> {
    let RestoreVersion { tree, number, place } = options;
    let carrier = Carrier::of(place)?;
    let tree = found(&carrier, tree).await?.id;
    let newest = carrier.restore(&tree, *number).await?;
    say(&format!("{tree} has version {newest}, which is as version {number}."));
    Ok(())
}

async fn document_of(of: &Of) -> Result<Vec<u8>, LibraryError> {
    let carrier = Carrier::of(&of.place)?;
    let tree = found(&carrier, &of.tree).await?;
    carrier.document(&tree.id, of.version.unwrap_or(tree.version)).await
}

/// The tree with this identifier, or else with this name.
async fn found(carrier: &Carrier, wanted: &str) -> Result<TreeLine, LibraryError> {
    if let Some(tree) = carrier.tree(wanted).await? {
        return Ok(tree);
    }
    let trees = carrier.trees(&Listed::all()).await?;
    if let Some(tree) = trees.iter().find(|tree| tree.id == wanted) {
        return Ok(tree.clone());
    }
    let mut named: Vec<TreeLine> = trees.iter().filter(|tree| tree.name == wanted).cloned().collect();
    match (named.len(), named.pop()) {
        (1, Some(tree)) => Ok(tree),
        (0, _) | (_, None) => {
            let meant = asked_for(wanted, trees.iter().flat_map(|tree| [&*tree.name, &*tree.id]));
            Err(LibraryError::NoTree(wanted.to_owned(), meant))
        }
        (count, _) => Err(LibraryError::Ambiguous { name: wanted.to_owned(), count }),
    }
}

/// Prints a table for people, or an object on a line for programs.
fn print<T: Serialize, const N: usize>(
    heads: [&str; N],
    lines: &[T],
    cells: impl Fn(&T) -> [String; N],
    Listing { json, .. }: &Listing,
) {
    if *json {
        // Plain values always have a JSON form.
        lines.iter().for_each(|line| say(&serde_json::to_string(line).unwrap_or_default()));
        return;
    }
    let rows: Vec<[String; N]> =
        std::iter::once(heads.map(str::to_owned)).chain(lines.iter().map(cells)).collect();
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: [usize; N] = std::array::from_fn(width);
    for row in &rows {
        let padded = row.iter().zip(widths).map(|(cell, width)| format!("{cell:width$}"));
        say(padded.collect::<Vec<_>>().join("  ").trim_end());
    }
}

fn say(line: &str) {
    // A reader that has gone, as `head` may, is no error of ours.
    let _ = writeln!(io::stdout(), "{line}");
}
