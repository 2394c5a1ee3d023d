//! Walls, rocks and houses in front.

use glam::DVec3;

use super::{RECOVERY, solids::Solid};
use crate::wood::Wood;

/// Rays that look for obstacles, within this angle (radians) upwind, over so many of their heights.
const RAYS: usize = 8;
const CONE: f64 = 10.0 * std::f64::consts::PI / 180.0;
const REACH: f64 = 6.0;
/// The most that an obstacle takes of the speed.
const TAKEN: f64 = 0.8;
const GOLDEN_ANGLE: f64 = 2.399_963_23;
/// Rows within a cube with edges of so many metres share what they get, and cubes grow by this until there are few enough.
const EDGE: f64 = 0.25;
const GROWS: f64 = 1.25;
const MOST_CUBES: f64 = 1024.0;

/// The share of the open wind's speed that each row gets past obstacles. What it costs is bounded by the number of cubes in
/// which rows are, whatever there is of them: rays are asked for once in each, where the drag of its rows acts.
pub(super) fn behind_obstacles(wood: &Wood, along: DVec3, solids: &[Solid]) -> Vec<f64> {
    let mut shares = vec![1.0; wood.len()];
    let rows: Vec<usize> = (0..wood.len()).filter(|&row| wood.drag_area[row] > 0.0).collect();
    if rows.is_empty() || solids.is_empty() {
        return shares;
    }
    let (mut least, mut most) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for &row in &rows {
        least = least.min(wood.middle(row));
        most = most.max(wood.middle(row));
    }
    let counts = |edge: f64| ((most - least) / edge).floor() + 1.0;
    let mut edge = EDGE;
    while counts(edge).element_product() > MOST_CUBES {
        edge *= GROWS;
    }
    let count = counts(edge);
    let cube = |row: usize| {
        let at = ((wood.middle(row) - least) / edge).floor();
        ((at.x * count.y + at.y) * count.z + at.z) as usize
    };
    let mut cubes = vec![(0.0, DVec3::ZERO); count.element_product() as usize];
    for &row in &rows {
        let (area, moment) = &mut cubes[cube(row)];
        *area += wood.drag_area[row];
        *moment += wood.drag_area[row] * wood.middle(row);
    }
    let ways = ways(along);
    let share = |&(area, moment): &(f64, DVec3)| {
        if area > 0.0 { share_at(moment / area, along, &ways, solids) } else { 1.0 }
    };
    let reached: Vec<f64> = cubes.iter().map(share).collect();
    for &row in &rows {
        shares[row] = reached[cube(row)];
    }
    shares
}

/// The share of the open wind's speed at a place.
pub fn at_place(place: DVec3, along: DVec3, solids: &[Solid]) -> f64 {
    share_at(place, along, &ways(along), solids)
}

/// The ways of all rays.
fn ways(along: DVec3) -> [DVec3; RAYS] {
    let across = along.cross(DVec3::Y).try_normalize().unwrap_or(DVec3::Z);
    let upward = across.cross(along);
    std::array::from_fn(|ray| {
        let tilt = CONE * ((ray as f64 + 0.5) / RAYS as f64).sqrt();
        let (sin, cos) = libm::sincos(tilt);
        let (around_sin, around_cos) = libm::sincos(GOLDEN_ANGLE * ray as f64);
        -cos * along + sin * (around_cos * across + around_sin * upward)
    })
}

/// Of obstacles behind each other that one counts for a ray that shelters most.
fn share_at(place: DVec3, along: DVec3, ways: &[DVec3; RAYS], solids: &[Solid]) -> f64 {
    let mut shade = [0.0f64; RAYS];
    for solid in solids.iter().filter(|solid| may_shelter(solid, place, along)) {
        let height = solid.height();
        for (way, shade) in ways.iter().zip(&mut shade) {
            if let Some(distance) = first_along(solid, place, *way, REACH * height) {
                *shade = shade.max(libm::exp(-distance / (RECOVERY * height)));
            }
        }
    }
    1.0 - TAKEN * shade.iter().sum::<f64>() / RAYS as f64
}

/// How far away a ray meets an obstacle. It goes up again from the ground, below which no air flows.
fn first_along(solid: &Solid, place: DVec3, way: DVec3, reach: f64) -> Option<f64> {
    let first = solid.first(place, way, reach);
    if way.y >= 0.0 {
        return first;
    }
    let down = place.y.max(0.0) / -way.y;
    if first.is_some_and(|first| first <= down) || down >= reach {
        return first;
    }
    let up = DVec3::new(way.x, -way.y, way.z);
    Some(down + solid.first(place + down * way, up, reach - down)?)
}

/// Whether the ball around an obstacle is near enough, and meets the cone in which rays go.
fn may_shelter(solid: &Solid, place: DVec3, along: DVec3) -> bool {
    let (radius, way) = solid.seen_from(place);
    let upwind = -way.dot(along);
    let squared = way.dot(way);
    let aside = (squared - upwind * upwind).max(0.0).sqrt();
    // 0.18 is more than the tangent of the cone's angle, 1.02 more than one over its cosine.
    upwind > -radius
        && squared.sqrt() - radius < REACH * solid.height()
        && aside <= 0.18 * upwind.max(0.0) + 1.02 * radius
}
