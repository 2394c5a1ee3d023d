//! Each vertex has a finite position, a unit normal and a finite place in the texture.

use super::{Failure, require};
use crate::triangle_mesh::TriangleMesh;

const CHECK: &str = "finite_vertices";

pub(super) fn check(mesh: &TriangleMesh) -> Result<(), Failure> {
    let TriangleMesh { positions, normals, uvs, .. } = mesh;
    require(CHECK, positions.len() == normals.len() && positions.len() == uvs.len(), || {
        format!("{} positions, {} normals, {} uvs", positions.len(), normals.len(), uvs.len())
    })?;
    for (vertex, ((position, normal), uv)) in positions.iter().zip(normals).zip(uvs).enumerate() {
        require(CHECK, position.is_finite() && uv.is_finite(), || {
            format!("vertex {vertex} is at {position}, {uv}")
        })?;
        let unit = (normal.length_squared() - 1.0).abs() < 1e-4;
        require(CHECK, unit, || format!("vertex {vertex} has normal {normal}"))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use glam::{Vec2, Vec3};

    use crate::{TriangleMesh, checks};

    #[test]
    fn short_normal_fails() {
        let mut mesh = TriangleMesh::default();
        mesh.vertex(Vec3::ZERO, Vec3::Y, Vec2::ZERO);
        assert_eq!(checks::mesh(&mesh), Ok(()));
        mesh.vertex(Vec3::ZERO, Vec3::Y * 0.9, Vec2::ZERO);
        assert_eq!(checks::mesh(&mesh).map_err(|f| f.check), Err("finite_vertices"));
    }
}
