//! Clients make joints and sway by themselves: both must find what is in `golden/sway.json`.
//!
//! After a deliberate change: `UPDATE_GOLDEN=1 cargo test -p espalier-motion --test motion golden`.

use std::{fs, path::PathBuf};

use espalier_motion::{
    Answers, Direction, Exposure, Joint, LIVE_PERIOD, NONE, Pluck, Pose, Row, Sway, Weather, Wind,
    flutter::{self, Blade, Stirring},
    loads::{self, Loading},
    shelter::{Form, Solid, Triangles, behind_crowns, shares},
};
use glam::{DMat3, DQuat, DVec3, Vec3};
use serde_json::{Value, json};

use crate::trees::{Tree, grown};

/// Of rows and of joints every so many are written down.
const ROWS: usize = 23;
const JOINTS: usize = 5;

/// None is −1, as clients have it.
fn index(row: u32) -> i64 {
    if row == NONE { -1 } else { i64::from(row) }
}

fn vector(vector: DVec3) -> Value {
    json!(vector.to_array())
}

/// Column by column.
fn matrix(matrix: DMat3) -> Value {
    json!(matrix.to_cols_array())
}

/// Rows as frames carry them, but for positions, which are whole and not differences.
fn rows(tree: &Tree) -> Value {
    let all: Vec<Row> = (0..tree.rows.len() as u32).map(|row| tree.rows.row(row)).collect();
    let link = |(at, row): (usize, &Row)| match row.parent {
        Some(parent) => 2 * (at as u32 - parent) + u32::from(row.starts_axis),
        None => 0,
    };
    json!({
        "parent": all.iter().enumerate().map(link).collect::<Vec<_>>(),
        "position": all.iter().flat_map(|row| row.position).collect::<Vec<_>>(),
        "radius": all.iter().map(|row| row.radius).collect::<Vec<_>>(),
        "leaves": all.iter().map(|row| row.leaves).collect::<Vec<_>>(),
    })
}

fn joint(joint: &Joint) -> Value {
    json!({
        "first": joint.first,
        "node": joint.node,
        "parent": index(joint.parent.unwrap_or(NONE)),
        "level": joint.level,
        "frequency": joint.frequency,
        "damping": joint.damping,
        "drag": joint.drag,
        "softness": joint.softness,
        "compliance": matrix(joint.compliance),
        "centre": vector(joint.centre),
        "area": joint.area,
        "lowest": joint.lowest,
    })
}

fn wind(weather: &Weather, period: f64) -> (Wind, Value) {
    let wind = Wind::new(weather, period);
    let lines: Vec<Value> = wind
        .lines()
        .iter()
        .map(|line| {
            json!({
                "harmonic": line.harmonic,
                "amplitude": line.amplitude,
                "direction": line.direction as u32,
                "phase": line.phase,
                "wave": vector(line.wave),
            })
        })
        .collect();
    let axes = [Direction::Along, Direction::Across, Direction::Upward].map(|axis| vector(wind.axis(axis)));
    let written = json!({
        "velocity": vector(weather.velocity),
        "turbulence": weather.turbulence,
        "seed": weather.seed,
        "period": period,
        "axes": axes,
        "lines": lines,
    });
    (wind, written)
}

/// A box, a ball and a mesh with the land that it stands on, upwind of a tree: as the wind meets them, and as clients have them.
fn obstacles(along: DVec3, metres: f64) -> (Vec<Solid>, Value) {
    let level = DVec3::new(along.x, 0.0, along.z).normalize();
    let aside = DVec3::new(-level.z, 0.0, level.x);
    // Places and turns have single precision, as on the wire.
    let place = |upwind: f64, beside: f64, height: f64| {
        (-upwind * level + beside * aside + height * DVec3::Y).as_vec3().to_array()
    };
    let turn = DQuat::from_euler(glam::EulerRot::YXZ, 0.7, 0.2, -0.1).as_quat().to_array();
    let shed: [[f32; 3]; 6] = [
        [-4.0, 0.0, -3.0],
        [4.0, 0.0, -3.0],
        [0.0, 9.0, -3.5],
        [-4.5, 0.0, 12.0],
        [4.5, 0.0, 12.0],
        [0.5, 11.0, 12.5],
    ];
    let land: [[f32; 3]; 4] =
        [[-90.0, 0.0, -90.0], [90.0, 0.0, -90.0], [90.0, 0.0, 90.0], [-90.0, 0.0, 90.0]];
    let corners: Vec<Vec3> = shed.into_iter().chain(land).map(Vec3::from_array).collect();
    let triangles: [[u32; 3]; 10] = [
        [0, 1, 2],
        [3, 5, 4],
        [0, 2, 5],
        [0, 5, 3],
        [1, 4, 5],
        [1, 5, 2],
        [0, 3, 4],
        [0, 4, 1],
        [6, 7, 8],
        [6, 8, 9],
    ];
    let scale = 1.3f32;
    let mesh = Triangles::new(triangles.iter().map(|&three| three.map(|at| scale * corners[at as usize])));
    let mesh = Form::Mesh(std::sync::Arc::new(mesh));
    let still = DQuat::IDENTITY.as_quat().to_array();
    let all = [
        (
            Form::Box(DVec3::new(1.5, 6.0, 14.0)),
            json!({ "kind": "box", "size": [3, 12, 28] }),
            place(30.0, -9.0, 4.0),
            turn,
        ),
        (Form::Ball(7.5), json!({ "kind": "sphere", "radius": 7.5 }), place(18.0, 9.0, 12.25), still),
        (
            mesh,
            json!({ "kind": "mesh", "vertices": 10, "triangles": 10, "scale": scale }),
            place(13.0, -1.0, 0.5),
            turn,
        ),
        (Form::Ball(9.0), json!({ "kind": "sphere", "radius": 9 }), place(-25.0, 0.0, 5.0), still),
    ];
    let mut solids = Vec::new();
    let mut written = Vec::new();
    for (form, shape, position, rotation) in all {
        let (at, turned) =
            (Vec3::from_array(position).as_dvec3(), glam::Quat::from_array(rotation).as_dquat());
        solids.push(Solid::new(form, at, turned, metres).expect("it stands"));
        written.push(json!({ "shape": shape, "pose": { "position": position, "rotation": rotation } }));
    }
    let positions: Vec<f32> = corners.iter().flat_map(|corner| corner.to_array()).collect();
    (solids, json!({ "standing": written, "positions": positions, "triangles": triangles.as_flattened() }))
}

/// How joints turn under what lies on them, each alone, and in the wind behind obstacles under all of it.
fn laden(tree: &Tree, wind: &Wind, exposure: &Exposure) -> Value {
    let Tree { rows, limbs, wood, joints, scale, .. } = tree;
    let turns = |loading: Loading| loads::turns(rows, limbs, wood, joints, scale, &loading);
    let some = |turns: Vec<DVec3>| turns.into_iter().step_by(JOINTS).map(vector).collect::<Vec<_>>();
    let none = Loading::default();
    let loading = Loading { sag: 0.4, snow: 0.12, rain: 0.7 };
    let answers = Answers::under(joints, wind, exposure, &turns(loading));
    json!({
        "sag": some(turns(Loading { sag: 1.0, ..none })),
        "snow": some(turns(Loading { snow: 1.0, ..none })),
        "rain": some(turns(Loading { rain: 1.0, ..none })),
        "loading": { "sag": loading.sag, "snow": loading.snow, "rain": loading.rain },
        "means": some(answers.all().iter().map(|answer| answer.mean).collect()),
    })
}

fn sample(tree: &Tree, suppleness: f64, period: f64, blows: [f64; 3]) -> Value {
    let Tree { limbs, wood, joints, .. } = tree;
    let weather = Weather::blowing(blows, 0.6, 7);
    let velocity = weather.velocity;
    let (strong, strong_written) = wind(&weather, period);
    let along = strong.axis(Direction::Along);
    let (solids, solids_written) = obstacles(along, tree.scale.internode_length);
    let lee = shares(wood, along, &solids);
    let in_lee = Exposure::of(joints, wood, &lee);
    let (weak, weak_written) = wind(&Weather { velocity: -0.4 * velocity, turbulence: 0.9, seed: 8 }, period);
    let shares = behind_crowns(wood, along);
    let exposure = Exposure::of(joints, wood, &shares);
    let answers = Answers::of(joints, &strong, &exposure);
    let answered: Vec<Value> = answers
        .all()
        .iter()
        .step_by(JOINTS)
        .map(|answer| json!({ "mean": vector(answer.mean), "swing": matrix(answer.swing), "damping": answer.damping }))
        .collect();
    let mut sway = Sway::new(answers);
    // The weak wind blows in the open, alike everywhere.
    sway.change(Answers::of(joints, &weak, &Exposure::even(joints)), 30.0);
    let pluck = Pluck { joint: joints.all().len() as u32 / 2, at: 31.0, bend: DVec3::new(0.3, -0.1, 0.2) };
    sway.pluck(pluck);
    let every = |count: usize| (0..count as u32).step_by(ROWS);
    let stands: Vec<Value> = [0.0, 12.345, 29.9, 30.6, 31.4, 4000.25]
        .into_iter()
        .map(|time| {
            let bends = sway.bends(time);
            let pose = Pose::of(joints, wood, &bends);
            let node = |row| {
                let node = pose.node(joints, wood, row);
                json!([row, vector(node.place), node.turn.to_array()])
            };
            json!({
                "time": time,
                "bends": bends.iter().step_by(JOINTS).map(|&bend| vector(bend)).collect::<Vec<_>>(),
                "nodes": every(tree.rows.len()).map(node).collect::<Vec<_>>(),
            })
        })
        .collect();
    let ride = |row: u32| {
        let ride = joints.rides()[row as usize];
        json!([row, ride.weight, vector(ride.first), vector(ride.second)])
    };
    json!({
        "name": tree.name,
        "internodeLength": tree.scale.internode_length,
        "leafSize": tree.scale.leaf_size,
        "suppleness": suppleness,
        "rows": rows(tree),
        "onward": every(tree.rows.len()).map(|row| json!([row, index(limbs.onward(row).unwrap_or(NONE))])).collect::<Vec<_>>(),
        "limbs": limbs.all().iter().map(|limb| json!([limb.first, limb.node, limb.level])).collect::<Vec<_>>(),
        "joints": joints.all().iter().map(joint).collect::<Vec<_>>(),
        "riders": joints.rides().iter().map(|ride| index(ride.joint)).collect::<Vec<_>>(),
        "rides": every(tree.rows.len()).map(ride).collect::<Vec<_>>(),
        "wind": strong_written,
        "shares": every(tree.rows.len()).map(|row| json!([row, shares[row as usize]])).collect::<Vec<_>>(),
        "exposure": exposure.shares(),
        "blows": { "speed": blows[0], "direction": blows[1], "rise": blows[2] },
        "obstacles": solids_written,
        "lee": every(tree.rows.len()).map(|row| json!([row, lee[row as usize]])).collect::<Vec<_>>(),
        "inLee": in_lee.shares(),
        "laden": laden(tree, &strong, &in_lee),
        "answers": answered,
        "change": { "at": 30.0, "wind": weak_written },
        "pluck": { "joint": pluck.joint, "at": pluck.at, "bend": vector(pluck.bend) },
        "stands": stands,
    })
}

/// Two plants in one table, the second aside from the first.
fn grove(tree: &Tree) -> Tree {
    let count = tree.rows.len() as u32;
    let first: Vec<Row> = (0..count).map(|row| tree.rows.row(row)).collect();
    let beside = |row: &Row| Row {
        parent: row.parent.map(|parent| parent + count),
        position: [row.position[0] + 2000, row.position[1], row.position[2] - 900],
        ..*row
    };
    let both: Vec<Row> = first.iter().copied().chain(first.iter().map(beside)).collect();
    Tree::of("grove", espalier_motion::Rows::new(both).expect("parents stand below"), tree.scale)
}

/// What moves besides joints: noise, shivering twigs and fluttering leaves.
fn flutters() -> Value {
    let part = |at: u32, of: f64| (f64::from(at) * of).fract();
    let noise = (0..24).map(|at| {
        let (along, seed) = (11.3 * f64::from(at) - 60.0, part(at, 0.377));
        json!([along, seed, flutter::noise(along, seed, 256)])
    });
    let quivers = (0..24).map(|at| {
        let (number, least, time) = (part(at, 0.619), 3.0 + 0.5 * f64::from(at % 3), 27.1 * f64::from(at));
        json!([number, least, time, flutter::quiver(number, least, time, LIVE_PERIOD)])
    });
    let leaves = (0..24).map(|at| {
        let [a, b, c, d] = [0.617, 0.211, 0.433, 0.871].map(|of| part(at + 1, of));
        let direction = DVec3::new(a - 0.5, b - 0.6, c - 0.3).normalize();
        let blade = Blade {
            base: DVec3::new(40.0 * b - 20.0, 90.0 * c, 40.0 * a - 20.0),
            direction,
            side: direction.any_orthonormal_vector(),
            own: [c, d, a],
        };
        let lee = DVec3::new(libm::cos(6.0 * d), 0.0, libm::sin(6.0 * d)) * (1.0 - 0.2 * c);
        let snow = [0.0, 0.03, 0.2][at as usize % 3];
        let stirring =
            Stirring { lee, much: 2.2 * b, covered: flutter::covered(snow), wet: [0.0, 0.8][at as usize % 2] };
        let (air, time) = (24.0 * d, 25.3 * f64::from(at));
        let turn = flutter::turn(&stirring, &blade, air, time, LIVE_PERIOD);
        json!({
            "base": vector(blade.base), "direction": vector(direction), "side": vector(blade.side), "own": blade.own,
            "lee": vector(lee), "much": stirring.much, "snow": snow, "wet": stirring.wet,
            "air": air, "time": time, "turn": turn.to_array(),
        })
    });
    json!({
        "noise": noise.collect::<Vec<_>>(),
        "quivers": quivers.collect::<Vec<_>>(),
        "leaves": leaves.collect::<Vec<_>>(),
    })
}

fn samples() -> Value {
    let supple = |tree: Tree| {
        let joints = espalier_motion::Joints::of(&tree.rows, &tree.limbs, &tree.wood, 2.5);
        Tree { joints, ..tree }
    };
    json!({
        "sampledRows": ROWS,
        "sampledJoints": JOINTS,
        "flutters": flutters(),
        "trees": [
            sample(&grown("default", 350), 1.0, LIVE_PERIOD, [5.8, 31.0, 0.0]),
            sample(&supple(grown("weeping-willow", 350)), 2.5, LIVE_PERIOD, [12.5, 151.5, 1.5]),
            sample(&grown("scots-pine", 350), 1.0, 8.0, [3.0, 90.0, 0.0]),
            sample(&grove(&grown("oak", 150)), 1.0, LIVE_PERIOD, [7.3, 164.0, -4.0]),
        ],
    })
}

#[test]
fn joints_and_sway_are_as_they_were_written_down() {
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("golden/sway.json");
    let samples = samples();
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        fs::write(&file, format!("{samples}\n")).expect("the samples can be written");
    }
    let stored = fs::read_to_string(&file).expect("the samples can be read");
    let stored: Value = serde_json::from_str(&stored).expect("the samples are JSON");
    let written: Value = serde_json::from_str(&samples.to_string()).expect("so are these");
    assert!(stored == written, "joints or their sway differ from golden/sway.json");
}
