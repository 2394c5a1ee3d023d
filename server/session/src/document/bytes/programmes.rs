//! Programmes, which schedules go by which, and the ages that lines of time have come to.

use std::sync::Arc;

use espalier_settings::ParametersPatch;

use super::{
    DocumentError, damaged,
    fields::{Reader, Writer},
    settings::{Pool, number, read_json, write_json},
};
use crate::{
    document::{
        futures::Futures,
        history::{AgeMark, History},
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
    ages: Vec<AgeMark>,
    /// Those of each future.
    ages_of_futures: Vec<Vec<AgeMark>>,
}

/// Whether plants are older anywhere than their steps of growth.
pub(super) fn has_ages(history: &History, futures: &Futures) -> bool {
    !history.ages.is_empty() || futures.all.iter().any(|future| !future.ages.is_empty())
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
    write_ages(out, &history.ages);
    out.list(&futures.all, |out, future| write_ages(out, &future.ages));
}

pub(super) fn read(reader: &mut Reader<'_>) -> Result<Programmes, DocumentError> {
    reader.up_to(1)?;
    let plans = reader.list(|r| {
        let plan = Plan::new(read_json(r)?).map_err(|problem| damaged(problem.message))?;
        Ok(Arc::new(plan))
    })?;
    Ok(Programmes {
        plans,
        of_schedules: reader.list(Reader::option)?,
        present: reader.option()?,
        ages: read_ages(reader)?,
        ages_of_futures: reader.list(read_ages)?,
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

    /// Puts the ages where they belong.
    pub(super) fn tell_ages(self, history: &mut History, futures: &mut Futures) -> Result<(), DocumentError> {
        if self.ages_of_futures.len() > futures.all.len() {
            return Err(damaged("a future is missing that has ages"));
        }
        history.ages = self.ages;
        for (future, ages) in futures.all.iter_mut().zip(self.ages_of_futures) {
            future.ages = ages;
        }
        Ok(())
    }
}

fn write_ages(out: &mut Writer, ages: &[AgeMark]) {
    out.list(ages, |out, mark| {
        out.u32(mark.step);
        out.u32(mark.done);
        out.u32(mark.ahead);
    });
}

fn read_ages(reader: &mut Reader<'_>) -> Result<Vec<AgeMark>, DocumentError> {
    reader.list(|r| Ok(AgeMark { step: r.u32()?, done: r.u32()?, ahead: r.u32()? }))
}
