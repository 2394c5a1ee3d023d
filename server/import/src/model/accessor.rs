//! Numbers out of buffers (glTF 2.0 specification, §3.6.2, and `KHR_mesh_quantization`), a block of bytes at a time.

use std::borrow::Cow;

use super::{
    ImportError,
    budget::Budget,
    container::{Buffer, Data, File},
    damaged,
    document::{Accessor, Compression, Document},
    packed,
    source::Source,
};

const BYTE: u32 = 5120;
const UNSIGNED_BYTE: u32 = 5121;
const SHORT: u32 = 5122;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;

/// Bytes that are got from the file at once.
const BLOCK: usize = 64 * 1024;
/// The most bytes from one item to the next; the specification has 252.
const MAX_STRIDE: usize = 4096;

/// An accessor with its number.
fn find(document: &Document, number: usize) -> Result<&Accessor, ImportError> {
    document.accessors.get(number).ok_or_else(|| damaged(format!("there is no accessor {number}")))
}

/// How many items an accessor says it has.
pub(super) fn count(document: &Document, number: usize) -> Result<usize, ImportError> {
    Ok(find(document, number)?.count)
}

/// Vectors of `N` numbers each; integers as fractions where they say so.
pub(super) fn vectors<const N: usize>(
    file: &mut File<'_>,
    number: usize,
    budget: &mut Budget,
) -> Result<Vec<[f32; N]>, ImportError> {
    let File { document, data } = file;
    let accessor = find(document, number)?;
    if accessor.kind != format!("VEC{N}") {
        return Err(damaged(format!("accessor {number} is not a VEC{N}")));
    }
    budget.check_vertices(accessor.count)?;
    let part: fn(&[u8]) -> f32 = match (accessor.component_type, accessor.normalized) {
        (FLOAT, _) => |bytes| f32::from_le_bytes(chunk(bytes)),
        (BYTE, false) => |bytes| f32::from(i8::from_le_bytes(chunk(bytes))),
        (BYTE, true) => |bytes| (f32::from(i8::from_le_bytes(chunk(bytes))) / 127.0).max(-1.0),
        (UNSIGNED_BYTE, false) => |bytes| f32::from(u8::from_le_bytes(chunk(bytes))),
        (UNSIGNED_BYTE, true) => |bytes| f32::from(u8::from_le_bytes(chunk(bytes))) / 255.0,
        (SHORT, false) => |bytes| f32::from(i16::from_le_bytes(chunk(bytes))),
        (SHORT, true) => |bytes| (f32::from(i16::from_le_bytes(chunk(bytes))) / 32767.0).max(-1.0),
        (UNSIGNED_SHORT, false) => |bytes| f32::from(u16::from_le_bytes(chunk(bytes))),
        (UNSIGNED_SHORT, true) => |bytes| f32::from(u16::from_le_bytes(chunk(bytes))) / 65535.0,
        (other, _) => return Err(damaged(format!("places of component type {other}"))),
    };
    let width = width(accessor.component_type)?;
    let mut vectors = Vec::new();
    items(document, data, accessor, N * width, budget, |item| {
        let mut vector = [0.0; N];
        for (to, bytes) in vector.iter_mut().zip(item.chunks_exact(width)) {
            *to = part(bytes);
        }
        vectors.push(vector);
    })?;
    Ok(vectors)
}

/// The vertex numbers of an accessor.
pub(super) fn indices(
    file: &mut File<'_>,
    number: usize,
    budget: &mut Budget,
) -> Result<Vec<u32>, ImportError> {
    let File { document, data } = file;
    let accessor = find(document, number)?;
    if accessor.kind != "SCALAR" {
        return Err(damaged("indices that are not single numbers"));
    }
    let index: fn(&[u8]) -> u32 = match accessor.component_type {
        UNSIGNED_BYTE => |bytes| u32::from(u8::from_le_bytes(chunk(bytes))),
        UNSIGNED_SHORT => |bytes| u32::from(u16::from_le_bytes(chunk(bytes))),
        UNSIGNED_INT => |bytes| u32::from_le_bytes(chunk(bytes)),
        other => return Err(damaged(format!("indices of component type {other}"))),
    };
    let mut indices = Vec::new();
    items(document, data, accessor, width(accessor.component_type)?, budget, |item| {
        indices.push(index(item));
    })?;
    Ok(indices)
}

/// Bytes of one number.
fn width(component_type: u32) -> Result<usize, ImportError> {
    match component_type {
        BYTE | UNSIGNED_BYTE => Ok(1),
        SHORT | UNSIGNED_SHORT => Ok(2),
        UNSIGNED_INT | FLOAT => Ok(4),
        other => Err(damaged(format!("there is no component type {other}"))),
    }
}

/// As many bytes as a number has; there are that many.
fn chunk<const W: usize>(bytes: &[u8]) -> [u8; W] {
    bytes.first_chunk().copied().unwrap_or([0; W])
}

/// Gives each item of an accessor, `size` bytes of it, if its view has bytes for all of them.
fn items(
    document: &Document,
    data: &mut Data<'_>,
    accessor: &Accessor,
    size: usize,
    budget: &mut Budget,
    mut each: impl FnMut(&[u8]),
) -> Result<(), ImportError> {
    if accessor.sparse.is_some() {
        return Err(ImportError::Unsupported("sparse accessors".to_owned()));
    }
    let view = accessor.buffer_view.and_then(|view| document.buffer_views.get(view));
    let view = view.ok_or_else(|| damaged("an accessor has no data"))?;
    let stride = view.byte_stride.unwrap_or(size);
    if !(size..=MAX_STRIDE).contains(&stride) {
        return Err(damaged(format!("a stride of {stride} bytes")));
    }
    // The last item need not fill its stride.
    let room = view.byte_length.saturating_sub(accessor.byte_offset);
    let held = if room < size { 0 } else { (room - size) / stride + 1 };
    if accessor.count > held {
        return Err(damaged("an accessor reaches beyond its view"));
    }
    // Before anything is read: until here, what a file says of itself has cost nothing.
    budget.spend(accessor.count)?;
    let Data { source, buffers } = data;
    let bytes = match view.compression() {
        Some(compression) => {
            if compression.count.checked_mul(compression.byte_stride) != Some(view.byte_length) {
                return Err(damaged("a compressed view has another length than its items"));
            }
            let place = [compression.byte_offset, compression.byte_length];
            let packed = Part::find(buffers, compression.buffer, place)?.whole(source, compression)?;
            Part::Held(Cow::Owned(packed::unpack(compression, &packed, budget)?))
        }
        None => Part::find(buffers, view.buffer, [view.byte_offset, view.byte_length])?,
    };
    let at_once = (BLOCK / stride).max(1);
    for from in (0..accessor.count).step_by(at_once) {
        let count = at_once.min(accessor.count - from);
        let (start, length) = (accessor.byte_offset + from * stride, (count - 1) * stride + size);
        let block = match &bytes {
            Part::Held(bytes) => {
                let block = bytes.get(start..start + length);
                Cow::Borrowed(block.ok_or_else(|| damaged("an accessor reaches beyond its view"))?)
            }
            Part::InFile { start: first, .. } => Cow::Owned(source.bytes(first + start as u64, length)?),
        };
        block.chunks(stride).for_each(|item| each(&item[..size]));
    }
    Ok(())
}

/// A part of a buffer.
enum Part<'a> {
    InFile { start: u64, length: usize },
    Held(Cow<'a, [u8]>),
}

impl<'a> Part<'a> {
    /// So many bytes of a buffer, if it has them.
    fn find(buffers: &'a [Buffer], number: usize, [start, length]: [usize; 2]) -> Result<Self, ImportError> {
        let buffer = buffers.get(number).ok_or_else(|| damaged("a view has no buffer"))?;
        let beyond = || damaged("a view reaches beyond its buffer");
        let end = start.checked_add(length).ok_or_else(beyond)?;
        match buffer {
            Buffer::InFile { start: first, length: held } if end <= *held => {
                Ok(Self::InFile { start: first + start as u64, length })
            }
            Buffer::InFile { .. } => Err(beyond()),
            Buffer::Held(bytes) => Ok(Self::Held(Cow::Borrowed(bytes.get(start..end).ok_or_else(beyond)?))),
            Buffer::Fallback => Err(damaged("a view has nothing but its compressed form")),
        }
    }

    /// All of it; what is compressed is seldom longer than what it unpacks to, and is not read where it is.
    fn whole(self, source: &mut Source<'_>, compression: &Compression) -> Result<Cow<'a, [u8]>, ImportError> {
        match self {
            Self::Held(bytes) => Ok(bytes),
            Self::InFile { length, .. } if length > packed::most_packed(compression) => {
                Err(damaged("a view is longer compressed than it is unpacked"))
            }
            Self::InFile { start, length } => Ok(Cow::Owned(source.bytes(start, length)?)),
        }
    }
}
