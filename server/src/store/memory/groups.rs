//! Groups of users in the model.

use espalier_proto::access::Role;

use super::{
    super::{Group, GroupChange, Groups, Holder, Missing, Pass, PassKind, StoreError, folding::folded},
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

    async fn change_group(
        &self,
        id: &str,
        GroupChange { name: other, role }: GroupChange,
        expected: Option<u64>,
    ) -> Result<bool, StoreError> {
        let mut kept = self.writing()?;
        let Some(own) = kept.group_at(id, expected)?.map(|group| folded(&group.name)) else {
            return Ok(false);
        };
        let key = other.as_deref().map_or_else(|| own.clone(), folded);
        if key != own && kept.groups.contains_key(&key) {
            return Err(StoreError::Taken);
        }
        let Some(group) = kept.groups.remove(&own) else { return Ok(false) };
        let (name, role) = (other.unwrap_or(group.name), role.unwrap_or(group.role));
        kept.groups.insert(key, Group { name, role, revision: group.revision + 1, ..group });
        Ok(true)
    }

    async fn remove_group(&self, id: &str, expected: Option<u64>) -> Result<bool, StoreError> {
        let mut kept = self.writing()?;
        let Some(own) = kept.group_at(id, expected)?.map(|group| folded(&group.name)) else {
            return Ok(false);
        };
        kept.forget_gifts(|gift| gift.is_to_group(id));
        Ok(kept.groups.remove(&own).is_some())
    }

    async fn join_group(&self, id: &str, user: &str, expected: Option<u64>) -> Result<(), StoreError> {
        let mut kept = self.writing()?;
        kept.group_at(id, expected)?.ok_or(StoreError::NotFound(Missing::Group))?;
        let user = kept.user_with(user).ok_or(StoreError::NotFound(Missing::User))?.name;
        let group = kept.group_at(id, expected)?.filter(|group| !group.members.contains(&user));
        if let Some(group) = group {
            group.members.push(user);
            group.members.sort_by_key(|member| folded(member));
            group.revision += 1;
        }
        Ok(())
    }

    async fn leave_group(&self, id: &str, user: &str, expected: Option<u64>) -> Result<bool, StoreError> {
        let mut kept = self.writing()?;
        let user = kept.user_with(user).map(|user| user.name);
        let Some(group) = kept.group_at(id, expected)? else { return Ok(false) };
        let left = group.members.extract_if(.., |member| Some(&*member) == user.as_ref()).count();
        group.revision += u64::from(left > 0);
        Ok(left > 0)
    }
}

impl Kept {
    /// A group, which is at a revision if one is expected.
    fn group_at(&mut self, id: &str, expected: Option<u64>) -> Result<Option<&mut Group>, StoreError> {
        let group = self.groups.values_mut().find(|group| group.id == id);
        match group {
            Some(group) if expected.is_some_and(|expected| expected != group.revision) => {
                Err(StoreError::Stale)
            }
            group => Ok(group),
        }
    }

    /// The most that a group gives a user.
    pub(super) fn group_role(&self, user: &str) -> Option<Role> {
        let is_member = |group: &&Group| group.members.iter().any(|member| folded(member) == folded(user));
        self.groups.values().filter(is_member).map(|group| group.role).max()
    }

    /// A pass with what it allows now; nothing where a token's device is let in no longer.
    pub(super) fn in_force(&self, mut pass: Pass, now: &str) -> Option<Pass> {
        let most = match &mut pass.holder {
            None => return Some(pass),
            Some(Holder::User { id, name }) => {
                let user = self.users.values().find(|user| user.id == *id)?;
                name.clone_from(&user.name);
                self.group_role(&user.name).map_or(user.role, |role| role.max(user.role))
            }
            Some(Holder::Device { id, .. }) => {
                let mut maker = self.passes.iter().map(|(_, other)| other);
                maker.find(|other| other.id == *id && *other.expires_at > *now)?.role
            }
        };
        if pass.kind == PassKind::Login {
            let name = pass.holder.as_ref().map(|holder| holder.name().to_owned());
            pass.name = name.unwrap_or(pass.name);
            pass.role = most;
        } else {
            pass.most = Some(pass.role);
            pass.role = pass.role.min(most);
        }
        Some(pass)
    }

    /// They are in no group any more.
    pub(super) fn leave_all(&mut self, user: &str) {
        for group in self.groups.values_mut() {
            group.members.retain(|member| folded(member) != folded(user));
        }
    }
}
