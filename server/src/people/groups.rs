//! `espalier group`: users who have a role together.

use super::{PeopleError, at, print, users};
use crate::{
    cli::{self, GroupOfRole, Members, NamedGroup, NewGroup},
    name,
    similar::asked_for,
    store::{Audit, Event, Group, GroupChange, Groups, Missing, SqliteStore, StoreError, Users, folded},
    time::now,
};

/// `espalier group`.
pub fn group(command: &cli::Group) -> Result<(), PeopleError> {
    match command {
        cli::Group::Add(NewGroup { name, role, database }) => {
            let (id, called, role, created_at) = (name::unguessable(), name.clone(), *role, now());
            let new = Group { id, name: called, role, created_at, members: Vec::new(), revision: 1 };
            at(&database.path, async |store| {
                match store.add_group(new).await {
                    Err(StoreError::Taken) => return Err(PeopleError::TakenGroup(name.clone())),
                    added => added?,
                }
                Ok(store.note(Event::at_machine("group-add", &format!("{name} {}", role.name()))).await?)
            })?;
            print(&format!("{name}: {}; `espalier group join` makes users its members.", role.name()));
        }
        cli::Group::Ls(options) => {
            for Group { name, role, members, .. } in
                at(&options.database.path, async |store| Ok(store.groups().await?))?
            {
                let members = if members.is_empty() { "nobody".into() } else { members.join(", ") };
                print(&format!("{name}: {}: {members}", role.name()));
            }
        }
        cli::Group::Role(GroupOfRole { name, role, database }) => {
            at(&database.path, async |store| {
                let change = GroupChange { role: Some(*role), ..GroupChange::default() };
                let group = found(store, name).await?;
                is_there(store, store.change_group(&group.id, change, None).await?, name).await?;
                Ok(store.note(Event::at_machine("group-role", &format!("{name} {}", role.name()))).await?)
            })?;
            print(&format!("Members of {name} are {} from now on.", role.name()));
        }
        cli::Group::Join(Members { name, users, database }) => {
            at(&database.path, async |store| {
                let group = found(store, name).await?;
                for user in users {
                    let member = users::found(store, user).await?;
                    match store.join_group(&group.id, &member.id, None).await {
                        Err(StoreError::NotFound(Missing::User)) => {
                            return Err(users::none(store, user).await?);
                        }
                        Err(StoreError::NotFound(_)) => return Err(none(store, name).await?),
                        joined => joined?,
                    }
                    store.note(Event::at_machine("group-join", &format!("{name} {user}"))).await?;
                }
                Ok(())
            })?;
            print(&format!("{} in {name} from now on.", are(users)));
        }
        cli::Group::Leave(Members { name, users, database }) => {
            at(&database.path, async |store| {
                let Group { id, name: group, members, .. } = found(store, name).await?;
                for user in users {
                    let member = store.user(user).await?.map(|user| user.id).unwrap_or_default();
                    if !store.leave_group(&id, &member, None).await? {
                        let hint = asked_for(user, members.iter().map(String::as_str));
                        return Err(PeopleError::NoMember { group, user: user.clone(), hint });
                    }
                    store.note(Event::at_machine("group-leave", &format!("{name} {user}"))).await?;
                }
                Ok(())
            })?;
            print(&format!("{} in {name} no longer.", are(users)));
        }
        cli::Group::Remove(NamedGroup { name, database }) => {
            at(&database.path, async |store| {
                let group = found(store, name).await?;
                is_there(store, store.remove_group(&group.id, None).await?, name).await?;
                Ok(store.note(Event::at_machine("group-remove", name)).await?)
            })?;
            print(&format!(
                "There is no group {name} any more; its members may do what they may by themselves."
            ));
        }
    }
    Ok(())
}

fn are(users: &[String]) -> String {
    format!("{} {}", users.join(", "), if users.len() == 1 { "is" } else { "are" })
}

async fn is_there(store: &SqliteStore, is_there: bool, name: &str) -> Result<(), PeopleError> {
    if is_there { Ok(()) } else { Err(none(store, name).await?) }
}

/// The group that goes by a name.
async fn found(store: &SqliteStore, name: &str) -> Result<Group, PeopleError> {
    match store.groups().await?.into_iter().find(|group| folded(&group.name) == folded(name)) {
        Some(group) => Ok(group),
        None => Err(none(store, name).await?),
    }
}

/// There is no group of a name; which may have been meant is told.
pub(super) async fn none(store: &SqliteStore, name: &str) -> Result<PeopleError, StoreError> {
    let groups = store.groups().await?;
    let hint = asked_for(name, groups.iter().map(|group| group.name.as_str()));
    Ok(PeopleError::NoneSuch { what: "group", name: name.to_owned(), hint })
}
