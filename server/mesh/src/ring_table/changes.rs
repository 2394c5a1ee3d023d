//! What differs between two states of a table.

use std::ops::Range;

/// What a [`RingTable::sync`](super::RingTable::sync) changed: first the truncation, then rows in ascending order
/// by column, then what was appended.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Changes {
    /// How many rows were kept, if some were dropped.
    pub truncated: Option<u32>,
    /// The rows that are new, those included that took the place of dropped ones.
    pub appended: Range<u32>,
    /// Kept rows that moved.
    pub position: Vec<u32>,
    /// Kept rows that thickened, died or came back to life.
    pub radius: Vec<u32>,
    /// The codes of their radii before.
    pub former_radius: Vec<u16>,
    /// Kept rows whose leaves or vigor changed.
    pub foliage: Vec<u32>,
    /// Their leaves and vigor before.
    pub former_foliage: Vec<u8>,
    /// Kept rows whose light changed.
    pub light: Vec<u32>,
    /// Their light before.
    pub former_light: Vec<u8>,
    /// Kept rows that are given other organs.
    pub organs: Vec<u32>,
}

impl Changes {
    /// Whether nothing changed.
    pub fn is_empty(&self) -> bool {
        self.truncated.is_none()
            && self.appended.is_empty()
            && [&self.position, &self.radius, &self.foliage, &self.light, &self.organs]
                .iter()
                .all(|rows| rows.is_empty())
    }
}
