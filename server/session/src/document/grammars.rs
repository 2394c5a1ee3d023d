//! The grammar in force (`GR`): what it has written, and how it goes on. Each step of derivation is one of growth, so its
//! depth is time, and what it wrote is wood like any other.
//!
//! Words are not kept: they follow from the text, its values, its seed and what surroundings answered. What is kept for
//! each depth is which row each name of the word has, so that what goes on stays what it was.

mod anew;
mod commands;
mod depths;
mod origins;
mod surroundings;
mod telling;
mod underway;
mod writing;

use std::sync::Arc;

use espalier_grammar::{BadValue, Grammar, Limits, Place, Program, Slider, Stop, WoodOptions};
use espalier_growth::{EditError, Envelope, Parameters, Plane, Scene, WORLD_EXTENT};
use espalier_plant::hash::StableHash;
use espalier_proto::{GrammarBody, GrammarSlider, Problem, Reason};
use glam::{Vec2, Vec3};

pub(crate) use self::telling::GrammarMark;
pub(super) use self::{
    commands::Planting,
    underway::Underway,
    writing::{Grammars, Wrote},
};

/// Names with their rows, and answers, that all lines of time may keep.
pub(super) const MAX_HELD: usize = 8_000_000;
/// Bytes of texts that they may.
pub(super) const MAX_HELD_TEXT: usize = 32 << 20;

/// What one derivation may take.
const LIMITS: Limits = Limits { modules: 2_000_000, parameters: 4_000_000, nesting: 512, work: 500_000_000 };

/// A grammar with its values, and where it stands.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    pub(super) text: String,
    pub(super) values: Vec<(String, f64)>,
    pub(super) seed: u32,
    pub(super) at: Vec3,
    pub(super) within: Option<(GrammarBody, Arc<Envelope>)>,
    title: Option<String>,
    sliders: Vec<GrammarSlider>,
    axiom_at: Place,
    program: Arc<Program>,
    asks: bool,
    /// Whether what it asks for depends on what else it has written.
    asks_of_wood: bool,
    /// Whether it asks for vigor, which is read only where somebody wants to know it.
    asks_of_vigor: bool,
}

impl PartialEq for Source {
    fn eq(&self, other: &Self) -> bool {
        let body = |source: &Self| source.within.as_ref().map(|(body, _)| body.clone());
        self.text == other.text
            && self.values == other.values
            && self.seed == other.seed
            && self.at == other.at
            && body(self) == body(other)
    }
}

/// What a grammar has written up to a depth.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Written {
    pub(super) source: Arc<Source>,
    pub(super) depth: u32,
    /// What surroundings answered in each step of derivation; empty for grammars that do not ask.
    pub(super) answers: Vec<Arc<[f64]>>,
    /// The rows that names have, in order of the names.
    pub(super) rows: Vec<(u64, u32)>,
    /// The rows whose axes it has ended itself, each with the axis that went on from it last, in order.
    pub(super) ends: Vec<(u32, u32)>,
    /// The step of the plants that it led to.
    pub(super) step: u32,
    /// Whether others have changed the plants since the grammar began.
    pub(super) is_edited: bool,
    /// The step that the grammar was set in.
    pub(super) begun: u32,
}

/// The grammar in force, if one is; the same one is found equal at once.
#[derive(Clone, Debug, Default)]
pub(crate) struct InForce(pub(super) Option<Arc<Written>>);

impl PartialEq for InForce {
    fn eq(&self, other: &Self) -> bool {
        match (&self.0, &other.0) {
            (Some(one), Some(other)) => Arc::ptr_eq(one, other) || one == other,
            (None, None) => true,
            _ => false,
        }
    }
}

/// What a grammar is to do in a step.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Write {
    /// It goes on by a step of derivation.
    Derive,
    /// A grammar begins, or the one in force goes on with other values, at a depth.
    Set { source: Arc<Source>, depth: u32, is_new: bool },
}

impl Write {
    /// Whether it asks for vigor, with this in force.
    pub(super) fn asks_of_vigor(&self, now: &InForce) -> bool {
        let of_former = now.0.as_ref().is_some_and(|written| written.source.asks_of_vigor);
        of_former || matches!(self, Self::Set { source, .. } if source.asks_of_vigor)
    }

    /// Bytes of the text that it brings.
    fn text_bytes(&self) -> usize {
        match self {
            Self::Derive => 0,
            Self::Set { source, .. } => source.text.len(),
        }
    }
}

/// A grammar cannot write a step.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub(crate) enum WriteError {
    #[error(transparent)]
    Stop(#[from] Stop),
    #[error("no grammar is in force")]
    NoGrammar,
}

impl From<EditError> for WriteError {
    fn from(error: EditError) -> Self {
        Self::Stop(match error {
            EditError::OutOfWorld => Stop::World(WORLD_EXTENT as u32),
            EditError::OutOfBudget => Stop::Full,
            EditError::Broken | EditError::Columns(_) => Stop::Broken,
        })
    }
}

impl InForce {
    pub(super) fn hash(&self, hash: &mut StableHash) {
        let Some(written) = &self.0 else { return };
        let Source { text, values, seed, at, within, .. } = &*written.source;
        if let Some((body, _)) = within {
            for part in body.outline.iter().flat_map(|point| point.get().to_array()) {
                hash.word(part.to_bits().into());
            }
            hash.vector(body.plane.origin());
            hash.word(body.depth.get().to_bits().into());
        }
        for chunk in text.as_bytes().chunks(8) {
            hash.word(chunk.iter().fold(0, |word, &byte| word << 8 | u64::from(byte)));
        }
        values.iter().for_each(|(_, value)| hash.word(value.to_bits()));
        hash.vector(*at);
        hash.word(u64::from(*seed) | u64::from(written.depth) << 32);
        for &(key, row) in &written.rows {
            hash.word(key);
            hash.word(row.into());
        }
        for &(row, axis) in &written.ends {
            hash.word(u64::from(row) | u64::from(axis) << 32);
        }
    }
}

/// What bounds the wood of a grammar in a scene.
fn options(scene: &Scene, parameters: &Parameters) -> WoodOptions {
    WoodOptions {
        nodes: scene.metamer_budget() as usize,
        extent: WORLD_EXTENT as u32,
        twig_radius: f64::from(parameters.twig_diameter) / 2.0,
    }
}

impl Source {
    /// Reads a grammar; its seed may follow from the one that the text asks for.
    pub(super) fn new(
        text: &str,
        values: Vec<(String, f64)>,
        seed: impl FnOnce(Option<u32>) -> u32,
        at: Vec3,
        within: Option<&GrammarBody>,
    ) -> Result<Self, Problem> {
        let grammar = Grammar::read(text).map_err(|diagnostics| {
            let cause = diagnostics.iter().map(ToString::to_string).next().unwrap_or_default();
            let problem = Problem::new(Reason::NotAGrammar, format!("the text is no grammar: {cause}"))
                .at("text", "a grammar without errors");
            Problem { cause: Some(cause), ..problem }
        })?;
        let set: Vec<(&str, f64)> = values.iter().map(|(name, value)| (name.as_str(), *value)).collect();
        let program = grammar.program(&set).map_err(|error| bad_value(&grammar, &error))?;
        let within =
            within.map(|body| Ok::<_, Problem>((body.clone(), Arc::new(inflated(body)?)))).transpose()?;
        Ok(Self {
            text: text.to_owned(),
            values,
            seed: seed(program.seed()),
            at,
            within,
            title: grammar.title().map(str::to_owned),
            sliders: sliders_of(&grammar),
            axiom_at: grammar.axiom_place(),
            asks: grammar.asks_places(),
            asks_of_wood: grammar.asks_of_wood(),
            asks_of_vigor: grammar.asks_of_vigor(),
            program: Arc::new(program),
        })
    }
}

/// The problem with a value that a grammar does not allow.
pub(crate) fn bad_value(grammar: &Grammar, error: &BadValue) -> Problem {
    let sliders = grammar.sliders();
    let allowed: Vec<String> = sliders
        .iter()
        .map(|slider| format!("{} from {} to {}", slider.name, slider.from, slider.to))
        .collect();
    let allowed =
        if allowed.is_empty() { "no values: the text has no sliders".into() } else { allowed.join(", ") };
    Problem::out_of_range("values", error.to_string(), allowed)
}

/// The sliders of a grammar, as they travel.
pub(crate) fn sliders_of(grammar: &Grammar) -> Vec<GrammarSlider> {
    let slider = |Slider { name, value, from, to }| GrammarSlider { name, from, to, value };
    grammar.sliders().into_iter().map(slider).collect()
}

fn inflated(body: &GrammarBody) -> Result<Envelope, Problem> {
    let outline: Vec<Vec2> = body.outline.iter().map(|point| point.get()).collect();
    let (right, up) = body.plane.axes();
    let plane = Plane { origin: body.plane.origin(), right, up };
    Envelope::inflate(&outline, plane, body.depth.get(), 0.0).map_err(|error| {
        Problem::new(Reason::NoRoom, format!("nothing can grow into this: {error}"))
            .at("within", "an outline around some room")
    })
}
