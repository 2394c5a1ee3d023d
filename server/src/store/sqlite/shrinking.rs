//! Giving the disk back what was deleted: SQLite keeps pages that are free until it is asked for them.

use std::time::Instant;

use sqlx::sqlite::SqliteConnection;

use super::{super::StoreError, open::sentence};

/// Pages that are given back in one step, 1 MiB of them, so that people's work has its turns between.
const STEP: u32 = 256;
/// What `PRAGMA auto_vacuum` answers where pages can be given back step by step.
const INCREMENTAL: i64 = 2;

/// Gives a step's pages back; whether there are more.
pub(super) async fn step(connection: &mut SqliteConnection) -> Result<bool, StoreError> {
    // One page goes with each row that the pragma would answer, so all of them are asked for.
    let query = sqlx::query(sqlx::AssertSqlSafe(format!("PRAGMA incremental_vacuum({STEP})")));
    query.fetch_all(&mut *connection).await?;
    let free: i64 = sqlx::query_scalar("PRAGMA freelist_count").fetch_one(connection).await?;
    Ok(free > 0)
}

/// Takes the pages that were given back out of the file itself, which else happens when so much has been written again
/// that SQLite does it, or when the server stops. Comes between transactions.
pub(super) async fn settle(connection: &mut SqliteConnection) {
    if let Err(error) = sqlx::query("PRAGMA wal_checkpoint(PASSIVE)").fetch_all(connection).await {
        tracing::debug!("the file gets smaller later: {}", sentence(&error));
    }
}

/// Rewrites a file of an earlier program once, from which pages could not be given back else. Where there is no room
/// for that, everything works as before.
pub(super) async fn allow(connection: &mut SqliteConnection) {
    let begun = Instant::now();
    match rewrite(connection).await {
        Ok(false) => {}
        Ok(true) => {
            tracing::info!("the database was rewritten in {:.1?}, so that it can shrink", begun.elapsed());
        }
        Err(error) => tracing::warn!(
            "the database cannot be rewritten, so it does not shrink when trees are deleted: {}",
            sentence(&error)
        ),
    }
}

async fn rewrite(connection: &mut SqliteConnection) -> Result<bool, sqlx::Error> {
    let found: i64 = sqlx::query_scalar("PRAGMA auto_vacuum").fetch_one(&mut *connection).await?;
    if found == INCREMENTAL {
        return Ok(false);
    }
    sqlx::query("PRAGMA auto_vacuum = INCREMENTAL").execute(&mut *connection).await?;
    sqlx::query("VACUUM").execute(connection).await?;
    Ok(true)
}

#[cfg(test)]
mod tests {
    use sqlx::ConnectOptions;

    use super::{
        super::{
            Folder, SqliteStore,
            open::{common_options, writer_options},
        },
        *,
    };
    use crate::store::{Library, Store, contract::tree_of_bytes};

    /// What no packing makes smaller.
    fn noise(bytes: u32) -> Vec<u8> {
        let mut state = 1_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 56) as u8
        };
        (0..bytes).map(|_| next()).collect()
    }

    async fn pages(connection: &mut SqliteConnection) -> i64 {
        sqlx::query_scalar("PRAGMA page_count").fetch_one(connection).await.unwrap()
    }

    #[tokio::test]
    async fn the_file_shrinks_when_all_is_deleted() {
        let folder = Folder::new();
        let store = SqliteStore::open(&folder.database()).await.unwrap();
        let mut look = common_options(&folder.database()).read_only(true).connect().await.unwrap();
        let empty = pages(&mut look).await;
        store.add_tree(tree_of_bytes("ash", "2026", noise(4_000_000))).await.unwrap();
        let full = pages(&mut look).await;
        assert!(full > empty + 900, "{full} pages");
        store.sql("UPDATE trees SET deleted_at = '2026'".into()).await;
        store.purge("2027", 1).await.unwrap();
        let mut steps = 1;
        while store.shrink().await.unwrap() {
            steps += 1;
        }
        assert!(steps > 2, "{steps} steps");
        assert!(pages(&mut look).await < empty + 20, "{} pages are left", pages(&mut look).await);
        let bytes = std::fs::metadata(folder.database()).unwrap().len();
        assert!(bytes < 1_000_000, "the file has {bytes} bytes while the server runs on");
        assert!(!store.shrink().await.unwrap());
    }

    #[tokio::test]
    async fn a_file_of_before_is_rewritten_once() {
        let folder = Folder::new();
        let store = SqliteStore::open(&folder.database()).await.unwrap();
        store.add_tree(tree_of_bytes("ash", "2026", vec![7; 10_000])).await.unwrap();
        store.close().await;
        let mut connection = writer_options(&folder.database()).connect().await.unwrap();
        sqlx::query("PRAGMA auto_vacuum = NONE").execute(&mut connection).await.unwrap();
        sqlx::query("VACUUM").execute(&mut connection).await.unwrap();
        assert!(rewrite(&mut connection).await.unwrap());
        assert!(!rewrite(&mut connection).await.unwrap());
        drop(connection);
        let store = SqliteStore::open(&folder.database()).await.unwrap();
        assert_eq!(store.document("ash", 1).await.unwrap().unwrap().bytes, vec![7; 10_000]);
    }
}
