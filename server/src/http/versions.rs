//! The library: versions of a tree.

use axum::{
    Json,
    extract::State,
    http::{HeaderMap, HeaderName, StatusCode, header},
    response::{IntoResponse, Response},
};
use espalier_proto::{
    library::{ChangeVersion, ImportNote, RestoreVersion, SaveVersion, TreeVersion},
    text::{Name, Note},
    thumbnail,
    version::TURNTABLE_PICTURES,
};
use schemars::JsonSchema;
use serde::Deserialize;

use super::{
    Shared,
    exports::{self, Wish},
    failure::{Body, Failure, Path, Query},
    guard::Named,
    limit::Limit,
    ranges,
    revision::{self, Expected},
    sessions, trees,
};
use crate::{
    SIMULATION_VERSION,
    access::{Action, Caller},
    drawn::{DrawError, Kind, Png, Why},
    formats::DOCUMENT,
    pool::Panicked,
    store::{Contents, Library, NewVersion, Saved, StoredVersion, TreeChange, TreeDocument},
    time::now,
};

/// Versions in one answer.
const MAX_VERSIONS: u32 = 200;
/// What is there never changes, and nothing else ever takes its place.
const FOR_GOOD: (HeaderName, &str) = (header::CACHE_CONTROL, "private, max-age=31536000, immutable");

/// Pixels along a side of the pictures of a turntable: those of a card.
const TURNTABLE_SIDE: usize = 240;

/// A version from the front,
pub(super) const THUMBNAIL: Kind = Kind::Thumbnail;
/// and from all around.
pub(super) const TURNTABLE: Kind = Kind::Turntable { side: TURNTABLE_SIDE, count: TURNTABLE_PICTURES };

/// Which versions to list.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub(super) struct Page {
    /// How many at most, 1 to 200.
    #[serde(default)]
    limit: Limit<MAX_VERSIONS>,
    /// Those before this number.
    before: Option<u32>,
}

pub(super) async fn list(
    State(shared): State<Shared>,
    Path(tree): Path<String>,
    Query(page): Query<Page>,
) -> Result<Json<Vec<TreeVersion>>, Failure> {
    trees::stored(&shared, &tree).await?;
    let versions = shared.store.versions(&tree, page.limit.get(), page.before).await?;
    Ok(Json(versions.into_iter().map(|version| to_proto(&tree, version)).collect()))
}

/// What is saved of a session.
pub(super) struct Saving {
    pub(super) session: String,
    pub(super) note: Option<Note>,
    pub(super) author: Option<Name>,
    pub(super) thumbnail: Option<String>,
}

/// What a session holds now, as a version to be saved.
pub(super) async fn read(shared: &Shared, caller: &Caller, saving: Saving) -> Result<NewVersion, Failure> {
    let Saving { session, note, author, thumbnail } = saving;
    let thumbnail = thumbnail.as_deref().map(thumbnail::from_data_url).transpose()?;
    let said = Said::by(caller, author, note);
    shared.ask(caller, Action::TakeTree, Named::Session(&session)).await?;
    let read = sessions::open(shared, &session).await?.read().await?;
    let document = TreeDocument { simulation_version: SIMULATION_VERSION, bytes: read.bytes };
    let saved = Saved { document, metamers: read.metamers, species: read.species, thumbnail };
    let version = new(caller, said, Contents::New(Box::new(saved)));
    // The session belongs to the tree from then on: that is for those who may change what it holds.
    let takes = shared.ask(caller, Action::EditSession, Named::Session(&session)).await.is_ok();
    Ok(NewVersion { session: takes.then_some((session, read.through)), ..version })
}

/// What is said of what is saved, and by whom.
pub(super) struct Said {
    author: Option<String>,
    note: String,
}

impl Said {
    pub(super) fn by(caller: &Caller, author: Option<Name>, note: Option<Note>) -> Self {
        let author = caller.called(author.map(String::from));
        Self { author, note: note.map(String::from).unwrap_or_default() }
    }
}

/// A version that holds this.
pub(super) fn new(caller: &Caller, said: Said, contents: Contents) -> NewVersion {
    let Said { author, note } = said;
    let (saved_at, principal) = (now(), caller.person());
    NewVersion { saved_at, principal, author, note, contents, session: None }
}

pub(super) async fn save(
    State(shared): State<Shared>,
    caller: Caller,
    Path(tree): Path<String>,
    Expected(expected): Expected,
    Body(save): Body<SaveVersion>,
) -> Result<impl IntoResponse, Failure> {
    let SaveVersion { session, note, author, thumbnail } = save;
    let version = read(&shared, &caller, Saving { session, note, author, thumbnail }).await?;
    add(&shared, &tree, expected, version).await
}

pub(super) async fn restore(
    State(shared): State<Shared>,
    caller: Caller,
    Path((tree, number)): Path<(String, u32)>,
    Expected(expected): Expected,
    Body(restore): Body<RestoreVersion>,
) -> Result<impl IntoResponse, Failure> {
    let contents = Contents::Of { tree: tree.clone(), version: number };
    let said = Said::by(&caller, restore.author, restore.note);
    let version = new(&caller, said, contents);
    add(&shared, &tree, expected, version).await
}

/// Makes this the newest version of a tree.
pub(super) async fn add(
    shared: &Shared,
    tree: &str,
    expected: Option<u64>,
    version: NewVersion,
) -> Result<impl IntoResponse + use<>, Failure> {
    add_noted(shared, tree, expected, version, Vec::new()).await
}

/// The same with what is to be known of the file that it was made of (`IM3`).
pub(super) async fn add_noted(
    shared: &Shared,
    tree: &str,
    expected: Option<u64>,
    version: NewVersion,
    import_notes: Vec<ImportNote>,
) -> Result<impl IntoResponse + use<>, Failure> {
    let number = shared.store.add_version(tree, expected, version).await?;
    shared.ahead.add(tree, number);
    let (found, revision) =
        (version_of(shared, tree, number).await?, trees::stored(shared, tree).await?.revision);
    let found = TreeVersion { import_notes, ..found };
    Ok((StatusCode::CREATED, revision::tag(revision), Json(found)))
}

pub(super) async fn change(
    State(shared): State<Shared>,
    Path((tree, number)): Path<(String, u32)>,
    Expected(expected): Expected,
    Body(change): Body<ChangeVersion>,
) -> Result<impl IntoResponse, Failure> {
    let change = TreeChange { version_note: Some((number, change.note.into())), ..TreeChange::default() };
    shared.store.change_tree(&tree, expected, change).await?;
    let revision = trees::stored(&shared, &tree).await?.revision;
    Ok((revision::tag(revision), Json(version_of(&shared, &tree, number).await?)))
}

async fn version_of(shared: &Shared, tree: &str, number: u32) -> Result<TreeVersion, Failure> {
    let found = shared.store.versions(tree, 1, Some(number.saturating_add(1))).await?.pop();
    let found = found.filter(|version| version.number == number);
    found.map(|version| to_proto(tree, version)).ok_or_else(Failure::no_version)
}

/// The document of a version: the same as its file of that format.
pub(super) async fn document(
    shared: State<Shared>,
    version: Path<(String, u32)>,
    caller: Caller,
    asked: HeaderMap,
) -> Result<Response, Failure> {
    exports::take_version(shared, version, caller, (Wish::default(), asked), &DOCUMENT).await
}

/// The picture that was saved with a version, or else one that is drawn (`LB1`).
pub(super) async fn thumbnail(
    State(shared): State<Shared>,
    Path((tree, number)): Path<(String, u32)>,
    asked: HeaderMap,
) -> Result<Response, Failure> {
    if let Some(picture) = shared.store.thumbnail(&tree, number).await? {
        let headers = [(header::CONTENT_TYPE, picture.media_type), (FOR_GOOD.0, FOR_GOOD.1.to_owned())];
        return ranges::answer_with(&asked, headers, picture.bytes);
    }
    drawn(&shared, &tree, number, THUMBNAIL, &asked).await
}

/// Pictures of a version from all around, side by side (`LB9`).
pub(super) async fn turntable(
    State(shared): State<Shared>,
    Path((tree, number)): Path<(String, u32)>,
    asked: HeaderMap,
) -> Result<Response, Failure> {
    drawn(&shared, &tree, number, TURNTABLE, &asked).await
}

/// A picture that the server draws. Whoever goes away leaves it to those who come after.
async fn drawn(
    shared: &Shared,
    tree: &str,
    number: u32,
    kind: Kind,
    asked: &HeaderMap,
) -> Result<Response, Failure> {
    let png = picture_of(shared, Why::Asked, tree, number, kind).await?;
    ranges::answer_with(asked, [(header::CONTENT_TYPE, "image/png"), FOR_GOOD], png.to_vec())
}

/// The picture that is kept of a version, or else one that is drawn.
pub(super) async fn picture_of(
    shared: &Shared,
    why: Why,
    tree: &str,
    number: u32,
    kind: Kind,
) -> Result<Png, Failure> {
    if let Some(png) = shared.drawn.kept(tree, number, kind) {
        return Ok(png);
    }
    let saved = sessions::kept_document(shared, tree, number).await?;
    let (shared, key) = (shared.clone(), (tree.to_owned(), number, kind));
    let drawing =
        tokio::spawn(async move { shared.drawn.of(key, saved, (&shared.memory, &shared.pool), why).await });
    drawing.await.map_err(|_| Panicked)?.map_err(|error| match error {
        DrawError::Document(error) => sessions::unreadable(tree, &error),
        DrawError::Full(full) => full.into(),
        DrawError::Panicked(panicked) => panicked.into(),
    })
}

/// Where the picture of a version is.
pub(super) fn thumbnail_of(tree: &str, version: u32) -> String {
    format!("/api/v1/trees/{tree}/versions/{version}/thumbnail")
}

fn to_proto(tree: &str, version: StoredVersion) -> TreeVersion {
    TreeVersion {
        import_notes: Vec::new(),
        thumbnail: thumbnail_of(tree, version.number),
        document: format!("/api/v1/trees/{tree}/versions/{}/document", version.number),
        number: version.number,
        saved_at: version.saved_at,
        author: version.author,
        note: version.note,
        metamers: version.metamers,
        species: version.species,
        restored: version.restored,
    }
}
