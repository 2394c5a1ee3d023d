//! What can be done with a library, by two ways: in the database's file, or by asking the server that uses it.

use std::{
    collections::BTreeMap,
    env,
    path::{Path, PathBuf},
};

use clap::ValueEnum;
use espalier_growth::DEFAULT_METAMER_BUDGET;
use espalier_proto::{library::ImportNote as NoteTold, text};
use espalier_session::{Document, Principal};
use serde::{Deserialize, de::DeserializeOwned};
use serde_json::json;
use ureq::http::Method;

use super::{
    LibraryError,
    lines::{SessionOfList, SessionTold, TreeLine, VersionLine},
    site::{Address, Site, SiteError, part},
};
use crate::{
    cli::{
        self,
        library::{List, Order, Put, Where},
    },
    document,
    import::{self, ImportNote, Imported},
    name, review,
    review::Language,
    similar::no_species,
    store::{
        Comments, Contents, Library, LibraryFile, Missing, NewTree, NewVersion, Picture, Saved, SessionQuery,
        SqliteStore, Store, StoreError, TreeQuery,
    },
    time::now,
};

/// Where a server may be named beside the command line.
const URL: &str = "ESPALIER_URL";
/// Entries of a page of a server's list: as many as it gives.
const PAGE: &str = "500";
/// The same of lists of versions and of sessions.
const SHORT_PAGE: &str = "200";

/// How a library is reached.
#[derive(Debug)]
pub enum Carrier {
    /// In this file, with a server on it or without.
    File(PathBuf),
    /// By a server.
    Site(Box<Site>),
}

/// Which trees are listed.
#[derive(Clone, Debug)]
pub struct Listed {
    pub words: Vec<String>,
    pub tags: Vec<String>,
    pub species: Option<String>,
    pub sort: Order,
    pub deleted: bool,
}

impl Listed {
    /// Those that a command names.
    pub fn of(list: &List, words: &[String]) -> Self {
        Self {
            words: words.iter().flat_map(|words| words.split_whitespace()).map(str::to_owned).collect(),
            tags: list.tags.clone(),
            species: list.species.clone(),
            sort: list.sort,
            deleted: list.deleted,
        }
    }

    /// All that are not deleted.
    pub fn all() -> Self {
        Self { words: Vec::new(), tags: Vec::new(), species: None, sort: Order::Newest, deleted: false }
    }
}

/// A page of a server's list of trees.
#[derive(Deserialize)]
struct TreesTold {
    trees: Vec<TreeLine>,
    #[serde(default)]
    next: Option<String>,
}

/// The same of sessions.
#[derive(Deserialize)]
struct SessionsTold {
    sessions: Vec<SessionTold>,
    #[serde(default)]
    next: Option<String>,
}

/// What a server says of a file that became a tree, or a version of one.
#[derive(Deserialize)]
struct PutTold {
    #[serde(default)]
    id: Option<String>,
    #[serde(alias = "version")]
    number: u32,
    #[serde(default)]
    import_notes: Vec<NoteTold>,
}

/// A server's problem as one of this command.
impl From<SiteError> for LibraryError {
    fn from(error: SiteError) -> Self {
        Self::Site(error)
    }
}

impl Carrier {
    /// The way that a command names: an address or a file that is given, one of the environment, or else the usual file.
    pub fn of(wanted: &Where) -> Result<Self, LibraryError> {
        let site = |address: &Address| Self::Site(Box::new(Site::new(address, wanted.token.as_deref())));
        if let Some(address) = &wanted.url {
            return Ok(site(address));
        }
        if let Some(path) = &wanted.database {
            return Ok(Self::File(path.clone()));
        }
        match env::var(URL).ok().filter(|url| !url.is_empty()) {
            Some(url) => Ok(site(&url.parse().map_err(LibraryError::Address)?)),
            None => Ok(Self::File(cli::usual_database())),
        }
    }

    /// Trees, in order.
    pub async fn trees(&self, listed: &Listed) -> Result<Vec<TreeLine>, LibraryError> {
        let Listed { words, tags, species, sort, deleted } = listed;
        match self {
            Self::File(path) => {
                let query = TreeQuery {
                    is_deleted: *deleted,
                    words: words.clone(),
                    tags: tags.clone(),
                    species: species.clone(),
                    sort: (*sort).into(),
                    ..TreeQuery::default()
                };
                let trees = LibraryFile::open(path).await?.trees(&query).await?;
                Ok(trees.into_iter().map(TreeLine::from).collect())
            }
            Self::Site(site) => {
                let mut query = vec![("limit", PAGE.to_owned()), ("sort", named(sort))];
                query.extend((!words.is_empty()).then(|| ("q", words.join(" "))));
                query.extend((!tags.is_empty()).then(|| ("tags", tags.join(","))));
                query.extend(species.clone().map(|species| ("species", species)));
                query.extend(deleted.then(|| ("deleted", "true".to_owned())));
                let told = pages(site, "/trees", &query, |TreesTold { trees, next }| (trees, next));
                match (told, species.as_deref().and_then(no_species)) {
                    (Err(LibraryError::Site(SiteError::Refused { .. })), Some(unknown)) => {
                        Err(LibraryError::NoSpecies(unknown))
                    }
                    (told, _) => told,
                }
            }
        }
    }

    /// Sessions, those first in which something was done last.
    pub async fn sessions(&self, unsaved: bool) -> Result<Vec<SessionOfList>, LibraryError> {
        match self {
            Self::File(path) => {
                let is_saved = unsaved.then_some(false);
                let query = SessionQuery { is_saved, limit: u32::MAX, ..SessionQuery::default() };
                let sessions = LibraryFile::open(path).await?.sessions(&query).await?;
                Ok(sessions.into_iter().map(SessionOfList::from).collect())
            }
            Self::Site(site) => {
                let mut query = vec![("limit", SHORT_PAGE.to_owned())];
                query.extend(unsaved.then(|| ("saved", "false".to_owned())));
                let told = |SessionsTold { sessions, next }: SessionsTold| (sessions, next);
                let all = pages(site, "/sessions", &query, told)?;
                Ok(all.into_iter().map(SessionOfList::from).collect())
            }
        }
    }

    /// The tree with this identifier that is not deleted, where that is known without a list of all.
    pub async fn tree(&self, id: &str) -> Result<Option<TreeLine>, LibraryError> {
        match self {
            Self::File(_) => Ok(None),
            Self::Site(site) => {
                let found: Option<TreeLine> = site.found(&format!("/trees/{}", part(id)))?;
                Ok(found.filter(|tree| tree.deleted_at.is_none()))
            }
        }
    }

    /// Versions of a tree, the newest first.
    pub async fn versions(&self, tree: &str) -> Result<Vec<VersionLine>, LibraryError> {
        match self {
            Self::File(path) => {
                let versions = LibraryFile::open(path).await?.versions(tree).await?;
                Ok(versions.into_iter().map(VersionLine::from).collect())
            }
            Self::Site(site) => {
                let path = format!("/trees/{}/versions", part(tree));
                let mut all: Vec<VersionLine> = Vec::new();
                loop {
                    let mut query = vec![("limit", SHORT_PAGE.to_owned())];
                    query.extend(all.last().map(|last| ("before", last.number.to_string())));
                    let page: Vec<VersionLine> = site.get(&path, &query)?;
                    if page.is_empty() {
                        return Ok(all);
                    }
                    all.extend(page);
                }
            }
        }
    }

    /// The document of a version.
    pub async fn document(&self, tree: &str, version: u32) -> Result<Vec<u8>, LibraryError> {
        let document = match self {
            Self::File(path) => {
                let document = LibraryFile::open(path).await?.document(tree, version).await?;
                document.map(|document| document.bytes)
            }
            Self::Site(site) => {
                site.found_file(&format!("/trees/{}/versions/{version}/document", part(tree)))?
            }
        };
        document.ok_or(LibraryError::NoVersion(version))
    }

    /// Saves a file as a new tree, or as a version of one. Gives the tree, the number of the version, and what is to be
    /// known of the file.
    pub async fn put(
        &self,
        tree: Option<&str>,
        put: &Put,
        name: String,
        bytes: Vec<u8>,
    ) -> Result<(String, u32, Vec<String>), LibraryError> {
        match self {
            Self::File(path) => put_into(path, tree, put, name, &bytes).await,
            Self::Site(site) => send_to(site, tree, put, name, bytes),
        }
    }

    /// Makes what a version holds the newest version; gives its number.
    pub async fn restore(&self, tree: &str, number: u32) -> Result<u32, LibraryError> {
        match self {
            Self::File(path) => {
                let contents = Contents::Of { tree: tree.to_owned(), version: number };
                let store = for_itself(path).await?;
                let added = store.add_version(tree, None, new_version(String::new(), contents)).await;
                store.close().await;
                added.map_err(|error| match error {
                    StoreError::NotFound(Missing::Version) => LibraryError::NoVersion(number),
                    error => error.into(),
                })
            }
            Self::Site(site) => {
                if !self.versions(tree).await?.iter().any(|version| version.number == number) {
                    return Err(LibraryError::NoVersion(number));
                }
                let path = format!("/trees/{}/versions/{number}/restore", part(tree));
                let told: PutTold =
                    site.send(Method::POST, &path, &[], ("application/json", b"{}".to_vec()))?;
                Ok(told.number)
            }
        }
    }

    /// What people say of a tree, as a page.
    pub async fn review(&self, tree: &str, language: Language) -> Result<String, LibraryError> {
        match self {
            Self::File(path) => review_in(path, tree, language).await,
            Self::Site(site) => {
                let query = [("language", named(&language))];
                let html = site.file(&format!("/trees/{}/review.html", part(tree)), &query)?;
                Ok(String::from_utf8_lossy(&html).into_owned())
            }
        }
    }
}

/// How a choice of the command line is called.
fn named(choice: &impl ValueEnum) -> String {
    choice.to_possible_value().map(|choice| choice.get_name().to_owned()).unwrap_or_default()
}

/// All entries of a server's list, page by page.
fn pages<T, P: DeserializeOwned>(
    site: &Site,
    path: &str,
    query: &[(&str, String)],
    told: impl Fn(P) -> (Vec<T>, Option<String>),
) -> Result<Vec<T>, LibraryError> {
    let mut all = Vec::new();
    let mut after: Option<String> = None;
    loop {
        let query: Vec<_> = query.iter().cloned().chain(after.map(|after| ("after", after))).collect();
        let (page, next) = told(site.get(path, &query)?);
        all.extend(page);
        after = next;
        if after.is_none() {
            return Ok(all);
        }
    }
}

async fn put_into(
    path: &Path,
    tree: Option<&str>,
    put: &Put,
    name: String,
    bytes: &[u8],
) -> Result<(String, u32, Vec<String>), LibraryError> {
    let import = import::Import {
        format: put.file.format,
        units: put.options.units(),
        seed: 1,
        species: put.options.species(),
        parameters: vec![put.options.parameters()],
        metamers: DEFAULT_METAMER_BUDGET,
    };
    let Imported { mut document, notes } = import::document(bytes, &import)
        .map_err(|cause| LibraryError::Import { path: put.file.path.clone(), cause })?;
    let png = document::thumbnail(&mut document);
    let thumbnail = Picture { media_type: "image/png".into(), bytes: png };
    let saved = Saved { thumbnail: Some(thumbnail), ..Saved::of(&document) };
    let version = new_version(text::note(&put.note)?, Contents::New(Box::new(saved)));
    let store = for_itself(path).await?;
    let put = match tree {
        Some(tree) => store.add_version(tree, None, version).await.map(|number| (tree.to_owned(), number)),
        None => {
            let id = name::unguessable();
            store.add_tree(NewTree { id: id.clone(), name, version }).await.map(|()| (id, 1))
        }
    };
    store.close().await;
    let (id, number) = put?;
    Ok((id, number, notes.iter().map(ImportNote::to_string).collect()))
}

fn send_to(
    site: &Site,
    tree: Option<&str>,
    put: &Put,
    name: String,
    bytes: Vec<u8>,
) -> Result<(String, u32, Vec<String>), LibraryError> {
    let note = text::note(&put.note)?;
    let mut query = vec![("format", put.file.format.ending().to_owned())];
    query.extend(put.options.in_query());
    let file = ("application/octet-stream", bytes);
    let (id, told) = match tree {
        Some(tree) => {
            query.extend((!note.is_empty()).then_some(("note", note)));
            let path = format!("/trees/{}/versions/import", part(tree));
            (tree.to_owned(), site.send::<PutTold>(Method::POST, &path, &query, file)?)
        }
        None => {
            query.push(("name", name));
            let told: PutTold = site.send(Method::POST, "/trees/import", &query, file)?;
            let id = told.id.clone().unwrap_or_default();
            if !note.is_empty() {
                let said = serde_json::to_vec(&json!({ "note": note })).unwrap_or_default();
                let path = format!("/trees/{}/versions/{}", part(&id), told.number);
                let _: VersionLine = site.send(Method::PATCH, &path, &[], ("application/json", said))?;
            }
            (id, told)
        }
    };
    Ok((id, told.number, told.import_notes.into_iter().map(|note| note.message).collect()))
}

async fn review_in(path: &Path, tree: &str, language: Language) -> Result<String, LibraryError> {
    let library = LibraryFile::open(path).await?;
    let all = library.trees(&TreeQuery { only: Some(tree.to_owned()), ..TreeQuery::default() }).await?;
    let tree = all.into_iter().next().ok_or(StoreError::NotFound(Missing::Tree))?;
    let document = library.document(&tree.id, tree.head.number).await?;
    let store = SqliteStore::open_beside(path).await?;
    let written = async {
        let pins = store.pins(&tree.id).await?;
        let states = match document.filter(|_| !pins.is_empty()) {
            Some(document) => review::states(&Document::from_bytes(&document.bytes)?, &pins),
            None => BTreeMap::new(),
        };
        Ok::<_, LibraryError>(review::summary(&store, &tree, &states, &now(), language).await?)
    };
    let html = written.await;
    store.close().await;
    html
}

fn new_version(note: String, contents: Contents) -> NewVersion {
    let principal = Principal::visitor().to_string();
    NewVersion { saved_at: now(), principal, author: None, note, contents, session: None }
}

/// The database, which no server uses meanwhile.
async fn for_itself(path: &Path) -> Result<SqliteStore, LibraryError> {
    if SqliteStore::is_in_use(path) {
        return Err(LibraryError::InUse(path.to_owned()));
    }
    Ok(SqliteStore::open(path).await?)
}
