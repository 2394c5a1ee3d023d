//! Binary mesh deltas: rings of generalized cylinders as columns of a table with one row per metamer.
//!
//! A frame is a header and a body of [`ChunkChange`]s. Rows are metamers in birth order; a chunk is
//! [`CHUNK_ROWS`] consecutive rows with one generation. `PROTOCOL.md` gives the layout byte by byte (`FR`).

use crate::{
    envelope::{self, FLAG_CATCH_UP, FrameKind, Header},
    varint,
};

pub use crate::envelope::{FrameError, HEADER_BYTES, MAX_BODY_BYTES};

/// Rows in a full chunk.
pub const CHUNK_ROWS: usize = 256;
/// Steps of the position grid in one internode length.
pub const POSITION_STEPS: f32 = 256.0;
/// Radius of code 1, in internode lengths; code c means `MIN_RADIUS · e^((c − 1) · RADIUS_LOG_STEP)`, code 0 no ring.
pub const MIN_RADIUS: f32 = 0.001;
/// Ratio of neighbouring radius codes, as a natural logarithm.
pub const RADIUS_LOG_STEP: f32 = 0.01;

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
    /// Difference to the parent's position (to the origin without one), in steps of 1/256 internode.
    Position(Vec<[i32; 3]>),
    /// Radius code; 0: the metamer is dead and not drawn.
    Radius(Vec<u16>),
    /// Number of leaves in the low four bits, vigor from 0 (weak) to 15 in the high four.
    Foliage(Vec<u8>),
    /// Light exposure from 0 (dark) to 255 (full).
    Light(Vec<u8>),
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
    /// See [`Values::Radius`].
    pub radius: Vec<u16>,
    /// See [`Values::Foliage`].
    pub foliage: Vec<u8>,
    /// See [`Values::Light`].
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

    fn write(&self, out: &mut Vec<u8>) {
        debug_assert!(self.is_consistent(), "all columns have one length");
        varint::write(out, self.len() as u32);
        write_column(out, &self.parent, |v| *v);
        write_positions(out, &unlike(&self.parent, &self.position));
        write_radii(out, &self.radius);
        write_bytes(out, &self.foliage);
        write_bytes(out, &self.light);
        write_births(out, &self.born);
    }

    fn read(bytes: &mut &[u8]) -> Result<Self, FrameError> {
        let count = read_count(bytes)?;
        let parent = read_column(bytes, count, Some)?;
        let mut position = read_positions(bytes, count)?;
        for row in 1..count {
            if parent[row] == NEXT {
                position[row] =
                    std::array::from_fn(|axis| position[row][axis].wrapping_add(position[row - 1][axis]));
            }
        }
        Ok(Self {
            parent,
            position,
            radius: read_radii(bytes, count)?,
            foliage: read_bytes(bytes, count)?,
            light: read_bytes(bytes, count)?,
            born: read_births(bytes, count)?,
        })
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
            Self::Radius(v) => v.len(),
            Self::Foliage(v) | Self::Light(v) => v.len(),
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

    fn write(&self, out: &mut Vec<u8>) {
        match self {
            Self::Parent(v) => write_column(out, v, |v| *v),
            Self::Position(v) => write_positions(out, v),
            Self::Radius(v) => write_radii(out, v),
            Self::Foliage(v) | Self::Light(v) => write_bytes(out, v),
            Self::Born(v) => write_births(out, v),
            Self::Organs(v) => write_organs(out, v),
        }
    }

    fn read(bytes: &mut &[u8], column: u8, count: usize) -> Result<Self, FrameError> {
        Ok(match column {
            0 => Self::Parent(read_column(bytes, count, Some)?),
            1 => Self::Position(read_positions(bytes, count)?),
            2 => Self::Radius(read_radii(bytes, count)?),
            3 => Self::Foliage(read_bytes(bytes, count)?),
            4 => Self::Light(read_bytes(bytes, count)?),
            5 => Self::Born(read_births(bytes, count)?),
            6 => Self::Organs((0..count).map(|_| read_organs(bytes)).collect::<Result<_, _>>()?),
            _ => return Err(FrameError::Body),
        })
    }
}

/// The parent of a row that goes on where the row before it ends.
const NEXT: u32 = 2;

const TRUNCATE: u8 = 1;
const REPLACE: u8 = 2;
const APPEND: u8 = 3;
const PATCH: u8 = 4;

impl ChunkChange {
    fn write(&self, sequence: u32, out: &mut Vec<u8>) {
        match self {
            Self::Truncate { rows } => {
                out.push(TRUNCATE);
                varint::write(out, *rows);
            }
            Self::Replace { chunk, generation, rows } => {
                out.push(REPLACE);
                varint::write(out, *chunk);
                varint::write(out, sequence.wrapping_sub(*generation));
                rows.write(out);
            }
            Self::Append { chunk, generation, start, rows } => {
                out.push(APPEND);
                varint::write(out, *chunk);
                varint::write(out, sequence.wrapping_sub(*generation));
                varint::write(out, *start);
                rows.write(out);
            }
            Self::Patch { chunk, generation, rows, values } => {
                debug_assert_eq!(rows.len(), values.len(), "one value a row");
                out.push(PATCH);
                varint::write(out, *chunk);
                varint::write(out, sequence.wrapping_sub(*generation));
                out.push(values.column() as u8);
                varint::write(out, rows.len() as u32);
                let mut next = 0;
                for &row in rows {
                    varint::write(out, u32::from(row) - next);
                    next = u32::from(row) + 1;
                }
                values.write(out);
            }
        }
    }

    fn read(bytes: &mut &[u8], sequence: u32) -> Result<Self, FrameError> {
        let kind = read_byte(bytes)?;
        let first = read_varint(bytes)?;
        if kind == TRUNCATE {
            return Ok(Self::Truncate { rows: first });
        }
        let (chunk, generation) = (first, sequence.wrapping_sub(read_varint(bytes)?));
        match kind {
            REPLACE => Ok(Self::Replace { chunk, generation, rows: Rows::read(bytes)? }),
            APPEND => {
                let start = read_varint(bytes)?;
                let rows = Rows::read(bytes)?;
                let fits = (start as usize).checked_add(rows.len()).is_some_and(|end| end <= CHUNK_ROWS);
                if fits { Ok(Self::Append { chunk, generation, start, rows }) } else { Err(FrameError::Body) }
            }
            PATCH => {
                let column = read_byte(bytes)?;
                let count = read_count(bytes)?;
                let mut rows = Vec::with_capacity(count);
                let mut next = 0u32;
                for _ in 0..count {
                    let row = next.checked_add(read_varint(bytes)?).ok_or(FrameError::Body)?;
                    rows.push(u8::try_from(row).map_err(|_| FrameError::Body)?);
                    next = row + 1;
                }
                Ok(Self::Patch { chunk, generation, rows, values: Values::read(bytes, column, count)? })
            }
            _ => Err(FrameError::Body),
        }
    }
}

impl Frame {
    /// The frame as bytes; the body is deflated where that makes it shorter.
    pub fn encode(&self) -> Vec<u8> {
        let flags = if self.catch_up { FLAG_CATCH_UP } else { 0 };
        let header = Header { flags, epoch: self.epoch, sequence: self.sequence };
        envelope::seal(FrameKind::MeshDelta, header, &write_changes(&self.changes, self.sequence))
    }

    /// Reads a frame; any bytes at all give a frame or an error.
    pub fn decode(bytes: &[u8]) -> Result<Self, FrameError> {
        let (Header { flags, epoch, sequence }, body) = envelope::open(bytes, FrameKind::MeshDelta)?;
        let changes = read_changes(&body, sequence)?;
        Ok(Self { epoch, sequence, catch_up: flags & FLAG_CATCH_UP != 0, changes })
    }
}

/// The changes of a frame with this sequence.
pub(crate) fn write_changes(changes: &[ChunkChange], sequence: u32) -> Vec<u8> {
    let mut body = Vec::new();
    changes.iter().for_each(|change| change.write(sequence, &mut body));
    body
}

pub(crate) fn read_changes(mut body: &[u8], sequence: u32) -> Result<Vec<ChunkChange>, FrameError> {
    let mut changes = Vec::new();
    while !body.is_empty() {
        changes.push(ChunkChange::read(&mut body, sequence)?);
    }
    Ok(changes)
}

fn write_column<T>(out: &mut Vec<u8>, values: &[T], mut code: impl FnMut(&T) -> u32) {
    for value in values {
        varint::write(out, code(value));
    }
}

/// Of a row that goes on where the row before it ends, how it differs from that: shoots are nearly straight.
fn unlike(parents: &[u32], positions: &[[i32; 3]]) -> Vec<[i32; 3]> {
    let before = |row: usize| if row > 0 && parents[row] == NEXT { positions[row - 1] } else { [0; 3] };
    let rows = positions.iter().enumerate();
    rows.map(|(row, p)| std::array::from_fn(|axis| p[axis].wrapping_sub(before(row)[axis]))).collect()
}

/// Each as the difference to the one before it, modulo 256.
fn write_bytes(out: &mut Vec<u8>, bytes: &[u8]) {
    let mut before = 0;
    out.extend(bytes.iter().map(|&byte| byte.wrapping_sub(std::mem::replace(&mut before, byte))));
}

/// All x, then all y, then all z: like stands beside like, which packs better.
fn write_positions(out: &mut Vec<u8>, positions: &[[i32; 3]]) {
    for axis in 0..3 {
        write_column(out, positions, |p| varint::zigzag(p[axis]));
    }
}

/// Each as the difference to the one before it: what grows on one axis is nearly equally thick.
fn write_radii(out: &mut Vec<u8>, radii: &[u16]) {
    let mut before = 0;
    write_column(out, radii, |&code| {
        let code = i32::from(code);
        varint::zigzag(code - std::mem::replace(&mut before, code))
    });
}

/// Each as the difference to the one before it: rows are in birth order, so nearly all are 0.
fn write_births(out: &mut Vec<u8>, births: &[u32]) {
    let mut before = 0;
    write_column(out, births, |&born| born.wrapping_sub(std::mem::replace(&mut before, born)));
}

/// A byte that is 0 for none and else one more than their number, then so many numbers.
fn write_organs(out: &mut Vec<u8>, rows: &[Option<Vec<u32>>]) {
    for organs in rows {
        debug_assert!(organs.as_ref().is_none_or(|organs| organs.len() <= MOST_ORGANS), "at most 15");
        out.push(organs.as_ref().map_or(0, |organs| 1 + organs.len() as u8));
        out.extend(organs.iter().flatten().flat_map(|organ| organ.to_le_bytes()));
    }
}

fn read_organs(bytes: &mut &[u8]) -> Result<Option<Vec<u32>>, FrameError> {
    let Some(count) = usize::from(read_byte(bytes)?).checked_sub(1) else { return Ok(None) };
    if count > MOST_ORGANS {
        return Err(FrameError::Body);
    }
    let organ = |_| {
        let (organ, rest) = bytes.split_first_chunk().ok_or(FrameError::Truncated)?;
        *bytes = rest;
        let organ = u32::from_le_bytes(*organ);
        if organ >> 30 == 3 { Err(FrameError::Body) } else { Ok(organ) }
    };
    (0..count).map(organ).collect::<Result<_, _>>().map(Some)
}

fn read_byte(bytes: &mut &[u8]) -> Result<u8, FrameError> {
    let (&byte, rest) = bytes.split_first().ok_or(FrameError::Truncated)?;
    *bytes = rest;
    Ok(byte)
}

fn read_varint(bytes: &mut &[u8]) -> Result<u32, FrameError> {
    varint::read(bytes).ok_or(FrameError::Truncated)
}

fn read_count(bytes: &mut &[u8]) -> Result<usize, FrameError> {
    let count = read_varint(bytes)? as usize;
    if (1..=CHUNK_ROWS).contains(&count) { Ok(count) } else { Err(FrameError::Body) }
}

fn read_bytes(bytes: &mut &[u8], count: usize) -> Result<Vec<u8>, FrameError> {
    let (taken, rest) = bytes.split_at_checked(count).ok_or(FrameError::Truncated)?;
    *bytes = rest;
    let mut before = 0u8;
    Ok(taken
        .iter()
        .map(|&difference| {
            before = before.wrapping_add(difference);
            before
        })
        .collect())
}

fn read_column<T>(
    bytes: &mut &[u8],
    count: usize,
    mut parse: impl FnMut(u32) -> Option<T>,
) -> Result<Vec<T>, FrameError> {
    (0..count).map(|_| parse(read_varint(bytes)?).ok_or(FrameError::Body)).collect()
}

fn read_radii(bytes: &mut &[u8], count: usize) -> Result<Vec<u16>, FrameError> {
    let mut before = 0i32;
    read_column(bytes, count, |difference| {
        let code = u16::try_from(before.checked_add(varint::unzigzag(difference))?).ok()?;
        before = code.into();
        Some(code)
    })
}

fn read_births(bytes: &mut &[u8], count: usize) -> Result<Vec<u32>, FrameError> {
    let mut before = 0u32;
    read_column(bytes, count, |later| {
        before = before.wrapping_add(later);
        Some(before)
    })
}

fn read_positions(bytes: &mut &[u8], count: usize) -> Result<Vec<[i32; 3]>, FrameError> {
    let mut positions = vec![[0; 3]; count];
    for axis in 0..3 {
        for position in &mut positions {
            position[axis] = varint::unzigzag(read_varint(bytes)?);
        }
    }
    Ok(positions)
}
