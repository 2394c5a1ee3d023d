//! Wood from files of structure, which becomes a document.

use espalier_import::{Units, WoodFormat, WoodOptions, read_wood};
use espalier_session::Document;
use espalier_settings::{Appearance, ParameterValues};

use crate::SEED;

const NODES: usize = 1000;

/// Reads a file; what it gives is within the limits, and if it fits together it is a document that can be written,
/// read again and taken back to its seeds.
pub(crate) fn read(format: WoodFormat, bytes: &[u8]) -> bool {
    let options =
        WoodOptions { internode_length: None, units: Units::of(1.0), shoot: 4, nodes: NODES, extent: 1000.0 };
    let file = match read_wood(format, bytes, &options) {
        Ok(file) => file,
        Err(fault) => {
            assert!(!fault.what.is_empty(), "a fault without a sentence: {fault:?}");
            return false;
        }
    };
    assert!(file.wood.nodes.len() <= NODES);
    let parameters = ParameterValues::default().patched(&file.parameters);
    let made = Document::transplanted(&file.wood, SEED, &parameters, Appearance::default());
    let Ok(document) = made else { return false };
    let again = Document::from_bytes(&document.to_bytes()).map(|document| document.hash());
    assert_eq!(again.as_ref().ok(), Some(&document.hash()), "{again:?}");
    let mut plant = document.plant().clone();
    let hash = plant.hash();
    let now = plant.step();
    plant.go_to(0);
    plant.go_to(now);
    assert_eq!(plant.hash(), hash);
    true
}
