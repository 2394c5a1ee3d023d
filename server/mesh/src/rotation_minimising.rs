//! Normals along a curve that do not twist around it (a rotation-minimising frame): each is turned by the least rotation
//! that takes one tangent to the next. A step that leaves askew, as at the foot of a branch, does not disturb them.

use glam::{Quat, Vec3};

/// The first vector across each of the places, which are given by their unit tangents; `first` is any vector that is not
/// along the first tangent.
pub(crate) fn normals(tangents: impl IntoIterator<Item = Vec3>, first: Vec3) -> Vec<Vec3> {
    let mut normals = Vec::new();
    let mut last: Option<(Vec3, Vec3)> = None;
    for tangent in tangents {
        let carried = last.map_or(first, |(t, normal)| Quat::from_rotation_arc(t, tangent) * normal);
        // Rounding tilts the normal a little each time; it is set upright before the tilt adds up.
        let normal = carried
            .reject_from_normalized(tangent)
            .try_normalize()
            .unwrap_or_else(|| tangent.any_orthonormal_vector());
        normals.push(normal);
        last = Some((tangent, normal));
    }
    normals
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flat_arc_keeps_its_binormal() {
        let arc = (0..=20).map(|i| {
            let angle = i as f32 * 0.1;
            Vec3::new(libm::cosf(angle), libm::sinf(angle), 0.0)
        });
        for normal in normals(arc, Vec3::Z) {
            assert!(normal.distance(Vec3::Z) < 1e-5);
        }
    }

    #[test]
    fn helix_turns_back_by_its_torsion() {
        // On a helix of radius 1 and rise 1 a turn (in radians) torsion is 1/2: the normal falls behind the
        // curve's own normal by 1/2 radian per unit of length, and a unit of angle is √2 long.
        let place = |i: u32| {
            let angle = i as f32 * 0.01;
            let (s, c) = (libm::sinf(angle), libm::cosf(angle));
            (Vec3::new(-s, c, 1.0) / std::f32::consts::SQRT_2, Vec3::new(-c, -s, 0.0))
        };
        let count = 200;
        let normals = normals((0..=count).map(|i| place(i).0), place(0).1);
        let (_, own) = place(count);
        let fallen = normals[count as usize].angle_between(own);
        assert!((fallen - 2.0 * std::f32::consts::FRAC_1_SQRT_2).abs() < 1e-3, "{fallen}");
    }
}
