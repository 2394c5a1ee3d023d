//! The parameters of growth: their ranges, their defaults, and what follows from them.

use core::{f32::consts::TAU, ops::Deref};

/// How vigor is shared out among the branches of a plant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum VigorModel {
    /// At each node between the axis and its laterals (the extended Borchert-Honda model, TreeSketch §3.2).
    #[default]
    BorchertHonda,
    /// Along each axis by rank: what has more light for each bud weighs more (the priority model).
    Priority,
}

/// Declares a plain set of values and their defaults in one table: numbers with their ranges, and choices.
macro_rules! values {
    (
        numbers { $($(#[doc = $doc:expr])+ $name:ident : $type:ty = $default:expr, in $low:expr, $high:expr;)+ }
        choices { $($(#[doc = $chosen_doc:expr])+ $chosen:ident : $choice:ty = $usual:expr;)+ }
    ) => {
        /// Values of all parameters, in range or not; angles in degrees, lengths in internodes.
        #[derive(Clone, Debug, PartialEq)]
        pub struct ParameterValues {
            $($(#[doc = $doc])+ pub $name: $type,)+
            $($(#[doc = $chosen_doc])+ pub $chosen: $choice,)+
        }

        impl Default for ParameterValues {
            fn default() -> Self {
                Self { $($name: $default,)+ $($chosen: $usual,)+ }
            }
        }

        impl ParameterValues {
            fn check_ranges(&self) -> Result<(), ParameterError> {
                $(
                    if !($low..=$high).contains(&self.$name) {
                        return Err(ParameterError {
                            name: stringify!($name),
                            value: self.$name.to_string(),
                            allowed: format!("{} to {}", $low, $high),
                        });
                    }
                )+
                Ok(())
            }
        }

        /// Name, least and greatest value of every numeric parameter.
        pub const RANGES: &[(&str, f32, f32)] = &[$((stringify!($name), $low as f32, $high as f32),)+];
    };
}

values! {
    numbers {
        /// Length of an internode in metres, for exports (l).
        internode_length: f32 = 0.1, in 0.005, 1.0;
        /// Radius of the zone a bud occupies (r, TreeSketch Figure 8).
        occupancy_radius: f32 = 1.5, in 0.5, 6.0;
        /// Depth of the perception volume beyond the zone (d).
        perception_depth: f32 = 3.0, in 0.5, 10.0;
        /// Full opening angle of the perception volume (ζ).
        perception_angle: f32 = 90.0, in 20.0, 360.0;
        /// Angle between successive lateral buds around their axis (φ).
        phyllotactic_angle: f32 = 137.5, in 0.0, 180.0;
        /// Lateral buds at each node.
        buds_per_node: u32 = 1, in 1, 4;
        /// Angle between a lateral bud and its bearing axis (ψ).
        branching_angle: f32 = 50.0, in 0.0, 120.0;
        /// Angle by which an axis turns away from a lateral bud (δ).
        deflection_angle: f32 = 5.0, in 0.0, 45.0;
        /// Share of vigor the main axis claims against its laterals (λ).
        apical_control: f32 = 0.52, in 0.4, 0.7;
        /// Share of vigor the main axis claims when its plant is mature.
        mature_apical_control: f32 = 0.52, in 0.4, 0.7;
        /// Steps after a plant's seed at which its apical control begins to change.
        maturity_start: u32 = 0, in 0, 500;
        /// Steps over which apical control turns into that of maturity; 0 if it never does.
        maturity_steps: u32 = 0, in 0, 500;
        /// Exponent of a bud's response to light (κ in Q = bL^κ).
        light_sensitivity: f32 = 1.0, in 0.0, 6.0;
        /// Internodes the most vigorous enabled bud adds in a step (n_max).
        max_shoot_length: u32 = 4, in 1, 20;
        /// Vigor per internode, over α, below which a branch is shed (Th).
        shedding_threshold: f32 = 0.0, in 0.0, 1.0;
        /// Vigor at the base per unit of light (α of Borchert-Honda).
        vigor_gain: f32 = 2.0, in 0.1, 10.0;
        /// Least weight of the priority model, that of what ranks last on an axis (w_min).
        priority_least_weight: f32 = 0.006, in 0.001, 1.0;
        /// Share of the ranking over which weight falls from 1 to the least (κ_p of the priority model).
        priority_decline: f32 = 0.5, in 0.05, 1.0;
        /// Weight of the present heading (α in H′ = αH + βT + γE).
        heading_weight: f32 = 0.5, in 0.0, 1.0;
        /// Weight of tropism (β).
        tropism_weight: f32 = 0.25, in 0.0, 1.0;
        /// Weight of the direction towards free space (γ).
        space_weight: f32 = 0.25, in 0.0, 1.0;
        /// How far the direction of growth turns from free space towards the light (-∇s), 0 to 1.
        phototropism: f32 = 0.0, in 0.0, 1.0;
        /// Gravitropic set-point angle from the vertical (θ).
        setpoint_angle: f32 = 0.0, in 0.0, 180.0;
        /// Vertical half-axis of the gravimorphism ellipse (s_v, TreeSketch Figure 10).
        gravimorphism_vertical: f32 = 1.0, in 0.05, 3.0;
        /// Horizontal half-axis of the gravimorphism ellipse (s_p).
        gravimorphism_horizontal: f32 = 1.0, in 0.05, 3.0;
        /// Shift of the ellipse along the vertical, over s_v (e_v / s_v).
        gravimorphism_shift: f32 = 0.0, in -0.99, 0.99;
        /// Markers the brush sows per cubic internode and step.
        marker_density: f32 = 0.15, in 0.01, 1.0;
        /// Markers a bud perceives on average in autonomous growth.
        markers_per_bud: u32 = 6, in 1, 32;
        /// Steps a brush marker lives.
        marker_max_age: u32 = 8, in 1, 60;
        /// Shadow cast into the cubic internode around a metamer, full light being 1 (a in a·b^-q).
        shadow_strength: f32 = 0.12, in 0.0, 1.0;
        /// Factor by which a shadow fades with each internode of height (b).
        shadow_decay: f32 = 2.0, in 1.1, 4.0;
        /// Internodes below a metamer that its shadow reaches (q_max).
        shadow_depth: u32 = 6, in 0, 8;
        /// Exponent of da Vinci's rule (n).
        girth_exponent: f32 = 2.5, in 2.0, 3.0;
        /// Diameter of a twig at its tip (d_e).
        twig_diameter: f32 = 0.07, in 0.02, 0.3;
        /// Leaves at each node of a twig.
        leaves_per_node: u32 = 4, in 0, 15;
        /// Length of a leaf.
        leaf_size: f32 = 1.0, in 0.1, 3.0;
    }
    choices {
        /// The trunk tends upwards whatever the set-point angle is (TreeSketch §3.4).
        trunk_upward: bool = true;
        /// A stroke's direction takes the place of the set-point angle (TreeSketch §3.4).
        tropism_from_stroke: bool = false;
        /// How vigor is shared out among branches.
        vigor_model: VigorModel = VigorModel::BorchertHonda;
    }
}

/// A value outside its range.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{name} is {value}; allowed: {allowed}")]
pub struct ParameterError {
    /// The parameter.
    pub name: &'static str,
    /// What it was to be.
    pub value: String,
    /// What it may be.
    pub allowed: String,
}

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
    pub fn new(values: ParameterValues) -> Result<Self, ParameterError> {
        values.check_ranges()?;
        let sum = values.heading_weight + values.tropism_weight + values.space_weight;
        if (sum - 1.0).abs() > WEIGHT_TOLERANCE {
            return Err(ParameterError {
                name: "heading_weight",
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
    fn defaults_are_in_range() {
        assert!(Parameters::new(ParameterValues::default()).is_ok());
    }

    #[test]
    fn both_ends_pass_and_beyond_fails() {
        let with_r =
            |r| Parameters::new(ParameterValues { occupancy_radius: r, ..ParameterValues::default() });
        assert!(with_r(0.5).is_ok() && with_r(6.0).is_ok());
        for bad in [0.49, 6.01, f32::NAN, f32::INFINITY] {
            let error = with_r(bad).expect_err("out of range");
            assert_eq!((error.name, error.allowed.as_str()), ("occupancy_radius", "0.5 to 6"));
        }
    }

    #[test]
    fn weights_must_sum_to_one() {
        let values = ParameterValues { space_weight: 0.5, ..ParameterValues::default() };
        assert!(Parameters::new(values).is_err());
    }
}
