//! ZIP files whose members are stored as they are, as USDZ wants them: all data begins at multiples of 64 bytes.

use std::io::{self, SeekFrom, Write};

use crc32fast::Hasher;

use crate::{ExportError, Sink};

/// Where data begin, by multiples; those who map a file into memory can then use it in place.
const ALIGNMENT: u64 = 64;
/// Bytes of a member's head without its name, and where its sums stand in it.
const HEAD: u64 = 30;
const SUMS: u64 = 14;
/// The extra field that fills up to the alignment: unknown to all, as its number is.
const FILLER: u16 = 0x1986;
/// Members are younger than 1980 is: the format's first day, since a file does not know its time.
const DAY: u16 = 0x21;

/// A file that is being written.
pub(crate) struct Zip<'a> {
    out: &'a mut dyn Sink,
    members: Vec<Member>,
}

struct Member {
    name: String,
    start: u64,
    sum: u32,
    size: u32,
}

/// The data of one member, while they are written.
struct Data<'a> {
    out: &'a mut dyn Sink,
    sum: Hasher,
    size: u64,
}

impl<'a> Zip<'a> {
    pub(crate) fn new(out: &'a mut dyn Sink) -> Self {
        Self { out, members: Vec::new() }
    }

    /// Adds a member whose data are written by and by.
    pub(crate) fn add(
        &mut self,
        name: &str,
        write: impl FnOnce(&mut dyn Write) -> Result<(), ExportError>,
    ) -> Result<(), ExportError> {
        let start = self.out.stream_position()?;
        let data = start + HEAD + name.len() as u64;
        // An extra field has four bytes at least.
        let filler = (data + 4).next_multiple_of(ALIGNMENT) - data;
        let mut head = b"PK\x03\x04".to_vec();
        words(&mut head, &[10, 0, 0, 0, DAY]);
        head.extend([0; 12]);
        words(&mut head, &[name.len() as u16, filler as u16]);
        head.extend(name.bytes());
        words(&mut head, &[FILLER, filler as u16 - 4]);
        head.resize(head.len() + filler as usize - 4, 0);
        self.out.write_all(&head)?;
        let mut data = Data { out: &mut *self.out, sum: Hasher::new(), size: 0 };
        write(&mut data)?;
        let size = u32::try_from(data.size).map_err(|_| ExportError::TooLarge)?;
        let sum = data.sum.finalize();
        self.out.seek(SeekFrom::Start(start + SUMS))?;
        for word in [sum, size, size] {
            self.out.write_all(&word.to_le_bytes())?;
        }
        self.out.seek(SeekFrom::End(0))?;
        self.members.push(Member { name: name.to_owned(), start, sum, size });
        Ok(())
    }

    /// Ends the file with its list of members.
    pub(crate) fn finish(self) -> Result<(), ExportError> {
        let list = self.out.stream_position()?;
        let mut bytes = Vec::new();
        for Member { name, start, sum, size } in &self.members {
            bytes.extend(b"PK\x01\x02");
            words(&mut bytes, &[10, 10, 0, 0, 0, DAY]);
            let start = u32::try_from(*start).map_err(|_| ExportError::TooLarge)?;
            bytes.extend([*sum, *size, *size].map(u32::to_le_bytes).as_flattened());
            words(&mut bytes, &[name.len() as u16, 0, 0, 0, 0, 0, 0]);
            bytes.extend(start.to_le_bytes());
            bytes.extend(name.bytes());
        }
        let (count, length) = (self.members.len() as u16, bytes.len() as u32);
        let list = u32::try_from(list).map_err(|_| ExportError::TooLarge)?;
        bytes.extend(b"PK\x05\x06");
        words(&mut bytes, &[0, 0, count, count]);
        bytes.extend([length, list].map(u32::to_le_bytes).as_flattened());
        words(&mut bytes, &[0]);
        self.out.write_all(&bytes)?;
        Ok(self.out.flush()?)
    }
}

impl Write for Data<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.out.write(bytes)?;
        self.sum.update(&bytes[..count]);
        self.size += count as u64;
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

fn words(bytes: &mut Vec<u8>, words: &[u16]) {
    bytes.extend(words.iter().flat_map(|word| word.to_le_bytes()));
}
