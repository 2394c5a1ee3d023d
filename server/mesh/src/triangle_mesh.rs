//! Triangles with normals and texture coordinates.

use glam::{Vec2, Vec3};

/// An indexed mesh; front faces run counter-clockwise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleMesh {
    /// Where each vertex is, in internodes.
    pub positions: Vec<Vec3>,
    /// Each vertex' unit normal.
    pub normals: Vec<Vec3>,
    /// Each vertex' place in a texture, v upwards.
    pub uvs: Vec<Vec2>,
    /// Three vertices for each triangle.
    pub indices: Vec<u32>,
}

impl TriangleMesh {
    /// Whether there is nothing to draw.
    pub fn is_empty(&self) -> bool {
        self.indices.is_empty()
    }

    /// Adds a vertex and returns its index.
    pub fn vertex(&mut self, position: Vec3, normal: Vec3, uv: Vec2) -> u32 {
        let index = self.positions.len() as u32;
        self.positions.push(position);
        self.normals.push(normal);
        self.uvs.push(uv);
        index
    }

    /// Adds a triangle.
    pub fn triangle(&mut self, a: u32, b: u32, c: u32) {
        self.indices.extend([a, b, c]);
    }

    /// Forgets all triangles, but not their room.
    pub fn clear(&mut self) {
        let Self { positions, normals, uvs, indices } = self;
        positions.clear();
        normals.clear();
        uvs.clear();
        indices.clear();
    }

    /// The corners of the box around all vertices; none without vertices.
    pub fn bounds(&self) -> Option<[Vec3; 2]> {
        let first = *self.positions.first()?;
        Some(self.positions.iter().fold([first; 2], |[low, high], &p| [low.min(p), high.max(p)]))
    }
}
