//! Passes in the model.

use espalier_proto::access::Role;

use super::{
    super::{Missing, Pass, PassKind, Passes, StoreError, folding::folded},
    MemoryStore,
};
use crate::access::SecretHash;

impl Passes for MemoryStore {
    async fn add_pass(&self, hash: SecretHash, mut pass: Pass) -> Result<(), StoreError> {
        let mut kept = self.writing()?;
        if pass.tree.as_ref().is_some_and(|tree| !kept.trees.contains_key(tree)) {
            return Err(StoreError::NotFound(Missing::Tree));
        }
        if pass.kind == PassKind::Login {
            let user = kept.users.get(&folded(&pass.name)).ok_or(StoreError::NotFound(Missing::User))?;
            pass.role = user.role;
        }
        kept.passes.push((hash, pass));
        Ok(())
    }

    async fn pass(&self, hash: SecretHash, now: &str) -> Result<Option<Pass>, StoreError> {
        let kept = self.kept();
        let found = kept.passes.iter().find(|(of, pass)| *of == hash && *pass.expires_at > *now);
        Ok(found.map(|(_, pass)| kept.in_force(pass.clone())))
    }

    async fn passes(&self, kind: PassKind, now: &str) -> Result<Vec<Pass>, StoreError> {
        let kept = self.kept();
        let found = kept.passes.iter().map(|(_, pass)| pass);
        let found = found.filter(|pass| pass.kind == kind && *pass.expires_at > *now);
        let mut found: Vec<Pass> = found.map(|pass| kept.in_force(pass.clone())).collect();
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

    async fn take_pass(&self, id: &str) -> Result<bool, StoreError> {
        Ok(self.writing()?.passes.extract_if(.., |(_, pass)| pass.id == id).count() > 0)
    }

    async fn purge_passes(&self, now: &str) -> Result<(), StoreError> {
        self.writing()?.passes.retain(|(_, pass)| *pass.expires_at > *now);
        Ok(())
    }
}
