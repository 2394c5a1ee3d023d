//! The library of saved trees.

use sqlx::{
    FromRow, Row,
    sqlite::{SqliteConnection, SqliteRow},
};

use super::{Database, DatabaseError, writer::Write};

/// A picture as it was handed in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// `image/png`, `image/jpeg` or `image/webp`.
    pub media_type: String,
    /// The file.
    pub bytes: Vec<u8>,
}

/// A tree to be saved.
#[derive(Debug)]
pub struct NewTree {
    /// Its identifier, made by the caller.
    pub id: String,
    /// Its name.
    pub name: String,
    /// Living metamers.
    pub metamers: u32,
    /// The version of the simulation that grew it.
    pub simulation_version: u32,
    /// The document.
    pub document: Vec<u8>,
    /// Its picture.
    pub thumbnail: Option<Picture>,
}

/// One line of the library.
#[derive(Debug, PartialEq, Eq)]
pub struct StoredTree {
    /// Its identifier.
    pub id: String,
    /// Its name.
    pub name: String,
    /// Living metamers.
    pub metamers: u32,
    /// When it was saved: RFC 3339, UTC.
    pub saved_at: String,
    /// Whether it has a picture.
    pub has_thumbnail: bool,
}

impl FromRow<'_, SqliteRow> for StoredTree {
    fn from_row(row: &SqliteRow) -> Result<Self, sqlx::Error> {
        Ok(Self {
            id: row.try_get("id")?,
            name: row.try_get("name")?,
            metamers: row.try_get("metamers")?,
            saved_at: row.try_get("saved_at")?,
            has_thumbnail: row.try_get("has_thumbnail")?,
        })
    }
}

#[derive(Debug)]
pub(super) enum TreeWrite {
    Save(NewTree),
    Rename { id: String, name: String },
    Delete { id: String },
}

impl Database {
    /// Puts a tree into the library.
    pub async fn save_tree(&self, tree: NewTree) -> Result<(), DatabaseError> {
        self.writer.write(Write::Tree(TreeWrite::Save(tree))).await.map(drop)
    }

    /// Gives a tree another name; answers whether there is such a tree.
    pub async fn rename_tree(&self, id: String, name: String) -> Result<bool, DatabaseError> {
        Ok(self.writer.write(Write::Tree(TreeWrite::Rename { id, name })).await? > 0)
    }

    /// Takes a tree out of the library; answers whether there was such a tree.
    pub async fn delete_tree(&self, id: String) -> Result<bool, DatabaseError> {
        Ok(self.writer.write(Write::Tree(TreeWrite::Delete { id })).await? > 0)
    }

    /// So many trees, newest first; behind the one named, if one is.
    pub async fn trees(&self, limit: u32, behind: Option<&str>) -> Result<Vec<StoredTree>, DatabaseError> {
        Ok(sqlx::query_as(
            "SELECT id, name, metamers, saved_at, thumbnail IS NOT NULL AS has_thumbnail
             FROM trees
             WHERE ?1 IS NULL OR (saved_at, rowid) < (SELECT saved_at, rowid FROM trees WHERE id = ?1)
             ORDER BY saved_at DESC, rowid DESC LIMIT ?2",
        )
        .bind(behind)
        .bind(limit)
        .fetch_all(&self.readers)
        .await?)
    }

    /// One line of the library.
    pub async fn tree(&self, id: &str) -> Result<Option<StoredTree>, DatabaseError> {
        Ok(sqlx::query_as(
            "SELECT id, name, metamers, saved_at, thumbnail IS NOT NULL AS has_thumbnail FROM trees WHERE id = ?",
        )
        .bind(id)
        .fetch_optional(&self.readers)
        .await?)
    }

    /// A tree's document, with the version of the simulation that grew it.
    pub async fn tree_document(&self, id: &str) -> Result<Option<(u32, Vec<u8>)>, DatabaseError> {
        Ok(sqlx::query_as("SELECT simulation_version, document FROM trees WHERE id = ?")
            .bind(id)
            .fetch_optional(&self.readers)
            .await?)
    }

    /// A tree's picture, if there is such a tree and it has one.
    pub async fn thumbnail(&self, id: &str) -> Result<Option<Picture>, DatabaseError> {
        let row: Option<(String, Vec<u8>)> = sqlx::query_as(
            "SELECT thumbnail_type, thumbnail FROM trees WHERE id = ? AND thumbnail IS NOT NULL",
        )
        .bind(id)
        .fetch_optional(&self.readers)
        .await?;
        Ok(row.map(|(media_type, bytes)| Picture { media_type, bytes }))
    }
}

impl TreeWrite {
    pub(super) async fn apply(&self, connection: &mut SqliteConnection) -> Result<u64, sqlx::Error> {
        let query = match self {
            Self::Save(tree) => sqlx::query(
                "INSERT INTO trees
                 (id, name, metamers, saved_at, simulation_version, document, thumbnail, thumbnail_type)
                 VALUES (?, ?, ?, strftime('%Y-%m-%dT%H:%M:%fZ', 'now'), ?, ?, ?, ?)",
            )
            .bind(&tree.id)
            .bind(&tree.name)
            .bind(tree.metamers)
            .bind(tree.simulation_version)
            .bind(&tree.document)
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

#[cfg(test)]
mod tests {
    use super::{super::open::tests::Folder, *};

    fn tree(id: &str, thumbnail: Option<Picture>) -> NewTree {
        NewTree {
            id: id.into(),
            name: format!("The {id}"),
            metamers: 4_000_000_000,
            simulation_version: 1,
            document: id.as_bytes().to_vec(),
            thumbnail,
        }
    }

    fn picture() -> Picture {
        Picture { media_type: "image/png".into(), bytes: vec![1, 2, 3] }
    }

    #[tokio::test]
    async fn trees_are_listed_newest_first() {
        let folder = Folder::new();
        let database = Database::open(&folder.database()).await.unwrap();
        assert!(database.trees(9, None).await.unwrap().is_empty());
        for id in ["ash", "birch", "cedar"] {
            database.save_tree(tree(id, None)).await.unwrap();
        }
        let trees = database.trees(9, None).await.unwrap();
        let ids: Vec<&str> = trees.iter().map(|tree| tree.id.as_str()).collect();
        assert_eq!(ids, ["cedar", "birch", "ash"]);
        for (limit, behind, page) in [
            (2, None, ["cedar", "birch"].as_slice()),
            (2, Some("birch"), &["ash"]),
            (1, Some("cedar"), &["birch"]),
            (2, Some("ash"), &[]),
            (2, Some("felled"), &[]),
        ] {
            let trees = database.trees(limit, behind).await.unwrap();
            assert_eq!(trees.iter().map(|tree| tree.id.as_str()).collect::<Vec<_>>(), page, "{behind:?}");
        }
        assert_eq!(trees[0].metamers, 4_000_000_000);
        assert!(trees[0].saved_at.ends_with('Z') && trees[0].saved_at.contains('T'), "{}", trees[0].saved_at);
    }

    #[tokio::test]
    async fn a_tree_comes_back_whole() {
        let folder = Folder::new();
        let database = Database::open(&folder.database()).await.unwrap();
        database.save_tree(tree("ash", Some(picture()))).await.unwrap();
        database.save_tree(tree("birch", None)).await.unwrap();
        assert_eq!(database.tree_document("ash").await.unwrap(), Some((1, b"ash".to_vec())));
        assert_eq!(database.tree_document("elm").await.unwrap(), None);
        assert_eq!(database.thumbnail("ash").await.unwrap(), Some(picture()));
        assert_eq!(database.thumbnail("birch").await.unwrap(), None);
        assert_eq!(database.thumbnail("elm").await.unwrap(), None);
        assert!(database.tree("ash").await.unwrap().unwrap().has_thumbnail);
        assert!(!database.tree("birch").await.unwrap().unwrap().has_thumbnail);
    }

    #[tokio::test]
    async fn renaming_and_deleting_say_whether_it_was_there() {
        let folder = Folder::new();
        let database = Database::open(&folder.database()).await.unwrap();
        database.save_tree(tree("ash", None)).await.unwrap();
        assert!(database.rename_tree("ash".into(), "Old ash".into()).await.unwrap());
        assert!(!database.rename_tree("elm".into(), "Elm".into()).await.unwrap());
        assert_eq!(database.tree("ash").await.unwrap().unwrap().name, "Old ash");
        assert!(database.delete_tree("ash".into()).await.unwrap());
        assert!(!database.delete_tree("ash".into()).await.unwrap());
        assert_eq!(database.tree("ash").await.unwrap(), None);
    }
}
