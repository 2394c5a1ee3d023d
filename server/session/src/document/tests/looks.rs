//! Looks: changed, joined with parameters, taken back, kept.

use espalier_proto::OperationKind;
use espalier_settings::{
    Appearance, AppearancePatch, BarkKind, BarkLook, FlowerLook, LeafKind, LeafLook, LeafPatch,
};

use super::*;

/// Another season of the leaves as they are by default.
pub fn season(gesture: Option<u32>, season: f32) -> Command {
    let leaves = LeafLook { season, ..Appearance::default().leaves };
    look(gesture, AppearancePatch { leaves: Some(leaves.into()), ..AppearancePatch::default() })
}

fn look(gesture: Option<u32>, appearance: AppearancePatch) -> Command {
    in_gesture(gesture, Action::SetAppearance { appearance })
}

fn kinds(document: &Document) -> Vec<OperationKind> {
    document.timeline().operations.iter().map(|operation| operation.kind).collect()
}

fn apply(document: &mut Document, action: &Command) {
    document.apply(&who("ann"), action).expect("it is done");
}

#[test]
fn ap1_looks_change_section_by_section() {
    let mut document = Document::new(1);
    let bark = BarkLook { kind: BarkKind::Papery, ..Appearance::default().bark };
    let patch = AppearancePatch { bark: Some(bark.into()), ..AppearancePatch::default() };
    apply(&mut document, &look(None, patch));
    let looks = *document.appearance();
    assert_eq!((looks.bark.kind, looks.leaves.shape), (BarkKind::Papery, LeafKind::Ovate));
    let before = document.hash();
    apply(&mut document, &look(None, patch));
    assert_eq!(document.hash(), before, "what is so already is no operation");
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!(*document.appearance(), Appearance::default());
    assert!(!document.figures().can_undo && document.figures().can_redo);
    apply(&mut document, &plain(Action::Redo {}));
    assert_eq!(*document.appearance(), looks);
}

#[test]
fn ap1_what_is_out_of_range_names_its_section() {
    let flowers = |size| {
        let flowers = FlowerLook { size, ..Appearance::default().flowers };
        AppearancePatch { flowers: Some(flowers.into()), ..AppearancePatch::default() }
    };
    let mut document = Document::new(1);
    for good in [0.05, 2.0] {
        apply(&mut document, &look(None, flowers(good)));
    }
    for bad in [0.04, 2.1, f32::NAN, f32::INFINITY] {
        let problem = problem(&mut document, &look(None, flowers(bad)));
        assert_eq!(problem.field.as_deref(), Some("appearance.flowers.size"));
        assert_eq!(problem.allowed.as_deref(), Some("0.05 to 2"));
        assert!(problem.message.starts_with("appearance.flowers.size is "), "{problem}");
    }
}

#[test]
fn ap2_a_drag_is_one_operation() {
    let mut document = Document::new(1);
    for value in [1.2, 1.6, 2.0] {
        apply(&mut document, &season(Some(4), value));
    }
    apply(&mut document, &season(Some(5), 2.5));
    apply(&mut document, &season(None, 2.7));
    apply(&mut document, &season(None, 2.8));
    assert_eq!(kinds(&document), [OperationKind::Appearance; 4]);
    for value in [2.7, 2.5, 2.0, 1.0] {
        apply(&mut document, &plain(Action::Undo {}));
        assert_eq!(document.appearance().leaves.season, value);
    }
    assert!(document.apply(&who("ann"), &plain(Action::Undo {})).is_err());
}

#[test]
fn ap2_a_species_is_picked_in_one_operation() {
    let mut document = Document::new(1);
    let seedling = document.parameters();
    apply(&mut document, &season(Some(1), 2.0));
    apply(&mut document, &patch_in(Some(1), 0.5));
    apply(&mut document, &season(Some(1), 2.2));
    assert_eq!(kinds(&document), [OperationKind::Parameters], "what changes growth gives the name");
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!((document.parameters(), *document.appearance()), (seedling, Appearance::default()));
    apply(&mut document, &plain(Action::Redo {}));
    assert_eq!((document.parameters().apical_control, document.appearance().leaves.season), (0.5, 2.2));
}

#[test]
fn ap2_what_others_do_parts_a_gesture() {
    let mut document = Document::new(1);
    apply(&mut document, &season(Some(1), 2.0));
    document.apply(&who("ben"), &season(Some(1), 2.4)).expect("it is done");
    apply(&mut document, &season(Some(1), 2.8));
    assert_eq!(kinds(&document).len(), 3);
    grow(&mut document, 1, None);
    apply(&mut document, &season(Some(1), 2.9));
    assert_eq!(kinds(&document).len(), 5);
}

#[test]
fn ap2_a_drag_back_to_its_start_is_nothing() {
    let mut document = Document::new(1);
    grow(&mut document, 3, None);
    let grown = document.plant().hash();
    apply(&mut document, &plain(Action::Undo {}));
    apply(&mut document, &season(Some(1), 2.0));
    assert_eq!(document.timeline().futures.len(), 1, "what lay ahead is a future");
    apply(&mut document, &season(Some(1), 1.0));
    assert_eq!(kinds(&document), [OperationKind::Growth]);
    assert!(document.timeline().futures.is_empty() && !document.figures().can_undo);
    apply(&mut document, &plain(Action::Redo {}));
    assert_eq!(document.plant().hash(), grown, "it lies ahead again");
}

#[test]
fn looks_follow_the_line_of_time() {
    let mut document = Document::new(3);
    grow(&mut document, 4, None);
    apply(&mut document, &season(None, 2.0));
    grow(&mut document, 4, None);
    let season_at = |document: &mut Document, step| {
        apply(document, &plain(Action::GoTo { step }));
        document.appearance().leaves.season
    };
    assert_eq!([2, 8, 3].map(|step| season_at(&mut document, step)), [1.0, 2.0, 1.0]);
    apply(&mut document, &plain(Action::GoTo { step: 8 }));
    apply(&mut document, &plain(Action::Ungrow { steps: Steps::nearest(6) }));
    assert_eq!(document.appearance().leaves.season, 2.0, "CM7: ungrowing keeps looks");
    grow(&mut document, 1, None);
    assert_eq!(kinds(&document)[1..], [OperationKind::Appearance, OperationKind::Growth]);
    let future = document.timeline().futures[0].future;
    apply(&mut document, &season(None, 3.0));
    apply(&mut document, &plain(Action::TakeFuture { future }));
    assert_eq!((document.plant().step(), document.appearance().leaves.season), (8, 2.0));
}

#[test]
fn looks_are_saved_with_the_tree() {
    let mut document = Document::new(3);
    grow(&mut document, 3, None);
    apply(&mut document, &season(Some(2), 2.0));
    let kept = Document::from_bytes(&document.to_bytes()).expect("it can be read");
    assert_eq!((kept.hash(), kept.appearance()), (document.hash(), document.appearance()));
    let mut saved = Document::from_bytes(&document.to_saved_bytes()).expect("it can be read");
    assert_eq!(saved.appearance().leaves.season, 2.0);
    // A drag goes on where it was.
    apply(&mut saved, &season(Some(2), 2.5));
    apply(&mut saved, &plain(Action::Undo {}));
    assert_eq!(*saved.appearance(), Appearance::default());
}

#[test]
fn looks_make_no_difference_to_growth() {
    let mut plain = Document::new(6);
    let mut seasoned = plain.clone();
    apply(&mut seasoned, &season(None, 3.0));
    for document in [&mut plain, &mut seasoned] {
        grow(document, 6, None);
    }
    assert_eq!(plain.plant().hash(), seasoned.plant().hash());
    assert_ne!(plain.hash(), seasoned.hash());
}

#[test]
fn ap1_fields_of_two_people_both_count() {
    let mut document = Document::new(1);
    let season = LeafPatch { season: Some(2.0), ..LeafPatch::default() };
    let tint = LeafPatch { tint: Some([10, 20, 30]), ..LeafPatch::default() };
    for (author, leaves) in [("ann", season), ("ben", tint)] {
        let patch = AppearancePatch { leaves: Some(leaves), ..AppearancePatch::default() };
        document.apply(&who(author), &look(None, patch)).expect("it is done");
    }
    let leaves = document.appearance().leaves;
    assert_eq!((leaves.season, leaves.tint), (2.0, [10, 20, 30]));
    assert_eq!(leaves.shape, LeafKind::Ovate, "what nobody gave stays");
}
