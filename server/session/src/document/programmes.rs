//! The schedule of a document: its programme, what was set by hand, and the age by which it goes (`PG`).

use std::sync::Arc;

use espalier_plant::hash::StableHash;
use espalier_proto::{ParameterName, Problem, Programme, Reason};

use super::{
    Document,
    history::{Kind, Setting},
    settings::to_words,
};
use crate::{
    cause::Cause,
    schedule::{GrowthSchedule, Plan},
};

impl Document {
    /// The programme in force.
    pub fn programme(&self) -> Option<&Arc<Programme>> {
        self.schedule().programme()
    }

    /// The short name of the species whose programme is in force.
    pub fn species(&self) -> Option<String> {
        self.programme()?.species.as_ref().map(|species| species.as_str().to_owned())
    }

    /// The names of the parameters that do not follow the programme; none without one.
    pub fn set_by_hand(&self) -> impl Iterator<Item = &'static str> + use<> {
        let has_programme = self.programme().is_some();
        self.schedule().by_hand().names().filter(move |_| has_programme)
    }

    /// The age of the plants.
    pub fn age(&self) -> u32 {
        self.simulation.generator().age(self.simulation.scene())
    }

    pub(super) fn schedule(&self) -> &Arc<GrowthSchedule> {
        self.simulation.generator().schedule()
    }

    pub(super) fn set_programme(
        &mut self,
        cause: Cause<'_>,
        programme: Option<&Programme>,
        keep: bool,
    ) -> Result<(), Problem> {
        let plan = programme.map(|programme| Plan::new(programme.clone()).map(Arc::new)).transpose();
        let wanted = plan.and_then(|plan| self.schedule().replaced(plan, keep, self.age()));
        self.change_schedule(cause, wanted.map_err(|problem| problem.within("programme"))?);
        Ok(())
    }

    pub(super) fn follow_programme(
        &mut self,
        cause: Cause<'_>,
        names: &[ParameterName],
    ) -> Result<(), Problem> {
        if self.programme().is_none() {
            let message = "there is no programme that parameters could follow";
            return Err(Problem::new(Reason::NoProgramme, message)
                .at("parameters", "names of parameters while a programme is in force"));
        }
        let names: Vec<&str> = names.iter().map(|name| name.as_str()).collect();
        let wanted = self.schedule().without(&names)?;
        self.change_schedule(cause, wanted);
        Ok(())
    }

    pub(super) fn change_schedule(&mut self, cause: Cause<'_>, wanted: GrowthSchedule) {
        if wanted != **self.schedule() {
            let setting = Setting { schedule: Arc::new(wanted), ..self.setting() };
            self.change_setting(Kind::Parameters, cause, setting);
        }
    }

    /// Grows by a schedule from here on, in the state that the line has at the present step.
    pub(super) fn turn_to(&mut self, schedule: &Arc<GrowthSchedule>) {
        let state = self.history.state_at(self.plant().step());
        self.simulation.generator_mut().turn_to(schedule, state);
        let wanted = schedule.at(self.age());
        if **wanted != *self.simulation.parameters() {
            self.simulation.set_parameters((**wanted).clone());
        }
    }

    /// Puts the generators into the state that the line has at the present step.
    pub(super) fn keep_state(&mut self) {
        let schedule = Arc::clone(self.schedule());
        self.turn_to(&schedule);
    }

    /// Notes the state that the generators have come to.
    pub(super) fn note_state(&mut self) {
        self.history.note_state(self.plant().step(), self.simulation.generator().state());
    }

    pub(super) fn hash_schedule(&self, hash: &mut StableHash) {
        if let Some(programme) = self.programme() {
            to_words(&**programme).into_iter().for_each(|word| hash.word(word));
            to_words(self.schedule().by_hand()).into_iter().for_each(|word| hash.word(word));
        }
        for mark in &self.history.states {
            hash.word(u64::from(mark.step) | u64::from(mark.state.ahead) << 32);
        }
    }
}
