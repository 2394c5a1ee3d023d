//! Clients that connect, resume and leave (`HS`, `RS1`).

use std::sync::Arc;

use espalier_proto::{
    ClientMessage, Resume, ServerMessage, Unreadable,
    frame::CHUNK_ROWS,
    version::{CloseCode, PROTOCOL_VERSION},
};
use serde_json::Value;

use super::Session;
use crate::{
    clients::{Client, ConnectedClient, PredictionView, View, Watch},
    io::ClientId,
    principal::Principal,
    rights::Access,
    to_proto::Held,
    window::Window,
};

/// How long a client may take for its hello, in milliseconds (`HS1`).
const HELLO_MS: u64 = 10_000;

impl Session {
    pub(super) fn connect(&mut self, client: ClientId) {
        self.forget(client);
        self.clients.insert(client, Client::default());
        self.upkeep.hellos.push_back((self.now + HELLO_MS, client));
    }

    pub(super) fn greet(&mut self, client: ClientId, text: &str, message: Result<ClientMessage, Unreadable>) {
        match message {
            Ok(ClientMessage::Hello { protocol, .. }) if protocol != PROTOCOL_VERSION => {
                self.close_version(client)
            }
            Ok(ClientMessage::Hello { client: key, resume, .. }) => match Principal::client(&key) {
                Some(principal) => match self.rights.ask(&principal, Access::Join) {
                    Ok(()) => self.welcome(client, principal, resume),
                    Err(problem) => self.close(client, CloseCode::CannotOpen, &problem.in_close()),
                },
                None => {
                    let sentence = "a client key has 8 to 64 letters, digits, hyphens and underscores";
                    self.close(client, CloseCode::HelloExpected, sentence);
                }
            },
            // The hello of another version may look different in all but its number.
            Err(_) if states_another_version(text) => self.close_version(client),
            _ => self.close(client, CloseCode::HelloExpected, "the first message must be a hello"),
        }
    }

    fn close_version(&mut self, client: ClientId) {
        let sentence = format!("this server speaks protocol {PROTOCOL_VERSION}: load the page again");
        self.close(client, CloseCode::VersionMismatch, &sentence);
    }

    fn welcome(&mut self, client: ClientId, principal: Principal, resume: Option<Resume>) {
        let key = Arc::clone(principal.name());
        if let Some(older) = self.authors.get(&key).and_then(|author| author.client) {
            self.close(older, CloseCode::Replaced, "the same client connected again");
        }
        let author = self.authors.enter(&key);
        author.client = Some(client);
        author.strokes_end_at = None;
        let acknowledged = author.durable;
        self.upkeep.overdue.remove(&key);
        let resume = resume.filter(|resume| resume.epoch == self.epoch && is_consistent(resume));
        let resumed = resume.is_some();
        let view = View::Stale(resume.map_or(Held::Nothing, Held::Chunks));
        if let Some(client) = self.clients.get_mut(&client) {
            client.connected = Some(ConnectedClient {
                principal,
                window: Window::default(),
                view,
                watch: Watch::default(),
                prediction_view: PredictionView::default(),
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
        self.send(client, &ServerMessage::Timeline(Box::new(self.timeline.clone())));
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

    pub(super) fn forget(&mut self, id: ClientId) {
        let Some(Client { connected: Some(connected), .. }) = self.clients.remove(&id) else { return };
        connected.prediction_view.cancel();
        self.author_left(connected.principal.name(), id);
        self.upkeep.state_changed = true;
    }
}

fn is_consistent(resume: &Resume) -> bool {
    (resume.rows as usize).div_ceil(CHUNK_ROWS) == resume.generations.len()
}

fn states_another_version(text: &str) -> bool {
    let Ok(value) = serde_json::from_str::<Value>(text) else { return false };
    let version = value.get("protocol").and_then(Value::as_u64);
    value.get("type").and_then(Value::as_str) == Some("hello")
        && version.is_some_and(|version| version != u64::from(PROTOCOL_VERSION))
}
