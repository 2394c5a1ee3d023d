//! Users in SQLite.

use espalier_proto::access::Role;
use sqlx::sqlite::SqliteConnection;

use super::{
    super::{
        StoreError, Terms, User, UserChange, Users,
        folding::folded,
        identity_of, person_of,
        users::{mentioning_instead, person_removed},
    },
    SqliteStore,
    groups::{most, stale},
    writer::Write,
};

#[derive(Debug)]
pub(super) enum UserWrite {
    Add(User),
    Change(String, UserChange, Terms),
    Remove(String, Terms),
}

macro_rules! select {
    () => {
        "SELECT key, name, role, password, created_at, revision,
         (SELECT group_concat(studios.role) FROM studio_members
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

    async fn change_user(&self, id: &str, change: UserChange, terms: Terms) -> Result<bool, StoreError> {
        let write = UserWrite::Change(id.to_owned(), change, terms);
        Ok(self.writer.write(Write::User(write)).await? > 0)
    }

    async fn remove_user(&self, id: &str, terms: Terms) -> Result<bool, StoreError> {
        Ok(self.writer.write(Write::User(UserWrite::Remove(id.to_owned(), terms))).await? > 0)
    }
}

/// Identifier, name, role, password, when they were added, revision, and the roles of their groups.
type Row = (String, String, String, String, String, i64, Option<String>);

fn read((id, name, role, password, created_at, revision, of_groups): Row) -> Result<User, StoreError> {
    let role = Role::named(&role)
        .ok_or_else(|| StoreError::Damaged(format!("the user {name} has no known role")))?;
    let group_role = of_groups.map(|roles| most(Role::None, Some(&roles))).transpose()?;
    let revision = revision.try_into().unwrap_or_default();
    Ok(User { id, name, role, group_role, password, created_at, revision })
}

impl UserWrite {
    pub(super) async fn apply(&self, connection: &mut SqliteConnection) -> Result<u64, StoreError> {
        match self {
            Self::Add(User { id, name, role, password, created_at, .. }) => {
                let added = sqlx::query(
                    "INSERT INTO users (key, name, folded, role, password, created_at) VALUES (?, ?, ?, ?, ?, ?)
                     ON CONFLICT (folded) DO NOTHING",
                );
                let added = added
                    .bind(id)
                    .bind(name)
                    .bind(folded(name))
                    .bind(role.name())
                    .bind(password)
                    .bind(created_at);
                Ok(added.execute(connection).await?.rows_affected())
            }
            Self::Change(id, change, terms) => {
                let Some(there) = Kept::find(connection, id).await? else { return Ok(0) };
                there.change(connection, change, *terms).await?;
                Ok(1)
            }
            Self::Remove(id, terms) => {
                let Some(there) = Kept::find(connection, id).await? else { return Ok(0) };
                there.check(connection, *terms, true).await?;
                let person = person_of(&there.name);
                for sql in [
                    "DELETE FROM session_people WHERE person = ?",
                    "DELETE FROM comments_seen WHERE person = ?",
                    // Nothing of theirs is left to whoever has the name after them.
                    "UPDATE trees SET owner_person = NULL, owner_name = NULL WHERE owner_person = ?",
                    "DELETE FROM favourites WHERE principal = ?",
                    "DELETE FROM removals WHERE person = ?",
                ] {
                    sqlx::query(sql).bind(&person).execute(&mut *connection).await?;
                }
                sqlx::query("UPDATE authors SET person = NULL WHERE person = ?")
                    .bind(identity_of(id))
                    .execute(&mut *connection)
                    .await?;
                count_for(connection, &person, &person_removed(id)).await?;
                let removed = sqlx::query("DELETE FROM users WHERE id = ?").bind(there.row);
                Ok(removed.execute(connection).await?.rows_affected())
            }
        }
    }
}

/// A user's row.
struct Kept {
    row: i64,
    name: String,
    is_admin: bool,
    revision: i64,
}

impl Kept {
    async fn find(connection: &mut SqliteConnection, id: &str) -> Result<Option<Self>, StoreError> {
        let found: Option<(i64, String, String, i64)> =
            sqlx::query_as("SELECT id, name, role, revision FROM users WHERE key = ?")
                .bind(id)
                .fetch_optional(connection)
                .await?;
        Ok(found.map(|(row, name, role, revision)| Self {
            row,
            name,
            is_admin: role == Role::Admin.name(),
            revision,
        }))
    }

    /// Whether they may be changed, who is perhaps no administrator afterwards.
    async fn check(
        &self,
        connection: &mut SqliteConnection,
        terms: Terms,
        stops: bool,
    ) -> Result<(), StoreError> {
        if stale(terms.expected, self.revision) {
            return Err(StoreError::Stale);
        }
        if terms.force || !stops || !self.is_admin {
            return Ok(());
        }
        let others: i64 = sqlx::query_scalar("SELECT count(*) FROM users WHERE role = ? AND id <> ?")
            .bind(Role::Admin.name())
            .bind(self.row)
            .fetch_one(connection)
            .await?;
        if others == 0 { Err(StoreError::LastAdmin) } else { Ok(()) }
    }

    async fn change(
        &self,
        connection: &mut SqliteConnection,
        change: &UserChange,
        terms: Terms,
    ) -> Result<(), StoreError> {
        let UserChange { name, role, password, stays } = change;
        self.check(connection, terms, role.is_some_and(|role| role != Role::Admin)).await?;
        if let Some(name) = name {
            self.rename(connection, name).await?;
        }
        if let Some(role) = role {
            let sql = "UPDATE users SET role = ? WHERE id = ?";
            sqlx::query(sql).bind(role.name()).bind(self.row).execute(&mut *connection).await?;
        }
        if let Some(password) = password {
            let sql = "DELETE FROM passes WHERE user = ? AND kind = 'login' AND hash IS NOT ?";
            let ended = sqlx::query(sql).bind(self.row).bind(stays.map(|hash| hash.to_vec()));
            ended.execute(&mut *connection).await?;
            let sql = "UPDATE users SET password = ? WHERE id = ?";
            sqlx::query(sql).bind(password).bind(self.row).execute(&mut *connection).await?;
        }
        let sql = "UPDATE users SET revision = revision + 1 WHERE id = ?";
        sqlx::query(sql).bind(self.row).execute(connection).await?;
        Ok(())
    }

    /// They are the same person under another name.
    async fn rename(&self, connection: &mut SqliteConnection, name: &str) -> Result<(), StoreError> {
        let other: Option<i64> = sqlx::query_scalar("SELECT id FROM users WHERE folded = ? AND id <> ?")
            .bind(folded(name))
            .bind(self.row)
            .fetch_optional(&mut *connection)
            .await?;
        if other.is_some() {
            return Err(StoreError::Taken);
        }
        let sql = "UPDATE users SET name = ?, folded = ? WHERE id = ?";
        let renamed = sqlx::query(sql).bind(name).bind(folded(name)).bind(self.row);
        renamed.execute(&mut *connection).await?;
        let (old, new) = (person_of(&self.name), person_of(name));
        if old == new {
            return Ok(());
        }
        for sql in [
            "UPDATE OR REPLACE session_people SET person = ?2 WHERE person = ?1",
            "UPDATE OR REPLACE comments_seen SET person = ?2 WHERE person = ?1",
            "UPDATE OR REPLACE favourites SET principal = ?2 WHERE principal = ?1",
            "UPDATE OR REPLACE removals SET person = ?2 WHERE person = ?1",
            "UPDATE trees SET owner_person = ?2 WHERE owner_person = ?1",
        ] {
            sqlx::query(sql).bind(&old).bind(&new).execute(&mut *connection).await?;
        }
        count_for(connection, &old, &new).await
    }
}

/// What somebody has saved and said, and where they are mentioned, counts for another person from now on.
async fn count_for(connection: &mut SqliteConnection, old: &str, new: &str) -> Result<(), StoreError> {
    for sql in [
        "UPDATE comments SET person = ?2 WHERE person = ?1",
        "UPDATE trees SET principal = ?2 WHERE principal = ?1",
        "UPDATE versions SET principal = ?2 WHERE principal = ?1",
    ] {
        sqlx::query(sql).bind(old).bind(new).execute(&mut *connection).await?;
    }
    let mentioning: Vec<(i64, i64, String)> =
        sqlx::query_as("SELECT thread, number, said FROM comments WHERE instr(said, ?) > 0")
            .bind(old)
            .fetch_all(&mut *connection)
            .await?;
    for (thread, number, said) in mentioning {
        let sql = "UPDATE comments SET said = ? WHERE thread = ? AND number = ?";
        let said = mentioning_instead(&said, old, new);
        sqlx::query(sql).bind(said).bind(thread).bind(number).execute(&mut *connection).await?;
    }
    Ok(())
}
