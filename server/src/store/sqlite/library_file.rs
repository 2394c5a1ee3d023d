//! The library of a database to read, with a server on it or without.

use std::path::Path;

use sqlx::{Connection, SqlitePool, sqlite::SqlitePoolOptions};

use super::{
    super::{SessionLine, SessionQuery, StoreError, StoredTree, StoredVersion, TreeDocument, TreeQuery},
    care,
    open::{self, OpenError, common_options, sentence},
    trees, visits,
};

/// Reads trees and versions; nothing is written.
#[derive(Debug)]
pub struct LibraryFile(SqlitePool);

impl LibraryFile {
    /// Opens a database of ours with the present schema.
    pub async fn open(database: &Path) -> Result<Self, OpenError> {
        let refused = |reason| OpenError::new(database, reason);
        let mut connection = care::reading(database).await?;
        if !open::is_current(&mut connection).await.map_err(refused)? {
            return Err(refused(care::EARLIER.into()));
        }
        // Whether the connection ends well matters to nobody.
        drop(connection.close().await);
        let options = SqlitePoolOptions::new().max_connections(1);
        let readers = options.connect_with(common_options(database).read_only(true)).await;
        Ok(Self(readers.map_err(|error| refused(sentence(&error)))?))
    }

    /// Some trees, in order.
    pub async fn trees(&self, query: &TreeQuery) -> Result<Vec<StoredTree>, StoreError> {
        trees::list(&self.0, query).await
    }

    /// Some sessions, those first in which something was done last.
    pub async fn sessions(&self, query: &SessionQuery) -> Result<Vec<SessionLine>, StoreError> {
        visits::list(&self.0, query).await
    }

    /// All versions of a tree, newest first.
    pub async fn versions(&self, tree: &str) -> Result<Vec<StoredVersion>, StoreError> {
        trees::versions(&self.0, tree, u32::MAX, None).await
    }

    /// The document of a version.
    pub async fn document(&self, tree: &str, version: u32) -> Result<Option<TreeDocument>, StoreError> {
        trees::document(&self.0, tree, version).await
    }
}
