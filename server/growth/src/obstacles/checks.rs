//! What the numbers of an obstacle must be.

use glam::{Quat, Vec3};

/// A shape cannot be an obstacle.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ObstacleError {
    /// NaN or infinite.
    #[error("the {0} is not a finite number")]
    NotFinite(&'static str),
    /// Outside every world.
    #[error("the {0} is farther than 100000 internodes from the origin")]
    TooFar(&'static str),
    /// A length that must be above 0.
    #[error("the {what} is {value}; it must be greater than 0")]
    NotPositive {
        /// The length.
        what: &'static str,
        /// What it was to be.
        value: f32,
    },
    /// A direction or rotation that must have length 1.
    #[error("the {what} has length {length}; it must be 1")]
    NotUnit {
        /// The direction or rotation.
        what: &'static str,
        /// Its length.
        length: f32,
    },
    /// A mesh without a triangle that has an area.
    #[error("the mesh has no triangles with an area")]
    EmptyMesh,
    /// A triangle whose corner does not exist.
    #[error("triangle {triangle} names vertex {index}, but there are {vertices} vertices")]
    NoSuchVertex {
        /// The triangle.
        triangle: usize,
        /// The corner it names.
        index: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// More triangles than a mesh may have.
    #[error("the mesh has {0} triangles; at most 200000 are allowed")]
    TooManyTriangles(usize),
}

/// Coordinates of obstacles stay within this distance of the origin on each axis, in internodes.
const FARTHEST: f32 = 1.0e5;
/// How far a direction's or a rotation's length may be from 1.
const UNIT_TOLERANCE: f32 = 1.0e-3;

/// A finite place within reach.
pub(super) fn check_place(what: &'static str, place: Vec3) -> Result<(), ObstacleError> {
    if !place.is_finite() {
        return Err(ObstacleError::NotFinite(what));
    }
    if place.abs().max_element() > FARTHEST {
        return Err(ObstacleError::TooFar(what));
    }
    Ok(())
}

/// More than nothing.
pub(super) fn check_positive(what: &'static str, value: f32) -> Result<(), ObstacleError> {
    if value > 0.0 { Ok(()) } else { Err(ObstacleError::NotPositive { what, value }) }
}

/// A unit quaternion.
pub(super) fn check_rotation(what: &'static str, rotation: Quat) -> Result<(), ObstacleError> {
    let [x, y, z, w] = rotation.to_array();
    check_unit(what, (x * x + y * y + z * z + w * w).sqrt())
}

/// A length of 1.
pub(super) fn check_unit(what: &'static str, length: f32) -> Result<(), ObstacleError> {
    if !length.is_finite() {
        return Err(ObstacleError::NotFinite(what));
    }
    if (length - 1.0).abs() > UNIT_TOLERANCE {
        return Err(ObstacleError::NotUnit { what, length });
    }
    Ok(())
}
