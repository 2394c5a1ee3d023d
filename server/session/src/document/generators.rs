//! What grows a document's scene. Another generator is a field here and a kind of [`Step`]; its state is written in
//! `bytes`.

use espalier_growth::{Change, Generator, Growth, Observer, Scene, StepInput, StepOutcome};

#[cfg(test)]
use super::tests::forks::Forks;

/// All generators of a document, on one scene.
#[derive(Clone, Debug)]
pub(crate) struct Generators {
    growth: Growth,
    #[cfg(test)]
    forks: Forks,
}

/// One step of one of them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Step {
    /// Buds grow into free space.
    Growth(StepInput),
    /// Every bud becomes a fork.
    #[cfg(test)]
    Fork,
}

impl Generator for Generators {
    type Input = Step;

    /// Who has not made the step itself follows it.
    fn step(&mut self, scene: &mut Scene, input: &Step, observer: &mut impl Observer) -> StepOutcome {
        match input {
            Step::Growth(input) => {
                let outcome = self.growth.step(scene, input, observer);
                #[cfg(test)]
                self.forks.follow(scene, &Change::Edited);
                outcome
            }
            #[cfg(test)]
            Step::Fork => {
                let outcome = self.forks.step(scene, &(), observer);
                self.growth.follow(scene, &Change::Edited);
                outcome
            }
        }
    }

    fn follow(&mut self, scene: &Scene, change: &Change) {
        self.growth.follow(scene, change);
        #[cfg(test)]
        self.forks.follow(scene, change);
    }
}

#[cfg(test)]
impl Generators {
    pub(super) fn forks(&self) -> &Forks {
        &self.forks
    }
}

impl From<Growth> for Generators {
    fn from(growth: Growth) -> Self {
        Self {
            growth,
            #[cfg(test)]
            forks: Forks::default(),
        }
    }
}

impl AsRef<Growth> for Generators {
    fn as_ref(&self) -> &Growth {
        &self.growth
    }
}

impl AsMut<Growth> for Generators {
    fn as_mut(&mut self) -> &mut Growth {
        &mut self.growth
    }
}
