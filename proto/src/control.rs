//! Control messages: JSON text in both directions over a session's WebSocket.

use espalier_settings::{Appearance, ParameterValues};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use ts_rs::TS;

use crate::{
    access::Role,
    bounded::{BrushRadius, List, PredictedSteps},
    command::Command,
    comment::Pin,
    design::{BranchPath, DesignInForce, DyeColours, DyedBlock, LimbOutline, PlacedBranch},
    envelope::FrameKind,
    grammar::GrammarInForce,
    obstacle::PlacedObstacle,
    place::Position,
    presence::{Author, Camera, Person, Pointer},
    problem::Problem,
    programme::{Programme, Slug},
    reading::{self, tagged_enum},
    text::Name,
    timeline::{OperationKind, Timeline, TimelineChange, WidthConstraint},
    version::{MAX_PRUNED_ROWS, MAX_SKETCH_PLACES},
};

/// What a returning client still has (`RS1`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields, expecting = "an object with epoch, generations and rows")]
pub struct Resume {
    /// The epoch of the frames it holds.
    pub epoch: u32,
    /// The generation of each chunk it holds, by chunk number.
    pub generations: Vec<u32>,
    /// How many rows it holds.
    pub rows: u32,
}

fn mesh_delta() -> FrameKind {
    FrameKind::MeshDelta
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks with a reference")]
fn is_mesh_delta(kind: &FrameKind) -> bool {
    *kind == mesh_delta()
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks with a reference")]
fn is_zero(number: &u32) -> bool {
    *number == 0
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks with a reference")]
fn is_false(value: &bool) -> bool {
    !value
}

tagged_enum! {
    "type",

    /// From a client.
    pub enum ClientMessage {
        /// The first message (`HS1`).
        Hello {
            /// [`crate::version::PROTOCOL_VERSION`].
            protocol: u32,
            /// A random key this client keeps across reconnections: 8 to 64 letters, digits, `-` or `_`.
            client: String,
            /// What it still holds of this session, if it returns.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[ts(optional)]
            resume: Option<Resume>,
        },
        /// Something to do (`CM1`).
        Command {
            /// 1, 2, 3 … for each client key; sent again after a reconnection until acknowledged.
            id: u32,
            /// What to do.
            command: Command,
        },
        /// The client has taken in frames up to this sequence (`FL1`).
        Received {
            /// The sequence of the newest frame.
            sequence: u32,
            /// The kind of that frame as in its header; 1, a mesh delta, if left out.
            #[serde(default = "mesh_delta", skip_serializing_if = "is_mesh_delta")]
            #[ts(as = "Option<u8>", optional)]
            kind: FrameKind,
        },
        /// How would the plants grow on without these branches? The answer is a ghost, for this client alone (`PD1`).
        Predict {
            /// Up to 1024 rows, each as in `prune`.
            rows: List<u32, 0, MAX_PRUNED_ROWS>,
            /// Up to 100 simulation steps; 0 without rows ends the ghost.
            steps: PredictedSteps,
        },
        /// Which branch of the design this client looks at: it is told where that and those around it stand (`DS8`).
        LookAtBranch {
            /// The branch; without one it is told nothing more.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[ts(optional)]
            of: Option<BranchPath>,
        },
        /// Which limb lies a row on, and which outline has it? The answer is `limb`, for this client alone (`DS13`).
        LookAtLimb {
            /// The row of a living metamer.
            row: u32,
        },
        /// Where somebody points and what they do: the newest only counts, and nothing is kept (`PS1`).
        ///
        /// What is left out is not there, but for camera and name, which stay as they were.
        Here {
            /// Where they point, if anywhere.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[ts(optional)]
            pointer: Option<Pointer>,
            /// The radius of their brush, if that is what they hold.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[ts(optional)]
            radius: Option<BrushRadius>,
            /// The tool that they hold.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[ts(optional)]
            tool: Option<Slug>,
            /// 1 to 48 places of a line that they are drawing and that is not sent yet.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[ts(optional)]
            sketch: Option<List<Position, 1, MAX_SKETCH_PLACES>>,
            /// What they see.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[ts(optional)]
            camera: Option<Camera>,
            /// Whether they look at something else.
            #[serde(default, skip_serializing_if = "is_false")]
            #[ts(as = "Option<bool>", optional)]
            away: bool,
            /// What they want to be called.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[ts(optional)]
            name: Option<Name>,
        },
        /// Follow the camera of a device (`PS4`).
        Follow {
            /// Which; none to follow nobody any more.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[ts(optional)]
            device: Option<u32>,
        },
        /// Bring everyone to a view (`PS5`).
        Gather {
            /// The view.
            camera: Camera,
        },
        /// Says whether the rows that this client holds are those of the server (`CK1`).
        Check {},
        /// Is the server there?
        Ping {
            /// Comes back in the pong.
            nonce: u32,
        },
    }
}

/// A message of a client that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unreadable {
    /// The number of the command, if it is one.
    pub id: Option<u32>,
    /// Why. The field of a command is named as in the command, not as in the message.
    pub problem: Problem,
}

impl ClientMessage {
    /// Reads a message.
    ///
    /// # Errors
    ///
    /// It is no known message; a problem names the field and what is allowed there.
    pub fn from_json(text: &str) -> Result<Self, Unreadable> {
        let (value, twice) = match reading::parse(text) {
            Ok(value) => (value, None),
            // One in which a name stands twice may still say which command it is.
            Err(problem) => match serde_json::from_str(text) {
                Ok(value) => (value, Some(problem)),
                Err(_) => return Err(Unreadable { id: None, problem: of_whole(problem) }),
            },
        };
        let is_command = value.get("type").is_some_and(|kind| kind == "command");
        let id = value.get("id").and_then(Value::as_u64).filter(|_| is_command);
        let id = id.and_then(|id| u32::try_from(id).ok());
        if let Some(mut problem) = twice {
            let field = problem.field.take().unwrap_or_default();
            let id = id.filter(|_| !matches!(&*field, "id" | "type"));
            let inner = field.strip_prefix("command.").filter(|_| id.is_some()).map(str::to_owned);
            problem.field = Some(inner.unwrap_or(field));
            return Err(Unreadable { id, problem });
        }
        let command = value.get("command").filter(|_| id.is_some()).cloned();
        reading::from_value(value).map_err(|problem| {
            let command = command.map(reading::from_value::<Command>);
            let inner = command.and_then(Result::err).filter(|problem| problem.field.is_some());
            Unreadable { id, problem: inner.unwrap_or_else(|| of_whole(problem)) }
        })
    }
}

/// A problem with no part of a message is one with all of it.
fn of_whole(problem: Problem) -> Problem {
    Problem { field: problem.field.or_else(|| Some("message".into())), ..problem }
}

/// Figures of the document as a whole, sent after each change.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct DocumentState {
    /// The simulation step reached.
    pub step: u32,
    /// The age of the plants, by which a programme goes (`PG1`).
    pub age: u32,
    /// Living metamers.
    pub metamers: u32,
    /// Living axes with at least one metamer.
    pub axes: u32,
    /// Leaves.
    pub leaves: u32,
    /// The most metamers, dead ones included, this document may hold.
    pub metamer_budget: u32,
    /// Whether it holds that many: nothing grows any more until something is undone (`LM4`).
    pub budget_reached: bool,
    /// Whether there is an operation to undo.
    pub can_undo: bool,
    /// Whether there is something to redo.
    pub can_redo: bool,
    /// Simulation steps still to be run for commands already accepted; a lasso and a stroke
    /// that has ended, whose steps nobody knows before, count as one each until they are done.
    pub pending_steps: u32,
    /// How many of them are trials of a design that is being fitted, at most (`DS10`); 0 where none is.
    #[serde(default, skip_serializing_if = "is_zero")]
    #[ts(optional, as = "Option<u32>")]
    pub trials: u32,
    /// Clients connected, this one included.
    pub people: u32,
    /// Why growth rests though there is something to grow (`LM19`, `OP5`); absent where it does not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub paused: Option<Pause>,
}

/// Why growth rests.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(rename_all = "snake_case")]
pub enum Pause {
    /// The server has no memory for it now; it goes on when there is some (`LM19`).
    Memory,
    /// The server did not outlive it twice; it goes on when an owner says so (`OP5`).
    Crashes,
}

/// What everybody in a session is notified of once: how it was opened (`OP`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Notice {
    /// The last commands were done again by other rules of growth, and may have grown otherwise (`OP2`).
    Regrown {
        /// The version of the simulation by which they were done first.
        from: u32,
        /// The version that this server has.
        to: u32,
    },
    /// The journal is damaged: what was done from this entry on is missing and kept aside (`OP4`).
    Damaged {
        /// The first entry that is missing; 1, 2, 3 … within the session.
        #[ts(type = "number")]
        entry: u64,
    },
}

/// What somebody drew where nothing can grow, or growth did not reach (`SG2`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct Hint {
    /// The command with which it became known: the lasso, or the last one of the stroke.
    pub id: u32,
    /// The number of the stroke, if it is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub stroke: Option<u32>,
    /// Why it is not there.
    pub reason: HintReason,
    /// Where the brush or the end of the outline was.
    pub position: Position,
}

/// What came of `take_back` or `bring_back`, of `undo` or `redo` (`UD7`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct Deed {
    /// The command.
    pub id: u32,
    /// What was taken back, or brought back.
    pub kind: OperationKind,
    /// Whether it is taken back now.
    pub away: bool,
    /// So many metamers fell,
    pub fell: u32,
    /// so many rose,
    pub rose: u32,
    /// and so many of what was taken back stay, since wood that somebody else drew stands on them.
    pub held: u32,
    /// Later deeds of one's own of which nothing could go.
    #[serde(default, skip_serializing_if = "is_none")]
    #[ts(as = "Option<u32>", optional)]
    pub passed: u32,
}

fn is_none(count: &u32) -> bool {
    *count == 0
}

/// Why what somebody drew is not there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(rename_all = "snake_case")]
pub enum HintReason {
    /// No bud is in reach (`SG2`).
    OutOfReach,
    /// Buds are near, and none could grow there: the space is taken, or something stands in the way.
    NothingGrew,
    /// Something grew, but no wood is within 2 internodes of the end of the stroke, or none of it in the lasso.
    DidNotReach,
}

/// From the server.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
pub enum ServerMessage {
    /// The session is being read; the welcome comes when it is (`HS8`).
    Loading {
        /// How much of it is done, from 0 to 1.
        share: f32,
    },
    /// The answer to a hello (`HS2`).
    Welcome {
        /// [`crate::version::PROTOCOL_VERSION`].
        protocol: u32,
        /// The session's name, as in its link.
        session: String,
        /// The epoch of the frames that follow; generations of another epoch mean nothing.
        epoch: u32,
        /// Whether the client's resume was taken up; if not, it must forget its rows.
        resumed: bool,
        /// The highest command of this client that is durable; later ones must be sent again.
        acknowledged: u32,
        /// The parameters in force.
        parameters: Box<ParameterValues>,
        /// The document.
        state: DocumentState,
    },
    /// Every command of this client up to `id` is durable (`CM2`).
    Acknowledged {
        /// The command.
        id: u32,
    },
    /// Nothing that this client asked for is under way any more (`CM11`).
    Done {
        /// Its last command.
        id: u32,
        /// The step at which the tree is then.
        step: u32,
        /// Living metamers of all plants.
        metamers: u32,
    },
    /// A command was not done; nothing in the document changed (`CM3`).
    Refused {
        /// The command.
        id: u32,
        /// Why.
        problem: Problem,
    },
    /// A message could not be read at all, or a prediction not be made; nothing in the document changed.
    Problem {
        /// Why.
        problem: Problem,
    },
    /// What this client asked to be taken back, or brought back, is so (`UD7`).
    Deed {
        /// What came of it.
        deed: Deed,
    },
    /// The document changed.
    State {
        /// The document.
        state: DocumentState,
    },
    /// Someone changed the parameters.
    Parameters {
        /// The parameters in force.
        parameters: Box<ParameterValues>,
    },
    /// The programme, and what overrides it: after the welcome if there is one, and when it changes (`PG5`).
    Programme {
        /// The programme in force.
        programme: Option<Box<Programme>>,
        /// The names of the parameters that were set by hand and do not follow it.
        by_hand: Vec<String>,
    },
    /// How the tree looks: after the welcome, and when it changes (`AP3`).
    Appearance {
        /// The appearance in force.
        appearance: Box<Appearance>,
        /// When its wind took the place of another, in milliseconds since the server started; 0 if it never did (`WD3`).
        #[ts(type = "number")]
        wind_since: u64,
    },
    /// The obstacles in the scene, all of them: after the welcome if there are any, and when they change (`OB3`).
    Obstacles {
        /// In order of their ids.
        obstacles: Vec<PlacedObstacle>,
    },
    /// What was done, line by line: after the welcome (`TT1`).
    Timeline(Box<Timeline>),
    /// What changed of it since it was told last (`TT6`).
    TimelineChanged(Box<TimelineChange>),
    /// The width constraints in force, all of them: after the welcome if there are any, and when they change (`WI2`).
    Widths {
        /// In order of their rows.
        widths: Vec<WidthConstraint>,
    },
    /// The design in force: after the welcome if there is one, and when it changes (`DS4`).
    Design {
        /// The design; none where there is none any more.
        design: Option<Box<DesignInForce>>,
    },
    /// The colours that designs say of branches: after the welcome if there are any, and when they change (`DS14`).
    Dyes {
        /// At most 15 different ones; none where every branch has the colours of the tree.
        dyes: Vec<DyeColours>,
        /// Which rows have which, in ascending order. Rows in none of the blocks have the dye of the row that bears them.
        blocks: Vec<DyedBlock>,
    },
    /// Where branches of the design stand, to whom looks at one: at once, and when the design changes (`DS8`).
    Branches {
        /// The branch that was asked for.
        of: BranchPath,
        /// Those on the way to it, it, and the laterals of each of these, as far as they are wood: lower orders first.
        branches: Vec<PlacedBranch>,
    },
    /// A limb that grew, to whom looks at it (`DS13`).
    Limb {
        /// The row that was asked for.
        of: u32,
        /// The limb; none where no limb lives there, or it follows a design.
        limb: Option<Box<LimbOutline>>,
    },
    /// The grammar in force: after the welcome if there is one, and when it changes (`GR5`).
    Grammar {
        /// The grammar; none where there is none any more.
        grammar: Option<Box<GrammarInForce>>,
    },
    /// How the session was opened, after the welcome (`OP3`).
    Notice {
        /// What happened.
        notice: Notice,
    },
    /// What this client draws comes to nothing (`SG2`).
    Hint {
        /// What and why.
        hint: Hint,
    },
    /// Who is here, all of them: to whom has said `here`, and when it changes (`PS3`).
    People {
        /// The number of the device that this goes to.
        you: u32,
        /// In order of their numbers.
        people: Vec<Person>,
        /// How many devices are here beside those.
        more: u32,
    },
    /// Who did what a replay shows: after its welcome (`RP3`).
    Authors {
        /// In order of their numbers.
        authors: Vec<Author>,
    },
    /// Somebody brings everyone to a view (`PS5`).
    Gathered {
        /// The device that asked for it.
        by: u32,
        /// The view.
        camera: Camera,
    },
    /// What this client may do from now on (`AU3`).
    Role {
        /// As the role.
        role: Role,
    },
    /// Where the comments of the tree are pinned now: after the welcome if there are any, and those that change (`CT2`).
    Pins {
        /// In order of their threads.
        pins: Vec<Pin>,
    },
    /// What people say of the tree has changed: whoever shows it asks for it again (`CT3`).
    ThreadsChanged {
        /// The threads.
        threads: Vec<u32>,
    },
    /// What the rows add up to, to whom has asked for a check (`CK1`).
    Checksum {
        /// The mesh delta up to which they are counted; 0 before the first.
        sequence: u32,
        /// How many rows there are.
        rows: u32,
        /// CRC-32 of all rows.
        crc32: u32,
        /// A hash of the plants, as 16 hexadecimal digits: `plant_hash` of the command line (`CK2`).
        plant: String,
    },
    /// The answer to a ping.
    Pong {
        /// The ping's.
        nonce: u32,
        /// Milliseconds since the server started (`WD2`).
        #[ts(type = "number")]
        at: u64,
    },
}
