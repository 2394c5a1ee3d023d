//! `LM`: what has the right form to become part of a document.

use std::collections::BTreeMap;

use espalier_proto::{ClientMessage, Problem, ProblemCode, Reason, access::Role, version::CloseCode};
use espalier_session::{Entrant, read_command};
use serde_json::{Value, json};

use crate::{obstacles::tetrahedron, world::World};

fn check(json: &str, expected: Result<(), (ProblemCode, Option<&str>)>) {
    let found = read_command(json).map(drop).map_err(|problem| {
        assert!(problem.message.len() > 10, "{json}: {}", problem.message);
        (problem.code, problem.field)
    });
    let expected = expected.map_err(|(code, field)| (code, field.map(str::to_owned)));
    assert_eq!(found, expected, "{json}");
}

const OUT: ProblemCode = ProblemCode::OutOfRange;
const BAD: ProblemCode = ProblemCode::Malformed;

#[test]
fn lm2_samples_lie_within_the_world() {
    let sample = |position: &str, radius: &str| {
        let good = r#"{"position":[0,1,0],"radius":4}"#;
        format!(
            r#"{{"kind":"stroke_move","stroke":1,"samples":[{good},{{"position":{position},"radius":{radius}}}]}}"#
        )
    };
    check(&sample("[1000,1000,-1000]", "0"), Ok(()));
    check(&sample("[-1000,-10,1000]", "40"), Ok(()));
    check(&sample("[1000.1,0,0]", "1"), Err((OUT, Some("samples[1].position[0]"))));
    check(&sample("[0,-10.01,0]", "1"), Err((OUT, Some("samples[1].position[1]"))));
    check(&sample("[0,0,-1001]", "1"), Err((OUT, Some("samples[1].position[2]"))));
    check(&sample("[0,0,1e39]", "1"), Err((OUT, Some("samples[1].position[2]"))));
    check(&sample("[0,0,0]", "40.5"), Err((OUT, Some("samples[1].radius"))));
    check(&sample("[0,0,0]", "-0.1"), Err((OUT, Some("samples[1].radius"))));
    check(&sample("[0,0,0]", "\"wide\""), Err((BAD, Some("samples[1].radius"))));
    check(&sample("[0,0]", "1"), Err((BAD, Some("samples[1].position"))));
    check(&sample("[0,0,null]", "1"), Err((BAD, Some("samples[1].position[2]"))));
}

#[test]
fn lm2_a_move_has_1_to_256_samples() {
    let samples = |count: usize| {
        let list = vec![r#"{"position":[0,1,0],"radius":4}"#; count].join(",");
        format!(r#"{{"kind":"stroke_move","stroke":1,"samples":[{list}]}}"#)
    };
    check(&samples(0), Err((OUT, Some("samples"))));
    check(&samples(1), Ok(()));
    check(&samples(256), Ok(()));
    check(&samples(257), Err((ProblemCode::TooMany, Some("samples"))));
}

#[test]
fn lm3_steps_go_from_1_to_1000() {
    for kind in ["grow", "ungrow"] {
        for (steps, allowed) in [(0, false), (1, true), (1000, true), (1001, false)] {
            let expected = if allowed { Ok(()) } else { Err((OUT, Some("steps"))) };
            check(&format!(r#"{{"kind":"{kind}","steps":{steps}}}"#), expected);
        }
    }
}

#[test]
fn unreadable_fields_are_named() {
    check(r#"{"kind":"grow"}"#, Err((BAD, Some("steps"))));
    check(r#"{"kind":"grow","steps":1,"water":2}"#, Err((BAD, Some("water"))));
    check(r#"{"kind":"grow","steps":1.5}"#, Err((BAD, Some("steps"))));
    check(r#"{"kind":"grow","steps":1,"gesture":"a"}"#, Err((BAD, Some("gesture"))));
    check(r#"{"kind":"stroke_end","stroke":-1}"#, Err((OUT, Some("stroke"))));
    check(r#"{"kind":"stroke_move","stroke":1,"samples":7}"#, Err((BAD, Some("samples"))));
    check(r#"{"kind":"stroke_move","stroke":1,"samples":[7]}"#, Err((BAD, Some("samples[0]"))));
    check(r#"{"kind":"plant_seed","position":[0,"a",0]}"#, Err((BAD, Some("position[1]"))));
    check(r#"{"kind":"plant_seed","position":[0,0,2000]}"#, Err((OUT, Some("position[2]"))));
    check(r#"{"kind":"set_parameters","parameters":{"sap":1}}"#, Err((BAD, Some("parameters.sap"))));
    let not_a_number = r#"{"kind":"set_parameters","parameters":{"leaf_size":"big"}}"#;
    check(not_a_number, Err((BAD, Some("parameters.leaf_size"))));
    let infinite = r#"{"kind":"set_parameters","parameters":{"leaf_size":1e39}}"#;
    check(infinite, Err((OUT, Some("parameters.leaf_size"))));
    check(r#"{"kind":"grill"}"#, Err((BAD, Some("kind"))));
    check("grow", Err((BAD, None)));
}

#[test]
fn lm13_programmes_have_bounds() {
    let programme = |stages: Value, age: u32| {
        let programme = json!({ "parameters": {}, "stages": stages, "age": age });
        json!({ "kind": "set_programme", "programme": programme }).to_string()
    };
    let change = |age: u32| json!({ "kind": "change", "age": age, "parameters": {} });
    check(&programme(vec![change(10_000); 128].into(), 10_000), Ok(()));
    let many = programme(vec![change(1); 129].into(), 9);
    check(&many, Err((ProblemCode::TooMany, Some("programme.stages"))));
    check(&programme([change(10_001)].to_vec().into(), 9), Err((OUT, Some("programme.stages[0].age"))));
    check(&programme(json!([]), 10_001), Err((OUT, Some("programme.age"))));
    let high = json!([{ "kind": "seed", "age": 1, "position": [0, 1, 0] }]);
    check(&programme(high, 9), Err((OUT, Some("programme.stages[0].position[1]"))));
    let still = json!([{ "kind": "stroke", "age": 1, "samples": [] }]);
    check(&programme(still, 9), Err((OUT, Some("programme.stages[0].samples"))));
}

#[test]
fn every_kind_of_command_is_read() {
    for json in [
        r#"{"kind":"set_programme","programme":null}"#,
        r#"{"kind":"follow_programme","parameters":[]}"#,
        r#"{"kind":"stroke_begin","stroke":1}"#,
        r#"{"kind":"stroke_end","stroke":1}"#,
        r#"{"kind":"grow","steps":3,"gesture":4}"#,
        r#"{"kind":"undo"}"#,
        r#"{"kind":"redo"}"#,
        r#"{"kind":"set_parameters","parameters":{}}"#,
        r#"{"kind":"plant_seed","position":[1,0,2]}"#,
        r#"{"kind":"stroke_begin","stroke":1,"bud":0}"#,
        r#"{"kind":"grow","steps":3,"bud":7}"#,
        r#"{"kind":"lasso","outline":[[0,0],[1,0],[1,1]],"plane":{"origin":[0,0,0],"right":[1,0,0],"up":[0,1,0]}}"#,
        r#"{"kind":"stop"}"#,
        r#"{"kind":"place_obstacle","obstacle":{"shape":{"kind":"plane"},"pose":{"position":[0,0,0]}}}"#,
        r#"{"kind":"move_obstacle","id":1,"pose":{"position":[0,0,0],"rotation":[0,1,0,0]}}"#,
        r#"{"kind":"reshape_obstacle","id":1,"shape":{"kind":"sphere","radius":2}}"#,
        r#"{"kind":"remove_obstacle","id":1}"#,
        r#"{"kind":"place_obstacle","obstacle":{"shape":{"kind":"plane"},"pose":{"position":[0,0,0]}},"gesture":4}"#,
        r#"{"kind":"move_obstacle","id":1,"pose":{"position":[0,0,0]},"gesture":4}"#,
        r#"{"kind":"reshape_obstacle","id":1,"shape":{"kind":"plane"},"gesture":4}"#,
        r#"{"kind":"remove_obstacle","id":1,"gesture":4}"#,
    ] {
        check(json, Ok(()));
    }
}

#[test]
fn lm5_a_lasso_has_its_ranges() {
    let lasso = |outline: &str, plane: &str, depth: &str| {
        format!(r#"{{"kind":"lasso","outline":{outline},"plane":{plane},"depth":{depth}}}"#)
    };
    let outline = |points: usize| format!("[{}]", vec!["[0,1]"; points].join(","));
    let plane = r#"{"origin":[0,0,0],"right":[1,0,0],"up":[0,1,0]}"#;
    for (points, allowed) in [(2, Err((OUT, Some("outline")))), (3, Ok(())), (4096, Ok(()))] {
        check(&lasso(&outline(points), plane, "1"), allowed);
    }
    check(&lasso(&outline(4097), plane, "1"), Err((ProblemCode::TooMany, Some("outline"))));
    check(&lasso("[[0,0],[1,0],[1,1001]]", plane, "1"), Err((OUT, Some("outline[2][1]"))));
    check(&lasso("[[0,0],[1,0],[1]]", plane, "1"), Err((BAD, Some("outline[2]"))));
    for (depth, allowed) in [("0.09", false), ("0.1", true), ("1", true), ("1.01", false)] {
        let expected = if allowed { Ok(()) } else { Err((OUT, Some("depth"))) };
        check(&lasso(&outline(3), plane, depth), expected);
    }
    for (plane, field) in [
        (r#"{"origin":[0,-11,0],"right":[1,0,0],"up":[0,1,0]}"#, "plane.origin[1]"),
        (r#"{"origin":[0,0,0],"right":[1.02,0,0],"up":[0,1,0]}"#, "plane.right"),
        (r#"{"origin":[0,0,0],"right":[1,0,0],"up":[0,0,0]}"#, "plane.up"),
        (r#"{"origin":[0,0,0],"right":[1,0,0],"up":[0.6,0.8,0]}"#, "plane.up"),
    ] {
        check(&lasso(&outline(3), plane, "1"), Err((OUT, Some(field))));
    }
    let missing = r#"{"kind":"lasso","outline":[[0,0],[1,0],[1,1]],"plane":{"origin":[0,0,0]}}"#;
    check(missing, Err((BAD, Some("plane.right"))));
}

#[test]
fn lm6_an_obstacle_has_its_ranges() {
    let with = |shape: &str, pose: &str| {
        format!(r#"{{"kind":"place_obstacle","obstacle":{{"shape":{shape},"pose":{pose}}}}}"#)
    };
    let here = r#"{"position":[0,1,0]}"#;
    let shape = |shape: &str, expected| check(&with(shape, here), expected);
    shape(r#"{"kind":"box","size":[0.1,1,1000]}"#, Ok(()));
    shape(r#"{"kind":"box","size":[0.09,1,1]}"#, Err((OUT, Some("obstacle.shape.size[0]"))));
    shape(r#"{"kind":"box","size":[1,1,1001]}"#, Err((OUT, Some("obstacle.shape.size[2]"))));
    shape(r#"{"kind":"sphere","radius":500}"#, Ok(()));
    shape(r#"{"kind":"sphere","radius":501}"#, Err((OUT, Some("obstacle.shape.radius"))));
    shape(r#"{"kind":"cone"}"#, Err((BAD, Some("obstacle.shape.kind"))));
    let sphere = r#"{"kind":"sphere","radius":1}"#;
    let rotated = |rotation: &str| format!(r#"{{"position":[0,1,0],"rotation":{rotation}}}"#);
    check(&with(sphere, &rotated("[0.6,0,0.8,0]")), Ok(()));
    check(&with(sphere, &rotated("[1,1,0,0]")), Err((OUT, Some("obstacle.pose.rotation"))));
    check(&with(sphere, &rotated("[0,0,0]")), Err((BAD, Some("obstacle.pose.rotation"))));
    check(&with(sphere, r#"{"position":[0,1,1001]}"#), Err((OUT, Some("obstacle.pose.position[2]"))));
}

#[test]
fn lm6_a_mesh_that_is_none_is_refused() {
    let field = Some("obstacle.shape.mesh");
    let text = |mesh: &str, scale: f32| {
        let shape = format!(r#"{{"kind":"mesh","mesh":"{mesh}","scale":{scale}}}"#);
        format!(r#"{{"kind":"place_obstacle","obstacle":{{"shape":{shape},"pose":{{"position":[0,0,0]}}}}}}"#)
    };
    let sound = tetrahedron();
    check(&text(&sound.to_base64(), 1.0), Ok(()));
    check(&text(&sound.to_base64(), 0.0), Err((OUT, Some("obstacle.shape.scale"))));
    check(&text("no base64!", 1.0), Err((BAD, field)));
    check(&text("", 1.0), Err((BAD, field)));
    check(&text("AAAAAAAAAAA=", 1.0), Err((OUT, field)));
    let mut far = sound.clone();
    far.vertices[0].x = 10_001.0;
    check(&text(&far.to_base64(), 1.0), Err((OUT, field)));
    let mut endless = sound.clone();
    endless.vertices[3].y = f32::NAN;
    check(&text(&endless.to_base64(), 1.0), Err((BAD, field)));
    let mut loose = sound.clone();
    loose.triangles[1][2] = 4;
    check(&text(&loose.to_base64(), 1.0), Err((BAD, field)));
    let mut flat = sound;
    flat.triangles = vec![[0, 0, 1]];
    check(&text(&flat.to_base64(), 1.0), Err((OUT, field)));
}

#[test]
fn lm8_diameters_and_rotations_have_their_ranges() {
    let width = |diameter: &str| format!(r#"{{"kind":"set_width","row":1,"diameter":{diameter}}}"#);
    for good in ["0.01", "1", "100", "null"] {
        check(&width(good), Ok(()));
    }
    for bad in ["0.0099", "100.1", "-1", "0"] {
        check(&width(bad), Err((OUT, Some("diameter"))));
    }
    let turn = |rotation: &str| format!(r#"{{"kind":"turn_branch","row":1,"rotation":{rotation}}}"#);
    let graft =
        |rotation: &str| format!(r#"{{"kind":"graft","row":1,"onto":2,"keep":true,"rotation":{rotation}}}"#);
    for rotation in ["[0,0,0,1]", "[0,0,0,1.009]", "[0,-0.991,0,0]", "[0.5,0.5,0.5,-0.5]"] {
        check(&turn(rotation), Ok(()));
        check(&graft(rotation), Ok(()));
    }
    for rotation in ["[0,0,0,1.011]", "[0,0.989,0,0]", "[1,1,1,1]", "[0,0,0,0]"] {
        check(&turn(rotation), Err((OUT, Some("rotation"))));
        check(&graft(rotation), Err((OUT, Some("rotation"))));
    }
}

#[test]
fn lm10_a_prediction_has_up_to_100_steps() {
    let mut world = World::new();
    let client = world.join("birch-01");
    for (steps, ghosts) in [(100, 1), (101, 1), (1, 2)] {
        world.send(client, &json!({ "type": "predict", "rows": [], "steps": steps }));
        world.settle();
        assert_eq!(world.peer(client).ghosts.len(), ghosts, "{steps} steps");
    }
    let problems = world.peer(client).problems();
    let [problem] = problems.as_slice() else { panic!("{problems:?}") };
    assert_eq!((problem.code, problem.field.as_deref()), (OUT, Some("steps")));
    assert!(problem.allowed.as_deref().is_some_and(|allowed| allowed.contains("100")), "{problem:?}");
}

#[test]
fn lm20_what_is_said_of_oneself_has_bounds() {
    let mut world = World::new();
    let client = world.join("birch-01");
    let camera = |field: &str, value: f32| {
        let mut camera = json!({ "target": [0.0, 8.0, 0.0], "yaw": 0.0, "pitch": 0.0, "distance": 40.0 });
        camera[field] = json!(value);
        json!({ "type": "here", "camera": camera })
    };
    let sketch = |count: usize| json!({ "type": "here", "sketch": vec![[0.0, 1.0, 0.0]; count] });
    let offset = |x: f32| {
        let pointer = json!({ "kind": "wood", "row": 1, "along": 1.0, "offset": [x, 0.0, 0.0] });
        json!({ "type": "here", "pointer": pointer })
    };
    for good in [
        camera("yaw", -180.0),
        camera("pitch", 90.0),
        camera("distance", 10_000.0),
        sketch(1),
        sketch(48),
        offset(-16.0),
    ] {
        world.send(client, &good);
        assert!(world.peer(client).problems().is_empty(), "{good}");
    }
    for (bad, field) in [
        (camera("yaw", 181.0), "camera.yaw"),
        (camera("pitch", -90.5), "camera.pitch"),
        (camera("distance", 0.0), "camera.distance"),
        (sketch(0), "sketch"),
        (sketch(49), "sketch"),
        (offset(16.5), "pointer.offset[0]"),
        (json!({ "type": "here", "radius": 41 }), "radius"),
        (json!({ "type": "here", "tool": "Big Brush" }), "tool"),
        (json!({ "type": "here", "name": " " }), "name"),
    ] {
        world.send(client, &bad);
        let problem = world.peer(client).problems().pop().unwrap();
        assert_eq!(problem.field.as_deref(), Some(field), "{bad}");
    }
}

#[test]
fn lm1_a_large_message_closes() {
    let mut world = World::new();
    let client = world.join("birch-01");
    let padding = " ".repeat(256 * 1024);
    world.text(client, &format!(r#"{{"type":"ping","nonce":1}}{padding}"#));
    assert_eq!(world.peer(client).closed, Some(CloseCode::MessageTooBig));
}

#[test]
fn lm23_commands_waiting_for_the_tree_are_bounded() {
    let mut world = World::new();
    world.work_ms = u64::MAX / 2;
    check_bounded(&mut world);
}

#[test]
fn lm23_commands_waiting_for_the_disk_are_bounded() {
    let mut world = World::new();
    world.write_ms = u64::MAX / 2;
    check_bounded(&mut world);
}

fn check_bounded(world: &mut World) {
    let people: Vec<u64> = (0..5).map(|person| world.join(&format!("person-{person}"))).collect();
    for id in 1..=1000 {
        for person in &people {
            world.command(*person, id, json!({ "kind": "redo" }));
        }
        if id % 40 == 0 {
            world.pass(20);
        }
    }
    let refused: Vec<_> = people.iter().map(|person| not_taken(world, *person)).collect();
    let count: usize = refused.iter().map(Vec::len).sum();
    assert!((850..=910).contains(&count), "{count} were refused");
    let all = Some("up to 4096 commands in 8388608 bytes that wait");
    for refused in &refused {
        let behind = refused.iter().take_while(|(_, problem)| problem.reason == Reason::Behind);
        assert_eq!(behind.count(), 1, "what follows the first is a gap");
        assert_eq!(refused[0].1.allowed.as_deref(), all);
    }
    // What all of them wait for can be stopped, by who waits as well.
    let (first, _) = refused[0][0];
    world.command(people[0], first, json!({ "kind": "stop" }));
    assert_eq!(not_taken(world, people[0]), refused[0]);
}

/// What was refused so that its number was not taken.
fn not_taken(world: &World, client: u64) -> Vec<(u32, Problem)> {
    let is_not_taken =
        |(_, problem): &(u32, Problem)| [Reason::Behind, Reason::NumberTaken].contains(&problem.reason);
    world.peer(client).refused().into_iter().filter(is_not_taken).collect()
}

#[test]
fn lm23_what_finds_no_room_is_done_in_its_order_when_it_comes_again() {
    let mut world = World::new();
    let client = world.join("birch-01");
    let end = json!({ "kind": "stroke_end", "stroke": 1 });
    // Nothing of it becomes durable, for no time passes.
    for id in 1..=1026 {
        world.command(client, id, end.clone());
    }
    let reasons = |world: &World| -> Vec<_> {
        not_taken(world, client).into_iter().map(|(id, problem)| (id, problem.reason)).collect()
    };
    let first = [(1025, Reason::Behind), (1026, Reason::NumberTaken)];
    assert_eq!(reasons(&world), first);
    world.settle();
    // There is room now, yet the second may not go before the first.
    world.command(client, 1026, end.clone());
    assert_eq!(reasons(&world), [first.as_slice(), &[(1026, Reason::NumberTaken)]].concat());
    world.command(client, 1025, end.clone());
    world.command(client, 1026, end.clone());
    world.settle();
    assert_eq!(reasons(&world).len(), 3, "both are taken");
    assert!(world.disk.iter().map(|entry| entry.id).eq(1..=1026));
}

#[test]
fn lm7_a_bend_in_bad_form_names_its_field() {
    let touches =
        |rows: &str| format!(r#"{{"kind":"bend_begin","bend":1,"base":1,"touches":{rows},"stretch":0}}"#);
    let stretch =
        |share: &str| format!(r#"{{"kind":"bend_begin","bend":1,"base":1,"touches":[2],"stretch":{share}}}"#);
    let targets = |places: &str| format!(r#"{{"kind":"bend_move","bend":1,"targets":{places}}}"#);
    let position = "three numbers, x and z -1000 to 1000, y -10 to 1000";
    for (text, field, allowed) in [
        (touches("[]"), "touches", "a list of 1 to 8 entries"),
        (touches("[1,2,3,4,5,6,7,8,9]"), "touches", "a list of 1 to 8 entries"),
        (touches("[2,3,2]"), "touches[2]", "a row that is touched once"),
        (touches("[-2]"), "touches[0]", "a whole number from 0 to 4294967295"),
        (stretch("1.5"), "stretch", "0 to 1"),
        (stretch("1e99"), "stretch", "0 to 1"),
        (stretch("NaN"), "stretch", "0 to 1"),
        (targets("[]"), "targets", "a list of 1 to 8 entries"),
        (targets("[[0,1,0],[0,1e39,0]]"), "targets[1][1]", "-10 to 1000"),
        (targets("[[0,1,0],[0,Infinity,0]]"), "targets[1][1]", "-10 to 1000"),
        (targets("[[-1001,1,0]]"), "targets[0][0]", "-1000 to 1000"),
        (targets("[[0,1]]"), "targets[0]", position),
    ] {
        let problem = read_command(&text).expect_err(&text);
        let found = (problem.field.as_deref(), problem.allowed.as_deref());
        assert_eq!(found, (Some(field), Some(allowed)), "{text}: {}", problem.message);
    }
    check(&touches("[2,3,4,5,6,7,8,9]"), Ok(()));
    check(&stretch("1"), Ok(()));
}

#[test]
fn lm9_rows_and_light_have_their_ranges() {
    let prune = |count: usize| json!({ "kind": "prune", "rows": vec![1; count] }).to_string();
    check(&prune(0), Err((OUT, Some("rows"))));
    check(&prune(1024), Ok(()));
    check(&prune(1025), Err((ProblemCode::TooMany, Some("rows"))));
    let predict = |count: usize| json!({ "type": "predict", "rows": vec![1; count], "steps": 1 }).to_string();
    assert!(
        ClientMessage::from_json(&predict(0)).is_ok() && ClientMessage::from_json(&predict(1024)).is_ok()
    );
    let problem = ClientMessage::from_json(&predict(1025)).expect_err("too many").problem;
    assert_eq!((problem.code, problem.field.as_deref()), (ProblemCode::TooMany, Some("rows")));
    for (exposure, allowed) in [("0", Ok(())), ("1", Ok(())), ("1.01", Err((OUT, Some("exposure"))))] {
        check(&format!(r#"{{"kind":"prune_dim","exposure":{exposure}}}"#), allowed);
    }
}

#[test]
fn lm23_nobody_keeps_others_out_of_a_session() {
    let mut world = World::new();
    let mut enter = |person: &str, key: &str, is_anybody: bool| {
        let id = world.connect_as(Entrant { is_anybody, ..Entrant::new(person, Role::Editor) });
        world.hello(id, key, None);
        id
    };
    let (tablet, phone) = (enter("Bo", "bo-tablet", false), enter("Bo", "bo-phone", false));
    let ann = enter("Ann", "ann-tablet", false);
    let (here, there) = (enter("machine", "page-one", true), enter("machine", "page-two", true));
    // Of no stroke, so that it costs nothing.
    let end = || json!({ "kind": "stroke_end", "stroke": 1 });
    let mut sent = BTreeMap::<u64, u32>::new();
    // Nothing of it becomes durable, for no time passes.
    let mut send = |world: &mut World, id: u64, count: u32, command: Value| {
        let next = sent.entry(id).or_default();
        for _ in 0..count {
            let before = not_taken(world, id).len();
            world.command(id, *next + 1, command.clone());
            // What finds no room does not take up its number.
            *next += u32::from(not_taken(world, id).len() == before);
        }
        let refused = world.peer(id).refused().into_iter().map(|(_, problem)| problem);
        let refused = refused.filter(|problem| problem.reason == Reason::Behind);
        refused.filter_map(|problem| problem.allowed).collect::<Vec<_>>()
    };
    assert_eq!(send(&mut world, tablet, 1000, end()), [""; 0]);
    assert_eq!(send(&mut world, phone, 24, end()), [""; 0]);
    let of_one = ["up to 1024 commands of one person that wait"];
    assert_eq!(send(&mut world, phone, 1, end()), of_one);
    assert_eq!(send(&mut world, tablet, 1, end()), of_one);
    assert_eq!(send(&mut world, tablet, 1, json!({ "kind": "stop" })), of_one, "it is not refused");
    assert_eq!(not_taken(&world, tablet).len(), 1);
    assert_eq!(send(&mut world, ann, 1, end()), [""; 0]);
    assert_eq!(send(&mut world, here, 1024, end()), [""; 0]);
    assert_eq!(send(&mut world, here, 1, end()), of_one);
    assert_eq!(send(&mut world, there, 1000, end()), [""; 0], "each key for itself");
    // What is done and durable makes room.
    world.settle();
    assert_eq!(send(&mut world, phone, 1, end()).len(), 1, "no further one");
}
