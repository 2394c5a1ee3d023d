//! Deflating, and how long a document can be.

use std::io::{Read, Write};

use flate2::{Compression, read::DeflateDecoder, write::DeflateEncoder};

use super::{DocumentError, damaged};
use crate::document::{futures, obstacles};

/// The largest metamer budget that a session can begin with (`LM4`).
pub const MAX_METAMER_BUDGET: u32 = 4_000_000;

/// Axes to a metamer: a node bears up to four lateral buds, and a seed brings the axis of its plant.
const AXES: u64 = 5;
/// A metamer in all columns that the present or a future has of it, its given radius, its cut and its scar.
const METAMER: u64 = 70;
/// An axis in all columns, and its shedding. Where one dies in a future, a step and a row take less.
const AXIS: u64 = 29;
/// A place of wood that was moved, with its axes: rows, nodes, normals and directions.
const PLACE: u64 = 28 + AXES * 16;
/// A triangle of an obstacle and its corners.
const TRIANGLE: u64 = 48;
/// What people did: operations, parameters, looks, programmes, steps. No limit counts these, but hundred thousands of
/// operations fit.
const HISTORY: u64 = 500_000_000;

/// The most bytes that a document unpacks to, whatever its sections hold: the limits of the protocol (`LM4`, `LM6`,
/// `LM11`) leave room for no more.
pub(super) const MAX_UNPACKED: u64 = (MAX_METAMER_BUDGET as u64 + futures::MAX_METAMERS as u64)
    * (METAMER + AXES * AXIS)
    + futures::MAX_PLACES * PLACE
    + obstacles::MAX_HELD_TRIANGLES as u64 * TRIANGLE
    + HISTORY;

pub(super) fn deflate(bytes: &[u8]) -> Vec<u8> {
    let mut deflate = DeflateEncoder::new(Vec::with_capacity(bytes.len() / 2), Compression::new(3));
    // Writing into memory does not fail.
    let _ = deflate.write_all(bytes);
    deflate.finish().unwrap_or_default()
}

/// What was deflated; nothing if it is more than so many bytes, of which no more are unpacked.
pub(super) fn inflate(deflated: &[u8], most: u64) -> Result<Option<Vec<u8>>, DocumentError> {
    let mut bytes = Vec::new();
    let mut inflated = DeflateDecoder::new(deflated).take(most.saturating_add(1));
    inflated.read_to_end(&mut bytes).map_err(|_| damaged("it does not unpack"))?;
    Ok((bytes.len() as u64 <= most).then_some(bytes))
}

#[cfg(test)]
mod tests {
    use espalier_growth::DEFAULT_METAMER_BUDGET;
    use espalier_settings::{Kind, ParameterValues};

    use super::*;

    #[test]
    fn a_bomb_unpacks_to_what_is_asked_for_and_no_further() {
        let bomb = deflate(&vec![0; 1 << 22]);
        assert!(bomb.len() < 1 << 13, "{} bytes become four million", bomb.len());
        assert_eq!(inflate(&bomb, (1 << 22) - 1), Ok(None));
        assert_eq!(inflate(&bomb, 0), Ok(None));
        assert_eq!(inflate(&bomb, 1 << 22), Ok(Some(vec![0; 1 << 22])));
        // No more than the limit is read: what follows is not even looked at.
        let torn = &bomb[..bomb.len() / 2];
        assert_eq!(inflate(torn, 100), Ok(None));
        assert!(inflate(torn, 1 << 22).is_err());
    }

    #[test]
    fn the_limits_are_those_of_the_settings() {
        let buds = ParameterValues::ROWS.iter().find(|row| row.name == "buds_per_node");
        let Some(Kind::Number { most, .. }) = buds.map(|row| row.kind) else { panic!("buds are counted") };
        assert_eq!(AXES, most as u64 + 1);
        const { assert!(DEFAULT_METAMER_BUDGET <= MAX_METAMER_BUDGET) };
    }
}
