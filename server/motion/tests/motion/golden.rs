//! Clients make joints and sway by themselves: both must find what is in `golden/sway.json`.
//!
//! After a deliberate change: `UPDATE_GOLDEN=1 cargo test -p espalier-motion --test motion golden`.

use std::{fs, path::PathBuf};

use espalier_motion::{
    Answers, Direction, Exposure, Joint, LIVE_PERIOD, NONE, Pluck, Pose, Row, Sway, Weather, Wind,
    shelter::behind_crowns,
};
use glam::{DMat3, DVec3};
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

fn sample(tree: &Tree, suppleness: f64, period: f64, velocity: DVec3) -> Value {
    let Tree { limbs, wood, joints, .. } = tree;
    let (strong, strong_written) = wind(&Weather { velocity, turbulence: 0.6, seed: 7 }, period);
    let (weak, weak_written) = wind(&Weather { velocity: -0.4 * velocity, turbulence: 0.9, seed: 8 }, period);
    let shares = behind_crowns(wood, velocity.normalize());
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

fn samples() -> Value {
    let supple = |tree: Tree| {
        let joints = espalier_motion::Joints::of(&tree.rows, &tree.limbs, &tree.wood, 2.5);
        Tree { joints, ..tree }
    };
    json!({
        "sampledRows": ROWS,
        "sampledJoints": JOINTS,
        "trees": [
            sample(&grown("default", 350), 1.0, LIVE_PERIOD, DVec3::new(5.0, 0.0, 3.0)),
            sample(&supple(grown("weeping-willow", 350)), 2.5, LIVE_PERIOD, DVec3::new(-11.0, 1.5, 6.0)),
            sample(&grown("scots-pine", 350), 1.0, 8.0, DVec3::new(0.0, 0.0, 3.0)),
            sample(&grove(&grown("oak", 150)), 1.0, LIVE_PERIOD, DVec3::new(-7.0, 0.0, 2.0)),
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
