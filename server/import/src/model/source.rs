//! The bytes of a file, got as they are asked for.

use std::io::{self, Read, Seek, SeekFrom};

use flate2::read::DeflateDecoder;

use super::{ImportError, damaged};

/// What bytes can be got from, in any order.
pub(super) trait Input: Read + Seek {}

impl<T: Read + Seek> Input for T {}

/// A file of a known length.
pub(super) struct Source<'a> {
    from: &'a mut dyn Input,
    /// Where the part of it begins that is read.
    start: u64,
    length: u64,
    /// How many bytes that part has in all, where it is deflated.
    inflated: Option<u64>,
}

impl<'a> Source<'a> {
    pub(super) fn open(from: &'a mut dyn Input) -> Result<Self, ImportError> {
        let length = from.seek(SeekFrom::End(0)).map_err(unread)?;
        Ok(Self { from, start: 0, length, inflated: None })
    }

    /// The same with a part alone, which it must have.
    pub(super) fn narrow(&mut self, start: u64, length: u64) -> Result<(), ImportError> {
        if start.checked_add(length).is_none_or(|end| end > self.length) {
            return Err(damaged("it is cut short"));
        }
        (self.start, self.length) = (self.start + start, length);
        Ok(())
    }

    /// The same, of a part that is deflated and has so many bytes in all; it can only be read from its beginning.
    pub(super) fn deflated(&mut self, size: u64) {
        self.inflated = Some(size);
    }

    /// How many bytes there are.
    pub(super) fn length(&self) -> u64 {
        self.length
    }

    /// So many bytes from `start`, which the file must have.
    pub(super) fn bytes(&mut self, start: u64, length: usize) -> Result<Vec<u8>, ImportError> {
        if start.checked_add(length as u64).is_none_or(|end| end > self.length) {
            return Err(damaged("it is cut short"));
        }
        let mut bytes = vec![0; length];
        self.from.seek(SeekFrom::Start(self.start + start)).map_err(unread)?;
        self.from.read_exact(&mut bytes).map_err(unread)?;
        Ok(bytes)
    }

    /// All of it, from its beginning.
    pub(super) fn into_reader(self) -> Result<Box<dyn Read + 'a>, ImportError> {
        self.from.seek(SeekFrom::Start(self.start)).map_err(unread)?;
        let kept = self.from.take(self.length);
        Ok(match self.inflated {
            None => Box::new(kept),
            Some(left) => Box::new(Inflated { from: DeflateDecoder::new(kept), left }),
        })
    }
}

/// Bytes that were deflated, and how many are still to come.
struct Inflated<R> {
    from: DeflateDecoder<R>,
    left: u64,
}

impl<R: Read> Read for Inflated<R> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        // What is wrong with the data is no fault of the disk.
        let damaged = || io::Error::from(io::ErrorKind::InvalidData);
        let count = self.from.read(bytes).map_err(|error| match error.kind() {
            io::ErrorKind::InvalidInput | io::ErrorKind::UnexpectedEof => damaged(),
            _ => error,
        })?;
        let is_short = count == 0 && !bytes.is_empty() && self.left > 0;
        self.left = self.left.checked_sub(count as u64).filter(|_| !is_short).ok_or_else(damaged)?;
        Ok(count)
    }
}

/// Why bytes did not come.
pub(super) fn unread(error: io::Error) -> ImportError {
    match error.kind() {
        io::ErrorKind::InvalidData => damaged("its deflated data are broken"),
        _ => ImportError::Unread(error.to_string()),
    }
}
