//! Snapshots of the first released version, 0.1.0: a document behind a header of its own. Frozen.

use std::collections::BTreeMap;

use flate2::Crc;

use super::{Progress, RestoreError, Snapshot};
use crate::{
    author::LastCommand,
    document::{Document, DocumentError, Reader},
    principal::Principal,
};

const MAGIC: &[u8] = b"ESPS";
const VERSION: u32 = 1;

/// Reads a snapshot; nothing if the bytes are not of this format.
///
/// Little-endian: magic, version, last entry, count of authors; per author key length, key, id, entry; the document;
/// a CRC-32 of all before.
pub(super) fn from_bytes(bytes: &[u8]) -> Result<Option<Snapshot>, RestoreError> {
    if !bytes.starts_with(MAGIC) {
        return Ok(None);
    }
    let (contents, sum) = bytes.split_last_chunk().ok_or(RestoreError::Damaged)?;
    let mut expected = Crc::new();
    expected.update(contents);
    if expected.sum() != u32::from_le_bytes(*sum) {
        return Err(RestoreError::Damaged);
    }
    let mut reader = Reader::new(&contents[MAGIC.len()..]);
    let (through, last_commands) = read_header(&mut reader).map_err(|_| RestoreError::Damaged)?;
    let document = Document::from_bytes(reader.rest())?;
    Ok(Some(Snapshot { through, last_commands, document }))
}

fn read_header(reader: &mut Reader<'_>) -> Result<Progress, DocumentError> {
    if reader.u32()? != VERSION {
        return Err(DocumentError::NotADocument);
    }
    let (through, count) = (reader.u64()?, reader.u32()?);
    let mut last_commands = BTreeMap::new();
    for _ in 0..count {
        let length = reader.u8()?;
        let key =
            std::str::from_utf8(reader.slice(length.into())?).map_err(|_| DocumentError::NotADocument)?;
        let last = LastCommand { id: reader.u32()?, entry: reader.u64()? };
        last_commands.insert(Principal::named(key), last);
    }
    Ok((through, last_commands))
}
