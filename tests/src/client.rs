//! A client of the wire: sends commands, keeps what was not acknowledged, takes in frames.

use std::{collections::VecDeque, fmt::Debug, time::Duration};

use espalier_proto::{
    BendFrame, ClientMessage, DesignInForce, DocumentState, DyeColours, DyedBlock, Frame, FrameKind,
    GhostFrame, GrammarInForce, Notice, Person, PlacedObstacle, PresenceFrame, Problem, Programme,
    ServerMessage, Timeline, WidthConstraint, access::Role,
};
use espalier_settings::{Appearance, ParameterValues};
use futures_util::{SinkExt, StreamExt};
use serde_json::{Value, json};
use tokio::{net::TcpStream, time};
use tokio_tungstenite::{
    MaybeTlsStream, WebSocketStream, connect_async,
    tungstenite::{Error, Message, client::IntoClientRequest, protocol::CloseFrame},
};

use crate::{
    scratch::Scratch,
    server::{GUARD, Server},
    table::{Form, Table},
};

/// The socket beneath a client.
pub type Socket = WebSocketStream<MaybeTlsStream<TcpStream>>;

/// Whether a client answers frames, and so opens its window again (`FL1`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Receipts {
    /// Each frame is answered at once.
    Sent,
    /// Frames are taken in without a word.
    Withheld,
}

/// The nonce of pings that no test sends.
const NOBODYS: u32 = u32::MAX;

/// One person with the page open.
#[derive(Debug)]
pub struct Client {
    /// `None` while the connection is lost.
    socket: Option<Socket>,
    /// The key it keeps.
    pub key: String,
    /// The session as the welcome names it.
    pub session: String,
    /// The rows.
    pub table: Table,
    /// The newest figures.
    pub state: DocumentState,
    /// The newest parameters.
    pub parameters: ParameterValues,
    /// The programme, and what was set by hand.
    pub programme: Option<(Programme, Vec<String>)>,
    /// The newest looks.
    pub appearance: Appearance,
    /// How often the looks were told.
    pub appearances: usize,
    /// The newest list of obstacles.
    pub obstacles: Vec<PlacedObstacle>,
    /// The newest lines of time.
    pub timeline: Timeline,
    /// The newest width constraints.
    pub widths: Vec<WidthConstraint>,
    /// The design in force.
    pub design: Option<DesignInForce>,
    /// Colours of branches,
    pub dyes: Vec<DyeColours>,
    /// and which rows have them.
    pub dyed: Vec<DyedBlock>,
    /// The grammar in force, as it was told last.
    pub grammar: Option<GrammarInForce>,
    /// Frames of bends, in the order they came.
    pub bend_frames: Vec<BendFrame>,
    /// Ghosts of predictions, in the order they came.
    pub ghosts: Vec<GhostFrame>,
    /// Frames of presence.
    pub presence: Vec<PresenceFrame>,
    /// Who is here, as it was told last.
    pub people: Vec<Person>,
    /// What it was told that it may do, since it came in.
    pub role: Option<Role>,
    /// How much of the session was loaded, each time that it was told.
    pub loading: Vec<f32>,
    /// The highest durable command.
    pub acknowledged: u32,
    /// The command up to which nothing is left to do (`CM11`).
    pub done: u32,
    /// How often it was told what its rows must add up to (`CK1`).
    pub checksums: usize,
    /// What was sent and is not known to be durable.
    pub unacknowledged: VecDeque<(u32, Value)>,
    /// Whether the last welcome took up the resume.
    pub resumed: bool,
    /// Refused commands, in the order they came.
    pub refused: Vec<(u32, Problem)>,
    /// Messages that could not be read.
    pub problems: Vec<Problem>,
    /// How the session was opened.
    pub notices: Vec<Notice>,
    /// Pongs.
    pub pongs: Vec<u32>,
    /// Bytes of all frames.
    pub frame_bytes: usize,
    /// Frames.
    pub frames: usize,
    /// Whether it answers frames.
    pub receipts: Receipts,
    /// Why the server closed the socket.
    pub closed: Option<CloseFrame>,
    next: u32,
}

/// A socket of this session on which nothing has been said.
pub async fn open(port: u16, session: &str) -> Socket {
    open_with(port, session, &[]).await
}

/// The same with more headers.
pub async fn open_with(port: u16, session: &str, headers: &[(&'static str, &str)]) -> Socket {
    open_door(port, session, "socket", headers).await
}

/// The same to a socket of another name: `replay`.
pub async fn open_door(port: u16, session: &str, door: &str, headers: &[(&'static str, &str)]) -> Socket {
    let url = format!("ws://127.0.0.1:{port}/api/v1/sessions/{session}/{door}");
    let mut request = url.into_client_request().expect("it is an address");
    for (name, value) in headers {
        request.headers_mut().insert(*name, value.parse().expect("it is a header"));
    }
    let (socket, _) = connect_async(request).await.expect("the socket opens");
    socket
}

/// The next message on a bare socket; `None` when it has ended.
pub async fn next(socket: &mut Socket) -> Option<Message> {
    loop {
        match time::timeout(GUARD, socket.next()).await.expect("the server says something") {
            // The server looks whether anyone is there; the answer goes out by itself.
            Some(Ok(Message::Ping(_) | Message::Pong(_))) => continue,
            Some(Ok(message)) => return Some(message),
            Some(Err(_)) | None => return None,
        }
    }
}

/// The code a bare socket is closed with; other messages before it are passed over.
pub async fn close_code(socket: &mut Socket) -> Option<u16> {
    close(socket).await.map(|(code, _)| code)
}

/// The same with the reason.
pub async fn close(socket: &mut Socket) -> Option<(u16, String)> {
    loop {
        match next(socket).await? {
            Message::Close(frame) => return frame.map(|frame| (frame.code.into(), frame.reason.to_string())),
            _ => continue,
        }
    }
}

/// A control message as a socket message.
pub fn text(message: &impl serde::Serialize) -> Message {
    Message::text(serde_json::to_string(message).expect("control messages are JSON"))
}

/// Whether a message tells how far a session is loaded (`HS8`).
pub fn is_loading(message: &str) -> bool {
    message.starts_with(r#"{"type":"loading","#)
}

/// What comes first, but for how far the session is loaded.
async fn welcome(socket: &mut Socket) -> String {
    loop {
        match next(socket).await {
            Some(Message::Text(answer)) if is_loading(&answer) => {}
            Some(Message::Text(answer)) => return answer.to_string(),
            other => panic!("HS2: a welcome comes first, not {other:?}"),
        }
    }
}

impl Client {
    /// One client in a new session of seed 7, on a server of its own with these options.
    pub async fn alone(options: &[&str]) -> (Self, Server, Scratch) {
        let scratch = Scratch::new();
        let server = Server::start_with(&scratch.path("trees.db"), 0, options);
        let session = server.new_session(7);
        let client = Self::connect(server.port(), &session, "browser-1").await;
        (client, server, scratch)
    }

    /// Opens a session under this key, as far as the welcome.
    pub async fn connect(port: u16, session: &str, key: &str) -> Self {
        Self::connect_with(port, session, key, Receipts::Sent).await
    }

    /// The same, with a say in whether frames are answered.
    pub async fn connect_with(port: u16, session: &str, key: &str, receipts: Receipts) -> Self {
        let mut socket = open(port, session).await;
        let hello = ClientMessage::Hello {
            protocol: espalier_proto::version::PROTOCOL_VERSION,
            client: key.to_owned(),
            resume: None,
        };
        socket.send(text(&hello)).await.expect("the hello is sent");
        let answer = welcome(&mut socket).await;
        let Ok(ServerMessage::Welcome { session, epoch, acknowledged, parameters, state, resumed, .. }) =
            serde_json::from_str(&answer)
        else {
            panic!("HS2: {answer} is no welcome")
        };
        Self {
            socket: Some(socket),
            key: key.to_owned(),
            session,
            table: Table::new(epoch),
            state,
            parameters: *parameters,
            programme: None,
            appearance: Appearance::default(),
            appearances: 0,
            obstacles: Vec::new(),
            timeline: Timeline::default(),
            widths: Vec::new(),
            design: None,
            dyes: Vec::new(),
            dyed: Vec::new(),
            grammar: None,
            bend_frames: Vec::new(),
            ghosts: Vec::new(),
            presence: Vec::new(),
            people: Vec::new(),
            role: None,
            acknowledged,
            done: 0,
            checksums: 0,
            unacknowledged: VecDeque::new(),
            resumed,
            refused: Vec::new(),
            problems: Vec::new(),
            notices: Vec::new(),
            pongs: Vec::new(),
            loading: Vec::new(),
            frame_bytes: 0,
            frames: 0,
            receipts,
            closed: None,
            next: acknowledged + 1,
        }
    }

    /// Comes back with what it has (`RS1`) and sends again what is not acknowledged (`CM1`).
    pub async fn reconnect(&mut self, port: u16) {
        self.socket = None;
        self.closed = None;
        // BE5: these end with the connection.
        self.bend_frames.clear();
        self.ghosts.clear();
        let mut socket = open(port, &self.session).await;
        let hello = ClientMessage::Hello {
            protocol: espalier_proto::version::PROTOCOL_VERSION,
            client: self.key.clone(),
            resume: Some(self.table.resume()),
        };
        socket.send(text(&hello)).await.expect("the hello is sent");
        let answer = welcome(&mut socket).await;
        self.socket = Some(socket);
        let message = serde_json::from_str(&answer).unwrap_or_else(|error| panic!("{error}: {answer}"));
        self.take_control(message);
        for (id, command) in self.unacknowledged.clone() {
            self.send_message(&json!({ "type": "command", "id": id, "command": command })).await;
        }
    }

    /// Whether the socket is still open.
    pub fn is_connected(&self) -> bool {
        self.socket.is_some()
    }

    /// Drops the connection without a word.
    pub fn vanish(&mut self) {
        self.socket = None;
    }

    /// Sends a command under the next number, which is returned. A lost connection keeps it for later.
    pub async fn send(&mut self, command: Value) -> u32 {
        let id = self.next;
        self.next += 1;
        self.unacknowledged.push_back((id, command.clone()));
        self.send_message(&json!({ "type": "command", "id": id, "command": command })).await;
        id
    }

    /// Takes the next number for a command sent by other means.
    pub fn take_number(&mut self) -> u32 {
        self.next += 1;
        self.next - 1
    }

    /// Sends any control message.
    pub async fn send_message(&mut self, message: &impl serde::Serialize) {
        self.send_raw(text(message)).await;
    }

    /// Sends anything at all; a socket that fails is lost.
    pub async fn send_raw(&mut self, message: Message) {
        if let Some(socket) = &mut self.socket
            && socket.send(message).await.is_err()
        {
            self.socket = None;
        }
    }

    /// Takes in messages until `done`, or panics after a long time.
    pub async fn until(&mut self, what: &str, mut done: impl FnMut(&Self) -> bool) {
        let all = async {
            while !done(self) {
                assert!(self.take_in().await, "{what}: the connection ended with {:?}", self.closed);
            }
        };
        if time::timeout(GUARD, all).await.is_err() {
            panic!(
                "{what} did not happen; state {:?}, acknowledged {}, {} unacknowledged, {} rows living, refused {:?}",
                self.state,
                self.acknowledged,
                self.unacknowledged.len(),
                self.table.living(),
                self.refused,
            );
        }
    }

    /// Waits until everything sent is durable and done, and all that came of it has arrived.
    pub async fn until_settled(&mut self) {
        let last = self.next - 1;
        self.until("everything is done (CM11)", |client| client.done >= last).await;
        // What others did before, and what this client did nothing about, has come when an answer has.
        self.send_message(&json!({ "type": "ping", "nonce": NOBODYS })).await;
        self.until("a ping is answered", |client| client.pongs.contains(&NOBODYS)).await;
        self.pongs.retain(|nonce| *nonce != NOBODYS);
        self.until("the rows are as many as the state says", |client| {
            client.table.living() == client.state.metamers as usize
        })
        .await;
    }

    /// The form of the table once it has come in full (`FL5`), which is so when rows are added up.
    pub async fn form(&mut self) -> Vec<Form> {
        let told = self.checksums;
        self.send_message(&json!({ "type": "check" })).await;
        self.until("rows are added up (CK1)", |client| client.checksums > told).await;
        self.table.form()
    }

    /// Takes in messages until the table has this form.
    pub async fn until_form(&mut self, form: &[Form]) {
        let all = async {
            while self.table.form() != form {
                assert!(self.take_in().await, "the connection ended with {:?}", self.closed);
            }
        };
        if time::timeout(GUARD, all).await.is_err() {
            panic!("the table stays different: {}", difference(&self.table.form(), form));
        }
    }

    /// Takes in whatever comes within this time.
    pub async fn listen(&mut self, time: Duration) {
        let all = async { while self.take_in().await {} };
        // Running out of time is how this ends while the connection lives.
        let _ = time::timeout(time, all).await;
    }

    /// Takes in one message; false when the connection has ended.
    pub async fn take_in(&mut self) -> bool {
        let Some(socket) = &mut self.socket else { return false };
        match socket.next().await {
            Some(Ok(Message::Text(text))) => {
                let message = serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}"));
                self.take_control(message);
            }
            Some(Ok(Message::Binary(bytes))) => self.take_frame(&bytes).await,
            Some(Ok(Message::Close(frame))) => {
                self.closed = frame;
                self.socket = None;
            }
            Some(Ok(_)) => {}
            Some(Err(Error::ConnectionClosed | Error::AlreadyClosed)) | None => self.socket = None,
            Some(Err(_)) => self.socket = None,
        }
        self.socket.is_some()
    }

    async fn take_frame(&mut self, bytes: &[u8]) {
        let kind = FrameKind::of(bytes).unwrap_or(FrameKind::MeshDelta);
        let sequence = match kind {
            FrameKind::MeshDelta => return self.take_delta(bytes).await,
            FrameKind::Bend => {
                self.bend_frames.push(BendFrame::decode(bytes).expect("every frame of a bend is valid"));
                self.bend_frames.last().map(|frame| frame.sequence)
            }
            FrameKind::Ghost => {
                self.ghosts.push(GhostFrame::decode(bytes).expect("every ghost is valid"));
                self.ghosts.last().map(|ghost| ghost.sequence)
            }
            FrameKind::Presence => {
                let frame = PresenceFrame::decode(bytes).expect("every frame of presence is valid");
                self.presence.push(frame);
                self.presence.last().map(|frame| frame.sequence)
            }
        };
        if let (Receipts::Sent, Some(sequence)) = (self.receipts, sequence) {
            self.send_message(&json!({ "type": "received", "sequence": sequence, "kind": kind.code() }))
                .await;
        }
    }

    async fn take_delta(&mut self, bytes: &[u8]) {
        let frame =
            Frame::decode(bytes).unwrap_or_else(|error| panic!("the server sent a broken frame: {error}"));
        self.table.apply(&frame).unwrap_or_else(|error| panic!("the server broke the protocol: {error}"));
        self.frame_bytes += bytes.len();
        self.frames += 1;
        if self.receipts == Receipts::Sent {
            self.send_message(&json!({ "type": "received", "sequence": frame.sequence, "kind": 1 })).await;
        }
    }

    fn take_control(&mut self, message: ServerMessage) {
        match message {
            ServerMessage::Welcome { epoch, resumed, acknowledged, parameters, state, .. } => {
                if !resumed {
                    self.table = Table::new(epoch);
                }
                assert_eq!(epoch, self.table.epoch, "RS1: only the same epoch can be resumed");
                self.resumed = resumed;
                self.parameters = *parameters;
                // These follow if there are any (`PG5`, `OB3`, `WI2`, `DS4`, `DS14`, `GR5`).
                self.programme = None;
                self.obstacles.clear();
                self.widths.clear();
                self.design = None;
                (self.dyes, self.dyed) = (Vec::new(), Vec::new());
                self.grammar = None;
                self.state = state;
                self.done = 0;
                self.take_acknowledgement(acknowledged);
            }
            ServerMessage::Loading { share } => self.loading.push(share),
            ServerMessage::Acknowledged { id } => self.take_acknowledgement(id),
            ServerMessage::Done { id, .. } => self.done = id,
            ServerMessage::Refused { id, problem } => {
                self.unacknowledged.retain(|(other, _)| *other != id);
                self.refused.push((id, problem));
            }
            ServerMessage::Problem { problem } => self.problems.push(problem),
            ServerMessage::State { state } => self.state = state,
            ServerMessage::Parameters { parameters } => self.parameters = *parameters,
            ServerMessage::Programme { programme, by_hand } => {
                self.programme = programme.map(|it| (*it, by_hand))
            }
            ServerMessage::Obstacles { obstacles } => self.obstacles = obstacles,
            ServerMessage::Timeline(timeline) => self.timeline = *timeline,
            ServerMessage::TimelineChanged(change) => self.timeline.change(*change),
            ServerMessage::Widths { widths } => self.widths = widths,
            ServerMessage::Design { design } => self.design = design.map(|design| *design),
            ServerMessage::Dyes { dyes, blocks } => (self.dyes, self.dyed) = (dyes, blocks),
            ServerMessage::Grammar { grammar } => self.grammar = grammar.map(|grammar| *grammar),
            ServerMessage::Appearance { appearance, .. } => {
                self.appearance = *appearance;
                self.appearances += 1;
            }
            ServerMessage::Notice { notice } => self.notices.push(notice),
            ServerMessage::Checksum { .. } => self.checksums += 1,
            // Said to a person, who is not here.
            ServerMessage::Hint { .. }
            | ServerMessage::Deed { .. }
            | ServerMessage::Branches { .. }
            | ServerMessage::Limb { .. }
            | ServerMessage::Authors { .. }
            | ServerMessage::Gathered { .. }
            | ServerMessage::Pins { .. }
            | ServerMessage::ThreadsChanged { .. } => {}
            ServerMessage::People { people, .. } => self.people = people,
            ServerMessage::Role { role } => self.role = Some(role),
            ServerMessage::Pong { nonce, .. } => self.pongs.push(nonce),
        }
    }

    fn take_acknowledgement(&mut self, id: u32) {
        assert!(id >= self.acknowledged, "CM2: {id} is acknowledged after {}", self.acknowledged);
        self.acknowledged = id;
        self.unacknowledged.retain(|(other, _)| *other > id);
    }
}

/// Takes in messages of two clients of one session until their tables are the same, bit for bit.
pub async fn until_equal(a: &mut Client, b: &mut Client) {
    let all = async {
        while a.table.rows != b.table.rows {
            tokio::select! {
                alive = a.take_in() => assert!(alive, "the first connection ended: {:?}", a.closed),
                alive = b.take_in() => assert!(alive, "the second connection ended: {:?}", b.closed),
            }
        }
    };
    if time::timeout(GUARD, all).await.is_err() {
        panic!("the tables stay different: {}", difference(&a.table.rows, &b.table.rows));
    }
}

/// Where two tables differ, for people.
fn difference<T: Debug + PartialEq>(a: &[T], b: &[T]) -> String {
    let all = a.iter().zip(b).filter(|(a, b)| a != b).count();
    let first = a.iter().zip(b).position(|(a, b)| a != b);
    let pair = first.map(|i| (&a[i], &b[i]));
    format!("{} and {} rows, {all} differ, first {first:?}: {pair:?}", a.len(), b.len())
}
