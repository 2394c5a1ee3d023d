//! Back and forth in a tree of 100k metamers, each journey ending with one frame; and the tree as bytes and back.

mod support;

use std::time::Instant;

use espalier_proto::{Action, Steps};
use espalier_session::Document;
use support::{Cost, Followed, Percentiles, report};

const METAMERS: u32 = 100_000;
/// Steps back at a time, one by one.
const STEPS: u32 = 8;
const ROUNDS: u32 = 12;

fn main() {
    support::on_the_pool(bench);
}

fn bench() {
    let mut tree = Followed::tree(METAMERS);
    let each = Action::Ungrow { steps: Steps::nearest(1) };
    travel(&mut tree, "ungrow, one step", STEPS, &each, &Action::Redo {});
    travel(&mut tree, "undo, one operation of one step", STEPS, &Action::Undo {}, &Action::Redo {});
    travel(
        &mut tree,
        "ungrow, eight steps at once",
        1,
        &Action::Ungrow { steps: Steps::nearest(STEPS) },
        &Action::Redo {},
    );
    write_and_read(&tree.document);
}

/// The document as bytes and back.
fn write_and_read(document: &Document) {
    let bytes = document.to_bytes();
    let timed = |act: &dyn Fn()| {
        Percentiles::of_milliseconds((0..ROUNDS).map(|_| {
            let begun = Instant::now();
            act();
            begun.elapsed()
        }))
    };
    println!("the document, {} bytes, in {ROUNDS} rounds       median       p99      most", bytes.len());
    println!("  written, ms                  {}", timed(&|| drop(document.to_bytes())));
    println!("  read, ms                     {}", timed(&|| drop(Document::from_bytes(&bytes))));
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
