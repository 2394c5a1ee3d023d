//! ZIP files. Members are deflated, or stored as they are, as USDZ wants them: all data begins at multiples of 64 bytes.

use std::io::{self, BufWriter, SeekFrom, Write};

use crc32fast::Hasher;
use flate2::{Compression, write::DeflateEncoder};

use crate::{ExportError, Sink};

/// Where stored data begin, by multiples; those who map a file into memory can then use it in place.
const ALIGNMENT: u64 = 64;
/// Bytes of a member's head without its name, and where its sums stand in it.
const HEAD: u64 = 30;
const SUMS: u64 = 14;
/// The extra field that fills up to the alignment: unknown to all, as its number is.
const FILLER: u16 = 0x1986;
/// Members are younger than 1980 is: the format's first day, since a file does not know its time.
const DAY: u16 = 0x21;
/// Bytes of text that are deflated at once.
const PIECE: usize = 1 << 16;

/// A file that is being written.
pub(crate) struct Zip<'a> {
    out: &'a mut dyn Sink,
    members: Vec<Member>,
    method: Method,
}

/// How the data of a member are kept; its number in the format, and the version of the format that has it.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Method {
    Stored,
    Deflated,
}

impl Method {
    fn numbers(self) -> [u16; 2] {
        match self {
            Self::Stored => [10, 0],
            Self::Deflated => [20, 8],
        }
    }
}

struct Member {
    name: String,
    start: u64,
    method: Method,
    /// The sum of its data, and their bytes as they are kept and as they are.
    sums: [u32; 3],
}

/// The data of one member, while they are written.
struct Data<W: Write> {
    out: W,
    sum: Hasher,
    size: u64,
}

impl<W: Write> Data<W> {
    fn to(out: W) -> Self {
        Self { out, sum: Hasher::new(), size: 0 }
    }
}

impl<'a> Zip<'a> {
    /// With members that are stored.
    pub(crate) fn new(out: &'a mut dyn Sink) -> Self {
        Self { out, members: Vec::new(), method: Method::Stored }
    }

    /// With members that are deflated.
    pub(crate) fn deflated(out: &'a mut dyn Sink) -> Self {
        Self { method: Method::Deflated, ..Self::new(out) }
    }

    /// Adds a member whose data are written by and by.
    pub(crate) fn add(
        &mut self,
        name: &str,
        write: impl FnOnce(&mut dyn Write) -> Result<(), ExportError>,
    ) -> Result<(), ExportError> {
        self.member(name, self.method, write)
    }

    /// Adds a member whose data are packed already: it is stored.
    pub(crate) fn add_packed(
        &mut self,
        name: &str,
        write: impl FnOnce(&mut dyn Write) -> Result<(), ExportError>,
    ) -> Result<(), ExportError> {
        self.member(name, Method::Stored, write)
    }

    fn member(
        &mut self,
        name: &str,
        method: Method,
        write: impl FnOnce(&mut dyn Write) -> Result<(), ExportError>,
    ) -> Result<(), ExportError> {
        let start = self.out.stream_position()?;
        let data = start + HEAD + name.len() as u64;
        // An extra field has four bytes at least.
        let filler = match method {
            Method::Stored => (data + 4).next_multiple_of(ALIGNMENT) - data,
            Method::Deflated => 0,
        };
        let [version, number] = method.numbers();
        let mut head = b"PK\x03\x04".to_vec();
        words(&mut head, &[version, 0, number, 0, DAY]);
        head.extend([0; 12]);
        words(&mut head, &[name.len() as u16, filler as u16]);
        head.extend(name.bytes());
        if filler > 0 {
            words(&mut head, &[FILLER, filler as u16 - 4]);
            head.resize(head.len() + filler as usize - 4, 0);
        }
        self.out.write_all(&head)?;
        let (sum, size) = match method {
            Method::Stored => {
                let mut data = Data::to(&mut *self.out);
                write(&mut data)?;
                (data.sum, data.size)
            }
            Method::Deflated => {
                let mut data = Data::to(Deflated(DeflateEncoder::new(&mut *self.out, Compression::fast())));
                let mut pieces = BufWriter::with_capacity(PIECE, &mut data);
                write(&mut pieces)?;
                pieces.flush()?;
                drop(pieces);
                data.out.0.finish()?;
                (data.sum, data.size)
            }
        };
        let kept = self.out.stream_position()? - start - head.len() as u64;
        let [kept, size] = [kept, size].map(u32::try_from);
        let [Ok(kept), Ok(size)] = [kept, size] else { return Err(ExportError::TooLarge) };
        let sums = [sum.finalize(), kept, size];
        self.out.seek(SeekFrom::Start(start + SUMS))?;
        self.out.write_all(sums.map(u32::to_le_bytes).as_flattened())?;
        self.out.seek(SeekFrom::End(0))?;
        self.members.push(Member { name: name.to_owned(), start, method, sums });
        Ok(())
    }

    /// Ends the file with its list of members.
    pub(crate) fn finish(self) -> Result<(), ExportError> {
        let list = self.out.stream_position()?;
        let mut bytes = Vec::new();
        for Member { name, start, method, sums } in &self.members {
            let [version, number] = method.numbers();
            bytes.extend(b"PK\x01\x02");
            words(&mut bytes, &[version, version, 0, number, 0, DAY]);
            let start = u32::try_from(*start).map_err(|_| ExportError::TooLarge)?;
            bytes.extend(sums.map(u32::to_le_bytes).as_flattened());
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

impl<W: Write> Write for Data<W> {
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

/// Data that are deflated on their way.
struct Deflated<W: Write>(DeflateEncoder<W>);

impl<W: Write> Write for Deflated<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        // To bring all of it out would end a block each time.
        self.0.get_mut().flush()
    }
}

fn words(bytes: &mut Vec<u8>, words: &[u16]) {
    bytes.extend(words.iter().flat_map(|word| word.to_le_bytes()));
}
