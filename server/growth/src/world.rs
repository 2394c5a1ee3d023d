//! The bounds of the world.

use glam::Vec3;

/// Growth stays within this distance of the origin on each axis, in internodes.
pub const WORLD_EXTENT: f32 = 1000.0;

/// Whether a place lies within the bounds.
pub(crate) fn is_in_world(place: Vec3) -> bool {
    place.abs().max_element() <= WORLD_EXTENT
}
