//! `FL`: windows, catch-up, bounded memory for slow readers; and growth that is seen while it goes on.

use espalier_proto::{ChunkChange, ClientMessage, ProblemCode, ServerMessage, version::CloseCode};
use espalier_session::{ClientId, Input};
use serde_json::json;

use crate::world::{World, grow};

/// Makes the tree change until a client that answers nothing is left behind; gives the next command id.
pub fn leave_behind(world: &mut World, busy: u64, slow: u64) -> u32 {
    world.peer_mut(slow).slow = true;
    world.settle();
    let mut id = 1;
    for round in 0..2_000 {
        let command = if round % 2 == 0 { grow(12) } else { json!({ "kind": "ungrow", "steps": 12 }) };
        let before = [busy, slow].map(|client| world.peer(client).frames.len());
        world.command(busy, id, command);
        world.settle();
        id += 1;
        if world.peer(slow).frames.len() - before[1] < world.peer(busy).frames.len() - before[0] {
            return id;
        }
    }
    panic!("the window never closes");
}

#[test]
fn fl1_frames_on_the_way_are_bounded() {
    let mut world = World::new();
    let busy = world.join("birch-01");
    let slow = world.join("maple-01");
    leave_behind(&mut world, busy, slow);
    // The simulated socket asserts the limit at every frame; here: that it was really reached.
    let sent: usize = world.peer(slow).in_flight.iter().map(|(_, bytes)| bytes).sum();
    assert!(sent > 128 * 1024, "only {sent} bytes were on the way");
}

#[test]
fn fl2_an_opened_window_brings_one_catch_up() {
    let mut world = World::new();
    let busy = world.join("birch-01");
    let slow = world.join("maple-01");
    let next = leave_behind(&mut world, busy, slow);
    let stuck = world.peer(slow).frames.len();
    for id in next..next + 5 {
        world.command(busy, id, grow(3));
        world.settle();
    }
    assert_eq!(world.peer(slow).frames.len(), stuck, "nothing comes through a closed window");
    world.peer_mut(slow).slow = false;
    world.answer_frames(slow);
    world.settle();
    assert_eq!(world.peer(slow).frames.len(), stuck + 1);
    assert!(world.peer(slow).frames[stuck].catch_up);
    world.assert_mirrored(slow);
    world.assert_mirrored(busy);
}

#[test]
fn fl2_the_frame_that_did_not_fit_is_made_up_for() {
    let mut world = World::new();
    let busy = world.join("birch-01");
    let slow = world.join("maple-01");
    leave_behind(&mut world, busy, slow);
    world.peer_mut(slow).slow = false;
    world.answer_frames(slow);
    world.settle();
    world.assert_mirrored(slow);
}

#[test]
fn fl2_a_catch_up_holds_only_what_is_stale() {
    let mut world = World::new();
    let busy = world.join("birch-01");
    let mut commands = 0;
    while world.peer(busy).mirror.generations.len() < 240 {
        commands += 1;
        world.command(busy, commands, grow(3));
        world.settle();
    }
    // One frame larger than the window is on the way, so not even a small one may follow.
    let slow = world.join("maple-01");
    world.peer_mut(slow).slow = true;
    world.settle();
    assert!(world.peer(slow).most_in_flight > 256 * 1024);
    world.command(busy, commands + 1, json!({ "kind": "plant_seed", "position": [9.0, 0.0, 0.0] }));
    world.settle();
    assert_eq!(world.peer(slow).frames.len(), 1);
    world.peer_mut(slow).slow = false;
    world.answer_frames(slow);
    world.settle();
    let last_chunk = world.peer(busy).mirror.generations.len() as u32 - 1;
    assert!(last_chunk > 100);
    let [ChunkChange::Replace { chunk, .. }] = world.peer(slow).frames[1].changes.as_slice() else {
        panic!("{} changes instead of one chunk", world.peer(slow).frames[1].changes.len());
    };
    assert_eq!(*chunk, last_chunk);
    world.assert_mirrored(slow);
}

#[test]
fn fl1_received_ahead_of_time_is_a_problem() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.settle();
    world.send(client, &json!({ "type": "received", "sequence": 9_999, "kind": 1 }));
    let problems = world.peer(client).problems();
    assert_eq!(problems.len(), 1);
    assert_eq!(problems[0].code, ProblemCode::OutOfRange);
    assert_eq!(problems[0].field.as_deref(), Some("sequence"));
}

#[test]
fn fl3_a_deaf_client_is_closed() {
    let mut world = World::new();
    let deaf = world.join("birch-01");
    let other = world.join("maple-01");
    world.peer_mut(deaf).deaf = true;
    for nonce in 0..2_000 {
        if world.peer(deaf).closed.is_none() {
            world.send(deaf, &ClientMessage::Ping { nonce });
        }
    }
    assert_eq!(world.peer(deaf).closed, Some(CloseCode::TooSlow));
    assert_eq!(world.peer(deaf).unread, 1024);
    assert_eq!(world.peer(other).closed, None);
}

#[test]
fn fl3_a_client_that_reads_may_ask_forever() {
    let mut world = World::new();
    let client = world.join("birch-01");
    for nonce in 0..5_000 {
        world.send(client, &ClientMessage::Ping { nonce });
        if nonce % 500 == 0 {
            world.pass(1);
        }
    }
    assert_eq!(world.peer(client).closed, None);
}

#[test]
fn fl4_the_state_is_told_at_most_every_50_ms() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.settle();
    let states = |world: &World| {
        world.peer(client).texts.iter().filter(|text| matches!(text, ServerMessage::State { .. })).count()
    };
    // The first one follows a rest.
    let (mut seen, mut last) = (states(&world), None);
    let before = seen;
    for ms in 0..1_000 {
        world.pass(1);
        if ms % 5 == 0 {
            let command = if ms % 10 == 0 { grow(1) } else { json!({ "kind": "ungrow", "steps": 1 }) };
            world.command(client, ms / 5 + 1, command);
        }
        let now = states(&world);
        assert!(now <= seen + 1, "two at once");
        if now > seen {
            let gap = last.map_or(50, |last| ms - last);
            assert!(gap >= 50, "another after {gap} ms");
            (seen, last) = (now, Some(ms));
        }
    }
    assert!(seen - before > 10, "{} in a second in which the tree always changed", seen - before);
    world.settle();
    let state = world.peer(client).last_state().unwrap();
    assert_eq!(state.step, world.document().figures().step, "the last change is told as well");
}

/// Each comes a little after the other, and says what a page says.
fn crowd(world: &mut World, size: u64) -> Vec<u64> {
    let come = |number| {
        world.pass(5);
        world.join(&format!("somebody-{number}"))
    };
    (0..size).map(come).collect()
}

fn is_state(text: &ServerMessage) -> bool {
    matches!(text, ServerMessage::State { .. })
}

#[test]
fn fl4_states_are_4000_a_second_at_most_however_many_come() {
    const MANY: u64 = 500;
    let mut world = World::new();
    let people = crowd(&mut world, MANY);
    let told = |world: &World| {
        let states =
            people.iter().map(|id| world.peer(*id).texts.iter().filter(|text| is_state(text)).count());
        states.sum::<usize>() as u64
    };
    // While they come, and while half of them go: each time as many are told of each of them as were here.
    let seconds = world.now / 1000 + 1;
    assert!(told(&world) <= seconds * 4000 + MANY, "{} in {seconds} s", told(&world));
    world.settle();
    let before = told(&world);
    let from = world.now;
    for id in &people[..MANY as usize / 2] {
        world.handle(Input::Disconnected(ClientId(*id)));
        world.pass(10);
    }
    let seconds = (world.now - from) / 1000 + 1;
    assert!(told(&world) - before <= seconds * 4000 + MANY, "{} in {seconds} s", told(&world) - before);
    world.pass(1000);
    for id in &people[MANY as usize / 2..] {
        assert_eq!(world.peer(*id).last_state().unwrap().people, MANY as u32 / 2, "the last one is told");
    }
}

#[test]
fn fl4_who_reads_nothing_is_sent_the_newest_state_once_they_read() {
    let mut world = World::new();
    let (deaf, other) = (world.join("birch-01"), world.join("maple-01"));
    world.settle();
    world.peer_mut(deaf).deaf = true;
    world.peer_mut(deaf).texts.clear();
    for id in 1..=1500 {
        // With something in between that everybody is told of.
        world.command(other, id, if id % 2 == 1 { grow(1) } else { json!({ "kind": "ungrow", "steps": 1 }) });
        world.pass(60);
    }
    assert_eq!(world.peer(deaf).closed, Some(CloseCode::TooSlow), "lines of time are sent all the same");
    let states = world.peer(deaf).texts.iter().filter(|text| is_state(text)).count();
    assert!(states <= 32, "{states} figures wait for somebody who reads nothing");

    let mut world = World::new();
    let deaf = world.join("birch-01");
    world.settle();
    world.peer_mut(deaf).deaf = true;
    world.peer_mut(deaf).texts.clear();
    for number in 0..500 {
        let guest = world.join(&format!("somebody-{number}"));
        world.pass(60);
        if number % 2 == 0 {
            world.leave(guest);
        }
    }
    let states = world.peer(deaf).texts.iter().filter(|text| is_state(text)).count();
    assert!(states <= 32, "{states} figures wait for somebody who reads nothing");
    assert_eq!(world.peer(deaf).closed, None, "they are let go for nothing that could be left out");
    world.peer_mut(deaf).deaf = false;
    world.pass(1000);
    assert_eq!(world.peer(deaf).last_state().unwrap().people, 251, "and then they have the newest");
}

#[test]
fn fl4_a_ping_is_answered_at_once() {
    let mut world = World::new();
    let client = world.join("birch-01");
    (world.work_ms, world.write_ms) = (10_000, 10_000);
    world.command(client, 1, grow(200));
    world.pass(20);
    assert!(world.working.is_some() || world.writing.is_some(), "the session is busy");
    for nonce in [7, 8] {
        world.send(client, &ClientMessage::Ping { nonce });
        assert_eq!(world.peer(client).texts.last(), Some(&ServerMessage::Pong { nonce, at: world.now }));
    }
}

#[test]
fn long_growth_is_seen_while_it_goes_on() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.settle();
    let before = world.peer(client).frames.len();
    world.command(client, 1, grow(12));
    // The command is acknowledged long before its last step is run.
    world.pass(6);
    assert_eq!(world.peer(client).acknowledged(), [1]);
    assert!(world.working.is_some());
    assert!(world.peer(client).last_state().unwrap().pending_steps > 0);
    world.settle();
    assert!(world.peer(client).frames.len() - before >= 3);
    assert_eq!(world.peer(client).last_state().unwrap().pending_steps, 0);
    world.assert_mirrored(client);
}

#[test]
fn those_who_join_together_share_one_frame() {
    let mut world = World::new();
    let first = world.join("birch-01");
    world.command(first, 1, grow(9));
    world.settle();
    let guests: Vec<u64> = (0..20).map(|number| world.join(&format!("guest-{number:02}"))).collect();
    world.settle();
    for guest in guests {
        assert_eq!(world.peer(guest).frames.len(), 1);
        world.assert_mirrored(guest);
    }
}

#[test]
fn a_client_that_joins_amid_growth_sees_it_all() {
    let mut world = World::new();
    let first = world.join("birch-01");
    world.command(first, 1, grow(13));
    for number in 0..6 {
        world.pass(3);
        world.join(&format!("guest-{number:02}"));
    }
    world.settle();
    let all: Vec<u64> = world.peers.keys().copied().collect();
    for client in all {
        world.assert_mirrored(client);
    }
}

#[test]
fn a_client_may_vanish_while_its_frame_is_made() {
    let mut world = World::new();
    let first = world.join("birch-01");
    world.command(first, 1, grow(4));
    let gone = world.join("maple-01");
    assert!(world.working.is_some());
    world.leave(gone);
    // A text may still be under way from a socket that is gone.
    world.handle(Input::Text(ClientId(gone), "{}".into()));
    world.handle(Input::Written(ClientId(gone), 3));
    world.settle();
    world.assert_mirrored(first);
}

fn stroke(kind: &str, fields: serde_json::Value) -> serde_json::Value {
    let mut command = json!({ "kind": kind, "stroke": 1 });
    for (name, value) in fields.as_object().into_iter().flatten() {
        command[name] = value.clone();
    }
    command
}

/// Draws upwards from the tip of a young tree, as a page does; the last command's number, and how many frames had patches
/// of older rows while the finger moved.
fn draw_upwards(world: &mut World, client: u64) -> (u32, usize) {
    world.command(client, 1, grow(6));
    world.settle();
    let top = (0..world.document().plant().metamer_count())
        .map(|row| world.document().plant().metamers().end(espalier_plant::MetamerId::new(row)))
        .max_by(|a, b| a.y.total_cmp(&b.y))
        .expect("it has a tip");
    let before = world.peer(client).frames.len();
    world.command(client, 2, stroke("stroke_begin", json!({})));
    for part in 0..60u32 {
        let position = [top.x + 0.05 * part as f32, top.y + 0.3 * part as f32, top.z];
        let samples = json!([{ "position": position, "radius": 1.5 }]);
        world.command(client, 3 + part, stroke("stroke_move", json!({ "samples": samples })));
        world.pass(33);
    }
    let is_patched = |frame: &espalier_proto::Frame| {
        frame.changes.iter().any(|change| matches!(change, ChunkChange::Patch { .. }))
    };
    let patched = world.peer(client).frames[before..].iter().filter(|frame| is_patched(frame)).count();
    (62, patched)
}

#[test]
fn fl5_older_wood_is_shown_anew_twice_a_second_while_somebody_draws() {
    let mut world = World::new();
    let client = world.join("birch-01");
    let (last, patched) = draw_upwards(&mut world, client);
    let rows = world.document().plant().metamer_count();
    assert_eq!(world.peer(client).mirror.rows.len(), rows, "new wood is there at once");
    // In two seconds, and one more for the end of the growth before.
    assert!((1..=5).contains(&patched), "{patched} frames with older wood");
    world.command(client, last + 1, stroke("stroke_end", json!({})));
    world.settle();
    world.pass(3_100);
    let expected = crate::mirror::rows_of(world.document());
    for (seen, expected) in world.peer(client).mirror.rows.iter().zip(&expected) {
        assert!(seen.shows(expected), "at rest looks are exact: {seen:?} {expected:?}");
    }
    world.assert_mirrored(client);
}

#[test]
fn fl5_looks_are_exact_three_seconds_after_the_finger_rests() {
    let mut world = World::new();
    let client = world.join("birch-01");
    draw_upwards(&mut world, client);
    let differing = |world: &World| {
        let expected = crate::mirror::rows_of(world.document());
        let rows = &world.peer(client).mirror.rows;
        rows.iter().zip(&expected).filter(|(seen, expected)| !seen.shows(expected)).count()
    };
    assert!(differing(&world) > 0, "something was held back");
    world.pass(3_100);
    assert_eq!(differing(&world), 0, "the stroke is still open");
    // Whoever comes now has the same, and so has who checks.
    world.assert_mirrored(client);
    let frames = world.peer(client).frames.len();
    world.pass(5_000);
    assert_eq!(world.peer(client).frames.len(), frames, "nothing is left to be told");
}

#[test]
fn fl5_who_checks_is_told_of_rows_that_are_whole() {
    let mut world = World::new();
    let client = world.join("birch-01");
    draw_upwards(&mut world, client);
    world.send(client, &ClientMessage::Check {});
    world.pass(40);
    let told = world.peer(client).texts.iter().any(|text| matches!(text, ServerMessage::Checksum { .. }));
    assert!(told, "it is answered at once");
    let expected = crate::mirror::rows_of(world.document());
    let rows = &world.peer(client).mirror.rows;
    assert!(rows.iter().zip(&expected).all(|(seen, expected)| seen.shows(expected)));
}

#[test]
fn fr9_a_drawing_hand_is_sent_fewer_than_12_bytes_for_each_new_metamer() {
    let (before, sent) = crate::delta_bytes::measured();
    let bytes = sent.a_metamer(&before, sent.bytes_since(&before));
    assert!(bytes < 12.0, "{bytes}");
}
