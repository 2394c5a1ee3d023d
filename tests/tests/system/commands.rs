use espalier_proto::ProblemCode;
use espalier_settings::ParametersPatch;
use espalier_tests::{
    client::Client,
    strokes::{line, stroke, upward},
};
use serde_json::{Value, json};

fn grow(steps: u32) -> Value {
    json!({ "kind": "grow", "steps": steps })
}

#[tokio::test]
async fn cm1_a_number_taken_before_is_not_done_twice() {
    let (mut client, _server, _scratch) = Client::alone(&[]).await;
    let id = client.send(grow(3)).await;
    client.until_settled().await;
    let step = client.state.step;
    assert_eq!(step, 3);
    for _ in 0..5 {
        client.send_message(&json!({ "type": "command", "id": id, "command": grow(3) })).await;
    }
    client.send(grow(1)).await;
    client.until_settled().await;
    assert_eq!(client.state.step, step + 1);
    assert_eq!(client.refused, []);
}

#[tokio::test]
async fn cm1_a_gap_is_refused_and_what_fills_it_is_done() {
    let (mut client, _server, _scratch) = Client::alone(&[]).await;
    client.send_message(&json!({ "type": "command", "id": 3, "command": grow(50) })).await;
    client.until("the gap is refused", |client| !client.refused.is_empty()).await;
    let (id, problem) = &client.refused[0];
    assert_eq!(*id, 3);
    assert!(!problem.message.is_empty());
    for _ in 0..3 {
        client.send(grow(1)).await;
    }
    client.until("all three are durable", |client| client.acknowledged == 3).await;
    client.until_settled().await;
    assert_eq!(client.state.step, 3);
}

#[tokio::test]
async fn cm4_commands_of_one_client_run_in_their_order() {
    let (mut client, server, _scratch) = Client::alone(&[]).await;
    // Only in this order is the second tree smaller and the redo refused.
    client.send(grow(6)).await;
    client.send(json!({ "kind": "ungrow", "steps": 2 })).await;
    client.send(grow(1)).await;
    client.send(json!({ "kind": "undo" })).await;
    client.until_settled().await;
    assert_eq!(client.state.step, 4);
    let session = server.new_session(7);
    let mut straight = Client::connect(server.port(), &session, "browser-2").await;
    straight.send(grow(4)).await;
    straight.until_settled().await;
    client.until_form(&straight.form().await).await;
}

#[tokio::test]
async fn cm5_overlapping_strokes_are_one_operation() {
    let (mut first, server, _scratch) = Client::alone(&[]).await;
    let mut second = Client::connect(server.port(), &first.session.clone(), "browser-2").await;
    let left = stroke(1, &line([0.0, 0.0, 0.0], [-8.0, 10.0, 0.0], 12), 2.0, 3);
    let right = stroke(1, &line([0.0, 0.0, 0.0], [8.0, 10.0, 0.0], 12), 2.0, 3);
    for (left, right) in left.into_iter().zip(right) {
        first.send(left).await;
        first.until("it is durable", |client| client.unacknowledged.is_empty()).await;
        second.send(right).await;
        second.until("it is durable", |client| client.unacknowledged.is_empty()).await;
    }
    first.until_settled().await;
    second.until_settled().await;
    assert!(first.state.metamers > 10, "the strokes grew {} metamers", first.state.metamers);
    second.send(json!({ "kind": "undo" })).await;
    second.until_settled().await;
    assert_eq!(second.state.metamers, 0);
    assert!(!second.state.can_undo);
}

#[tokio::test]
async fn cm7_undo_and_redo_give_the_same_rows_back() {
    let (mut client, _server, _scratch) = Client::alone(&[]).await;
    for command in upward(1, 12.0, 3.0) {
        client.send(command).await;
    }
    client.until_settled().await;
    let drawn = client.form().await;
    client.send(grow(5)).await;
    client.until_settled().await;
    let grown = client.form().await;
    assert_ne!(drawn, grown);
    client.send(json!({ "kind": "undo" })).await;
    client.until_settled().await;
    client.until_form(&drawn).await;
    client.send(json!({ "kind": "redo" })).await;
    client.until_settled().await;
    client.until_form(&grown).await;
    assert!(!client.state.can_redo);
}

#[tokio::test]
async fn cm7_ungrow_takes_steps_back_exactly() {
    let (mut client, _server, _scratch) = Client::alone(&[]).await;
    client.send(grow(8)).await;
    client.until_settled().await;
    let rows = client.form().await;
    client.send(grow(4)).await;
    client.until_settled().await;
    client.send(json!({ "kind": "ungrow", "steps": 4 })).await;
    client.until_settled().await;
    client.until_form(&rows).await;
    client.send(json!({ "kind": "ungrow", "steps": 1000 })).await;
    client.until_settled().await;
    assert_eq!((client.state.step, client.state.metamers), (0, 0));
}

#[tokio::test]
async fn cm3_nothing_to_undo_is_refused() {
    let (mut client, _server, _scratch) = Client::alone(&[]).await;
    let id = client.send(json!({ "kind": "undo" })).await;
    client.until("it is refused", |client| !client.refused.is_empty()).await;
    assert_eq!(client.refused[0].0, id);
    assert_eq!(client.refused[0].1.code, ProblemCode::Refused);
    client.send(grow(1)).await;
    client.until_settled().await;
    assert_eq!(client.state.step, 1);
}

#[tokio::test]
async fn parameters_reach_everyone_and_change_growth() {
    let (mut first, server, _scratch) = Client::alone(&[]).await;
    let mut second = Client::connect(server.port(), &first.session.clone(), "browser-2").await;
    let patch = ParametersPatch { max_shoot_length: Some(1), leaves_per_node: Some(0), ..Default::default() };
    first.send(json!({ "kind": "set_parameters", "parameters": patch })).await;
    second.until("the parameters arrive", |client| client.parameters.max_shoot_length == 1).await;
    first.send(grow(6)).await;
    first.until_settled().await;
    assert_eq!(first.parameters, second.parameters);
    assert_eq!(first.state.leaves, 0);
    assert!(first.state.metamers > 0);
}

#[tokio::test]
async fn another_seed_grows_another_plant() {
    let (mut client, _server, _scratch) = Client::alone(&[]).await;
    client.send(json!({ "kind": "plant_seed", "position": [30.0, 0.0, 0.0] })).await;
    client.send(grow(6)).await;
    client.until_settled().await;
    let seeds = client.table.rows.iter().filter(|row| row.parent == 0).count();
    assert_eq!(seeds, 2);
    let beside = |row: &&espalier_tests::table::Row| row.radius > 0 && row.position[0] > 20 * 256;
    assert!(
        client.table.rows.iter().filter(beside).count() > 2,
        "the second plant grows where it was planted"
    );
}
