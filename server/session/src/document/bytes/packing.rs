//! Deflating and inflating.

use std::io::{Read, Write};

use flate2::{Compression, read::DeflateDecoder, write::DeflateEncoder};

use super::{DocumentError, damaged};

pub(super) fn deflate(bytes: &[u8]) -> Vec<u8> {
    let mut deflate = DeflateEncoder::new(Vec::with_capacity(bytes.len() / 2), Compression::new(3));
    // Writing into memory does not fail.
    let _ = deflate.write_all(bytes);
    deflate.finish().unwrap_or_default()
}

/// What was deflated; nothing if it is more than so many bytes, of which no more are unpacked.
pub(super) fn inflate(deflated: &[u8], most: u64) -> Result<Option<Vec<u8>>, DocumentError> {
    let mut bytes = Vec::new();
    let mut inflated = DeflateDecoder::new(deflated).take(most.saturating_add(1));
    inflated.read_to_end(&mut bytes).map_err(|_| damaged("it does not unpack"))?;
    Ok((bytes.len() as u64 <= most).then_some(bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bomb_unpacks_to_what_is_asked_for_and_no_further() {
        let bomb = deflate(&vec![0; 1 << 22]);
        assert!(bomb.len() < 1 << 13, "{} bytes become four million", bomb.len());
        assert_eq!(inflate(&bomb, (1 << 22) - 1), Ok(None));
        assert_eq!(inflate(&bomb, 0), Ok(None));
        assert_eq!(inflate(&bomb, 1 << 22), Ok(Some(vec![0; 1 << 22])));
        // No more than the limit is read: what follows is not even looked at.
        let torn = &bomb[..bomb.len() / 2];
        assert_eq!(inflate(torn, 100), Ok(None));
        assert!(inflate(torn, 1 << 22).is_err());
    }
}
