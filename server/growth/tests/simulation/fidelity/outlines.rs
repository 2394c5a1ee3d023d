//! Outlines as a finger draws them, in internodes, with the ground at height 0.

use core::f32::consts::TAU;

use glam::Vec2;

/// Points of a curve around once.
fn curve(points: u32, at: impl Fn(f32, f32) -> Vec2) -> Vec<Vec2> {
    (0..points)
        .map(|i| {
            let (sin, cos) = libm::sincosf(i as f32 * TAU / points as f32);
            at(sin, cos)
        })
        .collect()
}

/// The corners of a polygon, "x,y x,y …".
fn polygon(corners: &str) -> Vec<Vec2> {
    let point = |pair: &str| {
        let (x, y) = pair.split_once(',').expect("a pair");
        Vec2::new(x.parse().expect("a number"), y.parse().expect("a number"))
    };
    corners.split_whitespace().map(point).collect()
}

fn circle() -> Vec<Vec2> {
    curve(64, |sin, cos| Vec2::new(14.0 * cos, 14.0 + 14.0 * sin))
}

fn star() -> Vec<Vec2> {
    (0..10u32)
        .map(|i| {
            let (sin, cos) = libm::sincosf((i as f32 * 0.1 + 0.25) * TAU);
            Vec2::new(cos, sin) * if i % 2 == 0 { 24.0 } else { 11.0 } + Vec2::Y * 19.5
        })
        .collect()
}

fn heart() -> Vec<Vec2> {
    curve(96, |sin, cos| {
        let cos_twice = 2.0 * cos * cos - 1.0;
        let cos_thrice = cos * (4.0 * cos * cos - 3.0);
        let cos_four_times = 2.0 * cos_twice * cos_twice - 1.0;
        let y = 13.0 * cos - 5.0 * cos_twice - 2.0 * cos_thrice - cos_four_times;
        Vec2::new(1.3 * 16.0 * sin * sin * sin, 1.3 * (y + 17.0))
    })
}

/// One stroke that crosses itself in the middle; the loops stand on one another.
fn figure_eight() -> Vec<Vec2> {
    curve(128, |sin, cos| Vec2::new(26.0 * sin * cos, 25.0 - 24.0 * cos))
}

/// Open to the right and above.
fn crescent() -> Vec<Vec2> {
    let outer = (0..=48).map(|i| (0.13 + 0.74 * i as f32 / 48.0) * TAU);
    let inner = (0..=48).rev().map(|i| (0.19 + 0.62 * i as f32 / 48.0) * TAU);
    let ring = |angle: f32, centre: Vec2, radius: f32| {
        let (sin, cos) = libm::sincosf(angle);
        centre + Vec2::new(cos, sin) * radius
    };
    let outer = outer.map(|angle| ring(angle, Vec2::new(9.0, 20.0), 20.0));
    outer.chain(inner.map(|angle| ring(angle, Vec2::new(14.5, 21.0), 13.5))).collect()
}

/// Names and outlines.
pub fn all() -> Vec<(&'static str, Vec<Vec2>)> {
    let umbrella = "-1.5,0 1.5,0 1.5,20 6,19 11,20 16,19 22,20 21,26 17,32 10,36 0,38 -10,36 -17,32 -21,26 \
                    -22,20 -16,19 -11,20 -6,19 -1.5,20";
    vec![
        (
            "swan",
            polygon(
                "-2,0 2,0 3,6 14,8 18,14 17,18 10,14 2,15 -4,20 -7,26 -5,31 -8,35 -13,34 -18,31 -13,30 \
                 -12,26 -12,18 -10,11 -5,7",
            ),
        ),
        ("heart", heart()),
        ("bottle", polygon("-9,0 9,0 9,22 3.5,28 3.5,40 -3.5,40 -3.5,28 -9,22")),
        ("star", star()),
        ("circle", circle()),
        ("crescent", crescent()),
        ("letter T", polygon("-4,0 4,0 4,26 16,26 16,35 -16,35 -16,26 -4,26")),
        (
            "letter S",
            polygon(
                "-4,0 8,0 14,6 14,16 8,22 -4,25 -5,28 -2,31 14,31 14,39 -6,39 -13,33 -13,23 -8,17 4,14 6,11 4,8 -4,8",
            ),
        ),
        ("figure eight", figure_eight()),
        ("umbrella", polygon(umbrella)),
    ]
}
