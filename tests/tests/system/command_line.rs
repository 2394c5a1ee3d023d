use std::fs;

use espalier_tests::{program, scratch::Scratch, server::Server, strokes::upward};
use serde_json::{Value, json};

const PHASES: [&str; 7] = ["space", "light", "vigor", "growth", "shedding", "girth", "delta"];

/// Checks a binary glTF file's frame, and that its accessors lie inside its buffer; returns its JSON.
pub fn is_gltf(bytes: &[u8]) -> Value {
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes")) as usize;
    assert_eq!(&bytes[..4], b"glTF");
    assert_eq!((word(4), word(8)), (2, bytes.len()), "version and length");
    let json_length = word(12);
    assert_eq!(&bytes[16..20], b"JSON");
    let json: Value = serde_json::from_slice(&bytes[20..20 + json_length]).expect("the first chunk is JSON");
    let binary = 20 + json_length;
    assert_eq!(&bytes[binary + 4..binary + 8], b"BIN\0");
    let buffer = word(binary);
    assert_eq!(binary + 8 + buffer, bytes.len());
    assert_eq!(json["asset"]["version"], json!("2.0"));
    let list = |name: &str| json[name].as_array().cloned().unwrap_or_default();
    let number = |value: &Value| value.as_u64().unwrap_or(0) as usize;
    let views = list("bufferViews");
    for view in &views {
        assert!(number(&view["byteOffset"]) + number(&view["byteLength"]) <= buffer, "{view}");
    }
    for accessor in list("accessors") {
        let size = match accessor["componentType"].as_u64() {
            Some(5120 | 5121) => 1,
            Some(5122 | 5123) => 2,
            Some(5125 | 5126) => 4,
            other => panic!("component type {other:?}"),
        };
        let parts = match accessor["type"].as_str() {
            Some("SCALAR") => 1,
            Some("VEC2") => 2,
            Some("VEC3") => 3,
            Some("VEC4") => 4,
            other => panic!("type {other:?}"),
        };
        let view = &views[number(&accessor["bufferView"])];
        let stride = view["byteStride"].as_u64().map_or(size * parts, |stride| stride as usize);
        let count = number(&accessor["count"]);
        assert!(count > 0, "{accessor}");
        let end = number(&accessor["byteOffset"]) + stride * (count - 1) + size * parts;
        assert!(end <= number(&view["byteLength"]), "{accessor}");
    }
    assert!(!list("meshes").is_empty());
    json
}

fn script(scratch: &Scratch, name: &str, commands: &[Value]) -> String {
    let lines: Vec<String> =
        commands.iter().map(|command| serde_json::to_string(command).expect("a command is JSON")).collect();
    let path = scratch.path(name);
    fs::write(&path, lines.join("\n") + "\n").expect("the scratch folder can be written");
    path.to_str().expect("a plain name").to_owned()
}

fn tree() -> Vec<Value> {
    let mut commands = upward(1, 10.0, 2.5);
    commands.push(json!({ "kind": "grow", "steps": 3 }));
    commands
}

fn stats(arguments: &[&str]) -> Value {
    let finished = program::run(arguments);
    assert_eq!(finished.code, 0, "{}", finished.stderr);
    serde_json::from_str(&finished.stdout)
        .unwrap_or_else(|error| panic!("one JSON object on standard output: {error}: {}", finished.stdout))
}

/// What must not differ from run to run.
fn outcome(stats: &Value) -> Value {
    let keys = ["metamers_alive", "metamers_grown", "axes", "leaves", "steps", "delta_bytes", "plant_hash"];
    keys.map(|key| stats[key].clone()).to_vec().into()
}

#[test]
fn stats_are_one_object_with_all_its_keys() {
    let scratch = Scratch::new();
    let script = script(&scratch, "tree.jsonl", &tree());
    let out = scratch.path("tree.json");
    let out = out.to_str().expect("a plain name");
    for stats in [
        stats(&["replay", &script, "--export", out, "--stats", "json"]),
        stats(&["grow", "--metamers", "500", "--seed", "3", "--stats", "json"]),
    ] {
        for key in [
            "metamers_alive",
            "metamers_grown",
            "axes",
            "leaves",
            "steps",
            "delta_bytes",
            "join_bytes",
            "peak_memory_bytes",
            "tree_memory_bytes",
        ] {
            assert!(stats[key].as_u64().is_some_and(|n| n > 0), "{key} in {stats}");
        }
        for key in ["seconds_total", "seconds_last_step", "bytes_per_metamer"] {
            assert!(stats[key].as_f64().is_some_and(|n| n >= 0.0), "{key} in {stats}");
        }
        for phase in PHASES {
            assert!(stats["seconds"][phase].as_f64().is_some_and(|n| n >= 0.0), "{phase} in {stats}");
        }
        assert!(stats["metamers_grown"].as_u64() >= stats["metamers_alive"].as_u64());
        assert!(stats["plant_hash"].as_str().is_some_and(|hash| hash.len() >= 16), "{stats}");
    }
}

#[test]
fn grow_reaches_the_number_asked_for() {
    let stats = stats(&["grow", "--metamers", "2000", "--seed", "3", "--stats", "json"]);
    assert!(stats["metamers_alive"].as_u64().is_some_and(|n| n >= 2000), "{stats}");
}

#[test]
fn parameters_and_budget_are_options() {
    let hash = |options: &[&str]| {
        let arguments = [&["grow", "--metamers", "300", "--stats", "json"], options].concat();
        stats(&arguments)["plant_hash"].clone()
    };
    let plain = hash(&[]);
    assert_eq!(hash(&["--budget", "100000"]), plain);
    assert_ne!(hash(&["--parameter", "branching_angle=80"]), plain);
    // Two of the three weights alone do not sum to 1 with the third; all together they do.
    let weights = ["--parameter", "heading_weight=0.4", "--parameter", "tropism_weight=0.35"];
    assert_ne!(hash(&weights), plain);
    for (options, code, words) in [
        (&["--budget", "200"][..], 1, "stopped growing"),
        (&["--parameter", "heading_weight=0.4"], 2, "heading_weight"),
        (&["--parameter", "apical_control=2"], 2, "0.4 to 0.7"),
        (&["--parameter", "sap=1"], 2, "sap"),
    ] {
        let finished = program::run(&[&["grow", "--metamers", "300"], options].concat());
        assert_eq!(finished.code, code, "{options:?}: {}", finished.stderr);
        assert!(finished.stderr.contains(words), "{options:?}: {}", finished.stderr);
    }
}

#[test]
fn replay_does_lassos_and_obstacles() {
    let scratch = Scratch::new();
    let path = scratch.path("swan.jsonl");
    let lines = [
        r#"{"kind":"place_obstacle","obstacle":{"shape":{"kind":"sphere","radius":2},"pose":{"position":[5,9,0]}}}"#,
        r#"{"kind":"lasso","outline":[[-8,0],[8,0],[8,16],[-8,16]],"plane":{"origin":[0,0,0],"right":[1,0,0],"up":[0,1,0]}}"#,
        r#"{"kind":"stop"}"#,
        r#"{"kind":"grow","steps":2,"bud":3}"#,
    ];
    fs::write(&path, lines.join("\n")).expect("the scratch folder can be written");
    let path = path.to_str().expect("a plain name");
    let first = stats(&["replay", path, "--stats", "json"]);
    assert!(first["metamers_alive"].as_u64().is_some_and(|n| n > 100), "{first}");
    assert_eq!(outcome(&first), outcome(&stats(&["replay", path, "--stats", "json", "--threads", "1"])));
}

#[test]
fn replay_derives_grammars_as_grow_does() {
    let scratch = Scratch::new();
    let text = "slider: a 10 60\na = 30\naxiom: A\nA --> F(1+ran(1))[+(a)A]/(90)A\n";
    let (grammar, path) = (scratch.path("own.lsys"), scratch.path("own.jsonl"));
    fs::write(&grammar, text).expect("the scratch folder can be written");
    let planted = serde_json::json!({ "kind": "set_grammar", "text": text, "depth": 3 }).to_string();
    let write = |lines: &[&str]| fs::write(&path, lines.join("\n")).expect("it can be written");
    let replay = || stats(&["replay", path.to_str().expect("a plain name"), "--stats", "json"]);
    write(&[&planted, r#"{"kind":"derive","steps":3}"#]);
    let replayed = replay();
    let grammar = grammar.to_str().expect("a plain name");
    let grown = stats(&["grow", "--grammar", grammar, "--depth", "6", "--stats", "json"]);
    assert_eq!(replayed["plant_hash"], grown["plant_hash"]);
    assert_eq!(replayed["metamers_alive"], grown["metamers_alive"]);
    // With sliders, hands and undo between depths: whatever was taken back leaves nothing.
    write(&[
        &planted,
        r#"{"kind":"set_grammar_values","values":[{"name":"a","value":50}]}"#,
        r#"{"kind":"prune","rows":[5]}"#,
        r#"{"kind":"undo"}"#,
        r#"{"kind":"undo"}"#,
        r#"{"kind":"derive","steps":3}"#,
    ]);
    assert_eq!(replay()["plant_hash"], grown["plant_hash"]);
}

#[test]
fn a_grammar_that_is_none_is_told_from_one_that_ends() {
    let scratch = Scratch::new();
    let path = scratch.path("own.lsys");
    let bomb = "axiom: A\nA --> FAAAAAAAAAAAAAAAA\n";
    for (text, code, said) in [("axiom: A\nA --> F[+A\n", 2, "line 2, column 8"), (bomb, 1, "of 12")] {
        fs::write(&path, text).expect("it can be written");
        let path = path.to_str().expect("a plain name");
        let finished = program::run(&["grow", "--grammar", path, "--depth", "12"]);
        assert_eq!(finished.code, code, "{text}: {}", finished.stderr);
        assert!(finished.stderr.contains(said), "{text}: {}", finished.stderr);
    }
}

#[test]
fn what_is_to_be_known_of_a_grammar_is_noted_on_stderr() {
    let scratch = Scratch::new();
    let path = scratch.path("own.lsys");
    fs::write(&path, "axiom: A\nderivation length: 60\nA --> F(0.1)[+(30)F(0.1)F(0.1)F(0.1)@o]A\n")
        .expect("it can be written");
    let path = path.to_str().expect("a plain name");
    let finished = program::run(&["grow", "--grammar", path, "--seeds", "1-2", "--stats", "json"]);
    assert_eq!(finished.code, 0, "{}", finished.stderr);
    let notes: Vec<&str> = finished.stderr.lines().filter(|line| line.starts_with("Note: ")).collect();
    assert_eq!(notes.len(), 2, "each is said once: {}", finished.stderr);
    assert!(notes[0].contains("own.lsys: line 3, column") && notes[0].contains("@o"), "{}", notes[0]);
    assert!(notes[1].contains("scale: 10"), "{}", notes[1]);
}

#[test]
fn a_grammar_is_given_a_space_and_obstacles() {
    let scratch = Scratch::new();
    let written = |name: &str, text: &str| {
        let path = scratch.path(name);
        fs::write(&path, text).expect("it can be written");
        path.to_str().expect("a plain name").to_owned()
    };
    let grammar = written(
        "own.lsys",
        "axiom: A\nderivation length: 9\nA : inside(0) && !inside(1) --> F[&(50)A]/(137.5)A\nA : !inside(0) || inside(1) --> %\n",
    );
    let space = written(
        "space.json",
        r#"{"outline": [[-3, -1], [3, -1], [3, 5], [-3, 5]], "plane": {"origin": [0, 0, 0], "right": [1, 0, 0], "up": [0, 1, 0]}}"#,
    );
    let wall = written(
        "wall.json",
        r#"{"shape": {"kind": "box", "size": [2, 30, 30]}, "pose": {"position": [2, 0, 0]}}"#,
    );
    let model = written(
        "wall.obj",
        "v 1 -9 -9\nv 1 9 -9\nv 1 9 9\nv 1 -9 9\nv 3 0 0\nf 1 2 3\nf 1 3 4\nf 2 1 5\nf 3 2 5\nf 4 3 5\nf 1 4 5\n",
    );
    let alive = |more: &[&str]| {
        let arguments = [&["grow", "--grammar", &*grammar, "--stats", "json"], more].concat();
        stats(&arguments)["metamers_alive"].as_u64().expect("a number")
    };
    let free = alive(&[]);
    let within = alive(&["--space", &space]);
    let beside = alive(&["--obstacle", &wall]);
    let both = alive(&["--space", &space, "--obstacle", &wall]);
    assert!(within < free && beside < free && both < within.min(beside), "{free} {within} {beside} {both}");
    let metres = ["--parameter", "internode_length=1", "--obstacle", &model];
    assert!(alive(&metres) < free, "a model stands in the way as well");
    // Trees that no grammar writes grow around it, too.
    let grown = |more: &[&str]| stats(&[&["grow", "--steps", "12", "--stats", "json"], more].concat());
    assert_ne!(outcome(&grown(&[])), outcome(&grown(&["--obstacle", &wall])));
    for (options, named) in [
        (["--space", &*wall], "wall.json is no space of a grammar"),
        (["--obstacle", &*space], "space.json is no obstacle"),
        (["--obstacle", &*grammar], "own.lsys is no obstacle"),
    ] {
        let finished = program::run(&[&["grow", "--grammar", &*grammar], &options[..]].concat());
        assert_eq!(finished.code, 2, "{}", finished.stderr);
        assert!(finished.stderr.contains(named), "{}", finished.stderr);
    }
}

#[test]
fn a_folder_that_is_missing_is_named_before_anything_grows() {
    let scratch = Scratch::new();
    let folder = scratch.path("none");
    let out = folder.join("tree.glb");
    let [folder, out] = [&folder, &out].map(|path| path.to_str().expect("a plain name"));
    let finished = program::run(&["grow", "--metamers", "50", "--export", out]);
    assert_eq!(finished.code, 1, "{}", finished.stderr);
    let said = format!("The export {out} cannot be written: there is no folder {folder}.");
    assert!(finished.stderr.contains(&said), "{}", finished.stderr);
}

#[test]
fn what_a_grammar_writes_leaves_in_every_format_and_sways() {
    let scratch = Scratch::new();
    let path = scratch.path("own.lsys");
    let text = "axiom: A\nA --> F[+(30)FA][-(30)FA]/(90)FA\n";
    fs::write(&path, text).expect("it can be written");
    let path = path.to_str().expect("a plain name");
    for ending in ["glb", "usda", "usda.zip", "obj.zip", "pivots.zip", "mtg", "ply", "joints.csv", "png"] {
        let out = scratch.path(&format!("tree.{ending}"));
        let file = out.to_str().expect("a plain name");
        let finished = program::run(&["grow", "--grammar", path, "--depth", "5", "--export", file]);
        assert_eq!(finished.code, 0, "{ending}: {}", finished.stderr);
        let bytes = fs::metadata(&out).expect("the file was written").len();
        assert!(bytes > 500, "{ending}: {bytes} bytes");
    }
    // A joint for each limb, so that all of them move.
    let joints = fs::read_to_string(scratch.path("tree.joints.csv")).expect("it is text");
    assert!(joints.lines().count() > 40, "{joints}");
}

#[test]
fn the_plant_is_the_same_on_any_number_of_threads() {
    let scratch = Scratch::new();
    let script = script(&scratch, "tree.jsonl", &tree());
    let grow = |threads: &str| {
        outcome(&stats(&[
            "grow",
            "--metamers",
            "3000",
            "--seed",
            "3",
            "--stats",
            "json",
            "--threads",
            threads,
        ]))
    };
    let replay =
        |threads: &str| outcome(&stats(&["replay", &script, "--stats", "json", "--threads", threads]));
    let (grown, replayed) = (grow("1"), replay("1"));
    for threads in ["1", "2", "8"] {
        assert_eq!(grow(threads), grown, "{threads} threads");
        assert_eq!(replay(threads), replayed, "{threads} threads");
    }
    let other = stats(&["grow", "--metamers", "3000", "--seed", "4", "--stats", "json"]);
    assert_ne!(outcome(&other), grown, "another seed is another tree");
}

#[test]
fn replay_writes_gltf_with_the_trees_triangles() {
    let scratch = Scratch::new();
    let script = script(&scratch, "tree.jsonl", &tree());
    let out = scratch.path("tree.glb");
    let finished = program::run(&["replay", &script, "--export", out.to_str().expect("a plain name")]);
    assert_eq!(finished.code, 0, "{}", finished.stderr);
    let json = is_gltf(&fs::read(&out).expect("the file was written"));
    let indices = &json["meshes"][0]["primitives"][0]["indices"];
    let accessor = &json["accessors"][indices.as_u64().expect("the mesh is indexed") as usize];
    let count = accessor["count"].as_u64().expect("an accessor counts");
    assert!(count > 500 && count.is_multiple_of(3), "{count} indices");
}

#[test]
fn replay_writes_the_skeleton_as_json() {
    let scratch = Scratch::new();
    let script = script(&scratch, "tree.jsonl", &tree());
    let out = scratch.path("tree.json");
    let stats =
        stats(&["replay", &script, "--export", out.to_str().expect("a plain name"), "--stats", "json"]);
    let json: Value =
        serde_json::from_slice(&fs::read(&out).expect("the file was written")).expect("it is JSON");
    let metamers = json["metamers"].as_array().expect("the skeleton lists its metamers");
    // The seed is in the list, and is no metamer.
    assert_eq!(metamers.len() as u64, stats["metamers_alive"].as_u64().expect("a number") + 1);
    for (i, metamer) in metamers.iter().enumerate() {
        for key in ["parent", "axis", "position", "normal", "radius", "birth"] {
            assert!(metamer.get(key).is_some(), "{key} in {metamer}");
        }
        assert_eq!(metamer["position"].as_array().map(Vec::len), Some(3));
        if let Some(parent) = metamer["parent"].as_u64() {
            assert!((parent as usize) < i, "metamer {i} follows its parent {parent}");
        }
    }
}

#[test]
fn a_broken_line_is_named_and_nothing_is_written() {
    let scratch = Scratch::new();
    let good = serde_json::to_string(&json!({ "kind": "grow", "steps": 1 })).expect("a command is JSON");
    for (bad, word) in [
        ("{\"kind\":\"grow\",\"steps\":", ""),
        ("{\"kind\":\"fell\"}", "fell"),
        ("{\"kind\":\"grow\",\"steps\":100000}", "1 to 1000"),
        ("{\"kind\":\"stroke_move\",\"stroke\":1,\"samples\":[{\"position\":[0,NaN,0],\"radius\":1}]}", ""),
        ("{\"kind\":\"set_parameters\",\"parameters\":{\"apical_control\":2}}", "apical_control"),
        ("{\"kind\":\"undo\"} trailing", ""),
    ] {
        let path = scratch.path("broken.jsonl");
        fs::write(&path, format!("{good}\n\n{bad}\n{good}\n")).expect("the scratch folder can be written");
        let out = scratch.path("tree.glb");
        let (path, name) = (path.to_str().expect("a plain name"), out.to_str().expect("a plain name"));
        let finished = program::run(&["replay", path, "--export", name, "--stats", "json"]);
        assert_eq!(finished.code, 2, "{bad}: {}", finished.stderr);
        assert!(finished.stderr.contains("line 3"), "{bad}: {}", finished.stderr);
        assert!(finished.stderr.contains(word), "{bad}: {}", finished.stderr);
        assert!(finished.stdout.is_empty(), "{bad}: {}", finished.stdout);
        assert!(!out.exists(), "{bad}: a file was written all the same");
    }
}

#[test]
fn many_seeds_are_many_files() {
    let scratch = Scratch::new();
    let name = scratch.path("tree-{seed}.json");
    let name = name.to_str().expect("a plain name");
    let finished =
        program::run(&["grow", "--metamers", "50", "--seeds", "3-5", "--export", name, "--stats", "json"]);
    assert_eq!(finished.code, 0, "{}", finished.stderr);
    assert_eq!(finished.stdout.lines().count(), 3, "figures of each");
    let files = [3, 4, 5].map(|seed| fs::read(scratch.path(&format!("tree-{seed}.json"))).expect("a file"));
    assert!(files[0] != files[1] && files[1] != files[2]);
    let alone = scratch.path("alone.json");
    let alone = alone.to_str().expect("a plain name");
    program::run(&["grow", "--metamers", "50", "--seed", "4", "--export", alone]);
    assert!(fs::read(alone).expect("a file") == files[1], "the same tree as by its seed alone");
}

#[test]
fn an_export_to_standard_output_leaves_it_to_the_file() {
    let grown =
        program::run(&["grow", "--steps", "4", "--export", "-", "--format", "mtg", "--stats", "json"]);
    assert_eq!(grown.code, 0, "{}", grown.stderr);
    assert!(grown.stdout.starts_with("CODE"), "{}", grown.stdout);
    assert!(grown.stderr.contains("\"metamers_alive\""), "{}", grown.stderr);
    let several =
        program::run(&["grow", "--steps", "1", "--seeds", "1-2", "--export", "-", "--format", "mtg"]);
    assert!(several.code == 2 && several.stderr.contains("{seed}"), "{}", several.stderr);
}

#[test]
fn species_are_told_as_json() {
    let finished = program::run(&["species", "--json"]);
    let all: Vec<Value> = serde_json::from_str(&finished.stdout).expect("JSON");
    assert_eq!(all.len(), program::run(&["species"]).stdout.lines().count());
    assert!(all.iter().all(|species| species["programme"]["age"].as_u64() > Some(0)));
}

#[test]
fn a_reader_that_has_seen_enough_is_no_error() {
    let scratch = Scratch::new();
    let database = scratch.path("trees.db");
    assert!(Server::start(&database).terminate().success());
    let database = database.to_str().expect("a plain name");
    for arguments in [
        &["completions", "bash"][..],
        &["species"],
        &["species", "--json"],
        &["library", "ls", "--database", database],
        &["grow", "--metamers", "20"],
        &["grow", "--metamers", "20", "--export", "-", "--format", "json"],
    ] {
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let ended = program::command().args(arguments).stdout(writer).output().expect("the program starts");
        let said = String::from_utf8_lossy(&ended.stderr);
        assert!(ended.status.success(), "{arguments:?}: {said}");
        assert!(!said.contains("panicked") && !said.contains("roken pipe"), "{arguments:?}: {said}");
    }
}

#[test]
fn a_tree_that_is_larger_than_was_asked_for_is_told() {
    let finished = program::run(&["grow", "--steps", "8", "--metamers", "3"]);
    assert_eq!(finished.code, 0, "{}", finished.stderr);
    assert!(finished.stderr.contains("so that --metamers 3 changes nothing."), "{}", finished.stderr);
    let finished = program::run(&["grow", "--steps", "2", "--metamers", "300"]);
    assert_eq!((finished.code, finished.stderr.as_str()), (0, ""));
}

#[test]
fn shells_and_the_manual_know_every_command() {
    let scratch = Scratch::new();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let finished = program::run(&["completions", shell]);
        assert!(
            finished.code == 0
                && finished.stdout.contains("scots-pine") | finished.stdout.contains("metamers")
        );
    }
    let folder = scratch.path("man");
    let finished = program::run(&["man", folder.to_str().expect("a plain name")]);
    assert_eq!(finished.code, 0, "{}", finished.stderr);
    for page in ["espalier.1", "espalier-serve.1", "espalier-grow.1", "espalier-backup.1"] {
        let text = fs::read_to_string(folder.join(page)).unwrap_or_else(|error| panic!("{page}: {error}"));
        assert!(text.contains(".SH NAME"), "{page}");
    }
}

#[test]
fn wrong_arguments_are_refused_with_a_sentence() {
    let scratch = Scratch::new();
    let script = script(&scratch, "tree.jsonl", &tree());
    let odd = scratch.path("tree.dwg");
    let odd = odd.to_str().expect("a plain name");
    for arguments in [
        vec!["replay", &script, "--export", odd],
        vec!["replay", "/nowhere/tree.jsonl"],
        vec!["grow", "--metamers", "0"],
        vec!["grow", "--metamers", "many"],
        vec!["replay", &script, "--export", "/nowhere/tree.glb"],
        vec!["grow", "--metamers", "50", "--seeds", "1-2", "--export", "same.glb"],
        vec!["prune"],
    ] {
        let finished = program::run(&arguments);
        assert_ne!(finished.code, 0, "{arguments:?}");
        assert!(finished.code == 1 || finished.code == 2, "{arguments:?}: {}", finished.code);
        assert!(finished.stderr.len() > 10 && !finished.stderr.contains("panicked"), "{}", finished.stderr);
    }
}
