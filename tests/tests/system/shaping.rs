//! Shaping by hand over a real socket: bends that survive a kill, scrubbing, predictions, and the same again by
//! `espalier replay`.

use std::{fs, time::Duration};

use espalier_proto::ProblemCode;
use espalier_tests::{
    client::{Client, until_equal},
    program,
    scratch::Scratch,
    server::Server,
};
use serde_json::{Value, json};

fn grow(steps: u32) -> Value {
    json!({ "kind": "grow", "steps": steps })
}

/// A row's parent.
fn parent(client: &Client, row: u32) -> Option<u32> {
    let code = client.table.rows[row as usize].parent;
    (code > 0).then(|| row - code / 2)
}

/// The youngest living row that stands on so many others, and the row so many below it.
fn limb(client: &Client, length: usize) -> (u32, u32) {
    let down = |row: u32| std::iter::successors(Some(row), |&row| parent(client, row));
    let rows = (0..client.table.rows.len() as u32).rev();
    let mut tall =
        rows.filter(|&row| client.table.rows[row as usize].radius > 0 && down(row).count() > length + 2);
    let top = tall.next().expect("the tree is tall enough");
    (top, down(top).nth(length).expect("it stands on more than that"))
}

/// Where a row ends, in internodes, moved.
fn beside(client: &Client, row: u32, shift: [f32; 3]) -> [f32; 3] {
    let place = client.table.rows[row as usize].position;
    std::array::from_fn(|axis| place[axis] as f32 / 256.0 + shift[axis])
}

#[tokio::test]
async fn a_kill_in_the_middle_of_a_bend_loses_nothing() {
    let scratch = Scratch::new();
    let mut server = Server::start(&scratch.path("trees.db"));
    let session = server.new_session(7);
    let mut ann = Client::connect(server.port(), &session, "browser-1").await;
    let mut done = vec![grow(9)];
    ann.send(grow(9)).await;
    ann.until_settled().await;
    let (top, base) = limb(&ann, 6);
    let rest = ann.form().await;
    let mut all =
        vec![json!({ "kind": "bend_begin", "bend": 1, "base": base, "touches": vec![top], "stretch": 0.2 })];
    for part in 1..=12 {
        let target = beside(&ann, top, [0.25 * part as f32, -0.1 * part as f32, 0.0]);
        all.push(json!({ "kind": "bend_move", "bend": 1, "targets": vec![target] }));
    }
    all.push(json!({ "kind": "bend_end", "bend": 1 }));
    all.push(json!({ "kind": "set_width", "row": base, "diameter": Some(0.6) }));
    all.push(grow(2));
    all.push(json!({ "kind": "prune", "rows": vec![top], "gesture": Some(4) }));
    all.push(json!({ "kind": "grow", "steps": 2, "gesture": Some(4) }));
    for (number, command) in all.into_iter().enumerate() {
        ann.send(command.clone()).await;
        done.push(command);
        if number == 7 {
            ann.until("frames of the bend travel (BE5)", |ann| !ann.bend_frames.is_empty()).await;
            assert_eq!(ann.table.form(), rest, "BE5: rows do not");
            server = server.kill_and_restart();
            ann.reconnect(server.port()).await;
        }
    }
    ann.until_settled().await;
    // What is shown while a bend is going on comes when there is time for it, or never.
    let is_over = |ann: &Client| ann.bend_frames.last().is_none_or(|pose| pose.motions.is_empty());
    ann.until("the bend is over (BE5)", is_over).await;
    assert_eq!(ann.refused, []);
    assert_ne!(ann.form().await[..rest.len()], rest[..], "the branch was bent");
    assert_eq!((ann.timeline.operations.len(), ann.timeline.done), (5, 5));
    assert_eq!(ann.widths.iter().map(|width| width.row).collect::<Vec<_>>(), [base]);

    // The same commands give the same tree without a server.
    let lines: Vec<String> =
        done.iter().map(|command| serde_json::to_string(command).expect("commands are JSON")).collect();
    let path = scratch.path("shaped.jsonl");
    fs::write(&path, lines.join("\n")).expect("the scratch folder can be written");
    let path = path.to_str().expect("a plain name");
    let replay = |threads| {
        let finished =
            program::run(&["replay", path, "--seed", "7", "--stats", "json", "--threads", threads]);
        assert_eq!(finished.code, 0, "{}", finished.stderr);
        serde_json::from_str::<Value>(&finished.stdout).expect("one JSON object")
    };
    let stats = replay("2");
    let figures = ["metamers_alive", "axes", "leaves"].map(|key| stats[key].as_u64());
    let shown = [ann.state.metamers, ann.state.axes, ann.state.leaves].map(|figure| Some(u64::from(figure)));
    assert_eq!(figures, shown);
    assert_eq!(stats["plant_hash"], replay("1")["plant_hash"]);
}

#[tokio::test]
async fn tt2_two_people_scrub_through_growth_and_edits() {
    let (mut ann, server, _scratch) = Client::alone(&[]).await;
    let mut bob = Client::connect(server.port(), &ann.session, "browser-2").await;
    ann.send(grow(8)).await;
    ann.until_settled().await;
    let (top, base) = limb(&ann, 4);
    let rotation = [0.0, 0.0, 0.6, 0.8];
    ann.send(json!({ "kind": "turn_branch", "row": base, "rotation": rotation })).await;
    ann.send(json!({ "kind": "graft", "row": top, "onto": base, "rotation": rotation, "keep": true })).await;
    ann.send(grow(3)).await;
    ann.until_settled().await;
    let end = ann.form().await;
    let last = ann.timeline.last_step;
    assert_eq!(last, 13);
    for step in (0..last).rev().chain(1..=last) {
        ann.send(json!({ "kind": "go_to", "step": step })).await;
        bob.listen(Duration::from_millis(3)).await;
    }
    ann.until_settled().await;
    assert_eq!(ann.form().await, end);
    until_equal(&mut ann, &mut bob).await;
    // TT3, TT4: another future, and the first one again.
    ann.send(json!({ "kind": "go_to", "step": 5 })).await;
    bob.until("bob sees the past", |bob| bob.timeline.step == 5).await;
    bob.send(json!({ "kind": "plant_seed", "position": [4.0, 0.0, 0.0] })).await;
    bob.until("a future is left", |bob| bob.timeline.futures.len() == 1).await;
    let future = bob.timeline.futures[0].future;
    bob.send(json!({ "kind": "take_future", "future": future })).await;
    bob.until_settled().await;
    bob.until("the first one is back", |bob| bob.timeline.step == last).await;
    bob.until_form(&end).await;
    ann.send(json!({ "kind": "take_future", "future": 77 })).await;
    ann.until("there is no such future", |ann| !ann.refused.is_empty()).await;
    assert_eq!(ann.refused[0].1.code, ProblemCode::NotFound);
}

#[tokio::test]
async fn pd2_a_ghost_comes_to_who_asked() {
    let (mut ann, server, _scratch) = Client::alone(&[]).await;
    let mut bob = Client::connect(server.port(), &ann.session, "browser-2").await;
    ann.send(grow(9)).await;
    ann.until_settled().await;
    let (top, _) = limb(&ann, 4);
    ann.send_message(&json!({ "type": "predict", "rows": vec![top], "steps": 4 })).await;
    ann.until("the ghost comes", |ann| !ann.ghosts.is_empty()).await;
    assert!(!ann.ghosts[0].changes.is_empty());
    ann.send(json!({ "kind": "undo" })).await;
    ann.until("a command ends it", |ann| ann.ghosts.len() == 2).await;
    assert!(ann.ghosts[1].changes.is_empty());
    ann.send_message(&json!({ "type": "predict", "rows": vec![999_999], "steps": 4 })).await;
    ann.until("it is answered", |ann| !ann.problems.is_empty()).await;
    assert_eq!(ann.problems[0].code, ProblemCode::NotFound);
    bob.listen(Duration::from_millis(100)).await;
    assert!(bob.ghosts.is_empty());
}

#[tokio::test]
async fn what_another_has_cut_cannot_be_edited() {
    let (mut ann, server, _scratch) = Client::alone(&[]).await;
    let mut bob = Client::connect(server.port(), &ann.session, "browser-2").await;
    ann.send(grow(9)).await;
    ann.until_settled().await;
    bob.until("bob sees the tree", |bob| bob.timeline.step == 9).await;
    let (top, base) = limb(&bob, 6);
    bob.send(json!({ "kind": "bend_begin", "bend": 1, "base": base, "touches": vec![top], "stretch": 0.2 }))
        .await;
    let target = beside(&bob, top, [1.0, 0.0, 0.0]);
    bob.send(json!({ "kind": "bend_move", "bend": 1, "targets": vec![target] })).await;
    bob.until_settled().await;
    ann.until("ann sees it bend", |ann| !ann.bend_frames.is_empty()).await;
    ann.send(json!({ "kind": "prune", "rows": vec![top] })).await;
    ann.until_settled().await;
    assert_eq!(ann.table.rows[top as usize].radius, 0, "it is cut");
    let left = ann.form().await;
    // Bob has not looked yet: his hands are where the branch was.
    let rotation = [0.0, 0.0, 0.6, 0.8];
    for (command, field) in [
        (json!({ "kind": "bend_move", "bend": 1, "targets": vec![target] }), "bend"),
        (json!({ "kind": "bend_end", "bend": 1 }), "bend"),
        (
            json!({ "kind": "bend_begin", "bend": 2, "base": base, "touches": vec![top], "stretch": 0.2 }),
            "touches[0]",
        ),
        (json!({ "kind": "set_width", "row": top, "diameter": Some(1.0) }), "row"),
        (json!({ "kind": "turn_branch", "row": top, "rotation": rotation }), "row"),
        (json!({ "kind": "graft", "row": top, "onto": base, "rotation": rotation, "keep": true }), "row"),
        (json!({ "kind": "prune", "rows": vec![top] }), "rows[0]"),
        (json!({ "kind": "grow", "steps": 1, "bud": Some(top) }), "bud"),
    ] {
        bob.refused.clear();
        bob.send(command.clone()).await;
        bob.until("it is answered", |bob| !bob.refused.is_empty()).await;
        let problem = &bob.refused[0].1;
        assert_eq!(
            (problem.code, problem.field.as_deref()),
            (ProblemCode::NotFound, Some(field)),
            "{command:?}"
        );
        assert!(problem.allowed.is_some(), "it says what is allowed: {problem:?}");
    }
    bob.until_form(&left).await;
    until_equal(&mut ann, &mut bob).await;
    assert_eq!(
        (bob.timeline.operations.len(), bob.timeline.done),
        (2, 2),
        "growth and the cut, nothing else"
    );
    assert!(bob.bend_frames.last().is_some_and(|pose| pose.motions.is_empty()), "BE4: his bend is over");
}
