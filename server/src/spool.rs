//! A file in the making: on disk, a slice at a time, beneath what draws, until somebody gives it up.

mod room;

use std::{
    fs::File,
    io::{self, BufWriter, ErrorKind, Seek, SeekFrom, Write},
    sync::Arc,
    time::Duration,
};

use tokio::sync::watch;
use tokio_util::sync::CancellationToken;

pub use self::room::{InRoom, Room, Rooms};
use crate::pool::SimulationPool;

/// Bytes that are made in one go: some milliseconds of work.
const SLICE: usize = 256 * 1024;
/// How long a slice waits at most for those who draw.
const PATIENCE: Duration = Duration::from_millis(20);

/// A file that takes no more when nobody wants it.
#[derive(Debug)]
pub struct Spool(BufWriter<Slices>);

#[derive(Debug)]
struct Slices {
    file: File,
    pool: SimulationPool,
    stop: CancellationToken,
    written: watch::Sender<u64>,
    bytes_left: u64,
    room: Option<Arc<Room>>,
}

impl Spool {
    /// Writes to an empty file. It counts in `written` the bytes that lie in it, and takes none after `stop`.
    pub fn new(
        file: File,
        pool: SimulationPool,
        stop: CancellationToken,
        written: watch::Sender<u64>,
    ) -> Self {
        let slices = Slices { file, pool, stop, written, bytes_left: u64::MAX, room: None };
        Self(BufWriter::with_capacity(SLICE, slices))
    }

    /// The same, and it takes what it writes of a room: where that is full it is `QuotaExceeded`.
    pub fn in_room(mut self, room: Arc<Room>) -> Self {
        self.0.get_mut().room = Some(room);
        self
    }

    /// The same, and it takes no more bytes than these: what is beyond is `QuotaExceeded`.
    pub fn within(mut self, bytes_left: u64) -> Self {
        self.0.get_mut().bytes_left = bytes_left;
        self
    }

    /// The whole file, from its beginning, and how many bytes it has.
    pub fn into_file(self) -> io::Result<(File, u64)> {
        let Slices { mut file, .. } = self.0.into_inner().map_err(io::IntoInnerError::into_error)?;
        let length = file.seek(SeekFrom::End(0))?;
        file.rewind()?;
        Ok((file, length))
    }
}

impl Write for Spool {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

impl Seek for Spool {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.0.seek(to)
    }
}

impl Slices {
    /// Lets those who draw go first, and ends what nobody wants any more.
    fn go_on(&self) -> io::Result<()> {
        self.pool.give_way(PATIENCE);
        if self.stop.is_cancelled() { Err(ErrorKind::ConnectionAborted.into()) } else { Ok(()) }
    }
}

impl Write for Slices {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.go_on()?;
        if self.written.borrow().saturating_add(bytes.len() as u64) > self.bytes_left {
            return Err(ErrorKind::QuotaExceeded.into());
        }
        if self.room.as_ref().is_some_and(|room| !room.take(bytes.len() as u64)) {
            return Err(ErrorKind::QuotaExceeded.into());
        }
        let count = self.file.write(bytes)?;
        self.written.send_modify(|written| *written += count as u64);
        Ok(count)
    }

    /// What takes long and writes nothing asks here whether to go on.
    fn flush(&mut self) -> io::Result<()> {
        self.go_on()?;
        self.file.flush()
    }
}

impl Seek for Slices {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use super::*;

    fn spool(stop: &CancellationToken) -> Spool {
        let pool = SimulationPool::new(std::num::NonZeroUsize::new(1)).unwrap();
        Spool::new(tempfile::tempfile().unwrap(), pool, stop.clone(), watch::Sender::default())
    }

    #[test]
    fn what_was_written_is_read_from_its_beginning() {
        let mut spool = spool(&CancellationToken::new());
        spool.write_all(b"abc").unwrap();
        spool.seek(SeekFrom::Start(1)).unwrap();
        spool.write_all(b"X").unwrap();
        let (mut file, length) = spool.into_file().unwrap();
        let mut text = String::new();
        file.read_to_string(&mut text).unwrap();
        assert_eq!((text.as_str(), length), ("aXc", 3));
    }

    #[test]
    fn a_file_that_nobody_wants_takes_no_more() {
        let stop = CancellationToken::new();
        let mut spool = spool(&stop);
        spool.write_all(&vec![0; 2 * SLICE]).unwrap();
        stop.cancel();
        let error = spool.write_all(&vec![0; 2 * SLICE]).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::ConnectionAborted);
    }

    #[test]
    fn whoever_draws_for_a_file_that_nobody_wants_hears_it_when_it_is_flushed() {
        let stop = CancellationToken::new();
        let mut spool = spool(&stop);
        spool.flush().unwrap();
        stop.cancel();
        assert_eq!(spool.flush().unwrap_err().kind(), ErrorKind::ConnectionAborted);
    }

    #[test]
    fn a_file_takes_no_more_than_its_room() {
        let mut spool = spool(&CancellationToken::new()).within(SLICE as u64 + 1);
        spool.write_all(&vec![0; SLICE]).unwrap();
        let error = spool.write_all(&vec![0; SLICE]).and_then(|()| spool.flush()).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::QuotaExceeded);
    }
}
