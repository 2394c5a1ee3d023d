//! Passes in the model.

use espalier_proto::access::Role;

use super::{
    super::{Holder, Missing, Pass, PassKind, Passes, StoreError},
    MemoryStore,
};
use crate::access::SecretHash;

impl Passes for MemoryStore {
    async fn add_pass(&self, hash: SecretHash, pass: Pass) -> Result<(), StoreError> {
        self.add_pass_up_to(u32::MAX, hash, pass).await
    }

    async fn add_pass_up_to(&self, most: u32, hash: SecretHash, pass: Pass) -> Result<(), StoreError> {
        let mut kept = self.writing()?;
        if pass.tree.as_ref().is_some_and(|tree| !kept.trees.contains_key(tree)) {
            return Err(StoreError::NotFound(Missing::Tree));
        }
        match &pass.holder {
            Some(Holder::User { id, .. }) if kept.users.values().all(|user| user.id != *id) => {
                return Err(StoreError::NotFound(Missing::User));
            }
            Some(Holder::Device { id, .. }) if kept.passes.iter().all(|(_, other)| other.id != *id) => {
                return Err(StoreError::NotFound(Missing::Pass));
            }
            _ => {}
        }
        let is_like_it = |other: &&(SecretHash, Pass)| is_like(&other.1, &pass);
        if kept.passes.iter().filter(is_like_it).count() >= most as usize {
            return Err(StoreError::Full);
        }
        kept.passes.push((hash, pass));
        Ok(())
    }

    async fn pass(&self, hash: SecretHash, now: &str) -> Result<Option<Pass>, StoreError> {
        let kept = self.kept();
        let found = kept.passes.iter().find(|(of, pass)| *of == hash && *pass.expires_at > *now);
        Ok(found.and_then(|(_, pass)| kept.in_force(pass.clone(), now)))
    }

    async fn passes(&self, kind: PassKind, now: &str) -> Result<Vec<Pass>, StoreError> {
        let kept = self.kept();
        let found = kept.passes.iter().map(|(_, pass)| pass);
        let found = found.filter(|pass| pass.kind == kind && *pass.expires_at > *now);
        let mut found: Vec<Pass> = found.filter_map(|pass| kept.in_force(pass.clone(), now)).collect();
        found.sort_by(|a, b| (&b.created_at, &b.id).cmp(&(&a.created_at, &a.id)));
        Ok(found)
    }

    async fn extend_pass(&self, id: &str, expires_at: &str) -> Result<(), StoreError> {
        let mut kept = self.writing()?;
        for (_, pass) in kept.passes.iter_mut().filter(|(_, pass)| pass.id == id) {
            expires_at.clone_into(&mut pass.expires_at);
        }
        Ok(())
    }

    async fn change_pass(&self, id: &str, role: Role) -> Result<bool, StoreError> {
        let mut writing = self.writing()?;
        let found = writing.passes.iter_mut().find(|(_, pass)| pass.id == id);
        Ok(found.map(|(_, pass)| pass.role = role).is_some())
    }

    async fn redeem_pass(&self, hash: SecretHash, device: &Pass) -> Result<bool, StoreError> {
        let mut kept = self.writing()?;
        let is_it = |(_, pass): &&mut (SecretHash, Pass)| {
            pass.id == device.id && pass.kind == PassKind::Invitation && pass.expires_at > device.created_at
        };
        let deleted = |id: &String| kept.trees.get(id).is_none_or(|tree| tree.deleted_at.is_some());
        if device.tree.as_ref().is_some_and(deleted) {
            return Ok(false);
        }
        let Some(found) = kept.passes.iter_mut().find(is_it) else { return Ok(false) };
        *found = (hash, Pass { role: found.1.role, ..device.clone() });
        Ok(true)
    }

    async fn take_pass(&self, id: &str) -> Result<bool, StoreError> {
        let mut kept = self.writing()?;
        let taken = kept.passes.extract_if(.., |(_, pass)| pass.id == id).count();
        kept.passes.retain(|(_, pass)| maker(pass) != Some(id));
        Ok(taken > 0)
    }

    async fn purge_passes(&self, now: &str) -> Result<(), StoreError> {
        let mut kept = self.writing()?;
        let gone = kept.passes.extract_if(.., |(_, pass)| *pass.expires_at <= *now);
        let gone: Vec<String> = gone.map(|(_, pass)| pass.id).collect();
        kept.passes.retain(|(_, pass)| maker(pass).is_none_or(|id| gone.iter().all(|other| other != id)));
        Ok(())
    }
}

/// Whether a pass lets in for the same tree as a new one, or for none and is a token of the same holder.
fn is_like(pass: &Pass, new: &Pass) -> bool {
    let holder = |pass: &Pass| match &pass.holder {
        Some(Holder::User { id, .. } | Holder::Device { id, .. }) => Some(id.clone()),
        None => None,
    };
    let is_like = match &new.tree {
        None => pass.kind == PassKind::Token && holder(pass) == holder(new),
        Some(_) => matches!(pass.kind, PassKind::Invitation | PassKind::Device),
    };
    is_like && pass.tree == new.tree && pass.expires_at > new.created_at
}

/// The device that has made a token.
fn maker(pass: &Pass) -> Option<&str> {
    match &pass.holder {
        Some(Holder::Device { id, .. }) => Some(id),
        _ => None,
    }
}
