//! Groups of users in SQLite.

use espalier_proto::access::Role;
use sqlx::sqlite::SqliteConnection;

use super::{
    super::{Group, GroupChange, Groups, Missing, StoreError, folding::folded},
    SqliteStore,
    writer::Write,
};

#[derive(Debug)]
pub(super) enum GroupWrite {
    Add(Group),
    Change(String, GroupChange, Option<u64>),
    Remove(String, Option<u64>),
    Join { group: String, user: String, expected: Option<u64> },
    Leave { group: String, user: String, expected: Option<u64> },
}

impl Groups for SqliteStore {
    async fn add_group(&self, group: Group) -> Result<(), StoreError> {
        let added = self.writer.write(Write::Group(GroupWrite::Add(group))).await?;
        if added > 0 { Ok(()) } else { Err(StoreError::Taken) }
    }

    async fn groups(&self) -> Result<Vec<Group>, StoreError> {
        let rows: Vec<Row> = sqlx::query_as(
            "SELECT studios.key, studios.name, studios.role, studios.created_at, studios.revision, users.name
             FROM studios LEFT JOIN studio_members ON studio = studios.id LEFT JOIN users ON users.id = user
             ORDER BY studios.folded, users.folded",
        )
        .fetch_all(&self.readers)
        .await?;
        let mut groups: Vec<Group> = Vec::new();
        for (id, name, role, created_at, revision, member) in rows {
            match groups.last_mut().filter(|group| group.id == id) {
                Some(group) => group.members.extend(member),
                None => {
                    let (role, members) = (role_named(&role)?, member.into_iter().collect());
                    let revision = revision.try_into().unwrap_or_default();
                    groups.push(Group { id, name, role, created_at, members, revision });
                }
            }
        }
        Ok(groups)
    }

    async fn change_group(
        &self,
        id: &str,
        change: GroupChange,
        expected: Option<u64>,
    ) -> Result<bool, StoreError> {
        self.change_groups(GroupWrite::Change(id.to_owned(), change, expected)).await
    }

    async fn remove_group(&self, id: &str, expected: Option<u64>) -> Result<bool, StoreError> {
        self.change_groups(GroupWrite::Remove(id.to_owned(), expected)).await
    }

    async fn join_group(&self, id: &str, user: &str, expected: Option<u64>) -> Result<(), StoreError> {
        let write = GroupWrite::Join { group: id.to_owned(), user: user.to_owned(), expected };
        self.change_groups(write).await.map(drop)
    }

    async fn leave_group(&self, id: &str, user: &str, expected: Option<u64>) -> Result<bool, StoreError> {
        self.change_groups(GroupWrite::Leave { group: id.to_owned(), user: user.to_owned(), expected }).await
    }
}

impl SqliteStore {
    async fn change_groups(&self, write: GroupWrite) -> Result<bool, StoreError> {
        Ok(self.writer.write(Write::Group(write)).await? > 0)
    }
}

/// Identifier, name, role, when it was added, revision, and a member.
type Row = (String, String, String, String, i64, Option<String>);

/// Whether something is at another revision than was expected.
pub(super) fn stale(expected: Option<u64>, found: i64) -> bool {
    expected.is_some_and(|expected| u64::try_from(found) != Ok(expected))
}

/// The most of a role and those of groups, as `group_concat` has them.
pub(super) fn most(own: Role, of_groups: Option<&str>) -> Result<Role, StoreError> {
    let named = of_groups.into_iter().flat_map(|names| names.split(','));
    named.map(role_named).try_fold(own, |most, role| Ok(most.max(role?)))
}

fn role_named(name: &str) -> Result<Role, StoreError> {
    Role::named(name).ok_or_else(|| StoreError::Damaged(format!("a group has the unknown role {name}")))
}

impl GroupWrite {
    pub(super) async fn apply(&self, connection: &mut SqliteConnection) -> Result<u64, StoreError> {
        match self {
            Self::Add(Group { id, name, role, created_at, .. }) => {
                let added = sqlx::query(
                    "INSERT INTO studios (key, name, folded, role, created_at) VALUES (?, ?, ?, ?, ?)
                     ON CONFLICT (folded) DO NOTHING",
                );
                let added = added.bind(id).bind(name).bind(folded(name)).bind(role.name()).bind(created_at);
                Ok(added.execute(connection).await?.rows_affected())
            }
            Self::Change(id, GroupChange { name: other, role }, expected) => {
                let Some(row) = find(connection, id, *expected).await? else { return Ok(0) };
                if let Some(other) = other {
                    rename(connection, row, other).await?;
                }
                if let Some(role) = role {
                    let sql = "UPDATE studios SET role = ? WHERE id = ?";
                    sqlx::query(sql).bind(role.name()).bind(row).execute(&mut *connection).await?;
                }
                count(connection, row).await
            }
            Self::Remove(id, expected) => {
                let Some(row) = find(connection, id, *expected).await? else { return Ok(0) };
                let removed = sqlx::query("DELETE FROM studios WHERE id = ?").bind(row);
                Ok(removed.execute(connection).await?.rows_affected())
            }
            Self::Join { group, user, expected } => {
                let row = find(connection, group, *expected).await?;
                let row = row.ok_or(StoreError::NotFound(Missing::Group))?;
                let user: i64 = sqlx::query_scalar("SELECT id FROM users WHERE key = ?")
                    .bind(user)
                    .fetch_optional(&mut *connection)
                    .await?
                    .ok_or(StoreError::NotFound(Missing::User))?;
                let sql = "INSERT INTO studio_members (studio, user) VALUES (?, ?) ON CONFLICT DO NOTHING";
                let joined = sqlx::query(sql).bind(row).bind(user).execute(&mut *connection).await?;
                if joined.rows_affected() == 0 { Ok(0) } else { count(connection, row).await }
            }
            Self::Leave { group, user, expected } => {
                let Some(row) = find(connection, group, *expected).await? else { return Ok(0) };
                let sql = "DELETE FROM studio_members
                           WHERE studio = ? AND user = (SELECT id FROM users WHERE key = ?)";
                let left = sqlx::query(sql).bind(row).bind(user).execute(&mut *connection).await?;
                if left.rows_affected() == 0 { Ok(0) } else { count(connection, row).await }
            }
        }
    }
}

/// The row of a group, which is at a revision if one is expected.
async fn find(
    connection: &mut SqliteConnection,
    id: &str,
    expected: Option<u64>,
) -> Result<Option<i64>, StoreError> {
    let found: Option<(i64, i64)> = sqlx::query_as("SELECT id, revision FROM studios WHERE key = ?")
        .bind(id)
        .fetch_optional(connection)
        .await?;
    match found {
        Some((_, revision)) if stale(expected, revision) => Err(StoreError::Stale),
        found => Ok(found.map(|(row, _)| row)),
    }
}

async fn rename(connection: &mut SqliteConnection, row: i64, name: &str) -> Result<(), StoreError> {
    let other: Option<i64> = sqlx::query_scalar("SELECT id FROM studios WHERE folded = ? AND id <> ?")
        .bind(folded(name))
        .bind(row)
        .fetch_optional(&mut *connection)
        .await?;
    if other.is_some() {
        return Err(StoreError::Taken);
    }
    let renamed = sqlx::query("UPDATE studios SET name = ?, folded = ? WHERE id = ?");
    renamed.bind(name).bind(folded(name)).bind(row).execute(connection).await?;
    Ok(())
}

/// Counts a change.
async fn count(connection: &mut SqliteConnection, row: i64) -> Result<u64, StoreError> {
    let counted = sqlx::query("UPDATE studios SET revision = revision + 1 WHERE id = ?").bind(row);
    Ok(counted.execute(connection).await?.rows_affected())
}
