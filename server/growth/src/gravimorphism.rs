//! Gravimorphism: which side of a slanted axis its lateral buds thrive on (TreeSketch §3.2, Figure 10).

use espalier_settings::ParameterValues;
use glam::Vec3;

/// Propensity b of a lateral bud to grow, from the axis' heading H and the bud's direction.
///
/// b = cos²τ + d·sin²τ (TreeSketch eq. 1), with τ the angle of H to the vertical and d the distance from the
/// axis to the control ellipse in the bud's polar direction χ.
pub fn propensity(heading: Vec3, bud: Vec3, parameters: &ParameterValues) -> f32 {
    let cos_squared = (heading.y * heading.y).min(1.0);
    let sin_squared = 1.0 - cos_squared;
    // V is the most vertical direction across H; without one the axis is upright, and b is 1 anyway.
    let Some(vertical) = (Vec3::Y - heading * heading.y).try_normalize() else { return 1.0 };
    if sin_squared < 1e-8 {
        return 1.0;
    }
    let parallel = heading.cross(vertical);
    let (along_v, along_p) = (bud.dot(vertical), bud.dot(parallel));
    let across = (along_v * along_v + along_p * along_p).sqrt();
    if across < 1e-6 {
        return 1.0;
    }
    cos_squared + ellipse_distance(along_v / across, along_p / across, parameters) * sin_squared
}

/// Distance from the axis to the ellipse with half-axes s_v, s_p and centre e_v on V, in direction (cos χ, sin χ).
fn ellipse_distance(cos: f32, sin: f32, parameters: &ParameterValues) -> f32 {
    let (s_v, s_p) = (parameters.gravimorphism_vertical, parameters.gravimorphism_horizontal);
    let e_v = parameters.gravimorphism_shift * s_v;
    let a = cos * cos / (s_v * s_v) + sin * sin / (s_p * s_p);
    let b = e_v * cos / (s_v * s_v);
    let c = e_v * e_v / (s_v * s_v) - 1.0;
    // |e_v| < s_v keeps the axis inside the ellipse, so there is exactly one positive root.
    ((b + (b * b - a * c).max(0.0).sqrt()) / a).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(shift: f32, s_v: f32, s_p: f32) -> ParameterValues {
        ParameterValues {
            gravimorphism_shift: shift,
            gravimorphism_vertical: s_v,
            gravimorphism_horizontal: s_p,
            ..ParameterValues::default()
        }
    }

    #[test]
    fn unit_circle_favours_no_side() {
        for bud in [Vec3::Y, -Vec3::Y, Vec3::Z] {
            assert!((propensity(Vec3::X, bud, &with(0.0, 1.0, 1.0)) - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn epitony_favours_the_upper_side() {
        let b = |bud| propensity(Vec3::X, bud, &with(0.5, 1.0, 1.0));
        assert!((b(Vec3::Y) - 1.5).abs() < 1e-6 && (b(-Vec3::Y) - 0.5).abs() < 1e-6);
    }

    #[test]
    fn amphitony_favours_the_sides() {
        let b = |bud| propensity(Vec3::X, bud, &with(0.0, 0.5, 1.5));
        assert!((b(Vec3::Z) - 1.5).abs() < 1e-6 && (b(Vec3::Y) - 0.5).abs() < 1e-6);
    }

    #[test]
    fn upright_axes_feel_nothing() {
        assert!((propensity(Vec3::Y, Vec3::X, &with(0.9, 0.1, 3.0)) - 1.0).abs() < 1e-6);
    }
}
