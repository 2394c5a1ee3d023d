//! What others read and write in Python: the example client, written from the documents alone, and exports.

use std::{
    path::{Path, PathBuf},
    process::Command,
};

use espalier_tests::{program, scratch::Scratch, server::Server};

/// Runs a command to its end; what it printed.
fn run(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{command:?}: {printed}{}", String::from_utf8_lossy(&output.stderr));
    printed
}

/// Python with the packages that a folder of the repository asks for.
fn python(scratch: &Scratch, home: &Path) -> PathBuf {
    let place = scratch.path("python");
    run(Command::new("python3").args(["-m", "venv"]).arg(&place));
    let requirements = home.join("requirements.txt");
    run(Command::new(place.join("bin/pip")).args(["install", "--quiet", "-r"]).arg(requirements));
    place.join("bin/python")
}

fn folder(of: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(of)
}

#[test]
fn the_example_client_draws_saves_and_exports() {
    let scratch = Scratch::new();
    let home = folder("docs/client");
    let python = python(&scratch, &home);

    let server = Server::start(&scratch.path("trees.db"));
    let address = format!("http://127.0.0.1:{}", server.port());
    let printed = run(Command::new(python).arg(home.join("draw.py")).arg(address));
    let numbers: Vec<u32> = printed.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    let [frames, 1, glb, metamers] = numbers[..] else { panic!("{printed}") };
    assert!(frames > 100 && glb > 10_000 && metamers > 50, "{printed}");
}

#[test]
fn exports_open_in_other_programs() {
    let scratch = Scratch::new();
    let home = folder("tests/readers");
    let python = python(&scratch, &home);
    let grown = |species: &str, options: &[&str], name: &str| {
        let file = scratch.path(name);
        let grow = ["grow", "--species", species, "--export", file.to_str().expect("a plain path")];
        let grown = program::run(&[&grow[..], options].concat());
        assert_eq!(grown.code, 0, "{}", grown.stderr);
        file
    };

    // Closed and wound outwards, says trimesh.
    let mut files: Vec<PathBuf> = ["oak", "scots-pine", "weeping-willow", "baobab", "umbrella-acacia"]
        .map(|species| grown(species, &["--lod", "set"], &format!("{species}.glb")))
        .into();
    files.push(grown("cherry", &["--by-limb"], "limbs.glb"));
    let printed = run(Command::new(&python).arg(home.join("wood.py")).args(&files));
    assert!(printed.lines().count() > 4 * 5 + 5, "{printed}");

    // So is that of each species, with fewer sides.
    let listed = program::run(&["species", "--json"]);
    let listed: serde_json::Value = serde_json::from_str(&listed.stdout).expect("JSON");
    let slugs =
        listed.as_array().expect("a list").iter().map(|species| species["slug"].as_str().expect("a name"));
    let files: Vec<_> = slugs.map(|slug| grown(slug, &["--lod", "1"], &format!("{slug}.glb"))).collect();
    assert!(files.len() > 20);
    let printed = run(Command::new(&python).arg(home.join("wood.py")).args(&files));
    let is_told = |file: &&PathBuf| printed.contains(&format!("{}: ", file.display()));
    assert_eq!(files.iter().filter(is_told).count(), files.len(), "{printed}");
    // A hedge is several plants.
    assert!(printed.matches(" triangles of wood, ").count() >= files.len(), "{printed}");

    // A scene with materials, says usd-core.
    let scenes = [("usda", None), ("usdz", None), ("usda", Some("--instanced"))].map(|(ending, option)| {
        let name = format!("cherry{}.{ending}", option.unwrap_or_default());
        grown("cherry", &Vec::from_iter(option), &name)
    });
    let printed = run(Command::new(&python).arg(home.join("usd.py")).args(scenes));
    assert_eq!(printed.lines().count(), 3, "{printed}");
    assert!(!printed.lines().last().is_some_and(|last| last.contains(" 0 leaves as instances")), "{printed}");

    // Bones that sway in a loop, and vertices that go along with them, says UsdSkel.
    let swaying =
        [("usda", &["--by-limb"][..]), ("usdz", &["--lod", "set", "--hull"][..])].map(|(ending, more)| {
            grown("cherry", &[&["--sway", "64"], more].concat(), &format!("sways.{ending}"))
        });
    let printed = run(Command::new(&python).arg(home.join("usd.py")).args(swaying));
    let bones: Vec<&str> = printed.lines().filter(|line| line.contains(" bones, ")).collect();
    assert_eq!(bones.len(), 2, "{printed}");
    for line in bones {
        assert!((20..=64).contains(&before(line, " bones")), "{printed}");
        assert!(!line.contains(" 0.00 m"), "{printed}");
    }

    // As many triangles, of the same size, as in glTF, whatever the leaves.
    for species in ["scots-pine", "cherry", "maple"] {
        let file = |ending: &str| grown(species, &[], &format!("whole-{species}.{ending}"));
        let gltf = run(Command::new(&python).arg(home.join("wood.py")).arg(file("glb")));
        let usd = run(Command::new(&python).arg(home.join("usd.py")).arg(file("usdz")));
        let counts =
            [(&gltf, " triangles in all"), (&usd, " triangles")].map(|(said, what)| before(said, what));
        assert!(counts[0] > 1000 && counts[0] == counts[1], "{gltf}{usd}");
        let sizes = [&gltf, &usd].map(|said| said[said.rfind('[').expect("a size")..].split(']').next());
        assert_eq!(sizes[0], sizes[1], "{gltf}{usd}");
    }

    // Files of structure hold each metamer once.
    let files = ["ply", "csv", "mtg"].map(|ending| grown("oak", &[], &format!("oak.{ending}")));
    let printed = run(Command::new(&python).arg(home.join("structure.py")).args(files));
    let counts = [" metamers", " cylinders", " components"].map(|what| before(&printed, what));
    assert!(counts[0] > 2000 && counts.iter().all(|&count| count == counts[0]), "{printed}");
}

/// The number before the first of some words.
fn before(printed: &str, words: &str) -> u32 {
    let (head, _) = printed.split_once(words).unwrap_or_else(|| panic!("no{words}: {printed}"));
    let number = head.rsplit(' ').next().and_then(|number| number.parse().ok());
    number.unwrap_or_else(|| panic!("no number before{words}: {printed}"))
}

#[test]
fn the_server_keeps_to_rfc_6455_case_by_case() {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    let address = format!("http://127.0.0.1:{}", server.port());
    let script = folder("tests/conformance/websocket.py");
    let table = run(Command::new("python3").arg("-B").arg(script).arg(address));
    let kept: Vec<(&str, &str)> = table.lines().skip(2).filter_map(|row| row.rsplit_once(" | ")).collect();
    assert_eq!(kept.len(), 9, "{table}");
    for (row, good) in kept {
        assert!(row.ends_with(good.trim_end_matches(" |")), "{table}");
    }
}
