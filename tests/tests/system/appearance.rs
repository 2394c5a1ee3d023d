//! `AP`, `SC1`: looks of a session for everybody in it, schematics, pictures of species.

use espalier_proto::{ProblemCode, Schematic};
use espalier_settings::{Appearance, AppearancePatch, BarkKind, BarkLook, LeafLook, ParameterValues, Sky};
use espalier_tests::{client::Client, http, scratch::Scratch, server::Server};
use serde_json::{Value, json};
use tokio_tungstenite::tungstenite::Message;

fn season(season: f32, gesture: Option<u32>) -> Value {
    let leaves = LeafLook { season, ..Appearance::default().leaves };
    let appearance = AppearancePatch { leaves: Some(leaves.into()), ..AppearancePatch::default() };
    json!({ "kind": "set_appearance", "appearance": appearance, "gesture": gesture })
}

async fn seen(client: &mut Client, season: f32) {
    client.until("the season is told", |client| client.appearance.leaves.season == season).await;
}

#[tokio::test]
async fn ap3_everybody_hears_of_looks_and_of_undo() {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    let session = server.new_session(7);
    let mut first = Client::connect(server.port(), &session, "browser-1").await;
    first.until("looks follow the welcome", |client| client.appearances > 0).await;
    assert_eq!(first.appearance, Appearance::default());
    let mut second = Client::connect(server.port(), &session, "browser-2").await;
    for value in [1.5, 1.75, 2.0] {
        first.send(season(value, Some(1))).await;
    }
    seen(&mut first, 2.0).await;
    seen(&mut second, 2.0).await;
    let mut late = Client::connect(server.port(), &session, "browser-3").await;
    seen(&mut late, 2.0).await;
    second.send(json!({ "kind": "undo" })).await;
    for client in [&mut first, &mut second, &mut late] {
        seen(client, 1.0).await;
    }
    second.send(json!({ "kind": "redo" })).await;
    seen(&mut first, 2.0).await;
    first.until_settled().await;
    let operations = first.timeline.operations.len();
    assert!(operations <= 1, "AP2: a drag is one operation, not {operations}");
}

#[tokio::test]
async fn looks_outlive_a_kill_and_go_with_saved_trees() {
    let scratch = Scratch::new();
    let database = scratch.path("trees.db");
    let server = Server::start(&database);
    let session = server.new_session(7);
    let mut client = Client::connect(server.port(), &session, "browser-1").await;
    let bark = BarkLook { kind: BarkKind::Papery, ..Appearance::default().bark };
    let mut background = Appearance::default().background;
    background.sky = Sky::Overcast;
    let appearance = AppearancePatch {
        bark: Some(bark.into()),
        background: Some(background.into()),
        ..AppearancePatch::default()
    };
    client.send(json!({ "kind": "grow", "steps": 4 })).await;
    client.send(json!({ "kind": "set_appearance", "appearance": appearance })).await;
    client.until_settled().await;
    server.kill();
    let server = Server::start(&database);
    let mut client = Client::connect(server.port(), &session, "browser-2").await;
    client.until("looks are told", |client| client.appearances > 0).await;
    assert_eq!((client.appearance.bark, client.appearance.background), (bark, background));

    let body = json!({"session": session, "name": "Birch"});
    let saved = http::send(server.port(), "POST", "/api/v1/trees", Some(&body)).expect("the server answers");
    assert_eq!(saved.status, 201, "{}", saved.text());
    let opened = json!({"tree": saved.json()["id"], "template": true});
    let opened = http::send(server.port(), "POST", "/api/v1/sessions", Some(&opened)).expect("an answer");
    let other = opened.json()["session"].as_str().expect("a session").to_owned();
    let mut visitor = Client::connect(server.port(), &other, "browser-3").await;
    visitor.until("looks are told", |client| client.appearances > 0).await;
    assert_eq!((visitor.appearance.bark, visitor.appearance.background), (bark, background));
}

#[tokio::test]
async fn bad_looks_are_refused_by_name_and_change_nothing() {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    let session = server.new_session(7);
    let mut client = Client::connect(server.port(), &session, "browser-1").await;
    let leaves =
        |change: &str| format!(r#"{{"leaves":{{"shape":"ovate","tint":[1,2,3],"vigor_shift":0,{change}}}}}"#);
    let cases = [
        (leaves(r#""season":4,"orientation":0"#), "appearance.leaves.season", "0 to 3"),
        (leaves(r#""season":NaN,"orientation":0"#), "appearance.leaves.season", "0 to 3"),
        (leaves(r#""season":1e39,"orientation":0"#), "appearance.leaves.season", "0 to 3"),
        (leaves(r#""season":1,"orientation":"up""#), "appearance.leaves.orientation", "-1 to 1"),
        (r#"{"leaves":null}"#.into(), "appearance.leaves", ""),
        (r#"{"petals":{}}"#.into(), "appearance.petals", ""),
        (leaves(r#""season":1,"orientation":0,"smell":1"#), "appearance.leaves.smell", "shape, tint"),
        (r#"{"background":{"backdrop":[0,300,0]}}"#.into(), "appearance.background.backdrop[1]", "0 to 255"),
    ];
    for (id, (looks, field, allowed)) in (1..).zip(&cases) {
        let command = format!(
            r#"{{"type":"command","id":{id},"command":{{"kind":"set_appearance","appearance":{looks}}}}}"#
        );
        client.send_raw(Message::text(command)).await;
        client.until("it is refused", |client| client.refused.len() == id).await;
        let (number, problem) = client.refused.last().expect("a refusal");
        assert_eq!(*number as usize, id);
        assert_eq!(problem.field.as_deref(), Some(*field), "{looks}: {problem}");
        assert!(problem.message.contains(allowed), "{problem}");
        assert_ne!(problem.code, ProblemCode::Unavailable);
    }
    assert_eq!(client.appearance, Appearance::default());
    assert!(!client.state.can_undo);
}

#[tokio::test]
async fn sc1_schematics_are_small_flat_and_steady() {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    let session = server.new_session(7);
    let client = Client::connect(server.port(), &session, "browser-1").await;
    let ask = |parameters: &Value| {
        http::send(server.port(), "POST", "/api/v1/schematic", Some(parameters)).expect("the server answers")
    };
    let defaults = serde_json::to_value(&client.parameters).expect("JSON");
    let first = ask(&defaults);
    assert_eq!(first.status, 200, "{}", first.text());
    let drawn: Schematic = serde_json::from_slice(&first.body).expect("a schematic");
    assert!((60..=420).contains(&drawn.parents.len()), "{}", drawn.parents.len());
    assert_eq!(ask(&defaults).body, first.body, "the same again");
    // The heaviest parameters there are end as small.
    let heaviest = ParameterValues {
        perception_depth: 10.0,
        perception_angle: 360.0,
        markers_per_bud: 32,
        max_shoot_length: 20,
        buds_per_node: 4,
        shadow_depth: 8,
        ..client.parameters.clone()
    };
    let heavy = ask(&serde_json::to_value(&heaviest).expect("JSON"));
    let heavy: Schematic = serde_json::from_slice(&heavy.body).expect("a schematic");
    assert!(heavy.parents.len() <= 420);

    let mut wrong = defaults.clone();
    wrong["apical_control"] = json!(3);
    let answer = ask(&wrong);
    assert_eq!((answer.status, answer.json()["field"].as_str()), (400, Some("apical_control")));
    for bad in [json!({}), json!([]), json!({"apical_control": 0.5}), json!(null)] {
        assert_eq!(ask(&bad).status, 400, "{bad}");
    }
    wrong["extra"] = json!("x".repeat(9000));
    assert_eq!(ask(&wrong).status, 413);
    assert_eq!(http::get(server.port(), "/api/v1/schematic").expect("an answer").status, 405);
}

#[tokio::test]
async fn species_have_pictures_that_may_be_kept() {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    let path = "/api/v1/species/bonsai-literati/picture";
    let first = http::get(server.port(), path).expect("the server answers");
    assert_eq!((first.status, first.header("content-type")), (200, Some("image/png")));
    assert!(first.body.starts_with(b"\x89PNG\r\n\x1a\n"));
    assert!(first.header("cache-control").is_some_and(|cache| cache.contains("max-age")));
    let tag = first.header("etag").expect("a tag").to_owned();
    assert!(tag.starts_with('"') && tag.len() > 10, "{tag}");
    let again = http::get(server.port(), path).expect("the server answers");
    assert_eq!(again.header("etag"), Some(tag.as_str()));
    assert_eq!(again.body, first.body);
    for missing in ["/api/v1/species/triffid/picture", "/api/v1/species/%2e%2e/picture"] {
        assert_eq!(http::get(server.port(), missing).expect("an answer").status, 404);
    }
}
