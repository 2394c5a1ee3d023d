//! What is told of the grammar in force (`GR5`), and what sets it elsewhere.

use espalier_proto::{Action, GrammarEnd, GrammarInForce, GrammarValue, List, Position, Steps};

use super::{InForce, Source, WriteError, Written};
use crate::{document::Document, grammars::wire_end};

/// A grammar at one time, to be compared.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct GrammarMark {
    in_force: InForce,
    edited: bool,
    ends: Option<WriteError>,
}

impl Document {
    /// How deep the grammar in force is derived, and why it ended there, if it did.
    pub fn grammar_depth(&self) -> Option<(u32, Option<String>)> {
        let refusal = self.simulation.generator().refusal().map(ToString::to_string);
        self.written().map(|written| (written.depth, refusal))
    }

    /// What is told of the grammar in force (`GR5`).
    pub(crate) fn grammar_told(&self) -> Option<GrammarInForce> {
        let written = self.written()?;
        let source = &written.source;
        let (earlier, later) = self.depths_around(written);
        Some(GrammarInForce {
            text: source.text.clone(),
            title: source.title.clone(),
            at: Position::nearest(source.at),
            seed: source.seed,
            sliders: source.sliders.clone(),
            values: values_of(source),
            within: source.within.as_ref().map(|(body, _)| body.clone()),
            depth: written.depth,
            earlier,
            later,
            edited: self.is_edited(written),
            ends: self.grammar_end(),
        })
    }

    /// Why the grammar in force could not go on, where that was tried last.
    fn grammar_end(&self) -> Option<GrammarEnd> {
        match self.simulation.generator().refusal()? {
            WriteError::Stop(stop) => Some(wire_end(stop)),
            // None that is in force says so of itself.
            WriteError::NoGrammar => None,
        }
    }

    /// The command that sets the grammar in force in another document, whose seed is that of its chance.
    pub(in crate::document) fn grammar_to_set(&self) -> Option<Action> {
        let written = self.written()?;
        let Source { text, at, within, .. } = &*written.source;
        Some(Action::SetGrammar {
            text: text.clone(),
            values: List::try_from(values_of(&written.source)).ok()?,
            seed: None,
            position: Some(Position::nearest(*at)),
            depth: Steps::try_from(written.depth).ok(),
            within: within.as_ref().map(|(body, _)| body.clone()),
        })
    }

    /// Whether another grammar is in force than this one, or it stands otherwise; costs little.
    pub(crate) fn grammar_mark(&self) -> GrammarMark {
        let written = self.written();
        GrammarMark {
            in_force: InForce(written.cloned()),
            edited: written.is_some_and(|written| self.is_edited(written)),
            ends: self.simulation.generator().refusal().cloned(),
        }
    }

    /// Whether hands have changed the plants since the grammar was set.
    fn is_edited(&self, written: &Written) -> bool {
        written.is_edited || written.step != self.plant().step()
    }
}

/// The values of a grammar, as they travel.
fn values_of(source: &Source) -> Vec<GrammarValue> {
    let value = |(name, value): &(String, f64)| GrammarValue { name: name.clone(), value: *value };
    source.values.iter().map(value).collect()
}
