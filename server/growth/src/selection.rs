//! Selective growth (TreeSketch §3.2, Figure 9): only the branch of one chosen bud competes for markers.

use espalier_plant::{AxisId, Plant};

/// Which buds may claim markers in a step.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Selection {
    /// Whether each axis may; none to let all.
    allowed: Option<Vec<bool>>,
}

impl Selection {
    /// All buds, or those of the chosen axis and of every axis borne on it.
    ///
    /// A chosen axis that is dead, or not born at this time, lets nobody grow: growing everywhere instead is
    /// not what its chooser asked for.
    pub(crate) fn new(plant: &Plant, chosen: Option<AxisId>) -> Self {
        let allowed = chosen.map(|chosen| {
            let mut allowed = vec![false; plant.axis_count()];
            if chosen.index() < plant.axis_count() && plant.is_axis_alive(chosen) {
                allowed[chosen.index()] = true;
                // Bearers are born before what they bear.
                for index in chosen.index() + 1..plant.axis_count() {
                    let bearer = plant.axes().bearer(AxisId::new(index));
                    allowed[index] =
                        bearer.is_some_and(|bearer| allowed[plant.metamers().axis(bearer).index()]);
                }
            }
            allowed
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
