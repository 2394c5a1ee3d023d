//! `espalier invite`, `user`, `group`, `device`, `token` and `audit`: who may come in, and what was done, said at the machine itself, while a server runs or not.

mod audit;
mod groups;
mod members;
mod users;

use std::{
    io::{self, IsTerminal, Write},
    net::{IpAddr, Ipv4Addr, SocketAddr},
    path::Path,
    time::SystemTime,
};

use espalier_proto::access::Role;

use crate::{
    access::admission::{self, INVITATION_LIFE, NewToken},
    announce::{self, Medium},
    cli::{self, Scope},
    similar::asked_for,
    store::{Audit, Event, OpenError, Pass, PassKind, Passes, SqliteStore, Store, StoreError},
    time::written,
};

pub use self::{audit::audit, groups::group, members::member, users::user};

/// It could not be done; each message is one sentence.
#[derive(Debug, thiserror::Error)]
pub enum PeopleError {
    /// The database cannot be used.
    #[error(transparent)]
    Open(#[from] OpenError),
    /// It cannot be written.
    #[error("It cannot be done: {}.", .0.in_words())]
    Store(#[from] StoreError),
    /// There is no tree to invite to.
    #[error("There is no tree {0}; GET /api/v1/trees lists them.")]
    NoTree(String),
    /// Nothing goes by the name.
    #[error("There is no {what} {name}{hint}; `espalier {what} ls` lists them.")]
    NoneSuch {
        /// What it would be.
        what: &'static str,
        /// How it was called.
        name: String,
        /// What may have been meant.
        hint: String,
    },
    /// Nothing to be given goes by the name, or several do.
    #[error(
        "There is no {kind} {name:?}, or several are called so{hint}; `espalier library ls` lists trees by their identifiers."
    )]
    NothingSuch {
        /// A tree or a collection.
        kind: &'static str,
        /// How it was called.
        name: String,
        /// What may have been meant.
        hint: String,
    },
    /// It was not given to them.
    #[error("{what} was not given to {name}{hint}; `espalier member ls` lists to whom it was.")]
    NotGiven {
        /// What was to be taken back.
        what: String,
        /// From whom.
        name: String,
        /// Who may have been meant.
        hint: String,
    },
    /// Somebody goes by the name.
    #[error("There is a user {0} already; `espalier user passwd` gives them another password.")]
    Taken(String),
    /// There is such a group.
    #[error("There is a group {0} already; `espalier group role` gives it another role.")]
    TakenGroup(String),
    /// They are in no such group.
    #[error("{user} is not in a group {group}{hint}; `espalier group ls` lists who is.")]
    NoMember {
        /// The group.
        group: String,
        /// Who was to leave it.
        user: String,
        /// Who may have been meant.
        hint: String,
    },
    /// Nobody else is an administrator.
    #[error(
        "{0} is the last administrator: nobody would look after who comes in over the network. \
         `espalier user add --admin NAME` adds another one; --force does it all the same."
    )]
    LastAdmin(String),
    /// It is no password.
    #[error("The password cannot be taken: {0}.")]
    Password(String),
    /// Nobody types it.
    #[error("The password cannot be read: {0}.")]
    Unread(io::Error),
    /// The runtime cannot be made.
    #[error("The program's threads cannot be started: {0}.")]
    Threads(#[from] io::Error),
}

/// `espalier invite`.
pub fn invite(options: cli::Invite) -> Result<(), PeopleError> {
    let cli::Invite { role, tree, lasts, name, url, port, database } = options;
    let called = name.clone();
    let invite = admission::Invite { name, role, tree: tree.clone(), lasts };
    let secret = at(&database.path, async |store| {
        match (admission::invite(store, invite, SystemTime::now()).await, tree) {
            (Err(StoreError::NotFound(_)), Some(tree)) => Err(PeopleError::NoTree(tree)),
            (made, tree) => {
                let object = [Some(called), tree].into_iter().flatten().collect::<Vec<_>>().join(" ");
                let made = made?;
                store.note(Event::at_machine("invite", &object)).await?;
                Ok(made)
            }
        }
    })?;
    let everywhere = SocketAddr::new(IpAddr::V4(Ipv4Addr::UNSPECIFIED), port);
    let addresses = url.map_or_else(|| announce::addresses(everywhere), |url| vec![url]);
    let medium = if io::stdout().is_terminal() { Medium::Terminal } else { Medium::Plain };
    let waits = lasts.unwrap_or(INVITATION_LIFE);
    print(announce::invitation(&addresses, secret.text(), waits, medium).trim_end());
    Ok(())
}

/// `espalier device`.
pub fn device(command: &cli::Device) -> Result<(), PeopleError> {
    match command {
        cli::Device::Ls(options) => list(options, PassKind::Device),
        cli::Device::Revoke(options) => revoke(options, PassKind::Device, "device"),
    }
}

/// `espalier token`.
pub fn token(command: &cli::Token) -> Result<(), PeopleError> {
    match command {
        cli::Token::Create(cli::NewToken { name, scope, lasts, database }) => {
            let role = match scope {
                Scope::Read => Role::Viewer,
                Scope::Comment => Role::Commenter,
                Scope::Write => Role::Editor,
            };
            let made = at(&database.path, async |store| {
                // Whoever sits at the machine has as many as they like.
                let new = NewToken { name: name.clone(), role, holder: None, lasts: *lasts, most: u32::MAX };
                let (made, _) = admission::token(store, new, SystemTime::now()).await?;
                store.note(Event::at_machine("token", name)).await?;
                Ok(made)
            });
            print(made?.text());
            Ok(())
        }
        cli::Token::Ls(options) => list(options, PassKind::Token),
        cli::Token::Revoke(options) => revoke(options, PassKind::Token, "token"),
    }
}

fn list(options: &cli::Listed, kind: PassKind) -> Result<(), PeopleError> {
    let all = at(&options.database.path, async |store| {
        Ok(store.passes(kind, &written(SystemTime::now())).await?)
    })?;
    for Pass { id, name, role, holder, tree, created_at, expires_at, .. } in all {
        let of = holder.map(|holder| format!(" of {}", holder.name())).unwrap_or_default();
        let tree = tree.map(|tree| format!(" of tree {tree}")).unwrap_or_default();
        print(&format!("{id}  {name}{of}: {}{tree}, since {created_at}, until {expires_at}", role.name()));
    }
    Ok(())
}

fn revoke(options: &cli::Revoked, kind: PassKind, what: &'static str) -> Result<(), PeopleError> {
    let name = &options.name;
    at(&options.database.path, async |store| {
        let all = store.passes(kind, &written(SystemTime::now())).await?;
        let mut taken = 0;
        for pass in all.iter().filter(|pass| pass.id == *name || pass.name == *name) {
            taken += u32::from(store.take_pass(&pass.id).await?);
        }
        if taken == 0 {
            let hint = asked_for(name, all.iter().map(|pass| pass.name.as_str()));
            return Err(PeopleError::NoneSuch { what, name: name.clone(), hint });
        }
        Ok(store.note(Event::at_machine("revoke", &format!("{what} {name}"))).await?)
    })?;
    print(&format!("{name} is let in no longer."));
    Ok(())
}

/// Does something in a database, beside a server that may be using it.
fn at<T>(
    path: &Path,
    work: impl AsyncFnOnce(&SqliteStore) -> Result<T, PeopleError>,
) -> Result<T, PeopleError> {
    tokio::runtime::Builder::new_current_thread().enable_all().build()?.block_on(async {
        let store = SqliteStore::open_beside(path).await?;
        let done = work(&store).await;
        store.close().await;
        done
    })
}

fn print(line: &str) {
    // A reader that has gone is no error of ours.
    let _ = writeln!(io::stdout(), "{line}");
}
