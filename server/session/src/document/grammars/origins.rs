//! Which rule made what each row of a grammar draws (`GR8`).

use std::sync::Arc;

use espalier_grammar::{Derivation, Place};
use espalier_plant::MetamerId;
use espalier_proto::{GrammarOrigins, GrammarRule};

use super::{
    LIMITS, WriteError, options,
    surroundings::{Asking, Told},
};
use crate::document::Document;

impl Document {
    /// Which rule made each living row of the grammar in force; nothing where none is in force.
    ///
    /// # Errors
    /// Where the word cannot be read again, as where hands have set a smaller budget since.
    pub fn grammar_origins(&self) -> Option<GrammarOrigins> {
        let written = self.written()?;
        self.origins_of(written).ok()
    }

    fn origins_of(&self, written: &super::Written) -> Result<GrammarOrigins, WriteError> {
        let source = &written.source;
        let mut derivation = Derivation::traced(Arc::clone(&source.program), source.seed, LIMITS)?;
        for step in 0..written.depth as usize {
            let answers = written.answers.get(step).cloned().unwrap_or_default();
            derivation.step(&Told::new(answers, 0))?;
        }
        let scene = self.simulation.scene();
        let keys: Vec<u64> = written.rows.iter().map(|&(key, _)| key).collect();
        let options = options(scene, self.simulation.parameters());
        let asking = Asking::new(scene, self.simulation.generator().as_ref(), source);
        let drawn = derivation.draw_on(&asking, options, &keys)?;
        let traced = derivation.origins();
        let plant = self.plant();
        let rule_of = |module: u64| {
            let at = traced.binary_search_by_key(&module, |&(key, _)| key).ok()?;
            Some(traced[at].1)
        };
        let mut found: Vec<(u32, Option<Place>)> = Vec::new();
        for (key, &module) in drawn.keys.iter().zip(&drawn.modules) {
            let Ok(at) = written.rows.binary_search_by_key(key, |&(known, _)| known) else { continue };
            let row = written.rows[at].1;
            let id = MetamerId::new(row as usize);
            let is_there = id.index() < plant.metamer_count() && plant.is_alive(id) && !plant.is_seed(id);
            if is_there {
                found.push((row, rule_of(module)));
            }
        }
        found.sort_unstable();
        // The axiom first, where there is none.
        let mut rules: Vec<Option<Place>> = found.iter().map(|&(_, rule)| rule).collect();
        rules.push(None);
        rules.sort_unstable();
        rules.dedup();
        let number = |rule: &Option<Place>| rules.binary_search(rule).unwrap_or_default() as u16;
        let by = found.iter().map(|(_, rule)| number(rule)).collect();
        let rows = found.iter().map(|&(row, _)| row).collect();
        let place = |rule: &Option<Place>| {
            let (line, column) = rule.unwrap_or(source.axiom_at);
            GrammarRule { line, column }
        };
        Ok(GrammarOrigins { depth: written.depth, rules: rules.iter().map(place).collect(), rows, by })
    }
}
