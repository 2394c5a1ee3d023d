//! A second generator, as small as can be: it proves that documents take one, whatever is done to its wood, and
//! beside growth.

use espalier_growth::{Change, Generator, Observer, Recording, Scene, StepOutcome};
use espalier_plant::{AxisId, Carried, Internode, MetamerId, Plant, checks};
use proptest::prelude::*;

use super::*;

/// By how much wood stretches in a step.
const STRETCH: f32 = 1.05;
/// How far a bud looks for a free place, in internodes.
const CLEARANCE: f32 = 0.3;
/// Metamers of the documents here.
const BUDGET: u32 = 400;

/// In each step every internode stretches, and every bud in the light with room ahead becomes an internode with two
/// buds, as thick as its step says.
#[derive(Clone, Debug, Default)]
pub(in crate::document) struct Forks {
    /// How often it has followed others.
    followed: u32,
}

impl Generator for Forks {
    type Input = ();

    fn step(&mut self, scene: &mut Scene, (): &(), _: &mut impl Observer) -> StepOutcome {
        let is_free = |axis: &AxisId| {
            let plant = scene.plant();
            let place = plant.bud_position(*axis) + plant.axes().direction(*axis);
            place.y > 0.0 && scene.is_free(place, CLEARANCE) && scene.exposure(place) > 0.1
        };
        let plant = scene.plant();
        let buds = (0..plant.axis_count()).map(AxisId::new);
        let buds = buds.filter(|&axis| plant.is_axis_alive(axis) && !plant.has_grown(axis));
        let buds: Vec<AxisId> = buds.filter(is_free).collect();
        let metamers_grown = scene.record_growth(|step| {
            let columns = stretched(step.scene().plant());
            step.place(columns).expect("it stretches within the world");
            let born: Vec<MetamerId> = buds.iter().filter_map(|&bud| fork(step, bud)).collect();
            let radius = Some(0.05 + 0.01 * step.scene().plant().step() as f32);
            let radii: Vec<_> = born.iter().map(|&id| (id, radius)).collect();
            step.give_radii(&radii).expect("living wood");
            born.len() as u32
        });
        StepOutcome { metamers_grown, buds_enabled: buds.len() as u32 }
    }

    fn follow(&mut self, _: &Scene, _: &Change) {
        self.followed += 1;
    }
}

fn fork(step: &mut Recording<'_>, bud: AxisId) -> Option<MetamerId> {
    let plant = step.scene().plant();
    let heading = plant.axes().direction(bud);
    let normal = heading.any_orthonormal_vector();
    let laterals = [(heading + normal).normalize(), (heading - normal).normalize()];
    let end = plant.bud_position(bud) + heading;
    step.extend(bud, &Internode { end, normal, laterals: &laterals })
}

/// Where all living wood stands once it has stretched.
fn stretched(plant: &Plant) -> Carried {
    let mut ends: Vec<Vec3> = Vec::new();
    let mut columns = Carried::default();
    for id in (0..plant.metamer_count()).map(MetamerId::new) {
        let end = plant.metamers().end(id);
        let Some(parent) = plant.metamers().parent(id).filter(|_| plant.is_alive(id)) else {
            ends.push(end);
            continue;
        };
        ends.push(ends[parent.index()] + STRETCH * (end - plant.metamers().end(parent)));
        columns.metamers.push(id);
        columns.ends.push(ends[id.index()]);
        columns.normals.push(plant.metamers().normal(id));
    }
    columns
}

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
        1 => Just(Event::Reload),
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
    document.begin_steps(Cause::from("ann"), steps, step)?;
    while document.advance() {}
    Ok(())
}

/// Does it, or is refused: not everything can be done at all times.
fn happen(document: &mut Document, event: &Event) -> Result<(), Problem> {
    let of = |pick| row(document, pick);
    let actions = match *event {
        Event::Fork(count) => return steps(document, Step::Fork, count),
        Event::Reload => {
            let again = reloaded(document);
            assert_eq!(again.hash(), document.hash());
            *document = again;
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
    };
    actions.iter().try_for_each(|action| document.apply("ann", action))
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

fn reloaded(document: &Document) -> Document {
    Document::from_bytes(&document.to_bytes()).expect("it reads what it has written")
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
        for event in &events {
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
        for step in [Step::Fork, Step::Growth(espalier_growth::StepInput { autonomous: true, ..Default::default() })] {
            let one = steps(&mut document, step.clone(), 2);
            prop_assert_eq!(&one, &steps(&mut opened, step, 2));
            prop_assert_eq!(document.hash(), opened.hash());
        }
        let mut undone = 0;
        while document.apply("ann", &plain(Action::Undo {})).is_ok() {
            undone += 1;
        }
        prop_assert_eq!(document.plant().hash(), seedling);
        for _ in 0..undone {
            document.apply("ann", &plain(Action::Redo {})).expect("it was undone");
        }
        prop_assert_eq!(document.plant().hash(), opened.plant().hash());
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
    assert_eq!(document.simulation.generator().forks().followed, 0);
    let grown = plant.hash();
    apply(&mut document, &plain(Action::Ungrow { steps: Steps::nearest(1) }));
    assert!((document.plant().metamers().end(MetamerId::new(1)).y - STRETCH).abs() < 1e-5);
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!(document.plant().living_count(), 0);
    apply(&mut document, &plain(Action::Redo {}));
    assert_eq!(document.plant().hash(), grown);
    assert!(document.simulation.generator().forks().followed >= 3, "it hears of every move in time");
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
