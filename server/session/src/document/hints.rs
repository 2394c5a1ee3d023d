//! What somebody draws where nothing can grow, or growth does not reach: it is said once for each stroke and lasso
//! (`SG2`).
//!
//! Nothing of this is written or hashed, for nothing grows by it.

use std::collections::BTreeSet;

use espalier_growth::{Envelope, REACH, StrokeId};
use espalier_plant::{AxisId, MetamerId, Plant};
use espalier_proto::HintReason;
use glam::Vec3;

use super::{Document, strokes::OpenStroke};

/// Wood must lie this near to the end of a stroke for growth to have reached it, in internodes.
const REACHED: f32 = 2.0;

/// A stroke or lasso that does not get what was drawn.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct DrawnInVain {
    /// The author's number of the stroke, if it is one.
    pub stroke: Option<u32>,
    pub reason: HintReason,
    /// Where the hand was.
    pub place: Vec3,
}

/// A lasso that is grown into, as far as it may turn out to be drawn in vain.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct OpenLasso {
    envelope: Envelope,
    is_in_reach: bool,
    /// Its last corner.
    end: Vec3,
    /// Metamers from this row on were born after it had begun.
    first_born: usize,
}

impl OpenLasso {
    /// The same of an outline with this tip that a limb is to fill, whose buds are near.
    pub(super) fn around_limb(envelope: Envelope, tip: Vec3, plant: &Plant) -> Self {
        Self { envelope, is_in_reach: true, end: tip, first_born: plant.metamer_count() }
    }
}

/// What is still to be said, and of which strokes something has been said.
#[derive(Clone, Debug, Default)]
pub(super) struct Hints {
    drawn: Vec<DrawnInVain>,
    strokes: BTreeSet<StrokeId>,
}

impl Hints {
    pub fn say(&mut self, in_vain: DrawnInVain) {
        self.drawn.push(in_vain);
    }
}

impl Document {
    /// What was drawn in vain since the last call.
    pub(crate) fn take_drawn_in_vain(&mut self) -> Vec<DrawnInVain> {
        std::mem::take(&mut self.hints.drawn)
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

    /// A stroke that has ended, and has come to rest, may have grown nothing, or not to its end. That the document is
    /// full is said elsewhere (`LM4`).
    pub(super) fn hint_shortfall(&mut self, stroke: &OpenStroke) {
        let reason = self.simulation.guide(stroke.id).and_then(|guide| {
            let has_grown = self.plant().metamer_count() > guide.first_born.index();
            let Some(end) = guide.end().filter(|_| has_grown) else { return Some(HintReason::NothingGrew) };
            self.simulation.scene().is_free(end, REACHED).then_some(HintReason::DidNotReach)
        });
        if let Some(reason) = reason.filter(|_| !self.is_stopped() && self.require_room().is_ok()) {
            self.hint(stroke, reason);
        }
        self.hints.strokes.remove(&stroke.id);
    }

    fn hint(&mut self, stroke: &OpenStroke, reason: HintReason) {
        let Some(last) = stroke.last else { return };
        if self.hints.strokes.insert(stroke.id) {
            self.hints.say(DrawnInVain { stroke: Some(stroke.number), reason, place: last.position });
        }
    }

    /// A lasso that is about to be grown into; it ends at the last corner of its outline.
    pub(super) fn opened_lasso(&self, envelope: Envelope, outline: &[Vec3]) -> OpenLasso {
        let plant = self.plant();
        let buds = (0..plant.axis_count()).map(AxisId::new).filter(|&axis| plant.is_axis_alive(axis));
        let mut buds = buds.map(|axis| plant.bud_position(axis));
        let edges = || outline.iter().zip(outline.iter().cycle().skip(1));
        let is_near = |bud: Vec3| {
            envelope.contains(bud) || edges().any(|(&from, &to)| distance_to_edge(bud, from, to) <= REACH)
        };
        let end = outline.last().copied().unwrap_or_default();
        OpenLasso { is_in_reach: buds.any(is_near), envelope, end, first_born: plant.metamer_count() }
    }

    /// A lasso at which nothing grows any more may hold nothing of what grew for it.
    pub(super) fn hint_empty(&mut self, lasso: OpenLasso) {
        let plant = self.plant();
        let mut born = (lasso.first_born..plant.metamer_count()).map(MetamerId::new);
        let reason = match lasso {
            OpenLasso { is_in_reach: false, .. } => HintReason::OutOfReach,
            OpenLasso { first_born, .. } if first_born == plant.metamer_count() => HintReason::NothingGrew,
            _ => HintReason::DidNotReach,
        };
        let is_empty =
            !born.any(|id| plant.is_alive(id) && lasso.envelope.contains(plant.metamers().end(id)));
        if is_empty && !self.is_stopped() && self.require_room().is_ok() {
            self.hints.say(DrawnInVain { stroke: None, reason, place: lasso.end });
        }
    }
}

fn distance_to_edge(place: Vec3, from: Vec3, to: Vec3) -> f32 {
    let along = to - from;
    let length_squared = along.length_squared();
    let share = if length_squared > 0.0 { (place - from).dot(along) / length_squared } else { 0.0 };
    place.distance(from + along * share.clamp(0.0, 1.0))
}
