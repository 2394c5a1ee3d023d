use espalier_proto::{ClientMessage, DocumentState, ProblemCode};
use espalier_settings::{Kind, ParameterValues};
use espalier_tests::{client::Client, dice::Dice, scratch::Scratch, server::Server, table::Row};
use serde_json::{Value, json};
use tokio_tungstenite::tungstenite::Message;

/// A session with a small tree, and what it looked like before the bad input.
struct Patient {
    client: Client,
    state: DocumentState,
    rows: Vec<Row>,
    _server: Server,
    _scratch: Scratch,
}

impl Patient {
    async fn new() -> Self {
        let scratch = Scratch::new();
        let server = Server::start(&scratch.path("trees.db"));
        let session = server.new_session(7);
        let mut client = Client::connect(server.port(), &session, "browser-1").await;
        client.send(json!({ "kind": "grow", "steps": 4 })).await;
        // An open stroke, so that a stroke_move is refused for its samples and not for its stroke.
        client.send(json!({ "kind": "stroke_begin", "stroke": 1 })).await;
        client.until_settled().await;
        let (state, rows) = (client.state.clone(), client.table.rows.clone());
        Self { client, state, rows, _server: server, _scratch: scratch }
    }

    /// A ping comes back and nothing has changed.
    async fn is_unharmed(&mut self, after: &str) {
        let nonce = self.client.pongs.len() as u32;
        self.client.send_message(&ClientMessage::Ping { nonce }).await;
        self.client.until("the session lives on", |client| client.pongs.contains(&nonce)).await;
        // A command that waits to be refused counts as a step still to be done.
        self.client.until("the refusal is done", |client| client.state.pending_steps == 0).await;
        assert_eq!(self.client.state, self.state, "after {after}");
        assert!(self.client.table.rows == self.rows, "the rows changed after {after}");
    }

    /// Sends a message that must be answered with a problem, and returns that.
    async fn problem(&mut self, message: Message, shown: &str) -> espalier_proto::Problem {
        let before = self.client.problems.len();
        self.client.send_raw(message).await;
        self.client
            .until(&format!("CM8: a problem for {shown}"), |client| client.problems.len() > before)
            .await;
        self.is_unharmed(shown).await;
        self.client.problems[before].clone()
    }

    /// Sends a command, as JSON, that must be refused, and returns why.
    async fn refusal(&mut self, command: &Value) -> espalier_proto::Problem {
        self.refusal_of(&command.to_string()).await
    }

    /// The same for a command as text, which may be no JSON.
    async fn refusal_of(&mut self, command: &str) -> espalier_proto::Problem {
        let shown: String = command.chars().take(120).collect();
        let id = self.client.take_number();
        let before = self.client.refused.len();
        let message = format!(r#"{{"type":"command","id":{id},"command":{command}}}"#);
        self.client.send_raw(Message::text(message)).await;
        self.client.until(&format!("CM3: {shown} is refused"), |client| client.refused.len() > before).await;
        self.is_unharmed(&shown).await;
        let (refused, problem) = self.client.refused[before].clone();
        assert_eq!(refused, id, "{shown}");
        problem
    }

    /// What follows bad input still works, under the next number (`CM3`).
    async fn still_grows(mut self) {
        let step = self.client.state.step;
        self.client.send(json!({ "kind": "grow", "steps": 1 })).await;
        self.client.until_settled().await;
        assert_eq!(self.client.state.step, step + 1);
    }
}

#[tokio::test]
async fn cm8_a_message_that_is_no_control_message_is_a_problem() {
    let mut patient = Patient::new().await;
    let nested = "[".repeat(100_000);
    let messages = [
        "",
        "{",
        "null",
        "42",
        "\"hello\"",
        "[]",
        "{}",
        r#"{"type":"dance"}"#,
        r#"{"type":"ping"}"#,
        r#"{"type":"ping","nonce":-1}"#,
        r#"{"type":"ping","nonce":4294967296}"#,
        r#"{"type":"ping","nonce":1,"more":2}"#,
        r#"{"type":"command","id":4294967296,"command":{"kind":"undo"}}"#,
        r#"{"type":"command","id":"3","command":{"kind":"undo"}}"#,
        &nested,
        &format!(r#"{{"type":"command","id":3,"command":{nested}"#),
    ];
    for message in messages {
        let shown: String = message.chars().take(120).collect();
        let problem = patient.problem(Message::text(message.to_owned()), &shown).await;
        let is_number = shown.contains("-1") || shown.contains(":4294967296");
        let code = if is_number { ProblemCode::OutOfRange } else { ProblemCode::Malformed };
        assert_eq!(problem.code, code, "{shown}: {problem:?}");
        assert!(problem.message.len() > 10, "{shown}: {problem:?}");
    }
    patient.still_grows().await;
}

#[tokio::test]
async fn cm8_what_is_unknown_is_named() {
    let mut patient = Patient::new().await;
    for (message, name) in [
        (r#"{"type":"dance"}"#, "dance"),
        (r#"{"type":"ping"}"#, "nonce"),
        (r#"{"type":"ping","nonce":1,"more":2}"#, "more"),
    ] {
        let problem = patient.problem(Message::text(message), message).await;
        assert!(problem.message.contains(name), "{name} in {problem:?}");
    }
    patient.still_grows().await;
}

#[tokio::test]
async fn cm8_a_binary_message_is_a_problem() {
    let mut patient = Patient::new().await;
    for bytes in [vec![], vec![1, 1, 0, 0], vec![0xff; 60_000]] {
        let shown = format!("{} bytes", bytes.len());
        let problem = patient.problem(Message::binary(bytes), &shown).await;
        assert!(problem.message.contains("inary"), "{problem:?}");
    }
    patient.still_grows().await;
}

#[tokio::test]
async fn cm3_a_command_that_cannot_be_read_is_refused() {
    let mut patient = Patient::new().await;
    let cases = [
        (json!({"kind": "fell"}), "fell"),
        (json!({"kind": "grow"}), "steps"),
        (json!({"kind": "grow", "steps": 1.5}), "steps"),
        (json!({"kind": "grow", "steps": -1}), "steps"),
        (json!({"kind": "grow", "steps": 1, "speed": 2}), "speed"),
        (json!({"kind": "plant_seed", "position": [0, 0]}), "position"),
        (json!({"kind": "plant_seed", "position": [0, "up", 0]}), "position"),
        (json!({"kind": "stroke_move", "stroke": 1, "samples": [{"position": [0, 0, 0]}]}), "radius"),
        (json!({"kind": "set_parameters", "parameters": {"height": 3}}), "height"),
        (json!({"kind": "set_parameters", "parameters": {"leaf_size": "big"}}), "leaf_size"),
        (json!({}), "kind"),
        (json!(null), ""),
    ];
    for (command, word) in cases {
        let problem = patient.refusal(&command).await;
        let code = if command["steps"] == -1 { ProblemCode::OutOfRange } else { ProblemCode::Malformed };
        assert_eq!(problem.code, code, "{command}: {problem:?}");
        assert!(problem.message.len() > 10 && problem.message.contains(word), "{command}: {problem:?}");
    }
    patient.still_grows().await;
}

fn sample(position: [f64; 3], radius: f64) -> Value {
    json!({"position": position, "radius": radius})
}

fn stroke_move(samples: &[Value]) -> Value {
    json!({"kind": "stroke_move", "stroke": 1, "samples": samples})
}

#[tokio::test]
async fn lm2_lm3_out_of_range_names_the_field_and_the_range() {
    let mut patient = Patient::new().await;
    let fine = sample([0.0, 1.0, 0.0], 1.0);
    let cases = [
        (stroke_move(&[sample([0.0, 1.0, 0.0], 1e9)]), "samples[0].radius", "0 to 40"),
        (stroke_move(&[fine.clone(), sample([0.0, 1.0, 0.0], 40.01)]), "samples[1].radius", "0 to 40"),
        (stroke_move(&[sample([0.0, 1.0, 0.0], -0.01)]), "samples[0].radius", "0 to 40"),
        (stroke_move(&[sample([0.0, 1.0, 0.0], 1e39)]), "samples[0].radius", "0 to 40"),
        (stroke_move(&[sample([1000.5, 1.0, 0.0], 1.0)]), "samples[0].position", "1000"),
        (stroke_move(&[sample([0.0, 1000.5, 0.0], 1.0)]), "samples[0].position", "1000"),
        (stroke_move(&[sample([0.0, -10.5, 0.0], 1.0)]), "samples[0].position", "-10"),
        (stroke_move(&[sample([0.0, 1.0, -1e39], 1.0)]), "samples[0].position", "1000"),
        (stroke_move(&[]), "samples", "1 to 256"),
        (stroke_move(&vec![fine.clone(); 257]), "samples", "1 to 256"),
        (stroke_move(&vec![fine.clone(); 5000]), "samples", "1 to 256"),
        (json!({"kind": "grow", "steps": 0}), "steps", "1 to 1000"),
        (json!({"kind": "grow", "steps": 1001}), "steps", "1 to 1000"),
        (json!({"kind": "grow", "steps": u32::MAX}), "steps", "1 to 1000"),
        (json!({"kind": "ungrow", "steps": 0}), "steps", "1 to 1000"),
        (json!({"kind": "ungrow", "steps": 1001}), "steps", "1 to 1000"),
        (json!({"kind": "plant_seed", "position": [1e9, 0, 0]}), "position", "1000"),
        (json!({"kind": "plant_seed", "position": [0, 1e39, 0]}), "position", ""),
    ];
    for (command, field, allowed) in cases {
        let shown: String = command.to_string().chars().take(120).collect();
        let problem = patient.refusal(&command).await;
        let said = problem.field.clone().unwrap_or_default();
        assert!(said.starts_with(field), "{shown}: {problem:?}");
        let range = problem.allowed.clone().unwrap_or_default().replace('−', "-");
        assert!(range.contains(allowed) && !range.is_empty(), "{shown}: {problem:?}");
        assert!(problem.message.contains(&said), "{shown}: {problem:?}");
    }
    patient.still_grows().await;
}

#[tokio::test]
async fn numbers_that_json_does_not_have_name_their_field() {
    let mut patient = Patient::new().await;
    for (command, field, allowed) in [
        (r#"{"kind":"grow","steps":NaN}"#, "steps", "1 to 1000"),
        (r#"{"kind":"plant_seed","position":[0,NaN,0]}"#, "position[1]", "-10 to 1000"),
        (r#"{"kind":"plant_seed","position":[0,1e999,0]}"#, "position[1]", "-10 to 1000"),
        (
            r#"{"kind":"set_parameters","parameters":{"apical_control":NaN}}"#,
            "parameters.apical_control",
            "0.4 to 0.7",
        ),
        (
            r#"{"kind":"stroke_move","stroke":1,"samples":[{"position":[0,1,0],"radius":NaN}]}"#,
            "samples[0].radius",
            "0 to 40",
        ),
        (
            r#"{"kind":"stroke_move","stroke":1,"samples":[{"position":[0,1,0],"radius":-Infinity}]}"#,
            "samples[0].radius",
            "0 to 40",
        ),
    ] {
        let problem = patient.refusal_of(command).await;
        assert_eq!(problem.field.as_deref(), Some(field), "{command}: {problem:?}");
        assert!(problem.allowed.clone().unwrap_or_default().contains(allowed), "{command}: {problem:?}");
    }
    patient.still_grows().await;
}

#[tokio::test]
async fn cm5_a_stroke_that_was_not_begun_is_refused() {
    let mut patient = Patient::new().await;
    let samples = [sample([0.0, 1.0, 0.0], 1.0)];
    for command in [
        json!({"kind": "stroke_move", "stroke": 2, "samples": samples}),
        json!({"kind": "stroke_move", "stroke": u32::MAX, "samples": samples}),
        json!({"kind": "stroke_end", "stroke": 2}),
        json!({"kind": "stroke_begin", "stroke": 1}),
    ] {
        let problem = patient.refusal(&command).await;
        assert!(problem.message.contains("stroke"), "{command}: {problem:?}");
    }
    patient.still_grows().await;
}

#[tokio::test]
async fn every_parameter_is_refused_beyond_both_ends() {
    let mut patient = Patient::new().await;
    let defaults = serde_json::to_value(ParameterValues::default()).expect("parameters are JSON");
    for row in ParameterValues::ROWS {
        let Kind::Number { least, most, .. } = row.kind else { continue };
        let is_whole = defaults[row.name].is_u64();
        let beyond = if is_whole { 1.0 } else { 0.001 };
        for value in [least - beyond, most + beyond] {
            if is_whole && value < 0.0 {
                continue;
            }
            let value = if is_whole { json!(value as u32) } else { json!(value) };
            let command = json!({"kind": "set_parameters", "parameters": {row.name: value}});
            let problem = patient.refusal(&command).await;
            assert_eq!(problem.code, ProblemCode::OutOfRange, "{command}");
            assert_eq!(problem.field, Some(format!("parameters.{}", row.name)), "{command}");
            assert_eq!(problem.allowed, Some(format!("{least} to {most}")), "{command}");
        }
    }
    patient.still_grows().await;
}

#[tokio::test]
async fn every_parameter_is_accepted_at_both_ends() {
    let mut patient = Patient::new().await;
    // The three weights have a sum to keep, so they move together.
    let weights = |heading: f64, tropism: f64, space: f64| json!({"heading_weight": heading, "tropism_weight": tropism, "space_weight": space});
    let mut patches = vec![weights(1.0, 0.0, 0.0), weights(0.0, 1.0, 0.0), weights(0.0, 0.0, 1.0)];
    let defaults = serde_json::to_value(ParameterValues::default()).expect("parameters are JSON");
    for row in ParameterValues::ROWS {
        match row.kind {
            Kind::Number { .. } if row.group == Some("weights") => {}
            Kind::Number { least, most, .. } if defaults[row.name].is_u64() => {
                patches.extend([least, most].map(|end| json!({row.name: end as u32})));
            }
            Kind::Number { least, most, .. } => {
                patches.extend([least, most].map(|end| json!({row.name: end})));
            }
            Kind::Switch => patches.extend([true, false].map(|on| json!({row.name: on}))),
            Kind::Choice { choices } => {
                patches.extend(choices.iter().map(|choice| json!({row.name: choice})))
            }
            Kind::Colour => panic!("no parameter of growth is a colour"),
        }
    }
    for patch in patches {
        let id = patient.client.take_number();
        let command = json!({"kind": "set_parameters", "parameters": patch});
        let message = json!({"type": "command", "id": id, "command": command}).to_string();
        patient.client.send_raw(Message::text(message)).await;
        patient.client.until(&format!("{patch} is taken"), |client| client.acknowledged >= id).await;
        assert_eq!(patient.client.refused, [], "{patch}");
    }
}

#[tokio::test]
async fn a_patch_with_one_bad_value_changes_nothing() {
    let mut patient = Patient::new().await;
    let parameters = patient.client.parameters.clone();
    for patch in [
        json!({"leaf_size": 1.5, "apical_control": 0.9}),
        json!({"heading_weight": 0.41}),
        json!({"heading_weight": 1, "tropism_weight": 1, "space_weight": 1}),
    ] {
        patient.refusal(&json!({"kind": "set_parameters", "parameters": patch})).await;
        assert_eq!(patient.client.parameters, parameters, "{patch}");
    }
    let key = "browser-2";
    let session = patient.client.session.clone();
    let other = Client::connect(patient._server.port(), &session, key).await;
    assert_eq!(other.parameters, parameters);
}

#[tokio::test]
async fn mutilated_messages_never_end_the_session() {
    let mut patient = Patient::new().await;
    let mut dice = Dice::new(41);
    let whole = [
        r#"{"type":"ping","nonce":7}"#,
        r#"{"type":"received","sequence":1}"#,
        r#"{"type":"hello","protocol":4,"client":"browser-1","resume":{"epoch":1,"generations":[1,2],"rows":300}}"#,
        r#"{"type":"command","id":900,"command":{"kind":"stroke_move","stroke":3,"samples":[{"position":[0,1.5,0],"radius":2}]}}"#,
        r#"{"type":"command","id":900,"command":{"kind":"set_parameters","parameters":{"leaf_size":1.5,"trunk_upward":true}}}"#,
        r#"{"type":"command","id":900,"command":{"kind":"plant_seed","position":[1e1,0,-2]}}"#,
    ];
    let debris =
        ["\"", "{", "}", "[", "]", ",", ":", "-", "1e400", "null", "\\u0000", "\u{fffd}", "99999999999", ""];
    for _ in 0..1500 {
        let mut message = whole[dice.roll(whole.len())].to_owned();
        for _ in 0..=dice.roll(3) {
            let start = dice.roll(message.len() + 1);
            let end = (start + dice.roll(4)).min(message.len());
            message.replace_range(start..end, debris[dice.roll(debris.len())]);
            // Every piece is ASCII or stands whole, but a cut may go through the one that is not.
            if !message.is_ascii() {
                break;
            }
        }
        patient.client.send_raw(Message::text(message)).await;
        // Answers are read as they come, or this client would be a slow one.
        patient.client.listen(std::time::Duration::from_micros(200)).await;
    }
    assert!(patient.client.is_connected(), "{:?}", patient.client.closed);
    patient.is_unharmed("1500 mutilated messages").await;
    patient.still_grows().await;
}
