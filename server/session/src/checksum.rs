//! What the rows that clients hold add up to (`CK1`).

use espalier_mesh::{RingTable, radius_code::NOT_DRAWN};

/// Bytes of a row in the sum.
const ROW_BYTES: usize = 24;
/// Rows that are summed at once.
const BATCH: u32 = 256;

/// The sum of a table, and what it is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Checksum {
    /// The newest frame.
    pub(crate) sequence: u32,
    pub(crate) rows: u32,
    pub(crate) crc32: u32,
    /// Hash of the plants.
    pub(crate) plant: u64,
}

/// CRC-32 of all rows of a table, in their order.
pub(crate) fn crc32(table: &RingTable) -> u32 {
    let count = table.rows() as u32;
    let mut hasher = crc32fast::Hasher::new();
    let mut bytes = Vec::with_capacity(ROW_BYTES * BATCH as usize);
    for first in (0..count).step_by(BATCH as usize) {
        bytes.clear();
        (first..count.min(first + BATCH)).for_each(|row| append(table, row, &mut bytes));
        hasher.update(&bytes);
    }
    for row in (0..count).filter(|&row| table.radius(row) != NOT_DRAWN) {
        let Some(organs) = table.organs(row) else { continue };
        hasher.update(&row.to_le_bytes());
        hasher.update(&[organs.len() as u8]);
        organs.iter().for_each(|organ| hasher.update(&organ.to_number().to_le_bytes()));
    }
    hasher.finalize()
}

fn append(table: &RingTable, row: u32, bytes: &mut Vec<u8>) {
    let link = table.parent(row).map_or(0, |parent| 2 * (row - parent) + u32::from(table.starts_axis(row)));
    bytes.extend(link.to_le_bytes());
    bytes.extend(table.position(row).into_iter().flat_map(i32::to_le_bytes));
    let radius = table.radius(row);
    bytes.extend(radius.to_le_bytes());
    // What is not drawn looks as it did when it was, and a table made anew does not know that.
    let looks = if radius == NOT_DRAWN { [0, 0] } else { [table.foliage(row), table.light(row)] };
    bytes.extend(looks);
    bytes.extend(table.born(row).to_le_bytes());
}
