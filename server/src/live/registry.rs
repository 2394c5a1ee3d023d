//! All sessions that are in memory, each loaded at most once at a time.

use std::{
    collections::BTreeMap,
    sync::{Arc, Mutex, MutexGuard, PoisonError, Weak},
};

use espalier_proto::Notice;
use espalier_session::{DocumentError, RestoreError, Session};
use tokio::{
    sync::{OnceCell, OwnedSemaphorePermit, Semaphore},
    time::Instant,
};
use tokio_util::{sync::CancellationToken, task::TaskTracker};

use super::actor::{Actor, Services, SessionHandle};
use crate::{
    SIMULATION_VERSION,
    pool::{Panicked, SimulationPool},
    store::{AnyStore, Damage, Lease, Store, StoreError, StoredSession},
};

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
    /// A newer program made it.
    #[error(
        "A newer Espalier made this tree (simulation {found}; this one has {SIMULATION_VERSION}): update the server."
    )]
    Newer {
        /// The version of the simulation it was made with.
        found: u32,
    },
    /// A newer program wrote its snapshot, in a way that this one cannot read.
    #[error("A newer Espalier made this tree ({0}): update the server.")]
    Later(String),
    /// Restoring it panicked.
    #[error("The session cannot be restored: {0}.")]
    Panicked(#[from] Panicked),
    /// The server is stopping.
    #[error("The server is stopping.")]
    Stopping,
}

impl OpenError {
    /// Whether asking again is of no use.
    pub fn is_final(&self) -> bool {
        !matches!(self, Self::Store(_) | Self::Stopping)
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

impl From<StoreError> for OpenError {
    fn from(error: StoreError) -> Self {
        match error {
            StoreError::Damaged(what) => Self::Damaged(what),
            error => Self::Store(error),
        }
    }
}

/// Sockets at a time, over all sessions.
const MAX_SOCKETS: usize = 1024;

type Slot = OnceCell<SessionHandle>;

/// The sessions in memory.
#[derive(Clone, Debug)]
pub struct Sessions(Arc<Inner>);

#[derive(Debug)]
struct Inner {
    services: Services,
    slots: Mutex<BTreeMap<String, Arc<Slot>>>,
    /// Sessions and their sockets.
    tasks: TaskTracker,
    places: Arc<Semaphore>,
}

impl Sessions {
    /// None are loaded yet. When `stop` is cancelled all of them end.
    pub fn new(store: Arc<AnyStore>, pool: SimulationPool, stop: CancellationToken) -> Self {
        let services = Services { store, pool, stop, started: Instant::now() };
        Self(Arc::new(Inner {
            services,
            slots: Mutex::default(),
            tasks: TaskTracker::new(),
            places: Arc::new(Semaphore::new(MAX_SOCKETS)),
        }))
    }

    /// The session of this name, loaded if need be; nothing if there is none.
    pub async fn open(&self, name: &str) -> Result<Option<SessionHandle>, OpenError> {
        loop {
            if self.0.services.stop.is_cancelled() {
                return Err(OpenError::Stopping);
            }
            let slot = Arc::clone(self.0.slots().entry(name.to_owned()).or_default());
            match slot.get_or_try_init(|| self.load(name, &slot)).await {
                Ok(session) if !session.is_ended() => return Ok(Some(session.clone())),
                Ok(session) => session.gone.cancelled().await,
                Err(unloaded) => {
                    self.forget(name, slot);
                    return match unloaded {
                        Unloaded::Unknown => Ok(None),
                        Unloaded::Error(error) => Err(error),
                    };
                }
            }
        }
    }

    /// A place for one more socket, if there is any left.
    pub fn place(&self) -> Option<OwnedSemaphorePermit> {
        Arc::clone(&self.0.places).try_acquire_owned().ok()
    }

    /// Runs a socket; when the server stops, this is waited for as well.
    pub async fn run_socket(&self, place: OwnedSemaphorePermit, socket: impl Future<Output = ()>) {
        self.0.tasks.track_future(socket).await;
        drop(place);
    }

    /// Waits until every session and socket has ended, which they do once the server stops.
    pub async fn ended(&self) {
        self.0.tasks.close();
        self.0.tasks.wait().await;
    }

    async fn load(&self, name: &str, slot: &Arc<Slot>) -> Result<SessionHandle, Unloaded> {
        let Inner { services, tasks, .. } = &*self.0;
        let lease = services.store.acquire(name).await?;
        let session = match restored(services, name, &lease).await {
            Ok(session) => session,
            Err(unloaded) => {
                services.store.release(lease).await;
                return Err(unloaded);
            }
        };
        let (actor, handle) = Actor::new(name.to_owned(), session, lease, services.clone());
        let place = Place {
            sessions: Arc::downgrade(&self.0),
            name: name.to_owned(),
            slot: Arc::downgrade(slot),
            gone: handle.gone.clone(),
        };
        tasks.spawn(async move {
            let _place = place;
            actor.run().await;
        });
        Ok(handle)
    }

    /// Drops an empty slot unless somebody else is about to fill it.
    fn forget(&self, name: &str, slot: Arc<Slot>) {
        let mut slots = self.0.slots();
        // Slots are handed out under this lock only, so two holders are the map and us.
        if Arc::strong_count(&slot) == 2 && !slot.initialized() {
            slots.remove(name);
        }
    }
}

/// Restores a session from its newest snapshot, or from the one before if that is of no use.
async fn restored(services: &Services, name: &str, lease: &Lease) -> Result<Session, Unloaded> {
    let stored = services.store.load_session(name, None).await?.ok_or(Unloaded::Unknown)?;
    let (through, passed_over) = (stored.through, stored.damage.clone());
    match restore(services, name, lease, stored).await? {
        Ok(session) => Ok(session),
        // Going on from an older snapshot would grow another tree than the newer program did.
        Err(error @ RestoreError::Document(DocumentError::Later(_))) => Err(error.into()),
        Err(error) => {
            tracing::error!(session = name, %error, "the newest snapshot is of no use; trying the one before");
            // The first error is the one that tells.
            let Ok(Some(mut older)) = services.store.load_session(name, Some(through)).await else {
                return Err(error.into());
            };
            // Its row is what was written, but nothing can be made of it.
            older.damage.push(Damage::Snapshot(through));
            older
                .damage
                .extend(passed_over.into_iter().filter(|damage| matches!(damage, Damage::Snapshot(_))));
            Ok(restore(services, name, lease, older).await?.map_err(|_| error)?)
        }
    }
}

/// Makes a session of what was read of it, and puts aside what was damaged; nothing of that is done in silence.
async fn restore(
    services: &Services,
    name: &str,
    lease: &Lease,
    stored: StoredSession,
) -> Result<Result<Session, RestoreError>, Unloaded> {
    if stored.newest_version > SIMULATION_VERSION {
        return Err(OpenError::Newer { found: stored.newest_version }.into());
    }
    let last = stored.through + stored.entries.len() as u64;
    tracing::info!(session = name, entries = stored.entries.len(), last, "loading");
    let notices = notices(&stored);
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
    let StoredSession { seed, snapshot, entries, damage, .. } = stored;
    let epoch = rand::random();
    let made = services.pool.run({
        let name = name.to_owned();
        move || Session::restore(name, epoch, snapshot.as_deref(), seed, entries)
    });
    let mut session = match made.await? {
        Ok(session) => session,
        Err(error) => return Ok(Err(error)),
    };
    if !damage.is_empty() {
        services.store.set_aside(lease, &damage).await?;
    }
    if !notices.is_empty() {
        session.notify(notices);
    }
    Ok(Ok(session))
}

/// What everybody who comes into the session is notified of.
fn notices(stored: &StoredSession) -> Vec<Notice> {
    let older = stored.oldest_entries.filter(|&version| version < SIMULATION_VERSION);
    let regrown = older.map(|from| Notice::Regrown { from, to: SIMULATION_VERSION });
    let lost = stored.damage.iter().filter_map(|damage| match *damage {
        Damage::Journal(entry) => Some(Notice::Damaged { entry }),
        // What it contained has been done again.
        Damage::Snapshot(_) => None,
    });
    regrown.into_iter().chain(lost).collect()
}

impl Inner {
    fn slots(&self) -> MutexGuard<'_, BTreeMap<String, Arc<Slot>>> {
        self.slots.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A live session's place among the others, given up even if its actor panics.
struct Place {
    sessions: Weak<Inner>,
    name: String,
    slot: Weak<Slot>,
    gone: CancellationToken,
}

impl Drop for Place {
    fn drop(&mut self) {
        if let Some(sessions) = self.sessions.upgrade() {
            let mut slots = sessions.slots();
            if slots.get(&self.name).is_some_and(|slot| std::ptr::eq(Arc::as_ptr(slot), self.slot.as_ptr())) {
                slots.remove(&self.name);
            }
        }
        self.gone.cancel();
    }
}

/// Why there is no handle.
enum Unloaded {
    Unknown,
    Error(OpenError),
}

impl<E: Into<OpenError>> From<E> for Unloaded {
    fn from(error: E) -> Self {
        Self::Error(error.into())
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use espalier_proto::{ServerMessage, version::CloseCode};
    use espalier_session::{ClientId, Document, JournalEntry, Principal};
    use tokio::time::timeout;

    use super::{
        super::{
            actor::{DocumentBytes, Request},
            outbox::{self, Outgoing, Outgoings},
        },
        *,
    };
    use crate::store::{MemoryStore, NewSession, NewSnapshot};

    const HELLO: &str = r#"{"type":"hello","protocol":1,"client":"test-client"}"#;

    struct House {
        store: Arc<AnyStore>,
        stop: CancellationToken,
        sessions: Sessions,
    }

    impl House {
        async fn new() -> Self {
            let house = Self::at(Arc::new(AnyStore::Memory(MemoryStore::default())));
            house.begin("oak", SIMULATION_VERSION, None).await;
            house
        }

        fn at(store: Arc<AnyStore>) -> Self {
            let stop = CancellationToken::new();
            let sessions =
                Sessions::new(Arc::clone(&store), SimulationPool::new(None).unwrap(), stop.clone());
            Self { store, stop, sessions }
        }

        async fn begin(&self, name: &str, simulation_version: u32, snapshot: Option<Vec<u8>>) {
            let new = NewSession { name: name.into(), seed: 7, simulation_version, snapshot };
            self.store.create_session(new).await.unwrap();
        }

        async fn restarted(self) -> Self {
            self.stop.cancel();
            self.sessions.ended().await;
            Self::at(self.store)
        }

        async fn visit(&self) -> Visitor {
            self.visit_to("oak").await
        }

        async fn visit_to(&self, name: &str) -> Visitor {
            let session = self.sessions.open(name).await.unwrap().unwrap();
            let (outbox, outgoings) = outbox::lane();
            let client = session.join(outbox).await.unwrap();
            let mut visitor = Visitor { session, client, outgoings };
            visitor.say(HELLO).await;
            visitor
        }
    }

    /// A client without a socket.
    struct Visitor {
        session: SessionHandle,
        client: ClientId,
        outgoings: Outgoings,
    }

    impl Visitor {
        async fn say(&mut self, text: &str) {
            self.session.send(Request::Text(self.client, text.into())).await.unwrap();
        }

        async fn grow(&mut self, id: u32) {
            self.say(&format!(r#"{{"type":"command","id":{id},"command":{{"kind":"grow","steps":3}}}}"#))
                .await;
        }

        /// The next control message that `pick` takes.
        async fn hear<T>(&mut self, pick: impl Fn(ServerMessage) -> Option<T>) -> T {
            let picked = async {
                loop {
                    if let Outgoing::Text(text) = self.outgoings.lane.recv().await.unwrap()
                        && let Some(picked) = pick(serde_json::from_str(&text).unwrap())
                    {
                        return picked;
                    }
                }
            };
            timeout(Duration::from_secs(20), picked).await.unwrap()
        }

        async fn acknowledged(&mut self) -> u32 {
            self.hear(|message| match message {
                ServerMessage::Acknowledged { id } => Some(id),
                _ => None,
            })
            .await
        }

        /// The document when this step is reached.
        async fn reached(&self, step: u32) -> DocumentBytes {
            loop {
                let document = self.session.read().await.unwrap();
                if Document::from_bytes(&document.bytes).unwrap().figures().step == step {
                    return document;
                }
            }
        }

        /// Epoch, acknowledged command and living metamers of the welcome.
        async fn welcome(&mut self) -> (u32, u32, u32) {
            self.hear(|message| match message {
                ServerMessage::Welcome { epoch, acknowledged, state, .. } => {
                    Some((epoch, acknowledged, state.metamers))
                }
                _ => None,
            })
            .await
        }

        async fn close_code(&self) -> CloseCode {
            timeout(Duration::from_secs(20), self.outgoings.closing.decided()).await.unwrap();
            self.outgoings.closing.farewell().code
        }
    }

    #[tokio::test]
    async fn an_unknown_session_leaves_no_trace() {
        let house = House::new().await;
        assert!(house.sessions.open("elm").await.unwrap().is_none());
        assert!(house.sessions.0.slots().is_empty());
    }

    #[tokio::test]
    async fn many_who_come_at_once_meet_in_one_session() {
        let house = House::new().await;
        let visits: Vec<_> = std::iter::repeat_with(|| house.visit()).take(8).collect();
        let mut epochs = Vec::new();
        for mut visitor in futures_util::future::join_all(visits).await {
            epochs.push(visitor.welcome().await.0);
        }
        assert!(epochs.iter().all(|&epoch| epoch == epochs[0]), "{epochs:?}");
    }

    #[tokio::test]
    async fn cm2_acknowledged_commands_survive_a_restart() {
        let house = House::new().await;
        let mut visitor = house.visit().await;
        let (epoch, ..) = visitor.welcome().await;
        visitor.grow(1).await;
        visitor.grow(2).await;
        while visitor.acknowledged().await < 2 {}
        let before = visitor.reached(6).await;
        assert!(before.metamers > 0);

        let house = house.restarted().await;
        let mut visitor = house.visit().await;
        let (epoch_after, acknowledged, metamers) = visitor.welcome().await;
        assert_ne!(epoch_after, epoch, "RS2");
        assert_eq!((acknowledged, metamers), (2, before.metamers));
        assert_eq!(visitor.session.read().await.unwrap().bytes, before.bytes);
    }

    fn grown(number: u64) -> JournalEntry {
        let command = r#"{"kind":"grow","steps":2}"#.into();
        let principal = Principal::client("test-client").unwrap();
        JournalEntry { number, principal, id: number as u32, command }
    }

    #[tokio::test]
    async fn a_damaged_snapshot_falls_back_to_the_one_before() {
        let house = House::new().await;
        let mut visitor = house.visit().await;
        visitor.grow(1).await;
        visitor.acknowledged().await;
        let tree = visitor.reached(3).await;

        let start = Session::first_snapshot(&tree.bytes, 1_000_000).unwrap();
        house.begin("elm", SIMULATION_VERSION, Some(start)).await;
        let lease = house.store.acquire("elm").await.unwrap();
        house.store.append(&lease, SIMULATION_VERSION, &[grown(1)]).await.unwrap();
        // Its checksum is right, and still it is no snapshot.
        let (simulation_version, bytes) = (SIMULATION_VERSION, b"damaged".to_vec());
        let damaged = NewSnapshot { through: 1, simulation_version, bytes };
        house.store.keep_snapshot(&lease, damaged).await.unwrap();
        let (_, acknowledged, metamers) = house.visit_to("elm").await.welcome().await;
        assert_eq!(acknowledged, 1);
        assert!(metamers > tree.metamers, "the tree it began with, grown on");
        let stored = house.store.load_session("elm", None).await.unwrap().unwrap();
        assert_ne!(stored.snapshot.as_deref(), Some(b"damaged".as_slice()), "it is put aside");
    }

    #[tokio::test]
    async fn a_session_without_a_sound_snapshot_is_not_invented() {
        let house = House::new().await;
        house.begin("elm", SIMULATION_VERSION, Some(b"damaged".to_vec())).await;
        let error = house.sessions.open("elm").await.unwrap_err();
        assert!(matches!(error, OpenError::Restore(RestoreError::Damaged)) && error.is_final(), "{error}");
        assert!(house.sessions.0.slots().is_empty());
    }

    #[tokio::test]
    async fn op1_a_session_of_a_newer_program_stays_closed() {
        let house = House::new().await;
        house.begin("elm", SIMULATION_VERSION + 1, None).await;
        let error = house.sessions.open("elm").await.unwrap_err();
        assert!(error.is_final());
        let words = format!("simulation {}; this one has {SIMULATION_VERSION}", SIMULATION_VERSION + 1);
        assert!(error.to_string().contains(&words), "{error}");
        assert!(error.to_string().len() <= 123, "it fits into the reason of a close");
    }

    #[tokio::test]
    async fn op1_a_snapshot_in_a_newer_format_is_not_passed_over() {
        let house = House::new().await;
        let start = Session::seedling(7, 1_000_000);
        house.begin("elm", SIMULATION_VERSION, Some(start.clone())).await;
        let lease = house.store.acquire("elm").await.unwrap();
        house.store.append(&lease, SIMULATION_VERSION, &[grown(1)]).await.unwrap();
        let mut bytes = start;
        // The container's format follows eight bytes of magic.
        bytes[8] = 99;
        let newer = NewSnapshot { through: 1, simulation_version: SIMULATION_VERSION, bytes };
        house.store.keep_snapshot(&lease, newer).await.unwrap();
        let error = house.sessions.open("elm").await.unwrap_err();
        assert!(matches!(error, OpenError::Later(_)) && error.is_final(), "{error}");
    }

    #[tokio::test]
    async fn op2_op3_an_older_journal_is_done_again_and_said_once() {
        let house = House::new().await;
        house.begin("elm", SIMULATION_VERSION - 1, Some(Session::seedling(7, 1_000_000))).await;
        let lease = house.store.acquire("elm").await.unwrap();
        house.store.append(&lease, SIMULATION_VERSION - 1, &[grown(1)]).await.unwrap();
        let notified = |message| match message {
            ServerMessage::Notice { notice } => Some(notice),
            _ => None,
        };
        let mut visitor = house.visit_to("elm").await;
        let regrown = Notice::Regrown { from: SIMULATION_VERSION - 1, to: SIMULATION_VERSION };
        assert_eq!(visitor.hear(notified).await, regrown);
        assert!(visitor.session.read().await.unwrap().metamers > 1);
        // The snapshot that is made at once leaves nothing to be said the next time.
        let house = house.restarted().await;
        let stored = house.store.load_session("elm", None).await.unwrap().unwrap();
        assert_eq!((stored.through, stored.oldest_entries), (1, None));
        let mut visitor = house.visit_to("elm").await;
        visitor.welcome().await;
        visitor.say(r#"{"type":"ping","nonce":5}"#).await;
        let pong = |message| match message {
            ServerMessage::Notice { notice } => panic!("{notice:?}"),
            ServerMessage::Pong { nonce } => Some(nonce),
            _ => None,
        };
        assert_eq!(visitor.hear(pong).await, 5);
    }

    #[tokio::test]
    async fn a_clean_stop_leaves_nothing_to_replay() {
        let house = House::new().await;
        let mut visitor = house.visit().await;
        visitor.grow(1).await;
        visitor.grow(2).await;
        while visitor.acknowledged().await < 2 {}
        let before = visitor.reached(6).await;
        let house = house.restarted().await;
        let stored = house.store.load_session("oak", None).await.unwrap().unwrap();
        assert_eq!((stored.through, stored.entries.len()), (2, 0));
        let visitor = house.visit().await;
        assert_eq!(visitor.session.read().await.unwrap().bytes, before.bytes);
    }

    #[tokio::test]
    async fn a_stopping_server_says_goodbye() {
        let house = House::new().await;
        let visitor = house.visit().await;
        house.stop.cancel();
        assert_eq!(visitor.close_code().await, CloseCode::GoingAway);
        house.sessions.ended().await;
        assert!(matches!(house.sessions.open("oak").await, Err(OpenError::Stopping)));
    }

    #[tokio::test]
    async fn cm2_nothing_is_acknowledged_that_was_not_written() {
        let house = House::new().await;
        let mut visitor = house.visit().await;
        let (epoch, ..) = visitor.welcome().await;
        // From here on every write fails, as on a full disk.
        house.store.close().await;
        visitor.grow(1).await;
        assert_eq!(visitor.close_code().await, CloseCode::InternalError);
        while let Ok(outgoing) = visitor.outgoings.lane.try_recv() {
            let Outgoing::Text(text) = outgoing else { continue };
            assert!(!text.contains("\"type\":\"acknowledged\""), "{text}");
        }
        // Whoever comes now meets the session as it is on disk.
        let mut visitor = house.visit().await;
        let (epoch_after, acknowledged, metamers) = visitor.welcome().await;
        assert_ne!(epoch_after, epoch);
        assert_eq!((acknowledged, metamers), (0, 0));
    }
}
