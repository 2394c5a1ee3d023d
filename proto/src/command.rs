//! Commands: everything that can be done to a document, on the wire and in a replay script alike.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

use crate::parameters::ParametersPatch;

/// One place of the brush, in internode lengths.
///
/// Coordinates are right-handed with Y up; the ground is y = 0 and the first seed stands at the origin.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct StrokeSample {
    /// The centre of the brush.
    pub position: [f32; 3],
    /// The radius of the brush; 0 sketches one limb exactly.
    pub radius: f32,
}

/// Something done to a document. Commands of one session have one order; the journal keeps them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
#[allow(
    clippy::large_enum_variant,
    reason = "patches are rare, and a box in every message would be in everyone's way"
)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Command {
    /// A finger touches down with the brush. One stroke, begin to end, is one operation for undo.
    StrokeBegin {
        /// The client's own number for this stroke.
        stroke: u32,
    },
    /// The brush moves, or rests: a resting brush keeps sowing markers, so it is sent again and again.
    /// Each message grows the plants by at least one step.
    StrokeMove {
        /// The number given in `stroke_begin`.
        stroke: u32,
        /// 1 to 256 places, in the order the finger went through them.
        samples: Vec<StrokeSample>,
    },
    /// The finger lifts; growth goes on for the steps its last markers live.
    StrokeEnd {
        /// The number given in `stroke_begin`.
        stroke: u32,
    },
    /// Grow on without guidance.
    Grow {
        /// 1 to 1000 simulation steps.
        steps: u32,
        /// Commands of one client that follow each other with the same gesture are one operation for undo.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        gesture: Option<u32>,
    },
    /// Go back in time, step by step, through whatever made the plants grow.
    Ungrow {
        /// 1 to 1000 simulation steps.
        steps: u32,
    },
    /// Take back the last operation as a whole.
    Undo {},
    /// Do again what was last undone or ungrown.
    Redo {},
    /// Change some of the parameters; growth from here on uses them.
    SetParameters {
        /// The fields to change.
        parameters: ParametersPatch,
    },
    /// Plant a seed on the ground: another plant that competes for the same light and space.
    PlantSeed {
        /// Where, in internode lengths.
        position: [f32; 3],
    },
}
