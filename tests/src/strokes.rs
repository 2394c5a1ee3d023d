//! Strokes as a finger would draw them.

use serde_json::{Value, json};

/// A stroke through `points`, in messages of `per_message` samples, with a constant radius.
pub fn stroke(number: u32, points: &[[f32; 3]], radius: f32, per_message: usize) -> Vec<Value> {
    let mut commands = vec![json!({ "kind": "stroke_begin", "stroke": number })];
    for points in points.chunks(per_message) {
        let samples = points
            .iter()
            .map(|&position| json!({ "position": position, "radius": radius }))
            .collect::<Vec<_>>();
        commands.push(json!({ "kind": "stroke_move", "stroke": number, "samples": samples }));
    }
    commands.push(json!({ "kind": "stroke_end", "stroke": number }));
    commands
}

/// `count` points on the straight line from one place to another, ends included.
pub fn line(from: [f32; 3], to: [f32; 3], count: usize) -> Vec<[f32; 3]> {
    (0..count)
        .map(|i| {
            let t = i as f32 / (count - 1).max(1) as f32;
            std::array::from_fn(|axis| from[axis] + (to[axis] - from[axis]) * t)
        })
        .collect()
}

/// Straight up from the first seed, as high as `height` internodes.
pub fn upward(number: u32, height: f32, radius: f32) -> Vec<Value> {
    stroke(number, &line([0.0, 0.0, 0.0], [0.0, height, 0.0], (height * 2.0) as usize), radius, 4)
}
