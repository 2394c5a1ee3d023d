//! The SQLite file: one writer that commits in groups, and readers beside it.

mod open;
mod sessions;
mod trees;
mod writer;

#[cfg(test)]
pub use open::tests::Folder;
pub use open::{Database, OpenError};
pub use trees::{NewTree, Picture, StoredTree};

/// Why a query or a write failed. The cause goes to the log; a client reads a sentence made for people.
#[derive(Debug, thiserror::Error)]
pub enum DatabaseError {
    /// SQLite said no.
    #[error("{0}")]
    Sqlite(#[from] sqlx::Error),
    /// What was read is not what was once written.
    #[error("{0}")]
    Damaged(String),
    /// The writer has ended; the server is stopping.
    #[error("the database is closed")]
    Closed,
}

impl DatabaseError {
    /// What can be told to a client: half a sentence, without anything about our insides.
    pub fn in_words(&self) -> &'static str {
        match self {
            Self::Sqlite(error) => in_words(error).unwrap_or("its database failed"),
            Self::Damaged(_) => "its database is damaged",
            Self::Closed => "it is stopping",
        }
    }
}

/// Sentences for the ways in which SQLite refuses, by its primary result code.
fn in_words(error: &sqlx::Error) -> Option<&'static str> {
    let sqlx::Error::Database(error) = error else { return None };
    let code: u32 = error.code()?.parse().ok()?;
    Some(match code & 0xff {
        5 | 6 => "another program holds it locked",
        8 => "it is read-only",
        10 => "the disk cannot be read or written",
        11 => "it is damaged",
        13 => "the disk is full",
        14 => "it cannot be opened; does the folder exist, and may you write there?",
        23 => "access to it is denied",
        26 => "it is not a database",
        _ => return None,
    })
}
