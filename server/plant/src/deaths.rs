//! When rows died.

use std::ops::Range;

/// The step of death of what is alive.
pub(crate) const ALIVE: u32 = u32::MAX;

/// A step of death for each row, written down as far as the last one that has one.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Deaths {
    written: Vec<u32>,
}

impl Deaths {
    /// As columns are kept outside: one step for each row.
    pub(crate) fn from_rows(rows: Vec<u32>) -> Self {
        let mut deaths = Self { written: rows };
        deaths.trim();
        deaths
    }

    /// The same, for so many rows.
    pub(crate) fn to_rows(&self, count: usize) -> Vec<u32> {
        (0..count).map(|row| self.of(row)).collect()
    }

    /// The step of a row's death, [`ALIVE`] if it has none.
    #[inline(always)]
    pub(crate) fn of(&self, row: usize) -> u32 {
        self.written.get(row).copied().unwrap_or(ALIVE)
    }

    /// Those of some neighbouring rows, as far as they are written down.
    pub(crate) fn within(&self, rows: Range<usize>) -> &[u32] {
        let end = self.written.len();
        &self.written[rows.start.min(end)..rows.end.min(end)]
    }

    /// A row dies.
    pub(crate) fn set(&mut self, row: usize, step: u32) {
        if row >= self.written.len() {
            self.written.resize(row + 1, ALIVE);
        }
        self.written[row] = step;
    }

    /// Puts another step in place of a row's; returns the one that was. [`Deaths::trim`] follows.
    pub(crate) fn replace(&mut self, row: usize, step: u32) -> u32 {
        let was = self.of(row);
        if was != step {
            self.set(row, step);
        }
        was
    }

    /// Takes out the deaths that come after a step, row by row.
    pub(crate) fn take_after(&mut self, step: u32) -> Vec<(usize, u32)> {
        let mut taken = Vec::new();
        let is_later = |(_, death): &(usize, &mut u32)| **death > step && **death != ALIVE;
        for (row, death) in self.written.iter_mut().enumerate().filter(is_later) {
            taken.push((row, std::mem::replace(death, ALIVE)));
        }
        self.trim();
        taken
    }

    /// Cuts the rows off from one on and returns those.
    pub(crate) fn split_off(&mut self, at: usize) -> Self {
        let written = self.written.split_off(at.min(self.written.len()));
        self.trim();
        Self { written }
    }

    /// Puts rows behind the first so many.
    pub(crate) fn append(&mut self, count: usize, mut more: Self) {
        if !more.written.is_empty() {
            self.written.resize(count, ALIVE);
            self.written.append(&mut more.written);
        }
    }

    /// Leaves out the living at the end, so that equal deaths are equal columns.
    pub(crate) fn trim(&mut self) {
        let dead = self.written.iter().rposition(|&death| death != ALIVE);
        self.written.truncate(dead.map_or(0, |last| last + 1));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_deaths_are_equal_columns() {
        let mut deaths = Deaths::default();
        deaths.set(2, 7);
        deaths.set(5, 9);
        assert_eq!(deaths.to_rows(7), [ALIVE, ALIVE, 7, ALIVE, ALIVE, 9, ALIVE]);
        assert_eq!(Deaths::from_rows(deaths.to_rows(7)), deaths);
        assert_eq!(deaths.within(1..9), [ALIVE, 7, ALIVE, ALIVE, 9]);
        let mut parted = deaths.clone();
        let rest = parted.split_off(4);
        assert_eq!((parted.of(2), parted.of(5), rest.of(1)), (7, ALIVE, 9));
        assert_eq!(parted, Deaths::from_rows(vec![ALIVE, ALIVE, 7]));
        parted.append(4, rest);
        assert_eq!(parted, deaths);
        assert_eq!(parted.take_after(7), [(5, 9)]);
        assert_eq!(parted, Deaths::from_rows(vec![ALIVE, ALIVE, 7]));
    }
}
