//! To whom trees and collections are given (`AC22`).

use std::time::{Duration, Instant};

use axum::{Extension, Json, extract::State, http::StatusCode, response::IntoResponse};
use espalier_proto::{
    Problem, Reason,
    access::{NewMember, Role, TreeMember},
};

use super::{
    Shared,
    audit::Made,
    failure::{Body, Failure, Path},
    trees,
};
use crate::{
    access::{Action, Caller, Rate, SecretHash},
    store::{Finding, Gift, Gifts, Given, Groups, Missing, Receiver, StoreError, Users, folded},
};

/// Names of nobody that somebody gives to in ten minutes.
const NAMES_OF: u32 = 20;
const NAMES_TIME: Duration = Duration::from_mins(10);

/// How often somebody gave to a name of nobody: else whoever owns a tree would find out who can log in by guessing.
#[derive(Debug)]
pub struct NamesTried(Rate<SecretHash>);

impl Default for NamesTried {
    fn default() -> Self {
        Self(Rate::new(NAMES_OF, NAMES_TIME))
    }
}

impl NamesTried {
    /// Counts a name as that of nobody until it is known that it is not; for whom, if they may not see who can log in.
    fn count(shared: &Shared, caller: &Caller) -> Result<Option<SecretHash>, Failure> {
        let sees_people = caller.role() >= Action::SeePeople.least();
        let Some(by) = caller.counted_as().filter(|_| !sees_people) else { return Ok(None) };
        let counted = shared.names_tried.0.count(by, Instant::now());
        counted.map_err(|wait| Failure::too_often("name", "Too many names were those of nobody.", wait))?;
        Ok(Some(by))
    }
}

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
    caller: Caller,
    Path(tree): Path<String>,
    Body(new): Body<NewMember>,
) -> Result<impl IntoResponse, Failure> {
    add(&shared, &caller, Gift::Tree(&tree), new).await
}

pub(super) async fn add_to_collection(
    State(shared): State<Shared>,
    caller: Caller,
    Path(collection): Path<String>,
    Body(new): Body<NewMember>,
) -> Result<impl IntoResponse, Failure> {
    add(&shared, &caller, Gift::Collection(&collection), new).await
}

pub(super) async fn remove_from_tree(
    State(shared): State<Shared>,
    caller: Caller,
    Path((tree, member)): Path<(String, String)>,
) -> Result<(Extension<Made>, StatusCode), Failure> {
    trees::stored(&shared, &tree).await?;
    remove(&shared, &caller, Gift::Tree(&tree), &member).await
}

pub(super) async fn remove_from_collection(
    State(shared): State<Shared>,
    caller: Caller,
    Path((collection, member)): Path<(String, String)>,
) -> Result<(Extension<Made>, StatusCode), Failure> {
    is_there(&shared, &collection).await?;
    remove(&shared, &caller, Gift::Collection(&collection), &member).await
}

async fn list(shared: &Shared, what: Gift<'_>) -> Result<Json<Vec<TreeMember>>, Failure> {
    Ok(Json(shared.store.given(what).await?.into_iter().map(described).collect()))
}

async fn add(
    shared: &Shared,
    caller: &Caller,
    what: Gift<'_>,
    NewMember { name, group, role }: NewMember,
) -> Result<impl IntoResponse + use<>, Failure> {
    let name = String::from(name);
    let to = if group { Receiver::Group(name.clone()) } else { Receiver::User(name.clone()) };
    let role = Role::from(role);
    ask_to_give(shared, caller, what, &to, role).await?;
    let tried = NamesTried::count(shared, caller)?;
    match shared.store.give(what, &to, role).await {
        Err(StoreError::NotFound(Missing::User)) => {
            return Err(Failure::none_such("user", "name", "the name of somebody who can log in"));
        }
        Err(StoreError::NotFound(Missing::Group)) => {
            return Err(Failure::none_such("group", "name", "the name of a group"));
        }
        given => given?,
    }
    if let Some(by) = tried {
        shared.names_tried.0.uncount(by);
    }
    shared.tell_standings();
    let given = shared.store.given(what).await?.into_iter().find(|given| given.to.is_called(&to));
    let given = given.ok_or(Missing::User)?;
    let made = Made(format!("{name} {}", role.name()));
    Ok((StatusCode::CREATED, Extension(made), Json(described(given))))
}

/// Whether somebody may give it so. Who was given it to own, or had it handed over, gives it to others to draw with, and to
/// nobody whom owners of the server gave it to own: so those can take back all that was theirs (`AC22`).
async fn ask_to_give(
    shared: &Shared,
    caller: &Caller,
    what: Gift<'_>,
    to: &Receiver,
    role: Role,
) -> Result<(), Failure> {
    if caller.owns_all() {
        return Ok(());
    }
    if role >= Role::Owner {
        return Err(not_yours("Owners of the server alone give a tree to own.", "role", "editor or less"));
    }
    let own = caller.user().unwrap_or_default();
    let own = shared.store.users().await?.into_iter().find(|user| user.id == own);
    if let Some(own) = own {
        let (name, called) = (folded(to.name()), folded(&own.name));
        let is_own = match to {
            Receiver::User(_) => name == called,
            Receiver::Group(_) => {
                let mut groups = shared.store.groups().await?.into_iter();
                groups.any(|group| folded(&group.name) == name && group.members.contains(&own.name))
            }
        };
        if is_own {
            let sentence = "Nobody gives a tree to themselves, or to a group that they are in.";
            return Err(not_yours(sentence, "name", "somebody else, or a group of others"));
        }
    }
    let given = shared.store.given(what).await?;
    if given.iter().any(|given| given.role >= Role::Owner && given.to.is_called(to)) {
        return Err(not_yours(OWNERS, "name", "somebody who does not own it"));
    }
    Ok(())
}

/// What is said of those who own it.
const OWNERS: &str = "Owners of the server alone say who owns a tree.";

fn not_yours(sentence: &str, field: &str, allowed: &str) -> Failure {
    Problem::new(Reason::Forbidden, sentence).at(field, allowed).into()
}

async fn remove(
    shared: &Shared,
    caller: &Caller,
    what: Gift<'_>,
    member: &str,
) -> Result<(Extension<Made>, StatusCode), Failure> {
    let given = shared.store.given(what).await?.into_iter().find(|given| given.id == member);
    // What is one's own one may give up.
    let is_theirs = |given: &Given| caller.owns_all() || caller.user() == Some(&given.id);
    if given.as_ref().is_some_and(|given| given.role >= Role::Owner && !is_theirs(given)) {
        return Err(not_yours(OWNERS, "member", "somebody who does not own it, or yourself"));
    }
    if let Some(given) = given
        && shared.store.take_back(what, member).await?
    {
        shared.tell_standings();
        return Ok((Extension(Made(given.to.name().to_owned())), StatusCode::NO_CONTENT));
    }
    Err(Failure::none_such("member", "member", "the identifier of a user or a group that was given it"))
}

async fn is_there(shared: &Shared, id: &str) -> Result<(), Failure> {
    let is_there = shared.store.collections().await?.iter().any(|collection| collection.id == id);
    if is_there { Ok(()) } else { Err(Missing::Collection.into()) }
}

fn described(Given { id, to, role }: Given) -> TreeMember {
    let group = matches!(to, Receiver::Group(_));
    TreeMember { id, name: to.name().to_owned(), group, role: role.into() }
}
