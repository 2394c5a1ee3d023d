//! What trees are found by, in SQLite.

use std::collections::BTreeSet;

use sqlx::{QueryBuilder, Sqlite, SqlitePool, sqlite::SqliteConnection};

use super::{
    super::{
        Collection, CollectionChange, Missing, Sort, StoreError, TreeQuery,
        folding::{alternatives, folded, searched, uncased},
    },
    gifts,
};

#[derive(Debug)]
pub(super) enum FindingWrite {
    AddCollection(Collection),
    ChangeCollection(String, CollectionChange),
    DeleteCollection(String),
    SetFavourite { principal: String, tree: String, is_one: bool },
}

/// Adds the conditions of a query to one for trees.
pub(super) fn narrow(sql: &mut QueryBuilder<Sqlite>, query: &TreeQuery) {
    sql.push(if query.is_deleted { " WHERE deleted_at IS NOT NULL" } else { " WHERE deleted_at IS NULL" });
    if let Some(is_template) = query.is_template {
        sql.push(" AND is_template = ").push_bind(is_template);
    }
    let words: Vec<Vec<String>> = query.words.iter().map(|word| alternatives(word)).collect();
    // An index of three letters finds no fewer.
    let is_long = |part: &String| part.chars().count() >= 3 && !part.contains(char::is_control);
    let (long, short): (Vec<_>, Vec<_>) = words.into_iter().partition(|parts| parts.iter().all(is_long));
    if !long.is_empty() {
        let quoted = |part: &String| format!("\"{}\"", part.replace('"', "\"\""));
        let any = |parts: &Vec<String>| parts.iter().map(quoted).collect::<Vec<_>>().join(" OR ");
        let all: Vec<String> = long.iter().map(|parts| format!("({})", any(parts))).collect();
        sql.push(" AND id IN (SELECT rowid FROM trees_text WHERE trees_text MATCH ");
        sql.push_bind(all.join(" AND ")).push(")");
    }
    for parts in short {
        sql.push(" AND (FALSE");
        for part in parts {
            sql.push(" OR instr(search, ").push_bind(part).push(") > 0");
        }
        sql.push(")");
    }
    for tag in &query.tags {
        sql.push(" AND id IN (SELECT tree FROM tree_tags WHERE folded = ").push_bind(uncased(tag)).push(")");
    }
    match &query.collection {
        None => {}
        Some(None) => drop(sql.push(" AND collection IS NULL")),
        Some(Some(key)) => {
            sql.push(" AND collection = (SELECT id FROM collections WHERE key = ");
            sql.push_bind(key.clone()).push(")");
        }
    }
    if let Some(principal) = &query.favourites_of {
        sql.push(" AND id IN (SELECT tree FROM favourites WHERE principal = ");
        sql.push_bind(principal.clone()).push(")");
    }
    if let Some(person) = &query.seen_by {
        gifts::narrow(sql, person);
    }
    for (condition, value) in [
        (" AND key = ", &query.only),
        (" AND species = ", &query.species),
        (" AND author = ", &query.author),
        (" AND principal = ", &query.saved_by),
        (" AND saved_at >= ", &query.saved_from),
        (" AND saved_at < ", &query.saved_before),
    ] {
        if let Some(value) = value {
            sql.push(condition).push_bind(value.clone());
        }
    }
    let (least, most) = (*query.metamers.start(), *query.metamers.end());
    if (least, most) != (0, u32::MAX) {
        sql.push(" AND metamers BETWEEN ").push_bind(least).push(" AND ").push_bind(most);
    }
    let value = match (query.is_deleted, query.sort) {
        (true, _) => "deleted_at",
        (false, Sort::Newest | Sort::Oldest) => "saved_at",
        (false, Sort::Name) => "folded",
        (false, Sort::Largest | Sort::Smallest) => "metamers",
    };
    let (behind, order) = if query.is_ascending() { (">", "ASC") } else { ("<", "DESC") };
    if let Some(place) = &query.after {
        sql.push(format!(" AND ({value}, key) {behind} ("));
        if value == "metamers" {
            sql.push("CAST(").push_bind(place.value.clone()).push(" AS INTEGER)");
        } else {
            sql.push_bind(place.value.clone());
        }
        sql.push(", ").push_bind(place.id.clone()).push(")");
    }
    sql.push(format!(" ORDER BY {value} {order}, key {order} LIMIT ")).push_bind(query.limit);
}

/// Folds anew what is searched of a tree, and how its name is sorted.
pub(super) async fn fold(connection: &mut SqliteConnection, id: i64) -> Result<(), StoreError> {
    let tree = sqlx::query_as("SELECT name, note, species FROM trees WHERE id = ?").bind(id);
    let (name, note, species): (String, String, Option<String>) = tree.fetch_one(&mut *connection).await?;
    let tags = sqlx::query_scalar("SELECT tag FROM tree_tags WHERE tree = ? ORDER BY tag").bind(id);
    let tags: Vec<String> = tags.fetch_all(&mut *connection).await?;
    sqlx::query("UPDATE trees SET folded = ?, search = ? WHERE id = ?")
        .bind(folded(&name))
        .bind(searched(&name, &tags, &note, species.as_deref()))
        .bind(id)
        .execute(connection)
        .await?;
    Ok(())
}

/// Gives a tree a tag, spelt as other trees have it, unless it has it already.
pub(super) async fn tag(connection: &mut SqliteConnection, tree: i64, tag: &str) -> Result<(), StoreError> {
    let query = sqlx::query(
        "INSERT INTO tree_tags (tree, tag, folded)
         SELECT ?1, coalesce((SELECT tag FROM tree_tags WHERE folded = ?3 LIMIT 1), ?2), ?3
         WHERE NOT EXISTS (SELECT 1 FROM tree_tags WHERE tree = ?1 AND folded = ?3)",
    );
    query.bind(tree).bind(tag).bind(uncased(tag)).execute(connection).await?;
    Ok(())
}

/// Makes tags of an earlier program that differ in case alone one, spelt as most trees have it.
async fn unite_tags(connection: &mut SqliteConnection) -> Result<(), StoreError> {
    let new: Vec<String> = sqlx::query_scalar("SELECT DISTINCT tag FROM tree_tags WHERE folded = ''")
        .fetch_all(&mut *connection)
        .await?;
    for tag in &new {
        let query = sqlx::query("UPDATE tree_tags SET folded = ? WHERE tag = ?").bind(uncased(tag)).bind(tag);
        query.execute(&mut *connection).await?;
    }
    let all: Vec<(String, String)> = sqlx::query_as(
        "SELECT folded, tag FROM tree_tags WHERE ?
         GROUP BY folded, tag ORDER BY folded, count(*) DESC, tag",
    )
    .bind(!new.is_empty())
    .fetch_all(&mut *connection)
    .await?;
    for same in all.chunk_by(|(one, _), (other, _)| one == other) {
        for (_, other) in &same[1..] {
            let query = sqlx::query("UPDATE OR REPLACE tree_tags SET tag = ? WHERE tag = ?");
            query.bind(&same[0].1).bind(other).execute(&mut *connection).await?;
        }
    }
    Ok(())
}

/// The same for trees of an earlier program.
pub(super) async fn fold_all(connection: &mut SqliteConnection) -> Result<(), StoreError> {
    let new = sqlx::query_scalar("SELECT id FROM trees WHERE search IS NULL");
    for id in new.fetch_all(&mut *connection).await? {
        fold(connection, id).await?;
    }
    unite_tags(connection).await
}

pub(super) async fn collections(readers: &SqlitePool) -> Result<Vec<Collection>, StoreError> {
    let rows: Vec<(String, String, Option<String>, u32)> = sqlx::query_as(
        "SELECT key, name, (SELECT key FROM collections AS above WHERE above.id = collections.parent),
                (SELECT count(*) FROM trees WHERE collection = collections.id AND deleted_at IS NULL)
         FROM collections",
    )
    .fetch_all(readers)
    .await?;
    let mut all: Vec<Collection> =
        rows.into_iter().map(|(id, name, parent, trees)| Collection { id, name, parent, trees }).collect();
    all.sort_by_key(|collection| (folded(&collection.name), collection.id.clone()));
    Ok(all)
}

pub(super) async fn tags(readers: &SqlitePool) -> Result<Vec<(String, u32)>, StoreError> {
    Ok(sqlx::query_as(
        "SELECT min(tag) AS tag, count(*) FROM tree_tags JOIN trees ON id = tree WHERE deleted_at IS NULL
         GROUP BY tree_tags.folded ORDER BY tag",
    )
    .fetch_all(readers)
    .await?)
}

pub(super) async fn authors(readers: &SqlitePool) -> Result<Vec<(String, u32)>, StoreError> {
    Ok(sqlx::query_as(
        "SELECT author, count(*) FROM trees WHERE deleted_at IS NULL AND author IS NOT NULL GROUP BY author ORDER BY author",
    )
    .fetch_all(readers)
    .await?)
}

pub(super) async fn favourites(
    readers: &SqlitePool,
    principal: &str,
) -> Result<BTreeSet<String>, StoreError> {
    let keys = sqlx::query_scalar(
        "SELECT key FROM favourites JOIN trees ON id = tree WHERE favourites.principal = ?",
    );
    Ok(keys.bind(principal).fetch_all(readers).await?.into_iter().collect())
}

/// The row of a collection, where one is named.
pub(super) async fn row_of(
    connection: &mut SqliteConnection,
    key: Option<&str>,
    missing: Missing,
) -> Result<Option<i64>, StoreError> {
    let Some(key) = key else { return Ok(None) };
    let found = sqlx::query_scalar("SELECT id FROM collections WHERE key = ?").bind(key);
    found.fetch_optional(connection).await?.map(Some).ok_or(StoreError::NotFound(missing))
}

impl FindingWrite {
    pub(super) async fn apply(&self, connection: &mut SqliteConnection) -> Result<u64, StoreError> {
        let query = match self {
            Self::AddCollection(Collection { id, name, parent, .. }) => {
                let parent = row_of(connection, parent.as_deref(), Missing::Parent).await?;
                let query = sqlx::query("INSERT INTO collections (key, name, parent) VALUES (?, ?, ?)");
                query.bind(id).bind(name).bind(parent)
            }
            Self::ChangeCollection(key, change) => return change_collection(connection, key, change).await,
            Self::DeleteCollection(key) => {
                let id = row_of(connection, Some(key), Missing::Collection).await?;
                for sql in [
                    "UPDATE trees SET collection = (SELECT parent FROM collections WHERE id = ?1) WHERE collection = ?1",
                    "UPDATE collections SET parent = (SELECT parent FROM collections WHERE id = ?1) WHERE parent = ?1",
                ] {
                    sqlx::query(sql).bind(id).execute(&mut *connection).await?;
                }
                sqlx::query("DELETE FROM collections WHERE id = ?").bind(id)
            }
            Self::SetFavourite { principal, tree, is_one } => {
                let found = sqlx::query_scalar("SELECT id FROM trees WHERE key = ?").bind(tree);
                let id: Option<i64> = found.fetch_optional(&mut *connection).await?;
                let id = id.ok_or(StoreError::NotFound(Missing::Tree))?;
                let query = sqlx::query(if *is_one {
                    "INSERT OR IGNORE INTO favourites (principal, tree) VALUES (?, ?)"
                } else {
                    "DELETE FROM favourites WHERE principal = ? AND tree = ?"
                });
                query.bind(principal).bind(id)
            }
        };
        Ok(query.execute(connection).await?.rows_affected())
    }
}

async fn change_collection(
    connection: &mut SqliteConnection,
    key: &str,
    change: &CollectionChange,
) -> Result<u64, StoreError> {
    let id = row_of(connection, Some(key), Missing::Collection).await?;
    if let Some(name) = &change.name {
        let query = sqlx::query("UPDATE collections SET name = ? WHERE id = ?").bind(name).bind(id);
        query.execute(&mut *connection).await?;
    }
    if let Some(parent) = &change.parent {
        let parent = row_of(connection, parent.as_deref(), Missing::Parent).await?;
        let is_above: bool = sqlx::query_scalar(
            "WITH RECURSIVE above (id) AS
                 (SELECT ?1 UNION SELECT parent FROM collections JOIN above USING (id) WHERE parent IS NOT NULL)
             SELECT EXISTS (SELECT 1 FROM above WHERE id = ?2)",
        )
        .bind(parent)
        .bind(id)
        .fetch_one(&mut *connection)
        .await?;
        if is_above {
            return Err(StoreError::Cycle);
        }
        let query = sqlx::query("UPDATE collections SET parent = ? WHERE id = ?").bind(parent).bind(id);
        query.execute(connection).await?;
    }
    Ok(1)
}
