//! Tokens of programs, which act as whoever made them (`AC21`).

use std::time::{Duration, SystemTime};

use axum::{Extension, Json, extract::State, http::StatusCode, response::IntoResponse};
use espalier_proto::{
    Problem, Reason,
    access::{ListedToken, MadeToken, NewToken, Role},
};

use super::{
    Shared,
    audit::Made,
    failure::{Body, Failure, Path},
};
use crate::{
    access::{Caller, admission},
    store::{Missing, Pass, PassKind, Passes, StoreError},
    time::now,
};

/// Tokens of one person.
const MOST: u32 = 100;
/// How long a token is good that is for no time of its own.
const LASTS: Duration = Duration::from_hours(90 * 24);

pub(super) async fn list(
    State(shared): State<Shared>,
    caller: Caller,
) -> Result<Json<Vec<ListedToken>>, Failure> {
    Ok(Json(own(&shared, &caller).await?.into_iter().map(described).collect()))
}

pub(super) async fn list_all(State(shared): State<Shared>) -> Result<Json<Vec<ListedToken>>, Failure> {
    let all = shared.store.passes(PassKind::Token, &now()).await?;
    Ok(Json(all.into_iter().map(described).collect()))
}

pub(super) async fn add(
    State(shared): State<Shared>,
    caller: Caller,
    Body(NewToken { name, role, hours }): Body<NewToken>,
) -> Result<impl IntoResponse, Failure> {
    if caller.is_program() {
        let problem = Problem::new(Reason::Forbidden, "A program makes no tokens: people make them.");
        return Err(problem.into());
    }
    let role = Role::from(role);
    if role > caller.role() {
        let sentence = format!("You may do what {} may, and so may your programs.", caller.role().name());
        let allowed = format!("{} or less", caller.role().name());
        return Err(Problem::new(Reason::Forbidden, sentence).at("role", allowed).into());
    }
    let lasts = hours.map_or(LASTS, |hours| Duration::from_hours(hours.get().into()));
    let token = admission::NewToken { name: name.into(), role, holder: caller.holder(), lasts, most: MOST };
    let (secret, id) = match admission::token(&*shared.store, token, SystemTime::now()).await {
        // They were let in until just now.
        Err(StoreError::NotFound(Missing::User | Missing::Pass)) => {
            return Err(crate::access::not_let_in().into());
        }
        Err(StoreError::Full) => {
            let problem = Problem::new(Reason::TooMany, format!("You have {MOST} tokens; revoke one first."));
            return Err(problem.at("name", format!("fewer than {MOST} tokens")).into());
        }
        made => made?,
    };
    let (made, token) = (Extension(Made(id.clone())), secret.text().to_owned());
    Ok((StatusCode::CREATED, made, Json(MadeToken { id, token })))
}

/// Revokes a token of one's own; administrators revoke any.
pub(super) async fn revoke(
    State(shared): State<Shared>,
    caller: Caller,
    Path(id): Path<String>,
) -> Result<StatusCode, Failure> {
    let all = shared.store.passes(PassKind::Token, &now()).await?;
    let found = all.iter().find(|token| token.id == id);
    let is_theirs = found.is_some_and(|token| caller.role() == Role::Admin || caller.has_token(token));
    if is_theirs && shared.store.take_pass(&id).await? {
        shared.tell_standings();
        return Ok(StatusCode::NO_CONTENT);
    }
    Err(Failure::none_such("token", "token", "the identifier of a token of yours"))
}

/// Those of whoever asks, newest first.
async fn own(shared: &Shared, caller: &Caller) -> Result<Vec<Pass>, StoreError> {
    let mut all = shared.store.passes(PassKind::Token, &now()).await?;
    all.retain(|token| caller.has_token(token));
    Ok(all)
}

fn described(token: Pass) -> ListedToken {
    let Pass { id, name, role, holder, created_at, expires_at, .. } = token;
    let of = holder.map(|holder| holder.name().to_owned());
    ListedToken { id, name, role, of, since: created_at, until: expires_at }
}
