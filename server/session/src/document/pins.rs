//! Places on the wood that comments are pinned to, found again whatever became of the wood (`CT`).
//!
//! A metamer is known by the line of time on which it was born, its row there, the step of its birth, and its way from
//! the seed. On lines that share that step it is the same one. Where it is dead, or on none of the lines, those below
//! it say where it was.

use espalier_plant::{AxisId, MetamerId, hash::StableHash};
use espalier_proto::comment::PinState;
use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::{
    Document,
    history::{Kind, Operation},
};

/// The most metamers below one that are kept: those 1, 2, 4 … 128 below.
const MOST_BELOW: u32 = 8;
/// Wood of another line stands for what was there if it is so near, in internode lengths.
const REGROWN_WITHIN: f32 = 3.0;

/// A metamer as it is found again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Knot {
    row: u32,
    born: u32,
    /// Its way from the seed.
    way: u64,
}

/// A place on the wood: a metamer, and some of those below it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Anchor {
    /// The line of time.
    line: u32,
    knot: Knot,
    /// Those below, the nearest first.
    below: Vec<Knot>,
}

/// What became of a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Whereabouts {
    /// How it is.
    pub state: PinState,
    /// Its row, or that of the nearest living metamer below.
    pub row: Option<u32>,
    /// The step at which it is seen,
    pub step: Option<u32>,
    /// and the line.
    pub line: Option<u32>,
}

impl Whereabouts {
    fn at(state: PinState, row: Option<MetamerId>) -> Self {
        Self { state, row: row.map(MetamerId::raw), step: None, line: None }
    }
}

/// Whether a metamer that is on no line known here is looked for among all others, which takes a pass over them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Search {
    /// It is.
    Everywhere,
    /// It is not.
    KnownPlaces,
}

impl Document {
    /// The place of a metamer, if it lives.
    pub fn anchor(&self, row: u32) -> Option<Anchor> {
        let plant = self.plant();
        let id = self.row(row).filter(|id| plant.is_alive(*id) && !plant.is_seed(*id))?;
        let mut below = Vec::new();
        let (mut at, mut passed) = (id, 0);
        while let Some(parent) = plant.metamers().parent(at).filter(|_| below.len() < MOST_BELOW as usize) {
            (at, passed) = (parent, passed + 1);
            if passed == 1 << below.len() {
                below.push(self.knot(at));
            }
        }
        Some(Anchor { line: self.futures.present, knot: self.knot(id), below })
    }

    /// What became of a place that lay there when it was noted.
    pub fn whereabouts(&self, anchor: &Anchor, place: Vec3, search: Search) -> Whereabouts {
        let plant = self.plant();
        let shared = self.futures.shared_with(anchor.line);
        let knot = anchor.knot;
        // A line that is not known here may be the present one under an earlier number: files do not keep the others.
        let is_of_line = shared.is_none_or(|step| knot.born <= step);
        if is_of_line && (plant.step() + 1..=plant.last_step()).contains(&knot.born) {
            let not_yet = Whereabouts::at(PinState::NotYet, self.living_below(anchor, shared));
            return Whereabouts { step: Some(knot.born), ..not_yet };
        }
        if let Some(id) = self.found(knot, shared) {
            if plant.is_alive(id) {
                return Whereabouts::at(PinState::Standing, Some(id));
            }
            if let Some(moved) = self.moved_to(id) {
                return Whereabouts::at(PinState::Standing, Some(moved));
            }
            return Whereabouts::at(PinState::Detached, self.living_from(id));
        }
        if search == Search::Everywhere
            && let Some(id) = self.like(knot.way).filter(|id| self.is_near(*id, place))
        {
            return Whereabouts::at(PinState::Regrown, Some(id));
        }
        let below = self.living_below(anchor, shared);
        match shared {
            Some(step) if knot.born > step => Whereabouts {
                step: Some(knot.born),
                line: Some(anchor.line),
                ..Whereabouts::at(PinState::Elsewhere, below)
            },
            Some(_) | None => Whereabouts::at(PinState::Detached, below),
        }
    }

    fn row(&self, row: u32) -> Option<MetamerId> {
        ((row as usize) < self.plant().metamer_count()).then(|| MetamerId::new(row as usize))
    }

    fn knot(&self, id: MetamerId) -> Knot {
        Knot { row: id.raw(), born: self.plant().birth(id), way: self.way(id) }
    }

    /// The very metamer, where it is on the present line; `shared` is the last step that this has with its own.
    fn found(&self, knot: Knot, shared: Option<u32>) -> Option<MetamerId> {
        let id = self.row(knot.row).filter(|_| shared.is_none_or(|step| knot.born <= step))?;
        (self.plant().birth(id) == knot.born && self.way(id) == knot.way).then_some(id)
    }

    /// The nearest living metamer below a place.
    fn living_below(&self, anchor: &Anchor, shared: Option<u32>) -> Option<MetamerId> {
        anchor.below.iter().find_map(|knot| self.found(*knot, shared)).and_then(|id| self.living_from(id))
    }

    /// The first living one from a metamer down.
    fn living_from(&self, id: MetamerId) -> Option<MetamerId> {
        let plant = self.plant();
        std::iter::successors(Some(id), |id| plant.metamers().parent(*id)).find(|id| plant.is_alive(*id))
    }

    /// The way from the seed, as a number that every metamer has for itself.
    fn way(&self, id: MetamerId) -> u64 {
        let plant = self.plant();
        let mut turns = Vec::new();
        let mut at = id;
        while let Some(parent) = plant.metamers().parent(at) {
            turns.push(self.turn(at, parent));
            at = parent;
        }
        let start = self.start(at);
        turns.into_iter().rev().fold(start, on)
    }

    /// How a metamer leaves the one below: 0 goes on, others branch off.
    fn turn(&self, id: MetamerId, parent: MetamerId) -> u64 {
        let plant = self.plant();
        let axis = plant.metamers().axis(id);
        if !plant.is_seed(parent) && plant.metamers().axis(parent) == axis {
            return 0;
        }
        let place = plant.laterals(parent).position(|lateral: AxisId| lateral == axis);
        place.map_or(0, |place| place as u64 + 1)
    }

    fn start(&self, seed: MetamerId) -> u64 {
        let mut hash = StableHash::default();
        hash.vector(self.plant().metamers().end(seed));
        hash.finish()
    }

    /// A living metamer to which the same way leads.
    fn like(&self, way: u64) -> Option<MetamerId> {
        let plant = self.plant();
        let mut ways: Vec<u64> = Vec::with_capacity(plant.metamer_count());
        let mut found = None;
        for row in 0..plant.metamer_count() {
            let id = MetamerId::new(row);
            let own = match plant.metamers().parent(id) {
                Some(parent) => on(ways[parent.index()], self.turn(id, parent)),
                None => self.start(id),
            };
            ways.push(own);
            if own == way && plant.is_alive(id) {
                found = Some(id);
            }
        }
        found
    }

    fn is_near(&self, id: MetamerId, place: Vec3) -> bool {
        self.plant().metamers().end(id).distance(place) <= REGROWN_WITHIN
    }

    /// Where a dead metamer was moved to, if that is what became of it: a graft that moves wood copies it row by row and
    /// cuts it where it was.
    fn moved_to(&self, id: MetamerId) -> Option<MetamerId> {
        let plant = self.plant();
        let all = plant.columns(0..plant.metamer_count());
        let death = *all.death.get(id.index())?;
        let is_it = |one: &&Operation| one.kind == Kind::Graft && (one.first + 1..=one.last).contains(&death);
        let graft = self.history.operations[..self.history.done].iter().find(is_it)?;
        let steps = graft.first + 1..=graft.last;
        let gone: Vec<usize> = (0..all.death.len()).filter(|row| steps.contains(&all.death[*row])).collect();
        let came: Vec<MetamerId> = (0..plant.metamer_count())
            .map(MetamerId::new)
            .filter(|id| steps.contains(&plant.birth(*id)))
            .collect();
        let place = gone.iter().position(|row| *row == id.index()).filter(|_| gone.len() == came.len())?;
        came.get(place).copied().filter(|id| plant.is_alive(*id))
    }
}

fn on(way: u64, turn: u64) -> u64 {
    let mut hash = StableHash::default();
    hash.word(way);
    hash.word(turn);
    hash.finish()
}
