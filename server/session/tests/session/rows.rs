//! `FR`: what the columns of the table say, whatever a tree has been through.

use espalier_proto::{
    ChunkChange, Frame, Values,
    frame::{CHUNK_ROWS, light_level, light_of},
};
use serde_json::{Value, json};

use crate::{
    mirror::{Mirror, Row, rows_of},
    shaping::{grown, limb},
    world::{World, grow},
};

/// Light changes by so much before a client is told.
const SEEN: u8 = 8;

#[test]
fn fr7_light_and_vigor_are_functions_of_the_present() {
    let looks = |world: &World| -> Vec<(u8, u8)> {
        rows_of(world.document()).iter().map(|row: &Row| (row.light, row.foliage)).collect()
    };
    let (straight, ..) = grown();
    let (mut detour, ann, _) = grown();
    for (id, command) in (2..).zip([
        grow(4),
        json!({ "kind": "ungrow", "steps": 6 }),
        json!({ "kind": "plant_seed", "position": [2.0, 0.0, 0.0] }),
        grow(5),
        json!({ "kind": "take_future", "future": 0 }),
        json!({ "kind": "go_to", "step": 9 }),
    ]) {
        detour.command(ann, id, command);
    }
    detour.settle();
    assert_eq!(detour.peer(ann).refused(), []);
    let expected = looks(&straight);
    assert!(expected.iter().any(|&(light, _)| light > 0 && light < 255), "some stand in the shade");
    assert_eq!(looks(&detour)[..expected.len()], expected);
}

#[test]
fn fr7_faint_changes_are_kept_back_from_everybody_alike() {
    let mut world = World::new();
    let (ann, bob) = (world.join("birch-01"), world.join("maple-01"));
    let mut patched = 0;
    for (id, command) in (1..).zip([
        grow(12),
        json!({ "kind": "ungrow", "steps": 4 }),
        grow(5),
        json!({ "kind": "undo" }),
        grow(9),
    ]) {
        world.command(ann, id, command);
        world.settle();
        // Carol stays for a while, and has all that bob has.
        let carol = world.join("aspen-01");
        world.settle();
        assert_eq!(world.leave(carol).mirror.rows, world.peer(bob).mirror.rows);
    }
    let mut mirror = Mirror { epoch: world.peer(bob).mirror.epoch, ..Mirror::default() };
    for frame in &world.peer(bob).frames {
        patched += check_light(&mirror, frame);
        mirror.apply(frame);
    }
    assert!(patched > 100, "{patched} patches of light");
}

/// The patches of light in a frame; each changes what the client has by enough to be seen.
fn check_light(mirror: &Mirror, frame: &Frame) -> usize {
    let mut patched = 0;
    for change in &frame.changes {
        let ChunkChange::Patch { chunk, rows, values: Values::Light(values), .. } = change else { continue };
        for (&row, &by) in rows.iter().zip(values) {
            let held = &mirror.rows[*chunk as usize * CHUNK_ROWS + usize::from(row)];
            let light = light_of(light_level(held.light) + by).expect("FR11: there are 32 levels of light");
            assert!(light.abs_diff(held.light) >= SEEN, "{} to {light}", held.light);
        }
        patched += values.len();
    }
    patched
}

#[test]
fn fr8_births_rise_with_the_rows_and_never_change() {
    let (mut world, ann, bob) = grown();
    let (top, base) = limb(&world);
    let births = |world: &World| world.peer(bob).mirror.rows.iter().map(|row| row.born).collect::<Vec<u32>>();
    // 9 steps have been grown.
    let mut known = births(&world);
    assert_eq!((known[0], known.last()), (0, Some(&9)));
    let mut id = 1;
    // What each brings was born with the step of growth before it; the mirror refuses a patch of a birth.
    let mut after = |world: &mut World, command: Value, brings: Option<u32>| {
        id += 1;
        world.command(ann, id, command);
        world.settle();
        assert_eq!(world.peer(ann).refused(), []);
        let births = births(world);
        assert!(births.is_sorted(), "{births:?}");
        assert_eq!(births[..known.len()], known);
        let new = &births[known.len()..];
        match brings {
            Some(born) => assert!(!new.is_empty() && new.iter().all(|&at| at == born), "{new:?}"),
            None => assert_eq!(new, [] as [u32; 0]),
        }
        known = births;
    };
    let rotation = [0.0, 0.0, 0.0, 1.0];
    let seed = json!({ "kind": "plant_seed", "position": [6.0, 0.0, 0.0] });
    after(&mut world, seed, Some(9));
    after(
        &mut world,
        json!({ "kind": "graft", "row": top, "onto": base, "rotation": rotation, "keep": true }),
        Some(9),
    );
    let bend = [
        json!({ "kind": "bend_begin", "bend": 1, "base": base, "touches": vec![top], "stretch": 0.1 }),
        json!({ "kind": "bend_move", "bend": 1, "targets": vec![[3.0, 4.0, 0.0]] }),
        json!({ "kind": "bend_end", "bend": 1 }),
        json!({ "kind": "set_width", "row": base, "diameter": Some(0.7) }),
    ];
    for command in bend {
        after(&mut world, command, None);
    }
    // Edits are no steps of growth: this one is the tenth, and the whole graft counts as young as it.
    after(&mut world, grow(1), Some(10));
    after(
        &mut world,
        json!({ "kind": "graft", "row": top, "onto": base, "rotation": rotation, "keep": true }),
        Some(10),
    );
    world.assert_mirrored(bob);
}
