//! `AP`: looks of a session, told to all of its clients.

use espalier_proto::ServerMessage;
use espalier_settings::{Appearance, AppearancePatch, Background, LeafLook, Sky};
use serde_json::{Value, json};

use crate::world::{Peer, World, grow};

fn leaves(season: f32, gesture: Option<u32>) -> Value {
    let leaves = LeafLook { season, ..Appearance::default().leaves };
    let appearance = AppearancePatch { leaves: Some(leaves.into()), ..AppearancePatch::default() };
    json!({ "kind": "set_appearance", "appearance": appearance, "gesture": gesture })
}

fn background(sky: Sky) -> Value {
    let background = Background { sky, ..Appearance::default().background };
    let appearance = AppearancePatch { background: Some(background.into()), ..AppearancePatch::default() };
    json!({ "kind": "set_appearance", "appearance": appearance })
}

/// The seasons a client was told, in order.
fn seasons(peer: &Peer) -> Vec<f32> {
    let season = |text: &ServerMessage| match text {
        ServerMessage::Appearance { appearance, .. } => Some(appearance.leaves.season),
        _ => None,
    };
    peer.texts.iter().filter_map(season).collect()
}

#[test]
fn ap3_looks_follow_each_welcome_and_change() {
    let mut world = World::new();
    let birch = world.join("birch-01");
    let maple = world.join("maple-01");
    assert!(matches!(
        world.peer(maple).texts[..2],
        [ServerMessage::Welcome { .. }, ServerMessage::Appearance { .. }]
    ));
    world.command(birch, 1, leaves(2.0, None));
    world.settle();
    world.command(maple, 1, background(Sky::Studio));
    world.settle();
    world.command(maple, 2, json!({ "kind": "undo" }));
    world.settle();
    world.command(maple, 3, json!({ "kind": "undo" }));
    world.settle();
    for client in [birch, maple] {
        assert_eq!(seasons(world.peer(client)), [1.0, 2.0, 2.0, 2.0, 1.0]);
    }
    assert_eq!(world.document().hash(), world.replayed_hash());
}

#[test]
fn ap1_looks_that_are_refused_are_not_journaled() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, leaves(3.5, None));
    world.command(client, 2, leaves(f32::INFINITY, None));
    world.settle();
    let refused = world.peer(client).refused();
    assert_eq!(refused.iter().map(|(id, _)| *id).collect::<Vec<_>>(), [1, 2]);
    for (_, problem) in refused {
        assert_eq!(problem.field.as_deref(), Some("appearance.leaves.season"));
        assert_eq!(problem.allowed.as_deref(), Some("0 to 3"));
    }
    assert!(world.disk.is_empty());
    assert_eq!(seasons(world.peer(client)), [1.0]);
}

#[test]
fn looks_survive_journal_snapshot_and_undo() {
    let mut world = World::new();
    let client = world.join("birch-01");
    world.command(client, 1, grow(3));
    world.command(client, 2, leaves(2.0, Some(1)));
    world.command(client, 3, leaves(2.5, Some(1)));
    world.settle();
    world.crash();
    assert_eq!(world.document().appearance().leaves.season, 2.5, "from the journal alone");
    world.join("maple-01");
    world.pass(40_000);
    assert!(world.snapshots > 0);
    world.crash();
    assert_eq!(world.document().hash(), world.replayed_hash());
    let client = world.join("birch-01");
    assert_eq!(seasons(world.peer(client)), [2.5]);
    world.command(client, 4, json!({ "kind": "undo" }));
    world.settle();
    assert_eq!(seasons(world.peer(client)), [2.5, 1.0], "AP2: a drag is one operation");
    assert_eq!(world.document().figures().step, 3);
}

fn wind(fields: Value) -> Value {
    json!({ "kind": "set_appearance", "appearance": { "wind": fields } })
}

#[test]
fn wd1_all_see_one_wind_and_it_moves_no_row() {
    let mut world = World::new();
    let [birch, maple] = ["birch-01", "maple-01"].map(|name| world.join(name));
    world.command(birch, 1, grow(5));
    world.settle();
    let (rows, deltas) = (world.document().plant().metamer_count(), world.peer(maple).frames.len());
    let step = world.document().figures().step;
    world.command(birch, 2, wind(json!({ "speed": 8.0, "direction": 90.0 })));
    world.command(maple, 1, wind(json!({ "snow": 0.2 })));
    world.settle();
    let told = |client| {
        let looks = world.peer(client).texts.iter().rev().find_map(|text| match text {
            ServerMessage::Appearance { appearance, .. } => Some(appearance.wind),
            _ => None,
        });
        looks.expect("looks are told")
    };
    let both = told(birch);
    assert_eq!(
        (both.speed, both.direction, both.snow),
        (8.0, 90.0, 0.2),
        "two who set it do not undo each other"
    );
    assert_eq!(told(maple), both);
    assert_eq!(world.document().plant().metamer_count(), rows);
    assert_eq!(world.document().figures().step, step);
    assert_eq!(world.peer(maple).frames.len(), deltas, "nothing is drawn anew");
    let late = world.join("cedar-01");
    world.settle();
    assert!(
        world.peer(late).texts.iter().any(
            |text| matches!(text, ServerMessage::Appearance { appearance, .. } if appearance.wind == both)
        )
    );
    assert_eq!(world.document().hash(), world.replayed_hash());
}

#[test]
fn wd1_growth_is_the_same_in_any_wind() {
    let grown = |weather: Option<Value>| {
        let mut world = World::new();
        let client = world.join("birch-01");
        let commands = [Some(grow(4)), weather.map(wind), Some(grow(4))];
        for (id, command) in (1..).zip(commands.into_iter().flatten()) {
            world.command(client, id, command);
        }
        world.settle();
        let plant = world.document().plant();
        (plant.metamer_count(), plant.hash())
    };
    let storm =
        json!({ "speed": 25.0, "turbulence": 1.0, "rise": -10.0, "snow": 0.5, "rain": 1.0, "sag": 1.0 });
    assert_eq!(grown(None), grown(Some(storm)));
}

#[test]
fn wd1_a_wind_that_cannot_be_is_refused_with_its_field() {
    let mut world = World::new();
    let client = world.join("birch-01");
    for (id, (field, value)) in (1..).zip([
        ("speed", json!(1e9)),
        ("speed", json!(-1.0)),
        ("rise", json!(11.0)),
        ("suppleness", json!(0.0)),
        ("snow", json!(0.6)),
    ]) {
        world.command(client, id, wind(json!({ field: value })));
        world.settle();
        let refused = world.peer(client).refused();
        let (last, problem) = refused.last().expect("it is refused");
        assert_eq!((*last, problem.field.clone()), (id, Some(format!("appearance.wind.{field}"))));
    }
    assert_eq!(world.document().appearance().wind, Appearance::default().wind);
    assert!(world.disk.is_empty());
}

#[test]
fn wd2_a_pong_tells_the_time() {
    let mut world = World::new();
    let client = world.join("birch-01");
    for (nonce, wait) in [(1, 500), (2, 12_000)] {
        world.pass(wait);
        world.send(client, &espalier_proto::ClientMessage::Ping { nonce });
        assert_eq!(world.peer(client).texts.last(), Some(&ServerMessage::Pong { nonce, at: world.now }));
    }
}

#[test]
fn wd3_looks_tell_since_when_their_wind_blows() {
    let mut world = World::new();
    let [birch, maple] = ["birch-01", "maple-01"].map(|name| world.join(name));
    let told = |world: &World, client| {
        let since = world.peer(client).texts.iter().rev().find_map(|text| match text {
            ServerMessage::Appearance { wind_since, .. } => Some(*wind_since),
            _ => None,
        });
        since.expect("looks are told")
    };
    assert_eq!(told(&world, birch), 0, "a wind that has always blown");
    world.pass(7_000);
    world.command(birch, 1, wind(json!({ "speed": 8.0 })));
    world.settle();
    let changed = told(&world, birch);
    assert!(changed >= 7_000 && changed <= world.now, "told {changed} at {}", world.now);
    assert_eq!(told(&world, maple), changed);
    world.pass(3_000);
    world.command(maple, 1, leaves(2.0, None));
    world.settle();
    assert_eq!(told(&world, birch), changed, "other looks leave it");
    let late = world.join("cedar-01");
    assert_eq!(told(&world, late), changed, "whoever comes later is told the same");
    world.pass(2_000);
    world.command(birch, 2, json!({ "kind": "undo" }));
    world.command(birch, 3, json!({ "kind": "undo" }));
    world.settle();
    assert!(told(&world, maple) >= changed + 5_000, "undo changes it as well");
}
