//! Triangles in a tree of boxes, so that a ray looks at few of them.

use glam::{DVec3, Vec3};

/// Triangles of a leaf of the tree.
const LEAF: usize = 4;
/// Nodes that are still to be looked at, at most: a level has one of them, and there are not as many levels.
const DEEPEST: usize = 64;
/// Cells along each axis of the curve by which triangles are put in order.
const CELLS: f64 = 1024.0;
/// A triangle whose normal is nearer than 26° to the vertical is flat: land, and not a wall.
const FLAT: f64 = 0.9;

/// Triangles around their own origin, in the order of a space-filling curve, and the boxes around them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangles {
    corners: Vec<[Vec3; 3]>,
    /// Of node 1, which holds all; below node n are 2n and 2n + 1, and the second half are leaves.
    boxes: Vec<[Vec3; 2]>,
}

/// A ray in the axes of the triangles that it looks for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    pub from: DVec3,
    /// Of unit length.
    pub way: DVec3,
    /// What is farther does not count.
    pub reach: f64,
    /// The unit vector upwards.
    pub up: DVec3,
    /// Flat triangles count where this is exceeded along `up`, seen from the origin of the triangles.
    pub land: f64,
}

impl Triangles {
    /// Of the corners of each triangle; those that are not finite do not count.
    pub fn new(triangles: impl Iterator<Item = [Vec3; 3]>) -> Self {
        let corners: Vec<[Vec3; 3]> =
            triangles.filter(|corners| corners.iter().all(|corner| corner.is_finite())).collect();
        let middle = |corners: &[Vec3; 3]| corners.iter().map(|corner| corner.as_dvec3()).sum::<DVec3>();
        let (mut least, mut most) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for corners in &corners {
            least = least.min(middle(corners));
            most = most.max(middle(corners));
        }
        let size = most - least;
        let cell = |way: f64, size: f64| {
            if size > 0.0 { ((way / size * CELLS) as u32).min(CELLS as u32 - 1) } else { 0 }
        };
        let mut order: Vec<(u32, u32)> = corners
            .iter()
            .zip(0..)
            .map(|(corners, number)| {
                let way = middle(corners) - least;
                let [x, y, z] =
                    [cell(way.x, size.x), cell(way.y, size.y), cell(way.z, size.z)].map(spread_bits);
                (x | y << 1 | z << 2, number)
            })
            .collect();
        order.sort_unstable();
        let corners: Vec<[Vec3; 3]> = order.iter().map(|&(_, number)| corners[number as usize]).collect();
        let leaves = corners.len().div_ceil(LEAF).next_power_of_two();
        let mut boxes = vec![[Vec3::INFINITY, Vec3::NEG_INFINITY]; 2 * leaves];
        for (leaf, corners) in corners.chunks(LEAF).enumerate() {
            let around = &mut boxes[leaves + leaf];
            for &corner in corners.as_flattened() {
                *around = [around[0].min(corner), around[1].max(corner)];
            }
        }
        for node in (1..leaves).rev() {
            let [one, other] = [boxes[2 * node], boxes[2 * node + 1]];
            boxes[node] = [one[0].min(other[0]), one[1].max(other[1])];
        }
        Self { corners, boxes }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.corners.is_empty()
    }

    /// All corners.
    pub(super) fn corners(&self) -> impl Iterator<Item = DVec3> {
        self.corners.as_flattened().iter().map(|corner| corner.as_dvec3())
    }

    /// The box around all of them.
    pub(super) fn bounds(&self) -> [DVec3; 2] {
        self.boxes[1].map(Vec3::as_dvec3)
    }

    /// How far away a ray first meets one.
    pub(super) fn first(&self, ray: &Ray) -> Option<f64> {
        let leaves = self.boxes.len() / 2;
        let inverse = 1.0 / ray.way;
        let enters = |node: usize, reach: f64| enters(&self.boxes[node], ray.from, inverse, reach);
        let mut nearest = ray.reach;
        let mut is_met = false;
        let mut open = [(1, 0.0); DEEPEST];
        let mut count = usize::from(enters(1, nearest).is_some());
        while count > 0 {
            count -= 1;
            let (node, since) = open[count];
            if since > nearest {
                continue;
            }
            if node < leaves {
                let [one, other] = [2 * node, 2 * node + 1].map(|node| (node, enters(node, nearest)));
                // The nearer one is looked at first.
                let is_turned = one.1.zip(other.1).is_some_and(|(one, other)| one < other);
                for (node, since) in if is_turned { [other, one] } else { [one, other] } {
                    if let Some(since) = since {
                        open[count] = (node, since);
                        count += 1;
                    }
                }
                continue;
            }
            let first = LEAF * (node - leaves);
            for corners in &self.corners[first..self.corners.len().min(first + LEAF)] {
                if let Some(away) = meets(corners, ray).filter(|&away| away < nearest) {
                    nearest = away;
                    is_met = true;
                }
            }
        }
        is_met.then_some(nearest)
    }
}

/// Two zeros between each of ten bits and the next.
fn spread_bits(number: u32) -> u32 {
    let mut spread = number & 0x3ff;
    for (shift, mask) in [(16, 0x0300_00ff), (8, 0x0300_f00f), (4, 0x030c_30c3), (2, 0x0924_9249)] {
        spread = (spread | spread << shift) & mask;
    }
    spread
}

/// From where on a ray is in a box, if it is before it has come so far. Comparisons with what is not a number do not decide.
fn enters([low, high]: &[Vec3; 2], from: DVec3, inverse: DVec3, reach: f64) -> Option<f64> {
    let (mut enters, mut leaves) = (0.0, reach);
    for axis in 0..3 {
        let [mut near, mut far] = [f64::from(low[axis]), f64::from(high[axis])];
        if inverse[axis] < 0.0 {
            (near, far) = (far, near);
        }
        let [near, far] = [near, far].map(|side| (side - from[axis]) * inverse[axis]);
        if near > enters {
            enters = near;
        }
        if far < leaves {
            leaves = far;
        }
    }
    // Nothing is below an empty box, which is as if turned inside out.
    (enters <= leaves && low.x <= high.x).then_some(enters)
}

/// How far away a ray meets a triangle from either side (Möller and Trumbore).
fn meets(corners: &[Vec3; 3], ray: &Ray) -> Option<f64> {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let (one, other) = (b - a, c - a);
    let across = ray.way.cross(other);
    let size = one.dot(across);
    if size == 0.0 {
        return None;
    }
    let from = ray.from - a;
    let u = from.dot(across) / size;
    if !(0.0..=1.0).contains(&u) {
        return None;
    }
    let beside = from.cross(one);
    let v = ray.way.dot(beside) / size;
    if v < 0.0 || u + v > 1.0 {
        return None;
    }
    let away = other.dot(beside) / size;
    let normal = one.cross(other);
    let upwards = normal.dot(ray.up);
    let is_flat = upwards * upwards > FLAT * FLAT * normal.dot(normal);
    let is_land = is_flat && (ray.from + away * ray.way).dot(ray.up) < ray.land;
    (away > 0.0 && !is_land).then_some(away)
}

#[cfg(test)]
mod tests {
    use espalier_mesh::leaves::hash;

    use super::*;

    #[test]
    fn a_ray_meets_what_it_meets_where_all_triangles_are_tried() {
        let draw = |at: u32| f64::from(hash(at)) / f64::from(u32::MAX) - 0.5;
        let place = |at: u32, size: f64| size * DVec3::new(draw(3 * at), draw(3 * at + 1), draw(3 * at + 2));
        let all: Vec<[Vec3; 3]> = (0..3000)
            .map(|at| {
                [1, 2, 3].map(|corner| (place(at, 20.0) + place(9000 + 7 * at + corner, 4.0)).as_vec3())
            })
            .collect();
        let tree = Triangles::new(all.iter().copied());
        let mut met = 0;
        for at in 0..500 {
            let from = place(100_000 + at, 30.0);
            let way = if at % 5 == 0 { DVec3::NEG_X } else { place(200_000 + at, 1.0).normalize() };
            let ray = Ray { from, way, reach: 40.0, up: DVec3::Y, land: -1.0 };
            let nearest = all.iter().filter_map(|corners| meets(corners, &ray)).fold(40.0, f64::min);
            let found = tree.first(&ray);
            assert_eq!(found, (nearest < 40.0).then_some(nearest), "ray {at}");
            met += u32::from(found.is_some());
        }
        assert!(met > 200, "{met}");
    }

    #[test]
    fn few_triangles_and_none_are_a_tree_too() {
        let one = [Vec3::ZERO, Vec3::Y, Vec3::Z];
        let ray =
            |way: DVec3| Ray { from: DVec3::new(2.0, 0.2, 0.2), way, reach: 9.0, up: DVec3::Y, land: 0.0 };
        for count in [1, 3, 5, 9] {
            let tree = Triangles::new(std::iter::repeat_n(one, count));
            assert_eq!(tree.first(&ray(DVec3::NEG_X)), Some(2.0));
            assert_eq!(tree.first(&ray(DVec3::X)), None);
        }
        assert_eq!(Triangles::new(std::iter::empty()).first(&ray(DVec3::NEG_X)), None);
    }
}
