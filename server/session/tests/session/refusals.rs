//! Every refusal of a message names the field at fault and what is allowed there (`CM3`, `CM8`).

use espalier_proto::{ClientMessage, Problem, Reason, Unreadable};
use espalier_session::{Document, Principal, read_command};
use serde_json::{Value, json};

use crate::obstacles::tetrahedron;

/// One command of each kind, with all its fields.
pub(crate) fn commands() -> Vec<Value> {
    let pose = json!({ "position": [1, 2, 3], "rotation": [0, 0, 0, 1] });
    let looks = Value::from_iter([("appearance", json!(espalier_settings::Appearance::default()))]);
    let mut set_appearance = looks;
    set_appearance["kind"] = "set_appearance".into();
    let parameters = Document::new(1).parameters();
    let mesh = json!({ "kind": "mesh", "mesh": tetrahedron().to_base64(), "scale": 1 });
    let stages = json!([
        { "kind": "change", "age": 0, "parameters": { "shedding_threshold": 0.5, "trunk_upward": true } },
        { "kind": "seed", "age": 3, "position": [1, 0, 2] },
        { "kind": "stroke", "age": 4, "samples": [{ "position": [0, 1, 0], "radius": 4 }] },
    ]);
    let programme =
        json!({ "species": "oak", "parameters": { "branching_angle": 40 }, "stages": stages, "age": 20 });
    vec![
        json!({ "kind": "stroke_begin", "stroke": 1, "bud": 0 }),
        json!({ "kind": "stroke_move", "stroke": 1, "samples": [{ "position": [0, 1, 0], "radius": 4 }] }),
        json!({ "kind": "stroke_end", "stroke": 1 }),
        json!({ "kind": "grow", "steps": 3, "until": 9, "gesture": 4, "bud": 7 }),
        json!({
            "kind": "lasso", "outline": [[0, 0], [1, 0], [1, 1]], "depth": 0.5, "bud": 1,
            "plane": { "origin": [0, 0, 0], "right": [1, 0, 0], "up": [0, 1, 0] },
        }),
        json!({ "kind": "stop", "tick": 9 }),
        json!({ "kind": "ungrow", "steps": 2 }),
        json!({ "kind": "undo" }),
        json!({ "kind": "redo" }),
        json!({ "kind": "take_back" }),
        json!({ "kind": "bring_back" }),
        json!({ "kind": "set_parameters", "parameters": parameters, "gesture": 1 }),
        json!({ "kind": "set_programme", "programme": programme, "keep": true, "gesture": 1 }),
        json!({ "kind": "follow_programme", "parameters": ["apical_control"], "gesture": 1 }),
        set_appearance,
        json!({ "kind": "plant_seed", "position": [1, 0, 2] }),
        json!({ "kind": "place_obstacle", "obstacle": { "shape": mesh, "pose": pose }, "gesture": 1 }),
        json!({ "kind": "place_obstacle", "obstacle": { "shape": { "kind": "plane" }, "pose": pose } }),
        json!({ "kind": "move_obstacle", "id": 1, "pose": pose, "gesture": 1 }),
        json!({ "kind": "reshape_obstacle", "id": 1, "shape": { "kind": "box", "size": [1, 2, 3] } }),
        json!({ "kind": "reshape_obstacle", "id": 1, "shape": { "kind": "sphere", "radius": 2 } }),
        json!({ "kind": "remove_obstacle", "id": 1, "gesture": 1 }),
        json!({ "kind": "bend_begin", "bend": 1, "base": 2, "touches": [3, 4], "stretch": 0.5, "gesture": 1 }),
        json!({ "kind": "bend_move", "bend": 1, "targets": [[0, 1, 0], [0, 2, 0]] }),
        json!({ "kind": "bend_end", "bend": 1 }),
        json!({ "kind": "bend_cancel", "bend": 1 }),
        json!({ "kind": "set_width", "row": 1, "diameter": 0.5, "gesture": 1 }),
        json!({ "kind": "prune", "rows": [1, 2], "gesture": 1 }),
        json!({ "kind": "prune_dim", "exposure": 0.1 }),
        json!({ "kind": "turn_branch", "row": 1, "rotation": [0, 0, 0, 1], "gesture": 1 }),
        json!({ "kind": "graft", "row": 1, "onto": 2, "rotation": [0, 0, 0, 1], "keep": true }),
        json!({ "kind": "new_design", "position": [1, 0, 2], "template": "chokkan" }),
        json!({ "kind": "edit_design", "edits": [
            { "edit": "set", "of": "/1", "key": "reach", "value": { "multiply": 1.5, "private": true } },
            { "edit": "clear", "of": "level 2", "key": "roll" },
            { "edit": "name", "node": "/1", "name": "left" },
            { "edit": "share", "share": 1, "key": "roll", "value": 5, "members": ["/1", "/2"] },
            { "edit": "set_shared", "share": 1, "value": 6 },
            { "edit": "anchor", "node": "/1", "at": 0.5 },
            { "edit": "wake", "node": "/1" },
            { "edit": "forget", "node": "/1" },
            { "edit": "copy", "from": "/1", "to": "/2" },
            { "edit": "seed", "seed": 3 },
        ] }),
        json!({ "kind": "release_design" }),
        json!({ "kind": "fit_design", "row": 1, "orders": 3 }),
        json!({
            // What an envelope is, designs say: here it is any JSON.
            "kind": "refill", "row": 1, "envelope": 2, "rotation": [0, 0, 0, 1], "length": 8, "anew": true,
        }),
        json!({
            "kind": "set_grammar", "text": "axiom: A\nA --> F[+A]A", "seed": 3, "position": [1, 0, 2], "depth": 2,
            "values": [{ "name": "a", "value": 20 }], "gesture": 1,
            "within": {
                "outline": [[0, 0], [1, 0], [1, 1]], "depth": 0.5,
                "plane": { "origin": [0, 0, 0], "right": [1, 0, 0], "up": [0, 1, 0] },
            },
        }),
        json!({
            "kind": "set_grammar_body", "gesture": 1,
            "within": {
                "outline": [[0, 0], [1, 0], [1, 1]], "depth": 0.5,
                "plane": { "origin": [0, 0, 0], "right": [1, 0, 0], "up": [0, 1, 0] },
            },
        }),
        json!({ "kind": "derive", "steps": 2, "gesture": 1 }),
        json!({ "kind": "set_grammar_values", "values": [{ "name": "a", "value": 20 }], "gesture": 1 }),
        json!({ "kind": "go_to", "step": 1 }),
        json!({ "kind": "take_future", "future": 1 }),
    ]
}

/// An envelope as designs write it.
fn ovoid() -> Value {
    json!({
        "top": [0, 1, 0], "bottom": [0, 0, 0], "radii": [0.4, 0.4, 0.4, 0.4], "heights": [0.5, 0.5, 0.5, 0.5],
        "upper": 2, "lower": 2, "tip": [0, 1, 0],
    })
}

/// One message of each type but commands.
pub(crate) fn messages() -> Vec<Value> {
    let resume = json!({ "epoch": 1, "generations": [1, 2], "rows": 3 });
    vec![
        json!({ "type": "hello", "protocol": 4, "client": "birch-01", "resume": resume }),
        json!({ "type": "received", "sequence": 1, "kind": 2 }),
        json!({ "type": "predict", "rows": [1], "steps": 3 }),
        json!({
            "type": "here",
            "pointer": { "kind": "wood", "row": 3, "along": 0.5, "offset": [0.5, 0.0, -1.0] },
            "radius": 2.0,
            "tool": "brush",
            "sketch": [[0.0, 1.0, 2.0]],
            "camera": { "target": [0.0, 8.0, 0.0], "yaw": 90.0, "pitch": -5.0, "distance": 40.0 },
            "away": true,
            "name": "Ann",
        }),
        json!({ "type": "here", "pointer": { "kind": "space", "position": [0.5, 1.0, 2.0] } }),
        json!({ "type": "look_at_limb", "row": 4 }),
        json!({ "type": "follow", "device": 2 }),
        json!({
            "type": "gather",
            "camera": { "target": [0.0, 8.0, 0.0], "yaw": 90.0, "pitch": -5.0, "distance": 40.0 },
        }),
        json!({ "type": "ping", "nonce": 1 }),
    ]
}

/// A way to a value inside another one, as a refusal names it, and as JSON does.
#[derive(Clone)]
struct Way {
    name: String,
    pointer: String,
}

/// The ways to all values inside a value, and to itself.
fn ways(value: &Value, at: &Way, found: &mut Vec<Way>) {
    found.push(at.clone());
    let inner: Vec<(String, String, &Value)> = match value {
        Value::Object(fields) => fields
            .iter()
            .map(|(key, inner)| {
                let dot = if at.name.is_empty() { "" } else { "." };
                (format!("{dot}{key}"), key.clone(), inner)
            })
            .collect(),
        Value::Array(entries) => {
            let named = |(index, inner)| (format!("[{index}]"), format!("{index}"), inner);
            entries.iter().enumerate().map(named).collect()
        }
        _ => Vec::new(),
    };
    for (name, key, inner) in inner {
        let way = Way { name: at.name.clone() + &name, pointer: format!("{}/{key}", at.pointer) };
        ways(inner, &way, found);
    }
}

/// A text with something wrong in it, and the field that its refusal should name, or one inside it.
pub(crate) fn mistakes(sample: &Value) -> Vec<(String, String)> {
    let mut all = Vec::new();
    ways(sample, &Way { name: String::new(), pointer: String::new() }, &mut all);
    let mut mistakes = Vec::new();
    for Way { name, pointer } in all {
        let changed = |change: &dyn Fn(&mut Value)| {
            let mut copy = sample.clone();
            copy.pointer_mut(&pointer).map(change);
            copy.to_string()
        };
        if let Some(Value::Object(_)) = sample.pointer(&pointer) {
            let dot = if name.is_empty() { "" } else { "." };
            mistakes.push((changed(&|it| it["extra"] = 1.into()), format!("{name}{dot}extra")));
        }
        if name.is_empty() {
            continue;
        }
        for wrong in [
            json!("x"),
            json!(true),
            json!(null),
            json!(-1),
            json!(1.5),
            json!(1e6),
            json!(-1e6),
            json!(1e39),
            json!([]),
            json!({}),
            json!([1, 2, 3, 4, 5]),
            json!({ "extra": 1 }),
            json!(u64::MAX),
        ] {
            mistakes.push((changed(&|it| *it = wrong.clone()), name.clone()));
        }
        for number in ["NaN", "1e999", "-Infinity"] {
            let text = changed(&|it| *it = "@".into()).replace("\"@\"", number);
            mistakes.push((text, name.clone()));
        }
        if let Some(Value::Array(entries)) = sample.pointer(&pointer) {
            let many = vec![entries[0].clone(); 5000];
            mistakes.push((changed(&|it| *it = json!(many)), name.clone()));
        }
        let (outer, key) = pointer.rsplit_once('/').expect("it is inside something");
        let mut copy = sample.clone();
        match copy.pointer_mut(outer).expect("it is there") {
            Value::Object(fields) => drop(fields.remove(key)),
            Value::Array(entries) => drop(entries.pop()),
            _ => {}
        }
        let whole = name.trim_end_matches(&format!("[{key}]")).to_owned();
        mistakes.push((copy.to_string(), whole));
    }
    mistakes
}

/// The sample with each object in it as a list of its values, in the order of their names and in the other, and of none.
fn nameless(sample: &Value) -> Vec<String> {
    let mut all = Vec::new();
    ways(sample, &Way { name: String::new(), pointer: String::new() }, &mut all);
    let lists = all.iter().filter_map(|Way { pointer, .. }| {
        let Some(Value::Object(fields)) = sample.pointer(pointer) else { return None };
        let values: Vec<Value> = fields.values().cloned().collect();
        let reversed: Vec<Value> = values.iter().rev().cloned().collect();
        Some([values, reversed, vec![]].map(|list| {
            let mut copy = sample.clone();
            if let Some(it) = copy.pointer_mut(pointer) {
                *it = list.into();
            }
            copy.to_string()
        }))
    });
    lists.flatten().collect()
}

#[derive(Debug, Default, PartialEq)]
struct Count {
    refused: usize,
    nameless: Vec<String>,
    without_range: Vec<String>,
}

fn count(samples: &[Value], read: impl Fn(&str) -> Result<(), Problem>) -> Count {
    let mut count = Count::default();
    for sample in samples {
        assert_eq!(read(&sample.to_string()), Ok(()), "{sample}");
        for (text, wanted) in mistakes(sample) {
            let Err(problem) = read(&text) else { continue };
            count.refused += 1;
            let Problem { field, allowed, message, .. } = problem;
            let answer = format!("{text:.120} at {wanted}: {message:.200}");
            let field = field.unwrap_or_default();
            // One wrong value may make the whole wrong that it is part of, or its neighbour.
            let section = wanted.rsplit_once(['.', '[']).map_or(&*wanted, |(outer, _)| outer);
            if field.is_empty() || !field.starts_with(section) || !message.contains(&field) {
                count.nameless.push(format!("{answer} ({field})"));
            }
            if allowed.is_none_or(|allowed| allowed.is_empty() || !message.contains(&allowed)) {
                count.without_range.push(answer);
            }
        }
    }
    count
}

fn check(count: &Count, least: usize) {
    println!(
        "{} refusals: {} without a field, {} without what is allowed",
        count.refused,
        count.nameless.len(),
        count.without_range.len()
    );
    assert!(count.refused > least, "only {} refusals", count.refused);
    assert!(count.nameless.is_empty(), "{:#?}", &count.nameless[..count.nameless.len().min(20)]);
    assert!(
        count.without_range.is_empty(),
        "{:#?}",
        &count.without_range[..count.without_range.len().min(20)]
    );
}

#[test]
fn cm3_every_refused_command_names_field_and_range() {
    check(&count(&commands(), |text| read_command(text).map(drop)), 3000);
}

#[test]
fn cm8_every_refused_message_names_field_and_range() {
    let read = |text: &str| ClientMessage::from_json(text).map(drop).map_err(|unread| unread.problem);
    check(&count(&messages(), read), 150);
}

#[test]
fn cm8_what_is_no_message_at_all_is_named_as_the_message() {
    for (text, allowed) in
        [("{", "JSON"), ("", "JSON"), ("[]", "an object with type"), ("5", "an object with type")]
    {
        let Unreadable { id, problem } = ClientMessage::from_json(text).expect_err(text);
        let found = (id, problem.field.as_deref(), problem.allowed.as_deref());
        assert_eq!(found, (None, Some("message"), Some(allowed)), "{text}");
    }
}

#[test]
fn cm3_a_name_that_stands_twice_is_refused() {
    for (text, id, field) in [
        (r#"{"type":"command","id":7,"command":{"kind":"grow","steps":1,"steps":2}}"#, Some(7), "steps"),
        (r#"{"type":"command","id":7,"id":8,"command":{"kind":"undo"}}"#, None, "id"),
        (r#"{"type":"ping","nonce":1,"nonce":1}"#, None, "nonce"),
    ] {
        let unread = ClientMessage::from_json(text).expect_err(text);
        let problem = &unread.problem;
        let found = (unread.id, problem.field.as_deref(), problem.allowed.as_deref());
        assert_eq!(found, (id, Some(field), Some("once")), "{text}");
    }
}

#[test]
fn cm3_no_object_is_read_from_a_list() {
    let refused = |text: &String, read: Result<(), Problem>| {
        let problem = read.expect_err(text);
        assert!(
            problem.allowed.is_some_and(|allowed| !allowed.is_empty()),
            "{text:.120}: {}",
            problem.message
        );
    };
    for text in commands().iter().flat_map(nameless) {
        refused(&text, read_command(&text).map(drop));
    }
    for text in messages().iter().flat_map(nameless) {
        refused(&text, ClientMessage::from_json(&text).map(drop).map_err(|unread| unread.problem));
    }
}

/// What is refused for what the document is: what was done before, the command, and the field that it should name.
fn by_state() -> Vec<(Reason, Vec<Value>, Value, &'static str)> {
    let stroke = |stroke: u32| json!({ "kind": "stroke_begin", "stroke": stroke });
    let place = |shape: &Value| json!({ "kind": "place_obstacle", "obstacle": { "shape": shape, "pose": { "position": [40, 3, 0] } } });
    let ball = json!({ "kind": "sphere", "radius": 2 });
    let mesh = json!({ "kind": "mesh", "mesh": tetrahedron().to_base64(), "scale": 1 });
    let grow = |steps: u32| json!({ "kind": "grow", "steps": steps });
    let refill = |row: u32, envelope: &Value, length: f32| json!({ "kind": "refill", "row": row, "envelope": envelope, "rotation": [0, 0, 0, 1], "length": length });
    let mut inside_out = ovoid();
    inside_out["top"] = json!([0, -1, 0]);
    let turned = json!([0, 0.6, 0, 0.8]);
    let line = json!({
        "kind": "lasso", "outline": [[0, 0], [0, 0], [0, 0]], "depth": 0.5,
        "plane": { "origin": [0, 0, 0], "right": [1, 0, 0], "up": [0, 1, 0] },
    });
    vec![
        (Reason::NothingToUndo, vec![], json!({ "kind": "undo" }), "kind"),
        (Reason::NothingToRedo, vec![grow(1)], json!({ "kind": "redo" }), "kind"),
        (Reason::NothingToUngrow, vec![], json!({ "kind": "ungrow", "steps": 1 }), "kind"),
        (Reason::OutOfRange, vec![grow(1)], json!({ "kind": "go_to", "step": 9 }), "step"),
        (Reason::NoDimBranch, vec![grow(3)], json!({ "kind": "prune_dim", "exposure": 0 }), "exposure"),
        (Reason::NumberTaken, vec![stroke(1)], stroke(1), "stroke"),
        (Reason::StrokesFull, (0..32).map(stroke).collect(), stroke(32), "stroke"),
        (Reason::StrokeGone, vec![], json!({ "kind": "stroke_end", "stroke": 1 }), "stroke"),
        (Reason::BendGone, vec![], json!({ "kind": "bend_cancel", "bend": 1 }), "bend"),
        (Reason::FutureGone, vec![], json!({ "kind": "take_future", "future": 1 }), "future"),
        (Reason::ObstacleGone, vec![], json!({ "kind": "remove_obstacle", "id": 1 }), "id"),
        (Reason::ObstaclesFull, vec![place(&ball); 64], place(&ball), "obstacle"),
        (
            Reason::MeshKeepsShape,
            vec![place(&mesh)],
            json!({ "kind": "reshape_obstacle", "id": 1, "shape": ball }),
            "id",
        ),
        (
            Reason::NoProgramme,
            vec![],
            json!({ "kind": "follow_programme", "parameters": ["apical_control"] }),
            "parameters",
        ),
        (Reason::OffGround, vec![], json!({ "kind": "plant_seed", "position": [9, 1, 0] }), "position[1]"),
        (
            Reason::InObstacle,
            vec![place(&json!({ "kind": "sphere", "radius": 9 }))],
            json!({ "kind": "plant_seed", "position": [40, 0, 0] }),
            "position",
        ),
        (Reason::NoRoom, vec![], line, "outline"),
        (Reason::BranchGone, vec![], json!({ "kind": "grow", "steps": 1, "bud": 999 }), "bud"),
        (Reason::BranchGone, vec![], json!({ "kind": "prune", "rows": [999] }), "rows[0]"),
        (Reason::TrunkCut, vec![grow(1)], json!({ "kind": "prune", "rows": [1] }), "rows[0]"),
        (
            Reason::TrunkTurned,
            vec![grow(1)],
            json!({ "kind": "turn_branch", "row": 1, "rotation": turned }),
            "row",
        ),
        (
            Reason::OwnBranch,
            vec![grow(2)],
            json!({ "kind": "graft", "row": 1, "onto": 2, "rotation": turned, "keep": false }),
            "onto",
        ),
        (Reason::TreeFull, vec![grow(20)], grow(1), "kind"),
        (Reason::BranchGone, vec![grow(2)], refill(999, &ovoid(), 8.0), "row"),
        (Reason::BranchGone, vec![grow(2)], refill(0, &ovoid(), 8.0), "row"),
        (Reason::TreeFull, vec![grow(2)], refill(1, &ovoid(), 40.0), "envelope"),
        (Reason::OutOfRange, vec![grow(2)], refill(1, &inside_out, 8.0), "envelope.top"),
        (Reason::Malformed, vec![grow(2)], refill(1, &json!({}), 8.0), "envelope.top"),
        (Reason::BeingDrawn, vec![grow(2), stroke(1)], refill(1, &ovoid(), 8.0), "kind"),
    ]
}

#[test]
fn cm3_every_refusal_by_the_state_names_field_and_range() {
    for (reason, before, refused, field) in by_state() {
        let mut document = Document::new(1);
        document.set_metamer_budget(100);
        let read = |value: &Value| read_command(&value.to_string()).expect("it is in good form");
        for command in &before {
            document
                .apply(&Principal::visitor(), &read(command))
                .unwrap_or_else(|problem| panic!("{command}: {problem}"));
        }
        let hash = document.hash();
        let problem = document.apply(&Principal::visitor(), &read(&refused)).expect_err("it is refused");
        assert_eq!((problem.reason, problem.field.as_deref()), (reason, Some(field)), "{refused}: {problem}");
        assert!(problem.allowed.is_some_and(|allowed| !allowed.is_empty()), "{refused}");
        assert_eq!(document.hash(), hash, "{refused} changes something");
    }
}

#[test]
fn a_sample_of_each_kind_is_tried() {
    let unknown = read_command(r#"{"kind":"fell"}"#).expect_err("no such kind");
    let kinds = unknown.allowed.expect("the kinds");
    let samples = commands();
    for kind in kinds.split(", ") {
        assert!(samples.iter().any(|sample| sample["kind"] == kind), "{kind} has no sample");
    }
}

#[test]
fn cm9_any_command_may_carry_a_gesture() {
    for mut sample in commands() {
        sample["gesture"] = 5.into();
        let command = read_command(&sample.to_string()).expect("it is in good form");
        assert_eq!(command.gesture, Some(5), "{sample}");
        let written = serde_json::to_string(&command).expect("plain values");
        assert_eq!(
            read_command(&written),
            Ok(command),
            "what is written is read again as the same: {written}"
        );
    }
}

#[test]
fn scripts_of_the_gallery_are_read() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/gallery/sketches");
    let mut lines = 0;
    for entry in std::fs::read_dir(folder).expect("the gallery is there") {
        let path = entry.expect("it is listed").path();
        let script = std::fs::read_to_string(&path).expect("it is text");
        for line in script.lines().filter(|line| !line.trim().is_empty()) {
            read_command(line).unwrap_or_else(|problem| panic!("{}: {problem}: {line}", path.display()));
            lines += 1;
        }
    }
    assert!(lines > 20, "only {lines} commands");
}
