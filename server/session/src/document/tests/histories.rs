//! Random histories: back to the seedling, forth to the tree, written down and read again, bit for bit.

use espalier_plant::checks;
use proptest::prelude::*;

use super::{
    arranging::{place_in, pose, slab, sphere, swell},
    designing, programmes, *,
};

/// Something that happens. Rows are any numbers, from which a living metamer is found.
#[derive(Clone, Debug)]
pub(super) enum Event {
    Stroke,
    Grow(u32),
    Ungrow(u32),
    Undo,
    Redo,
    Apical(f32, Option<u32>),
    Season(u32, Option<u32>),
    Shedding(f32),
    Seed(f32),
    Begin(u32),
    Move(u32, f32, f32, f32),
    End(u32),
    Lasso(f32, f32),
    Choose(u32),
    Ball(f32, f32, Option<u32>),
    Mesh(f32, Option<u32>),
    Push(u32, f32, Option<u32>),
    Swell(u32, f32, Option<u32>),
    Clear(u32, Option<u32>),
    Hold {
        bend: u32,
        end: u32,
        length: u32,
        touches: u32,
        stretch: f32,
    },
    Drag {
        bend: u32,
        shift: [f32; 3],
    },
    LetGo(u32),
    /// A whole bend.
    Bend {
        end: u32,
        length: u32,
        stretch: f32,
        shift: [f32; 3],
    },
    GiveUp(u32),
    Width(u32, Option<f32>, Option<u32>),
    Prune(Vec<u32>, Option<u32>),
    PruneDim(f32),
    Turn(u32, f32, Option<u32>),
    Graft(u32, u32, f32, bool),
    GoTo(u32),
    Take(u32),
    GrowOn(u32, u32),
    /// One of a few programmes, or none.
    Programme(u32, bool, Option<u32>),
    Follow(Option<u32>),
    /// A small design at a place.
    Design(f32),
    /// Something is said of one of its branches.
    Say(u32, f32, Option<u32>),
    /// The design is let go.
    Release,
}

pub(super) fn events() -> impl Strategy<Value = Vec<Event>> {
    let gesture = || prop::option::of(0u32..2);
    let event = prop_oneof![
        2 => Just(Event::Stroke),
        6 => (1u32..5).prop_map(Event::Grow),
        2 => (1u32..9).prop_map(Event::Ungrow),
        3 => Just(Event::Undo),
        2 => Just(Event::Redo),
        2 => (0.4f32..0.7, gesture()).prop_map(|(apical, gesture)| Event::Apical(apical, gesture)),
        3 => (0u32..4, gesture()).prop_map(|(season, gesture)| Event::Season(season, gesture)),
        1 => (0f32..0.5).prop_map(Event::Shedding),
        1 => (-20f32..20.0).prop_map(Event::Seed),
        1 => (90u32..92).prop_map(Event::Begin),
        2 => (90u32..92, -6f32..6.0, 0f32..14.0, 0f32..4.0).prop_map(|(n, x, y, r)| Event::Move(n, x, y, r)),
        1 => (90u32..92).prop_map(Event::End),
        1 => (0.5f32..6.0, 1f32..14.0).prop_map(|(w, h)| Event::Lasso(w, h)),
        1 => (0u32..200).prop_map(Event::Choose),
        2 => (-9f32..9.0, 1f32..5.0, gesture()).prop_map(|(x, r, g)| Event::Ball(x, r, g)),
        1 => (-9f32..9.0, gesture()).prop_map(|(x, g)| Event::Mesh(x, g)),
        // Few places, so that things also come back to where they were.
        3 => (1u32..4, -2i32..3, gesture()).prop_map(|(id, x, g)| Event::Push(id, 3.0 * x as f32, g)),
        2 => (1u32..4, 1u8..4, gesture()).prop_map(|(id, radius, g)| Event::Swell(id, radius.into(), g)),
        2 => (1u32..4, gesture()).prop_map(|(id, g)| Event::Clear(id, g)),
        4 => (0u32..2, any::<u32>(), 1u32..9, 1u32..4, 0f32..1.0)
            .prop_map(|(bend, end, length, touches, stretch)| Event::Hold { bend, end, length, touches, stretch }),
        2 => (0u32..2, prop::array::uniform3(-3f32..3.0)).prop_map(|(bend, shift)| Event::Drag { bend, shift }),
        4 => (any::<u32>(), 1u32..9, 0f32..1.0, prop::array::uniform3(-3f32..3.0))
            .prop_map(|(end, length, stretch, shift)| Event::Bend { end, length, stretch, shift }),
        2 => (0u32..2).prop_map(Event::LetGo),
        1 => (0u32..2).prop_map(Event::GiveUp),
        4 => (any::<u32>(), prop::option::weighted(0.8, 0.05f32..2.0), gesture())
            .prop_map(|(row, diameter, gesture)| Event::Width(row % 5, diameter, gesture)),
        3 => (prop::collection::vec(any::<u32>(), 1..4), gesture()).prop_map(|(rows, g)| Event::Prune(rows, g)),
        1 => (0f32..1.0).prop_map(Event::PruneDim),
        4 => (any::<u32>(), -3f32..3.0, gesture()).prop_map(|(row, angle, g)| Event::Turn(row, angle, g)),
        3 => (any::<u32>(), any::<u32>(), -3f32..3.0, any::<bool>())
            .prop_map(|(row, onto, angle, keep)| Event::Graft(row, onto, angle, keep)),
        4 => any::<u32>().prop_map(Event::GoTo),
        4 => any::<u32>().prop_map(Event::Take),
        2 => (1u32..4, 0u32..2).prop_map(|(steps, gesture)| Event::GrowOn(steps, gesture)),
        4 => (0u32..4, any::<bool>(), gesture()).prop_map(|(which, keep, g)| Event::Programme(which, keep, g)),
        1 => gesture().prop_map(Event::Follow),
        2 => (-9f32..9.0).prop_map(Event::Design),
        8 => (0u32..7, 0f32..1.0, gesture()).prop_map(|(what, value, g)| Event::Say(what, value, g)),
        1 => Just(Event::Release),
    ];
    prop::collection::vec(event, 1..40)
}

/// A living metamer found from any number; its row, or one that is not there if nothing lives.
fn row(document: &Document, any: u32) -> u32 {
    let plant = document.plant();
    let count = plant.metamer_count();
    let rows = (0..count).map(|index| (index + any as usize) % count).map(MetamerId::new);
    let mut living = rows.filter(|&id| plant.is_alive(id) && !plant.is_seed(id));
    living.next().map_or(u32::MAX, MetamerId::raw)
}

fn hold(document: &Document, bend: u32, end: u32, length: u32, touches: u32, stretch: f32) -> Command {
    let plant = document.plant();
    let end = row(document, end);
    let mut path = vec![end];
    while path.len() <= length as usize {
        let below = path.last().filter(|&&id| id < u32::MAX).map(|&id| MetamerId::new(id as usize));
        let Some(parent) = below.and_then(|id| plant.metamers().parent(id)) else { break };
        path.push(parent.raw());
    }
    let base = path[path.len() - 1];
    let touches = path.iter().step_by(2).take(touches as usize).copied().collect();
    in_gesture(
        Some(bend % 2),
        Action::BendBegin { bend, base, touches: held(touches), stretch: Share::nearest(stretch) },
    )
}

fn drag(document: &Document, bend: u32, shift: [f32; 3]) -> Command {
    let open = document.bends.open.iter().find(|open| open.number == bend);
    let wanted = |open: &bending::OpenBend| {
        let ends = open.touches.iter().map(|&touch| document.plant().metamers().end(open.path[touch]));
        ends.map(|end| end + Vec3::from_array(shift)).collect()
    };
    plain(Action::BendMove { bend, targets: places(open.map_or_else(|| vec![Vec3::ONE], wanted)) })
}

pub(super) fn happen(document: &mut Document, number: usize, event: &Event) {
    let turned = |angle: f32| Quat::from_xyzw(0.0, libm::sinf(angle), 0.0, libm::cosf(angle)).normalize();
    let found = |any: &u32| row(document, *any);
    let action = match event {
        Event::Bend { end, length, stretch, shift } => {
            let bend = 7;
            for event in [
                Event::Hold { bend, end: *end, length: *length, touches: 2, stretch: *stretch },
                Event::Drag { bend, shift: shift.map(|c| 0.5 * c) },
                Event::Drag { bend, shift: *shift },
                Event::LetGo(bend),
            ] {
                happen(document, number, &event);
            }
            return;
        }
        Event::Stroke => return stroke(document, 1000 + number as u32),
        Event::Grow(steps) => plain(Action::Grow { steps: Steps::nearest(*steps), until: None, bud: None }),
        Event::GrowOn(steps, gesture) => {
            in_gesture(Some(*gesture), Action::Grow { steps: Steps::nearest(*steps), until: None, bud: None })
        }
        Event::Ungrow(steps) => plain(Action::Ungrow { steps: Steps::nearest(*steps) }),
        Event::Undo => plain(Action::Undo {}),
        Event::Redo => plain(Action::Redo {}),
        Event::Apical(value, gesture) => patch_in(*gesture, *value),
        Event::Season(season, gesture) => looks::season(*gesture, *season as f32),
        Event::Shedding(threshold) => {
            let patch =
                ParametersPatch { shedding_threshold: Some(*threshold), ..ParametersPatch::default() };
            plain(Action::SetParameters { parameters: patch })
        }
        Event::Seed(x) => plain(Action::PlantSeed { position: Position::nearest(Vec3::X * *x) }),
        Event::Begin(stroke) => plain(Action::StrokeBegin { stroke: *stroke, bud: None }),
        Event::Move(stroke, x, y, r) => {
            plain(Action::StrokeMove { stroke: *stroke, samples: list(vec![sample(*x, *y, *r)]) })
        }
        Event::End(stroke) => plain(Action::StrokeEnd { stroke: *stroke }),
        Event::Lasso(w, h) => lasso(*w, *h),
        Event::Choose(row) => plain(Action::Grow { steps: Steps::nearest(2), until: None, bud: Some(*row) }),
        Event::Ball(x, radius, gesture) => place_in(*gesture, &sphere(*radius), *x),
        Event::Mesh(x, gesture) => place_in(*gesture, &slab(), *x),
        Event::Push(id, x, gesture) => in_gesture(*gesture, Action::MoveObstacle { id: *id, pose: pose(*x) }),
        Event::Swell(id, radius, gesture) => swell(*id, *radius, *gesture),
        Event::Clear(id, gesture) => in_gesture(*gesture, Action::RemoveObstacle { id: *id }),
        Event::Hold { bend, end, length, touches, stretch } => {
            hold(document, *bend, *end, *length, *touches, *stretch)
        }
        Event::Drag { bend, shift } => drag(document, *bend, *shift),
        Event::LetGo(bend) => plain(Action::BendEnd { bend: *bend }),
        Event::GiveUp(bend) => plain(Action::BendCancel { bend: *bend }),
        Event::Width(row, diameter, gesture) => in_gesture(
            *gesture,
            Action::SetWidth { row: found(row), diameter: diameter.map(Diameter::nearest) },
        ),
        Event::Prune(rows, gesture) => {
            in_gesture(*gesture, Action::Prune { rows: list(rows.iter().map(found).collect()) })
        }
        Event::PruneDim(exposure) => plain(Action::PruneDim { exposure: Share::nearest(*exposure) }),
        Event::Turn(row, angle, gesture) => in_gesture(
            *gesture,
            Action::TurnBranch { row: found(row), rotation: UnitRotation::nearest(turned(*angle)) },
        ),
        Event::Graft(row, onto, angle, keep) => plain(Action::Graft {
            row: found(row),
            onto: found(onto),
            rotation: UnitRotation::nearest(turned(*angle)),
            keep: *keep,
        }),
        Event::Programme(which, keep, gesture) => {
            in_gesture(*gesture, Action::SetProgramme { programme: programmes::some(*which), keep: *keep })
        }
        Event::Follow(gesture) => {
            in_gesture(*gesture, Action::FollowProgramme { parameters: List::default() })
        }
        Event::Design(x) => designing::begin(*x),
        Event::Say(what, value, gesture) => designing::say(*what, *value, *gesture),
        Event::Release => plain(Action::ReleaseDesign {}),
        Event::GoTo(step) => plain(Action::GoTo { step: step % (document.last_step() + 2) }),
        Event::Take(any) => {
            let futures = document.timeline().futures;
            let future = futures.get(*any as usize % futures.len().max(1)).map_or(*any, |it| it.future);
            plain(Action::TakeFuture { future })
        }
    };
    let before = document.hash();
    let answer = document.apply(&who("ann"), &action);
    let refused = answer.is_err();
    // A bend that cannot be kept ends nevertheless.
    if refused && !matches!(action.action, Action::BendEnd { .. }) {
        assert_eq!(document.hash(), before, "a refused {event:?} changed something: {answer:?}");
    }
}

/// What undoing and redoing leads to: the plant's hash and age, what it grows by, what stands in its way, its looks.
pub(super) type Form = ((u64, u32), ParameterValues, Vec<espalier_proto::PlacedObstacle>, Appearance);

pub(super) fn form(document: &Document) -> Form {
    let plant = (document.plant().hash(), document.age());
    (plant, document.parameters(), document.obstacles(), *document.appearance())
}

fn check_all(seed: u32, events: &[Event]) -> Result<(), TestCaseError> {
    let mut document = Document::new(seed);
    document.set_metamer_budget(4000);
    happen(&mut document, 0, &Event::Grow(5));
    for (number, event) in events.iter().enumerate() {
        happen(&mut document, number, event);
        prop_assert_eq!(checks::all(document.plant()), Ok(()), "{:?}", event);
    }
    // Light, space and buds are those of a scene made afresh: it grows on in the same way.
    let mut grown = document.simulation.clone();
    let parts = Plant::from_parts(document.plant().to_parts()).expect("its own parts");
    let mut afresh = Simulation::from_state(parts, document.simulation.state());
    // Growth by hand ends the brush of a programme.
    let strokes: Vec<_> = afresh.generator().strokes().filter(|stroke| stroke.is_of_programme()).collect();
    strokes.into_iter().for_each(|stroke| afresh.end_stroke(stroke));
    for _ in 0..2 {
        let input = espalier_growth::StepInput { autonomous: true, ..Default::default() };
        let schedule = GrowthSchedule::plain(grown.parameters().clone());
        grown.generator_mut().turn_to(&Arc::new(schedule), GeneratorState::default());
        // What was drawn the document alone knows.
        grown.generator_mut().keep_what_began_in(Vec::new());
        grown.step(&Step::Growth(input.clone()), &mut espalier_growth::NoObserver);
        afresh.step(&input, &mut espalier_growth::NoObserver);
    }
    prop_assert_eq!(grown.plant().hash(), afresh.plant().hash());
    // Written down and read again it is the same, and goes on the same.
    let bytes = document.to_bytes();
    let mut copy = Document::from_bytes(&bytes).expect("our own bytes");
    prop_assert_eq!(copy.hash(), document.hash());
    prop_assert!(copy.to_bytes() == bytes, "what was read is written again, byte by byte");
    prop_assert_eq!(copy.timeline(), document.timeline());
    let first = document.timeline().futures.first().map_or(0, |future| future.future);
    for event in [
        Event::Move(90, 3.0, 9.0, 0.0),
        Event::Drag { bend: 0, shift: [0.5, -1.0, 0.25] },
        Event::LetGo(0),
        Event::Grow(2),
        Event::Undo,
        Event::Redo,
        Event::Turn(7, 0.5, Some(0)),
        Event::Take(first),
        Event::Grow(1),
    ] {
        happen(&mut document, 500, &event);
        happen(&mut copy, 500, &event);
        prop_assert_eq!(copy.hash(), document.hash(), "after {:?}", event);
    }
    // All the way back is the seedling; all the way forth is the end again. So it is on every line of time.
    let lines: Vec<u32> = document.timeline().futures.iter().map(|future| future.future).collect();
    let seedling = form(&Document::new(seed));
    let mut forms = Vec::new();
    for line in std::iter::once(None).chain(lines.into_iter().map(Some)) {
        if let Some(future) = line {
            // TT4: what has nothing of its own any more lies on another line.
            if !document.timeline().futures.iter().any(|listed| listed.future == future) {
                continue;
            }
            document.apply(&who("ann"), &plain(Action::TakeFuture { future })).expect("it is listed");
            prop_assert_eq!(document.timeline().line, future);
        }
        while document.apply(&who("ann"), &plain(Action::Redo {})).is_ok() {}
        // Ungrowing may have left a setting that is not the line's.
        let step = document.plant().step();
        document.apply(&who("ann"), &plain(Action::GoTo { step })).expect("it is here");
        let end = form(&document);
        while document.apply(&who("ann"), &plain(Action::Undo {})).is_ok() {}
        prop_assert_eq!(&form(&document), &seedling);
        while document.apply(&who("ann"), &plain(Action::Redo {})).is_ok() {}
        prop_assert_eq!(&form(&document), &end);
        prop_assert_eq!(checks::all(document.plant()), Ok(()));
        forms.push((document.timeline().line, end));
    }
    // Each line is still there under its number.
    for (line, end) in forms {
        let timeline = document.timeline();
        if timeline.futures.iter().any(|listed| listed.future == line) {
            document.apply(&who("ann"), &plain(Action::TakeFuture { future: line })).expect("it is listed");
            prop_assert_eq!(form(&document), end);
        }
    }
    Ok(())
}

/// A document that was read does not know yet how the wood of a design was made, where it goes to another line.
#[test]
fn a_width_undone_beside_a_design_stays_a_future() {
    let events = [
        Event::Design(0.0),
        Event::Width(0, 0.05.into(), None),
        Event::Undo,
        Event::Say(0, 0.0, None),
        Event::Lasso(0.5, 1.0),
    ];
    check_all(54, &events).expect("it is whole");
}

#[test]
fn cm7_what_was_left_in_part_is_done_again_in_whole() {
    let mut document = Document::new(54);
    grow(&mut document, 4, None);
    let (whole, step) = (document.plant().hash(), document.plant().step());
    let ungrow = plain(Action::Ungrow { steps: Steps::nearest(1) });
    apply(&mut document, &ungrow);
    apply(&mut document, &plain(Action::Redo {}));
    assert_eq!((document.plant().hash(), document.plant().step()), (whole, step), "the rest of it");
    apply(&mut document, &ungrow);
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!(document.plant().step(), 0, "all of it");
    apply(&mut document, &plain(Action::Redo {}));
    assert_eq!((document.plant().hash(), document.plant().step()), (whole, step));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn histories_undo_redo_and_read_back_exactly(seed: u32, events in events()) {
        check_all(seed, &events)?;
    }
}
