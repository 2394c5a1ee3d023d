//! Which triangle is seen at each pixel.

use glam::{DVec3, Vec2, Vec3};

/// No triangle.
pub(crate) const NOTHING: u32 = u32::MAX;

/// A direction to look in, from a place or from infinitely far away: a point goes to its pixel and its nearness.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    /// Unit vectors to the right, upwards, and to the eye.
    axes: [Vec3; 3],
    /// Pixels to an internode, at the distance of one internode where the eye is at a place.
    scale: f32,
    /// The pixel of the origin, or of what the eye looks at.
    origin: Vec2,
    eye: Option<Eye>,
}

/// Where an eye is, and how near it sees.
#[derive(Clone, Copy, Debug)]
struct Eye {
    place: Vec3,
    nearest: f32,
}

impl View {
    /// Looks from `eye`, any direction but straight up or down, with the origin at a pixel.
    pub(crate) fn new(eye: Vec3, scale: f32, origin: Vec2) -> Self {
        let right = Vec3::Y.cross(eye).normalize();
        Self { axes: [right, eye.cross(right), eye], scale, origin, eye: None }
    }

    /// The same from a place, at which what is nearer is not seen.
    pub(crate) fn from(self, place: Vec3, nearest: f32) -> Self {
        Self { eye: Some(Eye { place, nearest }), ..self }
    }

    /// The same view without its first rows.
    pub(crate) fn below_row(&self, first: f32) -> Self {
        Self { origin: self.origin - Vec2::new(0.0, first), ..*self }
    }

    /// The unit vector to the eye.
    pub(crate) fn eye(&self) -> Vec3 {
        self.axes[2]
    }

    /// Where the eye is, unless it is infinitely far away.
    pub(crate) fn place(&self) -> Option<Vec3> {
        self.eye.map(|eye| eye.place)
    }

    /// The unit vector to the right.
    pub(crate) fn right(&self) -> Vec3 {
        self.axes[0]
    }

    /// Pixels to an internode.
    pub(crate) fn scale(&self) -> f32 {
        self.scale
    }

    /// Whether a level plane through a point is seen from below, or from its edge.
    pub(crate) fn is_below(&self, point: Vec3) -> bool {
        self.place().map_or(self.axes[2].y, |place| place.y - point.y) <= 0.0
    }

    /// The pixel of a point, and how near it is.
    pub(crate) fn project(&self, point: Vec3) -> Vec3 {
        let Some(Eye { place, .. }) = self.eye else {
            let [x, y, near] = self.axes.map(|axis| axis.dot(point));
            return Vec3::new(self.origin.x + self.scale * x, self.origin.y - self.scale * y, near);
        };
        let [x, y, near] = self.axes.map(|axis| axis.dot(point - place));
        // Over a triangle in the picture, 1 / distance is even; the distance itself is not.
        let by_distance = -1.0 / near;
        let scale = self.scale * by_distance;
        Vec3::new(self.origin.x + scale * x, self.origin.y - scale * y, by_distance)
    }

    /// What is seen of a triangle: none, one or two parts of it, cut off where it comes too near.
    pub(crate) fn pieces(&self, corners: [Vec3; 3]) -> impl Iterator<Item = Piece> {
        let own = [Vec3::X, Vec3::Y, Vec3::Z];
        let Some(Eye { place, nearest }) = self.eye else {
            let whole = Piece { corners: corners.map(|corner| self.project(corner)), shares: None };
            return [Some(whole), None].into_iter().flatten();
        };
        let beyond = corners.map(|corner| self.axes[2].dot(place - corner) - nearest);
        if beyond.iter().all(|&beyond| beyond >= 0.0) {
            let whole = Piece { corners: corners.map(|corner| self.project(corner)), shares: Some(own) };
            return [Some(whole), None].into_iter().flatten();
        }
        // The corners of what is left, at most four.
        let mut left: [Vec3; 4] = [Vec3::ZERO; 4];
        let mut count = 0;
        for (at, next) in [(0, 1), (1, 2), (2, 0)] {
            let mut keep = |share: Vec3| {
                left[count] = share;
                count += 1;
            };
            if beyond[at] >= 0.0 {
                keep(own[at]);
            }
            if (beyond[at] >= 0.0) != (beyond[next] >= 0.0) {
                keep(own[at].lerp(own[next], beyond[at] / (beyond[at] - beyond[next])));
            }
        }
        let piece = |shares: [Vec3; 3]| {
            let place = |share: Vec3| corners[0] * share.x + corners[1] * share.y + corners[2] * share.z;
            Piece { corners: shares.map(|share| self.project(place(share))), shares: Some(shares) }
        };
        let [a, b, c, d] = left;
        [(count >= 3).then(|| piece([a, b, c])), (count == 4).then(|| piece([a, c, d]))].into_iter().flatten()
    }

    /// How much each corner of a triangle has to say at a pixel; none for one seen from its edge.
    pub(crate) fn shares(&self, corners: [Vec3; 3], at: Vec2) -> Option<Vec3> {
        let Some(Eye { place, .. }) = self.eye else {
            return weights(corners.map(|corner| self.project(corner)), at);
        };
        let off = (at - self.origin) / self.scale;
        let ray = (self.axes[0] * off.x - self.axes[1] * off.y - self.axes[2]).as_dvec3();
        let [a, b, c] = corners.map(|corner| (corner - place).as_dvec3());
        let (first, second) = (b - a, c - a);
        let across = ray.cross(second);
        let area = first.dot(across);
        if area == 0.0 {
            return None;
        }
        let (of_b, of_c) = (-a.dot(across) / area, -ray.dot(a.cross(first)) / area);
        let shares = DVec3::new(1.0 - of_b - of_c, of_b, of_c);
        // A pixel at the edge of a triangle that is seen almost from its edge may be far off it.
        Some(shares.clamp(DVec3::ZERO, DVec3::ONE).as_vec3())
    }
}

/// What is seen of a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    /// Its corners in the picture.
    pub(crate) corners: [Vec3; 3],
    /// How much each corner of the whole has to say at each of them; none from infinitely far away, where it is whole.
    shares: Option<[Vec3; 3]>,
}

impl Piece {
    /// How much each corner of the whole has to say where those of the piece have so much to say in the picture.
    pub(crate) fn of_whole(&self, weights: Vec3) -> Vec3 {
        let Some([a, b, c]) = self.shares else {
            return weights;
        };
        let [of_a, of_b, of_c] = self.corners;
        let weights = weights * Vec3::new(of_a.z, of_b.z, of_c.z);
        (a * weights.x + b * weights.y + c * weights.z) / weights.element_sum()
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

    /// An eye 4 above the origin's front that looks level along −z.
    fn near() -> View {
        View::new(Vec3::Z, 10.0, Vec2::new(10.0, 10.0)).from(Vec3::new(0.0, 0.0, 4.0), 1.0)
    }

    #[test]
    fn what_is_nearer_than_an_eye_sees_is_cut_off() {
        let triangle =
            |z: [f32; 3]| [Vec3::new(-1.0, 0.0, z[0]), Vec3::new(1.0, 0.0, z[1]), Vec3::new(0.0, 1.0, z[2])];
        for (z, pieces) in
            [([0.0; 3], 1), ([3.5; 3], 0), ([9.0; 3], 0), ([0.0, 0.0, 9.0], 2), ([0.0, 5.0, 9.0], 1)]
        {
            let seen: Vec<_> = near().pieces(triangle(z)).collect();
            assert_eq!(seen.len(), pieces, "{z:?}");
            assert!(seen.iter().flat_map(|piece| piece.corners).all(|at| at.z > 0.0 && at.z <= 1.0 + 1e-5));
        }
    }

    #[test]
    fn shares_are_those_of_places_not_of_pixels() {
        // Its middle is at z = -4, which the picture shows at a third of the way from the nearer corner.
        let corners = [Vec3::new(-2.0, 0.0, 2.0), Vec3::new(2.0, 0.0, -10.0), Vec3::new(-2.0, 3.0, 2.0)];
        let half = 0.5 * (corners[0] + corners[1]);
        let at = near().project(half).truncate();
        let shares = near().shares(corners, at).expect("it is seen");
        assert!(shares.distance(Vec3::new(0.5, 0.5, 0.0)) < 1e-5, "{shares}");
        let piece = near().pieces(corners).next().expect("it is seen");
        let seen = weights(piece.corners, at).expect("it is seen");
        assert!(seen.distance(shares) > 0.2, "{seen}");
        assert!(piece.of_whole(seen).distance(shares) < 1e-5, "{}", piece.of_whole(seen));
    }
}
