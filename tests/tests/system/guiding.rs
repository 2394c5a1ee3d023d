use espalier_proto::ProblemCode;
use espalier_tests::{client::Client, server::Server};
use serde_json::{Value, json};

fn grow(steps: u32) -> Value {
    json!({ "kind": "grow", "steps": steps })
}

/// A heart, 2·`size` wide, its tip on the ground.
fn heart(size: f32, bud: Option<u32>) -> Value {
    let half = [[0.0, 0.0], [0.6, 0.6], [1.0, 1.2], [0.9, 1.6], [0.5, 1.8], [0.2, 1.7]];
    let mirrored = half.iter().rev().map(|[x, y]| [-x, *y]);
    let outline = half.into_iter().chain([[0.0, 1.4]]).chain(mirrored).map(|[x, y]| [x * size, y * size]);
    let plane = json!({ "origin": [0.0, 0.0, 0.0], "right": [1.0, 0.0, 0.0], "up": [0.0, 1.0, 0.0] });
    json!({ "kind": "lasso", "outline": outline.collect::<Vec<_>>(), "plane": plane, "depth": 1.0, "bud": bud })
}

#[tokio::test]
async fn la1_a_lasso_grows_for_everybody_and_undoes() {
    let (mut first, server, _scratch) = Client::alone(&[]).await;
    let mut second = Client::connect(server.port(), &first.session.clone(), "browser-2").await;
    first.send(heart(10.0, None)).await;
    first.until_settled().await;
    assert!(first.state.metamers > 200, "{:?}", first.state);
    let heart = first.form().await;
    second.until_form(&heart).await;
    second.send(json!({ "kind": "undo" })).await;
    second.until_settled().await;
    assert_eq!(second.state.metamers, 0);
    second.send(json!({ "kind": "redo" })).await;
    first.until_form(&heart).await;
}

#[tokio::test]
async fn st1_what_was_stopped_survives_a_crash() {
    let (mut client, server, _scratch) = Client::alone(&[]).await;
    client.send(grow(1000)).await;
    client.until("it grows", |client| client.state.step > 0).await;
    client.send(json!({ "kind": "stop" })).await;
    client.until_settled().await;
    let (step, form) = (client.state.step, client.form().await);
    assert!(step < 1000 && client.state.metamers > 0, "{step} steps");
    let server = server.kill_and_restart();
    client.reconnect(server.port()).await;
    client.until_form(&form).await;
    client.until_settled().await;
    assert_eq!(client.state.step, step);
}

#[tokio::test]
async fn sg1_a_branch_grows_alone() {
    let (mut client, _server, _scratch) = Client::alone(&[]).await;
    client.send(grow(6)).await;
    client.until_settled().await;
    let before = client.table.rows.len() as u32;
    let beyond = client.send(json!({ "kind": "grow", "steps": 1, "bud": Some(before) })).await;
    client.until("the row beyond is refused", |client| !client.refused.is_empty()).await;
    let (id, problem) = client.refused.remove(0);
    assert_eq!((id, problem.code, problem.field.as_deref()), (beyond, ProblemCode::NotFound, Some("bud")));
    // The last row that begins an axis is a young lateral.
    let lateral = (0..before).rev().find(|&row| {
        let code = client.table.rows[row as usize].parent;
        code % 2 == 1 && client.table.rows[row as usize].radius > 0
    });
    let lateral = lateral.expect("the tree has branched");
    client.send(json!({ "kind": "grow", "steps": 8, "bud": Some(lateral) })).await;
    client.until_settled().await;
    let rows = &client.table.rows;
    assert!(rows.len() as u32 > before, "nothing has grown");
    for row in before..rows.len() as u32 {
        let mut at = row;
        while at > lateral {
            at -= rows[at as usize].parent / 2;
        }
        assert_eq!(at, lateral, "row {row} does not grow from row {lateral}");
    }
}

#[tokio::test]
async fn lm4_the_budget_of_a_session_is_the_one_it_began_with() {
    let (mut client, server, scratch) = Client::alone(&["--metamer-budget", "600"]).await;
    client.send(grow(1000)).await;
    client.until("the budget is reached", |client| client.state.budget_reached).await;
    client.until_settled().await;
    assert_eq!(client.state.metamer_budget, 600);
    let form = client.form().await;
    client.send(grow(1)).await;
    client.until("more is refused", |client| !client.refused.is_empty()).await;
    assert!(client.refused[0].1.message.contains("600"), "{:?}", client.refused);
    client.vanish();
    server.kill();
    let server = Server::start_with(&scratch.path("trees.db"), 0, &["--metamer-budget", "900"]);
    client.reconnect(server.port()).await;
    client.until_form(&form).await;
    client.until("the budget is reached", |client| client.state.budget_reached).await;
    assert_eq!(client.state.metamer_budget, 600);
    let session = server.new_session(7);
    let newer = Client::connect(server.port(), &session, "browser-2").await;
    assert_eq!((newer.state.metamer_budget, newer.state.budget_reached), (900, false));
}

#[tokio::test]
async fn a_thousand_seeds_fit_in_one_scene() {
    let (mut client, _server, _scratch) = Client::alone(&[]).await;
    for number in 0..1000u32 {
        let place = |n: u32| n as f32 * 9.0 - 140.0;
        client
            .send(json!({ "kind": "plant_seed", "position": [place(number % 32), 0.0, place(number / 32)] }))
            .await;
    }
    client.send(grow(3)).await;
    client.until_settled().await;
    assert_eq!(client.refused, []);
    assert_eq!(client.table.rows.iter().filter(|row| row.parent == 0).count(), 1001);
    assert!(client.state.axes > 900, "{:?}", client.state);
}
