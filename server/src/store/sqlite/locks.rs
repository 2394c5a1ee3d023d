//! Locks in SQLite.

use sqlx::sqlite::SqliteConnection;

use super::{
    super::{Locks, StoreError},
    SqliteStore,
    writer::Write,
};

/// The tree, and by whom it is locked from now on.
#[derive(Debug)]
pub(super) struct LockWrite(String, Option<String>);

impl Locks for SqliteStore {
    async fn lock_tree(&self, tree: &str, by: Option<String>) -> Result<bool, StoreError> {
        Ok(self.writer.write(Write::Lock(LockWrite(tree.to_owned(), by))).await? > 0)
    }

    async fn lock_of(&self, tree: &str) -> Result<Option<String>, StoreError> {
        let found: Option<Option<String>> = sqlx::query_scalar("SELECT locked_by FROM trees WHERE key = ?")
            .bind(tree)
            .fetch_optional(&self.readers)
            .await?;
        Ok(found.flatten())
    }
}

impl LockWrite {
    pub(super) async fn apply(&self, connection: &mut SqliteConnection) -> Result<u64, StoreError> {
        let Self(tree, by) = self;
        let write = sqlx::query("UPDATE trees SET locked_by = ? WHERE key = ?").bind(by).bind(tree);
        Ok(write.execute(connection).await?.rows_affected())
    }
}
