//! `RP`: copies of a session in which its design is played.

use espalier_proto::{ServerMessage, Timeline, access::Role};
use espalier_session::Entrant;
use serde_json::json;

use crate::world::{Peer, World, grow};

fn enter(world: &mut World, person: &str, role: Role) -> u64 {
    let id = world.connect_as(Entrant { name: Some(person.into()), ..Entrant::new(person, role) });
    world.hello(id, &format!("device-of-{person}"), None);
    id
}

/// Two people have grown a tree in turns, and one has gone back two steps.
fn grown() -> World {
    let mut world = World::new();
    let [ann, bo] = ["Ann", "Bo"].map(|name| enter(&mut world, name, Role::Editor));
    world.command(ann, 1, grow(4));
    world.settle();
    world.command(bo, 1, grow(3));
    world.settle();
    world.command(bo, 2, json!({ "kind": "go_to", "step": 5 }));
    world.settle();
    world
}

fn line(peer: &Peer) -> &Timeline {
    let mut lines = peer.texts.iter().filter_map(|text| match text {
        ServerMessage::Timeline(timeline) => Some(&**timeline),
        _ => None,
    });
    lines.next_back().expect("a line of time follows the welcome")
}

#[test]
fn rp1_one_travels_in_a_replay_and_does_nothing_else() {
    let mut world = grown();
    let rows = world.document().figures();
    let mut replay = world.replay();
    let viewer = enter(&mut replay, "Cy", Role::Viewer);
    replay.settle();
    assert_eq!(line(replay.peer(viewer)).step, 5, "it begins where the session stands");
    for (id, step) in [(1, 0), (2, 3), (3, 7)] {
        replay.command(viewer, id, json!({ "kind": "go_to", "step": step }));
        replay.settle();
        assert_eq!(replay.document().figures().step, step);
    }
    let owner = enter(&mut replay, "Di", Role::Owner);
    replay.command(owner, 1, grow(1));
    replay.command(viewer, 4, json!({ "kind": "undo" }));
    replay.settle();
    for (peer, number) in [(owner, 1), (viewer, 4)] {
        let is_refused = |text: &ServerMessage| {
            matches!(text, ServerMessage::Refused { id, problem }
                if *id == number && problem.field.as_deref() == Some("kind"))
        };
        assert!(replay.peer(peer).texts.iter().any(is_refused), "{number} is refused");
    }
    assert_eq!(replay.document().figures().step, 7);
    world.settle();
    assert_eq!(world.document().figures(), rows, "the session stands where it stood");
}

#[test]
fn rp1_at_each_step_the_replay_is_the_session_at_that_step() {
    let mut world = grown();
    let mut replay = world.replay();
    let viewer = enter(&mut replay, "Cy", Role::Viewer);
    let ann = enter(&mut world, "Ann", Role::Editor);
    for (id, step) in [(1, 0), (2, 1), (3, 4), (4, 6), (5, 5)] {
        replay.command(viewer, id, json!({ "kind": "go_to", "step": step }));
        replay.settle();
        world.command(ann, id + 1, json!({ "kind": "go_to", "step": step }));
        world.settle();
        assert_eq!(replay.document().figures(), world.document().figures(), "step {step}");
    }
}

#[test]
fn rp3_a_replay_names_who_did_what_by_their_numbers_in_the_session() {
    let mut world = grown();
    let di = enter(&mut world, "Di", Role::Viewer);
    world.settle();
    let session: Vec<u32> = line(world.peer(di)).operations.iter().map(|done| done.author).collect();
    let mut replay = world.replay();
    let cy = enter(&mut replay, "Cy", Role::Viewer);
    replay.settle();
    let peer = replay.peer(cy);
    let played: Vec<u32> = line(peer).operations.iter().map(|done| done.author).collect();
    assert_eq!(played, session);
    let authors = peer.texts.iter().find_map(|text| match text {
        ServerMessage::Authors { authors } => Some(authors.clone()),
        _ => None,
    });
    let named: Vec<_> =
        authors.expect("they follow the welcome").into_iter().map(|it| (it.person, it.name)).collect();
    let expected = [(session[0], Some("Ann".to_owned())), (session[1], Some("Bo".to_owned()))];
    assert_eq!(named, expected);
}

/// The authors that are told in a replay.
fn authors(world: &mut World) -> Vec<(u32, Option<String>)> {
    let mut replay = world.replay();
    let viewer = enter(&mut replay, "Cy", Role::Viewer);
    replay.settle();
    let told = replay.peer(viewer).texts.iter().find_map(|text| match text {
        ServerMessage::Authors { authors } => Some(authors.clone()),
        _ => None,
    });
    told.expect("they follow the welcome").into_iter().map(|it| (it.person, it.name)).collect()
}

#[test]
fn rp3_names_outlive_the_server() {
    let mut world = grown();
    let di = enter(&mut world, "Di", Role::Editor);
    world.settle();
    let before = authors(&mut world);
    assert_eq!(before.iter().map(|(_, name)| name.as_deref()).collect::<Vec<_>>(), [Some("Ann"), Some("Bo")]);
    let kept: Vec<&str> = world.named.iter().map(|named| &*named.name).collect();
    assert_eq!(kept, ["Ann", "Bo"], "nothing is kept of whoever only looks");
    world.leave(di);
    world.crash();
    assert_eq!(authors(&mut world), before);
    // Who comes back at another device is the same person, and may choose another name.
    let bo = world.connect_as(Entrant { name: Some("Bo".into()), ..Entrant::new("Bo", Role::Editor) });
    world.hello(bo, "another-device-of-Bo", None);
    world.command(bo, 1, json!({ "kind": "go_to", "step": 7 }));
    world.command(bo, 2, grow(1));
    world.send(bo, &json!({ "type": "here", "name": "Robert" }));
    world.settle();
    let renamed = vec![before[0].clone(), (before[1].0, Some("Robert".to_owned()))];
    assert_eq!(authors(&mut world), renamed);
    world.crash();
    assert_eq!(authors(&mut world), renamed);
}
