//! Skeletons.

use espalier_import::WoodFormat;

use crate::wood;

/// Reads a file, and makes a document of it.
pub fn read(bytes: &[u8]) -> bool {
    wood::read(WoodFormat::Skeleton, bytes)
}

/// Both versions.
pub fn seeds() -> Vec<Vec<u8>> {
    [include_str!("../seeds/skeleton-1.json"), include_str!("../seeds/skeleton-2.json")]
        .map(|text| text.as_bytes().to_vec())
        .into()
}
