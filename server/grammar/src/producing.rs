//! What rules make of modules: products, and what decomposition and lifespans make of those at once.

use crate::{
    code::Moment,
    derivation::Derivation,
    keys::Products,
    limits::{MADE_FOR_EACH, MOST_OF_ONE, Stop},
    program::{Production, Program},
    reading::{MOST_PARAMETERS, choose, finite},
    word::Tag,
};

/// How often modules that have waited may be rewritten within one step.
const MOST_FIRINGS: u32 = 100;

/// When rules have acted on a module in a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Firing {
    /// The time at which what it becomes begins.
    pub time: f64,
    /// How often rules have acted on it before in this step.
    pub pass: u32,
}

/// Whether a time has passed, but for rounding.
pub(crate) fn is_over(age: f64, lifespan: f64) -> bool {
    age >= lifespan - 1e-9
}

/// Modules that came of others within a step beside the one product of rules, and those that came of one of them.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Made {
    pub in_step: usize,
    pub of_one: usize,
}

impl Derivation {
    /// Appends what a rule makes of a module.
    pub(crate) fn produce(
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
        let is_heir = |number: usize| rule.heir == Some(number);
        let key = |number: usize| keys.filter(|_| !is_heir(number)).map_or(of.key, |keys| keys.key(number));
        if let Some(traced) = &mut self.traced {
            let new = (0..rule.products.len()).filter(|&number| !is_heir(number));
            traced.extend(new.map(|number| (key(number), rule.at)));
        }
        if let Some(plain) = &rule.plain {
            let (new, heir) = (Tag { born, time: firing.time, ..of }, rule.heir.map(|heir| (heir, of.born)));
            self.next.extend_plain(plain, key, new, heir, &self.limits)?;
            for code in rule.products.iter().flat_map(|product| &product.arguments) {
                let value = finite(self.machine.run(code, frame, moment), rule)?;
                self.next.push_parameter(value);
            }
            return Ok(());
        }
        for (number, product) in rule.products.iter().enumerate() {
            let born = if is_heir(number) { of.born } else { born };
            let tag = Tag { symbol: product.symbol, key: key(number), born, time: firing.time };
            let mut values = [0.0; MOST_PARAMETERS];
            for (value, code) in values.iter_mut().zip(&product.arguments) {
                *value = finite(self.machine.run(code, frame, moment), rule)?;
            }
            self.emit(program, tag, &values[..product.arguments.len()], firing.pass, moment)?;
        }
        Ok(())
    }

    /// Appends a module, or what decomposition and the time that has passed make of it at once.
    pub(crate) fn emit(
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
        // Counted here, for what vanishes again is nowhere in the word.
        let count = rule.products.len().max(1);
        self.made.of_one += count;
        self.made.in_step += count;
        if self.made.of_one > MOST_OF_ONE {
            return Err(Stop::Single(MOST_OF_ONE));
        }
        if self.made.in_step > self.limits.modules.saturating_mul(MADE_FOR_EACH) {
            return Err(Stop::Modules(self.limits.modules));
        }
        self.produce(program, rule, tag, parameters, firing, moment)
    }
}
