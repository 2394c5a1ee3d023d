//! What clients are notified of a document beside its rows and figures: lines of time, width constraints, open bends.

use std::collections::BTreeMap;

use espalier_plant::{Girth, widths};
use espalier_proto::{
    OperationKind, RowMotion, Timeline, TimelineFuture, TimelineOperation, TimelinePart, WidthConstraint,
};

use super::{
    Document,
    history::{Kind, Operation},
    parts::PartSet,
};
use crate::principal::Principal;

impl Document {
    /// The present line of time and all others (`TT1`), with people numbered in the order in which they appear.
    pub fn timeline(&self) -> Timeline {
        let mut people = BTreeMap::new();
        self.timeline_of(|author| {
            let next = people.len() as u32 + 1;
            *people.entry(author.clone()).or_insert(next)
        })
    }

    /// The present line of time and all others (`TT1`), with the numbers that people have.
    pub(crate) fn timeline_of(&self, number: impl FnMut(&Principal) -> u32) -> Timeline {
        let mut people = People { known: BTreeMap::new(), number };
        let operations = people.name(&self.history.operations, &self.history.parts_away());
        let mut futures: Vec<TimelineFuture> = (self.futures.all.iter())
            .map(|future| TimelineFuture {
                future: future.line,
                from: future.fork.step,
                on: future.on,
                steps: future.rows.steps(),
                operations: people.name(&future.operations, &[]),
            })
            .collect();
        futures.sort_by_key(|future| future.future);
        Timeline {
            line: self.futures.present,
            step: self.plant().step(),
            last_step: self.last_step(),
            done: self.history.done as u32,
            operations,
            futures,
        }
    }

    /// The width constraints in force, in order of their rows (`WI2`).
    pub fn widths(&self) -> Vec<WidthConstraint> {
        if self.plant().widths().next().is_none() {
            return Vec::new();
        }
        let girth = self.girth();
        let entry = |width: &widths::Width| WidthConstraint {
            row: width.metamer.raw(),
            diameter: width.wanted,
            effective: width.effective,
        };
        widths::in_force(self.plant(), &girth).iter().map(entry).collect()
    }

    /// Where each open bend that was moved stands, by its number (`BE5`).
    pub(crate) fn bend_motions(&self) -> BTreeMap<u32, Vec<RowMotion>> {
        let motions = |bend: &super::bending::OpenBend| {
            let rows = bend.path.iter().zip(bend.solver.motions());
            let entry = rows.map(|(row, motion)| RowMotion {
                row: row.raw(),
                rotation: motion.rotation.to_array(),
                to: motion.to.to_array(),
            });
            (bend.id, entry.collect())
        };
        self.bends.open.iter().filter(|bend| bend.is_moved).map(motions).collect()
    }

    pub(super) fn girth(&self) -> Girth {
        let parameters = self.simulation.parameters();
        Girth::new(parameters.girth_exponent, parameters.twig_diameter)
    }
}

/// Client keys are secret, so people are sent as numbers.
struct People<'a, F> {
    known: BTreeMap<&'a Principal, u32>,
    number: F,
}

impl<'a, F: FnMut(&Principal) -> u32> People<'a, F> {
    fn name(&mut self, operations: &'a [Operation], away: &[PartSet]) -> Vec<TimelineOperation> {
        let away = away.iter().copied().chain(std::iter::repeat(PartSet::default()));
        let name = |(operation, gone): (&'a Operation, PartSet)| {
            let Operation { first, last, .. } = *operation;
            let mut number = |author| *self.known.entry(author).or_insert_with(|| (self.number)(author));
            let author = number(&operation.author);
            let part =
                |part| TimelinePart { author: number(operation.author_of(part)), away: gone.holds(part) };
            let count = Some(operation.parts.count() as u8).filter(|&count| count > 1).unwrap_or(0);
            let parts = (0..count).map(part).collect();
            let away = operation.is_all_in(gone);
            TimelineOperation { kind: operation.kind.into(), author, first, last, away, parts }
        };
        operations.iter().zip(away).map(name).collect()
    }
}

impl From<Kind> for OperationKind {
    fn from(kind: Kind) -> Self {
        match kind {
            Kind::Stroke => Self::Stroke,
            Kind::Growth => Self::Growth,
            Kind::Parameters => Self::Parameters,
            Kind::Seed => Self::Seed,
            Kind::Lasso => Self::Lasso,
            Kind::Obstacle => Self::Obstacle,
            Kind::Bend => Self::Bend,
            Kind::Width => Self::Width,
            Kind::Prune => Self::Prune,
            Kind::Turn => Self::Turn,
            Kind::Graft => Self::Graft,
            Kind::Appearance => Self::Appearance,
            Kind::TakenBack => Self::TakenBack,
            Kind::BroughtBack => Self::BroughtBack,
            Kind::Design => Self::Design,
            Kind::Grammar => Self::Grammar,
            Kind::Refill => Self::Refill,
        }
    }
}
