//! Derivation: all modules of a word are rewritten at once, step by step, a slice at a time.

use std::{mem, sync::Arc};

use crate::{
    code::{Machine, Moment},
    contexts::Contexts,
    environment::{Environment, Stand},
    keys::{self, Chance, Products},
    limits::{Limits, Stop},
    program::{Production, Program},
    reading::{FRAME, MOST_PARAMETERS, NoPen, Reading, When, choose, draw, finite, fires, holds},
    symbols::{Action, CUT, POP, PUSH, turtle},
    word::{Tag, Word},
};

/// How often modules that have waited may be rewritten within one step.
const MOST_FIRINGS: u32 = 100;

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
    seed: u32,
    limits: Limits,
    word: Word,
    next: Word,
    step: u32,
    /// The step that the next word is of: 0 while it is the axiom.
    coming: u32,
    phase: Phase,
    at: usize,
    machine: Machine,
    /// Where the modules of the word stand, if the grammar asks.
    stands: Vec<Stand>,
    stopped: Option<Stop>,
    /// The keys of modules and the place of the rule that made them, if that is wanted.
    traced: Option<Vec<(u64, Place)>>,
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
            derivation.emit(&program, tag, values, 0, &mut moment)?;
        }
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

    fn time(&self, step: u32) -> f64 {
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

    /// Works on about so many modules. Surroundings must not change within a step.
    ///
    /// # Errors
    /// Where a budget ends or a number is none; the word stays that of the step before, and nothing goes on.
    pub fn advance(&mut self, surroundings: &dyn Environment, modules: usize) -> Result<Progress, Stop> {
        if let Some(stop) = self.stopped {
            return Err(stop);
        }
        let program = Arc::clone(&self.program);
        let result = self.work(&program, surroundings, modules.max(1));
        if let Err(stop) = result {
            self.stopped = Some(stop);
            self.next = Word::new(program.columns);
            self.phase = Phase::Rest;
        }
        result
    }

    fn work(
        &mut self,
        program: &Program,
        surroundings: &dyn Environment,
        modules: usize,
    ) -> Result<Progress, Stop> {
        if matches!(self.phase, Phase::Rest) {
            self.next.clear();
            self.stands.clear();
            self.at = 0;
            self.phase = match program.asks_places {
                true => Phase::Reading(Box::new(Reading::new(program, self.when(), self.limits.work))),
                false => Phase::Rewriting,
            };
        }
        let end = self.at.saturating_add(modules).min(self.word.len());
        if let Phase::Reading(mut reading) = mem::replace(&mut self.phase, Phase::Rewriting) {
            while self.at < end {
                self.ask(program, &mut reading, surroundings)?;
                self.at += 1;
            }
            match self.at < self.word.len() {
                true => self.phase = Phase::Reading(reading),
                false => self.at = 0,
            }
            return Ok(Progress::Working);
        }
        // Taken out, so that what is read is not what is written.
        let word = mem::take(&mut self.word);
        let rewritten = self.rewrite_until(program, &word, end, surroundings);
        self.word = word;
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
        end: usize,
        surroundings: &dyn Environment,
    ) -> Result<(), Stop> {
        let mut frame = [0.0; FRAME];
        while self.at < end {
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

    /// Appends what a rule makes of a module.
    fn produce(
        &mut self,
        program: &Program,
        rule: &Production,
        of: Tag,
        frame: &[f64],
        firing: Firing,
        moment: &mut Moment<'_>,
    ) -> Result<(), Stop> {
        // Most modules that only change are all that they become, and need no keys.
        let is_heir_alone = rule.heir.is_some() && rule.products.len() == 1;
        let keys = (!is_heir_alone).then(|| Products::of_rule(of.key, self.coming, firing.pass));
        let born = self.coming;
        for (number, product) in rule.products.iter().enumerate() {
            let is_heir = rule.heir == Some(number);
            let tag = Tag {
                symbol: product.symbol,
                key: keys.filter(|_| !is_heir).map_or(of.key, |keys| keys.key(number)),
                born: if is_heir { of.born } else { born },
                time: firing.time,
            };
            if let Some(traced) = self.traced.as_mut().filter(|_| !is_heir) {
                traced.push((tag.key, rule.at));
            }
            if is_plain(program, tag) {
                self.next.push(tag, &self.limits)?;
                for code in &product.arguments {
                    let value = finite(self.machine.run(code, frame, moment), rule)?;
                    self.next.push_parameter(value);
                }
                continue;
            }
            let mut values = [0.0; MOST_PARAMETERS];
            for (value, code) in values.iter_mut().zip(&product.arguments) {
                *value = finite(self.machine.run(code, frame, moment), rule)?;
            }
            self.emit(program, tag, &values[..product.arguments.len()], firing.pass, moment)?;
        }
        Ok(())
    }

    /// Appends a module, or what decomposition and the time that has passed make of it at once.
    fn emit(
        &mut self,
        program: &Program,
        tag: Tag,
        parameters: &[f64],
        pass: u32,
        moment: &mut Moment<'_>,
    ) -> Result<(), Stop> {
        let decomposition = &program.decomposition;
        let candidates = decomposition.of(tag.symbol);
        if !candidates.is_empty() {
            self.machine.work += 1;
            let found = choose(&mut self.machine, candidates, &decomposition.rules, parameters, moment)?;
            if let Some(chosen) = found {
                let firing = Firing { time: tag.time, pass: pass + 1 };
                let most = program.decomposition_depth;
                let frame = chosen.frame(parameters);
                return self.again(program, chosen.rule, tag, frame, firing, most, moment);
            }
        }
        let lifespan = program.lifespans.get(tag.symbol as usize).copied().flatten();
        let now = self.time(self.coming);
        if let Some(lifespan) = lifespan.filter(|&lifespan| is_over(now - tag.time, lifespan)) {
            let rules = &program.rules;
            let candidates = rules.of(tag.symbol);
            let found = choose(&mut self.machine, candidates, &rules.rules, parameters, moment)?;
            if let Some(chosen) = found {
                let firing = Firing { time: tag.time + lifespan, pass: pass + 1 };
                let frame = chosen.frame(parameters);
                return self.again(program, chosen.rule, tag, frame, firing, MOST_FIRINGS, moment);
            }
        }
        self.next.push(tag, &self.limits)?;
        self.next.push_parameters(parameters);
        Ok(())
    }

    #[expect(
        clippy::too_many_arguments,
        reason = "two callers, and a struct of them would have no meaning of its own"
    )]
    fn again(
        &mut self,
        program: &Program,
        rule: &Production,
        tag: Tag,
        parameters: &[f64],
        firing: Firing,
        most: u32,
        moment: &mut Moment<'_>,
    ) -> Result<(), Stop> {
        if firing.pass > most {
            let (line, column) = rule.at;
            return Err(Stop::Endless { line, column, most });
        }
        if self.machine.work >= self.limits.work {
            return Err(Stop::Work(self.limits.work));
        }
        self.produce(program, rule, tag, parameters, firing, moment)
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

/// When rules have acted on a module in a step.
#[derive(Clone, Copy, Debug)]
struct Firing {
    /// The time at which what it becomes begins.
    time: f64,
    /// How often rules have acted on it before in this step.
    pass: u32,
}

/// Whether a time has passed, but for rounding.
fn is_over(age: f64, lifespan: f64) -> bool {
    age >= lifespan - 1e-9
}

/// Whether a new module is appended as it is.
fn is_plain(program: &Program, tag: Tag) -> bool {
    let waits = program.lifespans.get(tag.symbol as usize).is_some_and(Option::is_some);
    program.decomposition.of(tag.symbol).is_empty() && !waits
}
