//! Everything around a session: a disk, a simulation pool, clients and a clock, all of them obedient.

use std::collections::BTreeMap;

use espalier_proto::{
    BendFrame, ClientMessage, DocumentState, Frame, FrameKind, GhostFrame, PlacedObstacle, PresenceFrame,
    Problem, Resume, ServerMessage,
    access::Role,
    version::{CloseCode, PROTOCOL_VERSION},
};
use espalier_session::{
    Access, ActId, Anchor, ClientId, Document, Entrant, Input, JournalEntry, Named, Output, PredictionRun,
    Principal, ReadDocument, ReadId, Restoring, Session, Tail, Urgency, Work,
};
use serde_json::{Value, json};

use crate::mirror::{Mirror, rows_of};

pub const SEED: u32 = 7;

/// The other end of one connection.
#[derive(Debug, Default)]
pub struct Peer {
    pub texts: Vec<ServerMessage>,
    pub frames: Vec<Frame>,
    pub bend_frames: Vec<BendFrame>,
    pub ghosts: Vec<GhostFrame>,
    /// Frames of presence, each with the time when it came.
    pub presence: Vec<(u64, PresenceFrame)>,
    /// Bytes of those.
    pub presence_bytes: usize,
    /// Times when it was asked whether it is there.
    pub pings: Vec<u64>,
    /// Does not say that it is there.
    pub asleep: bool,
    pub mirror: Mirror,
    pub closed: Option<CloseCode>,
    /// Why it was closed.
    pub farewell: String,
    /// Frames not yet answered with `received`: sequence and bytes.
    pub in_flight: Vec<(u32, usize)>,
    /// Kinds and sequences of other frames not yet answered.
    pub unanswered: Vec<(u8, u32)>,
    pub most_in_flight: usize,
    /// Does not answer frames.
    pub slow: bool,
    /// Does not read its control messages.
    pub deaf: bool,
    pub unread: usize,
}

pub struct World {
    pub session: Session,
    pub now: u64,
    pub peers: BTreeMap<u64, Peer>,
    /// What survives a crash.
    pub disk: Vec<JournalEntry>,
    pub snapshot: Option<(u64, Vec<u8>)>,
    /// The saved tree the session was opened with.
    origin: Option<Vec<u8>>,
    pub snapshots: usize,
    /// Whether snapshots find no room on the disk.
    pub is_full: bool,
    /// How often somebody has had the notices.
    pub notified: usize,
    answers: Vec<Input>,
    pub anchors: Vec<Option<Anchor>>,
    /// What authors are called, as it is kept.
    pub named: Vec<Named>,
    pub documents: Vec<(ReadId, ReadDocument)>,
    pub acts: Vec<(ActId, Result<Option<PlacedObstacle>, Problem>)>,
    pub writing: Option<(u64, Vec<JournalEntry>)>,
    pub working: Option<(u64, Box<Work>)>,
    predictions: Vec<PredictionRun>,
    wake_at: Option<u64>,
    /// How long the disk and a slice of work take.
    pub write_ms: u64,
    /// Rows that there is memory for: for growth, and for those who draw.
    pub room: [u64; 2],
    pub work_ms: u64,
    next_client: u64,
    next_epoch: u32,
}

impl World {
    pub fn new() -> Self {
        Self::opened_with(None)
    }

    /// A session whose document may hold so many metamers.
    pub fn seeded_with_budget(metamers: u32) -> Self {
        Self::opened_with(Some(Session::seedling(SEED, metamers)))
    }

    /// A session that starts from a first snapshot.
    pub fn opened_with(origin: Option<Vec<u8>>) -> Self {
        let session = Session::restore("plane-tree", 1, origin.as_deref(), SEED, []).unwrap();
        Self { origin, ..Self::around(session) }
    }

    /// A replay of the session as it is now.
    pub fn replay(&mut self) -> Self {
        self.handle(Input::Read(ReadId(1)));
        self.settle();
        let (_, read) = self.documents.pop().unwrap();
        let people = self.session.register().clone();
        Self::around(Session::replay("plane-tree", 77, &read.bytes, people).unwrap())
    }

    fn around(session: Session) -> Self {
        Self {
            session,
            origin: None,
            now: 0,
            peers: BTreeMap::new(),
            disk: Vec::new(),
            snapshot: None,
            snapshots: 0,
            is_full: false,
            notified: 0,
            answers: Vec::new(),
            anchors: Vec::new(),
            named: Vec::new(),
            documents: Vec::new(),
            acts: Vec::new(),
            writing: None,
            working: None,
            predictions: Vec::new(),
            wake_at: None,
            write_ms: 5,
            room: [u64::MAX; 2],
            work_ms: 3,
            next_client: 1,
            next_epoch: 2,
        }
    }

    /// The process dies, the session is loaded from what the disk holds, and nobody comes before all of that is done.
    pub fn crash(&mut self) {
        self.crash_to(Tail::Follows);
        self.handle(Input::Woken);
        while self.working.is_some() {
            self.work();
        }
    }

    /// The process dies and the session is loaded, where it is said what becomes of the journal.
    pub fn crash_to(&mut self, tail: Tail) {
        let snapshot = self.snapshot.as_ref().map(|(_, bytes)| bytes.as_slice()).or(self.origin.as_deref());
        let (entries, room) = (self.disk.iter().cloned(), self.room);
        let mut restoring =
            Restoring::new("plane-tree", self.next_epoch, snapshot, SEED, entries, tail).unwrap();
        while restoring.follow(|| true, &mut |rows, urgency| rows <= room_for(room, urgency)) {}
        self.session = restoring.session();
        self.session.remember(self.named.iter().cloned());
        self.next_epoch += 1;
        self.peers.clear();
        (self.writing, self.working, self.wake_at) = (None, None, None);
        self.predictions.clear();
        self.answers.clear();
    }

    pub fn handle(&mut self, input: Input) {
        self.session.handle(self.now, input);
        while let Some(output) = self.session.poll_output() {
            self.fulfil(output);
        }
    }

    fn fulfil(&mut self, output: Output) {
        match output {
            Output::Text(ClientId(id), text) => {
                let peer = self.peers.get_mut(&id).expect("a text goes to a connection that was made");
                assert!(peer.closed.is_none(), "nothing follows a close");
                let message = serde_json::from_str(&text).expect("every text is a server message");
                if let ServerMessage::Refused { problem, .. } | ServerMessage::Problem { problem } = &message
                {
                    let is_whole = problem.message.starts_with("the message");
                    let names = (problem.field.is_some() || is_whole, problem.allowed.is_some());
                    assert_eq!(names, (true, true), "a refusal names too little: {problem:?}");
                }
                peer.texts.push(message);
                peer.unread += 1;
            }
            Output::Frame(ClientId(id), bytes) => {
                let peer = self.peers.get_mut(&id).expect("a frame goes to a connection that was made");
                assert!(peer.closed.is_none(), "nothing follows a close");
                match FrameKind::of(&bytes) {
                    Some(FrameKind::Bend) => {
                        let frame = BendFrame::decode(&bytes).expect("every frame of a bend is valid");
                        peer.unanswered.push((2, frame.sequence));
                        return peer.bend_frames.push(frame);
                    }
                    Some(FrameKind::Ghost) => {
                        let ghost = GhostFrame::decode(&bytes).expect("every ghost is valid");
                        peer.unanswered.push((3, ghost.sequence));
                        return peer.ghosts.push(ghost);
                    }
                    _ => {}
                }
                let frame = Frame::decode(&bytes).expect("every frame is valid");
                peer.in_flight.push((frame.sequence, bytes.len()));
                let bytes: usize = peer.in_flight.iter().map(|(_, bytes)| bytes).sum();
                assert!(bytes <= 256 * 1024 || peer.in_flight.len() == 1, "FL1");
                peer.most_in_flight = peer.most_in_flight.max(bytes);
                peer.mirror.apply(&frame);
                peer.frames.push(frame);
            }
            Output::Volatile(ClientId(id), bytes) => {
                let peer = self.peers.get_mut(&id).expect("a frame goes to a connection that was made");
                assert!(peer.closed.is_none(), "nothing follows a close");
                assert!(!peer.unanswered.iter().any(|(kind, _)| *kind == 4), "PS2: one at a time");
                let frame = PresenceFrame::decode(&bytes).expect("every frame of presence is valid");
                peer.unanswered.push((4, frame.sequence));
                peer.presence_bytes += bytes.len();
                peer.presence.push((self.now, frame));
            }
            Output::Ping(ClientId(id)) => {
                let peer = self.peers.get_mut(&id).expect("a question goes to a connection that was made");
                peer.pings.push(self.now);
                if !peer.asleep {
                    self.answers.push(Input::Heard(ClientId(id)));
                }
            }
            Output::Close(ClientId(id), code, reason) => {
                let peer = self.peers.get_mut(&id).expect("a close goes to a connection that was made");
                assert_eq!(peer.closed.replace(code), None, "a socket closes once");
                peer.farewell = reason;
            }
            Output::Journal(entries) => {
                assert!(self.writing.is_none(), "one batch at a time");
                self.writing = Some((self.now + self.write_ms, entries));
            }
            Output::Work(work) => {
                assert!(self.working.is_none(), "there is one document");
                self.working = Some((self.now + self.work_ms, work));
            }
            Output::Predict(prediction) => self.predictions.push(*prediction),
            Output::Snapshot { through, bytes } => {
                let durable = self.disk.last().map_or(0, |entry| entry.number);
                assert!(through <= durable, "a snapshot is never ahead of the journal");
                self.snapshots += 1;
                if self.is_full {
                    self.answers.push(Input::SnapshotFailed);
                } else {
                    self.snapshot = Some((through, bytes));
                    self.answers.push(Input::SnapshotKept(through));
                }
            }
            Output::Anchored(_, anchor) => self.anchors.push(anchor),
            Output::Named(named) => self.named.push(named),
            Output::Notified => self.notified += 1,
            Output::Acted { act, outcome } => self.acts.push((act, outcome)),
            Output::Document { read, document } => self.documents.push((read, document)),
            Output::WakeAt(at) => self.wake_at = Some(at),
        }
    }

    /// Lets time pass; what is due happens in its order.
    pub fn pass(&mut self, ms: u64) {
        let end = self.now + ms;
        loop {
            self.let_peers_read();
            if let Some(answer) = self.answers.pop() {
                self.handle(answer);
                continue;
            }
            let write = self.writing.as_ref().map(|(due, _)| *due);
            let work = self.working.as_ref().map(|(due, _)| *due);
            if let Some(mut prediction) = self.predictions.pop() {
                match prediction.run(|| false) {
                    true => self.handle(Input::Predicted(Box::new(prediction))),
                    false => self.predictions.push(prediction),
                }
                continue;
            }
            let next = [write, work, self.wake_at].into_iter().flatten().filter(|due| *due <= end).min();
            let Some(due) = next else { break };
            self.now = self.now.max(due);
            if write == Some(due) {
                let (_, entries) = self.writing.take().unwrap();
                let through = entries.last().unwrap().number;
                self.disk.extend(entries);
                self.handle(Input::Journaled(through));
            } else if work == Some(due) {
                self.work();
            } else {
                self.wake_at = None;
                self.handle(Input::Woken);
            }
        }
        self.now = end;
    }

    /// The slice of work under way is done.
    fn work(&mut self) {
        let (_, mut work) = self.working.take().unwrap();
        let room = self.room;
        work.run_within(|| false, &mut |rows, urgency| rows <= room_for(room, urgency));
        self.handle(Input::Worked(work));
    }

    /// Answers of clients that answer at once.
    fn let_peers_read(&mut self) {
        let ids: Vec<u64> = self.peers.keys().copied().collect();
        for id in ids {
            let peer = &self.peers[&id];
            if peer.closed.is_some() {
                continue;
            }
            if !peer.deaf && !peer.asleep && peer.unread > 0 {
                self.read_texts(id);
            }
            let peer = &self.peers[&id];
            let is_answered = peer.in_flight.is_empty() && peer.unanswered.is_empty();
            if !peer.slow && !peer.asleep && !is_answered {
                self.answer_frames(id);
            }
        }
    }

    pub fn read_texts(&mut self, id: u64) {
        let count = std::mem::take(&mut self.peers.get_mut(&id).unwrap().unread);
        self.handle(Input::Written(ClientId(id), count));
    }

    /// Says that all frames so far have arrived.
    pub fn answer_frames(&mut self, id: u64) {
        let frames = std::mem::take(&mut self.peers.get_mut(&id).unwrap().in_flight);
        if let Some(&(sequence, _)) = frames.last() {
            self.send(id, &json!({ "type": "received", "sequence": sequence, "kind": 1 }));
        }
        for (kind, sequence) in std::mem::take(&mut self.peers.get_mut(&id).unwrap().unanswered) {
            self.send(id, &json!({ "type": "received", "sequence": sequence, "kind": kind }));
        }
    }

    /// Long enough for all work to be done, too short for any deadline.
    pub fn settle(&mut self) {
        for _ in 0..100_000 {
            self.pass(1);
            if self.writing.is_none() && self.working.is_none() {
                // Figures wait for their turn.
                self.pass(60);
                if self.writing.is_none() && self.working.is_none() {
                    return;
                }
            }
        }
        panic!("the session never comes to rest");
    }

    pub fn connect(&mut self) -> u64 {
        self.connect_with(Access::Edit)
    }

    pub fn connect_with(&mut self, access: Access) -> u64 {
        let role = if access == Access::Edit { Role::Editor } else { Role::Viewer };
        let stranger = Entrant::new(format!("stranger {}", self.next_client), role);
        self.connect_as(stranger)
    }

    pub fn connect_as(&mut self, entrant: Entrant) -> u64 {
        let id = self.next_client;
        self.next_client += 1;
        self.peers.insert(id, Peer::default());
        self.handle(Input::Connected(ClientId(id), entrant));
        id
    }

    /// Somebody connects who is known by the key alone, and says hello.
    pub fn join(&mut self, key: &str) -> u64 {
        let id = self.connect_as(stranger_at(key));
        self.hello(id, key, None);
        id
    }

    /// Connects again with what an earlier connection had.
    pub fn rejoin(&mut self, key: &str, mirror: Mirror) -> u64 {
        let id = self.connect_as(stranger_at(key));
        let resume = mirror.resume();
        self.peer_mut(id).mirror = mirror;
        self.hello(id, key, Some(resume));
        id
    }

    pub fn hello(&mut self, id: u64, key: &str, resume: Option<Resume>) {
        self.send(id, &ClientMessage::Hello { protocol: PROTOCOL_VERSION, client: key.into(), resume });
        if let Some(ServerMessage::Welcome { epoch, resumed, .. }) = self.peer(id).texts.first().cloned() {
            let mirror = &mut self.peer_mut(id).mirror;
            if !resumed {
                *mirror = Mirror::default();
            }
            mirror.epoch = epoch;
            mirror.sequence = None;
        }
    }

    pub fn leave(&mut self, id: u64) -> Peer {
        self.handle(Input::Disconnected(ClientId(id)));
        self.peers.remove(&id).unwrap()
    }

    pub fn send(&mut self, id: u64, message: &impl serde::Serialize) {
        self.text(id, &serde_json::to_string(message).unwrap());
    }

    pub fn text(&mut self, id: u64, text: &str) {
        self.handle(Input::Text(ClientId(id), text.into()));
    }

    pub fn command(&mut self, client: u64, id: u32, command: Value) {
        self.send(client, &json!({ "type": "command", "id": id, "command": command }));
    }

    pub fn peer(&self, id: u64) -> &Peer {
        &self.peers[&id]
    }

    pub fn peer_mut(&mut self, id: u64) -> &mut Peer {
        self.peers.get_mut(&id).unwrap()
    }

    pub fn document(&self) -> &Document {
        self.session.document().expect("the document is at home")
    }

    /// The hash of the document when the same commands are done again from the start.
    pub fn replayed_hash(&self) -> u64 {
        let again =
            Session::restore("again", 99, self.origin.as_deref(), SEED, self.disk.iter().cloned()).unwrap();
        again.document().expect("a new session has its document").hash()
    }

    /// A client's rows show the plants; all clients have the very same rows.
    pub fn assert_mirrored(&mut self, id: u64) {
        // Where somebody has just drawn rows may be behind for three seconds (`FL5`).
        self.pass(3_100);
        let stranger = self.join("stranger");
        self.settle();
        let Peer { mirror: complete, .. } = self.leave(stranger);
        let expected = rows_of(self.document());
        let mirror = &self.peer(id).mirror;
        assert_eq!(mirror.rows.len(), expected.len(), "rows of client {id}");
        for (row, (seen, expected)) in mirror.rows.iter().zip(&expected).enumerate() {
            assert!(seen.shows(expected), "row {row} of client {id} is {seen:?} instead of {expected:?}");
            assert_eq!(seen, &complete.rows[row], "row {row} of client {id} differs from a newcomer's");
        }
    }
}

impl Peer {
    pub fn acknowledged(&self) -> Vec<u32> {
        let id = |text: &ServerMessage| match text {
            ServerMessage::Acknowledged { id } => Some(*id),
            _ => None,
        };
        self.texts.iter().filter_map(id).collect()
    }

    /// The numbers of `done`, each with the figures sent before it.
    pub fn done(&self) -> Vec<(u32, DocumentState)> {
        let notified = self.texts.iter().enumerate().filter_map(|(index, text)| match text {
            ServerMessage::Done { id, step, metamers } => {
                let state = last_state(&self.texts[..index])?;
                assert_eq!((*step, *metamers), (state.step, state.metamers), "what `state` says");
                Some((*id, state))
            }
            _ => None,
        });
        notified.collect()
    }

    pub fn refused(&self) -> Vec<(u32, Problem)> {
        let refusal = |text: &ServerMessage| match text {
            ServerMessage::Refused { id, problem } => Some((*id, problem.clone())),
            _ => None,
        };
        self.texts.iter().filter_map(refusal).collect()
    }

    pub fn problems(&self) -> Vec<Problem> {
        let problem = |text: &ServerMessage| match text {
            ServerMessage::Problem { problem } => Some(problem.clone()),
            _ => None,
        };
        self.texts.iter().filter_map(problem).collect()
    }

    pub fn last_state(&self) -> Option<DocumentState> {
        last_state(&self.texts)
    }

    pub fn welcome_acknowledged(&self) -> u32 {
        match self.texts.first() {
            Some(ServerMessage::Welcome { acknowledged, .. }) => *acknowledged,
            other => panic!("no welcome but {other:?}"),
        }
    }

    pub fn resumed(&self) -> bool {
        matches!(self.texts.first(), Some(ServerMessage::Welcome { resumed: true, .. }))
    }
}

fn last_state(texts: &[ServerMessage]) -> Option<DocumentState> {
    texts.iter().rev().find_map(|text| match text {
        ServerMessage::State { state } | ServerMessage::Welcome { state, .. } => Some(state.clone()),
        _ => None,
    })
}

fn room_for([growing, drawing]: [u64; 2], urgency: Urgency) -> u64 {
    if urgency == Urgency::Drawing { drawing } else { growing }
}

/// The client with this key.
pub fn stranger_at(key: &str) -> Entrant {
    Entrant::new(format!("stranger at {key}"), Role::Editor)
}

pub fn person(key: &str) -> Principal {
    Principal::client(key).expect("a key")
}

pub fn grow(steps: u32) -> Value {
    json!({ "kind": "grow", "steps": steps })
}
