//! One task for each live session: it feeds the state machine and does what the machine asks for.

use std::{
    collections::BTreeMap,
    panic::{AssertUnwindSafe, catch_unwind},
    sync::Arc,
    time::Duration,
};

use espalier_proto::{Pause, version::CloseCode};
use espalier_session::{
    ActId, Anchor, AnchorId, ClientId, Input, JournalEntry, Named, Output, PredictionRun, Session, Work,
};
use tokio::{
    sync::{mpsc, oneshot},
    time::{Instant, sleep_until, timeout},
};
use tokio_util::sync::CancellationToken;

use super::{
    handle::{Outcome, Request, SessionFigures, SessionHandle},
    keeping::Keeping,
    leaving::{End, Standing},
    outbox::{Outbox, Outgoing},
    readers::Readers,
    restoring::Opened,
    turn::turn_of,
};
use crate::{
    memory::{self, Growing, Memory, Need, Use},
    pool::{Class, Person, SimulationPool},
    store::AnyStore,
};

/// Requests waiting for a session; beyond that, sockets stop reading.
const MAILBOX: usize = 256;
/// A session that nobody has asked for anything yet after so long is unloaded.
const UNVISITED: Duration = Duration::from_secs(10);
/// After so long a session that was opened lives, though it rests for want of memory.
const LIVES: Duration = Duration::from_secs(30);
/// How long a session that ends waits for its journal, its last commands and a snapshot that contains them.
const LAST_WRITES: Duration = Duration::from_secs(8);

/// What the actor's own tasks bring back.
#[derive(Debug)]
enum ActorTask {
    Journaled(u64),
    JournalFailed(String),
    Worked(Box<Work>),
    Predicted(Box<PredictionRun>),
    WorkFailed,
    SnapshotKept(u64),
    SnapshotFailed,
    Forgotten,
}

/// Everything a session needs from the server.
#[derive(Clone, Debug)]
pub(super) struct Services {
    pub(super) store: Arc<AnyStore>,
    pub(super) pool: SimulationPool,
    pub(super) memory: Memory,
    pub(super) stop: CancellationToken,
    pub(super) started: Instant,
}

pub(super) struct Actor {
    name: String,
    session: Session,
    /// What is taken of memory for it.
    room: Growing,
    /// Whether the store counts that it was tried to be opened.
    is_counted: bool,
    opened_at: Instant,
    keeping: Keeping,
    services: Services,
    requests: mpsc::Receiver<Request>,
    tasks: mpsc::UnboundedReceiver<ActorTask>,
    task: mpsc::UnboundedSender<ActorTask>,
    clients: BTreeMap<ClientId, Outbox>,
    next_client: u64,
    readers: Readers,
    acts: BTreeMap<u64, oneshot::Sender<Outcome>>,
    next_act: u64,
    anchors: BTreeMap<u64, oneshot::Sender<Option<Anchor>>>,
    next_anchor: u64,
    wake_at: Option<Instant>,
    /// When somebody was here last.
    empty_since: Instant,
    /// How long it then waits for somebody.
    patience: Duration,
    /// Tasks that are still running.
    under_way: usize,
}

impl Actor {
    pub(super) fn new(
        name: String,
        Opened { session, room, is_counted }: Opened,
        keeping: Keeping,
        services: Services,
    ) -> (Self, SessionHandle) {
        room.settle(session.held_rows().unwrap_or(0));
        let (sender, requests) = mpsc::channel(MAILBOX);
        let (task, tasks) = mpsc::unbounded_channel();
        let handle = SessionHandle::new(sender);
        let readers = Readers::new(services.memory.patience());
        let actor = Self {
            name,
            session,
            room,
            is_counted,
            opened_at: Instant::now(),
            keeping,
            services,
            requests,
            tasks,
            task,
            clients: BTreeMap::new(),
            next_client: 1,
            readers,
            acts: BTreeMap::new(),
            next_act: 1,
            anchors: BTreeMap::new(),
            next_anchor: 1,
            wake_at: None,
            empty_since: Instant::now(),
            patience: UNVISITED,
            under_way: 0,
        };
        (actor, handle)
    }

    /// Runs until no client needs the session, the server stops, or the session fails.
    pub(super) async fn run(mut self) {
        let end = match self.live().await {
            Ok(end) => end,
            Err(Failed) => End::Failed,
        };
        self.requests.close();
        match end {
            End::Idle => tracing::info!(session = self.name, "nobody is here any more"),
            End::Resting => {
                tracing::info!(session = self.name, "nobody is here, and what rests makes room");
                self.readers.turn_all_away();
            }
            End::Stopping => self.close_all(CloseCode::GoingAway, "The server is stopping."),
            End::Failed => {
                tracing::error!(session = self.name, "the session failed and will be loaded again");
                self.close_all(
                    CloseCode::InternalError,
                    "The session failed; it is loaded again when you come back.",
                );
            }
        }
        let is_finished = matches!(end, End::Idle | End::Stopping);
        let finished = is_finished && matches!(timeout(LAST_WRITES, self.finish()).await, Ok(Ok(())));
        let rests = self.session.paused().is_some();
        if is_finished && !(finished && (rests || self.session.is_kept())) {
            tracing::warn!(
                session = self.name,
                "the last commands may not have been kept, or are in no snapshot"
            );
        }
        // It rests for want of memory, and not because the server did not outlive it.
        if self.is_counted
            && self.session.paused() == Some(Pause::Memory)
            && let Err(error) = self.keeping.forget_tries().await
        {
            tracing::warn!(session = self.name, %error, "that the session lives is not kept");
        }
        self.keeping.release().await;
    }

    async fn live(&mut self) -> Result<End, Failed> {
        self.read_names().await;
        self.drain()?;
        self.read_pins().await?;
        // What the journal holds may not all be done, and nobody may come.
        self.handle(Input::Woken)?;
        loop {
            let wake_at = self.wake_at;
            let was_empty = self.clients.is_empty();
            self.readers.note(Instant::now(), self.session.paused());
            let refuse_at = self.readers.due();
            let standing = self.standing();
            let (in_time, in_haste) = (standing.end_in_time(), standing.end_where_memory_is_short());
            let idle_at = self.empty_since + self.patience;
            let input = tokio::select! {
                biased;
                () = self.services.stop.cancelled() => return Ok(End::Stopping),
                Some(task) = self.tasks.recv() => self.returned(task)?,
                Some(request) = self.requests.recv() => self.requested(request),
                () = until(wake_at) => {
                    self.wake_at = None;
                    Some(Input::Woken)
                }
                () = until(refuse_at) => {
                    self.readers.turn_away(Instant::now());
                    None
                }
                end = then(sleep_until(idle_at), in_time) => return Ok(end),
                // Where nobody is, others are served first.
                end = then(self.services.memory.short(), in_haste) => return Ok(end),
            };
            if let Some(input) = input {
                self.handle(input)?;
            }
            if !was_empty || !self.clients.is_empty() {
                self.empty_since = Instant::now();
            }
        }
    }

    /// What people have said of the tree before the session was opened.
    async fn read_pins(&mut self) -> Result<(), Failed> {
        match self.keeping.pins(&self.name).await {
            Ok(places) if places.is_empty() => Ok(()),
            Ok(places) => self.handle(Input::Commented { places, threads: Vec::new() }),
            Err(error) => {
                tracing::warn!(session = self.name, %error, "comments are shown without their places");
                Ok(())
            }
        }
    }

    /// What those were called who have done something before the session was opened.
    async fn read_names(&mut self) {
        match self.keeping.named_authors(&self.session.authors()).await {
            Ok(named) => self.session.remember(named),
            Err(error) => {
                tracing::warn!(session = self.name, %error, "who did what is shown without names");
            }
        }
    }

    fn standing(&self) -> Standing {
        Standing {
            is_empty: self.clients.is_empty(),
            is_still: self.under_way == 0,
            owes_answers: !self.readers.is_empty() || !self.acts.is_empty() || !self.anchors.is_empty(),
            is_settled: self.session.is_settled(),
            is_kept: self.session.is_idle(),
            paused: self.session.paused(),
        }
    }

    /// Sees to it that what was accepted is durable, done, and in a snapshot, so that nothing is left to be replayed.
    async fn finish(&mut self) -> Result<(), Failed> {
        let clients: Vec<ClientId> = self.clients.keys().copied().collect();
        self.clients.clear();
        for client in clients {
            self.handle(Input::Disconnected(client))?;
        }
        self.handle(Input::Stopping)?;
        while self.under_way > 0 {
            let Some(task) = self.tasks.recv().await else { break };
            if let Some(input) = self.returned(task)? {
                self.handle(input)?;
            }
        }
        Ok(())
    }

    fn requested(&mut self, request: Request) -> Option<Input> {
        self.patience = self.keeping.patience();
        Some(match request {
            Request::Join(outbox, entrant, answer) => {
                let client = ClientId(self.next_client);
                // Where nobody takes the number, nobody would disconnect it.
                answer.send(client).ok()?;
                self.next_client += 1;
                self.clients.insert(client, outbox);
                Input::Connected(client, entrant)
            }
            Request::Grant(client, role) => Input::Granted(client, role),
            Request::Heard(client) => Input::Heard(client),
            Request::Text(client, text) => Input::Text(client, text),
            Request::Binary(client) => Input::Binary(client),
            Request::Written(client, count) => Input::Written(client, count),
            Request::Leave(client) => {
                self.clients.remove(&client);
                Input::Disconnected(client)
            }
            Request::Read(answer) => Input::Read(self.readers.ask(Instant::now(), answer)),
            Request::Act(principal, by, command, answer) => {
                let act = self.next_act;
                self.next_act += 1;
                self.acts.insert(act, answer);
                Input::Act(ActId(act), principal, by, command)
            }
            Request::Anchor(row, answer) => {
                let anchor = self.next_anchor;
                self.next_anchor += 1;
                self.anchors.insert(anchor, answer);
                Input::Anchor(AnchorId(anchor), row)
            }
            Request::Commented(places, threads) => Input::Commented { places, threads },
            // Whoever asked may have gone meanwhile.
            Request::Pins(answer) => {
                let _ = answer.send(self.session.pins().collect());
                return None;
            }
            Request::Parameters(answer) => {
                let _ = answer.send(self.session.parameters().clone());
                return None;
            }
            Request::Design(answer) => {
                let _ = answer.send(self.session.design().cloned());
                return None;
            }
            Request::Mesh(obstacle, answer) => {
                let _ = answer.send(self.session.mesh(obstacle));
                return None;
            }
            Request::Look(answer) => {
                let _ = answer.send(SessionFigures {
                    people: u32::try_from(self.session.people().count()).unwrap_or(u32::MAX),
                    metamers: self.session.metamers(),
                    memory: self.room.bytes(),
                    waiting: self.session.waiting(),
                    unanswered: self.session.unanswered(),
                    paused: self.session.paused(),
                });
                return None;
            }
            Request::GoOn(answer) => {
                let _ = answer.send(self.session.paused() == Some(Pause::Crashes));
                Input::GoOn
            }
            Request::StoreFailed(reason) => Input::JournalFailed(reason),
            Request::Person(number, asking, answer) => {
                let _ = answer.send((self.session.person(number), self.session.called(&asking)));
                return None;
            }
            Request::Named(answer) => {
                let _ = answer.send(self.session.named());
                return None;
            }
            Request::Register(answer) => {
                let _ = answer.send(self.session.register().clone());
                return None;
            }
            Request::People(answer) => {
                let _ = answer.send(self.session.people().cloned().collect());
                return None;
            }
        })
    }

    fn returned(&mut self, task: ActorTask) -> Result<Option<Input>, Failed> {
        self.under_way -= 1;
        match task {
            ActorTask::Journaled(through) => Ok(Some(Input::Journaled(through))),
            ActorTask::JournalFailed(reason) => Ok(Some(Input::JournalFailed(reason))),
            ActorTask::Worked(work) => {
                self.room.settle(work.held_rows());
                Ok(Some(Input::Worked(work)))
            }
            ActorTask::Predicted(prediction) => Ok(Some(Input::Predicted(prediction))),
            ActorTask::WorkFailed => Err(Failed),
            ActorTask::SnapshotKept(through) => Ok(Some(Input::SnapshotKept(through))),
            ActorTask::SnapshotFailed => Ok(Some(Input::SnapshotFailed)),
            ActorTask::Forgotten => Ok(None),
        }
    }

    fn handle(&mut self, input: Input) -> Result<(), Failed> {
        let now = self.services.started.elapsed().as_millis() as u64;
        // A bug in a session must end this session only.
        catch_unwind(AssertUnwindSafe(|| self.session.handle(now, input))).map_err(|_| Failed)?;
        self.drain()
    }

    fn drain(&mut self) -> Result<(), Failed> {
        while let Some(output) =
            catch_unwind(AssertUnwindSafe(|| self.session.poll_output())).map_err(|_| Failed)?
        {
            self.fulfil(output);
        }
        if self.is_counted && self.lives() {
            self.is_counted = false;
            self.forget_tries();
        }
        if self.session.has_failed() { Err(Failed) } else { Ok(()) }
    }

    fn fulfil(&mut self, output: Output) {
        match output {
            Output::Text(client, text) => {
                if let Some(outbox) = self.clients.get(&client) {
                    outbox.send(Outgoing::Text(text));
                }
            }
            Output::Frame(client, frame) => {
                if let Some(outbox) = self.clients.get(&client) {
                    outbox.send(Outgoing::Frame(frame));
                }
            }
            Output::Volatile(client, frame) => {
                if let Some(outbox) = self.clients.get(&client) {
                    outbox.show(frame);
                }
            }
            Output::Ping(client) => {
                if let Some(outbox) = self.clients.get(&client) {
                    outbox.ping();
                }
            }
            Output::Close(client, code, sentence) => {
                if let Some(outbox) = self.clients.remove(&client) {
                    outbox.close(code, sentence);
                }
            }
            Output::Journal(entries) => self.journal(entries),
            Output::Work(work) => self.work(work),
            Output::Predict(prediction) => self.start_prediction(prediction),
            Output::Snapshot { through, bytes } => self.keep_snapshot(through, bytes),
            Output::Notified => self.forget_notices(),
            Output::Named(named) => self.keep_name(named),
            Output::Document { read, document } => self.readers.answer(read, document),
            Output::Acted { act, outcome } => {
                if let Some(answer) = self.acts.remove(&act.0) {
                    let _ = answer.send(outcome);
                }
            }
            Output::Anchored(id, anchor) => {
                if let Some(answer) = self.anchors.remove(&id.0) {
                    let _ = answer.send(anchor);
                }
            }
            Output::WakeAt(at) => self.wake_at = Some(self.services.started + Duration::from_millis(at)),
        }
    }

    fn journal(&mut self, entries: Vec<JournalEntry>) {
        let Some(last) = entries.last().map(|entry| entry.number) else { return };
        let (keeping, task) = (self.keeping.clone(), self.task.clone());
        let session = self.name.clone();
        self.under_way += 1;
        tokio::spawn(async move {
            let _ = task.send(match keeping.append(&entries).await {
                Ok(()) => ActorTask::Journaled(last),
                Err(error) => {
                    tracing::error!(session, %error, "the journal could not be written");
                    ActorTask::JournalFailed(error.in_words().into())
                }
            });
        });
    }

    fn work(&mut self, mut work: Box<Work>) {
        let (pool, task, room) = (self.services.pool.clone(), self.task.clone(), self.room.clone());
        self.under_way += 1;
        tokio::spawn(async move {
            let (class, person) = turn_of(&work);
            let done = pool.run(class, person, move |turn| {
                work.run_within(|| turn.is_over(), &mut |rows, urgency| room.has_room(rows, urgency));
                work
            });
            let _ = task.send(done.await.map_or(ActorTask::WorkFailed, ActorTask::Worked));
        });
    }

    /// Makes a prediction slice by slice, so that the trees people work on have their turns between.
    fn start_prediction(&mut self, mut prediction: Box<PredictionRun>) {
        let (pool, task) = (self.services.pool.clone(), self.task.clone());
        let person: Person = self.name.as_str().into();
        let memory = self.services.memory.clone();
        self.under_way += 1;
        tokio::spawn(async move {
            let mut claim = memory.take(Use::Prediction, Need::Other, 0);
            loop {
                let rows = prediction.held_rows();
                let needed = memory::prediction(rows + rows / 8 + memory::STRIDE);
                if !claim.as_mut().is_ok_and(|claim| claim.become_of(Need::Other, needed).is_ok()) {
                    prediction.refuse();
                }
                let slice = pool.run(Class::Growing, Arc::clone(&person), move |turn| {
                    let is_done = prediction.run(|| turn.is_over());
                    (prediction, is_done)
                });
                match slice.await {
                    Ok((done, true)) => break task.send(ActorTask::Predicted(done)),
                    Ok((rest, false)) => prediction = rest,
                    Err(_) => break task.send(ActorTask::WorkFailed),
                }
            }
        });
    }

    fn keep_snapshot(&mut self, through: u64, bytes: Vec<u8>) {
        let (keeping, task) = (self.keeping.clone(), self.task.clone());
        let session = self.name.clone();
        let metamers = self.session.metamers();
        self.under_way += 1;
        tokio::spawn(async move {
            let _ = task.send(match keeping.keep_snapshot(through, bytes, metamers).await {
                Ok(()) => ActorTask::SnapshotKept(through),
                Err(error) => {
                    tracing::error!(session, %error, "a snapshot could not be kept; the journal holds what was done");
                    ActorTask::SnapshotFailed
                }
            });
        });
    }

    /// Whether opening it came to an end: what the journal held is done, or has rested for long for want of memory.
    fn lives(&self) -> bool {
        match self.session.paused() {
            Some(Pause::Crashes) => false,
            Some(Pause::Memory) => self.opened_at.elapsed() >= LIVES,
            None => self.session.has_caught_up(),
        }
    }

    fn forget_tries(&mut self) {
        let (keeping, task) = (self.keeping.clone(), self.task.clone());
        let session = self.name.clone();
        self.under_way += 1;
        tokio::spawn(async move {
            // If this fails, it waits for an owner's word the sooner.
            if let Err(error) = keeping.forget_tries().await {
                tracing::warn!(session, %error, "that the session lives is not kept");
            }
            let _ = task.send(ActorTask::Forgotten);
        });
    }

    fn forget_notices(&mut self) {
        let (keeping, task) = (self.keeping.clone(), self.task.clone());
        let session = self.name.clone();
        self.under_way += 1;
        tokio::spawn(async move {
            // If this fails, clients are notified once more.
            if let Err(error) = keeping.forget_notices().await {
                tracing::warn!(session, %error, "notices that were delivered could not be forgotten");
            }
            let _ = task.send(ActorTask::Forgotten);
        });
    }

    fn keep_name(&mut self, named: Named) {
        let (keeping, task) = (self.keeping.clone(), self.task.clone());
        let session = self.name.clone();
        self.under_way += 1;
        tokio::spawn(async move {
            if let Err(error) = keeping.name_author(&named).await {
                tracing::warn!(session, %error, "what somebody is called who draws is not kept");
            }
            let _ = task.send(ActorTask::Forgotten);
        });
    }

    fn close_all(&self, code: CloseCode, sentence: &str) {
        for outbox in self.clients.values() {
            outbox.close(code, sentence.into());
        }
    }
}

/// The session must be loaded again from what is durable.
#[derive(Debug)]
struct Failed;

/// Ends so once that has happened, if it may end.
async fn then(happened: impl Future<Output = ()>, end: Option<End>) -> End {
    match end {
        Some(end) => {
            happened.await;
            end
        }
        None => std::future::pending().await,
    }
}

async fn until(instant: Option<Instant>) {
    match instant {
        Some(instant) => sleep_until(instant).await,
        None => std::future::pending().await,
    }
}
