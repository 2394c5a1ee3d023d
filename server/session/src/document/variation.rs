//! What a document gives to other trees of its kind.

use espalier_proto::{Action, Age, Steps};

use super::Document;

impl Document {
    /// What grows another tree of this kind from another seed: its programme, parameters and looks, and the grammar in
    /// force, to its age. What was drawn and done by hand is no part of it.
    pub fn variation(&self) -> Vec<Action> {
        let programme = self.programme().map(|programme| (**programme).clone());
        let age = Age::nearest(self.age());
        let parameters = self.schedule().by_hand().clone();
        let mut actions = vec![
            Action::SetProgramme { programme, keep: false },
            Action::SetParameters { parameters },
            Action::SetAppearance { appearance: (*self.appearance()).into() },
        ];
        // What a grammar writes is written again, with other chance.
        actions.extend(self.grammar_to_set());
        let grow = Action::Grow { steps: Steps::MOST, until: Some(age), bud: None };
        let commands = age.get().div_ceil(Steps::MOST.get()) as usize;
        actions.extend(std::iter::repeat_n(grow, commands));
        actions
    }
}

#[cfg(test)]
mod tests {
    use espalier_growth::species;
    use espalier_settings::{AppearancePatch, LeafPatch, ParametersPatch};

    use super::*;
    use crate::{principal::Principal, script};

    fn grown(seed: u32, actions: &[Action]) -> Document {
        let mut document = Document::new(seed);
        for action in actions {
            document
                .apply(&Principal::visitor(), &action.clone().into())
                .unwrap_or_else(|problem| panic!("{problem}"));
        }
        document
    }

    #[test]
    fn with_its_own_seed_it_is_the_same_tree_and_with_another_one_another() {
        let species = species::find("juniper").unwrap_or_else(|| panic!("it is a species"));
        let mut actions = script(species);
        let parameters = ParametersPatch { leaf_size: Some(0.5), ..ParametersPatch::default() };
        actions.insert(1, Action::SetParameters { parameters });
        let leaves = Some(LeafPatch { season: Some(2.0), ..LeafPatch::default() });
        let appearance = AppearancePatch { leaves, ..AppearancePatch::default() };
        actions.push(Action::SetAppearance { appearance });
        let one = grown(3, &actions);
        let (same, other) = (grown(3, &one.variation()), grown(4, &one.variation()));
        assert_eq!(same.plant().hash(), one.plant().hash());
        assert_ne!(other.plant().hash(), one.plant().hash());
        for tree in [&same, &other] {
            assert_eq!((tree.parameters(), tree.appearance()), (one.parameters(), one.appearance()));
            assert_eq!((tree.age(), tree.species()), (one.age(), one.species()));
        }
    }

    #[test]
    fn without_a_programme_it_grows_by_the_parameters_to_the_same_age() {
        let parameters = ParametersPatch { apical_control: Some(0.6), ..ParametersPatch::default() };
        let steps = Steps::nearest(7);
        let actions = [Action::SetParameters { parameters }, Action::Grow { steps, until: None, bud: None }];
        let one = grown(3, &actions);
        let same = grown(3, &one.variation());
        assert_eq!((same.plant().hash(), same.age()), (one.plant().hash(), 7));
        assert!(Document::new(1).variation().iter().all(|action| !matches!(action, Action::Grow { .. })));
    }
}
