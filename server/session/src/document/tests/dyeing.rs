//! Colours that designs say of branches, on their rows.

use espalier_design::{Generator, MAX_INTERNODES, NodeId};
use espalier_mesh::Dye;
use serde_json::{Value, json};

use super::{
    designing::{begin, designed, edits, in_force, new_design, set, small},
    *,
};

fn material(of: &str, bark: f32, leaves: f32) -> Value {
    set(of, "material", &json!({ "bark": [bark, 1, 1], "leaves": [1, leaves, 1] }))
}

/// The reds of bark and the greens of leaves of all rows.
fn seen(document: &mut Document) -> Vec<[f32; 2]> {
    let style = document.style();
    let rows = 0..document.plant().metamer_count();
    rows.map(|row| style.dyes().of(MetamerId::new(row))).map(|dye| [dye.bark.x, dye.leaves.y]).collect()
}

/// What the branches of the design in force have, by the rows of its wood, which are the last of the plant.
fn wanted(document: &Document) -> Vec<[f32; 2]> {
    let design = in_force(document);
    let generated = Generator::default().generate(&design, MAX_INTERNODES);
    let of_node = |node: NodeId| {
        let material =
            design.branch(node).expect("it stands").values().material(espalier_design::Key::Material);
        [material.bark[0], material.leaves[1]]
    };
    let rows = 0..generated.wood.nodes.len() as u32;
    let of_row = |row: u32| generated.wood.nodes[row as usize].axis as usize;
    rows.map(|row| of_node(generated.placed[of_row(row)].node)).collect()
}

fn plain_rows(document: &mut Document) -> bool {
    seen(document).iter().all(|&colours| colours == [1.0, 1.0])
}

#[test]
fn ds14_rows_have_the_colours_of_their_branches() {
    let mut document = designed();
    assert!(plain_rows(&mut document) && document.dyes().are_none());
    apply(&mut document, &edits(None, &[material("level 1", 0.5, 2.0), material("/1", 3.0, 1.0)]));
    let (all, wanted) = (seen(&mut document), wanted(&document));
    assert_eq!(all[all.len() - wanted.len()..], wanted);
    for colours in [[1.0, 1.0], [0.5, 2.0], [3.0, 1.0]] {
        assert!(wanted.iter().filter(|&&has| has == colours).count() > 3, "{colours:?}");
    }
    assert!(all[..all.len() - wanted.len()].iter().all(|&colours| colours == [1.0, 1.0]));
    let dyes = document.dyes();
    assert_eq!(dyes.all().len(), 2);
    // The wood itself has not changed, and undo takes the colours alone.
    apply(&mut document, &plain(Action::Undo {}));
    assert!(plain_rows(&mut document));
    apply(&mut document, &plain(Action::Redo {}));
    assert_eq!(document.dyes(), dyes);
    let mut copy = Document::from_bytes(&document.to_bytes()).expect("our own bytes");
    assert_eq!(copy.dyes(), dyes);
}

#[test]
fn ds14_what_grows_on_a_branch_has_its_colours_and_keeps_them_when_the_design_is_let_go() {
    let mut document = designed();
    apply(&mut document, &edits(None, &[material("/", 0.25, 4.0)]));
    let first = document.plant().metamer_count();
    grow(&mut document, 3, None);
    let all = seen(&mut document);
    let plant = document.plant();
    let on_top: Vec<usize> = (first..all.len())
        .filter(|&row| {
            let parent = plant.metamers().parent(MetamerId::new(row));
            parent.is_some_and(|parent| all[parent.index()] == [0.25, 4.0])
        })
        .collect();
    assert!(on_top.len() > 3 && on_top.iter().all(|&row| all[row] == [0.25, 4.0]));

    apply(&mut document, &plain(Action::ReleaseDesign {}));
    assert_eq!((document.design_told(), seen(&mut document)), (None, all.clone()));
    let mut copy = Document::from_bytes(&document.to_bytes()).expect("our own bytes");
    assert_eq!((copy.hash(), seen(&mut copy)), (document.hash(), all.clone()));
    // Another design beside it.
    apply(&mut document, &begin(-8.0));
    apply(&mut document, &edits(None, &[material("/", 2.0, 1.0)]));
    let both = seen(&mut document);
    assert_eq!(both[..all.len()], all);
    assert!(both[all.len()..].iter().all(|&colours| colours == [2.0, 1.0]));
    assert_eq!(document.dyes().all().len(), 2);
    let mut copy = Document::from_bytes(&document.to_bytes()).expect("our own bytes");
    assert_eq!(seen(&mut copy), both);
    // Back before it was let go, and before there was any.
    for _ in 0..3 {
        apply(&mut document, &plain(Action::Undo {}));
    }
    assert!(document.design_told().is_some());
    assert_eq!(seen(&mut document), all);
    apply(&mut document, &plain(Action::GoTo { step: 0 }));
    assert!(plain_rows(&mut document));
}

#[test]
fn ds14_more_materials_than_can_be_told_apart_are_drawn_as_the_nearest() {
    let mut document = designed();
    apply(&mut document, &edits(None, &[set("/", "density", &json!([[0, 24], [1, 24]]))]));
    let shares: Vec<f32> = (0..20u8).map(|i| 0.1 + 0.1 * f32::from(i)).collect();
    let nodes = in_force(&document);
    let branches: Vec<String> =
        nodes.root().laterals().iter().map(|branch| branch.id().to_string()).collect();
    assert!(branches.len() > 16, "{}", branches.len());
    let said: Vec<Value> =
        branches.iter().zip(&shares).map(|(branch, &share)| material(branch, share, 1.0)).collect();
    apply(&mut document, &edits(None, &said));
    let (all, wanted) = (seen(&mut document), wanted(&document));
    assert_eq!(document.dyes().all().len(), 15);
    let far = all[all.len() - wanted.len()..].iter().zip(&wanted).map(|(a, b)| (a[0] - b[0]).abs());
    assert!(far.fold(0.0, f32::max) < 0.65);
    assert!(document.dyes().all().iter().all(|dye| *dye != Dye::NONE));
}

/// A design at a place, whose bark has so much of its red.
fn red(x: f32, bark: f32) -> Command {
    let mut graph = small();
    graph["nodes"]["/"]["values"]["material"] =
        json!({ "own": { "bark": [bark, 1.0, 1.0], "leaves": [1.0, 1.0, 1.0] } });
    new_design(Some(Vec3::X * x), Some(graph))
}

/// Which reds of bark there are.
fn reds(document: &mut Document) -> Vec<f32> {
    let alive: Vec<bool> = {
        let plant = document.plant();
        (0..plant.metamer_count()).map(|row| plant.is_alive(MetamerId::new(row))).collect()
    };
    let mut reds: Vec<f32> =
        seen(document).iter().zip(alive).filter(|(_, alive)| *alive).map(|([red, _], _)| *red).collect();
    reds.sort_by(f32::total_cmp);
    reds.dedup();
    reds
}

fn act(document: &mut Document, name: &str, command: Command) {
    document.apply(&who(name), &command).expect("it is done");
}

#[test]
fn ds14_a_design_that_is_taken_back_takes_no_colours_off_others() {
    let mut document = Document::new(5);
    for (name, x, bark) in [("ann", 0.0, 0.25), ("bo", 20.0, 0.5), ("ann", -20.0, 2.0)] {
        act(&mut document, name, red(x, bark));
    }
    assert_eq!(reds(&mut document), [0.25, 0.5, 1.0, 2.0]);
    act(&mut document, "bo", plain(take_back_by(&[])));
    assert_eq!(reds(&mut document), [0.25, 1.0, 2.0]);
    act(&mut document, "bo", plain(bring_back_by(&[])));
    assert_eq!(reds(&mut document), [0.25, 0.5, 1.0, 2.0]);
    // What was let go and has another after it stays let go: what can go of Bo's is their own tree.
    act(&mut document, "bo", plain(Action::ReleaseDesign {}));
    act(&mut document, "ann", red(40.0, 3.0));
    act(&mut document, "bo", plain(take_back_by(&[])));
    assert_eq!(reds(&mut document), [0.25, 1.0, 2.0, 3.0]);
}

#[test]
fn ds14_no_more_designs_are_kept_than_documents_hold() {
    let mut document = Document::new(5);
    for number in 0..18u8 {
        let name = if number == 9 { "bo" } else { "ann" };
        act(&mut document, name, red(15.0 * f32::from(number), 0.15 + 0.1 * f32::from(number)));
    }
    let kept = document.dyes().all().len();
    assert_eq!(kept, 9, "the one in force and 8 that were let go");
    act(&mut document, "bo", plain(take_back_by(&[])));
    let mut copy = Document::from_bytes(&document.to_bytes()).expect("our own bytes");
    assert_eq!((copy.hash(), reds(&mut copy)), (document.hash(), reds(&mut document)));
}

#[test]
fn ud5_whose_design_was_let_go_does_not_lose_the_tree_for_its_last_change() {
    let mut document = Document::new(5);
    act(&mut document, "ann", begin(8.0));
    act(&mut document, "ann", edits(None, &[set("/1", "roll", &json!(40))]));
    act(&mut document, "bo", plain(Action::ReleaseDesign {}));
    let before = (document.metamers(), seen(&mut document));
    let refused = document.apply(&who("ann"), &plain(take_back_by(&[])));
    assert_eq!(refused.map_err(|problem| problem.reason), Err(Reason::DesignGone));
    assert_eq!((document.metamers(), seen(&mut document)), before);
    // Bo may have it in force again, and then Ann's change can go.
    act(&mut document, "bo", plain(take_back_by(&[])));
    act(&mut document, "ann", plain(take_back_by(&[])));
    assert_eq!(document.design_told().map(|told| told.values), Some(5));
}

#[test]
fn ds14_rows_of_another_line_have_their_own_colours() {
    let mut document = Document::new(5);
    grow(&mut document, 3, None);
    apply(&mut document, &red(20.0, 0.25));
    apply(&mut document, &plain(Action::ReleaseDesign {}));
    let (first, mark) = (seen(&mut document), document.design_mark());
    apply(&mut document, &plain(Action::GoTo { step: 1 }));
    grow(&mut document, 2, Some(2));
    apply(&mut document, &red(20.0, 0.25));
    apply(&mut document, &plain(Action::ReleaseDesign {}));
    let second = seen(&mut document);
    let future = document.timeline().futures[0].future;
    apply(&mut document, &plain(Action::TakeFuture { future }));
    assert_eq!((seen(&mut document), document.design_mark() == mark), (first, true));
    let future = document.timeline().futures[0].future;
    apply(&mut document, &plain(Action::TakeFuture { future }));
    assert_eq!(seen(&mut document), second);
}
