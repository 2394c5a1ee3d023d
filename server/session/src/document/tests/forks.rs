//! A second generator, as small as can be, with a state that its next step depends on, and a section for it.

use espalier_growth::{Change, Generator, Observer, Recording, Scene, StepOutcome};
use espalier_plant::{AxisId, Carried, Internode, MetamerId, Plant};
use glam::{Quat, Vec3};

use crate::document::{
    bytes::{Container, DocumentError, Writer, sections},
    futures::{Futures, all_states},
    history::{History, StateMark},
};

/// By how much wood stretches in a step.
pub(super) const STRETCH: f32 = 1.05;
/// How far a bud looks for a free place, in internodes.
pub(super) const CLEARANCE: f32 = 0.3;
/// By how much the plane of forks turns in each step, in radians.
const TURN: f32 = 0.7;

/// In each step every internode stretches, and buds in the light with room ahead become internodes with two buds, as
/// thick as the step says. The first step, and one after others have changed the plants, takes all buds; any other takes
/// those that the step before has left, in its order. What it keeps for that is this.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::document) struct Forks {
    /// Steps made up to here.
    pub(super) steps: u32,
    /// What the last of them has left.
    pub(super) tips: Vec<AxisId>,
    /// How often others have changed the plants since the first.
    pub(super) changes: u32,
    /// Where the plants were when it last saw them.
    seen: u32,
}

impl Generator for Forks {
    type Input = ();

    fn step(&mut self, scene: &mut Scene, (): &(), _: &mut impl Observer) -> StepOutcome {
        let is_free = |axis: &AxisId| {
            let plant = scene.plant();
            let place = plant.bud_position(*axis) + plant.axes().direction(*axis);
            place.y > 0.0 && scene.is_free(place, CLEARANCE) && scene.exposure(place) > 0.1
        };
        let plant = scene.plant();
        let is_bud = |axis: &AxisId| {
            axis.index() < plant.axis_count() && plant.is_axis_alive(*axis) && !plant.has_grown(*axis)
        };
        let all = || (0..plant.axis_count()).map(AxisId::new).collect();
        let buds = if self.tips.is_empty() { all() } else { self.tips.clone() };
        let buds: Vec<AxisId> = buds.into_iter().filter(is_bud).filter(is_free).collect();
        let turn = TURN * self.steps as f32 + self.changes as f32;
        let mut tips = Vec::new();
        let metamers_grown = scene.record_growth(|step| {
            let columns = stretched(step.scene().plant());
            step.place(columns).expect("it stretches within the world");
            let born: Vec<MetamerId> = buds.iter().filter_map(|&bud| fork(step, bud, turn)).collect();
            let plant = step.scene().plant();
            let radius = Some(0.05 + 0.01 * plant.step() as f32);
            // The last to be born is the first to fork, so that the order is its own.
            tips.extend(born.iter().rev().flat_map(|&id| plant.laterals(id)));
            let radii: Vec<_> = born.iter().map(|&id| (id, radius)).collect();
            step.give_radii(&radii).expect("living wood");
            born.len() as u32
        });
        *self = Self { steps: self.steps + 1, tips, seen: scene.plant().step(), ..*self };
        StepOutcome { metamers_grown, buds_enabled: buds.len() as u32, shares: Vec::new() }
    }

    /// Where time has gone, the document puts the state of that time in place of this one.
    fn follow(&mut self, scene: &Scene, change: &Change) {
        let now = scene.plant().step();
        if self.steps > 0 && *change == Change::Edited && now > self.seen {
            *self = Self { steps: self.steps, tips: Vec::new(), changes: self.changes + 1, seen: now };
        }
    }
}

fn fork(step: &mut Recording<'_>, bud: AxisId, turn: f32) -> Option<MetamerId> {
    let plant = step.scene().plant();
    let heading = plant.axes().direction(bud);
    let normal = Quat::from_axis_angle(heading, turn) * heading.any_orthonormal_vector();
    let laterals = [(heading + normal).normalize(), (heading - normal).normalize()];
    let end = plant.bud_position(bud) + heading;
    step.extend(bud, &Internode { end, normal, laterals: &laterals })
}

/// Where all living wood stands once it has stretched.
fn stretched(plant: &Plant) -> Carried {
    let mut ends: Vec<Vec3> = Vec::new();
    let mut columns = Carried::default();
    for id in (0..plant.metamer_count()).map(MetamerId::new) {
        let end = plant.metamers().end(id);
        let Some(parent) = plant.metamers().parent(id).filter(|_| plant.is_alive(id)) else {
            ends.push(end);
            continue;
        };
        ends.push(ends[parent.index()] + STRETCH * (end - plant.metamers().end(parent)));
        columns.metamers.push(id);
        columns.ends.push(ends[id.index()]);
        columns.normals.push(plant.metamers().normal(id));
    }
    columns
}

/// Whether there is any state to be written.
pub(in crate::document) fn has_grown(history: &History, futures: &Futures) -> bool {
    all_states(history, futures).any(|mark| mark.state.forks.steps > 0)
}

/// The state at each place that the section of programmes names.
pub(in crate::document) fn write(out: &mut Writer, history: &History, futures: &Futures) {
    let states: Vec<&StateMark> = all_states(history, futures).collect();
    out.list(&states, |out, mark| {
        let Forks { steps, tips, changes, seen } = &mark.state.forks;
        [steps, changes, seen].into_iter().for_each(|&number| out.u32(number));
        out.list(tips, |out, tip| out.u32(tip.raw()));
    });
}

pub(in crate::document) fn read(
    container: &Container,
    history: &mut History,
    futures: &mut Futures,
) -> Result<(), DocumentError> {
    let states = container.read(&sections::FORKS, |r| {
        r.up_to(1)?;
        r.list(|r| {
            let (steps, changes, seen) = (r.u32()?, r.u32()?, r.u32()?);
            let tips = r.list(|r| Ok(AxisId::new(r.row()? as usize)))?;
            Ok(Forks { steps, tips, changes, seen })
        })
    })?;
    let marks = history.states.iter_mut().chain(futures.all.iter_mut().flat_map(|future| &mut future.states));
    for (mark, forks) in marks.zip(states.unwrap_or_default()) {
        mark.state.forks = forks;
    }
    Ok(())
}
