//! Obstacles as a document holds them: what they are, where they stand, and what growth sees of them.

use std::sync::Arc;

use espalier_growth::{Obstacle as Solid, ObstacleError, Shape as Space, TriangleMesh};
pub use espalier_proto::Mesh;
use espalier_proto::{
    Obstacle as WireObstacle, PlacedObstacle, PlacedShape, Pose, Position, Problem, Reason, Shape,
    UnitRotation,
};
use glam::{Quat, Vec3};

/// The farthest a vertex may lie from its mesh's origin on any axis, scaled, in internodes (`LM6`).
const FARTHEST_VERTEX: f32 = 10_000.0;

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

/// Where an obstacle stands: a pose whose rotation has length 1 exactly. Made so once, for a second time might change its last
/// bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Where its own origin lies.
    pub position: Vec3,
    /// How it is turned, of unit length.
    pub rotation: Quat,
}

/// An obstacle in good form.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    pub(crate) form: Form,
    pub(crate) placement: Placement,
}

/// An obstacle in the scene.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Standing {
    pub(crate) id: u32,
    pub(crate) obstacle: Obstacle,
}

impl Obstacle {
    /// An obstacle as it came over the wire, if growth can make one of it (`LM6`).
    pub(crate) fn of(wire: &WireObstacle) -> Result<Self, Problem> {
        let form = Form::of(&wire.shape).map_err(|problem| problem.within("obstacle.shape"))?;
        Self::new(form, Placement::from(&wire.pose))
    }

    /// A form in its place, if growth can make an obstacle of it.
    pub(crate) fn new(form: Form, placement: Placement) -> Result<Self, Problem> {
        let obstacle = Self { form, placement };
        obstacle.solid().map_err(|error| unfit("shape", &error))?;
        Ok(obstacle)
    }

    /// The obstacle as growth sees it.
    pub(crate) fn solid(&self) -> Result<Solid, ObstacleError> {
        let Placement { position, rotation } = self.placement;
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
        let Obstacle { form, placement } = &self.obstacle;
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
        let pose = Pose {
            position: Position::nearest(placement.position),
            rotation: UnitRotation::nearest(placement.rotation),
        };
        PlacedObstacle { id: self.id, shape, pose }
    }
}

impl From<&Pose> for Placement {
    fn from(wire: &Pose) -> Self {
        Self { position: wire.position.get(), rotation: wire.rotation.get() }
    }
}

impl Form {
    /// The form that a shape on the wire has.
    pub(crate) fn of(wire: &Shape) -> Result<Self, Problem> {
        Ok(match wire {
            Shape::Box { size } => Self::Box { size: size.get() },
            Shape::Sphere { radius } => Self::Sphere { radius: radius.get() },
            Shape::Plane {} => Self::Plane,
            Shape::Mesh { mesh, scale } => {
                let scale = scale.get();
                let outside = |vertex: &&Vec3| (**vertex * scale).abs().max_element() > FARTHEST_VERTEX;
                if let Some(vertex) = mesh.vertices.iter().find(outside) {
                    let allowed = format!("coordinates up to {FARTHEST_VERTEX} after scaling");
                    let found = format!("as large as {}", *vertex * scale);
                    return Err(Problem::out_of_range("mesh", found, allowed));
                }
                Self::mesh(Arc::new(mesh.clone()), scale)?
            }
        })
    }

    /// A mesh in this scale.
    pub(crate) fn mesh(mesh: Arc<Mesh>, scale: f32) -> Result<Self, Problem> {
        let vertices = mesh.vertices.iter().map(|&vertex| vertex * scale).collect();
        let solid = TriangleMesh::new(vertices, mesh.triangles.clone());
        let solid = Arc::new(solid.map_err(|error| unfit("mesh", &error))?);
        Ok(Self::Mesh { mesh, scale, solid })
    }
}

fn unfit(field: &str, error: &ObstacleError) -> Problem {
    let reason = match error {
        ObstacleError::EmptyMesh => Reason::EmptyMesh,
        ObstacleError::TooManyTriangles(_) => Reason::LargeMesh,
        _ => Reason::NoSurface,
    };
    Problem::new(reason, format!("the shape cannot be an obstacle: {error}"))
        .at(field, "a shape with a surface")
}
