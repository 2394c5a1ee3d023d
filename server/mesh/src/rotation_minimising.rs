//! Frames along a curve that do not twist around it: the double reflection method (Wang et al. 2008).

use glam::Vec3;

/// Below this square of a length a reflection would divide by nothing; the frame then stays as it is.
const LEAST_SQUARE: f32 = 1e-12;

/// The first vector across each of the places, which are given as point and unit tangent; `first` is any vector
/// that is not along the first tangent.
pub(crate) fn normals(places: impl IntoIterator<Item = (Vec3, Vec3)>, first: Vec3) -> Vec<Vec3> {
    let mut normals = Vec::new();
    let mut last: Option<(Vec3, Vec3, Vec3)> = None;
    for (point, tangent) in places {
        let carried = last.map_or(first, |(p, t, normal)| carry(point - p, t, tangent, normal));
        // Rounding tilts the frame a little each time; it is set upright before the tilt adds up.
        let normal = carried
            .reject_from_normalized(tangent)
            .try_normalize()
            .unwrap_or_else(|| tangent.any_orthonormal_vector());
        normals.push(normal);
        last = Some((point, tangent, normal));
    }
    normals
}

fn carry(step: Vec3, from_tangent: Vec3, to_tangent: Vec3, normal: Vec3) -> Vec3 {
    let reflected = |v: Vec3, across: Vec3| {
        let square = across.length_squared();
        if square < LEAST_SQUARE { v } else { v - across * (2.0 / square * across.dot(v)) }
    };
    // The first mirror stands half-way between the points, the second turns the tangent right.
    let (normal, tangent) = (reflected(normal, step), reflected(from_tangent, step));
    reflected(normal, to_tangent - tangent)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flat_arc_keeps_its_binormal() {
        let arc = (0..=20).map(|i| {
            let angle = i as f32 * 0.1;
            (
                Vec3::new(libm::sinf(angle), 1.0 - libm::cosf(angle), 0.0),
                Vec3::new(libm::cosf(angle), libm::sinf(angle), 0.0),
            )
        });
        for normal in normals(arc, Vec3::Z) {
            assert!(normal.distance(Vec3::Z) < 1e-5);
        }
    }

    #[test]
    fn helix_turns_back_by_its_torsion() {
        // On a helix of radius 1 and rise 1 a turn (in radians) torsion is 1/2: the frame falls behind the
        // curve's own normal by 1/2 radian per unit of length, and a unit of angle is √2 long.
        let place = |i: u32| {
            let angle = i as f32 * 0.01;
            let (s, c) = (libm::sinf(angle), libm::cosf(angle));
            (Vec3::new(c, s, angle), Vec3::new(-s, c, 1.0) / std::f32::consts::SQRT_2, Vec3::new(-c, -s, 0.0))
        };
        let count = 200;
        let normals = normals((0..=count).map(|i| (place(i).0, place(i).1)), place(0).2);
        let (_, _, own) = place(count);
        let fallen = normals[count as usize].angle_between(own);
        assert!((fallen - 2.0 * std::f32::consts::FRAC_1_SQRT_2).abs() < 1e-3, "{fallen}");
    }
}
