//! What tests give up while pictures are drawn into it.

use std::io::{self, Cursor, Seek, SeekFrom, Write};

/// A file that is given up when it is asked for the second time.
#[derive(Default)]
pub(super) struct GivenUp {
    pub file: Cursor<Vec<u8>>,
    pub asked: usize,
}

impl Write for GivenUp {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.asked += 1;
        if self.asked > 1 { Err(io::ErrorKind::ConnectionAborted.into()) } else { Ok(()) }
    }
}

impl Seek for GivenUp {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}
