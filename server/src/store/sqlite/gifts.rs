//! What is given to users and groups, in SQLite.

use std::collections::BTreeSet;

use espalier_proto::access::Role;
use sqlx::{QueryBuilder, Sqlite, sqlite::SqliteConnection};

use super::{
    super::{Gift, Gifts, Given, Missing, Receiver, Room, StoreError, folding::folded, gifts::user_of},
    SqliteStore,
    groups::most,
    writer::Write,
};

#[derive(Debug)]
pub(super) struct GiftWrite {
    what: Owned,
    done: Done,
}

#[derive(Debug)]
enum Done {
    Given(Receiver, Role),
    /// From whom, by their identifier.
    TakenBack(String),
}

#[derive(Debug)]
enum Owned {
    Tree(String),
    Collection(String),
}

impl From<Gift<'_>> for Owned {
    fn from(gift: Gift<'_>) -> Self {
        match gift {
            Gift::Tree(id) => Self::Tree(id.to_owned()),
            Gift::Collection(id) => Self::Collection(id.to_owned()),
        }
    }
}

/// The trees that a user, who is bound by their folded name, was given by themselves, by a group or by hand over; begins with
/// what stands before the name, which is bound twice.
macro_rules! trees_seen {
    ($user:literal) => {
        concat!(
            "(WITH RECURSIVE mine AS (SELECT tree, collection FROM gifts JOIN users ON users.folded = ", $user,
            " WHERE gifts.user = users.id
                OR gifts.studio IN (SELECT studio FROM studio_members WHERE studio_members.user = users.id)),
              inside(id) AS (SELECT collection FROM mine WHERE collection IS NOT NULL
                UNION SELECT collections.id FROM collections JOIN inside ON collections.parent = inside.id)
              SELECT tree FROM mine WHERE tree IS NOT NULL
              UNION SELECT trees.id FROM trees JOIN inside ON trees.collection = inside.id
              UNION SELECT trees.id FROM trees WHERE owner_person = 'login ' || ", $user, ")"
        )
    };
}

pub(super) use trees_seen;

/// Adds the condition that somebody sees a tree.
pub(super) fn narrow(sql: &mut QueryBuilder<Sqlite>, person: &str) {
    let user = user_of(person).unwrap_or_default();
    sql.push(" AND id IN ");
    for (index, part) in trees_seen!("\u{0}").split('\u{0}').enumerate() {
        if index > 0 {
            sql.push_bind(user.to_owned());
        }
        sql.push(part);
    }
}

/// The roles with which a user, `?1`, was given what `above` and `tree` name.
macro_rules! roles_given {
    ($above:literal, $tree:literal) => {
        concat!(
            "WITH RECURSIVE above(id) AS (", $above,
            " UNION SELECT parent FROM collections JOIN above ON collections.id = above.id WHERE parent IS NOT NULL)
             SELECT group_concat(gifts.role) FROM gifts JOIN users ON users.folded = ?1
             WHERE (gifts.user = users.id
                OR gifts.studio IN (SELECT studio FROM studio_members WHERE studio_members.user = users.id))
               AND (gifts.collection IN (SELECT id FROM above)", $tree, ")"
        )
    };
}

const WITH_TREE: &str = roles_given!(
    "SELECT collection FROM trees WHERE key = ?2 AND collection IS NOT NULL",
    " OR gifts.tree = (SELECT id FROM trees WHERE key = ?2)"
);
const WITH_SESSION: &str = roles_given!(
    "SELECT collection FROM trees JOIN sessions ON sessions.tree = trees.id WHERE sessions.name = ?2 AND collection IS NOT NULL",
    " OR gifts.tree = (SELECT tree FROM sessions WHERE name = ?2)"
);
const WITH_COLLECTION: &str = roles_given!("SELECT id FROM collections WHERE key = ?2", "");

impl SqliteStore {
    async fn greatest(&self, sql: &'static str, person: &str, key: &str) -> Result<Role, StoreError> {
        let Some(user) = user_of(person) else { return Ok(Role::None) };
        let roles: Option<String> =
            sqlx::query_scalar(sql).bind(user).bind(key).fetch_one(&self.readers).await?;
        most(Role::None, roles.as_deref())
    }
}

impl Gifts for SqliteStore {
    async fn give(&self, what: Gift<'_>, to: &Receiver, role: Role) -> Result<(), StoreError> {
        let write = GiftWrite { what: what.into(), done: Done::Given(to.clone(), role) };
        self.writer.write(Write::Gift(write)).await.map(drop)
    }

    async fn take_back(&self, what: Gift<'_>, from: &str) -> Result<bool, StoreError> {
        let write = GiftWrite { what: what.into(), done: Done::TakenBack(from.to_owned()) };
        Ok(self.writer.write(Write::Gift(write)).await? > 0)
    }

    async fn given(&self, what: Gift<'_>) -> Result<Vec<Given>, StoreError> {
        let (sql, key) = match what {
            Gift::Tree(key) => (
                "SELECT coalesce(users.key, studios.key), coalesce(users.name, studios.name), users.id IS NULL,
                        gifts.role FROM gifts LEFT JOIN users ON users.id = user LEFT JOIN studios ON studios.id = studio
                 WHERE gifts.tree = (SELECT id FROM trees WHERE key = ?)
                 ORDER BY users.id IS NOT NULL, coalesce(users.folded, studios.folded)",
                key,
            ),
            Gift::Collection(key) => (
                "SELECT coalesce(users.key, studios.key), coalesce(users.name, studios.name), users.id IS NULL,
                        gifts.role FROM gifts LEFT JOIN users ON users.id = user LEFT JOIN studios ON studios.id = studio
                 WHERE gifts.collection = (SELECT id FROM collections WHERE key = ?)
                 ORDER BY users.id IS NOT NULL, coalesce(users.folded, studios.folded)",
                key,
            ),
        };
        let rows: Vec<(String, String, bool, String)> =
            sqlx::query_as(sql).bind(key).fetch_all(&self.readers).await?;
        let read = |(id, name, is_group, role): (String, String, bool, String)| {
            let to = if is_group { Receiver::Group(name) } else { Receiver::User(name) };
            Ok(Given { id, to, role: most(Role::None, Some(&role))? })
        };
        rows.into_iter().map(read).collect()
    }

    async fn role_given(&self, room: Room<'_>, person: &str) -> Result<Role, StoreError> {
        match room {
            Room::Tree(key) => self.greatest(WITH_TREE, person, key).await,
            Room::Session(name) => self.greatest(WITH_SESSION, person, name).await,
        }
    }

    async fn role_in(&self, collection: &str, person: &str) -> Result<Role, StoreError> {
        self.greatest(WITH_COLLECTION, person, collection).await
    }

    async fn collections_of(&self, person: &str) -> Result<BTreeSet<String>, StoreError> {
        let Some(user) = user_of(person) else { return Ok(BTreeSet::new()) };
        let keys: Vec<String> = sqlx::query_scalar(
            "WITH RECURSIVE inside(id) AS (SELECT collection FROM gifts JOIN users ON users.folded = ?
               WHERE collection IS NOT NULL AND (gifts.user = users.id
                 OR gifts.studio IN (SELECT studio FROM studio_members WHERE studio_members.user = users.id))
               UNION SELECT collections.id FROM collections JOIN inside ON collections.parent = inside.id)
             SELECT key FROM collections JOIN inside ON inside.id = collections.id",
        )
        .bind(user)
        .fetch_all(&self.readers)
        .await?;
        Ok(keys.into_iter().collect())
    }
}

impl GiftWrite {
    pub(super) async fn apply(&self, connection: &mut SqliteConnection) -> Result<u64, StoreError> {
        let (tree, collection) = match &self.what {
            Owned::Tree(key) => {
                let sql = "SELECT id FROM trees WHERE key = ? AND deleted_at IS NULL";
                (Some(row(connection, sql, key, Missing::Tree).await?), None)
            }
            Owned::Collection(key) => {
                let sql = "SELECT id FROM collections WHERE key = ?";
                (None, Some(row(connection, sql, key, Missing::Collection).await?))
            }
        };
        let (to, role) = match &self.done {
            Done::Given(to, role) => (to, role),
            Done::TakenBack(from) => {
                let sql = "DELETE FROM gifts WHERE tree IS ?1 AND collection IS ?2
                           AND (user = (SELECT id FROM users WHERE key = ?3)
                             OR studio = (SELECT id FROM studios WHERE key = ?3))";
                let taken = sqlx::query(sql).bind(tree).bind(collection).bind(from);
                return Ok(taken.execute(connection).await?.rows_affected());
            }
        };
        let (user, studio) = match to {
            Receiver::User(name) => {
                let sql = "SELECT id FROM users WHERE folded = ?";
                (Some(row(connection, sql, &folded(name), Missing::User).await?), None)
            }
            Receiver::Group(name) => {
                let sql = "SELECT id FROM studios WHERE folded = ?";
                (None, Some(row(connection, sql, &folded(name), Missing::Group).await?))
            }
        };
        let sql = "DELETE FROM gifts WHERE tree IS ? AND collection IS ? AND user IS ? AND studio IS ?";
        let before = sqlx::query(sql).bind(tree).bind(collection).bind(user).bind(studio);
        before.execute(&mut *connection).await?;
        let sql = "INSERT INTO gifts (tree, collection, user, studio, role) VALUES (?, ?, ?, ?, ?)";
        let given = sqlx::query(sql).bind(tree).bind(collection).bind(user).bind(studio).bind(role.name());
        Ok(given.execute(connection).await?.rows_affected())
    }
}

async fn row(
    connection: &mut SqliteConnection,
    sql: &'static str,
    key: &str,
    missing: Missing,
) -> Result<i64, StoreError> {
    let found = sqlx::query_scalar(sql).bind(key).fetch_optional(connection).await?;
    found.ok_or(StoreError::NotFound(missing))
}
