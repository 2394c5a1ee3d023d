//! Grammars over the wire (`GR`).

use espalier_proto::{GrammarInForce, ServerMessage};
use serde_json::json;

use crate::world::World;

/// What a client was told of the grammar in force last; nothing where it was told nothing.
fn told(world: &World, client: u64) -> Option<Option<GrammarInForce>> {
    world.peer(client).texts.iter().rev().find_map(|message| match message {
        ServerMessage::Grammar { grammar } => Some(grammar.clone().map(|grammar| *grammar)),
        _ => None,
    })
}

const TEXT: &str = "slider: a 10 60\na = 30\naxiom: A\nA --> F[+(a)A]/(90)A\n";

#[test]
fn gr1_a_text_becomes_a_plant_and_typing_is_one_deed() {
    let mut world = World::new();
    let client = world.join("birch-01");
    for (id, depth) in [(1, 2), (2, 3), (3, 4)] {
        world.command(
            client,
            id,
            json!({ "kind": "set_grammar", "text": TEXT, "depth": depth, "gesture": 1 }),
        );
    }
    world.settle();
    assert_eq!(world.document().metamers(), 15);
    world.command(client, 4, json!({ "kind": "set_grammar", "text": "axiom: A\nA --> F[+A\n" }));
    world.settle();
    assert_eq!(world.peer(client).refused().len(), 1);
    world.command(client, 5, json!({ "kind": "undo" }));
    world.settle();
    assert_eq!(world.document().metamers(), 0);
    assert_eq!(world.document().hash(), world.replayed_hash());
}

#[test]
fn gr2_depth_is_time() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, json!({ "kind": "set_grammar", "text": TEXT }));
    world.command(client, 2, json!({ "kind": "derive", "steps": 5 }));
    world.settle();
    assert_eq!((world.document().metamers(), world.document().plant().step()), (31, 5));
    world.command(client, 3, json!({ "kind": "go_to", "step": 3 }));
    world.settle();
    assert_eq!(world.document().metamers(), 7);
    world.command(client, 4, json!({ "kind": "derive", "steps": 2 }));
    world.settle();
    assert_eq!(world.document().metamers(), 31);
    assert_eq!(world.document().hash(), world.replayed_hash());
}

#[test]
fn gr3_sliders_move_rows() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, json!({ "kind": "set_grammar", "text": TEXT, "depth": 4 }));
    for (id, value) in [(2, 20), (3, 50)] {
        let values = json!([{ "name": "a", "value": value }]);
        world.command(client, id, json!({ "kind": "set_grammar_values", "values": values, "gesture": 9 }));
    }
    world.settle();
    let document = world.document();
    assert_eq!((document.metamers(), document.plant().metamer_count(), document.plant().step()), (15, 16, 5));
    assert_eq!(world.document().hash(), world.replayed_hash());
}

#[test]
fn gr4_what_cannot_go_on_is_refused_and_what_was_stays() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, json!({ "kind": "derive", "steps": 1 }));
    world.command(
        client,
        2,
        json!({ "kind": "set_grammar", "text": "axiom: A(1)\nA(x) --> F(1/(3-x))A(x+1)\n", "depth": 9 }),
    );
    world.settle();
    assert_eq!(world.document().plant().step(), 2);
    world.command(client, 3, json!({ "kind": "derive", "steps": 1 }));
    world.settle();
    let refused = world.peer(client).refused();
    assert_eq!(refused.len(), 2, "no grammar at first, none further at last");
    assert_eq!(world.document().hash(), world.replayed_hash());
}

#[test]
fn gr5_all_are_told_the_grammar_and_each_change_of_it() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.settle();
    assert_eq!(told(&world, client), None, "a welcome that none follows means: none");
    world.command(client, 1, json!({ "kind": "set_grammar", "text": TEXT, "depth": 3, "seed": 7 }));
    world.settle();
    let seen = told(&world, client).flatten().expect("it is in force");
    assert_eq!((seen.text.as_str(), seen.depth, seen.seed, seen.edited), (TEXT, 3, 7, false));
    assert_eq!(seen.sliders.len(), 1);
    assert_eq!((seen.sliders[0].from, seen.sliders[0].value, seen.sliders[0].to), (10.0, 30.0, 60.0));
    let values = json!([{ "name": "a", "value": 20 }]);
    world.command(client, 2, json!({ "kind": "set_grammar_values", "values": values }));
    world.settle();
    let late = world.join("aspen-01");
    world.settle();
    let seen = told(&world, late).flatten().expect("it follows the welcome");
    assert_eq!((seen.values[0].value, seen.depth), (20.0, 3));
    world.command(client, 3, json!({ "kind": "grow", "steps": 1 }));
    world.settle();
    assert!(told(&world, late).flatten().is_some_and(|seen| seen.edited), "somebody has grown it on");
    world.command(client, 4, json!({ "kind": "go_to", "step": 2 }));
    world.settle();
    let seen = told(&world, late).flatten().expect("it is in force there");
    assert_eq!((seen.depth, seen.values.len(), seen.edited), (2, 0, false), "time goes back in depth");
    world.command(client, 5, json!({ "kind": "go_to", "step": 0 }));
    world.settle();
    assert_eq!(told(&world, late), Some(None), "before it was set there is none");
}
