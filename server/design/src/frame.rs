//! Frames of branches: which side of a branch looks up, and how it is turned.

use glam::{Mat3, Vec3};

use crate::envelope::Envelope;

/// A side whose sine to the branch is smaller says nothing of where the branch's own side is.
const LEAST_SINE: f32 = 0.1;

/// A frame with Y along a direction and X as near to straight up as it can be; `other` says where X is of a branch
/// that stands upright.
pub(crate) fn upward(direction: Vec3, other: Vec3) -> Mat3 {
    let candidates = [Vec3::Y, other, Vec3::X, Vec3::Z];
    let side = candidates.into_iter().map(|side| side - direction * side.dot(direction));
    let side = side.into_iter().find(|side| side.length() > LEAST_SINE).unwrap_or(Vec3::X);
    let x = side.normalize();
    Mat3::from_cols(x, direction, x.cross(direction))
}

/// The frame turned about its own Y.
pub(crate) fn rolled(frame: Mat3, degrees: f32) -> Mat3 {
    if degrees == 0.0 {
        return frame;
    }
    let (sin, cos) = libm::sincosf(degrees.to_radians());
    let (x, z) = (frame.x_axis, frame.z_axis);
    Mat3::from_cols(x * cos + z * sin, frame.y_axis, z * cos - x * sin)
}

/// The axes of an envelope's tip: across, along and aside.
pub(crate) fn of_tip(envelope: &Envelope) -> Mat3 {
    let along = envelope.tip.normalize();
    let across = |side: Vec3| side - along * side.dot(along);
    let side = [Vec3::X, Vec3::NEG_Y].into_iter().map(across).find(|side| side.length() > LEAST_SINE);
    let x = side.unwrap_or(Vec3::Z).normalize();
    Mat3::from_cols(x, along, x.cross(along))
}

/// A vector turned by a rotation vector in degrees.
pub(crate) fn turned(vector: Vec3, by: Vec3) -> Vec3 {
    let degrees = by.length();
    if degrees < 1e-6 {
        return vector;
    }
    let axis = by / degrees;
    let (sin, cos) = libm::sincosf(degrees.to_radians());
    vector * cos + axis.cross(vector) * sin + axis * (axis.dot(vector) * (1.0 - cos))
}

/// The rotation vector in degrees that turns one unit vector into another by the shorter arc.
pub(crate) fn turn_between(from: Vec3, to: Vec3) -> Vec3 {
    let across = from.cross(to);
    let (sin, cos) = (across.length(), from.dot(to));
    if sin < 1e-6 {
        return if cos > 0.0 { Vec3::ZERO } else { upward(from, Vec3::X).x_axis * 180.0 };
    }
    across / sin * libm::atan2f(sin, cos).to_degrees()
}

/// Turns `vector` the way that turns the unit vector `from` into the unit vector `to`, and squares it with `to`.
pub(crate) fn transported(vector: Vec3, from: Vec3, to: Vec3) -> Vec3 {
    let cos = from.dot(to);
    let axis = from.cross(to);
    let carried = if cos < -0.999 {
        vector
    } else {
        vector + axis.cross(vector) + axis.cross(axis.cross(vector)) / (1.0 + cos)
    };
    across(carried, to)
}

/// The unit vector across a heading that is nearest to a vector.
pub(crate) fn across(vector: Vec3, heading: Vec3) -> Vec3 {
    let level = vector - heading * vector.dot(heading);
    if level.length() > 1e-3 { level.normalize() } else { upward(heading, Vec3::X).x_axis }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn unit() -> impl Strategy<Value = Vec3> {
        let vector = (-1.0f32..1.0, -1.0f32..1.0, -1.0f32..1.0).prop_map(|(x, y, z)| Vec3::new(x, y, z));
        vector.prop_filter("it has a direction", |v| v.length() > 0.1).prop_map(Vec3::normalize)
    }

    proptest! {
        #[test]
        fn a_turn_leads_from_one_direction_to_the_other(from in unit(), to in unit()) {
            prop_assert!(turned(from, turn_between(from, to)).distance(to) < 1e-4);
            prop_assert!(turned(from, turn_between(from, -from)).distance(-from) < 1e-4);
        }

        #[test]
        fn frames_are_square(direction in unit(), other in unit(), degrees in -360.0f32..360.0) {
            for frame in [upward(direction, other), rolled(upward(direction, other), degrees)] {
                prop_assert!((frame.determinant() - 1.0).abs() < 1e-4);
                prop_assert!(frame.y_axis.distance(direction) < 1e-6);
            }
        }
    }
}
