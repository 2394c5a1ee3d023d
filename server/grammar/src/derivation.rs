//! Derivation: all modules of a word are rewritten at once, step by step, a slice at a time.

use std::{mem, sync::Arc};

use crate::{
    code::{Machine, Moment},
    contexts::Contexts,
    environment::{Environment, Stand},
    keys::{self, Chance},
    limits::{Limits, MADE_FOR_EACH, Stop, WORK_FOR_EACH},
    producing::{Firing, Made, is_over},
    program::{Production, Program},
    reading::{FRAME, MOST_PARAMETERS, NoPen, Reading, When, draw, fires, holds},
    symbols::{Action, CUT, POP, PUSH, turtle},
    word::{Tag, Word},
};

/// How far a slice of work has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress {
    /// The step goes on.
    Working,
    /// A step has ended.
    Stepped,
}

#[derive(Clone, Debug)]
enum Phase {
    /// Between steps.
    Rest,
    /// Finding out where modules stand.
    Reading(Box<Reading>),
    Rewriting,
}

/// A word on its way.
#[derive(Clone, Debug)]
pub struct Derivation {
    program: Arc<Program>,
    pub(crate) seed: u32,
    pub(crate) limits: Limits,
    word: Word,
    pub(crate) next: Word,
    step: u32,
    /// The step that the next word is of: 0 while it is the axiom.
    pub(crate) coming: u32,
    phase: Phase,
    at: usize,
    pub(crate) machine: Machine,
    /// Where the modules of the word stand, if the grammar asks.
    stands: Vec<Stand>,
    stopped: Option<Stop>,
    /// The keys of modules and the place of the rule that made them, if that is wanted.
    pub(crate) traced: Option<Vec<(u64, Place)>>,
    pub(crate) made: Made,
    /// Modules that slices have taken and made.
    touched: u64,
}

/// The line and column of a rule.
pub type Place = (u32, u32);

impl Derivation {
    /// The axiom.
    ///
    /// # Errors
    /// Where it is too large, or a number of it is none.
    pub fn new(program: Arc<Program>, seed: u32, limits: Limits) -> Result<Self, Stop> {
        Self::begin(program, seed, limits, None)
    }

    /// The axiom of a derivation that notes which rule makes each module, for [`Derivation::origins`].
    ///
    /// # Errors
    /// As [`Derivation::new`] does.
    pub fn traced(program: Arc<Program>, seed: u32, limits: Limits) -> Result<Self, Stop> {
        Self::begin(program, seed, limits, Some(Vec::new()))
    }

    fn begin(
        program: Arc<Program>,
        seed: u32,
        limits: Limits,
        traced: Option<Vec<(u64, Place)>>,
    ) -> Result<Self, Stop> {
        let columns = program.columns;
        let mut derivation = Self {
            program: Arc::clone(&program),
            seed,
            limits,
            word: Word::new(columns),
            next: Word::new(columns),
            step: 0,
            coming: 0,
            phase: Phase::Rest,
            at: 0,
            machine: Machine::new(),
            stands: Vec::new(),
            stopped: None,
            traced,
            made: Made::default(),
            touched: 0,
        };
        let start =
            Stand { place: glam::DVec3::ZERO, heading: glam::DVec3::Y, order: 0, below: 0, branch: 0 };
        for (number, product) in program.axiom.iter().enumerate() {
            let key = keys::axiom(number);
            let tag = Tag { symbol: product.symbol, key, born: 0, time: 0.0 };
            let mut moment = Moment {
                step: 0.0,
                age: 0.0,
                chance: Chance::new(seed, key, 0),
                stand: Some(&start),
                environment: &crate::environment::OpenSky,
                curves: &program.curves,
            };
            let mut values = [0.0; MOST_PARAMETERS];
            for (value, code) in values.iter_mut().zip(&product.arguments) {
                *value = derivation.machine.run(code, &[], &mut moment);
                if !value.is_finite() {
                    let (line, column) = program.axiom_at;
                    return Err(Stop::NoNumber { line, column });
                }
            }
            let values = &values[..product.arguments.len()];
            derivation.made.of_one = 0;
            derivation.emit(&program, tag, values, 0, &mut moment)?;
        }
        derivation.touched = (derivation.next.len() + derivation.made.in_step) as u64;
        mem::swap(&mut derivation.word, &mut derivation.next);
        derivation.coming = 1;
        Ok(derivation)
    }

    /// The word of the last step that has ended.
    pub fn word(&self) -> &Word {
        &self.word
    }

    /// How many steps have ended.
    pub fn depth(&self) -> u32 {
        self.step
    }

    /// The keys of modules in ascending order, each with the line and column of the rule that made it; those of the axiom
    /// are not among them. A module that goes on keeps the rule that it began with.
    pub fn origins(&self) -> Vec<(u64, Place)> {
        let mut origins = self.traced.clone().unwrap_or_default();
        origins.sort_unstable();
        origins.dedup_by_key(|(key, _)| *key);
        origins
    }

    /// The grammar with its values.
    pub fn program(&self) -> &Arc<Program> {
        &self.program
    }

    /// Bytes that words take while it goes on: that of the last step and the one being made.
    pub fn bytes(&self) -> usize {
        self.word.bytes() + self.next.bytes() + size_of_val(&*self.stands)
    }

    pub(crate) fn is_traced(&self) -> bool {
        self.traced.is_some()
    }

    pub(crate) fn limits(&self) -> &Limits {
        &self.limits
    }

    pub(crate) fn when(&self) -> When {
        When { seed: self.seed, step: self.step, time: self.time(self.step) }
    }

    pub(crate) fn time(&self, step: u32) -> f64 {
        f64::from(step) * self.program.time_step
    }

    /// Derives one whole step.
    ///
    /// # Errors
    /// Where a budget ends or a number is none; the word stays that of the step before.
    pub fn step(&mut self, surroundings: &dyn Environment) -> Result<(), Stop> {
        while self.advance(surroundings, usize::MAX)? == Progress::Working {}
        Ok(())
    }

    /// Derives until so many steps have been taken in all.
    ///
    /// # Errors
    /// As [`Derivation::step`] does.
    pub fn derive(&mut self, depth: u32, surroundings: &dyn Environment) -> Result<(), Stop> {
        while self.step < depth {
            self.step(surroundings)?;
        }
        Ok(())
    }

    /// What it has cost: modules that it has taken and made, and steps of computing.
    pub fn work(&self) -> u64 {
        self.touched + self.machine.work
    }

    /// Works on so many modules, or fewer that make many others or compute long. Surroundings must not change within a
    /// step.
    ///
    /// # Errors
    /// Where a budget ends or a number is none; the word stays that of the step before, and nothing goes on.
    pub fn advance(&mut self, surroundings: &dyn Environment, modules: usize) -> Result<Progress, Stop> {
        if let Some(stop) = self.stopped {
            return Err(stop);
        }
        let program = Arc::clone(&self.program);
        let result = self.go_on(&program, surroundings, modules.max(1));
        if let Err(stop) = result {
            self.stopped = Some(stop);
            self.next = Word::new(program.columns);
            self.phase = Phase::Rest;
        }
        result
    }

    fn go_on(
        &mut self,
        program: &Program,
        surroundings: &dyn Environment,
        modules: usize,
    ) -> Result<Progress, Stop> {
        if matches!(self.phase, Phase::Rest) {
            self.next.clear();
            self.stands.clear();
            self.at = 0;
            self.made = Made::default();
            self.phase = match program.asks_places {
                true => Phase::Reading(Box::new(Reading::new(program, self.when(), &self.limits))),
                false => Phase::Rewriting,
            };
        }
        let from = self.at;
        let end = from.saturating_add(modules).min(self.word.len());
        if let Phase::Reading(mut reading) = mem::replace(&mut self.phase, Phase::Rewriting) {
            let until = reading.cost.until(modules);
            let before = reading.cost;
            let mut asked = Ok(());
            while self.at < end && reading.cost.is_below(&until) && asked.is_ok() {
                asked = self.ask(program, &mut reading, surroundings);
                self.at += 1;
            }
            self.touched += (self.at - from) as u64 + reading.cost.since(&before);
            asked?;
            match self.at < self.word.len() {
                true => self.phase = Phase::Reading(reading),
                false => self.at = 0,
            }
            return Ok(Progress::Working);
        }
        // Taken out, so that what is read is not what is written.
        let word = mem::take(&mut self.word);
        let before = self.next.len() + self.made.in_step;
        let work_end = self.machine.work.saturating_add(WORK_FOR_EACH.saturating_mul(modules as u64));
        let made_end = before.saturating_add(MADE_FOR_EACH.saturating_mul(modules));
        let rewritten = self.rewrite_until(program, &word, [end, made_end], work_end, surroundings);
        self.word = word;
        self.touched += (self.at - from + self.next.len() + self.made.in_step - before) as u64;
        rewritten?;
        if self.at < self.word.len() {
            return Ok(Progress::Working);
        }
        mem::swap(&mut self.word, &mut self.next);
        self.step += 1;
        self.coming += 1;
        self.phase = Phase::Rest;
        Ok(Progress::Stepped)
    }

    /// Notes where a module stands, and fills in what it asks.
    fn ask(
        &mut self,
        program: &Program,
        reading: &mut Reading,
        surroundings: &dyn Environment,
    ) -> Result<(), Stop> {
        let state = reading.turtle.state;
        let stand = reading.turtle.stand();
        self.stands.push(stand);
        match turtle(self.word.symbol(self.at)).map(|row| row.action) {
            Some(Action::AskPlace) => self.word.fill(self.at, &(state.place / program.scale).to_array()),
            Some(Action::AskHeading) => self.word.fill(self.at, &state.heading.to_array()),
            Some(Action::AskUp) => self.word.fill(self.at, &state.up.to_array()),
            Some(Action::AskLeft) => self.word.fill(self.at, &state.left.to_array()),
            Some(Action::AskLight) => self.word.fill(self.at, &[surroundings.light(&stand)]),
            _ => {}
        }
        reading.read(program, &self.word, self.at, surroundings, &mut NoPen)
    }

    /// Rewrites a part of a word, and copies what has no rules in whole runs.
    fn rewrite_until(
        &mut self,
        program: &Program,
        word: &Word,
        [end, made_end]: [usize; 2],
        work_end: u64,
        surroundings: &dyn Environment,
    ) -> Result<(), Stop> {
        let mut frame = [0.0; FRAME];
        while self.at < end && self.machine.work < work_end && self.next.len() + self.made.in_step < made_end
        {
            let run = word.run(self.at..end, &program.active);
            if run > 0 {
                self.next.extend_from(word, self.at..self.at + run, &self.limits)?;
                self.at += run;
                continue;
            }
            self.at = self.rewrite(program, word, &mut frame, surroundings)?;
            if self.machine.work >= self.limits.work {
                return Err(Stop::Work(self.limits.work));
            }
        }
        Ok(())
    }

    /// Rewrites or copies a module; returns which is next.
    fn rewrite(
        &mut self,
        program: &Program,
        word: &Word,
        frame: &mut [f64; FRAME],
        surroundings: &dyn Environment,
    ) -> Result<usize, Stop> {
        let at = self.at;
        self.made.of_one = 0;
        let tag = word.tag(at);
        let parameters = word.parameters(at);
        let stand = self.stands.get(at);
        let stand = stand.copied();
        let now = self.time(self.coming);
        let lifespan = program.lifespans.get(tag.symbol as usize).copied().flatten();
        let mut moment = Moment {
            step: self.step.into(),
            age: match program.columns.times {
                true => now - tag.time,
                false => f64::from(self.step - tag.born),
            },
            chance: Chance::new(self.seed, tag.key, self.step),
            stand: stand.as_ref(),
            environment: surroundings,
            curves: &program.curves,
        };
        let is_due = lifespan.is_none_or(|lifespan| is_over(now - tag.time, lifespan));
        let found = if is_due { self.find(program, word, frame, &mut moment)? } else { None };
        let Some((rule, is_framed)) = found else {
            self.emit(program, tag, parameters, 0, &mut moment)?;
            return Ok(if tag.symbol == CUT { end_of_branch(word, at) } else { at + 1 });
        };
        let time = lifespan.map_or(now, |lifespan| tag.time + lifespan);
        let frame = if is_framed { &frame[..] } else { parameters };
        self.produce(program, rule, tag, frame, Firing { time, pass: 0 }, &mut moment)?;
        Ok(at + 1)
    }

    /// The rule that acts on the next module, and whether parameters are in the frame.
    fn find<'a>(
        &mut self,
        program: &'a Program,
        word: &Word,
        frame: &mut [f64; FRAME],
        moment: &mut Moment<'_>,
    ) -> Result<Option<(&'a Production, bool)>, Stop> {
        let at = self.at;
        let rules = &program.rules.rules;
        let parameters = word.parameters(at);
        for &number in program.rules.of(word.symbol(at)) {
            let rule = &rules[number as usize];
            if usize::from(rule.arity) != parameters.len() || rule.is_later {
                continue;
            }
            if rule.left.is_empty() && rule.right.is_empty() && rule.locals.is_empty() {
                if holds(&mut self.machine, rule, parameters, moment)? {
                    let rule = draw(&mut self.machine, rule, rules, parameters, moment)?;
                    return Ok(Some((rule, false)));
                }
                continue;
            }
            let mut contexts =
                Contexts { word, program, frame, work: &mut self.machine.work, most: self.limits.work };
            if !contexts.lie_below(at, &rule.left) || contexts.lie_above(at + 1, &rule.right).is_none() {
                continue;
            }
            let own = usize::from(rule.own);
            frame[own..own + parameters.len()].copy_from_slice(parameters);
            if fires(&mut self.machine, rule, frame, moment)? {
                let rule = draw(&mut self.machine, rule, rules, frame, moment)?;
                return Ok(Some((rule, true)));
            }
        }
        Ok(None)
    }
}

/// Where the branch ends that a module lies in.
fn end_of_branch(word: &Word, from: usize) -> usize {
    let mut open = 0;
    for at in from + 1..word.len() {
        match word.symbol(at) {
            PUSH => open += 1,
            POP if open == 0 => return at,
            POP => open -= 1,
            _ => {}
        }
    }
    word.len()
}
