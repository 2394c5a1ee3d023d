//! An envelope of any body that each line across a plane passes through once.

use glam::Vec2;

use super::{Envelope, LEAST_SIZE, LassoError, Plane, check_plane, mask::Mask};
use crate::world::is_in_world;

/// Pixels along the longer side of the mask: enough for a body without corners.
const RESOLUTION: usize = 128;

impl Envelope {
    /// A body that need not be symmetric to a plane. `low` and `high` are corners of a box on the plane around it, and
    /// `column` says of a place on the plane from where to where the body reaches along the normal, which is right × up.
    ///
    /// # Errors
    /// Where the plane is none, the body has no inside, or it reaches beyond the world.
    pub fn solid(
        plane: Plane,
        (low, high): (Vec2, Vec2),
        occupancy_radius: f32,
        column: impl Fn(Vec2) -> Option<(f32, f32)>,
    ) -> Result<Self, LassoError> {
        check_plane(&plane)?;
        if !(low.is_finite() && high.is_finite()) {
            return Err(LassoError::NotFinite("box around the body"));
        }
        if (high - low).max_element() < LEAST_SIZE {
            return Err(LassoError::NoArea);
        }
        let mut mask = Mask::of_box((low + high) * 0.5, high - low, RESOLUTION);
        let Mask { width, corner, pixel, .. } = mask;
        let normal = plane.right.cross(plane.up);
        let count = mask.inside.len();
        let (mut height, mut middle) = (vec![0.0; count], vec![0.0; count]);
        for (at, inside) in mask.inside.iter_mut().enumerate() {
            let place = corner + Vec2::new((at % width) as f32, (at / width) as f32) * pixel;
            let Some((from, to)) = column(place).filter(|(from, to)| to > from) else { continue };
            for depth in [from, to] {
                let end = plane.origin + plane.right * place.x + plane.up * place.y + normal * depth;
                if !is_in_world(end) {
                    return Err(LassoError::OutOfWorld(end.abs().max_element()));
                }
            }
            *inside = true;
            (height[at], middle[at]) = (0.5 * (to - from), 0.5 * (from + to));
        }
        mask.clear_margin();
        if !mask.inside.contains(&true) {
            return Err(LassoError::NoArea);
        }
        for (height, _) in height.iter_mut().zip(&mask.inside).filter(|(_, inside)| !**inside) {
            *height = 0.0;
        }
        let rim = mask.depth().values.iter().map(|squared| squared.sqrt() * pixel).collect();
        Ok(Self {
            plane,
            corner,
            pixel,
            width,
            height,
            middle,
            rim,
            depth_factor: 1.0,
            most_depth: f32::INFINITY,
            zone: occupancy_radius,
        })
    }
}
