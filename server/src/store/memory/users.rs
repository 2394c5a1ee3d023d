//! Users in the model.

use espalier_proto::access::Role;

use super::{
    super::{
        Holder, Pass, PassKind, StoreError, Terms, User, UserChange, Users,
        folding::folded,
        identity_of, person_of,
        users::{mentioning_instead, person_removed},
    },
    Kept, MemoryStore,
};
use crate::access::SecretHash;

impl Users for MemoryStore {
    async fn add_user(&self, user: User) -> Result<(), StoreError> {
        let mut kept = self.writing()?;
        let key = folded(&user.name);
        if kept.users.contains_key(&key) {
            return Err(StoreError::Taken);
        }
        kept.users.insert(key, user);
        Ok(())
    }

    async fn user(&self, name: &str) -> Result<Option<User>, StoreError> {
        let kept = self.kept();
        Ok(kept.users.get(&folded(name)).map(|user| kept.grouped(user)))
    }

    async fn users(&self) -> Result<Vec<User>, StoreError> {
        let kept = self.kept();
        Ok(kept.users.values().map(|user| kept.grouped(user)).collect())
    }

    async fn change_user(&self, id: &str, change: UserChange, terms: Terms) -> Result<bool, StoreError> {
        let mut kept = self.writing()?;
        let Some(user) = kept.user_with(id) else { return Ok(false) };
        kept.check(&user, terms, change.role.is_some_and(|role| role != Role::Admin))?;
        let UserChange { name: other, role, password, stays } = change;
        let key = folded(other.as_deref().unwrap_or(&user.name));
        if key != folded(&user.name) && kept.users.contains_key(&key) {
            return Err(StoreError::Taken);
        }
        if password.is_some() {
            kept.end_logins(&user, stays);
        }
        let changed = User {
            name: other.unwrap_or(user.name.clone()),
            role: role.unwrap_or(user.role),
            password: password.unwrap_or(user.password.clone()),
            revision: user.revision + 1,
            ..user.clone()
        };
        kept.rename(&user.name, &changed.name);
        kept.users.remove(&folded(&user.name));
        kept.users.insert(key, changed);
        Ok(true)
    }

    async fn remove_user(&self, id: &str, terms: Terms) -> Result<bool, StoreError> {
        let mut kept = self.writing()?;
        let Some(user) = kept.user_with(id) else { return Ok(false) };
        kept.check(&user, terms, true)?;
        kept.passes.retain(|(_, pass)| !is_of(pass, &user));
        kept.forget_gifts(|gift| gift.is_to_user(&user.id));
        kept.leave_all(&user.name);
        let person = person_of(&user.name);
        kept.sessions.values_mut().for_each(|session| _ = session.people.remove(&person));
        kept.threads.values_mut().flatten().for_each(|(_, thread)| thread.forget_reader(&person));
        let identity = identity_of(id);
        for (_, named) in kept.authors.values_mut() {
            named.person.take_if(|of| **of == *identity);
        }
        // Nothing of theirs is left to whoever has the name after them.
        kept.heirs.retain(|_, heir| heir.person != person);
        kept.favourites.retain(|(who, _)| *who != person);
        kept.removals.retain(|removal| removal.person != person);
        kept.count_for(&person, &person_removed(id));
        Ok(kept.users.remove(&folded(&user.name)).is_some())
    }
}

impl Kept {
    /// The user with this identifier.
    pub(super) fn user_with(&self, id: &str) -> Option<User> {
        self.users.values().find(|user| user.id == id).cloned()
    }

    fn grouped(&self, user: &User) -> User {
        User { group_role: self.group_role(&user.name), ..user.clone() }
    }

    fn check(&self, user: &User, terms: Terms, stops: bool) -> Result<(), StoreError> {
        if terms.expected.is_some_and(|expected| expected != user.revision) {
            return Err(StoreError::Stale);
        }
        let mut others = self.users.values().filter(|other| other.id != user.id);
        let is_last = user.role == Role::Admin && !others.any(|other| other.role == Role::Admin);
        if stops && is_last && !terms.force { Err(StoreError::LastAdmin) } else { Ok(()) }
    }

    fn end_logins(&mut self, user: &User, stays: Option<SecretHash>) {
        let ends = |pass: &Pass| pass.kind == PassKind::Login && is_of(pass, user);
        self.passes.retain(|(hash, pass)| Some(*hash) == stays || !ends(pass));
    }

    /// What was of somebody is of the same person under another name.
    fn rename(&mut self, old_name: &str, new_name: &str) {
        for group in self.groups.values_mut() {
            let own = group.members.iter_mut().filter(|member| folded(member) == folded(old_name));
            own.for_each(|member| new_name.clone_into(member));
            group.members.sort_by_key(|member| folded(member));
        }
        let (old, new) = (person_of(old_name), person_of(new_name));
        if old == new {
            return;
        }
        for session in self.sessions.values_mut() {
            if session.people.remove(&old) {
                session.people.insert(new.clone());
            }
        }
        self.favourites = std::mem::take(&mut self.favourites)
            .into_iter()
            .map(|(person, tree)| (if person == old { new.clone() } else { person }, tree))
            .collect();
        let removals = self.removals.iter_mut().map(|removal| &mut removal.person);
        let heirs = self.heirs.values_mut().map(|heir| &mut heir.person);
        for person in removals.chain(heirs).filter(|person| **person == old) {
            person.clone_from(&new);
        }
        self.count_for(&old, &new);
    }
}

impl Kept {
    /// What somebody has saved and said, what they have read, and where they are mentioned, counts for another person.
    fn count_for(&mut self, old: &str, new: &str) {
        let savers = self.trees.values_mut().flat_map(|tree| tree.savers());
        for person in savers.filter(|person| **person == *old) {
            new.clone_into(person);
        }
        for (_, thread) in self.threads.values_mut().flatten() {
            thread.rename(old, new, |said| mentioning_instead(said, old, new));
        }
    }
}

fn is_of(pass: &Pass, user: &User) -> bool {
    matches!(&pass.holder, Some(Holder::User { id, .. }) if *id == user.id)
}
