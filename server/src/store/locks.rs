//! Trees that owners alone change for now.

use super::StoreError;

/// Keeps who has locked which tree.
pub trait Locks {
    /// Somebody locks a tree, or nobody does any more; whether the tree is there.
    async fn lock_tree(&self, tree: &str, by: Option<String>) -> Result<bool, StoreError>;

    /// Who has locked a tree, if anybody has.
    async fn lock_of(&self, tree: &str) -> Result<Option<String>, StoreError>;
}
