//! A document as bytes and back, for snapshots and saved trees: a container of sections, each with a version of its
//! own. `docs/document.md` has the layout, and says how a section or a version is added.

mod container;
mod designs;
mod fields;
mod format_4;
mod gestures;
mod grammars;
mod growth;
mod lengths;
mod names;
mod organs;
mod packing;
mod plain;
mod programmes;
pub(super) mod sections;
mod settings;
mod times;
mod wood;

use std::{collections::VecDeque, sync::Arc};

use espalier_growth::{Simulation, simulation_version};
use espalier_plant::{Plant, PlantParts};

pub use self::{container::announced_bytes, lengths::MAX_METAMER_BUDGET, plain::plain};
pub(crate) use self::{
    container::{Container, Section},
    fields::{Reader, Writer},
    sections::SESSION,
};
use self::{
    names::Names,
    sections::{Kind, Release},
    settings::Pool,
};
use super::{
    Document, Generators,
    designing::Designs,
    futures::{Futures, all_states},
    hints::Hints,
    obstacles::Obstacles,
};
use crate::schedule::GrowthSchedule;

/// Bytes are not a document that this program reads.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DocumentError {
    /// Not written by this program.
    #[error("this is not an Espalier document")]
    NotADocument,
    /// Written by a later version of the program; the text says which one reads it, where it is known.
    #[error("a later version of Espalier wrote the document: {0}")]
    Later(String),
    /// Cut short or changed since it was written.
    #[error("the document is damaged: {0}")]
    Damaged(String),
}

impl DocumentError {
    fn within(self, section: &str) -> Self {
        match self {
            Self::NotADocument => self,
            Self::Later(what) => Self::Later(format!("in its section {section}, {what}")),
            Self::Damaged(what) => Self::Damaged(format!("in its section {section}, {what}")),
        }
    }
}

impl Document {
    /// The whole document, its history and futures included, packed. Steps still pending are run first by the caller.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.to_container(&self.futures, &Names::Keys).packed().to_bytes()
    }

    /// The document with its present line of time alone, for keeping as a tree (`TT3`). As snapshots, it is not packed:
    /// the store packs its parts.
    pub fn to_saved_bytes(&self) -> Vec<u8> {
        self.to_container(&Futures::default(), &Names::Keys).to_bytes()
    }

    /// As [`Self::to_saved_bytes`], for people to take along: authors have numbers instead of their keys (`PS6`).
    pub fn to_bytes_for_people(&self) -> Vec<u8> {
        let names = Names::numbered(&self.history, &self.strokes, &self.bends);
        self.to_container(&Futures::default(), &names).to_bytes()
    }

    /// The whole document with the section of a session, not packed.
    pub(crate) fn to_snapshot_bytes(&self, session: Writer) -> Vec<u8> {
        let mut container = self.to_container(&self.futures, &Names::Keys);
        container.sections.push(Section::new(&SESSION, session.into_bytes()));
        container.to_bytes()
    }

    fn to_container(&self, futures: &Futures, names: &Names) -> Container {
        debug_assert!(self.pending.is_empty(), "a document is written between two actions");
        if !self.is_line_complete() {
            let mut complete = self.clone();
            complete.complete_line();
            return complete.to_container(futures, names);
        }
        let mut sections = Vec::new();
        let mut add = |kind: &Kind, write: &dyn Fn(&mut Writer)| {
            let mut out = Writer::default();
            write(&mut out);
            sections.push(Section::new(kind, out.into_bytes()));
        };
        let plant = self.simulation.plant().to_parts();
        add(&sections::PLANT, &|out| wood::write_columns(out, &plant));
        add(&sections::TIMELINE, &|out| wood::write_timeline(out, &plant));
        if !plant.widths.is_empty() {
            add(&sections::WIDTHS, &|out| wood::write_widths(out, &plant));
        }
        if !plant.given_radii.is_empty() {
            add(&sections::GIVEN_RADII, &|out| wood::write_given_radii(out, &plant));
        }
        if organs::are_there(&plant, futures) {
            add(&sections::GIVEN_ORGANS, &|out| organs::write(out, &plant));
        }
        add(&sections::GROWTH, &|out| {
            growth::write(out, &self.simulation.state());
            out.u32(self.steps_begun);
        });
        let guides = self.simulation.state().guides;
        if !guides.is_empty() {
            add(&sections::SWEEPS, &|out| growth::write_sweeps(out, &guides));
        }
        let pool = Pool::of(&self.history, futures, &self.setting());
        add(&sections::PARAMETERS, &|out| pool.write_parameters(out));
        if pool.has_programmes() || all_states(&self.history, futures).next().is_some() {
            add(&sections::PROGRAMMES, &|out| {
                programmes::write(out, &pool, self.schedule(), &self.history, futures);
            });
        }
        #[cfg(test)]
        if super::tests::forks::has_grown(&self.history, futures) {
            add(&sections::FORKS, &|out| super::tests::forks::write(out, &self.history, futures));
        }
        if grammars::are_there(&self.history, futures) {
            add(&sections::GRAMMARS, &|out| grammars::write(out, &self.history, futures));
        }
        add(&sections::LOOKS, &|out| pool.write_looks(out, &self.appearance));
        add(&sections::OBSTACLES, &|out| pool.write_obstacles(out, &self.obstacles));
        add(&sections::HISTORY, &|out| times::write_history(out, &self.history, &pool, names));
        if designs::are_there(&self.history, futures) {
            add(&sections::DESIGNS, &|out| designs::write(out, &self.history, futures));
        }
        if designs::are_let_go(&self.history, futures) {
            add(&sections::LET_GO, &|out| designs::write_let_go(out, &self.history, futures));
        }
        if *futures != Futures::default() {
            add(&sections::FUTURES, &|out| times::write_futures(out, futures, &pool, names));
        }
        if self.strokes.begun > 0 || self.bends.begun > 0 {
            add(&sections::GESTURES, &|out| gestures::write(out, &self.strokes, &self.bends, names));
        }
        add(&sections::WRITER, &|out| out.u32(Release::THIS.to_number()));
        sections.extend(self.unknown.iter().cloned());
        Container { simulation: simulation_version(), writer: Some(Release::THIS), sections }
    }

    /// Reads a document; any bytes at all give a document or an error.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, DocumentError> {
        Self::from_container(&Container::read_any(bytes)?)
    }

    /// Reads a document from the sections of it.
    pub(crate) fn from_container(container: &Container) -> Result<Self, DocumentError> {
        let PlantParts { now, ends, edits, .. } =
            container.require(&sections::TIMELINE, wood::read_timeline)?;
        let widths = container.read(&sections::WIDTHS, wood::read_widths)?.unwrap_or_default();
        let given_radii = container.read(&sections::GIVEN_RADII, wood::read_given_radii)?.unwrap_or_default();
        let given_organs = container.read(&sections::GIVEN_ORGANS, organs::read)?.unwrap_or_default();
        let rows = container.require(&sections::PLANT, wood::read_columns)?;
        let plant =
            Plant::from_parts(PlantParts { now, ends, edits, widths, given_radii, given_organs, ..rows })
                .map_err(|error| damaged(error.to_string()))?;
        let (mut state, steps_begun) =
            container.require(&sections::GROWTH, |r| Ok((growth::read(r)?, r.u32()?)))?;
        container.read(&sections::SWEEPS, |r| growth::read_sweeps(r, &mut state.guides))?;
        growth::check(&state, &plant)?;

        let all_parameters = container.require(&sections::PARAMETERS, settings::read_parameters)?;
        let programmes = container.read(&sections::PROGRAMMES, programmes::read)?.unwrap_or_default();
        let (all_looks, look) =
            container.require(&sections::LOOKS, |r| Ok((settings::read_looks(r)?, r.u32()?)))?;
        let (all_sets, standing, placed) = container
            .require(&sections::OBSTACLES, |r| Ok((settings::read_obstacles(r)?, r.u32()?, r.u32()?)))?;
        let pool = Pool::new(programmes.schedules(&all_parameters)?, all_looks, all_sets);
        let obstacles = Obstacles { standing: pool.standing(standing)?, placed };
        if obstacles.standing.last().is_some_and(|last| last.id > obstacles.placed) {
            return Err(damaged("an obstacle was never placed"));
        }
        state.obstacles = Obstacles::solids(&obstacles.standing);

        let mut history = container.require(&sections::HISTORY, |r| times::read_history(r, &pool))?;
        times::check_history(&history, &plant)?;
        let futures = container.read(&sections::FUTURES, |r| times::read_futures(r, &pool))?;
        let mut futures = futures.unwrap_or_default();
        let schedule = match programmes.present {
            Some(number) => pool.schedule(number)?,
            None => Arc::new(GrowthSchedule::plain(state.parameters.clone())),
        };
        programmes.tell_states(&mut history, &mut futures)?;
        designs::read(container, &mut history, &mut futures)?;
        designs::read_let_go(container, &mut history, &mut futures)?;
        grammars::read(container, &mut history, &mut futures)?;
        #[cfg(test)]
        super::tests::forks::read(container, &mut history, &mut futures)?;
        times::check_futures(&futures, &history, &plant)?;
        let (strokes, bends) = container.read(&sections::GESTURES, gestures::read)?.unwrap_or_default();
        gestures::check(&strokes, &bends, &plant)?;
        let generators = history.state_at(plant.step());
        let simulation = Simulation::from_state(plant, state);
        let mut document = Self {
            simulation: simulation.grown_by(|growth| Generators::new(growth, schedule, generators)),
            history,
            futures,
            strokes,
            bends,
            obstacles,
            appearance: pool.look(look)?,
            designs: Designs::default(),
            pending: VecDeque::new(),
            underway: None,
            outcome: None,
            hints: Hints::default(),
            switched: None,
            steps_begun,
            stop_at: None,
            unknown: container.unknown(),
        };
        document.keep_to_design();
        Ok(document)
    }
}

impl Container {
    /// Reads a container, or what a released version wrote before there were any.
    pub(crate) fn read_any(bytes: &[u8]) -> Result<Self, DocumentError> {
        match format_4::upgrade(bytes)? {
            Some(container) => Ok(container),
            None => Self::from_bytes(bytes),
        }
    }
}

fn damaged(what: impl Into<String>) -> DocumentError {
    DocumentError::Damaged(what.into())
}

fn later(what: impl Into<String>) -> DocumentError {
    DocumentError::Later(what.into())
}
