//! What is kept of a session: its journal and its last snapshots.

use espalier_session::JournalEntry;
use sqlx::sqlite::SqliteConnection;

use super::{Database, DatabaseError, writer::Write};

/// Snapshots kept of each session: the last one, and one before it should the last be damaged.
const KEPT_SNAPSHOTS: i64 = 2;

/// A session as it is read back.
#[derive(Debug, PartialEq, Eq)]
pub struct StoredSession {
    /// The seed of all its randomness.
    pub seed: u32,
    /// The version of the simulation its journal was made with.
    pub simulation_version: u32,
    /// The newest snapshot.
    pub snapshot: Option<Vec<u8>>,
    /// The entries after that snapshot.
    pub entries: Vec<JournalEntry>,
    /// The number of the last entry; 0 if there never was one.
    pub last: u64,
}

#[derive(Debug)]
pub(super) enum SessionWrite {
    Create { name: String, seed: u32, simulation_version: u32, snapshot: Option<Vec<u8>> },
    Journal { session: String, first: u64, last: u64, entries: String },
    Snapshot { session: String, through: u64, bytes: Vec<u8> },
}

impl Database {
    /// Makes a session, which may start from a snapshot before its first entry.
    pub async fn create_session(
        &self,
        name: String,
        seed: u32,
        simulation_version: u32,
        snapshot: Option<Vec<u8>>,
    ) -> Result<(), DatabaseError> {
        let write = SessionWrite::Create { name, seed, simulation_version, snapshot };
        self.writer.write(Write::Session(write)).await.map(drop)
    }

    /// Writes consecutive entries as one row; they are durable when this returns.
    pub async fn append_journal(
        &self,
        session: String,
        entries: &[JournalEntry],
    ) -> Result<(), DatabaseError> {
        let (Some(first), Some(last)) = (entries.first(), entries.last()) else { return Ok(()) };
        let (first, last) = (first.number, last.number);
        let entries = to_row(entries)?;
        self.writer
            .write(Write::Session(SessionWrite::Journal { session, first, last, entries }))
            .await
            .map(drop)
    }

    /// Keeps a snapshot, and drops the rows that no kept snapshot needs for its replay.
    pub async fn keep_snapshot(
        &self,
        session: String,
        through: u64,
        bytes: Vec<u8>,
    ) -> Result<(), DatabaseError> {
        self.writer.write(Write::Session(SessionWrite::Snapshot { session, through, bytes })).await.map(drop)
    }

    /// Whether there is such a session.
    pub async fn has_session(&self, name: &str) -> Result<bool, DatabaseError> {
        let found: i64 = sqlx::query_scalar("SELECT EXISTS (SELECT 1 FROM sessions WHERE name = ?)")
            .bind(name)
            .fetch_one(&self.readers)
            .await?;
        Ok(found != 0)
    }

    /// Reads a session with its newest snapshot and the entries after it.
    ///
    /// With `damaged` snapshots it starts from the one before these; nothing if there is none so old.
    pub async fn load_session(
        &self,
        name: &str,
        damaged: u32,
    ) -> Result<Option<StoredSession>, DatabaseError> {
        // One transaction sees one state: a snapshot and a deletion may come in between otherwise.
        let mut transaction = self.readers.begin().await?;
        let Some((seed, simulation_version)) =
            sqlx::query_as::<_, (u32, u32)>("SELECT seed, simulation_version FROM sessions WHERE name = ?")
                .bind(name)
                .fetch_optional(&mut *transaction)
                .await?
        else {
            return Ok(None);
        };
        let snapshot: Option<(i64, Vec<u8>)> = sqlx::query_as(
            "SELECT through, bytes FROM snapshots WHERE session = ? ORDER BY through DESC LIMIT 1 OFFSET ?",
        )
        .bind(name)
        .bind(damaged)
        .fetch_optional(&mut *transaction)
        .await?;
        // The journal alone is no way back: what came before the oldest snapshot may be gone, or a saved tree.
        if damaged > 0 && snapshot.is_none() {
            return Ok(None);
        }
        let (through, snapshot) = snapshot.map_or((0, None), |(through, bytes)| (through, Some(bytes)));
        let rows: Vec<(i64, String)> = sqlx::query_as(
            "SELECT first, entries FROM journal WHERE session = ? AND last > ? ORDER BY first",
        )
        .bind(name)
        .bind(through)
        .fetch_all(&mut *transaction)
        .await?;

        let through = through.cast_unsigned();
        let mut entries: Vec<JournalEntry> = Vec::new();
        for (first, row) in rows {
            entries.extend(
                from_row(first.cast_unsigned(), &row)?.into_iter().filter(|entry| entry.number > through),
            );
        }
        for (number, entry) in (through + 1..).zip(&entries) {
            if entry.number != number {
                return Err(DatabaseError::Damaged(format!("entry {number} of session {name} is missing")));
            }
        }
        let last = entries.last().map_or(through, |entry| entry.number);
        Ok(Some(StoredSession { seed, simulation_version, snapshot, entries, last }))
    }
}

impl SessionWrite {
    pub(super) async fn apply(&self, connection: &mut SqliteConnection) -> Result<u64, sqlx::Error> {
        match self {
            Self::Create { name, seed, simulation_version, snapshot } => {
                let result = sqlx::query(
                    "INSERT INTO sessions (name, seed, simulation_version, created_at)
                     VALUES (?, ?, ?, strftime('%Y-%m-%dT%H:%M:%fZ', 'now'))",
                )
                .bind(name)
                .bind(seed)
                .bind(simulation_version)
                .execute(&mut *connection)
                .await?;
                if let Some(bytes) = snapshot {
                    insert_snapshot(connection, name, 0, bytes).await?;
                }
                Ok(result.rows_affected())
            }
            Self::Journal { session, first, last, entries } => {
                let result =
                    sqlx::query("INSERT INTO journal (session, first, last, entries) VALUES (?, ?, ?, ?)")
                        .bind(session)
                        .bind(first.cast_signed())
                        .bind(last.cast_signed())
                        .bind(entries)
                        .execute(connection)
                        .await?;
                Ok(result.rows_affected())
            }
            Self::Snapshot { session, through, bytes } => {
                insert_snapshot(connection, session, through.cast_signed(), bytes).await?;
                sqlx::query(
                    "DELETE FROM snapshots WHERE session = ?1 AND through NOT IN
                     (SELECT through FROM snapshots WHERE session = ?1 ORDER BY through DESC LIMIT ?2)",
                )
                .bind(session)
                .bind(KEPT_SNAPSHOTS)
                .execute(&mut *connection)
                .await?;
                let result = sqlx::query(
                    "DELETE FROM journal WHERE session = ?1 AND last <=
                     (SELECT min(through) FROM snapshots WHERE session = ?1 HAVING count(*) = ?2)",
                )
                .bind(session)
                .bind(KEPT_SNAPSHOTS)
                .execute(connection)
                .await?;
                Ok(result.rows_affected())
            }
        }
    }
}

async fn insert_snapshot(
    connection: &mut SqliteConnection,
    session: &str,
    through: i64,
    bytes: &[u8],
) -> Result<(), sqlx::Error> {
    sqlx::query("INSERT OR REPLACE INTO snapshots (session, through, bytes) VALUES (?, ?, ?)")
        .bind(session)
        .bind(through)
        .bind(bytes)
        .execute(connection)
        .await
        .map(drop)
}

fn to_row(entries: &[JournalEntry]) -> Result<String, DatabaseError> {
    let row: Vec<(&str, u32, &str)> =
        entries.iter().map(|entry| (entry.client.as_str(), entry.id, entry.command.as_str())).collect();
    serde_json::to_string(&row).map_err(|error| DatabaseError::Damaged(error.to_string()))
}

fn from_row(first: u64, row: &str) -> Result<Vec<JournalEntry>, DatabaseError> {
    let row: Vec<(String, u32, String)> = serde_json::from_str(row).map_err(|error| {
        DatabaseError::Damaged(format!("the journal's row from {first} cannot be read: {error}"))
    })?;
    Ok((first..)
        .zip(row)
        .map(|(number, (client, id, command))| JournalEntry { number, client, id, command })
        .collect())
}

#[cfg(test)]
mod tests {
    use super::{super::open::tests::Folder, *};

    fn entries(numbers: std::ops::RangeInclusive<u64>) -> Vec<JournalEntry> {
        numbers
            .map(|number| JournalEntry {
                number,
                client: "finger".into(),
                id: number as u32,
                command: format!(r#"{{"kind":"grow","steps":{number}}}"#),
            })
            .collect()
    }

    async fn with_session(folder: &Folder) -> Database {
        let database = Database::open(&folder.database()).await.unwrap();
        database.create_session("oak".into(), u32::MAX, 1, None).await.unwrap();
        database
    }

    async fn journal_rows(database: &Database) -> Vec<(i64, i64)> {
        sqlx::query_as("SELECT first, last FROM journal ORDER BY first")
            .fetch_all(&database.readers)
            .await
            .unwrap()
    }

    #[tokio::test]
    async fn a_new_session_is_empty() {
        let folder = Folder::new();
        let database = with_session(&folder).await;
        let stored = database.load_session("oak", 0).await.unwrap().unwrap();
        let expected =
            StoredSession { seed: u32::MAX, simulation_version: 1, snapshot: None, entries: vec![], last: 0 };
        assert_eq!(stored, expected);
        assert!(database.has_session("oak").await.unwrap());
        assert!(!database.has_session("elm").await.unwrap());
        assert_eq!(database.load_session("elm", 0).await.unwrap(), None);
    }

    #[tokio::test]
    async fn a_name_is_given_only_once() {
        let folder = Folder::new();
        let database = with_session(&folder).await;
        assert!(database.create_session("oak".into(), 1, 1, None).await.is_err());
    }

    #[tokio::test]
    async fn entries_come_back_after_reopening() {
        let folder = Folder::new();
        let database = with_session(&folder).await;
        database.append_journal("oak".into(), &entries(1..=3)).await.unwrap();
        database.append_journal("oak".into(), &entries(4..=4)).await.unwrap();
        database.append_journal("oak".into(), &[]).await.unwrap();
        assert_eq!(journal_rows(&database).await, [(1, 3), (4, 4)]);
        database.close().await;
        let database = Database::open(&folder.database()).await.unwrap();
        assert_eq!(database.load_session("oak", 0).await.unwrap().unwrap().entries, entries(1..=4));
    }

    #[tokio::test]
    async fn a_snapshot_shortens_the_replay() {
        let folder = Folder::new();
        let database = with_session(&folder).await;
        database.append_journal("oak".into(), &entries(1..=4)).await.unwrap();
        database.append_journal("oak".into(), &entries(5..=6)).await.unwrap();
        database.keep_snapshot("oak".into(), 3, b"three".to_vec()).await.unwrap();
        let stored = database.load_session("oak", 0).await.unwrap().unwrap();
        assert_eq!(stored.snapshot.as_deref(), Some(b"three".as_slice()));
        assert_eq!(stored.entries, entries(4..=6));
        assert_eq!(journal_rows(&database).await, [(1, 4), (5, 6)], "one snapshot alone drops nothing");
    }

    #[tokio::test]
    async fn two_snapshots_and_their_journal_are_kept() {
        let folder = Folder::new();
        let database = with_session(&folder).await;
        for numbers in [1..=2, 3..=4, 5..=6] {
            let through = *numbers.end();
            database.append_journal("oak".into(), &entries(numbers)).await.unwrap();
            database.keep_snapshot("oak".into(), through, vec![through as u8]).await.unwrap();
        }
        let kept: Vec<i64> = sqlx::query_scalar("SELECT through FROM snapshots ORDER BY through")
            .fetch_all(&database.readers)
            .await
            .unwrap();
        assert_eq!(kept, [4, 6]);
        assert_eq!(journal_rows(&database).await, [(5, 6)]);
        let stored = database.load_session("oak", 0).await.unwrap().unwrap();
        assert_eq!((stored.snapshot, stored.entries, stored.last), (Some(vec![6]), vec![], 6));
        let older = database.load_session("oak", 1).await.unwrap().unwrap();
        assert_eq!((older.snapshot, older.entries, older.last), (Some(vec![4]), entries(5..=6), 6));
        assert_eq!(database.load_session("oak", 2).await.unwrap(), None);
    }

    #[tokio::test]
    async fn a_session_may_start_from_a_snapshot() {
        let folder = Folder::new();
        let database = Database::open(&folder.database()).await.unwrap();
        database.create_session("elm".into(), 7, 1, Some(b"tree".to_vec())).await.unwrap();
        database.append_journal("elm".into(), &entries(1..=1)).await.unwrap();
        let stored = database.load_session("elm", 0).await.unwrap().unwrap();
        assert_eq!((stored.snapshot, stored.entries), (Some(b"tree".to_vec()), entries(1..=1)));
    }

    #[tokio::test]
    async fn a_gap_in_the_journal_is_noticed() {
        let folder = Folder::new();
        let database = with_session(&folder).await;
        database.append_journal("oak".into(), &entries(2..=3)).await.unwrap();
        let error = database.load_session("oak", 0).await.unwrap_err();
        assert!(matches!(error, DatabaseError::Damaged(_)), "{error}");
    }

    #[tokio::test]
    async fn one_bad_write_spoils_no_other() {
        let folder = Folder::new();
        let database = with_session(&folder).await;
        let (good, bad, other) = (entries(1..=1), entries(1..=1), entries(2..=2));
        let (good, bad, other) = tokio::join!(
            database.append_journal("oak".into(), &good),
            database.append_journal("no such session".into(), &bad),
            database.append_journal("oak".into(), &other),
        );
        assert!(good.is_ok() && other.is_ok());
        assert!(bad.is_err(), "the foreign key holds");
        assert_eq!(database.load_session("oak", 0).await.unwrap().unwrap().entries, entries(1..=2));
    }

    #[tokio::test]
    async fn an_entry_is_written_only_once() {
        let folder = Folder::new();
        let database = with_session(&folder).await;
        database.append_journal("oak".into(), &entries(1..=2)).await.unwrap();
        assert!(database.append_journal("oak".into(), &entries(1..=1)).await.is_err());
    }
}
