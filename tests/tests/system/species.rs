use std::{collections::BTreeSet, fs};

use espalier_proto::species::Species;
use espalier_tests::{client::Client, http, program, scratch::Scratch, server::Server};
use serde_json::{Value, json};

fn grown(options: &[&str]) -> Value {
    let finished = program::run(&[&["grow", "--stats", "json"], options].concat());
    assert_eq!(finished.code, 0, "{}", finished.stderr);
    serde_json::from_str(&finished.stdout).expect("one JSON object on standard output")
}

fn hash(options: &[&str]) -> Value {
    grown(options)["plant_hash"].clone()
}

#[test]
fn every_listed_species_can_be_grown() {
    let listed = program::run(&["species"]);
    assert_eq!(listed.code, 0, "{}", listed.stderr);
    let slugs: Vec<&str> = listed.stdout.lines().filter_map(|line| line.split(' ').next()).collect();
    assert!(slugs.len() >= 22, "{slugs:?}");
    let hashes: BTreeSet<String> =
        slugs.iter().map(|slug| hash(&["--species", slug]).as_str().expect("a hash").to_owned()).collect();
    assert_eq!(hashes.len(), slugs.len(), "no two species are the same tree");
}

#[test]
fn species_go_with_the_other_options_of_grow() {
    let plain = hash(&["--species", "birch"]);
    assert_eq!(hash(&["--species", "birch", "--threads", "1"]), plain);
    assert_ne!(hash(&["--species", "birch", "--seed", "2"]), plain);
    assert_ne!(hash(&["--species", "birch", "--parameter", "branching_angle=70"]), plain);
    let grown = grown(&["--species", "baobab", "--metamers", "3000"]);
    assert!(grown["metamers_alive"].as_u64().is_some_and(|n| n >= 3000), "{grown}");
    let unknown = program::run(&["grow", "--species", "triffid"]);
    assert_eq!(unknown.code, 2);
    assert!(unknown.stderr.contains("espalier species"), "{}", unknown.stderr);
}

#[test]
fn pictures_and_sheets_are_png_files() {
    let scratch = Scratch::new();
    let size = |name: &str, arguments: &[&str]| {
        let path = scratch.path(name);
        let finished = program::run(&[arguments, &[path.to_str().expect("a plain name")]].concat());
        assert_eq!(finished.code, 0, "{}", finished.stderr);
        let bytes = fs::read(&path).expect("the file was written");
        assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
        assert_eq!(&bytes[bytes.len() - 8..], b"IEND\xae\x42\x60\x82");
        let word = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().expect("four bytes"));
        (word(16), word(20))
    };
    assert_eq!(size("pine.png", &["grow", "--species", "bonsai-literati", "--export"]), (1000, 1000));
    let (width, height) = size("sheet.png", &["species", "--sheet"]);
    assert!(width > 1500 && height > 1000, "{width} by {height}");
}

#[tokio::test]
async fn pg5_a_picked_species_is_told_and_grows_up_as_on_the_command_line() {
    let scratch = Scratch::new();
    let server = Server::start(&scratch.path("trees.db"));
    let answer = http::send(server.port(), "GET", "/api/v1/species", None).expect("the server answers");
    assert_eq!(answer.status, 200);
    let all: Vec<Species> = serde_json::from_value(answer.json()).expect("a list of species");
    let willow = all.iter().find(|species| species.slug == "weeping-willow").expect("there is a willow");
    let session = server.new_session(7);
    let mut client = Client::connect(server.port(), &session, "browser-1").await;
    let programme = &willow.programme;
    client.send(json!({ "kind": "set_programme", "programme": programme })).await;
    client.until_settled().await;
    assert_eq!(client.parameters.setpoint_angle, 40.0, "a young willow");
    let until = programme.age;
    client.send(json!({ "kind": "grow", "steps": 1000, "until": until })).await;
    client.until_settled().await;
    assert_eq!(client.parameters.setpoint_angle, 180.0, "an old willow");
    assert_eq!(client.state.age, until.get());
    let grown = grown(&["--species", "weeping-willow", "--seed", "7"]);
    assert_eq!(grown["metamers_alive"], client.state.metamers);
    client.send(json!({ "kind": "set_parameters", "parameters": { "max_shoot_length": 3 } })).await;
    client.until_settled().await;
    let mut guest = Client::connect(server.port(), &session, "browser-2").await;
    guest.until("PG5: the programme", |guest| guest.programme.is_some()).await;
    assert_eq!(guest.programme, client.programme);
    assert_eq!(guest.programme, Some((programme.clone(), vec!["max_shoot_length".to_owned()])));
    client.send(json!({ "kind": "set_programme", "programme": null })).await;
    client.until_settled().await;
    assert_eq!((client.programme, client.parameters.max_shoot_length), (None, 3));
}
