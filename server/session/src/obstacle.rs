//! Obstacles as a document holds them: what they are, where they stand, and what growth sees of them.

use std::sync::Arc;

use base64::{Engine, prelude::BASE64_STANDARD};
use espalier_growth::{Obstacle as Solid, ObstacleError, Shape as Space, TriangleMesh};
use espalier_proto::{
    Obstacle as WireObstacle, PlacedObstacle, PlacedShape, Pose as WirePose, Problem, ProblemCode, Shape,
    version::{MAX_MESH_TRIANGLES, MAX_MESH_VERTICES},
};
use glam::{Quat, Vec3};

use crate::action::{parse_position, parse_rotation};

/// The farthest a vertex may lie from its mesh's origin on any axis, scaled, in internodes (`LM6`).
const FARTHEST_VERTEX: f32 = 10_000.0;

/// Triangles around an origin of their own, as they were given.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Places of the corners.
    pub vertices: Vec<Vec3>,
    /// The corners of each triangle, as numbers of vertices.
    pub triangles: Vec<[u32; 3]>,
}

/// What an obstacle is, around its own origin; lengths in internodes. Of a mesh growth's own, which is slow to
/// make, stays with it wherever it stands.
#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    /// A box.
    Box {
        /// Its sides.
        size: Vec3,
    },
    /// A sphere.
    Sphere {
        /// Its radius.
        radius: f32,
    },
    /// Everything below it.
    Plane,
    /// A body of triangles.
    Mesh {
        /// As it was given.
        mesh: Arc<Mesh>,
        /// What its coordinates are multiplied by.
        scale: f32,
        /// As growth has it.
        solid: Arc<TriangleMesh>,
    },
}

/// Where an obstacle stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Where its own origin lies.
    pub position: Vec3,
    /// How it is turned, of unit length.
    pub rotation: Quat,
}

/// An obstacle in good form.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    pub(crate) form: Form,
    pub(crate) pose: Pose,
}

/// An obstacle in the scene.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Standing {
    pub(crate) id: u32,
    pub(crate) obstacle: Obstacle,
}

impl Obstacle {
    /// Checks an obstacle's form (`LM6`).
    pub(crate) fn parse(wire: &WireObstacle) -> Result<Self, Problem> {
        let form = Form::parse(&wire.shape).map_err(|problem| problem.within("shape"))?;
        let pose = Pose::parse(&wire.pose).map_err(|problem| problem.within("pose"))?;
        Self::new(form, pose)
    }

    /// A form in its place, if growth can make an obstacle of it.
    pub(crate) fn new(form: Form, pose: Pose) -> Result<Self, Problem> {
        let obstacle = Self { form, pose };
        obstacle.solid().map_err(|error| unfit("shape", &error))?;
        Ok(obstacle)
    }

    /// The obstacle as growth sees it.
    pub(crate) fn solid(&self) -> Result<Solid, ObstacleError> {
        let Pose { position, rotation } = self.pose;
        Solid::new(match &self.form {
            Form::Box { size } => Space::Box { centre: position, half_extents: *size * 0.5, rotation },
            Form::Sphere { radius } => Space::Sphere { centre: position, radius: *radius },
            Form::Plane => Space::Plane { point: position, normal: (rotation * Vec3::Y).normalize() },
            Form::Mesh { solid, .. } => Space::Mesh { mesh: Arc::clone(solid), position, rotation },
        })
    }

    /// Its mesh, if it is one.
    pub(crate) fn mesh(&self) -> Option<&Arc<Mesh>> {
        match &self.form {
            Form::Mesh { mesh, .. } => Some(mesh),
            _ => None,
        }
    }
}

impl Standing {
    pub(crate) fn to_proto(&self) -> PlacedObstacle {
        let Obstacle { form, pose } = &self.obstacle;
        let shape = match form {
            Form::Box { size } => PlacedShape::Box { size: size.to_array() },
            Form::Sphere { radius } => PlacedShape::Sphere { radius: *radius },
            Form::Plane => PlacedShape::Plane {},
            Form::Mesh { mesh, scale, .. } => PlacedShape::Mesh {
                vertices: mesh.vertices.len() as u32,
                triangles: mesh.triangles.len() as u32,
                scale: *scale,
            },
        };
        let pose = WirePose { position: pose.position.to_array(), rotation: pose.rotation.to_array() };
        PlacedObstacle { id: self.id, shape, pose }
    }
}

impl Pose {
    pub(crate) fn parse(wire: &WirePose) -> Result<Self, Problem> {
        let position = parse_position(&wire.position)?;
        Ok(Self { position, rotation: parse_rotation(&wire.rotation)? })
    }
}

impl Form {
    fn parse(wire: &Shape) -> Result<Self, Problem> {
        Ok(match wire {
            Shape::Box { size } => {
                for (axis, &value) in size.iter().enumerate() {
                    in_range(&format!("size[{axis}]"), value, 0.1, 1000.0)?;
                }
                Self::Box { size: Vec3::from_array(*size) }
            }
            &Shape::Sphere { radius } => Self::Sphere { radius: in_range("radius", radius, 0.1, 500.0)? },
            Shape::Plane {} => Self::Plane,
            Shape::Mesh { mesh, scale } => {
                let scale = in_range("scale", *scale, 0.001, 1000.0)?;
                let bytes = BASE64_STANDARD.decode(mesh).map_err(|error| damaged(&error.to_string()))?;
                let mesh = Mesh::from_bytes(&bytes)?;
                let outside = |vertex: &&Vec3| (**vertex * scale).abs().max_element() > FARTHEST_VERTEX;
                if let Some(vertex) = mesh.vertices.iter().find(outside) {
                    let allowed = format!("coordinates up to {FARTHEST_VERTEX} after scaling");
                    return Err(Problem::out_of_range(
                        "mesh",
                        format!("as large as {}", *vertex * scale),
                        allowed,
                    ));
                }
                Self::mesh(Arc::new(mesh), scale)?
            }
        })
    }

    /// A form that an obstacle may take on later; a mesh is what it was placed as (`OB2`).
    pub(crate) fn parse_simple(wire: &Shape) -> Result<Self, Problem> {
        match wire {
            Shape::Mesh { .. } => Err(Problem::out_of_range("kind", "mesh", "box, sphere or plane")),
            simple => Self::parse(simple),
        }
    }

    /// A mesh in this scale.
    pub(crate) fn mesh(mesh: Arc<Mesh>, scale: f32) -> Result<Self, Problem> {
        let vertices = mesh.vertices.iter().map(|&vertex| vertex * scale).collect();
        let solid = TriangleMesh::new(vertices, mesh.triangles.clone());
        let solid = Arc::new(solid.map_err(|error| unfit("mesh", &error))?);
        Ok(Self::Mesh { mesh, scale, solid })
    }
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
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Problem> {
        let mut words =
            bytes.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]));
        let (Some(vertices), Some(triangles)) = (words.next(), words.next()) else {
            return Err(damaged("it is cut short"));
        };
        count("vertices", vertices, MAX_MESH_VERTICES)?;
        count("triangles", triangles, MAX_MESH_TRIANGLES)?;
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
            return Err(damaged(&format!("vertex {at} is not finite")));
        }
        if let Some(corner) = corners.iter().find(|&&corner| corner as usize >= vertices.len()) {
            return Err(damaged(&format!("a triangle has corner {corner} of {} vertices", vertices.len())));
        }
        let triangles = corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect();
        Ok(Self { vertices, triangles })
    }

    /// The mesh as a command carries it.
    pub fn to_base64(&self) -> String {
        BASE64_STANDARD.encode(self.to_bytes())
    }
}

fn in_range(field: &str, value: f32, low: f32, high: f32) -> Result<f32, Problem> {
    if (low..=high).contains(&value) {
        Ok(value)
    } else {
        Err(Problem::out_of_range(field, value, format!("{low} to {high}")))
    }
}

fn count(what: &str, found: u32, most: usize) -> Result<(), Problem> {
    if (1..=most).contains(&(found as usize)) {
        return Ok(());
    }
    Err(Problem {
        code: if found == 0 { ProblemCode::OutOfRange } else { ProblemCode::TooMany },
        field: Some("mesh".into()),
        allowed: Some(format!("1 to {most} {what}")),
        message: format!("the mesh has {found} {what}; allowed: 1 to {most}"),
    })
}

fn unfit(field: &str, error: &ObstacleError) -> Problem {
    Problem {
        code: ProblemCode::OutOfRange,
        field: Some(field.into()),
        allowed: None,
        message: format!("the shape cannot be an obstacle: {error}"),
    }
}

fn damaged(why: &str) -> Problem {
    Problem {
        code: ProblemCode::Malformed,
        field: Some("mesh".into()),
        allowed: None,
        message: format!("the mesh cannot be read: {why}"),
    }
}
