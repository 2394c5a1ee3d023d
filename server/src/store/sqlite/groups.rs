//! Groups of users in SQLite.

use espalier_proto::access::Role;
use sqlx::sqlite::SqliteConnection;

use super::{
    super::{Group, Groups, Missing, StoreError, folding::folded},
    SqliteStore,
    writer::Write,
};

#[derive(Debug)]
pub(super) enum GroupWrite {
    Add(Group),
    Change(String, Role),
    Remove(String),
    Join { group: String, user: String },
    Leave { group: String, user: String },
}

impl Groups for SqliteStore {
    async fn add_group(&self, group: Group) -> Result<(), StoreError> {
        let added = self.writer.write(Write::Group(GroupWrite::Add(group))).await?;
        if added > 0 { Ok(()) } else { Err(StoreError::Taken) }
    }

    async fn groups(&self) -> Result<Vec<Group>, StoreError> {
        let rows: Vec<(String, String, String, Option<String>)> = sqlx::query_as(
            "SELECT studios.name, studios.role, studios.created_at, users.name FROM studios
             LEFT JOIN studio_members ON studio = studios.id LEFT JOIN users ON users.id = user
             ORDER BY studios.folded, users.folded",
        )
        .fetch_all(&self.readers)
        .await?;
        let mut groups: Vec<Group> = Vec::new();
        for (name, role, created_at, member) in rows {
            match groups.last_mut().filter(|group| group.name == name) {
                Some(group) => group.members.extend(member),
                None => {
                    let role = role_named(&role)?;
                    groups.push(Group { name, role, created_at, members: member.into_iter().collect() });
                }
            }
        }
        Ok(groups)
    }

    async fn change_group(&self, name: &str, role: Role) -> Result<bool, StoreError> {
        Ok(self.writer.write(Write::Group(GroupWrite::Change(name.to_owned(), role))).await? > 0)
    }

    async fn remove_group(&self, name: &str) -> Result<bool, StoreError> {
        Ok(self.writer.write(Write::Group(GroupWrite::Remove(name.to_owned()))).await? > 0)
    }

    async fn join_group(&self, name: &str, user: &str) -> Result<(), StoreError> {
        let write = GroupWrite::Join { group: name.to_owned(), user: user.to_owned() };
        self.writer.write(Write::Group(write)).await.map(drop)
    }

    async fn leave_group(&self, name: &str, user: &str) -> Result<bool, StoreError> {
        let write = GroupWrite::Leave { group: name.to_owned(), user: user.to_owned() };
        Ok(self.writer.write(Write::Group(write)).await? > 0)
    }
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
        let query = match self {
            Self::Add(Group { name, role, created_at, .. }) => sqlx::query(
                "INSERT INTO studios (name, folded, role, created_at) VALUES (?, ?, ?, ?)
                 ON CONFLICT (folded) DO NOTHING",
            )
            .bind(name)
            .bind(folded(name))
            .bind(role.name())
            .bind(created_at),
            Self::Change(name, role) => sqlx::query("UPDATE studios SET role = ? WHERE folded = ?")
                .bind(role.name())
                .bind(folded(name)),
            Self::Remove(name) => sqlx::query("DELETE FROM studios WHERE folded = ?").bind(folded(name)),
            Self::Join { group, user } => {
                let group: i64 = sqlx::query_scalar("SELECT id FROM studios WHERE folded = ?")
                    .bind(folded(group))
                    .fetch_optional(&mut *connection)
                    .await?
                    .ok_or(StoreError::NotFound(Missing::Group))?;
                let user: i64 = sqlx::query_scalar("SELECT id FROM users WHERE folded = ?")
                    .bind(folded(user))
                    .fetch_optional(&mut *connection)
                    .await?
                    .ok_or(StoreError::NotFound(Missing::User))?;
                sqlx::query("INSERT INTO studio_members (studio, user) VALUES (?, ?) ON CONFLICT DO NOTHING")
                    .bind(group)
                    .bind(user)
            }
            Self::Leave { group, user } => sqlx::query(
                "DELETE FROM studio_members WHERE studio = (SELECT id FROM studios WHERE folded = ?)
                 AND user = (SELECT id FROM users WHERE folded = ?)",
            )
            .bind(folded(group))
            .bind(folded(user)),
        };
        Ok(query.execute(connection).await?.rows_affected())
    }
}
