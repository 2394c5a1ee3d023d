//! Wood has no open edge, and each of its triangles faces outwards.

use std::collections::BTreeMap;

use glam::Vec3;

use super::{Failure, require};
use crate::tubes::Wood;

const CHECK: &str = "closed_wood";

pub(super) fn check(wood: &Wood) -> Result<(), Failure> {
    let Wood { surface, radii, metamers, tangents, .. } = wood;
    require(CHECK, [radii.len(), metamers.len(), tangents.len()] == [surface.positions.len(); 3], || {
        format!("{} radii, {} metamers, {} tangents", radii.len(), metamers.len(), tangents.len())
    })?;
    for (vertex, (tangent, normal)) in tangents.iter().zip(&surface.normals).enumerate() {
        let along = tangent.truncate();
        let fits =
            (along.length() - 1.0).abs() < 1e-3 && along.dot(*normal).abs() < 1e-3 && tangent.w.abs() == 1.0;
        require(CHECK, fits, || format!("vertex {vertex} has tangent {tangent} on normal {normal}"))?;
    }
    // Vertices at one place count as one, wherever they are in the texture.
    let bits = |corner: u32| surface.positions[corner as usize].to_array().map(f32::to_bits);
    let mut runs: BTreeMap<_, i32> = BTreeMap::new();
    let mut volume = 0.0;
    for (number, triangle) in wood.triangles().enumerate() {
        let [a, b, c] = triangle.map(|corner| surface.positions[corner as usize]);
        let facing = (b - a).cross(c - a);
        let outward: Vec3 = triangle.iter().map(|&corner| surface.normals[corner as usize]).sum();
        require(CHECK, facing.dot(outward) > 0.0, || format!("triangle {number} at {a} faces inwards"))?;
        volume += a.as_dvec3().dot(b.as_dvec3().cross(c.as_dvec3()));
        for [from, to] in [[0, 1], [1, 2], [2, 0]] {
            let (from, to) = (bits(triangle[from]), bits(triangle[to]));
            *runs.entry((from.min(to), from.max(to))).or_default() += if from < to { 1 } else { -1 };
        }
    }
    require(CHECK, volume > 0.0, || format!("it is inside out: its volume is {volume}"))?;
    let open = runs.iter().find(|&(_, &balance)| balance != 0);
    require(CHECK, open.is_none(), || {
        let [from, to] = open
            .map_or_else(Default::default, |(&(from, to), _)| [from, to].map(|end| end.map(f32::from_bits)));
        format!("the edge from {from:?} to {to:?} is open")
    })
}

#[cfg(test)]
mod tests {
    use espalier_plant::{AxisId, Internode, Plant};
    use espalier_settings::BarkLook;

    use super::*;
    use crate::{Style, checks, tubes};

    fn stem() -> Wood {
        let mut plant = Plant::new(Vec3::ZERO);
        plant.begin_step();
        plant.extend(AxisId::new(0), &Internode { end: Vec3::Y, normal: Vec3::X, laterals: &[] });
        plant.end_step();
        tubes::wood(&plant, &Style::default(), &BarkLook::default()).remove(0)
    }

    #[test]
    fn a_stem_passes() {
        assert_eq!(checks::wood(&stem()), Ok(()));
    }

    #[test]
    fn a_hole_or_a_turned_triangle_fails() {
        let (mut open, mut turned) = (stem(), stem());
        open.surface.indices.truncate(open.surface.indices.len() - 3);
        turned.surface.indices.swap(0, 1);
        for (wood, said) in [(open, "open"), (turned, "inwards")] {
            let failure = checks::wood(&wood).expect_err("it is no solid");
            assert!(failure.check == CHECK && failure.detail.contains(said), "{failure}");
        }
    }
}
