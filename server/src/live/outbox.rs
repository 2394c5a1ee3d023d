//! What waits to be written to one socket.
//!
//! The lane has no bound of its own: the session counts unread control messages (`FL3`) and sends frames only as
//! far as the client's window reaches (`FL1`). Beside it lies what is written when the lane is empty: one frame of
//! presence, which a newer one replaces, and the question whether somebody is there (`PS`).

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use espalier_proto::version::CloseCode;
use tokio::sync::{Notify, mpsc};
use tokio_util::sync::CancellationToken;

/// Something to write.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Outgoing {
    Text(Arc<str>),
    Frame(Arc<[u8]>),
}

/// The session's end: never waits.
#[derive(Clone, Debug)]
pub(super) struct Outbox {
    lane: mpsc::UnboundedSender<Outgoing>,
    beside: Arc<Beside>,
    closing: Closing,
}

/// The socket's end.
#[derive(Debug)]
pub(super) struct Outgoings {
    pub(super) lane: mpsc::UnboundedReceiver<Outgoing>,
    pub(super) beside: Arc<Beside>,
    pub(super) closing: Closing,
}

/// What is written when the lane is empty.
#[derive(Debug, Default)]
pub(super) struct Beside {
    waiting: Mutex<Waiting>,
    put: Notify,
}

/// What lies beside the lane.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Waiting {
    /// The newest frame of presence.
    pub(super) presence: Option<Arc<[u8]>>,
    /// Whether it is to be asked if somebody is there.
    pub(super) ping: bool,
}

impl Beside {
    fn put(&self, change: impl FnOnce(&mut Waiting)) {
        change(&mut self.waiting.lock().unwrap_or_else(PoisonError::into_inner));
        self.put.notify_one();
    }

    /// Waits until something lies here, and takes it.
    pub(super) async fn take(&self) -> Waiting {
        loop {
            let waiting = std::mem::take(&mut *self.waiting.lock().unwrap_or_else(PoisonError::into_inner));
            if waiting != Waiting::default() {
                return waiting;
            }
            self.put.notified().await;
        }
    }
}

/// Why and how the socket is to be closed, once that is decided.
#[derive(Clone, Debug, Default)]
pub(super) struct Closing {
    farewell: Arc<OnceLock<Farewell>>,
    decided: CancellationToken,
}

/// The last message to a client, as the reason of the close.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Farewell {
    pub(super) code: CloseCode,
    pub(super) sentence: String,
}

pub(super) fn lane() -> (Outbox, Outgoings) {
    let (sender, receiver) = mpsc::unbounded_channel();
    let (closing, beside) = (Closing::default(), Arc::<Beside>::default());
    let outbox = Outbox { lane: sender, beside: Arc::clone(&beside), closing: closing.clone() };
    (outbox, Outgoings { lane: receiver, beside, closing })
}

impl Outbox {
    pub(super) fn send(&self, outgoing: Outgoing) {
        // The socket may be gone already; its end tells the session so.
        let _ = self.lane.send(outgoing);
    }

    /// Takes the place of the frame of presence that still waits, if one does.
    pub(super) fn show(&self, frame: Arc<[u8]>) {
        self.beside.put(|waiting| waiting.presence = Some(frame));
    }

    /// Asks whether somebody is there; twice is once where the first question still waits.
    pub(super) fn ping(&self) {
        self.beside.put(|waiting| waiting.ping = true);
    }

    pub(super) fn close(&self, code: CloseCode, sentence: String) {
        self.closing.decide(Farewell { code, sentence });
    }
}

impl Closing {
    /// The first decision stands.
    pub(super) fn decide(&self, farewell: Farewell) {
        let _ = self.farewell.set(farewell);
        self.decided.cancel();
    }

    pub(super) fn is_decided(&self) -> bool {
        self.decided.is_cancelled()
    }

    pub(super) async fn decided(&self) {
        self.decided.cancelled().await;
    }

    /// Without a decision the session vanished.
    pub(super) fn farewell(&self) -> Farewell {
        self.farewell.get().cloned().unwrap_or_else(|| Farewell {
            code: CloseCode::InternalError,
            sentence: "The session failed; it is loaded again when you come back.".into(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn what_waits_keeps_its_order() {
        let (outbox, mut outgoings) = lane();
        let sent = || {
            [Outgoing::Text("welcome".into()), Outgoing::Frame([1, 2].into()), Outgoing::Text("state".into())]
        };
        for outgoing in sent() {
            outbox.send(outgoing);
        }
        drop(outbox);
        for expected in sent() {
            assert_eq!(outgoings.lane.recv().await, Some(expected));
        }
        assert_eq!(outgoings.lane.recv().await, None);
        assert_eq!(outgoings.closing.farewell().code, CloseCode::InternalError);
    }

    #[tokio::test]
    async fn ps2_of_presence_the_newest_waits_alone() {
        let (outbox, outgoings) = lane();
        for number in 0..200 {
            outbox.show([number].into());
            outbox.ping();
        }
        assert_eq!(outgoings.beside.take().await, Waiting { presence: Some([199].into()), ping: true });
        outbox.show([7].into());
        assert_eq!(outgoings.beside.take().await, Waiting { presence: Some([7].into()), ping: false });
    }

    #[tokio::test]
    async fn the_first_reason_to_close_stands() {
        let (outbox, outgoings) = lane();
        assert!(!outgoings.closing.is_decided());
        outbox.close(CloseCode::MessageTooBig, "first".into());
        outbox.close(CloseCode::TooSlow, "second".into());
        outgoings.closing.decided().await;
        assert_eq!(outgoings.closing.farewell().sentence, "first");
    }
}
