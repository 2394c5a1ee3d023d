//! Kills while trees are saved, put up and deleted: nothing acknowledged is lost, nothing is there twice.

use std::{
    collections::{BTreeMap, BTreeSet},
    sync::mpsc,
    thread,
    time::Duration,
};

use espalier_tests::{
    dice::Dice,
    http,
    scratch::Scratch,
    server::{Server, kills},
};
use serde_json::{Value, json};

const SEED: u32 = 11;

/// Something asked of the library.
#[derive(Clone, Debug)]
enum Ask {
    /// Save what stands in a session.
    Save { session: String, name: String },
    /// Put up a file.
    Upload { file: Vec<u8>, name: String },
    /// Delete the tree with this number.
    Delete { tree: String },
}

impl Ask {
    /// Asks; an error where the server dies meanwhile. The key is the name, so that asking twice is asking once.
    fn send(&self, port: u16) -> std::io::Result<http::Answer> {
        let key = |name: &str| format!("idempotency-key: {name}\r\n");
        match self {
            Self::Save { session, name } => {
                let body = json!({ "session": session, "name": name }).to_string();
                let headers = format!("content-type: application/json\r\n{}", key(name));
                http::send_with(port, "POST", "/api/v1/trees", &headers, body.as_bytes())
            }
            Self::Upload { file, name } => {
                let headers = format!("content-type: application/octet-stream\r\n{}", key(name));
                http::send_with(
                    port,
                    "POST",
                    &format!("/api/v1/trees/import?format=espalier&name={name}"),
                    &headers,
                    file,
                )
            }
            Self::Delete { tree } => http::send(port, "DELETE", &format!("/api/v1/trees/{tree}"), None),
        }
    }
}

/// What the server has answered so far.
#[derive(Default)]
struct Known {
    /// Trees by their names.
    saved: BTreeMap<String, String>,
    deleted: BTreeSet<String>,
}

impl Known {
    fn take(&mut self, ask: &Ask, answer: &http::Answer) {
        match ask {
            Ask::Save { name, .. } | Ask::Upload { name, .. } => {
                assert_eq!(answer.status, 201, "{name}: {}", answer.text());
                let tree = answer.json()["id"].as_str().expect("a tree has a number").to_owned();
                if let Some(before) = self.saved.insert(name.clone(), tree.clone()) {
                    assert_eq!(before, tree, "{name} is one tree");
                }
            }
            Ask::Delete { tree } => {
                assert!([204, 404].contains(&answer.status), "{tree}: {}", answer.text());
                self.deleted.insert(tree.clone());
            }
        }
    }

    /// Everything acknowledged is as it was acknowledged.
    fn check(&self, port: u16) {
        for (name, tree) in &self.saved {
            let answer = http::get(port, &format!("/api/v1/trees/{tree}")).expect("the server answers");
            assert_eq!(
                (answer.status, answer.json()["name"].as_str()),
                (200, Some(name.as_str())),
                "{name} is lost"
            );
            let is_deleted = !answer.json()["deleted_at"].is_null();
            assert!(is_deleted || !self.deleted.contains(tree), "{name} has come back");
        }
    }
}

/// The trees of each name, deleted ones included.
fn trees(port: u16) -> BTreeMap<String, Vec<String>> {
    let mut names = BTreeMap::new();
    for deleted in [false, true] {
        let mut after = String::new();
        loop {
            let path = format!("/api/v1/trees?limit=50&deleted={deleted}{after}");
            let page: Value = http::get(port, &path).expect("the server answers").json();
            for tree in page["trees"].as_array().expect("a page has trees") {
                let of =
                    |field: &str| tree[field].as_str().expect("a tree has a name and a number").to_owned();
                names.entry(of("name")).or_insert_with(Vec::new).push(of("id"));
            }
            match page["next"].as_str() {
                Some(next) => after = format!("&after={next}"),
                None => break,
            }
        }
    }
    names
}

#[test]
fn kills_lose_and_double_nothing_in_the_library() {
    let mut dice = Dice::new(2026);
    let scratch = Scratch::new();
    let mut server = Server::start(&scratch.path("trees.db"));
    let session = server.new_session(SEED);
    let file = http::get(server.port(), &format!("/api/v1/sessions/{session}/tree.espalier"));
    let file = file.expect("the server answers").body;
    let mut known = Known::default();
    let kills = kills(5);
    for round in 0..kills {
        let port = server.port();
        let (told, answers) = mpsc::channel();
        let living: Vec<String> =
            known.saved.values().filter(|tree| !known.deleted.contains(*tree)).cloned().collect();
        let (session, file) = (session.clone(), file.clone());
        let at_work = thread::spawn(move || {
            let (mut answered, mut living) = (Vec::new(), living.into_iter());
            for number in 0.. {
                let name = format!("tree-{round}-{number}");
                let ask = match number % 3 {
                    0 => Ask::Save { session: session.clone(), name },
                    1 => Ask::Upload { file: file.clone(), name },
                    _ => match living.next() {
                        Some(tree) => Ask::Delete { tree },
                        None => continue,
                    },
                };
                match ask.send(port) {
                    Ok(answer) => {
                        answered.push((ask, answer));
                        told.send(()).expect("it is counted until the server is killed");
                    }
                    Err(_) => return (answered, ask),
                }
            }
            unreachable!("the server is killed")
        });
        for _ in 0..1 + round % 4 {
            answers.recv().expect("the server answers");
        }
        thread::sleep(Duration::from_millis(dice.roll(40) as u64));
        server = server.kill_and_restart();
        let (answered, last) = at_work.join().expect("every answer was in good form");
        for (ask, answer) in &answered {
            known.take(ask, answer);
        }
        known.check(server.port());
        // What nobody answered is asked again; where the server does not know whether it was done, one looks.
        let again = last.send(server.port()).expect("the server answers");
        match &last {
            Ask::Save { name, .. } | Ask::Upload { name, .. } if again.status == 409 => {
                assert_eq!(again.json()["reason"], "outcome-unknown", "{name}");
                if let Some(found) = trees(server.port()).remove(name) {
                    known.saved.insert(name.clone(), found[0].clone());
                }
            }
            _ => known.take(&last, &again),
        }
        known.check(server.port());
    }
    assert!(!known.saved.is_empty() && !known.deleted.is_empty(), "something was done before each kill");
    let there = trees(server.port());
    let wanted = known.saved.iter().map(|(name, tree)| (name.clone(), vec![tree.clone()]));
    assert_eq!(there, wanted.collect(), "each is there once, and nothing else");
    println!("{kills} kills: {} trees kept, {} deleted", known.saved.len(), known.deleted.len());
}
