//! Users in SQLite.

use espalier_proto::access::Role;
use sqlx::sqlite::SqliteConnection;

use super::{
    super::{StoreError, User, UserChange, Users, folding::folded, person_of},
    SqliteStore,
    groups::most,
    writer::Write,
};

#[derive(Debug)]
pub(super) enum UserWrite {
    Add(User),
    Change(String, UserChange),
    Remove(String),
}

macro_rules! select {
    () => {
        "SELECT name, role, password, created_at, (SELECT group_concat(studios.role) FROM studio_members
         JOIN studios ON studios.id = studio WHERE user = users.id) FROM users "
    };
}

impl Users for SqliteStore {
    async fn add_user(&self, user: User) -> Result<(), StoreError> {
        let added = self.writer.write(Write::User(UserWrite::Add(user))).await?;
        if added > 0 { Ok(()) } else { Err(StoreError::Taken) }
    }

    async fn user(&self, name: &str) -> Result<Option<User>, StoreError> {
        let found = sqlx::query_as(concat!(select!(), "WHERE folded = ?"));
        found.bind(folded(name)).fetch_optional(&self.readers).await?.map(read).transpose()
    }

    async fn users(&self) -> Result<Vec<User>, StoreError> {
        let all = sqlx::query_as(concat!(select!(), "ORDER BY folded"));
        all.fetch_all(&self.readers).await?.into_iter().map(read).collect()
    }

    async fn change_user(&self, name: &str, change: UserChange) -> Result<bool, StoreError> {
        let write = UserWrite::Change(name.to_owned(), change);
        Ok(self.writer.write(Write::User(write)).await? > 0)
    }

    async fn remove_user(&self, name: &str) -> Result<bool, StoreError> {
        Ok(self.writer.write(Write::User(UserWrite::Remove(name.to_owned()))).await? > 0)
    }
}

/// Name, role, password, when they were added, and the roles of their groups.
type Row = (String, String, String, String, Option<String>);

fn read((name, role, password, created_at, of_groups): Row) -> Result<User, StoreError> {
    let role = Role::named(&role)
        .ok_or_else(|| StoreError::Damaged(format!("the user {name} has no known role")))?;
    let group_role = of_groups.map(|roles| most(Role::Viewer, Some(&roles))).transpose()?;
    Ok(User { name, role, group_role, password, created_at })
}

impl UserWrite {
    pub(super) async fn apply(&self, connection: &mut SqliteConnection) -> Result<u64, StoreError> {
        let query = match self {
            Self::Add(User { name, role, password, created_at, .. }) => sqlx::query(
                "INSERT INTO users (name, folded, role, password, created_at) VALUES (?, ?, ?, ?, ?)
                 ON CONFLICT (folded) DO NOTHING",
            )
            .bind(name)
            .bind(folded(name))
            .bind(role.name())
            .bind(password)
            .bind(created_at),
            Self::Change(name, UserChange::Role(role)) => {
                sqlx::query("UPDATE users SET role = ? WHERE folded = ?").bind(role.name()).bind(folded(name))
            }
            Self::Change(name, UserChange::Password(password)) => {
                let ended = "DELETE FROM passes WHERE user = (SELECT id FROM users WHERE folded = ?)";
                sqlx::query(ended).bind(folded(name)).execute(&mut *connection).await?;
                sqlx::query("UPDATE users SET password = ? WHERE folded = ?")
                    .bind(password)
                    .bind(folded(name))
            }
            Self::Remove(name) => {
                for sql in [
                    "DELETE FROM session_people WHERE person = ?",
                    "DELETE FROM comments_seen WHERE person = ?",
                    "UPDATE authors SET person = NULL WHERE person = ?",
                ] {
                    sqlx::query(sql).bind(person_of(name)).execute(&mut *connection).await?;
                }
                sqlx::query("DELETE FROM users WHERE folded = ?").bind(folded(name))
            }
        };
        Ok(query.execute(connection).await?.rows_affected())
    }
}
