//! Shaping a tree of 100k metamers by hand: bends, cuts, and scrubbing through growth and edits.

mod support;

use std::time::Instant;

use espalier_plant::MetamerId;
use espalier_proto::{Action, Diameter, List, Position, Share, Steps, Touches, UnitRotation};
use espalier_session::{Document, Principal};
use glam::{Quat, Vec3};
use support::{Cost, Followed, Percentiles, report, sample};

const METAMERS: u32 = 100_000;
const ROUNDS: usize = 8;

fn main() {
    support::on_the_pool(bench);
}

fn bench() {
    bend_events();
    let mut tree = Followed::tree(METAMERS);
    edits(&mut tree);
    scrub(&mut tree);
}

/// Pointer events of a bend whose path has a thousand internodes.
fn bend_events() {
    let mut document = Document::new(1);
    let mut apply = |action: Action| {
        document.apply(&Principal::visitor(), &action.into()).expect("the action can be done")
    };
    apply(Action::StrokeBegin { stroke: 1, bud: None });
    for part in 0..20 {
        let samples: Vec<_> =
            (0..=10).map(|i| sample(Vec3::Y * (50.0 * part as f32 + 5.0 * i as f32), 0.0)).collect();
        apply(Action::StrokeMove { stroke: 1, samples: List::try_from(samples).expect("eleven") });
    }
    apply(Action::StrokeEnd { stroke: 1 });
    let path = longest_path(&document);
    let length = (path.len() - 2).min(1000);
    let (top, middle, base) = (path[0], path[length / 2], path[length]);
    let place = document.plant().metamers().end(top);
    let between = document.plant().metamers().end(middle);
    let touches = vec![top.raw(), middle.raw()];
    let begin = Action::BendBegin {
        bend: 1,
        base: base.raw(),
        touches: Touches::try_from(touches).expect("two rows"),
        stretch: Share::nearest(0.1),
    };
    document.apply(&Principal::visitor(), &begin.into()).expect("it is a path");
    let mut costs = Vec::new();
    for event in 0..240 {
        let angle = 0.02 * event as f32;
        let shift = Vec3::new(libm::sinf(angle), -0.3 * (1.0 - libm::cosf(angle)), 0.0) * 0.4 * length as f32;
        let targets = vec![Position::nearest(place + shift), Position::nearest(between + 0.3 * shift)];
        let targets = List::try_from(targets).expect("two places");
        let begun = Instant::now();
        document
            .apply(&Principal::visitor(), &Action::BendMove { bend: 1, targets }.into())
            .expect("it is in progress");
        costs.push(begun.elapsed());
    }
    println!("bend event, {length} internodes, ms    {}", Percentiles::of_milliseconds(costs.into_iter()));
    let begun = Instant::now();
    document
        .apply(&Principal::visitor(), &Action::BendEnd { bend: 1 }.into())
        .expect("it stays in the world");
    println!("bend let go, {length} internodes, ms   {:.2}", 1e3 * begun.elapsed().as_secs_f64());
}

/// One edit, taken back and done again in several rounds.
fn edits(tree: &mut Followed) {
    let path = longest_path(&tree.document);
    let (top, limb) = (path[0].raw(), path[path.len() / 2].raw());
    let rotation = Quat::from_xyzw(0.0, 0.1, 0.0, 0.995).normalize();
    for (title, action) in [
        ("prune", Action::Prune { rows: List::of(limb) }),
        ("prune_dim", Action::PruneDim { exposure: Share::nearest(0.2) }),
        ("turn_branch", Action::TurnBranch { row: limb, rotation: UnitRotation::nearest(rotation) }),
        ("set_width", Action::SetWidth { row: limb, diameter: Some(Diameter::nearest(1.0)) }),
        (
            "graft",
            Action::Graft { row: top, onto: limb, rotation: UnitRotation::nearest(rotation), keep: true },
        ),
    ] {
        let (mut done, mut undone): (Vec<Vec<Cost>>, Vec<Vec<Cost>>) = (Vec::new(), Vec::new());
        let mut changed = 0;
        for _ in 0..ROUNDS {
            let before = tree.document.metamers();
            done.push(vec![tree.act(&action)]);
            changed = tree.document.metamers().abs_diff(before);
            undone.push(vec![tree.act(&Action::Undo {})]);
        }
        report(title, &done, &[changed]);
        report(&format!("{title}, undone"), &undone, &[changed]);
    }
}

/// Back and forth, step by step, through growth with an edit after each third step.
fn scrub(tree: &mut Followed) {
    let path = longest_path(&tree.document);
    let rotation = Quat::from_xyzw(0.0, 0.02, 0.0, 1.0).normalize();
    let top = tree.document.plant().step();
    for round in 0..4 {
        let row = path[path.len() * (round + 1) / 6].raw();
        tree.act(&Action::TurnBranch { row, rotation: UnitRotation::nearest(rotation) });
        tree.act(&Action::SetWidth { row, diameter: Some(Diameter::nearest(0.5)) });
        tree.act(&Action::Grow { steps: Steps::nearest(1), until: None, bud: None });
    }
    let last = tree.document.plant().step();
    let first = top.saturating_sub(6);
    for (way, steps) in
        [("back", (first..last).rev().collect::<Vec<_>>()), ("forth", (first + 1..=last).collect())]
    {
        let mut rounds = Vec::new();
        let mut metamers = Vec::new();
        for _ in 0..ROUNDS {
            tree.act(&Action::GoTo { step: if way == "back" { last } else { first } });
            metamers.clear();
            let mut costs = Vec::new();
            for &step in &steps {
                let before = tree.document.metamers();
                costs.push(tree.act(&Action::GoTo { step }));
                metamers.push(tree.document.metamers().abs_diff(before));
            }
            rounds.push(costs);
        }
        report(&format!("scrub {way}, {} metamers", tree.document.metamers()), &rounds, &metamers);
    }
}

/// From the living metamer that stands on the most others down to its trunk's foot.
fn longest_path(document: &Document) -> Vec<MetamerId> {
    let plant = document.plant();
    let mut height = vec![0u32; plant.metamer_count()];
    let mut top = MetamerId::new(0);
    for id in (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id)) {
        if let Some(parent) = plant.metamers().parent(id) {
            height[id.index()] = height[parent.index()] + 1;
        }
        if height[id.index()] > height[top.index()] {
            top = id;
        }
    }
    let down = std::iter::successors(Some(top), |&id| plant.metamers().parent(id));
    down.take_while(|&id| !plant.is_seed(id)).collect()
}
