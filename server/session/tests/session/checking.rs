//! `CK`: how a client learns that its rows are those of the server.

use espalier_proto::ServerMessage;
use serde_json::json;

use crate::{
    flow::leave_behind,
    mirror::Row,
    world::{Peer, World, grow},
};

/// A sum that was told: the frame, how many rows, CRC-32, the hash of the plants.
type Sum = (u32, u32, u32, String);

fn sums(peer: &Peer) -> Vec<Sum> {
    let sum = |text: &ServerMessage| match text {
        ServerMessage::Checksum { sequence, rows, crc32, plant } => {
            Some((*sequence, *rows, *crc32, plant.clone()))
        }
        _ => None,
    };
    peer.texts.iter().filter_map(sum).collect()
}

/// What a client makes of its own rows, from the protocol's text alone.
fn crc32(rows: &[Row]) -> u32 {
    let mut bytes = Vec::new();
    for (row, it) in rows.iter().enumerate() {
        let link = it.parent.map_or(0, |parent| 2 * (row as u32 - parent) + u32::from(it.begins_axis));
        bytes.extend(link.to_le_bytes());
        it.position.iter().for_each(|x| bytes.extend(x.to_le_bytes()));
        bytes.extend(it.radius.to_le_bytes());
        bytes.extend(if it.radius == 0 { [0, 0] } else { [it.foliage, it.light] });
        bytes.extend(it.born.to_le_bytes());
    }
    crc32fast::hash(&bytes)
}

fn own(peer: &Peer) -> (u32, u32, u32) {
    let rows = &peer.mirror.rows;
    (peer.mirror.sequence.unwrap(), rows.len() as u32, crc32(rows))
}

/// What was told, without the plants.
fn told(peer: &Peer) -> Vec<(u32, u32, u32)> {
    sums(peer).into_iter().map(|(sequence, rows, crc32, _)| (sequence, rows, crc32)).collect()
}

fn check(world: &mut World, client: u64) {
    world.send(client, &json!({ "type": "check" }));
}

#[test]
fn ck1_the_sum_is_that_of_the_rows_that_clients_hold() {
    let mut world = World::new();
    let (birch, maple) = (world.join("birch-01"), world.join("maple-01"));
    world.command(birch, 1, grow(12));
    world.settle();
    world.command(birch, 2, json!({ "kind": "prune", "rows": [40] }));
    world.command(birch, 3, json!({ "kind": "ungrow", "steps": 2 }));
    world.settle();
    check(&mut world, maple);
    world.settle();
    assert_eq!(told(world.peer(maple)), [own(world.peer(maple))]);
    assert!(world.peer(maple).mirror.rows.len() > 256, "more than a chunk");
    assert_eq!(sums(world.peer(birch)), [], "who does not ask is told nothing");
}

#[test]
fn ck1_the_sum_comes_once_nothing_is_under_way_and_once_a_second_at_most() {
    let mut world = World::new();
    world.work_ms = 40;
    let client = world.join("birch-01");
    world.command(client, 1, grow(30));
    check(&mut world, client);
    check(&mut world, client);
    world.pass(200);
    assert_eq!(sums(world.peer(client)), [], "it grows");
    world.settle();
    assert_eq!(sums(world.peer(client)).len(), 1, "one answer for both");
    let first = world.now;
    for _ in 0..20 {
        check(&mut world, client);
        world.pass(50);
    }
    let told_since = sums(world.peer(client)).len() - 1;
    assert!((1..=2).contains(&told_since), "{told_since} in {} ms", world.now - first);
    world.settle();
    assert_eq!(told(world.peer(client)).last(), Some(&own(world.peer(client))));
}

#[test]
fn ck1_a_client_that_holds_less_is_told_once_it_has_caught_up() {
    let mut world = World::new();
    let (busy, slow) = (world.join("birch-01"), world.join("maple-01"));
    leave_behind(&mut world, busy, slow);
    check(&mut world, slow);
    world.pass(5000);
    let held = world.peer(slow).mirror.rows.len();
    assert!(held < world.document().plant().metamer_count(), "its window is closed");
    assert_eq!(sums(world.peer(slow)), [], "what it holds is known to be old");
    world.peer_mut(slow).slow = false;
    world.answer_frames(slow);
    world.settle();
    assert_eq!(told(world.peer(slow)), [own(world.peer(slow))]);
}

#[test]
fn ck1_after_a_crash_rows_look_as_they_did() {
    let mut world = World::new();
    let client = world.join("birch-01");
    let at = |x: f32| json!({ "position": [x, 9.0, 0.0], "radius": 2.0 });
    let commands = [
        grow(14),
        json!({ "kind": "stroke_begin", "stroke": 1 }),
        json!({ "kind": "stroke_move", "stroke": 1, "samples": [at(2.0), at(12.0)] }),
        json!({ "kind": "stroke_end", "stroke": 1 }),
        json!({ "kind": "prune", "rows": [60] }),
        json!({ "kind": "ungrow", "steps": 2 }),
        grow(3),
    ];
    for (id, command) in (1..).zip(commands) {
        world.command(client, id, command);
        world.settle();
    }
    let sum = |world: &mut World, client| {
        world.pass(3000);
        check(world, client);
        world.settle();
        sums(world.peer(client)).pop().map(|(_, rows, crc32, plant)| (rows, crc32, plant))
    };
    let before = sum(&mut world, client);
    assert!(before.is_some());
    world.crash();
    let again = world.join("birch-01");
    world.settle();
    assert_eq!(sum(&mut world, again), before);
}

#[test]
fn ck2_equal_plants_have_one_hash_however_they_came_to_clients() {
    let grown = |splits: &[u32]| {
        let mut world = World::new();
        let client = world.join("birch-01");
        for (id, &steps) in (1..).zip(splits) {
            world.command(client, id, grow(steps));
            world.settle();
        }
        check(&mut world, client);
        world.settle();
        let hash = world.document().plant().hash();
        let told = sums(world.peer(client));
        assert_eq!(told[0].3, format!("{hash:016x}"));
        told[0].3.clone()
    };
    assert_eq!(grown(&[9]), grown(&[4, 5]));
    assert_ne!(grown(&[9]), grown(&[8]));
}
