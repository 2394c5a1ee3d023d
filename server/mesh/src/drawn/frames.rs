//! Vectors across the wood of each row that do not twist along a limb: each follows from the one below by double reflection
//! (Wang et al. 2008). A limb takes its first one from what bears it, so that bark turns with its bearer's. Clients turn
//! their bark in the same way (`client/src/scene/table/node-orientations.ts`).

use glam::Vec3;

const SHORTEST: f32 = 1e-6;
/// A vector with less of itself than this across an axis, squared, says nothing about which way is across.
const LEAST_ACROSS: f32 = 1e-4;

/// Any unit vector across a direction.
pub(super) fn any(direction: Vec3) -> Vec3 {
    let helper = if direction.x.abs() < 0.8 { Vec3::X } else { Vec3::Z };
    helper.reject_from_normalized(direction).normalize_or(Vec3::X)
}

/// The vector nearest to `normal` that lies across a direction.
pub(super) fn across(normal: Vec3, direction: Vec3) -> Vec3 {
    let across = normal - direction.dot(normal) * direction;
    if across.length_squared() < LEAST_ACROSS { any(direction) } else { across.normalize() }
}

/// What a vector across `from` becomes at a place `step` farther, where the way is `to`: mirrored first across the plane
/// between the places, then across the one between the directions.
pub(super) fn transported(normal: Vec3, step: Vec3, [from, to]: [Vec3; 2]) -> Vec3 {
    let squared = step.length_squared();
    if squared < SHORTEST * SHORTEST {
        return normal;
    }
    let mirror = |vector: Vec3, by: Vec3, squared: f32| vector - (2.0 / squared) * by.dot(vector) * by;
    let (normal, from) = (mirror(normal, step, squared), mirror(from, step, squared));
    let turn = to - from;
    let squared = turn.length_squared();
    if squared < SHORTEST * SHORTEST { normal } else { mirror(normal, turn, squared) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn along(places: &[(Vec3, Vec3)], first: Vec3) -> Vec<Vec3> {
        let mut normals = vec![first];
        for pair in places.windows(2) {
            let [(from, out), (to, on)] = [pair[0], pair[1]];
            let normal = transported(normals[normals.len() - 1], to - from, [out, on]);
            normals.push(across(normal, on));
        }
        normals
    }

    #[test]
    fn flat_arc_keeps_its_binormal() {
        let arc: Vec<(Vec3, Vec3)> = (0..=20)
            .map(|i| {
                let (sin, cos) = libm::sincosf(i as f32 * 0.1);
                (Vec3::new(sin, 1.0 - cos, 0.0), Vec3::new(cos, sin, 0.0))
            })
            .collect();
        for normal in along(&arc, Vec3::Z) {
            assert!(normal.distance(Vec3::Z) < 1e-5);
        }
    }

    #[test]
    fn helix_turns_back_by_its_torsion() {
        // On a helix of radius 1 and rise 1 a turn (in radians) torsion is 1/2: the normal falls behind the
        // curve's own normal by 1/2 radian per unit of length, and a unit of angle is √2 long.
        let place = |i: u32| {
            let angle = i as f32 * 0.01;
            let (sin, cos) = libm::sincosf(angle);
            let tangent = Vec3::new(-sin, cos, 1.0) / std::f32::consts::SQRT_2;
            ((Vec3::new(cos, sin, angle), tangent), Vec3::new(-cos, -sin, 0.0))
        };
        let count = 200;
        let places: Vec<(Vec3, Vec3)> = (0..=count).map(|i| place(i).0).collect();
        let normals = along(&places, place(0).1);
        let fallen = normals[count as usize].angle_between(place(count).1);
        assert!((fallen - 2.0 * std::f32::consts::FRAC_1_SQRT_2).abs() < 1e-3, "{fallen}");
    }

    #[test]
    fn what_lies_along_the_way_gives_any_vector_across() {
        for direction in [Vec3::X, Vec3::Y, Vec3::Z] {
            assert!(across(direction, direction).dot(direction).abs() < 1e-6);
        }
    }
}
