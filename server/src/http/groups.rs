//! Users who have a role together (`AC20`).

use axum::{Extension, Json, extract::State, http::StatusCode, response::IntoResponse};
use espalier_proto::access::{ChangeGroup, GroupMember, ListedGroup, NewGroup, Role};

use super::{
    Shared,
    audit::Made,
    failure::{Body, Failure, Path},
    revision::{Expected, tag},
    users::{in_words, no_user, usable, user},
};
use crate::{
    name,
    store::{Group, GroupChange, Groups, Missing, StoreError, User, UserChange, Users},
    time::now,
};

pub(super) async fn list(State(shared): State<Shared>) -> Result<Json<Vec<ListedGroup>>, Failure> {
    let (groups, users) = (shared.store.groups().await?, shared.store.users().await?);
    Ok(Json(groups.into_iter().map(|group| described(group, &users)).collect()))
}

pub(super) async fn find(
    State(shared): State<Shared>,
    Path(id): Path<String>,
) -> Result<impl IntoResponse, Failure> {
    told(&shared, &id).await
}

pub(super) async fn add(
    State(shared): State<Shared>,
    Body(NewGroup { name, role }): Body<NewGroup>,
) -> Result<impl IntoResponse, Failure> {
    let (id, name, role) = (name::unguessable(), usable(name)?, role.into());
    let made = Made(format!("{name} {}", Role::name(role)));
    let group = Group { id: id.clone(), name, role, created_at: now(), members: Vec::new(), revision: 1 };
    shared.store.add_group(group).await?;
    Ok((StatusCode::CREATED, Extension(made), told(&shared, &id).await?))
}

pub(super) async fn change(
    State(shared): State<Shared>,
    Path(id): Path<String>,
    Expected(expected): Expected,
    Body(ChangeGroup { name, role }): Body<ChangeGroup>,
) -> Result<impl IntoResponse, Failure> {
    let before = group(&shared, &id).await?.name;
    let change = GroupChange { name: name.map(usable).transpose()?, role: role.map(Role::from) };
    // What changes nothing counts as nothing.
    if change != GroupChange::default() || expected.is_some() {
        if !shared.store.change_group(&id, change.clone(), expected).await? {
            return Err(no_group());
        }
        shared.tell_standings();
    }
    let GroupChange { name, role } = change;
    let change = UserChange { name, role, ..UserChange::default() };
    let made = Made(in_words(&before, &change));
    Ok((Extension(made), told(&shared, &id).await?))
}

pub(super) async fn remove(
    State(shared): State<Shared>,
    Path(id): Path<String>,
    Expected(expected): Expected,
) -> Result<impl IntoResponse, Failure> {
    let Group { name, .. } = group(&shared, &id).await?;
    if !shared.store.remove_group(&id, expected).await? {
        return Err(no_group());
    }
    shared.tell_standings();
    Ok((StatusCode::NO_CONTENT, Extension(Made(name))))
}

pub(super) async fn join(
    State(shared): State<Shared>,
    Path((id, member)): Path<(String, String)>,
    Expected(expected): Expected,
) -> Result<impl IntoResponse, Failure> {
    let (group, user) = both(&shared, &id, &member).await?;
    match shared.store.join_group(&id, &member, expected).await {
        Err(StoreError::NotFound(Missing::User)) => return Err(no_user()),
        Err(StoreError::NotFound(Missing::Group)) => return Err(no_group()),
        joined => joined?,
    }
    shared.tell_standings();
    Ok((Extension(Made(format!("{} {}", group.name, user.name))), told(&shared, &id).await?))
}

pub(super) async fn leave(
    State(shared): State<Shared>,
    Path((id, member)): Path<(String, String)>,
    Expected(expected): Expected,
) -> Result<impl IntoResponse, Failure> {
    let (group, user) = both(&shared, &id, &member).await?;
    if !shared.store.leave_group(&id, &member, expected).await? {
        return Err(Failure::none_such("member", "user", "the identifier of somebody in the group"));
    }
    shared.tell_standings();
    Ok((Extension(Made(format!("{} {}", group.name, user.name))), told(&shared, &id).await?))
}

async fn both(shared: &Shared, id: &str, member: &str) -> Result<(Group, User), Failure> {
    Ok((group(shared, id).await?, user(shared, member).await?))
}

/// The group with this identifier.
async fn group(shared: &Shared, id: &str) -> Result<Group, Failure> {
    let found = shared.store.groups().await?.into_iter().find(|group| group.id == id);
    found.ok_or_else(no_group)
}

fn no_group() -> Failure {
    Failure::none_such("group", "group", "the identifier of a group")
}

/// What is told of a group, with the tag of its revision.
async fn told(shared: &Shared, id: &str) -> Result<impl IntoResponse + use<>, Failure> {
    let (group, users) = (group(shared, id).await?, shared.store.users().await?);
    Ok((tag(group.revision), Json(described(group, &users))))
}

fn described(group: Group, users: &[User]) -> ListedGroup {
    let Group { id, name, role, created_at, members, revision } = group;
    let members = members.into_iter().filter_map(|name| {
        let user = users.iter().find(|user| user.name == name)?;
        Some(GroupMember { id: user.id.clone(), name })
    });
    ListedGroup { id, name, role: role.into(), members: members.collect(), created_at, revision }
}
