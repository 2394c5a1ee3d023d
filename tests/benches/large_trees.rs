//! What a large tree costs a server: to save, to open, to open again after a crash, and to export; and how long others
//! wait for their drawing while one is exported.

use std::{
    io::{self, Read, Write},
    net::TcpStream,
    thread,
    time::{Duration, Instant},
};

use espalier_tests::{
    client::{self, Client},
    http,
    scratch::Scratch,
    server::Server,
};
use serde_json::{Value, json};

/// Living metamers of the trees, at least, where no others are given behind the command.
const SIZES: [u32; 2] = [100_000, 500_000];
/// So often each is saved and opened.
const TIMES: usize = 5;
/// Steps of growth that are timed while nothing else happens.
const STEPS: usize = 100;

#[tokio::main]
async fn main() {
    let scratch = Scratch::new();
    let mut server = Server::start(&scratch.path("trees.db"));
    let mut other = grown(&server, 1, 1_000).await;
    let mut quiet = Vec::new();
    while quiet.len() < STEPS {
        quiet.push(step(&mut other).await);
    }
    println!("a step of somebody else: {}", spread(quiet));
    let given: Vec<u32> = std::env::args().filter_map(|size| size.parse().ok()).collect();
    for &size in if given.is_empty() { &SIZES[..] } else { &given } {
        let (mut client, tree) = save_first(&server, size).await;
        save_again(&server, &mut client, &tree).await;
        open(&server, &tree).await;
        turn(&server, &tree);
        export(&server, &client, &mut other).await;
        let session = client.session.clone();
        drop(client);
        server = server.kill_and_restart();
        let begun = Instant::now();
        let loading = first_sign(&server, &session).await;
        let welcome = first_frame(&server, &session).await;
        println!(
            "  opened again after a crash: {:.0} ms, told how far it is after {:.0} ms, welcome after {:.0} ms",
            ms(begun.elapsed()),
            ms(loading),
            ms(loading + welcome)
        );
        other.reconnect(server.port()).await;
    }
}

/// Grows trees of other seeds, so that they share no parts, and saves each; gives the last.
async fn save_first(server: &Server, size: u32) -> (Client, String) {
    let mut times = Vec::new();
    let mut seed = 2;
    loop {
        let client = grown(server, seed, size).await;
        let body = json!({ "session": client.session, "name": "Large" });
        let begun = Instant::now();
        let id = post(server, "/api/v1/trees", &body)["id"].as_str().unwrap_or_default().to_owned();
        times.push(begun.elapsed());
        if times.len() == TIMES {
            println!("{} metamers", client.state.metamers);
            println!("  saved as a new tree: {}", spread(times));
            return (client, id);
        }
        seed += 1;
    }
}

/// Saves the tree and one step more as its next versions.
async fn save_again(server: &Server, client: &mut Client, id: &str) {
    let mut times = Vec::new();
    let processor = server.processor_time();
    for _ in 0..TIMES {
        client.send(json!({ "kind": "grow", "steps": 1 })).await;
        client.until_settled().await;
        let begun = Instant::now();
        post(server, &format!("/api/v1/trees/{id}/versions"), &json!({ "session": client.session }));
        times.push(begun.elapsed());
        client.send(json!({ "kind": "undo" })).await;
        client.until_settled().await;
    }
    let processor = (server.processor_time() - processor) / TIMES as u32;
    println!(
        "  a step more, saved as the next version: {}; {:.0} ms of processor time with the step",
        spread(times),
        ms(processor)
    );
}

/// Begins sessions with the tree, up to the first frame of each.
async fn open(server: &Server, tree: &str) {
    let mut times = Vec::new();
    for _ in 0..TIMES {
        let begun = Instant::now();
        let made = post(server, "/api/v1/sessions", &json!({ "tree": tree, "template": true }));
        first_frame(server, made["session"].as_str().unwrap_or_default()).await;
        times.push(begun.elapsed());
    }
    println!("  a new session begun with it, up to its first frame: {}", spread(times));
}

/// Has its turntable drawn.
fn turn(server: &Server, tree: &str) {
    // Of a large tree it takes longer than answers are waited for in tests.
    let (first, _) = silence(server.port(), &format!("/api/v1/trees/{tree}/versions/1/turntable"))
        .expect("the server answers");
    println!("  its turntable: {:.2} s", first.as_secs_f64());
}

/// From asking for a socket to the first word on it.
async fn first_sign(server: &Server, session: &str) -> Duration {
    let begun = Instant::now();
    let mut socket = client::open(server.port(), session).await;
    let first = client::next(&mut socket).await;
    let text = first.as_ref().and_then(|message| message.to_text().ok()).unwrap_or_default();
    assert!(text.contains("loading"), "{first:?}");
    begun.elapsed()
}

/// Joins a session up to its first frame; tells when it was welcome.
async fn first_frame(server: &Server, session: &str) -> Duration {
    let begun = Instant::now();
    let mut client = Client::connect(server.port(), session, "whoever-opens").await;
    let welcome = begun.elapsed();
    client.until("the first frame", |client| client.frames > 0).await;
    welcome
}

/// Exports the tree as glTF: alone, then while somebody else draws.
async fn export(server: &Server, client: &Client, other: &mut Client) {
    let (port, address) = (server.port(), format!("/api/v1/sessions/{}/tree.glb", client.session));
    let (processor, held) = (server.processor_time(), server.resident_bytes());
    server.forget_peak();
    let begun = Instant::now();
    let bytes = download(port, &address);
    println!(
        "  exported as {} MB of glTF: {:.2} s, {:.2} s of processor time, {} MB of memory more at most",
        bytes / 1_000_000,
        begun.elapsed().as_secs_f64(),
        (server.processor_time() - processor).as_secs_f64(),
        server.peak_bytes().saturating_sub(held) / 1_000_000,
    );
    let begun = Instant::now();
    let (first, longest) = silence(port, &address).expect("the server answers");
    println!(
        "  the same again: first byte after {:.2} s, longest time without one {:.2} s, of {:.2} s",
        first.as_secs_f64(),
        longest.as_secs_f64(),
        begun.elapsed().as_secs_f64()
    );
    let exporting = thread::spawn(move || download(port, &address));
    let mut meanwhile = Vec::new();
    while !exporting.is_finished() {
        meanwhile.push(step(other).await);
    }
    println!("  a step of somebody else meanwhile: {}", spread(meanwhile));
}

/// Somebody in a session of their own, with a tree that large.
async fn grown(server: &Server, seed: u32, metamers: u32) -> Client {
    let session = server.new_session(seed);
    let mut client = Client::connect(server.port(), &session, &format!("somebody-{metamers}")).await;
    while client.state.metamers < metamers {
        client.send(json!({ "kind": "grow", "steps": 1 })).await;
        client.until_settled().await;
    }
    client
}

/// From one step of growth to its frame; the step is taken back.
async fn step(client: &mut Client) -> Duration {
    let frames = client.frames;
    let begun = Instant::now();
    client.send(json!({ "kind": "grow", "steps": 1 })).await;
    client.until("a frame", |client| client.frames > frames).await;
    let time = begun.elapsed();
    client.send(json!({ "kind": "ungrow", "steps": 1 })).await;
    client.until_settled().await;
    time
}

fn post(server: &Server, address: &str, body: &Value) -> Value {
    let answer = http::send(server.port(), "POST", address, Some(body)).expect("the server answers");
    assert!(answer.status < 300, "{address}: {}", answer.text());
    answer.json()
}

/// Reads a file and forgets it; the time to its first byte, and the longest without one.
fn silence(port: u16, address: &str) -> io::Result<(Duration, Duration)> {
    let mut stream = TcpStream::connect(("127.0.0.1", port))?;
    let head = format!("GET {address} HTTP/1.1\r\nhost: 127.0.0.1:{port}\r\nconnection: close\r\n\r\n");
    stream.write_all(head.as_bytes())?;
    let (begun, mut piece) = (Instant::now(), vec![0; 1 << 20]);
    let (mut first, mut longest, mut last) = (None, Duration::ZERO, begun);
    while stream.read(&mut piece)? > 0 {
        first.get_or_insert(begun.elapsed());
        longest = longest.max(last.elapsed());
        last = Instant::now();
    }
    Ok((first.unwrap_or_default(), longest))
}

fn download(port: u16, address: &str) -> usize {
    let answer = http::get(port, address).expect("the server answers");
    assert_eq!(answer.status, 200, "{}", answer.text());
    answer.body.len()
}

fn spread(mut times: Vec<Duration>) -> String {
    times.sort_unstable();
    let at =
        |share: usize| times.get((times.len().max(1) - 1) * share / 100).map_or(f64::NAN, |&time| ms(time));
    format!("median {:.1} ms, most {:.1} ms, of {}", at(50), at(100), times.len())
}

fn ms(time: Duration) -> f64 {
    time.as_secs_f64() * 1000.0
}
