//! The rows of a plant that are made anew from a design, and what seals them.

use espalier_plant::{MetamerId, Plant};

/// The step in which the wood of a design was born, and its rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Block {
    /// The step.
    pub step: u32,
    /// The first row.
    pub first: u32,
    /// The row behind the last one.
    pub end: u32,
}

/// Whether a design may still change its wood.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seal {
    /// Nothing has happened since: its rows may be made anew.
    Open,
    /// The plant has gone back to before it.
    Undone,
    /// Later steps stand on it, for rows are numbered in order of birth.
    Sealed {
        /// Rows born since.
        grown: u32,
        /// Steps since, of growth and of edits.
        steps: u32,
    },
}

impl Block {
    /// The wood that a plant got in its present step; none in the step of its first seed.
    pub fn of_present(plant: &Plant) -> Option<Self> {
        let (step, end) = (plant.step(), plant.metamer_count() as u32);
        // Rows stand in order of birth.
        let (mut from, mut to) = (0, end);
        while from < to {
            let middle = from + (to - from) / 2;
            if plant.birth(MetamerId::new(middle as usize)) < step { from = middle + 1 } else { to = middle }
        }
        (step > 0 && from < end).then_some(Self { step, first: from, end })
    }

    /// Whether its rows may be made anew.
    pub fn seal(&self, plant: &Plant) -> Seal {
        if plant.step() < self.step {
            return Seal::Undone;
        }
        match plant.step() - self.step {
            0 => Seal::Open,
            steps => Seal::Sealed { grown: plant.metamer_count() as u32 - self.end, steps },
        }
    }

    /// Whether a row is of its wood.
    pub fn contains(&self, row: MetamerId) -> bool {
        (self.first..self.end).contains(&row.raw())
    }
}
