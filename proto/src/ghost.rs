//! A prediction: the plants as they would be, as a table of its own (`PD2`).

use crate::{
    envelope::{self, FrameError, FrameKind, Header},
    frame::{
        ChunkChange,
        layout::{read_changes, write_changes},
    },
};

/// What one client asked for with `predict`; without changes there is no ghost any more.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GhostFrame {
    /// As in mesh deltas.
    pub epoch: u32,
    /// Rises from ghost to ghost.
    pub sequence: u32,
    /// All chunks of the ghost's table, in order.
    pub changes: Vec<ChunkChange>,
}

impl GhostFrame {
    /// The frame as bytes.
    pub fn encode(&self) -> Vec<u8> {
        let header = Header { flags: 0, epoch: self.epoch, sequence: self.sequence };
        let mut body = Vec::new();
        write_changes(&self.changes, self.sequence, &mut body);
        envelope::seal(FrameKind::Ghost, header, &body)
    }

    /// Reads a frame; any bytes at all give a frame or an error.
    pub fn decode(bytes: &[u8]) -> Result<Self, FrameError> {
        let (Header { epoch, sequence, .. }, body) = envelope::open_plain(bytes, FrameKind::Ghost)?;
        Ok(Self { epoch, sequence, changes: read_changes(&mut &*body, sequence)? })
    }
}
