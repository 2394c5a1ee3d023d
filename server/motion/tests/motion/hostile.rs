//! Rows as no plant would grow them: everything stays finite, and what cannot swing does not.

use espalier_mesh::leaves::hash;
use espalier_motion::{
    Answers, Exposure, Joints, LIVE_PERIOD, MAX_JOINTS, Pose, Rig, Row, Rows, Scale, Sway, Weather, Wind,
    bodies::{AHEAD, Bodies, Joinery},
    clips::{Conditions, GUST, KEYS_A_SECOND, blow, clips, reaches},
    loads::{self, Loading},
    shelter::{Form, Solid, behind_crowns, shares},
};
use glam::{DQuat, DVec3};

use crate::trees::{SEED, Tree, grown, pole};

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

#[test]
fn winds_that_nothing_stands_and_winds_that_are_no_numbers_leave_everything_finite() {
    let tree = grown("oak", 400);
    let Tree { joints, wood, .. } = &tree;
    let bends_at = |velocity: DVec3, turbulence: f64, time: f64| {
        let weather = Weather { velocity, turbulence, seed: 3 };
        let conditions = Conditions::open(wood, weather);
        let wind = Wind::new(&weather, LIVE_PERIOD);
        let answers = Answers::of(joints, &wind, &conditions.exposure(joints, wood));
        Sway::new(answers).bends(time)
    };
    for speed in [0.0, 1e-45, 1e-3, 25.0, 1e4, 1e9, 1e150] {
        for turbulence in [0.0, 1.0, 1e9] {
            for time in [0.0, 599.999, -1e6, 1e12] {
                let bends = bends_at(DVec3::new(speed, 0.1 * speed, -speed), turbulence, time);
                let furthest = bends.iter().map(|bend| bend.length()).fold(0.0, f64::max);
                assert!(bends.iter().all(|bend| bend.is_finite()), "{speed} m/s, {turbulence}, {time} s");
                assert!(furthest <= 1.1 + 1e-9, "{speed} m/s: {furthest}");
            }
        }
    }
    let calm = bends_at(DVec3::ZERO, 0.5, 3.0);
    for none in [DVec3::NAN, DVec3::X * f64::INFINITY, DVec3::new(1e200, 0.0, 1e200)] {
        assert_eq!(bends_at(none, 0.5, 3.0), calm, "{none}");
    }
    for turbulence in [f64::NAN, f64::INFINITY, -1.0] {
        assert_eq!(bends_at(DVec3::X, turbulence, 3.0), bends_at(DVec3::X, 0.0, 9.0), "{turbulence}");
    }
}

#[test]
fn more_snow_than_there_is_bends_no_limb_further_than_it_goes() {
    let tree = grown("scots-pine", 400);
    let Tree { rows, limbs, wood, joints, scale, .. } = &tree;
    for snow in [0.5, 1e3, 1e9] {
        let loads = loads::turns(rows, limbs, wood, joints, scale, &Loading { snow, ..Loading::default() });
        let calm = Weather { velocity: DVec3::ZERO, turbulence: 0.0, seed: 0 };
        let [sway, gust] = clips(joints, wood, &Conditions::new(wood, calm, &[], loads));
        assert!(
            sway.keys.iter().chain(&gust.keys).flatten().all(|bend| bend.length() <= 0.8 + 1e-9),
            "{snow}"
        );
    }
}

#[test]
fn a_tree_of_one_metamer_stands_in_any_weather() {
    let Tree { rows, limbs, wood, joints, scale, .. } = &pole(1, [0, 256, 0], |_| 0.05);
    assert_eq!(joints.all().len(), 1, "a trunk always sways");
    let loads = loads::turns(rows, limbs, wood, joints, scale, &Loading { sag: 1.0, snow: 0.5, rain: 1.0 });
    let wall = Solid::new(Form::Box(DVec3::ONE), DVec3::NEG_X * 2.0, DQuat::IDENTITY, 1.0).expect("a wall");
    let weather = Weather::blowing([18.0, 0.0, 3.0], 1.0, 7);
    let conditions = Conditions::new(wood, weather, &[wall], loads);
    let mut clips = clips(joints, wood, &conditions);
    let rig = Rig::of(joints, limbs, wood, 0, &reaches(&clips, 1), 64);
    blow(&mut clips[1], &[rig], (joints, limbs, wood), &conditions, || Ok::<(), ()>(())).expect("it goes on");
    assert!(clips.iter().flat_map(|clip| &clip.keys).flatten().all(|bend| bend.is_finite()));
}

#[test]
fn bodies_in_a_gust_stop_when_they_are_told_to() {
    let tree = grown("oak", 400);
    let Tree { limbs, wood, joints, .. } = &tree;
    let conditions = Conditions::open(wood, Weather::blowing([14.0, 30.0, 0.0], 0.8, 7));
    let mut clips = clips(joints, wood, &conditions);
    let rig = Rig::of(joints, limbs, wood, 0, &reaches(&clips, joints.all().len()), 64);
    let gust = &mut clips[1];
    for last in [1, 100] {
        let mut asked = 0;
        let go_on = || {
            asked += 1;
            if asked < last { Ok(()) } else { Err("nobody wants it") }
        };
        let stopped = blow(gust, std::slice::from_ref(&rig), (joints, limbs, wood), &conditions, go_on);
        assert_eq!((stopped, asked), (Err("nobody wants it"), last));
    }
    let mut asked = 0;
    let go_on = || {
        asked += 1;
        Ok::<(), ()>(())
    };
    assert_eq!(blow(gust, &[rig], (joints, limbs, wood), &conditions, go_on), Ok(()));
    assert_eq!(f64::from(asked), GUST * f64::from(KEYS_A_SECOND) + 1.0, "it is asked at every key");
}

/// A row of a million, in 250 plants: a trunk of 100 rows each, and thin shoots of 20 on 195 nodes.
fn million() -> Rows {
    let mut rows = Vec::with_capacity(1_000_250);
    for plant in 0..250i32 {
        let seed = rows.len() as u32;
        let foot = [2000 * (plant % 16), 0, 2000 * (plant / 16)];
        rows.push(Row { position: foot, ..SEED });
        for height in 1..=100 {
            let parent = Some(rows.len() as u32 - 1);
            let radius = crate::trees::code(1.2 - 0.01 * f64::from(height));
            rows.push(Row {
                parent,
                starts_axis: height == 1,
                position: [foot[0], 256 * height, foot[2]],
                radius,
                leaves: 0,
            });
        }
        for shoot in 0..195i32 {
            let node = seed + 2 + (shoot / 2) as u32;
            let way = if shoot % 2 == 0 { 256 } else { -256 };
            for at in 1..=20 {
                let below = if at == 1 { node } else { rows.len() as u32 - 1 };
                let [x, y, z] = rows[node as usize].position;
                let radius = crate::trees::code(0.06 + 0.001 * f64::from(shoot));
                let position = [x + way * at, y, z + 40 * at];
                rows.push(Row { parent: Some(below), starts_axis: at == 1, position, radius, leaves: 2 });
            }
        }
    }
    Rows::new(rows).expect("each stands on one before it")
}

#[test]
fn a_million_rows_have_no_more_joints_than_there_may_be() {
    let rows = million();
    assert!(rows.len() >= 1_000_000, "{}", rows.len());
    let scale = Scale { internode_length: 0.1, leaf_size: 1.0 };
    let (limbs, wood, joints) = Joints::grown(&rows, &scale, 1.0);
    assert!(limbs.all().len() > 10 * MAX_JOINTS);
    assert_eq!(joints.all().len(), MAX_JOINTS, "more limbs than that are slow");
    let trunks = joints.all().iter().filter(|joint| joint.parent.is_none()).count();
    assert_eq!(trunks, 250, "every trunk is among them");
    assert!(joints.all().iter().all(|joint| joint.frequency.is_finite() && joint.frequency > 0.0));
    assert_eq!(joints.rides().len(), rows.len());
    let wall = Solid::new(Form::Box(DVec3::new(1.0, 30.0, 900.0)), DVec3::NEG_X * 20.0, DQuat::IDENTITY, 1.0);
    let reached = shares(&wood, DVec3::X, &[wall.expect("a wall")]);
    assert!(reached.iter().all(|share| (0.0..=1.0).contains(share)));
}
