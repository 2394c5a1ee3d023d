//! The library of trees in SQLite.

use sqlx::{SqlitePool, sqlite::SqliteConnection};

use super::super::{NewTree, Picture, StoreError, StoredTree, TreeDocument, TreeKey, seal::tree_sum};

#[derive(Debug)]
pub(super) enum TreeWrite {
    Save(NewTree),
    Rename { id: String, name: String },
    Delete { id: String },
}

/// Identifier, name, metamers, time, whether there is a picture.
type Line = (String, String, u32, String, bool);

fn line((id, name, metamers, saved_at, has_thumbnail): Line) -> StoredTree {
    StoredTree { key: TreeKey { saved_at, id }, name, metamers, has_thumbnail }
}

pub(super) async fn list(
    readers: &SqlitePool,
    limit: u32,
    behind: Option<&TreeKey>,
) -> Result<Vec<StoredTree>, StoreError> {
    let lines: Vec<Line> = sqlx::query_as(
        "SELECT id, name, metamers, saved_at, thumbnail IS NOT NULL FROM trees
         WHERE ?1 IS NULL OR (saved_at, id) < (?1, ?2) ORDER BY saved_at DESC, id DESC LIMIT ?3",
    )
    .bind(behind.map(|key| &key.saved_at))
    .bind(behind.map(|key| &key.id))
    .bind(limit)
    .fetch_all(readers)
    .await?;
    Ok(lines.into_iter().map(line).collect())
}

pub(super) async fn find(readers: &SqlitePool, id: &str) -> Result<Option<StoredTree>, StoreError> {
    let found: Option<Line> =
        sqlx::query_as("SELECT id, name, metamers, saved_at, thumbnail IS NOT NULL FROM trees WHERE id = ?")
            .bind(id)
            .fetch_optional(readers)
            .await?;
    Ok(found.map(line))
}

pub(super) async fn document(readers: &SqlitePool, id: &str) -> Result<Option<TreeDocument>, StoreError> {
    let row: Option<(u32, Vec<u8>, Option<u32>)> =
        sqlx::query_as("SELECT simulation_version, document, checksum FROM trees WHERE id = ?")
            .bind(id)
            .fetch_optional(readers)
            .await?;
    let Some((simulation_version, bytes, checksum)) = row else { return Ok(None) };
    // Trees of the first release have none.
    if checksum.is_some_and(|checksum| checksum != tree_sum(id, &bytes)) {
        return Err(StoreError::Damaged(format!("the document of tree {id} is damaged")));
    }
    Ok(Some(TreeDocument { simulation_version, bytes }))
}

pub(super) async fn thumbnail(readers: &SqlitePool, id: &str) -> Result<Option<Picture>, StoreError> {
    let row: Option<(String, Vec<u8>)> =
        sqlx::query_as("SELECT thumbnail_type, thumbnail FROM trees WHERE id = ? AND thumbnail IS NOT NULL")
            .bind(id)
            .fetch_optional(readers)
            .await?;
    Ok(row.map(|(media_type, bytes)| Picture { media_type, bytes }))
}

impl TreeWrite {
    pub(super) async fn apply(&self, connection: &mut SqliteConnection) -> Result<u64, StoreError> {
        let query = match self {
            Self::Save(tree) => sqlx::query(
                "INSERT INTO trees (id, name, metamers, saved_at, simulation_version, document, checksum,
                                    thumbnail, thumbnail_type)
                 VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)",
            )
            .bind(&tree.id)
            .bind(&tree.name)
            .bind(tree.metamers)
            .bind(&tree.saved_at)
            .bind(tree.document.simulation_version)
            .bind(&tree.document.bytes)
            .bind(tree_sum(&tree.id, &tree.document.bytes))
            .bind(tree.thumbnail.as_ref().map(|picture| &picture.bytes))
            .bind(tree.thumbnail.as_ref().map(|picture| &picture.media_type)),
            Self::Rename { id, name } => {
                sqlx::query("UPDATE trees SET name = ? WHERE id = ?").bind(name).bind(id)
            }
            Self::Delete { id } => sqlx::query("DELETE FROM trees WHERE id = ?").bind(id),
        };
        Ok(query.execute(connection).await?.rows_affected())
    }
}
