//! What is drawn: paths of strokes, and outlines 36 internodes tall that stand on the ground.

use core::f32::consts::{FRAC_PI_2, PI, TAU};

use glam::{Vec2, Vec3};

/// Height of the trunk at whose top strokes begin.
pub const TRUNK: f32 = 10.0;
/// Height of the outlines.
pub const HEIGHT: f32 = 36.0;

fn curve<P>(points: u16, at: impl Fn(f32) -> P) -> Vec<P> {
    (0..=points).map(|i| at(f32::from(i) / f32::from(points))).collect()
}

fn unit(angle: f32) -> Vec2 {
    let (sin, cos) = libm::sincosf(angle);
    Vec2::new(cos, sin)
}

/// Paths of strokes from the top of the trunk, by name.
pub fn strokes() -> Vec<(&'static str, Vec<Vec3>)> {
    let top = Vec3::Y * TRUNK;
    let points = |points: &[[f32; 3]]| points.iter().map(|&p| top + Vec3::from_array(p)).collect::<Vec<_>>();
    let s = curve(60, |t| top + Vec3::new(7.0 * libm::sinf(TAU * t), 28.0 * t, 0.0));
    let turn = |t: f32| unit(TAU * t - FRAC_PI_2) * 8.0 + Vec2::Y * 8.0;
    let loop_ = curve(60, |t| top + turn(0.95 * t).extend(0.0));
    let helix = curve(120, |t| {
        let around = (unit(2.0 * TAU * t) - Vec2::X) * 6.0;
        top + Vec3::new(around.x, 24.0 * t, around.y)
    });
    vec![
        ("line", points(&[[0.0; 3], [8.0, 24.0, 0.0]])),
        ("S", s),
        ("loop", loop_),
        ("helix", helix),
        ("down", points(&[[0.0; 3], [3.0, 0.0, 0.0], [12.0, -9.0, 0.0]])),
        ("back", points(&[[0.0; 3], [14.0, 3.0, 0.0], [15.0, 7.0, 2.0], [-8.0, 9.0, 5.0]])),
        ("level", points(&[[0.0; 3], [24.0, 0.0, 0.0]])),
    ]
}

/// The corners of a polygon, "x,y x,y …".
fn polygon(corners: &str) -> Vec<Vec2> {
    let point = |pair: &str| {
        let (x, y) = pair.split_once(',').expect("a pair");
        Vec2::new(x.parse().expect("a number"), y.parse().expect("a number"))
    };
    corners.split_whitespace().map(point).collect()
}

/// A band along a circle's arc.
fn band(centre: Vec2, [inner, outer]: [f32; 2], [from, to]: [f32; 2]) -> Vec<Vec2> {
    let arc =
        |radius: f32, from: f32, to: f32| curve(72, move |t| centre + unit(from + (to - from) * t) * radius);
    [arc(outer, from, to), arc(inner, to, from)].concat()
}

/// Two discs and the neck between them.
fn dumbbell() -> Vec<Vec2> {
    let half_gap = libm::asinf(1.75 / 9.0);
    let upper =
        curve(48, |t| Vec2::Y * 27.0 + unit(-FRAC_PI_2 + half_gap + (TAU - 2.0 * half_gap) * t) * 9.0);
    let lower = curve(48, |t| Vec2::Y * 9.0 + unit(FRAC_PI_2 + half_gap + (TAU - 2.0 * half_gap) * t) * 9.0);
    let stretch = |p: Vec2| if p.y > 18.0 { p + Vec2::Y * 2.0 } else { p - Vec2::Y * 2.0 };
    [upper, lower].concat().into_iter().map(|p| (stretch(p) + Vec2::Y * 2.0) * 0.9).collect()
}

fn heart() -> Vec<Vec2> {
    let heart = curve(96, |t| {
        let [one, two, three, four] = [1.0, 2.0, 3.0, 4.0].map(|n| libm::cosf(n * TAU * t));
        let sin = libm::sinf(TAU * t);
        Vec2::new(16.0 * sin * sin * sin, 13.0 * one - 5.0 * two - 2.0 * three - four + 17.0)
    });
    heart.into_iter().map(|p| p * HEIGHT / 28.94).collect()
}

fn star() -> Vec<Vec2> {
    let corner = |i: u8| {
        let radius = if i.is_multiple_of(2) { 19.9 } else { 8.5 };
        unit(FRAC_PI_2 + f32::from(i) * TAU / 10.0) * radius + Vec2::Y * 16.1
    };
    (0..10).map(corner).collect()
}

/// Names and outlines.
pub fn outlines() -> Vec<(&'static str, Vec<Vec2>)> {
    let middle = Vec2::Y * 18.0;
    let whole = [-FRAC_PI_2, TAU - FRAC_PI_2];
    let mut hook = polygon("-9,36");
    hook.extend(curve(48, |t| Vec2::new(0.0, 9.0) + unit(PI + PI * t) * 9.0));
    hook.extend(polygon("9,15 4,15"));
    hook.extend(curve(48, |t| Vec2::new(0.0, 9.0) + unit(-PI * t) * 4.0));
    hook.extend(polygon("-4,36"));
    vec![
        (
            "cat",
            polygon(
                "-9,0 8,0 12,1 18,3 19,8 18,14 16,18 13,17 15,13 16,8 15,6 11,5 10,12 7,18 6,22 8,26 8,31 6,36 3,32 \
                 -2,32 -5,36 -7,31 -7,26 -4,22 -6,16 -9,8",
            ),
        ),
        ("dumbbell", dumbbell()),
        ("T", polygon("-3,0 3,0 3,29 15,29 15,36 -15,36 -15,29 -3,29")),
        ("E", polygon("-10,0 12,0 12,5 -4,5 -4,15.5 9,15.5 9,20.5 -4,20.5 -4,31 12,31 12,36 -10,36")),
        ("hook", hook),
        ("bar", polygon("-2,0 2,0 10,36 6,36")),
        ("star", star()),
        (
            "R",
            polygon(
                "-10,0 -4,0 -4,14 0,14 7,0 14,0 6,15 10,18 12,23 12,28 10,33 5,36 -10,36 -4,30.5 3,30.5 6,28 6,23 \
                 3,19.5 -4,19.5 -4,30.5 -10,36",
            ),
        ),
        ("crescent", {
            let outer = curve(48, |t| Vec2::Y * 18.0 + unit(0.2 * TAU + 0.6 * TAU * t) * 18.9);
            let inner = curve(48, |t| Vec2::new(7.0, 18.0) + unit(0.76 * TAU - 0.52 * TAU * t) * 15.5);
            [outer, inner].concat().into_iter().map(|p| p + Vec2::X * 10.0).collect()
        }),
        ("ring", band(middle, [9.0, 18.0], whole)),
        ("thin ring", band(middle, [14.0, 18.0], whole)),
        ("heart", heart()),
        ("square", polygon("-18,0 18,0 18,36 -18,36")),
    ]
}
