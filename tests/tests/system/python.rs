//! The example client in Python does what it says, written from the documents alone.

use std::{path::Path, process::Command};

use espalier_tests::{scratch::Scratch, server::Server};

/// Runs a command to its end; what it printed.
fn run(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{command:?}: {printed}{}", String::from_utf8_lossy(&output.stderr));
    printed
}

#[test]
fn the_example_client_draws_saves_and_exports() {
    let scratch = Scratch::new();
    let home = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/client");
    let place = scratch.path("python");
    run(Command::new("python3").args(["-m", "venv"]).arg(&place));
    let requirements = home.join("requirements.txt");
    run(Command::new(place.join("bin/pip")).args(["install", "--quiet", "-r"]).arg(requirements));

    let server = Server::start(&scratch.path("trees.db"));
    let address = format!("http://127.0.0.1:{}", server.port());
    let printed = run(Command::new(place.join("bin/python")).arg(home.join("draw.py")).arg(address));
    let numbers: Vec<u32> = printed.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    let [frames, 1, glb, metamers] = numbers[..] else { panic!("{printed}") };
    assert!(frames > 100 && glb > 10_000 && metamers > 50, "{printed}");
}
