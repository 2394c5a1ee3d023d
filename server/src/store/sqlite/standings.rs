//! How people stand with trees, in SQLite.

use sqlx::sqlite::SqliteConnection;

use super::{
    super::{Heir, Removal, Removed, Room, Standing, Standings, StoreError},
    SqliteStore,
    writer::Write,
};

/// Changes how somebody stands with a tree.
#[derive(Debug)]
pub(super) enum StandingWrite {
    /// At a time.
    KeepOut(Removal, String),
    LetBack(String),
    /// The tree, to whom, and by whom.
    HandOver(String, Option<Heir>, Option<String>),
}

/// Identifier, room, person, name, by whom, until when, whether the link is revoked.
type RemovalRow = (String, String, String, String, String, String, bool);

/// By whom the tree is locked, whether it was handed over to them, whether it is deleted, by whom they were removed, whether
/// their link is revoked.
type StandingRow = (Option<String>, bool, bool, Option<String>, Option<bool>);

impl Standings for SqliteStore {
    async fn keep_out(&self, removal: Removal, now: &str) -> Result<(), StoreError> {
        self.writer.write(Write::Standing(StandingWrite::KeepOut(removal, now.to_owned()))).await?;
        Ok(())
    }

    async fn removals(&self, room: Room<'_>, now: &str) -> Result<Vec<Removal>, StoreError> {
        let rows: Vec<RemovalRow> = sqlx::query_as(
            "SELECT id, room, person, name, removed_by, until, revoked FROM removals \
             WHERE room = ? AND until > ? ORDER BY until, id",
        )
        .bind(room.written())
        .bind(now)
        .fetch_all(&self.readers)
        .await?;
        Ok(rows.into_iter().map(removal).collect())
    }

    async fn let_back(&self, id: &str) -> Result<bool, StoreError> {
        Ok(self.writer.write(Write::Standing(StandingWrite::LetBack(id.to_owned()))).await? > 0)
    }

    async fn hand_over(&self, tree: &str, to: Option<Heir>, by: Option<&str>) -> Result<bool, StoreError> {
        let write = StandingWrite::HandOver(tree.to_owned(), to, by.map(str::to_owned));
        Ok(self.writer.write(Write::Standing(write)).await? > 0)
    }

    async fn heir_of(&self, tree: &str) -> Result<Option<Heir>, StoreError> {
        let found: Option<(Option<String>, Option<String>)> =
            sqlx::query_as("SELECT owner_person, owner_name FROM trees WHERE key = ?")
                .bind(tree)
                .fetch_optional(&self.readers)
                .await?;
        let heir = found.and_then(|(person, name)| person.zip(name));
        Ok(heir.map(|(person, name)| Heir { person, name }))
    }

    async fn standing(&self, room: Room<'_>, person: &str, now: &str) -> Result<Standing, StoreError> {
        let (query, name) = match room {
            Room::Tree(id) => (
                "SELECT t.locked_by, coalesce(t.owner_person = ?2, 0) AS is_heir, t.deleted_at IS NOT NULL, \
                 r.removed_by, r.revoked \
                 FROM trees t \
                 LEFT JOIN removals r ON r.person = ?2 AND r.until > ?3 AND r.room = 'tree ' || t.key \
                 WHERE t.key = ?1",
                id,
            ),
            Room::Session(name) => (
                "SELECT t.locked_by, coalesce(t.owner_person = ?2, 0) AS is_heir, t.deleted_at IS NOT NULL, \
                 r.removed_by, r.revoked \
                 FROM sessions s LEFT JOIN trees t ON t.id = s.tree \
                 LEFT JOIN removals r ON r.person = ?2 AND r.until > ?3 \
                 AND r.room IN ('session ' || s.name, 'tree ' || t.key) \
                 WHERE s.name = ?1 ORDER BY r.until DESC LIMIT 1",
                name,
            ),
        };
        let found: Option<StandingRow> =
            sqlx::query_as(query).bind(name).bind(person).bind(now).fetch_optional(&self.readers).await?;
        Ok(found.map(standing).unwrap_or_default())
    }
}

impl StandingWrite {
    pub(super) async fn apply(&self, connection: &mut SqliteConnection) -> Result<u64, StoreError> {
        let write = match self {
            Self::KeepOut(removal, now) => {
                sqlx::query("DELETE FROM removals WHERE until <= ?")
                    .bind(now)
                    .execute(&mut *connection)
                    .await?;
                sqlx::query(
                    "INSERT OR REPLACE INTO removals (id, room, person, name, removed_by, until, revoked) \
                     VALUES (?, ?, ?, ?, ?, ?, ?)",
                )
                .bind(&removal.id)
                .bind(&removal.room)
                .bind(&removal.person)
                .bind(&removal.name)
                .bind(&removal.by)
                .bind(&removal.until)
                .bind(removal.is_revoked)
            }
            Self::LetBack(id) => sqlx::query("DELETE FROM removals WHERE id = ?").bind(id),
            Self::HandOver(tree, to, by) => sqlx::query(
                "UPDATE trees SET owner_person = ?1, owner_name = ?2 \
                 WHERE key = ?3 AND (?4 IS NULL OR owner_person = ?4)",
            )
            .bind(to.as_ref().map(|heir| &heir.person))
            .bind(to.as_ref().map(|heir| &heir.name))
            .bind(tree)
            .bind(by),
        };
        Ok(write.execute(connection).await?.rows_affected())
    }
}

fn removal((id, room, person, name, by, until, is_revoked): RemovalRow) -> Removal {
    Removal { id, room, person, name, by, until, is_revoked }
}

fn standing((locked_by, is_heir, is_deleted, by, is_revoked): StandingRow) -> Standing {
    let removed = by.zip(is_revoked).map(|(by, is_revoked)| Removed { by, is_revoked });
    Standing { locked_by, removed, is_heir, is_deleted }
}
