//! The rows a client holds, built from frames alone and as strictly as the protocol allows.

use espalier_proto::{
    ChunkChange, Frame, Resume, Rows, Values,
    frame::{CHUNK_ROWS, direction, light_level, light_of},
};

/// One metamer as a client knows it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Row {
    /// See [`Values::Parent`].
    pub parent: u32,
    /// Where it ends, in steps of 1/256 internode; absolute (`FR6`).
    pub position: [i32; 3],
    /// The radius code; 0 is dead, or a seed.
    pub radius: u16,
    /// Leaves and vigor.
    pub foliage: u8,
    /// Light.
    pub light: u8,
    /// Steps of growth up to its birth.
    pub born: u32,
    /// Organs that it is given.
    pub organs: Option<Vec<u32>>,
}

/// What a row is apart from its looks: light and vigor are shown as they were last worth a patch.
pub type Form = (u32, [i32; 3], u16, u8);

impl Row {
    /// Parent, position, radius and number of leaves.
    pub fn form(&self) -> Form {
        (self.parent, self.position, self.radius, self.foliage & 0xf)
    }
}

/// The table and the generation of each of its chunks.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// The epoch of the frames in it.
    pub epoch: u32,
    /// The newest frame in it.
    pub sequence: Option<u32>,
    /// All rows in birth order.
    pub rows: Vec<Row>,
    /// The generation of each chunk.
    pub generations: Vec<u32>,
}

impl Table {
    /// An empty table that waits for frames of this epoch.
    pub fn new(epoch: u32) -> Self {
        Self { epoch, ..Self::default() }
    }

    /// Rows that are drawn.
    pub fn living(&self) -> usize {
        self.rows.iter().filter(|row| row.radius != 0).count()
    }

    /// The form of all rows: what the same commands must give in any session.
    pub fn form(&self) -> Vec<Form> {
        self.rows.iter().map(Row::form).collect()
    }

    /// What a returning client says it has (`RS1`).
    pub fn resume(&self) -> Resume {
        Resume { epoch: self.epoch, generations: self.generations.clone(), rows: self.rows.len() as u32 }
    }

    /// Takes in a frame; an error is a broken rule of the protocol.
    pub fn apply(&mut self, frame: &Frame) -> Result<(), String> {
        if frame.epoch != self.epoch {
            return Err(format!("epoch {} after a welcome with {}", frame.epoch, self.epoch));
        }
        if let Some(last) = self.sequence {
            let follows = if frame.catch_up { frame.sequence >= last } else { frame.sequence == last + 1 };
            if !follows {
                return Err(format!(
                    "FR4: frame {} after {last}, catch-up {}",
                    frame.sequence, frame.catch_up
                ));
            }
        }
        for change in &frame.changes {
            self.change(change)?;
        }
        if self.generations.len() != self.rows.len().div_ceil(CHUNK_ROWS) {
            return Err(format!("{} generations for {} rows", self.generations.len(), self.rows.len()));
        }
        self.sequence = Some(frame.sequence);
        Ok(())
    }

    fn change(&mut self, change: &ChunkChange) -> Result<(), String> {
        match change {
            ChunkChange::Truncate { rows } => {
                let rows = *rows as usize;
                if rows > self.rows.len() {
                    return Err(format!("truncate to {rows} of {} rows", self.rows.len()));
                }
                self.rows.truncate(rows);
                self.generations.truncate(rows.div_ceil(CHUNK_ROWS));
                Ok(())
            }
            ChunkChange::Replace { chunk, generation, rows } => {
                let start = *chunk as usize * CHUNK_ROWS;
                let had = self.rows.len().saturating_sub(start).min(CHUNK_ROWS);
                if start > self.rows.len() || (rows.len() < had && start + had < self.rows.len()) {
                    return Err(format!("replace of chunk {chunk} leaves a hole"));
                }
                // A last chunk may become shorter; what follows a whole chunk stays.
                if start + had == self.rows.len() {
                    self.rows.truncate(start);
                }
                self.write(start, rows)?;
                self.stamp(*chunk, *generation)
            }
            ChunkChange::Append { chunk, generation, start, rows } => {
                let at = *chunk as usize * CHUNK_ROWS + *start as usize;
                if at != self.rows.len() {
                    return Err(format!("append at row {at} to {} rows", self.rows.len()));
                }
                self.write(at, rows)?;
                self.stamp(*chunk, *generation)
            }
            ChunkChange::Patch { chunk, generation, rows, values } => {
                for (i, &row) in rows.iter().enumerate() {
                    self.patch(*chunk as usize * CHUNK_ROWS + usize::from(row), values, i)?;
                }
                self.stamp(*chunk, *generation)
            }
        }
    }

    fn write(&mut self, start: usize, rows: &Rows) -> Result<(), String> {
        for i in 0..rows.len() {
            let row = start + i;
            if row == self.rows.len() {
                self.rows.push(Row::default());
            }
            self.rows[row].parent = rows.parent[i];
            self.rows[row] = Row {
                parent: rows.parent[i],
                position: self.place(row, rows.position[i])?,
                radius: rows.radius[i],
                foliage: rows.foliage[i],
                light: rows.light[i],
                born: rows.born[i],
                organs: None,
            };
        }
        Ok(())
    }

    fn patch(&mut self, row: usize, values: &Values, i: usize) -> Result<(), String> {
        if row >= self.rows.len() {
            return Err(format!("patch of row {row} of {}", self.rows.len()));
        }
        match values {
            Values::Parent(v) => self.rows[row].parent = v[i],
            Values::Position(v) => self.rows[row].position = self.place(row, v[i])?,
            Values::Radius(v) => {
                let code = u16::try_from(i32::from(self.rows[row].radius) + v[i]);
                self.rows[row].radius = code.map_err(|_| format!("FR11: radius of row {row} by {}", v[i]))?;
            }
            Values::Foliage(v) => self.rows[row].foliage = self.rows[row].foliage.wrapping_add(v[i]),
            Values::Light(v) => {
                let light = light_of(light_level(self.rows[row].light) + v[i]);
                self.rows[row].light =
                    light.ok_or_else(|| format!("FR11: light of row {row} by {}", v[i]))?;
            }
            Values::Born(_) => panic!("a metamer never changes its birth"),
            Values::Organs(v) => self.rows[row].organs.clone_from(&v[i]),
        }
        Ok(())
    }

    /// Where a row ends, by what is told of it (`FR10`).
    fn place(&self, row: usize, told: [i32; 3]) -> Result<[i32; 3], String> {
        let goes_on = self.rows[row].parent & 1 == 0;
        let Some(parent) = self.parent(row)? else { return Ok(direction::follow(told, [0; 3], goes_on)) };
        let from = self.rows[parent].position;
        let parents = self.parent(parent)?.map_or([0; 3], |below| {
            let below = self.rows[below].position;
            std::array::from_fn(|axis| from[axis].wrapping_sub(below[axis]))
        });
        Ok(sum(from, direction::follow(told, parents, goes_on)))
    }

    fn parent(&self, row: usize) -> Result<Option<usize>, String> {
        let back = (self.rows[row].parent >> 1) as usize;
        match (self.rows[row].parent, back) {
            (0, _) => Ok(None),
            (_, 1..) if back <= row => Ok(Some(row - back)),
            (parent, _) => Err(format!("FR5: row {row} has parent code {parent}")),
        }
    }

    fn stamp(&mut self, chunk: u32, generation: u32) -> Result<(), String> {
        let chunk = chunk as usize;
        if chunk == self.generations.len() {
            self.generations.push(generation);
        }
        match self.generations.get_mut(chunk) {
            Some(slot) => *slot = generation,
            None => return Err(format!("chunk {chunk} is changed before it exists")),
        }
        Ok(())
    }
}

fn sum(a: [i32; 3], b: [i32; 3]) -> [i32; 3] {
    std::array::from_fn(|axis| a[axis].wrapping_add(b[axis]))
}
