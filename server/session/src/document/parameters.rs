//! Parameters between the wire and the simulation.

use espalier_growth::{ParameterValues, Parameters, VigorModel};
use espalier_proto::{Problem, ProblemCode, VigorModel as WireVigorModel};

use crate::across::{Across, enums};

enums! { VigorModel = WireVigorModel { BorchertHonda, Priority } }

/// Copies every field by name, so that a field on one side alone does not compile.
macro_rules! convert {
    ($from:expr => $to:ident { $($name:ident),+ $(,)? }) => {
        $to { $($name: $from.$name.across()),+ }
    };
}

macro_rules! fields {
    ($from:expr => $to:ident) => {
        convert!($from => $to {
            internode_length, occupancy_radius, perception_depth, perception_angle, phyllotactic_angle,
            buds_per_node, branching_angle, deflection_angle, apical_control,
            mature_apical_control, maturity_start, maturity_steps, light_sensitivity, max_shoot_length,
            shedding_threshold, vigor_gain, vigor_model, priority_least_weight, priority_decline,
            heading_weight, tropism_weight, space_weight, phototropism,
            setpoint_angle, trunk_upward, tropism_from_stroke, gravimorphism_vertical,
            gravimorphism_horizontal, gravimorphism_shift, marker_density, markers_per_bud, marker_max_age,
            shadow_strength, shadow_decay, shadow_depth, girth_exponent, twig_diameter, leaves_per_node,
            leaf_size,
        })
    };
}

type WireParameters = espalier_proto::Parameters;

/// Checks every range.
pub(crate) fn parse(wire: &WireParameters) -> Result<Parameters, Problem> {
    let values = fields!(wire => ParameterValues);
    Parameters::new(values).map_err(|error| Problem {
        code: ProblemCode::OutOfRange,
        field: Some(error.name.to_owned()),
        message: error.to_string(),
        allowed: Some(error.allowed),
    })
}

pub(crate) fn to_proto(values: &ParameterValues) -> WireParameters {
    fields!(values => WireParameters)
}

/// All values as words, for hashing.
pub(super) fn to_words(values: &ParameterValues) -> Vec<u64> {
    // The JSON text of a float is its shortest exact form, so equal text means equal bits.
    let text = serde_json::to_vec(&to_proto(values)).unwrap_or_default();
    text.chunks(8).map(|chunk| chunk.iter().fold(0, |word, &byte| word << 8 | u64::from(byte))).collect()
}
