//! Groups of users in the model.

use espalier_proto::access::Role;

use super::{
    super::{Group, Groups, Missing, Pass, PassKind, StoreError, folding::folded},
    Kept, MemoryStore,
};

impl Groups for MemoryStore {
    async fn add_group(&self, group: Group) -> Result<(), StoreError> {
        let mut kept = self.writing()?;
        let key = folded(&group.name);
        if kept.groups.contains_key(&key) {
            return Err(StoreError::Taken);
        }
        kept.groups.insert(key, Group { members: Vec::new(), ..group });
        Ok(())
    }

    async fn groups(&self) -> Result<Vec<Group>, StoreError> {
        Ok(self.kept().groups.values().cloned().collect())
    }

    async fn change_group(&self, name: &str, role: Role) -> Result<bool, StoreError> {
        let mut kept = self.writing()?;
        let group = kept.groups.get_mut(&folded(name));
        Ok(group.map(|group| group.role = role).is_some())
    }

    async fn remove_group(&self, name: &str) -> Result<bool, StoreError> {
        Ok(self.writing()?.groups.remove(&folded(name)).is_some())
    }

    async fn join_group(&self, name: &str, user: &str) -> Result<(), StoreError> {
        let mut kept = self.writing()?;
        if !kept.groups.contains_key(&folded(name)) {
            return Err(StoreError::NotFound(Missing::Group));
        }
        let user = kept.users.get(&folded(user)).ok_or(StoreError::NotFound(Missing::User))?.name.clone();
        if let Some(group) = kept.groups.get_mut(&folded(name)) {
            group.members.retain(|member| *member != user);
            group.members.push(user);
            group.members.sort_by_key(|member| folded(member));
        }
        Ok(())
    }

    async fn leave_group(&self, name: &str, user: &str) -> Result<bool, StoreError> {
        let mut kept = self.writing()?;
        let Some(group) = kept.groups.get_mut(&folded(name)) else { return Ok(false) };
        let left = group.members.extract_if(.., |member| folded(member) == folded(user));
        Ok(left.count() > 0)
    }
}

impl Kept {
    /// The most that a group gives a user.
    pub(super) fn group_role(&self, user: &str) -> Option<Role> {
        let is_member = |group: &&Group| group.members.iter().any(|member| folded(member) == folded(user));
        self.groups.values().filter(is_member).map(|group| group.role).max()
    }

    /// A pass with what it allows now.
    pub(super) fn in_force(&self, mut pass: Pass) -> Pass {
        if pass.kind == PassKind::Login {
            pass.role = self.group_role(&pass.name).map_or(pass.role, |role| role.max(pass.role));
        }
        pass
    }

    /// They are in no group any more.
    pub(super) fn leave_all(&mut self, user: &str) {
        for group in self.groups.values_mut() {
            group.members.retain(|member| folded(member) != folded(user));
        }
    }
}
