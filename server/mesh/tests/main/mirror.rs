//! Clients, as far as their rows go.

use espalier_mesh::{Changes, RingTable, ring_table::CHUNK_ROWS};

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    pub parent: Option<u32>,
    pub starts_axis: bool,
    pub position: [i32; 3],
    pub radius: u16,
    pub foliage: u8,
    pub light: u8,
    pub born: u32,
}

fn row(table: &RingTable, row: u32) -> Row {
    Row {
        parent: table.parent(row),
        starts_axis: table.starts_axis(row),
        position: table.position(row),
        radius: table.radius(row),
        foliage: table.foliage(row),
        light: table.light(row),
        born: table.born(row),
    }
}

pub fn all_rows(table: &RingTable) -> Vec<Row> {
    (0..table.rows() as u32).map(|index| row(table, index)).collect()
}

/// A client that is sent every change and reads nothing else.
#[derive(Debug, Default)]
pub struct ByChanges {
    rows: Vec<Row>,
    generations: Vec<u32>,
}

impl ByChanges {
    pub fn apply(&mut self, changes: &Changes, table: &RingTable, sequence: u32) {
        if let Some(kept) = changes.truncated {
            assert!((kept as usize) < self.rows.len(), "a truncation drops rows");
            self.rows.truncate(kept as usize);
            self.generations.truncate(self.rows.len().div_ceil(CHUNK_ROWS));
            if !self.rows.len().is_multiple_of(CHUNK_ROWS) {
                self.stamp(kept - 1, sequence);
            }
        }
        for rows in [&changes.position, &changes.radius, &changes.foliage, &changes.light] {
            assert!(rows.is_sorted_by(|a, b| a < b) && rows.iter().all(|&row| row < changes.appended.start));
            for &row in rows {
                self.stamp(row, sequence);
            }
        }
        for &index in &changes.position {
            self.rows[index as usize].position = table.position(index);
        }
        for &index in &changes.radius {
            self.rows[index as usize].radius = table.radius(index);
        }
        for &index in &changes.foliage {
            self.rows[index as usize].foliage = table.foliage(index);
        }
        for &index in &changes.light {
            self.rows[index as usize].light = table.light(index);
        }
        for index in changes.appended.clone() {
            assert_eq!(index as usize, self.rows.len());
            self.rows.push(row(table, index));
            self.stamp(index, sequence);
        }
    }

    fn stamp(&mut self, row: u32, sequence: u32) {
        let chunk = row as usize / CHUNK_ROWS;
        self.generations.resize(self.generations.len().max(chunk + 1), sequence);
        self.generations[chunk] = sequence;
    }

    pub fn equals(&self, table: &RingTable) -> bool {
        self.rows == all_rows(table) && self.generations == table.generations()
    }
}

/// A client that comes by from time to time and takes the chunks whose generation it does not have.
#[derive(Debug, Default)]
pub struct ByGenerations {
    rows: Vec<Row>,
    generations: Vec<u32>,
}

impl ByGenerations {
    pub fn catch_up(&mut self, table: &RingTable) {
        let current = all_rows(table);
        self.rows.truncate(current.len());
        for (chunk, rows) in current.chunks(CHUNK_ROWS).enumerate() {
            if self.generations.get(chunk) != Some(&table.generations()[chunk]) {
                let first = chunk * CHUNK_ROWS;
                self.rows.resize(self.rows.len().max(first + rows.len()), rows[0]);
                self.rows[first..first + rows.len()].copy_from_slice(rows);
            }
        }
        self.generations = table.generations().to_vec();
    }

    pub fn equals(&self, table: &RingTable) -> bool {
        self.rows == all_rows(table)
    }
}
