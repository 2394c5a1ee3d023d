//! Commands: everything that can be done to a document, on the wire, in the journal and in a replay script alike.

use std::borrow::Cow;

use espalier_settings::{AppearancePatch, ParametersPatch};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::Value;
use ts_rs::TS;

use crate::{
    bounded::{Age, BrushRadius, Depth, Diameter, LimbLength, LimbOrders, List, Share, Steps, Touches},
    design::{DesignEdit, DesignValue, MAX_DESIGN_EDITS},
    grammar::{GrammarBody, GrammarValue, MAX_GRAMMAR_VALUES},
    obstacle::{Obstacle, Pose, SimpleShape},
    place::{DrawingPlane, PlanePoint, Position, UnitRotation},
    problem::Problem,
    programme::{ParameterName, Programme, Slug},
    reading::{self, tagged_enum},
    version::{
        MAX_BEND_TOUCHES, MAX_OUTLINE_POINTS, MAX_PRUNED_ROWS, MAX_STROKE_SAMPLES, MIN_OUTLINE_POINTS,
    },
};

/// An action, and the gesture that it belongs to. It travels as one object: the action's kind and fields, and the
/// gesture beside them.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct Command {
    /// What to do.
    #[serde(flatten)]
    pub action: Action,
    /// Commands of one client that follow each other with the same gesture can be one operation for undo; `AP2`,
    /// `BE1`, `BR1`, `LA1`, `OB2`, `PR2` and `WI1` say which.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub gesture: Option<u32>,
}

impl Command {
    /// Reads a command as the journal and replay scripts hold it.
    ///
    /// # Errors
    ///
    /// A problem names the field and what is allowed there.
    pub fn from_json(text: &str) -> Result<Self, Problem> {
        reading::from_json(text)
    }
}

impl From<Action> for Command {
    /// Without a gesture.
    fn from(action: Action) -> Self {
        Self { action, gesture: None }
    }
}

impl JsonSchema for Command {
    fn schema_name() -> Cow<'static, str> {
        "Command".into()
    }

    /// Each action, with a gesture among its fields.
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut schema = Action::json_schema(generator);
        let gesture = json_schema!({
            "type": ["integer", "null"],
            "minimum": 0,
            "maximum": u32::MAX,
            "description": "Commands of one client with the same gesture can be one operation for undo.",
        });
        for action in schema.get_mut("oneOf").and_then(Value::as_array_mut).into_iter().flatten() {
            action["properties"]["gesture"] = gesture.clone().to_value();
        }
        schema
    }
}

impl<'de> Deserialize<'de> for Command {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let mut fields = reading::object(deserializer, "an object with kind")?;
        let gesture = fields.remove("gesture").unwrap_or_default();
        let action = reading::part("", &Value::Object(fields))?;
        Ok(Self { action, gesture: reading::part("gesture", &gesture)? })
    }
}

/// One place of the brush.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields, expecting = "an object with position and radius")]
pub struct StrokeSample {
    /// The centre of the brush, in internode lengths.
    pub position: Position,
    /// The radius of the brush; 0 sketches one limb exactly.
    pub radius: BrushRadius,
}

/// More names than there are parameters.
const MAX_NAMES: usize = 64;

/// Keys of one person that count as theirs beside the one they come with (`UD8`).
pub const MAX_OWN_KEYS: usize = 1024;

fn is_empty(keys: &[String]) -> bool {
    keys.is_empty()
}

/// A lasso is as deep as it is wide unless it says otherwise.
pub(crate) fn whole_depth() -> Depth {
    Depth::MOST
}

tagged_enum! {
    "kind",

    /// Something done to a document. Commands of one session have one order; the journal keeps them.
    pub enum Action {
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
            samples: List<StrokeSample, 1, MAX_STROKE_SAMPLES>,
        },
        /// The finger lifts; growth goes on until it has filled what the brush swept (`CM6`).
        StrokeEnd {
            /// The number given in `stroke_begin`.
            stroke: u32,
        },
        /// Grow on alone, by the programme if there is one (`PG2`).
        Grow {
            /// 1 to 1000 simulation steps.
            steps: Steps,
            /// Growth ends at this age, however many steps are left (`PG2`).
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[ts(optional)]
            until: Option<Age>,
            /// The row of a metamer: only the buds at its node and above grow (`SG1`).
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[ts(optional)]
            bud: Option<u32>,
        },
        /// Fill an outline with growth: it becomes a body in space, full of markers, and plants grow into it
        /// until they find no more of them (`LA1`).
        Lasso {
            /// 3 to 4096 points on the plane, in internode lengths; the last is joined to the first.
            outline: List<PlanePoint, MIN_OUTLINE_POINTS, MAX_OUTLINE_POINTS>,
            /// Where the outline lies.
            plane: DrawingPlane,
            /// How deep the body is, 0.1 to 1: at 1 it is as deep as it is wide, everywhere.
            #[serde(default = "whole_depth")]
            #[ts(as = "Option<f32>", optional)]
            depth: Depth,
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
            #[schemars(skip)]
            #[ts(skip)]
            tick: Option<u32>,
        },
        /// Go back in time, step by step, through whatever made the plants grow.
        Ungrow {
            /// 1 to 1000 simulation steps.
            steps: Steps,
        },
        /// Take back the last operation as a whole.
        Undo {},
        /// Do again what was last undone or ungrown.
        Redo {},
        /// Take back what this person did last and is in force, wherever it lies; what others drew stays (`UD1`).
        TakeBack {
            /// Written by the server into its journal: the other keys under which this person did something (`UD8`).
            /// What a client says here counts for nothing.
            #[serde(default, skip_serializing_if = "is_empty")]
            #[schemars(skip)]
            #[ts(skip)]
            keys: List<String, 0, MAX_OWN_KEYS>,
        },
        /// Put in force again what this person took back last (`UD3`).
        BringBack {
            /// As in `take_back`.
            #[serde(default, skip_serializing_if = "is_empty")]
            #[schemars(skip)]
            #[ts(skip)]
            keys: List<String, 0, MAX_OWN_KEYS>,
        },
        /// Change some of the parameters; growth from here on uses them.
        SetParameters {
            /// The fields to change.
            parameters: ParametersPatch,
        },
        /// Grow by a programme from here on, or by the present parameters alone (`PG3`).
        SetProgramme {
            /// The programme; `null` for none.
            programme: Option<Programme>,
            /// Whether parameters that were set by hand stay as they are.
            #[serde(default)]
            #[ts(as = "Option<bool>", optional)]
            keep: bool,
        },
        /// Let parameters that were set by hand follow the programme again (`PG4`).
        FollowProgramme {
            /// Their names; none for all of them.
            parameters: List<ParameterName, 0, MAX_NAMES>,
        },
        /// Change how the tree and its surroundings look (`AP1`).
        SetAppearance {
            /// The sections to change, each as a whole.
            appearance: AppearancePatch,
        },
        /// Plant a seed on the ground: another plant that competes for the same light and space.
        PlantSeed {
            /// Where, in internode lengths.
            position: Position,
        },
        /// Put something into the scene that takes space and light away.
        PlaceObstacle {
            /// What, and where.
            obstacle: Obstacle,
        },
        /// Put an obstacle elsewhere.
        MoveObstacle {
            /// Its id, as in `obstacles`.
            id: u32,
            /// Where it goes.
            pose: Pose,
        },
        /// Give an obstacle other measures, or make it another of the simple shapes (`OB2`).
        ReshapeObstacle {
            /// Its id, as in `obstacles`.
            id: u32,
            /// What it becomes; no mesh.
            shape: SimpleShape,
        },
        /// Take an obstacle away.
        RemoveObstacle {
            /// Its id, as in `obstacles`.
            id: u32,
        },
        /// Fingers take hold of a branch to bend it; one bend, begin to end, is one operation for undo (`BE1`).
        BendBegin {
            /// The client's own number for this bend.
            bend: u32,
            /// The row of the metamer that stays where it is; the wood above it bends.
            base: u32,
            /// 1 to 8 rows above the base, all on one way up from it; the farthest is where the bend ends.
            touches: Touches,
            /// From 0, stiff in length, to 1, stretchy.
            stretch: Share,
        },
        /// The fingers move (`BE3`).
        BendMove {
            /// The number given in `bend_begin`.
            bend: u32,
            /// Where the end of each touched metamer is wanted, in internode lengths, in the order of `touches`.
            targets: List<Position, 1, MAX_BEND_TOUCHES>,
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
            diameter: Option<Diameter>,
        },
        /// Cut branches off, each at the branching point below its row (`PR1`).
        Prune {
            /// 1 to 1024 rows of living metamers.
            rows: List<u32, 1, MAX_PRUNED_ROWS>,
        },
        /// Cut every lateral branch that stands in the dark as a whole (`PR3`).
        PruneDim {
            /// No node of such a branch receives more light than this, 0 to 1.
            exposure: Share,
        },
        /// Turn a whole branch about the place where it is borne (`BR1`).
        TurnBranch {
            /// The row that the branch begins with.
            row: u32,
            /// By what it is turned: a quaternion (x, y, z, w) of length 1.
            rotation: UnitRotation,
        },
        /// Copy or move a branch onto another limb (`BR2`).
        Graft {
            /// The row that the branch begins with.
            row: u32,
            /// The row of the metamer whose node bears it from now on.
            onto: u32,
            /// By what it is turned: a quaternion (x, y, z, w) of length 1.
            rotation: UnitRotation,
            /// Whether the branch stays where it was as well.
            keep: bool,
        },
        /// Begin a design: wood from its outline inwards, which follows what is said of its branches (`DS1`).
        NewDesign {
            /// Where it stands; without one it takes the place of the design in force.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[ts(optional)]
            position: Option<Position>,
            /// The template that it begins with.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[ts(optional)]
            template: Option<Slug>,
            /// The graph that it begins with, as in files of designs; a plain one without any.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[ts(optional)]
            graph: Option<DesignValue>,
        },
        /// Change the design in force (`DS2`): all of it or nothing.
        EditDesign {
            /// 1 to 64 edits, done one after another.
            edits: List<DesignEdit, 1, MAX_DESIGN_EDITS>,
        },
        /// Let the design in force go: its wood stays, and is wood like any other (`DS3`).
        ReleaseDesign {},
        /// Describe a plant that grew by a design, whose wood takes its place (`DS10`).
        FitDesign {
            /// The row of its seed or of any of its metamers; without one it is the plant that has most of them.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[ts(optional)]
            row: Option<u32>,
            /// Up to which order its limbs are described: 1 to 3, and 3 without it.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[ts(optional)]
            orders: Option<LimbOrders>,
        },
        /// Let a limb that grew fill another outline: what lies outside is cut, and it grows into what is free (`DS12`).
        Refill {
            /// The row that the limb begins with.
            row: u32,
            /// The outline, as designs write a `silhouette`; its base is where the limb begins.
            envelope: DesignValue,
            /// How the outline is turned in the scene: a quaternion (x, y, z, w) of length 1.
            rotation: UnitRotation,
            /// From its base to its point T, in internode lengths, 0.5 to 400.
            length: LimbLength,
            /// Whether all above the first fork of the limb is cut, rather than what lies outside.
            #[serde(default)]
            #[ts(as = "Option<bool>", optional)]
            anew: bool,
        },
        /// Plant what a grammar writes (`GR1`).
        SetGrammar {
            /// The text of the grammar.
            text: String,
            /// What its sliders are set to; others have the values of the text.
            #[serde(default)]
            #[ts(as = "Option<List<GrammarValue, 0, MAX_GRAMMAR_VALUES>>", optional)]
            values: List<GrammarValue, 0, MAX_GRAMMAR_VALUES>,
            /// The seed of its chance; that of the document if there is none.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[ts(optional)]
            seed: Option<u32>,
            /// Where its turtle begins, on the ground; the middle if nothing is said.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[ts(optional)]
            position: Option<Position>,
            /// Steps of derivation to begin with; none if nothing is said.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[ts(optional)]
            depth: Option<Steps>,
            /// A body that the grammar may ask for as `inside(0)`.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[ts(optional)]
            within: Option<GrammarBody>,
        },
        /// Give the grammar in force another body to ask for, or take it away; its plant follows (`GR9`).
        SetGrammarBody {
            /// What `inside(0)` asks for; no body if nothing is said.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[ts(optional)]
            within: Option<GrammarBody>,
        },
        /// Derive the grammar in force further; each step is one of growth (`GR2`).
        Derive {
            /// 1 to 1000 steps of derivation.
            steps: Steps,
        },
        /// Set sliders of the grammar in force; its plant follows (`GR3`).
        SetGrammarValues {
            /// The sliders to set; others stay as they are.
            values: List<GrammarValue, 0, MAX_GRAMMAR_VALUES>,
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
}
