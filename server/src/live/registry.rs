//! All sessions that are in memory, each loaded at most once at a time.

use std::{
    collections::BTreeMap,
    net::IpAddr,
    sync::{
        Arc, Mutex, MutexGuard, PoisonError, Weak,
        atomic::{AtomicBool, Ordering},
    },
    time::Duration,
};

use espalier_proto::comment::Pin;
use espalier_session::{Place as Pinned, Principal, Session};
use futures_util::future::join_all;
use tokio::{
    sync::OnceCell,
    time::{Instant, timeout},
};
use tokio_util::{sync::CancellationToken, task::TaskTracker};

use super::{
    actor::{Actor, Services},
    handle::{PersonHere, PersonNamed, SessionFigures, SessionHandle},
    keeping::Keeping,
    loading::{Opening, Progress},
    restoring::{self, OpenError, Opened},
};
use crate::{
    memory::{Growing, Memory},
    places::{self, Places},
    pool::SimulationPool,
    store::{AnyStore, Lease, Store, StoreError},
};

/// Sockets at a time, over all sessions,
const MAX_SOCKETS: usize = 4096;
/// and those of one network, but for this machine.
const MAX_SOCKETS_OF_ONE: usize = 256;

/// A session that says nothing of itself for so long is being opened, or has ended.
const LOOKING: Duration = Duration::from_secs(1);

/// A session's place in memory.
#[derive(Debug, Default)]
struct Slot {
    session: OnceCell<SessionHandle>,
    /// How far it is loaded.
    progress: Progress,
    /// Whether tries of before do not count.
    is_anew: AtomicBool,
}

/// A session in memory.
#[derive(Clone, Debug)]
pub struct Looked {
    /// Its name.
    pub name: String,
    /// Its figures, where it answers.
    pub figures: Option<SessionFigures>,
}

/// The sessions in memory.
#[derive(Clone, Debug)]
pub struct Sessions(Arc<Inner>);

#[derive(Debug)]
struct Inner {
    services: Services,
    slots: Mutex<BTreeMap<String, Arc<Slot>>>,
    /// Sessions and their sockets.
    tasks: TaskTracker,
    places: Places,
}

impl Sessions {
    /// None are loaded yet. When `stop` is cancelled all of them end.
    pub fn new(store: Arc<AnyStore>, pool: SimulationPool, memory: Memory, stop: CancellationToken) -> Self {
        let services = Services { store, pool, memory, stop, started: Instant::now() };
        Self(Arc::new(Inner {
            services,
            slots: Mutex::default(),
            tasks: TaskTracker::new(),
            places: Places::new(MAX_SOCKETS, MAX_SOCKETS_OF_ONE),
        }))
    }

    /// The session of this name, loaded if need be; nothing if there is none.
    pub async fn open(&self, name: &str) -> Result<Option<SessionHandle>, OpenError> {
        self.opening(name).opened().await
    }

    /// The same of one that the server did not outlive ([`OpenError::Waits`]), which is tried as if it had never been.
    pub async fn open_anew(&self, name: &str) -> Result<Option<SessionHandle>, OpenError> {
        self.slot(name).is_anew.store(true, Ordering::Relaxed);
        self.open(name).await
    }

    /// The same, with how far it is.
    pub(super) fn opening(&self, name: &str) -> Opening {
        let (sessions, name) = (self.clone(), name.to_owned());
        let slot = self.slot(&name);
        let share = slot.session.get().is_none().then(|| slot.progress.watched());
        // Whoever asks may give up. What is being loaded is loaded all the same: dropped half-way, it would leave its
        // lease and its slot behind.
        let opened = self.0.tasks.spawn(async move { sessions.open_to_the_end(&name, slot).await });
        Opening::new(opened, share)
    }

    fn slot(&self, name: &str) -> Arc<Slot> {
        Arc::clone(self.0.slots().entry(name.to_owned()).or_default())
    }

    async fn open_to_the_end(
        &self,
        name: &str,
        mut slot: Arc<Slot>,
    ) -> Result<Option<SessionHandle>, OpenError> {
        loop {
            if self.0.services.stop.is_cancelled() {
                self.forget(name, slot);
                return Err(OpenError::Stopping);
            }
            match slot.session.get_or_try_init(|| self.load(name, &slot)).await {
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
            slot = self.slot(name);
        }
    }

    /// Puts a session that was just begun and kept into memory, for whoever comes next, so that it need not be read
    /// again. It leaves soon if nobody does.
    pub async fn seat(&self, name: &str, session: Session, room: Growing) {
        let slot = self.slot(name);
        let seated = slot.session.get_or_try_init(|| async {
            let lease = self.0.services.store.acquire(name).await?;
            Ok::<_, StoreError>(self.start(name, &slot, Opened { session, room, is_counted: false }, lease))
        });
        if let Err(error) = seated.await {
            // Whoever comes loads it, or hears why not.
            tracing::warn!(session = name, %error, "a new session was not put into memory");
            self.forget(name, slot);
        }
    }

    /// Runs a copy of a session that nobody else finds and of which nothing is kept. It ends when nobody looks on.
    pub fn play(&self, name: &str, session: Session, room: Growing) -> SessionHandle {
        let Inner { services, tasks, .. } = &*self.0;
        let opened = Opened { session, room, is_counted: false };
        let (actor, handle) = Actor::new(name.to_owned(), opened, Keeping::Nowhere, services.clone());
        tasks.spawn(actor.run());
        handle
    }

    /// Who is in the session of this name; nobody where it is not in memory.
    pub async fn people(&self, name: &str) -> Vec<Principal> {
        let slot = self.0.slots().get(name).cloned();
        match slot.as_ref().and_then(|slot| slot.session.get()) {
            Some(session) => session.people().await.unwrap_or_default(),
            None => Vec::new(),
        }
    }

    /// Figures of the session of this name, where it is in memory and answers.
    pub async fn figures(&self, name: &str) -> Option<SessionFigures> {
        let slot = self.0.slots().get(name).cloned();
        let session = slot.as_ref().and_then(|slot| slot.session.get())?;
        timeout(LOOKING, session.look()).await.ok().and_then(Result::ok)
    }

    /// Those who are in a session and have a name; nobody where it is not in memory.
    pub async fn named(&self, name: &str) -> Vec<PersonNamed> {
        let slot = self.0.slots().get(name).cloned();
        match slot.as_ref().and_then(|slot| slot.session.get()) {
            Some(session) => session.named().await.unwrap_or_default(),
            None => Vec::new(),
        }
    }

    /// Whoever has this number in a session, and what whoever asks is called there; nothing where it is not in memory.
    pub async fn person(&self, name: &str, number: u32, asking: &Principal) -> Option<PersonHere> {
        let slot = self.0.slots().get(name).cloned();
        let session = slot.as_ref().and_then(|slot| slot.session.get())?;
        session.person(number, asking.clone()).await.ok()
    }

    /// Tells a session, where it is in memory, that what people say of its tree has changed.
    pub async fn comment(&self, name: &str, places: Vec<Pinned>, threads: Vec<u32>) {
        let slot = self.0.slots().get(name).cloned();
        if let Some(session) = slot.as_ref().and_then(|slot| slot.session.get()) {
            // One that has ended reads all of it when it is opened again.
            let _ = session.comment(places, threads).await;
        }
    }

    /// Where the comments of a session's tree are pinned now; nothing where it is not in memory.
    pub async fn pins(&self, name: &str) -> Option<Vec<Pin>> {
        let slot = self.0.slots().get(name).cloned();
        let session = slot.as_ref().and_then(|slot| slot.session.get())?;
        session.pins().await.ok()
    }

    /// All sessions in memory with their figures, in the order of their names.
    pub async fn look(&self) -> Vec<Looked> {
        let slots: Vec<_> =
            self.0.slots().iter().map(|(name, slot)| (name.clone(), Arc::clone(slot))).collect();
        let looking = slots.into_iter().map(async |(name, slot)| {
            let Some(session) = slot.session.get() else { return Looked { name, figures: None } };
            let figures = timeout(LOOKING, session.look()).await;
            Looked { name, figures: figures.ok().and_then(Result::ok) }
        });
        join_all(looking).await
    }

    /// Sockets that are open.
    pub fn sockets(&self) -> usize {
        self.0.places.count()
    }

    /// How long the server has been running.
    pub fn up(&self) -> Duration {
        self.0.services.started.elapsed()
    }

    /// Whether the server stops.
    pub fn is_stopping(&self) -> bool {
        self.0.services.stop.is_cancelled()
    }

    /// Ends every session in memory, for nothing of them can be kept any more.
    pub async fn fail(&self, reason: &str) {
        let slots: Vec<_> = self.0.slots().values().cloned().collect();
        for session in slots.iter().filter_map(|slot| slot.session.get()) {
            // One that has ended already has nothing to lose.
            let _ = session.fail(reason).await;
        }
    }

    /// A place for one more socket from this address, if there is any left.
    pub fn place(&self, from: IpAddr) -> Option<places::Place> {
        self.0.places.take(from)
    }

    /// Runs a socket; when the server stops, this is waited for as well.
    pub async fn run_socket(&self, place: places::Place, socket: impl Future<Output = ()>) {
        self.0.tasks.track_future(socket).await;
        drop(place);
    }

    /// Waits until every session and socket has ended, which they do once the server stops.
    pub async fn ended(&self) {
        self.0.tasks.close();
        self.0.tasks.wait().await;
    }

    async fn load(&self, name: &str, slot: &Arc<Slot>) -> Result<SessionHandle, Unloaded> {
        let services = &self.0.services;
        let lease = services.store.acquire(name).await?;
        if slot.is_anew.swap(false, Ordering::Relaxed)
            && let Err(error) = services.store.forget_tries(&lease).await
        {
            services.store.release(lease).await;
            return Err(error.into());
        }
        let restored = restoring::restored(services, name, &lease, &slot.progress).await;
        let opened =
            match restored.map_err(Unloaded::Error).and_then(|opened| opened.ok_or(Unloaded::Unknown)) {
                Ok(opened) => opened,
                Err(unloaded) => {
                    services.store.release(lease).await;
                    return Err(unloaded);
                }
            };
        Ok(self.start(name, slot, opened, lease))
    }

    /// Runs a session in this slot.
    fn start(&self, name: &str, slot: &Arc<Slot>, opened: Opened, lease: Lease) -> SessionHandle {
        let Inner { services, tasks, .. } = &*self.0;
        let keeping = Keeping::Stored(Arc::clone(&services.store), lease);
        let (actor, handle) = Actor::new(name.to_owned(), opened, keeping, services.clone());
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
        handle
    }

    /// Drops an empty slot unless somebody else is about to fill it.
    fn forget(&self, name: &str, slot: Arc<Slot>) {
        let mut slots = self.0.slots();
        // Slots are handed out under this lock only, so a count of two means the map and this function.
        if Arc::strong_count(&slot) == 2 && !slot.session.initialized() {
            slots.remove(name);
        }
    }
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
mod tests;
