//! A plant's rows as clients have them: what limbs and joints are made from.

use glam::DVec3;

use crate::{
    radius_code::NOT_DRAWN,
    ring_table::{POSITION_STEPS, RingTable},
};

/// In place of a row, limb or joint that is not there.
pub const NONE: u32 = u32::MAX;

/// One row, as it is sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Row {
    /// The row it grows from; none for a seed.
    pub parent: Option<u32>,
    /// Whether it is the first wood of its axis.
    pub starts_axis: bool,
    /// Where its metamer ends, in steps of 1/256 internode.
    pub position: [i32; 3],
    /// The code of its radius; 0 for seeds and the dead.
    pub radius: u16,
    /// How many leaves it bears.
    pub leaves: u8,
}

/// Rows in birth order, column by column.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Rows {
    /// The row that each grows from; [`NONE`] of a seed.
    pub parent: Vec<u32>,
    /// Whether each is the first wood of its axis.
    pub starts_axis: Vec<bool>,
    /// Where each metamer ends, in steps of 1/256 internode.
    pub position: Vec<[i32; 3]>,
    /// The code of each radius; 0 for seeds and the dead.
    pub radius: Vec<u16>,
    /// How many leaves each bears.
    pub leaves: Vec<u8>,
}

/// Rows that are no plant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the parent of row {0} is not below it")]
pub struct BrokenRows(pub u32);

impl Rows {
    /// Fails where a parent does not stand before its child.
    pub fn new(rows: impl IntoIterator<Item = Row>) -> Result<Self, BrokenRows> {
        let mut columns = Self::default();
        for (at, row) in rows.into_iter().enumerate() {
            if row.parent.is_some_and(|parent| parent as usize >= at) {
                return Err(BrokenRows(at as u32));
            }
            columns.push(row);
        }
        Ok(columns)
    }

    /// The rows of a table, whose parents stand before their children.
    pub fn of(table: &RingTable) -> Self {
        let mut columns = Self::default();
        for row in 0..table.rows() as u32 {
            columns.push(Row {
                parent: table.parent(row),
                starts_axis: table.starts_axis(row),
                position: table.position(row),
                radius: table.radius(row),
                leaves: table.foliage(row) & 0x0f,
            });
        }
        columns
    }

    fn push(&mut self, row: Row) {
        self.parent.push(row.parent.unwrap_or(NONE));
        self.starts_axis.push(row.starts_axis);
        self.position.push(row.position);
        self.radius.push(row.radius);
        self.leaves.push(row.leaves);
    }

    /// How many rows there are.
    pub fn len(&self) -> usize {
        self.parent.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.parent.is_empty()
    }

    /// One of the rows.
    pub fn row(&self, row: u32) -> Row {
        let at = row as usize;
        Row {
            parent: (self.parent[at] != NONE).then_some(self.parent[at]),
            starts_axis: self.starts_axis[at],
            position: self.position[at],
            radius: self.radius[at],
            leaves: self.leaves[at],
        }
    }

    /// Whether a row is drawn: it lives and is no seed.
    pub fn is_wood(&self, row: usize) -> bool {
        self.radius[row] != NOT_DRAWN && self.parent[row] != NONE
    }

    /// Where a row ends, in internodes. A quotient by a power of two, so it is exact.
    pub fn place(&self, row: usize) -> DVec3 {
        let [x, y, z] = self.position[row].map(f64::from);
        DVec3::new(x, y, z) / f64::from(POSITION_STEPS)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_above_its_parent_is_refused() {
        let row = |parent| Row { parent, starts_axis: false, position: [0; 3], radius: 1, leaves: 0 };
        assert_eq!(Rows::new([row(None), row(Some(1))]), Err(BrokenRows(1)));
        assert_eq!(Rows::new([row(None), row(Some(0))]).map(|rows| rows.len()), Ok(2));
    }
}
