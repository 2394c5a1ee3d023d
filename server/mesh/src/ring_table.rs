//! The table of rings that clients mirror: one quantised row per metamer, in birth order.
//!
//! The table holds what clients were sent. [`RingTable::sync`] compares it with the plant in one pass and says
//! what differs, so it does not matter what happened in between: growth, a slider, or a journey in time.
//!
//! Rows are held as the plant has them and quantised when they are read. So a chunk that stayed as it was is
//! known by its plain columns, which compare many rows at once. Only while width constraints hold, the codes of
//! radii are held as well, for then tips alone do not tell them.

mod changes;
mod detail;
mod organs;

use std::ops::Range;

use espalier_plant::{AxisId, Columns, Condition, MetamerId, Organs, Plant, Widths, reserve};
use glam::Vec3;

use self::organs::ToldOrgans;
pub use self::{
    changes::Changes,
    detail::{Detail, seen},
    organs::told,
};
use crate::{
    foliage,
    radius_code::{self, NOT_DRAWN},
    style::Style,
};

/// Rows in a chunk.
pub const CHUNK_ROWS: usize = 256;
/// Steps of a position in one internode.
pub const POSITION_STEPS: f32 = 256.0;

/// The link of a seed.
const NO_LINK: u32 = u32::MAX;
/// In place of the tips of what is not drawn: seeds and the dead.
const NO_TIPS: u32 = u32::MAX;

/// What clients know of a plant.
#[derive(Clone, Debug, Default)]
pub struct RingTable {
    /// Twice the parent's row, and one more if the row starts its axis.
    links: Vec<u32>,
    axes: Vec<AxisId>,
    ends: Vec<Vec3>,
    /// Tips that are drawn.
    tips: Vec<u32>,
    /// light and vigor as they were sent.
    looks: Vec<Condition>,
    /// Codes of radii as they were sent, if width constraints held; empty otherwise.
    radii: Vec<u16>,
    /// Organs given as they were sent.
    organs: ToldOrgans,
    /// For each number of steps of growth, how many rows had been born by then.
    births: Vec<u32>,
    /// What tips look like.
    style: Style,
    generations: Vec<u32>,
    leaves: u32,
}

impl RingTable {
    /// A table without rows.
    pub fn new() -> Self {
        Self::default()
    }

    /// How many rows there are.
    pub fn rows(&self) -> usize {
        self.links.len()
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
        let link = self.links[row as usize];
        (link != NO_LINK).then_some(link >> 1)
    }

    /// Whether a row is the first wood of its axis.
    pub fn starts_axis(&self, row: u32) -> bool {
        let link = self.links[row as usize];
        link != NO_LINK && link & 1 == 1
    }

    /// Where a row's metamer ends, in steps of 1/[`POSITION_STEPS`] internode.
    pub fn position(&self, row: u32) -> [i32; 3] {
        quantised(self.ends[row as usize])
    }

    /// The code of a row's radius (see [`crate::radius_code`]).
    pub fn radius(&self, row: u32) -> u16 {
        match self.radii.get(row as usize) {
            Some(&code) => code,
            None => radius(self.tips[row as usize], &self.style),
        }
    }

    /// Leaves in the low four bits, vigor in the high four.
    pub fn foliage(&self, row: u32) -> u8 {
        let row = row as usize;
        self.looks[row].vigor | leaves(self.tips[row], self.organs_of(row), &self.style)
    }

    /// The organs that a row is given; none where it bears what grows on such wood.
    pub fn organs(&self, row: u32) -> Option<&Organs> {
        self.organs_of(row as usize)
    }

    fn organs_of(&self, row: usize) -> Option<&Organs> {
        self.organs.of(row)
    }

    /// Exposure to light, 0 to 255.
    pub fn light(&self, row: u32) -> u8 {
        self.looks[row as usize].light
    }

    /// Steps of growth up to the birth of a row's metamer, that step included.
    pub fn born(&self, row: u32) -> u32 {
        self.births.partition_point(|&rows| rows <= row) as u32
    }

    /// Makes the table show the present of `plant`; chunks that change get `generation`.
    ///
    /// Light and vigor are shown in [few levels](seen).
    pub fn sync(&mut self, plant: &Plant, style: &Style, generation: u32) -> Changes {
        self.sync_in(Detail::Whole, plant, style, generation)
    }

    /// The same in less detail: what older wood looks like may stay behind the plant, but not where it is and whether it
    /// lives. A later call in more detail makes up for it. Another style and width constraints are shown whole at once.
    pub fn sync_in(&mut self, detail: Detail, plant: &Plant, style: &Style, generation: u32) -> Changes {
        let restyled = *style.options() != *self.style.options();
        let former = restyled.then(|| std::mem::replace(&mut self.style, style.clone()));
        let widths = Widths::of(plant, style.girth());
        let is_constrained = !widths.follow_from_tips();
        let mut pass = Pass {
            plant,
            all: plant.columns(0..plant.metamer_count()),
            style,
            former: former.as_ref(),
            detail,
            radii: Vec::new(),
            bears: !(plant.organs().is_empty() && self.organs.is_empty()),
            renumbered: false,
            changes: Changes::default(),
        };
        if is_constrained || !self.radii.is_empty() {
            pass.radii = pass.radii(&widths);
            if self.radii.is_empty() {
                let sent_style = pass.former.unwrap_or(style);
                self.radii = self.tips.iter().map(|&tips| radius(tips, sent_style)).collect();
            }
        }
        if pass.former.is_some() || !pass.radii.is_empty() {
            pass.detail = Detail::Whole;
        }
        let (count, births) = (plant.metamer_count(), plant.births());
        let known = self.same_births(&births, self.rows().min(count));
        let mut kept = 0;
        while kept < known {
            let chunk = kept..(kept + CHUNK_ROWS).min(known);
            let same = self.match_links(&mut pass, chunk.clone());
            if self.update(&mut pass, chunk.start..same) {
                self.generations[chunk.start / CHUNK_ROWS] = generation;
            }
            kept = same;
            if same < chunk.end {
                // A row never changes its parent, so this is another future, and so is every later row.
                break;
            }
        }
        if kept < self.rows() {
            self.truncate(kept, pass.former.unwrap_or(style), generation);
            pass.changes.truncated = Some(kept as u32);
        }
        self.append(&pass, kept..count, generation);
        self.births = births;
        pass.changes.appended = kept as u32..count as u32;
        // By now all rows are those of the plant.
        self.radii = if is_constrained { pass.radii } else { Vec::new() };
        pass.changes
    }

    /// The first row, up to `known`, that was born elsewhere in another line of time.
    fn same_births(&self, births: &[u32], known: usize) -> usize {
        let by_then =
            |births: &[u32], step: usize| births.get(step).map_or(known, |&rows| known.min(rows as usize));
        let steps = 0..births.len().max(self.births.len());
        let differing = steps.map(|step| (by_then(&self.births, step), by_then(births, step)));
        differing
            .filter(|(held, present)| held != present)
            .map(|(held, present)| held.min(present))
            .next()
            .unwrap_or(known)
    }

    /// The first row of a chunk that has another link in the plant, or the chunk's end.
    fn match_links(&mut self, pass: &mut Pass<'_>, rows: Range<usize>) -> usize {
        let (links, axes) = (&self.links[rows.clone()], &mut self.axes[rows.clone()]);
        let present = pass.plant.columns(rows.clone());
        let mut differs = u32::from(pass.renumbered);
        for (link, parent) in links.iter().zip(present.parent) {
            // The sign is kept, so that the link of a seed is halved to that of no parent.
            differs |= (*link as i32 >> 1) as u32 ^ parent.raw();
        }
        for (axis, present) in axes.iter().zip(present.axis) {
            differs |= axis.raw() ^ present.raw();
        }
        if differs == 0 {
            return rows.end;
        }
        let same = rows.clone().zip(links).take_while(|(row, link)| **link == pass.link(*row)).count();
        // The same wood may have axes of other numbers; then what follows cannot be known by its number.
        pass.renumbered = true;
        axes[..same].copy_from_slice(&present.axis[..same]);
        rows.start + same
    }

    /// Takes over what may change in some rows of a chunk; returns whether clients will see anything of it.
    fn update(&mut self, pass: &mut Pass<'_>, rows: Range<usize>) -> bool {
        let moved = self.update_ends(pass, rows.clone());
        let is_as_wide = pass.radii.is_empty() || self.radii[rows.clone()] == pass.radii[rows.clone()];
        let redrawn = if pass.former.is_none() && is_as_wide {
            let mut differing = self.drawn_otherwise(pass.plant, pass.detail, rows.clone());
            if pass.detail == Detail::Coarse {
                self.keep_what_differs_little(pass, rows.start, &mut differing);
            }
            if pass.bears {
                self.mark_other_organs(pass, rows.start, &mut differing[..rows.len()]);
            }
            self.update_drawing(pass, rows.start, marked(&differing))
        } else {
            self.update_drawing(pass, rows.start, 0..rows.len())
        };
        moved || redrawn
    }

    fn update_ends(&mut self, pass: &mut Pass<'_>, rows: Range<usize>) -> bool {
        let (held, present) = (&mut self.ends[rows.clone()], pass.plant.columns(rows.clone()).end);
        let bits = |end: &Vec3| end.to_array().map(f32::to_bits);
        let mut differs = 0;
        for (held, present) in held.iter().zip(present) {
            let ([x, y, z], [present_x, present_y, present_z]) = (bits(held), bits(present));
            differs |= (x ^ present_x) | (y ^ present_y) | (z ^ present_z);
        }
        if differs == 0 {
            return false;
        }
        let before = pass.changes.position.len();
        for ((row, held), present) in rows.zip(held).zip(present) {
            if quantised(*held) != quantised(*present) {
                pass.changes.position.push(row as u32);
            }
            *held = *present;
        }
        pass.changes.position.len() > before
    }

    /// Marks those rows of a chunk that are drawn so differently that clients have to be sent them.
    fn drawn_otherwise(&self, plant: &Plant, detail: Detail, rows: Range<usize>) -> [u8; CHUNK_ROWS] {
        let present = plant.columns(rows.clone());
        let now = plant.step();
        let (mut drawn, mut differing) = ([0; CHUNK_ROWS], [0; CHUNK_ROWS]);
        for (drawn, &parent) in drawn.iter_mut().zip(present.parent) {
            *drawn = u8::from(parent != Columns::NO_PARENT);
        }
        for (drawn, &death) in drawn.iter_mut().zip(present.death) {
            *drawn &= u8::from(death > now);
        }
        if detail == Detail::Form {
            for ((differs, drawn), &held) in differing.iter_mut().zip(drawn).zip(&self.tips[rows]) {
                *differs = u8::from(held == NO_TIPS) ^ drawn ^ 1;
            }
            return differing;
        }
        let tips = self.tips[rows.clone()].iter().zip(present.tips);
        for ((differs, drawn), (&held, &tips)) in differing.iter_mut().zip(drawn).zip(tips) {
            *differs = u8::from(held != if drawn != 0 { tips } else { NO_TIPS });
        }
        let (light_step, vigor_step) = detail.steps();
        let looks = self.looks[rows].iter().zip(present.condition);
        for ((differs, drawn), (held, &look)) in differing.iter_mut().zip(drawn).zip(looks) {
            let look = seen(look);
            let light = look.light.abs_diff(held.light) >= light_step;
            let vigor = look.vigor.abs_diff(held.vigor) >= vigor_step;
            *differs |= drawn & u8::from(light | vigor);
        }
        differing
    }

    /// Takes back the mark of rows whose girth alone differs, and not by much.
    fn keep_what_differs_little(&self, pass: &Pass<'_>, first: usize, differing: &mut [u8; CHUNK_ROWS]) {
        let (light_step, vigor_step) = Detail::Coarse.steps();
        for (i, differs) in differing.iter_mut().enumerate().filter(|(_, differs)| **differs != 0) {
            let row = first + i;
            let (held_tips, tips) = (self.tips[row], pass.tips(row));
            let (held, look) = (self.looks[row], seen(pass.all.condition[row]));
            let looks_otherwise = look.light.abs_diff(held.light) >= light_step
                || look.vigor.abs_diff(held.vigor) >= vigor_step;
            let is_as_drawn = (held_tips == NO_TIPS) == (tips == NO_TIPS);
            let widths = radius(held_tips, pass.style).abs_diff(radius(tips, pass.style));
            let organs = self.organs_of(row);
            let as_leafy = leaves(held_tips, organs, pass.style) == leaves(tips, organs, pass.style);
            *differs =
                u8::from(looks_otherwise || !is_as_drawn || widths >= detail::COARSE_RADIUS || !as_leafy);
        }
    }

    /// Marks rows that are given other organs.
    fn mark_other_organs(&self, pass: &Pass<'_>, first: usize, differing: &mut [u8]) {
        for (row, differs) in (first..).zip(differing) {
            *differs |= u8::from(self.organs.is_stale(pass.plant, row));
        }
    }

    /// Takes over how some rows are drawn, given by how far they lie behind `first`; returns whether clients will see
    /// anything of it.
    fn update_drawing(
        &mut self,
        pass: &mut Pass<'_>,
        first: usize,
        rows: impl Iterator<Item = usize>,
    ) -> bool {
        let style = pass.style;
        let former = pass.former.unwrap_or(style);
        let mut changes = false;
        for row in rows.map(|i| first + i) {
            let (held_tips, tips) = (self.tips[row], pass.tips(row));
            let held = self.looks[row];
            // What is not drawn keeps its looks: a change would only cost bytes.
            let look = if tips == NO_TIPS { held } else { seen(pass.all.condition[row]) };
            let organs = pass.organs(row);
            let held_leaves = leaves(held_tips, self.organs_of(row), former);
            let leaves = leaves(tips, organs, style);
            if pass.bears && self.organs.follow(pass.plant, row) {
                pass.changes.organs.push(row as u32);
                changes = true;
            }
            let (held_radius, radius) = match pass.radii.get(row) {
                Some(&code) => (self.radii[row], code),
                None => (radius(held_tips, former), radius(tips, style)),
            };
            self.tips[row] = tips;
            self.looks[row] = look;
            self.leaves = self.leaves - u32::from(held_leaves) + u32::from(leaves);
            if held_radius != radius {
                pass.changes.radius.push(row as u32);
                pass.changes.former_radius.push(held_radius);
                changes = true;
            }
            if (held_leaves, held.vigor) != (leaves, look.vigor) {
                pass.changes.foliage.push(row as u32);
                pass.changes.former_foliage.push(held.vigor | held_leaves);
                changes = true;
            }
            if held.light != look.light {
                pass.changes.light.push(row as u32);
                pass.changes.former_light.push(held.light);
                changes = true;
            }
        }
        changes
    }

    fn truncate(&mut self, kept: usize, sent_style: &Style, generation: u32) {
        self.leaves -= self.all_leaves(kept..self.rows(), sent_style);
        self.organs.truncate(kept);
        self.links.truncate(kept);
        self.axes.truncate(kept);
        self.ends.truncate(kept);
        self.tips.truncate(kept);
        self.looks.truncate(kept);
        self.generations.truncate(kept.div_ceil(CHUNK_ROWS));
        if !kept.is_multiple_of(CHUNK_ROWS) {
            // The last chunk lost some of its rows, and so it changed.
            self.generations[kept / CHUNK_ROWS] = generation;
        }
    }

    fn append(&mut self, pass: &Pass<'_>, rows: Range<usize>, generation: u32) {
        let new = pass.plant.columns(rows.clone());
        reserve(&mut self.links, rows.len());
        reserve(&mut self.axes, rows.len());
        reserve(&mut self.ends, rows.len());
        reserve(&mut self.tips, rows.len());
        reserve(&mut self.looks, rows.len());
        self.links.extend(rows.clone().map(|row| pass.link(row)));
        self.axes.extend_from_slice(new.axis);
        self.ends.extend_from_slice(new.end);
        self.tips.extend(rows.clone().map(|row| pass.tips(row)));
        self.looks.extend(new.condition.iter().copied().map(seen));
        if pass.bears {
            for row in rows.clone() {
                self.organs.follow(pass.plant, row);
            }
        }
        self.leaves += self.all_leaves(rows.clone(), pass.style);
        if !rows.is_empty() {
            self.generations.truncate(rows.start / CHUNK_ROWS);
            self.generations.resize(rows.end.div_ceil(CHUNK_ROWS), generation);
        }
    }

    fn all_leaves(&self, rows: Range<usize>, style: &Style) -> u32 {
        rows.map(|row| u32::from(leaves(self.tips[row], self.organs_of(row), style))).sum()
    }
}

/// A plant on the way into the table.
struct Pass<'a> {
    plant: &'a Plant,
    all: Columns<'a>,
    style: &'a Style,
    /// The style before, if it is another now.
    former: Option<&'a Style>,
    /// The codes of all radii, if width constraints hold or held; empty otherwise.
    radii: Vec<u16>,
    /// How much is shown.
    detail: Detail,
    /// Whether any row is given organs, or was.
    bears: bool,
    /// Whether rows that stayed as they were have other axes by number.
    renumbered: bool,
    changes: Changes,
}

impl Pass<'_> {
    fn link(&self, row: usize) -> u32 {
        let Columns { parent, axis, .. } = self.all;
        if parent[row] == Columns::NO_PARENT {
            return NO_LINK;
        }
        let below = parent[row].index();
        let starts_axis = parent[below] == Columns::NO_PARENT || axis[below] != axis[row];
        2 * below as u32 + u32::from(starts_axis)
    }

    fn tips(&self, row: usize) -> u32 {
        let Columns { parent, tips, .. } = self.all;
        let is_drawn = parent[row] != Columns::NO_PARENT && self.all.lives(row, self.plant.step());
        if is_drawn { tips[row] } else { NO_TIPS }
    }

    fn organs(&self, row: usize) -> Option<&Organs> {
        if self.bears { self.plant.organs().of(row)?.as_ref() } else { None }
    }

    fn radii(&self, widths: &Widths<'_>) -> Vec<u16> {
        let code = |row| match (self.tips(row), widths.log_radius(MetamerId::new(row))) {
            (NO_TIPS, _) => NOT_DRAWN,
            (_, Some(log)) => radius_code::encode_log(log),
            (tips, None) => self.style.radius_code(tips),
        };
        (0..self.all.parent.len()).map(code).collect()
    }
}

/// Which rows of a chunk are marked, in ascending order. Mostly few are, so eight are passed over at once.
fn marked(marks: &[u8; CHUNK_ROWS]) -> impl Iterator<Item = usize> + '_ {
    let words = marks.as_chunks::<8>().0.iter().map(|bytes| u64::from_le_bytes(*bytes));
    words.enumerate().flat_map(|(word, mut left)| {
        std::iter::from_fn(move || {
            let bit = (left != 0).then(|| left.trailing_zeros() as usize)?;
            left &= left - 1;
            Some(word * 8 + bit / 8)
        })
    })
}

fn radius(tips: u32, style: &Style) -> u16 {
    if tips == NO_TIPS { NOT_DRAWN } else { style.radius_code(tips) }
}

fn leaves(tips: u32, organs: Option<&Organs>, style: &Style) -> u8 {
    if tips == NO_TIPS { 0 } else { foliage::leaves_of_living(tips, organs, style) }
}

fn quantised(place: Vec3) -> [i32; 3] {
    place.to_array().map(quantise)
}

/// The nearest step; half-way cases go away from zero.
fn quantise(length: f32) -> i32 {
    let steps = length * POSITION_STEPS;
    (steps + 0.5_f32.copysign(steps)) as i32
}
