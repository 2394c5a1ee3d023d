//! The header `Range`.

use espalier_proto::ranges::part;

/// Reads the bytes as what is asked of files of several lengths; a part is inside its file and not empty.
pub fn read(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    let asks = |length| match part(text, length) {
        Ok(Some(part)) => {
            assert!(part.start < part.end && part.end <= length, "{text} of {length}: {part:?}");
            true
        }
        Ok(None) | Err(_) => false,
    };
    let asked = [0, 1, 10, 1 << 40, u64::MAX].map(asks);
    assert!(!asked[0], "{text}: a file without bytes has no part");
    asked.contains(&true)
}

/// Parts that are told by both ends, and by one of them.
pub fn seeds() -> Vec<Vec<u8>> {
    ["bytes=0-3", "bytes=4-", "Bytes=-3", "bytes=7-9999999999", "bytes=-18446744073709551616"]
        .map(|text| text.as_bytes().to_vec())
        .to_vec()
}
