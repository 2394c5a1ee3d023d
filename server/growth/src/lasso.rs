//! The lasso: a silhouette becomes an envelope to grow into (TreeSketch §3.2, Figure 7).
//!
//! The paper thins the silhouette to its chordal axes and inflates it around them, as Teddy does. Here the
//! envelope is the union of all balls whose discs are inscribed in the silhouette, which is the same body
//! without a skeleton: any such ball lies within one centred on the axes.

mod distance;
mod mask;

use glam::{Vec2, Vec3};

use crate::{random::Draw, world::WORLD_EXTENT};
use distance::{Raster, lower_envelope};
use mask::{Mask, bounds};

/// Points an outline may have.
pub const MAX_OUTLINE: usize = 100_000;
/// Pixels along the longer side of the mask.
const RESOLUTION: usize = 256;
/// Silhouettes smaller than this are slips of the finger, in internodes.
const LEAST_SIZE: f32 = 0.01;
/// Places keep to this share of a pixel's column, so that rounding does not carry them out of it.
const WITHIN: f32 = 0.999;
/// How far the plane's vectors may be from orthonormal.
const UNIT_TOLERANCE: f32 = 1.0e-3;

/// The plane that is drawn on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Where (0, 0) lies.
    pub origin: Vec3,
    /// Unit direction of x.
    pub right: Vec3,
    /// Unit direction of y, at a right angle to `right`.
    pub up: Vec3,
}

/// A body that is symmetric to the plane its silhouette was drawn on.
#[derive(Clone, Debug, PartialEq)]
pub struct Envelope {
    plane: Plane,
    /// Where the first pixel's centre lies in the plane, and the edge of a pixel.
    corner: Vec2,
    pixel: f32,
    width: usize,
    /// How far the body reaches from the plane to either side, pixel by pixel.
    half_depth: Vec<f32>,
    volume: f64,
}

/// An outline cannot be inflated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LassoError {
    /// NaN or infinite.
    #[error("the {0} is not a finite number")]
    NotFinite(&'static str),
    /// A point or two.
    #[error("the outline has {0} different points; at least 3 are needed")]
    TooFewPoints(usize),
    /// More points than anyone draws.
    #[error("the outline has {0} points; at most 100000 are allowed")]
    TooManyPoints(usize),
    /// A line, or something that small.
    #[error("the outline encloses no area")]
    NoArea,
    /// Outside the world.
    #[error("the outline reaches beyond the world, {0} internodes from its middle")]
    OutOfWorld(f32),
    /// The plane's vectors.
    #[error("the plane's right and up must have length 1 and be at right angles")]
    NotOrthonormal,
    /// The depth factor.
    #[error("the depth factor is {0}; allowed: 0.05 to 4")]
    DepthFactor(f32),
}

impl Envelope {
    /// Inflates an outline drawn on a plane. An open outline is closed by a straight line, a self-crossing one
    /// filled by the even-odd rule. With `depth_factor` 1 a disc becomes a ball; less flattens. Parts narrower
    /// than `occupancy_radius` are widened until they can hold markers.
    pub fn inflate(
        outline: &[Vec2],
        plane: Plane,
        depth_factor: f32,
        occupancy_radius: f32,
    ) -> Result<Self, LassoError> {
        Self::inflate_at(RESOLUTION, outline, plane, depth_factor, occupancy_radius)
    }

    /// [`Envelope::inflate`] with a mask so many pixels long.
    #[doc(hidden)]
    pub fn inflate_at(
        resolution: usize,
        outline: &[Vec2],
        plane: Plane,
        depth_factor: f32,
        occupancy_radius: f32,
    ) -> Result<Self, LassoError> {
        check_plane(&plane)?;
        check_outline(outline, &plane)?;
        if !(0.05..=4.0).contains(&depth_factor) {
            return Err(LassoError::DepthFactor(depth_factor));
        }
        let least_radius = 0.5 * occupancy_radius.max(0.0);
        let mut mask = Mask::fill(outline, least_radius, resolution.max(16));
        if !mask.inside.contains(&true) {
            return Err(LassoError::NoArea);
        }
        let depth = mask.widen_narrow_parts(least_radius);
        let Mask { width, corner, pixel, .. } = mask;
        let mut half_depth = inscribed_balls(depth).values;
        for depth in &mut half_depth {
            *depth *= pixel * depth_factor;
        }
        let column = 2.0 * f64::from(pixel) * f64::from(pixel);
        let volume = column * half_depth.iter().map(|&depth| f64::from(depth)).sum::<f64>();
        Ok(Self { plane, corner, pixel, width, half_depth, volume })
    }

    /// Its volume in cubic internodes.
    pub fn volume(&self) -> f64 {
        self.volume
    }

    /// Whether a place lies in it.
    pub fn contains(&self, place: Vec3) -> bool {
        let Plane { origin, right, up } = self.plane;
        let from = place - origin;
        let at = (Vec2::new(from.dot(right), from.dot(up)) - self.corner) / self.pixel + 0.5;
        let height = self.half_depth.len() / self.width;
        let is_on_mask = at.min_element() >= 0.0 && at.x < self.width as f32 && at.y < height as f32;
        is_on_mask && {
            let half_depth = self.half_depth[at.y as usize * self.width + at.x as usize];
            half_depth > 0.0 && from.dot(right.cross(up)).abs() <= half_depth
        }
    }

    /// `count` places spread evenly over its volume.
    ///
    /// The body is cut into as many slices of equal volume, along a curve that keeps what is near together,
    /// and each gets one: evener than chance, which leaves clusters and holes.
    pub(crate) fn places(&self, count: usize, draw: Draw) -> Vec<Vec3> {
        let mut places = Vec::with_capacity(count);
        let column = 2.0 * f64::from(self.pixel) * f64::from(self.pixel);
        let slice = self.volume / count as f64;
        let jittered = |i: usize| (i as f64 + f64::from(draw.unit(3 * i as u32))) * slice;
        let mut filled = 0.0;
        let mut next = jittered(0);
        let normal = self.plane.right.cross(self.plane.up);
        for (x, y) in morton_order(self.width, self.half_depth.len() / self.width) {
            let half_depth = self.half_depth[y * self.width + x];
            filled += column * f64::from(half_depth);
            while next < filled && places.len() < count {
                let i = places.len() as u32;
                let jitter = Vec2::new(draw.unit(3 * i + 1), draw.unit(3 * i + 2)) - 0.5;
                let across = Vec2::new(x as f32, y as f32) + jitter * WITHIN;
                let in_plane = self.corner + across * self.pixel;
                // Depths follow the golden ratio, so that neighbours along the curve lie far apart in depth.
                let share = (i.wrapping_mul(0x9e37_79b9) >> 8) as f32 * (1.0 / 16_777_216.0);
                let depth = half_depth * (2.0 * share - 1.0) * WITHIN;
                places.push(
                    self.plane.origin
                        + self.plane.right * in_plane.x
                        + self.plane.up * in_plane.y
                        + normal * depth,
                );
                next = jittered(places.len());
            }
        }
        places
    }
}

/// How high above the plane the union of inscribed balls reaches at each pixel, in pixels, from the squared
/// distance to the background.
fn inscribed_balls(depth: Raster) -> Raster {
    let inside: Vec<bool> = depth.values.iter().map(|&squared| squared > 0.0).collect();
    let mut balls = depth;
    for value in &mut balls.values {
        // The silhouette ends half a pixel before the centre of the first one outside.
        let radius = value.sqrt() - 0.5;
        *value = if radius > 0.0 { -radius * radius } else { f32::INFINITY };
    }
    let mut height = lower_envelope(balls);
    for (value, inside) in height.values.iter_mut().zip(inside) {
        *value = if inside { (-*value).max(0.0).sqrt() } else { 0.0 };
    }
    height
}

/// All pixels, along a Z-order curve.
fn morton_order(width: usize, height: usize) -> impl Iterator<Item = (usize, usize)> {
    let side = width.max(height).next_power_of_two() as u32;
    (0..side * side)
        .map(|code| (every_other_bit(code) as usize, every_other_bit(code >> 1) as usize))
        .filter(move |&(x, y)| x < width && y < height)
}

/// Bits 0, 2, 4, … packed together.
fn every_other_bit(code: u32) -> u32 {
    let mut bits = code & 0x5555_5555;
    bits = (bits | bits >> 1) & 0x3333_3333;
    bits = (bits | bits >> 2) & 0x0f0f_0f0f;
    bits = (bits | bits >> 4) & 0x00ff_00ff;
    (bits | bits >> 8) & 0x0000_ffff
}

fn check_plane(plane: &Plane) -> Result<(), LassoError> {
    let Plane { origin, right, up } = *plane;
    if !(origin.is_finite() && right.is_finite() && up.is_finite()) {
        return Err(LassoError::NotFinite("drawing plane"));
    }
    let off = [right.length() - 1.0, up.length() - 1.0, right.dot(up)];
    if off.iter().any(|off| off.abs() > UNIT_TOLERANCE) {
        return Err(LassoError::NotOrthonormal);
    }
    Ok(())
}

fn check_outline(outline: &[Vec2], plane: &Plane) -> Result<(), LassoError> {
    if outline.len() > MAX_OUTLINE {
        return Err(LassoError::TooManyPoints(outline.len()));
    }
    if !outline.iter().all(|p| p.is_finite()) {
        return Err(LassoError::NotFinite("outline"));
    }
    let different = different_points(outline);
    if different < 3 {
        return Err(LassoError::TooFewPoints(different));
    }
    let (low, high) = bounds(outline);
    for corner in [low, high, Vec2::new(low.x, high.y), Vec2::new(high.x, low.y)] {
        let place = plane.origin + plane.right * corner.x + plane.up * corner.y;
        let farthest = place.abs().max_element();
        if farthest.is_nan() || farthest > WORLD_EXTENT {
            return Err(LassoError::OutOfWorld(farthest));
        }
    }
    if (high - low).max_element() < LEAST_SIZE {
        return Err(LassoError::NoArea);
    }
    Ok(())
}

/// How many different points there are; beyond two it does not matter how many.
fn different_points(outline: &[Vec2]) -> usize {
    let Some(&first) = outline.first() else { return 0 };
    let Some(&second) = outline.iter().find(|&&p| p != first) else { return 1 };
    if outline.iter().any(|&p| p != first && p != second) { 3 } else { 2 }
}

#[cfg(test)]
mod tests;
