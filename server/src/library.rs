//! `espalier library`: the library of saved trees, without a page.

use std::{
    collections::BTreeMap,
    fs,
    io::{self, Write},
    path::PathBuf,
};

use espalier_growth::DEFAULT_METAMER_BUDGET;
use espalier_proto::{Problem, text};
use espalier_session::{Document, DocumentError, Principal};
use serde::Serialize;

use crate::{
    cli::{
        self, Database,
        library::{
            ExportTree, Find, Get, LibraryCommand, List, Listing, Of, Put, RestoreVersion, Review, Sessions,
            Versions,
        },
    },
    document::{self, FORMATS, Format, Stored},
    export_options::NotOfFormat,
    import::{self, ImportNote, Imported},
    name,
    output::{OutputError, Target},
    progress::Bar,
    review,
    similar::{asked_for, no_species},
    store::{
        Comments, Contents, Library, LibraryFile, Missing, NewTree, NewVersion, OpenError, Picture, Saved,
        SessionLine, SessionQuery, SqliteStore, Store, StoreError, StoredTree, StoredVersion, TreeDocument,
        TreeQuery,
    },
    time::now,
};

/// It could not be done; each message is one sentence.
#[derive(Debug, thiserror::Error)]
pub enum LibraryError {
    /// The database cannot be used.
    #[error(transparent)]
    Database(#[from] OpenError),
    /// A server uses it, and it alone writes documents.
    #[error("A server is using the database {}: save and restore trees by its page or its API, or stop it first.", .0.display())]
    InUse(PathBuf),
    /// Reading or writing failed.
    #[error("The library cannot be used: {}.", .0.in_words())]
    Store(#[from] StoreError),
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

/// A tree, as lists print it.
#[derive(Serialize)]
struct TreeLine<'a> {
    id: &'a str,
    name: &'a str,
    version: u32,
    metamers: u32,
    species: Option<&'a str>,
    tags: &'a [String],
    note: &'a str,
    author: Option<&'a str>,
    saved_at: &'a str,
    created_at: &'a str,
    deleted_at: Option<&'a str>,
}

/// A version, as lists print it.
#[derive(Serialize)]
struct VersionLine<'a> {
    number: u32,
    metamers: u32,
    species: Option<&'a str>,
    note: &'a str,
    author: Option<&'a str>,
    saved_at: &'a str,
    restored: Option<u32>,
}

async fn ls(list: &List, words: &[String]) -> Result<(), LibraryError> {
    let query = TreeQuery {
        is_deleted: list.deleted,
        words: words.iter().flat_map(|words| words.split_whitespace()).map(str::to_owned).collect(),
        tags: list.tags.clone(),
        species: list.species.clone(),
        sort: list.sort.into(),
        ..TreeQuery::default()
    };
    let trees = LibraryFile::open(&list.from.database.path).await?.trees(&query).await?;
    if let Some(unknown) = list.species.as_deref().filter(|_| trees.is_empty()).and_then(no_species) {
        return Err(LibraryError::NoSpecies(unknown));
    }
    let lines = trees.iter().map(|StoredTree { head, .. }| head).zip(&trees).map(|(head, tree)| TreeLine {
        id: &tree.id,
        name: &tree.name,
        version: head.number,
        metamers: head.metamers,
        species: head.species.as_deref(),
        tags: &tree.tags,
        note: &tree.note,
        author: head.author.as_deref(),
        saved_at: &head.saved_at,
        created_at: &tree.created_at,
        deleted_at: tree.deleted_at.as_deref(),
    });
    let cells = |line: &TreeLine<'_>| {
        [
            line.id.to_owned(),
            line.name.to_owned(),
            line.version.to_string(),
            line.metamers.to_string(),
            line.species.unwrap_or_default().to_owned(),
            line.saved_at.to_owned(),
        ]
    };
    print(["ID", "NAME", "VERSION", "METAMERS", "SPECIES", "SAVED"], lines, cells, &list.from);
    Ok(())
}

/// A session, as lists print it.
#[derive(Serialize)]
struct SessionOfList<'a> {
    session: &'a str,
    tree: Option<&'a str>,
    tree_name: Option<&'a str>,
    version: Option<u32>,
    saved: bool,
    metamers: u32,
    used_at: &'a str,
}

async fn sessions(Sessions { unsaved, from }: &Sessions) -> Result<(), LibraryError> {
    let query =
        SessionQuery { is_saved: unsaved.then_some(false), limit: u32::MAX, ..SessionQuery::default() };
    let sessions = LibraryFile::open(&from.database.path).await?.sessions(&query).await?;
    let lines =
        sessions.iter().map(|SessionLine { name, tree, is_saved, metamers, used_at }| SessionOfList {
            session: name,
            tree: tree.as_ref().map(|tree| &*tree.id),
            tree_name: tree.as_ref().map(|tree| &*tree.name),
            version: tree.as_ref().map(|tree| tree.version),
            saved: *is_saved,
            metamers: *metamers,
            used_at,
        });
    let cells = |line: &SessionOfList<'_>| {
        [
            line.session.to_owned(),
            line.tree_name.unwrap_or_default().to_owned(),
            if line.saved { "yes" } else { "no" }.to_owned(),
            line.metamers.to_string(),
            line.used_at.to_owned(),
        ]
    };
    print(["SESSION", "TREE", "SAVED", "METAMERS", "USED"], lines, cells, from);
    Ok(())
}

async fn versions(Versions { tree, from }: &Versions) -> Result<(), LibraryError> {
    let file = LibraryFile::open(&from.database.path).await?;
    let versions = file.versions(&found(&file, tree).await?.id).await?;
    let lines = versions.iter().map(|version: &StoredVersion| VersionLine {
        number: version.number,
        metamers: version.metamers,
        species: version.species.as_deref(),
        note: &version.note,
        author: version.author.as_deref(),
        saved_at: &version.saved_at,
        restored: version.restored,
    });
    let cells = |line: &VersionLine<'_>| {
        [
            line.number.to_string(),
            line.metamers.to_string(),
            line.species.unwrap_or_default().to_owned(),
            line.saved_at.to_owned(),
            line.author.unwrap_or_default().to_owned(),
            line.note.lines().next().unwrap_or_default().to_owned(),
        ]
    };
    print(["VERSION", "METAMERS", "SPECIES", "SAVED", "AUTHOR", "NOTE"], lines, cells, from);
    Ok(())
}

async fn get(Get { of, file }: &Get) -> Result<(), LibraryError> {
    let document = document_of(of).await?;
    let row = FORMATS.iter().find(|row| row.format == Format::Document).ok_or(cli::NoFormat)?;
    let target = Target { path: file.clone(), row };
    Ok(target.write(|out| Ok(out.write_all(&document.bytes)?))?)
}

async fn export(options: &ExportTree) -> Result<(), LibraryError> {
    let target = options.out.target(options.format)?;
    options.options.check(target.row.options)?;
    target.check()?;
    let document = document_of(&options.of).await?;
    let mut stored = Stored::read(&document.bytes)?;
    Ok(target.write(|out| stored.write(target.row.format, &options.options, out))?)
}

async fn review(Review { tree, file, language, database }: &Review) -> Result<(), LibraryError> {
    let library = LibraryFile::open(&database.path).await?;
    let tree = found(&library, tree).await?;
    let document = library.document(&tree.id, tree.head.number).await?;
    let store = SqliteStore::open_beside(&database.path).await?;
    let written = async {
        let pins = store.pins(&tree.id).await?;
        let states = match document.filter(|_| !pins.is_empty()) {
            Some(document) => review::states(&Document::from_bytes(&document.bytes)?, &pins),
            None => BTreeMap::new(),
        };
        Ok::<_, LibraryError>(review::summary(&store, &tree, &states, &now(), *language).await?)
    };
    let html = written.await;
    store.close().await;
    let html = html?;
    if file.as_os_str() == "-" {
        say(html.trim_end());
        return Ok(());
    }
    fs::write(file, html).map_err(|cause| LibraryError::Written { path: file.clone(), cause })
}

async fn put(options: &Put) -> Result<(), LibraryError> {
    let path = &options.file.path;
    let bytes = fs::read(path).map_err(|cause| LibraryError::Read { path: path.clone(), cause })?;
    let file_name = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    let name = text::name("name", options.name.as_deref().unwrap_or(&file_name))?;
    let note = text::note(&options.note)?;
    let import = import::Import {
        format: options.file.format,
        units: options.options.units(),
        seed: 1,
        parameters: vec![options.options.parameters()],
        metamers: DEFAULT_METAMER_BUDGET,
    };
    let bar = Bar::turning("making a tree of the file");
    let Imported { mut document, notes } = import::document(&bytes, &import)
        .map_err(|cause| LibraryError::Import { path: path.clone(), cause })?;
    let png = document::thumbnail(&mut document);
    drop(bar);
    notes.iter().for_each(ImportNote::print);
    let thumbnail = Picture { media_type: "image/png".into(), bytes: png };
    let saved = Saved { thumbnail: Some(thumbnail), ..Saved::of(&document) };
    let version = new_version(note, Contents::New(Box::new(saved)));
    let tree = match &options.to {
        Some(tree) => Some(found(&LibraryFile::open(&options.database.path).await?, tree).await?),
        None => None,
    };
    let store = for_itself(&options.database).await?;
    let put = match tree {
        Some(tree) => store.add_version(&tree.id, None, version).await.map(|number| (tree.id, number)),
        None => {
            let id = name::unguessable();
            store.add_tree(NewTree { id: id.clone(), name, version }).await.map(|()| (id, 1))
        }
    };
    store.close().await;
    let (id, number) = put?;
    say(&format!("{id} has version {number}."));
    Ok(())
}

async fn restore(options: &RestoreVersion) -> Result<(), LibraryError> {
    let RestoreVersion { tree, number, database } = options;
    let tree = found(&LibraryFile::open(&database.path).await?, tree).await?.id;
    let contents = Contents::Of { tree: tree.clone(), version: *number };
    let store = for_itself(database).await?;
    let added = store.add_version(&tree, None, new_version(String::new(), contents)).await;
    store.close().await;
    let newest = added.map_err(|error| match error {
        StoreError::NotFound(Missing::Version) => LibraryError::NoVersion(*number),
        error => error.into(),
    })?;
    say(&format!("{tree} has version {newest}, which is as version {number}."));
    Ok(())
}

fn new_version(note: String, contents: Contents) -> NewVersion {
    let principal = Principal::visitor().to_string();
    NewVersion { saved_at: now(), principal, author: None, note, contents, session: None }
}

/// The database, which no server uses meanwhile.
async fn for_itself(database: &Database) -> Result<SqliteStore, LibraryError> {
    if SqliteStore::is_in_use(&database.path) {
        return Err(LibraryError::InUse(database.path.clone()));
    }
    Ok(SqliteStore::open(&database.path).await?)
}

async fn document_of(of: &Of) -> Result<TreeDocument, LibraryError> {
    let file = LibraryFile::open(&of.database.path).await?;
    let tree = found(&file, &of.tree).await?;
    let version = of.version.unwrap_or(tree.head.number);
    file.document(&tree.id, version).await?.ok_or(LibraryError::NoVersion(version))
}

/// The tree with this identifier, or else with this name.
async fn found(file: &LibraryFile, wanted: &str) -> Result<StoredTree, LibraryError> {
    let trees = file.trees(&TreeQuery::default()).await?;
    if let Some(tree) = trees.iter().find(|tree| tree.id == wanted) {
        return Ok(tree.clone());
    }
    let mut named: Vec<StoredTree> = trees.iter().filter(|tree| tree.name == wanted).cloned().collect();
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
    lines: impl Iterator<Item = T>,
    cells: impl Fn(&T) -> [String; N],
    Listing { json, .. }: &Listing,
) {
    if *json {
        // Plain values always have a JSON form.
        lines.for_each(|line| say(&serde_json::to_string(&line).unwrap_or_default()));
        return;
    }
    let rows: Vec<[String; N]> =
        std::iter::once(heads.map(str::to_owned)).chain(lines.map(|line| cells(&line))).collect();
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
