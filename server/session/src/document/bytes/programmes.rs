//! Programmes, which schedules go by which, and where on lines of time the state of generators changed, with the ages.

use std::sync::Arc;

use espalier_settings::ParametersPatch;

use super::{
    DocumentError, damaged,
    fields::{Reader, Writer},
    settings::{MOST, Pool, number, read_json, write_json},
};
use crate::{
    document::{
        futures::Futures,
        generators::GeneratorState,
        history::{History, StateMark},
    },
    schedule::{GrowthSchedule, Plan},
};

/// What the section holds; a document without it has no programme.
#[derive(Debug, Default)]
pub(super) struct Programmes {
    plans: Vec<Arc<Plan>>,
    /// For each schedule the number of its programme.
    of_schedules: Vec<Option<u32>>,
    /// The number of the schedule in force; none where it has no programme.
    pub(super) present: Option<u32>,
    states: Vec<StateMark>,
    /// Those of each future.
    states_of_futures: Vec<Vec<StateMark>>,
}

pub(super) fn write(
    out: &mut Writer,
    pool: &Pool,
    present: &Arc<GrowthSchedule>,
    history: &History,
    futures: &Futures,
) {
    let mut plans: Vec<&Arc<Plan>> = Vec::new();
    let mut of_schedules = Vec::new();
    for plan in pool.schedules().iter().map(|schedule| schedule.plan()) {
        let known = |plan: &Arc<Plan>| plans.iter().position(|there| Arc::ptr_eq(there, plan));
        let number = plan.map(|plan| known(plan).unwrap_or(plans.len()));
        plans.extend(plan.filter(|_| number == Some(plans.len())));
        of_schedules.push(number.map(|number| number as u32));
    }
    out.list(&plans, |out, plan| write_json(out, &**plan.programme()));
    out.list(&of_schedules, |out, &number| out.option(number));
    out.option(present.plan().map(|_| number(pool.schedules(), present)));
    write_states(out, &history.states);
    out.list(&futures.all, |out, future| write_states(out, &future.states));
}

pub(super) fn read(reader: &mut Reader<'_>) -> Result<Programmes, DocumentError> {
    reader.up_to(1)?;
    let plans = reader.list_up_to(MOST, |r| {
        let plan = Plan::new(read_json(r)?).map_err(|problem| damaged(problem.message))?;
        Ok(Arc::new(plan))
    })?;
    Ok(Programmes {
        plans,
        of_schedules: reader.list_up_to(MOST, Reader::option)?,
        present: reader.option()?,
        states: read_states(reader)?,
        states_of_futures: reader.list(read_states)?,
    })
}

impl Programmes {
    /// The schedules that set these parameters.
    pub(super) fn schedules(
        &self,
        parameters: &[ParametersPatch],
    ) -> Result<Vec<Arc<GrowthSchedule>>, DocumentError> {
        let schedule = |(index, patch): (usize, &ParametersPatch)| {
            let number = self.of_schedules.get(index).copied().flatten();
            let plan = number.map(|number| {
                self.plans.get(number as usize).cloned().ok_or_else(|| damaged("a programme is missing"))
            });
            let schedule = GrowthSchedule::new(plan.transpose()?, patch);
            schedule.map(Arc::new).map_err(|problem| damaged(problem.message))
        };
        parameters.iter().enumerate().map(schedule).collect()
    }

    /// Puts the states where they belong.
    pub(super) fn tell_states(
        self,
        history: &mut History,
        futures: &mut Futures,
    ) -> Result<(), DocumentError> {
        if self.states_of_futures.len() > futures.all.len() {
            return Err(damaged("a future is missing that has ages"));
        }
        history.states = self.states;
        for (future, states) in futures.all.iter_mut().zip(self.states_of_futures) {
            future.states = states;
        }
        Ok(())
    }
}

/// Each place where a state changes, with the age there; what else belongs to a state stands in sections of its own.
fn write_states(out: &mut Writer, states: &[StateMark]) {
    out.list(states, |out, mark| {
        out.u32(mark.step);
        out.u32(mark.done);
        out.u32(mark.state.ahead);
    });
}

fn read_states(reader: &mut Reader<'_>) -> Result<Vec<StateMark>, DocumentError> {
    reader.list(|r| {
        let (step, done) = (r.u32()?, r.u32()?);
        Ok(StateMark { step, done, state: GeneratorState::default().aged(r.u32()?) })
    })
}
