//! Changes as numbers, one after the other, each of a field; how numbers become bytes is the sink's to say.

use super::{CHUNK_ROWS, ChunkChange, Column, FrameError, MOST_ORGANS, Rows, Values};
use crate::{packing::Field, varint};

/// Takes the numbers of a body.
pub(crate) trait Sink {
    fn number(&mut self, field: Field, number: u32);
    fn byte(&mut self, field: Field, byte: u8);
    /// What kind of change comes next; none at the end.
    fn change(&mut self, field: Field, change: Option<u8>);
}

/// Gives them again.
pub(crate) trait Source {
    fn number(&mut self, field: Field) -> Result<u32, FrameError>;
    fn byte(&mut self, field: Field) -> Result<u8, FrameError>;
    fn change(&mut self, field: Field) -> Result<Option<u8>, FrameError>;
}

/// A body as it travels raw, or deflated: varints and bytes, and an end where the bytes end.
impl Sink for Vec<u8> {
    fn number(&mut self, _: Field, number: u32) {
        varint::write(self, number);
    }

    fn byte(&mut self, _: Field, byte: u8) {
        self.push(byte);
    }

    fn change(&mut self, _: Field, change: Option<u8>) {
        self.extend(change);
    }
}

impl Source for &[u8] {
    fn number(&mut self, _: Field) -> Result<u32, FrameError> {
        varint::read(self).ok_or(FrameError::Truncated)
    }

    fn byte(&mut self, _: Field) -> Result<u8, FrameError> {
        let (&byte, rest) = self.split_first().ok_or(FrameError::Truncated)?;
        *self = rest;
        Ok(byte)
    }

    fn change(&mut self, field: Field) -> Result<Option<u8>, FrameError> {
        if self.is_empty() { Ok(None) } else { self.byte(field).map(Some) }
    }
}

const TRUNCATE: u8 = 1;
const REPLACE: u8 = 2;
const APPEND: u8 = 3;
const PATCH: u8 = 4;

/// The changes of a frame with this sequence.
pub(crate) fn write_changes(changes: &[ChunkChange], sequence: u32, out: &mut impl Sink) {
    let mut place = Place::default();
    for change in changes {
        write_change(change, sequence, &mut place, out);
    }
    out.change(place.change, None);
}

pub(crate) fn read_changes(bytes: &mut impl Source, sequence: u32) -> Result<Vec<ChunkChange>, FrameError> {
    let mut changes = Vec::new();
    let mut place = Place::default();
    while let Some(kind) = bytes.change(place.change)? {
        changes.push(read_change(kind, sequence, &mut place, bytes)?);
    }
    Ok(changes)
}

/// Where a body has come to.
struct Place {
    /// What the kind of the next change depends on: the kind of the last.
    change: Field,
    /// The chunk of the last change of one.
    chunk: Option<u32>,
}

impl Default for Place {
    fn default() -> Self {
        Self { change: Field::FirstChange, chunk: None }
    }
}

impl Place {
    /// A chunk as what is written for it: the difference to the one before.
    fn write_chunk(&mut self, chunk: u32, out: &mut impl Sink) {
        match self.chunk.replace(chunk) {
            None => out.number(Field::FirstChunk, chunk),
            Some(before) => {
                out.number(Field::Chunk, varint::zigzag(chunk.wrapping_sub(before).cast_signed()));
            }
        }
    }

    fn read_chunk(&mut self, bytes: &mut impl Source) -> Result<u32, FrameError> {
        let chunk = match self.chunk {
            None => bytes.number(Field::FirstChunk)?,
            Some(before) => {
                before.wrapping_add(varint::unzigzag(bytes.number(Field::Chunk)?).cast_unsigned())
            }
        };
        self.chunk = Some(chunk);
        Ok(chunk)
    }
}

fn write_change(change: &ChunkChange, sequence: u32, place: &mut Place, out: &mut impl Sink) {
    let kind = match change {
        ChunkChange::Truncate { .. } => TRUNCATE,
        ChunkChange::Replace { .. } => REPLACE,
        ChunkChange::Append { .. } => APPEND,
        ChunkChange::Patch { .. } => PATCH,
    };
    out.change(std::mem::replace(&mut place.change, after(kind)), Some(kind));
    match change {
        ChunkChange::Truncate { rows } => out.number(Field::Truncate, *rows),
        ChunkChange::Replace { chunk, generation, rows } => {
            place.write_chunk(*chunk, out);
            out.number(Field::Age, sequence.wrapping_sub(*generation));
            write_rows(rows, out);
        }
        ChunkChange::Append { chunk, generation, start, rows } => {
            place.write_chunk(*chunk, out);
            out.number(Field::Age, sequence.wrapping_sub(*generation));
            out.number(Field::Start, *start);
            write_rows(rows, out);
        }
        ChunkChange::Patch { chunk, generation, rows, values } => {
            debug_assert_eq!(rows.len(), values.len(), "one value a row");
            place.write_chunk(*chunk, out);
            out.number(Field::Age, sequence.wrapping_sub(*generation));
            out.number(Field::Column, values.column() as u32);
            let patched = Patched::of(values.column() as u32);
            out.number(patched.count, rows.len() as u32);
            let (mut next, mut gap) = (0, patched.first_gap);
            for &row in rows {
                let skipped = u32::from(row) - next;
                out.number(gap, skipped);
                gap = patched.gap_behind(skipped);
                next = u32::from(row) + 1;
            }
            write_values(values, out);
        }
    }
}

fn read_change(
    kind: u8,
    sequence: u32,
    place: &mut Place,
    bytes: &mut impl Source,
) -> Result<ChunkChange, FrameError> {
    place.change = after(kind);
    if kind == TRUNCATE {
        return Ok(ChunkChange::Truncate { rows: bytes.number(Field::Truncate)? });
    }
    if ![REPLACE, APPEND, PATCH].contains(&kind) {
        return Err(FrameError::Body);
    }
    let chunk = place.read_chunk(bytes)?;
    let generation = sequence.wrapping_sub(bytes.number(Field::Age)?);
    match kind {
        REPLACE => Ok(ChunkChange::Replace { chunk, generation, rows: read_rows(bytes)? }),
        APPEND => {
            let start = bytes.number(Field::Start)?;
            let rows = read_rows(bytes)?;
            let fits = (start as usize).checked_add(rows.len()).is_some_and(|end| end <= CHUNK_ROWS);
            if fits {
                Ok(ChunkChange::Append { chunk, generation, start, rows })
            } else {
                Err(FrameError::Body)
            }
        }
        _ => {
            let column = bytes.number(Field::Column)?;
            let patched = Patched::of(column);
            let count = read_count(bytes, patched.count)?;
            let mut rows = Vec::with_capacity(count);
            let (mut next, mut gap) = (0u32, patched.first_gap);
            for _ in 0..count {
                let skipped = bytes.number(gap)?;
                let row = next.checked_add(skipped).ok_or(FrameError::Body)?;
                rows.push(u8::try_from(row).map_err(|_| FrameError::Body)?);
                gap = patched.gap_behind(skipped);
                next = row + 1;
            }
            let values = read_values(bytes, column, count)?;
            Ok(ChunkChange::Patch { chunk, generation, rows, values })
        }
    }
}

/// The field of what follows a change of a kind.
fn after(kind: u8) -> Field {
    match kind {
        TRUNCATE => Field::ChangeAfterTruncate,
        REPLACE => Field::ChangeAfterReplace,
        APPEND => Field::ChangeAfterAppend,
        _ => Field::ChangeAfterPatch,
    }
}

/// Fields of the rows that a patch names.
struct Patched {
    count: Field,
    first_gap: Field,
    gap_after_none: Field,
    gap: Field,
}

impl Patched {
    fn of(column: u32) -> Self {
        let is = |other: Column| column == other as u32;
        let [count, first_gap, gap_after_none, gap] = if is(Column::Radius) {
            [Field::RadiusCount, Field::FirstRadiusGap, Field::RadiusGapAfterNone, Field::RadiusGap]
        } else if is(Column::Foliage) {
            [Field::FoliageCount, Field::FirstFoliageGap, Field::FoliageGapAfterNone, Field::FoliageGap]
        } else if is(Column::Light) {
            [Field::LightCount, Field::FirstLightGap, Field::LightGapAfterNone, Field::LightGap]
        } else {
            [Field::OtherCount, Field::OtherGap, Field::OtherGap, Field::OtherGap]
        };
        Self { count, first_gap, gap_after_none, gap }
    }

    fn gap_behind(&self, skipped: u32) -> Field {
        if skipped == 0 { self.gap_after_none } else { self.gap }
    }
}

/// Fields of values that stand one after the other: of the first, of any other.
#[derive(Clone, Copy)]
struct Fields(Field, Field);

impl Fields {
    fn at(self, place: usize) -> Field {
        if place == 0 { self.0 } else { self.1 }
    }
}

const RADII: Fields = Fields(Field::FirstRadius, Field::Radius);
const FOLIAGE: Fields = Fields(Field::FirstFoliage, Field::Foliage);
const LIGHT: Fields = Fields(Field::FirstLight, Field::Light);
const BORN: Fields = Fields(Field::FirstBorn, Field::Born);
const NEW_NUMBERS: Fields = Fields(Field::NewNumber, Field::NewNumber);

fn write_rows(rows: &Rows, out: &mut impl Sink) {
    debug_assert!(rows.is_consistent(), "all columns have one length");
    out.number(Field::Count, rows.len() as u32);
    for (place, &parent) in rows.parent.iter().enumerate() {
        out.number(if place == 0 { Field::FirstParent } else { Field::Parent }, parent);
    }
    // Like stands beside like, which packs better.
    for part in 0..3 {
        for (told, &parent) in rows.position.iter().zip(&rows.parent) {
            out.number(position(part, parent), varint::zigzag(told[part]));
        }
    }
    write_radii(&rows.radius, out);
    write_bytes(&rows.foliage, FOLIAGE, out);
    write_bytes(&rows.light, LIGHT, out);
    write_births(&rows.born, BORN, out);
}

fn read_rows(bytes: &mut impl Source) -> Result<Rows, FrameError> {
    let count = read_count(bytes, Field::Count)?;
    let field = |place| if place == 0 { Field::FirstParent } else { Field::Parent };
    let parent = (0..count).map(|place| bytes.number(field(place))).collect::<Result<Vec<_>, _>>()?;
    let mut told = vec![[0; 3]; count];
    for part in 0..3 {
        for (told, &parent) in told.iter_mut().zip(&parent) {
            told[part] = varint::unzigzag(bytes.number(position(part, parent))?);
        }
    }
    Ok(Rows {
        parent,
        position: told,
        radius: read_radii(bytes, count)?,
        foliage: read_bytes(bytes, FOLIAGE, count)?,
        light: read_bytes(bytes, LIGHT, count)?,
        born: read_births(bytes, BORN, count)?,
    })
}

/// The field of one of the three numbers that tell a position: the last is along the parent's way. Where an axis goes on,
/// the row's *parent* is even.
fn position(part: usize, parent: u32) -> Field {
    match (parent.is_multiple_of(2), part) {
        (true, 2) => Field::OnAlong,
        (true, _) => Field::OnAcross,
        (false, 2) => Field::Along,
        (false, _) => Field::Across,
    }
}

fn write_values(values: &Values, out: &mut impl Sink) {
    match values {
        Values::Parent(v) => v.iter().for_each(|&parent| out.number(Field::NewNumber, parent)),
        Values::Position(v) => {
            for part in 0..3 {
                v.iter().for_each(|told| out.number(Field::NewPosition, varint::zigzag(told[part])));
            }
        }
        Values::Radius(v) => v.iter().for_each(|&by| out.number(Field::NewRadius, varint::zigzag(by))),
        Values::Foliage(v) => v.iter().for_each(|&by| out.byte(Field::NewFoliage, by)),
        Values::Light(v) => v.iter().for_each(|&by| out.number(Field::NewLight, varint::zigzag(by))),
        Values::Born(v) => write_births(v, NEW_NUMBERS, out),
        Values::Organs(v) => v.iter().for_each(|organs| write_organs(organs.as_deref(), out)),
    }
}

fn read_values(bytes: &mut impl Source, column: u32, count: usize) -> Result<Values, FrameError> {
    Ok(match column {
        0 => Values::Parent((0..count).map(|_| bytes.number(Field::NewNumber)).collect::<Result<_, _>>()?),
        1 => {
            let mut all = vec![[0; 3]; count];
            for part in 0..3 {
                for told in &mut all {
                    told[part] = varint::unzigzag(bytes.number(Field::NewPosition)?);
                }
            }
            Values::Position(all)
        }
        2 => Values::Radius(read_signed(bytes, Field::NewRadius, count)?),
        3 => Values::Foliage((0..count).map(|_| bytes.byte(Field::NewFoliage)).collect::<Result<_, _>>()?),
        4 => Values::Light(read_signed(bytes, Field::NewLight, count)?),
        5 => Values::Born(read_births(bytes, NEW_NUMBERS, count)?),
        6 => Values::Organs((0..count).map(|_| read_organs(bytes)).collect::<Result<_, _>>()?),
        _ => return Err(FrameError::Body),
    })
}

fn read_signed(bytes: &mut impl Source, field: Field, count: usize) -> Result<Vec<i32>, FrameError> {
    (0..count).map(|_| Ok(varint::unzigzag(bytes.number(field)?))).collect()
}

/// Each as the difference to the one before it: what grows on one axis is nearly equally thick.
fn write_radii(radii: &[u16], out: &mut impl Sink) {
    let mut before = 0;
    for (place, &code) in radii.iter().enumerate() {
        let code = i32::from(code);
        out.number(RADII.at(place), varint::zigzag(code - std::mem::replace(&mut before, code)));
    }
}

fn read_radii(bytes: &mut impl Source, count: usize) -> Result<Vec<u16>, FrameError> {
    let mut before = 0i32;
    let read = |place| {
        let difference = varint::unzigzag(bytes.number(RADII.at(place))?);
        before = before.checked_add(difference).ok_or(FrameError::Body)?;
        u16::try_from(before).map_err(|_| FrameError::Body)
    };
    (0..count).map(read).collect()
}

/// Each as the difference to the one before it, modulo 256.
fn write_bytes(values: &[u8], fields: Fields, out: &mut impl Sink) {
    let mut before = 0;
    for (place, &byte) in values.iter().enumerate() {
        out.byte(fields.at(place), byte.wrapping_sub(std::mem::replace(&mut before, byte)));
    }
}

fn read_bytes(bytes: &mut impl Source, fields: Fields, count: usize) -> Result<Vec<u8>, FrameError> {
    let mut before = 0u8;
    let read = |place| {
        before = before.wrapping_add(bytes.byte(fields.at(place))?);
        Ok(before)
    };
    (0..count).map(read).collect()
}

/// Each as the difference to the one before it: rows are in birth order, so nearly all are 0.
fn write_births(births: &[u32], fields: Fields, out: &mut impl Sink) {
    let mut before = 0;
    for (place, &born) in births.iter().enumerate() {
        out.number(fields.at(place), born.wrapping_sub(std::mem::replace(&mut before, born)));
    }
}

fn read_births(bytes: &mut impl Source, fields: Fields, count: usize) -> Result<Vec<u32>, FrameError> {
    let mut before = 0u32;
    let read = |place| {
        before = before.wrapping_add(bytes.number(fields.at(place))?);
        Ok(before)
    };
    (0..count).map(read).collect()
}

/// A byte that is 0 for none and else one more than their number, then so many numbers.
fn write_organs(organs: Option<&[u32]>, out: &mut impl Sink) {
    debug_assert!(organs.is_none_or(|organs| organs.len() <= MOST_ORGANS), "at most 15");
    out.byte(Field::Organs, organs.map_or(0, |organs| 1 + organs.len() as u8));
    let bytes = organs.into_iter().flatten().flat_map(|organ| organ.to_le_bytes());
    bytes.for_each(|byte| out.byte(Field::Organ, byte));
}

fn read_organs(bytes: &mut impl Source) -> Result<Option<Vec<u32>>, FrameError> {
    let Some(count) = usize::from(bytes.byte(Field::Organs)?).checked_sub(1) else { return Ok(None) };
    if count > MOST_ORGANS {
        return Err(FrameError::Body);
    }
    let organ = |_| {
        let mut organ = [0; 4];
        for byte in &mut organ {
            *byte = bytes.byte(Field::Organ)?;
        }
        let organ = u32::from_le_bytes(organ);
        if organ >> 30 == 3 { Err(FrameError::Body) } else { Ok(organ) }
    };
    (0..count).map(organ).collect::<Result<_, _>>().map(Some)
}

fn read_count(bytes: &mut impl Source, field: Field) -> Result<usize, FrameError> {
    let count = bytes.number(field)? as usize;
    if (1..=CHUNK_ROWS).contains(&count) { Ok(count) } else { Err(FrameError::Body) }
}
