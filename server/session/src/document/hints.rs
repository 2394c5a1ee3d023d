//! What somebody draws where nothing can grow: it is said once for each stroke and lasso (`SG2`).
//!
//! Nothing of this is written or hashed, for nothing grows by it.

use std::collections::BTreeSet;

use espalier_growth::{Envelope, REACH, StrokeId};
use espalier_plant::AxisId;
use espalier_proto::HintReason;
use glam::Vec3;

use super::{Document, strokes::OpenStroke};

/// A stroke or lasso in which nothing grows.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Silence {
    /// The author's number of the stroke, if it is one.
    pub stroke: Option<u32>,
    pub reason: HintReason,
    /// Where the hand was.
    pub place: Vec3,
}

/// What is still to be said, and of which strokes something has been said.
#[derive(Clone, Debug, Default)]
pub(super) struct Hints {
    silences: Vec<Silence>,
    strokes: BTreeSet<StrokeId>,
}

impl Hints {
    pub fn say(&mut self, silence: impl IntoIterator<Item = Silence>) {
        self.silences.extend(silence);
    }
}

impl Document {
    /// What was drawn in vain since the last call.
    pub(crate) fn take_silences(&mut self) -> Vec<Silence> {
        std::mem::take(&mut self.hints.silences)
    }

    /// A stroke that has just been drawn on may find no bud where it begins.
    pub(super) fn hint_out_of_reach(&mut self, id: StrokeId) {
        let is_lost =
            self.simulation.guide(id).is_some_and(|guide| guide.is_out_of_reach && guide.is_connecting);
        let stroke = self.strokes.open.iter().find(|stroke| stroke.id == id).cloned();
        if let Some(stroke) = stroke.filter(|_| is_lost) {
            self.hint(&stroke, HintReason::OutOfReach);
        }
    }

    /// A stroke that has ended, and has come to rest, may have grown nothing. That the document is full is said
    /// elsewhere (`LM4`).
    pub(super) fn hint_nothing_grew(&mut self, stroke: &OpenStroke) {
        let metamers = self.plant().metamer_count();
        let guide = self.simulation.guide(stroke.id);
        let is_idle = guide.is_some_and(|guide| guide.first_born.index() == metamers);
        if is_idle && self.require_room().is_ok() {
            self.hint(stroke, HintReason::NothingGrew);
        }
        self.hints.strokes.remove(&stroke.id);
    }

    fn hint(&mut self, stroke: &OpenStroke, reason: HintReason) {
        let Some(last) = stroke.last else { return };
        if self.hints.strokes.insert(stroke.id) {
            self.hints.say([Silence { stroke: Some(stroke.number), reason, place: last.position }]);
        }
    }

    /// What to say of a lasso in which nothing grows: it ends at the last corner of its outline.
    pub(super) fn silence_of_lasso(&self, envelope: &Envelope, outline: &[Vec3]) -> Option<Silence> {
        let plant = self.plant();
        let buds = (0..plant.axis_count()).map(AxisId::new).filter(|&axis| plant.is_axis_alive(axis));
        let mut buds = buds.map(|axis| plant.bud_position(axis));
        let edges = || outline.iter().zip(outline.iter().cycle().skip(1));
        let is_near = |bud: Vec3| {
            envelope.contains(bud) || edges().any(|(&from, &to)| distance_to_edge(bud, from, to) <= REACH)
        };
        let reason = if buds.any(is_near) { HintReason::NothingGrew } else { HintReason::OutOfReach };
        outline.last().map(|&place| Silence { stroke: None, reason, place })
    }
}

fn distance_to_edge(place: Vec3, from: Vec3, to: Vec3) -> f32 {
    let along = to - from;
    let length_squared = along.length_squared();
    let share = if length_squared > 0.0 { (place - from).dot(along) / length_squared } else { 0.0 };
    place.distance(from + along * share.clamp(0.0, 1.0))
}
