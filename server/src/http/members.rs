//! To whom trees and collections are given (`AC22`).

use axum::{Extension, Json, extract::State, http::StatusCode, response::IntoResponse};
use espalier_proto::access::{NewMember, TreeMember};

use super::{
    Shared,
    audit::Made,
    failure::{Body, Failure, Path},
    trees,
};
use crate::store::{Finding, Gift, Gifts, Given, Missing, Receiver, StoreError};

pub(super) async fn of_tree(
    State(shared): State<Shared>,
    Path(tree): Path<String>,
) -> Result<Json<Vec<TreeMember>>, Failure> {
    trees::stored(&shared, &tree).await?;
    list(&shared, Gift::Tree(&tree)).await
}

pub(super) async fn of_collection(
    State(shared): State<Shared>,
    Path(collection): Path<String>,
) -> Result<Json<Vec<TreeMember>>, Failure> {
    is_there(&shared, &collection).await?;
    list(&shared, Gift::Collection(&collection)).await
}

pub(super) async fn add_to_tree(
    State(shared): State<Shared>,
    Path(tree): Path<String>,
    Body(new): Body<NewMember>,
) -> Result<impl IntoResponse, Failure> {
    add(&shared, Gift::Tree(&tree), new).await
}

pub(super) async fn add_to_collection(
    State(shared): State<Shared>,
    Path(collection): Path<String>,
    Body(new): Body<NewMember>,
) -> Result<impl IntoResponse, Failure> {
    add(&shared, Gift::Collection(&collection), new).await
}

pub(super) async fn remove_from_tree(
    State(shared): State<Shared>,
    Path((tree, member)): Path<(String, String)>,
) -> Result<StatusCode, Failure> {
    trees::stored(&shared, &tree).await?;
    remove(&shared, Gift::Tree(&tree), &member).await
}

pub(super) async fn remove_from_collection(
    State(shared): State<Shared>,
    Path((collection, member)): Path<(String, String)>,
) -> Result<StatusCode, Failure> {
    is_there(&shared, &collection).await?;
    remove(&shared, Gift::Collection(&collection), &member).await
}

async fn list(shared: &Shared, what: Gift<'_>) -> Result<Json<Vec<TreeMember>>, Failure> {
    Ok(Json(shared.store.given(what).await?.into_iter().map(described).collect()))
}

async fn add(
    shared: &Shared,
    what: Gift<'_>,
    NewMember { name, group, role }: NewMember,
) -> Result<impl IntoResponse + use<>, Failure> {
    let name = String::from(name);
    let to = if group { Receiver::Group(name.clone()) } else { Receiver::User(name.clone()) };
    match shared.store.give(what, &to, role.into()).await {
        Err(StoreError::NotFound(Missing::User)) => {
            return Err(Failure::none_such("user", "name", "the name of somebody who can log in"));
        }
        Err(StoreError::NotFound(Missing::Group)) => {
            return Err(Failure::none_such("group", "name", "the name of a group"));
        }
        given => given?,
    }
    shared.tell_standings();
    let given = shared.store.given(what).await?.into_iter().find(|given| is_called(given, &to));
    let given = given.ok_or(Missing::User)?;
    Ok((StatusCode::CREATED, Extension(Made(name)), Json(described(given))))
}

async fn remove(shared: &Shared, what: Gift<'_>, member: &str) -> Result<StatusCode, Failure> {
    let given = shared.store.given(what).await?.into_iter().find(|given| given.id == member);
    if let Some(given) = given
        && shared.store.take_back(what, &given.to).await?
    {
        shared.tell_standings();
        return Ok(StatusCode::NO_CONTENT);
    }
    Err(Failure::none_such("member", "member", "the identifier of a user or a group that was given it"))
}

/// Whether it is of the same kind and has the same name, as names are compared.
fn is_called(given: &Given, to: &Receiver) -> bool {
    let is_same_kind = std::mem::discriminant(&given.to) == std::mem::discriminant(to);
    is_same_kind && crate::store::folded(given.to.name()) == crate::store::folded(to.name())
}

async fn is_there(shared: &Shared, id: &str) -> Result<(), Failure> {
    let is_there = shared.store.collections().await?.iter().any(|collection| collection.id == id);
    if is_there { Ok(()) } else { Err(Missing::Collection.into()) }
}

fn described(Given { id, to, role }: Given) -> TreeMember {
    let group = matches!(to, Receiver::Group(_));
    TreeMember { id, name: to.name().to_owned(), group, role: role.into() }
}
