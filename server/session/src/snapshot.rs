//! A session as bytes: the document, who did how much, and where the journal goes on.

use std::{collections::BTreeMap, sync::Arc};

use espalier_proto::Problem;

use crate::{
    author::LastCommand,
    document::{Document, DocumentError},
};

const MAGIC: [u8; 4] = *b"ESPS";
const VERSION: u32 = 1;
/// Magic, version, entry and count before the keys; the checksum behind the document.
const FIXED_BYTES: usize = 4 + 4 + 8 + 4 + 4;

/// Why a session cannot be loaded.
#[derive(Debug, thiserror::Error)]
pub enum RestoreError {
    /// The bytes are no snapshot, or are damaged.
    #[error("the snapshot is damaged")]
    Damaged,
    /// A snapshot of another version of this program.
    #[error("the snapshot has version {0}; this program reads version 1")]
    Version(u32),
    /// The document inside cannot be read.
    #[error("the snapshot's document cannot be read")]
    Document(#[from] DocumentError),
    /// A journal entry is missing.
    #[error("the journal goes on with entry {found}, but entry {expected} is missing")]
    Gap {
        /// The entry that should follow.
        expected: u64,
        /// The one that does.
        found: u64,
    },
    /// A journal entry holds no command.
    #[error("journal entry {number} cannot be read: {problem}")]
    Entry {
        /// Which one.
        number: u64,
        /// Why.
        problem: Problem,
    },
}

/// What a snapshot holds.
#[derive(Debug)]
pub(crate) struct Snapshot {
    pub(crate) through: u64,
    pub(crate) last_commands: BTreeMap<Arc<str>, LastCommand>,
    pub(crate) document: Document,
}

/// Little-endian: magic, version, last entry, count of authors; per author key length, key, id, entry;
/// the document; a CRC-32 of all before.
pub(crate) fn to_bytes(
    through: u64,
    last_commands: &BTreeMap<Arc<str>, LastCommand>,
    document: &[u8],
) -> Vec<u8> {
    let mut out = Vec::with_capacity(FIXED_BYTES + 48 * last_commands.len() + document.len());
    out.extend_from_slice(&MAGIC);
    out.extend_from_slice(&VERSION.to_le_bytes());
    out.extend_from_slice(&through.to_le_bytes());
    out.extend_from_slice(&(last_commands.len() as u32).to_le_bytes());
    for (key, last) in last_commands {
        out.push(key.len() as u8);
        out.extend_from_slice(key.as_bytes());
        out.extend_from_slice(&last.id.to_le_bytes());
        out.extend_from_slice(&last.entry.to_le_bytes());
    }
    out.extend_from_slice(document);
    let sum = checksum(&out);
    out.extend_from_slice(&sum.to_le_bytes());
    out
}

/// Reads a snapshot; any bytes at all give one or an error.
pub(crate) fn from_bytes(bytes: &[u8]) -> Result<Snapshot, RestoreError> {
    let (contents, sum) = bytes.split_last_chunk().ok_or(RestoreError::Damaged)?;
    if checksum(contents) != u32::from_le_bytes(*sum) {
        return Err(RestoreError::Damaged);
    }
    read(contents)
}

fn read(contents: &[u8]) -> Result<Snapshot, RestoreError> {
    let mut rest = contents;
    if take(&mut rest)? != MAGIC {
        return Err(RestoreError::Damaged);
    }
    let version = u32::from_le_bytes(take(&mut rest)?);
    if version != VERSION {
        return Err(RestoreError::Version(version));
    }
    let through = u64::from_le_bytes(take(&mut rest)?);
    let count = u32::from_le_bytes(take(&mut rest)?);
    let mut last_commands = BTreeMap::new();
    for _ in 0..count {
        let [length] = take(&mut rest)?;
        let (key, after) = rest.split_at_checked(length.into()).ok_or(RestoreError::Damaged)?;
        rest = after;
        let key = std::str::from_utf8(key).map_err(|_| RestoreError::Damaged)?;
        let id = u32::from_le_bytes(take(&mut rest)?);
        let entry = u64::from_le_bytes(take(&mut rest)?);
        last_commands.insert(Arc::from(key), LastCommand { id, entry });
    }
    Ok(Snapshot { through, last_commands, document: Document::from_bytes(rest)? })
}

fn take<const N: usize>(bytes: &mut &[u8]) -> Result<[u8; N], RestoreError> {
    let (taken, rest) = bytes.split_first_chunk().ok_or(RestoreError::Damaged)?;
    *bytes = rest;
    Ok(*taken)
}

fn checksum(bytes: &[u8]) -> u32 {
    let mut sum = flate2::Crc::new();
    sum.update(bytes);
    sum.sum()
}
