//! Parts of an operation in which several people drew at once: whose its wood is, so that each takes back their own.

use std::ops::Range;

use espalier_growth::{Share, StrokeId};
use espalier_plant::{Plant, hash::StableHash};

use super::history::Operation;
use crate::principal::Principal;

/// Parts of one operation at most: which of them are away is kept in the bits of a number.
pub(super) const MAX_PARTS: usize = 64;

/// Metamers born one after the other, from the first to that of the next run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Run {
    pub first: u32,
    /// The part they belong to.
    pub part: u8,
    /// Whether a hand drew them, rather than that they grew by themselves.
    pub by_hand: bool,
}

/// Strokes of one person that overlap one another are one part, and so are the lassos and the growth that they ask for
/// meanwhile. The first part is that of the operation's author; while it is the only one nothing is kept.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Parts {
    /// Whose the parts after the first are.
    pub others: Vec<Principal>,
    /// The strokes of each part, in the order in which they began.
    pub strokes: Vec<(StrokeId, u8)>,
    /// Whose the metamers are, from the first that is not of the first part for certain.
    pub runs: Vec<Run>,
    /// What grows by itself or into a lasso is of this part, and whether a hand drew it.
    pub asked: (u8, bool),
}

/// A set of parts of an operation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct PartSet(u64);

impl PartSet {
    pub fn holds(self, part: u8) -> bool {
        self.0 >> part & 1 > 0
    }

    pub fn put(&mut self, part: u8, is_in: bool) {
        self.0 = self.0 & !(1 << part) | u64::from(is_in) << part;
    }
}

impl Parts {
    pub fn count(&self) -> usize {
        1 + self.others.len()
    }

    pub fn hash(&self, hash: &mut StableHash) {
        for run in &self.runs {
            hash.word(u64::from(run.first) | u64::from(run.part) << 32 | u64::from(run.by_hand) << 40);
        }
    }

    fn of_stroke(&self, stroke: StrokeId) -> Option<u8> {
        self.strokes.iter().find(|(known, _)| *known == stroke).map(|&(_, part)| part)
    }
}

impl Operation {
    /// Whose a part is.
    pub(super) fn author_of(&self, part: u8) -> &Principal {
        usize::from(part)
            .checked_sub(1)
            .and_then(|other| self.parts.others.get(other))
            .unwrap_or(&self.author)
    }

    /// Everybody who did some of it.
    pub(super) fn authors(&self) -> impl Iterator<Item = &Principal> {
        std::iter::once(&self.author).chain(&self.parts.others)
    }

    /// The parts of somebody, the last first.
    pub(super) fn parts_of<'a>(&'a self, author: &'a Principal) -> impl Iterator<Item = u8> + 'a {
        self.parts_where(move |of| of == author)
    }

    /// The parts of those for whom something is so, the last first.
    pub(super) fn parts_where(&self, is_theirs: impl Fn(&Principal) -> bool) -> impl Iterator<Item = u8> {
        (0..self.parts.count() as u8).rev().filter(move |&part| is_theirs(self.author_of(part)))
    }

    /// Whether all parts are in a set.
    pub(super) fn is_all_in(&self, set: PartSet) -> bool {
        (0..self.parts.count() as u8).all(|part| set.holds(part))
    }

    /// A stroke of somebody takes part from now on. `overlaps` is a stroke of theirs that is still in progress.
    pub(super) fn join(&mut self, author: &Principal, stroke: StrokeId, overlaps: Option<StrokeId>) {
        if self.parts.of_stroke(stroke).is_some() {
            return;
        }
        let part = match overlaps.and_then(|other| self.parts.of_stroke(other)) {
            Some(part) => part,
            // Of the author's first stroke nothing is noted until somebody joins in.
            None if overlaps.is_some() && self.author == *author => 0,
            None => self.another_part(author),
        };
        self.parts.strokes.push((stroke, part));
    }

    /// A stroke of somebody goes on in an operation that it may not have begun in.
    pub(super) fn resume(&mut self, author: &Principal, stroke: StrokeId) {
        if self.author == *author || self.parts.of_stroke(stroke).is_some() {
            return;
        }
        let known = self.parts_of(author).next();
        let part = known.unwrap_or_else(|| self.another_part(author));
        self.parts.strokes.push((stroke, part));
    }

    /// Somebody asks for growth or a lasso within the operation.
    pub(super) fn ask(&mut self, author: &Principal, by_hand: bool) {
        let known = self.parts_of(author).next();
        let part = known.unwrap_or_else(|| self.another_part(author));
        self.parts.asked = (part, by_hand);
    }

    fn another_part(&mut self, author: &Principal) -> u8 {
        if self.parts.count() == MAX_PARTS {
            return self.parts_of(author).next().unwrap_or(0);
        }
        self.is_joint |= self.author != *author;
        self.parts.others.push(author.clone());
        self.parts.others.len() as u8
    }

    /// Metamers are born: of a step that a stroke guided, or of one that was asked for.
    pub(super) fn note_births(&mut self, born: Range<u32>, guide: Option<StrokeId>, shares: &[Share]) {
        if self.parts.count() == 1 || born.is_empty() {
            return;
        }
        let (part, by_hand) = self.parts.asked;
        let asked = |first| Run { first, part, by_hand };
        let drawn = |first, stroke| match self.parts.of_stroke(stroke) {
            Some(part) => Run { first, part, by_hand: true },
            None => Run { first, part: 0, by_hand: true },
        };
        let of = |first, stroke: Option<StrokeId>| {
            stroke.map_or_else(|| asked(first), |stroke| drawn(first, stroke))
        };
        let runs: Vec<Run> = if shares.is_empty() {
            vec![of(born.start, guide)]
        } else {
            shares.iter().map(|share| of(share.first.raw(), share.stroke.or(guide))).collect()
        };
        for run in runs {
            let last = self.parts.runs.last();
            if last.is_none_or(|last| (last.part, last.by_hand) != (run.part, run.by_hand)) {
                self.parts.runs.push(run);
            }
        }
    }

    /// The metamers that were born in it.
    pub(super) fn born(&self, plant: &Plant) -> Range<u32> {
        plant.born_by(self.first)..plant.born_by(self.last)
    }

    /// Whose the metamers of a range are that were born in it.
    pub(super) fn runs_of(&self, born: Range<u32>) -> Vec<(Range<u32>, Run)> {
        if self.parts.count() == 1 {
            return Vec::new();
        }
        let first = Run { first: 0, part: 0, by_hand: true };
        let runs = std::iter::once(&first).chain(&self.parts.runs);
        let ends = self.parts.runs.iter().map(|run| run.first).chain([u32::MAX]);
        let clipped = runs.zip(ends).map(|(run, end)| (run.first.max(born.start)..end.min(born.end), *run));
        clipped.filter(|(rows, _)| !rows.is_empty()).collect()
    }
}
