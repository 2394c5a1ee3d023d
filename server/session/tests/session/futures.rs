//! `TT`: going over to another line of time, and the numbers of lines.

use espalier_proto::{ProblemCode, Timeline, version::MAX_FUTURES};
use serde_json::{Value, json};

use crate::{
    shaping::{grown, timeline},
    world::World,
};

fn seed() -> Value {
    json!({ "kind": "plant_seed", "position": [5.0, 0.0, 0.0] })
}

fn lines(timeline: &Timeline) -> Vec<u32> {
    timeline.futures.iter().map(|future| future.future).collect()
}

/// Does it, and gives the hash of the plants and the lines of time.
fn then(world: &mut World, client: u64, id: u32, command: Value) -> (u64, Timeline) {
    world.command(client, id, command);
    world.settle();
    (world.document().plant().hash(), timeline(world.peer(client)))
}

#[test]
fn tt4_a_future_that_is_taken_is_the_present_line_at_its_end() {
    let (mut world, ann, bob) = grown();
    let first = world.document().plant().hash();
    world.command(ann, 2, json!({ "kind": "go_to", "step": 5 }));
    let (second, found) = then(&mut world, ann, 3, seed());
    assert_eq!((found.line, found.last_step, lines(&found)), (1, 6, vec![0]));
    // What lay ahead is a future under the number of its line, even where one stands amid that line.
    world.command(ann, 4, json!({ "kind": "go_to", "step": 3 }));
    let (hash, found) = then(&mut world, ann, 5, json!({ "kind": "take_future", "future": 0 }));
    assert_eq!((hash, found.line, found.step, found.last_step), (first, 0, 9, 9));
    assert_eq!((lines(&found), found.futures[0].from, found.futures[0].steps), (vec![1], 5, 1));
    let (hash, found) = then(&mut world, ann, 6, json!({ "kind": "take_future", "future": 1 }));
    assert_eq!((hash, found.line, found.step, lines(&found)), (second, 1, 6, vec![0]));
    // The present line is no future, and neither is a number that no line has.
    for (id, future) in [(7, 1), (8, 2), (9, u32::MAX)] {
        let (hash, found) = then(&mut world, ann, id, json!({ "kind": "take_future", "future": future }));
        assert_eq!((hash, found.line), (second, 1));
        let (refused, problem) = world.peer(ann).refused().pop().expect("it is refused");
        assert_eq!(
            (refused, problem.code, problem.field.as_deref()),
            (id, ProblemCode::NotFound, Some("future"))
        );
    }
    world.assert_mirrored(bob);
    assert_eq!(world.replayed_hash(), world.document().hash());
}

#[test]
fn tt5_lines_keep_their_numbers() {
    let (mut world, ann, _) = grown();
    assert_eq!(timeline(world.peer(ann)).line, 0, "the first line is 0");
    let mut hashes = vec![world.document().plant().hash()];
    let mut id = 1;
    let mut next = || {
        id += 1;
        id
    };
    for line in 1..4 {
        world.command(ann, next(), json!({ "kind": "go_to", "step": 9 - line }));
        let (hash, found) = then(&mut world, ann, next(), seed());
        assert_eq!((found.line, lines(&found).len()), (line, line as usize));
        hashes.push(hash);
    }
    for line in [0, 2, 1, 3, 0, 1] {
        let (hash, found) = then(&mut world, ann, next(), json!({ "kind": "take_future", "future": line }));
        assert_eq!((hash, found.line), (hashes[line as usize], line), "line {line}");
    }
    let found = timeline(world.peer(ann));
    world.crash();
    let ann = world.join("birch-01");
    world.settle();
    assert_eq!(timeline(world.peer(ann)), found, "a restart changes none");
}

#[test]
fn tt5_the_oldest_futures_are_forgotten_and_their_numbers_stay_unused() {
    let (mut world, ann, _) = grown();
    let forks = MAX_FUTURES as u32 + 3;
    for fork in 0..forks {
        world.command(ann, 2 + 2 * fork, json!({ "kind": "go_to", "step": 1 }));
        world.command(ann, 3 + 2 * fork, seed());
    }
    world.settle();
    let found = timeline(world.peer(ann));
    assert_eq!(found.line, forks);
    let mut kept = lines(&found);
    kept.sort_unstable();
    assert_eq!(kept, (3..forks).collect::<Vec<_>>(), "lines 0, 1 and 2 are the oldest");
    let (_, found) = then(&mut world, ann, 2 + 2 * forks, json!({ "kind": "take_future", "future": 0 }));
    assert_eq!(found.line, forks);
    assert_eq!(world.peer(ann).refused().pop().map(|(_, problem)| problem.code), Some(ProblemCode::NotFound));
}
