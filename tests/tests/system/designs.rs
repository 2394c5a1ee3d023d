//! `espalier grow --design`: plants that are designed, without a server.

use std::fs;

use espalier_tests::{program, scratch::Scratch};
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
