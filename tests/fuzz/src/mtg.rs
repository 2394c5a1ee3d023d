//! Multiscale tree graphs.

use espalier_import::WoodFormat;

use crate::wood;

/// Reads a file, and makes a document of it.
pub fn read(bytes: &[u8]) -> bool {
    wood::read(WoodFormat::Mtg, bytes)
}

/// A graph as this program writes it, and one with growth units and runs.
pub fn seeds() -> Vec<Vec<u8>> {
    [include_str!("../seeds/own.mtg"), include_str!("../seeds/units.mtg")]
        .map(|text| text.as_bytes().to_vec())
        .into()
}
