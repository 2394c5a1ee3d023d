//! What stands around what is grown on the command line: obstacles, and the space of a grammar.

use std::{
    io::Cursor,
    path::{Path, PathBuf},
};

use espalier_import::{Limits, Model, Triangles, read_model};
use espalier_proto::{
    Action, GrammarBody, Mesh, Obstacle, Pose, Position, Scale, Shape, UnitRotation,
    reading::from_json,
    version::{MAX_MESH_TRIANGLES, MAX_MESH_VERTICES, MAX_MODEL_TRIANGLES},
};

use super::{HeadlessError, read};

/// What a model may have, and what is kept of it (`LM6`).
const LIMITS: Limits = Limits {
    vertices: MAX_MESH_VERTICES,
    triangles: MAX_MESH_TRIANGLES,
    most_triangles: MAX_MODEL_TRIANGLES,
};

/// The space of a grammar in a file: the `within` of a `set_grammar`.
pub(super) fn body(path: &Path) -> Result<GrammarBody, HeadlessError> {
    let text = text(path)?;
    from_json(&text).map_err(|problem| not_so(path, "space of a grammar", problem))
}

/// Places what a file has: obstacles as `place_obstacle` takes them, one a line, or a model whose units are metres.
pub(super) fn obstacles(path: &Path, metres: f32) -> Result<Vec<Action>, HeadlessError> {
    let is_list = path.extension().is_some_and(|ending| ending == "json" || ending == "jsonl");
    let no_obstacle = |cause: &dyn ToString| not_so(path, "obstacle", cause.to_string());
    if is_list {
        let text = text(path)?;
        // A file may be one obstacle over several lines.
        if let Ok(obstacle) = from_json::<Obstacle>(&text) {
            return Ok(vec![Action::PlaceObstacle { obstacle }]);
        }
        let lines = (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty());
        let placed = lines.map(|(number, line)| {
            let obstacle =
                from_json(line).map_err(|problem| no_obstacle(&format!("line {number}: {problem}")))?;
            Ok(Action::PlaceObstacle { obstacle })
        });
        return placed.collect();
    }
    let bytes = read(path).map_err(|cause| HeadlessError::Read { path: path.to_owned(), cause })?;
    let Model { triangles, .. } =
        read_model(&mut Cursor::new(bytes), &LIMITS).map_err(|error| no_obstacle(&error))?;
    let Triangles { vertices, corners } = triangles;
    let scale = Scale::try_from(1.0 / metres).map_err(|fault| no_obstacle(&fault.found))?;
    let shape = Shape::Mesh { mesh: Mesh { vertices, triangles: corners }, scale };
    let pose = Pose { position: Position::ORIGIN, rotation: UnitRotation::IDENTITY };
    Ok(vec![Action::PlaceObstacle { obstacle: Obstacle { shape, pose } }])
}

fn text(path: &Path) -> Result<String, HeadlessError> {
    let bytes = read(path).map_err(|cause| HeadlessError::Read { path: path.to_owned(), cause })?;
    Ok(String::from_utf8_lossy(&bytes).trim_start_matches('\u{feff}').to_owned())
}

fn not_so(path: &Path, what: &'static str, cause: impl ToString) -> HeadlessError {
    HeadlessError::Surroundings { path: PathBuf::from(path), what, cause: cause.to_string() }
}
