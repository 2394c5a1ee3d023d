//! The triangles of an obstacle, as they travel (`OB4`).

use base64::{Engine, prelude::BASE64_STANDARD};
use glam::Vec3;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

use crate::version::{MAX_MESH_TRIANGLES, MAX_MESH_VERTICES};

/// Triangles around an origin of their own, as they were given.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Places of the corners.
    pub vertices: Vec<Vec3>,
    /// The corners of each triangle, as numbers of vertices.
    pub triangles: Vec<[u32; 3]>,
}

/// Why bytes are no mesh.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MeshError {
    /// They make no sense.
    #[error("the mesh cannot be read: {0}")]
    Damaged(String),
    /// There is nothing in it, or too much.
    #[error("the mesh has {count} {of}; allowed: 1 to {most}")]
    Count {
        /// Vertices or triangles.
        of: &'static str,
        /// How many there are.
        count: u32,
        /// The most there may be.
        most: usize,
    },
}

impl Mesh {
    /// Little-endian: u32 vertices, u32 triangles, then x, y, z of each vertex as f32, three u32 for each
    /// triangle (`OB4`).
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut out = Vec::with_capacity(8 + 12 * (self.vertices.len() + self.triangles.len()));
        out.extend_from_slice(&(self.vertices.len() as u32).to_le_bytes());
        out.extend_from_slice(&(self.triangles.len() as u32).to_le_bytes());
        for vertex in &self.vertices {
            vertex.to_array().iter().for_each(|c| out.extend_from_slice(&c.to_le_bytes()));
        }
        for corner in self.triangles.iter().flatten() {
            out.extend_from_slice(&corner.to_le_bytes());
        }
        out
    }

    /// Reads a mesh (`OB4`); coordinates are finite, and every corner is there.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, MeshError> {
        let mut words =
            bytes.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]));
        let (Some(vertices), Some(triangles)) = (words.next(), words.next()) else {
            return Err(damaged("it is cut short"));
        };
        check_count("vertices", vertices, MAX_MESH_VERTICES)?;
        check_count("triangles", triangles, MAX_MESH_TRIANGLES)?;
        if bytes.len() as u64 != 8 + 12 * (u64::from(vertices) + u64::from(triangles)) {
            return Err(damaged("its length is not that of its vertices and triangles"));
        }
        let words: Vec<u32> = words.collect();
        let (places, corners) = words.split_at(3 * vertices as usize);
        let vertices: Vec<Vec3> = places
            .chunks_exact(3)
            .map(|c| Vec3::new(f32::from_bits(c[0]), f32::from_bits(c[1]), f32::from_bits(c[2])))
            .collect();
        if let Some(at) = vertices.iter().position(|vertex| !vertex.is_finite()) {
            return Err(damaged(format!("vertex {at} is not finite")));
        }
        if let Some(corner) = corners.iter().find(|&&corner| corner as usize >= vertices.len()) {
            return Err(damaged(format!("a triangle has corner {corner} of {} vertices", vertices.len())));
        }
        let triangles = corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect();
        Ok(Self { vertices, triangles })
    }

    /// The mesh as a command carries it.
    pub fn to_base64(&self) -> String {
        BASE64_STANDARD.encode(self.to_bytes())
    }
}

impl Serialize for Mesh {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.to_base64())
    }
}

impl<'de> Deserialize<'de> for Mesh {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        let bytes = BASE64_STANDARD.decode(text).map_err(damaged);
        bytes.and_then(|bytes| Self::from_bytes(&bytes)).map_err(|error| match error {
            MeshError::Count { of, count, most } => {
                let fault = if count == 0 { "too few" } else { "too many" };
                D::Error::custom(format_args!("{fault}: {count} {of}, expected 1 to {most} {of}"))
            }
            MeshError::Damaged(why) => D::Error::custom(format_args!("{why}, expected a mesh in base64")),
        })
    }
}

fn check_count(of: &'static str, count: u32, most: usize) -> Result<(), MeshError> {
    let is_allowed = (1..=most).contains(&(count as usize));
    is_allowed.then_some(()).ok_or(MeshError::Count { of, count, most })
}

fn damaged(why: impl ToString) -> MeshError {
    MeshError::Damaged(why.to_string())
}
