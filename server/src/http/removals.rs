//! People whom an owner removes from a session, and who are let back (`AC17`).

use std::time::{Duration, SystemTime};

use axum::{Extension, Json, extract::State, http::StatusCode, response::IntoResponse};
use espalier_proto::{
    Problem, Reason,
    access::{KeptOut, RemovedPerson, Role},
    version::{CloseCode, KEPT_OUT_HOURS},
};
use espalier_session::{Entrant, Principal};

use super::{
    Shared,
    audit::Made,
    comments::{UNNAMED, called},
    failure::{Failure, Path},
};
use crate::{
    access::Caller,
    name,
    store::{Library, Passes, Removal, Removed, Room, Standings, Store},
    time::{now, written},
};

pub(super) async fn remove(
    State(shared): State<Shared>,
    Path((session, number)): Path<(String, u32)>,
    Extension(principal): Extension<Principal>,
    caller: Caller,
) -> Result<impl IntoResponse, Failure> {
    let there = person(&shared, &session, number, &principal).await?;
    let Entrant { person, name, role, .. } = there.entrant;
    if *person == caller.person() || role >= Role::Owner {
        let forbidden = espalier_session::forbidden();
        return Err(forbidden.at("person", "somebody else, who is no owner").into());
    }
    let name = name.map_or_else(|| UNNAMED.to_owned(), |name| name.to_string());
    let (at, until) = (now(), written(SystemTime::now() + Duration::from_hours(KEPT_OUT_HOURS.into())));
    let pass = match Caller::pass_of(&person) {
        Some(hash) => shared.store.pass(hash, &at).await?.filter(|pass| pass.tree.is_some()),
        None => None,
    };
    let removal = Removal {
        id: name::unguessable(),
        room: tree_of(&shared, &session)
            .await?
            .map_or_else(|| Room::Session(&session).written(), |tree| Room::Tree(&tree).written()),
        person: person.to_string(),
        name: name.clone(),
        by: called(&caller, there.asking),
        until: until.clone(),
        is_revoked: pass.is_some(),
    };
    // In this order, so that a guest whose link is gone hears by whom.
    shared.store.keep_out(removal, &at).await?;
    if let Some(pass) = &pass {
        shared.store.take_pass(&pass.id).await?;
    }
    shared.tell_standings();
    let until = pass.is_none().then_some(until);
    Ok((Extension(Made(name.clone())), Json(RemovedPerson { name, until })))
}

pub(super) async fn list(
    State(shared): State<Shared>,
    Path(session): Path<String>,
) -> Result<Json<Vec<KeptOut>>, Failure> {
    let removals = kept_out(&shared, &session).await?.into_iter();
    let described = removals.map(|Removal { id, name, by, until, .. }| KeptOut { id, name, by, until });
    Ok(Json(described.collect()))
}

pub(super) async fn let_back(
    State(shared): State<Shared>,
    Path((session, removal)): Path<(String, String)>,
) -> Result<StatusCode, Failure> {
    let is_there = kept_out(&shared, &session).await?.iter().any(|other| other.id == removal);
    if is_there && shared.store.let_back(&removal).await? {
        return Ok(StatusCode::NO_CONTENT);
    }
    Err(Failure::none_such("removal", "removal", "the identifier of a removal from this session"))
}

/// What somebody is told who is kept out.
pub(super) fn problem(Removed { by, is_revoked }: &Removed) -> Problem {
    let (reason, sentence) = if *is_revoked {
        (Reason::RemovedGuest, format!("{by} has removed you, and your link lets in no longer."))
    } else {
        (Reason::Removed, format!("{by} has removed you from this tree for {KEPT_OUT_HOURS} hours."))
    };
    let problem = Problem::new(reason, sentence).at("tree", "a tree that you were not removed from");
    Problem { cause: Some(by.clone()), ..problem }
}

/// How a socket closes that may not stay or come: who was removed hears by whom.
pub(super) fn close_of(problem: &Problem) -> (CloseCode, String) {
    let removed = [Reason::Removed, Reason::RemovedGuest].contains(&problem.reason);
    match problem.cause.as_deref().filter(|_| removed) {
        Some(by) => (CloseCode::Removed, Problem::new(problem.reason, by).in_close()),
        None => (CloseCode::CannotOpen, problem.in_close()),
    }
}

/// Somebody in a session.
pub(super) struct There {
    pub(super) entrant: Entrant,
    /// What whoever asks for them is called there, if they are there.
    pub(super) asking: Option<String>,
}

/// Whoever has a number in a session.
pub(super) async fn person(
    shared: &Shared,
    session: &str,
    number: u32,
    asking: &Principal,
) -> Result<There, Failure> {
    if let Some((Some(entrant), asking)) = shared.sessions.person(session, number, asking).await {
        return Ok(There { entrant, asking: asking.map(|name| name.to_string()) });
    }
    there(shared, session).await?;
    Err(Failure::none_such("person", "person", "the number of somebody who is in the session"))
}

/// The tree of a session that is there.
pub(super) async fn tree_of(shared: &Shared, session: &str) -> Result<Option<String>, Failure> {
    let found = shared.store.tree_of(session).await?;
    if found.is_none() {
        there(shared, session).await?;
    }
    Ok(found.map(|tree| tree.id))
}

async fn there(shared: &Shared, session: &str) -> Result<(), Failure> {
    if shared.store.has_session(session).await? { Ok(()) } else { Err(Failure::no_session()) }
}

/// Who is kept out of a session, now or of its tree, and can be let back: whose link was revoked cannot.
async fn kept_out(shared: &Shared, session: &str) -> Result<Vec<Removal>, Failure> {
    let (tree, at) = (tree_of(shared, session).await?, now());
    let mut all = shared.store.removals(Room::Session(session), &at).await?;
    if let Some(tree) = &tree {
        all.extend(shared.store.removals(Room::Tree(tree), &at).await?);
    }
    all.retain(|removal| !removal.is_revoked);
    Ok(all)
}
