//! What goes into a session and what comes out: the whole boundary of the state machine.

use std::sync::Arc;

use espalier_proto::{Command, PlacedObstacle, Problem, access::Role, version::CloseCode};
use glam::Vec3;

use crate::{
    document::Anchor, entrant::Entrant, prediction::PredictionRun, principal::Principal, work::Work,
};

/// Names one connection; the shell numbers them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ClientId(pub u64);

/// Names one request for the document's bytes; the shell numbers them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReadId(pub u64);

/// Names one command from outside; the shell numbers them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ActId(pub u64);

/// Names one question for a place on the wood; the shell numbers them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AnchorId(pub u64);

/// Where a thread of comments is pinned.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// The thread.
    pub thread: u32,
    /// How the place is found again.
    pub anchor: Anchor,
    /// Where it was.
    pub at: Vec3,
}

/// What somebody is called who has done something.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Named {
    /// As journals and lines of time know them.
    pub author: Principal,
    /// As the server knows them, if it still does (see [`crate::Entrant`]).
    pub person: Option<Arc<str>>,
    /// What they were called last.
    pub name: Arc<str>,
}

/// Something happened.
#[derive(Debug)]
pub enum Input {
    /// A socket opened, of this person.
    Connected(ClientId, Entrant),
    /// The person at a socket may do what this role may, from now on.
    Granted(ClientId, Role),
    /// A socket showed that somebody is there, by other means than a message.
    Heard(ClientId),
    /// A text message came.
    Text(ClientId, String),
    /// A binary message came; there are none from clients, so it is answered with a problem.
    Binary(ClientId),
    /// A socket is gone; not needed after `Output::Close`, but harmless.
    Disconnected(ClientId),
    /// So many more of this client's `Output::Text`s have been handed to its socket.
    /// A client with 1,024 of them outstanding is closed (`FL3`), so report each one or in small batches.
    Written(ClientId, usize),
    /// Journal entries up to this number are durable.
    Journaled(u64),
    /// The journal could not be written; nothing after the last `Journaled` is durable.
    /// The document may already hold what was lost, so the session ends itself: every socket is closed with
    /// 1011 and [`crate::Session::has_failed`] turns true. Drop it, and restore it from disk for the next socket.
    JournalFailed(String),
    /// A piece of work came back from the simulation pool.
    Worked(Box<Work>),
    /// A prediction is done.
    Predicted(Box<PredictionRun>),
    /// Someone outside wants the document as it is (to save it, to export it).
    Read(ReadId),
    /// Someone outside who may edit wants something done (an uploaded mesh placed).
    Act(ActId, Principal, Entrant, Box<Command>),
    /// The time asked for by `WakeAt` has come.
    Woken,
    /// The snapshot through this entry is kept.
    SnapshotKept(u64),
    /// A snapshot could not be kept. What it was to contain must be replayed, and another one is made soon.
    SnapshotFailed,
    /// The session is to be put away: growth ends as by `stop`, nobody waits for predictions any more, and as soon as
    /// all commands are done there is a snapshot that contains them.
    /// It can be dropped when nothing it asked for is under way any more.
    Stopping,
    /// An owner wants that to be done which the server did not outlive (`OP5`).
    GoOn,
    /// Somebody wants to pin a comment to a row.
    Anchor(AnchorId, u32),
    /// What people say of the tree has changed.
    Commented {
        /// All that is pinned somewhere.
        places: Vec<Place>,
        /// The threads that have changed.
        threads: Vec<u32>,
    },
}

/// Something to do.
#[derive(Debug)]
pub enum Output {
    /// Send a control message.
    Text(ClientId, Arc<str>),
    /// Send a mesh delta.
    Frame(ClientId, Arc<[u8]>),
    /// Send a frame of presence, when nothing else waits for this client.
    Volatile(ClientId, Arc<[u8]>),
    /// Ask a socket whether somebody is there; answer with `Heard` when they are.
    Ping(ClientId),
    /// Close a socket; a sentence for people goes with the code. The session has forgotten the client already.
    Close(ClientId, CloseCode, String),
    /// Write these entries; answer with `Journaled` or `JournalFailed`. There is one batch on the way at a time.
    Journal(Vec<JournalEntry>),
    /// Run `work.run(..)` away from the network, then answer with `Worked`.
    Work(Box<Work>),
    /// Call `prediction.run(..)` away from the network, beside any `Work`, until it says it is done; then answer with
    /// `Predicted`.
    Predict(Box<PredictionRun>),
    /// Keep this snapshot; answer with `SnapshotKept` or `SnapshotFailed`. Once it is kept, entries up to `through` need
    /// no replay any more. There is one on the way at a time.
    Snapshot {
        /// The last journal entry it contains.
        through: u64,
        /// The session as bytes, for [`crate::Session::restore`].
        bytes: Vec<u8>,
    },
    /// Somebody has received the notices of [`crate::Session::notify`]: they need not be kept any longer.
    Notified,
    /// Keep what an author is called, for [`crate::Session::remember`].
    Named(Named),
    /// The document's bytes for a `Read`.
    Document {
        /// Whose answer this is.
        read: ReadId,
        /// The document.
        document: ReadDocument,
    },
    /// What became of an `Act`: done and durable, with the obstacle it placed if it placed one, or refused.
    Acted {
        /// Whose answer this is.
        act: ActId,
        /// What came of it.
        outcome: Result<Option<PlacedObstacle>, Problem>,
    },
    /// The place of a row for an `Anchor`; nothing where no living metamer has it.
    Anchored(AnchorId, Option<Anchor>),
    /// Answer with `Woken` at this time, in milliseconds of the clock handed to `handle`.
    /// A later `WakeAt` takes the place of an earlier one.
    WakeAt(u64),
}

/// The document between two commands, with what lists tell of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReadDocument {
    /// For [`crate::Document::from_bytes`].
    pub bytes: Vec<u8>,
    /// Living metamers.
    pub metamers: u32,
    /// The species whose programme it grows by.
    pub species: Option<String>,
    /// The last journal entry in it.
    pub through: u64,
}

/// One line of the journal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct JournalEntry {
    /// 1, 2, 3 … within the session.
    pub number: u64,
    /// Who it is done for.
    pub principal: Principal,
    /// The client's number for it; 0 where the session acts in a client's place (`CM5`).
    pub id: u32,
    /// The command as JSON.
    pub command: String,
}
