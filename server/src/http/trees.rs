//! The library of saved trees.

use std::time::SystemTime;

use axum::{
    Extension, Json,
    extract::{Path, Query, State, rejection::QueryRejection},
    http::{StatusCode, header},
    response::IntoResponse,
};
use espalier_proto::{
    Problem, ProblemCode,
    library::{RenameTree, SaveTree, SavedTree},
};
use espalier_session::Principal;
use serde::Deserialize;

use super::{
    Shared,
    failure::{Body, Failure},
    sessions, thumbnail,
};
use crate::{
    SIMULATION_VERSION,
    authority::{Action, Object},
    name,
    store::{NewTree, Picture, Store, StoredTree, TreeDocument, TreeKey},
};

const MAX_NAME_CHARACTERS: usize = 80;
/// Trees in one answer.
const MAX_TREES: u32 = 500;

/// Which trees of the library to list.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Page {
    /// How many at most.
    limit: Option<u32>,
    /// The last tree of the page before, which may be gone by now,
    behind: Option<String>,
    /// and when it was saved.
    saved_at: Option<String>,
}

impl Page {
    /// The place that the page begins behind.
    fn key(self) -> Result<Option<TreeKey>, Problem> {
        let missing = |field: &str| Problem {
            code: ProblemCode::Malformed,
            field: Some(field.into()),
            allowed: Some("as the last tree of the page before has it".into()),
            message: format!("{field} is missing: a page begins behind the id and the time of a tree"),
        };
        match (self.behind, self.saved_at) {
            (None, None) => Ok(None),
            (Some(id), Some(saved_at)) => Ok(Some(TreeKey { saved_at, id })),
            (Some(_), None) => Err(missing("saved_at")),
            (None, Some(_)) => Err(missing("behind")),
        }
    }
}

pub(super) async fn list(
    State(shared): State<Shared>,
    page: Result<Query<Page>, QueryRejection>,
) -> Result<Json<Vec<SavedTree>>, Failure> {
    let Query(page) = page.map_err(|rejection| Failure::bad_query(&rejection))?;
    let limit = page.limit.unwrap_or(MAX_TREES);
    if !(1..=MAX_TREES).contains(&limit) {
        return Err(Problem::out_of_range("limit", limit, format!("1 to {MAX_TREES}")).into());
    }
    let behind = page.key()?;
    let trees = shared.store.trees(limit, behind.as_ref()).await?;
    Ok(Json(trees.into_iter().map(to_proto).collect()))
}

pub(super) async fn save(
    State(shared): State<Shared>,
    Extension(principal): Extension<Principal>,
    Body(save): Body<SaveTree>,
) -> Result<impl IntoResponse, Failure> {
    let name = parse_name(&save.name)?;
    let thumbnail = save.thumbnail.as_deref().map(thumbnail::parse).transpose()?;
    shared.ask(&principal, Action::TakeTree, Object::Session(&save.session))?;
    let document = sessions::open(&shared, &save.session).await?.read().await?;
    let tree = keep(&shared, name, document.metamers, document.bytes, thumbnail).await?;
    Ok((StatusCode::CREATED, Json(tree)))
}

/// Puts a document into the library.
pub(super) async fn keep(
    shared: &Shared,
    name: String,
    metamers: u32,
    bytes: Vec<u8>,
    thumbnail: Option<Picture>,
) -> Result<SavedTree, Failure> {
    let id = name::unguessable();
    let tree = NewTree {
        id: id.clone(),
        name,
        metamers,
        saved_at: humantime::format_rfc3339_millis(SystemTime::now()).to_string(),
        document: TreeDocument { simulation_version: SIMULATION_VERSION, bytes },
        thumbnail,
    };
    shared.store.save_tree(tree).await?;
    find(shared, &id).await
}

pub(super) async fn rename(
    State(shared): State<Shared>,
    Path(id): Path<String>,
    Body(rename): Body<RenameTree>,
) -> Result<impl IntoResponse, Failure> {
    let name = parse_name(&rename.name)?;
    if !shared.store.rename_tree(&id, &name).await? {
        return Err(Failure::not_found("tree"));
    }
    Ok(Json(find(&shared, &id).await?))
}

pub(super) async fn delete(
    State(shared): State<Shared>,
    Path(id): Path<String>,
) -> Result<StatusCode, Failure> {
    if shared.store.delete_tree(&id).await? {
        Ok(StatusCode::NO_CONTENT)
    } else {
        Err(Failure::not_found("tree"))
    }
}

pub(super) async fn thumbnail(
    State(shared): State<Shared>,
    Path(id): Path<String>,
) -> Result<impl IntoResponse, Failure> {
    let picture = shared.store.thumbnail(&id).await?.ok_or_else(|| Failure::not_found("picture"))?;
    let headers = [
        (header::CONTENT_TYPE, picture.media_type),
        // A tree keeps its picture for life, and no two trees share an identifier.
        (header::CACHE_CONTROL, "private, max-age=31536000, immutable".into()),
    ];
    Ok((headers, picture.bytes))
}

async fn find(shared: &Shared, id: &str) -> Result<SavedTree, Failure> {
    shared.store.tree(id).await?.map(to_proto).ok_or_else(|| Failure::not_found("tree"))
}

fn to_proto(tree: StoredTree) -> SavedTree {
    let thumbnail = tree.has_thumbnail.then(|| format!("/api/trees/{}/thumbnail", tree.key.id));
    SavedTree {
        id: tree.key.id,
        name: tree.name,
        metamers: tree.metamers,
        saved_at: tree.key.saved_at,
        thumbnail,
    }
}

pub(super) fn parse_name(name: &str) -> Result<String, Problem> {
    let name = name.trim();
    let length = name.chars().count();
    if !(1..=MAX_NAME_CHARACTERS).contains(&length) {
        let value = format!("{length} characters long");
        return Err(Problem::out_of_range("name", value, format!("1 to {MAX_NAME_CHARACTERS} characters")));
    }
    if name.chars().any(char::is_control) {
        return Err(Problem::out_of_range("name", "not plain text", "characters one can see"));
    }
    Ok(name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_trimmed_and_counted_in_characters() {
        assert_eq!(parse_name("  Old oak ").as_deref(), Ok("Old oak"));
        assert_eq!(parse_name(&"ö".repeat(80)), Ok("ö".repeat(80)));
        for bad in ["", "   ", "\u{3000}", &"ö".repeat(81), "two\nlines", "bell\u{7}"] {
            assert_eq!(parse_name(bad).unwrap_err().field.as_deref(), Some("name"), "{bad:?}");
        }
        assert_eq!(
            parse_name("").unwrap_err().message,
            "name is 0 characters long; allowed: 1 to 80 characters"
        );
    }
}
