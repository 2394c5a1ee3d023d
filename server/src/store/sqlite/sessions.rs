//! Sessions in SQLite.

use espalier_proto::Notice;
use sqlx::Row as _;
use sqlx::{
    SqlitePool,
    sqlite::{SqliteConnection, SqliteRow},
};

use super::super::{
    Damage, KEPT_SNAPSHOTS, Lease, NewSession, StoreError, StoredSession,
    lease::Leases,
    seal::{Found, JournalRow, SessionRow, SnapshotRow},
};
use super::{
    parts::{self, Manifest},
    visits,
};

#[derive(Debug)]
pub(super) enum SessionWrite {
    Create(NewSession, Option<(SnapshotRow, Manifest)>),
    Append(Lease, JournalRow),
    /// With the living metamers in it.
    Snapshot(Lease, SnapshotRow, Manifest, u32),
    SetAside(Lease, Vec<Damage>, Vec<Notice>),
    ForgetNotices(Lease),
    Enter(String),
    /// Answers with how often the session was tried to be opened.
    CountTry(Lease),
    ForgetTries(Lease),
    Purge {
        saved: String,
        unsaved: String,
        limit: u32,
    },
}

impl SessionWrite {
    /// Whether less is kept afterwards.
    pub(super) const fn frees(&self) -> bool {
        matches!(self, Self::Purge { .. })
    }
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
    let Some(row) = session_row(&mut transaction, name).await? else { return Ok(None) };
    let made_by = row.simulation_version;
    let mut passed_over = Vec::new();
    let mut earlier = before;
    let snapshot = loop {
        let Some(row) = newest_snapshot(&mut transaction, name, earlier, made_by).await? else { break None };
        if row.is_whole(name) {
            break Some(row);
        }
        passed_over.push(Damage::Snapshot(row.through));
        earlier = Some(row.through);
    };
    let through = snapshot.as_ref().map_or(0, |row| row.through);
    let rows = journal_rows(&mut transaction, name, through.saturating_add(1), made_by).await?;
    Found { row, passed_over, snapshot, rows }.assemble(name, before).map(Some)
}

async fn session_row(
    connection: &mut SqliteConnection,
    name: &str,
) -> Result<Option<SessionRow>, sqlx::Error> {
    let row = sqlx::query(
        "SELECT seed, simulation_version, last_entry, last_snapshot, notices, written_by, checksum
         FROM sessions WHERE name = ?",
    )
    .bind(name)
    .fetch_optional(connection)
    .await?;
    let Some(row) = row else { return Ok(None) };
    Ok(Some(SessionRow {
        seed: row.try_get("seed")?,
        simulation_version: row.try_get("simulation_version")?,
        last_entry: row.try_get::<i64, _>("last_entry")?.cast_unsigned(),
        last_snapshot: row.try_get::<Option<i64>, _>("last_snapshot")?.map(i64::cast_unsigned),
        notices: row.try_get("notices")?,
        written_by: row.try_get("written_by")?,
        checksum: row.try_get("checksum")?,
    }))
}

/// The rows that hold an entry or one after it.
async fn journal_rows(
    connection: &mut SqliteConnection,
    session: &str,
    from: u64,
    made_by: u32,
) -> Result<Vec<JournalRow>, sqlx::Error> {
    let rows = sqlx::query(
        "SELECT first, last, entries, checksum, coalesce(simulation_version, ?3) AS version
         FROM journal WHERE session = ?1 AND last >= ?2 ORDER BY first",
    )
    .bind(session)
    .bind(from.cast_signed())
    .bind(made_by)
    .fetch_all(connection)
    .await?;
    rows.iter().map(journal_row).collect()
}

async fn newest_snapshot(
    connection: &mut SqliteConnection,
    session: &str,
    before: Option<u64>,
    made_by: u32,
) -> Result<Option<SnapshotRow>, StoreError> {
    let row = sqlx::query(
        "SELECT through, bytes, document, checksum, coalesce(simulation_version, ?3) AS version FROM snapshots
         WHERE session = ?1 AND (?2 IS NULL OR through < ?2) ORDER BY through DESC LIMIT 1",
    )
    .bind(session)
    .bind(before.map(u64::cast_signed))
    .bind(made_by)
    .fetch_optional(&mut *connection)
    .await?;
    let Some(row) = row else { return Ok(None) };
    Ok(Some(SnapshotRow {
        through: row.try_get::<i64, _>("through")?.cast_unsigned(),
        bytes: parts::contents(connection, row.try_get("bytes")?, row.try_get("document")?).await?,
        checksum: row.try_get("checksum")?,
        simulation_version: row.try_get("version")?,
    }))
}

fn journal_row(row: &SqliteRow) -> Result<JournalRow, sqlx::Error> {
    // As bytes: entries that are no text any more are damage, which the checksum reports.
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
        let (lease, change) = match self {
            Self::Create(new, snapshot) => return create(connection, new, snapshot.as_ref()).await,
            Self::Enter(name) => return enter(connection, name).await,
            Self::CountTry(lease) => {
                leases.check(lease)?;
                return count_try(connection, &lease.session).await;
            }
            Self::ForgetTries(lease) => {
                leases.check(lease)?;
                let sql = "UPDATE sessions SET tries = 0 WHERE name = ?";
                return Ok(sqlx::query(sql).bind(&*lease.session).execute(connection).await?.rows_affected());
            }
            Self::Purge { saved, unsaved, limit } => {
                return purge(connection, leases, [saved, unsaved], *limit).await;
            }
            Self::Append(lease, row) => (lease, Change::Append(row)),
            Self::Snapshot(lease, row, manifest, metamers) => {
                (lease, Change::Snapshot(row, manifest, *metamers))
            }
            Self::SetAside(lease, damage, notices) => (lease, Change::SetAside(damage, notices)),
            Self::ForgetNotices(lease) => (lease, Change::ForgetNotices),
        };
        leases.check(lease)?;
        let name = &*lease.session;
        let Some(mut session) = session_row(connection, name).await? else {
            return Err(StoreError::Damaged("there is no such session".into()));
        };
        let is_mending = matches!(change, Change::SetAside(..));
        if !is_mending && !session.is_whole(name) {
            return Err(StoreError::Damaged(format!("the row of session {name} is damaged")));
        }
        change.apply(connection, name, &mut session).await?;
        update(connection, name, &session.sealed(name)).await
    }
}

/// A change to a session that there is.
enum Change<'a> {
    Append(&'a JournalRow),
    Snapshot(&'a SnapshotRow, &'a Manifest, u32),
    SetAside(&'a [Damage], &'a [Notice]),
    ForgetNotices,
}

impl Change<'_> {
    async fn apply(
        self,
        connection: &mut SqliteConnection,
        name: &str,
        session: &mut SessionRow,
    ) -> Result<(), StoreError> {
        match self {
            Self::Append(row) => {
                let last = session.last_entry;
                if row.first != last + 1 {
                    return Err(StoreError::OutOfOrder { last, found: row.first });
                }
                insert_journal(connection, name, row).await?;
                session.last_entry = row.last;
            }
            Self::Snapshot(row, manifest, metamers) => {
                // The count is not sealed: it is for lists alone.
                let sql = "UPDATE sessions SET metamers = ? WHERE name = ?";
                sqlx::query(sql).bind(metamers).bind(name).execute(&mut *connection).await?;
                insert_snapshot(connection, name, row, manifest).await?;
                drop_what_nobody_needs(connection, name).await?;
                session.last_snapshot = session.last_snapshot.max(Some(row.through));
                session.last_entry = session.last_entry.max(row.through);
            }
            Self::SetAside(damage, notices) => {
                for part in damage {
                    set_aside(connection, name, *part, session).await?;
                }
                let newest: Option<i64> =
                    sqlx::query_scalar("SELECT max(through) FROM snapshots WHERE session = ?")
                        .bind(name)
                        .fetch_one(connection)
                        .await?;
                session.last_snapshot = newest.map(i64::cast_unsigned);
                session.keep_notices(notices);
            }
            Self::ForgetNotices => session.notices = None,
        }
        Ok(())
    }
}

async fn create(
    connection: &mut SqliteConnection,
    new: &NewSession,
    snapshot: Option<&(SnapshotRow, Manifest)>,
) -> Result<u64, StoreError> {
    sqlx::query(
        "INSERT INTO sessions (name, seed, simulation_version, created_at, principal, metamers)
         VALUES (?, ?, ?, strftime('%Y-%m-%dT%H:%M:%fZ', 'now'), ?, ?)",
    )
    .bind(&new.name)
    .bind(new.seed)
    .bind(new.simulation_version)
    .bind(&new.principal)
    .bind(new.metamers)
    .execute(&mut *connection)
    .await?;
    if let Some(person) = &new.person {
        visits::add(connection, &new.name, person).await?;
    }
    if let Some((tree, version)) = &new.tree {
        const OF_TREE: &str = "UPDATE sessions SET (tree, tree_version) = (SELECT id, ?2 FROM trees WHERE key = ?1) WHERE name = ?3";
        const OPENED: &str = "UPDATE trees SET session = ?3 WHERE key = ?1 AND head = ?2";
        // Opening the tree leads into it, unless that leads to people already.
        let opened = (!new.is_beside).then_some(OPENED);
        for sql in [OF_TREE].into_iter().chain(opened) {
            sqlx::query(sql).bind(tree).bind(version).bind(&new.name).execute(&mut *connection).await?;
        }
    }
    if let Some((row, manifest)) = snapshot {
        insert_snapshot(connection, &new.name, row, manifest).await?;
    }
    update(connection, &new.name, &SessionRow::new(new, snapshot.is_some())).await
}

async fn enter(connection: &mut SqliteConnection, name: &str) -> Result<u64, StoreError> {
    let sql = "UPDATE sessions SET entered_at = strftime('%Y-%m-%dT%H:%M:%fZ', 'now') WHERE name = ?";
    Ok(sqlx::query(sql).bind(name).execute(connection).await?.rows_affected())
}

async fn count_try(connection: &mut SqliteConnection, name: &str) -> Result<u64, StoreError> {
    // The count is not sealed: what is wrong with it costs a click at most.
    let sql = "UPDATE sessions SET tries = max(0, min(tries, 1000)) + 1 WHERE name = ? RETURNING tries";
    let tries: Option<i64> = sqlx::query_scalar(sql).bind(name).fetch_optional(connection).await?;
    Ok(tries.map_or(0, i64::cast_unsigned))
}

/// What a version holds is saved, and so is a seedling to which nothing was done.
async fn purge(
    connection: &mut SqliteConnection,
    leases: &Leases,
    [saved, unsaved]: [&str; 2],
    limit: u32,
) -> Result<u64, StoreError> {
    let names: Vec<String> = sqlx::query_scalar(
        "SELECT name FROM sessions WHERE entered_at < max(?1, ?2) AND entered_at < iif(
             last_entry <= saved_through AND (tree IS NOT NULL OR last_entry = 0 AND last_snapshot IS NULL), ?1, ?2)
         ORDER BY entered_at",
    )
    .bind(saved)
    .bind(unsaved)
    .fetch_all(&mut *connection)
    .await?;
    let mut gone = 0;
    for name in names.iter().filter(|name| !leases.is_held(name)).take(limit as usize) {
        gone += sqlx::query("DELETE FROM sessions WHERE name = ?")
            .bind(name)
            .execute(&mut *connection)
            .await?
            .rows_affected();
    }
    Ok(gone)
}

/// Writes what changes of a session's row.
async fn update(connection: &mut SqliteConnection, name: &str, row: &SessionRow) -> Result<u64, StoreError> {
    let result = sqlx::query(
        "UPDATE sessions SET last_entry = ?, last_snapshot = ?, notices = ?, written_by = ?, checksum = ?,
                             entered_at = strftime('%Y-%m-%dT%H:%M:%fZ', 'now')
         WHERE name = ?",
    )
    .bind(row.last_entry.cast_signed())
    .bind(row.last_snapshot.map(u64::cast_signed))
    .bind(&row.notices)
    .bind(&row.written_by)
    .bind(row.checksum)
    .bind(name)
    .execute(connection)
    .await?;
    Ok(result.rows_affected())
}

async fn insert_journal(
    connection: &mut SqliteConnection,
    session: &str,
    row: &JournalRow,
) -> Result<(), sqlx::Error> {
    sqlx::query(
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
    .await
    .map(drop)
}

async fn insert_snapshot(
    connection: &mut SqliteConnection,
    session: &str,
    row: &SnapshotRow,
    manifest: &Manifest,
) -> Result<(), StoreError> {
    let (document, _) = parts::write_document(connection, manifest).await?;
    sqlx::query(
        "INSERT OR REPLACE INTO snapshots (session, through, bytes, document, checksum, simulation_version)
         VALUES (?, ?, x'', ?, ?, ?)",
    )
    .bind(session)
    .bind(row.through.cast_signed())
    .bind(document)
    .bind(row.checksum)
    .bind(row.simulation_version)
    .execute(connection)
    .await?;
    Ok(())
}

async fn drop_what_nobody_needs(connection: &mut SqliteConnection, session: &str) -> Result<(), sqlx::Error> {
    let kept = KEPT_SNAPSHOTS as i64;
    sqlx::query(
        "DELETE FROM snapshots WHERE session = ?1 AND through NOT IN
         (SELECT through FROM snapshots WHERE session = ?1 ORDER BY through DESC LIMIT ?2)",
    )
    .bind(session)
    .bind(kept)
    .execute(&mut *connection)
    .await?;
    sqlx::query(
        "DELETE FROM journal WHERE session = ?1 AND last <=
         (SELECT min(through) FROM snapshots WHERE session = ?1 HAVING count(*) = ?2)",
    )
    .bind(session)
    .bind(kept)
    .execute(connection)
    .await
    .map(drop)
}

async fn set_aside(
    connection: &mut SqliteConnection,
    session: &str,
    part: Damage,
    row: &mut SessionRow,
) -> Result<(), sqlx::Error> {
    // A row may be whole before the entry that is damaged.
    let mut whole = Vec::new();
    if let Damage::Journal(from) = part {
        let rows = journal_rows(connection, session, from, row.simulation_version).await?;
        whole.extend(rows.iter().filter_map(|row| row.before(session, from)));
        row.last_entry = from - 1;
    }
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
            "INSERT INTO set_aside (session, last, contents, document, checksum, simulation_version, set_aside_at)
             SELECT session, through, bytes, document, checksum, simulation_version,
                    strftime('%Y-%m-%dT%H:%M:%fZ', 'now')
             FROM snapshots WHERE session = ?1 AND through = ?2",
            "DELETE FROM snapshots WHERE session = ?1 AND through = ?2",
            through,
        ),
    };
    for sql in [copy, delete] {
        sqlx::query(sql).bind(session).bind(number.cast_signed()).execute(&mut *connection).await?;
    }
    for row in &whole {
        insert_journal(connection, session, row).await?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

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
        assert_eq!((stored.entries, stored.simulations), (entries(1..=2), BTreeSet::from([3])));
        for nonsense in ["x'ff'", "'[]'", "'[[\"browser-1\",1]]'", "'{'"] {
            store.sql(format!("UPDATE journal SET entries = CAST({nonsense} AS TEXT)")).await;
            let stored = store.load_session("oak", None).await.unwrap().unwrap();
            assert_eq!(stored.damage, [Damage::Journal(1)], "{nonsense}");
        }
    }

    #[tokio::test]
    async fn op4_an_unsealed_row_is_read_up_to_what_is_no_command() {
        let folder = Folder::new();
        let store = SqliteStore::open(&folder.database()).await.unwrap();
        let lease = with_oak(&store).await;
        store.append(&lease, 3, &entries(1..=3)).await.unwrap();
        store.append(&lease, 3, &entries(4..=4)).await.unwrap();
        let spoil = "UPDATE journal SET entries = replace(entries, '\"steps\\\":2', '\"steps\\\":x')";
        store.sql(format!("{spoil}, checksum = NULL")).await;
        let stored = store.load_session("oak", None).await.unwrap().unwrap();
        assert_eq!((&stored.entries, &stored.damage), (&entries(1..=1), &vec![Damage::Journal(2)]));
        store.set_aside(&lease, &stored.damage, &[]).await.unwrap();
        let stored = store.load_session("oak", None).await.unwrap().unwrap();
        assert_eq!((stored.entries, stored.damage), (entries(1..=1), vec![]), "what is whole stays");
        store.append(&lease, 3, &entries(2..=2)).await.unwrap();
    }

    #[tokio::test]
    async fn op1_a_sealed_row_in_another_form_is_a_newer_programs() {
        let folder = Folder::new();
        let store = SqliteStore::open(&folder.database()).await.unwrap();
        let lease = with_oak(&store).await;
        let mut row = JournalRow::seal("oak", 3, &entries(1..=2)).unwrap();
        row.entries = r#"{"later":[]}"#.into();
        let sealed = row.with_sum("oak");
        let write = SessionWrite::Append(lease, sealed);
        store.writer.write(super::super::Write::Session(write)).await.unwrap();
        let refused = store.load_session("oak", None).await;
        assert!(matches!(refused, Err(StoreError::Later(_))), "{refused:?}");
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
        let snapshot = |through| super::super::NewSnapshot {
            through,
            simulation_version: 3,
            bytes: vec![1],
            metamers: 1,
        };
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
