//! `PR`: what a cut leaves behind.

use espalier_plant::MetamerId;
use serde_json::json;

use crate::{
    shaping::{grown, timeline},
    world::{World, grow},
};

/// The largest branch that is no trunk, with the rows it has.
fn branch(world: &World) -> (u32, Vec<u32>) {
    let plant = world.document().plant();
    let rows = (1..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id));
    let laterals = rows.filter(|&id| {
        let parent = plant.metamers().parent(id);
        parent.is_some_and(|parent| {
            plant.metamers().axis(parent) != plant.metamers().axis(id) && parent.raw() > 0
        })
    });
    let (row, above) = laterals.map(|id| (id, plant.above(id))).max_by_key(|(_, above)| above.len()).unwrap();
    (row.raw(), above.into_iter().map(MetamerId::raw).collect())
}

#[test]
fn pr2_what_is_cut_off_is_gone_as_if_it_had_never_grown() {
    let (mut world, ann, bob) = grown();
    world.command(ann, 2, grow(3));
    world.settle();
    let (row, gone) = branch(&world);
    assert!(gone.len() > 20, "only {} metamers", gone.len());
    let before = world.peer(bob).mirror.rows.clone();
    let place = |row: u32| before[row as usize].position;
    world.command(ann, 3, json!({ "kind": "prune", "rows": vec![row], "gesture": Some(7) }));
    world.settle();
    let after = world.peer(bob).mirror.rows.clone();
    assert!(gone.iter().all(|&row| after[row as usize].radius == 0), "what is dead is not drawn");
    // Wood below gets thinner, down to the foot; nothing else changes its girth.
    let mut below = vec![before[row as usize].parent.expect("it is borne")];
    while let Some(parent) = before[below[below.len() - 1] as usize].parent {
        below.push(parent);
    }
    let thinner = |row: u32| after[row as usize].radius < before[row as usize].radius;
    assert!(below.iter().filter(|&&row| row > 0).all(|&row| thinner(row)), "a limb below kept its girth");
    let standing = (1..before.len() as u32).filter(|row| !gone.contains(row));
    let changed: Vec<u32> = standing.clone().filter(|&row| thinner(row) && !below.contains(&row)).collect();
    assert_eq!(changed, [] as [u32; 0]);
    // Light opens up: some get more, none gets less.
    let light = |row: u32| (before[row as usize].light, after[row as usize].light);
    assert!(standing.clone().any(|row| light(row).1 > light(row).0), "nobody gets more light");
    assert!(standing.clone().all(|row| light(row).1 >= light(row).0), "somebody gets less light");
    // So does space: new wood stands where the branch stood.
    world.command(ann, 4, json!({ "kind": "grow", "steps": 6, "gesture": Some(7) }));
    world.settle();
    let grown = &world.peer(bob).mirror.rows[before.len()..];
    let is_near = |a: [i32; 3], b: [i32; 3]| {
        (0..3).map(|i| i64::from(a[i] - b[i]).pow(2)).sum::<i64>() < i64::from(256 * 256)
    };
    let returned =
        gone.iter().filter(|&&row| grown.iter().any(|new| is_near(new.position, place(row)))).count();
    assert!(5 * returned > gone.len(), "{returned} of {} places are taken again", gone.len());
    // Cut and growth by one gesture are one operation.
    let operations = timeline(world.peer(ann)).operations.len();
    world.command(ann, 5, json!({ "kind": "undo" }));
    world.settle();
    assert_eq!(timeline(world.peer(ann)).operations.len(), operations);
    assert_eq!(timeline(world.peer(ann)).done as usize, operations - 1);
    let again = &world.peer(bob).mirror.rows;
    assert!(gone.iter().all(|&row| again[row as usize].radius == before[row as usize].radius));
    world.assert_mirrored(bob);
}
