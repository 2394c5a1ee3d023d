//! What an obstacle may be.

use std::sync::Arc;

use glam::{Quat, Vec3};

use super::{
    checks::{ObstacleError, check_place, check_positive, check_rotation, check_unit},
    mesh::TriangleMesh,
};

/// The form and place of an obstacle, valid or not; lengths in internodes.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A solid box.
    Box {
        /// Its middle.
        centre: Vec3,
        /// Half its length along each of its own axes.
        half_extents: Vec3,
        /// World from the box's own axes, a unit quaternion.
        rotation: Quat,
    },
    /// A solid ball.
    Sphere {
        /// Its middle.
        centre: Vec3,
        /// Its radius.
        radius: f32,
    },
    /// A half-space: all that lies behind the plane is solid.
    Plane {
        /// A point of the plane.
        point: Vec3,
        /// Unit direction out of the solid.
        normal: Vec3,
    },
    /// A mesh: solid if it is closed, otherwise a sheet without thickness.
    Mesh {
        /// Its triangles; the same ones may stand in many places.
        mesh: Arc<TriangleMesh>,
        /// Where its own origin lies.
        position: Vec3,
        /// World from the mesh's own axes, a unit quaternion.
        rotation: Quat,
    },
}

/// A valid obstacle.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    shape: Shape,
}

impl Obstacle {
    /// Takes a shape whose numbers make sense.
    pub fn new(shape: Shape) -> Result<Self, ObstacleError> {
        match &shape {
            Shape::Box { centre, half_extents, rotation } => {
                check_place("centre of the box", *centre)?;
                check_place("size of the box", *half_extents)?;
                check_positive("size of the box", half_extents.min_element())?;
                check_rotation("rotation of the box", *rotation)?;
            }
            Shape::Sphere { centre, radius } => {
                check_place("centre of the sphere", *centre)?;
                check_place("radius of the sphere", Vec3::splat(*radius))?;
                check_positive("radius of the sphere", *radius)?;
            }
            Shape::Plane { point, normal } => {
                check_place("point of the plane", *point)?;
                check_unit("normal of the plane", normal.length())?;
            }
            // Its triangles were checked when they were made a mesh.
            Shape::Mesh { position, rotation, .. } => {
                check_place("place of the mesh", *position)?;
                check_rotation("rotation of the mesh", *rotation)?;
            }
        }
        Ok(Self { shape })
    }

    /// Its form and place.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sphere(centre: Vec3, radius: f32) -> Result<Obstacle, ObstacleError> {
        Obstacle::new(Shape::Sphere { centre, radius })
    }

    #[test]
    fn numbers_without_meaning_are_refused() {
        assert!(sphere(Vec3::ONE, 2.0).is_ok());
        assert_eq!(sphere(Vec3::NAN, 2.0), Err(ObstacleError::NotFinite("centre of the sphere")));
        assert_eq!(sphere(Vec3::ONE, f32::INFINITY), Err(ObstacleError::NotFinite("radius of the sphere")));
        assert!(matches!(sphere(Vec3::ONE, 0.0), Err(ObstacleError::NotPositive { .. })));
        assert_eq!(sphere(Vec3::X * 1e9, 1.0), Err(ObstacleError::TooFar("centre of the sphere")));
    }

    #[test]
    fn directions_must_have_length_one() {
        let plane = |normal| Obstacle::new(Shape::Plane { point: Vec3::ZERO, normal });
        assert!(plane(Vec3::Y).is_ok());
        assert!(matches!(plane(Vec3::ZERO), Err(ObstacleError::NotUnit { .. })));
        assert!(matches!(plane(Vec3::Y * 2.0), Err(ObstacleError::NotUnit { .. })));
        assert!(matches!(plane(Vec3::NAN), Err(ObstacleError::NotFinite(_))));
        let cuboid =
            |half_extents, rotation| Obstacle::new(Shape::Box { centre: Vec3::ZERO, half_extents, rotation });
        assert!(cuboid(Vec3::ONE, Quat::IDENTITY).is_ok());
        assert!(cuboid(Vec3::new(1.0, 0.0, 1.0), Quat::IDENTITY).is_err());
        assert!(cuboid(Vec3::ONE, Quat::from_xyzw(0.0, 0.0, 0.0, 3.0)).is_err());
    }
}
