//! What plants grow by: a programme over their age, and parameters that were set by hand and go before it (`PG`).

mod plan;

use std::sync::Arc;

use espalier_growth::Parameters;
use espalier_proto::{Problem, Programme};
use espalier_settings::{ParameterValues, ParametersPatch};

pub(crate) use self::plan::{Plan, ScheduledAction};

/// Parameters that sum to 1: when one of them is set by hand, all are.
const WEIGHTS: [&str; 3] = ["heading_weight", "tropism_weight", "space_weight"];

/// The parameters at every age, all in range.
#[derive(Clone, Debug)]
pub(crate) struct GrowthSchedule {
    plan: Option<Arc<Plan>>,
    /// What was set by hand; all parameters where there is no programme.
    by_hand: ParametersPatch,
    /// The parameters from an age on; the first from 0.
    courses: Vec<(u32, Arc<Parameters>)>,
}

impl GrowthSchedule {
    /// The same parameters at every age.
    pub(crate) fn plain(parameters: Parameters) -> Self {
        let by_hand = parameters.values().clone().into();
        Self { plan: None, by_hand, courses: vec![(0, Arc::new(parameters))] }
    }

    /// A programme with some parameters set by hand; without one those left out have their defaults.
    ///
    /// # Errors
    ///
    /// At some age a parameter would be out of its range.
    pub(crate) fn new(plan: Option<Arc<Plan>>, by_hand: &ParametersPatch) -> Result<Self, Problem> {
        let Some(plan) = plan else {
            let values = ParameterValues::default().patched(by_hand);
            return Ok(Self::plain(Parameters::new(values)?));
        };
        let resolve = |(age, values): &(u32, ParameterValues)| {
            Ok((*age, Arc::new(Parameters::new(values.patched(by_hand))?)))
        };
        let courses = plan.values().iter().map(resolve).collect::<Result<_, Problem>>()?;
        Ok(Self { plan: Some(plan), by_hand: by_hand.clone(), courses })
    }

    /// The parameters at an age.
    pub(crate) fn at(&self, age: u32) -> &Arc<Parameters> {
        let passed = self.courses.partition_point(|(from, _)| *from <= age);
        &self.courses[passed.max(1) - 1].1
    }

    /// Whether it is one of the parameters that are set together, for they sum to 1.
    pub(crate) fn is_weight(name: &str) -> bool {
        WEIGHTS.contains(&name)
    }

    /// What is done beside growing at an age.
    pub(crate) fn plan(&self) -> Option<&Arc<Plan>> {
        self.plan.as_ref()
    }

    /// The programme.
    pub(crate) fn programme(&self) -> Option<&Arc<Programme>> {
        self.plan.as_deref().map(Plan::programme)
    }

    /// What was set by hand; all parameters where there is no programme.
    pub(crate) fn by_hand(&self) -> &ParametersPatch {
        &self.by_hand
    }

    /// The same with more set by hand, at an age.
    pub(crate) fn with(&self, patch: &ParametersPatch, age: u32) -> Result<Self, Problem> {
        let present: ParametersPatch = self.at(age).values().clone().into();
        let sets_weight = patch.names().any(|name| WEIGHTS.contains(&name));
        let weights = present.only(|name| sets_weight && WEIGHTS.contains(&name));
        let by_hand = self.by_hand.patched(&weights).patched(patch);
        // The present age is checked first, so that a refusal speaks of what the user sees.
        Parameters::new(self.at(age).values().patched(patch))?;
        Self::new(self.plan.clone(), &by_hand)
    }

    /// The same with some of what was set by hand given up.
    pub(crate) fn without(&self, names: &[&str]) -> Result<Self, Problem> {
        let weights = names.iter().any(|name| WEIGHTS.contains(name));
        let goes = |name: &str| names.contains(&name) || weights && WEIGHTS.contains(&name);
        let by_hand = self.by_hand.only(|name| !names.is_empty() && !goes(name));
        Self::new(self.plan.clone(), &by_hand)
    }

    /// Another programme, or none: then the parameters stay those of an age. With `keep` so does what was set by hand.
    pub(crate) fn replaced(&self, plan: Option<Arc<Plan>>, keep: bool, age: u32) -> Result<Self, Problem> {
        match plan {
            None => Ok(Self::plain((**self.at(age)).clone())),
            Some(_) if keep && self.plan.is_some() => Self::new(plan, &self.by_hand),
            Some(plan) if keep => {
                // Without a programme everything is set by hand: what is not as it is at first was meant.
                let present = ParameterValues::default().change_to(self.at(age).values());
                Self::new(Some(plan), &present)
            }
            Some(plan) => Self::new(Some(plan), &ParametersPatch::default()),
        }
    }
}

impl PartialEq for GrowthSchedule {
    fn eq(&self, other: &Self) -> bool {
        let same_plan = match (&self.plan, &other.plan) {
            (Some(one), Some(another)) => Arc::ptr_eq(one, another) || one == another,
            (one, another) => one.is_none() && another.is_none(),
        };
        same_plan && self.by_hand == other.by_hand
    }
}

#[cfg(test)]
mod tests {
    use espalier_growth::species;

    use super::*;
    use crate::species_script::programme_of;

    fn pine() -> GrowthSchedule {
        let plan = Plan::new(programme_of(species::find("scots-pine").expect("a pine"))).expect("in range");
        GrowthSchedule::new(Some(Arc::new(plan)), &ParametersPatch::default()).expect("in range")
    }

    #[test]
    fn pg1_parameters_follow_the_age() {
        let pine = pine();
        assert_eq!([0, 9, 10, 500].map(|age| pine.at(age).shedding_threshold), [0.9, 0.9, 0.25, 0.25]);
    }

    #[test]
    fn pg4_what_is_set_by_hand_goes_before_the_programme_until_it_is_given_up() {
        let thick = ParametersPatch { shedding_threshold: Some(0.1), ..ParametersPatch::default() };
        let pine = pine();
        let by_hand = pine.with(&thick, 3).expect("in range");
        assert_eq!([0, 10].map(|age| by_hand.at(age).shedding_threshold), [0.1, 0.1]);
        assert_eq!(by_hand.by_hand().names().collect::<Vec<_>>(), ["shedding_threshold"]);
        assert_eq!(by_hand.without(&["shedding_threshold"]).expect("in range"), pine);
        assert_eq!(by_hand.without(&[]).expect("in range"), pine);
    }

    #[test]
    fn pg4_the_three_weights_are_set_together() {
        let level = ParametersPatch {
            heading_weight: Some(0.5),
            tropism_weight: Some(0.3),
            space_weight: Some(0.2),
            ..ParametersPatch::default()
        };
        let by_hand = pine().with(&level, 0).expect("they sum to 1");
        assert_eq!(by_hand.without(&["tropism_weight"]).expect("in range"), pine());
        let alone = ParametersPatch { heading_weight: Some(0.9), ..ParametersPatch::default() };
        assert!(pine().with(&alone, 0).is_err());
    }

    #[test]
    fn pg3_without_a_programme_parameters_stay_as_they_are() {
        let none = pine().replaced(None, false, 4).expect("in range");
        assert!(none.programme().is_none());
        assert_eq!([0, 40].map(|age| none.at(age).shedding_threshold), [0.9, 0.9]);
    }
}
