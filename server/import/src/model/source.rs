//! The bytes of a file, got as they are asked for.

use std::io::{self, Read, Seek, SeekFrom};

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
}

impl<'a> Source<'a> {
    pub(super) fn open(from: &'a mut dyn Input) -> Result<Self, ImportError> {
        let length = from.seek(SeekFrom::End(0)).map_err(unread)?;
        Ok(Self { from, start: 0, length })
    }

    /// The same with a part alone, which it must have.
    pub(super) fn narrow(&mut self, start: u64, length: u64) -> Result<(), ImportError> {
        if start.checked_add(length).is_none_or(|end| end > self.length) {
            return Err(damaged("it is cut short"));
        }
        (self.start, self.length) = (self.start + start, length);
        Ok(())
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
    pub(super) fn into_reader(self) -> Result<impl Read + 'a, ImportError> {
        self.from.seek(SeekFrom::Start(self.start)).map_err(unread)?;
        Ok(self.from.take(self.length))
    }
}

pub(super) fn unread(error: io::Error) -> ImportError {
    ImportError::Unread(error.to_string())
}
