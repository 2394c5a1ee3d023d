//! What clients draw of a silhouette and an axis is what wood grows by: both read the samples of one file.

use std::{fs, path::Path};

use espalier_design::{Curve, Envelope, Half};
use glam::Vec3;
use serde_json::{Value, json};

const SHARES: [f32; 4] = [0.0, 0.35, 0.8, 1.0];
const PLACES: [f32; 6] = [0.0, 0.13, 0.4, 0.55, 0.9, 1.0];

/// After a deliberate change: `UPDATE_GOLDEN=1 cargo test -p espalier-design shells`.
#[test]
fn samples_of_shells_and_axes_are_those_that_clients_read() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/shells.json");
    let wanted = json!({
        "envelopes": envelopes().iter().map(of_envelope).collect::<Vec<_>>(),
        "curves": curves().iter().map(|points| of_curve(points)).collect::<Vec<_>>(),
    });
    let wanted = format!("{wanted:#}\n");
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        fs::write(&file, &wanted).expect("the file can be written");
    }
    let found = fs::read_to_string(&file).expect("the file is there");
    assert!(found == wanted, "shells.json is out of date: run this test with UPDATE_GOLDEN=1");
}

fn envelopes() -> Vec<Envelope> {
    let ovoid = Envelope::default();
    vec![
        ovoid.clone(),
        Envelope {
            top: Vec3::new(0.2, 1.1, -0.1),
            bottom: Vec3::new(-0.1, -0.2, 0.05),
            radii: [0.9, 0.3, 0.15, 0.5],
            heights: [0.2, 0.5, 0.7, 0.3],
            upper: 1.0,
            lower: 3.5,
            tip: Vec3::new(0.3, 0.9, 0.1),
        },
        // Poles outside the periphery are drawn in to it.
        Envelope { top: Vec3::new(0.9, 1.0, 0.4), upper: 0.6, lower: 8.0, ..ovoid },
    ]
}

fn of_envelope(envelope: &Envelope) -> Value {
    let mut points = Vec::new();
    for half in [Half::Upper, Half::Lower] {
        for turn in 0..12 {
            let angle = turn as f32 * core::f32::consts::TAU / 12.0 + 0.1;
            for share in SHARES {
                points.push(json!({
                    "upper": half == Half::Upper,
                    "angle": angle,
                    "share": share,
                    "at": envelope.surface(angle, share, half).to_array(),
                }));
            }
        }
    }
    json!({
        "envelope": {
            "top": envelope.top.to_array(),
            "bottom": envelope.bottom.to_array(),
            "radii": envelope.radii,
            "heights": envelope.heights,
            "upper": envelope.upper,
            "lower": envelope.lower,
            "tip": envelope.tip.to_array(),
        },
        "points": points,
    })
}

fn curves() -> Vec<Vec<Vec3>> {
    vec![
        vec![Vec3::ZERO, Vec3::Y],
        vec![Vec3::ZERO, Vec3::new(0.3, 0.4, 0.0), Vec3::Y],
        vec![
            Vec3::ZERO,
            Vec3::new(0.2, 0.1, 0.1),
            Vec3::new(-0.4, 0.5, 0.3),
            Vec3::new(0.1, 0.52, -0.2),
            Vec3::Y,
        ],
    ]
}

fn of_curve(points: &[Vec3]) -> Value {
    let curve = Curve::new(points).expect("it is one");
    let at = PLACES.map(|t| json!({ "t": t, "at": curve.at(t).to_array() }));
    json!({ "points": points.iter().map(|point| point.to_array()).collect::<Vec<_>>(), "length": curve.length(), "at": at })
}
