//! The driver that measures a server, against a server.

use espalier_tests::{program, scratch::Scratch, server::Server};

/// Runs it for a second, and gives the table.
fn measured(server: &Server, arguments: &[&str]) -> String {
    measured_for(server, arguments, 1)
}

/// Runs it for longer and longer, as a busy machine may need, until all these delays were measured.
fn measured_until(server: &Server, arguments: &[&str], rows: &[&str]) -> String {
    let is_whole = |table: &String| rows.iter().all(|row| count(table, row) > 0);
    let table = [1, 4, 16].into_iter().map(|seconds| measured_for(server, arguments, seconds)).find(is_whole);
    table.unwrap_or_else(|| panic!("{arguments:?}: some of {rows:?} was never measured"))
}

fn measured_for(server: &Server, arguments: &[&str], seconds: u32) -> String {
    let url = format!("http://127.0.0.1:{}", server.port());
    let output = program::command()
        .arg("load")
        .args(arguments)
        .args(["--url", &url, "--seconds", &seconds.to_string()])
        .output()
        .expect("the program runs");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {said}");
    String::from_utf8(output.stdout).expect("the table is text")
}

/// How often a row of delays was measured.
fn count(table: &str, row: &str) -> usize {
    let line = table.lines().find(|line| line.starts_with(&format!("| {row} ")));
    let line = line.unwrap_or_else(|| panic!("there is no {row:?} in\n{table}"));
    line.trim_end_matches(" |").rsplit(' ').next().and_then(|count| count.parse().ok()).expect("a count")
}

#[test]
fn the_driver_measures_every_scenario() {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    for scenario in ["drawing", "all-draw"] {
        let rows = ["part of a stroke to its frame", "command to its acknowledgement"];
        let table = measured_until(&server, &[scenario, "--sessions", "3", "--metamers", "50"], &rows);
        assert!(table.contains("| sockets | 6 |"), "{table}");
    }
    let few = ["--people", "2", "--beside", "1", "--metamers", "50"];
    let growers = [&["growers"], &few[..]].concat();
    measured_until(&server, &growers, &["part of a stroke to its frame, beside 1 growing"]);
    let restores = [&["restores", "--large", "300"], &few[..]].concat();
    measured_until(&server, &restores, &["a large tree opened, to its welcome"]);
    let table = measured(&server, &["idle", "--sockets", "20"]);
    assert!(table.contains("| sockets | 20 |"), "{table}");
    let table = measured(&server, &["malformed", "--connections", "12"]);
    assert_eq!(count(&table, "a connection, until it is answered or given up"), 12);
}

#[test]
fn the_driver_says_where_nobody_answers() {
    let output = program::command()
        .args(["load", "idle", "--url", "http://127.0.0.1:1"])
        .output()
        .expect("the program runs");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && said.starts_with("The server does not answer"), "{said}");
}
