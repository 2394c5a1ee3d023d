//! What takes the wind away.

use std::sync::Arc;

use espalier_motion::{
    Answers, Exposure, LIVE_PERIOD, Limbs, Pose, Row, Rows, Scale, Sway, Weather, Wind, Wood,
    answers::pressure,
    shelter::{Form, Solid, Triangles, at_place, behind_crowns, shares},
};
use glam::{DQuat, DVec3, Vec3};

use crate::trees::{Tree, grown, unlike};

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
}

/// A wall across winds along x, whose middle is above this place: so high and so wide, in metres.
fn wall(x: f64, high: f64, wide: f64) -> Solid {
    let form = Form::Box(DVec3::new(0.1, 0.5 * high, 0.5 * wide));
    Solid::new(form, DVec3::new(x, 0.5 * high, 0.0), DQuat::IDENTITY, 1.0).expect("it stands")
}

/// The corners of the six sides of a box.
fn sides(half: DVec3) -> Vec<[Vec3; 3]> {
    let corner = |at: u32| {
        let side = |bit: u32| if at >> bit & 1 == 0 { -1.0 } else { 1.0 };
        (half * DVec3::new(side(0), side(1), side(2))).as_vec3()
    };
    let faces: [[u32; 4]; 6] =
        [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).map(|three| three.map(corner)).collect()
}

fn mesh(triangles: Vec<[Vec3; 3]>) -> Form {
    Form::Mesh(Arc::new(Triangles::new(triangles.into_iter())))
}

#[test]
fn an_obstacle_shelters_its_lee_and_the_less_the_farther() {
    let wall = [wall(-0.1, 3.0, 200.0)];
    let at = |x: f64, y: f64| at_place(DVec3::new(x, y, 0.0), DVec3::X, &wall);
    let formula = |x: f64| 1.0 - 0.8 * libm::exp(-x / 30.0);
    assert!((at(0.5, 1.0) - formula(0.5)).abs() < 0.01, "{}", at(0.5, 1.0));
    assert!((at(3.0, 1.0) - formula(3.0)).abs() < 0.01, "{}", at(3.0, 1.0));
    assert!(at(1.0, 1.0) < at(8.0, 1.0) && at(8.0, 1.0) < 1.0);
    assert_eq!([at(20.0, 1.0), at(-2.0, 1.0), at(4.0, 9.0)], [1.0; 3]);
    // Near its edge some of the air passes over it.
    assert!(at(4.0, 3.0) > at(4.0, 1.0) && at(4.0, 3.0) < 1.0);
}

#[test]
fn a_wall_is_as_good_as_its_triangles_however_it_is_turned_and_whatever_its_unit() {
    let half = DVec3::new(1.0, 20.0, 40.0);
    let place = DVec3::new(-30.0, 12.0, 5.0);
    let mut sheltered = 0;
    for turn in
        [DQuat::IDENTITY, DQuat::from_rotation_y(0.4), DQuat::from_scaled_axis(DVec3::new(0.3, -0.2, 0.1))]
    {
        let of = |form: Form| vec![Solid::new(form, place, turn, 0.1).expect("it stands")];
        let (solid, triangles) = (of(Form::Box(half)), of(mesh(sides(half))));
        assert!((solid[0].height() - triangles[0].height()).abs() < 1e-6);
        for at in 0..200u32 {
            let spot =
                DVec3::new(f64::from(at % 10) - 4.0, 0.5 * f64::from(at / 10 % 5), f64::from(at / 50) - 1.0);
            let way = DVec3::new(1.0, 0.0, 0.2).normalize();
            let [one, other] = [&solid, &triangles].map(|solids| at_place(spot, way, solids));
            assert!((one - other).abs() < 1e-6, "{spot}: {one} behind a box, {other} behind its triangles");
            sheltered += u32::from(one < 1.0);
        }
    }
    assert!(sheltered > 100, "{sheltered}");
}

#[test]
fn a_ball_is_as_good_as_its_many_triangles() {
    let (rings, sides) = (64u32, 128u32);
    let at = |ring: u32, side: u32| {
        let (sin, cos) = libm::sincosf(core::f32::consts::PI * ring as f32 / rings as f32);
        let (z, x) = libm::sincosf(core::f32::consts::TAU * side as f32 / sides as f32);
        2.0 * Vec3::new(sin * x, cos, sin * z)
    };
    let quads = (0..rings).flat_map(|ring| (0..sides).map(move |side| (ring, side)));
    let triangles = quads.flat_map(|(ring, side)| {
        let [a, b, c, d] = [at(ring, side), at(ring, side + 1), at(ring + 1, side), at(ring + 1, side + 1)];
        [[a, b, c], [b, d, c]]
    });
    let of = |form: Form| vec![Solid::new(form, DVec3::Y * 2.0, DQuat::IDENTITY, 1.0).expect("it stands")];
    let (ball, many) = (of(Form::Ball(2.0)), of(mesh(triangles.collect())));
    let mut sheltered = 0;
    for spot in 0..400u32 {
        let spot = DVec3::new(
            3.0 + f64::from(spot % 20),
            0.5 + 0.2 * f64::from(spot / 20),
            0.1 * f64::from(spot % 7),
        );
        let [one, other] = [&ball, &many].map(|solids| at_place(spot, DVec3::X, solids));
        // A ray that grazes it meets one and not the other: an eighth of what can be taken.
        assert!((one - other).abs() < 0.8 / 8.0 + 1e-3, "{spot}: {one} and {other}");
        sheltered += u32::from(one < 1.0 && (one - other).abs() < 1e-3);
    }
    assert!(sheltered > 150, "{sheltered}");
}

#[test]
fn the_land_that_a_house_stands_on_shelters_nothing() {
    let half = DVec3::new(3.0, 3.0, 3.0);
    let house = sides(half).into_iter().map(|three| three.map(|corner| corner + Vec3::Y * 3.0));
    let [a, b, c, d] =
        [[-90.0, -90.0], [90.0, -90.0], [90.0, 90.0], [-90.0, 90.0]].map(|[x, z]| Vec3::new(x, 0.1, z));
    let all: Vec<[Vec3; 3]> = house.chain([[a, b, c], [a, c, d]]).collect();
    let site = [Solid::new(mesh(all), DVec3::ZERO, DQuat::IDENTITY, 1.0).expect("it stands")];
    let at = |place: DVec3| at_place(place, DVec3::X, &site);
    assert_eq!(at(DVec3::new(0.0, 2.0, 40.0)), 1.0, "beside it");
    assert_eq!(at(DVec3::new(-20.0, 2.0, 0.0)), 1.0, "in front of it");
    assert!(at(DVec3::new(8.0, 2.0, 0.0)) < 0.4, "behind it");
}

#[test]
fn what_is_underground_or_has_no_form_is_no_obstacle() {
    let of = |form: Form, place: DVec3, turn: DQuat, unit: f64| Solid::new(form, place, turn, unit).is_some();
    let ball = || Form::Ball(1.0);
    assert!(of(ball(), DVec3::ZERO, DQuat::IDENTITY, 1.0));
    assert!(!of(ball(), DVec3::NEG_Y * 3.0, DQuat::IDENTITY, 1.0), "it lies below the ground");
    assert!(!of(ball(), DVec3::NAN, DQuat::IDENTITY, 1.0));
    assert!(!of(ball(), DVec3::ZERO, DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0), 1.0));
    assert!(!of(ball(), DVec3::ZERO, DQuat::IDENTITY, f64::NAN));
    assert!(!of(Form::Ball(f64::INFINITY), DVec3::ZERO, DQuat::IDENTITY, 1.0));
    assert!(!of(mesh(Vec::new()), DVec3::ZERO, DQuat::IDENTITY, 1.0));
    assert!(!of(mesh(vec![[Vec3::NAN; 3]]), DVec3::ZERO, DQuat::IDENTITY, 1.0));
}

/// How far the rows of a tree lean along an even wind of a speed along x, root mean square, in metres.
fn lean(tree: &Tree, speed: f64, solids: &[Solid]) -> f64 {
    let wind = Wind::new(&Weather { velocity: DVec3::X * speed, turbulence: 0.0, seed: 1 }, LIVE_PERIOD);
    let exposure = Exposure::of(&tree.joints, &tree.wood, &shares(&tree.wood, DVec3::X, solids));
    let sway = Sway::new(Answers::of(&tree.joints, &wind, &exposure));
    let pose = Pose::of(&tree.joints, &tree.wood, &sway.bends(0.0));
    let away = |row: u32| pose.node(&tree.joints, &tree.wood, row).place - tree.wood.place(row);
    let squares = (0..tree.rows.len() as u32).map(|row| away(row).length_squared());
    (squares.sum::<f64>() / tree.rows.len() as f64).sqrt()
}

#[test]
fn a_wall_upwind_takes_the_sway_that_the_formula_says_and_one_downwind_takes_nothing() {
    let tree = grown("default", 1500);
    let reach = |axis: usize, sign: f64| {
        let along = (0..tree.rows.len() as u32).map(|row| sign * tree.wood.place(row)[axis]);
        along.fold(f64::NEG_INFINITY, f64::max)
    };
    let (front, back, top) = (-reach(0, -1.0), reach(0, 1.0), reach(1, 1.0));
    // Twice as high as the tree and very wide, so that all rays meet it.
    let high = 2.0 * top;
    let away = 3.0 * top;
    let upwind = [wall(front - away, high, 40.0 * high)];
    let downwind = [wall(back + away, high, 40.0 * high)];
    let speed = 3.0;
    let open = lean(&tree, speed, &[]);
    assert_eq!(lean(&tree, speed, &downwind), open, "what stands in the lee changes nothing");
    let sheltered = lean(&tree, speed, &upwind);
    // From its front to its back the speed is this share, and the pressure its square, below where crowns streamline.
    let taken = |x: f64| 1.0 - 0.8 * libm::exp(-(x - front + away - 0.1) / (10.0 * high));
    let [least, most] = [front, back].map(|x| pressure(speed * taken(x)).0 / pressure(speed).0);
    let share = sheltered / open;
    println!(
        "behind a wall it leans by {share:.3} of what it does in the open; {least:.3} to {most:.3} are expected"
    );
    assert!((least - 0.01..=most + 0.01).contains(&share), "{share} is not from {least} to {most}");
    assert!(share < 0.5, "it is halved at least");
    // Farther away it takes less, and beyond six heights nothing.
    let farther = lean(&tree, speed, &[wall(front - 5.0 * high, high, 40.0 * high)]);
    assert!(sheltered < farther && farther < open, "{sheltered}, {farther}, {open}");
    assert_eq!(lean(&tree, speed, &[wall(front - 7.0 * high, high, 40.0 * high)]), open);
}

#[test]
fn half_a_wall_shelters_the_half_behind_it() {
    let tree = grown("oak", 2000);
    let low = tree.joints.all()[0].centre.y;
    let front = (0..tree.rows.len() as u32).map(|row| tree.wood.place(row).x).fold(f64::INFINITY, f64::min);
    let solids = [wall(front - 0.5, low, 100.0)];
    let [open, behind] = [&[][..], &solids[..]].map(|solids| shares(&tree.wood, DVec3::X, solids));
    let [mut below, mut above] = [[0.0, 0.0]; 2];
    for row in (1..tree.rows.len() as u32).filter(|&row| tree.wood.drag_area(row) > 0.0) {
        let side = if tree.wood.place(row).y < low { &mut below } else { &mut above };
        side[0] += behind[row as usize] / open[row as usize];
        side[1] += 1.0;
    }
    let [below, above] = [below, above].map(|[sum, count]| sum / count);
    assert!(below < 0.6 && above > 0.8, "{below} below its edge, {above} above");
}

#[test]
fn nothing_shelters_where_nothing_is() {
    let rows = Rows::new([]).expect("no rows");
    let scale = Scale { internode_length: 0.1, leaf_size: 1.0 };
    assert!(behind_crowns(&Wood::of(&rows, &Limbs::of(&rows), &scale), DVec3::X).is_empty());
}
