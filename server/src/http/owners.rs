//! Trees that are handed over to somebody (`AC18`).

use axum::{Extension, Json, extract::State};
use espalier_proto::{
    Problem, Reason,
    access::{HandOver, TreeOwner},
};
use espalier_session::Principal;

use super::{
    Shared,
    audit::Made,
    comments::UNNAMED,
    failure::{Body, Failure, Path},
    removals::{person, tree_of},
};
use crate::{
    access::Caller,
    store::{Heir, Missing, Standings},
};

/// What the list of what was done says, and the answer.
type Handed = (Extension<Made>, Json<TreeOwner>);

pub(super) async fn find(
    State(shared): State<Shared>,
    Path(session): Path<String>,
) -> Result<Json<TreeOwner>, Failure> {
    let heir = match tree_of(&shared, &session).await? {
        Some(tree) => shared.store.heir_of(&tree).await?,
        None => None,
    };
    Ok(Json(TreeOwner { name: heir.map(|heir| heir.name) }))
}

pub(super) async fn hand_over(
    State(shared): State<Shared>,
    Path(session): Path<String>,
    Extension(principal): Extension<Principal>,
    caller: Caller,
    Body(HandOver { person: number }): Body<HandOver>,
) -> Result<Handed, Failure> {
    let tree = saved(&shared, &session).await?;
    let there = person(&shared, &session, number, &principal).await?;
    let name = there.entrant.name.map_or_else(|| UNNAMED.to_owned(), |name| name.to_string());
    let heir = Heir { person: there.entrant.person.to_string(), name };
    if !caller.owns_all() && heir.person == caller.person() {
        let sentence = "Nobody hands a tree over to themselves.";
        return Err(Problem::new(Reason::Forbidden, sentence).at("person", "somebody else").into());
    }
    handed(&shared, &caller, &tree, Some(heir)).await
}

pub(super) async fn take_back(
    State(shared): State<Shared>,
    caller: Caller,
    Path(session): Path<String>,
) -> Result<Handed, Failure> {
    let tree = saved(&shared, &session).await?;
    handed(&shared, &caller, &tree, None).await
}

/// The tree of a session, which must be one.
async fn saved(shared: &Shared, session: &str) -> Result<String, Failure> {
    tree_of(shared, session).await?.ok_or_else(|| {
        let problem = Problem::new(Reason::NoTree, "The session belongs to no tree; save it first.");
        problem.at("session", "a session of a saved tree").into()
    })
}

/// Hands a tree over, or takes it back: that is for owners of the server, and for whoever has it.
async fn handed(shared: &Shared, caller: &Caller, tree: &str, to: Option<Heir>) -> Result<Handed, Failure> {
    let name = to.as_ref().map(|heir| heir.name.clone());
    let by = (!caller.owns_all()).then(|| caller.person());
    if !shared.store.hand_over(tree, to, by.as_deref()).await? {
        if by.is_none() {
            return Err(Missing::Tree.into());
        }
        let sentence = "Owners of the server alone hand a tree over, and whoever it was handed over to.";
        let allowed = "a session of a tree that was handed over to you";
        return Err(Problem::new(Reason::Forbidden, sentence).at("session", allowed).into());
    }
    shared.tell_standings();
    let made = Made(name.clone().unwrap_or_else(|| "nobody".to_owned()));
    Ok((Extension(made), Json(TreeOwner { name })))
}
