//! How many bytes each section unpacks to at most: what the limits of the protocol leave room for (`LM4`, `LM6`,
//! `LM11`), times what it takes.

use espalier_plant::organs::MOST_ORGANS;
use espalier_proto::version::{MAX_BEND_TOUCHES, MAX_OBSTACLES};

use crate::{
    author::MAX_AUTHORS,
    document::{bending, designing, futures, grammars, history::MAX_SETS, obstacles, strokes, widths},
};

/// The largest metamer budget that a session can begin with (`LM4`).
pub const MAX_METAMER_BUDGET: u32 = 4_000_000;

const METAMERS: u64 = MAX_METAMER_BUDGET as u64;
/// Axes to a metamer: a node bears up to four lateral buds, and a seed brings the axis of its plant.
const AXES: u64 = 5;
/// No limit counts operations; nobody does so many.
const OPERATIONS: u64 = 2_000_000;
/// A name, or the key of a client, with its length.
const TEXT: u64 = 4 + 64;
/// An operation: kind, author, gesture, steps, places, setting.
const OPERATION: u64 = 1 + TEXT + 5 + 12 + 12;
/// A set of parameters, or looks, as JSON with its length.
const SET: u64 = 4000;
/// A set of obstacles: of each id, pose, shape.
const OBSTACLES_OF_SET: u64 = 4 + MAX_OBSTACLES as u64 * (4 + 28 + 13);
/// A triangle and its corners.
const TRIANGLE: u64 = 48;
/// A place of the brush, or of a path.
const PLACE: u64 = 16;
/// Places that are remembered of the brush of a stroke, and ahead of it.
const STROKE: u64 = 2048 * PLACE;

/// The numbers of lists, and what else there is one of.
const FEW: u64 = 4096;
/// The end of a step.
const STEP: u64 = 16;
/// What is noted where an axis is shed, and where a metamer is cut and scarred.
const SHED: u64 = 5;
const CUT: u64 = 5 + 9;
/// Wood that was moved: a metamer with its node and normal, and its axes with their directions.
const MOVED: u64 = 28 + AXES * 16;
/// An edit of one operation beside the wood it is about.
const EDIT: u64 = 48;
/// A row and a value of 4 bytes.
const PAIR: u64 = 8;
/// A row and its organs.
const ORGANS: u64 = 4 + 1 + 4 + 4 * MOST_ORGANS as u64;

/// Parent, axis, death, node and normal of metamers; bearer, direction and death of axes.
const fn rows(metamers: u64, axes: u64) -> u64 {
    36 * metamers + 20 * axes
}

/// Edits of wood of which so many metamers are there, and the steps in which it grew.
const TIME: u64 = METAMERS * (STEP + CUT + PAIR + ORGANS + AXES * SHED) + futures::MAX_PLACES * MOVED;

pub(super) const PLANT: u64 = FEW + rows(METAMERS, AXES * METAMERS);
pub(super) const TIMELINE: u64 = FEW + TIME + OPERATIONS * (STEP + EDIT);
pub(super) const WIDTHS: u64 = FEW + widths::MAX_WIDTHS as u64 * PAIR;
pub(super) const GIVEN_RADII: u64 = FEW + METAMERS * PAIR;
pub(super) const GIVEN_ORGANS: u64 = FEW + METAMERS * ORGANS;
/// A marker of the brush to each metamer.
pub(super) const GROWTH: u64 = FEW + SET + METAMERS * 17 + strokes::MAX_OPEN as u64 * STROKE;
pub(super) const SWEEPS: u64 = FEW + strokes::MAX_OPEN as u64 * STROKE;
pub(super) const PARAMETERS: u64 = FEW + MAX_SETS as u64 * SET;
/// A programme has many stages, each of which sets few parameters; and ages follow.
pub(super) const PROGRAMMES: u64 = PARAMETERS + OPERATIONS * 12;
/// Names and rows, answers, texts, and which of them each state has.
pub(super) const GRAMMARS: u64 =
    FEW + OPERATIONS * 5 + (grammars::MAX_HELD as u64 + METAMERS) * 12 + grammars::MAX_HELD_TEXT as u64;
pub(super) const LOOKS: u64 = PARAMETERS;
pub(super) const OBSTACLES: u64 =
    FEW + obstacles::MAX_HELD_TRIANGLES as u64 * TRIANGLE + MAX_SETS as u64 * OBSTACLES_OF_SET;
pub(super) const HISTORY: u64 = FEW + OPERATIONS * OPERATION;
pub(super) const DESIGNS: u64 = FEW + 2 * designing::MAX_HELD_BYTES as u64 + OPERATIONS * 8;
/// Which of them are in which set, and which set each operation has.
pub(super) const LET_GO: u64 = DESIGNS + OPERATIONS * (4 + 4 * designing::MOST_LET_GO as u64);
/// Beside rows as of the plant a future has lateral axes, branching orders, and what dies in it.
pub(super) const FUTURES: u64 = HISTORY
    + TIME
    + rows(futures::MAX_METAMERS as u64, AXES * futures::MAX_METAMERS as u64)
    + futures::MAX_METAMERS as u64 * (4 + PAIR + AXES * (4 + PAIR));
/// Of a bend the path, radii, the solver's prisms, and touches with their targets.
pub(super) const GESTURES: u64 = FEW
    + strokes::MAX_OPEN as u64 * (2 * TEXT)
    + bending::MAX_OPEN as u64
        * (2 * TEXT + bending::MAX_PATH as u64 * (4 + 12 + 4 + 56 + 12) + MAX_BEND_TOUCHES as u64 * 32);
pub(super) const WRITER: u64 = 4;
pub(super) const SESSION: u64 = FEW + MAX_AUTHORS as u64 * (TEXT + 12);

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use espalier_growth::DEFAULT_METAMER_BUDGET;
    use espalier_settings::{Appearance, Kind, ParameterValues};

    use super::{
        super::{fields::Writer, sections, settings, wood},
        *,
    };
    use crate::document::tests::tree;

    #[test]
    fn the_limits_are_those_of_the_settings() {
        let buds = ParameterValues::ROWS.iter().find(|row| row.name == "buds_per_node");
        let Some(Kind::Number { most, .. }) = buds.map(|row| row.kind) else { panic!("buds are counted") };
        assert_eq!(AXES, most as u64 + 1);
        const { assert!(DEFAULT_METAMER_BUDGET <= MAX_METAMER_BUDGET) };
    }

    #[test]
    fn rows_take_what_is_counted_for_them() {
        let parts = tree().plant().to_parts();
        let mut out = Writer::default();
        wood::write_columns(&mut out, &parts);
        let counted = rows(parts.parent.len() as u64, parts.bearer.len() as u64);
        assert_eq!(out.into_bytes().len() as u64, counted + 8 * 4);
        assert!(parts.bearer.len() as u64 <= AXES * parts.parent.len() as u64);
    }

    #[test]
    fn sets_of_settings_are_shorter_than_what_is_counted_for_them() {
        let longest = |text: String| {
            // Each number as long as an `f32` can be.
            let numbers = text.matches(|c: char| c.is_ascii_digit()).count();
            (text.len() + 12 * numbers) as u64
        };
        let json = |write: &dyn Fn(&mut Writer)| {
            let mut out = Writer::default();
            write(&mut out);
            String::from_utf8_lossy(&out.into_bytes()).into_owned()
        };
        assert!(longest(json(&|out| settings::write_json(out, &ParameterValues::default()))) < SET);
        assert!(longest(json(&|out| settings::write_json(out, &Appearance::default()))) < SET);
    }

    /// After a deliberate change: `UPDATE_GOLDEN=1 cargo test -p espalier-session document_page`.
    #[test]
    fn the_document_page_says_how_long_sections_can_be() {
        const BEGIN: &str = "<!-- lengths -->\n";
        const END: &str = "<!-- /lengths -->\n";
        let page = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/document.md");
        let found = std::fs::read_to_string(&page).unwrap();
        let (before, rest) = found.split_once(BEGIN).unwrap();
        let (_, after) = rest.split_once(END).unwrap();
        let mut table = "| section | bytes at most |\n|---|---|\n".to_owned();
        for kind in sections::RELEASED {
            writeln!(table, "| `{}` {} | {} |", kind.tag.escape_ascii(), kind.name, kind.most).unwrap();
        }
        let wanted = format!("{before}{BEGIN}{table}{END}{after}");
        if std::env::var_os("UPDATE_GOLDEN").is_some() {
            std::fs::write(&page, &wanted).unwrap();
        }
        let found = std::fs::read_to_string(&page).unwrap();
        assert!(found == wanted, "docs/document.md is out of date: run this test with UPDATE_GOLDEN=1");
    }
}
