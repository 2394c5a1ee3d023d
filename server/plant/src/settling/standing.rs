//! Which wood stands.
//!
//! - Drawn wood in force that nothing in force has cut since stands, and holds all that bears it.
//! - Wood in force that grew by itself stands where it is not cut and what it grows from stands. It holds nothing.
//! - Where two continue one axis at one node, drawn wood goes before wood that grew by itself, then the one that stands
//!   before the one that does not, then the later.
//! - An axis ends at the last of its metamers that stands. Its bud lives if its bearer stands and nothing in force has cut
//!   wood of it.

use super::{Claim, Claims, claim, edits};
use crate::{
    edits::Edit,
    id::{AxisId, MetamerId},
    plant::Plant,
    timeline::StepEnd,
};

/// How a metamer is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    /// It stands.
    Stands,
    /// It stands since drawn wood stands on it.
    Held,
    /// It was shed: the wood below keeps its girth.
    Scar,
    /// It is as if it had never grown.
    Gone,
}

impl State {
    pub(super) fn stands(self) -> bool {
        matches!(self, Self::Stands | Self::Held)
    }
}

/// What stands.
pub(super) struct Standing {
    /// The step in which each metamer was born.
    pub(super) births: Vec<u32>,
    /// The step in which the bud of each axis was born.
    pub(super) axis_births: Vec<u32>,
    /// How each metamer is.
    pub(super) states: Vec<State>,
    /// Whether each metamer is drawn wood in force that nothing in force has cut.
    pub(super) own: Vec<bool>,
    /// Whether the bud of each axis lives.
    pub(super) buds: Vec<bool>,
    /// The first and the last metamer of each axis that stand.
    pub(super) ends: Vec<Option<(MetamerId, MetamerId)>>,
}

/// The last steps in force that cut wood and shed it; 0 for none.
#[derive(Clone, Copy, Default)]
struct Cut {
    pruned: u32,
    shed: u32,
}

impl Cut {
    fn and(self, other: Self) -> Self {
        Self { pruned: self.pruned.max(other.pruned), shed: self.shed.max(other.shed) }
    }

    fn last(self) -> u32 {
        self.pruned.max(self.shed)
    }
}

/// What takes place at each node: one metamer continues its axis, and one begins each lateral.
struct Slots<T> {
    continuing: Vec<T>,
    beginning: Vec<T>,
}

impl<T: Default + Clone> Slots<T> {
    fn new(plant: &Plant) -> Self {
        Self {
            continuing: vec![T::default(); plant.metamer_count()],
            beginning: vec![T::default(); plant.axis_count()],
        }
    }

    fn of(&mut self, plant: &Plant, id: MetamerId) -> &mut T {
        let (axis, parent) = (plant.metamers().axis(id), plant.metamers().parent(id));
        match parent.filter(|&parent| plant.metamers().axis(parent) == axis) {
            Some(parent) => &mut self.continuing[parent.index()],
            None => &mut self.beginning[axis.index()],
        }
    }
}

impl Standing {
    pub(super) fn of(plant: &Plant, claims: &Claims) -> Self {
        let (of_births, claims) = (claims, claims.steps.as_slice());
        let births = births_of(plant, |end| end.metamers);
        let axis_births = births_of(plant, |end| end.axes);
        let (cuts, axis_cuts) = cuts(plant, claims);
        let row_claims = of_births.of_rows(&births);
        let rows = || (0..plant.metamer_count()).map(MetamerId::new);
        // What died as it was born never stood.
        let counts = |id: MetamerId| {
            let birth = births[id.index()];
            row_claims[id.index()].in_force && plant.metamers.death.of(id.index()) > birth
        };
        let is_whole = |id: MetamerId| counts(id) && cuts[id.index()].last() <= births[id.index()];
        let by_hand = |id: MetamerId| row_claims[id.index()].by_hand;
        let own: Vec<bool> = rows().map(|id| is_whole(id) && by_hand(id)).collect();
        let mut holds = own.clone();
        for id in rows().rev().filter(|&id| plant.metamers().parent(id).is_some()) {
            let parent = plant.metamers.parent[id.index()];
            holds[parent.index()] |= holds[id.index()];
        }
        let is_free = |id: MetamerId| is_whole(id) && !by_hand(id);
        let mut best: Slots<Option<(bool, bool, MetamerId)>> = Slots::new(plant);
        for id in rows().filter(|&id| holds[id.index()] || is_free(id)) {
            let slot = best.of(plant, id);
            *slot = (*slot).max(Some((holds[id.index()], plant.is_alive(id), id)));
        }
        let mut states = vec![State::Gone; plant.metamer_count()];
        let mut ends: Vec<Option<(MetamerId, MetamerId)>> = vec![None; plant.axis_count()];
        let mut is_taken: Slots<bool> = Slots::new(plant);
        for id in rows() {
            let is_chosen = best.of(plant, id).is_some_and(|(.., best)| best == id);
            let is_borne = plant.metamers().parent(id).is_none_or(|parent| states[parent.index()].stands());
            if is_chosen && is_borne {
                states[id.index()] = if is_whole(id) { State::Stands } else { State::Held };
                *is_taken.of(plant, id) = true;
                let end = &mut ends[plant.metamers().axis(id).index()];
                *end = Some((end.map_or(id, |(first, _)| first), id));
            }
        }
        for id in rows().filter(|&id| counts(id) && !plant.is_seed(id)) {
            let (birth, cut) = (births[id.index()], cuts[id.index()]);
            let is_shed = cut.pruned <= birth && cut.shed > birth && !states[id.index()].stands();
            let is_borne = states[plant.metamers.parent[id.index()].index()] != State::Gone;
            if is_shed && is_borne && !std::mem::replace(is_taken.of(plant, id), true) {
                states[id.index()] = State::Scar;
            }
        }
        let buds = (0..plant.axis_count()).map(AxisId::new).map(|axis| {
            let birth = axis_births[axis.index()];
            let bearer = plant.axes().bearer(axis);
            let below = bearer.map_or(Cut::default(), |bearer| cuts[bearer.index()]);
            let is_cut = below.and(axis_cuts[axis.index()]).last() > birth;
            let is_there = match bearer.filter(|_| ends[axis.index()].is_none()) {
                Some(bearer) => {
                    let was_made = !plant.is_graft(axis) || claim(claims, birth).in_force;
                    states[bearer.index()].stands() && was_made
                }
                None => ends[axis.index()].is_some(),
            };
            is_there && !is_cut && !ended_by_itself(plant, claims, axis, birth)
        });
        let buds = buds.collect();
        Self { births, axis_births, states, own, buds, ends }
    }
}

/// The step in which each row of a column was born.
fn births_of(plant: &Plant, column: impl Fn(&StepEnd) -> u32) -> Vec<u32> {
    let mut births = Vec::new();
    for (end, step) in plant.timeline.ends[..=plant.step() as usize].iter().zip(0..) {
        births.resize(column(end) as usize, step);
    }
    births
}

/// The last cuts in force of each metamer, at it or below, and those of each axis' own wood and bud.
fn cuts(plant: &Plant, claims: &[Claim]) -> (Vec<Cut>, Vec<Cut>) {
    let mut cuts = vec![Cut::default(); plant.metamer_count()];
    let mut axis_cuts = vec![Cut::default(); plant.axis_count()];
    for (step, edit) in edits(plant).filter(|&(step, _)| claim(claims, step).in_force) {
        match *edit {
            Edit::Pruned(cut) => {
                cuts[cut.index()].pruned = step;
                axis_cuts[plant.metamers().axis(cut).index()].pruned = step;
            }
            Edit::Shed(axis) => axis_cuts[axis.index()].shed = step,
            _ => {}
        }
    }
    for id in (0..plant.metamer_count()).map(MetamerId::new) {
        let shed = Cut { pruned: 0, ..axis_cuts[plant.metamers().axis(id).index()] };
        let below = plant.metamers().parent(id).map_or(Cut::default(), |parent| cuts[parent.index()]);
        cuts[id.index()] = cuts[id.index()].and(below).and(shed);
    }
    (cuts, axis_cuts)
}

/// Whether a bud came to its end in a step in force without having been cut or shed: those of copies of wood without a
/// bud, and of wood from elsewhere.
fn ended_by_itself(plant: &Plant, claims: &[Claim], axis: AxisId, birth: u32) -> bool {
    let death = plant.axes.death.of(axis.index());
    if plant.is_axis_alive(axis) {
        return false;
    }
    let was_cut = |edit: &Edit| matches!(edit, Edit::Shed(_) | Edit::Pruned(_) | Edit::Resettled(_));
    let (before, end) = (plant.timeline.before(death), plant.timeline.ends[death as usize]);
    let cut_then = plant.timeline.edits[before.edits as usize..end.edits as usize].iter().any(was_cut);
    death <= birth || (!cut_then && claim(claims, death).in_force)
}
