//! Names of authors in SQLite.

use espalier_session::{Named, Principal};
use sqlx::sqlite::SqliteConnection;

use super::{
    super::{Authors, StoreError},
    SqliteStore,
    writer::Write,
};

/// What somebody is called, and since when.
#[derive(Debug)]
pub(super) struct AuthorWrite(Named, String);

impl Authors for SqliteStore {
    async fn name_author(&self, named: &Named, at: &str) -> Result<(), StoreError> {
        self.writer.write(Write::Author(AuthorWrite(named.clone(), at.to_owned()))).await.map(drop)
    }

    async fn named_authors(&self, authors: &[Principal]) -> Result<Vec<Named>, StoreError> {
        let mut all = Vec::new();
        for author in authors {
            let found: Option<(String, Option<String>, String)> =
                sqlx::query_as("SELECT named_at, person, name FROM authors WHERE author = ?")
                    .bind(author.name())
                    .fetch_optional(&self.readers)
                    .await?;
            all.extend(found.map(|(at, person, name)| {
                let (author, person, name) = (author.clone(), person.map(Into::into), name.into());
                (at, Named { author, person, name })
            }));
        }
        all.sort_by(|(one, _), (other, _)| one.cmp(other));
        Ok(all.into_iter().map(|(_, named)| named).collect())
    }
}

impl AuthorWrite {
    pub(super) async fn apply(&self, connection: &mut SqliteConnection) -> Result<u64, StoreError> {
        let Self(Named { author, person, name }, at) = self;
        let write = sqlx::query(
            "INSERT INTO authors (author, person, name, named_at) VALUES (?, ?, ?, ?) ON CONFLICT (author)
             DO UPDATE SET person = excluded.person, name = excluded.name, named_at = excluded.named_at",
        );
        let write = write.bind(author.name()).bind(person.as_deref()).bind(&**name).bind(at);
        Ok(write.execute(connection).await?.rows_affected())
    }
}
