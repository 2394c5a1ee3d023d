//! Programmes: parameters by age, what guides growth, what is set by hand; all of it back and forth in time.

use espalier_plant::AxisId;
use espalier_proto::{Age, ParameterName, Programme, Slug, Stage};

use super::*;

fn change(age: u32, parameters: ParametersPatch) -> Stage {
    Stage::Change { age: Age::nearest(age), parameters }
}

fn shedding(threshold: f32) -> ParametersPatch {
    ParametersPatch { shedding_threshold: Some(threshold), ..ParametersPatch::default() }
}

fn programme(stages: Vec<Stage>) -> Programme {
    Programme {
        species: Slug::try_from("reed".to_owned()).ok(),
        parameters: ParametersPatch { apical_control: Some(0.55), ..ParametersPatch::default() },
        stages: List::try_from(stages).expect("a few"),
        age: Age::nearest(9),
    }
}

/// A pole that becomes a tree.
fn pole() -> Programme {
    programme(vec![change(0, shedding(0.9)), change(4, shedding(0.1))])
}

/// A second seed, and two strokes, between which parameters change.
fn drawn() -> Programme {
    let up = |x: f32, radius: f32| {
        let places = [1.0, 4.0, 6.0].map(|y| sample(x, y, radius));
        list(places.to_vec())
    };
    programme(vec![
        Stage::Seed { age: Age::nearest(0), position: Position::nearest(Vec3::X * 5.0) },
        Stage::Stroke { age: Age::nearest(1), samples: up(0.0, 0.0) },
        Stage::Stroke { age: Age::nearest(1), samples: up(5.0, 2.0) },
        change(3, shedding(0.3)),
        change(30, shedding(0.0)),
    ])
}

/// One of a few programmes, or none.
pub(super) fn some(which: u32) -> Option<Programme> {
    match which {
        0 => None,
        1 => Some(pole()),
        2 => Some(drawn()),
        _ => Some(programme(Vec::new())),
    }
}

fn set(document: &mut Document, programme: Option<Programme>, keep: bool) {
    document.apply(&who("ann"), &plain(Action::SetProgramme { programme, keep })).expect("it is in range");
}

fn set_shedding(document: &mut Document, threshold: f32) {
    let parameters = shedding(threshold);
    document.apply(&who("ann"), &plain(Action::SetParameters { parameters })).expect("it is in range");
}

fn now(document: &Document) -> (u32, f32) {
    (document.age(), document.parameters().shedding_threshold)
}

#[test]
fn pg1_parameters_are_those_of_the_age_wherever_one_goes_in_time() {
    let mut document = Document::new(3);
    set(&mut document, Some(pole()), false);
    assert_eq!(now(&document), (0, 0.9));
    grow(&mut document, 3, None);
    assert_eq!(now(&document), (3, 0.9));
    grow(&mut document, 3, None);
    assert_eq!(now(&document), (6, 0.1));
    let hash = document.plant().hash();
    document.apply(&who("ann"), &plain(Action::GoTo { step: 2 })).expect("it has been there");
    assert_eq!(now(&document), (2, 0.9));
    document.apply(&who("ann"), &plain(Action::Ungrow { steps: Steps::LEAST })).expect("it has grown");
    assert_eq!(now(&document), (1, 0.9));
    while document.apply(&who("ann"), &plain(Action::Redo {})).is_ok() {}
    assert_eq!((now(&document), document.plant().hash()), ((6, 0.1), hash));
    while document.apply(&who("ann"), &plain(Action::Undo {})).is_ok() {}
    assert!(document.programme().is_none() && now(&document) == (0, 0.0));
}

#[test]
fn pg1_edits_take_no_time() {
    let mut document = Document::new(3);
    set(&mut document, Some(pole()), false);
    grow(&mut document, 3, None);
    let seed = Action::PlantSeed { position: Position::nearest(Vec3::X * 9.0) };
    document.apply(&who("ann"), &plain(seed)).expect("there is room");
    assert_eq!((now(&document), document.plant().step()), ((3, 0.9), 4));
}

#[test]
fn pg2_growth_ends_at_the_age_it_is_given() {
    let mut document = Document::new(3);
    set(&mut document, Some(drawn()), false);
    for _ in 0..40 {
        let action = Action::Grow { steps: Steps::nearest(3), until: Some(Age::nearest(20)), bud: None };
        document.apply(&who("ann"), &plain(action)).expect("there is room");
    }
    assert_eq!(document.age(), 20);
    assert!(document.plant().living_count() > 10 && document.plant().has_seed_at(Vec3::X * 5.0));
}

#[test]
fn pg2_growth_goes_on_wherever_one_goes_back_to() {
    let mut document = Document::new(3);
    set(&mut document, Some(drawn()), false);
    grow(&mut document, 30, None);
    for step in (1..document.plant().last_step()).rev() {
        document.apply(&who("ann"), &plain(Action::GoTo { step })).expect("it has been there");
        let seeds = |document: &Document| {
            let all = (0..document.plant().metamer_count()).map(MetamerId::new);
            all.filter(|&id| document.plant().is_seed(id)).count()
        };
        grow(&mut document, 1, None);
        assert!(document.plant().step() > step, "stuck at step {step}, age {}", document.age());
        assert!(seeds(&document) <= 2, "sown twice");
    }
}

#[test]
fn pg3_a_programme_is_put_in_the_place_of_another_or_taken_away() {
    let mut document = Document::new(3);
    set_shedding(&mut document, 0.7);
    set(&mut document, Some(pole()), false);
    assert_eq!(now(&document).1, 0.9);
    set_shedding(&mut document, 0.6);
    set(&mut document, Some(drawn()), true);
    assert_eq!(document.set_by_hand().collect::<Vec<_>>(), ["shedding_threshold"]);
    set(&mut document, Some(pole()), false);
    assert_eq!((document.set_by_hand().count(), now(&document).1), (0, 0.9));
    set(&mut document, None, false);
    grow(&mut document, 6, None);
    assert_eq!((document.programme().is_none(), now(&document)), (true, (6, 0.9)));
}

#[test]
fn pg3_stages_out_of_order_are_refused() {
    let mut document = Document::new(3);
    let programme = programme(vec![change(4, shedding(0.9)), change(3, shedding(0.1))]);
    let action = Action::SetProgramme { programme: Some(programme), keep: false };
    let problem = document.apply(&who("ann"), &plain(action)).expect_err("out of order");
    assert_eq!(problem.field.as_deref(), Some("programme.stages[1].age"));
}

#[test]
fn pg4_what_was_set_by_hand_holds_at_every_age_until_it_is_given_back() {
    let mut document = Document::new(3);
    set(&mut document, Some(pole()), false);
    set_shedding(&mut document, 0.5);
    grow(&mut document, 6, None);
    assert_eq!(now(&document).1, 0.5);
    let names = vec![ParameterName::try_from("shedding_threshold".to_owned()).expect("a parameter")];
    let parameters = List::try_from(names).expect("one");
    document
        .apply(&who("ann"), &plain(Action::FollowProgramme { parameters }))
        .expect("there is a programme");
    assert_eq!(now(&document).1, 0.1);
    document.apply(&who("ann"), &plain(Action::Undo {})).expect("it is an operation");
    assert_eq!(now(&document).1, 0.5);
    set(&mut document, None, false);
    let all = Action::FollowProgramme { parameters: List::default() };
    assert!(document.apply(&who("ann"), &plain(all)).is_err());
}

#[test]
fn pg2_the_brush_of_a_programme_gives_its_bud_to_the_hand() {
    let up = |step: u8| sample(0.0, 3.0 * f32::from(step), 0.0);
    let pole =
        programme(vec![Stage::Stroke { age: Age::nearest(0), samples: list((0..20).map(up).collect()) }]);
    let mut document = Document::new(5);
    set(&mut document, Some(pole), false);
    grow(&mut document, 6, None);
    let before = document.metamers();
    let tip = document.plant().bud_position(AxisId::new(0));
    assert!((5.0..40.0).contains(&tip.y), "the brush of the programme is on its way: {tip}");
    let mut apply = |action: Action| document.apply(&who("ann"), &plain(action)).expect("it is well formed");
    apply(Action::StrokeBegin { stroke: 1, bud: None });
    for step in 0..=10u8 {
        let along = f32::from(step);
        let samples = list(vec![sample(tip.x + along, tip.y + 0.5 * along, 0.0)]);
        apply(Action::StrokeMove { stroke: 1, samples });
    }
    apply(Action::StrokeEnd { stroke: 1 });
    let grown = document.metamers() - before;
    assert!((10..=14).contains(&grown), "{grown} metamers for a stroke of 11 internodes");
    let end = document.plant().bud_position(AxisId::new(0));
    assert!(
        end.distance(tip + Vec3::new(10.0, 5.0, 0.0)) <= 0.5,
        "it continued the leader of the programme: {end}"
    );
    grow(&mut document, 3, None);
    assert!(document.metamers() > before + grown, "the programme goes on");
}
