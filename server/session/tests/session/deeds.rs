//! `UD`: everyone's own undo, as clients are told of it.

use espalier_proto::{
    Deed, OperationKind, Reason, ServerMessage, Timeline, TimelineChange, access::Role, version::CloseCode,
};
use espalier_session::{ActId, Entrant, Input};
use serde_json::json;

use crate::world::{Peer, World, grow, person};

fn enter(world: &mut World, person: &str, key: &str) -> u64 {
    let id = world.connect_as(Entrant { name: Some(person.into()), ..Entrant::new(person, Role::Editor) });
    world.hello(id, key, None);
    world.send(id, &json!({ "type": "here" }));
    id
}

/// A stroke sidewards from a height, with commands numbered from `first`.
fn draw(world: &mut World, client: u64, first: u32, x: f32) {
    let samples = json!([
        { "position": [0.0, 4.0, 0.0], "radius": 0.6 },
        { "position": [x, 7.0, 0.0], "radius": 0.6 },
    ]);
    world.command(client, first, json!({ "kind": "stroke_begin", "stroke": 1 }));
    world.command(client, first + 1, json!({ "kind": "stroke_move", "stroke": 1, "samples": samples }));
    world.command(client, first + 2, json!({ "kind": "stroke_end", "stroke": 1 }));
    world.settle();
}

fn deeds(peer: &Peer) -> Vec<Deed> {
    let deed = |text: &ServerMessage| match text {
        ServerMessage::Deed { deed } => Some(*deed),
        _ => None,
    };
    peer.texts.iter().filter_map(deed).collect()
}

/// Who did what lies on the line, by number.
fn authors(peer: &Peer) -> Vec<u32> {
    let mut timeline = None::<Timeline>;
    for text in &peer.texts {
        match text {
            ServerMessage::Timeline(whole) => timeline = Some(Timeline::clone(whole)),
            ServerMessage::TimelineChanged(change) => {
                timeline.as_mut().expect("the whole comes first").change(TimelineChange::clone(change));
            }
            _ => {}
        }
    }
    timeline.expect("it is told").operations.iter().map(|operation| operation.author).collect()
}

/// The number of the person at a client.
fn number(peer: &Peer) -> u32 {
    let own = peer.texts.iter().rev().find_map(|text| match text {
        ServerMessage::People { you, people, .. } => {
            people.iter().find(|person| person.devices.iter().any(|it| it.device == *you))
        }
        _ => None,
    });
    own.expect("people are told").person
}

#[test]
fn ud7_who_takes_back_is_told_what_came_of_it() {
    let mut world = World::new();
    let (ann, ben) = (enter(&mut world, "Ann", "ann-tablet"), enter(&mut world, "Ben", "ben-tablet"));
    world.command(ann, 1, grow(8));
    world.settle();
    draw(&mut world, ben, 1, 9.0);
    draw(&mut world, ann, 2, -9.0);
    world.command(ben, 4, json!({ "kind": "take_back" }));
    world.settle();
    let [away] = deeds(world.peer(ben))[..] else { panic!("one deed is told") };
    assert_eq!((away.id, away.kind, away.away, away.held), (4, OperationKind::Stroke, true, 0));
    assert!(away.fell > 0 && away.rose == 0, "{away:?}");
    assert_eq!(deeds(world.peer(ann)), [], "nobody else is told");
    world.command(ben, 5, json!({ "kind": "bring_back" }));
    world.settle();
    let [_, back] = deeds(world.peer(ben))[..] else { panic!("two deeds are told") };
    assert_eq!(back, Deed { id: 5, away: false, fell: 0, rose: away.fell, ..away });
    for id in 6..9 {
        world.command(ben, id, json!({ "kind": "take_back" }));
    }
    world.settle();
    let refused = world.peer(ben).texts.iter().filter_map(|text| match text {
        ServerMessage::Refused { id, problem } => Some((*id, problem.reason)),
        _ => None,
    });
    assert_eq!(refused.collect::<Vec<_>>(), [(7, Reason::NothingOfYours), (8, Reason::NothingOfYours)]);
}

#[test]
fn ud7_who_is_alone_is_told_as_well() {
    for (back, forth) in [("take_back", "bring_back"), ("undo", "redo")] {
        let mut world = World::new();
        let ann = enter(&mut world, "Ann", "ann-tablet");
        world.command(ann, 1, grow(8));
        world.settle();
        draw(&mut world, ann, 2, -9.0);
        world.command(ann, 5, json!({ "kind": back }));
        world.command(ann, 6, json!({ "kind": forth }));
        world.settle();
        let [away, brought] = deeds(world.peer(ann))[..] else { panic!("two deeds are told of {back}") };
        assert_eq!((away.kind, away.away, away.rose), (OperationKind::Stroke, true, 0));
        assert!(away.fell > 0, "{away:?}");
        assert_eq!(brought, Deed { id: 6, away: false, fell: 0, rose: away.fell, ..away });
    }
}

/// Reasons for which commands of a client were refused.
fn refusals(peer: &Peer) -> Vec<Reason> {
    let refused = peer.texts.iter().filter_map(|text| match text {
        ServerMessage::Refused { problem, .. } => Some(problem.reason),
        _ => None,
    });
    refused.collect()
}

#[test]
fn hs4_a_key_is_nobody_elses() {
    let mut world = World::new();
    let (ann, ben) = (enter(&mut world, "Ann", "ann-tablet"), enter(&mut world, "Ben", "ben-tablet"));
    world.command(ann, 1, grow(8));
    world.settle();
    draw(&mut world, ben, 1, 9.0);
    // Whoever has read Ben's key somewhere is sent away with it, whether or not he is there.
    for is_there in [true, false] {
        let eve = world.connect_as(Entrant::new("Eve", Role::Viewer));
        world.hello(eve, "ben-tablet", None);
        assert_eq!(world.peer(eve).closed, Some(CloseCode::Replaced));
        if is_there {
            assert_eq!(world.peer(ben).closed, None);
            world.leave(ben);
        }
    }
    let command = serde_json::from_value(grow(1)).expect("in good form");
    let (key, eve) = (person("ben-tablet"), Entrant::new("Eve", Role::Editor));
    world.handle(Input::Act(ActId(1), key, eve, Box::new(command)));
    assert!(matches!(&world.acts[..], [(_, Err(problem))] if problem.reason == Reason::Forbidden));
    // Ben has it again, under another name as well.
    let called = Entrant { person: "login Benjamin".into(), ..Entrant::new("Ben", Role::Editor) };
    let ben = world.connect_as(called);
    world.hello(ben, "ben-tablet", None);
    world.command(ben, 4, json!({ "kind": "take_back" }));
    world.settle();
    assert_eq!(deeds(world.peer(ben)).len(), 1);
}

#[test]
fn ud8_a_namesake_is_somebody_else() {
    let mut world = World::new();
    let ann = enter(&mut world, "Ann", "ann-tablet");
    world.command(ann, 1, grow(8));
    world.settle();
    let named =
        |identity: &str| Entrant { identity: identity.into(), ..Entrant::new("login ben", Role::Editor) };
    let ben = world.connect_as(named("user 1"));
    world.hello(ben, "ben-tablet", None);
    draw(&mut world, ben, 1, 9.0);
    world.leave(ben);
    let namesake = world.connect_as(named("user 2"));
    world.hello(namesake, "another-tablet", None);
    world.command(namesake, 1, json!({ "kind": "take_back" }));
    world.settle();
    assert_eq!(refusals(world.peer(namesake)), [Reason::NothingOfYours]);
}

#[test]
fn ud8_who_comes_again_takes_back_what_they_did_before() {
    let mut world = World::new();
    // Nobody says what Ann is called.
    let comes = |world: &mut World, person: &str, key: &str| {
        let id = world.connect_as(Entrant::new(person, Role::Editor));
        world.hello(id, key, None);
        id
    };
    let ann = comes(&mut world, "machine", "ann-before");
    world.command(ann, 1, grow(8));
    world.settle();
    let ben = enter(&mut world, "Ben", "ben-tablet");
    draw(&mut world, ann, 2, -9.0);
    draw(&mut world, ben, 1, 9.0);
    world.pass(1000);
    world.leave(ann);
    for key in ["ann-same-day", "ann-next-day"] {
        let ann = comes(&mut world, "machine", key);
        world.command(ann, 1, json!({ "kind": "take_back" }));
        world.settle();
        let kinds: Vec<_> = deeds(world.peer(ann)).iter().map(|deed| deed.kind).collect();
        let expected = if key == "ann-same-day" { OperationKind::Stroke } else { OperationKind::Growth };
        assert_eq!((kinds, refusals(world.peer(ann))), (vec![expected], vec![]), "{key}");
        // All of it is done again from the journal as it was.
        let hash = world.document().hash();
        world.crash();
        assert_eq!(world.document().hash(), hash);
    }
    // What somebody says is their key counts for nothing.
    let cy = enter(&mut world, "Cy", "cy-tablet");
    world.command(cy, 1, json!({ "kind": "take_back", "keys": ["ben-tablet"] }));
    world.settle();
    assert_eq!(refusals(world.peer(cy)), [Reason::NothingOfYours]);
}

#[test]
fn tt1_authors_have_the_numbers_of_people() {
    let mut world = World::new();
    let (ann, ben) = (enter(&mut world, "Ann", "ann-tablet"), enter(&mut world, "Ben", "ben-tablet"));
    world.command(ben, 1, grow(8));
    world.settle();
    draw(&mut world, ann, 1, -9.0);
    world.pass(1000);
    let (one, two) = (number(world.peer(ann)), number(world.peer(ben)));
    assert_ne!(one, two);
    assert_eq!(authors(world.peer(ann)), [two, one]);
    // After a restart nobody is known, and who comes has the number of what they did.
    world.crash();
    let ben = enter(&mut world, "Ben", "ben-tablet");
    let cy = enter(&mut world, "Cy", "cy-tablet");
    world.pass(1000);
    let [two, one] = authors(world.peer(ben))[..] else { panic!("two operations are told") };
    assert_eq!(two, number(world.peer(ben)));
    assert_ne!(one, two);
    assert!(![one, two].contains(&number(world.peer(cy))));
}
