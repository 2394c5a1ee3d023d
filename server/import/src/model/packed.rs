//! Views that meshoptimizer compressed (`EXT_meshopt_compression`, and `KHR_meshopt_compression`, which says the same).
//!
//! Its decoders take any bytes, and write no more than they are told to; what they are told is checked here.

use super::{ImportError, budget::Budget, damaged, document::Compression};

/// The most bytes that one view unpacks to: all of it is held at once.
const MAX_UNPACKED: usize = 256 << 20;
/// Bytes that unpack in the time that reading one number takes.
const FOR_ONE: usize = 16;

/// The most bytes that a view may have while it is compressed: bytes that cannot be made fewer get short headers.
pub(super) fn most_packed(compression: &Compression) -> usize {
    let unpacked = compression.count.saturating_mul(compression.byte_stride);
    unpacked.saturating_mul(2).saturating_add(1024)
}

/// The items of a view, one after another.
pub(super) fn unpack(
    compression: &Compression,
    bytes: &[u8],
    budget: &mut Budget,
) -> Result<Vec<u8>, ImportError> {
    let &Compression { count, byte_stride: stride, .. } = compression;
    let length = count.checked_mul(stride).filter(|&length| (1..=MAX_UNPACKED).contains(&length));
    let length = length.ok_or_else(|| {
        damaged(format!(
            "{count} items of {stride} bytes are compressed; up to {} MiB are read",
            MAX_UNPACKED >> 20
        ))
    })?;
    budget.spend(length.div_ceil(FOR_ONE))?;
    let filter = compression.filter.as_deref().unwrap_or("NONE");
    let unpacked = match (compression.mode.as_str(), stride, filter) {
        ("ATTRIBUTES", ..) => vertices(bytes, count, stride),
        ("TRIANGLES", 2, "NONE") if count.is_multiple_of(3) => {
            meshopt::decode_index_buffer::<u16>(bytes, count).ok().map(|all| flat(&all, u16::to_le_bytes))
        }
        ("TRIANGLES", 4, "NONE") if count.is_multiple_of(3) => {
            meshopt::decode_index_buffer::<u32>(bytes, count).ok().map(|all| flat(&all, u32::to_le_bytes))
        }
        ("INDICES", 2, "NONE") => {
            meshopt::decode_index_sequence::<u16>(bytes, count).ok().map(|all| flat(&all, u16::to_le_bytes))
        }
        ("INDICES", 4, "NONE") => {
            meshopt::decode_index_sequence::<u32>(bytes, count).ok().map(|all| flat(&all, u32::to_le_bytes))
        }
        (mode, ..) => {
            return Err(damaged(format!(
                "items of {stride} bytes are compressed as {mode}, filtered as {filter}"
            )));
        }
    };
    let mut unpacked = unpacked.ok_or_else(|| damaged("a compressed view cannot be unpacked"))?;
    match (filter, stride) {
        ("NONE", _) => {}
        ("EXPONENTIAL", _) => exponents(&mut unpacked),
        ("QUATERNION", 8) => unpacked = quaternions(&unpacked),
        _ => return Err(ImportError::Unsupported(format!("the filter {filter} on items of {stride} bytes"))),
    }
    Ok(unpacked)
}

fn flat<T: Copy, const N: usize>(all: &[T], bytes: fn(T) -> [u8; N]) -> Vec<u8> {
    all.iter().flat_map(|&one| bytes(one)).collect()
}

/// Each word is a number times a power of two: 24 bits of the one, 8 bits of the other, both signed.
fn exponents(unpacked: &mut [u8]) {
    for word in unpacked.as_chunks_mut::<4>().0 {
        let both = i32::from_le_bytes(*word);
        let (number, power) = ((both << 8) >> 8, both >> 24);
        // Twice, for the least powers have no float of their own.
        let half = |power: i32| f32::from_bits(((power + 127) as u32) << 23);
        *word = (number as f32 * half(power / 2) * half(power - power / 2)).to_le_bytes();
    }
}

/// Rotations whose largest part was left out.
fn quaternions(unpacked: &[u8]) -> Vec<u8> {
    let part = |bytes: &[u8; 8], at: usize| i16::from_le_bytes([bytes[2 * at], bytes[2 * at + 1]]);
    let mut all: Vec<[i16; 4]> =
        unpacked.as_chunks::<8>().0.iter().map(|bytes| [0, 1, 2, 3].map(|at| part(bytes, at))).collect();
    meshopt::decode_filter_quat(&mut all);
    flat(all.as_flattened(), i16::to_le_bytes)
}

/// Vertices of so many bytes each.
fn vertices(bytes: &[u8], count: usize, stride: usize) -> Option<Vec<u8>> {
    #[derive(Clone)]
    struct Vertex<const N: usize>([u8; N]);

    impl<const N: usize> Default for Vertex<N> {
        fn default() -> Self {
            Self([0; N])
        }
    }

    fn unpacked<const N: usize>(bytes: &[u8], count: usize) -> Option<Vec<u8>> {
        let vertices: Vec<Vertex<N>> = meshopt::decode_vertex_buffer(bytes, count).ok()?;
        // The same memory: nothing is copied.
        Some(vertices.into_iter().map(|Vertex(bytes)| bytes).collect::<Vec<_>>().into_flattened())
    }

    /// The decoder learns the length of a vertex from its type.
    macro_rules! by_stride {
        ($($n:literal)*) => {
            match stride {
                $($n => unpacked::<$n>(bytes, count),)*
                _ => None,
            }
        };
    }
    by_stride! {
        4 8 12 16 20 24 28 32 36 40 44 48 52 56 60 64 68 72 76 80 84 88 92 96 100 104 108 112 116 120 124 128
        132 136 140 144 148 152 156 160 164 168 172 176 180 184 188 192 196 200 204 208 212 216 220 224 228 232
        236 240 244 248 252 256
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Limits;

    fn compression(count: usize, byte_stride: usize, mode: &str, filter: Option<&str>) -> Compression {
        let (mode, filter) = (mode.to_owned(), filter.map(str::to_owned));
        Compression { buffer: 0, byte_offset: 0, byte_length: 0, byte_stride, count, mode, filter }
    }

    fn unpacked(compression: &Compression, bytes: &[u8]) -> Result<Vec<u8>, ImportError> {
        let limits = Limits { vertices: 1, triangles: 1, most_triangles: 1000 };
        unpack(compression, bytes, &mut Budget::new(&limits))
    }

    #[test]
    fn every_kind_of_view_is_what_was_packed() {
        let vertices: Vec<[u8; 12]> = (0..100u8).map(|i| [i; 12]).collect();
        let packed = meshopt::encode_vertex_buffer(&vertices).expect("it packs");
        assert_eq!(
            unpacked(&compression(100, 12, "ATTRIBUTES", None), &packed),
            Ok(vertices.into_flattened())
        );
        let corners = [0u32, 1, 2, 2, 1, 3, 3, 1, 70_000];
        let wide = flat(&corners, u32::to_le_bytes);
        let packed = meshopt::encode_index_buffer(&corners, 70_001).expect("it packs");
        let all = unpacked(&compression(9, 4, "TRIANGLES", None), &packed).expect("triangles");
        let turned = all.as_chunks::<4>().0.iter().map(|word| u32::from_le_bytes(*word)).collect::<Vec<_>>();
        // The corners of a triangle may be turned, which leaves it the same.
        for (before, after) in corners.as_chunks::<3>().0.iter().zip(turned.as_chunks::<3>().0) {
            assert!(
                (0..3).any(|by| [0, 1, 2].map(|i| before[(i + by) % 3]) == *after),
                "{before:?} {after:?}"
            );
        }
        let packed = meshopt::encode_index_sequence(&corners, 70_001).expect("it packs");
        assert_eq!(unpacked(&compression(9, 4, "INDICES", Some("NONE")), &packed), Ok(wide));
        let short = [0u32, 5, 3, 9];
        let packed = meshopt::encode_index_sequence(&short, 10).expect("it packs");
        let shorts = flat(&short.map(|index| index as u16), u16::to_le_bytes);
        assert_eq!(unpacked(&compression(4, 2, "INDICES", None), &packed), Ok(shorts));
    }

    #[test]
    fn exponents_make_floats() {
        let word = |number: i32, power: i32| ((power << 24) | (number & 0x00ff_ffff)).to_le_bytes();
        let mut words = [word(3, -1), word(-5, 2), word(0, 0), word(1, -100), word(1, 127)].concat();
        exponents(&mut words);
        let read: Vec<f32> = words.as_chunks::<4>().0.iter().map(|word| f32::from_le_bytes(*word)).collect();
        assert_eq!(read, [1.5, -20.0, 0.0, f32::from_bits(27 << 23), f32::from_bits(254 << 23)]);
    }

    #[test]
    fn what_is_announced_is_not_believed() {
        let vertices: Vec<[u8; 12]> = (0..100u8).map(|i| [i; 12]).collect();
        let packed = meshopt::encode_vertex_buffer(&vertices).expect("it packs");
        for (count, stride, mode, filter) in [
            // Vertices are packed in groups of 16.
            (113, 12, "ATTRIBUTES", None),
            (96, 12, "ATTRIBUTES", None),
            (100, 13, "ATTRIBUTES", None),
            (100, 260, "ATTRIBUTES", None),
            (0, 12, "ATTRIBUTES", None),
            (usize::MAX, 12, "ATTRIBUTES", None),
            (1_000_000_000, 12, "ATTRIBUTES", None),
            (100, 4, "TRIANGLES", None),
            (99, 4, "TRIANGLES", None),
            (99, 3, "TRIANGLES", None),
            (99, 4, "INDICES", None),
            (99, 4, "INDICES", Some("EXPONENTIAL")),
            (100, 12, "SOMETHING", None),
        ] {
            let refused = unpacked(&compression(count, stride, mode, filter), &packed);
            assert!(
                matches!(refused, Err(ImportError::Damaged(_))),
                "{count} × {stride} {mode}: {refused:?}"
            );
        }
        let refused = unpacked(&compression(100, 12, "ATTRIBUTES", Some("OCTAHEDRAL")), &packed);
        assert!(matches!(refused, Err(ImportError::Unsupported(_))), "{refused:?}");
        for end in 0..packed.len() {
            assert!(
                unpacked(&compression(100, 12, "ATTRIBUTES", None), &packed[..end]).is_err(),
                "cut to {end}"
            );
        }
    }
}
