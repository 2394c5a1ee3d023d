//! Which values limbs say themselves: those that bring most to its place, as many as are worth it.

use super::{
    Fitted, Unfit,
    writing::{Said, Wish},
};
use crate::{key::Key, refusal::MAX_VALUES};

/// How much of the crown a value must bring to its place to be said.
const WORTH: f32 = 1.0 / 6000.0;
/// How much it must bring to be said still when all others are known.
const WORTH_IN_THE_END: f32 = 1.0 / 4000.0;
/// Crowns that have so much in common are alike: what is beyond counts less.
const ALIKE: f32 = 0.905;
const BEYOND: f32 = 0.3;
/// Values tried together at first.
const FIRST_ROUND: usize = 4;
/// Most values of a kind tried together: siblings are compared with each other.
const MOST_OF_ROUND: usize = 128;
/// Most designs in which something more is said, and most in which something is said no longer.
const MOST_WITH: u32 = 150;
const MOST_WITHOUT: u32 = 150;
/// Values that are tried without at first, all together.
const FIRST_WITHOUT: usize = 16;
/// Values that limbs may say for the sake of the silhouette.
const KINDS: [Key; 6] =
    [Key::Reach, Key::Turn, Key::Axis, Key::Density, Key::Silhouette, Key::BranchingAngle];
/// Values that together say where a limb stands.
const PLACE: [Key; 3] = [Key::Reach, Key::Turn, Key::Axis];

/// A design that was tried, and what its limbs might say besides.
pub(super) type Tried = (Fitted, Vec<Wish>);

/// A search for the design of the best score, one design at a time.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Search {
    best: Fitted,
    said: Said,
    /// What limbs might still say of their form, and what else.
    forms: Vec<Wish>,
    others: Vec<Wish>,
    /// Values of a kind that are tried together.
    count: usize,
    with: u32,
    without: u32,
    stage: Stage,
}

#[derive(Clone, Debug, PartialEq)]
enum Stage {
    /// Sets of values are tried, each by itself; those that were better are kept with their scores.
    Alone {
        sets: Vec<Vec<Wish>>,
        better: Vec<(f32, Vec<Wish>)>,
        is_last: bool,
    },
    /// Those that were better are tried together, the best one first.
    Together {
        sets: Vec<Vec<Wish>>,
    },
    /// Parts of what is said are tried without.
    Without {
        size: usize,
        parts: Vec<Vec<(usize, Key)>>,
        is_worse: bool,
    },
    Over,
}

/// What speaks for a fitted design: its overlap, less what its values cost.
fn score(fitted: &Fitted, worth: f32) -> f32 {
    let beyond = (fitted.overlap - ALIKE).max(0.0);
    fitted.overlap.min(ALIKE) + BEYOND * beyond - worth * fitted.records as f32
}

impl Search {
    /// Begins with a design in which no limb says anything.
    pub(super) fn new((best, wishes): Tried) -> Self {
        let (forms, others) = wishes.into_iter().partition(Wish::is_of_form);
        let mut search = Self {
            best,
            said: Said::default(),
            forms,
            others,
            count: FIRST_ROUND,
            with: 0,
            without: 0,
            stage: Stage::Over,
        };
        search.stage = search.round();
        search
    }

    /// The best design so far.
    pub(super) fn best(&self) -> &Fitted {
        &self.best
    }

    /// The best design, what its limbs say, and what they might still say of their form.
    pub(super) fn found(self) -> (Fitted, Said, Vec<Wish>) {
        (self.best, self.said, self.forms)
    }

    /// Designs that are still to be tried, at most.
    pub(super) fn left(&self) -> u32 {
        let without = MOST_WITHOUT.saturating_sub(self.without);
        match self.stage {
            Stage::Over => 0,
            Stage::Without { .. } => without.max(1),
            _ => MOST_WITH.saturating_sub(self.with) + without,
        }
    }

    /// Tries one more design, or decides what is tried next; false when there is nothing more.
    pub(super) fn step(&mut self, tried: impl Fn(&Said) -> Result<Tried, Unfit>) -> bool {
        let stage = std::mem::replace(&mut self.stage, Stage::Over);
        self.stage = match stage {
            Stage::Alone { mut sets, mut better, is_last } => match sets.pop() {
                Some(set) if self.with < MOST_WITH => {
                    self.with += 1;
                    // It may have more branches than a design has.
                    if let Some((fitted, _)) = self.tried_with(&set, tried)
                        && score(&fitted, WORTH) > score(&self.best, WORTH)
                    {
                        better.push((score(&fitted, WORTH), set));
                    }
                    Stage::Alone { sets, better, is_last }
                }
                _ if !better.is_empty() => {
                    better.sort_by(|a, b| a.0.total_cmp(&b.0));
                    Stage::Together { sets: better.into_iter().map(|(_, set)| set).collect() }
                }
                _ if is_last || self.count >= MOST_OF_ROUND || self.with >= MOST_WITH => {
                    self.parts(FIRST_WITHOUT)
                }
                _ => {
                    self.count *= 2;
                    self.round()
                }
            },
            Stage::Together { mut sets } => match sets.pop() {
                Some(set) if self.with < MOST_WITH => {
                    self.with += 1;
                    if let Some((fitted, wishes)) = self.tried_with(&set, tried)
                        && score(&fitted, WORTH) > score(&self.best, WORTH)
                    {
                        self.said.add(&set);
                        (self.best, self.others) = (fitted, wishes);
                        self.forms.retain(|wish| !self.said.has(wish.limb, wish.key));
                    }
                    Stage::Together { sets }
                }
                _ => self.round(),
            },
            Stage::Without { size, mut parts, mut is_worse } => match parts.pop() {
                Some(part) if self.without < MOST_WITHOUT => {
                    self.without += 1;
                    let said = self.said.without(&part);
                    match tried(&said) {
                        Ok((fitted, _))
                            if score(&fitted, WORTH_IN_THE_END) >= score(&self.best, WORTH_IN_THE_END) =>
                        {
                            (self.best, self.said) = (fitted, said);
                        }
                        _ => is_worse = true,
                    }
                    Stage::Without { size, parts, is_worse }
                }
                None if size > 1 && is_worse => self.parts(size / 2),
                _ => Stage::Over,
            },
            Stage::Over => Stage::Over,
        };
        !matches!(self.stage, Stage::Over)
    }

    fn tried_with(&self, set: &[Wish], tried: impl Fn(&Said) -> Result<Tried, Unfit>) -> Option<Tried> {
        if self.best.records + set.len() > MAX_VALUES {
            return None;
        }
        let mut said = self.said.clone();
        said.add(set);
        tried(&said).ok()
    }

    /// What might be said next: of each kind the values that bring most, and all that says where some limbs stand.
    fn round(&self) -> Stage {
        let of = |keys: &[Key]| {
            let wishes = self.forms.iter().chain(&self.others);
            let mut wishes: Vec<Wish> = wishes.filter(|wish| keys.contains(&wish.key)).copied().collect();
            wishes.sort_by(|a, b| b.gain.total_cmp(&a.gain).then(a.limb.cmp(&b.limb)));
            wishes
        };
        let most = |mut wishes: Vec<Wish>| {
            wishes.truncate(self.count);
            wishes
        };
        let mut sets: Vec<Vec<Wish>> = KINDS.iter().map(|&kind| most(of(&[kind]))).collect();
        let is_last = sets.iter().all(|set| set.len() < self.count);
        let places = of(&PLACE);
        let limbs: Vec<usize> = places.iter().take(self.count).map(|wish| wish.limb).collect();
        sets.push(places.into_iter().filter(|wish| limbs.contains(&wish.limb)).collect());
        sets.push(most(of(&PLACE)));
        sets.retain(|set| !set.is_empty());
        Stage::Alone { sets, better: Vec::new(), is_last }
    }

    /// What is said, in parts of a size.
    fn parts(&self, size: usize) -> Stage {
        let all: Vec<(usize, Key)> = self.said.all().collect();
        let parts = all.chunks(size).map(<[_]>::to_vec).collect();
        Stage::Without { size, parts, is_worse: false }
    }
}
