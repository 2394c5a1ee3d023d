//! The table of rings as frames, and figures as messages.

use std::ops::Range;

use espalier_mesh::{Changes, Dyes, RingTable, StyleOptions, radius_code, ring_table};
use espalier_plant::organs::MOST_ORGANS;
use espalier_proto::{
    ChunkChange, DocumentState, DyeColours, DyedBlock, Frame, Pause, Resume, Rows, ServerMessage, Values,
    frame::{self, CHUNK_ROWS, direction, light_level},
};
use espalier_settings::ParameterValues;

use crate::document::Figures;

// The mesh must not know the wire, so the two say these for themselves; here, where they meet, they must agree.
const _: () = assert!(
    ring_table::CHUNK_ROWS == CHUNK_ROWS
        && ring_table::POSITION_STEPS == frame::POSITION_STEPS
        && radius_code::MIN_RADIUS == frame::MIN_RADIUS
        && radius_code::LOG_STEP == frame::RADIUS_LOG_STEP
        && MOST_ORGANS == frame::MOST_ORGANS
);

/// Rows in a chunk, as row numbers are counted.
const CHUNK: u32 = CHUNK_ROWS as u32;

/// What a client holds that is not up to date.
#[derive(Debug)]
pub(crate) enum Held {
    /// No rows.
    Nothing,
    /// All of the table as it was then.
    AsOf {
        /// The last frame it was sent.
        sequence: u32,
        /// The rows it had then.
        rows: u32,
    },
    /// What a returning client says (`RS1`).
    Chunks(Resume),
}

/// The colours of branches as a message.
pub fn dyes(dyes: &Dyes) -> ServerMessage {
    let all = dyes.all().iter();
    let all =
        all.map(|dye| DyeColours { bark: dye.bark.to_array(), leaves: dye.leaves.to_array() }).collect();
    let mut blocks: Vec<DyedBlock> = Vec::new();
    let mut end = None;
    for run in dyes.runs() {
        let entry = [run.count, run.dye.into()];
        match blocks.last_mut().filter(|_| end == Some(run.first)) {
            Some(block) => block.runs.push(entry),
            None => blocks.push(DyedBlock { first: run.first, runs: vec![entry] }),
        }
        end = Some(run.first + run.count);
    }
    ServerMessage::Dyes { dyes: all, blocks }
}

/// What everybody in step is sent: from the table as it was to `table`, by `changes`.
pub fn delta(table: &RingTable, changes: &Changes, epoch: u32, sequence: u32) -> Frame {
    let mut list = Vec::new();
    if let Some(rows) = changes.truncated {
        list.push(ChunkChange::Truncate { rows });
    }
    let end = changes.appended.start;
    // Positions go first and upwards: every other position is read relative to its parent's new one.
    patches(&mut list, &changes.position, end, sequence, |of| {
        Values::Position(changes.position[of].iter().map(|&row| told_position(table, row)).collect())
    });
    patches(&mut list, &changes.radius, end, sequence, |of| {
        let before = &changes.former_radius[of.clone()];
        let by = |(&row, &before)| i32::from(table.radius(row)) - i32::from(before);
        Values::Radius(changes.radius[of].iter().zip(before).map(by).collect())
    });
    patches(&mut list, &changes.foliage, end, sequence, |of| {
        let before = &changes.former_foliage[of.clone()];
        let by = |(&row, &before)| table.foliage(row).wrapping_sub(before);
        Values::Foliage(changes.foliage[of].iter().zip(before).map(by).collect())
    });
    patches(&mut list, &changes.light, end, sequence, |of| {
        let before = &changes.former_light[of.clone()];
        let by = |(&row, &before)| light_level(table.light(row)) - light_level(before);
        Values::Light(changes.light[of].iter().zip(before).map(by).collect())
    });
    patches(&mut list, &changes.organs, end, sequence, |of| organs(table, &changes.organs[of]));
    let mut next = changes.appended.start;
    while next < changes.appended.end {
        let (chunk, start) = (next / CHUNK, next % CHUNK);
        let until = changes.appended.end.min((chunk + 1) * CHUNK);
        list.push(ChunkChange::Append { chunk, generation: sequence, start, rows: rows(table, next..until) });
        list.extend(organs_of(table, next..until, sequence));
        next = until;
    }
    Frame { epoch, sequence, catch_up: false, changes: list }
}

/// The whole table, as somebody gets it who joins (`FL2`).
pub fn whole(table: &RingTable, epoch: u32, sequence: u32) -> Frame {
    catch_up(table, &Held::Nothing, epoch, sequence)
}

/// What one client lacks of the table, made from the table alone (`FL2`, `RS1`).
pub(crate) fn catch_up(table: &RingTable, held: &Held, epoch: u32, sequence: u32) -> Frame {
    let total = table.rows() as u32;
    let mut changes = Vec::new();
    let held_rows = match held {
        Held::Nothing => 0,
        Held::AsOf { rows, .. } => *rows,
        Held::Chunks(resume) => resume.rows,
    };
    if held_rows > total {
        changes.push(ChunkChange::Truncate { rows: total });
    }
    for (chunk, &generation) in table.generations().iter().enumerate() {
        let current = match held {
            Held::Nothing => false,
            Held::AsOf { sequence, .. } => generation <= *sequence,
            Held::Chunks(resume) => resume.generations.get(chunk) == Some(&generation),
        };
        let first = chunk as u32 * CHUNK;
        let end = total.min(first + CHUNK);
        // A chunk that looks current but is cut short at the client cannot be: its rows would have a newer stamp.
        if !current || held_rows < end {
            let rows = rows(table, first..end);
            changes.push(ChunkChange::Replace { chunk: chunk as u32, generation, rows });
            changes.extend(organs_of(table, first..end, generation));
        }
    }
    Frame { epoch, sequence, catch_up: true, changes }
}

/// The document's figures for clients; `queued` steps belong to commands not begun yet.
pub(crate) fn state(
    figures: &Figures,
    leaves: u32,
    queued: u32,
    people: usize,
    paused: Option<Pause>,
) -> DocumentState {
    DocumentState {
        step: figures.step,
        age: figures.age,
        metamers: figures.metamers,
        axes: figures.axes,
        leaves,
        metamer_budget: figures.metamer_budget,
        budget_reached: figures.budget_reached,
        can_undo: figures.can_undo,
        can_redo: figures.can_redo,
        pending_steps: figures.pending_steps.saturating_add(queued),
        trials: figures.trials,
        people: people as u32,
        paused,
    }
}

/// The parameters that concern drawing alone.
pub fn style_options(parameters: &ParameterValues) -> StyleOptions {
    StyleOptions {
        girth_exponent: parameters.girth_exponent,
        twig_diameter: parameters.twig_diameter,
        leaves_per_node: u8::try_from(parameters.leaves_per_node).unwrap_or(u8::MAX),
        leaf_size: parameters.leaf_size,
    }
}

/// Patches of one column, chunk by chunk; rows from `end` on are left out, for they are appended whole. `values` are those
/// of some of the rows, by their places in `changed`.
fn patches(
    list: &mut Vec<ChunkChange>,
    changed: &[u32],
    end: u32,
    generation: u32,
    values: impl Fn(Range<usize>) -> Values,
) {
    let changed = &changed[..changed.partition_point(|&row| row < end)];
    let mut place = 0;
    for rows in changed.chunk_by(|a, b| a / CHUNK == b / CHUNK) {
        let of = place..place + rows.len();
        place = of.end;
        list.push(ChunkChange::Patch {
            chunk: rows[0] / CHUNK,
            generation,
            rows: rows.iter().map(|row| (row % CHUNK) as u8).collect(),
            values: values(of),
        });
    }
}

fn rows(table: &RingTable, range: Range<u32>) -> Rows {
    Rows {
        parent: range.clone().map(|row| parent_code(table, row)).collect(),
        position: range.clone().map(|row| told_position(table, row)).collect(),
        radius: range.clone().map(|row| table.radius(row)).collect(),
        foliage: range.clone().map(|row| table.foliage(row)).collect(),
        light: range.clone().map(|row| table.light(row)).collect(),
        born: range.map(|row| table.born(row)).collect(),
    }
}

/// The patch that gives rows of a chunk, which have just been told, their organs, if any has some.
fn organs_of(table: &RingTable, range: Range<u32>, generation: u32) -> Option<ChunkChange> {
    let chunk = range.start / CHUNK;
    let rows: Vec<u32> = range.filter(|&row| table.organs(row).is_some()).collect();
    let within = rows.iter().map(|row| (row % CHUNK) as u8).collect();
    let patch = || ChunkChange::Patch { chunk, generation, rows: within, values: organs(table, &rows) };
    (!rows.is_empty()).then(patch)
}

fn organs(table: &RingTable, rows: &[u32]) -> Values {
    let numbers =
        |row: &u32| table.organs(*row).map(|organs| organs.iter().map(|organ| organ.to_number()).collect());
    Values::Organs(rows.iter().map(numbers).collect())
}

fn parent_code(table: &RingTable, row: u32) -> u32 {
    table.parent(row).map_or(0, |parent| 2 * (row - parent) + u32::from(table.starts_axis(row)))
}

/// What is told of where a row's metamer ends (`FR10`).
fn told_position(table: &RingTable, row: u32) -> [i32; 3] {
    let below = table.parent(row).and_then(|parent| Some((parent, table.parent(parent)?)));
    let parents = below.map_or([0; 3], |(parent, below)| way(table, parent, below));
    let own = table.parent(row).map_or(table.position(row), |parent| way(table, row, parent));
    direction::tell(own, parents, !table.starts_axis(row))
}

/// From where one row ends to where another one does.
fn way(table: &RingTable, to: u32, from: u32) -> [i32; 3] {
    let (to, from) = (table.position(to), table.position(from));
    std::array::from_fn(|axis| to[axis].wrapping_sub(from[axis]))
}
