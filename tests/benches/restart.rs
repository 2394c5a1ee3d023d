//! How long a restart takes from the side of those who draw: from SIGTERM to the end of the process, until the next one
//! answers, until everybody is welcome again, and until all that was sent is durable.

use std::{
    env,
    time::{Duration, Instant},
};

use espalier_tests::{client::Client, scratch::Scratch, server::Server};
use serde_json::json;
use tokio::{task::JoinSet, time::sleep};

/// People who draw, each in a session of their own.
const PEOPLE: u32 = 20;
/// Living metamers of their trees, and of one more that somebody draws on.
const METAMERS: u32 = 5_000;
const LARGE: u32 = 100_000;
/// So often the server is started anew, unless another number stands behind the command.
const TIMES: usize = 10;
/// So often a hand sends what it drew.
const EVERY: Duration = Duration::from_millis(100);
/// How long everybody draws before the server stops.
const DRAWING: Duration = Duration::from_secs(2);
/// How long a page waits before it comes back first, and then while nobody answers.
const AGAIN: Duration = Duration::from_millis(50);

#[derive(Default)]
struct Times {
    ended: Vec<Duration>,
    ready: Vec<Duration>,
    welcome: Vec<Duration>,
    durable: Vec<Duration>,
}

#[tokio::main]
async fn main() {
    let scratch = Scratch::new();
    let mut server = Server::start(&scratch.path("trees.db"));
    let port = server.port();
    let sizes = (0..PEOPLE).map(|_| METAMERS).chain([LARGE]);
    let mut people = Vec::new();
    for (number, metamers) in (0..).zip(sizes) {
        people.push(grown(&server, number, metamers).await);
    }
    let mut times = Times::default();
    let rounds = env::args().find_map(|times| times.parse().ok()).unwrap_or(TIMES);
    for round in 0..rounds {
        let begun = Instant::now() + DRAWING;
        let mut drawing = JoinSet::new();
        for (number, person) in people.drain(..).enumerate() {
            drawing.spawn(draw(person, port, round as u32, number, begun));
        }
        sleep(DRAWING).await;
        let stopped = Instant::now();
        let database = scratch.path("trees.db");
        let next = tokio::task::spawn_blocking(move || {
            assert!(server.terminate().success(), "the server ends as it should");
            let ended = stopped.elapsed();
            (ended, Server::start_on(&database, port), stopped.elapsed())
        });
        let (ended, started, ready) = next.await.expect("the server starts again");
        server = started;
        times.ended.push(ended);
        times.ready.push(ready);
        while let Some(back) = drawing.join_next().await {
            let (person, welcome, durable) = back.expect("everybody comes back");
            times.welcome.push(welcome.duration_since(stopped));
            times.durable.push(durable.duration_since(stopped));
            people.push(person);
        }
    }
    println!(
        "{rounds} restarts, {PEOPLE} people who draw on {METAMERS} metamers and one on {LARGE}; from SIGTERM, in ms"
    );
    println!("| until | median | most |\n|---|---|---|");
    for (what, times) in [
        ("the process has ended", times.ended),
        ("the next one answers", times.ready),
        ("a page is welcome again", times.welcome),
        ("all that it sent is durable", times.durable),
    ] {
        let (median, most) = spread(times);
        println!("| {what} | {median:.0} | {most:.0} |");
    }
}

/// A session with a tree.
async fn grown(server: &Server, seed: u32, metamers: u32) -> Client {
    let session = server.new_session(seed);
    let mut client = Client::connect(server.port(), &session, &format!("somebody-{seed}")).await;
    while client.state.metamers < metamers {
        client.send(json!({ "kind": "grow", "steps": 1 })).await;
        client.until_settled().await;
    }
    client
}

/// Draws until the server has gone, comes back, and waits until all that was sent is durable; when it was welcome, and when
/// that was so.
async fn draw(
    mut client: Client,
    port: u16,
    stroke: u32,
    number: usize,
    earliest: Instant,
) -> (Client, Instant, Instant) {
    client.send(json!({ "kind": "stroke_begin", "stroke": stroke })).await;
    let mut part = 0_u8;
    while client.is_connected() {
        let out = 2.0 + f32::from(part % 20) * 0.8;
        let position = [out, 4.0 + f32::from(part % 20) * 0.9, number as f32 * 0.1];
        let samples = json!([{ "position": position, "radius": 2.0 }]);
        client.send(json!({ "kind": "stroke_move", "stroke": stroke, "samples": samples })).await;
        client.listen(EVERY).await;
        part = part.wrapping_add(1);
    }
    let code = client.closed.as_ref().map(|close| u16::from(close.code));
    assert!(Instant::now() >= earliest, "nobody is let go before the server stops: {code:?}");
    assert_eq!(code, Some(1001), "HS5");
    let acknowledged = client.acknowledged;
    while !is_there(port).await {
        sleep(AGAIN).await;
    }
    client.reconnect(port).await;
    let welcome = Instant::now();
    assert!(client.acknowledged >= acknowledged, "nothing that was acknowledged is lost");
    let last = client.unacknowledged.back().map_or(0, |(id, _)| *id);
    client.until("all is durable", |client| client.acknowledged >= last).await;
    let durable = Instant::now();
    client.send(json!({ "kind": "stroke_end", "stroke": stroke })).await;
    client.send(json!({ "kind": "take_back" })).await;
    client.until_settled().await;
    (client, welcome, durable)
}

async fn is_there(port: u16) -> bool {
    tokio::net::TcpStream::connect(("127.0.0.1", port)).await.is_ok()
}

/// The middle one and the last one, in milliseconds.
fn spread(mut times: Vec<Duration>) -> (f64, f64) {
    times.sort_unstable();
    let ms = |time: Option<&Duration>| time.map_or(f64::NAN, |time| time.as_secs_f64() * 1000.0);
    (ms(times.get(times.len() / 2)), ms(times.last()))
}
