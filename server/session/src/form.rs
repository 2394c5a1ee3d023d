//! What a command's form must be beyond what its type says: parameters and looks in range, meshes that are solid.

use espalier_proto::{Action, Command, Position, Problem, Reason};
use espalier_settings::{ParameterValues, ParametersPatch};
use glam::Vec3;

use crate::{appearance::AppearanceChange, obstacle::Obstacle, schedule::Plan};

// The wire lets nothing stand outside the world that growth keeps to.
const _: () = assert!(espalier_growth::WORLD_EXTENT == espalier_proto::place::FARTHEST);

/// Reads a command as the journal and replay scripts hold it.
///
/// # Errors
///
/// A problem names the field and what is allowed there.
pub fn read_command(text: &str) -> Result<Command, Problem> {
    let command = Command::from_json(text)?;
    check(&command.action)?;
    Ok(command)
}

/// The place of a seed.
pub(crate) fn on_ground(position: Position) -> Result<Vec3, Problem> {
    let place = position.get();
    if place.y == 0.0 {
        return Ok(place);
    }
    let problem = Problem::out_of_range("position[1]", place.y, "0, the ground");
    Err(Problem { reason: Reason::OffGround, ..problem })
}

/// Checks what the type of an action leaves open.
pub(crate) fn check(action: &Action) -> Result<(), Problem> {
    match action {
        Action::SetParameters { parameters } => check_finite(parameters),
        Action::SetProgramme { programme: Some(programme), .. } => {
            Plan::new(programme.clone()).map(drop).map_err(|problem| problem.within("programme"))
        }
        Action::SetAppearance { appearance } => AppearanceChange::parse(appearance).map(drop),
        Action::PlaceObstacle { obstacle } => Obstacle::of(obstacle).map(drop),
        _ => Ok(()),
    }
}

/// JSON numbers beyond an f32 arrive as infinities, and JSON cannot write those down again.
fn check_finite(patch: &ParametersPatch) -> Result<(), Problem> {
    let Ok(serde_json::Value::Object(fields)) = serde_json::to_value(patch) else { return Ok(()) };
    match fields.iter().find(|(_, value)| value.is_null()) {
        Some((name, _)) => {
            let row = ParameterValues::ROWS.iter().find(|row| row.name == name);
            let allowed = row.map_or_else(|| "a finite number".into(), |row| row.allowed());
            Err(Problem::out_of_range(name, "not a finite number", allowed).within("parameters"))
        }
        None => Ok(()),
    }
}
