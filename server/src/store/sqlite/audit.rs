//! The list of events in SQLite.

use sqlx::sqlite::SqliteConnection;

use super::{
    super::{Audit, Event, MOST_EVENTS, StoreError},
    SqliteStore,
    writer::Write,
};

#[derive(Debug)]
pub(super) enum AuditWrite {
    Note(Event),
    Purge(String),
}

impl Audit for SqliteStore {
    async fn note(&self, event: Event) -> Result<(), StoreError> {
        self.writer.write(Write::Audit(AuditWrite::Note(event))).await.map(drop)
    }

    async fn events(&self, limit: u32, before: Option<u64>) -> Result<Vec<(u64, Event)>, StoreError> {
        let before = before.and_then(|before| i64::try_from(before).ok()).unwrap_or(i64::MAX);
        let found = sqlx::query_as(
            "SELECT id, at, who, address, action, object, outcome FROM audit WHERE id < ? ORDER BY id DESC LIMIT ?",
        );
        let found: Vec<Row> = found.bind(before).bind(limit).fetch_all(&self.readers).await?;
        Ok(found.into_iter().map(read).collect())
    }

    async fn purge_events(&self, before: &str) -> Result<(), StoreError> {
        self.writer.write(Write::Audit(AuditWrite::Purge(before.to_owned()))).await.map(drop)
    }
}

/// Number, time, who, address, action, object and outcome.
type Row = (i64, String, String, Option<String>, String, Option<String>, String);

fn read((id, at, who, address, action, object, outcome): Row) -> (u64, Event) {
    (id.unsigned_abs(), Event { at, who, address, action, object, outcome })
}

impl AuditWrite {
    pub(super) async fn apply(&self, connection: &mut SqliteConnection) -> Result<u64, StoreError> {
        match self {
            Self::Note(Event { at, who, address, action, object, outcome }) => {
                let added = sqlx::query(
                    "INSERT INTO audit (at, who, address, action, object, outcome) VALUES (?, ?, ?, ?, ?, ?)",
                );
                let added = added.bind(at).bind(who).bind(address).bind(action).bind(object).bind(outcome);
                let number = added.execute(&mut *connection).await?.last_insert_rowid();
                let forgotten = sqlx::query("DELETE FROM audit WHERE id <= ?");
                let forgotten = forgotten.bind(number - MOST_EVENTS as i64);
                Ok(forgotten.execute(connection).await?.rows_affected())
            }
            Self::Purge(before) => {
                let gone = sqlx::query("DELETE FROM audit WHERE at < ?").bind(before);
                Ok(gone.execute(connection).await?.rows_affected())
            }
        }
    }
}
