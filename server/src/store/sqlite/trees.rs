//! Reading the library in SQLite.

use sqlx::{QueryBuilder, Row, Sqlite, SqlitePool, sqlite::SqliteRow};

use super::{
    super::{
        Picture, SessionTree, StoreError, StoredTree, StoredVersion, TreeDocument, TreeQuery,
        seal::{document_hash, tree_sum, version_sum, where_damaged},
    },
    finding, parts,
};

/// What lists tell of a tree; its newest version's note is asked for with its versions.
const TREE: &str =
    "SELECT key, name, note, is_template, origin, origin_version, head AS number, metamers, species,
    author, saved_at, created_at, deleted_at, session, revision,
    (SELECT group_concat(tag, char(10)) FROM tree_tags WHERE tree = id) AS tags,
    (SELECT collections.key FROM collections WHERE collections.id = collection) AS collection FROM trees";

pub(super) async fn list(readers: &SqlitePool, query: &TreeQuery) -> Result<Vec<StoredTree>, StoreError> {
    let mut sql = QueryBuilder::<Sqlite>::new(TREE);
    finding::narrow(&mut sql, query);
    let rows = sql.build().fetch_all(readers).await?;
    Ok(rows.iter().map(tree).collect::<Result<_, _>>()?)
}

pub(super) async fn find(readers: &SqlitePool, id: &str) -> Result<Option<StoredTree>, StoreError> {
    let mut sql = QueryBuilder::<Sqlite>::new(TREE);
    let row = sql.push(" WHERE key = ").push_bind(id).build().fetch_optional(readers).await?;
    Ok(row.as_ref().map(tree).transpose()?)
}

pub(super) async fn versions(
    readers: &SqlitePool,
    key: &str,
    limit: u32,
    before: Option<u32>,
) -> Result<Vec<StoredVersion>, StoreError> {
    let rows = sqlx::query(
        "SELECT versions.*
         FROM versions JOIN trees ON trees.id = versions.tree
         WHERE key = ?1 AND (?2 IS NULL OR number < ?2) ORDER BY number DESC LIMIT ?3",
    );
    let rows = rows.bind(key).bind(before).bind(limit).fetch_all(readers).await?;
    let version = |row| Ok(StoredVersion { restored: row_u32(row, "restored")?, ..version(row)? });
    Ok(rows.iter().map(version).collect::<Result<_, sqlx::Error>>()?)
}

fn row_u32(row: &SqliteRow, column: &str) -> Result<Option<u32>, sqlx::Error> {
    row.try_get(column)
}

fn tree(row: &SqliteRow) -> Result<StoredTree, sqlx::Error> {
    let origin: Option<String> = row.try_get("origin")?;
    let tags: Option<String> = row.try_get("tags")?;
    let mut tags: Vec<String> = tags.iter().flat_map(|tags| tags.split('\n')).map(str::to_owned).collect();
    tags.sort();
    Ok(StoredTree {
        id: row.try_get("key")?,
        name: row.try_get("name")?,
        note: row.try_get("note")?,
        is_template: row.try_get("is_template")?,
        tags,
        collection: row.try_get("collection")?,
        origin: origin.zip(row_u32(row, "origin_version")?),
        created_at: row.try_get("created_at")?,
        deleted_at: row.try_get("deleted_at")?,
        head: version(row)?,
        session: row.try_get("session")?,
        revision: row.try_get::<i64, _>("revision")?.cast_unsigned(),
    })
}

fn version(row: &SqliteRow) -> Result<StoredVersion, sqlx::Error> {
    Ok(StoredVersion {
        number: row.try_get("number")?,
        saved_at: row.try_get("saved_at")?,
        author: row.try_get("author")?,
        note: row.try_get("note")?,
        metamers: row.try_get("metamers")?,
        species: row.try_get("species")?,
        restored: None,
    })
}

pub(super) async fn document(
    readers: &SqlitePool,
    key: &str,
    number: u32,
) -> Result<Option<TreeDocument>, StoreError> {
    let row = sqlx::query(
        "SELECT name, head, trees.checksum AS of_tree, versions.checksum AS of_version,
                simulation_version, document, bytes, hash
         FROM trees JOIN versions ON versions.tree = trees.id JOIN documents ON documents.id = document
         WHERE key = ? AND number = ?",
    );
    // One transaction sees one state: the version may go in between otherwise.
    let mut transaction = readers.begin().await?;
    let row = row.bind(key).bind(number).fetch_optional(&mut *transaction).await?;
    let Some(row) = row else { return Ok(None) };
    let bytes = parts::contents(&mut transaction, row.try_get("bytes")?, row.try_get("document")?).await?;
    let document = TreeDocument { simulation_version: row.try_get("simulation_version")?, bytes };
    let (name, head): (String, u32) = (row.try_get("name")?, row.try_get("head")?);
    let hash: Option<Vec<u8>> = row.try_get("hash")?;
    // What earlier programs wrote has neither hash nor checksums.
    let is_whole = hash.as_ref().is_none_or(|hash| *hash == document_hash(&document))
        && row_u32(&row, "of_tree")?.is_none_or(|sum| sum == tree_sum(key, &name, head))
        && row_u32(&row, "of_version")?.is_none_or(|sum| sum == version_sum(key, number, hash.as_deref()));
    if is_whole {
        Ok(Some(document))
    } else {
        let place = where_damaged(&document.bytes);
        Err(StoreError::Damaged(format!("version {number} of the tree {key} is damaged{place}")))
    }
}

pub(super) async fn thumbnail(
    readers: &SqlitePool,
    key: &str,
    number: u32,
) -> Result<Option<Picture>, StoreError> {
    let row: Option<(String, Vec<u8>)> = sqlx::query_as(
        "SELECT media_type, bytes FROM trees JOIN versions ON versions.tree = trees.id
         JOIN pictures ON pictures.id = picture WHERE key = ? AND number = ?",
    )
    .bind(key)
    .bind(number)
    .fetch_optional(readers)
    .await?;
    Ok(row.map(|(media_type, bytes)| Picture { media_type, bytes }))
}

pub(super) async fn tree_of(readers: &SqlitePool, session: &str) -> Result<Option<SessionTree>, StoreError> {
    let row: Option<(String, u32, bool)> = sqlx::query_as(
        "SELECT key, tree_version, last_entry <= saved_through
         FROM sessions JOIN trees ON trees.id = sessions.tree WHERE sessions.name = ?",
    )
    .bind(session)
    .fetch_optional(readers)
    .await?;
    Ok(row.map(|(id, version, is_saved)| SessionTree { id, version, is_saved }))
}
