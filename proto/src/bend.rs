//! A branch that is being bent: while fingers drag it, only the motions of its path travel (`BE5`).

use crate::{
    envelope::{self, FrameError, FrameKind, Header},
    varint,
};

/// How one internode of a bent path has moved: x goes to `rotation · (x − from) + to`, where `from` is the
/// row's position in the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RowMotion {
    /// The metamer's row.
    pub row: u32,
    /// The quaternion (x, y, z, w).
    pub rotation: [f32; 4],
    /// Where the metamer ends now, in internode lengths.
    pub to: [f32; 3],
}

/// Where an open bend stands; without motions it is over.
#[derive(Clone, Debug, PartialEq)]
pub struct BendFrame {
    /// As in mesh deltas.
    pub epoch: u32,
    /// Rises from frame to frame.
    pub sequence: u32,
    /// The server's own number for the bend.
    pub bend: u32,
    /// One for each internode of the path, from the base upwards.
    pub motions: Vec<RowMotion>,
}

impl BendFrame {
    /// The frame as bytes.
    pub fn encode(&self) -> Vec<u8> {
        let mut body = Vec::with_capacity(8 + 32 * self.motions.len());
        varint::write(&mut body, self.bend);
        varint::write(&mut body, self.motions.len() as u32);
        for motion in &self.motions {
            varint::write(&mut body, motion.row);
            for value in motion.rotation.into_iter().chain(motion.to) {
                body.extend_from_slice(&value.to_le_bytes());
            }
        }
        let header = Header { flags: 0, epoch: self.epoch, sequence: self.sequence };
        envelope::seal(FrameKind::Bend, header, &body)
    }

    /// Reads a frame; any bytes at all give a frame of finite numbers or an error.
    pub fn decode(bytes: &[u8]) -> Result<Self, FrameError> {
        let (Header { epoch, sequence, .. }, body) = envelope::open_plain(bytes, FrameKind::Bend)?;
        let mut body = &*body;
        let bend = varint::read(&mut body).ok_or(FrameError::Truncated)?;
        let count = varint::read(&mut body).ok_or(FrameError::Truncated)?;
        let motions = (0..count).map(|_| RowMotion::read(&mut body)).collect::<Result<_, _>>()?;
        if body.is_empty() { Ok(Self { epoch, sequence, bend, motions }) } else { Err(FrameError::Body) }
    }
}

impl RowMotion {
    fn read(bytes: &mut &[u8]) -> Result<Self, FrameError> {
        let row = varint::read(bytes).ok_or(FrameError::Truncated)?;
        let mut next = || {
            let (value, rest) = bytes.split_first_chunk().ok_or(FrameError::Truncated)?;
            *bytes = rest;
            let value = f32::from_le_bytes(*value);
            if value.is_finite() { Ok(value) } else { Err(FrameError::Body) }
        };
        let rotation = [next()?, next()?, next()?, next()?];
        Ok(Self { row, rotation, to: [next()?, next()?, next()?] })
    }
}
