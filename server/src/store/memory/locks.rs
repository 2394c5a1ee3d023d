//! Locks in the model.

use super::{
    super::{Locks, StoreError},
    MemoryStore,
};

impl Locks for MemoryStore {
    async fn lock_tree(&self, tree: &str, by: Option<String>) -> Result<bool, StoreError> {
        let mut kept = self.writing()?;
        if !kept.trees.contains_key(tree) {
            return Ok(false);
        }
        match by {
            Some(by) => drop(kept.locks.insert(tree.to_owned(), by)),
            None => drop(kept.locks.remove(tree)),
        }
        Ok(true)
    }

    async fn lock_of(&self, tree: &str) -> Result<Option<String>, StoreError> {
        Ok(self.kept().locks.get(tree).cloned())
    }
}
