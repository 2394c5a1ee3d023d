//! Rows as no plant would grow them: everything stays finite, and what cannot swing does not.

use espalier_mesh::leaves::hash;
use espalier_motion::{
    Answers, Exposure, LIVE_PERIOD, Pose, Row, Rows, Scale, Sway, Weather, Wind,
    bodies::{AHEAD, Bodies, Joinery},
    shelter::behind_crowns,
};
use glam::DVec3;

use crate::trees::{SEED, Tree};

/// Several seeds, dead rows with all they bore, rows without length, and rows of any girth.
fn rows(seed: u32) -> Rows {
    let draw = |row: u32, what: u32| hash(hash(seed) ^ (16 * row + what));
    let mut rows = vec![SEED];
    for row in 1..10 + seed % 60 {
        if draw(row, 0) % 16 == 0 {
            rows.push(Row { position: [draw(row, 1) as i32 % 5000, 0, 0], ..SEED });
            continue;
        }
        let parent = row - 1 - draw(row, 2) % row.min(3);
        let below = rows[parent as usize];
        let is_dead = draw(row, 3) % 8 == 0 || (below.parent.is_some() && below.radius == 0);
        let way = [4, 5, 6].map(|axis| (draw(row, axis) % 400) as i32 - 150);
        let way = if draw(row, 7) % 6 == 0 { [0; 3] } else { way };
        rows.push(Row {
            parent: Some(parent),
            starts_axis: draw(row, 8) % 3 == 0,
            position: [0, 1, 2].map(|axis| below.position[axis] + way[axis]),
            radius: if is_dead { 0 } else { 1 + (draw(row, 9) % 900) as u16 },
            leaves: (draw(row, 10) % 16) as u8,
        });
    }
    Rows::new(rows).expect("parents stand below")
}

#[test]
fn whatever_the_rows_are_everything_stays_finite() {
    let weather = Weather { velocity: DVec3::new(9.0, 1.0, -14.0), turbulence: 1.0, seed: 1 };
    let wind = Wind::new(&weather, LIVE_PERIOD);
    let mut moved = 0;
    for seed in 0..300 {
        let tree = Tree::of("hostile", rows(seed), Scale { internode_length: 0.1, leaf_size: 1.0 });
        let Tree { rows, wood, joints, .. } = &tree;
        let shares = behind_crowns(wood, weather.velocity.normalize());
        let sway = Sway::new(Answers::of(joints, &wind, &Exposure::of(joints, wood, &shares)));
        let pose = Pose::of(joints, wood, &sway.bends(123.4));
        let forces = vec![DVec3::X; rows.len()];
        let mut bodies = Bodies::of(wood, Joinery { softness: 2.0, damping: 0.01, ahead: AHEAD });
        for _ in 0..20 {
            bodies.step(0.01, &forces);
        }
        for row in 0..rows.len() as u32 {
            let node = pose.node(joints, wood, row);
            assert!(node.place.is_finite() && node.turn.is_finite(), "row {row} of {seed}: {node:?}");
            assert!(bodies.node(row).is_none_or(|node| node.is_finite()), "body {row} of {seed}");
            moved += u32::from(node.place != wood.place(row));
        }
        for joint in joints.all() {
            assert!(
                joint.frequency.is_finite() && joint.frequency > 0.0 && joint.centre.is_finite(),
                "{joint:?}"
            );
        }
    }
    assert!(moved > 1000, "{moved} nodes have moved");
}

#[test]
fn no_rows_at_all_have_no_joints() {
    let tree = Tree::of("nothing", Rows::default(), Scale { internode_length: 0.1, leaf_size: 1.0 });
    assert!(tree.joints.all().is_empty() && tree.limbs.all().is_empty() && tree.rows.is_empty());
    let seeds = Tree::of("seeds", Rows::new([SEED, SEED]).expect("two seeds"), tree.scale);
    assert!(seeds.joints.all().is_empty() && seeds.joints.rides().len() == 2);
}
