//! Grammars over the wire (`GR`).

use espalier_proto::{ClientMessage, GrammarInForce, ServerMessage};
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

#[test]
fn gr4_bombs_end_and_pings_are_answered_meanwhile() {
    let bombs = [
        // Modules, parameters, brackets, and contexts that everybody looks for in vain.
        "axiom: F\nF --> FFFFFFFF\n".to_owned(),
        "axiom: A\nA --> A(1,2,3,4,5,6,7,8)A\nA(a,b,c,d,e,f,g,h) --> AA\n".to_owned(),
        "axiom: A\nA --> F[A]\n".to_owned(),
        format!("axiom: A\nignore: F\nA --> {}\nB < F --> G\n", "F".repeat(9000)),
        "axiom: A(1)\nA(x) --> F(1/x)A(0)\n".to_owned(),
    ];
    for text in bombs {
        let mut world = World::new();
        let client = world.join("birch-01");
        world.settle();
        (world.work_ms, world.write_ms) = (10_000, 10_000);
        let before = world.document().metamers();
        world.command(client, 1, json!({ "kind": "set_grammar", "text": text, "depth": 600 }));
        world.pass(20);
        world.send(client, &ClientMessage::Ping { nonce: 7 });
        assert_eq!(world.peer(client).texts.last(), Some(&ServerMessage::Pong { nonce: 7, at: world.now }));
        (world.work_ms, world.write_ms) = (0, 0);
        world.settle();
        let seen = told(&world, client).flatten().expect("as deep as it went");
        assert!(seen.depth < 600 && seen.ends.is_some(), "{text}: {}", seen.depth);
        assert!(world.document().metamers() >= before);
        world.command(client, 2, json!({ "kind": "undo" }));
        world.settle();
        assert_eq!(world.document().metamers(), before, "what was is there again");
        assert_eq!(world.document().hash(), world.replayed_hash());
    }
}

#[test]
fn gr1_of_two_people_who_type_the_last_one_wins() {
    let mut world = World::new();
    let (mara, bo) = (world.join("birch-01"), world.join("aspen-01"));
    let text = |branches: &str| format!("axiom: A\nA --> F{branches}/(90)A\n");
    let typed = |world: &mut World, client, id, branches: &str, gesture| {
        let text = text(branches);
        world.command(
            client,
            id,
            json!({ "kind": "set_grammar", "text": text, "depth": 3, "gesture": gesture }),
        );
    };
    typed(&mut world, mara, 1, "[+A]", 1);
    typed(&mut world, bo, 1, "[+A][-A]", 1);
    typed(&mut world, mara, 2, "[&A]", 1);
    typed(&mut world, bo, 2, "[&A][^A]", 1);
    world.settle();
    for client in [mara, bo] {
        let seen = told(&world, client).flatten().expect("it is in force");
        assert_eq!(seen.text, text("[&A][^A]"), "never a mixture");
    }
    assert_eq!(world.document().metamers(), 13);
    assert_eq!(world.document().hash(), world.replayed_hash());
    // Each takes back their own, and what the other typed stays.
    world.command(bo, 3, json!({ "kind": "undo" }));
    world.settle();
    assert_eq!(told(&world, mara).flatten().map(|seen| seen.text), Some(text("[&A]")));
    assert_eq!(world.document().hash(), world.replayed_hash());
}

#[test]
fn gr4_what_takes_long_is_refused_as_it_goes_on() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, json!({ "kind": "set_grammar", "text": TEXT, "depth": 3 }));
    world.settle();
    let (before, metamers) = (world.document().plant().hash(), world.document().metamers());
    let text = "axiom: F(3)B\nB --> BB\n";
    world.command(client, 2, json!({ "kind": "set_grammar", "text": text, "depth": 25 }));
    world.settle();
    let refused = world.peer(client).refused();
    assert_eq!(refused.len(), 1);
    assert_eq!(told(&world, client).flatten().map(|seen| seen.text), Some(TEXT.to_owned()));
    assert_eq!((world.document().plant().hash(), world.document().metamers()), (before, metamers));
    assert_eq!(world.document().hash(), world.replayed_hash());
}
