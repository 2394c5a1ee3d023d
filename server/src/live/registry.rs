//! All sessions that are in memory, each loaded at most once at a time.

use std::{
    collections::BTreeMap,
    sync::{Arc, Mutex, MutexGuard, PoisonError, Weak},
};

use espalier_session::{RestoreError, Session};
use tokio::{
    sync::{OnceCell, OwnedSemaphorePermit, Semaphore},
    time::Instant,
};
use tokio_util::{sync::CancellationToken, task::TaskTracker};

use super::actor::{Actor, SessionHandle, Surroundings};
use crate::{
    database::{Database, DatabaseError},
    pool::{Panicked, SimulationPool},
};

/// A session exists but cannot be opened.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// Reading failed.
    #[error("the session cannot be read: {0}")]
    Database(#[from] DatabaseError),
    /// What was read is not a session.
    #[error("the session cannot be restored: {0}")]
    Restore(#[from] RestoreError),
    /// It would grow into another plant now.
    #[error("the session was made with version {found} of the simulation; this is version {current}")]
    OtherSimulation {
        /// The version it was made with.
        found: u32,
        /// The version of this program.
        current: u32,
    },
    /// Restoring it panicked.
    #[error("the session cannot be restored: {0}")]
    Panicked(#[from] Panicked),
    /// The server is stopping.
    #[error("the server is stopping")]
    Stopping,
}

/// Sockets at a time, over all sessions.
const MAX_SOCKETS: usize = 1024;

type Slot = OnceCell<SessionHandle>;

/// The sessions in memory.
#[derive(Clone, Debug)]
pub struct Sessions(Arc<Inner>);

#[derive(Debug)]
struct Inner {
    around: Surroundings,
    slots: Mutex<BTreeMap<String, Arc<Slot>>>,
    /// Sessions and their sockets.
    tasks: TaskTracker,
    places: Arc<Semaphore>,
}

impl Sessions {
    /// None are loaded yet. When `stop` is cancelled all of them end.
    pub fn new(database: Arc<Database>, pool: SimulationPool, stop: CancellationToken) -> Self {
        let around = Surroundings { database, pool, stop, started: Instant::now() };
        Self(Arc::new(Inner {
            around,
            slots: Mutex::default(),
            tasks: TaskTracker::new(),
            places: Arc::new(Semaphore::new(MAX_SOCKETS)),
        }))
    }

    /// The session of this name, loaded if need be; nothing if there is none.
    pub async fn open(&self, name: &str) -> Result<Option<SessionHandle>, OpenError> {
        loop {
            if self.0.around.stop.is_cancelled() {
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
        let Inner { around, tasks, .. } = &*self.0;
        let session = match restore(around, name, 0).await? {
            Ok(session) => session,
            Err(error) => {
                tracing::error!(session = name, %error, "the newest snapshot is of no use; trying the one before");
                match restore(around, name, 1).await {
                    Ok(Ok(session)) => session,
                    // The first error is the one that tells.
                    _ => return Err(OpenError::from(error).into()),
                }
            }
        };
        let (actor, handle) = Actor::new(name.to_owned(), session, around.clone());
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

/// Restores a session from its newest snapshot but so many.
async fn restore(
    around: &Surroundings,
    name: &str,
    damaged: u32,
) -> Result<Result<Session, RestoreError>, Unloaded> {
    let stored = around.database.load_session(name, damaged).await.map_err(OpenError::from)?;
    let stored = stored.ok_or(Unloaded::Unknown)?;
    let current = crate::SIMULATION_VERSION;
    if stored.simulation_version != current {
        return Err(OpenError::OtherSimulation { found: stored.simulation_version, current }.into());
    }
    tracing::info!(session = name, entries = stored.entries.len(), last = stored.last, "loading");
    let epoch = rand::random();
    let restored = around.pool.run({
        let name = name.to_owned();
        move || Session::restore(name, epoch, stored.snapshot.as_deref(), stored.seed, stored.entries)
    });
    Ok(restored.await.map_err(OpenError::from)?)
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
    use espalier_session::{ClientId, JournalEntry};
    use tokio::time::timeout;

    use super::{
        super::{
            actor::Request,
            outbox::{self, Outgoing, Outgoings},
        },
        *,
    };
    use crate::{SIMULATION_VERSION, database::Folder};

    const HELLO: &str = r#"{"type":"hello","protocol":1,"client":"test-client"}"#;

    struct House {
        folder: Folder,
        database: Arc<Database>,
        stop: CancellationToken,
        sessions: Sessions,
    }

    impl House {
        async fn new() -> Self {
            let house = Self::at(Folder::new()).await;
            house.database.create_session("oak".into(), 7, SIMULATION_VERSION, None).await.unwrap();
            house
        }

        async fn at(folder: Folder) -> Self {
            let database = Arc::new(Database::open(&folder.database()).await.unwrap());
            let stop = CancellationToken::new();
            let sessions =
                Sessions::new(Arc::clone(&database), SimulationPool::new(None).unwrap(), stop.clone());
            Self { folder, database, stop, sessions }
        }

        async fn restarted(self) -> Self {
            self.stop.cancel();
            self.sessions.ended().await;
            self.database.close().await;
            Self::at(self.folder).await
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
        let before = visitor.session.read().await.unwrap();
        assert!(before.metamers > 0);

        let house = house.restarted().await;
        let mut visitor = house.visit().await;
        let (epoch_after, acknowledged, metamers) = visitor.welcome().await;
        assert_ne!(epoch_after, epoch, "RS2");
        assert_eq!((acknowledged, metamers), (2, before.metamers));
        assert_eq!(visitor.session.read().await.unwrap().bytes, before.bytes);
    }

    #[tokio::test]
    async fn a_damaged_snapshot_falls_back_to_the_one_before() {
        let house = House::new().await;
        let mut visitor = house.visit().await;
        visitor.grow(1).await;
        visitor.acknowledged().await;
        let tree = visitor.session.read().await.unwrap();

        let start = Session::first_snapshot(&tree.bytes, 1_000_000).unwrap();
        house.database.create_session("elm".into(), 7, SIMULATION_VERSION, Some(start)).await.unwrap();
        let command = r#"{"kind":"grow","steps":2}"#.into();
        let entry = JournalEntry { number: 1, client: "test-client".into(), id: 1, command };
        house.database.append_journal("elm".into(), &[entry]).await.unwrap();
        house.database.keep_snapshot("elm".into(), 1, b"damaged".to_vec()).await.unwrap();
        let (_, acknowledged, metamers) = house.visit_to("elm").await.welcome().await;
        assert_eq!(acknowledged, 1);
        assert!(metamers > tree.metamers, "the tree it began with, grown on");
    }

    #[tokio::test]
    async fn a_session_without_a_sound_snapshot_is_not_invented() {
        let house = House::new().await;
        let damaged = Some(b"damaged".to_vec());
        house.database.create_session("elm".into(), 7, SIMULATION_VERSION, damaged).await.unwrap();
        assert!(matches!(house.sessions.open("elm").await, Err(OpenError::Restore(RestoreError::Damaged))));
        assert!(house.sessions.0.slots().is_empty());
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
        house.database.refuse_writes().await;
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
