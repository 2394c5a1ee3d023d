//! Room in memory: asked for before anything grows, so that what finds none rests and nothing is lost (`LM19`).

use espalier_proto::{Action, Shape};

use crate::urgency::Urgency;

/// Says whether a document may come to hold so many rows, for work of this kind. Whoever says yes keeps room for them.
pub type HasRoom<'a> = &'a mut dyn FnMut(u64, Urgency) -> bool;

/// A triangle of an obstacle takes as much as this part of a row.
const TRIANGLES_OF_A_ROW: u64 = 3;
/// Bytes that a row takes,
const ROW: usize = 400;
/// and a name of a grammar with its row.
const NAME: usize = 16;
/// Rows that a step may add to few,
const LEAST_STEP: u64 = 1024;
/// and this part of many.
const STEP_SHARE: u64 = 8;

/// Rows and triangles that a document holds, as rows.
pub(crate) fn as_rows(rows: u64, triangles: u64) -> u64 {
    rows + triangles / TRIANGLES_OF_A_ROW
}

/// What grammars keep takes as much as so many rows: names with their rows, and bytes of words.
pub(crate) fn grammars_as_rows(names: usize, bytes: usize) -> u64 {
    ((names * NAME + bytes) / ROW) as u64
}

/// What a document of so many rows may hold after a step.
pub(crate) fn after_step(rows: u64) -> u64 {
    rows + rows / STEP_SHARE + LEAST_STEP
}

fn triangles_of(shape: &Shape) -> u64 {
    match shape {
        Shape::Mesh { mesh, .. } => mesh.triangles.len() as u64,
        _ => 0,
    }
}

/// Whether an action may change how many triangles there are.
pub(crate) fn changes_triangles(action: &Action) -> bool {
    matches!(action, Action::PlaceObstacle { .. } | Action::RemoveObstacle { .. })
}

/// What a document of so many rows may hold after an action was taken on, before its steps; nothing more where the action
/// adds nothing.
pub(crate) fn after_taking_on(action: &Action, rows: u64) -> u64 {
    match action {
        // A copy of any branch, or wood like that of any plant.
        Action::Graft { .. } | Action::FitDesign { .. } => 2 * rows + LEAST_STEP,
        // A step of derivation seldom adds more.
        Action::SetGrammar { .. }
        | Action::SetGrammarBody { .. }
        | Action::Derive { .. }
        | Action::SetGrammarValues { .. } => 4 * rows + LEAST_STEP,
        Action::PlaceObstacle { obstacle } => rows + as_rows(LEAST_STEP, triangles_of(&obstacle.shape)),
        _ => rows,
    }
}
