//! Designs in a document: wood that follows what is said, undone, sealed, saved, and changed by hand.

use espalier_design::{Design, Generator, Key, MAX_INTERNODES, NodeId};
use espalier_plant::{Wood, WoodAxis, WoodNode, checks};
use espalier_proto::{DesignEdit, DesignValue, Slug};
use serde_json::{Value, json};

use super::{histories::form, *};
use crate::document::designing::Designed;

/// A design of few internodes.
pub(super) fn small() -> Value {
    json!({
        "version": 1,
        "nodes": { "/": { "values": {
            "height": { "own": 14 }, "stem": { "own": 0.4 }, "orders": { "own": 2 },
            "density": { "own": [[0, 4], [1, 4]] },
            "leaves": { "own": [[0, 2], [1, 2]] },
        } } },
    })
}

pub(super) fn new_design(position: Option<Vec3>, graph: Option<Value>) -> Command {
    plain(Action::NewDesign {
        position: position.map(Position::nearest),
        template: None,
        graph: graph.map(DesignValue::from),
    })
}

pub(super) fn begin(x: f32) -> Command {
    new_design(Some(Vec3::X * x), Some(small()))
}

pub(super) fn edits(gesture: Option<u32>, edits: &[Value]) -> Command {
    let edits = edits.iter().map(|edit| serde_json::from_value(edit.clone()).expect("in good form"));
    in_gesture(gesture, Action::EditDesign { edits: list(edits.collect::<Vec<DesignEdit>>()) })
}

pub(super) fn set(of: &str, key: &str, value: &Value) -> Value {
    json!({ "edit": "set", "of": of, "key": key, "value": { "own": value } })
}

/// One of a few things that can be said; some are refused where the branch is not there.
pub(super) fn say(what: u32, value: f32, gesture: Option<u32>) -> Command {
    // Few values, so that things also come back to what they were.
    let value = (4.0 * value).round() / 4.0;
    let edit = match what {
        0 => set("/", "density", &json!([[0, 2.0 + 4.0 * value], [1, 3]])),
        1 => set("/1", "reach", &json!(0.5 + value)),
        2 => set("/0/0", "roll", &json!(90.0 * value)),
        3 => set("/", "height", &json!(10.0 + 8.0 * value)),
        4 => json!({ "edit": "clear", "of": "/1", "key": "reach" }),
        5 => set("/1", "material", &json!({ "bark": [value, 1, 1], "leaves": [1, value, 1] })),
        _ => json!({ "edit": "set", "of": "level 1", "key": "girth", "value": { "multiply": 0.5 + value } }),
    };
    edits(gesture, &[edit])
}

/// A document with a small design and nothing else but the seed.
pub(super) fn designed() -> Document {
    let mut document = Document::new(5);
    apply(&mut document, &begin(8.0));
    document
}

pub(super) fn in_force(document: &Document) -> Design {
    document.design_in_force().expect("there is one").read().expect("it was written")
}

/// The ends of all living wood of the design, as it is made from scratch and as it stands.
fn check_wood(document: &Document) {
    assert_eq!(checks::all(document.plant()), Ok(()));
    let Some(of) = document.design_in_force() else { return };
    if document.plant().step() != of.step {
        return;
    }
    let wanted = Generator::default().generate(&in_force(document), MAX_INTERNODES);
    let plant = document.plant();
    let count = plant.metamer_count();
    let first = count - wanted.wood.nodes.len();
    for (node, row) in wanted.wood.nodes.iter().zip((first..count).map(MetamerId::new)) {
        assert_eq!(plant.metamers().end(row), node.end + of.at);
        assert_eq!(plant.birth(row), of.step);
        let parent = plant.metamers().parent(row).map(|parent| parent.index() - first);
        assert_eq!(parent, node.parent.map(|parent| parent as usize));
        assert_eq!(plant.given_radius(row), node.parent.and(node.radius));
    }
}

fn wood(document: &Document) -> Vec<[u32; 3]> {
    let plant = document.plant();
    let living = (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id));
    living.map(|id| plant.metamers().end(id).to_array().map(f32::to_bits)).collect()
}

#[test]
fn ds1_a_design_is_ordinary_wood_and_one_operation() {
    let mut document = Document::new(5);
    let before = document.hash();
    apply(&mut document, &begin(8.0));
    check_wood(&document);
    assert!(document.metamers() > 20);
    assert_eq!(kinds(&document), [espalier_proto::OperationKind::Design]);
    let told = document.design_told().expect("it is told");
    assert_eq!((told.at.get(), told.steps_on_top), (Vec3::X * 8.0, 0));
    assert_eq!(told.branches as usize, in_force(&document).root().count());
    let standing = form(&document);
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!((document.metamers(), document.design_told()), (0, None));
    assert_ne!(document.hash(), before, "there is something to redo");
    apply(&mut document, &plain(Action::Redo {}));
    assert_eq!(form(&document), standing);
}

#[test]
fn ds1_every_template_stands_in_a_document() {
    for template in espalier_design::TEMPLATES {
        let mut document = Document::new(5);
        let at = Vec3::new(0.0, 60.0, 0.0);
        let command = plain(Action::NewDesign {
            position: Some(Position::nearest(at)),
            template: Some(Slug::try_from(template.name.to_owned()).expect("it is short")),
            graph: None,
        });
        apply(&mut document, &command);
        check_wood(&document);
    }
}

#[test]
fn ds2_what_is_said_of_a_branch_changes_its_wood_alone_and_is_taken_back() {
    let mut document = designed();
    let before = (form(&document), wood(&document));
    apply(&mut document, &edits(None, &[set("/1", "roll", &json!(80))]));
    check_wood(&document);
    let after = (form(&document), wood(&document));
    assert_ne!(before.1, after.1);
    let limb = Generator::default().generate(&in_force(&document), MAX_INTERNODES);
    let of_limb = |row: usize| {
        limb.limbs.iter().any(|(id, rows)| id.to_string() == "/1" && rows.contains(&(row as u32)))
    };
    let first = before.1.len() - limb.wood.nodes.len();
    for (row, (was, is)) in before.1.iter().zip(&after.1).enumerate() {
        assert!(was == is || of_limb(row - first), "row {row} is none of limb /1 and moved");
    }
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!(wood(&document), before.1);
    apply(&mut document, &plain(Action::Redo {}));
    assert_eq!((form(&document), wood(&document)), after);
}

#[test]
fn ds2_a_gesture_is_one_operation_and_none_where_it_ends_as_it_began() {
    let mut document = designed();
    let before = wood(&document);
    for roll in [10, 20, 30] {
        apply(&mut document, &edits(Some(7), &[set("/1", "roll", &json!(roll))]));
    }
    assert_eq!(document.timeline().operations.len(), 2);
    apply(&mut document, &edits(Some(7), &[json!({ "edit": "clear", "of": "/1", "key": "roll" })]));
    assert_eq!((document.timeline().operations.len(), wood(&document)), (1, before));
    // What says what holds already changes nothing.
    let (hash, text) = (document.hash(), in_force(&document).to_json());
    apply(&mut document, &edits(None, &[set("/", "height", &json!(14))]));
    assert_eq!((document.hash(), in_force(&document).to_json()), (hash, text));
}

#[test]
fn ds2_edits_are_done_together_or_not_at_all() {
    let mut document = designed();
    for (refused, reason, field) in [
        (set("/", "height", &json!(9999)), Reason::OutOfRange, "edits[1].value.own"),
        (set("/", "hight", &json!(9)), Reason::Malformed, "edits[1].key"),
        (set("/77", "reach", &json!(1)), Reason::DesignBranchGone, "edits[1].node"),
        (set("/77/1", "height", &json!(10)), Reason::Malformed, "edits[1].value.own"),
        (set("/", "density", &json!([])), Reason::OutOfRange, "edits[1].value.own"),
        (set("/", "density", &json!([[0, 1], [0, 2]])), Reason::OutOfRange, "edits[1].value.own[1][0]"),
        (json!({ "edit": "copy", "from": "/1", "to": "/1/0" }), Reason::DesignRefused, "edits[1].edit"),
        (json!({ "edit": "wake", "node": "/1" }), Reason::DesignRefused, "edits[1].node"),
        (json!({ "edit": "set_shared", "share": 4, "value": 1 }), Reason::OutOfRange, "edits[1].share"),
        (
            json!({ "edit": "set", "of": "/1", "key": "axis", "value": { "add": [[0, 0, 0], [0, 1, 0]] } }),
            Reason::Malformed,
            "edits[1].value.add",
        ),
        (
            json!({ "edit": "set", "of": "/1", "key": "reach", "value": { "own": 1, "add": 1 } }),
            Reason::Malformed,
            "edits[1].value.add",
        ),
    ] {
        let command = edits(None, &[set("/1", "roll", &json!(80)), refused.clone()]);
        let before = document.hash();
        let problem = document.apply(&who("ann"), &command).expect_err("it is refused");
        assert_eq!(document.hash(), before, "{refused}");
        assert_eq!((problem.reason, problem.field.as_deref()), (reason, Some(field)), "{refused}: {problem}");
        assert_eq!(document.timeline().operations.len(), 1);
    }
}

#[test]
fn ds1_graphs_that_are_none_are_refused() {
    let mut document = Document::new(1);
    let many: serde_json::Map<String, Value> =
        (0..200).map(|at| (format!("/{at}"), json!({ "values": { "reach": { "own": 1 } } }))).collect();
    for (graph, field) in [
        (json!({}), "graph.version"),
        (json!({ "version": 2 }), "graph.version"),
        (json!({ "version": 1, "nodes": { "/1/": {} } }), "graph.nodes./1/"),
        (json!({ "version": 1, "nodes": many }), "graph.nodes./"),
        (
            json!({ "version": 1, "nodes": { "/": { "values": { "density": { "own": [] } } } } }),
            "graph.nodes./.values.density.own",
        ),
        (
            json!({ "version": 1, "nodes": { "/": { "values": { "silhouette": { "own": {
                "top": [0, -1, 0], "bottom": [0, 1, 0], "radii": [1, 1, 1, 1], "heights": [0, 0, 0, 0],
                "upper": 2, "lower": 2, "tip": [0, 1, 0],
            } } } } } }),
            "graph.nodes./.values.silhouette.own",
        ),
    ] {
        let problem = problem(&mut document, &new_design(Some(Vec3::ZERO), Some(graph.clone())));
        assert!(
            problem.field.as_deref().is_some_and(|found| found.starts_with(field)),
            "{graph}: {problem:?}"
        );
    }
    let template = plain(Action::NewDesign {
        position: Some(Position::nearest(Vec3::ZERO)),
        template: Some(Slug::try_from("oak".to_owned()).expect("it is short")),
        graph: None,
    });
    assert_eq!(problem(&mut document, &template).reason, Reason::NoTemplate);
    assert_eq!(problem(&mut document, &new_design(None, None)).reason, Reason::DesignGone);
    assert_eq!(
        problem(&mut document, &edits(None, &[set("/", "height", &json!(9))])).reason,
        Reason::DesignGone
    );
    assert_eq!(problem(&mut document, &plain(Action::ReleaseDesign {})).reason, Reason::DesignGone);
}

#[test]
fn ds3_what_grows_on_top_seals_the_design_until_it_is_undone() {
    let mut document = designed();
    grow(&mut document, 2, None);
    let change = edits(None, &[set("/1", "roll", &json!(80))]);
    let problem = problem(&mut document, &change);
    assert_eq!(problem.reason, Reason::DesignSealed);
    for way in ["undo", "release_design", "fit_design", "new_design"] {
        assert!(problem.message.contains(way), "{problem}");
    }
    assert_eq!(document.design_told().map(|told| told.steps_on_top), Some(document.plant().step() - 1));
    let grown = wood(&document);
    apply(&mut document, &plain(Action::Undo {}));
    apply(&mut document, &change);
    check_wood(&document);
    // What grew is a future, and stands on the wood as it was.
    let future = document.timeline().futures[0].future;
    apply(&mut document, &plain(Action::TakeFuture { future }));
    assert_eq!(wood(&document), grown);
    // Let go, it is wood like any other.
    apply(&mut document, &plain(Action::ReleaseDesign {}));
    assert_eq!((document.design_told(), wood(&document)), (None, grown));
    apply(&mut document, &plain(Action::Undo {}));
    assert!(document.design_told().is_some());
}

#[test]
fn ds5_changes_below_what_has_grown_are_undone_and_done_again() {
    let mut document = designed();
    let first = wood(&document);
    apply(&mut document, &edits(None, &[set("/", "density", &json!([[0, 7], [1, 7]]))]));
    let second = wood(&document);
    assert_ne!(first.len(), second.len());
    grow(&mut document, 3, None);
    let (standing, third) = (form(&document), wood(&document));
    for way in [&second, &first] {
        apply(&mut document, &plain(Action::Undo {}));
        assert_eq!(&wood(&document), way);
        check_wood(&document);
        // Written down in the midst of it, it is the same.
        let copy = Document::from_bytes(&document.to_bytes()).expect("our own bytes");
        assert_eq!((copy.hash(), &wood(&copy)), (document.hash(), way));
        assert_eq!(copy.timeline(), document.timeline());
    }
    assert_eq!(document.timeline().last_step, 4, "what has grown lies ahead");
    // Another change leaves both as a future.
    let mut other = document.clone();
    apply(&mut other, &edits(None, &[set("/1", "reach", &json!(0.5))]));
    check_wood(&other);
    let future = other.timeline().futures[0].future;
    apply(&mut other, &plain(Action::TakeFuture { future }));
    assert_eq!(wood(&other), third);
    for way in [&second, &third] {
        apply(&mut document, &plain(Action::Redo {}));
        assert_eq!(&wood(&document), way);
    }
    assert_eq!(form(&document), standing);
    apply(&mut document, &plain(Action::Ungrow { steps: Steps::nearest(3) }));
    assert_eq!(wood(&document), second);
}

#[test]
fn ds6_everyones_undo_takes_back_what_they_said() {
    let mut document = designed();
    let said = |of: &str, key: &str, value: Value| edits(None, &[set(of, key, &value)]);
    document.apply(&who("ben"), &said("/1", "roll", json!(80))).expect("it is said");
    document.apply(&who("ann"), &said("/2", "roll", json!(50))).expect("it is said");
    document.apply(&who("ben"), &said("/2", "reach", json!(0.6))).expect("it is said");
    document.apply(&who("ann"), &plain(take_back_by(&[]))).expect("she takes hers back");
    check_wood(&document);
    let has = |document: &Document, of: &str, key: Key| {
        let node: NodeId = of.parse().expect("a way");
        in_force(document).graph().setting(node, key).is_some()
    };
    assert!(has(&document, "/1", Key::Roll) && has(&document, "/2", Key::Reach));
    assert!(!has(&document, "/2", Key::Roll));
    document.apply(&who("ben"), &plain(take_back_by(&[]))).expect("he takes his back");
    document.apply(&who("ben"), &plain(take_back_by(&[]))).expect("and the other");
    check_wood(&document);
    assert!(!has(&document, "/1", Key::Roll) && !has(&document, "/2", Key::Reach));
    document.apply(&who("ann"), &plain(bring_back_by(&[]))).expect("she brings hers back");
    assert!(has(&document, "/2", Key::Roll));
    check_wood(&document);
    // Once something has grown, nobody changes the wood below it by taking back.
    document.apply(&who("ann"), &edits(None, &[set("/1", "roll", &json!(20))])).expect("it is said");
    document
        .apply(&who("ben"), &plain(Action::Grow { steps: Steps::nearest(1), until: None, bud: None }))
        .expect("it grows");
    let refused = document.apply(&who("ann"), &plain(take_back_by(&[]))).expect_err("it is sealed");
    assert_eq!(refused.reason, Reason::DesignSealed);
}

/// A row in the midst of limb `/1`, and how many rows the limb's own axis has.
fn limb(document: &Document) -> (Vec<u32>, NodeId) {
    let node: NodeId = "/1".parse().expect("a way");
    let generated = Generator::default().generate(&in_force(document), MAX_INTERNODES);
    let first = document.plant().metamer_count() - generated.wood.nodes.len();
    (generated.rows(node).map(|row| row + first as u32).collect(), node)
}

/// Changes what is said of the whole tree, and what was said by hand is still there.
fn survives(document: &mut Document, key: Key) {
    check_wood(document);
    let (_, node) = limb(document);
    let said = in_force(document).graph().setting(node, key).map(|(_, said)| said.clone());
    assert!(said.is_some(), "{key} is said of the limb");
    for count in [5.0, 4.0] {
        apply(document, &edits(None, &[set("/", "density", &json!([[0, count], [1, count]]))]));
        check_wood(document);
        assert_eq!(in_force(document).graph().setting(node, key).map(|(_, said)| said.clone()), said);
    }
}

#[test]
fn ds7_turned_wood_is_said_in_the_design() {
    let mut document = designed();
    let (rows, _) = limb(&document);
    let turn = |angle: f32| {
        let rotation = UnitRotation::nearest(Quat::from_rotation_z(angle));
        in_gesture(Some(3), Action::TurnBranch { row: rows[0], rotation })
    };
    let tip = MetamerId::new(rows[rows.len() - 1] as usize);
    let base = document.plant().metamers().parent(MetamerId::new(rows[0] as usize)).expect("it is borne");
    let base = document.plant().metamers().end(base);
    let before = document.plant().metamers().end(tip);
    apply(&mut document, &turn(0.1));
    apply(&mut document, &turn(0.3));
    assert_eq!(kinds(&document).len(), 2, "one gesture, one operation");
    let (after, _) = limb(&document);
    let tip = document.plant().metamers().end(MetamerId::new(after[after.len() - 1] as usize));
    let wanted = base + Quat::from_rotation_z(0.3) * (before - base);
    assert!(tip.distance(wanted) < 0.6, "{tip} is not near {wanted}");
    survives(&mut document, Key::Turn);
}

#[test]
fn ds7_bent_wood_is_said_in_the_design() {
    let mut document = designed();
    let (rows, _) = limb(&document);
    let end = rows[rows.len() - 1];
    let target = document.plant().metamers().end(MetamerId::new(end as usize)) + Vec3::new(0.0, 1.5, 0.5);
    apply(
        &mut document,
        &plain(Action::BendBegin {
            bend: 1,
            base: rows[0],
            touches: held(vec![end]),
            stretch: Share::nearest(0.0),
        }),
    );
    apply(&mut document, &plain(Action::BendMove { bend: 1, targets: places(vec![target]) }));
    apply(&mut document, &plain(Action::BendEnd { bend: 1 }));
    let (after, _) = limb(&document);
    let tip = document.plant().metamers().end(MetamerId::new(after[after.len() - 1] as usize));
    assert!(tip.distance(target) < 1.0, "{tip} is not near {target}");
    survives(&mut document, Key::Axis);
}

#[test]
fn ds7_widened_and_cut_wood_is_said_in_the_design() {
    let mut document = designed();
    let (rows, node) = limb(&document);
    apply(&mut document, &plain(Action::SetWidth { row: rows[1], diameter: Some(Diameter::nearest(0.3)) }));
    let (after, _) = limb(&document);
    let given = document.plant().given_radius(MetamerId::new(after[1] as usize));
    assert!(given.is_some_and(|radius| (radius - 0.15).abs() < 0.02), "{given:?}");
    survives(&mut document, Key::Girth);
    let row = limb(&document).0[1];
    apply(&mut document, &plain(Action::SetWidth { row, diameter: None }));
    assert!(in_force(&document).graph().setting(node, Key::Girth).is_none());
    let count = document.metamers();
    let rows = list(vec![limb(&document).0[0]]);
    apply(&mut document, &plain(Action::Prune { rows }));
    assert!(document.metamers() < count);
    survives(&mut document, Key::Shown);
}

#[test]
fn ds10_a_design_takes_the_place_of_what_grew_and_undo_brings_that_back() {
    let mut document = tree();
    apply(&mut document, &plain(Action::PlantSeed { position: Position::nearest(Vec3::X * 40.0) }));
    let grown = wood(&document);
    let living = document.metamers();
    let fit = |row| plain(Action::FitDesign { row, orders: None });
    apply(&mut document, &fit(None));
    check_wood(&document);
    assert_eq!(kinds(&document).last(), Some(&espalier_proto::OperationKind::Design));
    let told = document.design_told().expect("it is in force");
    assert!(told.overlap.is_some_and(|overlap| (0.5..=1.0).contains(&overlap)), "{:?}", told.overlap);
    assert!(document.metamers() < 4 * living && told.steps_on_top == 0);
    assert_eq!(told.at, Position::nearest(document.plant().metamers().end(MetamerId::new(0))));
    let seeds = (0..document.plant().metamer_count()).map(MetamerId::new);
    let seeds = seeds.filter(|&id| document.plant().is_seed(id) && document.plant().is_alive(id));
    assert_eq!(seeds.count(), 3, "that of the design, the bare one below it, and the other one");
    // What is changed stays one step, in which nothing of what grew comes back.
    let fitted = wood(&document);
    apply(&mut document, &edits(None, &[set("/", "height", &json!(9))]));
    check_wood(&document);
    assert_eq!(document.design_told().and_then(|told| told.overlap), None, "it is another one now");
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!(wood(&document), fitted);
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!((wood(&document), document.design_told()), (grown.clone(), None));
    apply(&mut document, &plain(Action::Redo {}));
    assert_eq!(wood(&document), fitted);
    // It is kept with the document, and goes on from there.
    let bytes = document.to_bytes();
    let mut kept = Document::from_bytes(&bytes).expect("it is whole");
    apply(&mut kept, &edits(None, &[set("/", "height", &json!(11))]));
    check_wood(&kept);
    apply(&mut kept, &plain(Action::Undo {}));
    apply(&mut kept, &plain(Action::Undo {}));
    assert_eq!(wood(&kept), grown);
}

#[test]
fn ds10_a_fitted_design_is_taken_back_by_its_author_alone() {
    let mut document = tree();
    let grown = wood(&document);
    let fit = plain(Action::FitDesign { row: Some(1), orders: None });
    document.apply(&who("bo"), &fit).expect("it fits");
    document
        .apply(&who("cy"), &plain(Action::PlantSeed { position: Position::nearest(Vec3::X * 40.0) }))
        .expect("it is free");
    document.apply(&who("bo"), &plain(take_back_by(&[]))).expect("nobody built on it");
    let others = wood(&document);
    assert!(others.starts_with(&grown) || grown.iter().all(|row| others.contains(row)), "what grew is back");
    assert_eq!(document.design_told(), None);
}

#[test]
fn ds10_nothing_happens_until_the_last_trial_and_nothing_after_a_stop() {
    let document = tree();
    let before = (wood(&document), document.history.done);
    let fit = plain(Action::FitDesign { row: None, orders: None });
    let mut whole = document.clone();
    whole.begin(&who("ann"), &fit).expect("it fits");
    let mut trials = 0;
    while whole.is_undecided() {
        assert_eq!((wood(&whole), whole.history.done), before);
        let figures = whole.figures();
        assert!(figures.trials > 0 && figures.pending_steps == figures.trials, "{figures:?}");
        assert!(whole.advance());
        trials += 1;
    }
    assert_eq!((whole.take_outcome(), whole.advance()), (Ok(()), false));
    assert!(trials > 10 && whole.design_told().is_some(), "{trials} trials");
    for taken in [0, 1, 7, trials - 1] {
        let mut stopped = document.clone();
        stopped.begin(&who("ann"), &fit).expect("it fits");
        (0..taken).for_each(|_| assert!(stopped.advance()));
        stopped.stop_at(Some(stopped.steps_begun()));
        while stopped.advance() {}
        assert_eq!(stopped.take_outcome().map_err(|problem| problem.reason), Err(Reason::FitStopped));
        assert_eq!(((wood(&stopped), stopped.history.done), stopped.design_told()), (before.clone(), None));
    }
}

#[test]
fn ds10_a_stub_has_a_design_that_can_be_read_again() {
    for length in [0.02, 0.3, 0.9, 3.0] {
        let node = |row: u8| WoodNode {
            parent: (row > 0).then_some(0),
            axis: 0,
            end: Vec3::Y * (f32::from(row) * length),
            normal: None,
            radius: (row > 0).then_some(0.1),
            birth: row.into(),
        };
        let trunk = WoodAxis { bearer: None, direction: None, has_bud: true };
        let wood = Wood { nodes: vec![node(0), node(1)], axes: vec![trunk], ..Wood::default() };
        let like = Document::new(7);
        let document = Document::transplanted(&wood, 7, &like.parameters(), *like.appearance());
        let mut document = document.expect("it fits together");
        apply(&mut document, &plain(Action::FitDesign { row: Some(0), orders: None }));
        check_wood(&document);
        assert!(Document::from_bytes(&document.to_bytes()).is_ok(), "{length}");
    }
}

#[test]
fn ds10_what_no_design_describes_is_refused() {
    let mut document = Document::new(7);
    let fit = |row| plain(Action::FitDesign { row, orders: None });
    assert_eq!(problem(&mut document, &fit(None)).reason, Reason::DesignRefused);
    assert_eq!(
        problem(&mut document, &fit(Some(0))).reason,
        Reason::DesignRefused,
        "nothing has grown on it"
    );
    assert_eq!(problem(&mut document, &fit(Some(9999))).reason, Reason::BranchGone);
    let mut document = tree();
    apply(&mut document, &plain(Action::StrokeBegin { stroke: 1, bud: None }));
    assert_eq!(problem(&mut document, &fit(None)).reason, Reason::BeingDrawn);
}

#[test]
fn ds5_nothing_is_read_that_no_document_has() {
    let document = designed();
    let design = document.design_in_force().expect("there is one");
    let mut broken = document.clone();
    for (text, step) in [("{}".to_owned(), 1), (design.text.clone(), 9), (design.text.clone(), 0)] {
        let of = Designed { text, step, ..Designed::clone(design) };
        broken.history.operations[0].after.design = Some(Arc::new(of));
        broken.designs = Designs::default();
        assert!(Document::from_bytes(&broken.to_bytes()).is_err());
    }
}

#[test]
fn lm21_edits_and_values_have_bounds() {
    let edit = set("/", "height", &json!(9));
    let many = json!({ "kind": "edit_design", "edits": vec![edit; 65] });
    let long: Vec<[f32; 2]> = (0..40_000).map(|at| [at as f32, 1.0]).collect();
    let long = json!({ "kind": "edit_design", "edits": [set("/", "density", &json!(long))] });
    let graph = json!({ "kind": "new_design", "graph": { "text": "x".repeat(200_000) } });
    for (command, field) in [(many, "edits"), (long, "edits[0].value.own"), (graph, "graph")] {
        let problem = Command::from_json(&command.to_string()).expect_err("it is too much");
        assert_eq!(problem.field.as_deref(), Some(field), "{problem}");
    }
    // What the history holds of designs is counted as text, each design once.
    let mut document = designed();
    let first = crate::document::designing::held_bytes(&document.history.operations);
    grow(&mut document, 1, None);
    assert_eq!(crate::document::designing::held_bytes(&document.history.operations), first);
    assert_eq!(first, document.design_in_force().expect("there is one").text.len());
}

#[test]
fn ds5_a_design_and_what_grows_on_it_come_to_the_same_on_however_many_threads() {
    let played = || {
        let mut document = designed();
        for what in 0..6 {
            apply(&mut document, &say(what, 0.75, None));
        }
        grow(&mut document, 3, None);
        (document.hash(), wood(&document))
    };
    let [one, eight] = [1, 8].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("there are threads");
        pool.install(played)
    });
    assert_eq!(one, eight);
}
