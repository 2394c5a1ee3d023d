//! Which triangle is seen at each pixel.

use glam::{Vec2, Vec3};

/// No triangle.
pub(crate) const NOTHING: u32 = u32::MAX;

/// A direction to look in, without perspective: a point goes to its pixel and its nearness.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    /// Unit vectors to the right, upwards, and to the eye.
    axes: [Vec3; 3],
    /// Pixels to an internode.
    scale: f32,
    /// The pixel of the origin.
    origin: Vec2,
}

impl View {
    /// Looks from `eye`, any direction but straight up or down, with the origin at a pixel.
    pub(crate) fn new(eye: Vec3, scale: f32, origin: Vec2) -> Self {
        let right = Vec3::Y.cross(eye).normalize();
        Self { axes: [right, eye.cross(right), eye], scale, origin }
    }

    /// The same view without its first rows.
    pub(crate) fn below_row(&self, first: f32) -> Self {
        Self { origin: self.origin - Vec2::new(0.0, first), ..*self }
    }

    /// The unit vector to the eye.
    pub(crate) fn eye(&self) -> Vec3 {
        self.axes[2]
    }

    /// The unit vector to the right.
    pub(crate) fn right(&self) -> Vec3 {
        self.axes[0]
    }

    /// Pixels to an internode.
    pub(crate) fn scale(&self) -> f32 {
        self.scale
    }

    /// The pixel of a point, and how near it is.
    pub(crate) fn project(&self, point: Vec3) -> Vec3 {
        let [x, y, near] = self.axes.map(|axis| axis.dot(point));
        Vec3::new(self.origin.x + self.scale * x, self.origin.y - self.scale * y, near)
    }
}

/// For each pixel the nearest triangle.
#[derive(Clone, Debug)]
pub(crate) struct Seen {
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// How near it is.
    pub(crate) near: Vec<f32>,
    /// Its number, or [`NOTHING`].
    pub(crate) triangle: Vec<u32>,
}

impl Seen {
    pub(crate) fn new(width: usize, height: usize) -> Self {
        let count = width * height;
        Self { width, height, near: vec![f32::NEG_INFINITY; count], triangle: vec![NOTHING; count] }
    }

    /// Puts a projected triangle in front of what lies behind it, where `is_there` finds some of it by how much each corner
    /// has to say; both its sides are seen.
    pub(crate) fn add(&mut self, corners: [Vec3; 3], number: u32, is_there: impl Fn(Vec3) -> bool) {
        let low = corners[0].min(corners[1]).min(corners[2]);
        let high = corners[0].max(corners[1]).max(corners[2]);
        let first = |value: f32| (value - 0.5).ceil().max(0.0) as usize;
        let end = |value: f32, size: usize| ((value + 0.5).floor().max(0.0) as usize).min(size);
        for y in first(low.y)..end(high.y, self.height) {
            for x in first(low.x)..end(high.x, self.width) {
                let Some(weights) = weights(corners, Vec2::new(x as f32 + 0.5, y as f32 + 0.5)) else {
                    continue;
                };
                if weights.min_element() < 0.0 {
                    continue;
                }
                let near = weights.x * corners[0].z + weights.y * corners[1].z + weights.z * corners[2].z;
                let pixel = y * self.width + x;
                if near > self.near[pixel] && is_there(weights) {
                    self.near[pixel] = near;
                    self.triangle[pixel] = number;
                }
            }
        }
    }
}

/// How much each corner of a projected triangle has to say at a pixel; none for one seen from its edge.
pub(crate) fn weights(corners: [Vec3; 3], at: Vec2) -> Option<Vec3> {
    let [a, b, c] = corners.map(Vec3::truncate);
    let area = (b - a).perp_dot(c - a);
    if area == 0.0 {
        return None;
    }
    let of_b = (at - a).perp_dot(c - a) / area;
    let of_c = (b - a).perp_dot(at - a) / area;
    Some(Vec3::new(1.0 - of_b - of_c, of_b, of_c))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corners(near: f32) -> [Vec3; 3] {
        [Vec3::new(0.0, 0.0, near), Vec3::new(8.0, 0.0, near), Vec3::new(0.0, 8.0, near)]
    }

    #[test]
    fn the_nearest_triangle_is_seen() {
        let mut seen = Seen::new(8, 8);
        for (number, near) in [(0, 1.0), (1, 3.0), (2, 2.0)] {
            seen.add(corners(near), number, |_| true);
        }
        seen.add(corners(4.0), 3, |weights| weights.x < 0.0);
        assert_eq!((seen.triangle[0], seen.triangle[63]), (1, NOTHING));
        assert_eq!(seen.triangle.iter().filter(|&&number| number == 1).count(), 36);
    }

    #[test]
    fn the_front_view_has_up_above() {
        let view = View::new(Vec3::Z, 2.0, Vec2::new(10.0, 20.0));
        assert_eq!(view.project(Vec3::new(1.0, 3.0, 5.0)), Vec3::new(12.0, 14.0, 5.0));
    }
}
