//! Leaves as triangles: an ovate blade, folded along its midrib and bowed towards its tip, as clients draw it.

use glam::{Vec2, Vec3};

use crate::{leaves::Leaf, triangle_mesh::TriangleMesh};

/// An outline between base and tip: how far along, and half the width there.
type Outline = &'static [(f32, f32)];

const DETAILED: Outline = &[(0.3, 0.31), (0.68, 0.24)];
const PLAIN: Outline = &[(0.42, 0.3)];
/// With more leaves than this each gets half the triangles: nobody sees single ones then.
const MANY_LEAVES: usize = 60_000;

/// Leaves as triangles. Texture coordinates run from 0 to 1 across a blade and from its base to its tip.
pub fn leaf_mesh(leaves: &[Leaf]) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    let outline = if leaves.len() > MANY_LEAVES { PLAIN } else { DETAILED };
    for leaf in leaves {
        add_blade(&mut mesh, leaf, outline);
    }
    mesh
}

fn add_blade(mesh: &mut TriangleMesh, leaf: &Leaf, outline: Outline) {
    let form = Form::of(leaf);
    let base = form.vertex(mesh, 0.0, 0.0, 0.0);
    // The left edge, the midrib and the right edge of the last station; at the base all three are one.
    let mut below = [base; 3];
    for &(along, half_width) in outline {
        let station = [-1.0, 0.0, 1.0].map(|across| form.vertex(mesh, across, along, half_width));
        let [left, middle, right] = station;
        if below[0] != base {
            mesh.triangle(below[0], below[1], left);
            mesh.triangle(below[1], below[2], middle);
        }
        mesh.triangle(left, below[1], middle);
        mesh.triangle(middle, below[2], right);
        below = station;
    }
    let tip = form.vertex(mesh, 0.0, 1.0, 0.0);
    mesh.triangle(below[0], below[1], tip);
    mesh.triangle(below[1], below[2], tip);
}

/// How one leaf is bent: each by its own measure, or a crown looks stamped.
struct Form<'a> {
    leaf: &'a Leaf,
    side: Vec3,
    bow: f32,
    fold: f32,
}

impl<'a> Form<'a> {
    fn of(leaf: &'a Leaf) -> Self {
        let second = (leaf.random * 7.0).fract();
        Self {
            leaf,
            side: leaf.direction.cross(leaf.normal),
            bow: 0.12 + 0.3 * leaf.random,
            fold: 0.18 + 0.27 * second,
        }
    }

    /// `across` is -1 and 1 at the edges, `along` 0 at the base and 1 at the tip.
    fn vertex(&self, mesh: &mut TriangleMesh, across: f32, along: f32, half_width: f32) -> u32 {
        let Leaf { base, direction, normal, size, .. } = *self.leaf;
        let out = across * half_width;
        let sunk = self.bow * along * along;
        let place = direction * (along - 0.12 * sunk)
            + self.side * (1.05 * out)
            + normal * (out.abs() * self.fold - sunk);
        let lengthwise = direction - normal * (2.0 * self.bow * along);
        let crosswise = self.side + normal * (self.fold * across);
        let uv = Vec2::new(0.5 + 0.5 * across, along);
        mesh.vertex(base + size * place, crosswise.cross(lengthwise).normalize(), uv)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks;

    fn blade(outline: Outline) -> TriangleMesh {
        let leaf = Leaf { base: Vec3::ONE, direction: Vec3::X, normal: Vec3::Y, size: 2.0, random: 0.5 };
        let mut mesh = TriangleMesh::default();
        add_blade(&mut mesh, &leaf, outline);
        mesh
    }

    #[test]
    fn blades_face_their_normal() {
        for (outline, vertices, triangles) in [(DETAILED, 8, 8), (PLAIN, 5, 4)] {
            let mesh = blade(outline);
            assert_eq!((mesh.positions.len(), mesh.indices.len()), (vertices, 3 * triangles));
            assert_eq!(checks::mesh(&mesh), Ok(()));
            for corners in mesh.indices.as_chunks::<3>().0 {
                let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize]);
                assert!((b - a).cross(c - a).y > 0.0, "a triangle faces down");
            }
        }
    }

    #[test]
    fn blade_is_as_long_and_wide_as_its_outline() {
        let [low, high] = blade(DETAILED).bounds().expect("a blade has vertices");
        assert!(low.x == 1.0 && high.x > 2.8 && high.x <= 3.0);
        // Both halves are alike.
        assert!((high.z + low.z - 2.0).abs() < 1e-6);
        assert!((high.z - 1.0 - 2.0 * 0.31 * 1.05).abs() < 1e-5);
    }
}
