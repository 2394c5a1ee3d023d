//! Passes in SQLite.

use espalier_proto::access::Role;
use sqlx::sqlite::SqliteConnection;

use super::{
    super::{Missing, Pass, PassKind, Passes, StoreError, folding::folded},
    SqliteStore,
    groups::most,
    writer::Write,
};
use crate::access::SecretHash;

#[derive(Debug)]
pub(super) enum PassWrite {
    Add(SecretHash, Pass),
    Extend { id: String, expires_at: String },
    Change { id: String, role: Role },
    Take(String),
    Purge(String),
}

impl Passes for SqliteStore {
    async fn add_pass(&self, hash: SecretHash, pass: Pass) -> Result<(), StoreError> {
        self.writer.write(Write::Pass(PassWrite::Add(hash, pass))).await.map(drop)
    }

    async fn pass(&self, hash: SecretHash, now: &str) -> Result<Option<Pass>, StoreError> {
        let found = sqlx::query_as(SELECT_BY_HASH).bind(hash.to_vec()).bind(now);
        found.fetch_optional(&self.readers).await?.map(read).transpose()
    }

    async fn passes(&self, kind: PassKind, now: &str) -> Result<Vec<Pass>, StoreError> {
        let found = sqlx::query_as(SELECT_BY_KIND).bind(kind.name()).bind(now);
        found.fetch_all(&self.readers).await?.into_iter().map(read).collect()
    }

    async fn extend_pass(&self, id: &str, expires_at: &str) -> Result<(), StoreError> {
        let write = PassWrite::Extend { id: id.to_owned(), expires_at: expires_at.to_owned() };
        self.writer.write(Write::Pass(write)).await.map(drop)
    }

    async fn change_pass(&self, id: &str, role: Role) -> Result<bool, StoreError> {
        let write = Write::Pass(PassWrite::Change { id: id.to_owned(), role });
        Ok(self.writer.write(write).await? > 0)
    }

    async fn take_pass(&self, id: &str) -> Result<bool, StoreError> {
        Ok(self.writer.write(Write::Pass(PassWrite::Take(id.to_owned()))).await? > 0)
    }

    async fn purge_passes(&self, now: &str) -> Result<(), StoreError> {
        self.writer.write(Write::Pass(PassWrite::Purge(now.to_owned()))).await.map(drop)
    }
}

macro_rules! select {
    ($rest:literal) => {
        concat!(
            "SELECT passes.id, kind, passes.name, coalesce(users.role, passes.role), key, passes.created_at,
             expires_at, ends_at, (SELECT group_concat(studios.role) FROM studio_members
             JOIN studios ON studios.id = studio WHERE studio_members.user = users.id)
             FROM passes LEFT JOIN trees ON trees.id = tree LEFT JOIN users ON users.id = passes.user WHERE expires_at > ?2 AND ",
            $rest
        )
    };
}

const SELECT_BY_HASH: &str = select!("hash = ?1");
const SELECT_BY_KIND: &str = select!("kind = ?1 ORDER BY passes.created_at DESC, passes.id DESC");

/// Identifier, kind, name, role, tree, the times when it was made, expires and ends, and the roles of its user's groups.
type Row = (String, String, String, String, Option<String>, String, String, String, Option<String>);

fn read(
    (id, kind, name, role, tree, created_at, expires_at, ends_at, of_groups): Row,
) -> Result<Pass, StoreError> {
    let known = PassKind::named(&kind).zip(Role::named(&role));
    let (kind, role) =
        known.ok_or_else(|| StoreError::Damaged(format!("the pass {id} is of no known kind")))?;
    let role = most(role, of_groups.as_deref())?;
    Ok(Pass { id, kind, name, role, tree, created_at, expires_at, ends_at })
}

impl PassWrite {
    pub(super) async fn apply(&self, connection: &mut SqliteConnection) -> Result<u64, StoreError> {
        let query = match self {
            Self::Add(hash, pass) => {
                let tree = match &pass.tree {
                    None => None,
                    Some(key) => {
                        let found = sqlx::query_scalar("SELECT id FROM trees WHERE key = ?").bind(key);
                        Some(id(found.fetch_optional(&mut *connection).await?, Missing::Tree)?)
                    }
                };
                let user = match pass.kind {
                    PassKind::Login => {
                        let found = sqlx::query_scalar("SELECT id FROM users WHERE folded = ?");
                        let found = found.bind(folded(&pass.name)).fetch_optional(&mut *connection).await?;
                        Some(id(found, Missing::User)?)
                    }
                    PassKind::Invitation | PassKind::Device | PassKind::Token => None,
                };
                sqlx::query(
                    "INSERT INTO passes (id, hash, kind, name, role, tree, user, created_at, expires_at, ends_at)
                     VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                )
                .bind(&pass.id)
                .bind(hash.to_vec())
                .bind(pass.kind.name())
                .bind(&pass.name)
                .bind(pass.role.name())
                .bind(tree)
                .bind(user)
                .bind(&pass.created_at)
                .bind(&pass.expires_at)
                .bind(&pass.ends_at)
            }
            Self::Extend { id, expires_at } => {
                sqlx::query("UPDATE passes SET expires_at = ? WHERE id = ?").bind(expires_at).bind(id)
            }
            Self::Change { id, role } => {
                sqlx::query("UPDATE passes SET role = ? WHERE id = ?").bind(role.name()).bind(id)
            }
            Self::Take(id) => sqlx::query("DELETE FROM passes WHERE id = ?").bind(id),
            Self::Purge(now) => sqlx::query("DELETE FROM passes WHERE expires_at <= ?").bind(now),
        };
        Ok(query.execute(connection).await?.rows_affected())
    }
}

/// The row of what a pass needs.
fn id(found: Option<i64>, what: Missing) -> Result<i64, StoreError> {
    found.ok_or(StoreError::NotFound(what))
}
