//! Obstacles: what they keep out, and what one gesture does to them (`OB2`).

use espalier_proto::{
    Mesh, Obstacle, OperationKind, PlacedShape, Pose, ProblemCode, Scale, Shape, SimpleShape, SphereRadius,
};
use proptest::prelude::*;

use super::{
    histories::{Event, Form, events, form, happen},
    *,
};

/// The gesture of the hand that is tried; no event has it.
const HAND: Option<u32> = Some(70);

pub(super) fn pose(x: f32) -> Pose {
    Pose {
        position: Position::nearest(Vec3::new(x, 3.0, 0.0)),
        rotation: UnitRotation::nearest(Quat::from_rotation_y(x)),
    }
}

pub(super) fn place(shape: &Shape, x: f32) -> Command {
    place_in(None, shape, x)
}

pub(super) fn place_in(gesture: Option<u32>, shape: &Shape, x: f32) -> Command {
    let obstacle = Obstacle { shape: shape.clone(), pose: pose(x) };
    in_gesture(gesture, Action::PlaceObstacle { obstacle })
}

#[test]
fn no_seed_is_planted_in_an_obstacle() {
    let mut document = Document::new(4);
    let ball = place(&sphere(4.0), 20.0);
    document.apply(&who("ann"), &ball).expect("there is room");
    let before = document.hash();
    let plant = |x: f32| plain(Action::PlantSeed { position: Position::nearest(Vec3::X * x) });
    let problem =
        document.apply(&who("ann"), &plant(20.0)).expect_err("the ball reaches below the ground there");
    assert_eq!((problem.code, problem.field.as_deref()), (ProblemCode::OutOfRange, Some("position")));
    assert!(problem.message.contains("obstacle"), "{}", problem.message);
    assert_eq!(document.hash(), before);
    document.apply(&who("ann"), &plant(26.0)).expect("beside it the ground is free");
}

#[test]
fn a_moved_mesh_is_not_made_again() {
    let mut document = Document::new(4);
    let made =
        |document: &Document, index: usize| match &document.simulation.scene().obstacles()[index].shape() {
            espalier_growth::Shape::Mesh { mesh, .. } => Arc::clone(mesh),
            other => panic!("{other:?}"),
        };
    document.apply(&who("ann"), &place(&slab(), 8.0)).expect("there is room");
    document.apply(&who("ann"), &place(&slab(), -8.0)).expect("there is room");
    let before = [made(&document, 0), made(&document, 1)];
    document
        .apply(&who("ann"), &plain(Action::MoveObstacle { id: 1, pose: pose(5.0) }))
        .expect("it is there");
    document.apply(&who("ann"), &place(&sphere(1.0), 15.0)).expect("there is room");
    for (index, before) in before.iter().enumerate() {
        assert!(Arc::ptr_eq(before, &made(&document, index)), "{index}");
    }
}

fn ball() -> Shape {
    sphere(2.0)
}

pub(super) fn sphere(radius: f32) -> Shape {
    Shape::Sphere { radius: SphereRadius::nearest(radius) }
}

fn push(id: u32, x: f32, gesture: Option<u32>) -> Command {
    in_gesture(gesture, Action::MoveObstacle { id, pose: pose(x) })
}

pub(super) fn swell(id: u32, radius: f32, gesture: Option<u32>) -> Command {
    in_gesture(
        gesture,
        Action::ReshapeObstacle { id, shape: SimpleShape::try_from(sphere(radius)).expect("no mesh") },
    )
}

#[test]
fn ob2_a_mesh_keeps_its_shape() {
    let mut document = tree();
    apply(&mut document, &place(&slab(), 9.0));
    let before = document.hash();
    let problem = document.apply(&who("ann"), &swell(1, 2.0, None)).expect_err("it is a mesh");
    assert_eq!(problem.code, ProblemCode::Refused);
    let problem = document.apply(&who("ann"), &swell(2, 2.0, None)).expect_err("nothing is there");
    assert_eq!(problem.code, ProblemCode::NotFound);
    assert_eq!(document.hash(), before);
    let refused = SimpleShape::try_from(slab()).expect_err("nothing becomes a mesh");
    assert_eq!(refused.at, "kind");
}

#[test]
fn ob2_another_shape_and_place_by_one_gesture_are_one_undo() {
    let mut document = tree();
    apply(&mut document, &place(&ball(), 9.0));
    let before = form(&document);
    apply(&mut document, &swell(1, 3.0, Some(8)));
    apply(&mut document, &push(1, 12.0, Some(8)));
    apply(&mut document, &swell(1, 4.0, Some(8)));
    let after = form(&document);
    assert_eq!(document.obstacles()[0].shape, PlacedShape::Sphere { radius: 4.0 });
    assert_eq!(kinds(&document), [OperationKind::Growth, OperationKind::Obstacle, OperationKind::Obstacle]);
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!(form(&document), before);
    apply(&mut document, &plain(Action::Redo {}));
    assert_eq!(form(&document), after);
}

#[test]
fn ob2_what_comes_between_parts_a_gesture() {
    let mut document = tree();
    apply(&mut document, &place_in(Some(1), &ball(), 9.0));
    for (author, action) in [
        ("ann", push(1, 3.0, Some(2))),
        ("ann", push(1, 4.0, None)),
        ("ann", push(1, 5.0, None)),
        ("bob", push(1, 6.0, Some(2))),
        ("ann", push(1, 7.0, Some(2))),
        ("ann", in_gesture(Some(2), Action::Grow { steps: Steps::nearest(1), until: None, bud: None })),
        ("ann", push(1, 8.0, Some(2))),
    ] {
        let operations = document.timeline().operations.len();
        document.apply(&who(author), &action).expect("it can be done");
        assert_eq!(document.timeline().operations.len(), operations + 1, "{author}: {action:?}");
    }
    // The same number for something of another kind is another operation as well.
    let operations = document.timeline().operations.len();
    apply(&mut document, &patch_in(Some(2), 0.6));
    apply(&mut document, &push(1, 9.0, Some(2)));
    assert_eq!(document.timeline().operations.len(), operations + 2);
}

#[test]
fn ob2_a_thing_dragged_back_leaves_redo_as_it_was() {
    let mut document = tree();
    apply(&mut document, &place(&ball(), 9.0));
    grow(&mut document, 2, None);
    apply(&mut document, &plain(Action::Undo {}));
    let (before, timeline) = (document.hash(), document.timeline());
    apply(&mut document, &push(1, 4.0, HAND));
    assert_eq!(document.timeline().futures.len(), 1, "TT3: the growth undone is another future");
    apply(&mut document, &push(1, 9.0, HAND));
    assert_eq!((document.hash(), document.timeline()), (before, timeline));
    assert!(document.figures().can_redo);
    // So does one that swells and shrinks again.
    for radius in [3.0, 2.0] {
        apply(&mut document, &swell(1, radius, HAND));
    }
    assert!(document.figures().can_redo);
    // What was placed and taken away at once was never there; its number stays its own.
    apply(&mut document, &place_in(HAND, &ball(), 4.0));
    apply(&mut document, &in_gesture(HAND, Action::RemoveObstacle { id: 2 }));
    assert!(document.figures().can_redo);
    apply(&mut document, &place_in(HAND, &ball(), 4.0));
    assert_eq!(document.obstacles().last().map(|obstacle| obstacle.id), Some(3));
}

/// What a hand does to obstacles, first found by any number.
#[derive(Clone, Debug)]
enum Arrangement {
    Place(i32),
    Push(u32, i32),
    Swell(u32, u8),
    Clear(u32),
}

fn arrangements() -> impl Strategy<Value = Vec<Arrangement>> {
    let arrangement = prop_oneof![
        (-2i32..3).prop_map(Arrangement::Place),
        (any::<u32>(), -2i32..3).prop_map(|(any, x)| Arrangement::Push(any, x)),
        (any::<u32>(), 1u8..4).prop_map(|(any, radius)| Arrangement::Swell(any, radius)),
        any::<u32>().prop_map(Arrangement::Clear),
    ];
    prop::collection::vec(arrangement, 1..7)
}

fn arrange(document: &mut Document, arrangement: &Arrangement) {
    let standing = document.obstacles();
    let found = |any: u32| standing.get(any as usize % standing.len().max(1)).map_or(0, |one| one.id);
    let action = match *arrangement {
        Arrangement::Place(x) => place_in(HAND, &ball(), 3.0 * x as f32),
        Arrangement::Push(any, x) => push(found(any), 3.0 * x as f32, HAND),
        Arrangement::Swell(any, radius) => swell(found(any), f32::from(radius), HAND),
        Arrangement::Clear(any) => in_gesture(HAND, Action::RemoveObstacle { id: found(any) }),
    };
    // Where nothing stands there is nothing to move.
    let _ = document.apply(&who("ann"), &action);
}

fn check_gesture(seed: u32, earlier: &[Event], hand: &[Arrangement]) -> Result<(), TestCaseError> {
    let mut document = Document::new(seed);
    document.set_metamer_budget(2000);
    for (number, event) in earlier.iter().enumerate() {
        happen(&mut document, number, event);
    }
    let before: Form = form(&document);
    let (timeline, figures) = (document.timeline(), document.figures());
    for arrangement in hand {
        arrange(&mut document, arrangement);
    }
    let after = form(&document);
    if document.obstacles() == before.2 {
        prop_assert_eq!((&after, document.timeline()), (&before, timeline));
        prop_assert_eq!(document.figures(), figures);
        return Ok(());
    }
    prop_assert!(!document.figures().can_redo, "what lay ahead is another future");
    document.apply(&who("ann"), &plain(Action::Undo {})).expect("there is the gesture");
    prop_assert_eq!(&form(&document), &before);
    document.apply(&who("ann"), &plain(Action::Redo {})).expect("it was just undone");
    prop_assert_eq!(&form(&document), &after);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn ob2_one_undo_takes_a_whole_gesture_back(seed: u32, earlier in events(), hand in arrangements()) {
        check_gesture(seed, &earlier, &hand)?;
    }
}

/// A sheet of two triangles.
pub(super) fn slab() -> Shape {
    let corners = [[-3.0, -3.0, 0.0], [3.0, -3.0, 0.0], [3.0, 3.0, 0.5], [-3.0, 3.0, 0.5]];
    let mesh =
        Mesh { vertices: corners.map(Vec3::from_array).to_vec(), triangles: vec![[0, 1, 2], [0, 2, 3]] };
    Shape::Mesh { mesh, scale: Scale::nearest(1.5) }
}
