//! What is done with grammars: set, derived further, their sliders set, and taken back (`GR1` to `GR4`).

use std::sync::Arc;

use espalier_plant::Future;
use espalier_proto::{GrammarBody, GrammarValue, Position, Problem, Reason};

use super::{
    MAX_HELD, MAX_HELD_TEXT, Source, Write, Written,
    underway::{After, Former, Underway},
};
use crate::{
    cause::Cause,
    document::{
        Document,
        futures::all_states,
        history::{Kind, Latest, Operation},
    },
    form,
};

/// In place of a row, where a whole grammar is meant.
pub(super) const WHOLE: u32 = u32::MAX;

/// What `set_grammar` says.
pub(in crate::document) struct Planting<'a> {
    pub text: &'a str,
    pub values: &'a [GrammarValue],
    pub seed: Option<u32>,
    pub position: Option<Position>,
    pub within: Option<&'a GrammarBody>,
    pub depth: Option<u32>,
}

impl Document {
    pub(super) fn written(&self) -> Option<&Arc<Written>> {
        self.simulation.generator().state().written.0.as_ref()
    }

    /// Whether the grammar in force may derive another step.
    pub(in crate::document) fn may_derive(&self) -> bool {
        let is_refused = self.simulation.generator().refusal().is_some();
        !is_refused && self.held_by_grammars().0 < MAX_HELD && self.require_places(0).is_ok()
    }

    /// The operation in progress keeps where wood was that the last step has moved.
    pub(in crate::document) fn keep_what_moved(&mut self) {
        self.history.keep_places(self.simulation.generator().moved());
    }

    pub(in crate::document) fn set_grammar(
        &mut self,
        cause: Cause<'_>,
        planting: &Planting<'_>,
    ) -> Result<(), Problem> {
        let now = self.plant().step();
        let in_force = self.written().cloned();
        let position = planting.position.map(form::on_ground).transpose()?;
        let at = position.or_else(|| in_force.as_ref().map(|one| one.source.at)).unwrap_or_default();
        if self.simulation.scene().is_solid(at) {
            let value = format!("{at}, in an obstacle");
            let problem = Problem::out_of_range("position", value, "a place outside all obstacles");
            return Err(Problem { reason: Reason::InObstacle, ..problem });
        }
        let before = in_force.as_ref().filter(|_| position.is_none()).map(|one| &one.source);
        let own = self.seed();
        // Who changes the seed of the text means the text, as with sliders.
        let seed = |of_text: Option<u32>| {
            let kept = before.filter(|source| of_text.is_none() || source.program.seed() == of_text);
            planting.seed.or(kept.map(|source| source.seed)).or(of_text).unwrap_or(own)
        };
        let within = before.and_then(|source| source.within.as_ref()).map(|(body, _)| body);
        let values = planting.values.iter().map(|value| (value.name.clone(), value.value)).collect();
        let source = Source::new(planting.text, values, seed, at, planting.within.or(within))?;
        let source = Arc::new(source);
        // Whoever types sets one grammar after another: each takes the place of the one before.
        let continues = self.history.continues(&[Kind::Grammar], cause, now);
        let first = self.history.current().map_or(now, |last| last.first);
        let plants_again = continues && in_force.as_ref().is_some_and(|written| written.begun == first);
        match in_force {
            Some(written) if position.is_none() && !plants_again => {
                let depth = planting.depth.unwrap_or(written.depth);
                self.rewrite(cause, Write::Set { source, depth, is_new: false })
            }
            _ => {
                self.plant_grammar(cause, source, planting.depth.unwrap_or(0), plants_again.then_some(first))
            }
        }
    }

    /// Plants what a grammar writes, step by step; in place of what the same gesture has planted from a step on.
    fn plant_grammar(
        &mut self,
        cause: Cause<'_>,
        source: Arc<Source>,
        depth: u32,
        again_from: Option<u32>,
    ) -> Result<(), Problem> {
        self.require_room()?;
        self.require_grammar_room(source.text.len())?;
        let now = self.plant().step();
        let former =
            again_from.map(|first| Former { future: self.set_aside_from(first), step: now, latest: None });
        let write = Write::Set { source, depth: 0, is_new: true };
        let recorded = former.is_none().then(|| self.record(Kind::Grammar, cause));
        let after = After { keeps_places: true, derives: depth, notes_latest: false };
        self.begin_writing(Underway::new(write, recorded, former, after, self.plant().step()))
    }

    /// Lets the plant of the grammar in force follow another text or other values, in one step; in place of the step in
    /// which the same gesture has done so.
    fn rewrite(&mut self, cause: Cause<'_>, write: Write) -> Result<(), Problem> {
        self.require_grammar_room(write.text_bytes())?;
        self.require_places(0)?;
        let now = self.plant().step();
        let continues = self.history.continues(&[Kind::Grammar], cause, now);
        let latest = Some(Latest { step: now, row: WHOLE, rotation: None });
        let former = (continues && self.replaces(WHOLE)).then(|| Former {
            future: self.set_aside_from(now - 1),
            step: now,
            latest,
        });
        let recorded = (!continues).then(|| self.record(Kind::Grammar, cause));
        let after = After { keeps_places: former.is_none(), derives: 0, notes_latest: true };
        self.begin_writing(Underway::new(write, recorded, former, after, self.plant().step()))
    }

    /// Goes back to a step; what was after it.
    fn set_aside_from(&mut self, step: u32) -> Future {
        self.simulation.go_to(step);
        let former = self.simulation.stash_future();
        self.keep_state();
        former
    }

    /// Goes on to a step of what was set aside right here.
    pub(super) fn take_up(&mut self, former: Future, step: u32) {
        let _fits = self.simulation.take_future(former);
        self.simulation.go_to(step);
        self.keep_state();
    }

    pub(in crate::document) fn derive(&mut self, cause: Cause<'_>, steps: u32) -> Result<(), Problem> {
        self.require_grammar()?;
        self.require_room()?;
        self.require_grammar_room(0)?;
        self.require_places(0)?;
        let continues = self.history.continues(&[Kind::Grammar], cause, self.plant().step());
        let recorded = (!continues).then(|| self.record(Kind::Grammar, cause));
        let after = After { keeps_places: true, derives: steps - 1, notes_latest: false };
        self.begin_writing(Underway::new(Write::Derive, recorded, None, after, self.plant().step()))
    }

    pub(in crate::document) fn set_grammar_values(
        &mut self,
        cause: Cause<'_>,
        values: &[GrammarValue],
    ) -> Result<(), Problem> {
        let written = self.require_grammar()?;
        let mut set = written.source.values.clone();
        for value in values {
            set.retain(|(name, _)| *name != value.name);
            set.push((value.name.clone(), value.value));
        }
        let Source { text, seed, at, within, .. } = &*written.source;
        let body = within.as_ref().map(|(body, _)| body);
        let source = Arc::new(Source::new(text, set, |_| *seed, *at, body)?);
        self.rewrite(cause, Write::Set { source, depth: written.depth, is_new: false })
    }

    /// Gives the grammar in force another body to ask for, or takes it away.
    pub(in crate::document) fn set_grammar_body(
        &mut self,
        cause: Cause<'_>,
        within: Option<&GrammarBody>,
    ) -> Result<(), Problem> {
        let written = self.require_grammar()?;
        let Source { text, values, seed, at, .. } = &*written.source;
        let source = Arc::new(Source::new(text, values.clone(), |_| *seed, *at, within)?);
        self.rewrite(cause, Write::Set { source, depth: written.depth, is_new: false })
    }

    /// After a deed was taken back or brought back, the grammar goes on from where the deeds in force have left it.
    pub(in crate::document) fn keep_grammar_to(&mut self, deed: usize, away: bool) {
        let is_grammar = |operation: &Operation| operation.kind == Kind::Grammar;
        let operations = &self.history.operations[..self.history.done];
        let is_last = {
            let gone = self.history.away();
            let later = operations.iter().zip(gone).skip(deed + 1);
            later.filter(|(_, away)| !away).all(|(operation, _)| !is_grammar(operation))
        };
        if is_last && operations.get(deed).is_some_and(is_grammar) {
            let written = self.history.state_after(deed + usize::from(!away)).written;
            self.simulation.generator_mut().put_in_force(written);
        }
    }

    fn require_grammar(&self) -> Result<Arc<Written>, Problem> {
        self.written().cloned().ok_or_else(|| {
            Problem::new(Reason::NoGrammar, "no grammar is in force here").at("kind", "set_grammar first")
        })
    }

    /// Names and answers that all lines of time keep, and bytes of texts.
    pub(in crate::document) fn held_by_grammars(&self) -> (usize, usize) {
        let (mut held, mut text) = (0, 0);
        let mut last: Option<&Arc<Written>> = None;
        for mark in all_states(&self.history, &self.futures) {
            let Some(written) = mark.state.written.0.as_ref() else { continue };
            if last.is_some_and(|last| Arc::ptr_eq(last, written)) {
                continue;
            }
            held += written.rows.len()
                + written.ends.len()
                + written.answers.iter().map(|answers| answers.len()).sum::<usize>();
            if last.is_none_or(|last| !Arc::ptr_eq(&last.source, &written.source)) {
                text += written.source.text.len();
            }
            last = Some(written);
        }
        (held, text)
    }

    fn require_grammar_room(&self, more: usize) -> Result<(), Problem> {
        let (held, text) = self.held_by_grammars();
        if held < MAX_HELD && text + more <= MAX_HELD_TEXT {
            return Ok(());
        }
        let message = "the history keeps as much of what grammars wrote as it may; undo something";
        Err(Problem::new(Reason::HistoryFull, message)
            .at("kind", format!("grammars that wrote up to {MAX_HELD} names in all")))
    }
}
