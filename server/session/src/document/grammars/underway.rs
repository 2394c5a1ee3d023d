//! The first step that a command has a grammar write: whole in one slice as a rule, or in several between which others
//! have their turn. Until it stands nothing has happened, and where it cannot stand, or somebody stops it, nothing has.

use espalier_growth::NoObserver;
use espalier_plant::Future;
use espalier_proto::{Problem, Reason};

use super::{Write, commands::WHOLE};
use crate::document::{Document, futures::Recorded, generators::Step, growing::Pending, history::Latest};

/// What the same gesture has written before, set aside until what takes its place stands.
#[derive(Clone, Debug)]
pub(super) struct Former {
    pub future: Future,
    /// The step that it led to.
    pub step: u32,
    pub latest: Option<Latest>,
}

/// What comes after it stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct After {
    /// The operation keeps where wood was that has moved.
    pub keeps_places: bool,
    /// So many more steps are derived.
    pub derives: u32,
    /// Another one of the same gesture may take its place.
    pub notes_latest: bool,
}

/// A step on its way, and how to take back that it was begun.
#[derive(Clone, Debug)]
pub(in crate::document) struct Underway {
    write: Write,
    recorded: Option<Recorded>,
    former: Option<Former>,
    after: After,
    /// The step of the plants that it began from.
    base: u32,
    /// Slices that count as steps begun.
    slices: u32,
}

/// What came of a slice.
enum Came {
    InPart,
    Whole,
    Refused(Problem),
}

impl Underway {
    pub(super) fn new(
        write: Write,
        recorded: Option<Recorded>,
        former: Option<Former>,
        after: After,
        base: u32,
    ) -> Self {
        Self { write, recorded, former, after, base, slices: 0 }
    }

    /// Steps that are still to be written.
    pub(in crate::document) fn steps(&self) -> u32 {
        1 + self.after.derives
    }
}

impl Document {
    /// Whether plants stand as they never were, for what was there is set aside: nobody is to see that.
    pub(crate) fn is_between(&self) -> bool {
        self.underway.as_ref().is_some_and(|underway| underway.former.is_some())
    }

    /// Whether it is still open what becomes of the command taken on last.
    pub(crate) fn is_undecided(&self) -> bool {
        self.underway.is_some() || self.trials() > 0
    }

    /// What became of the command taken on last, where that was not known when it was taken on.
    ///
    /// # Errors
    /// Why it was refused then.
    pub fn take_outcome(&mut self) -> Result<(), Problem> {
        self.outcome.take().unwrap_or(Ok(()))
    }

    /// Writes the first slice, so that a grammar which cannot is refused at once as a rule.
    pub(super) fn begin_writing(&mut self, mut underway: Underway) -> Result<(), Problem> {
        let mut came = self.write_slice(&mut underway);
        if matches!(came, Came::InPart) && underway.slices == 0 {
            came = self.write_slice(&mut underway);
        }
        match came {
            Came::InPart => {
                self.underway = Some(Box::new(underway));
                self.pending.push_back(Pending::Write);
                Ok(())
            }
            Came::Whole => {
                self.end_writing(underway);
                Ok(())
            }
            Came::Refused(problem) => {
                self.take_back_writing(underway);
                Err(problem)
            }
        }
    }

    /// Writes the next slice; whether the step stands now. A stop ends it, but not before its first slice: whatever takes no
    /// longer is done.
    pub(in crate::document) fn go_on_writing(&mut self) -> bool {
        let Some(mut underway) = self.underway.take() else { return false };
        if underway.slices > 0 && self.is_stopped() {
            self.simulation.generator_mut().give_up_writing();
            self.take_back_writing(*underway);
            self.outcome = Some(Ok(()));
            return false;
        }
        let counted = underway.slices;
        match self.write_slice(&mut underway) {
            Came::InPart => {
                self.underway = Some(underway);
                self.pending.push_front(Pending::Write);
                false
            }
            Came::Whole => {
                self.end_writing(*underway);
                self.forget_futures();
                self.outcome = Some(Ok(()));
                true
            }
            Came::Refused(problem) => {
                self.take_back_writing(*underway);
                self.steps_begun = self.steps_begun.wrapping_sub(counted);
                self.outcome = Some(Err(problem));
                false
            }
        }
    }

    fn write_slice(&mut self, underway: &mut Underway) -> Came {
        let begun = self.steps_begun;
        self.step(&Step::Write(underway.write.clone()), None, &mut NoObserver);
        underway.slices += self.steps_begun.wrapping_sub(begun);
        let generator = self.simulation.generator();
        if generator.grammars().is_writing() {
            return Came::InPart;
        }
        let Some(refusal) = generator.refusal().map(ToString::to_string) else {
            self.reach();
            return Came::Whole;
        };
        self.steps_begun = begun;
        let message = format!("the grammar cannot be derived so far: {refusal}");
        let problem = Problem::new(Reason::GrammarEnds, message)
            .at("kind", "a grammar within the limits of the document");
        Came::Refused(Problem { cause: Some(refusal), ..problem })
    }

    fn end_writing(&mut self, underway: Underway) {
        let After { keeps_places, derives, notes_latest } = underway.after;
        if keeps_places {
            self.keep_what_moved();
        }
        if notes_latest {
            let step = self.plant().step();
            let latest = Latest { step, row: WHOLE, rotation: None };
            self.history.latest = (step > underway.base).then_some(latest);
        }
        if derives > 0 {
            let step = Step::Write(Write::Derive);
            self.pending.push_front(Pending::Steps { left: derives, has_grown: false, step });
        }
    }

    fn take_back_writing(&mut self, underway: Underway) {
        if let Some(recorded) = underway.recorded {
            self.refuse(recorded);
        }
        if let Some(Former { future, step, latest }) = underway.former {
            self.take_up(future, step);
            if latest.is_some() {
                self.history.latest = latest;
            }
        }
    }
}
