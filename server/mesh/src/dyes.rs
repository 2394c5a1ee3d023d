//! Colours of single branches: factors by which the bark and the leaves of rows are multiplied.

use espalier_plant::{MetamerId, Plant};
use glam::Vec3;

/// Factors of colours in linear light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dye {
    /// Of bark.
    pub bark: Vec3,
    /// Of leaves.
    pub leaves: Vec3,
}

impl Dye {
    /// That which changes nothing.
    pub const NONE: Self = Self { bark: Vec3::ONE, leaves: Vec3::ONE };

    fn distance_squared(&self, other: &Self) -> f32 {
        self.bark.distance_squared(other.bark) + self.leaves.distance_squared(other.leaves)
    }
}

/// Rows after one another that are dyed alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DyedRows {
    /// The first one.
    pub first: u32,
    /// How many.
    pub count: u32,
    /// The place of their dye counted from 1; 0 for none.
    pub dye: u8,
}

/// Which rows of a plant are dyed how. Wood that grew on dyed wood is dyed like it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dyes {
    /// Different ones.
    all: Vec<Dye>,
    /// In ascending order, none of which have a row in common.
    runs: Vec<DyedRows>,
}

impl Dyes {
    /// Most different dyes of a document: four bits say which of them a row has, and one of these says none.
    pub const MOST: usize = 15;

    /// Whether nothing is dyed.
    pub fn are_none(&self) -> bool {
        self.all.is_empty()
    }

    /// The dyes.
    pub fn all(&self) -> &[Dye] {
        &self.all
    }

    /// Which rows have them.
    pub fn runs(&self) -> &[DyedRows] {
        &self.runs
    }

    /// The number of a dye, as rows have it. Beyond [`Self::MOST`] it is that of the one which is most like it.
    pub fn number(&mut self, dye: Dye) -> u8 {
        if dye == Dye::NONE {
            return 0;
        }
        let known = self.all.iter().position(|known| *known == dye);
        let at = known.unwrap_or_else(|| {
            if self.all.len() < Self::MOST {
                self.all.push(dye);
                return self.all.len() - 1;
            }
            let away = |at: &usize| self.all[*at].distance_squared(&dye);
            (0..self.all.len()).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or_default()
        });
        at as u8 + 1
    }

    /// Dyes rows, which come after all that have been dyed so far.
    pub fn push(&mut self, rows: DyedRows) {
        self.runs.push(rows);
    }

    /// The same for each row of a plant.
    pub fn by_rows(&self, plant: &Plant) -> RowDyes {
        if self.are_none() {
            return RowDyes::default();
        }
        let mut numbers = vec![0; plant.metamer_count()];
        let mut runs = self.runs.iter().peekable();
        for row in 0..numbers.len() {
            while runs.next_if(|run| (run.first + run.count) as usize <= row).is_some() {}
            let run = runs.peek().filter(|run| run.first as usize <= row);
            let below = plant.metamers().parent(MetamerId::new(row)).map(|parent| numbers[parent.index()]);
            numbers[row] = run.map_or(below.unwrap_or_default(), |run| run.dye);
        }
        RowDyes { all: self.all.clone(), numbers }
    }
}

/// The dye of each row of a plant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RowDyes {
    all: Vec<Dye>,
    numbers: Vec<u8>,
}

impl RowDyes {
    /// That of a row.
    pub fn of(&self, row: MetamerId) -> &Dye {
        let number = self.numbers.get(row.index()).copied().unwrap_or_default();
        usize::from(number).checked_sub(1).and_then(|at| self.all.get(at)).unwrap_or(&Dye::NONE)
    }

    /// The greatest factor of bark, at least 1.
    pub fn greatest_of_bark(&self) -> f32 {
        self.all.iter().map(|dye| dye.bark.max_element()).fold(1.0, f32::max)
    }
}

#[cfg(test)]
mod tests {
    use espalier_plant::{AxisId, Internode};

    use super::*;

    fn dye(bark: f32) -> Dye {
        Dye { bark: Vec3::splat(bark), leaves: Vec3::ONE }
    }

    #[test]
    fn wood_is_dyed_like_that_on_which_it_stands() {
        let mut plant = Plant::new(Vec3::ZERO);
        plant.begin_step();
        for height in 1..=4u8 {
            let end = Vec3::Y * f32::from(height);
            plant.extend(AxisId::new(0), &Internode { end, normal: Vec3::X, laterals: &[] });
        }
        plant.end_step();
        let mut dyes = Dyes::default();
        let (one, other) = (dyes.number(dye(0.5)), dyes.number(dye(2.0)));
        dyes.push(DyedRows { first: 1, count: 1, dye: one });
        dyes.push(DyedRows { first: 2, count: 1, dye: other });
        let rows = dyes.by_rows(&plant);
        let barks: Vec<f32> = (0..5).map(|row| rows.of(MetamerId::new(row)).bark.x).collect();
        assert_eq!(barks, [1.0, 0.5, 2.0, 2.0, 2.0]);
        assert_eq!(rows.greatest_of_bark(), 2.0);
    }

    #[test]
    fn what_is_beyond_the_most_gets_the_dye_most_like_it() {
        let mut dyes = Dyes::default();
        let numbers: Vec<u8> = (2..20u8).map(|i| dyes.number(dye(f32::from(i)))).collect();
        assert_eq!(numbers[..15], (1..=15).collect::<Vec<u8>>());
        assert_eq!(numbers[15..], [15, 15, 15]);
        assert_eq!((dyes.number(Dye::NONE), dyes.all().len()), (0, Dyes::MOST));
    }
}
