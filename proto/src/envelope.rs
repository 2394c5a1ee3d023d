//! What all binary frames have in common: a short header and a body that may be deflated (`FR`).

use std::{
    borrow::Cow,
    io::Read,
    panic::catch_unwind,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
        mpsc,
    },
};

use espalier_reading::{Between, Bounded};
use flate2::{Compress, Compression, FlushCompress, read::DeflateDecoder};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

use crate::{
    schema::{between, schemas},
    varint,
};

/// Bytes before the sequence and the length of the unpacked body, which are varints.
pub const HEADER_BYTES: usize = 8;
/// The most bytes a body may unpack to (`FR2`).
pub const MAX_BODY_BYTES: usize = 64 * 1024 * 1024;

const VERSION: u8 = 4;
const CODEC_RAW: u8 = 0;
const CODEC_DEFLATE: u8 = 1;
const CODEC_PACKED: u8 = 2;
/// The flag of a frame made for one client from the current state.
pub(crate) const FLAG_CATCH_UP: u8 = 1;
/// Bodies shorter than this travel raw: the compressor's overhead would eat the gain.
const MIN_COMPRESSED_BYTES: usize = 40;
/// A body from this length on is worth two threads, and loses less than one in a hundred bytes by being cut in two.
const MIN_HALVED_BYTES: usize = 32 * 1024;
/// Room for the end of a stream at least.
const SPARE_BYTES: usize = 64;
/// Level 4 saves 3 in 100 bytes more and takes a third longer.
const LEVEL: Compression = Compression::new(2);
/// Bodies shorter than this take no time to speak of.
const SHORT_BYTES: usize = 4096;
const SHORT_LEVEL: Compression = Compression::new(6);

/// What a frame is about; each kind counts its sequences by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
pub enum FrameKind {
    /// A change to the table of rows, [`crate::frame::Frame`].
    MeshDelta = 1,
    /// A branch that is being bent, [`crate::bend::BendFrame`].
    Bend = 2,
    /// A prediction, [`crate::ghost::GhostFrame`].
    Ghost = 3,
    /// Where people point and what they see, [`crate::presence_frame::PresenceFrame`].
    Presence = 4,
}

impl Serialize for FrameKind {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_u8(self.code())
    }
}

impl<'de> Deserialize<'de> for FrameKind {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let codes = Self::CODES;
        let code = deserializer.deserialize_u32(Bounded(codes, &codes))?;
        let kind = u8::try_from(code).ok().and_then(Self::from_code);
        kind.ok_or_else(|| D::Error::custom(format_args!("invalid value: {code}, expected {codes}")))
    }
}

schemas! {
    FrameKind = |_| between(&FrameKind::CODES);
}

impl FrameKind {
    /// All kinds.
    pub const ALL: [Self; 4] = [Self::MeshDelta, Self::Bend, Self::Ghost, Self::Presence];
    const CODES: Between<u32> = Between(Self::MeshDelta as u32, Self::Presence as u32);

    /// Its number in the header.
    pub fn code(self) -> u8 {
        self as u8
    }

    /// The kind with this number.
    pub fn from_code(code: u8) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.code() == code)
    }

    /// The kind that a frame's header states, whether or not the rest is valid.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        bytes.get(1).and_then(|&code| Self::from_code(code))
    }

    /// The sequence that a frame's header states, whether or not the rest is valid.
    pub fn sequence_of(bytes: &[u8]) -> Option<u32> {
        varint::read(&mut bytes.get(HEADER_BYTES..)?)
    }

    /// Flags that have a meaning.
    fn flags(self) -> u8 {
        if self == Self::MeshDelta { FLAG_CATCH_UP } else { 0 }
    }
}

/// Why bytes are not a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FrameError {
    /// Fewer bytes than the header, or than a value needs.
    #[error("the frame is cut short")]
    Truncated,
    /// Another version of the format.
    #[error("frame version {0} is not 4")]
    Version(u8),
    /// Another kind of frame than was asked for.
    #[error("frame kind {0} is not the one expected")]
    Kind(u8),
    /// A codec that there is not, or not for frames of this kind.
    #[error("codec {0} is neither 0, raw, nor 1, deflate, nor 2 in a mesh delta")]
    Codec(u8),
    /// A flag that has no meaning yet.
    #[error("reserved flags {0:#04x} are set")]
    Flags(u8),
    /// The body does not unpack to the length the header states.
    #[error("the body's length differs from the header's, or exceeds 64 MiB")]
    Length,
    /// An unknown change or column, a count out of range, or a number that is not finite.
    #[error("the body is malformed")]
    Body,
}

/// A header, read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Header {
    pub flags: u8,
    pub epoch: u32,
    pub sequence: u32,
}

/// A frame as bytes; the body is deflated where that makes it shorter.
pub(crate) fn seal(kind: FrameKind, header: Header, body: &[u8]) -> Vec<u8> {
    let packed = if body.len() >= MIN_COMPRESSED_BYTES { deflate(body) } else { None };
    let (codec, payload) = match &packed {
        Some(packed) if packed.len() < body.len() => (CODEC_DEFLATE, packed.as_slice()),
        _ => (CODEC_RAW, body),
    };
    let mut out = Vec::with_capacity(raw_length(header, payload.len()));
    begin(kind, codec, header, &mut out);
    varint::write(&mut out, body.len() as u32);
    out.extend_from_slice(payload);
    out
}

/// A frame whose body is packed by models.
pub(crate) fn seal_packed(kind: FrameKind, header: Header, packed: &[u8]) -> Vec<u8> {
    let mut out = Vec::with_capacity(raw_length(header, packed.len()));
    begin(kind, CODEC_PACKED, header, &mut out);
    varint::write(&mut out, packed.len() as u32);
    out.extend_from_slice(packed);
    out
}

fn begin(kind: FrameKind, codec: u8, header: Header, out: &mut Vec<u8>) {
    out.extend_from_slice(&[VERSION, kind.code(), codec, header.flags]);
    out.extend_from_slice(&header.epoch.to_le_bytes());
    varint::write(out, header.sequence);
}

fn raw_length(header: Header, body: usize) -> usize {
    HEADER_BYTES + varint::length(header.sequence) + varint::length(body as u32) + body
}

/// The body of a frame, as far as the envelope opens it.
#[derive(Debug)]
pub(crate) enum Body<'a> {
    /// Numbers and bytes.
    Plain(Cow<'a, [u8]>),
    /// Packed by models; in mesh deltas alone.
    Packed(&'a [u8]),
}

/// The header and the unpacked body of a frame that is not packed by models.
pub(crate) fn open_plain(bytes: &[u8], wanted: FrameKind) -> Result<(Header, Cow<'_, [u8]>), FrameError> {
    match open(bytes, wanted)? {
        (header, Body::Plain(body)) => Ok((header, body)),
        (_, Body::Packed(_)) => Err(FrameError::Codec(CODEC_PACKED)),
    }
}

/// The header and the body of a frame of this kind.
pub(crate) fn open(bytes: &[u8], wanted: FrameKind) -> Result<(Header, Body<'_>), FrameError> {
    let (header, mut payload) = bytes.split_at_checked(HEADER_BYTES).ok_or(FrameError::Truncated)?;
    let &[version, kind, codec, flags, a, b, c, d] = header else { return Err(FrameError::Truncated) };
    if version != VERSION {
        return Err(FrameError::Version(version));
    }
    if kind != wanted.code() {
        return Err(FrameError::Kind(kind));
    }
    if flags & !wanted.flags() != 0 {
        return Err(FrameError::Flags(flags));
    }
    let sequence = varint::read(&mut payload).ok_or(FrameError::Truncated)?;
    let header = Header { flags, epoch: u32::from_le_bytes([a, b, c, d]), sequence };
    let length = varint::read(&mut payload).ok_or(FrameError::Truncated)? as usize;
    if codec == CODEC_PACKED {
        let is_whole = payload.len() == length;
        return if is_whole { Ok((header, Body::Packed(payload))) } else { Err(FrameError::Length) };
    }
    if length > MAX_BODY_BYTES {
        return Err(FrameError::Length);
    }
    let body = match codec {
        CODEC_RAW => Cow::Borrowed(payload),
        CODEC_DEFLATE => Cow::Owned(inflate(payload, length)?),
        other => return Err(FrameError::Codec(other)),
    };
    if body.len() != length {
        return Err(FrameError::Length);
    }
    Ok((header, Body::Plain(body)))
}

/// A long body is deflated in halves, side by side: the first ends at a whole byte, the second does not look back.
///
/// A thread that waits in [`rayon::join`] takes up other work of the pool meanwhile, such as the growth of another
/// session, and would come back to its frame only after that. So the second half is offered to the pool, and done
/// here unless another thread has begun it; what has begun waits for nothing, and is waited for without other work.
fn deflate(body: &[u8]) -> Option<Vec<u8>> {
    if body.len() < MIN_HALVED_BYTES {
        return deflate_part(body, FlushCompress::Finish);
    }
    let (first, second) = body.split_at(body.len() / 2);
    let offered: Arc<[u8]> = second.into();
    let is_begun = Arc::new(AtomicBool::new(false));
    let (answer, answered) = mpsc::sync_channel(1);
    rayon::spawn({
        let is_begun = Arc::clone(&is_begun);
        move || {
            if !is_begun.swap(true, Ordering::Relaxed) {
                // It is waited for; a panic in it is no answer, and the body goes as it is.
                let packed = catch_unwind(|| deflate_part(&offered, FlushCompress::Finish));
                let _ = answer.send(packed.ok().flatten());
            }
        }
    });
    let mut packed = deflate_part(first, FlushCompress::Sync)?;
    let second = if is_begun.swap(true, Ordering::Relaxed) {
        answered.recv().ok()?
    } else {
        deflate_part(second, FlushCompress::Finish)
    };
    packed.extend_from_slice(&second?);
    Some(packed)
}

fn deflate_part(part: &[u8], flush: FlushCompress) -> Option<Vec<u8>> {
    let level = if part.len() < SHORT_BYTES { SHORT_LEVEL } else { LEVEL };
    let mut packer = Compress::new(level, false);
    let mut packed = Vec::with_capacity(part.len() / 2 + SPARE_BYTES);
    loop {
        let left = part.get(packer.total_in() as usize..)?;
        packer.compress_vec(left, &mut packed, flush).ok()?;
        // As long as there was no room to spare, there may be more to come.
        if packer.total_in() as usize == part.len() && packed.len() < packed.capacity() {
            return Some(packed);
        }
        packed.reserve(packed.len() / 2 + SPARE_BYTES);
    }
}

fn inflate(payload: &[u8], length: usize) -> Result<Vec<u8>, FrameError> {
    // One byte more than promised is enough to see that the promise was false.
    let mut out = Vec::new();
    DeflateDecoder::new(payload)
        .take(length as u64 + 1)
        .read_to_end(&mut out)
        .map_err(|_| FrameError::Length)?;
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LENGTHS: [usize; 5] = [1000, MIN_HALVED_BYTES - 1, MIN_HALVED_BYTES, MIN_HALVED_BYTES + 1, 300_000];

    #[test]
    fn a_long_body_is_the_same_on_any_threads() {
        let body: Vec<u8> = (0..300_000u32).map(|i| (i.wrapping_mul(i) >> 13) as u8 & 15).collect();
        let here = deflate(&body).expect("it can be deflated");
        for threads in [1, 2, 4] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            for _ in 0..8 {
                assert!(pool.install(|| deflate(&body)).as_ref() == Some(&here), "{threads} threads");
            }
        }
    }

    #[test]
    fn a_long_body_is_one_deflate_stream() {
        // The more bits of each byte are noise, the less is gained.
        let noise = |bits: u32| {
            (0..300_000u32).map(move |i| (i.wrapping_mul(0x9e37_79b1).wrapping_pow(3) >> (32 - bits)) as u8)
        };
        for (bits, length) in (1..7).flat_map(|bits| LENGTHS.map(|length| (bits, length))) {
            let body: Vec<u8> = noise(bits).take(length).collect();
            let header = Header { flags: 0, epoch: 1, sequence: 2 };
            let sealed = seal(FrameKind::MeshDelta, header, &body);
            assert_eq!(sealed[2], CODEC_DEFLATE);
            let (_, opened) = open_plain(&sealed, FrameKind::MeshDelta).expect("it was sealed");
            assert!(*opened == body, "{length} bytes, {bits} bits");
        }
    }
}
