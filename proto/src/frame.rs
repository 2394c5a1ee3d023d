//! Binary mesh deltas: rings of generalized cylinders as columns of a table with one row per metamer.
//!
//! A frame is a header and a body of [`ChunkChange`]s. Rows are metamers in birth order; a chunk is
//! [`CHUNK_ROWS`] consecutive rows with one generation. `PROTOCOL.md` gives the layout byte by byte (`FR`).

pub mod direction;
pub(crate) mod layout;

use crate::{
    envelope::{self, Body, FLAG_CATCH_UP, FrameKind, Header},
    packing::{Packer, Tally, Unpacker},
};
use layout::{read_changes, write_changes};

pub use crate::envelope::{FrameError, HEADER_BYTES, MAX_BODY_BYTES};

/// Rows in a full chunk.
pub const CHUNK_ROWS: usize = 256;
/// Steps of the position grid in one internode length.
pub const POSITION_STEPS: f32 = 256.0;
/// Radius of code 1, in internode lengths; code c means `MIN_RADIUS · e^((c − 1) · RADIUS_LOG_STEP)`, code 0 no ring.
pub const MIN_RADIUS: f32 = 0.001;
/// Ratio of neighbouring radius codes, as a natural logarithm.
pub const RADIUS_LOG_STEP: f32 = 0.01;

/// The level of light that a value of the column shows.
pub fn light_level(light: u8) -> i32 {
    i32::from(light >> 3)
}

/// The light of a level; none beyond the highest, 31, and below 0.
pub fn light_of(level: i32) -> Option<u8> {
    let level = u8::try_from(level).ok().filter(|level| *level < 32)?;
    Some(level << 3 | level >> 2)
}

/// Organs of one row at most.
pub const MOST_ORGANS: usize = 15;

/// One change to the table of rows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    /// Frames of one epoch build on each other.
    pub epoch: u32,
    /// Number of this frame in its epoch.
    pub sequence: u32,
    /// Made for one client from the current state, not from the frame before.
    pub catch_up: bool,
    /// What to do, in this order.
    pub changes: Vec<ChunkChange>,
}

/// A change to the table of rows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ChunkChange {
    /// Forget every row from `rows` on.
    Truncate {
        /// How many rows remain.
        rows: u32,
    },
    /// A chunk as a whole.
    Replace {
        /// Which chunk.
        chunk: u32,
        /// Its generation from now on.
        generation: u32,
        /// All its rows, 1 to 256.
        rows: Rows,
    },
    /// Rows behind those a chunk already has.
    Append {
        /// Which chunk.
        chunk: u32,
        /// Its generation from now on.
        generation: u32,
        /// How many rows it has so far.
        start: u32,
        /// The new rows.
        rows: Rows,
    },
    /// New values in one column of some rows.
    Patch {
        /// Which chunk.
        chunk: u32,
        /// Its generation from now on.
        generation: u32,
        /// The rows within the chunk, ascending.
        rows: Vec<u8>,
        /// As many values as rows.
        values: Values,
    },
}

/// Names a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Column {
    /// Which row this one grows from.
    Parent = 0,
    /// Where the metamer ends.
    Position = 1,
    /// How thick it is there.
    Radius = 2,
    /// Its leaves.
    Foliage = 3,
    /// The light it receives.
    Light = 4,
    /// When it was born.
    Born = 5,
    /// Organs that it is given.
    Organs = 6,
}

/// Values of one column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Values {
    /// 0 for a seed, else `2 · (row − parent row) + (1 if it begins an axis)`.
    Parent(Vec<u32>),
    /// What is [told](direction) of the difference to the parent's position (to the origin without one), in steps of 1/256
    /// internode.
    Position(Vec<[i32; 3]>),
    /// By how much the radius code changes; a code of 0: the metamer is dead and not drawn.
    Radius(Vec<i32>),
    /// By how much foliage changes, modulo 256: number of leaves in the low four bits, vigor from 0 (weak) to 15 in the high
    /// four.
    Foliage(Vec<u8>),
    /// By how many of 32 levels the exposure to light changes.
    Light(Vec<i32>),
    /// Steps of growth up to its birth, the one in which it was born included; 0 for the first seed.
    Born(Vec<u32>),
    /// Organs that it is given, at most 15, each in one number (`LF5`); none where it bears what grows on such wood.
    Organs(Vec<Option<Vec<u32>>>),
}

/// Whole rows, column by column; all columns have the same length.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Rows {
    /// See [`Values::Parent`].
    pub parent: Vec<u32>,
    /// See [`Values::Position`].
    pub position: Vec<[i32; 3]>,
    /// Radius code; 0: the metamer is dead and not drawn.
    pub radius: Vec<u16>,
    /// Number of leaves in the low four bits, vigor from 0 (weak) to 15 in the high four.
    pub foliage: Vec<u8>,
    /// Light exposure from 0 (dark) to 255 (full).
    pub light: Vec<u8>,
    /// See [`Values::Born`].
    pub born: Vec<u32>,
}

impl Rows {
    /// How many rows.
    pub fn len(&self) -> usize {
        self.parent.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.parent.is_empty()
    }

    fn is_consistent(&self) -> bool {
        let n = self.len();
        let lengths = [self.position.len(), self.radius.len(), self.foliage.len(), self.light.len()];
        lengths == [n; 4] && self.born.len() == n
    }
}

impl Values {
    /// How many values.
    pub fn len(&self) -> usize {
        match self {
            Self::Parent(v) | Self::Born(v) => v.len(),
            Self::Position(v) => v.len(),
            Self::Radius(v) | Self::Light(v) => v.len(),
            Self::Foliage(v) => v.len(),
            Self::Organs(v) => v.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Which column they belong to.
    pub fn column(&self) -> Column {
        match self {
            Self::Parent(_) => Column::Parent,
            Self::Position(_) => Column::Position,
            Self::Radius(_) => Column::Radius,
            Self::Foliage(_) => Column::Foliage,
            Self::Light(_) => Column::Light,
            Self::Born(_) => Column::Born,
            Self::Organs(_) => Column::Organs,
        }
    }
}

/// A body up to this length is packed by models: longer ones take their time, and deflate finds more in them.
const MOST_PACKED_BYTES: usize = 8 * 1024;

impl Frame {
    /// The frame as bytes. A short change is packed by models (`FR9`), all else deflated, where that makes it shorter.
    pub fn encode(&self) -> Vec<u8> {
        let flags = if self.catch_up { FLAG_CATCH_UP } else { 0 };
        let header = Header { flags, epoch: self.epoch, sequence: self.sequence };
        let body = self.body();
        if self.catch_up || body.len() > MOST_PACKED_BYTES {
            return envelope::seal(FrameKind::MeshDelta, header, &body);
        }
        let mut packer = Packer::default();
        write_changes(&self.changes, self.sequence, &mut packer);
        let packed = packer.finish();
        if packed.len() < body.len() {
            envelope::seal_packed(FrameKind::MeshDelta, header, &packed)
        } else {
            envelope::seal(FrameKind::MeshDelta, header, &body)
        }
    }

    /// What is in it before anything is packed.
    pub fn body(&self) -> Vec<u8> {
        let mut body = Vec::new();
        write_changes(&self.changes, self.sequence, &mut body);
        body
    }

    /// Counts what is in it, for what is usual in other frames.
    pub fn count_into(&self, tally: &mut Tally) {
        write_changes(&self.changes, self.sequence, tally);
    }

    /// Reads a frame; any bytes at all give a frame or an error.
    pub fn decode(bytes: &[u8]) -> Result<Self, FrameError> {
        let (Header { flags, epoch, sequence }, body) = envelope::open(bytes, FrameKind::MeshDelta)?;
        let changes = match body {
            Body::Plain(body) => read_changes(&mut &*body, sequence)?,
            Body::Packed(packed) => {
                let mut packed = Unpacker::new(packed);
                let changes = read_changes(&mut packed, sequence)?;
                if !packed.is_at_end() {
                    return Err(FrameError::Length);
                }
                changes
            }
        };
        Ok(Self { epoch, sequence, catch_up: flags & FLAG_CATCH_UP != 0, changes })
    }
}
