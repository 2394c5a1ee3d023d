//! Faces of many corners, cut into triangles.

use glam::{Vec2, Vec3};

/// Looks at corners that concave faces may take in all; beyond that they are cut as if they were convex.
const LOOKS: u64 = 500_000_000;

/// Cuts faces.
#[derive(Debug)]
pub(super) struct Cutter {
    looks_left: u64,
}

impl Default for Cutter {
    fn default() -> Self {
        Self { looks_left: LOOKS }
    }
}

impl Cutter {
    /// The triangles of a face with corners at these places, as numbers of its corners; they go around as it does.
    pub(super) fn cut(&mut self, places: &[Vec3], triangles: &mut Vec<[usize; 3]>) {
        triangles.clear();
        let mut left: Vec<usize> = (0..places.len()).collect();
        if let Some(flat) = flattened(places) {
            while left.len() > 3 {
                let Some(ear) = self.ear(&flat, &left) else { break };
                let before = left[(ear + left.len() - 1) % left.len()];
                triangles.push([before, left[ear], left[(ear + 1) % left.len()]]);
                left.remove(ear);
            }
        }
        // What is convex, and what no ear was found in.
        triangles.extend((2..left.len()).map(|i| [left[0], left[i - 1], left[i]]));
    }

    /// A corner that can be cut off, for nothing of the face lies in its triangle.
    fn ear(&mut self, flat: &[Vec2], left: &[usize]) -> Option<usize> {
        let count = left.len();
        (0..count).find(|&ear| {
            let [a, b, c] = [ear + count - 1, ear, ear + 1].map(|at| flat[left[at % count]]);
            self.looks_left = self.looks_left.saturating_sub(1);
            if self.looks_left == 0 || turn(a, b, c) <= 0.0 {
                return false;
            }
            let others = left.iter().map(|&other| flat[other]).filter(|other| ![a, b, c].contains(other));
            let mut looks = 0;
            let is_free = !others.inspect(|_| looks += 1).any(|other| {
                turn(a, b, other) >= 0.0 && turn(b, c, other) >= 0.0 && turn(c, a, other) >= 0.0
            });
            self.looks_left = self.looks_left.saturating_sub(looks);
            is_free
        })
    }
}

/// Twice the area of a triangle, positive where it goes around to the left.
fn turn(a: Vec2, b: Vec2, c: Vec2) -> f32 {
    (b - a).perp_dot(c - a)
}

/// A concave face as it is seen from its front; nothing for one that is convex, or has no front.
fn flattened(places: &[Vec3]) -> Option<Vec<Vec2>> {
    if places.len() < 4 {
        return None;
    }
    let next = |i: usize| places[(i + 1) % places.len()];
    // Measured from a corner, so that far places lose no digits.
    let normal: Vec3 =
        places.iter().enumerate().map(|(i, &place)| (place - places[0]).cross(next(i) - places[0])).sum();
    let corner = |i: usize| (next(i) - places[i]).cross(next(i + 1) - next(i)).dot(normal);
    if (0..places.len()).all(|i| corner(i) >= 0.0) {
        return None;
    }
    let away = normal.abs();
    let largest = away.max_element();
    if !largest.is_finite() || largest == 0.0 {
        return None;
    }
    // Along the axis that it faces most.
    let (side, sign): (fn(Vec3) -> Vec2, f32) = if away.x == largest {
        (|place| Vec2::new(place.y, place.z), normal.x)
    } else if away.y == largest {
        (|place| Vec2::new(place.z, place.x), normal.y)
    } else {
        (|place| Vec2::new(place.x, place.y), normal.z)
    };
    let mirror = if sign < 0.0 { Vec2::new(-1.0, 1.0) } else { Vec2::ONE };
    Some(places.iter().map(|&place| side(place - places[0]) * mirror).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(places: &[Vec3]) -> Vec<[usize; 3]> {
        let mut triangles = Vec::new();
        Cutter::default().cut(places, &mut triangles);
        triangles
    }

    fn area(places: &[Vec3], triangles: &[[usize; 3]]) -> f32 {
        let normal = |&corners: &[usize; 3]| {
            let [a, b, c] = corners.map(|corner| places[corner]);
            0.5 * (b - a).cross(c - a)
        };
        triangles.iter().map(|corners| normal(corners).length()).sum()
    }

    #[test]
    fn convex_faces_are_fans() {
        let square = [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y];
        assert_eq!(cut(&square[..3]), [[0, 1, 2]]);
        assert_eq!(cut(&square), [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(cut(&square[..2]), [[0; 3]; 0]);
    }

    #[test]
    fn concave_faces_are_covered_once_whichever_way_they_face() {
        // An L of three squares, of which a fan from its first corner would cover more.
        let outline = [[2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0], [0.0, 0.0]];
        let planes: [fn([f32; 2]) -> Vec3; 3] =
            [|[u, v]| Vec3::new(u, v, 5.0), |[u, v]| Vec3::new(5.0, u, v), |[u, v]| Vec3::new(v, -3.0, u)];
        for place in planes {
            for first in 0..outline.len() {
                let mut places: Vec<Vec3> =
                    (0..outline.len()).map(|i| place(outline[(i + first) % outline.len()])).collect();
                for _ in 0..2 {
                    let triangles = cut(&places);
                    assert_eq!(triangles.len(), 4);
                    assert!((area(&places, &triangles) - 3.0).abs() < 1e-5, "{places:?} {triangles:?}");
                    places.reverse();
                }
            }
        }
    }

    #[test]
    fn faces_without_sense_are_cut_into_as_many() {
        let bow = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::X + Vec3::Y];
        let line = [Vec3::ZERO, Vec3::X, 2.0 * Vec3::X, Vec3::X, 3.0 * Vec3::X];
        let far = [Vec3::ZERO, Vec3::X * 3e38, Vec3::splat(-3e38), Vec3::Y * 3e38, Vec3::Z];
        for places in [&bow[..], &line, &far, &[Vec3::ONE; 7]] {
            let triangles = cut(places);
            assert_eq!(triangles.len(), places.len() - 2);
            assert!(triangles.iter().flatten().all(|&corner| corner < places.len()));
        }
        let mut tired = Cutter { looks_left: 3 };
        let mut triangles = Vec::new();
        let comb: Vec<Vec3> = (0..50).map(|i| Vec3::new(i as f32, (i % 2 * 9) as f32, 0.0)).collect();
        tired.cut(&comb, &mut triangles);
        assert_eq!(triangles.len(), 48, "it comes to an end");
    }
}
