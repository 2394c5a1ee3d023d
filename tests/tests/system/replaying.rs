//! Replays over real sockets: copies in which somebody plays a design.

use espalier_tests::{
    client::{self, Socket},
    scratch::Scratch,
};
use futures_util::SinkExt;
use serde_json::{Value, json};

use super::{
    people::ask,
    removing::{come, come_to, number_of, studio, tree, until},
};

/// Gives a command and waits until it is done.
async fn does(socket: &mut Socket, id: u32, command: Value) {
    let message = json!({ "type": "command", "id": id, "command": command });
    socket.send(client::text(&message)).await.expect("it is sent");
    until(socket, |message| message["type"] == "done" && message["id"] == id).await;
}

/// The step at which the line of time stands for whoever comes.
async fn step(socket: &mut Socket) -> Value {
    until(socket, |message| message["type"] == "timeline").await["step"].clone()
}

#[tokio::test]
async fn rp2_nothing_of_a_replay_is_kept_or_reaches_the_session() {
    let scratch = Scratch::new();
    let users = [("Ann", "owner"), ("Cy", "viewer")];
    let (server, [ann, cy]) = studio(&scratch.path("trees.db"), users);
    let (session, _) = tree(&server, &ann);
    let mut anns = come(&server, &session, &ann, "client-of-ann").await;
    does(&mut anns, 1, json!({ "kind": "grow", "steps": 3 })).await;
    let mut replay = come_to(&server, &session, "replay", &cy, "client-of-cy").await;
    assert_eq!(step(&mut replay).await, 3);
    does(&mut replay, 1, json!({ "kind": "go_to", "step": 0 })).await;
    // Nor does what is done meanwhile reach the replay.
    does(&mut anns, 2, json!({ "kind": "grow", "steps": 2 })).await;
    does(&mut replay, 2, json!({ "kind": "go_to", "step": 3 })).await;
    let beyond = json!({ "type": "command", "id": 3, "command": { "kind": "go_to", "step": 5 } });
    replay.send(client::text(&beyond)).await.expect("it is sent");
    let refused = until(&mut replay, |message| {
        ["problem", "refused"].contains(&message["type"].as_str().unwrap_or_default())
    })
    .await;
    assert_eq!(refused["problem"]["field"], "step", "{refused}");
    drop(replay);
    let mut looks = come(&server, &session, &cy, "client-of-cy").await;
    assert_eq!(step(&mut looks).await, 5, "the session stands where it was drawn");
    let mut again = come_to(&server, &session, "replay", &cy, "client-of-cy").await;
    assert_eq!(step(&mut again).await, 5, "and so does the next replay");
    let list = ask(&server, "GET", "/api/v1/sessions", &ann, "").json();
    assert_eq!(list["sessions"].as_array().map(Vec::len), Some(1), "{list}");
}

#[tokio::test]
async fn rp2_who_is_removed_from_a_session_is_removed_from_its_replay() {
    let scratch = Scratch::new();
    let (server, [ann, bo]) = studio(&scratch.path("trees.db"), [("Ann", "owner"), ("Bo", "editor")]);
    let (session, _) = tree(&server, &ann);
    let mut anns = come(&server, &session, &ann, "client-of-ann").await;
    let mut bos = come(&server, &session, &bo, "client-of-bo").await;
    let mut replay = come_to(&server, &session, "replay", &bo, "client-of-bo").await;
    until(&mut replay, |message| message["type"] == "welcome").await;
    until(&mut bos, |message| message["type"] == "welcome").await;
    let number = number_of(&mut anns, "Bo").await;
    let path = format!("/api/v1/sessions/{session}/people/{number}");
    assert_eq!(ask(&server, "DELETE", &path, &ann, "").status, 200);
    assert_eq!(client::close(&mut replay).await, Some((4005, "removed: Ann".into())));
}
