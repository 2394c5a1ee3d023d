//! What envelopes hold, and what is no envelope.

use core::f32::consts::{PI, TAU};

use super::*;
use crate::random::{Draw, Purpose};

const FRONT: Plane = Plane { origin: Vec3::new(0.0, 40.0, 0.0), right: Vec3::X, up: Vec3::Y };

fn circle(centre: Vec2, radius: f32, points: usize) -> Vec<Vec2> {
    (0..points)
        .map(|i| {
            let (sin, cos) = libm::sincosf(i as f32 * TAU / points as f32);
            centre + Vec2::new(cos, sin) * radius
        })
        .collect()
}

fn rectangle(low: Vec2, high: Vec2) -> Vec<Vec2> {
    vec![low, Vec2::new(high.x, low.y), high, Vec2::new(low.x, high.y)]
}

fn inflate(outline: &[Vec2]) -> Envelope {
    Envelope::inflate(outline, FRONT, 1.0, 1.5).expect("a lasso")
}

fn at(x: f32, y: f32, depth: f32) -> Vec3 {
    FRONT.origin + Vec3::new(x, y, depth)
}

fn check_volume(name: &str, found: f64, expected: f32, tolerance: f64) {
    let off = found / f64::from(expected) - 1.0;
    assert!(off.abs() < tolerance, "{name}: {found} against {expected}");
}

#[test]
fn a_disc_inflates_to_a_ball() {
    for radius in [2.0, 10.0, 35.0] {
        let ball = inflate(&circle(Vec2::new(3.0, -2.0), radius, 400));
        check_volume("ball", ball.volume(), 4.0 / 3.0 * PI * radius * radius * radius, 0.03);
        let deepest = ball.height.iter().fold(0.0f32, |a, &b| a.max(b));
        assert!((deepest / radius - 1.0).abs() < 0.02, "{deepest} of {radius}");
    }
}

#[test]
fn a_rectangle_inflates_to_a_pill_of_its_width() {
    let long = inflate(&rectangle(Vec2::new(-20.0, -4.0), Vec2::new(20.0, 4.0)));
    // A cylinder and two ends, which are fuller than half balls: the corners hold smaller ones.
    let cylinder = PI * 16.0 * 32.0;
    let ball = 4.0 / 3.0 * PI * 64.0;
    assert!(long.volume() > f64::from(cylinder + ball) * 0.96);
    assert!(long.volume() < f64::from(cylinder + 1.4 * ball));
    assert!(long.contains(at(0.0, 0.0, 3.8)) && !long.contains(at(0.0, 0.0, 4.1)));
    assert!(long.contains(at(0.0, 3.0, 2.45)) && !long.contains(at(0.0, 3.0, 2.8)));
}

#[test]
fn flatter_by_the_depth_factor() {
    let outline = circle(Vec2::ZERO, 10.0, 100);
    let flat = Envelope::inflate(&outline, FRONT, 0.5, 1.5).expect("a lasso");
    check_volume("flat", 2.0 * flat.volume(), inflate(&outline).volume() as f32, 1e-6);
    assert!(flat.contains(at(0.0, 0.0, 4.8)) && !flat.contains(at(0.0, 0.0, 5.2)));
}

#[test]
fn an_annulus_keeps_its_hole() {
    // One stroke around outside, then inside: even-odd leaves the middle empty.
    let mut outline = circle(Vec2::ZERO, 20.0, 200);
    outline.push(Vec2::X * 20.0);
    outline.extend(circle(Vec2::ZERO, 10.0, 200));
    outline.push(Vec2::X * 10.0);
    let ring = inflate(&outline);
    let torus = 2.0 * PI * PI * 15.0 * 25.0;
    check_volume("torus", ring.volume(), torus, 0.03);
    assert!(!ring.contains(at(0.0, 0.0, 0.0)) && !ring.contains(at(8.0, 0.0, 0.0)));
    assert!(ring.contains(at(-15.0, 0.0, 4.8)) && !ring.contains(at(-15.0, 0.0, 5.3)));
}

#[test]
fn a_figure_eight_has_two_lobes() {
    let eight: Vec<Vec2> = (0..400)
        .map(|i| {
            let (sin, cos) = libm::sincosf(i as f32 * TAU / 400.0);
            Vec2::new(20.0 * sin, 16.0 * sin * cos)
        })
        .collect();
    let lobes = inflate(&eight);
    assert!(lobes.contains(at(14.0, 0.0, 4.0)) && lobes.contains(at(-14.0, 0.0, 4.0)));
    assert!(!lobes.contains(at(0.0, 6.0, 0.0)));
}

#[test]
fn an_open_outline_closes_with_a_line() {
    let half: Vec<Vec2> = circle(Vec2::ZERO, 20.0, 200).into_iter().filter(|p| p.y >= 0.0).collect();
    let dome = inflate(&half);
    assert!(dome.contains(at(0.0, 10.0, 0.0)) && !dome.contains(at(0.0, -1.0, 0.0)));
}

#[test]
fn the_silhouette_is_the_mask() {
    let mut star = Vec::new();
    for i in 0..10 {
        let (sin, cos) = libm::sincosf(i as f32 * TAU / 10.0);
        star.push(Vec2::new(cos, sin) * if i % 2 == 0 { 30.0 } else { 12.0 });
    }
    for outline in [star, circle(Vec2::ZERO, 9.0, 60), rectangle(Vec2::ZERO, Vec2::new(40.0, 9.0))] {
        // Radius 0 widens nothing.
        let mask = Mask::fill(&outline, 0.0, RESOLUTION);
        let body = Envelope::inflate(&outline, FRONT, 1.0, 0.0).expect("a lasso");
        let mismatch = mask.inside.iter().zip(&body.height).filter(|(inside, z)| **inside != (**z > 0.0));
        assert_eq!(mismatch.count(), 0);
        // The deepest place is the centre of the largest inscribed disc.
        let widest = mask.depth().values.iter().fold(0.0f32, |a, &b| a.max(b)).sqrt() - 0.5;
        let deepest = body.height.iter().fold(0.0f32, |a, &b| a.max(b)) / body.pixel;
        assert!((widest - deepest).abs() < 1e-3, "{widest} {deepest}");
    }
}

#[test]
fn narrow_parts_are_widened_and_wide_ones_kept() {
    // A lollipop: a disc of radius 12 on a stick 0.3 wide.
    let mut outline: Vec<Vec2> =
        circle(Vec2::Y * 30.0, 12.0, 360).into_iter().filter(|p| p.y > 18.02 || p.x.abs() > 0.2).collect();
    let split = outline.iter().position(|p| p.y < 18.05 && p.x > -0.5).unwrap_or(270);
    outline.rotate_left(split);
    outline.insert(0, Vec2::new(0.15, 0.0));
    outline.push(Vec2::new(-0.15, 0.0));
    let plain = Envelope::inflate(&outline, FRONT, 1.0, 0.0).expect("a lasso");
    let widened = Envelope::inflate(&outline, FRONT, 1.0, 2.0).expect("a lasso");
    for x in [-0.6, 0.6] {
        assert!(!plain.contains(at(x, 9.0, 0.0)) && widened.contains(at(x, 9.0, 0.0)));
    }
    assert!(widened.contains(at(0.0, 9.0, 0.6)) && !widened.contains(at(1.5, 9.0, 0.0)));
    assert!(!widened.contains(at(12.6, 30.0, 0.0)), "the disc keeps its outline");
}

#[test]
fn degenerate_lassos_are_named() {
    let check = |outline: &[Vec2]| Envelope::inflate(outline, FRONT, 1.0, 1.5).err();
    let line: Vec<Vec2> = (0..50).map(|i| Vec2::splat(i as f32)).collect();
    assert_eq!(check(&[]), Some(LassoError::TooFewPoints(0)));
    assert_eq!(check(&[Vec2::ONE; 9]), Some(LassoError::TooFewPoints(1)));
    assert_eq!(check(&[Vec2::ONE, Vec2::X, Vec2::ONE]), Some(LassoError::TooFewPoints(2)));
    assert_eq!(check(&line), Some(LassoError::NoArea));
    let level = [Vec2::ZERO, Vec2::X * 5.0, Vec2::X * 9.0];
    assert_eq!(check(&level), Some(LassoError::NoArea));
    assert_eq!(check(&circle(Vec2::ZERO, 1e-4, 9)), Some(LassoError::NoArea));
    let mut there_and_back = circle(Vec2::ZERO, 9.0, 40);
    there_and_back.extend(there_and_back.clone().into_iter().rev());
    assert_eq!(check(&there_and_back), Some(LassoError::NoArea));
    assert_eq!(check(&[Vec2::ZERO, Vec2::X, Vec2::NAN]), Some(LassoError::NotFinite("outline")));
    assert_eq!(
        check(&[Vec2::ZERO, Vec2::X, Vec2::splat(f32::INFINITY)]),
        Some(LassoError::NotFinite("outline"))
    );
    assert!(matches!(check(&circle(Vec2::ZERO, 1e5, 9)), Some(LassoError::OutOfWorld(_))));
    assert!(matches!(check(&[Vec2::ZERO, Vec2::X, Vec2::splat(3e38)]), Some(LassoError::OutOfWorld(_))));
    assert_eq!(check(&vec![Vec2::ONE; MAX_OUTLINE + 1]), Some(LassoError::TooManyPoints(MAX_OUTLINE + 1)));
}

#[test]
fn planes_and_depths_must_make_sense() {
    let outline = circle(Vec2::ZERO, 9.0, 40);
    let on = |plane| Envelope::inflate(&outline, plane, 1.0, 1.5).err();
    assert_eq!(on(Plane { up: Vec3::X, ..FRONT }), Some(LassoError::NotOrthonormal));
    assert_eq!(on(Plane { right: Vec3::X * 2.0, ..FRONT }), Some(LassoError::NotOrthonormal));
    assert_eq!(on(Plane { origin: Vec3::NAN, ..FRONT }), Some(LassoError::NotFinite("drawing plane")));
    for depth in [0.0, -1.0, f32::NAN, 1e9] {
        let refused = Envelope::inflate(&outline, FRONT, depth, 1.5);
        assert!(matches!(refused, Err(LassoError::DepthFactor(_))), "{depth}");
    }
}

#[test]
fn scribbles_and_long_outlines_inflate() {
    let draw = Draw::new(5, Purpose::Lasso, 0, 0);
    let scribble: Vec<Vec2> =
        (0..2000).map(|i| 30.0 * Vec2::new(draw.unit(2 * i), draw.unit(2 * i + 1))).collect();
    assert!(inflate(&scribble).volume() > 0.0);
    let fine = inflate(&circle(Vec2::ZERO, 30.0, MAX_OUTLINE));
    check_volume("fine", fine.volume(), 4.0 / 3.0 * PI * 27000.0, 0.03);
}

/// Where markers are laid, of so many in all, by one who comes so near.
fn places(envelope: &Envelope, count: usize, near: Vec3, reach: f32) -> Vec<Vec3> {
    let mut places = Vec::new();
    let mut sowing = Sowing::new(envelope, count, Draw::new(1, Purpose::Lasso, 2, 3));
    sowing.come_near(envelope, near, reach, |place| places.push(place));
    places
}

#[test]
fn all_markers_within_reach_are_laid_and_each_once() {
    let ball = inflate(&circle(Vec2::new(0.0, 30.0), 20.0, 200));
    let at = Vec3::new(12.0, 65.0, 3.0);
    let (all, some) = (places(&ball, 8000, at, 99.0), places(&ball, 8000, at, 4.0));
    let near: Vec<Vec3> = all.iter().copied().filter(|place| place.distance(at) <= 4.0).collect();
    assert!(near.len() > 20 && near.iter().all(|place| some.contains(place)));
    assert!(some.len() * 4 < all.len() && some.iter().all(|place| all.contains(place)));
    let mut sowing = Sowing::new(&ball, 8000, Draw::new(1, Purpose::Lasso, 2, 3));
    let mut count = 0;
    for x in -25..25i16 {
        (45..95i16)
            .for_each(|y| sowing.come_near(&ball, Vec3::new(x.into(), y.into(), 0.0), 2.0, |_| count += 1));
    }
    assert_eq!(count, 8000);
}

#[test]
fn what_would_take_too_much_wood_is_made_flatter() {
    let square = [Vec2::ZERO, Vec2::X * 40.0, Vec2::splat(40.0), Vec2::Y * 40.0];
    let body = inflate(&square);
    let flat = body.clone().filled_by(2000);
    assert_eq!(body.clone().filled_by(1_000_000), body);
    assert!(flat.volume() < 0.4 * body.volume());
    let middle = Vec3::new(20.0, 60.0, 0.0);
    assert!(
        flat.contains(middle)
            && !flat.contains(middle + 9.0 * Vec3::Z)
            && body.contains(middle + 9.0 * Vec3::Z)
    );
    // A flat body's nodes lie as far apart as those of a deep one.
    let shallow = Envelope::inflate(&square, FRONT, 0.1, 1.5).expect("a lasso");
    assert_eq!(shallow.zone_at(middle), body.zone_at(middle));
}

#[test]
fn places_fill_the_body_evenly() {
    let tilted = Plane { origin: Vec3::Y * 50.0, right: Vec3::new(0.6, 0.0, 0.8), up: Vec3::Y };
    let ball = Envelope::inflate(&circle(Vec2::ZERO, 20.0, 200), tilted, 1.0, 1.5).expect("a lasso");
    let places = places(&ball, 8000, tilted.origin, 99.0);
    assert_eq!(places.len(), 8000);
    assert!(places.iter().all(|&place| ball.contains(place)));
    // Half the radius holds an eighth of a ball, and each octant too.
    let from_middle = |place: &Vec3| *place - tilted.origin;
    let inner = places.iter().filter(|place| from_middle(place).length() < 10.0).count();
    assert!((900..1100).contains(&inner), "{inner}");
    for octant in 0..8 {
        let sign = |bit: i32| if octant >> bit & 1 == 0 { 1.0 } else { -1.0 };
        let signs = Vec3::new(sign(0), sign(1), sign(2));
        let count = places.iter().filter(|place| (from_middle(place) * signs).min_element() > 0.0).count();
        assert!((920..1080).contains(&count), "octant {octant}: {count}");
    }
}

#[test]
fn the_same_outline_gives_the_same_body() {
    let outline = circle(Vec2::ZERO, 20.0, 200);
    assert_eq!(inflate(&outline), inflate(&outline));
    let all = || places(&inflate(&outline), 100, Vec3::ZERO, 99.0);
    assert_eq!(all(), all());
}

/// A ball of radius 20 whose middle lies 12 internodes in front of the plane.
fn ball_in_front() -> Envelope {
    let column = |at: Vec2| {
        let half = 400.0 - at.length_squared();
        (half > 0.0).then(|| (12.0 - half.sqrt(), 12.0 + half.sqrt()))
    };
    Envelope::solid(FRONT, (Vec2::splat(-20.5), Vec2::splat(20.5)), 1.5, column).expect("a body")
}

#[test]
fn a_solid_body_lies_where_its_columns_do() {
    let ball = ball_in_front();
    check_volume("ball", ball.volume(), 4.0 / 3.0 * PI * 8000.0, 0.03);
    assert!(ball.contains(at(0.0, 0.0, 31.5)) && !ball.contains(at(0.0, 0.0, 32.5)));
    assert!(ball.contains(at(0.0, 0.0, -7.5)) && !ball.contains(at(0.0, 0.0, -8.5)));
    let places = places(&ball, 2000, FRONT.origin, 99.0);
    assert_eq!(places.len(), 2000);
    let middle = FRONT.origin + Vec3::Z * 12.0;
    assert!(places.iter().all(|place| ball.contains(*place) && place.distance(middle) < 20.5));
    let inner = places.iter().filter(|place| place.distance(middle) < 10.0).count();
    assert!((215..285).contains(&inner), "an eighth of a ball lies within half its radius: {inner}");
    let limbs = ball.limbs(FRONT.origin);
    assert!(limbs.iter().flatten().all(|sample| (sample.position.z - 12.0).abs() < 0.01));
}

#[test]
fn a_solid_body_has_an_inside_within_the_world() {
    let solid = |column: fn(Vec2) -> Option<(f32, f32)>, half: f32| {
        Envelope::solid(FRONT, (Vec2::splat(-half), Vec2::splat(half)), 1.5, column).err()
    };
    assert_eq!(solid(|_| None, 9.0), Some(LassoError::NoArea));
    assert_eq!(solid(|_| Some((1.0, 1.0)), 9.0), Some(LassoError::NoArea));
    assert!(matches!(solid(|_| Some((0.0, 2000.0)), 9.0), Some(LassoError::OutOfWorld(_))));
    assert_eq!(solid(|_| Some((0.0, 1.0)), f32::NAN), Some(LassoError::NotFinite("box around the body")));
    let askew = Plane { up: Vec3::X, ..FRONT };
    let refused = Envelope::solid(askew, (Vec2::ZERO, Vec2::ONE), 1.5, |_| Some((0.0, 1.0)));
    assert_eq!(refused.err(), Some(LassoError::NotOrthonormal));
}
