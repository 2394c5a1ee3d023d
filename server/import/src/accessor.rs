//! Numbers out of buffers (glTF 2.0 specification, §3.6.2).

use glam::Vec3;

use crate::{ImportError, container::File, damaged, document::Accessor};

const UNSIGNED_BYTE: u32 = 5121;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;

/// The positions an accessor holds.
pub(crate) fn positions(file: &File<'_>, number: usize) -> Result<Vec<Vec3>, ImportError> {
    let accessor = find(file, number)?;
    if accessor.kind != "VEC3" || accessor.component_type != FLOAT {
        return Err(ImportError::Unsupported("positions that are not floating-point".to_owned()));
    }
    items(file, accessor, |item: [u8; 12]| {
        let [x, y, z] =
            [0, 4, 8].map(|at| f32::from_le_bytes([item[at], item[at + 1], item[at + 2], item[at + 3]]));
        Vec3::new(x, y, z)
    })
}

/// The vertex numbers an accessor holds.
pub(crate) fn indices(file: &File<'_>, number: usize) -> Result<Vec<u32>, ImportError> {
    let accessor = find(file, number)?;
    if accessor.kind != "SCALAR" {
        return Err(damaged("indices that are not single numbers"));
    }
    match accessor.component_type {
        UNSIGNED_BYTE => items(file, accessor, |[byte]: [u8; 1]| u32::from(byte)),
        UNSIGNED_SHORT => items(file, accessor, |item| u32::from(u16::from_le_bytes(item))),
        UNSIGNED_INT => items(file, accessor, u32::from_le_bytes),
        other => Err(damaged(format!("indices of component type {other}"))),
    }
}

fn find<'a>(file: &'a File<'_>, number: usize) -> Result<&'a Accessor, ImportError> {
    file.document.accessors.get(number).ok_or_else(|| damaged(format!("there is no accessor {number}")))
}

/// All items of an accessor; never more than its buffer has bytes for.
fn items<const N: usize, T>(
    file: &File<'_>,
    accessor: &Accessor,
    read: impl Fn([u8; N]) -> T,
) -> Result<Vec<T>, ImportError> {
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
    let item = |i: usize| data[i * stride..].first_chunk::<N>().copied();
    (0..accessor.count).map(|i| item(i).map(&read).ok_or_else(|| damaged("an item is cut short"))).collect()
}
