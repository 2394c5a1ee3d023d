//! Numbers out of buffers (glTF 2.0 specification, §3.6.2). They are read one by one as they are asked for.

use glam::Vec3;

use crate::{ImportError, container::File, damaged, document::Accessor};

const UNSIGNED_BYTE: u32 = 5121;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;

/// Items of so many bytes.
struct Items<'a, const N: usize> {
    data: &'a [u8],
    stride: usize,
}

impl<const N: usize> Items<'_, N> {
    fn get(&self, number: usize) -> Option<[u8; N]> {
        self.data.get(number.checked_mul(self.stride)?..)?.first_chunk().copied()
    }
}

/// The positions an accessor holds.
pub(crate) struct Positions<'a> {
    items: Items<'a, 12>,
    /// How many there are.
    pub count: usize,
}

impl<'a> Positions<'a> {
    pub(crate) fn open(file: &'a File<'_>, number: usize) -> Result<Self, ImportError> {
        let accessor = find(file, number)?;
        if accessor.kind != "VEC3" || accessor.component_type != FLOAT {
            return Err(ImportError::Unsupported("positions that are not floating-point".to_owned()));
        }
        Ok(Self { items: items(file, accessor)?, count: accessor.count })
    }

    pub(crate) fn get(&self, number: usize) -> Result<Vec3, ImportError> {
        let item = (number < self.count).then(|| self.items.get(number)).flatten();
        let item = item.ok_or_else(|| damaged(format!("there is no vertex {number} of {}", self.count)))?;
        let [x, y, z] =
            [0, 4, 8].map(|at| f32::from_le_bytes([item[at], item[at + 1], item[at + 2], item[at + 3]]));
        Ok(Vec3::new(x, y, z))
    }
}

/// The vertex numbers an accessor holds.
pub(crate) struct Indices<'a> {
    width: Width<'a>,
    /// How many there are.
    pub count: usize,
}

enum Width<'a> {
    Byte(Items<'a, 1>),
    Short(Items<'a, 2>),
    Int(Items<'a, 4>),
}

impl<'a> Indices<'a> {
    pub(crate) fn open(file: &'a File<'_>, number: usize) -> Result<Self, ImportError> {
        let accessor = find(file, number)?;
        if accessor.kind != "SCALAR" {
            return Err(damaged("indices that are not single numbers"));
        }
        let width = match accessor.component_type {
            UNSIGNED_BYTE => Width::Byte(items(file, accessor)?),
            UNSIGNED_SHORT => Width::Short(items(file, accessor)?),
            UNSIGNED_INT => Width::Int(items(file, accessor)?),
            other => return Err(damaged(format!("indices of component type {other}"))),
        };
        Ok(Self { width, count: accessor.count })
    }

    pub(crate) fn get(&self, number: usize) -> Result<usize, ImportError> {
        let index = match &self.width {
            Width::Byte(items) => items.get(number).map(|[byte]| u32::from(byte)),
            Width::Short(items) => items.get(number).map(|short| u32::from(u16::from_le_bytes(short))),
            Width::Int(items) => items.get(number).map(u32::from_le_bytes),
        };
        index.map(|index| index as usize).ok_or_else(|| damaged(format!("there is no index {number}")))
    }
}

fn find<'a>(file: &'a File<'_>, number: usize) -> Result<&'a Accessor, ImportError> {
    file.document.accessors.get(number).ok_or_else(|| damaged(format!("there is no accessor {number}")))
}

/// The items of an accessor, if its buffer has bytes for all of them.
fn items<'a, const N: usize>(file: &'a File<'_>, accessor: &Accessor) -> Result<Items<'a, N>, ImportError> {
    if accessor.sparse.is_some() {
        return Err(ImportError::Unsupported("sparse accessors".to_owned()));
    }
    let view = accessor.buffer_view.and_then(|view| file.document.buffer_views.get(view));
    let view = view.ok_or_else(|| damaged("an accessor has no data"))?;
    let buffer = file.buffers.get(view.buffer).ok_or_else(|| damaged("a view has no buffer"))?;
    let end = view.byte_offset.checked_add(view.byte_length);
    let data = end.and_then(|end| buffer.get(view.byte_offset..end));
    let data = data.and_then(|data| data.get(accessor.byte_offset..));
    let data = data.ok_or_else(|| damaged("a view reaches beyond its buffer"))?;
    let stride = view.byte_stride.unwrap_or(N);
    if stride < N {
        return Err(damaged("a stride is shorter than an item"));
    }
    // The last item need not fill its stride.
    let held = if data.len() < N { 0 } else { (data.len() - N) / stride + 1 };
    if accessor.count > held {
        return Err(damaged("an accessor reaches beyond its view"));
    }
    Ok(Items { data, stride })
}
