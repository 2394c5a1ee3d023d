//! Growing a tree without anybody who draws: from what, with which settings, how far. The command line and the jobs of the
//! API grow by the same recipes.

use std::{ops::RangeInclusive, str::FromStr};

use espalier_growth::species::Species;
use espalier_proto::{Action, Command, Problem, Steps};
use espalier_session::{Document, Principal, script};
use espalier_settings::{AppearancePatch, ParametersPatch};

/// A tree that adds nothing in so many steps will not add anything any more.
const PATIENCE: u32 = 50;

/// How one tree for each seed is grown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recipe {
    /// What is set and grown first.
    pub script: Vec<Action>,
    /// Parameters that are set by hand, at every age.
    pub parameters: ParametersPatch,
    /// Looks that are set by hand.
    pub appearance: AppearancePatch,
    /// Steps to grow after the script.
    pub steps: Option<Steps>,
    /// Living metamers to grow on to.
    pub metamers: Option<u32>,
    /// The most metamers, dead ones included.
    pub budget: u32,
}

/// The tree cannot be grown; each message is one sentence.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GrowError {
    /// A command is refused.
    #[error("The tree cannot be grown: {0}.")]
    Refused(Problem),
    /// The tree does not get that large.
    #[error("The tree stopped growing with {alive} of {wanted} metamers.")]
    Stalled {
        /// Living metamers reached.
        alive: u32,
        /// Living metamers asked for.
        wanted: u32,
    },
    /// Nobody wants it any more.
    #[error("The tree was given up.")]
    GivenUp,
    /// There is no memory for it.
    #[error("The server has no memory left to grow the tree on; order it again later.")]
    NoMemory,
}

impl From<Problem> for GrowError {
    fn from(problem: Problem) -> Self {
        Self::Refused(problem)
    }
}

/// Seeds one after the other, as in 1-50, or one alone.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SeedRange(pub RangeInclusive<u32>);

impl FromStr for SeedRange {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let seed = |text: &str| {
            let is_number = text.bytes().all(|byte| byte.is_ascii_digit());
            text.parse::<u32>().ok().filter(|_| is_number)
        };
        let (from, to) = text.split_once('-').unwrap_or((text, text));
        let ends = seed(from).zip(seed(to));
        let (from, to) = ends.ok_or("write them as FROM-TO, such as 1-50, or one as it is")?;
        if from <= to { Ok(Self(from..=to)) } else { Err(format!("{from} comes after {to}")) }
    }
}

/// Does commands to a document.
pub trait Gardener {
    /// The document.
    fn document(&self) -> &Document;
    /// Does a command with all its steps.
    fn act(&mut self, command: &Command) -> Result<(), GrowError>;
}

impl Recipe {
    /// The life of a species.
    pub fn of(species: &Species) -> Self {
        Self { script: script(species), ..Self::default() }
    }

    /// What it grows from.
    ///
    /// # Errors
    /// Where a parameter is out of range.
    pub fn seedling(&self, seed: u32) -> Result<Document, Problem> {
        let mut document = if self.script.is_empty() {
            let wanted = Document::new(seed).parameters().patched(&self.parameters);
            Document::with_parameters(seed, &wanted)?
        } else {
            Document::new(seed)
        };
        document.set_metamer_budget(self.budget);
        Ok(document)
    }

    /// Grows what [`Recipe::seedling`] gave. Answers with the living metamers that there were when the script and the steps
    /// were done.
    pub fn grow(&self, gardener: &mut impl Gardener) -> Result<u32, GrowError> {
        for action in self.actions() {
            gardener.act(&action.into())?;
        }
        // One operation for undo, however many steps it takes.
        let step = Command {
            gesture: Some(1),
            ..Action::Grow { steps: Steps::LEAST, until: None, bud: None }.into()
        };
        let (wanted, before) = (self.metamers.unwrap_or(0), gardener.document().metamers());
        let (mut most, mut idle) = (0, 0);
        while gardener.document().metamers() < wanted {
            let alive = gardener.document().metamers();
            (most, idle) = if alive > most { (alive, 0) } else { (most, idle + 1) };
            let stalled = GrowError::Stalled { alive, wanted };
            if idle == PATIENCE {
                return Err(stalled);
            }
            gardener.act(&step).map_err(|error| match error {
                GrowError::GivenUp | GrowError::NoMemory => error,
                _ => stalled,
            })?;
        }
        Ok(before)
    }

    /// Tries what it sets, and grows nothing.
    ///
    /// # Errors
    /// Where something is out of range.
    pub fn check(&self) -> Result<(), Problem> {
        let mut document = self.seedling(0).map_err(|problem| problem.within("parameters"))?;
        let mut sets = self.actions().filter(|action| !matches!(action, Action::Grow { .. }));
        sets.try_for_each(|action| document.apply(&Principal::visitor(), &action.into()))
    }

    fn actions(&self) -> impl Iterator<Item = Action> {
        let by_hand =
            |grows: bool| grows.then(|| Action::SetParameters { parameters: self.parameters.clone() });
        let script = self.script.iter().cloned().flat_map(move |action| {
            by_hand(matches!(action, Action::Grow { .. })).into_iter().chain([action])
        });
        let looks = (self.appearance != AppearancePatch::default())
            .then_some(Action::SetAppearance { appearance: self.appearance });
        let steps = self.steps.map(|steps| Action::Grow { steps, until: None, bud: None });
        script.chain(looks).chain(steps)
    }
}
