//! One WebSocket: what it says goes to its session, what the session says goes out.

use std::{error::Error, future::pending, io::ErrorKind, pin::pin, time::Duration};

use axum::{
    body::Bytes,
    extract::ws::{CloseFrame, Message, Utf8Bytes, WebSocket},
};
use espalier_proto::access::Role;
use espalier_proto::version::{CloseCode, MAX_MESSAGE_BYTES};
use espalier_session::{ClientId, Entrant};
use futures_util::{SinkExt, Stream, StreamExt, stream::SplitSink};
use tokio::time::{Instant, MissedTickBehavior, interval, sleep, sleep_until, timeout};
use tokio_tungstenite::tungstenite::{self, error::ProtocolError};

use super::{
    handle::{Request, SessionHandle},
    outbox::{self, Closing, Farewell, Outgoing, Outgoings},
};
use crate::listener::Unfinished;

/// The server asks so often whether the other side is still there,
const PING_INTERVAL: Duration = Duration::from_secs(20);
/// and after so long without any sign lets go: a tablet that fell asleep says no goodbye.
const SILENCE: Duration = Duration::from_secs(60);
/// The other side may ask so often; of one that asks oftener no more is read meanwhile, for answers that nobody reads
/// would pile up.
const PING_PAUSE: Duration = Duration::from_millis(50);
/// How long what waits may take to go out once the socket is to be closed.
const LAST_WORDS: Duration = Duration::from_secs(2);
/// How long the other side may take to answer a close.
const CLOSING: Duration = Duration::from_secs(2);
/// The same of a server that stops: the next one waits for its end.
const STOPPING: Duration = Duration::from_millis(800);

/// Tells a session what somebody may do from now on.
#[derive(Clone, Debug)]
pub struct Grants {
    session: SessionHandle,
    client: ClientId,
}

impl Grants {
    /// They may do what this role may.
    pub async fn grant(&self, role: Role) {
        // Fails when the session has ended, and the socket with it.
        let _ = self.session.send(Request::Grant(self.client, role)).await;
    }
}

/// Connects a socket with a session for somebody until one of them ends; or until they may not go on, with the code and
/// the reason that `let_out` gives, which also tells what they may do when that changes.
pub async fn serve<LetOut: Future<Output = (CloseCode, String)>>(
    socket: WebSocket,
    unfinished: Unfinished,
    session: SessionHandle,
    entrant: Entrant,
    let_out: impl FnOnce(Grants) -> LetOut,
) {
    let (outbox, outgoings) = outbox::lane();
    let closing = outgoings.closing.clone();
    let Ok(client) = session.join(outbox, entrant).await else {
        return turn_away(socket, CloseCode::GoingAway, "The session is being put away; come back.").await;
    };
    let (sink, stream) = socket.split();
    let stream = stream.inspect(move |heard| match heard {
        // They may come between the pieces of a message.
        Ok(Message::Ping(payload) | Message::Pong(payload)) => unfinished.came_between(payload.len()),
        _ => unfinished.is_whole(),
    });
    let mut reading = pin!(read(stream, &session, client, &closing, SILENCE));
    {
        let mut writing = pin!(write(sink, outgoings, &session, client));
        let let_out = let_out(Grants { session: session.clone(), client });
        let watching = async {
            let (code, sentence) = let_out.await;
            closing.decide(Farewell { code, sentence });
            pending::<()>().await;
        };
        tokio::select! {
            () = watching => {}
            heard = &mut reading => if heard == Heard::Refused {
                writing.as_mut().await;
            },
            () = &mut writing => {
                // The close frame is sent. What the client still sends is read, so that it can read the frame.
                let _ = timeout(patience(closing.farewell().code), &mut reading).await;
            }
        }
    }
    // Fails when the session itself has ended.
    let _ = session.send(Request::Leave(client)).await;
}

/// Closes a socket that no session takes.
pub async fn turn_away(mut socket: WebSocket, code: CloseCode, sentence: &str) {
    let close = close_message(&Farewell { code, sentence: sentence.into() });
    let closed = async {
        if socket.send(close).await.is_ok() {
            while let Some(Ok(_)) = socket.recv().await {}
        }
    };
    let _ = timeout(CLOSING, closed).await;
}

/// How reading ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Heard {
    /// The other side has said goodbye and been answered, or has gone.
    Nothing,
    /// What cannot be read, or nothing for too long. It is decided how the socket closes.
    Refused,
}

async fn read(
    mut stream: impl Stream<Item = Result<Message, axum::Error>> + Unpin,
    session: &SessionHandle,
    client: ClientId,
    closing: &Closing,
    silence: Duration,
) -> Heard {
    let mut next_ping = Instant::now();
    loop {
        let Ok(message) = timeout(silence, stream.next()).await else {
            let sentence = format!("There was no sign of you for {} s.", silence.as_secs());
            closing.decide(Farewell { code: CloseCode::Silent, sentence });
            return Heard::Refused;
        };
        let Some(message) = message else { return Heard::Nothing };
        let request = match message {
            Ok(Message::Text(text)) => Request::Text(client, text.as_str().into()),
            Ok(Message::Binary(_)) => Request::Binary(client),
            // A goodbye is answered while the next message is asked for, of which there is none.
            Ok(Message::Close(_)) => continue,
            Ok(Message::Pong(_)) => Request::Heard(client),
            Ok(Message::Ping(_)) => {
                sleep_until(next_ping).await;
                next_ping = Instant::now() + PING_PAUSE;
                continue;
            }
            Err(error) => {
                let Some(farewell) = refusal(&error) else { return Heard::Nothing };
                closing.decide(farewell);
                return Heard::Refused;
            }
        };
        if !closing.is_decided() {
            // Fails when the session has ended; then the writing side says goodbye.
            let _ = session.send(request).await;
        }
    }
}

/// What is said to a client whose bytes are no messages, unless it has just gone.
fn refusal(error: &axum::Error) -> Option<Farewell> {
    let (code, sentence) = match error.source()?.downcast_ref()? {
        tungstenite::Error::Capacity(_) => {
            let sentence = format!("A message may have {} KiB at most.", MAX_MESSAGE_BYTES / 1024);
            (CloseCode::MessageTooBig, sentence)
        }
        tungstenite::Error::Io(error) if error.kind() == ErrorKind::OutOfMemory => {
            (CloseCode::TryAgainLater, "memory-full: there is no memory for so long a message now.".into())
        }
        tungstenite::Error::Utf8(_) => (CloseCode::NotText, "A text is not UTF-8.".into()),
        tungstenite::Error::Protocol(ProtocolError::ResetWithoutClosingHandshake) => return None,
        tungstenite::Error::Protocol(error) => (CloseCode::ProtocolError, format!("{error}.")),
        _ => return None,
    };
    Some(Farewell { code, sentence })
}

async fn write(
    mut sink: SplitSink<WebSocket, Message>,
    mut outgoings: Outgoings,
    session: &SessionHandle,
    client: ClientId,
) {
    let closing = outgoings.closing.clone();
    let connected = tokio::select! {
        connected = forward(&mut sink, &mut outgoings, session, client) => connected.is_ok(),
        () = out_of_patience(&closing) => true,
    };
    if connected {
        let farewell = closing.farewell();
        let _ = timeout(patience(farewell.code), sink.send(close_message(&farewell))).await;
    }
}

/// Writes until the socket is to be closed and nothing waits any more.
async fn forward(
    sink: &mut SplitSink<WebSocket, Message>,
    outgoings: &mut Outgoings,
    session: &SessionHandle,
    client: ClientId,
) -> Result<(), axum::Error> {
    let mut pings = interval(PING_INTERVAL);
    pings.set_missed_tick_behavior(MissedTickBehavior::Delay);
    loop {
        tokio::select! {
            biased;
            // First, so that whoever is told much is asked all the same whether they are still there.
            _ = pings.tick() => sink.send(Message::Ping(Bytes::new())).await?,
            outgoing = outgoings.lane.recv() => match outgoing {
                Some(Outgoing::Text(text)) => {
                    sink.send(Message::Text(Utf8Bytes::from(&*text))).await?;
                    // Fails when the session has ended; then the lane ends too.
                    let _ = session.send(Request::Written(client, 1)).await;
                }
                Some(Outgoing::Frame(frame)) => sink.send(Message::Binary(Bytes::from_owner(frame))).await?,
                None => return Ok(()),
            },
            () = outgoings.closing.decided() => return Ok(()),
            waiting = outgoings.beside.take() => {
                if waiting.ping {
                    sink.send(Message::Ping(Bytes::new())).await?;
                }
                if let Some(frame) = waiting.presence {
                    sink.send(Message::Binary(Bytes::from_owner(frame))).await?;
                }
            }
        }
    }
}

/// How long the other side may take to answer a close with this code.
fn patience(code: CloseCode) -> Duration {
    if code == CloseCode::GoingAway { STOPPING } else { CLOSING }
}

/// Waits until the socket must be closed whether or not anybody reads.
async fn out_of_patience(closing: &Closing) {
    closing.decided().await;
    match closing.farewell().code {
        CloseCode::TooSlow => {}
        CloseCode::GoingAway => sleep(STOPPING).await,
        _ => sleep(LAST_WORDS).await,
    }
}

fn close_message(farewell: &Farewell) -> Message {
    Message::Close(Some(CloseFrame {
        code: farewell.code.into(),
        reason: shortened(&farewell.sentence).into(),
    }))
}

/// The reason of a close has 123 bytes at most (RFC 6455, 5.5).
fn shortened(sentence: &str) -> &str {
    &sentence[..sentence.floor_char_boundary(123)]
}

#[cfg(test)]
mod tests {
    use futures_util::stream;
    use tokio::sync::mpsc;

    use super::*;

    #[tokio::test]
    async fn hs9_silence_closes_with_a_code_and_a_sentence() {
        let (requests, mut requested) = mpsc::channel(4);
        let session = SessionHandle::new(requests);
        // A last sign, and then nothing.
        let signs = stream::iter([Ok(Message::Pong(Bytes::new()))]).chain(stream::pending());
        let closing = Closing::default();
        let heard = read(signs.boxed(), &session, ClientId(1), &closing, Duration::from_millis(20)).await;
        assert_eq!(heard, Heard::Refused, "so that the close is written");
        assert!(matches!(requested.recv().await, Some(Request::Heard(ClientId(1)))));
        let farewell = closing.farewell();
        assert_eq!(farewell.code, CloseCode::Silent);
        assert!(farewell.sentence.starts_with("There was no sign of you for"), "{}", farewell.sentence);
    }

    #[test]
    fn a_close_reason_fits_its_frame() {
        assert_eq!(shortened("Bye."), "Bye.");
        let long = "é".repeat(100);
        assert_eq!(shortened(&long), "é".repeat(61));
    }
}
