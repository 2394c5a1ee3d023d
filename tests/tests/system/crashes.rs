use std::time::Duration;

use espalier_settings::ParametersPatch;
use espalier_tests::{
    client::Client,
    dice::Dice,
    scratch::Scratch,
    server::{Server, kills},
    strokes::{line, stroke},
};
use serde_json::{Value, json};

const SEED: u32 = 11;

/// Where the strokes go, seen from above.
const AROUND: [[f32; 2]; 7] =
    [[6.0, 0.0], [-3.0, 5.0], [1.0, -6.0], [-5.0, -3.0], [4.0, 4.0], [0.0, 6.0], [-6.0, 1.0]];

/// One stroke for each kill, with parameters and undo between them.
fn script(dice: &mut Dice) -> Vec<Vec<Value>> {
    (0..kills(20) as u32)
        .map(|number| {
            let [x, z] = AROUND[number as usize % AROUND.len()];
            let height = 4.0 + number as f32 * 0.5;
            let to = [x, height + 4.0, z];
            let radius = if dice.roll(3) == 0 { 0.0 } else { 1.0 };
            let mut commands = stroke(number, &line([0.0, height * 0.5, 0.0], to, 24), radius, 2);
            match dice.roll(4) {
                0 => commands.push(json!({ "kind": "undo" })),
                1 => commands.push(json!({ "kind": "set_parameters", "parameters": ParametersPatch { apical_control: Some(0.48), ..Default::default() } })),
                2 => commands.push(json!({ "kind": "grow", "steps": 1, "gesture": Some(number) })),
                _ => {}
            }
            commands
        })
        .collect()
}

/// The tree these commands grow when nothing goes wrong.
async fn reference(server: &Server, commands: impl Iterator<Item = Value>) -> Client {
    let session = server.new_session(SEED);
    let mut client = Client::connect(server.port(), &session, "reference").await;
    for command in commands {
        client.send(command).await;
    }
    client.until_settled().await;
    client
}

#[tokio::test]
async fn kills_lose_and_double_nothing_acknowledged() {
    let mut dice = Dice::new(2026);
    let strokes = script(&mut dice);
    let commands: Vec<Value> = strokes.iter().flatten().cloned().collect();
    let scratch = Scratch::new();
    let mut server = Server::start(&scratch.path("trees.db"));
    let session = server.new_session(SEED);
    let mut client = Client::connect(server.port(), &session, "browser-1").await;
    let mut cut_short = 0;
    for stroke in strokes {
        // Somewhere in the middle of the stroke, with some of it on its way.
        let last_words = 2 + dice.roll(stroke.len() - 3);
        for (i, command) in stroke.into_iter().enumerate() {
            client.send(command).await;
            if i + 1 == last_words {
                client.listen(Duration::from_millis(dice.roll(60) as u64)).await;
                cut_short += usize::from(!client.unacknowledged.is_empty());
                let promised = client.acknowledged;
                server = server.kill_and_restart();
                client.reconnect(server.port()).await;
                assert!(client.acknowledged >= promised, "CM2: {} after {promised}", client.acknowledged);
            } else {
                client.listen(Duration::from_millis(2)).await;
            }
        }
    }
    client.until("all is durable", |client| client.acknowledged as usize == commands.len()).await;
    client.until_settled().await;
    assert_eq!(client.refused, []);
    assert!(cut_short > 0, "some kills came between sending and acknowledging");

    let mut wanted = reference(&server, commands.into_iter()).await;
    client.until_form(&wanted.form().await).await;
    assert!(client.state.metamers > 100, "the strokes grew {} metamers", client.state.metamers);
}

#[tokio::test]
async fn what_was_acknowledged_is_there_even_if_nobody_resends() {
    let mut dice = Dice::new(7);
    let commands: Vec<Value> = script(&mut dice).into_iter().take(4).flatten().collect();
    let scratch = Scratch::new();
    let mut server = Server::start(&scratch.path("trees.db"));
    let session = server.new_session(SEED);
    let mut client = Client::connect(server.port(), &session, "browser-1").await;
    for command in &commands {
        client.send(command.clone()).await;
    }
    client
        .until("half of it is acknowledged", |client| client.acknowledged as usize >= commands.len() / 2)
        .await;
    let promised = client.acknowledged;
    server = server.kill_and_restart();

    // The same key without the memory of what it sent.
    let mut viewer = Client::connect(server.port(), &session, "browser-1").await;
    let durable = viewer.acknowledged;
    assert!(durable >= promised, "CM2: {durable} after {promised}");
    viewer.until_settled().await;
    let mut wanted = reference(&server, commands.into_iter().take(durable as usize)).await;
    viewer.until_form(&wanted.form().await).await;
}

#[tokio::test]
async fn hs5_a_server_that_stops_closes_with_1001_and_keeps_everything() {
    let scratch = Scratch::new();
    let database = scratch.path("trees.db");
    let server = Server::start(&database);
    let session = server.new_session(SEED);
    let mut client = Client::connect(server.port(), &session, "browser-1").await;
    client.send(json!({ "kind": "grow", "steps": 8 })).await;
    client.until_settled().await;
    let rows = client.form().await;

    let ending = tokio::task::spawn_blocking(move || server.terminate());
    while client.take_in().await {}
    assert_eq!(client.closed.as_ref().map(|frame| u16::from(frame.code)), Some(1001), "going away");
    assert_eq!(ending.await.expect("the wait ends").code(), Some(0));

    let server = Server::start(&database);
    client.reconnect(server.port()).await;
    client.until_form(&rows).await;
    // The document does not just look the same: it goes on the same.
    client.send(json!({ "kind": "grow", "steps": 2 })).await;
    client.until_settled().await;
    let grown = [8, 2].map(|steps| json!({ "kind": "grow", "steps": steps }));
    let mut wanted = reference(&server, grown.into_iter()).await;
    client.until_form(&wanted.form().await).await;
}

#[tokio::test]
async fn hs5_pages_go_on_where_they_were_on_the_next_process() {
    let scratch = Scratch::new();
    let database = scratch.path("trees.db");
    let server = Server::start(&database);
    let (port, session) = (server.port(), server.new_session(SEED));
    let mut drawer = Client::connect(port, &session, "browser-1").await;
    let mut viewer = Client::connect(port, &session, "browser-2").await;
    let commands = stroke(1, &line([0.0, 2.0, 0.0], [3.0, 12.0, 0.0], 24), 1.0, 2);
    // In the midst of a stroke.
    let (before, after) = commands.split_at(commands.len() / 2);
    for command in before {
        drawer.send(command.clone()).await;
    }
    let ending = tokio::task::spawn_blocking(move || server.terminate());
    while drawer.take_in().await {}
    while viewer.take_in().await {}
    for client in [&drawer, &viewer] {
        assert_eq!(client.closed.as_ref().map(|frame| u16::from(frame.code)), Some(1001));
    }
    assert_eq!(ending.await.expect("the wait ends").code(), Some(0));

    let server = Server::start_on(&database, port);
    drawer.reconnect(server.port()).await;
    viewer.reconnect(server.port()).await;
    for command in after {
        drawer.send(command.clone()).await;
    }
    drawer.until_settled().await;
    assert_eq!((drawer.acknowledged as usize, drawer.refused.len()), (commands.len(), 0));
    assert!(drawer.state.metamers > 5, "the stroke grew on: {:?}", drawer.state);
    viewer.until_form(&drawer.form().await).await;
}
