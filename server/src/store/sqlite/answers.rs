//! Answers to requests with keys, in SQLite.

use sqlx::sqlite::SqliteConnection;

use super::{
    super::{Answer, AnswerKey, Answering, Answers, MostAnswers, StoreError},
    SqliteStore,
    writer::Write,
};

#[derive(Debug)]
pub(super) enum AnswerWrite {
    Begin { key: AnswerKey, at: String, since: String, most: MostAnswers },
    Keep(AnswerKey, Answer),
    Forget(AnswerKey),
    Purge(String),
}

impl Answers for SqliteStore {
    async fn begin_answer(
        &self,
        key: AnswerKey,
        at: &str,
        since: &str,
        most: MostAnswers,
    ) -> Result<bool, StoreError> {
        let write = AnswerWrite::Begin { key, at: at.to_owned(), since: since.to_owned(), most };
        Ok(self.writer.write(Write::Answer(write)).await? > 0)
    }

    async fn answer(&self, key: AnswerKey) -> Result<Option<Answering>, StoreError> {
        let found = sqlx::query_as("SELECT request, status, headers, body FROM answers WHERE key = ?");
        found.bind(key.key.to_vec()).fetch_optional(&self.readers).await?.map(read).transpose()
    }

    async fn keep_answer(&self, key: AnswerKey, answer: Answer) -> Result<(), StoreError> {
        self.writer.write(Write::Answer(AnswerWrite::Keep(key, answer))).await.map(drop)
    }

    async fn forget_answer(&self, key: AnswerKey) -> Result<(), StoreError> {
        self.writer.write(Write::Answer(AnswerWrite::Forget(key))).await.map(drop)
    }

    async fn purge_answers(&self, before: &str) -> Result<(), StoreError> {
        self.writer.write(Write::Answer(AnswerWrite::Purge(before.to_owned()))).await.map(drop)
    }
}

/// Hash of the request, status, headers as JSON, and body.
type Row = (Option<Vec<u8>>, Option<u16>, Option<String>, Option<Vec<u8>>);

fn read(row: Row) -> Result<Answering, StoreError> {
    let (Some(request), Some(status), Some(headers), Some(body)) = row else {
        return Ok(Answering::UnderWay);
    };
    let damaged = || StoreError::Damaged("an answer that was kept is damaged".into());
    let request = request.try_into().map_err(|_| damaged())?;
    let headers = serde_json::from_str(&headers).map_err(|_| damaged())?;
    Ok(Answering::Answered(Answer { request, status, headers, body }))
}

impl AnswerWrite {
    pub(super) async fn apply(&self, connection: &mut SqliteConnection) -> Result<u64, StoreError> {
        match self {
            Self::Begin { key, at, since, most } => {
                let old = sqlx::query("DELETE FROM answers WHERE key = ? AND at < ?");
                old.bind(key.key.to_vec()).bind(since).execute(&mut *connection).await?;
                let begun = sqlx::query(
                    "INSERT INTO answers (caller, key, at) VALUES (?, ?, ?) ON CONFLICT (key) DO NOTHING",
                );
                let begun = begun.bind(key.caller.to_vec()).bind(key.key.to_vec()).bind(at);
                let begun = begun.execute(&mut *connection).await?;
                if begun.rows_affected() == 0 {
                    return Ok(0);
                }
                let forgotten = sqlx::query(
                    "DELETE FROM answers WHERE id <= ?1 OR caller = ?2 AND id <=
                     (SELECT id FROM answers WHERE caller = ?2 ORDER BY id DESC LIMIT 1 OFFSET ?3)",
                );
                let oldest = begun.last_insert_rowid() - most.of_all as i64;
                let forgotten = forgotten.bind(oldest).bind(key.caller.to_vec()).bind(most.of_one as i64);
                forgotten.execute(connection).await?;
                Ok(1)
            }
            Self::Keep(AnswerKey { key, .. }, Answer { request, status, headers, body }) => {
                // Plain texts always have a JSON form.
                let headers = serde_json::to_string(headers).unwrap_or_default();
                let kept = sqlx::query(
                    "UPDATE answers SET request = ?, status = ?, headers = ?, body = ? WHERE key = ?",
                );
                let kept = kept.bind(request.to_vec()).bind(status).bind(headers).bind(body);
                Ok(kept.bind(key.to_vec()).execute(connection).await?.rows_affected())
            }
            Self::Forget(AnswerKey { key, .. }) => {
                let gone = sqlx::query("DELETE FROM answers WHERE key = ?").bind(key.to_vec());
                Ok(gone.execute(connection).await?.rows_affected())
            }
            Self::Purge(before) => {
                let gone = sqlx::query("DELETE FROM answers WHERE at < ?").bind(before);
                Ok(gone.execute(connection).await?.rows_affected())
            }
        }
    }
}
