//! Passes in SQLite.

use espalier_proto::access::Role;
use sqlx::sqlite::SqliteConnection;

use super::{
    super::{Holder, Missing, Pass, PassKind, Passes, StoreError},
    SqliteStore,
    groups::most,
    writer::Write,
};
use crate::access::SecretHash;

#[derive(Debug)]
pub(super) enum PassWrite {
    /// Up to so many like it, if that is said.
    Add(SecretHash, Box<Pass>, Option<u32>),
    Extend {
        id: String,
        expires_at: String,
    },
    Change {
        id: String,
        role: Role,
    },
    /// What lets in from now on, as a device.
    Redeem(SecretHash, Box<Pass>),
    Take(String),
    Purge(String),
}

impl Passes for SqliteStore {
    async fn add_pass(&self, hash: SecretHash, pass: Pass) -> Result<(), StoreError> {
        self.writer.write(Write::Pass(PassWrite::Add(hash, Box::new(pass), None))).await.map(drop)
    }

    async fn add_pass_up_to(&self, most: u32, hash: SecretHash, pass: Pass) -> Result<(), StoreError> {
        let write = PassWrite::Add(hash, Box::new(pass), Some(most));
        self.writer.write(Write::Pass(write)).await.map(drop)
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

    async fn redeem_pass(&self, hash: SecretHash, device: &Pass) -> Result<bool, StoreError> {
        let write = PassWrite::Redeem(hash, Box::new(device.clone()));
        Ok(self.writer.write(Write::Pass(write)).await? > 0)
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
            "SELECT passes.id, passes.kind, passes.name, passes.role, trees.key, passes.created_at,
             passes.expires_at, passes.ends_at, coalesce(users.key, maker.id), coalesce(users.name, maker.name),
             maker.hash, coalesce(users.role, maker.role),
             (SELECT group_concat(studios.role) FROM studio_members
             JOIN studios ON studios.id = studio WHERE studio_members.user = users.id)
             FROM passes LEFT JOIN trees ON trees.id = passes.tree LEFT JOIN users ON users.id = passes.user
             LEFT JOIN passes AS maker ON maker.id = passes.maker
             WHERE passes.expires_at > ?2 AND (maker.id IS NULL OR maker.expires_at > ?2) AND ",
            $rest
        )
    };
}

/// How many lets in for the same tree, or for none and are tokens of the same holder, at a time.
const LIKE_IT: &str = "SELECT count(*) FROM passes WHERE expires_at > ?4 AND CASE WHEN ?1 IS NULL
    THEN kind = 'token' AND tree IS NULL AND user IS ?2 AND maker IS ?3
    ELSE tree = ?1 AND kind IN ('invitation', 'device') END";

const SELECT_BY_HASH: &str = select!("passes.hash = ?1");
const SELECT_BY_KIND: &str = select!("passes.kind = ?1 ORDER BY passes.created_at DESC, passes.id DESC");

/// Identifier, kind, name, role, tree, and the times when it was made, expires and ends; of its holder the identifier, the
/// name, the hash of a device, the role, and the roles of the groups of a user.
#[rustfmt::skip]
type Row = (
    String, String, String, String, Option<String>, String, String, String,
    Option<String>, Option<String>, Option<Vec<u8>>, Option<String>, Option<String>,
);

fn read(row: Row) -> Result<Pass, StoreError> {
    let (id, kind, name, role, tree, created_at, expires_at, ends_at, holder, called, hash, own, groups) =
        row;
    let unknown = || StoreError::Damaged(format!("the pass {id} is of no known kind"));
    let role_of = |name: &str| Role::named(name).ok_or_else(unknown);
    let (kind, made_for) = (PassKind::named(&kind).ok_or_else(unknown)?, role_of(&role)?);
    let holder = match (holder.zip(called), hash) {
        (None, _) => None,
        (Some((id, name)), None) => Some(Holder::User { id, name }),
        (Some((holder, name)), Some(hash)) => {
            let hash = SecretHash::try_from(hash).map_err(|_| unknown())?;
            Some(Holder::Device { id: holder, hash, name })
        }
    };
    let own = own.map(|own| most(role_of(&own)?, groups.as_deref())).transpose()?;
    let (name, role) = match (kind, &holder, own) {
        (PassKind::Login, Some(user), Some(own)) => (user.name().to_owned(), own),
        (_, _, own) => (name, own.map_or(made_for, |own| own.min(made_for))),
    };
    let most = Some(made_for).filter(|_| kind == PassKind::Token && holder.is_some());
    Ok(Pass { id, kind, name, role, holder, most, tree, created_at, expires_at, ends_at })
}

impl PassWrite {
    pub(super) async fn apply(&self, connection: &mut SqliteConnection) -> Result<u64, StoreError> {
        let query = match self {
            Self::Add(hash, pass, most) => {
                let tree = match &pass.tree {
                    None => None,
                    Some(key) => {
                        let found = sqlx::query_scalar("SELECT id FROM trees WHERE key = ?").bind(key);
                        Some(id(found.fetch_optional(&mut *connection).await?, Missing::Tree)?)
                    }
                };
                let holder = pass.holder.as_ref();
                let user = match holder {
                    Some(Holder::User { id: key, .. }) => {
                        let found = sqlx::query_scalar("SELECT id FROM users WHERE key = ?").bind(key);
                        Some(id(found.fetch_optional(&mut *connection).await?, Missing::User)?)
                    }
                    _ => None,
                };
                let maker = match holder {
                    Some(Holder::Device { id, .. }) => {
                        let found =
                            sqlx::query_scalar::<_, String>("SELECT id FROM passes WHERE id = ?").bind(id);
                        let found = found.fetch_optional(&mut *connection).await?;
                        Some(found.ok_or(StoreError::NotFound(Missing::Pass))?)
                    }
                    _ => None,
                };
                if let Some(most) = most {
                    let others: i64 = sqlx::query_scalar(LIKE_IT)
                        .bind(tree)
                        .bind(user)
                        .bind(&maker)
                        .bind(&pass.created_at)
                        .fetch_one(&mut *connection)
                        .await?;
                    if others >= i64::from(*most) {
                        return Err(StoreError::Full);
                    }
                }
                sqlx::query(
                    "INSERT INTO passes (id, hash, kind, name, role, tree, user, maker, created_at, expires_at,
                     ends_at) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                )
                .bind(&pass.id)
                .bind(hash.to_vec())
                .bind(pass.kind.name())
                .bind(&pass.name)
                .bind(pass.role.name())
                .bind(tree)
                .bind(user)
                .bind(maker)
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
            Self::Redeem(hash, device) => sqlx::query(
                "UPDATE passes SET hash = ?1, kind = ?2, created_at = ?3, expires_at = ?4, ends_at = ?5
                 WHERE id = ?6 AND kind = 'invitation' AND expires_at > ?3
                   AND (tree IS NULL OR tree IN (SELECT id FROM trees WHERE deleted_at IS NULL))",
            )
            .bind(hash.to_vec())
            .bind(device.kind.name())
            .bind(&device.created_at)
            .bind(&device.expires_at)
            .bind(&device.ends_at)
            .bind(&device.id),
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
