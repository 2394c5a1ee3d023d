//! The library of trees in SQLite.

use sqlx::{SqliteExecutor, SqlitePool, sqlite::SqliteConnection};

use super::super::{
    NewTree, Picture, StoreError, StoredTree, TreeDocument, TreeKey,
    seal::{tree_sum, tree_sum_of},
};

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
    let Some((name, document, checksum)) = row(readers, id).await? else { return Ok(None) };
    // Trees of the first release have none.
    if checksum.is_some_and(|checksum| checksum != sum_of(id, &name, &document)) {
        return Err(StoreError::Damaged(format!("the tree {id} is damaged")));
    }
    Ok(Some(document))
}

/// Name, document and checksum.
type Row = (String, TreeDocument, Option<u32>);

async fn row(from: impl SqliteExecutor<'_>, id: &str) -> Result<Option<Row>, sqlx::Error> {
    let row: Option<(String, u32, Vec<u8>, Option<u32>)> =
        sqlx::query_as("SELECT name, simulation_version, document, checksum FROM trees WHERE id = ?")
            .bind(id)
            .fetch_optional(from)
            .await?;
    Ok(row.map(|(name, simulation_version, bytes, checksum)| {
        (name, TreeDocument { simulation_version, bytes }, checksum)
    }))
}

fn sum_of(id: &str, name: &str, document: &TreeDocument) -> u32 {
    tree_sum_of(id, name, document.simulation_version, &document.bytes)
}

/// A tree that is whole stays so; one that is damaged does not become whole by another name.
async fn rename(connection: &mut SqliteConnection, id: &str, name: &str) -> Result<u64, StoreError> {
    let Some((before, document, checksum)) = row(&mut *connection, id).await? else { return Ok(0) };
    let is_whole = checksum == Some(sum_of(id, &before, &document));
    let checksum = if is_whole { Some(sum_of(id, name, &document)) } else { checksum };
    let query = sqlx::query("UPDATE trees SET name = ?, checksum = ? WHERE id = ?").bind(name);
    Ok(query.bind(checksum).bind(id).execute(connection).await?.rows_affected())
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
            .bind(tree_sum(tree))
            .bind(tree.thumbnail.as_ref().map(|picture| &picture.bytes))
            .bind(tree.thumbnail.as_ref().map(|picture| &picture.media_type)),
            Self::Rename { id, name } => return rename(connection, id, name).await,
            Self::Delete { id } => sqlx::query("DELETE FROM trees WHERE id = ?").bind(id),
        };
        Ok(query.execute(connection).await?.rows_affected())
    }
}
