//! What clients are notified of a document beside its rows and figures: lines of time, width constraints, open bends.

use std::collections::BTreeMap;

use espalier_plant::{Girth, widths};
use espalier_proto::{
    OperationKind, RowMotion, Timeline, TimelineFuture, TimelineOperation, WidthConstraint,
};

use super::{
    Document,
    history::{Kind, Operation},
};
use crate::principal::Principal;

impl Document {
    /// The present line of time and all others (`TT1`).
    pub fn timeline(&self) -> Timeline {
        let mut people = People::default();
        let operations = people.name(&self.history.operations, &self.history.away());
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
            last_step: self.plant().last_step(),
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
#[derive(Default)]
struct People<'a>(BTreeMap<&'a Principal, u32>);

impl<'a> People<'a> {
    fn name(&mut self, operations: &'a [Operation], away: &[bool]) -> Vec<TimelineOperation> {
        let away = away.iter().copied().chain(std::iter::repeat(false));
        operations.iter().zip(away).map(|(operation, away)| self.name_one(operation, away)).collect()
    }

    fn name_one(&mut self, operation: &'a Operation, away: bool) -> TimelineOperation {
        let next = self.0.len() as u32;
        let author = *self.0.entry(&operation.author).or_insert(next);
        let kind = match operation.kind {
            Kind::Stroke => OperationKind::Stroke,
            Kind::Growth => OperationKind::Growth,
            Kind::Parameters => OperationKind::Parameters,
            Kind::Seed => OperationKind::Seed,
            Kind::Lasso => OperationKind::Lasso,
            Kind::Obstacle => OperationKind::Obstacle,
            Kind::Bend => OperationKind::Bend,
            Kind::Width => OperationKind::Width,
            Kind::Prune => OperationKind::Prune,
            Kind::Turn => OperationKind::Turn,
            Kind::Graft => OperationKind::Graft,
            Kind::Appearance => OperationKind::Appearance,
            Kind::TakenBack => OperationKind::TakenBack,
            Kind::BroughtBack => OperationKind::BroughtBack,
        };
        TimelineOperation { kind, author, first: operation.first, last: operation.last, away }
    }
}
