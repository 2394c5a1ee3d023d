//! `espalier member`: to whom trees and collections are given.

use super::{PeopleError, at, groups, print, users};
use crate::{
    cli::{self, MembersOf, NewMember, RemovedMember, Shared},
    similar::asked_for,
    store::{
        Audit, Event, Finding, Gift, Gifts, Given, Library, Missing, Receiver, SqliteStore, StoreError,
        TreeQuery,
    },
};

/// `espalier member`.
pub fn member(command: &cli::Member) -> Result<(), PeopleError> {
    match command {
        cli::Member::Add(NewMember { shared, name, group, role }) => {
            let called = at(&shared.database.path, async |store| {
                let (id, called) = found(store, shared).await?;
                let to = receiver(name, *group);
                match store.give(gift(shared, &id), &to, *role).await {
                    Err(StoreError::NotFound(Missing::User)) => return Err(users::none(store, name).await?),
                    Err(StoreError::NotFound(Missing::Group)) => return Err(groups::none(store, name).await?),
                    given => given?,
                }
                let noted = format!("{called} {name} {}", role.name());
                store.note(Event::at_machine("give", &noted)).await?;
                Ok(called)
            })?;
            print(&format!("{name} is {} of {called} from now on.", role.name()));
        }
        cli::Member::Ls(MembersOf { shared }) => {
            let given = at(&shared.database.path, async |store| {
                let (id, _) = found(store, shared).await?;
                Ok(store.given(gift(shared, &id)).await?)
            })?;
            for Given { to, role, .. } in given {
                let kind = if matches!(to, Receiver::Group(_)) { "group " } else { "" };
                print(&format!("{kind}{}: {}", to.name(), role.name()));
            }
        }
        cli::Member::Remove(RemovedMember { shared, name, group }) => {
            let called = at(&shared.database.path, async |store| {
                let (id, called) = found(store, shared).await?;
                let given = store.given(gift(shared, &id)).await?;
                let to = receiver(name, *group);
                let from = given.iter().find(|given| given.to.is_called(&to));
                let was_given = match from {
                    Some(from) => store.take_back(gift(shared, &id), &from.id).await?,
                    None => false,
                };
                if !was_given {
                    let hint = asked_for(name, given.iter().map(|given| given.to.name()));
                    return Err(PeopleError::NotGiven { what: called, name: name.clone(), hint });
                }
                store.note(Event::at_machine("take-back", &format!("{called} {name}"))).await?;
                Ok(called)
            })?;
            print(&format!("{called} is given to {name} no longer."));
        }
    }
    Ok(())
}

fn receiver(name: &str, is_group: bool) -> Receiver {
    if is_group { Receiver::Group(name.to_owned()) } else { Receiver::User(name.to_owned()) }
}

fn gift<'a>(shared: &Shared, id: &'a str) -> Gift<'a> {
    if shared.collection { Gift::Collection(id) } else { Gift::Tree(id) }
}

/// The identifier and the name of what is meant.
async fn found(
    store: &SqliteStore,
    Shared { what, collection, .. }: &Shared,
) -> Result<(String, String), PeopleError> {
    let all: Vec<(String, String)> = if *collection {
        store.collections().await?.into_iter().map(|one| (one.id, one.name)).collect()
    } else {
        store.trees(&TreeQuery::default()).await?.into_iter().map(|one| (one.id, one.name)).collect()
    };
    let mut named = all.iter().filter(|(_, name)| name == what);
    let by_name = named.next().filter(|_| named.next().is_none());
    let found = all.iter().find(|(id, _)| id == what).or(by_name);
    found.cloned().ok_or_else(|| {
        let hint = asked_for(what, all.iter().map(|(_, name)| name.as_str()));
        let kind = if *collection { "collection" } else { "tree" };
        PeopleError::NothingSuch { kind, name: what.clone(), hint }
    })
}
