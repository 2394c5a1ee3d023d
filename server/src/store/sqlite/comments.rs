//! Comments in SQLite.

use sqlx::{SqlitePool, sqlite::SqliteConnection};

use super::{
    super::{
        CommentBytes, CommentChange, Comments, MOST_COMMENTS, MOST_THREADS, Missing, NewComment, Picture,
        StoreError, StoredComment, StoredThread,
    },
    SqliteStore,
    writer::Write,
};

#[derive(Debug)]
pub(super) enum CommentWrite {
    Begin { tree: String, pin: Option<String>, first: NewComment },
    Add { tree: String, thread: u32, comment: NewComment },
    Change { tree: String, thread: u32, comment: u32, change: CommentChange },
    Resolve { tree: String, thread: u32, resolved: Option<(String, String)> },
    See { tree: String, person: String, thread: u32, comment: u32 },
}

impl SqliteStore {
    async fn comment(&self, write: CommentWrite) -> Result<u64, StoreError> {
        self.writer.write(Write::Comment(write)).await
    }
}

impl Comments for SqliteStore {
    async fn add_thread(
        &self,
        tree: &str,
        pin: Option<String>,
        first: NewComment,
    ) -> Result<u32, StoreError> {
        let number = self.comment(CommentWrite::Begin { tree: tree.to_owned(), pin, first }).await?;
        Ok(u32::try_from(number).unwrap_or(u32::MAX))
    }

    async fn add_comment(
        &self,
        tree: &str,
        thread: u32,
        comment: NewComment,
    ) -> Result<Option<u32>, StoreError> {
        let number = self.comment(CommentWrite::Add { tree: tree.to_owned(), thread, comment }).await?;
        Ok(u32::try_from(number).ok().filter(|number| *number > 0))
    }

    async fn change_comment(
        &self,
        tree: &str,
        thread: u32,
        comment: u32,
        change: CommentChange,
    ) -> Result<bool, StoreError> {
        let tree = tree.to_owned();
        Ok(self.comment(CommentWrite::Change { tree, thread, comment, change }).await? > 0)
    }

    async fn resolve_thread(
        &self,
        tree: &str,
        thread: u32,
        resolved: Option<(String, String)>,
    ) -> Result<bool, StoreError> {
        let tree = tree.to_owned();
        Ok(self.comment(CommentWrite::Resolve { tree, thread, resolved }).await? > 0)
    }

    async fn threads(
        &self,
        tree: &str,
        limit: u32,
        before: Option<u32>,
    ) -> Result<Vec<StoredThread>, StoreError> {
        let rows: Vec<ThreadRow> = sqlx::query_as(
            "SELECT threads.id, threads.number, pin, resolved_by, resolved_at FROM threads
             JOIN trees ON trees.id = threads.tree
             WHERE key = ?1 AND threads.number < ?2 AND EXISTS (
                 SELECT 1 FROM comments WHERE thread = threads.id AND said IS NOT NULL)
             ORDER BY threads.number DESC LIMIT ?3",
        )
        .bind(tree)
        .bind(before.unwrap_or(u32::MAX))
        .bind(limit)
        .fetch_all(&self.readers)
        .await?;
        let mut threads = Vec::with_capacity(rows.len());
        for row in rows {
            threads.extend(read(&self.readers, row).await?);
        }
        Ok(threads)
    }

    async fn thread(&self, tree: &str, thread: u32) -> Result<Option<StoredThread>, StoreError> {
        let row: Option<ThreadRow> = sqlx::query_as(
            "SELECT threads.id, threads.number, pin, resolved_by, resolved_at FROM threads
             JOIN trees ON trees.id = threads.tree WHERE key = ? AND threads.number = ?",
        )
        .bind(tree)
        .bind(thread)
        .fetch_optional(&self.readers)
        .await?;
        match row {
            Some(row) => read(&self.readers, row).await,
            None => Ok(None),
        }
    }

    async fn comment_bytes(&self, tree: &str) -> Result<CommentBytes, StoreError> {
        let id: Option<i64> = sqlx::query_scalar("SELECT id FROM trees WHERE key = ?")
            .bind(tree)
            .fetch_optional(&self.readers)
            .await?;
        match id {
            Some(id) => held_by(&self.readers, id).await,
            None => Ok(CommentBytes::default()),
        }
    }

    async fn pins(&self, tree: &str) -> Result<Vec<(u32, String)>, StoreError> {
        let pins = sqlx::query_as(
            "SELECT threads.number, pin FROM threads JOIN trees ON trees.id = threads.tree
             WHERE key = ? AND pin IS NOT NULL AND EXISTS (
                 SELECT 1 FROM comments WHERE thread = threads.id AND said IS NOT NULL)
             ORDER BY threads.number",
        );
        Ok(pins.bind(tree).fetch_all(&self.readers).await?)
    }

    async fn comment_picture(
        &self,
        tree: &str,
        thread: u32,
        comment: u32,
    ) -> Result<Option<Picture>, StoreError> {
        let row: Option<(String, Vec<u8>)> = sqlx::query_as(
            "SELECT media_type, picture FROM comments JOIN threads ON threads.id = comments.thread
             JOIN trees ON trees.id = threads.tree
             WHERE key = ? AND threads.number = ? AND comments.number = ? AND picture IS NOT NULL",
        )
        .bind(tree)
        .bind(thread)
        .bind(comment)
        .fetch_optional(&self.readers)
        .await?;
        Ok(row.map(|(media_type, bytes)| Picture { media_type, bytes }))
    }

    async fn see_thread(
        &self,
        tree: &str,
        person: &str,
        thread: u32,
        comment: u32,
    ) -> Result<bool, StoreError> {
        let (tree, person) = (tree.to_owned(), person.to_owned());
        Ok(self.comment(CommentWrite::See { tree, person, thread, comment }).await? > 0)
    }

    async fn seen_threads(&self, tree: &str, person: &str) -> Result<Vec<(u32, u32)>, StoreError> {
        let seen = sqlx::query_as(
            "SELECT threads.number, seen FROM comments_seen JOIN threads ON threads.id = comments_seen.thread
             JOIN trees ON trees.id = threads.tree WHERE key = ? AND person = ? ORDER BY threads.number",
        );
        Ok(seen.bind(tree).bind(person).fetch_all(&self.readers).await?)
    }
}

/// Row, number, pin, by whom and when it was resolved.
type ThreadRow = (i64, u32, Option<String>, Option<String>, Option<String>);
/// Number, person, author, when it was written and changed, what it says, whether it has a picture.
type CommentRow = (u32, String, String, String, Option<String>, String, bool);

/// A thread with its comments; nothing where it has none.
async fn read(readers: &SqlitePool, row: ThreadRow) -> Result<Option<StoredThread>, StoreError> {
    let (id, number, pin, by, at) = row;
    let rows: Vec<CommentRow> = sqlx::query_as(
        "SELECT number, person, author, written_at, edited_at, said, picture IS NOT NULL FROM comments
         WHERE thread = ? AND said IS NOT NULL ORDER BY number",
    )
    .bind(id)
    .fetch_all(readers)
    .await?;
    let comments: Vec<StoredComment> = rows
        .into_iter()
        .map(|(number, person, author, written_at, edited_at, said, has_picture)| StoredComment {
            number,
            person,
            author,
            written_at,
            edited_at,
            said,
            has_picture,
        })
        .collect();
    let resolved = by.zip(at);
    Ok((!comments.is_empty()).then_some(StoredThread { number, pin, resolved, comments }))
}

impl CommentWrite {
    /// Answers with the number of what was made, or of the rows that changed.
    pub(super) async fn apply(&self, connection: &mut SqliteConnection) -> Result<u64, StoreError> {
        match self {
            Self::Begin { tree, pin, first } => {
                let tree = tree_id(connection, tree).await?;
                held_by(&mut *connection, tree).await?.require_room(first.bytes())?;
                let number: u32 =
                    sqlx::query_scalar("SELECT coalesce(max(number), 0) + 1 FROM threads WHERE tree = ?")
                        .bind(tree)
                        .fetch_one(&mut *connection)
                        .await?;
                if number > MOST_THREADS {
                    return Err(StoreError::Full);
                }
                let begun = sqlx::query("INSERT INTO threads (tree, number, pin) VALUES (?, ?, ?)");
                let begun = begun.bind(tree).bind(number).bind(pin).execute(&mut *connection).await?;
                insert(connection, begun.last_insert_rowid(), 1, first).await?;
                Ok(number.into())
            }
            Self::Add { tree, thread, comment } => {
                let tree = tree_id(connection, tree).await?;
                held_by(&mut *connection, tree).await?.require_room(comment.bytes())?;
                let found: Option<(i64, u32)> = sqlx::query_as(
                    "SELECT threads.id, max(comments.number) FROM threads JOIN comments ON thread = threads.id
                     WHERE tree = ? AND threads.number = ? GROUP BY threads.id HAVING count(said) > 0",
                )
                .bind(tree)
                .bind(thread)
                .fetch_optional(&mut *connection)
                .await?;
                let Some((id, last)) = found else { return Ok(0) };
                if last >= MOST_COMMENTS {
                    return Err(StoreError::Full);
                }
                insert(connection, id, last + 1, comment).await?;
                Ok(u64::from(last) + 1)
            }
            Self::Change { tree, thread, comment, change } => {
                let (said, at) = match change {
                    CommentChange::Edited { said, at } => {
                        require_room_for(connection, (tree, *thread, *comment), said).await?;
                        (Some(said), Some(at))
                    }
                    CommentChange::Deleted => (None, None),
                };
                let changed = sqlx::query(
                    "UPDATE comments SET said = ?1, edited_at = ?2,
                         media_type = iif(?1 IS NULL, NULL, media_type), picture = iif(?1 IS NULL, NULL, picture)
                     WHERE number = ?3 AND said IS NOT NULL AND thread = (
                         SELECT threads.id FROM threads JOIN trees ON trees.id = threads.tree
                         WHERE key = ?4 AND threads.number = ?5)",
                );
                let changed = changed.bind(said).bind(at).bind(comment).bind(tree).bind(thread);
                Ok(changed.execute(connection).await?.rows_affected())
            }
            Self::Resolve { tree, thread, resolved } => {
                let (by, at) = resolved.clone().unzip();
                let changed = sqlx::query(
                    "UPDATE threads SET resolved_by = ?1, resolved_at = ?2
                     WHERE number = ?3 AND tree = (SELECT id FROM trees WHERE key = ?4)
                     AND EXISTS (SELECT 1 FROM comments WHERE thread = threads.id AND said IS NOT NULL)",
                );
                let changed = changed.bind(by).bind(at).bind(thread).bind(tree);
                Ok(changed.execute(connection).await?.rows_affected())
            }
            Self::See { tree, person, thread, comment } => {
                let seen = sqlx::query(
                    "INSERT INTO comments_seen (thread, person, seen)
                     SELECT threads.id, ?1, min(?2, (SELECT max(number) FROM comments WHERE thread = threads.id))
                     FROM threads JOIN trees ON trees.id = threads.tree WHERE key = ?3 AND threads.number = ?4
                     AND EXISTS (SELECT 1 FROM comments WHERE thread = threads.id AND said IS NOT NULL)
                     ON CONFLICT (thread, person) DO UPDATE SET seen = max(seen, excluded.seen)",
                );
                let seen = seen.bind(person).bind(comment).bind(tree).bind(thread);
                Ok(seen.execute(connection).await?.rows_affected())
            }
        }
    }
}

async fn tree_id(connection: &mut SqliteConnection, key: &str) -> Result<i64, StoreError> {
    let found = sqlx::query_scalar("SELECT id FROM trees WHERE key = ?").bind(key);
    found.fetch_optional(connection).await?.ok_or(StoreError::NotFound(Missing::Tree))
}

/// What the comments of a tree hold. Nothing of it is read but how long it is.
async fn held_by<'a>(
    connection: impl sqlx::SqliteExecutor<'a>,
    tree: i64,
) -> Result<CommentBytes, StoreError> {
    let (said, pictures): (i64, i64) = sqlx::query_as(
        "SELECT coalesce(sum(octet_length(said)), 0), coalesce(sum(octet_length(picture)), 0)
         FROM comments JOIN threads ON threads.id = comments.thread WHERE tree = ?",
    )
    .bind(tree)
    .fetch_one(connection)
    .await?;
    let bytes = |sum: i64| u64::try_from(sum).unwrap_or(u64::MAX);
    Ok(CommentBytes { said: bytes(said), pictures: bytes(pictures) })
}

/// Fails where there is no room for a comment to say this.
async fn require_room_for(
    connection: &mut SqliteConnection,
    (tree, thread, comment): (&str, u32, u32),
    said: &str,
) -> Result<(), StoreError> {
    let found: Option<(i64, i64)> = sqlx::query_as(
        "SELECT threads.tree, octet_length(said) FROM comments JOIN threads ON threads.id = comments.thread
         JOIN trees ON trees.id = threads.tree
         WHERE key = ? AND threads.number = ? AND comments.number = ? AND said IS NOT NULL",
    )
    .bind(tree)
    .bind(thread)
    .bind(comment)
    .fetch_optional(&mut *connection)
    .await?;
    let Some((tree, before)) = found else { return Ok(()) };
    let more = (said.len() as u64).saturating_sub(u64::try_from(before).unwrap_or(0));
    held_by(connection, tree).await?.require_room(CommentBytes { said: more, pictures: 0 })
}

async fn insert(
    connection: &mut SqliteConnection,
    thread: i64,
    number: u32,
    new: &NewComment,
) -> Result<(), StoreError> {
    let NewComment { person, author, written_at, said, picture } = new;
    sqlx::query(
        "INSERT INTO comments (thread, number, person, author, written_at, said, media_type, picture)
         VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
    )
    .bind(thread)
    .bind(number)
    .bind(person)
    .bind(author)
    .bind(written_at)
    .bind(said)
    .bind(picture.as_ref().map(|picture| &picture.media_type))
    .bind(picture.as_ref().map(|picture| &picture.bytes))
    .execute(connection)
    .await?;
    Ok(())
}
