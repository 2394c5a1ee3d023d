//! `espalier group`: users who have a role together.

use super::{PeopleError, at, print};
use crate::{
    cli::{self, GroupOfRole, Members, NamedGroup, NewGroup},
    name,
    store::{Audit, Event, Group, GroupChange, Groups, Missing, StoreError},
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
                Ok(store.note(Event::at_machine("group-add", name)).await?)
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
                found(store.change_group(name, change, None).await?, name)?;
                Ok(store.note(Event::at_machine("group-role", name)).await?)
            })?;
            print(&format!("Members of {name} are {} from now on.", role.name()));
        }
        cli::Group::Join(Members { name, users, database }) => {
            at(&database.path, async |store| {
                for user in users {
                    store.join_group(name, user, None).await.map_err(|error| missing(error, name, user))?;
                    store.note(Event::at_machine("group-join", &format!("{name} {user}"))).await?;
                }
                Ok(())
            })?;
            print(&format!("{} in {name} from now on.", are(users)));
        }
        cli::Group::Leave(Members { name, users, database }) => {
            at(&database.path, async |store| {
                for user in users {
                    if !store.leave_group(name, user, None).await? {
                        return Err(PeopleError::NoMember { group: name.clone(), user: user.clone() });
                    }
                    store.note(Event::at_machine("group-leave", &format!("{name} {user}"))).await?;
                }
                Ok(())
            })?;
            print(&format!("{} in {name} no longer.", are(users)));
        }
        cli::Group::Remove(NamedGroup { name, database }) => {
            at(&database.path, async |store| {
                found(store.remove_group(name, None).await?, name)?;
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

fn found(is_there: bool, name: &str) -> Result<(), PeopleError> {
    if is_there { Ok(()) } else { Err(PeopleError::NoneSuch { what: "group", name: name.to_owned() }) }
}

fn missing(error: StoreError, group: &str, user: &str) -> PeopleError {
    match error {
        StoreError::NotFound(Missing::User) => PeopleError::NoneSuch { what: "user", name: user.to_owned() },
        StoreError::NotFound(_) => PeopleError::NoneSuch { what: "group", name: group.to_owned() },
        error => error.into(),
    }
}
