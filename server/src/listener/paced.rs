//! A TCP connection whose peer must read what it asked for.
//!
//! A deadline around an answer's body would never fire: while the peer takes nothing, nobody polls the body. So it
//! stands where bytes leave.

use std::{
    io::{self, ErrorKind},
    net::Shutdown,
    pin::Pin,
    task::{Context, Poll, ready},
    time::Duration,
};

use socket2::SockRef;
use tokio::{
    io::{AsyncRead, AsyncWrite, ReadBuf},
    net::TcpStream,
    runtime::Handle,
    time::{Instant, Sleep, sleep_until, timeout},
};
use tokio_util::{sync::CancellationToken, task::TaskTracker};

use super::{unfinished::Unfinished, unread};

/// A peer that takes no byte for so long is let go. One that reads slowly takes some now and then: systems tell of room
/// by up to 128 KiB at a time where both ends are on one machine.
pub const PATIENCE: Duration = Duration::from_secs(30);
/// The same while the server stops.
const LAST_PATIENCE: Duration = Duration::from_secs(1);
/// What the system keeps for a peer that does not read, besides what is on its way. More would hide for long that
/// nothing moves.
#[cfg(target_os = "linux")]
const UNSENT_BYTES: u32 = 32 * 1024;
/// After the last byte was sent, what the peer still sends is read for so long,
const LINGERING: Duration = Duration::from_secs(2);
/// and as far as this. A connection that is closed with unread data is reset, which may overtake the last words.
const LINGERING_BYTES: usize = 8 * 1024 * 1024;

/// A connection that fails with [`ErrorKind::TimedOut`] when its peer takes nothing for too long, and reads for a
/// while what comes in after it was dropped.
#[derive(Debug)]
pub struct Paced {
    /// Nothing only while it is dropped.
    stream: Option<TcpStream>,
    pace: Pace,
    /// What is written instead of what was to be written, and how much of it is.
    instead: Option<(Vec<u8>, usize)>,
    timer: Option<Pin<Box<Sleep>>>,
    unfinished: Unfinished,
    /// Nothing more comes or goes.
    is_over: bool,
    stop: CancellationToken,
    /// When it is cancelled, others need what the connection takes.
    makes_way: Option<CancellationToken>,
    lingering: TaskTracker,
}

impl Paced {
    /// Watches a connection. When `stop` is cancelled patience is short; `lingering` has what goes on after the drop.
    pub fn new(
        stream: TcpStream,
        patience: Duration,
        unfinished: Unfinished,
        stop: CancellationToken,
        lingering: TaskTracker,
    ) -> Self {
        let socket = SockRef::from(&stream);
        // Small deltas should not wait for company.
        if let Err(error) = socket.set_tcp_nodelay(true) {
            tracing::debug!(%error, "TCP_NODELAY cannot be set");
        }
        #[cfg(target_os = "linux")]
        if let Err(error) = socket.set_tcp_notsent_lowat(UNSENT_BYTES) {
            tracing::debug!(%error, "TCP_NOTSENT_LOWAT cannot be set");
        }
        let pace = Pace { patience, until: None };
        Self {
            stream: Some(stream),
            pace,
            instead: None,
            timer: None,
            unfinished,
            is_over: false,
            stop,
            makes_way: None,
            lingering,
        }
    }

    /// Nothing more is read or written, and what comes in is not waited for, once this is cancelled.
    pub fn until(mut self, makes_way: CancellationToken) -> Self {
        self.makes_way = Some(makes_way);
        self
    }

    fn stream(&mut self) -> io::Result<Pin<&mut TcpStream>> {
        self.stream.as_mut().map(Pin::new).ok_or_else(|| ErrorKind::NotConnected.into())
    }

    /// Writes what is written instead, to its end. Whoever writes comes again with the same bytes until then.
    fn write_instead(&mut self, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        while let Some((bytes, done)) = self.instead.take() {
            let left = bytes.get(done..).unwrap_or_default();
            if left.is_empty() {
                break;
            }
            let written = self.stream()?.poll_write(context, left);
            let more = match &written {
                Poll::Ready(Ok(more)) => *more,
                _ => 0,
            };
            self.instead = Some((bytes, done + more));
            ready!(self.paced(written, context))?;
        }
        Poll::Ready(Ok(()))
    }

    /// What comes of an attempt to write.
    fn paced<T>(&mut self, written: Poll<io::Result<T>>, context: &mut Context<'_>) -> Poll<io::Result<T>> {
        if let Poll::Ready(written) = written {
            self.pace.moved();
            self.is_over |= written.is_err();
            return Poll::Ready(written);
        }
        if self.stop.is_cancelled() {
            self.pace.shorten(LAST_PATIENCE);
        }
        let until = self.pace.waits(Instant::now());
        let timer = self.timer.get_or_insert_with(|| Box::pin(sleep_until(until)));
        if timer.deadline() != until {
            timer.as_mut().reset(until);
        }
        ready!(timer.as_mut().poll(context));
        self.is_over = true;
        if let Some(stream) = &self.stream {
            // What the system still holds for the peer goes as well.
            let _ = stream.set_zero_linger();
        }
        Poll::Ready(Err(ErrorKind::TimedOut.into()))
    }
}

impl AsyncRead for Paced {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        let (filled, room) = (buffer.filled().len(), buffer.remaining());
        let read = ready!(self.stream()?.poll_read(context, buffer));
        let came = buffer.filled().len() - filled;
        self.is_over |= read.is_err() || (room > 0 && came == 0);
        Poll::Ready(read.and_then(|()| self.unfinished.came(came)))
    }
}

impl AsyncWrite for Paced {
    fn poll_write(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        if self.instead.is_none() {
            self.instead = unread::instead(bytes).map(|instead| (instead, 0));
        }
        if self.instead.is_some() {
            ready!(self.write_instead(context))?;
            return Poll::Ready(Ok(bytes.len()));
        }
        let written = self.stream()?.poll_write(context, bytes);
        self.paced(written, context)
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        parts: &[io::IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        if let [only] = parts {
            return self.poll_write(context, only);
        }
        let written = self.stream()?.poll_write_vectored(context, parts);
        self.paced(written, context)
    }

    fn is_write_vectored(&self) -> bool {
        true
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        self.stream()?.poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        self.stream()?.poll_shutdown(context)
    }
}

impl Drop for Paced {
    fn drop(&mut self) {
        let makes_way = self.makes_way.as_ref().is_some_and(CancellationToken::is_cancelled);
        let Some(stream) = self.stream.take().filter(|_| !self.is_over && !makes_way) else { return };
        // Without a runtime the program ends.
        if let Ok(runtime) = Handle::try_current() {
            let lingering = async { timeout(LINGERING, linger(stream)).await };
            self.lingering.spawn_on(lingering, &runtime);
        }
    }
}

/// Reads what still comes, until the peer has closed as well.
async fn linger(stream: TcpStream) {
    // Fails where the peer has gone.
    let _ = SockRef::from(&stream).shutdown(Shutdown::Write);
    let mut left = LINGERING_BYTES;
    let mut bytes = vec![0; 16 * 1024];
    while left > 0 && stream.readable().await.is_ok() {
        match stream.try_read(&mut bytes) {
            Ok(0) => return,
            Ok(count) => left = left.saturating_sub(count),
            Err(error) if error.kind() == ErrorKind::WouldBlock => {}
            Err(_) => return,
        }
    }
}

/// Until when a peer may take nothing.
#[derive(Debug)]
struct Pace {
    patience: Duration,
    /// Nothing while bytes are taken.
    until: Option<Instant>,
}

impl Pace {
    /// Bytes were taken.
    fn moved(&mut self) {
        self.until = None;
    }

    /// None is taken now; says when patience ends.
    fn waits(&mut self, now: Instant) -> Instant {
        let end = now + self.patience;
        let until = self.until.map_or(end, |until| until.min(end));
        self.until = Some(until);
        until
    }

    /// From now on there is at most so much patience.
    fn shorten(&mut self, patience: Duration) {
        self.patience = self.patience.min(patience);
    }
}

#[cfg(test)]
mod tests {
    use std::future::poll_fn;

    use tokio::net::TcpListener;

    use super::*;

    async fn pair(patience: Duration) -> (Paced, TcpStream, TaskTracker) {
        let listener = TcpListener::bind(("127.0.0.1", 0)).await.unwrap();
        let peer = TcpStream::connect(listener.local_addr().unwrap()).await.unwrap();
        let (stream, _) = listener.accept().await.unwrap();
        let lingering = TaskTracker::new();
        (
            Paced::new(stream, patience, Unfinished::default(), CancellationToken::new(), lingering.clone()),
            peer,
            lingering,
        )
    }

    async fn write(paced: &mut Paced, bytes: &[u8]) -> io::Result<usize> {
        poll_fn(|context| Pin::new(&mut *paced).poll_write(context, bytes)).await
    }

    /// Writes until that fails.
    async fn fill(paced: &mut Paced) -> io::Error {
        loop {
            if let Err(error) = write(paced, &[7; 64 * 1024]).await {
                return error;
            }
        }
    }

    /// What a peer reads until the connection ends, and how that ends.
    async fn read_on(peer: &TcpStream) -> (Vec<u8>, io::Result<()>) {
        let mut heard = Vec::new();
        let mut bytes = vec![0; 1 << 20];
        loop {
            peer.readable().await.unwrap();
            match peer.try_read(&mut bytes) {
                Ok(0) => return (heard, Ok(())),
                Ok(count) => heard.extend_from_slice(&bytes[..count]),
                Err(error) if error.kind() == ErrorKind::WouldBlock => {}
                Err(error) => return (heard, Err(error)),
            }
        }
    }

    #[tokio::test]
    async fn lm15_a_peer_that_reads_nothing_is_let_go() {
        let (mut paced, peer, _) = pair(Duration::from_millis(20)).await;
        assert_eq!(fill(&mut paced).await.kind(), ErrorKind::TimedOut);
        drop(paced);
        // Nothing is kept for it, and it cannot take the answer for a whole one.
        let (_, end) = read_on(&peer).await;
        assert_eq!(end.unwrap_err().kind(), ErrorKind::ConnectionReset);
    }

    #[tokio::test]
    async fn a_server_that_stops_has_little_patience() {
        let (mut paced, _peer, _) = pair(Duration::from_hours(1)).await;
        paced.stop.cancel();
        assert_eq!(fill(&mut paced).await.kind(), ErrorKind::TimedOut);
    }

    #[test]
    fn lm15_whoever_takes_a_byte_now_and_then_is_waited_for() {
        let mut pace = Pace { patience: PATIENCE, until: None };
        let start = Instant::now();
        for round in 0..100 {
            // Each byte is taken a moment before patience ends.
            let begun = start + PATIENCE * round;
            let until = pace.waits(begun);
            assert_eq!(until, begun + PATIENCE);
            assert_eq!(
                pace.waits(until - Duration::from_millis(1)),
                until,
                "to wait on does not move the end"
            );
            pace.moved();
        }
        let until = pace.waits(start);
        pace.shorten(LAST_PATIENCE);
        assert!(pace.waits(start) < until);
    }

    #[tokio::test]
    async fn last_words_arrive_though_the_peer_has_sent_what_nobody_reads() {
        let (mut paced, peer, lingering) = pair(PATIENCE).await;
        peer.writable().await.unwrap();
        assert!(peer.try_write(&[1; 64 * 1024]).unwrap() > 0);
        assert_eq!(write(&mut paced, b"bye").await.unwrap(), 3);
        drop(paced);
        let (heard, end) = read_on(&peer).await;
        assert_eq!((&heard[..], end.is_ok()), (&b"bye"[..], true));
        drop(peer);
        lingering.close();
        lingering.wait().await;
    }
}
