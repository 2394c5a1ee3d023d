//! What can be done to a document: commands whose form has been checked.

mod outline;
mod shaping;

use espalier_proto::{
    Command, Problem, ProblemCode, StrokeSample,
    version::{MAX_STEPS_PER_COMMAND, MAX_STROKE_SAMPLES},
};
use espalier_settings::ParametersPatch;
use glam::{Quat, Vec3};

pub use self::outline::Lasso;
pub(crate) use self::shaping::{Prediction, parse_rotation};
use crate::{
    appearance::AppearanceChange,
    malformed,
    obstacle::{Form, Obstacle, Pose},
};

/// The farthest a position may lie from the origin on any axis, in internodes (`LM2`).
const FARTHEST: f32 = 1000.0;
/// The lowest y of a position, in internodes (`LM2`).
const DEEPEST: f32 = -10.0;
/// The widest brush, in internodes (`LM2`).
const WIDEST_BRUSH: f32 = 40.0;

/// One place of the brush, in internodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The centre of the brush.
    pub position: Vec3,
    /// The radius of the brush; 0 sketches one limb.
    pub radius: f32,
}

/// A command in good form (`LM2`, `LM3`). Whether it can be done now is for the document to say.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// A stroke begins.
    StrokeBegin {
        /// The author's number for it.
        stroke: u32,
        /// The row whose axis alone grows; all of them without one.
        bud: Option<u32>,
    },
    /// The brush moves or rests.
    StrokeMove {
        /// The author's number for the stroke.
        stroke: u32,
        /// Where it went, 1 to 256 places.
        samples: Vec<Sample>,
    },
    /// A stroke ends.
    StrokeEnd {
        /// The author's number for it.
        stroke: u32,
    },
    /// Growth without guidance.
    Grow {
        /// 1 to 1000 steps.
        steps: u32,
        /// Neighbours with the same gesture are one operation for undo.
        gesture: Option<u32>,
        /// The row whose axis alone grows; all of them without one.
        bud: Option<u32>,
    },
    /// Growth into an outline.
    Lasso {
        /// The outline.
        lasso: Box<Lasso>,
        /// The row whose axis alone grows; all of them without one.
        bud: Option<u32>,
    },
    /// An end to growth that was asked for before.
    Stop {
        /// Steps ever begun beyond which none is run for what came before.
        tick: Option<u32>,
    },
    /// Back in time.
    Ungrow {
        /// 1 to 1000 steps.
        steps: u32,
    },
    /// Take back the last operation.
    Undo,
    /// Do again what was taken back.
    Redo,
    /// Change parameters; all values are finite, their ranges are for the document to check.
    SetParameters {
        /// What to change.
        patch: Box<ParametersPatch>,
        /// Neighbours with the same gesture are one operation for undo.
        gesture: Option<u32>,
    },
    /// Change looks.
    SetAppearance {
        /// What to change.
        change: Box<AppearanceChange>,
        /// Neighbours with the same gesture are one operation for undo.
        gesture: Option<u32>,
    },
    /// Another plant.
    PlantSeed {
        /// Where.
        position: Vec3,
    },
    /// Something that stands in the way.
    PlaceObstacle {
        /// What, and where.
        obstacle: Box<Obstacle>,
        /// Neighbours with the same gesture are one operation for undo.
        gesture: Option<u32>,
    },
    /// An obstacle elsewhere.
    MoveObstacle {
        /// Which.
        id: u32,
        /// Where to.
        pose: Pose,
        /// Neighbours with the same gesture are one operation for undo.
        gesture: Option<u32>,
    },
    /// An obstacle that becomes another one where it stands.
    ReshapeObstacle {
        /// Which.
        id: u32,
        /// What it becomes; no mesh.
        form: Form,
        /// Neighbours with the same gesture are one operation for undo.
        gesture: Option<u32>,
    },
    /// An obstacle gone.
    RemoveObstacle {
        /// Which.
        id: u32,
        /// Neighbours with the same gesture are one operation for undo.
        gesture: Option<u32>,
    },
    /// A bend begins.
    BendBegin {
        /// The author's number for it.
        bend: u32,
        /// The row that stays.
        base: u32,
        /// 1 to 8 different rows.
        touches: Vec<u32>,
        /// 0 to 1.
        stretch: f32,
        /// Neighbours with the same gesture are one operation for undo.
        gesture: Option<u32>,
    },
    /// The touches of a bend move.
    BendMove {
        /// The author's number for it.
        bend: u32,
        /// Where each is wanted, 1 to 8 places.
        targets: Vec<Vec3>,
    },
    /// A bend ends.
    BendEnd {
        /// The author's number for it.
        bend: u32,
    },
    /// A bend is given up.
    BendCancel {
        /// The author's number for it.
        bend: u32,
    },
    /// A width constraint set, or removed.
    SetWidth {
        /// Where.
        row: u32,
        /// The diameter in internodes; none without a constraint.
        diameter: Option<f32>,
        /// Changes of one row with the same gesture are one operation for undo.
        gesture: Option<u32>,
    },
    /// Branches cut.
    Prune {
        /// 1 to 1024 rows.
        rows: Vec<u32>,
        /// Neighbours with the same gesture are one operation for undo.
        gesture: Option<u32>,
    },
    /// Branches in the dark cut.
    PruneDim {
        /// The most light, 0 to 1.
        exposure: f32,
    },
    /// A branch turned.
    TurnBranch {
        /// Its first row.
        row: u32,
        /// Of unit length.
        rotation: Quat,
        /// Turns of one branch with the same gesture are one operation for undo.
        gesture: Option<u32>,
    },
    /// A branch copied or moved.
    Graft {
        /// Its first row.
        row: u32,
        /// The row that bears it from now on.
        onto: u32,
        /// Of unit length.
        rotation: Quat,
        /// Whether it stays where it was as well.
        keep: bool,
    },
    /// Along the present line of time.
    GoTo {
        /// Where to.
        step: u32,
    },
    /// To another line of time.
    TakeFuture {
        /// Which.
        future: u32,
    },
}

impl Action {
    /// Checks a command's form; a problem names the field at fault.
    pub fn parse(command: &Command) -> Result<Self, Problem> {
        Ok(match command {
            &Command::StrokeBegin { stroke, bud } => Self::StrokeBegin { stroke, bud },
            Command::StrokeMove { stroke, samples } => {
                Self::StrokeMove { stroke: *stroke, samples: parse_samples(samples)? }
            }
            &Command::StrokeEnd { stroke } => Self::StrokeEnd { stroke },
            &Command::Grow { steps, gesture, bud } => Self::Grow { steps: parse_steps(steps)?, gesture, bud },
            Command::Lasso { outline, plane, depth, bud } => {
                Self::Lasso { lasso: Box::new(Lasso::parse(outline, plane, *depth)?), bud: *bud }
            }
            &Command::Stop { tick } => Self::Stop { tick },
            &Command::Ungrow { steps } => Self::Ungrow { steps: parse_steps(steps)? },
            Command::Undo {} => Self::Undo,
            Command::Redo {} => Self::Redo,
            Command::SetParameters { parameters, gesture } => {
                check_finite(parameters)?;
                Self::SetParameters { patch: Box::new(parameters.clone()), gesture: *gesture }
            }
            Command::SetAppearance { appearance, gesture } => {
                let change = Box::new(AppearanceChange::parse(appearance)?);
                Self::SetAppearance { change, gesture: *gesture }
            }
            Command::PlantSeed { position } => Self::PlantSeed { position: parse_position(position)? },
            Command::PlaceObstacle { obstacle, gesture } => {
                let obstacle = Obstacle::parse(obstacle).map_err(|problem| problem.within("obstacle"))?;
                Self::PlaceObstacle { obstacle: Box::new(obstacle), gesture: *gesture }
            }
            Command::MoveObstacle { id, pose, gesture } => {
                let pose = Pose::parse(pose).map_err(|problem| problem.within("pose"))?;
                Self::MoveObstacle { id: *id, pose, gesture: *gesture }
            }
            Command::ReshapeObstacle { id, shape, gesture } => {
                let form = Form::parse_simple(shape).map_err(|problem| problem.within("shape"))?;
                Self::ReshapeObstacle { id: *id, form, gesture: *gesture }
            }
            &Command::RemoveObstacle { id, gesture } => Self::RemoveObstacle { id, gesture },
            Command::BendBegin { bend, base, touches, stretch, gesture } => {
                shaping::bend_begin(*bend, *base, touches, *stretch, *gesture)?
            }
            Command::BendMove { bend, targets } => shaping::bend_move(*bend, targets)?,
            &Command::BendEnd { bend } => Self::BendEnd { bend },
            &Command::BendCancel { bend } => Self::BendCancel { bend },
            &Command::SetWidth { row, diameter, gesture } => shaping::set_width(row, diameter, gesture)?,
            Command::Prune { rows, gesture } => {
                Self::Prune { rows: shaping::pruned_rows(rows, 1)?, gesture: *gesture }
            }
            &Command::PruneDim { exposure } => shaping::prune_dim(exposure)?,
            Command::TurnBranch { row, rotation, gesture } => {
                Self::TurnBranch { row: *row, rotation: parse_rotation(rotation)?, gesture: *gesture }
            }
            Command::Graft { row, onto, rotation, keep } => {
                Self::Graft { row: *row, onto: *onto, rotation: parse_rotation(rotation)?, keep: *keep }
            }
            &Command::GoTo { step } => Self::GoTo { step },
            &Command::TakeFuture { future } => Self::TakeFuture { future },
        })
    }

    /// Reads a command as the journal and replay scripts hold it.
    pub fn from_json(text: &str) -> Result<Self, Problem> {
        let command = serde_json::from_str(text).map_err(|error| malformed::command(text, &error))?;
        Self::parse(&command)
    }

    /// The fewest simulation steps this will run, for telling people how much is still to come.
    pub(crate) fn least_steps(&self) -> u32 {
        match self {
            Self::Grow { steps, .. } => *steps,
            Self::StrokeMove { .. } | Self::Lasso { .. } => 1,
            _ => 0,
        }
    }
}

fn parse_samples(samples: &[StrokeSample]) -> Result<Vec<Sample>, Problem> {
    let count = samples.len();
    if !(1..=MAX_STROKE_SAMPLES).contains(&count) {
        let code = if count == 0 { ProblemCode::OutOfRange } else { ProblemCode::TooMany };
        return Err(Problem {
            code,
            field: Some("samples".into()),
            allowed: Some(format!("1 to {MAX_STROKE_SAMPLES}")),
            message: format!("samples has {count} entries; allowed: 1 to {MAX_STROKE_SAMPLES}"),
        });
    }
    let parse = |(index, sample)| {
        parse_sample(sample).map_err(|problem| problem.within(&format!("samples[{index}]")))
    };
    samples.iter().enumerate().map(parse).collect()
}

fn parse_sample(sample: &StrokeSample) -> Result<Sample, Problem> {
    let position = parse_position(&sample.position)?;
    let radius = sample.radius;
    if !(0.0..=WIDEST_BRUSH).contains(&radius) {
        return Err(Problem::out_of_range("radius", radius, format!("0 to {WIDEST_BRUSH}")));
    }
    Ok(Sample { position, radius })
}

/// A position within the world (`LM2`).
pub(crate) fn parse_position(position: &[f32; 3]) -> Result<Vec3, Problem> {
    for (axis, &value) in position.iter().enumerate() {
        let lowest = if axis == 1 { DEEPEST } else { -FARTHEST };
        if !(lowest..=FARTHEST).contains(&value) {
            let field = format!("position[{axis}]");
            return Err(Problem::out_of_range(field, value, format!("{lowest} to {FARTHEST}")));
        }
    }
    Ok(Vec3::from_array(*position))
}

fn parse_steps(steps: u32) -> Result<u32, Problem> {
    if (1..=MAX_STEPS_PER_COMMAND).contains(&steps) {
        Ok(steps)
    } else {
        Err(Problem::out_of_range("steps", steps, format!("1 to {MAX_STEPS_PER_COMMAND}")))
    }
}

/// JSON numbers beyond an f32 arrive as infinities, and JSON cannot write those down again.
fn check_finite(patch: &ParametersPatch) -> Result<(), Problem> {
    let Ok(serde_json::Value::Object(fields)) = serde_json::to_value(patch) else { return Ok(()) };
    match fields.iter().find(|(_, value)| value.is_null()) {
        Some((name, _)) => {
            Err(Problem::out_of_range(name, "not a finite number", "a finite number").within("parameters"))
        }
        None => Ok(()),
    }
}
