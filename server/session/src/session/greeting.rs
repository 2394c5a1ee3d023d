//! Clients that connect, resume and leave (`HS`, `RS1`).

use std::sync::Arc;

use espalier_proto::{
    ClientMessage, Problem, Resume, ServerMessage, Unreadable,
    frame::CHUNK_ROWS,
    reading,
    version::{CloseCode, PROTOCOL_VERSION},
};
use serde_json::Value;

use super::Session;
use crate::{
    clients::{Client, ConnectedClient, Lacks, PredictionView, View, Watch},
    entrant::Entrant,
    io::ClientId,
    principal::Principal,
    rights::Access,
    to_proto::Held,
    window::Window,
};

/// How long a client may take for its hello, in milliseconds (`HS1`).
const HELLO_MS: u64 = 10_000;
/// Why somebody is not let in under a key.
const KEY_OF_ANOTHER: &str = "this client key is somebody else's: take another one";

impl Session {
    pub(super) fn connect(&mut self, client: ClientId, entrant: Entrant) {
        self.forget(client);
        let access = if self.is_replay { Access::Travel } else { entrant.access() };
        let state = Client {
            entrant,
            access,
            unread: 0,
            lacks: Lacks::default(),
            notified_after: None,
            connected: None,
        };
        self.clients.insert(client, state);
        self.upkeep.hellos.push_back((self.now + HELLO_MS, client));
    }

    pub(super) fn greet(&mut self, client: ClientId, text: &str, message: Result<ClientMessage, Unreadable>) {
        match message {
            Ok(ClientMessage::Hello { protocol, .. }) if protocol != PROTOCOL_VERSION => {
                self.close_version(client)
            }
            Ok(ClientMessage::Hello { client: key, resume, .. }) => match Principal::client(&key) {
                Some(principal) => self.welcome(client, principal, resume),
                None => {
                    let problem = reading::unexpected("client", &key, Principal::KEYS);
                    self.close(client, CloseCode::HelloExpected, &problem.in_close());
                }
            },
            Ok(_) => self.close_without_hello(client, &no_hello(text)),
            Err(Unreadable { problem, .. }) => match hello(text) {
                // The hello of another version may look different in all but its number.
                Some(Some(version)) if version != u64::from(PROTOCOL_VERSION) => self.close_version(client),
                Some(_) => self.close(client, CloseCode::HelloExpected, &problem.in_close()),
                None => self.close_without_hello(client, &no_hello(text)),
            },
        }
    }

    /// Closes a client that has said something else first.
    pub(super) fn close_without_hello(&mut self, client: ClientId, problem: &Problem) {
        self.close(client, CloseCode::HelloExpected, &problem.in_close());
    }

    fn close_version(&mut self, client: ClientId) {
        let sentence = format!("this server speaks protocol {PROTOCOL_VERSION}: load the page again");
        self.close(client, CloseCode::VersionMismatch, &sentence);
    }

    fn welcome(&mut self, client: ClientId, principal: Principal, resume: Option<Resume>) {
        let identity = self.clients.get(&client).map(|client| &client.entrant.identity);
        if identity.is_some_and(|identity| self.is_key_of_another(&principal, identity)) {
            return self.close(client, CloseCode::Replaced, KEY_OF_ANOTHER);
        }
        if let Some(older) = self.authors.get(&principal).and_then(|author| author.client) {
            self.close(older, CloseCode::Replaced, "the same client connected again");
        }
        // Who returns may hold what is gone meanwhile.
        let returns = resume.is_some();
        let author = self.authors.enter(&principal);
        author.client = Some(client);
        author.strokes_end_at = None;
        let acknowledged = author.durable;
        self.upkeep.overdue.remove(&principal);
        let resume = resume.filter(|resume| resume.epoch == self.epoch && is_consistent(resume));
        let resumed = resume.is_some();
        let view = View::Stale(resume.map_or(Held::Nothing, Held::Chunks));
        let presence = self.enter_room(client, &principal);
        if let Some(work) = self.home.take() {
            // Numbers of people may have changed.
            self.timeline = self.line_of(&work.document);
            self.upkeep.timeline_changed |= self.timeline != self.told_timeline;
            self.home = Some(work);
        }
        if let Some(client) = self.clients.get_mut(&client) {
            client.connected = Some(ConnectedClient {
                principal,
                done: 0,
                window: Window::default(),
                view,
                watch: Watch::default(),
                prediction_view: PredictionView::default(),
                looked_at: None,
                asked_limb: None,
                presence,
                is_checking: false,
            });
        }
        let welcome = ServerMessage::Welcome {
            protocol: PROTOCOL_VERSION,
            session: self.name.clone(),
            epoch: self.epoch,
            resumed,
            acknowledged,
            parameters: Box::new(self.parameters.clone()),
            state: self.state(),
        };
        self.send(client, &welcome);
        if self.programme.is_there() {
            self.send(client, &self.programme.message());
        }
        self.send(client, &self.appearance_message());
        if !self.scenery.obstacles.is_empty() {
            self.send(client, &self.obstacles_message());
        }
        if !self.widths.is_empty() {
            self.send(client, &ServerMessage::Widths { widths: self.widths.clone() });
        }
        if self.design.is_some() || returns {
            self.send(client, &self.design_message());
        }
        if !self.dyes.are_none() || returns {
            self.send(client, &self.dyes_message());
        }
        if self.grammar.is_some() || returns {
            self.send(client, &self.grammar_message());
        }
        // As all others have it: what has changed since comes to everybody.
        self.send(client, &ServerMessage::Timeline(Box::new(self.told_timeline.clone())));
        if self.is_replay {
            self.send(client, &self.authors_message());
        }
        self.show_pins(client);
        // Who resumes has been notified before, for the epoch is the same (`OP3`).
        let notices = if resumed { Vec::new() } else { self.notices.clone() };
        let is_notified = !notices.is_empty();
        for notice in notices {
            self.send(client, &ServerMessage::Notice { notice });
        }
        if let Some(client) = self.clients.get_mut(&client).filter(|_| is_notified) {
            client.notified_after = Some(client.unread);
        }
        self.upkeep.state_changed = true;
    }

    /// Whether a key is known as that of somebody else than this one (`HS4`). In a replay nobody does anything.
    pub(super) fn is_key_of_another(&self, key: &Principal, identity: &Arc<str>) -> bool {
        !self.is_replay && self.room.register.is_of_another(key, identity)
    }

    pub(super) fn forget(&mut self, id: ClientId) {
        let Some(Client { connected: Some(connected), .. }) = self.clients.remove(&id) else { return };
        connected.prediction_view.cancel();
        self.author_left(&connected.principal, id);
        self.leave_room(connected.presence.device);
        self.upkeep.state_changed = true;
    }
}

fn is_consistent(resume: &Resume) -> bool {
    (resume.rows as usize).div_ceil(CHUNK_ROWS) == resume.generations.len()
}

/// What is wrong with a first message that is no hello.
fn no_hello(text: &str) -> Problem {
    let value = serde_json::from_str::<Value>(text);
    let kind = value.as_ref().map(|value| value.as_object().map(|fields| fields.get("type")));
    match kind {
        Err(_) => reading::unexpected("message", "no JSON", "a hello"),
        Ok(None) => reading::unexpected("message", "no object", "a hello"),
        Ok(Some(None)) => reading::unexpected("type", "missing", "hello"),
        Ok(Some(Some(Value::String(kind)))) => reading::unexpected("type", kind, "hello"),
        Ok(Some(Some(other))) => reading::unexpected("type", &other.to_string(), "hello"),
    }
}

/// Of a hello that cannot be read, the version that it states, if it states any; nothing of other messages.
fn hello(text: &str) -> Option<Option<u64>> {
    let value: Value = serde_json::from_str(text).ok()?;
    let is_hello = value.get("type").and_then(Value::as_str) == Some("hello");
    is_hello.then(|| value.get("protocol").and_then(Value::as_u64))
}
