//! Branches in people's hands: bends between their begin and their end (`BE`).

use espalier_plant::{Bend, MetamerId, Plant, Widths, hash::StableHash};
use espalier_proto::{Position, Problem, Reason, Share, frame::POSITION_STEPS};
use glam::Vec3;

use super::{Document, branches::said, history::Kind};
use crate::{cause::Cause, principal::Principal};

/// Bends open at once (`LM7`).
pub(super) const MAX_OPEN: usize = 32;
/// Metamers of a path (`LM7`).
pub(super) const MAX_PATH: usize = 4096;

/// One bend between its begin and its end.
#[derive(Clone, Debug)]
pub(super) struct OpenBend {
    pub author: Principal,
    /// The author's number for it.
    pub number: u32,
    /// The document's own number for it.
    pub id: u32,
    /// From the base to the farthest touch.
    pub path: Vec<MetamerId>,
    /// Where on the path each touch is.
    pub touches: Vec<usize>,
    pub solver: Bend,
    /// Neighbours with the same gesture are one operation.
    pub gesture: Option<u32>,
    /// Whether anything was moved.
    pub is_moved: bool,
}

/// All bends in progress.
#[derive(Clone, Debug, Default)]
pub(super) struct OpenBends {
    pub open: Vec<OpenBend>,
    /// Bends ever begun: names them.
    pub begun: u32,
}

impl OpenBends {
    pub fn of(&self, author: &Principal) -> Vec<u32> {
        self.open.iter().filter(|bend| bend.author == *author).map(|bend| bend.number).collect()
    }

    /// Takes a bend out of people's hands.
    pub fn close(&mut self, author: &Principal, number: u32) -> Result<OpenBend, Problem> {
        self.find(author, number).map(|index| self.open.remove(index))
    }

    pub fn close_all(&mut self) {
        self.open.clear();
    }

    pub fn hash(&self, hash: &mut StableHash) {
        hash.word(u64::from(self.begun));
        for bend in &self.open {
            hash.word(u64::from(bend.number) | u64::from(bend.id) << 32);
            hash.word(u64::from(bend.is_moved) | u64::from(bend.gesture.unwrap_or(u32::MAX)) << 1);
            for touch in &bend.touches {
                hash.word(*touch as u64);
            }
            for (row, motion) in bend.path.iter().zip(bend.solver.motions()) {
                hash.word(u64::from(row.raw()));
                hash.vector(motion.to);
                hash.vector(motion.rotation.xyz());
            }
        }
    }

    fn find(&self, author: &Principal, number: u32) -> Result<usize, Problem> {
        let index = self.open.iter().position(|bend| bend.number == number && bend.author == *author);
        index.ok_or_else(|| {
            let message =
                format!("bend {number} is not in progress: it was never begun, or its branch is gone");
            Problem::new(Reason::BendGone, message).at("bend", "the number of a bend in progress")
        })
    }
}

impl Document {
    /// The bends an author has begun and not ended.
    pub fn open_bends(&self, author: &Principal) -> Vec<u32> {
        self.bends.of(author)
    }

    pub(super) fn begin_bend(
        &mut self,
        cause: Cause<'_>,
        number: u32,
        base: u32,
        touches: &[u32],
        stretch: Share,
    ) -> Result<(), Problem> {
        if self.bends.find(cause.author, number).is_ok() {
            let message = format!("bend {number} has begun already");
            return Err(Problem::new(Reason::NumberTaken, message)
                .at("bend", "a number that no bend in progress has"));
        }
        if self.bends.open.len() >= MAX_OPEN {
            let message = format!("{MAX_OPEN} bends are in progress; end one first");
            return Err(Problem::new(Reason::BendsFull, message)
                .at("bend", format!("up to {MAX_OPEN} bends in progress")));
        }
        let base = self.wood("base", base)?;
        let touched =
            touches.iter().enumerate().map(|(index, &row)| self.wood(&format!("touches[{index}]"), row));
        let touched = touched.collect::<Result<Vec<_>, _>>()?;
        let (path, touches) = path(self.plant(), base, &touched)?;
        let (moved, end) = (path[1], path[path.len() - 1]);
        let plant = self.plant();
        let in_the_way = |bend: &&OpenBend| {
            let last = bend.path[bend.path.len() - 1];
            is_on(plant, end, bend.path[1]) || is_on(plant, last, moved)
        };
        if self.bends.open.iter().any(|bend| in_the_way(&bend)) {
            return Err(held("base", base));
        }
        let (metamers, girth) = (plant.metamers(), self.girth());
        let foot = metamers.parent(base).map_or(Vec3::ZERO, |foot| metamers.end(foot));
        let nodes: Vec<Vec3> = std::iter::once(foot).chain(path.iter().map(|&id| metamers.end(id))).collect();
        let widths = Widths::of(plant, &girth);
        let radii: Vec<f32> = path.iter().map(|&id| widths.radius(id)).collect();
        let solver = Bend::new(&nodes, &radii, stretch.get());
        self.bends.begun = self.bends.begun.wrapping_add(1);
        let id = self.bends.begun;
        self.bends.open.push(OpenBend {
            author: cause.author.clone(),
            number,
            id,
            path,
            touches,
            solver,
            gesture: cause.gesture,
            is_moved: false,
        });
        Ok(())
    }

    pub(super) fn move_bend(
        &mut self,
        cause: Cause<'_>,
        number: u32,
        targets: &[Position],
    ) -> Result<(), Problem> {
        let index = self.bends.find(cause.author, number)?;
        let bend = &mut self.bends.open[index];
        if targets.len() != bend.touches.len() {
            let allowed = format!("{}, one for each touch", bend.touches.len());
            let message = format!("targets has {} entries; allowed: {allowed}", targets.len());
            return Err(Problem::new(Reason::OutOfRange, message).at("targets", allowed));
        }
        let pairs: Vec<_> =
            bend.touches.iter().copied().zip(targets.iter().map(|target| target.get())).collect();
        bend.solver.drag(&pairs);
        bend.is_moved = true;
        Ok(())
    }

    pub(super) fn end_bend(&mut self, cause: Cause<'_>, number: u32) -> Result<(), Problem> {
        let mut bend = self.bends.close(cause.author, number)?;
        // Clients know places as finely as frames tell them.
        if !bend.is_moved || bend.solver.is_brought_back(1.0 / POSITION_STEPS) {
            return Ok(());
        }
        bend.solver.relax();
        let motions = bend.solver.motions();
        let rows: Vec<u32> = bend.path.iter().map(|id| id.raw()).collect();
        if let Some(designed) = self.designed(&rows) {
            return self.bend_designed(Cause { gesture: bend.gesture, ..cause }, &designed, &motions);
        }
        let places = self.plant().above(bend.path[1]).len();
        self.require_places(places)?;
        let now = self.plant().step();
        let cause = Cause { gesture: bend.gesture, ..cause };
        // Where a finger joins in or lifts, one bend ends and the next begins: to the hand they are one.
        let continues = self.history.continues(&[Kind::Bend], cause, now);
        let recorded = (!continues).then(|| self.record(Kind::Bend, cause));
        let carried = self.simulation.carry(&bend.path, &motions);
        if carried.is_err() || self.plant().step() == now {
            if let Some(recorded) = recorded {
                self.refuse(recorded);
            }
            return carried.map_err(said("bend"));
        }
        self.reach();
        self.history.keep_places(places);
        Ok(())
    }

    /// Gives up the bends whose branch is gone.
    pub(super) fn release_lost_bends(&mut self) {
        let plant = self.simulation.plant();
        self.bends.open.retain(|bend| bend.path.last().is_some_and(|&end| plant.is_alive(end)));
    }

    /// Refuses to move a branch that holds the path of an open bend.
    pub(super) fn require_no_bend_of(&self, branch: MetamerId) -> Result<(), Problem> {
        let holds = |bend: &OpenBend| is_on(self.plant(), bend.path[bend.path.len() - 1], branch);
        if self.bends.open.iter().any(holds) { Err(held("row", branch)) } else { Ok(()) }
    }
}

pub(super) fn held(field: &str, row: MetamerId) -> Problem {
    let message = format!("the branch at row {} is being bent; wait until it is let go", row.raw());
    Problem::new(Reason::BeingBent, message).at(field, "wood that nobody is bending")
}

/// The way from the base to the farthest touch, both included, and where on it each touch is.
fn path(
    plant: &Plant,
    base: MetamerId,
    touches: &[MetamerId],
) -> Result<(Vec<MetamerId>, Vec<usize>), Problem> {
    // Wood is younger than what bears it.
    let farthest = touches.iter().copied().max().unwrap_or(base);
    let mut path = vec![farthest];
    while path[path.len() - 1] > base && path.len() <= MAX_PATH {
        match plant.metamers().parent(path[path.len() - 1]) {
            Some(parent) => path.push(parent),
            None => break,
        }
    }
    path.reverse();
    let starts_at_base = path[0] == base;
    let places = touches.iter().enumerate().map(|(index, touch)| {
        let is_end = *touch == farthest;
        let place = path.binary_search(touch).ok().filter(|&place| place > 0 && (starts_at_base || !is_end));
        place.ok_or_else(|| {
            let allowed =
                format!("a row above the base, {MAX_PATH} metamers up at most, on one way with the others");
            Problem::out_of_range(format!("touches[{index}]"), touch.raw(), allowed)
        })
    });
    let places = places.collect::<Result<_, _>>()?;
    Ok((path, places))
}

/// Whether a metamer stands on another one, or is it.
fn is_on(plant: &Plant, id: MetamerId, below: MetamerId) -> bool {
    let mut id = id;
    while id > below {
        match plant.metamers().parent(id) {
            Some(parent) => id = parent,
            None => return false,
        }
    }
    id == below
}
