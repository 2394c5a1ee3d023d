//! What is kept: sessions with their journals and snapshots, and the library of trees.
//!
//! [`Store`], [`Library`], [`Finding`], [`Passes`], [`Users`], [`Groups`], [`Gifts`], [`Audit`], [`Answers`], [`Comments`], [`Locks`], [`Standings`], [`Visits`] and [`Authors`] are the interface. Whatever implements it passes the tests of `contract.rs`; SQLite is the first that
//! does, the model in `memory.rs` the second. The rest of the server knows [`AnyStore`] alone.

mod answers;
mod any;
mod audit;
mod authors;
mod comments;
#[cfg(test)]
mod contract;
mod finding;
mod folding;
mod gifts;
mod groups;
mod lease;
mod library;
mod locks;
#[cfg(test)]
mod memory;
mod passes;
mod seal;
mod sqlite;
mod standings;
mod users;
mod visits;

use std::{collections::BTreeSet, error::Error, time::Duration};

use espalier_proto::Notice;
use espalier_session::JournalEntry;

pub use self::{
    answers::{Answer, AnswerKey, Answering, Answers, MostAnswers},
    any::AnyStore,
    audit::{Audit, DONE, EXPORT, Event, MOST_EVENTS, Noted},
    authors::Authors,
    comments::{
        CommentBytes, CommentChange, Comments, MOST_COMMENTS, MOST_THREADS, NewComment, StoredComment,
        StoredThread,
    },
    finding::{Collection, CollectionChange, Finding, Sort, TreePlace, TreeQuery},
    folding::folded,
    gifts::{Gift, Gifts, Given, Receiver},
    groups::{Group, GroupChange, Groups},
    lease::Lease,
    library::{
        Contents, Deletion, LONG_AGO, Library, NOT_SO_LONG_AGO, NewTree, NewVersion, Picture, Saved,
        SessionTree, StoredTree, StoredVersion, TreeChange, TreeDocument,
    },
    locks::Locks,
    passes::{Holder, Pass, PassKind, Passes},
    sqlite::{CareError, LibraryFile, OpenError, Report, SqliteStore, backup, check, restore},
    standings::{Heir, Removal, Removed, Room, Standing, Standings},
    users::{Terms, User, UserChange, Users, identity_of, person_of},
    visits::{LineTree, SessionLine, SessionPlace, SessionQuery, Visits},
};
#[cfg(test)]
pub use self::{
    contract::{Breakable, tree},
    memory::MemoryStore,
};

/// Snapshots kept of each session: the last one, and one before it should the last be damaged.
const KEPT_SNAPSHOTS: usize = 2;

/// Keeps sessions. What a call that writes has returned from is durable.
pub trait Store {
    /// Makes a session, which may start from a snapshot before its first entry.
    async fn create_session(&self, new: NewSession) -> Result<(), StoreError>;

    /// Counts a try to open a session, before it is begun; how many there were since [`Store::forget_tries`], this one
    /// included.
    async fn count_try(&self, lease: &Lease) -> Result<u32, StoreError>;

    /// The session was opened and lives: tries to open it count from none again.
    async fn forget_tries(&self, lease: &Lease) -> Result<(), StoreError>;

    /// Whether there is such a session.
    async fn has_session(&self, name: &str) -> Result<bool, StoreError>;

    /// Gives the right to write to a session, which nobody who had it before has any longer.
    async fn acquire(&self, session: &str) -> Result<Lease, StoreError>;

    /// Gives the right back.
    async fn release(&self, lease: Lease);

    /// Reads a session: its newest whole snapshot, or the newest whole one `before` an entry, with the whole
    /// entries that follow it. What is damaged is named, not read.
    async fn load_session(
        &self,
        name: &str,
        before: Option<u64>,
    ) -> Result<Option<StoredSession>, StoreError>;

    /// Puts damaged parts of a session aside, where they no longer count; nothing is deleted. What is whole before a
    /// damaged entry stays. At once it keeps notices, until [`Store::forget_notices`].
    async fn set_aside(&self, lease: &Lease, damage: &[Damage], notices: &[Notice])
    -> Result<(), StoreError>;

    /// Deletes the notices of a session, which somebody has received.
    async fn forget_notices(&self, lease: &Lease) -> Result<(), StoreError>;

    /// Writes entries that follow the last one, made under a version of the simulation.
    async fn append(
        &self,
        lease: &Lease,
        simulation_version: u32,
        entries: &[JournalEntry],
    ) -> Result<(), StoreError>;

    /// Keeps a snapshot, and drops the entries that no kept snapshot needs for its replay.
    async fn keep_snapshot(&self, lease: &Lease, snapshot: NewSnapshot) -> Result<(), StoreError>;

    /// Gives up for good so many sessions at most that nobody holds: those that are saved and that nobody has entered
    /// since a time, the others where nobody has since another. Times are as those of saved trees. Says how many.
    async fn purge_sessions(&self, saved: &str, unsaved: &str, limit: u32) -> Result<u64, StoreError>;

    /// Gives the medium some of what is deleted back, in a step that keeps nobody waiting; whether there is more.
    async fn shrink(&self) -> Result<bool, StoreError>;

    /// Whether what is written still gets where it was; else every write fails, and no session opens.
    async fn check_place(&self) -> Result<(), StoreError>;

    /// Finishes what is being written; every later write fails.
    async fn close(&self);
}

/// Why something could not be read or written. Causes go to the log; a client reads a sentence made for people.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// The medium failed.
    #[error("{cause}")]
    Failed {
        /// Half a sentence for users, without internal details.
        words: &'static str,
        /// What the medium said.
        cause: Box<dyn Error + Send + Sync>,
    },
    /// What was read is not what was once written.
    #[error("{0}")]
    Damaged(String),
    /// A newer program wrote it, in a form that this one does not know.
    #[error("{0}")]
    Later(String),
    /// Another holder has acquired the right to write to this session.
    #[error("the session has been taken over")]
    Fenced,
    /// An entry that does not follow the last one.
    #[error("entry {found} was to be written after entry {last}")]
    OutOfOrder {
        /// The last entry there is.
        last: u64,
        /// The one that was to follow.
        found: u64,
    },
    /// What is asked for, or was to be named, is not there.
    #[error("there is no such {}", .0.field())]
    NotFound(Missing),
    /// A tree is at another revision than was expected.
    #[error("the tree has changed meanwhile")]
    Stale,
    /// A tree was to be taken back, or deleted for good, that is not deleted.
    #[error("the tree is not deleted")]
    NotDeleted,
    /// A collection was to lie in itself.
    #[error("a collection cannot lie in itself")]
    Cycle,
    /// There is no room for more of this.
    #[error("there is no room for more of this")]
    Full,
    /// Somebody goes by the name already.
    #[error("somebody goes by that name already")]
    Taken,
    /// Nobody would be an administrator.
    #[error("nobody else is an administrator")]
    LastAdmin,
    /// What is written would be lost: where it went is not there any more.
    #[error("the database file has been moved, deleted or replaced ({0})")]
    Gone(String),
    /// The store has been closed; the server is stopping.
    #[error("the store is closed")]
    Closed,
}

/// What is not there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Missing {
    /// A tree, or it is deleted.
    Tree,
    /// A version of a tree that is there.
    Version,
    /// A collection.
    Collection,
    /// The collection in which another one was to lie.
    Parent,
    /// Somebody who logs in.
    User,
    /// A group of those.
    Group,
    /// What a token was made by.
    Pass,
}

impl Missing {
    /// The field by which requests name it.
    pub fn field(self) -> &'static str {
        match self {
            Self::Tree => "tree",
            Self::Version => "version",
            Self::Collection => "collection",
            Self::Parent => "parent",
            Self::User => "name",
            Self::Group => "group",
            Self::Pass => "pass",
        }
    }
}

/// What [`StoreError::in_words`] says where the disk is.
const FULL_DISK: &str = "the disk is full";

impl StoreError {
    /// Whether there is no room on the disk.
    pub fn is_full_disk(&self) -> bool {
        matches!(self, Self::Failed { words, .. } if *words == FULL_DISK)
    }

    /// What can be told to a client: half a sentence.
    pub fn in_words(&self) -> &'static str {
        match self {
            Self::Failed { words, .. } => words,
            Self::Damaged(_) => "its database is damaged",
            Self::Later(_) => "a newer program wrote to its database",
            Self::Fenced | Self::OutOfOrder { .. } => "the session has been taken over",
            Self::NotFound(_) => "it is not there",
            Self::Stale => "it has changed meanwhile",
            Self::NotDeleted => "the tree is not deleted",
            Self::Cycle => "a collection cannot lie in itself",
            Self::Full => "there is no room for more of this",
            Self::Taken => "somebody goes by that name already",
            Self::LastAdmin => "nobody else is an administrator",
            Self::Gone(_) => "its database file has been moved, deleted or replaced",
            Self::Closed => "it is stopping",
        }
    }
}

/// What a store has committed since it was opened.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Commits {
    /// Transactions.
    pub commits: u64,
    /// What was to be written in them.
    pub writes: u64,
    /// What could not be written.
    pub failed: u64,
    /// How long they took together.
    pub took: Duration,
}

/// A session to be made.
#[derive(Clone, Debug, Default)]
pub struct NewSession {
    /// Its name.
    pub name: String,
    /// The seed of all its randomness.
    pub seed: u32,
    /// The version of the simulation it is made by.
    pub simulation_version: u32,
    /// Its state before the first entry.
    pub snapshot: Option<Vec<u8>>,
    /// Who begins it.
    pub principal: Option<String>,
    /// As whom they were let in.
    pub person: Option<String>,
    /// Living metamers in the snapshot.
    pub metamers: u32,
    /// The tree that it belongs to, and the version that it begins with.
    pub tree: Option<(String, u32)>,
    /// Whether people work on the tree in another session, into which whoever opens it is led as before.
    pub is_beside: bool,
}

/// A snapshot to be kept.
#[derive(Clone, Debug)]
pub struct NewSnapshot {
    /// The last entry it contains.
    pub through: u64,
    /// The version of the simulation it is made by.
    pub simulation_version: u32,
    /// The state after that entry.
    pub bytes: Vec<u8>,
    /// Living metamers in it.
    pub metamers: u32,
}

/// A session as it is read back.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StoredSession {
    /// The seed of all its randomness.
    pub seed: u32,
    /// A snapshot; none if the session started from its seed and has none yet.
    pub snapshot: Option<Vec<u8>>,
    /// The last entry that snapshot contains.
    pub through: u64,
    /// The entries after that snapshot.
    pub entries: Vec<JournalEntry>,
    /// The versions of the simulation that the entries were made by.
    pub simulations: BTreeSet<u32>,
    /// What of it is damaged or missing.
    pub damage: Vec<Damage>,
    /// What nobody has been notified of yet.
    pub notices: Vec<Notice>,
    /// The version of the program that wrote to it last, if it is known.
    pub written_by: Option<String>,
}

/// A part of a session that is not what was once written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Damage {
    /// The snapshot that contains entries up to this one.
    Snapshot(u64),
    /// The journal from this entry on: it is damaged or missing, and what follows does not count without it.
    Journal(u64),
}

impl Damage {
    /// The last entry of the snapshot, if it is one.
    fn snapshot(self) -> Option<u64> {
        match self {
            Self::Snapshot(through) => Some(through),
            Self::Journal(_) => None,
        }
    }
}
