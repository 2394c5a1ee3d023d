//! How long a server takes to list and to search a library of 10,000 trees.

use std::{
    thread,
    time::{Duration, Instant},
};

use espalier_tests::{http, scratch::Scratch, server::Server};
use serde_json::{Value, json};

const TREES: usize = 10_000;
/// Those who save at the same time.
const HANDS: usize = 16;
/// So often each question is asked.
const TIMES: usize = 101;
const WORDS: [&str; 16] = [
    "Oak",
    "Birch",
    "Cedar",
    "Lake",
    "Street",
    "Winter",
    "Study",
    "Old",
    "Young",
    "Hedge",
    "Courtyard",
    "Pine",
    "Ridge",
    "North",
    "Ash",
    "Grove",
];

fn main() {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    let port = server.port();
    let saved =
        ask(port, "POST", "/api/v1/trees", &json!({ "session": server.new_session(7), "name": "First" }));
    let first = format!("/api/v1/trees/{}", saved["id"].as_str().unwrap_or_default());
    thread::scope(|scope| {
        for hand in 0..HANDS {
            let first = &first;
            scope.spawn(move || (hand..TREES).step_by(HANDS).for_each(|number| fill(port, first, number)));
        }
    });
    let middle = middle_of(port);
    for (what, query) in [
        ("the first page", "limit=48"),
        ("a page in the middle", middle.as_str()),
        ("by name", "limit=48&sort=name"),
        ("by size", "limit=48&sort=largest"),
        ("a common word", "limit=48&q=oak"),
        ("two parts of words", "limit=48&q=irc+inte"),
        ("two letters", "limit=48&q=zz"),
        ("a tag and a person", "limit=48&tags=Ridge&author=Ash"),
    ] {
        println!("{:8.2} ms  {what}", median(port, query).as_secs_f64() * 1000.0);
    }
}

/// A copy of the first tree under a name of its own, with a note and tags.
fn fill(port: u16, first: &str, number: usize) {
    let word = |step: usize| WORDS[number / step % WORDS.len()];
    let copy = json!({ "name": format!("{} {} {number}", word(1), word(16)), "author": word(3) });
    let made = ask(port, "POST", &format!("{first}/copies"), &copy);
    let path = format!("/api/v1/trees/{}", made["id"].as_str().unwrap_or_default());
    ask(
        port,
        "PATCH",
        &path,
        &json!({ "note": format!("{} in {}", word(7), word(11)), "tags": [word(5), word(2)] }),
    );
}

fn middle_of(port: u16) -> String {
    let mut query = String::from("limit=500");
    for _ in 0..TREES / 1000 {
        let page = ask(port, "GET", &format!("/api/v1/trees?{query}"), &Value::Null);
        query = format!("limit=500&after={}", page["next"].as_str().unwrap_or_default());
    }
    query.replace("limit=500", "limit=48")
}

fn median(port: u16, query: &str) -> Duration {
    let path = format!("/api/v1/trees?{query}");
    let mut times: Vec<Duration> = (0..TIMES)
        .map(|_| {
            let begun = Instant::now();
            ask(port, "GET", &path, &Value::Null);
            begun.elapsed()
        })
        .collect();
    times.sort();
    times[TIMES / 2]
}

fn ask(port: u16, method: &str, path: &str, body: &Value) -> Value {
    let body = Some(body).filter(|body| !body.is_null());
    let answer = http::send(port, method, path, body).expect("the server answers");
    assert!(answer.status < 300, "{path}: {}", answer.text());
    answer.json()
}
