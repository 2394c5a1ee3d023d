//! The client previews bends by itself: both must find the motions in `golden/bend.json`.
//!
//! After a deliberate change: `UPDATE_GOLDEN=1 cargo test -p espalier-plant --test bend`.

use std::{fs, path::PathBuf};

use espalier_plant::Motion;
use glam::Vec3;
use serde_json::{Value, json};

use crate::shapes::Shape;

/// Of long paths every so many internodes are written down.
const SAMPLED: usize = 8;

/// Touches and their ways as shares of the length, led there in so many events.
type Way = (usize, [f32; 3]);

fn sample(shape: &Shape, stretch: f32, legs: &[(u32, &[Way])]) -> Value {
    let mut bend = shape.bend(stretch);
    let mut events = Vec::new();
    let mut at: Vec<Vec3> = shape.nodes[1..].to_vec();
    for &(count, ways) in legs {
        let from = at.clone();
        for event in 1..=count {
            let share = event as f32 / count as f32;
            let targets: Vec<(usize, Vec3)> = ways
                .iter()
                .map(|&(touch, way)| {
                    let there = shape.nodes[touch + 1] + shape.length() * Vec3::from(way);
                    (touch, from[touch].lerp(there, share))
                })
                .collect();
            targets.iter().for_each(|&(touch, place)| at[touch] = place);
            bend.drag(&targets);
            let touches: Vec<_> =
                targets.iter().map(|&(touch, place)| json!([touch, place.to_array()])).collect();
            events.push(json!({ "targets": touches, "motions": sampled_motions(&bend.motions()) }));
        }
    }
    bend.relax();
    json!({
        "name": shape.name,
        "stretch": stretch,
        "nodes": shape.nodes.iter().map(|node| node.to_array()).collect::<Vec<_>>(),
        "radii": shape.radii,
        "events": events,
        "relaxed": sampled_motions(&bend.motions()),
    })
}

/// Internode, where its end is, and its rotation.
fn sampled_motions(motions: &[Motion]) -> Vec<Value> {
    let every = motions.len().div_ceil(SAMPLED);
    let is_sampled = |i: usize| i.is_multiple_of(every) || i + 1 == motions.len();
    let sampled = motions.iter().enumerate().filter(|&(i, _)| is_sampled(i));
    sampled.map(|(i, motion)| json!([i, motion.to.to_array(), motion.rotation.to_array()])).collect()
}

fn samples() -> Value {
    let end = |shape: &Shape, way| [(shape.last(), way)];
    let straight = Shape::straight(12, 0.3);
    let curved = Shape::curved(40, 0.15);
    let zigzag = Shape::zigzag(25, 1.0);
    let uneven = Shape::uneven(30, 0.4);
    let long = Shape::curved(400, 0.1);
    let one = Shape::straight(2, 1.0);
    json!([
        sample(
            &straight,
            0.0,
            &[(5, &end(&straight, [0.3, -0.2, 0.1])), (3, &end(&straight, [0.0, -0.5, 0.0]))]
        ),
        sample(
            &curved,
            0.2,
            &[(6, &[(13, [0.1, 0.0, 0.1]), (26, [0.1, -0.1, 0.2]), (39, [-0.3, -0.2, 0.3])])]
        ),
        sample(&zigzag, 0.6, &[(4, &end(&zigzag, [0.5, -0.4, 0.3])), (2, &[(10, [0.2, 0.0, 0.0])])]),
        sample(&uneven, 1.0, &[(4, &end(&uneven, [1.0, 0.8, -0.3])), (1, &end(&uneven, [0.0, 0.0, 0.0]))]),
        sample(&long, 0.1, &[(4, &[(200, [0.05, -0.1, 0.1]), (399, [-0.3, -0.2, 0.3])])]),
        sample(&one, 0.5, &[(2, &end(&one, [1.0, -1.0, 0.0]))]),
    ])
}

#[test]
fn bends_are_as_they_were_written_down() {
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("golden/bend.json");
    let samples = samples();
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        fs::write(&file, format!("{samples}\n")).expect("the samples can be written");
    }
    let stored = fs::read_to_string(&file).expect("the samples can be read");
    let stored: Value = serde_json::from_str(&stored).expect("the samples are JSON");
    let written: Value = serde_json::from_str(&samples.to_string()).expect("so are these");
    assert!(stored == written, "bends differ from golden/bend.json");
}
