//! Users in the model.

use super::{
    super::{Pass, PassKind, StoreError, User, UserChange, Users, folding::folded},
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
        Ok(self.kept().users.get(&folded(name)).cloned())
    }

    async fn users(&self) -> Result<Vec<User>, StoreError> {
        Ok(self.kept().users.values().cloned().collect())
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
        Ok(kept.users.remove(&folded(name)).is_some())
    }
}

fn end_logins(kept: &mut Kept, name: &str) {
    kept.passes.retain(|(_, pass)| !is_login_of(pass, name));
}

fn is_login_of(pass: &Pass, name: &str) -> bool {
    pass.kind == PassKind::Login && folded(&pass.name) == folded(name)
}
