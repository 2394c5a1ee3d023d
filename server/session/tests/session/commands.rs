//! `CM`: numbers, order, refusals.

use espalier_proto::{ProblemCode, ServerMessage};
use espalier_session::{ClientId, Input};
use espalier_settings::{ParametersPatch, VigorModel};
use serde_json::{Value, json};

use crate::world::{World, grow, person};

fn moved(stroke: u32, height: f32) -> Value {
    let sample = |part: u8| json!({ "position": [0.0, height + f32::from(part), 0.0], "radius": 3.0 });
    json!({ "kind": "stroke_move", "stroke": stroke, "samples": (0..3).map(sample).collect::<Vec<_>>() })
}

#[test]
fn cm1_a_number_taken_is_not_done_twice() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(2));
    world.command(client, 1, grow(2));
    world.settle();
    world.command(client, 1, grow(2));
    world.settle();
    assert_eq!(world.disk.len(), 1);
    assert_eq!(world.document().figures().step, 2);
    assert_eq!(world.peer(client).acknowledged(), [1, 1]);
}

#[test]
fn cm1_what_is_sent_again_is_done_once() {
    let mut world = World::new();
    world.write_ms = 500;
    let client = world.join("birch-01");
    for id in 1..=3 {
        world.command(client, id, grow(1));
    }
    world.leave(client);
    let again = world.join("birch-01");
    assert_eq!(world.peer(again).welcome_acknowledged(), 0);
    for id in 1..=4 {
        world.command(again, id, grow(1));
    }
    world.settle();
    world.pass(2_000);
    assert_eq!(world.document().figures().step, 4);
    assert_eq!(world.disk.len(), 4);
    assert_eq!(world.peer(again).acknowledged().last(), Some(&4));
}

#[test]
fn cm1_a_gap_is_refused() {
    let mut world = World::new();
    let client = world.join("birch-01");
    for id in [0, 2, u32::MAX] {
        world.command(client, id, grow(1));
    }
    world.command(client, 1, grow(1));
    world.settle();
    let refused = world.peer(client).refused();
    assert_eq!(refused.iter().map(|(id, _)| *id).collect::<Vec<_>>(), [0, 2, u32::MAX]);
    assert!(refused.iter().all(|(_, problem)| problem.field.as_deref() == Some("id")));
    assert_eq!(refused[0].1.allowed.as_deref(), Some("1"));
    assert_eq!(world.peer(client).acknowledged(), [1]);
    assert_eq!(world.document().figures().step, 1);
}

#[test]
fn cm1_each_client_counts_for_itself() {
    let mut world = World::new();
    let birch = world.join("birch-01");
    let maple = world.join("maple-01");
    world.command(birch, 1, grow(1));
    world.command(maple, 1, grow(1));
    world.command(birch, 2, grow(1));
    world.settle();
    assert_eq!(world.peer(birch).acknowledged().last(), Some(&2));
    assert_eq!(world.peer(maple).acknowledged().last(), Some(&1));
    assert_eq!(world.document().figures().step, 3);
}

#[test]
fn cm3_refused_for_form_takes_its_number() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(0));
    world.command(client, 2, grow(1));
    world.settle();
    let refused = world.peer(client).refused();
    assert_eq!(refused.len(), 1);
    assert_eq!((refused[0].0, refused[0].1.code), (1, ProblemCode::OutOfRange));
    assert_eq!(refused[0].1.field.as_deref(), Some("steps"));
    assert_eq!(world.disk.iter().map(|entry| entry.id).collect::<Vec<_>>(), [2]);
    assert_eq!(world.peer(client).acknowledged(), [2]);
}

#[test]
fn cm3_a_refused_number_is_refused_again() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(0));
    world.command(client, 1, grow(0));
    world.command(client, 1, grow(5));
    world.settle();
    assert_eq!(world.peer(client).refused().len(), 3);
    assert_eq!(world.document().figures().step, 0);
    assert!(world.disk.is_empty());
}

#[test]
fn cm3_unreadable_commands_take_their_number() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.text(client, r#"{"type":"command","id":1,"command":{"kind":"grill"}}"#);
    world.text(client, r#"{"type":"command","id":2,"command":{"kind":"grow","steps":"many"}}"#);
    world.text(client, r#"{"type":"command","id":3}"#);
    world.command(client, 4, grow(1));
    world.settle();
    let refused = world.peer(client).refused();
    assert_eq!(refused.iter().map(|(id, _)| *id).collect::<Vec<_>>(), [1, 2, 3]);
    assert!(refused.iter().all(|(_, problem)| problem.code == ProblemCode::Malformed));
    assert_eq!(refused[1].1.field.as_deref(), Some("steps"));
    assert_eq!(refused[2].1.field.as_deref(), Some("command"));
    assert_eq!(world.peer(client).acknowledged(), [4]);
}

#[test]
fn cm3_after_a_restart_refused_numbers_may_lack() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(1));
    world.command(client, 2, grow(0));
    world.command(client, 3, grow(0));
    world.settle();
    world.crash();
    let client = world.join("birch-01");
    assert_eq!(world.peer(client).welcome_acknowledged(), 1);
    world.command(client, 4, grow(1));
    world.command(client, 6, grow(1));
    world.settle();
    assert_eq!(world.peer(client).acknowledged(), [4]);
    assert_eq!(world.peer(client).refused().len(), 1, "a second gap is one");
}

#[test]
fn cm3_the_document_refuses_without_a_change() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, json!({ "kind": "undo" }));
    world.settle();
    let before = world.document().hash();
    world.command(client, 2, json!({ "kind": "redo" }));
    world.settle();
    let refused = world.peer(client).refused();
    assert_eq!(refused.iter().map(|(id, _)| *id).collect::<Vec<_>>(), [1, 2]);
    assert!(refused.iter().all(|(_, problem)| !problem.message.is_empty()));
    assert_eq!(world.document().hash(), before);
    assert_eq!(world.peer(client).acknowledged().last(), Some(&2));
}

#[test]
fn cm3_only_the_sender_hears_of_a_refusal() {
    let mut world = World::new();
    let birch = world.join("birch-01");
    let maple = world.join("maple-01");
    world.command(birch, 1, json!({ "kind": "undo" }));
    world.settle();
    assert_eq!(world.peer(birch).refused().len(), 1);
    assert!(world.peer(maple).refused().is_empty());
}

#[test]
fn cm4_the_order_alone_makes_the_document() {
    let mut world = World::new();
    let birch = world.join("birch-01");
    let maple = world.join("maple-01");
    let script = [
        (birch, 1, json!({ "kind": "stroke_begin", "stroke": 1 })),
        (maple, 1, json!({ "kind": "stroke_begin", "stroke": 1 })),
        (birch, 2, moved(1, 1.0)),
        (maple, 2, moved(1, 2.0)),
        (birch, 3, moved(1, 3.0)),
        (maple, 3, grow(7)),
        (birch, 4, json!({ "kind": "stroke_end", "stroke": 1 })),
        (maple, 4, json!({ "kind": "stroke_end", "stroke": 1 })),
        (birch, 5, json!({ "kind": "undo" })),
        (birch, 6, json!({ "kind": "redo" })),
        (maple, 5, json!({ "kind": "ungrow", "steps": 3 })),
    ];
    for (client, id, command) in script {
        world.command(client, id, command);
        world.pass(2);
    }
    world.settle();
    assert!(world.document().figures().metamers > 0);
    assert_eq!(world.document().hash(), world.replayed_hash());
    world.assert_mirrored(birch);
    world.assert_mirrored(maple);
}

#[test]
fn cm5_strokes_end_30_s_after_their_client_left() {
    let mut world = World::new();
    let birch = world.join("birch-01");
    let maple = world.join("maple-01");
    world.command(birch, 1, json!({ "kind": "stroke_begin", "stroke": 4 }));
    world.command(birch, 2, moved(4, 1.0));
    world.settle();
    world.leave(birch);
    world.pass(29_000);
    assert_eq!(world.document().open_strokes(&person("birch-01")), [4]);
    world.pass(1_500);
    assert!(world.document().open_strokes(&person("birch-01")).is_empty());
    let last = world.disk.last().unwrap();
    assert_eq!((last.principal.to_string().as_str(), last.id), ("birch-01", 0));
    assert_eq!(last.command, r#"{"kind":"stroke_end","stroke":4}"#);
    assert!(world.peer(maple).refused().is_empty());
    assert_eq!(world.document().hash(), world.replayed_hash());
    // The session's own command counts for nobody.
    let birch = world.join("birch-01");
    assert_eq!(world.peer(birch).welcome_acknowledged(), 2);
}

#[test]
fn cm5_strokes_stay_open_for_who_returns() {
    let mut world = World::new();
    let birch = world.join("birch-01");
    world.command(birch, 1, json!({ "kind": "stroke_begin", "stroke": 4 }));
    world.settle();
    world.leave(birch);
    world.pass(29_000);
    let birch = world.join("birch-01");
    world.pass(60_000);
    assert_eq!(world.document().open_strokes(&person("birch-01")), [4]);
    world.command(birch, 2, json!({ "kind": "stroke_end", "stroke": 4 }));
    world.settle();
    assert!(world.document().open_strokes(&person("birch-01")).is_empty());
}

#[test]
fn cm5_a_restart_gives_the_absent_their_time_again() {
    let mut world = World::new();
    let birch = world.join("birch-01");
    world.command(birch, 1, json!({ "kind": "stroke_begin", "stroke": 4 }));
    world.settle();
    world.crash();
    world.join("maple-01");
    world.pass(29_000);
    assert_eq!(world.document().open_strokes(&person("birch-01")), [4]);
    world.pass(2_000);
    assert!(world.document().open_strokes(&person("birch-01")).is_empty());
}

#[test]
fn cm8_unknown_messages_are_answered() {
    let mut world = World::new();
    let client = world.join("birch-01");
    let texts = [
        "",
        "{",
        "null",
        "[1]",
        r#"{"type":"water"}"#,
        r#"{"type":"ping"}"#,
        r#"{"type":"ping","nonce":-1}"#,
        r#"{"type":"ping","nonce":1,"more":2}"#,
        r#"{"type":"hello","protocol":4,"client":"birch-01"}"#,
    ];
    for text in texts {
        world.text(client, text);
    }
    world.handle(Input::Binary(ClientId(client)));
    world.send(client, &espalier_proto::ClientMessage::Ping { nonce: 9 });
    world.settle();
    let problems = world.peer(client).problems();
    assert_eq!(problems.len(), texts.len() + 1);
    assert_eq!(problems[5].field.as_deref(), Some("nonce"));
    let codes = problems.iter().map(|problem| problem.code);
    let unlike: Vec<_> = codes.enumerate().filter(|(_, code)| *code != ProblemCode::Malformed).collect();
    assert_eq!(unlike, [(6, ProblemCode::OutOfRange)], "-1 is a number, but out of range");
    let is_answer = |text: &ServerMessage| matches!(text, ServerMessage::Pong { nonce: 9, .. });
    assert!(world.peer(client).texts.iter().any(is_answer));
    assert_eq!(world.peer(client).closed, None);
}

#[test]
fn changed_parameters_are_sent_to_all() {
    let mut world = World::new();
    let birch = world.join("birch-01");
    let maple = world.join("maple-01");
    let patch = ParametersPatch { apical_control: Some(0.56), ..ParametersPatch::default() };
    world.command(birch, 1, json!({ "kind": "set_parameters", "parameters": patch }));
    world.settle();
    for client in [birch, maple] {
        let notified = world.peer(client).texts.iter().find_map(|text| match text {
            ServerMessage::Parameters { parameters } => Some(parameters.apical_control),
            _ => None,
        });
        assert_eq!(notified, Some(0.56));
    }
    assert_eq!(world.document().hash(), world.replayed_hash());
}

#[test]
fn choices_and_maturity_survive_journal_snapshot_and_undo() {
    let mut world = World::new();
    let client = world.join("birch-01");
    let patch = ParametersPatch {
        vigor_model: Some(VigorModel::Priority),
        priority_least_weight: Some(0.5),
        mature_apical_control: Some(0.46),
        maturity_start: Some(3),
        maturity_steps: Some(7),
        phototropism: Some(0.25),
        ..ParametersPatch::default()
    };
    world.command(client, 1, grow(2));
    world.command(client, 2, json!({ "kind": "set_parameters", "parameters": patch.clone() }));
    world.command(client, 3, grow(9));
    world.settle();
    let wanted = World::new().document().parameters().patched(&patch);
    assert_eq!(world.document().parameters(), wanted);
    assert_eq!(world.document().hash(), world.replayed_hash());
    world.pass(40_000);
    assert!(world.snapshots > 0);
    world.crash();
    assert_eq!(world.document().parameters(), wanted);
    assert_eq!(world.document().hash(), world.replayed_hash());
    let client = world.join("birch-01");
    world.command(client, 4, json!({ "kind": "undo" }));
    world.command(client, 5, json!({ "kind": "undo" }));
    world.settle();
    assert_eq!(world.document().parameters(), World::new().document().parameters());
}

#[test]
fn figures_follow_the_document() {
    let mut world = World::new();
    let birch = world.join("birch-01");
    let maple = world.join("maple-01");
    world.command(birch, 1, grow(9));
    world.settle();
    let state = world.peer(maple).last_state().unwrap();
    let figures = world.document().figures();
    assert_eq!((state.step, state.metamers), (figures.step, figures.metamers));
    assert_eq!((state.step, state.pending_steps, state.can_undo), (9, 0, true));
}
