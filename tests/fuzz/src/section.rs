//! Sections of documents, behind the checksums that would hide damage to them.
//!
//! Bytes here are a document laid open: what lies packed and sealed in a file stands in plain, and [`read`] packs and
//! seals it, so that damage reaches the readers of what is inside.

use espalier_plant::hash::StableHash;

use crate::document;

/// What a document in sections begins with, and one of version 0.1.0.
const MAGIC: &[u8; 8] = b"ESPALIER";
/// What a snapshot of version 0.1.0 begins with.
const OLD_SNAPSHOT: &[u8] = b"ESPS";
/// Of the header in bytes, and of an entry of the table behind it.
const HEADER: usize = 28;
const ENTRY: usize = 28;
/// Where the formats of the container, and the body of the format before it, begin.
const FORMAT: usize = 8;
const BODY: usize = 24;

/// Seals a document that was laid open, and reads it as any other.
pub fn read(bytes: &[u8]) -> bool {
    document::read(&sealed(bytes))
}

/// Everything that a document, or its kin of earlier releases, can be, laid open.
pub fn seeds() -> Vec<Vec<u8>> {
    document::seeds().iter().filter_map(|seed| laid_open(seed)).collect()
}

/// The document with sections unpacked: the first bytes of its header, then tag, version, flags, length and contents of
/// each section. Of version 0.1.0 the header and the unpacked body, or what the checksum of a snapshot covers.
fn laid_open(bytes: &[u8]) -> Option<Vec<u8>> {
    if bytes.starts_with(OLD_SNAPSHOT) {
        return Some(bytes.split_last_chunk::<4>()?.0.to_vec());
    }
    if bytes.get(FORMAT) == Some(&4) {
        return Some([&bytes[..16], &inflated(bytes.get(BODY..)?)?].concat());
    }
    let count = u32::from_le_bytes(*bytes.get(20..24)?.first_chunk()?) as usize;
    let (table, mut rest) = bytes.get(HEADER..)?.split_at_checked(count * ENTRY)?;
    let mut open = bytes[..20].to_vec();
    for entry in table.chunks_exact(ENTRY) {
        let length = u64::from_le_bytes(*entry[8..].first_chunk()?) as usize;
        let (packed, behind) = rest.split_at_checked(length)?;
        rest = behind;
        let contents = if entry[7] == 0 { packed.to_vec() } else { inflated(packed)? };
        open.extend_from_slice(&entry[..7]);
        open.extend_from_slice(&(contents.len() as u32).to_le_bytes());
        open.extend_from_slice(&contents);
    }
    Some(open)
}

/// The same with lengths and checksums that are right, whatever stands in it.
fn sealed(open: &[u8]) -> Vec<u8> {
    if open.starts_with(OLD_SNAPSHOT) {
        return [open, &crc32fast::hash(open).to_le_bytes()].concat();
    }
    if open.starts_with(MAGIC) && open.get(FORMAT) == Some(&4) && open.len() >= 16 {
        let body = &open[16..];
        let mut hash = StableHash::default();
        hash.word(body.len() as u64);
        for chunk in body.chunks(8) {
            hash.word(chunk.iter().rev().fold(0, |word, &byte| word << 8 | u64::from(byte)));
        }
        return [&open[..16], &hash.finish().to_le_bytes(), &deflated(body)].concat();
    }
    let Some((header, mut rest)) = open.split_at_checked(20) else { return open.to_vec() };
    let (mut table, mut sections, mut count) = (Vec::new(), Vec::new(), 0u32);
    while let Some((entry, behind)) = rest.split_at_checked(11) {
        let length = entry[7..].first_chunk().map_or(0, |&length| u32::from_le_bytes(length) as usize);
        let (contents, behind) = behind.split_at(length.min(behind.len()));
        rest = behind;
        table.extend_from_slice(&entry[..7]);
        table.push(0);
        table.extend_from_slice(&[(contents.len() as u64).to_le_bytes(); 2].concat());
        table.extend_from_slice(&crc32fast::hash(contents).to_le_bytes());
        sections.extend_from_slice(contents);
        count += 1;
    }
    let header = [header, &count.to_le_bytes()].concat();
    let sum = crc32fast::hash(&[&header[..], &table].concat());
    [&header[..], &sum.to_le_bytes(), &table, &sections].concat()
}

fn inflated(packed: &[u8]) -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    std::io::Read::read_to_end(&mut flate2::read::DeflateDecoder::new(packed), &mut bytes).ok()?;
    Some(bytes)
}

fn deflated(bytes: &[u8]) -> Vec<u8> {
    let mut deflate = flate2::write::DeflateEncoder::new(Vec::new(), flate2::Compression::fast());
    // Writing into memory does not fail.
    let _ = std::io::Write::write_all(&mut deflate, bytes);
    deflate.finish().unwrap_or_default()
}
