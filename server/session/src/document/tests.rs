//! The document's timeline: whatever is done can be undone, redone, written down and read again, bit for bit.

mod arranging;
mod damage;
mod deeds;
mod designing;
mod dyeing;
pub(super) mod forks;
mod generating;
mod grammars;
mod histories;
mod looks;
mod pins;
mod programmes;
mod refilling;
mod shaping;
mod strokes;
mod times;

use espalier_proto::{
    BrushRadius, Depth, Diameter, Direction, DrawingPlane, List, ProblemCode, Share, Steps, StrokeSample,
    Touches, UnitRotation,
};
use espalier_settings::{Kind, ParameterValues, ParametersPatch};
use glam::{Quat, Vec2, Vec3};

use super::*;

/// Somebody of this name.
fn who(name: &str) -> Principal {
    Principal::named(name)
}

fn plain(action: Action) -> Command {
    action.into()
}

/// Taking back what somebody did under a key, and under these others.
fn take_back_by(keys: &[&str]) -> Action {
    Action::TakeBack { keys: list(keys.iter().map(|&key| key.to_owned()).collect()) }
}

fn bring_back_by(keys: &[&str]) -> Action {
    Action::BringBack { keys: list(keys.iter().map(|&key| key.to_owned()).collect()) }
}

fn in_gesture(gesture: impl Into<Option<u32>>, action: Action) -> Command {
    Command { action, gesture: gesture.into() }
}

fn list<T: std::fmt::Debug, const LEAST: usize, const MOST: usize>(entries: Vec<T>) -> List<T, LEAST, MOST> {
    List::try_from(entries).expect("not too many")
}

fn held(rows: Vec<u32>) -> Touches {
    Touches::try_from(rows).expect("all different")
}

fn places<const LEAST: usize, const MOST: usize>(places: Vec<Vec3>) -> List<Position, LEAST, MOST> {
    list(places.into_iter().map(Position::nearest).collect())
}

fn sample(x: f32, y: f32, radius: f32) -> StrokeSample {
    StrokeSample { position: Position::nearest(Vec3::new(x, y, 0.0)), radius: BrushRadius::nearest(radius) }
}

/// A stroke from the ground up, with a crown.
fn stroke(document: &mut Document, number: u32) {
    let mut apply =
        |command: Command| document.apply(&who("ann"), &command).expect("the stroke is well formed");
    apply(plain(Action::StrokeBegin { stroke: number, bud: None }));
    apply(plain(Action::StrokeMove {
        stroke: number,
        samples: list(vec![sample(0.0, 0.0, 0.2), sample(1.0, 8.0, 0.2)]),
    }));
    apply(plain(Action::StrokeMove {
        stroke: number,
        samples: list(vec![sample(2.0, 13.0, 4.0), sample(-3.0, 15.0, 5.0)]),
    }));
    apply(plain(Action::StrokeEnd { stroke: number }));
}

fn grow(document: &mut Document, steps: u32, gesture: Option<u32>) {
    document
        .apply(
            &who("ann"),
            &in_gesture(gesture, Action::Grow { steps: Steps::nearest(steps), until: None, bud: None }),
        )
        .expect("there is room to grow");
}

fn patch(apical_control: f32) -> Command {
    patch_in(None, apical_control)
}

fn patch_in(gesture: Option<u32>, apical_control: f32) -> Command {
    let patch = ParametersPatch { apical_control: Some(apical_control), ..ParametersPatch::default() };
    in_gesture(gesture, Action::SetParameters { parameters: patch })
}

/// A tree with a few branches.
pub(super) fn tree() -> Document {
    let mut document = Document::new(5);
    document
        .apply(&who("ann"), &plain(Action::Grow { steps: Steps::nearest(9), until: None, bud: None }))
        .expect("there is room");
    document
}

fn apply(document: &mut Document, action: &Command) {
    document.apply(&who("ann"), action).unwrap_or_else(|problem| panic!("{action:?}: {problem}"));
}

/// The problem an action is refused with; nothing changes.
fn problem(document: &mut Document, action: &Command) -> Problem {
    let before = document.hash();
    let problem = document.apply(&who("ann"), action).expect_err("it is refused");
    assert_eq!(document.hash(), before, "{action:?} is refused and changes something");
    assert!(problem.field.is_some() && problem.allowed.is_some(), "{action:?} names too little: {problem:?}");
    problem
}

fn refusal(document: &mut Document, action: &Command) -> (ProblemCode, String) {
    let problem = problem(document, action);
    assert!(!problem.message.is_empty());
    (problem.code, problem.field.unwrap_or_default())
}

/// The way down from the youngest living metamer that stands this far from its trunk's foot, or farther.
fn long_path(document: &Document, length: usize) -> Vec<MetamerId> {
    let plant = document.plant();
    let down = |id: MetamerId| {
        let below = std::iter::successors(Some(id), |&id| plant.metamers().parent(id));
        below.take_while(|&id| !plant.is_seed(id)).collect::<Vec<_>>()
    };
    let rows = (0..plant.metamer_count()).rev().map(MetamerId::new);
    let living = rows.filter(|&id| plant.is_alive(id) && !plant.is_seed(id));
    living.map(down).find(|path| path.len() >= length).expect("the tree is tall enough")
}

/// The first metamers of lateral branches.
fn laterals(document: &Document) -> Vec<MetamerId> {
    let plant = document.plant();
    let metamers = plant.metamers();
    let rows = (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id));
    rows.filter(|&id| {
        let parent = metamers.parent(id).filter(|&parent| !plant.is_seed(parent));
        parent.is_some_and(|parent| metamers.axis(parent) != metamers.axis(id))
    })
    .collect()
}

fn kinds(document: &Document) -> Vec<espalier_proto::OperationKind> {
    document.timeline().operations.iter().map(|operation| operation.kind).collect()
}

#[test]
fn undo_takes_back_whole_operations() {
    let mut document = Document::new(4);
    let seedling = document.plant().hash();
    stroke(&mut document, 1);
    let after_stroke = document.plant().hash();
    grow(&mut document, 3, None);
    document.apply(&who("ann"), &plain(Action::Undo {})).expect("there is growth to undo");
    assert_eq!(document.plant().hash(), after_stroke);
    document.apply(&who("ann"), &plain(Action::Undo {})).expect("there is a stroke to undo");
    assert_eq!(document.plant().hash(), seedling);
    let problem = document.apply(&who("ann"), &plain(Action::Undo {})).expect_err("nothing is left");
    assert_eq!(problem.code, ProblemCode::Refused);
}

#[test]
fn redo_restores_what_undo_took() {
    let mut document = Document::new(4);
    stroke(&mut document, 1);
    document.apply(&who("ann"), &patch(0.55)).expect("0.55 is in range");
    grow(&mut document, 3, None);
    let (hash, parameters) = (document.plant().hash(), document.parameters());
    for _ in 0..3 {
        document.apply(&who("ann"), &plain(Action::Undo {})).expect("three operations were done");
    }
    assert_eq!(document.parameters().apical_control, Document::new(4).parameters().apical_control);
    for _ in 0..3 {
        document.apply(&who("ann"), &plain(Action::Redo {})).expect("three operations were undone");
    }
    assert_eq!((document.plant().hash(), document.parameters()), (hash, parameters));
    assert!(document.apply(&who("ann"), &plain(Action::Redo {})).is_err());
}

#[test]
fn cm7_ungrow_goes_back_through_a_stroke_and_redo_returns() {
    let mut document = Document::new(4);
    stroke(&mut document, 1);
    let (step, hash) = (document.plant().step(), document.plant().hash());
    document
        .apply(&who("ann"), &plain(Action::Ungrow { steps: Steps::nearest(2) }))
        .expect("there are steps");
    assert_eq!(document.plant().step(), step - 2);
    document.apply(&who("ann"), &plain(Action::Redo {})).expect("the stroke was left in part");
    assert_eq!(document.plant().hash(), hash);
    document
        .apply(&who("ann"), &plain(Action::Ungrow { steps: Steps::nearest(1000) }))
        .expect("there are steps");
    assert_eq!(document.plant().step(), 0);
    assert!(document.apply(&who("ann"), &plain(Action::Ungrow { steps: Steps::nearest(1) })).is_err());
}

#[test]
fn growth_of_one_gesture_is_one_operation() {
    let mut document = Document::new(4);
    for _ in 0..4 {
        grow(&mut document, 1, Some(7));
    }
    grow(&mut document, 1, Some(8));
    document.apply(&who("ann"), &plain(Action::Undo {})).expect("one");
    assert_eq!(document.plant().step(), 4);
    document.apply(&who("ann"), &plain(Action::Undo {})).expect("two");
    assert_eq!(document.plant().step(), 0);
}

#[test]
fn every_step_back_shows() {
    let mut document = Document::new(4);
    let pencil = |x, y| plain(Action::StrokeMove { stroke: 1, samples: list(vec![sample(x, y, 0.0)]) });
    document.apply(&who("ann"), &plain(Action::StrokeBegin { stroke: 1, bud: None })).expect("new");
    document.apply(&who("ann"), &pencil(0.0, 0.0)).expect("open");
    document.apply(&who("ann"), &pencil(0.0, 20.0)).expect("open");
    for _ in 0..30 {
        // The finger rests: nothing is left to draw.
        document.apply(&who("ann"), &pencil(0.0, 20.0)).expect("open");
    }
    document.apply(&who("ann"), &plain(Action::StrokeEnd { stroke: 1 })).expect("open");
    while document.plant().step() > 0 {
        let before = document.metamers();
        document
            .apply(&who("ann"), &plain(Action::Ungrow { steps: Steps::nearest(1) }))
            .expect("there is a step");
        assert!(document.metamers() < before, "step {} shows nothing", document.plant().step());
    }
}

#[test]
fn a_stroke_that_grows_nothing_is_no_operation() {
    let mut document = Document::new(4);
    document.apply(&who("ann"), &plain(Action::StrokeBegin { stroke: 1, bud: None })).expect("new");
    document
        .apply(
            &who("ann"),
            &plain(Action::StrokeMove { stroke: 1, samples: list(vec![sample(500.0, 500.0, 3.0)]) }),
        )
        .expect("open");
    document.apply(&who("ann"), &plain(Action::StrokeEnd { stroke: 1 })).expect("open");
    assert!(!document.figures().can_undo);
}

#[test]
fn what_comes_to_nothing_leaves_redo_as_it_was() {
    let mut document = Document::new(4);
    stroke(&mut document, 1);
    grow(&mut document, 4, None);
    let grown = document.plant().hash();
    for back in [plain(Action::Undo {}), plain(Action::Ungrow { steps: Steps::nearest(2) })] {
        document.apply(&who("ann"), &back).expect("there is growth to take back");
        let (hash, timeline) = (document.hash(), document.timeline());
        let far = vec![sample(300.0, 300.0, 0.1)];
        for command in [
            plain(Action::StrokeBegin { stroke: 2, bud: None }),
            plain(Action::StrokeMove { stroke: 2, samples: list(far) }),
            plain(Action::StrokeEnd { stroke: 2 }),
        ] {
            document = Document::from_bytes(&document.to_bytes()).expect("its own bytes");
            document.apply(&who("ann"), &command).expect("the stroke is well formed");
        }
        assert_eq!(document.timeline(), timeline, "nothing grew, so nothing lay ahead in vain");
        assert_ne!(document.hash(), hash, "strokes are counted, for they key their randomness");
        document.apply(&who("ann"), &plain(Action::Redo {})).expect("what was undone is still ahead");
        assert_eq!(document.plant().hash(), grown);
    }
}

#[test]
fn parameters_as_they_are_keep_redo() {
    let mut document = Document::new(4);
    grow(&mut document, 3, None);
    document
        .apply(&who("ann"), &plain(Action::Ungrow { steps: Steps::nearest(1) }))
        .expect("there are steps");
    document.apply(&who("ann"), &patch(document.parameters().apical_control)).expect("no change");
    document
        .apply(&who("ann"), &plain(Action::SetParameters { parameters: ParametersPatch::default() }))
        .expect("no change");
    document.apply(&who("ann"), &plain(Action::Redo {})).expect("nothing was done since");
}

#[test]
fn lifted_brushes_leave_operations_apart() {
    let mut document = Document::new(4);
    document.apply(&who("ann"), &plain(Action::StrokeBegin { stroke: 1, bud: None })).expect("new");
    let samples = vec![sample(0.0, 0.0, 0.0), sample(0.0, 9.0, 0.0)];
    document
        .apply(&who("ann"), &plain(Action::StrokeMove { stroke: 1, samples: list(samples) }))
        .expect("open");
    document.end_gestures();
    let step = document.plant().step();
    grow(&mut document, 2, None);
    document.apply(&who("bob"), &plain(Action::Undo {})).expect("growth is an operation of its own");
    assert_eq!(document.plant().step(), step);
}

#[test]
fn lm4_seeds_count_against_the_budget() {
    let mut document = Document::new(4);
    document.set_metamer_budget(2);
    document
        .apply(&who("ann"), &plain(Action::PlantSeed { position: Position::nearest(Vec3::X) }))
        .expect("one more fits");
    assert!(
        document
            .apply(&who("ann"), &plain(Action::PlantSeed { position: Position::nearest(Vec3::Z) }))
            .is_err()
    );
}

#[test]
fn cm5_overlapping_strokes_are_one_operation() {
    let mut document = Document::new(4);
    let mut apply =
        |author: &str, command: Command| document.apply(&who(author), &command).expect("well formed");
    apply("ann", plain(Action::StrokeBegin { stroke: 1, bud: None }));
    apply("bob", plain(Action::StrokeBegin { stroke: 1, bud: None }));
    apply(
        "ann",
        plain(Action::StrokeMove {
            stroke: 1,
            samples: list(vec![sample(0.0, 0.0, 0.0), sample(0.0, 9.0, 0.0)]),
        }),
    );
    apply(
        "bob",
        plain(Action::StrokeMove {
            stroke: 1,
            samples: list(vec![sample(0.0, 4.0, 0.0), sample(6.0, 7.0, 0.0)]),
        }),
    );
    apply("ann", plain(Action::StrokeEnd { stroke: 1 }));
    apply("bob", plain(Action::StrokeEnd { stroke: 1 }));
    apply("bob", plain(Action::Undo {}));
    assert_eq!(document.plant().step(), 0);
}

#[test]
fn unknown_strokes_and_bad_seeds_are_refused() {
    let mut document = Document::new(4);
    let problem =
        document.apply(&who("ann"), &plain(Action::StrokeEnd { stroke: 3 })).expect_err("never begun");
    assert_eq!((problem.code, problem.field.as_deref()), (ProblemCode::NotFound, Some("stroke")));
    document.apply(&who("ann"), &plain(Action::StrokeBegin { stroke: 3, bud: None })).expect("new");
    assert!(
        document.apply(&who("ann"), &plain(Action::StrokeBegin { stroke: 3, bud: None })).is_err(),
        "begun twice"
    );
    assert!(
        document.apply(&who("bob"), &plain(Action::StrokeEnd { stroke: 3 })).is_err(),
        "another's stroke"
    );
    assert!(
        document
            .apply(&who("ann"), &plain(Action::PlantSeed { position: Position::nearest(Vec3::Y) }))
            .is_err()
    );
}

#[test]
fn every_parameter_refuses_beyond_its_ends() {
    let defaults = serde_json::to_value(Document::new(1).parameters()).expect("plain values");
    for row in ParameterValues::ROWS {
        let Kind::Number { least: low, most: high, .. } = row.kind else { continue };
        let name = row.name;
        for value in [f64::from(low) - 1.0, f64::from(high) + 1.0] {
            // A whole number below zero has no form in an unsigned field; the wire refuses it before this.
            if defaults[name].is_u64() && value < 0.0 {
                continue;
            }
            let json = if defaults[name].is_u64() {
                format!("{{\"{name}\":{}}}", value as u64)
            } else {
                format!("{{\"{name}\":{value}}}")
            };
            let patch: ParametersPatch = serde_json::from_str(&json).expect("a patch");
            let mut document = Document::new(1);
            let before = document.hash();
            let problem = document
                .apply(&who("ann"), &plain(Action::SetParameters { parameters: patch }))
                .expect_err(&json);
            assert_eq!(problem.field, Some(format!("parameters.{name}")));
            assert!(problem.allowed.is_some());
            assert_eq!(document.hash(), before, "{name} changed something");
        }
    }
}

#[test]
fn growth_beyond_the_budget_is_refused() {
    let mut document = Document::new(4);
    document.set_metamer_budget(300);
    grow(&mut document, 1000, None);
    assert_eq!(document.pending_steps(), 0);
    assert_eq!(document.plant().metamer_count(), 300);
    let problem = document
        .apply(&who("ann"), &plain(Action::Grow { steps: Steps::nearest(1), until: None, bud: None }))
        .expect_err("full");
    assert!(problem.message.contains("300"));
}

fn lasso(width: f32, height: f32) -> Command {
    let outline = [[-width, 0.0], [width, 0.0], [width, height], [-width, height]];
    let outline = outline.map(|point| Vec2::from_array(point).try_into().expect("within the world"));
    let direction = |axis: Vec3| Direction::try_from(axis).expect("of length 1");
    let plane = DrawingPlane::new(Position::ORIGIN, direction(Vec3::X), direction(Vec3::Y));
    let plane = plane.expect("they are perpendicular");
    plain(Action::Lasso { outline: list(outline.to_vec()), plane, depth: Depth::MOST, bud: None })
}
