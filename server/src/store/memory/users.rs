//! Users in the model.

use super::{
    super::{Pass, PassKind, StoreError, User, UserChange, Users, folding::folded, person_of},
    Kept, MemoryStore,
};

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

    async fn change_user(&self, name: &str, change: UserChange) -> Result<bool, StoreError> {
        let mut kept = self.writing()?;
        let Some(user) = kept.users.get_mut(&folded(name)) else { return Ok(false) };
        match change {
            UserChange::Role(role) => {
                user.role = role;
                for (_, pass) in kept.passes.iter_mut().filter(|(_, pass)| is_login_of(pass, name)) {
                    pass.role = role;
                }
            }
            UserChange::Password(password) => {
                user.password = password;
                end_logins(&mut kept, name);
            }
        }
        Ok(true)
    }

    async fn remove_user(&self, name: &str) -> Result<bool, StoreError> {
        let mut kept = self.writing()?;
        end_logins(&mut kept, name);
        kept.leave_all(name);
        let person = person_of(name);
        kept.sessions.values_mut().for_each(|session| _ = session.people.remove(&person));
        kept.threads.values_mut().flatten().for_each(|(_, thread)| thread.forget_reader(&person));
        for (_, named) in kept.authors.values_mut() {
            named.person.take_if(|of| **of == *person);
        }
        Ok(kept.users.remove(&folded(name)).is_some())
    }
}

impl Kept {
    fn grouped(&self, user: &User) -> User {
        User { group_role: self.group_role(&user.name), ..user.clone() }
    }
}

fn end_logins(kept: &mut Kept, name: &str) {
    kept.passes.retain(|(_, pass)| !is_login_of(pass, name));
}

fn is_login_of(pass: &Pass, name: &str) -> bool {
    pass.kind == PassKind::Login && folded(&pass.name) == folded(name)
}
