//! A document takes a second generator, whatever is done to its wood, and beside growth; its state goes everywhere that
//! the plants go.

use std::collections::BTreeMap;

use espalier_growth::StepInput;
use espalier_plant::checks;
use proptest::prelude::*;

use super::{
    forks::{CLEARANCE, Forks, STRETCH},
    *,
};
use crate::document::generators::GeneratorState;

/// Metamers of the documents here.
const BUDGET: u32 = 400;

#[derive(Clone, Debug)]
enum Event {
    Fork(u32),
    Grow(u32),
    Ungrow(u32),
    Undo,
    Redo,
    GoTo(u16),
    TakeFuture,
    Prune(u16),
    Bend(u16),
    Width(u16),
    Graft(u16, u16),
    /// Turned twice in one gesture.
    Turn(u16),
    Reload,
}

fn events() -> impl Strategy<Value = Vec<Event>> {
    let event = prop_oneof![
        5 => (1u32..3).prop_map(Event::Fork),
        2 => (1u32..3).prop_map(Event::Grow),
        1 => (1u32..3).prop_map(Event::Ungrow),
        2 => Just(Event::Undo),
        2 => Just(Event::Redo),
        1 => any::<u16>().prop_map(Event::GoTo),
        1 => Just(Event::TakeFuture),
        1 => any::<u16>().prop_map(Event::Prune),
        1 => any::<u16>().prop_map(Event::Bend),
        1 => any::<u16>().prop_map(Event::Width),
        1 => (any::<u16>(), any::<u16>()).prop_map(|(row, onto)| Event::Graft(row, onto)),
        1 => any::<u16>().prop_map(Event::Turn),
        2 => Just(Event::Reload),
    ];
    prop::collection::vec(event, 4..24)
}

/// The row of some living wood.
fn row(document: &Document, pick: u16) -> u32 {
    let plant = document.plant();
    let rows = (0..plant.metamer_count()).map(MetamerId::new);
    let wood: Vec<_> = rows.filter(|&id| plant.is_alive(id) && !plant.is_seed(id)).collect();
    wood.get(usize::from(pick) % wood.len().max(1)).map_or(u32::MAX, |id| id.raw())
}

fn steps(document: &mut Document, step: Step, steps: u32) -> Result<(), Problem> {
    document.begin_steps(Cause::from(&who("ann")), steps, step)?;
    while document.advance() {}
    Ok(())
}

/// Does it, or is refused: not everything can be done at all times.
fn happen(document: &mut Document, event: &Event) -> Result<(), Problem> {
    let of = |pick| row(document, pick);
    let actions = match *event {
        Event::Fork(count) => return steps(document, Step::Fork, count),
        Event::Reload => {
            *document = reloaded(document);
            return Ok(());
        }
        Event::Grow(steps) => {
            vec![plain(Action::Grow { steps: Steps::nearest(steps), until: None, bud: None })]
        }
        Event::Ungrow(steps) => vec![plain(Action::Ungrow { steps: Steps::nearest(steps) })],
        Event::Undo => vec![plain(Action::Undo {})],
        Event::Redo => vec![plain(Action::Redo {})],
        Event::GoTo(step) => {
            vec![plain(Action::GoTo { step: u32::from(step) % (document.plant().last_step() + 1) })]
        }
        Event::TakeFuture => {
            let future = document.futures.all.first().map_or(u32::MAX, |future| future.line);
            vec![plain(Action::TakeFuture { future })]
        }
        Event::Prune(pick) => vec![plain(Action::Prune { rows: list(vec![of(pick)]) })],
        Event::Bend(pick) => {
            let touched = of(pick);
            let base = bearer(document, touched);
            let target = end(document, touched) + Vec3::new(0.4, 0.0, 0.2);
            vec![
                plain(Action::BendBegin {
                    bend: 1,
                    base,
                    touches: held(vec![touched]),
                    stretch: Share::nearest(0.5),
                }),
                plain(Action::BendMove { bend: 1, targets: places(vec![target]) }),
                plain(Action::BendEnd { bend: 1 }),
            ]
        }
        Event::Width(pick) => {
            vec![plain(Action::SetWidth { row: of(pick), diameter: Some(Diameter::nearest(0.5)) })]
        }
        Event::Graft(pick, onto) => {
            let rotation = Quat::from_xyzw(0.0, 0.6, 0.0, 0.8);
            vec![plain(Action::Graft {
                row: of(pick),
                onto: of(onto),
                rotation: UnitRotation::nearest(rotation),
                keep: true,
            })]
        }
        Event::Turn(pick) => {
            let turned = |x| {
                let rotation = UnitRotation::nearest(Quat::from_xyzw(x, 0.0, 0.0, 1.0));
                in_gesture(1, Action::TurnBranch { row: of(pick), rotation })
            };
            vec![turned(0.2), turned(0.3)]
        }
    };
    actions.iter().try_for_each(|action| document.apply(&who("ann"), action))
}

/// The row below some wood.
fn bearer(document: &Document, row: u32) -> u32 {
    let metamers = document.plant().metamers();
    if row == u32::MAX {
        row
    } else {
        metamers.parent(MetamerId::new(row as usize)).map_or(row, MetamerId::raw)
    }
}

fn end(document: &Document, row: u32) -> Vec3 {
    if row == u32::MAX { Vec3::ZERO } else { document.plant().metamers().end(MetamerId::new(row as usize)) }
}

/// The document, saved and opened: nothing of it differs, the state of its generators least of all.
fn reloaded(document: &Document) -> Document {
    let again = Document::from_bytes(&document.to_bytes()).expect("it reads what it has written");
    assert_eq!(again.hash(), document.hash());
    assert_eq!((&again.history, &again.futures), (&document.history, &document.futures));
    assert_eq!(state(&again), state(document));
    again
}

fn state(document: &Document) -> GeneratorState {
    document.simulation.generator().state().clone()
}

fn forks(document: &Document) -> Forks {
    state(document).forks
}

/// The state of the generators at each place where the document has been: what has been done up to there, and the plants.
#[derive(Default)]
struct Places(BTreeMap<Place, GeneratorState>);

/// The kind and first step of each operation in force, the step, the plants.
type Place = (Vec<(u8, u32)>, u32, u64);

impl Places {
    /// Wherever the document has been before, the state is that of then.
    fn check(&mut self, document: &Document) {
        let done = &document.history.operations[..document.history.done];
        let done = done.iter().map(|operation| (operation.kind as u8, operation.first)).collect();
        let place = (done, document.plant().step(), document.plant().hash());
        let now = state(document);
        let then = self.0.entry(place).or_insert_with(|| now.clone());
        assert_eq!(*then, now, "it was here before");
    }
}

/// Light and space are those of the plants as they stand.
fn assert_light_and_space(document: &Document) {
    let (now, again) = (document.simulation.scene(), reloaded(document));
    let afresh = again.simulation.scene();
    for id in (0..now.plant().metamer_count()).map(MetamerId::new) {
        let place = now.plant().metamers().end(id);
        assert_eq!(now.exposure(place).to_bits(), afresh.exposure(place).to_bits());
        assert_eq!(now.is_free(place, CLEARANCE), afresh.is_free(place, CLEARANCE));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn a_second_generator_lives_with_everything_that_is_done_to_a_document(events in events()) {
        let mut document = Document::new(7);
        document.set_metamer_budget(BUDGET);
        let seedling = document.plant().hash();
        let mut places = Places::default();
        for event in &events {
            places.check(&document);
            let before = document.hash();
            if happen(&mut document, event).is_err() && !matches!(event, Event::Bend(_)) {
                prop_assert_eq!(document.hash(), before, "{:?} is refused and changes something", event);
            }
            document.end_gestures();
            prop_assert_eq!(checks::all(document.plant()), Ok(()), "after {:?}", event);
            assert_light_and_space(&document);
        }
        // Both generators go on from here as they do in a document that was saved and opened.
        let mut opened = reloaded(&document);
        for step in [Step::Fork, Step::Growth(StepInput { autonomous: true, ..Default::default() })] {
            let one = steps(&mut document, step.clone(), 2);
            prop_assert_eq!(&one, &steps(&mut opened, step, 2));
            prop_assert_eq!(document.hash(), opened.hash());
        }
        // What was left in part is done in whole: so will it be when it is done again (CM7).
        if document.history.is_in_part(document.plant().step()) {
            apply(&mut document, &plain(Action::Redo {}));
        }
        let (plant, at_the_end) = (document.plant().hash(), state(&document));
        places.check(&document);
        let mut undone = 0;
        while document.apply(&who("ann"), &plain(Action::Undo {})).is_ok() {
            undone += 1;
            places.check(&document);
        }
        prop_assert_eq!((document.plant().hash(), forks(&document)), (seedling, Forks::default()));
        for _ in 0..undone {
            document.apply(&who("ann"), &plain(Action::Redo {})).expect("it was undone");
            places.check(&document);
        }
        prop_assert_eq!((document.plant().hash(), state(&document)), (plant, at_the_end));
        for future in document.timeline().futures {
            let taken = Action::TakeFuture { future: future.future };
            // Its own line may have been forgotten meanwhile.
            let _ = document.apply(&who("ann"), &plain(taken));
            places.check(&document);
            for step in (0..=document.plant().last_step()).rev() {
                apply(&mut document, &plain(Action::GoTo { step }));
                places.check(&document);
            }
        }
    }
}

#[test]
fn a_fork_grows_by_its_own_rules_and_is_undone() {
    let mut document = Document::new(1);
    steps(&mut document, Step::Fork, 3).expect("there is room");
    // A stem, two forks of it, and four of theirs; each step has stretched those before.
    let plant = document.plant();
    assert_eq!((plant.living_count(), plant.step()), (7, 3));
    let stem = plant.metamers().end(MetamerId::new(1));
    assert!((stem.y - STRETCH * STRETCH).abs() < 1e-5, "{stem}");
    assert_eq!(plant.given_radius(MetamerId::new(1)), Some(0.05 + 0.01));
    assert_eq!(forks(&document).changes, 0);
    let grown = plant.hash();
    apply(&mut document, &plain(Action::Ungrow { steps: Steps::nearest(1) }));
    assert!((document.plant().metamers().end(MetamerId::new(1)).y - STRETCH).abs() < 1e-5);
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!(document.plant().living_count(), 0);
    apply(&mut document, &plain(Action::Redo {}));
    assert_eq!(document.plant().hash(), grown);
    let tip = document.plant().metamer_count() as u32 - 1;
    apply(&mut document, &plain(Action::Prune { rows: list(vec![tip]) }));
    assert_eq!(forks(&document).changes, 1, "it hears of what others do");
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!(forks(&document).changes, 0, "and knows no more of it once that is taken back");
}

#[test]
fn a_second_generator_ends_at_the_budget() {
    let mut document = Document::new(1);
    document.set_metamer_budget(20);
    steps(&mut document, Step::Fork, 30).expect("there is room");
    assert_eq!(document.plant().metamer_count(), 20);
    assert!(document.figures().budget_reached);
    assert_eq!(document.pending_steps(), 0);
    assert!(steps(&mut document, Step::Fork, 1).is_err());
}

/// Three steps; then back to the first of them, another seed, and two steps more as the present line.
fn branched() -> Document {
    let mut document = Document::new(1);
    steps(&mut document, Step::Fork, 3).expect("there is room");
    apply(&mut document, &plain(Action::Ungrow { steps: Steps::nearest(2) }));
    apply(&mut document, &plain(Action::PlantSeed { position: Position::nearest(Vec3::X * 4.0) }));
    steps(&mut document, Step::Fork, 2).expect("there is room");
    document
}

#[test]
fn each_line_of_time_has_states_of_its_own() {
    let mut document = reloaded(&branched());
    let here = forks(&document);
    assert_eq!((here.steps, here.changes), (3, 1));
    let there = document.futures.all[0].line;
    apply(&mut document, &plain(Action::TakeFuture { future: there }));
    let mut document = reloaded(&document);
    let other = forks(&document);
    assert_eq!((other.steps, other.changes), (3, 0));
    assert_ne!(other.tips, here.tips);
    apply(&mut document, &plain(Action::GoTo { step: 1 }));
    assert_eq!((forks(&document).steps, forks(&document).tips.len()), (1, 2));
    let back = document.futures.all[0].line;
    apply(&mut document, &plain(Action::TakeFuture { future: back }));
    assert_eq!(forks(&document), here);
}

#[test]
fn the_next_step_depends_on_the_state_that_was_saved() {
    let document = branched();
    let (mut opened, mut without) = (reloaded(&document), reloaded(&document));
    let (schedule, forgotten) = (Arc::clone(without.schedule()), GeneratorState::default());
    without.simulation.generator_mut().turn_to(&schedule, forgotten);
    let hashes = [document, opened.clone(), without].map(|mut document| {
        steps(&mut document, Step::Fork, 1).expect("there is room");
        document.plant().hash()
    });
    assert_eq!(hashes[0], hashes[1]);
    assert_ne!(hashes[1], hashes[2]);
    steps(&mut opened, Step::Fork, 1).expect("there is room");
    assert_eq!(opened.plant().hash(), hashes[0]);
}

/// What [`branched`] gives, as another program would have it: one without this generator refuses it
/// (`tests/session/kept.rs`), and so does every way into the server. `UPDATE_GOLDEN=1` writes it.
#[test]
fn a_document_of_another_program_opens_where_its_generator_is_known() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/golden/later.espalier");
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(path, branched().to_bytes()).expect("the folder is there");
    }
    let bytes = std::fs::read(path).expect("it is kept");
    let opened = Document::from_bytes(&bytes).expect("this program knows all of its sections");
    assert_eq!(forks(&reloaded(&opened)), forks(&branched()));
}
