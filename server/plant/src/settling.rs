//! Settling anew which wood stands, when some steps no longer count, or count again.
//!
//! Nothing is grown again and no row gets another number. Whoever settles says of each step whether it is in force, and
//! whether a hand drew what was born in it. From that follows which wood stands (`standing`), where (`places`), and
//! which widths, radii and organs hold (`fields`). The difference to the present is one edit in a step of its own.

mod fields;
mod places;
mod standing;

use std::ops::Range;

use self::standing::{Standing, State};
use crate::{
    deaths::ALIVE,
    edits::{Carried, Edit},
    id::{AxisId, MetamerId},
    plant::Plant,
    resettled::{AxisEnds, Resettled},
    timeline::StepEnd,
    tips::severed,
};

/// What counts of one step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Claim {
    /// Whether the step is in force: what was born, cut, shed, moved and widened in it counts.
    pub in_force: bool,
    /// Whether a hand drew what was born in it. Such wood holds what bears it; wood that grew by itself goes with what it
    /// stands on.
    pub by_hand: bool,
}

impl Claim {
    /// A step that counts, and whose wood was drawn by a hand.
    pub const HAND: Self = Self { in_force: true, by_hand: true };
}

/// What counts of each step, and of rows whose step is of several people.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Claims {
    /// One a step from the first on; steps without a claim count as [`Claim::HAND`].
    pub steps: Vec<Claim>,
    /// What counts of the birth of these rows, whatever is said of their step; in order, without overlap.
    pub rows: Vec<(Range<u32>, Claim)>,
}

impl From<Vec<Claim>> for Claims {
    fn from(steps: Vec<Claim>) -> Self {
        Self { steps, rows: Vec::new() }
    }
}

impl Claims {
    /// What counts of the birth of each row, where these are the steps of births.
    fn of_rows(&self, births: &[u32]) -> Vec<Claim> {
        let mut claims: Vec<Claim> = births.iter().map(|&birth| claim(&self.steps, birth)).collect();
        for (rows, claim) in &self.rows {
            let end = (rows.end as usize).min(claims.len());
            claims[(rows.start as usize).min(end)..end].fill(*claim);
        }
        claims
    }
}

/// What came of settling.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settled {
    /// Whether anything changes: then a step ahead of the present does so.
    pub is_recorded: bool,
    /// Metamers that fall, in birth order.
    pub falls: Vec<MetamerId>,
    /// Metamers that rise, in birth order.
    pub rises: Vec<MetamerId>,
    /// Metamers of steps that do not count, or cut in steps that do, which stand since drawn wood in force stands on
    /// them.
    pub held: Vec<MetamerId>,
    /// Drawn metamers in force that wait, since others have grown in their place.
    pub waiting: Vec<MetamerId>,
}

impl Plant {
    /// Records, as an edit ahead of the present, what changes if the steps up to the present count as the claims say. The
    /// plant [goes](Plant::go_to) there like to any other
    /// step. Where nothing changes nothing is recorded.
    ///
    /// # Panics
    /// If something is recorded beyond the present, or a step is being recorded.
    pub fn settle(&mut self, claims: &Claims) -> Settled {
        assert!(!self.timeline.recording, "time stands still within a step");
        assert_eq!(self.timeline.now, self.last_step(), "there is a future");
        let standing = Standing::of(self, claims);
        let places = places::resettled(self, &claims.steps, &standing);
        let edit = self.difference(&claims.steps, &standing, places);
        let mut settled = Settled::default();
        for &(id, death) in &edit.metamers {
            if death == ALIVE { settled.rises.push(id) } else { settled.falls.push(id) }
        }
        let rows = |is_one: &dyn Fn(usize) -> bool| {
            (0..self.metamer_count()).filter(|&row| is_one(row)).map(MetamerId::new).collect()
        };
        settled.held = rows(&|row| standing.states[row] == State::Held);
        settled.waiting = rows(&|row| standing.own[row] && !standing.states[row].stands());
        settled.is_recorded = !edit.is_empty();
        if settled.is_recorded {
            self.timeline.edits.push(Edit::Resettled(Box::new(edit)));
            let last = self.timeline.present();
            self.timeline.ends.push(StepEnd { edits: last.edits + 1, ..last });
        }
        settled
    }

    /// The edit that leads from the present to what shall stand: what it keeps is what comes after it.
    fn difference(&self, claims: &[Claim], standing: &Standing, carried: Carried) -> Resettled {
        let death = self.timeline.now + 1;
        let mut edit = Resettled { carried, ..Resettled::default() };
        let is_severed = severed(self.past_edits(), self.metamer_count());
        for id in (0..self.metamer_count()).map(MetamerId::new) {
            let state = standing.states[id.index()];
            if state.stands() != self.is_alive(id) {
                edit.metamers.push((id, if state.stands() { ALIVE } else { death }));
            }
            let is_borne = |parent: MetamerId| standing.states[parent.index()] != State::Gone;
            if self.metamers.parent(id).is_some_and(is_borne)
                && is_severed[id.index()] == (state != State::Gone)
            {
                edit.severed.push(id);
            }
        }
        for axis in (0..self.axis_count()).map(AxisId::new) {
            let is_alive = standing.buds[axis.index()];
            if is_alive != self.is_axis_alive(axis) {
                edit.axes.push((axis, if is_alive { ALIVE } else { death }));
            }
            let before = self.axes.first(axis).zip(self.axes.last(axis));
            let after = match standing.ends[axis.index()] {
                // Above what stands of an axis without a bud there may be what was cut off.
                Some((_, last)) if !is_alive && self.is_below_end(last, axis) => before,
                None if !is_alive => before,
                ends => ends,
            };
            if before != after {
                edit.ends.push(AxisEnds { axis, before, after });
            }
        }
        let fields::Fields { widths, radii, organs } = fields::resettled(self, claims);
        (edit.widths, edit.given, edit.organs) = (widths, radii, organs);
        edit
    }

    /// Whether a metamer is on the way from the end of its axis down to its beginning.
    fn is_below_end(&self, id: MetamerId, axis: AxisId) -> bool {
        let down = std::iter::successors(self.axes.last(axis), |&at| self.metamers.parent(at));
        down.take_while(|&at| at >= id).any(|at| at == id)
    }
}

/// What counts of a step.
fn claim(claims: &[Claim], step: u32) -> Claim {
    claims.get(step as usize).copied().unwrap_or(Claim::HAND)
}

/// The edits of the steps after the first up to the present, each with its step.
fn edits(plant: &Plant) -> impl DoubleEndedIterator<Item = (u32, &Edit)> {
    let ends = plant.timeline.ends[..=plant.step() as usize].windows(2);
    ends.enumerate().flat_map(|(before, pair)| {
        let edits = &plant.timeline.edits[pair[0].edits as usize..pair[1].edits as usize];
        edits.iter().map(move |edit| (before as u32 + 1, edit))
    })
}
