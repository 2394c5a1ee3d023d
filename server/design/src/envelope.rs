//! Asymmetric envelopes (Boudon et al. 2003, §2.4, after Horn, Koop and Cescatti), and where a ray leaves one.

use espalier_plant::hash::StableHash;
use espalier_reading::NotAllowed;
use glam::{Vec2, Vec3};

/// The least and the greatest radius of the periphery.
pub const RADII: (f32, f32) = (0.02, 4.0);
/// The least and the greatest coefficient of shape.
pub const SHAPES: (f32, f32) = (0.2, 8.0);
/// How far a coordinate may lie from the origin.
pub(crate) const FARTHEST: f32 = 4.0;
/// How far the periphery stays below the top and above the bottom.
const LEAST_HEIGHT: f32 = 0.01;
/// Most steps of the search for the surface.
const MOST_STEPS: usize = 64;
/// Top and bottom stand within this share of the periphery.
const INNER: f32 = 0.98;

/// The outline of a branching system, its base in the origin. Units are free: only its shape counts, and how far its
/// tip is from the origin.
#[derive(Clone, Debug, PartialEq)]
pub struct Envelope {
    /// The highest point (P₁).
    pub top: Vec3,
    /// The lowest point (P₂).
    pub bottom: Vec3,
    /// How far the periphery reaches along +X, +Z, −X, −Z (P₃ to P₆).
    pub radii: [f32; 4],
    /// How high the periphery stands there.
    pub heights: [f32; 4],
    /// Shape above the periphery (C₁): 1 a cone, 2 an ovoid, more a cylinder, less a spire.
    pub upper: f32,
    /// Shape below it (C₂).
    pub lower: f32,
    /// The point that comes to lie on the outline of the bearer (T).
    pub tip: Vec3,
}

impl Default for Envelope {
    /// An ovoid.
    fn default() -> Self {
        Self {
            top: Vec3::Y,
            bottom: Vec3::ZERO,
            radii: [0.35; 4],
            heights: [0.45; 4],
            upper: 2.0,
            lower: 2.0,
            tip: Vec3::Y,
        }
    }
}

impl Envelope {
    /// Checks that it has an inside.
    ///
    /// # Errors
    /// Where a number is out of range, or the envelope is inside out.
    pub fn check(&self) -> Result<(), NotAllowed> {
        let refused = |at: &str, found: String, allowed: &str| {
            Err(NotAllowed { at: at.to_owned(), ..NotAllowed::new(found, allowed) })
        };
        for (at, point) in [("top", self.top), ("bottom", self.bottom), ("tip", self.tip)] {
            if !(point.is_finite() && point.abs().max_element() <= FARTHEST) {
                let found = format!("[{}, {}, {}]", point.x, point.y, point.z);
                return refused(at, found, "coordinates from -4 to 4");
            }
        }
        for (at, radius) in self.radii.iter().enumerate() {
            if !(RADII.0..=RADII.1).contains(radius) {
                return refused(&format!("radii[{at}]"), radius.to_string(), "0.02 to 4");
            }
        }
        for (at, shape) in [("upper", self.upper), ("lower", self.lower)] {
            if !(SHAPES.0..=SHAPES.1).contains(&shape) {
                return refused(at, shape.to_string(), "0.2 to 8");
            }
        }
        let (least, most) = (self.bottom.y + LEAST_HEIGHT, self.top.y - LEAST_HEIGHT);
        if least > most {
            let allowed = "a height at least 0.02 above that of the bottom: the envelope is inside out";
            return refused("top", self.top.y.to_string(), allowed);
        }
        for (at, height) in self.heights.iter().enumerate() {
            if !(least..=most).contains(height) {
                let allowed =
                    format!("{least} to {most}, between bottom and top: the envelope is inside out");
                return refused(&format!("heights[{at}]"), height.to_string(), &allowed);
            }
        }
        if self.tip.length() < 0.05 {
            return refused("tip", self.tip.length().to_string(), "a place at least 0.05 from the base");
        }
        Ok(())
    }

    /// Above 0 inside, below 0 outside, 0 on the surface; continuous.
    pub fn depth(&self, point: Vec3) -> f32 {
        let above = self.rim(self.within(self.top), point);
        let below = self.rim(self.within(self.bottom), point);
        let out = 1.0 - above.share.max(below.share);
        if out < 0.0 {
            return out;
        }
        let top = self.top.y - (self.top.y - above.height) * power(above.share, self.upper);
        let bottom = self.bottom.y + (below.height - self.bottom.y) * power(below.share, self.lower);
        (top - point.y).min(point.y - bottom)
    }

    /// Whether a point is inside.
    pub fn contains(&self, point: Vec3) -> bool {
        self.depth(point) > 0.0
    }

    /// How far along a unit direction the surface is from a point inside; none from a point outside.
    pub fn distance(&self, from: Vec3, direction: Vec3) -> Option<f32> {
        let mut near = (0.0, self.depth(from));
        if near.1 <= 0.0 {
            return None;
        }
        // An envelope need not be convex: small steps find where the ray leaves it first.
        let mut far = (0.03, self.depth(from + direction * 0.03));
        while far.1 > 0.0 {
            near = far;
            // Nothing of an envelope is farther from anything else of it than its bounds are from one another.
            if far.0 > 32.0 {
                return Some(far.0);
            }
            let next = far.0 * 1.3;
            far = (next, self.depth(from + direction * next));
        }
        // The rule of false position, with the value of an end that stays halved (Illinois), and now and then a plain
        // half, for at spires the surface is too steep for that rule.
        let mut moved_near = None;
        for step in 1..=MOST_STEPS {
            let middle = match step % 4 {
                0 => (near.0 + far.0) * 0.5,
                _ => (near.0 * far.1 - far.0 * near.1) / (far.1 - near.1),
            };
            let depth = self.depth(from + direction * middle);
            let moves_near = depth > 0.0;
            match moves_near {
                true => near = (middle, depth),
                false => far = (middle, depth),
            }
            if far.0 - near.0 < 1e-4 {
                return Some(middle);
            }
            if moved_near == Some(moves_near) {
                let stays = if moves_near { &mut far.1 } else { &mut near.1 };
                *stays *= 0.5;
            }
            moved_near = Some(moves_near);
        }
        Some((near.0 + far.0) * 0.5)
    }

    /// A point of the periphery.
    pub fn periphery(&self, angle: f32) -> Vec3 {
        let (sin, cos) = libm::sincosf(angle);
        let ([x, z], [height_x, height_z]) = (self.quadrant(cos, sin), self.quadrant_heights(cos, sin));
        Vec3::new(x * cos, height_x * cos * cos + height_z * sin * sin, z * sin)
    }

    /// A point of the surface: `share` is 1 at the periphery and 0 at the top, or at the bottom below it.
    pub fn surface(&self, angle: f32, share: f32, half: Half) -> Vec3 {
        let rim = self.periphery(angle);
        let (pole, shape) = match half {
            Half::Upper => (self.top, self.upper),
            Half::Lower => (self.bottom, self.lower),
        };
        let level = self.within(pole).lerp(Vec2::new(rim.x, rim.z), share);
        Vec3::new(level.x, pole.y + (rim.y - pole.y) * power(share, shape), level.y)
    }

    /// The bounds of the surface.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let [right, front, left, back] = self.radii;
        (Vec3::new(-left, self.bottom.y, -back), Vec3::new(right, self.top.y, front))
    }

    fn quadrant(&self, x: f32, z: f32) -> [f32; 2] {
        [self.radii[if x >= 0.0 { 0 } else { 2 }], self.radii[if z >= 0.0 { 1 } else { 3 }]]
    }

    fn quadrant_heights(&self, x: f32, z: f32) -> [f32; 2] {
        [self.heights[if x >= 0.0 { 0 } else { 2 }], self.heights[if z >= 0.0 { 1 } else { 3 }]]
    }

    /// Where a pole stands within the periphery, seen from above.
    fn within(&self, pole: Vec3) -> Vec2 {
        let [x, z] = self.quadrant(pole.x, pole.z);
        let level = Vec2::new(pole.x, pole.z);
        let out = Vec2::new(level.x / x, level.y / z).length();
        if out > INNER { level * (INNER / out) } else { level }
    }

    /// Where the ray from a pole through a point meets the periphery, both seen from above.
    fn rim(&self, pole: Vec2, point: Vec3) -> Rim {
        let ray = Vec2::new(point.x, point.z) - pole;
        let length = ray.length();
        if length < 1e-6 {
            return Rim { share: 0.0, height: self.heights[0] };
        }
        let (sign_x, sign_z) = (ray.x, ray.y);
        // The ray may pass from one quadrant into another, at most twice.
        let mut at = (pole.x + sign_x, pole.y + sign_z);
        let mut reach = 0.0;
        for _ in 0..4 {
            let [x, z] = self.quadrant(at.0, at.1);
            let (d, p) = (Vec2::new(ray.x / x, ray.y / z), Vec2::new(pole.x / x, pole.y / z));
            let (a, b, c) = (d.length_squared(), d.dot(p), p.length_squared() - 1.0);
            // The pole may be outside this quarter's own ellipse; then the ray leaves it elsewhere.
            reach = (-b + (b * b - a * c).max(0.0).sqrt()) / a;
            let met = (pole.x + reach * ray.x, pole.y + reach * ray.y);
            if (met.0 >= 0.0) == (at.0 >= 0.0) && (met.1 >= 0.0) == (at.1 >= 0.0) {
                break;
            }
            at = met;
        }
        let met = Vec2::new(pole.x + reach * ray.x, pole.y + reach * ray.y);
        let ([x, z], [height_x, height_z]) =
            (self.quadrant(met.x, met.y), self.quadrant_heights(met.x, met.y));
        let (cos, sin) = (met.x / x, met.y / z);
        let height = (height_x * cos * cos + height_z * sin * sin) / (cos * cos + sin * sin).max(1e-9);
        Rim { share: 1.0 / reach.max(1e-9), height }
    }

    /// How far out a place is, seen from a pole: 0 there and 1 on the periphery; and how high the periphery stands there.
    pub(crate) fn out(&self, place: Vec3, pole: Vec3) -> (f32, f32) {
        let rim = self.rim(self.within(pole), place);
        (rim.share, rim.height)
    }

    pub(crate) fn hash(&self, hash: &mut StableHash) {
        [self.top, self.bottom, self.tip].into_iter().for_each(|point| hash.vector(point));
        for number in self.radii.into_iter().chain(self.heights).chain([self.upper, self.lower]) {
            hash.word(number.to_bits().into());
        }
    }
}

/// A half of an envelope.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Half {
    /// Above the periphery.
    Upper,
    /// Below it.
    Lower,
}

/// How far out a point is, 1 on the periphery, and how high the periphery stands there.
struct Rim {
    share: f32,
    height: f32,
}

fn power(base: f32, exponent: f32) -> f32 {
    match exponent {
        1.0 => base,
        2.0 => base * base,
        _ => libm::powf(base, exponent),
    }
}
