//! The library: collections, tags, favourites, and who saved trees.

use axum::{Extension, Json, extract::State, http::StatusCode, response::IntoResponse};
use espalier_proto::{
    Problem, Reason,
    library::{ChangeCollection, NewCollection, TreeAuthor, TreeCollection, TreeTag},
};

use super::{
    Shared, audit,
    failure::{Body, Failure, Path},
};
use crate::{
    access::{Caller, Peer},
    name,
    store::{Collection, CollectionChange, DONE, Finding, Gift, Gifts, Missing},
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
    peer: Option<Extension<Peer>>,
    Path(id): Path<String>,
    Body(change): Body<ChangeCollection>,
) -> Result<Json<TreeCollection>, Failure> {
    let change = CollectionChange {
        name: change.name.map(String::from),
        parent: change.parent.map(Some).map(|id| id.filter(|id| !id.is_empty())),
    };
    let moved = match &change.parent {
        None => None,
        Some(to) => {
            let all = shared.store.collections().await?;
            let from = all.into_iter().find(|collection| collection.id == id);
            let from = from.and_then(|collection| collection.parent);
            let (from, to) = (from.as_deref(), to.as_deref());
            let is_seen_by_others = shared.ask_to_move(&caller, caller.role(), from, to).await?;
            is_seen_by_others.then(|| format!("{id}/{}", to.unwrap_or_default()))
        }
    };
    shared.store.change_collection(&id, change).await?;
    shared.tell_standings();
    if let Some(moved) = moved {
        noted(&shared, &caller, peer, moved).await;
    }
    let found = shared.store.collections().await?.into_iter().find(|collection| collection.id == id);
    Ok(Json(to_proto(found.ok_or(Missing::Collection)?)))
}

/// Notes that what lies somewhere is seen by other people from now on.
async fn noted(shared: &Shared, caller: &Caller, peer: Option<Extension<Peer>>, moved: String) {
    let (who, peer) = (audit::called(caller), peer.map(|Extension(peer)| peer));
    shared.note(who, peer, audit::MOVE, Some(moved), DONE.into()).await;
}

/// What lies in it lies in its parent then, and is seen no longer by those to whom it was given itself.
pub(super) async fn delete(
    State(shared): State<Shared>,
    caller: Caller,
    peer: Option<Extension<Peer>>,
    Path(id): Path<String>,
) -> Result<StatusCode, Failure> {
    let was_given = !shared.store.given(Gift::Collection(&id)).await?.is_empty();
    if was_given && !caller.owns_all() {
        let sentence = "That collection was given to people: only owners of the server can delete it.";
        let allowed = "a collection that was given to nobody";
        return Err(Problem::new(Reason::Forbidden, sentence).at("collection", allowed).into());
    }
    shared.store.delete_collection(&id).await?;
    shared.tell_standings();
    if was_given {
        noted(&shared, &caller, peer, id).await;
    }
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
