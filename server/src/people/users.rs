//! `espalier user`: who logs in with a password.

use std::{
    io::{self, IsTerminal},
    path::Path,
};

use espalier_proto::access::Role;

use super::{PeopleError, at, print};
use crate::{
    access::password::Password,
    cli::{self, NamedUser, NewUser, RemovedUser, RoleOfUser},
    store::{Audit, Event, StoreError, User, UserChange, Users, folded},
    time::now,
};

/// `espalier user`.
pub fn user(command: &cli::User) -> Result<(), PeopleError> {
    match command {
        cli::User::Add(NewUser { name, admin, role, database }) => {
            let role = if *admin { Role::Admin } else { *role };
            let password = read_password()?;
            let new = User { name: name.clone(), role, group_role: None, password, created_at: now() };
            at(&database.path, async |store| {
                match store.add_user(new).await {
                    Err(StoreError::Taken) => return Err(PeopleError::Taken(name.clone())),
                    added => added?,
                }
                Ok(store.note(Event::at_machine("user-add", name)).await?)
            })?;
            print(&format!("{name} can log in: {}.", role.name()));
        }
        cli::User::Ls(options) => {
            for user in at(&options.database.path, async |store| Ok(store.users().await?))? {
                let by_group = if user.allowed() == user.role { "" } else { " by a group" };
                let User { name, created_at, .. } = &user;
                print(&format!("{name}: {}{by_group}, since {created_at}", user.allowed().name()));
            }
        }
        cli::User::Passwd(NamedUser { name, database }) => {
            known(&database.path, name)?;
            let password = UserChange::Password(read_password()?);
            change(&database.path, "user-passwd", name, password)?;
            print(&format!("{name} has another password, and is logged in nowhere."));
        }
        cli::User::Role(RoleOfUser { name, role, force, database }) => {
            if *role != Role::Admin && !force {
                leaves_one(&database.path, name)?;
            }
            change(&database.path, "user-role", name, UserChange::Role(*role))?;
            print(&format!("{name} is {} from now on.", role.name()));
        }
        cli::User::Remove(RemovedUser { name, force, database }) => {
            if !force {
                leaves_one(&database.path, name)?;
            }
            at(&database.path, async |store| {
                found(store.remove_user(name).await?, name)?;
                Ok(store.note(Event::at_machine("user-remove", name)).await?)
            })?;
            print(&format!("{name} can log in no longer."));
        }
    }
    Ok(())
}

/// Nobody types a password for a name that is mistyped.
fn known(database: &Path, name: &str) -> Result<(), PeopleError> {
    let user = at(database, async |store| Ok(store.user(name).await?))?;
    found(user.is_some(), name)
}

/// Whether an administrator is left without somebody; where they are none, nothing changes.
fn leaves_one(database: &Path, name: &str) -> Result<(), PeopleError> {
    let users = at(database, async |store| Ok(store.users().await?))?;
    let mut admins = users.iter().filter(|user| user.role == Role::Admin);
    match (admins.next(), admins.next()) {
        (Some(last), None) if folded(&last.name) == folded(name) => {
            Err(PeopleError::LastAdmin(last.name.clone()))
        }
        _ => Ok(()),
    }
}

fn change(database: &Path, action: &str, name: &str, change: UserChange) -> Result<(), PeopleError> {
    at(database, async |store| {
        found(store.change_user(name, change).await?, name)?;
        Ok(store.note(Event::at_machine(action, name)).await?)
    })
}

fn found(is_there: bool, name: &str) -> Result<(), PeopleError> {
    if is_there { Ok(()) } else { Err(PeopleError::NoneSuch { what: "user", name: name.to_owned() }) }
}

/// Asks for a password twice, unseen; gives what is kept of it. Where nobody sits at a terminal it is the next line.
fn read_password() -> Result<String, PeopleError> {
    let typed = if io::stdin().is_terminal() {
        let typed = rpassword::prompt_password("Password: ").map_err(PeopleError::Unread)?;
        let again = rpassword::prompt_password("The same again: ").map_err(PeopleError::Unread)?;
        if typed != again {
            return Err(PeopleError::Password("the two are not the same".into()));
        }
        typed
    } else {
        let mut line = String::new();
        io::stdin().read_line(&mut line).map_err(PeopleError::Unread)?;
        line.trim_end_matches(['\r', '\n']).to_owned()
    };
    let password = Password::parse(&typed).map_err(PeopleError::Password)?;
    password.kept().map_err(|error| PeopleError::Password(error.to_string()))
}
