//! Shedding (TreeSketch §3.2): a branch whose vigor per internode falls below a threshold is given up.

use espalier_plant::{AxisId, Plant};

use crate::{canopy::Canopy, parameter_table::ParameterTable};

/// Steps a branch is given before it is judged: a shoot of the last step has had no light yet.
const GRACE: u32 = 3;

/// Axes whose branches do not pay, some of them inside others.
pub(crate) fn condemned(plant: &Plant, canopy: &Canopy, parameters: &ParameterTable) -> Vec<AxisId> {
    if parameters.scene().shedding_threshold == 0.0 {
        return Vec::new();
    }
    let gain = f64::from(parameters.scene().vigor_gain);
    let threshold = |axis| gain * f64::from(parameters.of(axis).shedding_threshold);
    canopy.starving(plant, |first| plant.age(first) >= GRACE, threshold)
}
