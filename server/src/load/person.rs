//! Somebody in a session, as the page would be: answers frames, and may draw.

use std::{collections::VecDeque, time::Duration};

use espalier_proto::{
    ClientMessage, DocumentState, FrameKind, Reason, ServerMessage, version::PROTOCOL_VERSION,
};
use futures_util::{SinkExt, StreamExt};
use serde_json::{Value, json};
use tokio::{
    net::TcpStream,
    time::{Instant, MissedTickBehavior, interval_at, timeout},
};
use tokio_tungstenite::{
    WebSocketStream, client_async,
    tungstenite::{Message, client::IntoClientRequest, http::header::AUTHORIZATION},
};
use tokio_util::sync::CancellationToken;

use super::{
    LoadError,
    delays::Delays,
    site::{GUARD, Site},
};

/// So often a hand sends what it drew.
const EVERY: Duration = Duration::from_millis(100);
/// Parts of a stroke.
const MOVES: u32 = 20;
/// Where strokes go, seen from above.
const AROUND: [[f32; 2]; 6] = [[1.0, 0.0], [-0.5, 0.9], [-0.4, -0.9], [0.5, 0.8], [-1.0, 0.1], [0.6, -0.8]];

/// Somebody in a session.
#[derive(Debug)]
pub struct Person {
    socket: WebSocketStream<TcpStream>,
    state: DocumentState,
    next: u32,
    /// Commands that are not acknowledged, with when they were sent.
    unacknowledged: VecDeque<(u32, Instant)>,
    /// What was drawn last and has shown nothing yet.
    unseen: Option<(u32, Instant)>,
    done: u32,
    measured: Measured,
}

/// What somebody who drew has seen.
#[derive(Debug, Default)]
pub struct Measured {
    /// From a part of a stroke to the first frame after it.
    pub to_delta: Delays,
    /// From a command to its acknowledgement.
    pub to_acknowledged: Delays,
    /// Parts of strokes by which nothing grew.
    pub in_vain: u64,
    /// Commands that were refused.
    pub refused: u64,
}

impl Measured {
    /// What others have seen as well.
    pub fn append(&mut self, others: Self) {
        self.to_delta.append(others.to_delta);
        self.to_acknowledged.append(others.to_acknowledged);
        self.in_vain += others.in_vain;
        self.refused += others.refused;
    }
}

impl Person {
    /// Comes into a session under this key.
    pub async fn join(site: &Site, session: &str, key: &str) -> Result<Self, LoadError> {
        let lost = |error: &dyn std::fmt::Display| LoadError::Lost(format!("{session}: {error}"));
        let mut request = site.socket(session).into_client_request().map_err(|error| lost(&error))?;
        if let Some(bearer) = site.bearer().and_then(|bearer| bearer.parse().ok()) {
            request.headers_mut().insert(AUTHORIZATION, bearer);
        }
        let stream = site.connect().await?;
        let (socket, _) = client_async(request, stream).await.map_err(|error| lost(&error))?;
        let mut person = Self {
            socket,
            state: DocumentState::default(),
            next: 1,
            unacknowledged: VecDeque::new(),
            unseen: None,
            done: 0,
            measured: Measured::default(),
        };
        let hello = ClientMessage::Hello { protocol: PROTOCOL_VERSION, client: key.into(), resume: None };
        person.say(&json!(hello)).await?;
        let mut is_welcome = false;
        while !is_welcome {
            is_welcome = matches!(person.hear().await?, Some(ServerMessage::Welcome { .. }));
        }
        Ok(person)
    }

    /// Grows the tree until it has so many metamers.
    pub async fn grow_to(&mut self, metamers: u32) -> Result<(), LoadError> {
        while self.state.metamers < metamers {
            let before = self.state.metamers;
            let id = self.command(&json!({ "kind": "grow", "steps": 1 })).await?;
            self.until_done(id).await?;
            if self.state.paused.is_some() || self.state.metamers <= before {
                return Err(LoadError::Lost(format!("the tree does not grow beyond {before} metamers")));
            }
        }
        Ok(())
    }

    /// Has growth begin, and waits for nothing.
    pub async fn command(&mut self, command: &Value) -> Result<u32, LoadError> {
        let id = self.next;
        self.next += 1;
        self.unacknowledged.push_back((id, Instant::now()));
        self.say(&json!({ "type": "command", "id": id, "command": command })).await?;
        Ok(id)
    }

    /// Takes in what comes until nothing is left to do of what was asked for.
    pub async fn until_done(&mut self, id: u32) -> Result<(), LoadError> {
        while self.done < id {
            self.hear().await?;
        }
        Ok(())
    }

    /// Takes in what comes for so long.
    pub async fn stay(&mut self, until: Instant) -> Result<(), LoadError> {
        while let Ok(heard) = tokio::time::timeout_at(until, self.hear()).await {
            heard?;
        }
        Ok(())
    }

    /// Takes in what comes until something has happened: whoever reads nothing is let go (`FL3`).
    pub async fn wait(mut self, happened: CancellationToken) -> Result<Self, LoadError> {
        loop {
            tokio::select! {
                biased;
                () = happened.cancelled() => return Ok(self),
                heard = hear(&mut self.socket) => { self.take(heard?).await?; }
            }
        }
    }

    /// Draws strokes around the tree, ten parts of them a second, each taken back when it has ended, so that the tree stays as
    /// large as it is.
    pub async fn draw(&mut self, first: Instant, until: Instant) -> Result<(), LoadError> {
        let mut ticks = interval_at(first, EVERY);
        ticks.set_missed_tick_behavior(MissedTickBehavior::Delay);
        let mut part = 0;
        while Instant::now() < until {
            tokio::select! {
                biased;
                heard = hear(&mut self.socket) => { self.take(heard?).await?; }
                _ = ticks.tick() => {
                    self.draw_part(part).await?;
                    part += 1;
                }
            }
        }
        Ok(())
    }

    async fn draw_part(&mut self, part: u32) -> Result<(), LoadError> {
        let (stroke, place) = (part / (MOVES + 2), part % (MOVES + 2));
        if place == 0 {
            self.command(&json!({ "kind": "stroke_begin", "stroke": stroke })).await?;
        } else if place <= MOVES {
            // Around the crown and upwards, where there is room.
            let [x, z] = AROUND[stroke as usize % AROUND.len()];
            let (out, height) = (2.0 + place as f32 * 0.8, 4.0 + place as f32 * 0.9);
            let position = [out * x, height, out * z];
            let samples = json!([{ "position": position, "radius": 2.0 }]);
            let id =
                self.command(&json!({ "kind": "stroke_move", "stroke": stroke, "samples": samples })).await?;
            self.unseen.get_or_insert((id, Instant::now()));
        } else {
            self.command(&json!({ "kind": "stroke_end", "stroke": stroke })).await?;
            self.command(&json!({ "kind": "undo" })).await?;
        }
        Ok(())
    }

    /// What was measured, and the goodbye.
    pub async fn leave(mut self) -> Measured {
        // The server may have gone; what was measured was measured.
        let _ = timeout(Duration::from_secs(2), self.socket.close(None)).await;
        self.measured
    }

    async fn say(&mut self, message: &Value) -> Result<(), LoadError> {
        let sent = self.socket.send(Message::text(message.to_string())).await;
        sent.map_err(|error| LoadError::Lost(error.to_string()))
    }

    async fn hear(&mut self) -> Result<Option<ServerMessage>, LoadError> {
        let heard = hear(&mut self.socket).await?;
        self.take(heard).await
    }

    async fn take(&mut self, message: Message) -> Result<Option<ServerMessage>, LoadError> {
        match message {
            Message::Text(text) => {
                let message: ServerMessage = serde_json::from_str(&text)
                    .map_err(|error| LoadError::Lost(format!("a message cannot be read: {error}")))?;
                self.note(&message);
                Ok(Some(message))
            }
            Message::Binary(frame) => {
                let kind = FrameKind::of(&frame).unwrap_or(FrameKind::MeshDelta);
                if kind == FrameKind::MeshDelta
                    && let Some((_, sent)) = self.unseen.take()
                {
                    self.measured.to_delta.push(sent.elapsed());
                }
                let sequence = FrameKind::sequence_of(&frame).unwrap_or(0);
                let received = json!({ "type": "received", "sequence": sequence, "kind": kind.code() });
                self.say(&received).await?;
                Ok(None)
            }
            Message::Close(frame) => {
                let why = frame
                    .map_or("without a word".into(), |frame| format!("{}: {}", frame.code, frame.reason));
                Err(LoadError::Lost(format!("the server closed the socket ({why})")))
            }
            _ => Ok(None),
        }
    }

    fn note(&mut self, message: &ServerMessage) {
        match message {
            ServerMessage::Welcome { state, .. } | ServerMessage::State { state } => {
                self.state = state.clone()
            }
            ServerMessage::Acknowledged { id } => {
                while let Some((_, sent)) = self.unacknowledged.pop_front_if(|(sent, _)| *sent <= *id) {
                    self.measured.to_acknowledged.push(sent.elapsed());
                }
            }
            ServerMessage::Refused { id, problem } => {
                self.unacknowledged.retain(|(sent, _)| sent != id);
                self.measured.refused += 1;
                if problem.reason == Reason::Behind {
                    // Its number was not taken, nor is any after it.
                    self.next = self.next.min(*id);
                }
            }
            ServerMessage::Done { id, .. } => {
                self.done = self.done.max(*id);
                if self.unseen.take_if(|(drawn, _)| *drawn <= *id).is_some() {
                    self.measured.in_vain += 1;
                }
            }
            _ => {}
        }
    }
}

async fn hear(socket: &mut WebSocketStream<TcpStream>) -> Result<Message, LoadError> {
    match timeout(GUARD, socket.next()).await {
        Ok(Some(Ok(message))) => Ok(message),
        Ok(Some(Err(error))) => Err(LoadError::Lost(error.to_string())),
        Ok(None) => Err(LoadError::Lost("the connection ended".into())),
        Err(_) => Err(LoadError::Lost("the server says nothing".into())),
    }
}
