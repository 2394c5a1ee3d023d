//! Who logs in with a password (`AC19`).

use std::time::Instant;

use axum::{
    Extension, Json,
    extract::State,
    http::StatusCode,
    response::{IntoResponse, Response},
};
use espalier_proto::{
    Problem, Reason,
    access::{ChangePassword, ChangeUser, ListedUser, NewUser},
    text::Name,
};

use super::{
    Shared,
    audit::Made,
    entry,
    failure::{Body, Failure, Path},
    revision::{Expected, tag},
};
use crate::{
    access::{self, Caller, Peer, SecretHash, password::Password},
    name,
    store::{Group, Groups, Terms, User, UserChange, Users, folded},
    time::now,
};

pub(super) async fn list(State(shared): State<Shared>) -> Result<Json<Vec<ListedUser>>, Failure> {
    let (users, groups) = (shared.store.users().await?, shared.store.groups().await?);
    Ok(Json(users.into_iter().map(|user| described(user, &groups)).collect()))
}

pub(super) async fn find(
    State(shared): State<Shared>,
    Path(id): Path<String>,
) -> Result<impl IntoResponse, Failure> {
    let user = user(&shared, &id).await?;
    told(&shared, user).await
}

pub(super) async fn add(
    State(shared): State<Shared>,
    Body(NewUser { name, role, password }): Body<NewUser>,
) -> Result<impl IntoResponse, Failure> {
    let (id, name) = (name::unguessable(), usable(name)?);
    let password = kept(&shared, "password", &password).await?;
    let user = User { id, name, role, group_role: None, password, created_at: now(), revision: 1 };
    shared.store.add_user(user.clone()).await?;
    let made = Made(format!("{} {}", user.name, role.name()));
    Ok((StatusCode::CREATED, Extension(made), told(&shared, user).await?))
}

pub(super) async fn change(
    State(shared): State<Shared>,
    Path(id): Path<String>,
    Expected(expected): Expected,
    Body(ChangeUser { name, role, password }): Body<ChangeUser>,
) -> Result<impl IntoResponse, Failure> {
    let before = user(&shared, &id).await?;
    let name = name.map(usable).transpose()?;
    let password = match &password {
        Some(password) => Some(kept(&shared, "password", password).await?),
        None => None,
    };
    let change = UserChange { name, role, password, stays: None };
    // What changes nothing counts as nothing.
    if change != UserChange::default() || expected.is_some() {
        let terms = Terms { expected, force: false };
        if !shared.store.change_user(&id, change.clone(), terms).await? {
            return Err(no_user());
        }
        shared.tell_standings();
    }
    let changed = user(&shared, &id).await?;
    let made = Made(in_words(&before.name, &change));
    Ok((Extension(made), told(&shared, changed).await?))
}

pub(super) async fn remove(
    State(shared): State<Shared>,
    Path(id): Path<String>,
    Expected(expected): Expected,
) -> Result<impl IntoResponse, Failure> {
    let User { name, .. } = user(&shared, &id).await?;
    if !shared.store.remove_user(&id, Terms { expected, force: false }).await? {
        return Err(no_user());
    }
    shared.tell_standings();
    Ok((StatusCode::NO_CONTENT, Extension(Made(name))))
}

/// Gives whoever is logged in another password, if they know the one until now. Their other logins end.
pub(super) async fn change_own_password(
    State(shared): State<Shared>,
    peer: Option<Extension<Peer>>,
    caller: Caller,
    Body(ChangePassword { old, new }): Body<ChangePassword>,
) -> Result<StatusCode, Response> {
    let Some(((login, name), id)) = caller.login().zip(caller.user()) else {
        let problem = Problem::new(Reason::Forbidden, "Only who has logged in has a password.");
        return Err(Failure::from(problem).into_response());
    };
    let peer = peer.map(|Extension(peer)| peer);
    let tried = entry::Tried::count(&shared, peer, name, Instant::now());
    let tried = tried.map_err(Failure::into_response)?;
    let user = entry::check(&shared, name, "old", &old).await.map_err(Failure::into_response)?;
    tried.was_right(&shared);
    // Whoever goes by the name now may be somebody else.
    if user.id != id {
        return Err(Failure::from(access::not_let_in()).into_response());
    }
    change_own(&shared, user, login, &new).await.map_err(Failure::into_response)?;
    Ok(StatusCode::NO_CONTENT)
}

/// Gives somebody who was just checked another password; the login that they do it with stays.
pub(super) async fn change_own(
    shared: &Shared,
    User { id, revision, .. }: User,
    login: SecretHash,
    new: &str,
) -> Result<(), Failure> {
    let password = Some(kept(shared, "new", new).await?);
    let change = UserChange { password, stays: Some(login), ..UserChange::default() };
    // Not over one that was set meanwhile.
    let terms = Terms { expected: Some(revision), ..Terms::default() };
    if !shared.store.change_user(&id, change, terms).await? {
        return Err(access::not_let_in().into());
    }
    shared.tell_standings();
    Ok(())
}

/// What changes of somebody who was called so until now, for the list of what was done.
pub(super) fn in_words(before: &str, UserChange { name, role, password, .. }: &UserChange) -> String {
    let name = name.as_ref().map(|name| format!("name {name}"));
    let role = role.map(|role| format!("role {}", role.name()));
    let password = password.as_ref().map(|_| "password".to_owned());
    let changes = [name, role, password].into_iter().flatten().collect::<Vec<_>>().join(", ");
    if changes.is_empty() { format!("{before}: nothing") } else { format!("{before}: {changes}") }
}

/// What is told of a user, with the tag of their revision.
async fn told(shared: &Shared, user: User) -> Result<impl IntoResponse + use<>, Failure> {
    let groups = shared.store.groups().await?;
    Ok((tag(user.revision), Json(described(user, &groups))))
}

fn described(user: User, groups: &[Group]) -> ListedUser {
    let role = user.allowed();
    let User { id, name, role: own_role, created_at, revision, .. } = user;
    let is_theirs = |group: &&Group| group.members.contains(&name);
    let groups = groups.iter().filter(is_theirs).map(|group| group.name.clone()).collect();
    ListedUser { id, name, role, own_role, groups, created_at, revision }
}

/// The user with this identifier.
pub(super) async fn user(shared: &Shared, id: &str) -> Result<User, Failure> {
    let found = shared.store.users().await?.into_iter().find(|user| user.id == id);
    found.ok_or_else(no_user)
}

pub(super) fn no_user() -> Failure {
    Failure::none_such("user", "user", "the identifier of somebody who can log in")
}

/// A name that a login finds.
pub(super) fn usable(name: Name) -> Result<String, Failure> {
    if folded(name.as_str()).is_empty() {
        let problem = Problem::new(Reason::TextUnseen, "A name needs a letter or a digit.");
        return Err(problem.at("name", "a name with a letter or a digit").into());
    }
    Ok(name.into())
}

/// What is kept of a password.
async fn kept(shared: &Shared, field: &str, password: &str) -> Result<String, Failure> {
    let password = Password::parse(password).map_err(|sentence| {
        let problem = Problem::new(Reason::TextLength, format!("The password cannot be taken: {sentence}."));
        Failure::from(problem.at(field, Password::ALLOWED))
    })?;
    shared.passwords.kept(password).await.map_err(|error| {
        tracing::error!(%error, "a password cannot be hashed");
        Failure::new(Reason::Failed, "The server failed to compute this; nothing was changed.")
    })
}
