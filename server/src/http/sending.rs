//! A file that is sent while it is made.

use std::{fs::File, io, sync::Arc};

use axum::body::{Body, Bytes};
use futures_util::stream;
use tokio::sync::{
    oneshot::{self, error::RecvError},
    watch,
};
use tokio_util::sync::DropGuard;

use super::exports::{PIECE, piece_of};
use crate::{document::FileError, spool::Room};

/// Bytes of a file that are made before it is sent: a smaller one is sent when it is whole, with its length.
pub(super) const BEGINNING: u64 = 4 * 1024 * 1024;

/// What became of a file: the whole of it, from its beginning, and how many bytes it has.
pub(super) type Made = Result<(File, u64), FileError>;

/// A file in the making.
pub(super) struct Sending {
    /// How many bytes lie in it.
    pub written: watch::Receiver<u64>,
    pub made: oneshot::Receiver<Made>,
    /// Gives it up when it is dropped.
    pub gone: DropGuard,
    /// What it takes of the disk.
    pub room: Arc<Room>,
}

/// What can be answered with.
pub(super) enum Ready {
    /// All of the file, or why there is none.
    Whole(Result<Made, RecvError>),
    /// The file as it is made.
    Begun(Body),
}

impl Sending {
    /// Waits until the file is whole, or until so much of it is there that it can be sent. It is read by a handle of its
    /// own; without one it is sent when it is whole.
    pub(super) async fn ready(mut self, reader: Option<File>) -> Ready {
        let begun = async {
            let is_there = self.written.wait_for(|&written| written >= BEGINNING).await.is_ok();
            if !is_there || reader.is_none() {
                std::future::pending().await
            }
        };
        let made = tokio::select! {
            biased;
            made = &mut self.made => Some(made),
            () = begun => None,
        };
        match (made, reader) {
            (None, Some(file)) => Ready::Begun(self.body(file)),
            (made, _) => {
                let made = match made {
                    Some(made) => made,
                    None => self.made.await,
                };
                // What is whole can be given up no more.
                drop(self.gone.disarm());
                Ready::Whole(made)
            }
        }
    }

    /// The file, a piece at a time, each when it lies on the disk and the one before has been taken. Where the file fails,
    /// its transfer ends without an end, which every client takes for a failure.
    fn body(self, file: File) -> Body {
        let Self { written, made, gone, room } = self;
        let reading = Reading { file, sent: 0, written, made: Some(made), _gone: gone, _room: room };
        Body::from_stream(stream::try_unfold(reading, Reading::next))
    }
}

/// How far a file is sent.
struct Reading {
    file: File,
    sent: u64,
    written: watch::Receiver<u64>,
    /// None once it is whole.
    made: Option<oneshot::Receiver<Made>>,
    _gone: DropGuard,
    _room: Arc<Room>,
}

impl Reading {
    async fn next(mut self) -> io::Result<Option<(Bytes, Self)>> {
        loop {
            let left = *self.written.borrow_and_update() - self.sent;
            if left > 0 {
                let (piece, file) = piece_of(self.file, left.min(PIECE as u64)).await?;
                self.file = file;
                self.sent += piece.len() as u64;
                return Ok(Some((piece, self)));
            }
            let Some(made) = &mut self.made else { return Ok(None) };
            tokio::select! {
                Ok(()) = self.written.changed() => {}
                made = made => {
                    made.map_err(io::Error::other)?.map_err(io::Error::other)?;
                    self.made = None;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::{
        future::Future,
        io::Write,
        pin::pin,
        task::{Context, Poll, Waker},
    };

    use axum::body::to_bytes;
    use tokio_util::sync::CancellationToken;

    use super::*;
    use crate::{http::exports::on_disk, spool::Rooms};

    /// A file that is written by hand.
    struct Hand {
        file: File,
        written: watch::Sender<u64>,
        made: oneshot::Sender<Made>,
        stop: CancellationToken,
    }

    impl Hand {
        fn begin() -> (Self, Sending, File) {
            let (file, reader) = on_disk(true).unwrap();
            let (written, stop) = (watch::Sender::default(), CancellationToken::new());
            let (made, whether_made) = oneshot::channel();
            let gone = stop.clone().drop_guard();
            let room = Rooms::new(u64::MAX, u64::MAX).of("ada".into());
            let sending = Sending { written: written.subscribe(), made: whether_made, gone, room };
            (Self { file, written, made, stop }, sending, reader.unwrap())
        }

        fn write(&mut self, byte: u8, count: u64) {
            self.file.write_all(&vec![byte; count as usize]).unwrap();
            self.written.send_modify(|written| *written += count);
        }
    }

    fn is_pending<T>(future: std::pin::Pin<&mut impl Future<Output = T>>) -> bool {
        matches!(future.poll(&mut Context::from_waker(Waker::noop())), Poll::Pending)
    }

    #[tokio::test]
    async fn ex2_a_large_file_is_sent_while_it_is_made() {
        let (mut hand, sending, reader) = Hand::begin();
        let mut ready = pin!(sending.ready(Some(reader)));
        hand.write(1, BEGINNING - 1);
        assert!(is_pending(ready.as_mut()), "nothing is sent of a file that may still be small");
        hand.write(2, 1);
        let Ready::Begun(body) = ready.await else { panic!("it has begun") };
        let all = tokio::spawn(to_bytes(body, usize::MAX));
        hand.write(3, 3 * BEGINNING);
        let Hand { file, written, made, stop } = hand;
        drop(written);
        made.send(Ok((file, 4 * BEGINNING))).ok().unwrap();
        let all = all.await.unwrap().unwrap();
        assert_eq!(all.len() as u64, 4 * BEGINNING);
        let ones = BEGINNING as usize - 1;
        assert!(all[..ones].iter().all(|&byte| byte == 1) && all[ones] == 2);
        assert!(all[ones + 1..].iter().all(|&byte| byte == 3) && stop.is_cancelled());
    }

    #[tokio::test]
    async fn ex2_a_file_that_fails_while_it_is_sent_has_no_end() {
        let (mut hand, sending, reader) = Hand::begin();
        hand.write(1, BEGINNING);
        let Ready::Begun(body) = sending.ready(Some(reader)).await else { panic!("it has begun") };
        let Hand { written, made, .. } = hand;
        drop(written);
        made.send(Err(io::Error::from(io::ErrorKind::StorageFull).into())).ok().unwrap();
        to_bytes(body, usize::MAX).await.unwrap_err();
    }

    #[tokio::test]
    async fn ex2_a_file_that_goes_back_is_sent_when_it_is_whole() {
        let (mut hand, sending, _) = Hand::begin();
        hand.write(1, 2 * BEGINNING);
        let mut ready = pin!(sending.ready(None));
        assert!(is_pending(ready.as_mut()));
        let Hand { file, made, stop, .. } = hand;
        made.send(Ok((file, 2 * BEGINNING))).ok().unwrap();
        assert!(matches!(ready.await, Ready::Whole(Ok(Ok((_, length)))) if length == 2 * BEGINNING));
        assert!(!stop.is_cancelled());
    }

    #[tokio::test]
    async fn ex3_whoever_goes_away_gives_up_what_is_sent() {
        let (mut hand, sending, reader) = Hand::begin();
        hand.write(1, BEGINNING);
        let Ready::Begun(body) = sending.ready(Some(reader)).await else { panic!("it has begun") };
        assert!(!hand.stop.is_cancelled());
        drop(body);
        assert!(hand.stop.is_cancelled());
    }
}
