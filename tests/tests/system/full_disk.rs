//! What a server can still do when the disk is full.

use std::{
    thread,
    time::{Duration, Instant},
};

use espalier_tests::{
    full_disk::FullDisk,
    http::{self, Answer},
    server::{GUARD, Server},
};
use serde_json::Value;

/// What is kept so that something can be deleted on a full disk.
const RESERVE: &str = "trees.db.reserve";

struct House {
    disk: FullDisk,
    server: Server,
}

impl House {
    /// A server with the trees of these names, which has kept room for deleting.
    fn with_trees(names: &[&str]) -> (Self, Vec<String>) {
        let disk = FullDisk::new();
        let server = Server::start_in(&disk.environment(), &disk.path("trees.db"));
        let house = Self { disk, server };
        let ids = names.iter().map(|name| {
            let answer = house.save(name);
            assert_eq!(answer.status, 201, "{}", answer.text());
            answer.json()["id"].as_str().expect("an identifier").to_owned()
        });
        let ids = ids.collect();
        until("room is kept", || house.disk.has(RESERVE));
        (house, ids)
    }

    fn ask(&self, method: &str, path: &str, body: Option<&Value>) -> Answer {
        http::send(self.server.port(), method, path, body).expect("the server answers")
    }

    /// A tree of some hundred kilobytes.
    fn save(&self, name: &str) -> Answer {
        let mut wood =
            "id,parent,start_x,start_y,start_z,end_x,end_y,end_z,radius,length,branch,branch_order"
                .to_owned();
        for at in 1..=3000_u32 {
            let [low, high] = [at - 1, at].map(|at| f64::from(at) * 0.01);
            wood += &format!("\n{at},{},0,0,{low},0,0,{high},0.1,0.01,1,0", at - 1);
        }
        let path = format!("/api/v1/trees/import?format=csv&name={name}");
        let answer = http::send_bytes(self.server.port(), "POST", &path, "text/csv", wood.as_bytes());
        answer.expect("the server answers")
    }

    fn listed(&self) -> Vec<String> {
        let list = self.ask("GET", "/api/v1/trees", None).json();
        let trees = list["trees"].as_array().cloned().unwrap_or_default();
        let mut names: Vec<String> =
            trees.iter().filter_map(|tree| tree["name"].as_str()).map(str::to_owned).collect();
        names.sort();
        names
    }
}

fn until(what: &str, mut is_so: impl FnMut() -> bool) {
    let begun = Instant::now();
    while !is_so() {
        assert!(begun.elapsed() < GUARD, "never: {what}");
        thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn deleting_works_on_a_full_disk_and_makes_room() {
    let (house, ids) = House::with_trees(&["Ash", "Elm", "Oak"]);
    house.disk.fill_up_to(0);
    // Nothing more fits, that is said, and nothing of it stays.
    let mut refused = house.save("Yew");
    for _ in 0..50 {
        if refused.status == 503 {
            break;
        }
        // What lay free in the log and in the database has been used.
        refused = house.save("Yew");
    }
    assert_eq!(
        (refused.status, refused.json()["reason"].as_str()),
        (503, Some("database-failed")),
        "{}",
        refused.text()
    );
    assert!(refused.text().contains("disk"), "{}", refused.text());
    let before = house.listed();

    let path = format!("/api/v1/trees/{}", ids[1]);
    let deleted = house.ask("DELETE", &path, None);
    assert_eq!(deleted.status, 204, "{}", deleted.text());
    let gone = house.ask("DELETE", &format!("{path}/for-good"), None);
    assert_eq!(gone.status, 204, "{}", gone.text());
    let mut left = before;
    left.retain(|name| name != "Elm");
    assert_eq!(house.listed(), left);
    // The rest is whole, and can be deleted as well.
    for id in [&ids[0], &ids[2]] {
        let path = format!("/api/v1/trees/{id}");
        assert_eq!(house.ask("GET", &format!("{path}/versions/1/tree.json"), None).status, 200);
        assert_eq!(house.ask("DELETE", &path, None).status, 204);
        assert_eq!(house.ask("DELETE", &format!("{path}/for-good"), None).status, 204);
    }
    // What was deleted makes room by itself: saving works again.
    until("there is room again", || house.save("Pine").status == 201);
    assert!(house.listed().contains(&"Pine".to_owned()));
}

#[test]
fn a_server_that_starts_on_a_full_disk_lets_delete() {
    let (House { disk, server }, ids) = House::with_trees(&["Ash", "Elm"]);
    assert!(server.terminate().success());
    disk.fill_up_to(0);
    let server = Server::start_in(&disk.environment(), &disk.path("trees.db"));
    let house = House { disk, server };
    assert_eq!(house.listed(), ["Ash", "Elm"]);
    let path = format!("/api/v1/trees/{}", ids[0]);
    let deleted = house.ask("DELETE", &path, None);
    assert_eq!(deleted.status, 204, "{}", deleted.text());
    assert_eq!(house.ask("DELETE", &format!("{path}/for-good"), None).status, 204);
    assert_eq!(house.listed(), ["Elm"]);
}
