//! Reads a word with the turtle, module by module, each as the homomorphism has it.

use espalier_plant::{OrganKind, Stance};
use glam::DVec3;

use crate::{
    code::{Machine, Moment},
    environment::Environment,
    keys::{Chance, Products, WHILE_READING},
    limits::{Limits, MADE_FOR_EACH, MOST_OF_ONE, READ_FOR_EACH, Stop, WORK_FOR_EACH},
    program::{Production, Program},
    symbols::Action,
    turtle::{Moved, State, Turtle},
    word::{Tag, Word},
};

/// Parameters of a predecessor with its contexts and the numbers that a rule names at most.
pub(crate) const FRAME: usize = 64;
/// Parameters of a module at most.
pub(crate) const MOST_PARAMETERS: usize = 16;

/// What follows what the turtle does.
pub(crate) trait Pen {
    /// A branch begins.
    fn push(&mut self) -> Result<(), Stop>;
    /// A branch ends.
    fn pop(&mut self) -> Result<(), Stop>;
    /// A step was drawn.
    fn draw(&mut self, turtle: &State, tag: Tag) -> Result<(), Stop>;
    /// The turtle went elsewhere.
    fn jump(&mut self, turtle: &State) -> Result<(), Stop>;
    /// A module that goes on growing stands here.
    fn apex(&mut self, turtle: &State);
    /// The rest of the branch is cut off.
    fn cut(&mut self);
    /// An organ stands here, with a length in internodes if it has one of its own.
    fn organ(&mut self, kind: OrganKind, stance: &Stance, length: Option<f64>) -> Result<(), Stop>;
}

/// Draws nothing.
pub(crate) struct NoPen;

impl Pen for NoPen {
    fn push(&mut self) -> Result<(), Stop> {
        Ok(())
    }
    fn pop(&mut self) -> Result<(), Stop> {
        Ok(())
    }
    fn draw(&mut self, _: &State, _: Tag) -> Result<(), Stop> {
        Ok(())
    }
    fn jump(&mut self, _: &State) -> Result<(), Stop> {
        Ok(())
    }
    fn apex(&mut self, _: &State) {}
    fn cut(&mut self) {}
    fn organ(&mut self, _: OrganKind, _: &Stance, _: Option<f64>) -> Result<(), Stop> {
        Ok(())
    }
}

/// A surface that has begun.
#[derive(Clone, Copy, Debug)]
struct Surface {
    /// Surfaces within it that have begun.
    within: u32,
    /// Branches within it that have begun.
    branches: u32,
    /// Where it began.
    from: DVec3,
    /// The farthest place that the turtle has been at since.
    farthest: DVec3,
    /// The turtle's up when it began.
    up: DVec3,
}

impl Surface {
    fn reach(&mut self, place: DVec3) {
        if place.distance_squared(self.from) > self.farthest.distance_squared(self.from) {
            self.farthest = place;
        }
    }

    /// A leaf stands for it, from where it begins to its farthest place.
    fn end(self, pen: &mut impl Pen) -> Result<(), Stop> {
        let along = self.farthest - self.from;
        let Some(direction) = along.try_normalize() else { return Ok(()) };
        let normal = self.up.reject_from_normalized(direction).try_normalize();
        let normal = normal.unwrap_or_else(|| direction.any_orthonormal_vector());
        let stance = Stance { direction: direction.as_vec3(), normal: normal.as_vec3() };
        pen.organ(OrganKind::Leaf, &stance, Some(along.length()))
    }
}

/// When a word is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct When {
    pub seed: u32,
    pub step: u32,
    /// The present time, for grammars whose modules wait.
    pub time: f64,
}

/// What reading has cost.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Cost {
    /// Modules that others were read as.
    pub read: usize,
    /// Steps of computing.
    pub work: u64,
}

impl Cost {
    /// Where a slice of so many modules ends, if it does not end with them.
    pub fn until(&self, modules: usize) -> Self {
        Self {
            read: self.read.saturating_add(MADE_FOR_EACH.saturating_mul(modules)),
            work: self.work.saturating_add(WORK_FOR_EACH.saturating_mul(modules as u64)),
        }
    }

    pub fn is_below(&self, end: &Self) -> bool {
        self.read < end.read && self.work < end.work
    }

    pub fn since(&self, before: &Self) -> u64 {
        (self.read - before.read) as u64 + (self.work - before.work)
    }
}

/// Somewhere within a word.
#[derive(Clone, Debug)]
pub(crate) struct Reading {
    pub turtle: Turtle,
    pub machine: Machine,
    when: When,
    /// The surface that has begun.
    surface: Option<Surface>,
    /// Branches within the rest of a branch that is cut off.
    cut: Option<u32>,
    pub cost: Cost,
    /// Modules that the present module of the word was read as.
    of_one: usize,
    most: Cost,
}

impl Reading {
    pub fn new(program: &Program, when: When, limits: &Limits) -> Self {
        let turtle = Turtle::new(program.angle, program.scale);
        let most = Cost { read: limits.modules.saturating_mul(READ_FOR_EACH), work: limits.work };
        let (machine, cost) = (Machine::new(), Cost::default());
        Self { turtle, machine, when, surface: None, cut: None, cost, of_one: 0, most }
    }

    /// Reads one module of a word.
    pub fn read(
        &mut self,
        program: &Program,
        word: &Word,
        at: usize,
        surroundings: &dyn Environment,
        pen: &mut impl Pen,
    ) -> Result<(), Stop> {
        let tag = word.tag(at);
        self.of_one = 0;
        let read = self.module(program, tag, word.parameters(at), 0, surroundings, pen);
        self.cost.work = self.machine.work;
        read?;
        if self.cut.is_none() && program.is_apex(tag.symbol) {
            pen.apex(&self.turtle.state);
        }
        Ok(())
    }

    fn module(
        &mut self,
        program: &Program,
        tag: Tag,
        parameters: &[f64],
        level: u32,
        surroundings: &dyn Environment,
        pen: &mut impl Pen,
    ) -> Result<(), Stop> {
        let action = program.action(tag.symbol);
        if let Some(open) = self.cut {
            match action {
                Some(Action::Push) => self.cut = Some(open + 1),
                Some(Action::Pop) if open == 0 => self.cut = None,
                Some(Action::Pop) => self.cut = Some(open - 1),
                _ => {}
            }
            if self.cut.is_some() || action != Some(Action::Pop) {
                return Ok(());
            }
        }
        if self.machine.work > self.most.work {
            return Err(Stop::Work(self.most.work));
        }
        if level < program.homomorphism_depth && !program.homomorphism.of(tag.symbol).is_empty() {
            self.machine.work += 1;
            let stand = self.turtle.stand();
            let mut moment = Moment {
                step: self.when.step.into(),
                age: self.age(program, tag),
                chance: Chance::new(self.when.seed, tag.key, WHILE_READING),
                stand: Some(&stand),
                environment: surroundings,
                curves: &program.curves,
            };
            let rules = &program.homomorphism;
            let chosen =
                choose(&mut self.machine, rules.of(tag.symbol), &rules.rules, parameters, &mut moment)?;
            if let Some(chosen) = chosen {
                let frame = chosen.frame(parameters);
                return self.products(program, chosen.rule, tag, frame, level, &mut moment, pen);
            }
        }
        self.act(tag, action, parameters, pen)
    }

    /// What a module is read as.
    #[expect(
        clippy::too_many_arguments,
        reason = "one caller, and a struct of them would have no meaning of its own"
    )]
    fn products(
        &mut self,
        program: &Program,
        rule: &Production,
        tag: Tag,
        parameters: &[f64],
        level: u32,
        moment: &mut Moment<'_>,
        pen: &mut impl Pen,
    ) -> Result<(), Stop> {
        self.count(rule.products.len().max(1))?;
        let keys = Products::of_reading(tag.key, level);
        for (number, product) in rule.products.iter().enumerate() {
            let mut values = [0.0; MOST_PARAMETERS];
            for (value, code) in values.iter_mut().zip(&product.arguments) {
                *value = finite(self.machine.run(code, parameters, moment), rule)?;
            }
            let tag = Tag { symbol: product.symbol, key: keys.key(number), ..tag };
            let values = &values[..product.arguments.len().min(MOST_PARAMETERS)];
            self.module(program, tag, values, level + 1, moment.environment, pen)?;
        }
        Ok(())
    }

    /// Counts modules that one is read as, before they are read.
    fn count(&mut self, modules: usize) -> Result<(), Stop> {
        self.of_one += modules;
        self.cost.read += modules;
        if self.of_one > MOST_OF_ONE {
            return Err(Stop::Single(MOST_OF_ONE));
        }
        if self.cost.read > self.most.read { Err(Stop::Read(self.most.read)) } else { Ok(()) }
    }

    fn act(
        &mut self,
        tag: Tag,
        action: Option<Action>,
        parameters: &[f64],
        pen: &mut impl Pen,
    ) -> Result<(), Stop> {
        let Some(action) = action else { return Ok(()) };
        match action {
            Action::Push => {
                self.surface.iter_mut().for_each(|surface| surface.branches += 1);
                self.turtle.push(tag.key);
                pen.push()?;
            }
            Action::Pop => {
                // A surface ends with the branch in which it began.
                match &mut self.surface {
                    Some(surface) if surface.branches > 0 => surface.branches -= 1,
                    surface => *surface = None,
                }
                pen.pop()?;
                self.turtle.pop();
            }
            Action::Cut => {
                self.cut = Some(0);
                pen.cut();
            }
            Action::BeginPolygon => {
                let State { place, up, .. } = self.turtle.state;
                match &mut self.surface {
                    Some(surface) => surface.within += 1,
                    none => {
                        *none = Some(Surface { within: 0, branches: 0, from: place, farthest: place, up })
                    }
                }
            }
            Action::EndPolygon => match &mut self.surface {
                Some(surface) if surface.within > 0 => surface.within -= 1,
                surface => {
                    if let Some(surface) = surface.take() {
                        surface.end(pen)?;
                    }
                }
            },
            Action::Organ(kind, times) => {
                let State { heading, up, scale, .. } = self.turtle.state;
                let stance = Stance { direction: heading.as_vec3(), normal: up.as_vec3() };
                pen.organ(kind, &stance, parameters.first().map(|length| length * times * scale))?;
            }
            Action::DrawInPieces => {
                let (length, piece) = (parameters[0], parameters[1]);
                // As many pieces as any wood may have.
                const MOST: f64 = 1e6;
                let count = if piece > 0.0 { (length / piece).ceil().clamp(1.0, MOST) } else { 1.0 };
                let keys = Products::of_reading(tag.key, u32::MAX);
                for number in 0..count as usize {
                    self.count(1)?;
                    let tag = Tag { key: keys.key(number), ..tag };
                    self.moved(Action::Draw, &[length / count], tag, pen)?;
                }
            }
            action => self.moved(action, parameters, tag, pen)?,
        }
        Ok(())
    }

    fn moved(
        &mut self,
        action: Action,
        parameters: &[f64],
        tag: Tag,
        pen: &mut impl Pen,
    ) -> Result<(), Stop> {
        match self.turtle.act(action, parameters) {
            Moved::No => Ok(()),
            Moved::Drew if self.surface.is_none() => pen.draw(&self.turtle.state, tag),
            Moved::Drew | Moved::Jumped => {
                let place = self.turtle.state.place;
                if let Some(surface) = &mut self.surface {
                    surface.reach(place);
                }
                pen.jump(&self.turtle.state)
            }
        }
    }

    fn age(&self, program: &Program, tag: Tag) -> f64 {
        if program.columns.times { self.when.time - tag.time } else { f64::from(self.when.step - tag.born) }
    }
}

/// A rule that acts, and the frame of its parameters where it names numbers besides.
pub(crate) struct Chosen<'a> {
    pub rule: &'a Production,
    named: Option<Box<[f64]>>,
}

impl Chosen<'_> {
    /// What its products are computed from.
    pub fn frame<'b>(&'b self, parameters: &'b [f64]) -> &'b [f64] {
        self.named.as_deref().unwrap_or(parameters)
    }
}

/// The first rule without contexts that takes a module, or the alternative that is drawn.
pub(crate) fn choose<'a>(
    machine: &mut Machine,
    candidates: &[u32],
    rules: &'a [Production],
    parameters: &[f64],
    moment: &mut Moment<'_>,
) -> Result<Option<Chosen<'a>>, Stop> {
    for &number in candidates {
        let rule = &rules[number as usize];
        let fits = usize::from(rule.arity) == parameters.len() && !rule.is_later;
        if !fits || !rule.left.is_empty() || !rule.right.is_empty() {
            continue;
        }
        if rule.locals.is_empty() {
            if holds(machine, rule, parameters, moment)? {
                let rule = draw(machine, rule, rules, parameters, moment)?;
                return Ok(Some(Chosen { rule, named: None }));
            }
            continue;
        }
        let mut frame = [0.0; FRAME];
        let own = usize::from(rule.own);
        frame[own..own + parameters.len()].copy_from_slice(parameters);
        if fires(machine, rule, &mut frame, moment)? {
            let rule = draw(machine, rule, rules, &frame, moment)?;
            return Ok(Some(Chosen { rule, named: Some(frame.into()) }));
        }
    }
    Ok(None)
}

/// Whether the condition of a rule holds; what it names is put into its frame.
pub(crate) fn fires(
    machine: &mut Machine,
    rule: &Production,
    frame: &mut [f64; FRAME],
    moment: &mut Moment<'_>,
) -> Result<bool, Stop> {
    for (number, local) in rule.locals.iter().enumerate() {
        if number == rule.locals_before && !holds(machine, rule, frame, moment)? {
            return Ok(false);
        }
        let value = machine.run(local, frame, moment);
        frame[usize::from(rule.first_local) + number] = finite(value, rule)?;
    }
    if rule.locals.len() > rule.locals_before { Ok(true) } else { holds(machine, rule, frame, moment) }
}

/// Whether the condition of a rule holds.
pub(crate) fn holds(
    machine: &mut Machine,
    rule: &Production,
    frame: &[f64],
    moment: &mut Moment<'_>,
) -> Result<bool, Stop> {
    let Some(condition) = &rule.condition else { return Ok(true) };
    let value = machine.run(condition, frame, moment);
    if value.is_nan() {
        let (line, column) = rule.at;
        return Err(Stop::NoNumber { line, column });
    }
    Ok(value != 0.0)
}

/// The rule itself, or one of its alternatives by their weights.
pub(crate) fn draw<'a>(
    machine: &mut Machine,
    rule: &'a Production,
    rules: &'a [Production],
    frame: &[f64],
    moment: &mut Moment<'_>,
) -> Result<&'a Production, Stop> {
    if rule.draw.len() < 2 {
        return Ok(rule);
    }
    let none = || Stop::NoProbability { line: rule.at.0, column: rule.at.1 };
    let mut weigh = |number: u32, moment: &mut Moment<'_>| {
        let weight =
            rules[number as usize].weight.as_ref().map_or(0.0, |code| machine.run(code, frame, moment));
        if weight.is_finite() && weight >= 0.0 { Ok(weight) } else { Err(none()) }
    };
    let mut sum = 0.0;
    for &number in &rule.draw {
        sum += weigh(number, moment)?;
    }
    if sum <= 0.0 {
        return Err(none());
    }
    let mut left = moment.chance.unit() * sum;
    let mut last = rule;
    for &number in &rule.draw {
        let weight = weigh(number, moment)?;
        if weight > 0.0 {
            last = &rules[number as usize];
            if left < weight {
                break;
            }
        }
        left -= weight;
    }
    Ok(last)
}

/// A parameter, which must be a number.
pub(crate) fn finite(value: f64, rule: &Production) -> Result<f64, Stop> {
    let (line, column) = rule.at;
    if value.is_finite() { Ok(value) } else { Err(Stop::NoNumber { line, column }) }
}
