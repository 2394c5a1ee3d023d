//! The library: its trees as a whole.

use std::time::SystemTime;

use axum::{
    Extension, Json,
    extract::{Path, State},
    http::StatusCode,
    response::IntoResponse,
};
use base64::{Engine, engine::general_purpose::URL_SAFE_NO_PAD};
use espalier_proto::{
    Problem, ProblemCode,
    library::{ChangeTree, CopyTree, Origin, SaveTree, SavedTree, TreePage},
};
use espalier_session::Principal;
use serde::Deserialize;

use super::{
    Shared,
    failure::{Body, Failure, Query},
    revision::{self, Expected},
    text,
    versions::{self, Said, Saving},
};
use crate::{
    authority::{Action, Object},
    name,
    store::{Contents, Deletion, Library, NewTree, NewVersion, StoredTree, TreeChange, TreePlace, TreeQuery},
};

/// Trees in one answer.
const MAX_TREES: u32 = 500;

/// Which trees of the library to list.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Page {
    /// How many at most.
    limit: Option<u32>,
    /// The `next` of the page before.
    after: Option<String>,
    #[serde(default)]
    deleted: bool,
    template: Option<bool>,
}

pub(super) async fn list(
    State(shared): State<Shared>,
    Query(page): Query<Page>,
) -> Result<Json<TreePage>, Failure> {
    let limit = limit_of(page.limit, MAX_TREES)?;
    let after = page.after.as_deref().map(read_place).transpose()?;
    let query = TreeQuery { is_deleted: page.deleted, is_template: page.template, limit, after };
    let trees = shared.store.trees(&query).await?;
    let last = trees.last().filter(|_| trees.len() == limit as usize);
    let next = last.map(|tree| write_place(&query.place_of(tree)));
    let mut told = Vec::with_capacity(trees.len());
    for tree in trees {
        told.push(to_proto(&shared, tree).await);
    }
    Ok(Json(TreePage { trees: told, next }))
}

/// How many were asked for.
pub(super) fn limit_of(limit: Option<u32>, most: u32) -> Result<u32, Problem> {
    let limit = limit.unwrap_or(most);
    if (1..=most).contains(&limit) {
        Ok(limit)
    } else {
        Err(Problem::out_of_range("limit", limit, format!("1 to {most}")))
    }
}

/// A place in a list, as whoever lists hands it back unread.
fn write_place(place: &TreePlace) -> String {
    URL_SAFE_NO_PAD.encode(format!("{}\0{}", place.id, place.value))
}

fn read_place(text: &str) -> Result<TreePlace, Problem> {
    let bytes = URL_SAFE_NO_PAD.decode(text).ok();
    let read = bytes.and_then(|bytes| String::from_utf8(bytes).ok());
    let parts = read.as_deref().and_then(|read| read.split_once('\0'));
    let place = parts.map(|(id, value)| TreePlace { id: id.to_owned(), value: value.to_owned() });
    place.ok_or_else(|| Problem {
        field: Some("after".into()),
        allowed: Some("the next of the page before".into()),
        ..Problem::new(ProblemCode::Malformed, "after is not the next of a page")
    })
}

pub(super) async fn find(
    State(shared): State<Shared>,
    Path(id): Path<String>,
) -> Result<impl IntoResponse, Failure> {
    answer(&shared, &id).await
}

pub(super) async fn save(
    State(shared): State<Shared>,
    Extension(principal): Extension<Principal>,
    Body(save): Body<SaveTree>,
) -> Result<impl IntoResponse, Failure> {
    let name = text::name("name", &save.name)?;
    let SaveTree { session, note, author, thumbnail, .. } = save;
    let version = versions::read(&shared, &principal, Saving { session, note, author, thumbnail }).await?;
    Ok((StatusCode::CREATED, add(&shared, name, version).await?))
}

pub(super) async fn copy(
    State(shared): State<Shared>,
    Extension(principal): Extension<Principal>,
    Path(id): Path<String>,
    Body(copy): Body<CopyTree>,
) -> Result<impl IntoResponse, Failure> {
    shared.ask(&principal, Action::SaveTree, Object::Server)?;
    let name = text::name("name", &copy.name)?;
    let said = Said::parse(copy.author.as_deref(), copy.note.as_deref())?;
    let version = match copy.version {
        Some(version) => version,
        None => stored(&shared, &id).await?.head.number,
    };
    let contents = Contents::Of { tree: id, version };
    let version = versions::new(&principal, said, contents);
    Ok((StatusCode::CREATED, add(&shared, name, version).await?))
}

/// Puts a new tree into the library.
pub(super) async fn add(
    shared: &Shared,
    name: String,
    version: NewVersion,
) -> Result<impl IntoResponse + use<>, Failure> {
    let id = name::unguessable();
    shared.store.add_tree(NewTree { id: id.clone(), name, version }).await?;
    answer(shared, &id).await
}

pub(super) async fn change(
    State(shared): State<Shared>,
    Path(id): Path<String>,
    Expected(expected): Expected,
    Body(change): Body<ChangeTree>,
) -> Result<impl IntoResponse, Failure> {
    let change = TreeChange {
        name: change.name.map(|name| text::name("name", &name)).transpose()?,
        note: change.note.map(|note| text::note(&note)).transpose()?,
        is_template: change.template,
        ..TreeChange::default()
    };
    shared.store.change_tree(&id, expected, change).await?;
    answer(&shared, &id).await
}

pub(super) async fn delete(
    State(shared): State<Shared>,
    Path(id): Path<String>,
    Expected(expected): Expected,
) -> Result<StatusCode, Failure> {
    let deletion = Some(Deletion::Deleted(now()));
    shared.store.change_tree(&id, expected, TreeChange { deletion, ..TreeChange::default() }).await?;
    Ok(StatusCode::NO_CONTENT)
}

pub(super) async fn undelete(
    State(shared): State<Shared>,
    Path(id): Path<String>,
    Expected(expected): Expected,
) -> Result<impl IntoResponse, Failure> {
    let deletion = Some(Deletion::Undeleted);
    shared.store.change_tree(&id, expected, TreeChange { deletion, ..TreeChange::default() }).await?;
    answer(&shared, &id).await
}

/// The present time, as the library keeps it.
pub(super) fn now() -> String {
    humantime::format_rfc3339_millis(SystemTime::now()).to_string()
}

/// A tree as it is now.
async fn answer(shared: &Shared, id: &str) -> Result<impl IntoResponse + use<>, Failure> {
    let tree = stored(shared, id).await?;
    Ok((revision::tag(tree.revision), Json(to_proto(shared, tree).await)))
}

pub(super) async fn stored(shared: &Shared, id: &str) -> Result<StoredTree, Failure> {
    shared.store.tree(id).await?.ok_or_else(|| Failure::not_found("tree"))
}

async fn to_proto(shared: &Shared, tree: StoredTree) -> SavedTree {
    let people = match &tree.session {
        Some(session) => shared.sessions.people(session).await.len() as u32,
        None => 0,
    };
    let head = tree.head;
    SavedTree {
        thumbnail: versions::thumbnail_of(&tree.id, &head),
        id: tree.id,
        name: tree.name,
        note: tree.note,
        version: head.number,
        metamers: head.metamers,
        saved_at: head.saved_at,
        author: head.author,
        species: head.species,
        created_at: tree.created_at,
        template: tree.is_template,
        origin: tree.origin.map(|(tree, version)| Origin { tree, version }),
        deleted_at: tree.deleted_at,
        people,
        revision: tree.revision,
    }
}
