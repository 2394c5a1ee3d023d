//! Places on the wood that comments are pinned to, found again whatever became of the wood (`CT`).
//!
//! A metamer is known by the line of time on which it was born, its row there, the step of its birth, and its way from
//! the seed. On lines that share that step it is the same one. Where it is dead, or on none of the lines, those below
//! it say where it was.

use std::collections::{BTreeMap, BTreeSet};

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

/// Whether metamers that are on no line known here are looked for among all others, which takes a pass over those.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Search {
    /// They are.
    Everywhere,
    /// They are not.
    KnownPlaces,
}

/// What is known of a place without looking at all of the tree.
#[derive(Clone, Copy, Debug)]
enum Known {
    Whereabouts(Whereabouts),
    /// This is it, and it is dead, or was moved.
    Dead(MetamerId),
    /// It is on none of the lines.
    Lost,
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

    /// What became of places that lay there when they were noted, in their order.
    pub fn whereabouts<'a>(
        &self,
        pins: impl IntoIterator<Item = (&'a Anchor, Vec3)>,
        search: Search,
    ) -> Vec<Whereabouts> {
        self.whereabouts_in_passes(pins, search).0
    }

    /// The same, and in how many passes over the tree: one at most for all that was moved, and one for all that is
    /// looked for everywhere.
    pub(super) fn whereabouts_in_passes<'a>(
        &self,
        pins: impl IntoIterator<Item = (&'a Anchor, Vec3)>,
        search: Search,
    ) -> (Vec<Whereabouts>, u32) {
        let known: Vec<_> =
            pins.into_iter().map(|(anchor, place)| (anchor, place, self.known(anchor))).collect();
        let dead = known.iter().filter_map(|(.., known)| match known {
            Known::Dead(id) => Some(*id),
            Known::Whereabouts(_) | Known::Lost => None,
        });
        let grafts = self.grafts_of(dead);
        let lost = known.iter().filter(|(.., known)| matches!(known, Known::Lost));
        let ways: BTreeSet<u64> = match search {
            Search::Everywhere => lost.map(|(anchor, ..)| anchor.knot.way).collect(),
            Search::KnownPlaces => BTreeSet::new(),
        };
        let passes = u32::from(!grafts.is_empty()) + u32::from(!ways.is_empty());
        let (moved, like) = (self.moved_by(grafts), self.like(&ways));
        let found = known.into_iter().map(|(anchor, place, known)| match known {
            Known::Whereabouts(whereabouts) => whereabouts,
            Known::Dead(id) => match moved.get(&id.raw()) {
                Some(moved) => Whereabouts::at(PinState::Standing, Some(*moved)),
                None => Whereabouts::at(PinState::Detached, self.living_from(id)),
            },
            Known::Lost => match like.get(&anchor.knot.way).filter(|id| self.is_near(**id, place)) {
                Some(id) => Whereabouts::at(PinState::Regrown, Some(*id)),
                None => self.elsewhere(anchor),
            },
        });
        (found.collect(), passes)
    }

    fn known(&self, anchor: &Anchor) -> Known {
        let plant = self.plant();
        let shared = self.futures.shared_with(anchor.line);
        let knot = anchor.knot;
        // A line that is not known here may be the present one under an earlier number: files do not keep the others.
        let is_of_line = shared.is_none_or(|step| knot.born <= step);
        if is_of_line && (plant.step() + 1..=plant.last_step()).contains(&knot.born) {
            let not_yet = Whereabouts::at(PinState::NotYet, self.living_below(anchor, shared));
            return Known::Whereabouts(Whereabouts { step: Some(knot.born), ..not_yet });
        }
        match self.found(knot, shared) {
            Some(id) if plant.is_alive(id) => {
                Known::Whereabouts(Whereabouts::at(PinState::Standing, Some(id)))
            }
            Some(id) => Known::Dead(id),
            None => Known::Lost,
        }
    }

    /// What is said of a place that is on none of the lines, and nothing like it anywhere.
    fn elsewhere(&self, anchor: &Anchor) -> Whereabouts {
        let (shared, knot) = (self.futures.shared_with(anchor.line), anchor.knot);
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

    /// Living metamers to which the same ways lead, by these: the last one of each.
    fn like(&self, wanted: &BTreeSet<u64>) -> BTreeMap<u64, MetamerId> {
        let mut found = BTreeMap::new();
        if wanted.is_empty() {
            return found;
        }
        let plant = self.plant();
        let mut ways: Vec<u64> = Vec::with_capacity(plant.metamer_count());
        for row in 0..plant.metamer_count() {
            let id = MetamerId::new(row);
            let own = match plant.metamers().parent(id) {
                Some(parent) => on(ways[parent.index()], self.turn(id, parent)),
                None => self.start(id),
            };
            ways.push(own);
            if wanted.contains(&own) && plant.is_alive(id) {
                found.insert(own, id);
            }
        }
        found
    }

    fn is_near(&self, id: MetamerId, place: Vec3) -> bool {
        self.plant().metamers().end(id).distance(place) <= REGROWN_WITHIN
    }

    /// The grafts by which any of these dead metamers may have been moved, by their first steps.
    fn grafts_of(&self, dead: impl Iterator<Item = MetamerId>) -> BTreeMap<u32, Graft> {
        let plant = self.plant();
        let deaths = plant.columns(0..plant.metamer_count()).death;
        let deaths: BTreeSet<u32> = dead.filter_map(|id| deaths.get(id.index()).copied()).collect();
        let done = self.history.operations[..self.history.done].iter();
        let grafts = done.filter(|one: &&Operation| one.kind == Kind::Graft && one.first < one.last);
        let grafts = grafts.filter(|one| deaths.range(one.first + 1..=one.last).next().is_some());
        grafts.map(|one| (one.first, Graft { last: one.last, gone: Vec::new(), came: Vec::new() })).collect()
    }

    /// Where living metamers come from that any of these grafts has moved, by where they were: a graft that moves wood
    /// copies it row by row and cuts it where it was.
    fn moved_by(&self, mut grafts: BTreeMap<u32, Graft>) -> BTreeMap<u32, MetamerId> {
        let plant = self.plant();
        if !grafts.is_empty() {
            let deaths = plant.columns(0..plant.metamer_count()).death;
            for id in (0..plant.metamer_count()).map(MetamerId::new) {
                if let Some(graft) = deaths.get(id.index()).and_then(|death| graft_at(&mut grafts, *death)) {
                    graft.gone.push(id);
                }
                if let Some(graft) = graft_at(&mut grafts, plant.birth(id)) {
                    graft.came.push(id);
                }
            }
        }
        let whole = grafts.into_values().filter(|graft| graft.gone.len() == graft.came.len());
        let pairs = whole.flat_map(|graft| graft.gone.into_iter().zip(graft.came));
        pairs.filter(|(_, came)| plant.is_alive(*came)).map(|(gone, came)| (gone.raw(), came)).collect()
    }
}

/// A graft, and what it cut and grew, in the order of rows.
#[derive(Debug)]
struct Graft {
    last: u32,
    gone: Vec<MetamerId>,
    came: Vec<MetamerId>,
}

/// The graft that was done in a step.
fn graft_at(grafts: &mut BTreeMap<u32, Graft>, step: u32) -> Option<&mut Graft> {
    let (_, graft) = grafts.range_mut(..step).next_back()?;
    (step <= graft.last).then_some(graft)
}

fn on(way: u64, turn: u64) -> u64 {
    let mut hash = StableHash::default();
    hash.word(way);
    hash.word(turn);
    hash.finish()
}
