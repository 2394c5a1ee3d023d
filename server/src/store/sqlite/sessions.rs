//! Sessions in SQLite.

use sqlx::Row as _;
use sqlx::{
    SqlitePool,
    sqlite::{SqliteConnection, SqliteRow},
};

use super::super::{
    Damage, KEPT_SNAPSHOTS, Lease, NewSession, StoreError, StoredSession,
    lease::Leases,
    seal::{JournalRow, SnapshotRow, assemble, snapshot_sum},
};

#[derive(Debug)]
pub(super) enum SessionWrite {
    Create(NewSession),
    Append(Lease, JournalRow),
    Snapshot(Lease, SnapshotRow),
    SetAside(Lease, Vec<Damage>),
}

pub(super) async fn exists(readers: &SqlitePool, name: &str) -> Result<bool, StoreError> {
    let found: i64 = sqlx::query_scalar("SELECT EXISTS (SELECT 1 FROM sessions WHERE name = ?)")
        .bind(name)
        .fetch_one(readers)
        .await?;
    Ok(found != 0)
}

pub(super) async fn load(
    readers: &SqlitePool,
    name: &str,
    before: Option<u64>,
) -> Result<Option<StoredSession>, StoreError> {
    // One transaction sees one state: a snapshot and a deletion may come in between otherwise.
    let mut transaction = readers.begin().await?;
    let Some((seed, made_by)) =
        sqlx::query_as::<_, (u32, u32)>("SELECT seed, simulation_version FROM sessions WHERE name = ?")
            .bind(name)
            .fetch_optional(&mut *transaction)
            .await?
    else {
        return Ok(None);
    };
    let mut damage = Vec::new();
    let mut before = before;
    let snapshot = loop {
        let Some(row) = newest_snapshot(&mut transaction, name, before, made_by).await? else { break None };
        if row.is_whole(name) {
            break Some(row);
        }
        damage.push(Damage::Snapshot(row.through));
        before = Some(row.through);
    };
    // The journal alone is no way back: what came before the oldest snapshot may be gone, or a saved tree.
    if snapshot.is_none() && before.is_some() {
        return Err(StoreError::Damaged(format!("no snapshot of session {name} is whole")));
    }
    let through = snapshot.as_ref().map_or(0, |row| row.through);
    let rows = sqlx::query(
        "SELECT first, last, entries, checksum, coalesce(simulation_version, ?3) AS version
         FROM journal WHERE session = ?1 AND last > ?2 ORDER BY first",
    )
    .bind(name)
    .bind(through.cast_signed())
    .bind(made_by)
    .fetch_all(&mut *transaction)
    .await?;
    let rows = rows.iter().map(journal_row).collect::<Result<_, _>>()?;
    let mut stored = assemble(name, seed, made_by, snapshot, rows);
    stored.damage.splice(0..0, damage);
    Ok(Some(stored))
}

async fn newest_snapshot(
    connection: &mut SqliteConnection,
    session: &str,
    before: Option<u64>,
    made_by: u32,
) -> Result<Option<SnapshotRow>, sqlx::Error> {
    let row: Option<(i64, Vec<u8>, Option<u32>, u32)> = sqlx::query_as(
        "SELECT through, bytes, checksum, coalesce(simulation_version, ?3) FROM snapshots
         WHERE session = ?1 AND (?2 IS NULL OR through < ?2) ORDER BY through DESC LIMIT 1",
    )
    .bind(session)
    .bind(before.map(u64::cast_signed))
    .bind(made_by)
    .fetch_optional(connection)
    .await?;
    Ok(row.map(|(through, bytes, checksum, simulation_version)| SnapshotRow {
        through: through.cast_unsigned(),
        bytes,
        checksum,
        simulation_version,
    }))
}

fn journal_row(row: &SqliteRow) -> Result<JournalRow, sqlx::Error> {
    // What is no text any more is no row of ours either.
    let entries = row.try_get_unchecked::<Vec<u8>, _>("entries")?;
    Ok(JournalRow {
        first: row.try_get::<i64, _>("first")?.cast_unsigned(),
        last: row.try_get::<i64, _>("last")?.cast_unsigned(),
        entries: String::from_utf8(entries).unwrap_or_default(),
        checksum: row.try_get("checksum")?,
        simulation_version: row.try_get("version")?,
    })
}

impl SessionWrite {
    pub(super) async fn apply(
        &self,
        connection: &mut SqliteConnection,
        leases: &Leases,
    ) -> Result<u64, StoreError> {
        match self {
            Self::Create(new) => create(connection, new).await,
            Self::Append(lease, row) => {
                leases.check(lease)?;
                append(connection, &lease.session, row).await
            }
            Self::Snapshot(lease, row) => {
                leases.check(lease)?;
                insert_snapshot(connection, &lease.session, row).await?;
                drop_what_nobody_needs(connection, &lease.session).await
            }
            Self::SetAside(lease, damage) => {
                leases.check(lease)?;
                for part in damage {
                    set_aside(connection, &lease.session, *part).await?;
                }
                Ok(damage.len() as u64)
            }
        }
    }
}

async fn create(connection: &mut SqliteConnection, new: &NewSession) -> Result<u64, StoreError> {
    let result = sqlx::query(
        "INSERT INTO sessions (name, seed, simulation_version, created_at)
         VALUES (?, ?, ?, strftime('%Y-%m-%dT%H:%M:%fZ', 'now'))",
    )
    .bind(&new.name)
    .bind(new.seed)
    .bind(new.simulation_version)
    .execute(&mut *connection)
    .await?;
    if let Some(bytes) = &new.snapshot {
        let row = SnapshotRow {
            through: 0,
            bytes: bytes.clone(),
            checksum: Some(snapshot_sum(&new.name, 0, bytes)),
            simulation_version: new.simulation_version,
        };
        insert_snapshot(connection, &new.name, &row).await?;
    }
    Ok(result.rows_affected())
}

async fn append(
    connection: &mut SqliteConnection,
    session: &str,
    row: &JournalRow,
) -> Result<u64, StoreError> {
    let last: i64 = sqlx::query_scalar(
        "SELECT max(coalesce((SELECT last FROM journal WHERE session = ?1 ORDER BY first DESC LIMIT 1), 0),
                    coalesce((SELECT max(through) FROM snapshots WHERE session = ?1), 0))",
    )
    .bind(session)
    .fetch_one(&mut *connection)
    .await?;
    let last = last.cast_unsigned();
    if row.first != last + 1 {
        return Err(StoreError::OutOfOrder { last, found: row.first });
    }
    let result = sqlx::query(
        "INSERT INTO journal (session, first, last, entries, checksum, simulation_version)
         VALUES (?, ?, ?, ?, ?, ?)",
    )
    .bind(session)
    .bind(row.first.cast_signed())
    .bind(row.last.cast_signed())
    .bind(&row.entries)
    .bind(row.checksum)
    .bind(row.simulation_version)
    .execute(connection)
    .await?;
    Ok(result.rows_affected())
}

async fn insert_snapshot(
    connection: &mut SqliteConnection,
    session: &str,
    row: &SnapshotRow,
) -> Result<(), sqlx::Error> {
    sqlx::query(
        "INSERT OR REPLACE INTO snapshots (session, through, bytes, checksum, simulation_version)
         VALUES (?, ?, ?, ?, ?)",
    )
    .bind(session)
    .bind(row.through.cast_signed())
    .bind(&row.bytes)
    .bind(row.checksum)
    .bind(row.simulation_version)
    .execute(connection)
    .await
    .map(drop)
}

async fn drop_what_nobody_needs(connection: &mut SqliteConnection, session: &str) -> Result<u64, StoreError> {
    let kept = KEPT_SNAPSHOTS as i64;
    sqlx::query(
        "DELETE FROM snapshots WHERE session = ?1 AND through NOT IN
         (SELECT through FROM snapshots WHERE session = ?1 ORDER BY through DESC LIMIT ?2)",
    )
    .bind(session)
    .bind(kept)
    .execute(&mut *connection)
    .await?;
    let result = sqlx::query(
        "DELETE FROM journal WHERE session = ?1 AND last <=
         (SELECT min(through) FROM snapshots WHERE session = ?1 HAVING count(*) = ?2)",
    )
    .bind(session)
    .bind(kept)
    .execute(connection)
    .await?;
    Ok(result.rows_affected())
}

async fn set_aside(
    connection: &mut SqliteConnection,
    session: &str,
    part: Damage,
) -> Result<(), sqlx::Error> {
    let (copy, delete, number) = match part {
        Damage::Journal(from) => (
            "INSERT INTO set_aside (session, first, last, contents, checksum, simulation_version, set_aside_at)
             SELECT session, first, last, CAST(entries AS BLOB), checksum, simulation_version,
                    strftime('%Y-%m-%dT%H:%M:%fZ', 'now')
             FROM journal WHERE session = ?1 AND last >= ?2 ORDER BY first",
            "DELETE FROM journal WHERE session = ?1 AND last >= ?2",
            from,
        ),
        Damage::Snapshot(through) => (
            "INSERT INTO set_aside (session, last, contents, checksum, simulation_version, set_aside_at)
             SELECT session, through, bytes, checksum, simulation_version,
                    strftime('%Y-%m-%dT%H:%M:%fZ', 'now')
             FROM snapshots WHERE session = ?1 AND through = ?2",
            "DELETE FROM snapshots WHERE session = ?1 AND through = ?2",
            through,
        ),
    };
    for sql in [copy, delete] {
        sqlx::query(sql).bind(session).bind(number.cast_signed()).execute(&mut *connection).await?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::{
        super::{
            Store,
            contract::{entries, oak, with_oak},
        },
        Folder, SqliteStore,
    };
    use super::*;

    #[tokio::test]
    async fn entries_come_back_after_reopening() {
        let folder = Folder::new();
        let store = SqliteStore::open(&folder.database()).await.unwrap();
        let lease = with_oak(&store).await;
        store.append(&lease, 3, &entries(1..=3)).await.unwrap();
        store.append(&lease, 3, &entries(4..=4)).await.unwrap();
        store.close().await;
        let store = SqliteStore::open(&folder.database()).await.unwrap();
        let stored = store.load_session("oak", None).await.unwrap().unwrap();
        assert_eq!(stored.entries, entries(1..=4));
    }

    #[tokio::test]
    async fn rows_of_the_first_release_need_no_checksum() {
        let folder = Folder::new();
        let store = SqliteStore::open(&folder.database()).await.unwrap();
        let lease = with_oak(&store).await;
        store.append(&lease, 9, &entries(1..=2)).await.unwrap();
        store.sql("UPDATE journal SET checksum = NULL, simulation_version = NULL".into()).await;
        let stored = store.load_session("oak", None).await.unwrap().unwrap();
        assert_eq!((stored.entries, stored.oldest_entries), (entries(1..=2), Some(3)));
        for nonsense in ["x'ff'", "'[]'", "'[[\"browser-1\",1]]'", "'{'"] {
            store.sql(format!("UPDATE journal SET entries = CAST({nonsense} AS TEXT)")).await;
            let stored = store.load_session("oak", None).await.unwrap().unwrap();
            assert_eq!(stored.damage, [Damage::Journal(1)], "{nonsense}");
        }
    }

    #[tokio::test]
    async fn one_bad_write_spoils_no_other() {
        let folder = Folder::new();
        let store = SqliteStore::open(&folder.database()).await.unwrap();
        let lease = with_oak(&store).await;
        let nowhere = store.acquire("no such session").await.unwrap();
        let (first, second) = (entries(1..=1), entries(2..=2));
        let (good, bad, other) = tokio::join!(
            store.append(&lease, 3, &first),
            store.append(&nowhere, 3, &first),
            store.append(&lease, 3, &second),
        );
        assert!(good.is_ok() && other.is_ok());
        assert!(bad.is_err(), "the foreign key holds");
        let stored = store.load_session("oak", None).await.unwrap().unwrap();
        assert_eq!(stored.entries, entries(1..=2));
        assert!(store.create_session(oak(None)).await.is_err());
    }

    #[tokio::test]
    async fn rows_that_no_snapshot_needs_go() {
        let folder = Folder::new();
        let store = SqliteStore::open(&folder.database()).await.unwrap();
        let lease = with_oak(&store).await;
        let snapshot = |through| super::super::NewSnapshot { through, simulation_version: 3, bytes: vec![1] };
        store.append(&lease, 3, &entries(1..=4)).await.unwrap();
        store.append(&lease, 3, &entries(5..=6)).await.unwrap();
        store.keep_snapshot(&lease, snapshot(3)).await.unwrap();
        let rows =
            || sqlx::query_as("SELECT first, last FROM journal ORDER BY first").fetch_all(&store.readers);
        let kept: Vec<(i64, i64)> = rows().await.unwrap();
        assert_eq!(kept, [(1, 4), (5, 6)], "one snapshot alone drops nothing");
        store.keep_snapshot(&lease, snapshot(6)).await.unwrap();
        let kept: Vec<(i64, i64)> = rows().await.unwrap();
        assert_eq!(kept, [(1, 4), (5, 6)], "the snapshot before needs entry 4");
        store.keep_snapshot(&lease, snapshot(7)).await.unwrap();
        let kept: Vec<(i64, i64)> = rows().await.unwrap();
        assert_eq!(kept, []);
    }
}
