//! Whose file it is, asked before anything is written to it.

use std::path::Path;

use sqlx::{ConnectOptions, sqlite::SqliteConnection};

use super::open::{common_options, migrator, sentence};

/// Of the header of every file of ours, set by the second migration.
const APPLICATION_ID: i64 = 0x4553_504c;

/// Why a file of somebody else is refused.
pub(super) const FOREIGN: &str = "it belongs to another program; nothing in it was changed";

/// Refuses a file that another program keeps its data in.
pub(super) async fn check(path: &Path) -> Result<(), String> {
    if is_ours(path).await? { Ok(()) } else { Err(FOREIGN.into()) }
}

/// Whether a file is one of ours or empty; an error where it cannot be read.
pub(super) async fn is_ours(path: &Path) -> Result<bool, String> {
    let options = common_options(path).read_only(true);
    let mut connection = options.connect().await.map_err(|error| sentence(&error))?;
    has_our_marks(&mut connection).await.map_err(|error| sentence(&error))
}

async fn has_our_marks(connection: &mut SqliteConnection) -> Result<bool, sqlx::Error> {
    let id: i64 = sqlx::query_scalar("PRAGMA application_id").fetch_one(&mut *connection).await?;
    if id != 0 {
        return Ok(id == APPLICATION_ID);
    }
    let tables: Vec<String> = sqlx::query_scalar(
        "SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT LIKE 'sqlite_%'",
    )
    .fetch_all(&mut *connection)
    .await?;
    if !tables.iter().any(|table| table == "_sqlx_migrations") {
        return Ok(tables.is_empty());
    }
    // The first release wrote no identifier, but its first migration is known; none is there if it was cut short.
    let first: Option<Vec<u8>> =
        sqlx::query_scalar("SELECT checksum FROM _sqlx_migrations ORDER BY version LIMIT 1")
            .fetch_optional(connection)
            .await?;
    Ok(first.map_or(tables.len() == 1, |first| first == *migrator().migrations[0].checksum))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use sqlx::Connection;

    use super::{
        super::{Folder, SqliteStore, open::writer_options},
        *,
    };
    use crate::store::Store;

    async fn with(folder: &Folder, statements: &[&'static str]) -> std::path::PathBuf {
        let path = folder.database();
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        let mut connection = common_options(&path).create_if_missing(true).connect().await.unwrap();
        for statement in statements {
            sqlx::query(*statement).execute(&mut connection).await.unwrap();
        }
        connection.close().await.unwrap();
        path
    }

    #[tokio::test]
    async fn a_foreign_file_is_left_as_it_is() {
        let foreign: [&[&'static str]; 4] = [
            &["CREATE TABLE photos (id INTEGER PRIMARY KEY)"],
            &["CREATE TABLE sessions (name TEXT)"],
            &["PRAGMA application_id = 252006674", "CREATE TABLE blob (id)"],
            &[
                "CREATE TABLE _sqlx_migrations (version, description, installed_on, success, checksum,
                 execution_time)",
                "CREATE TABLE sessions (name TEXT)",
                "INSERT INTO _sqlx_migrations VALUES (1, 'theirs', 0, TRUE, x'00', 0)",
            ],
        ];
        for statements in foreign {
            let folder = Folder::new();
            let path = with(&folder, statements).await;
            let before = fs::read(&path).unwrap();
            let refusal = SqliteStore::open(&path).await.unwrap_err().to_string();
            assert!(refusal.contains("it belongs to another program"), "{refusal}");
            assert_eq!(fs::read(&path).unwrap(), before);
            let beside = fs::read_dir(path.parent().unwrap()).unwrap().count();
            assert_eq!(beside, 1, "nothing is left beside it");
        }
    }

    #[tokio::test]
    async fn an_empty_file_becomes_ours() {
        let folder = Folder::new();
        let path = with(&folder, &["PRAGMA user_version = 1"]).await;
        SqliteStore::open(&path).await.unwrap().close().await;
        let mut connection = writer_options(&path).connect().await.unwrap();
        let id: i64 = sqlx::query_scalar("PRAGMA application_id").fetch_one(&mut connection).await.unwrap();
        assert_eq!(id, APPLICATION_ID);
    }

    #[tokio::test]
    async fn a_file_of_the_first_release_is_known_by_its_schema() {
        let folder = Folder::new();
        SqliteStore::open(&folder.database()).await.unwrap().close().await;
        with(&folder, &["PRAGMA application_id = 0"]).await;
        SqliteStore::open(&folder.database()).await.unwrap().close().await;
    }
}
