//! The library: collections, tags, favourites, and who saved trees.

use axum::{Json, extract::State, http::StatusCode, response::IntoResponse};
use espalier_proto::library::{ChangeCollection, NewCollection, TreeAuthor, TreeCollection, TreeTag};

use super::{
    Shared,
    failure::{Body, Failure, Path},
};
use crate::{
    access::Caller,
    name,
    store::{Collection, CollectionChange, Finding, Gifts, Missing},
};

pub(super) async fn list(
    State(shared): State<Shared>,
    caller: Caller,
) -> Result<Json<Vec<TreeCollection>>, Failure> {
    let mut all = shared.store.collections().await?;
    if !caller.sees_all() {
        let own = shared.store.collections_of(&caller.person()).await?;
        all.retain(|collection| own.contains(&collection.id));
        for collection in &mut all {
            collection.parent.take_if(|parent| !own.contains(parent));
        }
    }
    Ok(Json(all.into_iter().map(to_proto).collect()))
}

pub(super) async fn add(
    State(shared): State<Shared>,
    Body(new): Body<NewCollection>,
) -> Result<impl IntoResponse, Failure> {
    let (id, name) = (name::unguessable(), new.name.into());
    let new = Collection { id, name, parent: new.parent, trees: 0 };
    shared.store.add_collection(new.clone()).await?;
    Ok((StatusCode::CREATED, Json(to_proto(new))))
}

pub(super) async fn change(
    State(shared): State<Shared>,
    caller: Caller,
    Path(id): Path<String>,
    Body(change): Body<ChangeCollection>,
) -> Result<Json<TreeCollection>, Failure> {
    let parent = change.parent.as_deref().filter(|id| !id.is_empty());
    let from = shared.store.collections().await?.into_iter().find(|collection| collection.id == id);
    let from = from.and_then(|collection| collection.parent);
    shared.ask_to_put_in(&caller, caller.role(), from.as_deref(), parent).await?;
    let change = CollectionChange {
        name: change.name.map(String::from),
        parent: change.parent.map(Some).map(|id| id.filter(|id| !id.is_empty())),
    };
    shared.store.change_collection(&id, change).await?;
    shared.tell_standings();
    let found = shared.store.collections().await?.into_iter().find(|collection| collection.id == id);
    Ok(Json(to_proto(found.ok_or(Missing::Collection)?)))
}

pub(super) async fn delete(
    State(shared): State<Shared>,
    Path(id): Path<String>,
) -> Result<StatusCode, Failure> {
    shared.store.delete_collection(&id).await?;
    shared.tell_standings();
    Ok(StatusCode::NO_CONTENT)
}

pub(super) async fn tags(State(shared): State<Shared>) -> Result<Json<Vec<TreeTag>>, Failure> {
    let tags = shared.store.tags().await?;
    Ok(Json(tags.into_iter().map(|(tag, trees)| TreeTag { tag, trees }).collect()))
}

pub(super) async fn authors(State(shared): State<Shared>) -> Result<Json<Vec<TreeAuthor>>, Failure> {
    let authors = shared.store.authors().await?;
    Ok(Json(authors.into_iter().map(|(author, trees)| TreeAuthor { author, trees }).collect()))
}

pub(super) async fn like(
    State(shared): State<Shared>,
    caller: Caller,
    Path(tree): Path<String>,
) -> Result<StatusCode, Failure> {
    shared.store.set_favourite(&caller.person(), &tree, true).await?;
    Ok(StatusCode::NO_CONTENT)
}

pub(super) async fn unlike(
    State(shared): State<Shared>,
    caller: Caller,
    Path(tree): Path<String>,
) -> Result<StatusCode, Failure> {
    shared.store.set_favourite(&caller.person(), &tree, false).await?;
    Ok(StatusCode::NO_CONTENT)
}

fn to_proto(collection: Collection) -> TreeCollection {
    let Collection { id, name, parent, trees } = collection;
    TreeCollection { id, name, parent, trees }
}
