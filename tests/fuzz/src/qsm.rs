//! Quantitative structure models.

use espalier_import::WoodFormat;

use crate::wood;

/// Reads a file, and makes a document of it.
pub fn read(bytes: &[u8]) -> bool {
    wood::read(WoodFormat::Qsm, bytes)
}

/// Cylinders as this program writes them, and as another one does.
pub fn seeds() -> Vec<Vec<u8>> {
    [include_str!("../seeds/own.csv"), include_str!("../seeds/rtwig.csv")]
        .map(|text| text.as_bytes().to_vec())
        .into()
}
