//! What a document gives to other trees of its kind.

use espalier_proto::{Action, Age, OperationKind, Steps};

use super::Document;

/// What of a document its variations are without.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LeftOut {
    /// What people did by hand that is in force: each kind, in the order in which it was first done, and how often.
    pub by_hand: Vec<(OperationKind, u32)>,
    /// Whether the tree began with wood, as one of a scan does.
    pub is_of_wood: bool,
}

impl Document {
    /// What a [`Document::variation`] has nothing of.
    pub fn left_out(&self) -> LeftOut {
        let timeline = self.timeline();
        let begun = timeline.operations.first().map_or(timeline.step, |operation| operation.first);
        let mut by_hand: Vec<(OperationKind, u32)> = Vec::new();
        let in_force = timeline.operations.iter().take(timeline.done as usize);
        for operation in in_force.filter(|operation| !operation.away && is_by_hand(operation.kind)) {
            match by_hand.iter_mut().find(|(kind, _)| *kind == operation.kind) {
                Some((_, count)) => *count += 1,
                None => by_hand.push((operation.kind, 1)),
            }
        }
        LeftOut { by_hand, is_of_wood: begun > 0 }
    }

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

/// Whether what was done so is of this one tree, and not of its kind.
const fn is_by_hand(kind: OperationKind) -> bool {
    match kind {
        OperationKind::Stroke
        | OperationKind::Lasso
        | OperationKind::Seed
        | OperationKind::Obstacle
        | OperationKind::Bend
        | OperationKind::Width
        | OperationKind::Prune
        | OperationKind::Turn
        | OperationKind::Graft
        | OperationKind::Design
        | OperationKind::Refill => true,
        OperationKind::Growth
        | OperationKind::Parameters
        | OperationKind::Appearance
        | OperationKind::TakenBack
        | OperationKind::BroughtBack
        | OperationKind::Grammar => false,
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
    fn what_was_done_by_hand_and_is_in_force_is_named() {
        let action = |json: &str| match crate::read_command(json) {
            Ok(command) => command.action,
            Err(problem) => panic!("{json}: {problem}"),
        };
        let mut actions = vec![action(r#"{"kind":"grow","steps":12}"#)];
        assert_eq!(grown(3, &actions).left_out(), LeftOut::default());
        actions.extend([
            action(r#"{"kind":"prune","rows":[8]}"#),
            action(r#"{"kind":"set_parameters","parameters":{"apical_control":0.6}}"#),
            action(r#"{"kind":"plant_seed","position":[9,0,0]}"#),
            action(r#"{"kind":"prune","rows":[6]}"#),
            action(r#"{"kind":"plant_seed","position":[-9,0,0]}"#),
            action(r#"{"kind":"undo"}"#),
        ]);
        let by_hand = vec![(OperationKind::Prune, 2), (OperationKind::Seed, 1)];
        assert_eq!(grown(3, &actions).left_out(), LeftOut { by_hand, is_of_wood: false });
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
