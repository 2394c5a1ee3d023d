//! The capacity of columns that grow.

/// Columns of fewer rows, or of fewer bytes, grow as vectors do.
const SHORT: (usize, usize) = (1024, 32 * 1024);
/// What a longer column gets at once, whichever is less: rows, or bytes.
const STRETCH: (usize, usize) = (128 * 1024, 4 * 1024 * 1024);

/// Reserves capacity for more rows at the end of a column.
///
/// A column that has become long gets capacity for many at once. Allocators map so long a stretch by itself: it grows
/// without leaving holes between other columns, and takes no memory where nothing is written. Beyond that it gets a
/// sixteenth more at a time, for not every allocator is so clever.
pub fn reserve<T>(column: &mut Vec<T>, more: usize) {
    let needed = column.len() + more;
    if needed <= column.capacity() {
        return;
    }
    let rows = |(rows, bytes): (usize, usize)| rows.min(bytes / size_of::<T>().max(1));
    if needed < rows(SHORT) {
        column.reserve(more);
    } else {
        let wanted = rows(STRETCH).max(needed + needed / 16);
        column.reserve_exact(wanted - column.len());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_columns_seldom_move() {
        let mut column: Vec<u16> = Vec::new();
        let mut capacities = Vec::new();
        for row in 0..300_000 {
            reserve(&mut column, 1);
            column.push(row as u16);
            capacities.push(column.capacity());
        }
        capacities.dedup();
        let long = capacities.iter().filter(|&&capacity| capacity >= STRETCH.0).count();
        assert!(long < 16 && capacities.len() - long < 12, "{capacities:?}");
        assert!(column.capacity() < column.len() + column.len() / 8, "{capacities:?}");
    }
}
