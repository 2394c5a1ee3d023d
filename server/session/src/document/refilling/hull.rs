//! An envelope of a design at its place in the scene, as a body to grow into.

use espalier_design::Envelope;
use espalier_growth::{Envelope as Body, LassoError, Plane};
use glam::{Quat, Vec2, Vec3};

/// Places at which a line across the envelope is looked at, and halvings by which its ends are found.
const SAMPLES: u8 = 24;
const HALVINGS: u8 = 8;
/// The box around a body is so much larger than the body.
const MARGIN: f32 = 1.02;

/// An envelope whose base, turn and size in the scene are known.
pub(super) struct Hull {
    envelope: Envelope,
    base: Vec3,
    rotation: Quat,
    /// Internodes to a unit of the envelope.
    scale: f32,
}

impl Hull {
    /// An envelope that checks, with so many internodes from its base to its point T.
    pub fn new(envelope: Envelope, base: Vec3, rotation: Quat, length: f32) -> Self {
        let scale = length / envelope.tip.length();
        Self { envelope, base, rotation, scale }
    }

    /// Whether a place of the scene lies in it.
    pub fn contains(&self, place: Vec3) -> bool {
        self.envelope.contains(self.rotation.inverse() * (place - self.base) / self.scale)
    }

    /// Its point T in the scene.
    pub fn tip(&self) -> Vec3 {
        self.base + self.rotation * self.envelope.tip * self.scale
    }

    /// The same as a body whose nodes keep a zone apart: columns across the plane of Y on which it is widest.
    pub fn body(&self, zone: f32) -> Result<Body, LassoError> {
        let (low, high) = self.envelope.bounds();
        let size = high - low;
        // Across that plane the normal is right × Y.
        let (right, normal) = if size.x >= size.z { (Vec3::X, Vec3::Z) } else { (Vec3::Z, Vec3::NEG_X) };
        let plane = Plane { origin: self.base, right: self.rotation * right, up: self.rotation * Vec3::Y };
        let ends = [low.dot(normal), high.dot(normal)];
        let (near, far) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        let corners = [low, high].map(|corner| Vec2::new(corner.dot(right), corner.y));
        let (middle, half) = ((corners[0] + corners[1]) * 0.5, (corners[1] - corners[0]) * 0.5 * MARGIN);
        let bounds = ((middle - half) * self.scale, (middle + half) * self.scale);
        Body::solid(plane, bounds, zone, |at| {
            let place = (right * at.x + Vec3::Y * at.y) / self.scale;
            let (from, to) = self.across(place, normal, near, far)?;
            Some((from * self.scale, to * self.scale))
        })
    }

    /// From where to where a line is inside, from the first place on that is to the last one.
    fn across(&self, place: Vec3, along: Vec3, near: f32, far: f32) -> Option<(f32, f32)> {
        let is_inside = |t: f32| self.envelope.contains(place + along * t);
        let step = (far - near) / f32::from(SAMPLES);
        let at = |sample: u8| near + step * (f32::from(sample) + 0.5);
        let mut inside = (0..SAMPLES).filter(|&sample| is_inside(at(sample)));
        let first = inside.next()?;
        let last = inside.next_back().unwrap_or(first);
        let end = |within: f32, outside: f32| {
            let (mut within, mut outside) = (within, outside);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (within + outside);
                if is_inside(middle) { within = middle } else { outside = middle }
            }
            within
        };
        Some((end(at(first), at(first) - step), end(at(last), at(last) + step)))
    }
}

#[cfg(test)]
mod tests {
    use core::f32::consts::FRAC_PI_3;

    use super::*;

    /// Lopsided in each direction.
    fn lopsided() -> Envelope {
        Envelope {
            top: Vec3::new(0.1, 1.1, -0.05),
            radii: [0.6, 0.2, 0.3, 0.45],
            heights: [0.5, 0.4, 0.3, 0.6],
            upper: 1.4,
            lower: 2.6,
            ..Envelope::default()
        }
    }

    #[test]
    fn a_body_holds_what_its_envelope_does() {
        let turned = Quat::from_axis_angle(Vec3::new(0.6, 0.0, 0.8), FRAC_PI_3);
        for envelope in [lopsided(), Envelope { radii: [0.2, 0.6, 0.3, 0.5], ..lopsided() }] {
            assert_eq!(envelope.check(), Ok(()));
            let hull = Hull::new(envelope.clone(), Vec3::new(3.0, 20.0, -7.0), turned, 16.0);
            let body = hull.body(1.5).expect("it has an inside");
            let (low, high) = envelope.bounds();
            let (mut both, mut one) = (0u32, 0u32);
            for number in 0..32_768u16 {
                let share = |shift: u16| (f32::from(number >> shift & 31) + 0.5) / 32.0 * 1.2 - 0.1;
                let place = low + (high - low) * Vec3::new(share(0), share(5), share(10));
                let scene = hull.base + hull.rotation * place * hull.scale;
                let inside = [envelope.contains(place), body.contains(scene)];
                assert_eq!(hull.contains(scene), inside[0]);
                both += u32::from(inside == [true; 2]);
                one += u32::from(inside[0] != inside[1]);
            }
            assert!(both > 4000 && one * 30 < both, "{both} in both, {one} in one alone");
        }
    }

    #[test]
    fn an_envelope_stands_by_its_tip() {
        let envelope = Envelope { tip: Vec3::new(0.0, 0.5, 0.0), ..Envelope::default() };
        let hull =
            Hull::new(envelope, Vec3::Y * 5.0, Quat::from_rotation_z(-core::f32::consts::FRAC_PI_2), 6.0);
        assert!(hull.tip().distance(Vec3::new(6.0, 5.0, 0.0)) < 1e-4, "{}", hull.tip());
        assert!(hull.contains(Vec3::new(11.5, 5.0, 0.0)) && !hull.contains(Vec3::new(12.5, 5.0, 0.0)));
    }
}
