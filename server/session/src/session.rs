//! The state machine of one session: what happened goes in, what is to be done comes out.

mod acts;
mod bending;
mod branches;
mod checking;
mod commands;
mod delivery;
mod greeting;
mod limbs;
mod pausing;
mod pins;
mod predicting;
mod presence;
mod replaying;
mod restoring;
mod upkeep;

use std::{
    collections::{BTreeMap, VecDeque},
    sync::Arc,
};

use espalier_mesh::Dyes;
use espalier_proto::{
    ClientMessage, DesignInForce, FrameKind, GrammarInForce, Notice, PlacedObstacle, Problem, Programme,
    Reason, ServerMessage, Timeline, Unreadable, WidthConstraint,
    comment::Pin,
    reading,
    version::{CloseCode, MAX_MESSAGE_BYTES},
};
use espalier_settings::{Appearance, ParameterValues};

use crate::{
    author::Authors,
    clients::{Client, Clients},
    document::{DesignMark, Document, Figures, GrammarMark, ObstaclesMark},
    io::{ClientId, Input, Output, ReadId},
    journal::Journal,
    obstacle::Mesh,
    prediction::Prediction,
    principal::Principal,
    snapshot::{self, RestoreError},
    to_proto::Held,
    window::MAX_UNREAD,
    work::{BendUpdate, Work},
};

pub use self::restoring::{Restoring, Tail};
use self::{acts::Act, commands::Queue, pausing::Pausing, pins::Pins, presence::Room, upkeep::Upkeep};
pub(crate) use self::{branches::LookedAt, limbs::AskedLimb};

/// One shared document with its clients. Feed it with [`Session::handle`], then drain [`Session::poll_output`].
#[derive(Debug)]
pub struct Session {
    name: String,
    epoch: u32,
    /// The latest time handed in, in milliseconds.
    now: u64,
    clients: Clients,
    authors: Authors,
    journal: Journal,
    queue: Queue,
    /// The document, unless it is away on the simulation pool.
    home: Option<Box<Work>>,
    reads: Vec<ReadId>,
    acts: Vec<Act>,
    /// The newest frame and the rows the table has since.
    newest: (u32, u32),
    /// The journal entry through which all is done, as of the last slice of work.
    done: u64,
    /// The last entry that the journal held when the session was opened.
    opened_through: u64,
    figures: Figures,
    leaves: u32,
    parameters: ParameterValues,
    programme: ProgrammeInForce,
    appearance: Appearance,
    /// When its wind took the place of another (`WD3`); 0 where it has blown since the session was opened.
    wind_since: u64,
    scenery: Scenery,
    timeline: Timeline,
    /// As clients have it.
    told_timeline: Timeline,
    /// When rows may be added up again (`CK1`).
    check_due: u64,
    /// When rows make up for what they are behind in, if nothing happens until then (`FL5`).
    whole_due: u64,
    widths: Vec<WidthConstraint>,
    design: Option<DesignInForce>,
    dyes: Dyes,
    design_mark: DesignMark,
    grammar: Option<GrammarInForce>,
    grammar_mark: GrammarMark,
    /// Bends as they are sent to clients, by their numbers.
    bends: BTreeMap<u32, BendUpdate>,
    /// Predictions that are being made.
    predictions: usize,
    upkeep: Upkeep,
    pausing: Pausing,
    /// Who is here.
    room: Room,
    /// Whether it is a copy in which one only travels (`RP1`).
    is_replay: bool,
    /// Where comments are pinned.
    pins: Pins,
    /// What everybody here is notified of.
    notices: Vec<Notice>,
    failed: bool,
    outputs: VecDeque<Output>,
}

/// The programme as it is sent to clients (`PG5`).
#[derive(Debug, PartialEq)]
struct ProgrammeInForce {
    programme: Option<Arc<Programme>>,
    by_hand: Vec<&'static str>,
}

impl ProgrammeInForce {
    fn of(document: &Document) -> Self {
        Self { programme: document.programme().cloned(), by_hand: document.set_by_hand().collect() }
    }

    fn is_there(&self) -> bool {
        self.programme.is_some()
    }

    fn message(&self) -> ServerMessage {
        ServerMessage::Programme {
            programme: self.programme.as_deref().cloned().map(Box::new),
            by_hand: self.by_hand.iter().map(|&name| name.to_owned()).collect(),
        }
    }
}

/// The obstacles as they are sent to clients.
#[derive(Debug)]
struct Scenery {
    /// Those of the document when this was made.
    mark: ObstaclesMark,
    obstacles: Vec<PlacedObstacle>,
    meshes: BTreeMap<u32, Arc<Mesh>>,
}

impl Scenery {
    fn of(document: &Document) -> Self {
        let (mark, obstacles) = (document.obstacles_mark(), document.obstacles());
        Self { mark, obstacles, meshes: document.meshes() }
    }
}

impl Session {
    /// The first snapshot of a session that starts from a seed and may hold so many metamers (`LM4`).
    /// Keep it with `through` 0 and restore the session from it.
    pub fn seedling(seed: u32, metamer_budget: u32) -> Vec<u8> {
        let mut document = Document::new(seed);
        document.set_metamer_budget(metamer_budget);
        snapshot::to_bytes(0, &BTreeMap::new(), &document)
    }

    /// A new session that begins with a saved tree, from the bytes a [`Input::Read`] gave, and its first snapshot,
    /// which is to be kept as that of [`Session::seedling`] is.
    pub fn of_tree(
        name: impl Into<String>,
        epoch: u32,
        document: &[u8],
        metamer_budget: u32,
    ) -> Result<(Self, Vec<u8>), RestoreError> {
        let mut document = Document::from_bytes(document)?;
        document.set_metamer_budget(metamer_budget);
        // Strokes and bends in progress go on in the session that the tree was saved from.
        document.end_gestures();
        let snapshot = snapshot::to_bytes(0, &BTreeMap::new(), &document);
        Ok((Restoring::of_document(name.into(), epoch, document).session(), snapshot))
    }

    /// Makes the frame of the whole tree before anybody comes who waits for it.
    pub fn draw_whole(&mut self) {
        if let Some(work) = &mut self.home {
            work.catch_up(&Held::Nothing);
            self.leaves = work.table.leaves();
        }
    }

    fn restored(restoring: Restoring) -> Self {
        let Restoring { name, epoch, mut work, snapshotted, last, taken_by } = restoring;
        work.show();
        let mut authors = Authors::default();
        if last > 0 {
            authors = Authors::restored(&taken_by);
        }
        let mut queue = Queue::default();
        queue.came_back(&work.orders);
        let bends = work.take_report().bends;
        let mut room = Room::default();
        let timeline = work.document.timeline_of(|author| room.register.author(author));
        Self {
            name,
            epoch,
            now: 0,
            clients: Clients::new(),
            authors,
            journal: Journal::new(last),
            queue,
            reads: Vec::new(),
            acts: Vec::new(),
            newest: (work.sequence, work.table.rows() as u32),
            done: work.done_through(),
            opened_through: last,
            figures: work.document.figures(),
            leaves: work.table.leaves(),
            parameters: work.document.parameters(),
            programme: ProgrammeInForce::of(&work.document),
            appearance: *work.document.appearance(),
            wind_since: 0,
            scenery: Scenery::of(&work.document),
            told_timeline: timeline.clone(),
            check_due: 0,
            whole_due: 0,
            timeline,
            widths: work.document.widths(),
            design: work.document.design_told(),
            dyes: work.document.dyes(),
            design_mark: work.document.design_mark(),
            grammar: work.document.grammar_told(),
            grammar_mark: work.document.grammar_mark(),
            bends: bends.into_iter().map(|update| (update.bend, update)).collect(),
            predictions: 0,
            pausing: Pausing::new(work.hold),
            home: Some(work),
            upkeep: Upkeep::new(snapshotted),
            room,
            is_replay: false,
            pins: Pins::default(),
            notices: Vec::new(),
            failed: false,
            outputs: VecDeque::new(),
        }
    }

    /// Notifies everybody who comes of how the session was opened (`OP`), and keeps what was restored in a snapshot.
    pub fn notify(&mut self, notices: impl IntoIterator<Item = Notice>) {
        self.notices.extend(notices);
        self.upkeep.keep_through(self.journal.last());
    }

    /// Something happened at this time, in milliseconds of a clock that never goes back.
    pub fn handle(&mut self, now: u64, input: Input) {
        self.now = self.now.max(now);
        if self.failed {
            if let Input::Connected(client, _) = input {
                self.outputs.push_back(Output::Close(client, CloseCode::InternalError, LOST.into()));
            }
            return;
        }
        self.start_clocks();
        // Of signs by which nothing becomes due there are more than of all else, and the rest of what an input causes costs as
        // much as there are people.
        let is_due = self.upkeep.is_due(self.now);
        match input {
            Input::Connected(client, entrant) => self.connect(client, entrant),
            Input::Granted(client, role) => self.grant(client, role),
            Input::Heard(client) => {
                if !self.hear(client) && !is_due {
                    return;
                }
            }
            Input::Text(client, text) => self.read(client, &text),
            Input::Binary(client) => self.read_binary(client),
            Input::Disconnected(client) => self.forget(client),
            Input::Written(client, count) => {
                if !self.written(client, count) && !is_due {
                    return;
                }
            }
            Input::Journaled(through) => self.journaled(through),
            Input::JournalFailed(reason) => self.fail(&reason),
            Input::Worked(work) => self.worked(work),
            Input::Predicted(prediction) => self.finish_prediction(*prediction),
            Input::Read(read) => self.reads.push(read),
            Input::Act(act, principal, by, command) => self.act(act, &principal, &by, *command),
            Input::Woken => self.upkeep.woken(),
            Input::SnapshotKept(through) => self.upkeep.snapshot_kept(through),
            Input::SnapshotFailed => self.upkeep.snapshot_failed(self.now),
            Input::Stopping => self.stop(),
            Input::GoOn => self.go_on(),
            Input::Anchor(id, row) => self.ask_anchor(id, row),
            Input::Commented { places, threads } => {
                self.pin(places);
                self.threads_changed(threads);
            }
        }
        if !self.failed {
            self.answer_acts();
            self.look_for_room();
            self.keep_up();
            self.find_pins();
            self.dispatch();
            self.ask_to_be_woken();
        }
    }

    /// The next thing to do, oldest first.
    pub fn poll_output(&mut self) -> Option<Output> {
        self.outputs.pop_front()
    }

    /// Whether the journal failed: this session is over and must be restored from disk.
    pub fn has_failed(&self) -> bool {
        self.failed
    }

    /// Whether all that was done is durable and in a snapshot, so that nothing is left to be replayed.
    pub fn is_kept(&self) -> bool {
        let last = self.journal.last();
        self.journal.durable() == last && self.upkeep.holds(last)
    }

    /// Whether nobody is here and nothing is left to do or to keep: it can be dropped and restored later.
    pub fn is_idle(&self) -> bool {
        let settled = self.home.as_ref().is_some_and(|work| !work.is_needed());
        let kept = self.is_kept() && self.upkeep.is_done();
        let answered = self.reads.is_empty() && self.acts.is_empty() && self.predictions == 0;
        self.clients.is_empty() && self.outputs.is_empty() && answered && settled && kept
    }

    /// The document, unless it is away on the simulation pool.
    pub fn document(&self) -> Option<&Document> {
        self.home.as_ref().map(|work| &work.document)
    }

    /// The parameters in force, as of the last slice of work.
    pub fn parameters(&self) -> &ParameterValues {
        &self.parameters
    }

    /// The design in force, as of the last slice of work (`DS11`).
    pub fn design(&self) -> Option<&DesignInForce> {
        self.design.as_ref()
    }

    /// The mesh of an obstacle in the scene, as of the last slice of work (`OB5`).
    pub fn mesh(&self, obstacle: u32) -> Option<Arc<Mesh>> {
        self.scenery.meshes.get(&obstacle).cloned()
    }

    /// Where the comments of its tree are pinned, as clients were told last.
    pub fn pins(&self) -> impl Iterator<Item = Pin> {
        self.pins.told()
    }

    /// Who has said hello and is still here, once for each client.
    pub fn people(&self) -> impl Iterator<Item = &Principal> {
        self.clients
            .values()
            .filter_map(|client| client.connected.as_ref())
            .map(|connected| &connected.principal)
    }

    /// Living metamers, as of the last slice of work.
    pub fn metamers(&self) -> u32 {
        self.figures.metamers
    }

    /// Commands that wait to be done or to be durable.
    pub fn waiting(&self) -> usize {
        self.queue.waiting().0.max(self.journal.waiting().0)
    }

    /// Bytes of frames that were sent and not answered.
    pub fn unanswered(&self) -> usize {
        let connected = self.clients.values().filter_map(|client| client.connected.as_ref());
        connected.map(|client| client.window.bytes()).sum()
    }

    fn read(&mut self, client: ClientId, text: &str) {
        let Some(Client { connected, .. }) = self.clients.get(&client) else { return };
        if text.len() > MAX_MESSAGE_BYTES {
            return self.close(client, CloseCode::MessageTooBig, "a message has at most 256 KiB");
        }
        let message = ClientMessage::from_json(text);
        let Some(connected) = connected else { return self.greet(client, text, message) };
        let principal = connected.principal.clone();
        self.hear(client);
        match message {
            Ok(ClientMessage::Command { id, command }) => {
                self.end_prediction(client);
                self.take(client, &principal, id, Ok(command));
            }
            Ok(ClientMessage::Received { sequence, kind }) => match kind {
                FrameKind::MeshDelta => self.received(client, sequence),
                FrameKind::Bend => self.received_bend_frame(client, sequence),
                FrameKind::Ghost => self.received_ghost(client, sequence),
                FrameKind::Presence => self.received_presence(client, sequence),
            },
            Ok(ClientMessage::Predict { rows, steps }) => {
                self.predict(client, Prediction { rows: rows.into(), steps: steps.get() });
            }
            Ok(ClientMessage::LookAtBranch { of }) => self.look_at_branch(client, of),
            Ok(ClientMessage::LookAtLimb { row }) => self.look_at_limb(client, row),
            Ok(ClientMessage::Follow { device }) => self.follow(client, device),
            Ok(ClientMessage::Gather { camera }) => self.gather(client, camera),
            Ok(here @ ClientMessage::Here { .. }) => {
                if let Some((said, name)) = presence::said(here) {
                    self.here(client, said, name.as_deref());
                }
            }
            Ok(ClientMessage::Check {}) => self.ask_to_check(client),
            Ok(ClientMessage::Ping { nonce }) => {
                self.send(client, &ServerMessage::Pong { nonce, at: self.now });
            }
            Ok(ClientMessage::Hello { .. }) => {
                let problem = Problem::new(Reason::Malformed, "hello is only the first message")
                    .at("type", "any other message");
                self.send(client, &ServerMessage::Problem { problem });
            }
            Err(Unreadable { id: Some(id), problem }) => {
                self.take(client, &principal, id, Err(problem));
            }
            Err(Unreadable { id: None, problem }) => self.send(client, &ServerMessage::Problem { problem }),
        }
    }

    /// So many control messages more have gone out to a client. Whether something is to be done now.
    fn written(&mut self, client: ClientId, count: usize) -> bool {
        let Some(client) = self.clients.get_mut(&client) else { return false };
        client.unread = client.unread.saturating_sub(count);
        if let Some(left) = client.notified_after {
            client.notified_after = left.checked_sub(count).filter(|&left| left > 0);
            if client.notified_after.is_none() {
                self.outputs.push_back(Output::Notified);
            }
        }
        client.wants_state() || client.wants_designs()
    }

    fn read_binary(&mut self, client: ClientId) {
        match self.clients.get(&client) {
            Some(Client { connected: Some(_), .. }) => {
                let problem = Problem::new(Reason::Malformed, "clients send no binary messages")
                    .at("type", "a control message, as text");
                self.send(client, &ServerMessage::Problem { problem });
            }
            Some(_) => {
                self.close_without_hello(client, &reading::unexpected("message", "binary", "a hello"));
            }
            None => {}
        }
    }

    fn fail(&mut self, reason: &str) {
        let sentence = format!("{LOST}: {reason}");
        for client in std::mem::take(&mut self.clients).into_keys() {
            self.outputs.push_back(Output::Close(client, CloseCode::InternalError, sentence.clone()));
        }
        self.failed = true;
        self.home = None;
    }

    fn send(&mut self, client: ClientId, message: &ServerMessage) {
        self.send_text(client, &text_of(message));
    }

    fn broadcast(&mut self, message: &ServerMessage) {
        self.broadcast_text(&text_of(message));
    }

    fn broadcast_text(&mut self, text: &Arc<str>) {
        let connected = self.clients.iter().filter(|(_, client)| client.connected.is_some());
        for client in connected.map(|(&id, _)| id).collect::<Vec<_>>() {
            self.send_text(client, text);
        }
    }

    fn send_text(&mut self, id: ClientId, text: &Arc<str>) {
        let Some(client) = self.clients.get_mut(&id) else { return };
        if client.unread >= MAX_UNREAD {
            return self.close(id, CloseCode::TooSlow, "1024 messages were sent and none of them was read");
        }
        client.unread += 1;
        self.outputs.push_back(Output::Text(id, Arc::clone(text)));
    }

    fn close(&mut self, client: ClientId, code: CloseCode, sentence: &str) {
        self.outputs.push_back(Output::Close(client, code, sentence.into()));
        self.forget(client);
    }
}

const LOST: &str = "the server could not write to its disk; what was not acknowledged is sent again";

fn text_of(message: &ServerMessage) -> Arc<str> {
    // Maps with keys that are no strings are all that serde_json cannot write, and there are none.
    serde_json::to_string(message).unwrap_or_default().into()
}
