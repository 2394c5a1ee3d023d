//! The direction of each new internode (TreeSketch §3.2, Figure 11): H′ = αH + βT + γE.

use core::f32::consts::TAU;

use glam::Vec3;

use crate::{parameters::Parameters, random::Draw};

/// The tropic direction T of an axis.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Tropism {
    /// Keep the set-point angle to the vertical; from the vertical itself chance says where to bend.
    SetPoint,
    /// Go this way: upwards for a forced trunk, or along a stroke.
    Towards(Vec3),
}

impl Tropism {
    /// T for an internode with this heading.
    fn vector(self, heading: Vec3, parameters: &Parameters, chance: impl FnOnce() -> Draw) -> Vec3 {
        match self {
            Self::Towards(direction) => direction,
            Self::SetPoint => {
                let (sin, cos) = parameters.setpoint;
                let level = Vec3::new(heading.x, 0.0, heading.z);
                // Near the vertical the plane of bending is a matter of chance, but of one chance per axis.
                let outward = if level.length_squared() < 1e-4 {
                    azimuth(chance(), parameters)
                } else {
                    level.normalize()
                };
                Vec3::Y * cos + outward * sin
            }
        }
    }
}

/// The horizontal direction that chance gives an axis.
pub(crate) fn azimuth(chance: Draw, parameters: &Parameters) -> Vec3 {
    if parameters.is_flat {
        return if chance.unit(0) < 0.5 { Vec3::X } else { Vec3::NEG_X };
    }
    let (sin, cos) = libm::sincosf(TAU * chance.unit(0));
    Vec3::new(cos, 0.0, sin)
}

/// H′ from the heading H, tropism, and the direction E to free space where there is one, by their weights. `chance`
/// decides where nothing else does.
pub(crate) fn next_heading(
    heading: Vec3,
    tropism: Tropism,
    space: Option<Vec3>,
    [alpha, beta, gamma]: [f32; 3],
    parameters: &Parameters,
    chance: impl FnOnce() -> Draw,
) -> Vec3 {
    let tropism = tropism.vector(heading, parameters, chance);
    let sum = alpha * heading + beta * tropism + gamma * space.unwrap_or(Vec3::ZERO);
    // Forces that cancel leave the axis as it goes.
    if sum.length_squared() < 1e-6 { heading } else { sum.normalize() }
}

/// Turns `vector` the way that turns the unit vector `from` into the unit vector `to`, by the shorter arc.
pub(crate) fn transport(vector: Vec3, from: Vec3, to: Vec3) -> Vec3 {
    let cos = from.dot(to);
    if cos < -0.9999 {
        // A reversal has no shorter arc; what lay across still lies across.
        return vector;
    }
    let axis = from.cross(to);
    vector + axis.cross(vector) + axis.cross(axis.cross(vector)) / (1.0 + cos)
}

/// Turns `vector`, which lies across the unit vector `around`, by an angle given by sine and cosine.
pub(crate) fn turn(vector: Vec3, around: Vec3, (sin, cos): (f32, f32)) -> Vec3 {
    vector * cos + around.cross(vector) * sin
}

/// The least sine, squared, of an angle between two vectors at which one still says a direction across the other.
const ALONG: f32 = 1e-6;

/// The unit vector across `heading` that is nearest to `vector`; any, where that lies along it.
pub(crate) fn across(vector: Vec3, heading: Vec3) -> Vec3 {
    let aside = vector - heading * vector.dot(heading);
    // What is left of a vector along the heading is rounding, and rounding is not across anything.
    Some(aside)
        .filter(|aside| aside.length_squared() > ALONG * vector.length_squared())
        .and_then(Vec3::try_normalize)
        .unwrap_or_else(|| heading.any_orthonormal_vector())
}

#[cfg(test)]
mod tests {
    use super::*;
    use espalier_settings::ParameterValues;

    use crate::random::Purpose;

    fn settled(theta: f32) -> f32 {
        let values = ParameterValues {
            setpoint_angle: theta,
            heading_weight: 0.7,
            tropism_weight: 0.3,
            space_weight: 0.0,
            ..ParameterValues::default()
        };
        let parameters = Parameters::new(values).expect("in range");
        let mut heading = Vec3::new(0.6, 0.8, 0.0);
        for _ in 0..60 {
            let chance = || Draw::new(1, Purpose::Azimuth, 0, 0);
            heading = next_heading(heading, Tropism::SetPoint, None, [0.7, 0.3, 0.0], &parameters, chance);
        }
        heading.y
    }

    #[test]
    fn axes_settle_at_their_set_point_angle() {
        assert!((settled(0.0) - 1.0).abs() < 1e-3);
        assert!(settled(90.0).abs() < 1e-3);
        assert!((settled(120.0) + 0.5).abs() < 1e-3);
    }

    /// What rounding leaves of a vector along the heading is no direction across it.
    #[test]
    fn what_is_across_is_square_to_headings_that_a_vector_lies_along() {
        let heading = Vec3::new(0.3, 0.8, -0.4).normalize();
        let aside = heading.any_orthonormal_vector();
        for lean in [0.0, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 0.1] {
            for vector in [heading + aside * lean, heading * 0.999_999_9 - aside * lean] {
                let found = across(vector, heading);
                assert!(found.dot(heading).abs() < 2e-4, "{lean}: {found} to {heading}");
                assert!((found.length() - 1.0).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn transport_keeps_angles() {
        let (from, to) = (Vec3::Y, Vec3::new(0.6, 0.0, 0.8));
        let moved = transport(Vec3::X, from, to);
        assert!(moved.dot(to).abs() < 1e-6 && (moved.length() - 1.0).abs() < 1e-6);
        assert!((transport(from, from, to) - to).length() < 1e-6);
    }
}
