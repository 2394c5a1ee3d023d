//! Selective growth (TreeSketch §3.2, Figure 9): only what a chosen node bears competes for markers.

use espalier_plant::{AxisId, MetamerId, Plant};

/// Which buds may claim markers in a step.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Selection {
    /// Whether each axis may; none to let all.
    allowed: Option<Vec<bool>>,
}

impl Selection {
    /// All buds, or those at the node of the chosen metamer and on all that grows above it.
    ///
    /// A chosen metamer that is dead, or not born at this time, lets nobody grow: growing everywhere instead is
    /// not what its chooser asked for.
    pub(crate) fn new(plant: &Plant, chosen: Option<MetamerId>) -> Self {
        let allowed = chosen.map(|chosen| {
            let mut above = vec![false; plant.metamer_count()];
            if chosen.index() < above.len() && plant.is_alive(chosen) {
                above[chosen.index()] = true;
                // Parents are born before what they bear.
                for index in chosen.index() + 1..above.len() {
                    let parent = plant.metamers().parent(MetamerId::new(index));
                    above[index] = parent.is_some_and(|parent| above[parent.index()]);
                }
            }
            (0..plant.axis_count()).map(|axis| above[plant.bud_node(AxisId::new(axis)).index()]).collect()
        });
        Self { allowed }
    }

    /// Whether all buds may.
    pub(crate) fn is_everyone(&self) -> bool {
        self.allowed.is_none()
    }

    /// Whether the bud of this axis may claim markers.
    #[inline]
    pub(crate) fn includes(&self, axis: AxisId) -> bool {
        self.allowed.as_ref().is_none_or(|allowed| allowed.get(axis.index()) == Some(&true))
    }
}
