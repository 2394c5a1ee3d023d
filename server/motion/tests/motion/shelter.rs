//! What takes the wind away.

use espalier_motion::{
    Exposure, Limbs, Row, Rows, Scale, Wood,
    shelter::{Hit, behind_crowns, behind_obstacles},
};
use glam::DVec3;

use crate::trees::{grown, unlike};

#[test]
fn a_crown_shelters_its_own_lee() {
    for tree in unlike() {
        for along in [DVec3::X, -DVec3::X, DVec3::new(0.6, 0.0, 0.8)] {
            let shares = behind_crowns(&tree.wood, along);
            let middle = tree.joints.all()[0].centre;
            let mut sides = [[0.0; 2]; 2];
            for row in 1..tree.rows.len() as u32 {
                let side = &mut sides[usize::from((tree.wood.place(row) - middle).dot(along) > 0.0)];
                side[0] += shares[row as usize];
                side[1] += 1.0;
                assert!(shares[row as usize] > 0.0 && shares[row as usize] <= 1.0);
            }
            let [front, lee] = sides.map(|[sum, count]| sum / count);
            println!("{}: {front:.2} in front, {lee:.2} in the lee", tree.name);
            assert!(lee < 0.95 * front, "{}: {lee} behind {front}", tree.name);
        }
    }
}

#[test]
fn a_plant_shelters_the_one_behind_and_less_from_afar() {
    let tree = grown("default", 1500);
    let count = tree.rows.len() as u32;
    let twice = |apart: i32| {
        let beside = |row: Row| Row {
            parent: row.parent.map(|parent| parent + count),
            position: [row.position[0] + 256 * apart, row.position[1], row.position[2]],
            ..row
        };
        let first: Vec<Row> = (0..count).map(|row| tree.rows.row(row)).collect();
        let rows =
            Rows::new(first.iter().copied().chain(first.iter().copied().map(beside))).expect("two plants");
        let wood = Wood::of(&rows, &Limbs::of(&rows), &tree.scale);
        let shares = behind_crowns(&wood, DVec3::X);
        let mean = |rows: std::ops::Range<u32>| {
            rows.clone().map(|row| shares[row as usize]).sum::<f64>() / f64::from(rows.len() as u32)
        };
        [mean(0..count), mean(count..2 * count)]
    };
    let [front, behind] = twice(60);
    let [_, far] = twice(600);
    assert!(behind < 0.9 * front && far > behind && far <= 1.01 * front, "{front}, {behind}, {far}");
}

#[test]
fn exposed_joints_are_those_in_front_and_on_top() {
    let tree = grown("default", 2000);
    let open = Exposure::of(&tree.joints, &tree.wood, &vec![1.0; tree.rows.len()]);
    let sheltered = Exposure::of(&tree.joints, &tree.wood, &behind_crowns(&tree.wood, DVec3::X));
    for ((joint, open), sheltered) in tree.joints.all().iter().zip(open.shares()).zip(sheltered.shares()) {
        assert!(sheltered <= open && *sheltered > 0.0);
        let [low, high] = [0.0, 2.0 * joint.centre.y].map(espalier_motion::profile);
        assert!(*open >= low && *open <= high + 0.2, "{joint:?} gets {open}");
    }
    let halved = sheltered.clone().in_lee(&tree.joints, |_| 0.5);
    assert!(halved.shares().iter().zip(sheltered.shares()).all(|(half, whole)| *half == 0.5 * whole));
}

#[test]
fn an_obstacle_shelters_its_lee_and_the_less_the_farther() {
    // A wall 3 m high at x = 0 that stands across the wind.
    let wall = |from: DVec3, way: DVec3| {
        let distance = -from.x / way.x;
        let meets = way.x != 0.0 && distance > 0.0 && (from.y + distance * way.y) < 3.0;
        meets.then_some(Hit { distance, height: 3.0 })
    };
    let at = |x: f64, y: f64| behind_obstacles(DVec3::new(x, y, 0.0), DVec3::X, wall);
    assert!((at(0.5, 1.0) - 0.21).abs() < 0.02, "{}", at(0.5, 1.0));
    assert!(at(1.0, 1.0) < at(8.0, 1.0) && at(8.0, 1.0) < 1.0);
    assert_eq!([at(20.0, 1.0), at(-2.0, 1.0), at(4.0, 9.0)], [1.0; 3]);
    // Near its edge some of the air passes over it.
    assert!(at(4.0, 3.0) > at(4.0, 1.0) && at(4.0, 3.0) < 1.0);
}

#[test]
fn nothing_shelters_where_nothing_is() {
    let rows = Rows::new([]).expect("no rows");
    let scale = Scale { internode_length: 0.1, leaf_size: 1.0 };
    assert!(behind_crowns(&Wood::of(&rows, &Limbs::of(&rows), &scale), DVec3::X).is_empty());
}
