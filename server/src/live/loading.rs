//! How far a session is loaded, and telling that to whoever waits for it (`HS8`).

use std::time::Duration;

use axum::extract::ws::{Message, WebSocket};
use espalier_proto::ServerMessage;
use futures_util::{FutureExt, Sink, SinkExt};
use tokio::{
    sync::watch,
    task::JoinHandle,
    time::{sleep, timeout},
};

use super::{handle::SessionHandle, registry::Sessions, restoring::OpenError};
use crate::pool::Panicked;

/// How much of the time it takes to read a session from the database, before it is made of what was read.
const READING: f32 = 0.2;
/// So often it is told at most how far a session is,
const PAUSE: Duration = Duration::from_millis(100);
/// and at least, so that whoever waits knows that the server is at it.
const AGAIN: Duration = Duration::from_secs(2);

/// How far a session is loaded. Copies are of the same.
#[derive(Clone, Debug)]
pub(super) struct Progress(watch::Sender<Option<f32>>);

impl Default for Progress {
    fn default() -> Self {
        Self(watch::Sender::new(None))
    }
}

impl Progress {
    /// There is such a session.
    pub(super) fn begun(&self) {
        self.0.send_replace(Some(0.0));
    }

    /// It is read from the database.
    pub(super) fn read(&self) {
        self.0.send_replace(Some(READING));
    }

    /// This share of it is made of what was read.
    pub(super) fn made(&self, share: f32) {
        self.0.send_replace(Some(READING + (1.0 - READING) * share));
    }

    pub(super) fn watched(&self) -> watch::Receiver<Option<f32>> {
        self.0.subscribe()
    }
}

/// A session that is being opened; dropping it stops nothing.
#[derive(Debug)]
pub(super) struct Opening {
    task: JoinHandle<Result<Option<SessionHandle>, OpenError>>,
    /// How far it is, where it was not in memory already.
    pub(super) share: Option<watch::Receiver<Option<f32>>>,
}

impl Opening {
    pub(super) fn new(
        task: JoinHandle<Result<Option<SessionHandle>, OpenError>>,
        share: Option<watch::Receiver<Option<f32>>>,
    ) -> Self {
        Self { task, share }
    }

    /// Waits for it.
    pub(super) async fn opened(self) -> Result<Option<SessionHandle>, OpenError> {
        self.task.await.unwrap_or(Err(OpenError::Panicked(Panicked)))
    }
}

/// Opens a session for somebody who is told meanwhile how far it is.
pub async fn open(
    socket: &mut WebSocket,
    sessions: &Sessions,
    name: &str,
) -> Result<Option<SessionHandle>, OpenError> {
    let mut opening = sessions.opening(name);
    if let Some(share) = opening.share.take() {
        let mut opened = opening.opened().boxed();
        return tokio::select! {
            opened = &mut opened => opened,
            // Whoever has gone is noticed once the session is there.
            () = tell(socket, share) => opened.await,
        };
    }
    opening.opened().await
}

/// Tells how far a session is, until nobody listens or it can get no further.
async fn tell(mut socket: impl Sink<Message> + Unpin, mut share: watch::Receiver<Option<f32>>) {
    loop {
        let now = *share.borrow_and_update();
        if let Some(now) = now {
            // A number always has a JSON form.
            let text = serde_json::to_string(&ServerMessage::Loading { share: now }).unwrap_or_default();
            if socket.send(Message::Text(text.into())).await.is_err() {
                return;
            }
            sleep(PAUSE).await;
        }
        if let Ok(Err(_)) = timeout(AGAIN, share.changed()).await {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use std::pin::pin;

    use futures_util::sink;
    use tokio::sync::mpsc;

    use super::*;

    /// Somebody who hears what is told.
    fn socket() -> (impl Sink<Message>, mpsc::UnboundedReceiver<Message>) {
        let (says, hears) = mpsc::unbounded_channel();
        let socket = sink::unfold(says, async |says: mpsc::UnboundedSender<Message>, message| {
            says.send(message).map(|()| says)
        });
        (socket, hears)
    }

    #[tokio::test]
    async fn hs8_whoever_waits_is_told_how_far_a_session_is() {
        let progress = Progress::default();
        let (socket, mut hears) = socket();
        let socket = pin!(socket);
        let mut telling = pin!(tell(socket, progress.watched()));
        let mut next = async || {
            tokio::select! {
                () = &mut telling => panic!("it is told no longer"),
                heard = hears.recv() => heard.unwrap().to_text().unwrap().to_owned(),
            }
        };
        let said = |share: f32| format!(r#"{{"type":"loading","share":{share:?}}}"#);
        progress.begun();
        assert_eq!(next().await, said(0.0));
        // What changes in a moment is told as one.
        progress.read();
        progress.made(0.0);
        progress.made(0.5);
        assert_eq!(next().await, said(0.6));
        progress.made(1.0);
        assert_eq!(next().await, said(1.0));
        assert_eq!(next().await, said(1.0), "again, after a while");
        drop(progress);
        telling.await;
    }

    #[tokio::test]
    async fn hs8_nothing_is_told_to_whoever_has_gone() {
        let progress = Progress::default();
        progress.begun();
        let (socket, hears) = socket();
        drop(hears);
        tell(pin!(socket), progress.watched()).await;
    }
}
