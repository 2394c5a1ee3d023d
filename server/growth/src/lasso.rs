//! The lasso: a silhouette becomes an envelope to grow into (TreeSketch §3.2, Figure 7).
//!
//! The paper thins the silhouette to its chordal axes and inflates it around them, as Teddy does. Here the
//! envelope is the union of all balls whose discs are inscribed in the silhouette, which is the same body
//! without a skeleton: any such ball lies within one centred on the axes.

mod distance;
mod limbs;
mod mask;
mod solid;
mod sowing;

use glam::{Vec2, Vec3};

use crate::world::WORLD_EXTENT;
use distance::{Raster, lower_envelope};
use mask::{Mask, bounds};

pub(crate) use sowing::Sowing;

/// Points an outline may have.
pub const MAX_OUTLINE: usize = 100_000;
/// Pixels along the longer side of the mask.
const RESOLUTION: usize = 256;
/// Silhouettes smaller than this are slips of the finger, in internodes.
const LEAST_SIZE: f32 = 0.01;
/// Nodes in a body keep so much of its height apart where that is less than a zone, and this at least, in internodes.
const ZONE_OVER_HEIGHT: f32 = 0.35;
const LEAST_ZONE: f32 = 0.45;
/// Nodes lie so far inside the outline, for leaves stick out; in thin parts by so much of the height.
const INSET: f32 = 0.3;
const INSET_OVER_HEIGHT: f32 = 0.2;
/// Metamers that fill a cube as wide as a zone.
const WOOD: f32 = 0.68;
/// Halvings by which a depth is found.
const FLATTENINGS: u32 = 24;
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

/// A body around a plane: symmetric to it where its silhouette was drawn there.
#[derive(Clone, Debug, PartialEq)]
pub struct Envelope {
    plane: Plane,
    /// Where the first pixel's centre lies in the plane, and the edge of a pixel.
    corner: Vec2,
    pixel: f32,
    width: usize,
    /// How far balls that are centred in the plane, and whose discs fit in, reach from it, pixel by pixel.
    height: Vec<f32>,
    /// How far the middle of the body lies from the plane, pixel by pixel; nothing where it is symmetric.
    middle: Vec<f32>,
    /// How far each pixel lies inside the outline.
    rim: Vec<f32>,
    /// How deep the body is, over how deep balls make it, and how far it reaches from the plane at most.
    depth_factor: f32,
    most_depth: f32,
    /// The zone of a node with room all around.
    zone: f32,
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
        let rim = depth.values.iter().map(|squared| squared.sqrt() * pixel).collect();
        let height = inscribed_balls(depth).values.iter().map(|height| height * pixel).collect();
        let (most_depth, zone) = (f32::INFINITY, occupancy_radius);
        let middle = Vec::new();
        Ok(Self { plane, corner, pixel, width, height, middle, rim, depth_factor, most_depth, zone })
    }

    /// The same body, made flat enough for so many metamers to fill it.
    pub(crate) fn filled_by(mut self, metamers: u32) -> Self {
        let most = f64::from(metamers);
        if self.wood() > most {
            let (mut low, mut high) =
                (0.0, self.height.iter().copied().fold(0.0, f32::max) * self.depth_factor);
            for _ in 0..FLATTENINGS {
                self.most_depth = 0.5 * (low + high);
                if self.wood() > most {
                    high = self.most_depth;
                } else {
                    low = self.most_depth;
                }
            }
            self.most_depth = low.max(LEAST_ZONE);
        }
        self
    }

    /// How many metamers fill it.
    pub fn wood(&self) -> f64 {
        let zone = f64::from(self.zone);
        f64::from(WOOD) * self.marker_count(1.0) / (zone * zone * zone)
    }

    /// How far a place is from the box around its silhouette.
    pub fn distance_to_box(&self, place: Vec3) -> f32 {
        let [x, y, away] = self.in_pixels(place).to_array();
        let size = [self.width, self.rows()].map(|pixels| pixels as f32);
        let beside = Vec2::new(x - x.clamp(0.0, size[0]), y - y.clamp(0.0, size[1])) * self.pixel;
        beside.extend(away).length()
    }

    /// Its volume in cubic internodes.
    pub fn volume(&self) -> f64 {
        let depth: f64 = (0..self.height.len()).map(|pixel| f64::from(self.half_depth(pixel))).sum();
        2.0 * f64::from(self.pixel) * f64::from(self.pixel) * depth
    }

    /// Whether a place lies in it.
    pub fn contains(&self, place: Vec3) -> bool {
        self.pixel_around(place).is_some()
    }

    /// Whether a node there keeps its leaves in the outline.
    pub(crate) fn holds_leaves(&self, place: Vec3) -> bool {
        let is_inset = |pixel: usize| self.rim[pixel] > INSET.min(INSET_OVER_HEIGHT * self.height[pixel]);
        self.pixel_around(place).is_some_and(is_inset)
    }

    /// How far apart nodes keep there: less than elsewhere where the body is too thin for several side by side. None
    /// outside of it.
    pub(crate) fn zone_at(&self, place: Vec3) -> Option<f32> {
        self.pixel_around(place).map(|pixel| self.zone_in(pixel))
    }

    fn zone_in(&self, pixel: usize) -> f32 {
        (self.height[pixel] * ZONE_OVER_HEIGHT).max(LEAST_ZONE).min(self.zone)
    }

    /// How far the body's middle lies from the plane.
    fn middle(&self, pixel: usize) -> f32 {
        self.middle.get(pixel).copied().unwrap_or_default()
    }

    /// How far the body reaches from its middle to either side.
    fn half_depth(&self, pixel: usize) -> f32 {
        (self.height[pixel] * self.depth_factor).min(self.most_depth)
    }

    fn rows(&self) -> usize {
        self.height.len() / self.width
    }

    /// Coordinates in pixels, and the distance from the plane in internodes.
    fn in_pixels(&self, place: Vec3) -> Vec3 {
        let Plane { origin, right, up } = self.plane;
        let from = place - origin;
        let at = (Vec2::new(from.dot(right), from.dot(up)) - self.corner) / self.pixel + 0.5;
        at.extend(from.dot(right.cross(up)))
    }

    /// The pixel in whose column of the body a place lies.
    fn pixel_around(&self, place: Vec3) -> Option<usize> {
        let at = self.in_pixels(place);
        let is_on_mask = at.x.min(at.y) >= 0.0 && at.x < self.width as f32 && at.y < self.rows() as f32;
        let pixel = is_on_mask.then(|| at.y as usize * self.width + at.x as usize);
        let is_around = |&pixel: &usize| {
            self.height[pixel] > 0.0 && (at.z - self.middle(pixel)).abs() <= self.half_depth(pixel)
        };
        pixel.filter(is_around)
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
