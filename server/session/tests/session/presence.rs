//! `PS`: who is here and what they do, under virtual time.

use espalier_proto::{
    DeviceNews, Person, PointerNews, PointerPlace, PresenceFrame, Reason, ServerMessage, Whereabouts,
    access::Role, version::MAX_SHOWN_DEVICES,
};
use espalier_session::{ClientId, Entrant, Input};
use serde_json::{Value, json};

use crate::world::{Peer, World, grow, person};

/// Comes as a person with a device.
fn enter(world: &mut World, person: &str, key: &str) -> u64 {
    let id = world.connect_as(Entrant { name: Some(person.into()), ..Entrant::new(person, Role::Editor) });
    world.hello(id, key, None);
    world.send(id, &json!({ "type": "here" }));
    id
}

fn here(world: &mut World, id: u64, x: f32) {
    let pointer = json!({ "kind": "space", "position": [x, 1.0, 0.0] });
    world.send(id, &json!({ "type": "here", "pointer": pointer, "tool": "brush", "radius": 2.5 }));
}

fn camera(yaw: f32) -> Value {
    json!({ "target": [0.0, 8.0, 0.0], "yaw": yaw, "pitch": 10.0, "distance": 40.0 })
}

/// The list of people that a client had last, and its own number.
fn people(peer: &Peer) -> (u32, Vec<Person>, u32) {
    let list = peer.texts.iter().rev().find_map(|text| match text {
        ServerMessage::People { you, people, more } => Some((*you, people.clone(), *more)),
        _ => None,
    });
    list.expect("there is a list of people")
}

fn state_of(peer: &Peer, device: u32) -> Option<Whereabouts> {
    let (_, people, _) = people(peer);
    people.iter().flat_map(|person| &person.devices).find(|it| it.device == device).map(|it| it.state)
}

/// What a client has been told of a device, from all frames together.
fn told(peer: &Peer, device: u32) -> DeviceNews {
    let mut all = DeviceNews { device, ..DeviceNews::default() };
    for news in peer.presence.iter().flat_map(|(_, frame)| &frame.devices).filter(|it| it.device == device) {
        all.pointer = news.pointer.or(all.pointer);
        all.sketch = news.sketch.clone().or(all.sketch);
        all.camera = news.camera.or(all.camera);
    }
    all
}

#[test]
fn ps1_what_somebody_says_reaches_the_others_and_the_newest_counts() {
    let mut world = World::new();
    let (ann, ben) = (enter(&mut world, "Ann", "ann-tablet"), enter(&mut world, "Ben", "ben-tablet"));
    let plain = world.join("a-program");
    world.pass(300);
    world.send(
        ann,
        &json!({
            "type": "here",
            "pointer": { "kind": "wood", "row": 7, "along": 0.5, "offset": [0.25, -1.0, 0.0] },
            "tool": "lasso",
            "sketch": [[0.0, 1.0, 0.0], [0.5, 1.5, 0.0]],
            "camera": camera(90.0),
        }),
    );
    world.pass(300);
    let (you, list, more) = people(world.peer(ben));
    assert_eq!((you, more), (2, 0));
    let names: Vec<_> = list.iter().map(|person| (person.person, person.name.as_deref())).collect();
    assert_eq!(names, [(1, Some("Ann")), (2, Some("Ben")), (3, None)]);
    assert_eq!(list[0].devices[0].tool.as_deref(), Some("lasso"));
    let seen = told(world.peer(ben), 1);
    let place = PointerPlace::Wood { row: 7, along: 128, offset: [8, -32, 0] };
    assert_eq!(seen.pointer.map(|pointer| (pointer.place, pointer.radius)), Some((place, 0)));
    assert_eq!(seen.sketch, Some(vec![[0, 32, 0], [16, 48, 0]]));
    assert_eq!(seen.camera, Some([0.0, 8.0, 0.0, 90.0, 10.0, 40.0]));
    // What is left out is not there any more, but for the camera; a name is kept as well.
    world.send(ann, &json!({ "type": "here", "away": true, "name": "Anna" }));
    world.send(ann, &json!({ "type": "here", "away": true }));
    world.pass(300);
    let seen = told(world.peer(ben), 1);
    assert_eq!(seen.pointer.map(|pointer| pointer.place), Some(PointerPlace::Nowhere));
    assert_eq!(seen.sketch, Some(Vec::new()));
    assert!(seen.camera.is_some());
    let (_, list, _) = people(world.peer(ben));
    assert_eq!((list[0].name.as_deref(), list[0].devices[0].state), (Some("Anna"), Whereabouts::Away));
    assert_eq!(list[0].devices[0].tool, None);
    // Whoever never says it is told nothing.
    let texts = &world.peer(plain).texts;
    assert!(!texts.iter().any(|text| matches!(text, ServerMessage::People { .. })));
    assert!(world.peer(plain).presence.is_empty());
}

#[test]
fn ps2_who_stalls_for_ten_seconds_gets_one_frame_and_then_the_newest() {
    let mut world = World::new();
    let (ann, ben) = (enter(&mut world, "Ann", "ann-tablet"), enter(&mut world, "Ben", "ben-tablet"));
    world.pass(500);
    world.peer_mut(ben).slow = true;
    let before = world.peer(ben).presence.len();
    for step in 0..1000 {
        here(&mut world, ann, step as f32 / 10.0);
        world.pass(10);
    }
    assert_eq!(world.peer(ben).presence.len(), before + 1);
    world.peer_mut(ben).slow = false;
    world.pass(100);
    assert_eq!(world.peer(ben).presence.len(), before + 2);
    let place = told(world.peer(ben), 1).pointer.unwrap().place;
    assert_eq!(place, PointerPlace::Space([(99.9f32 * 32.0).round() as i32, 32, 0]));
}

#[test]
fn ps2_a_thousand_in_a_second_cost_one_a_tick() {
    let mut world = World::new();
    let (ann, ben) = (enter(&mut world, "Ann", "ann-tablet"), enter(&mut world, "Ben", "ben-tablet"));
    let cem = enter(&mut world, "Cem", "cem-tablet");
    world.pass(500);
    let before = [ben, cem].map(|id| world.peer(id).presence.len());
    let bytes = world.peer(ben).presence_bytes;
    for step in 0..1000 {
        here(&mut world, ann, step as f32 / 100.0);
        world.pass(1);
    }
    for (id, before) in [ben, cem].into_iter().zip(before) {
        let frames = world.peer(id).presence.len() - before;
        assert!((19..=21).contains(&frames), "{frames} frames in a second");
    }
    let bytes = world.peer(ben).presence_bytes - bytes;
    assert!(bytes < 20 * 35, "{bytes} bytes of one pointer in a second");
    // Both were sent the very same, and whoever moves is told nothing of themselves.
    let frames = |id: u64| world.peer(id).presence.last().map(|(_, frame)| frame.clone());
    assert_eq!(frames(ben), frames(cem));
    assert!(world.peer(ann).presence.iter().all(|(_, frame)| frame.devices.iter().all(|it| it.device != 1)));
    // Nobody moves: nothing is sent.
    world.pass(200);
    let before = world.peer(ben).presence.len();
    world.pass(60_000);
    assert_eq!(world.peer(ben).presence.len(), before);
}

#[test]
fn ps3_who_falls_silent_is_gone_within_five_seconds() {
    for people in [2, 5] {
        for phase in (0..2000).step_by(125) {
            let mut world = World::new();
            let ids: Vec<u64> = (0..people)
                .map(|i| enter(&mut world, &format!("person {i}"), &format!("tablet-{i}")))
                .collect();
            world.pass(7_000 + phase);
            assert_eq!(state_of(world.peer(ids[0]), people as u32), Some(Whereabouts::Here));
            let sleeper = *ids.last().unwrap();
            world.peer_mut(sleeper).asleep = true;
            world.pass(5_000);
            for id in &ids[..people - 1] {
                let state = state_of(world.peer(*id), people as u32);
                assert_eq!(state, Some(Whereabouts::Gone), "{people} people, phase {phase}");
            }
            // It wakes: any sign is enough.
            world.peer_mut(sleeper).asleep = false;
            world.handle(Input::Heard(ClientId(sleeper)));
            world.pass(300);
            assert_eq!(state_of(world.peer(ids[0]), people as u32), Some(Whereabouts::Here));
        }
    }
}

#[test]
fn ps3_who_leaves_is_not_there_and_comes_back_under_the_same_numbers() {
    let mut world = World::new();
    let (ann, ben) = (enter(&mut world, "Ann", "ann-tablet"), enter(&mut world, "Ben", "ben-tablet"));
    let phone = enter(&mut world, "Ben", "ben-phone");
    world.pass(300);
    let (_, list, _) = people(world.peer(ann));
    let devices = |list: &[Person]| -> Vec<(u32, Vec<u32>)> {
        list.iter().map(|it| (it.person, it.devices.iter().map(|it| it.device).collect())).collect()
    };
    assert_eq!(devices(&list), [(1, vec![1]), (2, vec![2, 3])], "one person with two devices is one name");
    world.leave(ben);
    world.pass(300);
    assert_eq!(devices(&people(world.peer(ann)).1), [(1, vec![1]), (2, vec![3])]);
    world.leave(phone);
    world.pass(300);
    assert_eq!(devices(&people(world.peer(ann)).1), [(1, vec![1])]);
    // Another network: the page connects again before the server knows that the old socket is dead.
    let ben = enter(&mut world, "Ben", "ben-tablet");
    world.pass(300);
    world.peer_mut(ben).asleep = true;
    enter(&mut world, "Ben", "ben-tablet");
    world.pass(300);
    let (_, list, _) = people(world.peer(ann));
    assert_eq!(devices(&list), [(1, vec![1]), (2, vec![2])]);
    assert_eq!(list[1].devices[0].state, Whereabouts::Here);
}

#[test]
fn ps3_a_slow_link_is_no_absence_and_who_is_alone_is_not_asked() {
    let mut world = World::new();
    let ann = enter(&mut world, "Ann", "ann-tablet");
    world.pass(60_000);
    assert!(world.peer(ann).pings.is_empty());
    let ben = enter(&mut world, "Ben", "ben-tablet");
    world.pass(10_000);
    let pings = world.peer(ann).pings.len();
    assert!((5..=6).contains(&pings), "{pings} questions in ten seconds");
    // A tree is on its way to somebody, at 1 Mbit/s: what they say comes late.
    world.peer_mut(ben).slow = true;
    for id in 1..40 {
        world.command(ann, id, grow(12));
        world.settle();
    }
    let bytes: usize = world.peer(ben).in_flight.iter().map(|(_, bytes)| bytes).sum();
    assert!(bytes > 48 * 1024, "{bytes} bytes are on their way");
    world.peer_mut(ben).asleep = true;
    world.pass(7_000);
    assert_eq!(state_of(world.peer(ann), 2), Some(Whereabouts::Here));
    world.pass(10_000);
    assert_eq!(state_of(world.peer(ann), 2), Some(Whereabouts::Gone));
}

#[test]
fn ps3_who_was_fast_and_falls_silent_while_the_tree_grows_is_gone_within_five_seconds() {
    let mut world = World::new();
    let ann = enter(&mut world, "Ann", "ann-tablet");
    let ben = enter(&mut world, "Ben", "ben-tablet");
    for id in 1..4 {
        world.command(ann, id, grow(12));
        world.settle();
    }
    world.peer_mut(ben).asleep = true;
    for id in 4..40 {
        world.command(ann, id, grow(12));
    }
    world.pass(5_000);
    let bytes: usize = world.peer(ben).in_flight.iter().map(|(_, bytes)| bytes).sum();
    assert!(bytes > 16 * 1024, "{bytes} bytes are on their way");
    assert_eq!(state_of(world.peer(ann), 2), Some(Whereabouts::Gone));
}

#[test]
fn ps3_sixty_four_devices_are_shown_and_the_others_counted() {
    let mut world = World::new();
    let ids: Vec<u64> =
        (0..70).map(|i| enter(&mut world, &format!("person {i}"), &format!("tablet-{i}"))).collect();
    world.pass(600);
    let (_, list, more) = people(world.peer(ids[69]));
    assert_eq!((list.len(), more), (MAX_SHOWN_DEVICES, 6));
    here(&mut world, ids[69], 1.0);
    here(&mut world, ids[0], 1.0);
    world.pass(200);
    let devices = |frame: &PresenceFrame| frame.devices.iter().map(|it| it.device).collect::<Vec<_>>();
    let told: Vec<u32> = world.peer(ids[1]).presence.iter().flat_map(|(_, frame)| devices(frame)).collect();
    assert_eq!(told, [1]);
    // Those who are not shown move, and nobody is sent anything.
    let frames = |world: &World| ids.iter().map(|id| world.peer(*id).presence.len()).sum::<usize>();
    let before = frames(&world);
    for step in 2..20 {
        here(&mut world, ids[69], step as f32);
        here(&mut world, ids[64], step as f32);
        world.pass(60);
    }
    assert_eq!(frames(&world), before);
    // There is a place for one of them: where it points is told, though it does not move.
    world.leave(ids[3]);
    world.pass(200);
    let pointer = told_of(&world, ids[1], 65).expect("it is shown now").place;
    assert_eq!(pointer, PointerPlace::Space([19 * 32, 32, 0]));
    assert!(told_of(&world, ids[1], 70).is_none());
}

/// Where a client has been told that a device points.
fn told_of(world: &World, id: u64, device: u32) -> Option<PointerNews> {
    told(world.peer(id), device).pointer
}

#[test]
fn ps4_a_camera_that_is_followed_is_told_at_every_tick() {
    let mut world = World::new();
    let (ann, ben) = (enter(&mut world, "Ann", "ann-tablet"), enter(&mut world, "Ben", "ben-tablet"));
    world.pass(300);
    let turn = |world: &mut World| -> usize {
        let before = world.peer(ben).presence.len();
        for step in 0..200 {
            world.send(ann, &json!({ "type": "here", "camera": camera(step as f32 / 2.0) }));
            world.pass(10);
        }
        world.pass(600);
        let frames = &world.peer(ben).presence[before..];
        assert_eq!(told(world.peer(ben), 1).camera.unwrap()[3], 99.5);
        frames.iter().flat_map(|(_, frame)| &frame.devices).filter(|it| it.camera.is_some()).count()
    };
    let seldom = turn(&mut world);
    assert!((4..=6).contains(&seldom), "{seldom} cameras in two seconds");
    world.send(ben, &json!({ "type": "follow", "device": 1 }));
    let often = turn(&mut world);
    assert!((38..=42).contains(&often), "{often} cameras in two seconds");
    assert_eq!(people(world.peer(ann)).1[1].devices[0].follows, Some(1));
    // Nobody follows themselves, nor who is not here.
    for device in [json!(2), json!(99), Value::Null] {
        world.send(ben, &json!({ "type": "follow", "device": 1 }));
        world.send(ben, &json!({ "type": "follow", "device": device }));
        world.pass(300);
        assert_eq!(people(world.peer(ann)).1[1].devices[0].follows, None, "{device}");
    }
    world.send(ben, &json!({ "type": "follow", "device": 1 }));
    world.leave(ann);
    world.pass(300);
    assert_eq!(people(world.peer(ben)).1[0].devices[0].follows, None);
}

#[test]
fn ps5_who_may_edit_brings_everyone_once_in_ten_seconds() {
    let mut world = World::new();
    let (ann, ben) = (enter(&mut world, "Ann", "ann-tablet"), enter(&mut world, "Ben", "ben-tablet"));
    let gathered = |world: &World, id: u64| -> Vec<(u32, f32)> {
        let texts = world.peer(id).texts.iter();
        texts
            .filter_map(|text| match text {
                ServerMessage::Gathered { by, camera } => Some((*by, camera.yaw.get())),
                _ => None,
            })
            .collect()
    };
    let gather = |world: &mut World, id: u64, yaw: f32| {
        world.send(id, &json!({ "type": "gather", "camera": camera(yaw) }));
        world.pass(100);
    };
    gather(&mut world, ann, 30.0);
    gather(&mut world, ben, 60.0);
    assert_eq!(gathered(&world, ben), [(1, 30.0)]);
    assert!(gathered(&world, ann).is_empty());
    assert_eq!(world.peer(ben).problems()[0].reason, Reason::TooOften);
    world.pass(10_000);
    gather(&mut world, ben, 60.0);
    assert_eq!(gathered(&world, ann), [(2, 60.0)]);
    world.pass(10_000);
    world.handle(Input::Granted(ClientId(ben), Role::Viewer));
    gather(&mut world, ben, 90.0);
    assert_eq!(world.peer(ben).problems()[1].reason, Reason::Forbidden);
    assert_eq!(gathered(&world, ann).len(), 1);
}

#[test]
fn ps6_who_may_look_shows_no_tool() {
    let mut world = World::new();
    let ann = enter(&mut world, "Ann", "ann-tablet");
    let eve = world.connect_as(Entrant::new("Eve", Role::Viewer));
    world.hello(eve, "eve-tablet", None);
    let shows = [("tool", json!("brush")), ("radius", json!(2.0)), ("sketch", json!([[0.0, 1.0, 0.0]]))];
    for (field, value) in shows {
        world.send(eve, &json!({ "type": "here", field: value }));
        let problem = world.peer(eve).problems().pop().unwrap();
        assert_eq!((problem.reason, problem.field.as_deref()), (Reason::Forbidden, Some(field)));
    }
    let pointer = json!({ "kind": "space", "position": [1.0, 1.0, 0.0] });
    world.send(eve, &json!({ "type": "here", "pointer": pointer, "camera": camera(5.0) }));
    world.pass(300);
    let seen = told(world.peer(ann), 2);
    assert!(seen.pointer.is_some() && seen.camera.is_some());
    assert_eq!(people(world.peer(ann)).1[1].role, Role::Viewer);
}

#[test]
fn ps6_nothing_but_names_and_numbers_is_told_of_people() {
    let mut world = World::new();
    let keys = ["ann-key-4711", "ben-key-0815"];
    let ids = keys.map(|key| {
        let id = world.connect_as(Entrant::new(format!("login of {key}"), Role::Owner));
        world.hello(id, key, None);
        world.send(id, &json!({ "type": "here", "name": "Somebody", "camera": camera(1.0) }));
        here(&mut world, id, 1.0);
        id
    });
    world.command(ids[0], 1, grow(2));
    world.send(ids[0], &json!({ "type": "gather", "camera": camera(2.0) }));
    world.send(ids[1], &json!({ "type": "follow", "device": 1 }));
    world.pass(5_000);
    world.leave(ids[0]);
    world.pass(5_000);
    let peer = world.peer(ids[1]);
    let mut all: Vec<u8> = peer.texts.iter().flat_map(|text| serde_json::to_vec(text).unwrap()).collect();
    all.extend(peer.presence.iter().flat_map(|(_, frame)| frame.encode()));
    for secret in keys.iter().flat_map(|key| [key.to_string(), format!("login of {key}")]) {
        let found = all.windows(secret.len()).any(|part| part == secret.as_bytes());
        assert!(!found, "{secret} left the server");
    }
}

#[test]
fn ps7_ten_minutes_of_presence_leave_nothing_behind() {
    let mut world = World::new();
    let (ann, ben) = (enter(&mut world, "Ann", "ann-tablet"), enter(&mut world, "Ben", "ben-tablet"));
    world.command(ann, 1, grow(5));
    world.settle();
    world.pass(40_000);
    let (journal, snapshot) = (world.disk.clone(), world.snapshot.clone());
    let (snapshots, hash) = (world.snapshots, world.document().hash());
    let texts = world.peer(ben).texts.len();
    for step in 0..6_000 {
        here(&mut world, ann, (step % 100) as f32);
        world.pass(100);
    }
    assert_eq!((world.disk.len(), world.snapshots), (journal.len(), snapshots));
    assert_eq!((world.snapshot.clone(), world.document().hash()), (snapshot, hash));
    assert!(world.peer(ben).presence.len() > 5_900);
    assert!(world.peer(ben).texts.len() < texts + 10, "no control messages either");
}

#[test]
fn au3_what_somebody_may_do_changes_while_they_are_here() {
    let mut world = World::new();
    let (ann, ben) = (enter(&mut world, "Ann", "ann-tablet"), enter(&mut world, "Ben", "ben-tablet"));
    world.command(ben, 1, grow(3));
    world.settle();
    world.command(ben, 2, json!({ "kind": "stroke_begin", "stroke": 2 }));
    here(&mut world, ben, 1.0);
    world.settle();
    assert_eq!(world.document().open_strokes(&person("ben-tablet")).len(), 1);
    world.handle(Input::Granted(ClientId(ben), Role::Viewer));
    world.settle();
    assert!(world.document().open_strokes(&person("ben-tablet")).is_empty(), "it ended where it was");
    world.command(ben, 3, grow(1));
    world.settle();
    let refused: Vec<_> = world.peer(ben).refused().iter().map(|(id, it)| (*id, it.reason)).collect();
    assert_eq!(refused, [(3, Reason::Forbidden)]);
    assert!(world.peer(ben).texts.contains(&ServerMessage::Role { role: Role::Viewer }));
    world.pass(300);
    let (_, list, _) = people(world.peer(ann));
    assert_eq!((list[1].role, list[1].devices[0].tool.as_deref()), (Role::Viewer, None));
    assert_eq!(told(world.peer(ann), 2).pointer.unwrap().radius, 0);
    world.handle(Input::Granted(ClientId(ben), Role::Owner));
    world.command(ben, 4, grow(1));
    world.settle();
    assert_eq!(world.peer(ben).refused().len(), 1);
    assert_eq!(people(world.peer(ann)).1[1].role, Role::Owner);
}

#[test]
fn au3_who_gets_their_right_back_draws_on() {
    let mut world = World::new();
    let ben = enter(&mut world, "Ben", "ben-tablet");
    world.command(ben, 1, grow(3));
    world.settle();
    // The document is away with what they do, so that nobody knows yet which of their strokes are open.
    world.command(ben, 2, json!({ "kind": "stroke_begin", "stroke": 2 }));
    world.handle(Input::Granted(ClientId(ben), Role::Viewer));
    world.handle(Input::Granted(ClientId(ben), Role::Editor));
    world.settle();
    world.command(ben, 3, json!({ "kind": "stroke_begin", "stroke": 3 }));
    world.settle();
    assert_eq!(world.document().open_strokes(&person("ben-tablet")).len(), 2, "nothing of theirs was ended");
}
