//! Back and forth in a tree of 100k metamers: each journey ends with one frame.

mod support;

use espalier_session::Action;
use support::{Cost, Followed, report};

const METAMERS: u32 = 100_000;
/// Steps back at a time, one by one.
const STEPS: u32 = 8;
const ROUNDS: u32 = 12;

fn main() {
    support::on_the_pool(bench);
}

fn bench() {
    let mut tree = Followed::tree(METAMERS);
    let each = Action::Ungrow { steps: 1 };
    travel(&mut tree, "ungrow, one step", STEPS, &each, &Action::Redo);
    travel(&mut tree, "undo, one operation of one step", STEPS, &Action::Undo, &Action::Redo);
    travel(&mut tree, "ungrow, eight steps at once", 1, &Action::Ungrow { steps: STEPS }, &Action::Redo);
}

/// Goes back so many times and forth again, round after round.
fn travel(tree: &mut Followed, title: &str, times: u32, back: &Action, forth: &Action) {
    let (mut ways_back, mut ways_forth) = (Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        let top = tree.document.plant().step();
        ways_back.push((0..times).map(|_| timed(tree, back)).unzip());
        let mut way = Vec::new();
        while tree.document.plant().step() < top {
            way.push(timed(tree, forth));
        }
        ways_forth.push(way.into_iter().unzip());
    }
    for (way, rounds) in [("back", ways_back), ("forth", ways_forth)] {
        let (costs, metamers): (Vec<Vec<Cost>>, Vec<Vec<u32>>) = rounds.into_iter().unzip();
        report(&format!("{title}, {way}"), &costs, &metamers[0]);
    }
}

/// What an action costs, and by how many living metamers the tree differs then.
fn timed(tree: &mut Followed, action: &Action) -> (Cost, u32) {
    let before = tree.document.metamers();
    let cost = tree.act(action);
    (cost, tree.document.metamers().abs_diff(before))
}
