//! What people say of trees.

use super::{Picture, StoreError};

/// Threads that a tree may have.
pub const MOST_THREADS: u32 = 1_000;
/// Comments that a thread may have, the deleted ones included.
pub const MOST_COMMENTS: u32 = 200;
/// Bytes of pictures that the comments of a tree may have.
pub const MOST_PICTURES: u64 = 64 * 1024 * 1024;
/// Bytes of all else that they say, as JSON: words, and lines that were drawn.
pub const MOST_SAID: u64 = 64 * 1024 * 1024;

/// Keeps threads of comments. Where there is no such tree it is [`StoreError::NotFound`], where there is no room for
/// another [`StoreError::Full`]. A thread without comments is not there.
pub trait Comments {
    /// Begins a thread; says its number.
    async fn add_thread(&self, tree: &str, pin: Option<String>, first: NewComment)
    -> Result<u32, StoreError>;

    /// Adds a comment to a thread and says its number; nothing where there is no such thread.
    async fn add_comment(
        &self,
        tree: &str,
        thread: u32,
        comment: NewComment,
    ) -> Result<Option<u32>, StoreError>;

    /// Gives a comment other words, if there is room for more of them, or deletes it; whether it was there.
    async fn change_comment(
        &self,
        tree: &str,
        thread: u32,
        comment: u32,
        change: CommentChange,
    ) -> Result<bool, StoreError>;

    /// Somebody says at a time that a thread is done, or nobody does any more; whether it is there.
    async fn resolve_thread(
        &self,
        tree: &str,
        thread: u32,
        resolved: Option<(String, String)>,
    ) -> Result<bool, StoreError>;

    /// So many threads of a tree, newest first; those before a number, if one is given.
    async fn threads(
        &self,
        tree: &str,
        limit: u32,
        before: Option<u32>,
    ) -> Result<Vec<StoredThread>, StoreError>;

    /// One thread.
    async fn thread(&self, tree: &str, thread: u32) -> Result<Option<StoredThread>, StoreError>;

    /// How much the comments of a tree hold.
    async fn comment_bytes(&self, tree: &str) -> Result<CommentBytes, StoreError>;

    /// The pins of all threads of a tree that have one, by their numbers.
    async fn pins(&self, tree: &str) -> Result<Vec<(u32, String)>, StoreError>;

    /// The picture of a comment, if it has one.
    async fn comment_picture(
        &self,
        tree: &str,
        thread: u32,
        comment: u32,
    ) -> Result<Option<Picture>, StoreError>;

    /// Somebody has seen a thread up to a comment; whether it is there.
    async fn see_thread(
        &self,
        tree: &str,
        person: &str,
        thread: u32,
        comment: u32,
    ) -> Result<bool, StoreError>;

    /// What somebody has seen of the threads of a tree: the newest comment of each.
    async fn seen_threads(&self, tree: &str, person: &str) -> Result<Vec<(u32, u32)>, StoreError>;
}

/// A comment to be kept.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NewComment {
    /// Who writes it, as the server knows them.
    pub person: String,
    /// What they are called.
    pub author: String,
    /// When.
    pub written_at: String,
    /// What they say, as JSON.
    pub said: String,
    /// What they saw.
    pub picture: Option<Picture>,
}

/// What comments hold, in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CommentBytes {
    /// What they say, as JSON.
    pub said: u64,
    /// Their pictures.
    pub pictures: u64,
}

impl CommentBytes {
    /// Fails where there is no room for so much more.
    pub(super) fn require_room(self, more: Self) -> Result<(), StoreError> {
        let is_full = |held: u64, more: u64, most: u64| more > 0 && held.saturating_add(more) > most;
        if is_full(self.said, more.said, MOST_SAID) || is_full(self.pictures, more.pictures, MOST_PICTURES) {
            return Err(StoreError::Full);
        }
        Ok(())
    }
}

impl NewComment {
    pub(super) fn bytes(&self) -> CommentBytes {
        let pictures = self.picture.as_ref().map_or(0, |picture| picture.bytes.len() as u64);
        CommentBytes { said: self.said.len() as u64, pictures }
    }
}

/// What becomes of a comment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CommentChange {
    /// It says something else from a time on.
    Edited {
        /// As JSON.
        said: String,
        /// When.
        at: String,
    },
    /// It is deleted, with its picture; its number is never given again.
    Deleted,
}

/// A thread as it is kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StoredThread {
    /// Its number on the tree.
    pub number: u32,
    /// Where it is pinned, as JSON.
    pub pin: Option<String>,
    /// Who has said that it is done, and when.
    pub resolved: Option<(String, String)>,
    /// Those that are there, in order.
    pub comments: Vec<StoredComment>,
}

/// A comment as it is kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StoredComment {
    /// Its number in the thread.
    pub number: u32,
    /// Who wrote it, as the server knows them.
    pub person: String,
    /// What they are called.
    pub author: String,
    /// When.
    pub written_at: String,
    /// When it was changed last.
    pub edited_at: Option<String>,
    /// What it says, as JSON.
    pub said: String,
    /// Whether it has a picture.
    pub has_picture: bool,
}
