//! Commands: everything that can be done to a document, on the wire and in a replay script alike.

use espalier_settings::{AppearancePatch, ParametersPatch};
use serde::{Deserialize, Serialize};
use ts_rs::TS;

use crate::obstacle::{Obstacle, Pose, Shape};

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

/// A plane in space that an outline is drawn on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct DrawingPlane {
    /// The point that is (0, 0) on the plane, in internode lengths.
    pub origin: [f32; 3],
    /// Unit direction of the plane's x axis.
    pub right: [f32; 3],
    /// Unit direction of the plane's y axis, perpendicular to `right`.
    pub up: [f32; 3],
}

/// A lasso is as deep as it is wide unless it says otherwise.
fn whole_depth() -> f32 {
    1.0
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
        /// The row of a metamer: only the buds at its node and above follow the brush (`SG1`).
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        bud: Option<u32>,
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
        /// The row of a metamer: only the buds at its node and above grow (`SG1`).
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        bud: Option<u32>,
    },
    /// Fill an outline with growth: it becomes a body in space, full of markers, and plants grow into it
    /// until they find no more of them (`LA1`).
    Lasso {
        /// 3 to 4096 points on the plane, in internode lengths; the last is joined to the first.
        outline: Vec<[f32; 2]>,
        /// Where the outline lies.
        plane: DrawingPlane,
        /// How deep the body is, 0.1 to 1: at 1 it is as deep as it is wide, everywhere.
        #[serde(default = "whole_depth")]
        #[ts(as = "Option<f32>", optional)]
        depth: f32,
        /// The row of a metamer: only the buds at its node and above grow (`SG1`).
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        bud: Option<u32>,
    },
    /// End the growth that is under way or waits, and keep what has grown (`ST1`).
    Stop {
        /// Written by the server into its journal: no step beyond this one is run for what came before.
        /// What a client says here counts for nothing.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[ts(skip)]
        tick: Option<u32>,
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
        /// Changes of one client with the same gesture, one after the other, are one operation for undo (`AP2`).
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        gesture: Option<u32>,
    },
    /// Change how the tree and its surroundings look (`AP1`).
    SetAppearance {
        /// The sections to change, each as a whole.
        appearance: AppearancePatch,
        /// Changes of one client with the same gesture, one after the other, are one operation for undo (`AP2`).
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        gesture: Option<u32>,
    },
    /// Plant a seed on the ground: another plant that competes for the same light and space.
    PlantSeed {
        /// Where, in internode lengths.
        position: [f32; 3],
    },
    /// Put something into the scene that takes space and light away.
    PlaceObstacle {
        /// What, and where.
        obstacle: Obstacle,
        /// Obstacle commands of one client with the same gesture, one after the other, are one operation (`OB2`).
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        gesture: Option<u32>,
    },
    /// Put an obstacle elsewhere.
    MoveObstacle {
        /// Its id, as in `obstacles`.
        id: u32,
        /// Where it goes.
        pose: Pose,
        /// Obstacle commands of one client with the same gesture, one after the other, are one operation (`OB2`).
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        gesture: Option<u32>,
    },
    /// Give an obstacle other measures, or make it another of the simple shapes (`OB2`).
    ReshapeObstacle {
        /// Its id, as in `obstacles`.
        id: u32,
        /// What it becomes.
        shape: Shape,
        /// Obstacle commands of one client with the same gesture, one after the other, are one operation (`OB2`).
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        gesture: Option<u32>,
    },
    /// Take an obstacle away.
    RemoveObstacle {
        /// Its id, as in `obstacles`.
        id: u32,
        /// Obstacle commands of one client with the same gesture, one after the other, are one operation (`OB2`).
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        gesture: Option<u32>,
    },
    /// Fingers take hold of a branch to bend it; one bend, begin to end, is one operation for undo (`BE1`).
    BendBegin {
        /// The client's own number for this bend.
        bend: u32,
        /// The row of the metamer that stays where it is; the wood above it bends.
        base: u32,
        /// 1 to 8 rows above the base, all on one way up from it; the farthest is where the bend ends.
        touches: Vec<u32>,
        /// From 0, stiff in length, to 1, stretchy.
        stretch: f32,
        /// Bends of one client with the same gesture, one after the other, are one operation.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        gesture: Option<u32>,
    },
    /// The fingers move (`BE3`).
    BendMove {
        /// The number given in `bend_begin`.
        bend: u32,
        /// Where the end of each touched metamer is wanted, in internode lengths, in the order of `touches`.
        targets: Vec<[f32; 3]>,
    },
    /// The fingers let go: the branch keeps its new pose.
    BendEnd {
        /// The number given in `bend_begin`.
        bend: u32,
    },
    /// The branch goes back to where it was, and nothing has happened.
    BendCancel {
        /// The number given in `bend_begin`.
        bend: u32,
    },
    /// Set, change or remove a width constraint (`WI1`).
    SetWidth {
        /// The row of a living metamer.
        row: u32,
        /// How thick it is from now on, in internode lengths, 0.01 to 100; `null` removes the constraint.
        diameter: Option<f32>,
        /// Changes of one client to the same row with the same gesture, one after the other, are one operation.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        gesture: Option<u32>,
    },
    /// Cut branches off, each at the branching point below its row (`PR1`).
    Prune {
        /// 1 to 1024 rows of living metamers.
        rows: Vec<u32>,
        /// Commands of one client that follow each other with the same gesture are one operation for undo.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        gesture: Option<u32>,
    },
    /// Cut every lateral branch that stands in the dark as a whole (`PR3`).
    PruneDim {
        /// No node of such a branch receives more light than this, 0 to 1.
        exposure: f32,
    },
    /// Turn a whole branch about the place where it is borne (`BR1`).
    TurnBranch {
        /// The row that the branch begins with.
        row: u32,
        /// By what it is turned: a quaternion (x, y, z, w) of length 1.
        rotation: [f32; 4],
        /// Turns of one client of the same branch with the same gesture, one after the other, are one operation.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        gesture: Option<u32>,
    },
    /// Copy or move a branch onto another limb (`BR2`).
    Graft {
        /// The row that the branch begins with.
        row: u32,
        /// The row of the metamer whose node bears it from now on.
        onto: u32,
        /// By what it is turned: a quaternion (x, y, z, w) of length 1.
        rotation: [f32; 4],
        /// Whether the branch stays where it was as well.
        keep: bool,
    },
    /// Go to a step of the present line of time, back or forth (`TT2`).
    GoTo {
        /// 0 to the line's last step.
        step: u32,
    },
    /// Leave the present line of time for another one, at its end (`TT4`).
    TakeFuture {
        /// Its number, as in `timeline`.
        future: u32,
    },
}
