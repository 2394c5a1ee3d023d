//! Whose the metamers of a step are, where several strokes guide it.

use std::collections::BTreeMap;

use espalier_plant::{AxisId, MetamerId, Plant};

use crate::{brush::StrokeId, generator::Share, growth::Growth, step::StepInput};

impl Growth {
    /// Whether what a step grows may be of several strokes, or of a stroke and of a lasso or of none.
    pub(crate) fn is_shared(&self, input: &StepInput) -> bool {
        let by_itself = input.autonomous.then_some(None);
        let led = self.guides.keys().map(|&stroke| Some(stroke));
        let mut strokes = by_itself.into_iter().chain(led).chain(self.markers.strokes());
        let first = strokes.next();
        strokes.any(|stroke| Some(stroke) != first)
    }

    /// The shares of the metamers from `born` on, while what buds have claimed is still known. A leader's are those of the
    /// stroke it follows, another bud's those of the stroke of most markers it has claimed.
    pub(crate) fn shares(&self, plant: &Plant, born: usize) -> Vec<Share> {
        if !self.claims.counts_strokes() {
            return Vec::new();
        }
        let led = self.guides.iter().filter_map(|(&stroke, guide)| Some((guide.leader?, stroke)));
        let led: BTreeMap<AxisId, StrokeId> = led.collect();
        let mut shares: Vec<Share> = Vec::new();
        for first in (born..plant.metamer_count()).map(MetamerId::new) {
            let axis = plant.metamers().axis(first);
            let stroke = led.get(&axis).copied().or_else(|| self.claims.stroke(axis));
            if shares.last().is_none_or(|last| last.stroke != stroke) {
                shares.push(Share { first, stroke });
            }
        }
        shares
    }
}
