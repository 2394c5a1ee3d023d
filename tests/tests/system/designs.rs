//! Plants that are designed: without a server by `espalier grow --design`, and by programs over HTTP.

use std::fs;

use espalier_tests::{
    client::Client,
    http::{self, Answer},
    program,
    scratch::Scratch,
};
use serde_json::{Value, json};

fn grown(options: &[&str]) -> Value {
    let finished = program::run(&[&["grow", "--stats", "json"], options].concat());
    assert_eq!(finished.code, 0, "{}", finished.stderr);
    serde_json::from_str(&finished.stdout).expect("one JSON object on standard output")
}

#[test]
fn designs_are_planted_from_files_and_from_templates() {
    let scratch = Scratch::new();
    let file = |name: &str, text: &str| {
        let path = scratch.path(name);
        fs::write(&path, text).expect("the file can be written");
        path.to_str().expect("it is a text").to_owned()
    };
    let of = |values: Value| json!({ "version": 1, "nodes": { "/": { "values": values } } }).to_string();
    let small = json!({ "height": { "own": 20 }, "irregularity": { "own": 0.5 } });
    let tall = json!({ "height": { "own": 60 }, "irregularity": { "own": 0.5 } });
    let (small, tall) = (file("small.json", &of(small)), file("tall.json", &of(tall)));
    let alive = |stats: &Value| stats["metamers_alive"].as_u64().expect("it is a number");
    let (of_small, of_tall) = (grown(&["--design", &small]), grown(&["--design", &tall]));
    assert!(10 < alive(&of_small) && alive(&of_small) < alive(&of_tall), "{of_small} {of_tall}");
    assert!(alive(&grown(&["--design", "chokkan"])) > 1000);
    // It grows on from its buds.
    assert!(alive(&grown(&["--design", &small, "--steps", "3"])) > alive(&of_small));
    // Chance falls otherwise for each of several seeds.
    let export = scratch.path("tree-{seed}.glb");
    let export = export.to_str().expect("it is a text");
    let finished = program::run(&["grow", "--design", &small, "--seeds", "3-4", "--export", export]);
    assert_eq!(finished.code, 0, "{}", finished.stderr);
    let tree = |seed: u32| fs::read(export.replace("{seed}", &seed.to_string())).expect("it is there");
    assert_ne!(tree(3), tree(4));
    // What is no design is refused, with its place.
    let wrong = file("wrong.json", &of(json!({ "height": { "own": 4000 } })));
    for (design, place) in [
        (wrong.as_str(), "nodes./.values.height"),
        (file("text.json", "oak").as_str(), "is no design"),
        ("nobody-has-this", "There is no template \"nobody-has-this\", and no file of that name."),
        ("chokann", "There is no template \"chokann\" (did you mean chokkan?), and no file of that name."),
    ] {
        let refused = program::run(&["grow", "--design", design]);
        assert_eq!(refused.code, 2, "{design}: {}", refused.stderr);
        assert!(refused.stderr.contains(place), "{design}: {}", refused.stderr);
    }
}

#[tokio::test]
async fn ds11_a_program_asks_for_the_design_and_puts_another_in_its_place() {
    let (mut client, server, _scratch) = Client::alone(&[]).await;
    let path = format!("/api/v1/sessions/{}/design", client.session);
    let put = |body: Value| -> Answer {
        http::send(server.port(), "PUT", &path, Some(&body)).expect("the server answers")
    };
    let get = || http::get(server.port(), &path).expect("the server answers");
    let height = |answer: &Answer| answer.json()["graph"]["nodes"]["/"]["values"]["height"]["own"].as_f64();
    let graph = |height: u32| json!({ "version": 1, "nodes": { "/": { "values": { "height": { "own": height } } } } });
    assert_eq!(get().status, 404);
    let refused = put(json!({ "graph": graph(20) }));
    assert_eq!(
        (refused.status, refused.json()["reason"].clone()),
        (404, json!("design-gone")),
        "{}",
        refused.text()
    );
    assert_eq!(put(json!({ "graph": graph(20), "position": [0, 0, 0] })).status, 204);
    let found = get();
    assert_eq!((found.status, height(&found)), (200, Some(20.0)));
    assert_eq!(found.json()["at"], json!([0.0, 0.0, 0.0]));
    // It takes the place of the one in force, is told to whoever looks on, and is undone like any other deed.
    assert_eq!(put(json!({ "graph": graph(30) })).status, 204);
    assert_eq!(height(&get()), Some(30.0));
    client.send(json!({ "kind": "undo" })).await;
    client.until_settled().await;
    assert_eq!(height(&get()), Some(20.0));
    let wrong = put(json!({ "graph": graph(4000) }));
    assert_eq!(wrong.status, 400);
    assert_eq!(wrong.json()["field"], json!("graph.nodes./.values.height.own"), "{}", wrong.text());
    assert_eq!(put(json!({})).status, 400);
    assert_eq!(height(&get()), Some(20.0), "nothing of it is done");
}
