//! Rows in the order of their places, so that rows near each other are processed together.

use glam::Vec3;

use crate::directory::nearness;

/// Bits of a number that one pass sorts by; three passes make up a nearness.
const DIGIT: u32 = 10;
/// Fewer are sorted faster by comparing them.
const COUNTED_FROM: usize = if cfg!(test) { 4 } else { 256 };

/// Rows, given in ascending order with their places, by nearness; those in one voxel stay in ascending order.
pub(crate) fn nearby_order(rows: impl Iterator<Item = (usize, Vec3)>) -> Vec<u32> {
    let mut keys: Vec<u64> = rows.map(|(row, place)| u64::from(nearness(place)) << 32 | row as u64).collect();
    if keys.len() < COUNTED_FROM {
        keys.sort_unstable();
    } else {
        let mut sorted = vec![0; keys.len()];
        for pass in 0..3 {
            sort_by_digit(&keys, &mut sorted, 32 + pass * DIGIT);
            core::mem::swap(&mut keys, &mut sorted);
        }
    }
    keys.into_iter().map(|key| key as u32).collect()
}

/// Sorts numbers by the digit that begins at a bit; those with the same digit keep their order.
fn sort_by_digit(keys: &[u64], sorted: &mut [u64], bit: u32) {
    const DIGITS: usize = 1 << DIGIT;
    let digit = |key: u64| (key >> bit) as usize % DIGITS;
    let mut places = [0u32; DIGITS];
    for &key in keys {
        places[digit(key)] += 1;
    }
    let mut next = 0;
    for place in &mut places {
        next += core::mem::replace(place, next);
    }
    for &key in keys {
        let place = &mut places[digit(key)];
        sorted[*place as usize] = key;
        *place += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn rows_are_ordered_as_if_compared(places in prop::collection::vec((-90f32..90.0, 0f32..90.0, -90f32..90.0), 0..80)) {
            let places: Vec<Vec3> = places.into_iter().map(|place| Vec3::from(place) * 0.2).collect();
            let rows = || places.iter().enumerate().map(|(i, &place)| (i + 7, place));
            let mut expected: Vec<(u32, u32)> = rows().map(|(row, place)| (nearness(place), row as u32)).collect();
            expected.sort_unstable();
            let expected: Vec<u32> = expected.into_iter().map(|(_, row)| row).collect();
            prop_assert_eq!(nearby_order(rows()), expected);
        }
    }
}
