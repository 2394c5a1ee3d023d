//! The list of events in SQLite.

use sqlx::sqlite::SqliteConnection;

use super::{
    super::{Audit, Event, MOST_EVENTS, Noted, StoreError, audit::MOST_REFUSED},
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

    async fn events(&self, limit: u32, before: Option<u64>) -> Result<Vec<Noted>, StoreError> {
        let before = before.and_then(|before| i64::try_from(before).ok()).unwrap_or(i64::MAX);
        let found = sqlx::query_as(
            "SELECT id, at, who, address, action, object, outcome, times, last_at FROM audit
             WHERE id < ? ORDER BY id DESC LIMIT ?",
        );
        let found: Vec<Row> = found.bind(before).bind(limit).fetch_all(&self.readers).await?;
        Ok(found.into_iter().map(read).collect())
    }

    async fn purge_events(&self, before: &str) -> Result<(), StoreError> {
        self.writer.write(Write::Audit(AuditWrite::Purge(before.to_owned()))).await.map(drop)
    }
}

/// Number, time, who, address, action, object, outcome, how often, and when last.
type Row = (i64, String, String, Option<String>, String, Option<String>, String, u32, Option<String>);

fn read((id, at, who, address, action, object, outcome, times, last_at): Row) -> Noted {
    let event = Event { at, who, address, action, object, outcome };
    Noted { number: id.unsigned_abs(), event, times, last_at }
}

/// Counts an event that comes again; whether it was counted.
async fn count(event: &Event, connection: &mut SqliteConnection) -> Result<bool, StoreError> {
    let Event { at, who, address, action, object, outcome } = event;
    let alike = sqlx::query_as(
        "SELECT id, address IS ?5 AND object IS ?6 FROM audit
         WHERE who = ?1 AND action = ?2 AND outcome = ?3 AND at >= ?4 ORDER BY id DESC",
    );
    let alike = alike.bind(who).bind(action).bind(outcome).bind(event.counted_since());
    let alike: Vec<(i64, bool)> = alike.bind(address).bind(object).fetch_all(&mut *connection).await?;
    let equal = alike.iter().find(|(_, is_equal)| *is_equal);
    let last = alike.first().filter(|_| event.is_refused() && alike.len() >= MOST_REFUSED as usize);
    let Some((id, _)) = equal.or(last) else { return Ok(false) };
    let counted = sqlx::query("UPDATE audit SET times = times + 1, last_at = ? WHERE id = ?");
    counted.bind(at).bind(id).execute(connection).await?;
    Ok(true)
}

impl AuditWrite {
    pub(super) async fn apply(&self, connection: &mut SqliteConnection) -> Result<u64, StoreError> {
        match self {
            Self::Note(event) => {
                if event.may_repeat() && count(event, connection).await? {
                    return Ok(1);
                }
                let Event { at, who, address, action, object, outcome } = event;
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
                let gone = sqlx::query("DELETE FROM audit WHERE coalesce(last_at, at) < ?").bind(before);
                Ok(gone.execute(connection).await?.rows_affected())
            }
        }
    }
}
