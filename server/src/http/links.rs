//! Links that let people in for one tree (`AC12`).

use std::time::{Duration, SystemTime};

use axum::{
    Extension, Json,
    extract::State,
    http::{HeaderMap, StatusCode, header},
    response::IntoResponse,
};
use espalier_proto::{
    Problem, Reason,
    access::{ChangeLink, MadeLink, NewLink, Role, TreeLink},
    version::MAX_LINK_HOURS,
};

use super::{
    Shared,
    audit::Made,
    failure::{Body, Failure, Path},
    trees,
};
use crate::{
    access::{
        admission::{self, Invite, UNNAMED_LINK},
        cookie,
    },
    hosts,
    store::{Missing, Pass, PassKind, Passes, StoreError},
    time::now,
};

/// Links of one tree.
const MOST: u32 = 100;
/// How long a link waits that is for no time of its own.
const WAITS: Duration = Duration::from_hours(MAX_LINK_HOURS as u64);

pub(super) async fn list(
    State(shared): State<Shared>,
    Path(tree): Path<String>,
) -> Result<Json<Vec<TreeLink>>, Failure> {
    there(&shared, &tree).await?;
    Ok(Json(of(&shared, &tree).await?.into_iter().map(described).collect()))
}

pub(super) async fn add(
    State(shared): State<Shared>,
    Path(tree): Path<String>,
    headers: HeaderMap,
    Body(NewLink { role, hours, name }): Body<NewLink>,
) -> Result<impl IntoResponse, Failure> {
    there(&shared, &tree).await?;
    let name = name.map_or_else(|| UNNAMED_LINK.to_owned(), String::from);
    let lasts = hours.map(|hours| Duration::from_hours(hours.get().into()));
    let invite = Invite { name, role: role.into(), tree: Some(tree), lasts };
    let waits = lasts.unwrap_or(WAITS);
    let (secret, id) = match admission::link(&*shared.store, invite, (waits, MOST), SystemTime::now()).await {
        Err(StoreError::Full) => {
            let problem =
                Problem::new(Reason::TooMany, format!("The tree has {MOST} links; revoke one first."));
            return Err(problem.at("tree", format!("a tree with fewer than {MOST} links")).into());
        }
        made => made?,
    };
    let scheme = if cookie::is_secure(&headers) { "https" } else { "http" };
    let host = headers.get(header::HOST).and_then(|host| host.to_str().ok()).unwrap_or_default();
    // What this machine calls itself leads nowhere from another one.
    let reached = shared.addresses.first().filter(|_| hosts::is_loopback(host));
    let server = reached.cloned().unwrap_or_else(|| format!("{scheme}://{host}"));
    let url = format!("{server}/pair#{}", secret.text());
    Ok((StatusCode::CREATED, Extension(Made(id.clone())), Json(MadeLink { id, url })))
}

pub(super) async fn change(
    State(shared): State<Shared>,
    Path((tree, link)): Path<(String, String)>,
    Body(ChangeLink { role }): Body<ChangeLink>,
) -> Result<(Extension<Made>, Json<TreeLink>), Failure> {
    there(&shared, &tree).await?;
    let found = of(&shared, &tree).await?.into_iter().find(|pass| pass.id == link);
    let role = Role::from(role);
    match found {
        Some(pass) if shared.store.change_pass(&link, role).await? => {
            shared.tell_standings();
            Ok((Extension(Made(role.name().to_owned())), Json(described(Pass { role, ..pass }))))
        }
        Some(_) | None => Err(no_link()),
    }
}

pub(super) async fn revoke(
    State(shared): State<Shared>,
    Path((tree, link)): Path<(String, String)>,
) -> Result<StatusCode, Failure> {
    // Also of a tree that is deleted, which may come back.
    trees::stored(&shared, &tree).await?;
    let is_there = of(&shared, &tree).await?.iter().any(|pass| pass.id == link);
    if is_there && shared.store.take_pass(&link).await? {
        shared.tell_standings();
        return Ok(StatusCode::NO_CONTENT);
    }
    Err(no_link())
}

fn no_link() -> Failure {
    Failure::none_such("link", "link", "the identifier of a link of this tree")
}

pub(super) fn described(pass: Pass) -> TreeLink {
    TreeLink {
        id: pass.id,
        name: pass.name,
        role: pass.role,
        since: pass.created_at,
        until: pass.expires_at,
        used: pass.kind == PassKind::Device,
    }
}

/// What lets people in for this tree alone, newest first.
async fn of(shared: &Shared, tree: &str) -> Result<Vec<Pass>, Failure> {
    let now = now();
    let mut all = shared.store.passes(PassKind::Invitation, &now).await?;
    all.extend(shared.store.passes(PassKind::Device, &now).await?);
    all.retain(|pass| pass.tree.as_deref() == Some(tree));
    all.sort_by(|a, b| (&b.created_at, &b.id).cmp(&(&a.created_at, &a.id)));
    Ok(all)
}

/// Nobody is let in for a tree that is deleted.
async fn there(shared: &Shared, tree: &str) -> Result<(), Failure> {
    let found = trees::stored(shared, tree).await?;
    if found.deleted_at.is_some() { Err(Missing::Tree.into()) } else { Ok(()) }
}
