//! Restoring a session from what is stored of it: which snapshot, what was damaged, what people are notified of.

use espalier_proto::{Notice, Problem, Reason};
use espalier_session::{DocumentError, JournalEntry, RestoreError, Restoring, Session, Tail, Urgency};

use super::{actor::Services, handle::Ended, loading::Progress, readers::Unread};
use crate::{
    SIMULATION_VERSION,
    memory::{self, Full, Growing, Use},
    pool::{Class, Panicked},
    store::{Damage, Lease, Store, StoreError, StoredSession},
};

/// After so many tries that came to no end what the journal holds waits, or where it holds nothing the whole session
/// (`OP5`).
const MOST_TRIES: u32 = 2;

/// The share of a snapshot in the time that it takes to load a session, where entries follow: nobody knows before how
/// long those take.
const SNAPSHOT_SHARE: f32 = 0.5;

/// A session exists but cannot be opened.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// Reading failed.
    #[error("The session cannot be read: {0}.")]
    Store(#[source] StoreError),
    /// Nothing of it that a tree could be made from is whole.
    #[error("The session is damaged: {0}.")]
    Damaged(String),
    /// What was read is not a session.
    #[error("The session cannot be restored: {0}.")]
    Restore(#[source] RestoreError),
    /// A newer program wrote its snapshot, its journal or a saved tree, in a way that this one cannot read.
    #[error("A newer Espalier made this tree ({0}): update the server.")]
    Later(String),
    /// Restoring it panicked.
    #[error("The session cannot be restored: {0}.")]
    Panicked(#[from] Panicked),
    /// The server did not outlive it, though its journal holds nothing that could wait.
    #[error(
        "The server failed twice while it opened this session; it is kept, and an owner lets it be tried again."
    )]
    Waits,
    /// There is no memory for it.
    #[error("The server has no memory left to open this now; it is tried again.")]
    Memory(#[from] Full),
    /// It has left the memory meanwhile.
    #[error("The session has just ended; it is tried again.")]
    Ended,
    /// The server is stopping.
    #[error("The server is stopping.")]
    Stopping,
}

/// A session that was opened, and what was taken of memory for it.
#[derive(Debug)]
pub(super) struct Opened {
    pub(super) session: Session,
    pub(super) room: Growing,
    /// Whether the store counts that it was tried.
    pub(super) is_counted: bool,
}

impl OpenError {
    /// Whether an older snapshot may serve. Going on from one would grow another tree than a newer program did.
    fn is_of_snapshot(&self) -> bool {
        matches!(self, Self::Restore(_) | Self::Panicked(_))
    }

    /// The same for clients.
    pub fn problem(&self) -> Problem {
        let reason = match self {
            Self::Store(_) => Reason::NotOpened,
            Self::Damaged(_) | Self::Restore(_) | Self::Panicked(_) => Reason::SessionDamaged,
            Self::Later(_) => Reason::NewerProgram,
            Self::Waits => Reason::SessionWaits,
            Self::Memory(_) => Reason::MemoryFull,
            Self::Ended => Reason::SessionEnded,
            Self::Stopping => Reason::Stopping,
        };
        Problem::new(reason, self.to_string())
    }

    /// Whether asking again is of no use.
    pub fn is_final(&self) -> bool {
        !matches!(self, Self::Store(_) | Self::Memory(_) | Self::Ended | Self::Stopping)
    }
}

impl From<RestoreError> for OpenError {
    fn from(error: RestoreError) -> Self {
        match error {
            RestoreError::Document(DocumentError::Later(what)) => Self::Later(what),
            error => Self::Restore(error),
        }
    }
}

impl From<Unread> for OpenError {
    fn from(error: Unread) -> Self {
        match error {
            Unread::Ended => Self::Ended,
            Unread::Memory(full) => Self::Memory(full),
        }
    }
}

impl From<Ended> for OpenError {
    fn from(Ended: Ended) -> Self {
        Self::Ended
    }
}

impl From<StoreError> for OpenError {
    fn from(error: StoreError) -> Self {
        match error {
            StoreError::Damaged(what) => Self::Damaged(what),
            StoreError::Later(what) => Self::Later(what),
            error => Self::Store(error),
        }
    }
}

/// Begins a session with its name, epoch, snapshot, seed and entries.
pub(super) type Begin =
    fn(String, u32, Option<&[u8]>, u32, Vec<JournalEntry>, Tail) -> Result<Restoring, RestoreError>;

/// Restores a session, if there is one, from its newest snapshot, or from the one before if that is of no use.
pub(super) async fn restored(
    services: &Services,
    name: &str,
    lease: &Lease,
    progress: &Progress,
) -> Result<Option<Opened>, OpenError> {
    let begin: Begin = |name, epoch, snapshot, seed, entries, tail| {
        Restoring::new(name, epoch, snapshot, seed, entries, tail)
    };
    restored_by(begin, services, name, lease, progress).await
}

pub(super) async fn restored_by(
    begin: Begin,
    services: &Services,
    name: &str,
    lease: &Lease,
    progress: &Progress,
) -> Result<Option<Opened>, OpenError> {
    if !services.store.has_session(name).await? {
        return Ok(None);
    }
    progress.begun();
    let Some(stored) = services.store.load_session(name, None).await? else { return Ok(None) };
    progress.read();
    let (through, passed_over) = (stored.through, stored.damage.clone());
    let error = match restore(begin, services, name, lease, stored, progress).await {
        Err(error) if error.is_of_snapshot() => error,
        restored => return restored.map(Some),
    };
    tracing::error!(session = name, %error, "the newest snapshot is of no use; trying the one before");
    // The error of the newest snapshot is the one to report.
    let Ok(Some(mut older)) = services.store.load_session(name, Some(through)).await else {
        return Err(error);
    };
    // The checksum of its row is right, but no session can be made of it.
    older.damage.push(Damage::Snapshot(through));
    older.damage.extend(passed_over.into_iter().filter(|damage| matches!(damage, Damage::Snapshot(_))));
    let older = restore(begin, services, name, lease, older, progress);
    older.await.map(Some).map_err(|_| error)
}

/// Counts that the session is tried to be opened; how often it was.
async fn tries(services: &Services, name: &str, lease: &Lease, stored: &StoredSession) -> u32 {
    // Durable before it is begun. On a full disk a session opens all the same.
    let tries = services.store.count_try(lease).await.unwrap_or_else(|error| {
        tracing::warn!(%error, session = name, "that the session is opened is not counted");
        0
    });
    if tries > MOST_TRIES {
        let entries = stored.entries.len();
        tracing::error!(
            session = name,
            entries,
            tries = tries - 1,
            "opening this session was tried and never came to an end; what its journal holds, or where that is nothing the session, rests until an owner lets it go on"
        );
    }
    tries
}

/// Makes a session of what was read of it, sets aside what was damaged, and logs that.
async fn restore(
    begin: Begin,
    services: &Services,
    name: &str,
    lease: &Lease,
    stored: StoredSession,
    progress: &Progress,
) -> Result<Opened, OpenError> {
    let last = stored.through + stored.entries.len() as u64;
    let fresh = notices(&stored);
    for damage in &stored.damage {
        match damage {
            Damage::Snapshot(entry) => {
                tracing::error!(session = name, entry, "the snapshot after an entry is damaged")
            }
            Damage::Journal(entry) => {
                tracing::error!(session = name, entry, "the journal is damaged from an entry on")
            }
        }
    }
    let epoch = rand::random();
    let kept = stored.snapshot.as_ref().map_or(0, Vec::len);
    let bytes = kept + stored.entries.iter().map(|entry| entry.command.len()).sum::<usize>();
    let room = Growing::new(services.memory.take_soon(Use::Session, memory::restore(bytes)).await?);
    // It is tried only where there is memory for it.
    let tries = tries(services, name, lease, &stored).await;
    tracing::info!(session = name, entries = stored.entries.len(), last, "loading");
    let waits = tries > MOST_TRIES;
    if waits && stored.entries.is_empty() {
        return Err(OpenError::Waits);
    }
    let StoredSession { seed, snapshot, entries, damage, notices, written_by, .. } = stored;
    let follow = entries.len();
    let begun = services.pool.run(Class::Whole, name.into(), {
        let name = name.to_owned();
        let tail = if waits { Tail::Waits } else { Tail::Follows };
        move |_| begin(name, epoch, snapshot.as_deref(), seed, entries, tail)
    });
    let begun = begun.await?.map_err(|error| match error {
        // Its row is sealed, so this is what was written.
        RestoreError::Entry { number, problem } => {
            tracing::error!(session = name, number, %problem, "an entry of the journal cannot be read");
            let program = written_by.unwrap_or_else(|| "a later one".into());
            OpenError::Later(format!("its entry {number} is of version {program}"))
        }
        error => error.into(),
    });
    let followed = match begun {
        Ok(restoring) => followed(services, name, restoring, follow, &room, progress).await,
        Err(error) => Err(error),
    };
    if followed.as_ref().is_err_and(|error| !matches!(error, OpenError::Panicked(_)))
        && let Err(error) = services.store.forget_tries(lease).await
    {
        tracing::warn!(%error, session = name, "what the server outlived counts as if it had not");
    }
    let mut session = followed?;
    if !damage.is_empty() || !fresh.is_empty() {
        services.store.set_aside(lease, &damage, &fresh).await?;
    }
    let mut all = notices;
    all.extend(fresh.into_iter().filter(|notice| !all.contains(notice)).collect::<Vec<_>>());
    if !all.is_empty() {
        session.notify(all);
    }
    Ok(Opened { session, room, is_counted: tries > 0 })
}

/// Does what the journal holds behind the snapshot, slice by slice, so that others have their turns between and a server
/// that stops need not wait for it.
async fn followed(
    services: &Services,
    name: &str,
    mut restoring: Restoring,
    follow: usize,
    room: &Growing,
    progress: &Progress,
) -> Result<Session, OpenError> {
    let mut goes_on = follow > 0;
    progress.made(if goes_on { SNAPSHOT_SHARE } else { 1.0 });
    while goes_on {
        if services.stop.is_cancelled() {
            return Err(OpenError::Stopping);
        }
        let room = room.clone();
        // It is as much somebody's as a tree that grows while they look on.
        let slice = services.pool.run(Class::Growing, name.into(), move |turn| {
            let goes_on =
                restoring.follow(|| turn.is_over(), &mut |rows, _| room.has_room(rows, Urgency::Keeping));
            (restoring, goes_on)
        });
        (restoring, goes_on) = slice.await?;
        let done = 1.0 - restoring.to_follow() as f32 / follow as f32;
        progress.made(SNAPSHOT_SHARE + (1.0 - SNAPSHOT_SHARE) * done);
    }
    Ok(services.pool.run(Class::Whole, name.into(), move |_| restoring.session()).await?)
}

/// What everybody who comes into the session is notified of.
fn notices(stored: &StoredSession) -> Vec<Notice> {
    let other = stored.simulations.iter().find(|&&version| version != SIMULATION_VERSION);
    let regrown = other.map(|&from| Notice::Regrown { from, to: SIMULATION_VERSION });
    let lost = stored.damage.iter().filter_map(|damage| match *damage {
        Damage::Journal(entry) => Some(Notice::Damaged { entry }),
        // What it contained has been done again.
        Damage::Snapshot(_) => None,
    });
    regrown.into_iter().chain(lost).collect()
}
