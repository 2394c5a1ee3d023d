//! The table of rings that clients mirror: one quantised row per metamer, in birth order.
//!
//! The table holds what clients were told. [`RingTable::sync`] compares it with the plant in one pass and says
//! what differs, so it does not matter what happened in between: growth, a slider, or a journey in time.

use std::ops::Range;

use espalier_plant::{Appearance, MetamerId, Plant};
use glam::Vec3;

use crate::{foliage, radius_code::NOT_DRAWN, style::Style};

/// Rows in a chunk.
pub const CHUNK_ROWS: usize = 256;
/// Steps of a position in one internode.
pub const POSITION_STEPS: f32 = 256.0;

/// Light that changed by less is not reported: every shadow moves a little in every step, and nobody sees it.
const LIGHT_HYSTERESIS: u8 = 8;
/// The same for vigor, of 16 levels.
const VIGOR_HYSTERESIS: u8 = 2;

const NO_PARENT: u32 = u32::MAX;

/// What clients know of a plant.
#[derive(Clone, Debug, Default)]
pub struct RingTable {
    rows: Vec<Row>,
    generations: Vec<u32>,
    leaves: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Row {
    parent: u32,
    position: [i32; 3],
    radius: u16,
    foliage: u8,
    light: u8,
    starts_axis: bool,
}

/// What a [`RingTable::sync`] changed: first the truncation, then rows in ascending order by column, then what
/// was appended.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Changes {
    /// How many rows were kept, if some were dropped.
    pub truncated: Option<u32>,
    /// The rows that are new, those included that took the place of dropped ones.
    pub appended: Range<u32>,
    /// Kept rows that moved.
    pub position: Vec<u32>,
    /// Kept rows that thickened, died or came back to life.
    pub radius: Vec<u32>,
    /// Kept rows whose leaves or vigor changed.
    pub foliage: Vec<u32>,
    /// Kept rows whose light changed.
    pub light: Vec<u32>,
}

impl Changes {
    /// Whether nothing changed.
    pub fn is_empty(&self) -> bool {
        self.truncated.is_none()
            && self.appended.is_empty()
            && [&self.position, &self.radius, &self.foliage, &self.light].iter().all(|rows| rows.is_empty())
    }
}

impl RingTable {
    /// A table without rows.
    pub fn new() -> Self {
        Self::default()
    }

    /// How many rows there are.
    pub fn rows(&self) -> usize {
        self.rows.len()
    }

    /// For each chunk the generation in which it last changed.
    pub fn generations(&self) -> &[u32] {
        &self.generations
    }

    /// Leaves on all rows.
    pub fn leaves(&self) -> u32 {
        self.leaves
    }

    /// The row this one grows from; none for a seed.
    pub fn parent(&self, row: u32) -> Option<u32> {
        let parent = self.rows[row as usize].parent;
        (parent != NO_PARENT).then_some(parent)
    }

    /// Whether a row is the first wood of its axis.
    pub fn starts_axis(&self, row: u32) -> bool {
        self.rows[row as usize].starts_axis
    }

    /// Where a row's metamer ends, in steps of 1/[`POSITION_STEPS`] internode.
    pub fn position(&self, row: u32) -> [i32; 3] {
        self.rows[row as usize].position
    }

    /// The code of a row's radius (see [`crate::radius_code`]).
    pub fn radius(&self, row: u32) -> u16 {
        self.rows[row as usize].radius
    }

    /// Leaves in the low four bits, vigor in the high four.
    pub fn foliage(&self, row: u32) -> u8 {
        self.rows[row as usize].foliage
    }

    /// Exposure to light, 0 to 255.
    pub fn light(&self, row: u32) -> u8 {
        self.rows[row as usize].light
    }

    /// Makes the table show the present of `plant`; chunks that change get `generation`.
    ///
    /// Light and vigor that differ little from what the table shows stay as they are.
    pub fn sync(&mut self, plant: &Plant, style: &Style, generation: u32) -> Changes {
        let count = plant.metamer_count();
        let mut changes = Changes::default();
        let mut kept = self.rows.len().min(count);
        for index in 0..kept {
            let held = self.rows[index];
            let source = Source::read(plant, index);
            if (held.parent, held.starts_axis) != (source.parent, source.starts_axis) {
                // A row never changes its parent, so this is another future, and so is every later row.
                kept = index;
                break;
            }
            let row = source.row(style, Some(&held));
            if row != held {
                self.replace(index, row, generation, &mut changes);
            }
        }
        if kept < self.rows.len() {
            self.truncate(kept, generation);
            changes.truncated = Some(kept as u32);
        }
        self.rows.reserve(count - kept);
        for index in kept..count {
            self.append(Source::read(plant, index).row(style, None), generation);
        }
        changes.appended = kept as u32..count as u32;
        changes
    }

    fn replace(&mut self, index: usize, row: Row, generation: u32, changes: &mut Changes) {
        let held = std::mem::replace(&mut self.rows[index], row);
        let note = |differs: bool, rows: &mut Vec<u32>| {
            if differs {
                rows.push(index as u32);
            }
        };
        note(held.position != row.position, &mut changes.position);
        note(held.radius != row.radius, &mut changes.radius);
        note(held.foliage != row.foliage, &mut changes.foliage);
        note(held.light != row.light, &mut changes.light);
        self.leaves = self.leaves - held.leaf_count() + row.leaf_count();
        self.generations[index / CHUNK_ROWS] = generation;
    }

    fn truncate(&mut self, kept: usize, generation: u32) {
        for row in self.rows.drain(kept..) {
            self.leaves -= row.leaf_count();
        }
        self.generations.truncate(kept.div_ceil(CHUNK_ROWS));
        if !kept.is_multiple_of(CHUNK_ROWS) {
            // The last chunk lost some of its rows, and so it changed.
            self.generations[kept / CHUNK_ROWS] = generation;
        }
    }

    fn append(&mut self, row: Row, generation: u32) {
        if self.rows.len().is_multiple_of(CHUNK_ROWS) {
            self.generations.push(generation);
        }
        self.generations[self.rows.len() / CHUNK_ROWS] = generation;
        self.leaves += row.leaf_count();
        self.rows.push(row);
    }
}

impl Row {
    fn leaf_count(&self) -> u32 {
        u32::from(self.foliage & 0xf)
    }
}

/// What the plant says of one metamer.
struct Source {
    parent: u32,
    starts_axis: bool,
    end: Vec3,
    /// None for seeds and the dead.
    tips: Option<u32>,
    appearance: Appearance,
}

impl Source {
    fn read(plant: &Plant, index: usize) -> Self {
        let id = MetamerId::new(index);
        let metamers = plant.metamers();
        let parent = metamers.parent(id);
        let begins = |parent| plant.is_seed(parent) || metamers.axis(parent) != metamers.axis(id);
        Self {
            parent: parent.map_or(NO_PARENT, MetamerId::raw),
            starts_axis: parent.is_some_and(begins),
            end: metamers.end(id),
            tips: (parent.is_some() && plant.is_alive(id)).then(|| metamers.tips(id)),
            appearance: metamers.appearance(id),
        }
    }

    fn row(&self, style: &Style, held: Option<&Row>) -> Row {
        let Appearance { light, vigor } = self.appearance;
        let steady = |new: u8, held: Option<u8>, hysteresis: u8| match held {
            // What is not drawn keeps its looks: a change would only cost bytes.
            Some(held) if self.tips.is_none() || new.abs_diff(held) < hysteresis => held,
            _ => new,
        };
        let vigor = steady(vigor >> 4, held.map(|row| row.foliage >> 4), VIGOR_HYSTERESIS);
        let leaves = self.tips.map_or(0, |tips| foliage::leaves_of_living(tips, style));
        Row {
            parent: self.parent,
            position: self.end.to_array().map(quantise),
            radius: self.tips.map_or(NOT_DRAWN, |tips| style.radius_code(tips)),
            foliage: vigor << 4 | leaves,
            light: steady(light, held.map(|row| row.light), LIGHT_HYSTERESIS),
            starts_axis: self.starts_axis,
        }
    }
}

/// The nearest step; half-way cases go away from zero.
fn quantise(length: f32) -> i32 {
    let steps = length * POSITION_STEPS;
    (steps + 0.5_f32.copysign(steps)) as i32
}
