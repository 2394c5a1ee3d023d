//! Triangles have three different corners that exist, and an area.

use super::{Failure, require};
use crate::triangle_mesh::TriangleMesh;

const CHECK: &str = "true_triangles";

pub(super) fn check(mesh: &TriangleMesh) -> Result<(), Failure> {
    let (corners, rest) = mesh.indices.as_chunks::<3>();
    require(CHECK, rest.is_empty(), || format!("{} indices are no triangles", mesh.indices.len()))?;
    for (triangle, corners) in corners.iter().enumerate() {
        let exist = corners.iter().all(|&corner| (corner as usize) < mesh.positions.len());
        require(CHECK, exist, || format!("triangle {triangle} has corners {corners:?}"))?;
        let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize]);
        let area = 0.5 * (b - a).cross(c - a).length();
        require(CHECK, area > 0.0, || format!("triangle {triangle} is flat: {a}, {b}, {c}"))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use glam::{Vec2, Vec3};

    use crate::{TriangleMesh, checks};

    fn corner_mesh() -> TriangleMesh {
        let mut mesh = TriangleMesh::default();
        for position in [Vec3::ZERO, Vec3::X, Vec3::Y, 2.0 * Vec3::X] {
            mesh.vertex(position, Vec3::Z, Vec2::ZERO);
        }
        mesh
    }

    #[test]
    fn only_triangles_with_area_pass() {
        for (corners, verdict) in [
            ([0, 1, 2], Ok(())),
            ([0, 1, 1], Err("true_triangles")),
            ([0, 1, 3], Err("true_triangles")),
            ([0, 1, 4], Err("true_triangles")),
        ] {
            let mut mesh = corner_mesh();
            mesh.triangle(corners[0], corners[1], corners[2]);
            assert_eq!(checks::mesh(&mesh).map_err(|f| f.check), verdict);
        }
    }
}
