//! What a client makes of the frames it gets: the table of rows, strict about every rule of `FR`.

use espalier_mesh::{RingTable, Style, StyleOptions};
use espalier_proto::{
    ChunkChange, Frame, Resume, Rows, Values,
    frame::{CHUNK_ROWS, direction, light_level, light_of},
};
use espalier_session::Document;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    pub parent: Option<u32>,
    pub begins_axis: bool,
    pub position: [i32; 3],
    pub radius: u16,
    pub foliage: u8,
    pub light: u8,
    pub born: u32,
    pub organs: Option<Vec<u32>>,
}

#[derive(Clone, Debug, Default)]
pub struct Mirror {
    pub epoch: u32,
    pub sequence: Option<u32>,
    pub rows: Vec<Row>,
    pub generations: Vec<u32>,
}

impl Mirror {
    pub fn resume(&self) -> Resume {
        Resume { epoch: self.epoch, generations: self.generations.clone(), rows: self.rows.len() as u32 }
    }

    pub fn apply(&mut self, frame: &Frame) {
        assert_eq!(frame.epoch, self.epoch, "a frame of another epoch");
        match self.sequence {
            Some(last) if !frame.catch_up => assert_eq!(frame.sequence, last + 1, "FR4"),
            Some(last) => assert!(frame.sequence >= last, "FR4: a catch-up never goes back"),
            None => assert!(frame.catch_up, "the first frame of a connection is a catch-up"),
        }
        self.sequence = Some(frame.sequence);
        for change in &frame.changes {
            self.change(change, frame.sequence);
        }
    }

    fn change(&mut self, change: &ChunkChange, sequence: u32) {
        match change {
            ChunkChange::Truncate { rows } => {
                assert!((*rows as usize) < self.rows.len(), "nothing to forget");
                self.rows.truncate(*rows as usize);
                self.generations.truncate((*rows as usize).div_ceil(CHUNK_ROWS));
            }
            ChunkChange::Replace { chunk, generation, rows } => {
                let first = *chunk as usize * CHUNK_ROWS;
                assert!(first <= self.rows.len(), "chunks come without holes");
                assert!(*generation <= sequence);
                let behind = self.rows.split_off(self.rows.len().min(first + CHUNK_ROWS));
                self.rows.truncate(first);
                self.extend(rows);
                assert!(behind.is_empty() || rows.len() == CHUNK_ROWS, "only the last chunk is short");
                self.rows.extend(behind);
                self.stamp(*chunk, *generation);
            }
            ChunkChange::Append { chunk, generation, start, rows } => {
                assert_eq!(*chunk as usize * CHUNK_ROWS + *start as usize, self.rows.len());
                assert_eq!(*generation, sequence);
                self.extend(rows);
                self.stamp(*chunk, *generation);
            }
            ChunkChange::Patch { chunk, generation, rows, values } => {
                assert_eq!(*generation, sequence);
                for (at, row) in rows.iter().enumerate() {
                    self.patch(*chunk as usize * CHUNK_ROWS + usize::from(*row), values, at);
                }
                self.stamp(*chunk, *generation);
            }
        }
    }

    fn extend(&mut self, rows: &Rows) {
        for at in 0..rows.len() {
            let row = self.rows.len() as u32;
            let code = rows.parent[at];
            let parent = (code > 0).then(|| row.checked_sub(code / 2).expect("a parent's row exists"));
            assert!(parent.is_none_or(|parent| parent < row), "FR5: a parent's row is below its child's");
            self.rows.push(Row {
                parent,
                begins_axis: code & 1 == 1,
                position: self.place(parent, code & 1 == 1, rows.position[at]),
                radius: rows.radius[at],
                foliage: rows.foliage[at],
                light: rows.light[at],
                born: rows.born[at],
                organs: None,
            });
        }
    }

    fn patch(&mut self, row: usize, values: &Values, at: usize) {
        match values {
            Values::Parent(_) => panic!("a metamer never changes its parent"),
            Values::Position(values) => {
                let Row { parent, begins_axis, .. } = self.rows[row];
                self.rows[row].position = self.place(parent, begins_axis, values[at]);
            }
            Values::Radius(values) => {
                let code = i32::from(self.rows[row].radius) + values[at];
                self.rows[row].radius = code.try_into().expect("FR11: a radius has 16 bits");
            }
            Values::Foliage(values) => {
                self.rows[row].foliage = self.rows[row].foliage.wrapping_add(values[at]);
            }
            Values::Light(values) => {
                let level = light_level(self.rows[row].light) + values[at];
                self.rows[row].light = light_of(level).expect("FR11: there are 32 levels of light");
            }
            Values::Born(_) => panic!("a metamer never changes its birth"),
            Values::Organs(values) => self.rows[row].organs.clone_from(&values[at]),
        }
    }

    /// Where a metamer ends, by what is told of it (FR10).
    fn place(&self, parent: Option<u32>, begins_axis: bool, told: [i32; 3]) -> [i32; 3] {
        let Some(parent) = parent.map(|parent| &self.rows[parent as usize]) else {
            return direction::follow(told, [0; 3], !begins_axis);
        };
        let below = parent.parent.map(|below| self.rows[below as usize].position);
        let parents = below.map_or([0; 3], |below| difference(parent.position, below));
        sum(parent.position, direction::follow(told, parents, !begins_axis))
    }

    fn stamp(&mut self, chunk: u32, generation: u32) {
        let chunk = chunk as usize;
        assert!(chunk <= self.generations.len());
        if chunk == self.generations.len() {
            self.generations.push(generation);
        } else {
            self.generations[chunk] = generation;
        }
    }
}

/// The rows of a table that nobody has seen before.
pub fn rows_of(document: &Document) -> Vec<Row> {
    let parameters = document.parameters();
    let style = Style::new(StyleOptions {
        girth_exponent: parameters.girth_exponent,
        twig_diameter: parameters.twig_diameter,
        leaves_per_node: parameters.leaves_per_node as u8,
        leaf_size: parameters.leaf_size,
    });
    let mut table = RingTable::new();
    table.sync(document.plant(), &style, 1);
    let row = |row: u32| Row {
        parent: table.parent(row),
        begins_axis: table.starts_axis(row),
        position: table.position(row),
        radius: table.radius(row),
        foliage: table.foliage(row),
        light: table.light(row),
        born: table.born(row),
        organs: table.organs(row).map(|organs| organs.iter().map(|organ| organ.to_number()).collect()),
    };
    (0..table.rows() as u32).map(row).collect()
}

impl Row {
    /// Equal but for the looks of what is dead, and for changes of light and vigor too small to be told.
    pub fn shows(&self, plant: &Self) -> bool {
        let drawn = self.radius > 0;
        let exact = |row: &Self| {
            let organs = row.organs.clone();
            (row.parent, row.begins_axis, row.position, row.radius, row.foliage & 0xf, row.born, organs)
        };
        let light = self.light.abs_diff(plant.light) < 8;
        let vigor = (self.foliage >> 4).abs_diff(plant.foliage >> 4) < 2;
        exact(self) == exact(plant) && (!drawn || light && vigor)
    }
}

fn sum(a: [i32; 3], b: [i32; 3]) -> [i32; 3] {
    std::array::from_fn(|axis| a[axis].wrapping_add(b[axis]))
}

fn difference(a: [i32; 3], b: [i32; 3]) -> [i32; 3] {
    std::array::from_fn(|axis| a[axis].wrapping_sub(b[axis]))
}
