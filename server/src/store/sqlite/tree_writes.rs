//! Writing the library in SQLite.

use sqlx::{Row, sqlite::SqliteConnection};

use super::{
    super::{
        Contents, Deletion, LONG_AGO, Missing, NewTree, NewVersion, Saved, StoreError, TreeChange,
        seal::{tree_sum, version_sum},
    },
    finding,
    parts::{self, Manifest},
};

#[derive(Debug)]
pub(super) enum TreeWrite {
    /// A tree, and where the parts of its document are where it has one of its own.
    Add(NewTree, Option<Manifest>),
    AddVersion {
        key: String,
        expected: Option<u64>,
        version: NewVersion,
        manifest: Option<Manifest>,
    },
    Change {
        key: String,
        expected: Option<u64>,
        change: TreeChange,
    },
    Purge {
        before: String,
        limit: u32,
    },
}

impl TreeWrite {
    /// Whether less is kept afterwards.
    pub(super) const fn frees(&self) -> bool {
        match self {
            Self::Change { change, .. } => {
                matches!(change.deletion, Some(Deletion::Deleted(_) | Deletion::ForGood))
            }
            Self::Purge { .. } => true,
            Self::Add(..) | Self::AddVersion { .. } => false,
        }
    }

    /// Answers with the number of the version that was made, or of rows changed.
    pub(super) async fn apply(&self, connection: &mut SqliteConnection) -> Result<u64, StoreError> {
        match self {
            Self::Add(tree, manifest) => add(connection, tree, manifest.as_ref()).await,
            Self::AddVersion { key, expected, version, manifest } => {
                let tree = Tree::there(connection, key, *expected).await?;
                add_version(connection, &tree, version, manifest.as_ref()).await
            }
            Self::Change { key, expected, change } => change_tree(connection, key, *expected, change).await,
            Self::Purge { before, limit } => purge(connection, before, *limit).await,
        }
    }
}

/// What a change needs to know of a tree.
#[derive(Debug)]
struct Tree {
    id: i64,
    key: String,
    name: String,
    head: u32,
    revision: i64,
    deleted_at: Option<String>,
    checksum: Option<u32>,
}

impl Tree {
    /// The tree at this revision.
    async fn at(
        connection: &mut SqliteConnection,
        key: &str,
        expected: Option<u64>,
    ) -> Result<Self, StoreError> {
        let sql = "SELECT id, name, head, revision, deleted_at, checksum FROM trees WHERE key = ?";
        let row = sqlx::query(sql).bind(key).fetch_optional(connection).await?;
        let row = row.ok_or(StoreError::NotFound(Missing::Tree))?;
        let revision = row.try_get("revision")?;
        if expected.is_some_and(|expected| expected != i64::cast_unsigned(revision)) {
            return Err(StoreError::Stale);
        }
        Ok(Self {
            id: row.try_get("id")?,
            key: key.to_owned(),
            name: row.try_get("name")?,
            head: row.try_get("head")?,
            revision,
            deleted_at: row.try_get("deleted_at")?,
            checksum: row.try_get("checksum")?,
        })
    }

    /// The same if it is not deleted.
    async fn there(
        connection: &mut SqliteConnection,
        key: &str,
        expected: Option<u64>,
    ) -> Result<Self, StoreError> {
        let row = Self::at(connection, key, expected).await?;
        if row.deleted_at.is_none() { Ok(row) } else { Err(StoreError::NotFound(Missing::Tree)) }
    }

    /// The checksum for another name and head. A row that was damaged stays damaged.
    fn checksum_as(&self, name: &str, head: u32) -> Option<u32> {
        let is_whole = self.checksum == Some(tree_sum(&self.key, &self.name, self.head));
        if is_whole { Some(tree_sum(&self.key, name, head)) } else { self.checksum }
    }
}

async fn add(
    connection: &mut SqliteConnection,
    tree: &NewTree,
    manifest: Option<&Manifest>,
) -> Result<u64, StoreError> {
    let NewTree { id: key, name, version } = tree;
    let origin = match &version.contents {
        Contents::Of { tree, version } => Some((tree, version)),
        Contents::New(_) => None,
    };
    let row = sqlx::query_scalar(
        "INSERT INTO trees (key, name, origin, origin_version, head, metamers, has_picture, saved_at, created_at,
                            checksum)
         VALUES (?1, ?2, ?3, ?4, 0, 0, FALSE, ?5, ?5, ?6) RETURNING id",
    )
    .bind(key)
    .bind(name)
    .bind(origin.map(|(tree, _)| tree))
    .bind(origin.map(|(_, version)| version))
    .bind(&version.saved_at)
    .bind(tree_sum(key, name, 0));
    let id = row.fetch_one(&mut *connection).await?;
    let tree = Tree {
        id,
        key: key.clone(),
        name: name.clone(),
        head: 0,
        revision: 0,
        deleted_at: None,
        checksum: Some(tree_sum(key, name, 0)),
    };
    add_version(connection, &tree, version, manifest).await
}

/// What a version holds, by the numbers of its rows.
#[derive(Debug)]
struct Held {
    document: i64,
    hash: Option<Vec<u8>>,
    picture: Option<i64>,
    metamers: u32,
    species: Option<String>,
}

async fn held(
    connection: &mut SqliteConnection,
    contents: &Contents,
    manifest: Option<&Manifest>,
) -> Result<Held, StoreError> {
    match contents {
        Contents::New(saved) => {
            let none = || StoreError::Damaged("the parts of a new document are not there".into());
            keep(connection, saved, manifest.ok_or_else(none)?).await
        }
        Contents::Of { tree, version } => {
            let row = sqlx::query(
                "SELECT document, hash, picture, versions.metamers, versions.species FROM versions
                 JOIN trees ON trees.id = versions.tree JOIN documents ON documents.id = document
                 WHERE key = ? AND number = ? AND deleted_at IS NULL",
            );
            let row = row.bind(tree).bind(version).fetch_optional(&mut *connection).await?;
            let Some(row) = row else {
                Tree::there(connection, tree, None).await?;
                return Err(StoreError::NotFound(Missing::Version));
            };
            Ok(Held {
                document: row.try_get("document")?,
                hash: row.try_get("hash")?,
                picture: row.try_get("picture")?,
                metamers: row.try_get("metamers")?,
                species: row.try_get("species")?,
            })
        }
    }
}

async fn keep(
    connection: &mut SqliteConnection,
    saved: &Saved,
    manifest: &Manifest,
) -> Result<Held, StoreError> {
    let Saved { document: _, metamers, species, thumbnail } = saved;
    let (document, hash) = parts::write_document(connection, manifest).await?;
    let mut picture = None;
    if let Some(new) = thumbnail {
        let row = sqlx::query_scalar("INSERT INTO pictures (media_type, bytes) VALUES (?, ?) RETURNING id");
        picture = Some(row.bind(&new.media_type).bind(&new.bytes).fetch_one(connection).await?);
    }
    Ok(Held { document, hash: Some(hash), picture, metamers: *metamers, species: species.clone() })
}

async fn add_version(
    connection: &mut SqliteConnection,
    tree: &Tree,
    version: &NewVersion,
    manifest: Option<&Manifest>,
) -> Result<u64, StoreError> {
    let held = held(connection, &version.contents, manifest).await?;
    let number = tree.head + 1;
    let restored = match &version.contents {
        Contents::Of { tree: of, version } if *of == tree.key => Some(version),
        _ => None,
    };
    sqlx::query(
        "INSERT INTO versions (tree, number, document, picture, metamers, species, restored, author, principal, note,
                               saved_at, checksum)
         VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
    )
    .bind(tree.id)
    .bind(number)
    .bind(held.document)
    .bind(held.picture)
    .bind(held.metamers)
    .bind(&held.species)
    .bind(restored)
    .bind(&version.author)
    .bind(&version.principal)
    .bind(&version.note)
    .bind(&version.saved_at)
    .bind(version_sum(&tree.key, number, held.hash.as_deref()))
    .execute(&mut *connection)
    .await?;
    let session = version.session.as_ref().map(|(name, _)| name);
    sqlx::query(
        "UPDATE trees SET head = ?, metamers = ?, species = ?, author = ?, principal = ?, has_picture = ?, saved_at = ?,
                          session = coalesce(?, session), revision = ?, checksum = ? WHERE id = ?",
    )
    .bind(number)
    .bind(held.metamers)
    .bind(&held.species)
    .bind(&version.author)
    .bind(&version.principal)
    .bind(held.picture.is_some())
    .bind(&version.saved_at)
    .bind(session)
    .bind(tree.revision + 1)
    .bind(tree.checksum_as(&tree.name, number))
    .bind(tree.id)
    .execute(&mut *connection)
    .await?;
    finding::fold(connection, tree.id).await?;
    if let Some((session, through)) = &version.session {
        sqlx::query("UPDATE sessions SET tree = ?, tree_version = ?, saved_through = ? WHERE name = ?")
            .bind(tree.id)
            .bind(number)
            .bind(through.cast_signed())
            .bind(session)
            .execute(connection)
            .await?;
    }
    Ok(number.into())
}

async fn change_tree(
    connection: &mut SqliteConnection,
    key: &str,
    expected: Option<u64>,
    change: &TreeChange,
) -> Result<u64, StoreError> {
    let TreeChange { name, note, is_template, version_note, tags, collection, deletion } = change;
    let tree = Tree::at(connection, key, expected).await?;
    match (tree.deleted_at.is_some(), deletion.as_ref().is_some_and(Deletion::is_of_deleted)) {
        (true, false) => return Err(StoreError::NotFound(Missing::Tree)),
        (false, true) => return Err(StoreError::NotDeleted),
        _ => {}
    }
    if let Some((number, note)) = version_note {
        let changed = sqlx::query("UPDATE versions SET note = ? WHERE tree = ? AND number = ?");
        let changed = changed.bind(note).bind(tree.id).bind(number).execute(&mut *connection).await?;
        if changed.rows_affected() == 0 {
            return Err(StoreError::NotFound(Missing::Version));
        }
    }
    if let Some(tags) = tags {
        sqlx::query("DELETE FROM tree_tags WHERE tree = ?").bind(tree.id).execute(&mut *connection).await?;
        for tag in tags {
            finding::tag(connection, tree.id, tag).await?;
        }
    }
    if let Some(collection) = collection {
        let row = finding::row_of(connection, collection.as_deref(), Missing::Collection).await?;
        let query = sqlx::query("UPDATE trees SET collection = ? WHERE id = ?").bind(row).bind(tree.id);
        query.execute(&mut *connection).await?;
    }
    let deleted_at = match deletion {
        Some(Deletion::Deleted(at)) => Some(at.as_str()),
        Some(Deletion::ForGood) => Some(LONG_AGO),
        Some(Deletion::Undeleted) | None => None,
    };
    let changed = sqlx::query(
        "UPDATE trees SET name = coalesce(?1, name), note = coalesce(?2, note),
                          is_template = coalesce(?3, is_template), deleted_at = ?4, revision = ?5, checksum = ?6
         WHERE id = ?7",
    )
    .bind(name)
    .bind(note)
    .bind(is_template)
    .bind(deleted_at)
    .bind(tree.revision + 1)
    .bind(tree.checksum_as(name.as_ref().unwrap_or(&tree.name), tree.head))
    .bind(tree.id);
    changed.execute(&mut *connection).await?;
    finding::fold(connection, tree.id).await?;
    Ok(1)
}

/// What no version holds any more goes when the store is tidied.
async fn purge(connection: &mut SqliteConnection, before: &str, limit: u32) -> Result<u64, StoreError> {
    let gone = sqlx::query(
        "DELETE FROM trees WHERE id IN
         (SELECT id FROM trees WHERE deleted_at < ? ORDER BY deleted_at LIMIT ?)",
    );
    Ok(gone.bind(before).bind(limit).execute(connection).await?.rows_affected())
}
