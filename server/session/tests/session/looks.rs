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
        ServerMessage::Appearance { appearance } => Some(appearance.leaves.season),
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
