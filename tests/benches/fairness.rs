//! How long twenty people who draw wait for what they drew: alone, beside six trees that grow to a million metamers, and
//! beside four trees of half a million that are opened.

use std::{
    sync::Arc,
    time::{Duration, Instant},
};

use espalier_tests::{
    client::{Client, Receipts},
    http,
    scratch::Scratch,
    server::Server,
};
use serde_json::{Value, json};
use tokio::{
    task::{JoinSet, block_in_place},
    time::{MissedTickBehavior, interval, sleep, timeout},
};

/// Who draws, each a small tree of their own.
const PEOPLE: u32 = 20;
/// So often a hand sends what it drew.
const EVERY: Duration = Duration::from_millis(100);
/// So long is measured at a time.
const LONG: Duration = Duration::from_secs(20);
/// Trees that grow alone, and
const GROWERS: u32 = 6;
/// how large they may become.
const BUDGET: &str = "1000000";
/// Trees that are opened again and again, and
const OPENED: usize = 4;
/// their metamers at least.
const LARGE: u32 = 500_000;

#[tokio::main]
async fn main() {
    let scratch = Scratch::new();
    let database = scratch.path("trees.db");
    let server = Arc::new(Server::start_with(&database, 0, &["--metamer-budget", BUDGET]));
    println!("from what is drawn to its frame, {PEOPLE} people:");
    println!("  alone: {}", drawn(&server).await);

    let mut growing = Vec::new();
    for number in 0..GROWERS {
        growing.push(grower(&server, number).await);
    }
    println!("  beside {GROWERS} trees that grow: {}", drawn(&server).await);
    for mut client in growing {
        client.send(json!({ "kind": "stop" })).await;
        client.vanish();
    }

    let tree = large(&server).await;
    let opening: JoinSet<()> =
        (0..OPENED).map(|_| open_again_and_again(Arc::clone(&server), tree.clone())).collect();
    println!("  beside {OPENED} trees of {LARGE} that are opened: {}", drawn(&server).await);
    opening.join_all().await;
}

/// Everybody draws for as long as is measured.
async fn drawn(server: &Arc<Server>) -> String {
    let people: JoinSet<_> = (0..PEOPLE).map(|number| draw(Arc::clone(server), number)).collect();
    let mut delays = people.join_all().await.concat();
    delays.sort_unstable();
    let at = |share: f64| delays.get((delays.len() as f64 * share) as usize).map_or(f64::NAN, |&d| ms(d));
    let most = delays.last().map_or(f64::NAN, |&most| ms(most));
    format!(
        "median {:.1} ms, 99 % within {:.1} ms, most {most:.1} ms, of {}",
        at(0.5),
        at(0.99),
        delays.len()
    )
}

/// Somebody draws strokes on a new tree; how long each part took to its frame.
async fn draw(server: Arc<Server>, number: u32) -> Vec<Duration> {
    let session = block_in_place(|| server.new_session(number));
    let mut client = Client::connect(server.port(), &session, &format!("somebody-{number}")).await;
    // Not all hands move at once.
    sleep(EVERY * number / PEOPLE).await;
    let mut ticks = interval(EVERY);
    ticks.set_missed_tick_behavior(MissedTickBehavior::Delay);
    let (begun, mut delays) = (Instant::now(), Vec::new());
    client.send(json!({ "kind": "stroke_begin", "stroke": 1 })).await;
    let mut height = 0.0_f32;
    while begun.elapsed() < LONG {
        ticks.tick().await;
        height += 0.4;
        let sample = json!({ "position": [height % 2.0 - 1.0, height, 0.0], "radius": 2.0 });
        let (frames, sent) = (client.frames, Instant::now());
        let id = client.send(json!({ "kind": "stroke_move", "stroke": 1, "samples": [sample] })).await;
        // Here and there nothing grows by it, which is told at the next beat of what is done, 50 ms later at most.
        client.until("a frame", |client| client.frames > frames || client.done >= id).await;
        assert!(client.refused.is_empty(), "{:?}", client.refused);
        if client.frames > frames {
            delays.push(sent.elapsed());
        }
    }
    delays
}

/// A tree that grows alone, which nobody looks at.
async fn grower(server: &Arc<Server>, number: u32) -> Client {
    let session = block_in_place(|| server.new_session(1000 + number));
    let key = format!("grower-{number}");
    let mut client = Client::connect_with(server.port(), &session, &key, Receipts::Withheld).await;
    client.send(json!({ "kind": "grow", "steps": 1000 })).await;
    client
}

/// A saved tree of that size.
async fn large(server: &Arc<Server>) -> String {
    let session = block_in_place(|| server.new_session(2));
    let mut client = Client::connect(server.port(), &session, "somebody-else").await;
    while client.state.metamers < LARGE {
        client.send(json!({ "kind": "grow", "steps": 1 })).await;
        client.until_settled().await;
    }
    let saved = post(server, "/api/v1/trees", &json!({ "session": session, "name": "Large" })).await;
    saved["id"].as_str().unwrap_or_default().to_owned()
}

/// Begins sessions with a saved tree, up to the welcome of each.
async fn open_again_and_again(server: Arc<Server>, tree: String) {
    let begun = Instant::now();
    while begun.elapsed() < LONG {
        let made = post(&server, "/api/v1/sessions", &json!({ "tree": tree, "template": true })).await;
        let session = made["session"].as_str().unwrap_or_default();
        let joined = Client::connect_with(server.port(), session, "whoever-opens", Receipts::Withheld);
        // Whoever waits too long has waited as long as is measured.
        let _ = timeout(LONG, joined).await;
    }
}

async fn post(server: &Arc<Server>, address: &str, body: &Value) -> Value {
    let answer = block_in_place(|| http::send(server.port(), "POST", address, Some(body)));
    let answer = answer.expect("the server answers");
    assert!(answer.status < 300, "{address}: {}", answer.text());
    answer.json()
}

fn ms(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}
