//! The parameters of growth in range, and what follows from them.

use core::{f32::consts::TAU, ops::Deref};

use espalier_settings::{OutOfRange, ParameterValues};

/// Parameters in range, with what is computed from them once.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameters {
    values: ParameterValues,
    /// Cosine of half the perception angle (ζ/2).
    pub(crate) cos_half_perception: f32,
    /// Sine and cosine of the branching angle (ψ).
    pub(crate) branching: (f32, f32),
    /// Sine and cosine of the deflection angle (δ).
    pub(crate) deflection: (f32, f32),
    /// Sine and cosine of the set-point angle (θ).
    pub(crate) setpoint: (f32, f32),
    /// Sine and cosine of the phyllotactic angle (φ).
    pub(crate) phyllotaxis: (f32, f32),
    /// Whether gravimorphism favours any side at all.
    pub(crate) is_gravimorphic: bool,
    /// Sine and cosine of each lateral's turn around its node.
    pub(crate) whorl: [(f32, f32); MAX_LATERALS],
    /// Whether everything grows in the plane z = 0.
    pub(crate) is_flat: bool,
}

const WEIGHT_TOLERANCE: f32 = 1e-3;
/// Smaller phyllotactic angles leave successive buds on one side, as far as a plane has sides.
const LEAST_ALTERNATE_ANGLE: f32 = 60.0;
/// Lateral buds at one node at most.
pub(crate) const MAX_LATERALS: usize = 4;

impl Parameters {
    /// Takes values that are all in range, and whose three weights sum to 1.
    pub fn new(values: ParameterValues) -> Result<Self, OutOfRange> {
        values.check()?;
        let sum = values.heading_weight + values.tropism_weight + values.space_weight;
        if (sum - 1.0).abs() > WEIGHT_TOLERANCE {
            return Err(OutOfRange {
                field: "heading_weight".to_owned(),
                value: format!(
                    "{}, which with tropism_weight and space_weight sums to {sum}",
                    values.heading_weight
                ),
                allowed: "heading_weight + tropism_weight + space_weight = 1".to_owned(),
            });
        }
        let cos_half_perception = libm::cosf((0.5 * values.perception_angle).to_radians());
        Ok(Self {
            cos_half_perception,
            is_gravimorphic: (
                values.gravimorphism_vertical,
                values.gravimorphism_horizontal,
                values.gravimorphism_shift,
            ) != (1.0, 1.0, 0.0),
            whorl: core::array::from_fn(|i| libm::sincosf(TAU * i as f32 / values.buds_per_node as f32)),
            branching: sin_cos(values.branching_angle),
            deflection: sin_cos(values.deflection_angle),
            setpoint: sin_cos(values.setpoint_angle),
            phyllotaxis: sin_cos(values.phyllotactic_angle),
            is_flat: false,
            values,
        })
    }

    /// The same for a plant that grows in the plane z = 0, exactly: markers lie in it, and lateral buds to the left
    /// and to the right.
    #[must_use]
    pub fn flat(mut self) -> Self {
        // As sine and cosine, so that what is turned by them stays in the plane to the last bit.
        const HERE: (f32, f32) = (0.0, 1.0);
        const OPPOSITE: (f32, f32) = (0.0, -1.0);
        self.is_flat = true;
        self.values.buds_per_node = self.values.buds_per_node.min(2);
        self.phyllotaxis =
            if self.values.phyllotactic_angle < LEAST_ALTERNATE_ANGLE { HERE } else { OPPOSITE };
        self.whorl = [HERE, OPPOSITE, HERE, OPPOSITE];
        self
    }

    /// The plain values.
    pub fn values(&self) -> &ParameterValues {
        &self.values
    }

    /// How far a bud perceives (r + d).
    pub fn perception_radius(&self) -> f32 {
        self.values.occupancy_radius + self.values.perception_depth
    }

    /// Apical control λ of a plant so many steps after its seed.
    pub(crate) fn apical_control_at(&self, age: u32) -> f32 {
        let (start, steps) = (self.values.maturity_start, self.values.maturity_steps);
        if steps == 0 {
            return self.values.apical_control;
        }
        let matured = (age.saturating_sub(start) as f32 / steps as f32).min(1.0);
        self.values.apical_control
            + (self.values.mature_apical_control - self.values.apical_control) * matured
    }

    /// Whether light and shadow mean the same under both sets.
    pub(crate) fn casts_like(&self, other: &Self) -> bool {
        (self.shadow_strength, self.shadow_decay, self.shadow_depth)
            == (other.shadow_strength, other.shadow_decay, other.shadow_depth)
    }
}

impl Default for Parameters {
    fn default() -> Self {
        // The table's defaults lie in the table's ranges; a test holds them to it.
        Self::new(ParameterValues::default())
            .unwrap_or_else(|error| unreachable!("defaults are in range: {error}"))
    }
}

impl Deref for Parameters {
    type Target = ParameterValues;

    fn deref(&self) -> &ParameterValues {
        &self.values
    }
}

fn sin_cos(degrees: f32) -> (f32, f32) {
    libm::sincosf(degrees.to_radians())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_in_range() {
        assert!(Parameters::new(ParameterValues::default()).is_ok());
        let values = ParameterValues { occupancy_radius: f32::NAN, ..ParameterValues::default() };
        assert_eq!(Parameters::new(values).expect_err("out of range").field, "occupancy_radius");
    }

    #[test]
    fn weights_must_sum_to_one() {
        let values = ParameterValues { space_weight: 0.5, ..ParameterValues::default() };
        assert!(Parameters::new(values).is_err());
    }
}
