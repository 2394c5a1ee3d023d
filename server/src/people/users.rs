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
    name,
    similar::asked_for,
    store::{Audit, Event, SqliteStore, StoreError, Terms, User, UserChange, Users},
    time::now,
};

/// `espalier user`.
pub fn user(command: &cli::User) -> Result<(), PeopleError> {
    match command {
        cli::User::Add(NewUser { name, admin, role, database }) => {
            let role = if *admin { Role::Admin } else { *role };
            let password = read_password()?;
            let (id, called, created_at) = (name::unguessable(), name.clone(), now());
            let new = User { id, name: called, role, group_role: None, password, created_at, revision: 1 };
            at(&database.path, async |store| {
                match store.add_user(new).await {
                    Err(StoreError::Taken) => return Err(PeopleError::Taken(name.clone())),
                    added => added?,
                }
                Ok(store.note(Event::at_machine("user-add", &format!("{name} {}", role.name()))).await?)
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
            // Nobody types a password for a name that is mistyped.
            at(&database.path, async |store| found(store, name).await)?;
            let password = UserChange::password(read_password()?);
            change(&database.path, ("user-passwd", name), name, password, true)?;
            print(&format!("{name} has another password, and is logged in nowhere."));
        }
        cli::User::Role(RoleOfUser { name, role, force, database }) => {
            let noted = format!("{name} {}", role.name());
            change(&database.path, ("user-role", &noted), name, UserChange::role(*role), *force)?;
            print(&format!("{name} is {} from now on.", role.name()));
        }
        cli::User::Remove(RemovedUser { name, force, database }) => {
            at(&database.path, async |store| {
                let terms = Terms { expected: None, force: *force };
                let user = found(store, name).await?;
                match store.remove_user(&user.id, terms).await {
                    Err(error) => return Err(last(error, user)),
                    Ok(false) => return Err(none(store, name).await?),
                    Ok(true) => {}
                }
                Ok(store.note(Event::at_machine("user-remove", name)).await?)
            })?;
            print(&format!("{name} can log in no longer."));
        }
    }
    Ok(())
}

/// Changes somebody; with how the list of what was done calls it, and what it says of it.
fn change(
    database: &Path,
    (action, noted): (&str, &str),
    name: &str,
    change: UserChange,
    force: bool,
) -> Result<(), PeopleError> {
    at(database, async |store| {
        let user = found(store, name).await?;
        match store.change_user(&user.id, change, Terms { expected: None, force }).await {
            Err(error) => return Err(last(error, user)),
            Ok(false) => return Err(none(store, name).await?),
            Ok(true) => {}
        }
        Ok(store.note(Event::at_machine(action, noted)).await?)
    })
}

/// Why somebody was not changed, who is called as they were added.
fn last(error: StoreError, user: User) -> PeopleError {
    match error {
        StoreError::LastAdmin => PeopleError::LastAdmin(user.name),
        error => error.into(),
    }
}

/// Whoever goes by a name.
pub(super) async fn found(store: &SqliteStore, name: &str) -> Result<User, PeopleError> {
    match store.user(name).await? {
        Some(user) => Ok(user),
        None => Err(none(store, name).await?),
    }
}

/// Nobody goes by a name; who may have been meant is told.
pub(super) async fn none(store: &SqliteStore, name: &str) -> Result<PeopleError, StoreError> {
    let users = store.users().await?;
    let hint = asked_for(name, users.iter().map(|user| user.name.as_str()));
    Ok(PeopleError::NoneSuch { what: "user", name: name.to_owned(), hint })
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
