//! Who has been in which session, in SQLite.

use sqlx::{
    Row as _, SqlitePool,
    sqlite::{SqliteConnection, SqliteRow},
};

use super::{
    super::{LineTree, SessionLine, SessionQuery, StoreError, Visits},
    SqliteStore,
    gifts::trees_seen,
    writer::Write,
};

#[derive(Debug)]
pub(super) enum VisitWrite {
    /// A session, and who is in it.
    Visit(String, String),
    /// A session, and off whose list it goes.
    Forget(String, Option<String>),
}

impl Visits for SqliteStore {
    async fn visit(&self, session: &str, person: &str) -> Result<(), StoreError> {
        let is_known: i64 = sqlx::query_scalar(
            "SELECT EXISTS (SELECT 1 FROM sessions JOIN session_people ON session = name
                            WHERE name = ?1 AND person = ?2 AND forgotten = 0)",
        )
        .bind(session)
        .bind(person)
        .fetch_one(&self.readers)
        .await?;
        if is_known != 0 {
            return Ok(());
        }
        self.writer.write(Write::Visit(VisitWrite::Visit(session.into(), person.into()))).await.map(drop)
    }

    async fn sessions(&self, query: &SessionQuery) -> Result<Vec<SessionLine>, StoreError> {
        list(&self.readers, query).await
    }

    async fn forget_session(&self, session: &str, person: Option<&str>) -> Result<bool, StoreError> {
        let write = VisitWrite::Forget(session.into(), person.map(str::to_owned));
        Ok(self.writer.write(Write::Visit(write)).await? > 0)
    }
}

/// Some sessions, in order.
pub(super) async fn list(readers: &SqlitePool, query: &SessionQuery) -> Result<Vec<SessionLine>, StoreError> {
    let rows = sqlx::query(concat!(
        "SELECT sessions.name, entered_at, sessions.metamers, tree_version, key, trees.name AS tree_name,
                last_entry <= saved_through AND (tree IS NOT NULL OR last_entry = 0) AS is_saved
         FROM sessions LEFT JOIN trees ON trees.id = tree
         WHERE forgotten = 0
           AND (?1 IS NULL OR EXISTS (SELECT 1 FROM session_people
                                      WHERE session_people.session = sessions.name AND person = ?1))
           AND (?2 IS NULL OR key = ?2)
           AND (?3 IS NULL OR (last_entry <= saved_through AND (tree IS NOT NULL OR last_entry = 0)) = ?3)
           AND (?4 IS NULL OR (entered_at, sessions.name) < (?4, ?5))
           AND (?7 IS NULL OR sessions.tree IN ",
        trees_seen!("substr(?7, 7)"),
        ") ORDER BY entered_at DESC, sessions.name DESC LIMIT ?6",
    ))
    .bind(&query.person)
    .bind(&query.tree)
    .bind(query.is_saved)
    .bind(query.after.as_ref().map(|place| &place.used_at))
    .bind(query.after.as_ref().map(|place| &place.name))
    .bind(query.limit)
    .bind(&query.seen_by)
    .fetch_all(readers)
    .await?;
    rows.iter().map(|row| line(row).map_err(StoreError::from)).collect()
}

fn line(row: &SqliteRow) -> Result<SessionLine, sqlx::Error> {
    let tree = match row.try_get::<Option<String>, _>("key")? {
        None => None,
        Some(id) => {
            // A session that a tree lies in knows since when; those of the first release know no version.
            let version = row.try_get::<Option<u32>, _>("tree_version")?.unwrap_or(1);
            Some(LineTree { id, name: row.try_get("tree_name")?, version })
        }
    };
    Ok(SessionLine {
        name: row.try_get("name")?,
        tree,
        is_saved: row.try_get("is_saved")?,
        metamers: row.try_get("metamers")?,
        used_at: row.try_get("entered_at")?,
    })
}

impl VisitWrite {
    pub(super) async fn apply(&self, connection: &mut SqliteConnection) -> Result<u64, StoreError> {
        match self {
            Self::Visit(session, person) => {
                add(connection, session, person).await?;
                let sql = "UPDATE sessions SET forgotten = 0 WHERE name = ? AND forgotten <> 0";
                Ok(sqlx::query(sql).bind(session).execute(connection).await?.rows_affected())
            }
            Self::Forget(session, None) => {
                let sql = "UPDATE sessions SET forgotten = 1 WHERE name = ? AND forgotten = 0";
                Ok(sqlx::query(sql).bind(session).execute(connection).await?.rows_affected())
            }
            Self::Forget(session, Some(person)) => {
                let sql = "DELETE FROM session_people WHERE session = ? AND person = ?";
                let write = sqlx::query(sql).bind(session).bind(person);
                Ok(write.execute(connection).await?.rows_affected())
            }
        }
    }
}

/// Somebody has been in a session that there is.
pub(super) async fn add(
    connection: &mut SqliteConnection,
    session: &str,
    person: &str,
) -> Result<(), sqlx::Error> {
    sqlx::query(
        "INSERT OR IGNORE INTO session_people (session, person) SELECT name, ?2 FROM sessions WHERE name = ?1",
    )
    .bind(session)
    .bind(person)
    .execute(connection)
    .await
    .map(drop)
}
