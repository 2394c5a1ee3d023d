//! Documents whose sections are not packed: two of them that hold much the same have long runs of bytes in common.

use super::container::{Container, Section};

/// The same document or snapshot with no section packed, for a store that keeps what documents have in common once. It
/// opens as the other does. Bytes that are no container of this program come back as they are.
pub fn plain(bytes: Vec<u8>) -> Vec<u8> {
    let Ok(mut container) = Container::from_bytes(&bytes) else { return bytes };
    if !container.sections.iter().any(Section::is_packed) {
        return bytes;
    }
    for section in &mut container.sections {
        match section.unpack() {
            Ok(unpacked) => *section = Section::unpacked(section, unpacked.into_owned()),
            Err(_) => return bytes,
        }
    }
    container.to_bytes()
}
