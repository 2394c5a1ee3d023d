//! The parameters of growth as they travel. Names, ranges and defaults stand in `PROTOCOL.md`.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// How vigor is shared out among the branches of a plant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum VigorModel {
    /// At each node between the axis and its laterals (the extended Borchert-Honda model).
    #[default]
    BorchertHonda,
    /// Along each axis by rank: what has more light for each bud weighs more.
    Priority,
}

/// Declares the full set and the patch together, so that they cannot differ.
macro_rules! parameters {
    ($($(#[doc = $doc:expr])+ $name:ident : $type:ty,)+) => {
        /// All parameters of growth.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
        #[serde(deny_unknown_fields)]
        pub struct Parameters {
            $($(#[doc = $doc])+ pub $name: $type,)+
        }

        /// Some of the parameters: those to change.
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS)]
        #[serde(deny_unknown_fields)]
        pub struct ParametersPatch {
            $(
                $(#[doc = $doc])+
                #[serde(default, deserialize_with = "crate::present", skip_serializing_if = "Option::is_none")]
                #[ts(optional)]
                pub $name: Option<$type>,
            )+
        }

        impl From<Parameters> for ParametersPatch {
            /// Sets every parameter.
            fn from(all: Parameters) -> Self {
                Self { $($name: Some(all.$name),)+ }
            }
        }

        impl Parameters {
            /// These parameters with the patch's fields put in.
            #[must_use]
            pub fn patched(&self, patch: &ParametersPatch) -> Self {
                Self { $($name: patch.$name.clone().unwrap_or_else(|| self.$name.clone()),)+ }
            }
        }
    };
}

parameters! {
    /// Length of one internode in metres (l); the simulation's unit of length, used by exports.
    internode_length: f32,
    /// Radius of the zone a bud occupies, in internodes (r).
    occupancy_radius: f32,
    /// Depth of the volume a bud perceives beyond its zone, in internodes (d).
    perception_depth: f32,
    /// Full opening angle of the perception volume, in degrees (ζ).
    perception_angle: f32,
    /// Angle between successive lateral buds around their axis, in degrees (φ).
    phyllotactic_angle: f32,
    /// Lateral buds at each node: 1 alternate, 2 opposite, more whorled.
    buds_per_node: u32,
    /// Angle between a lateral bud and its bearing axis, in degrees (ψ).
    branching_angle: f32,
    /// Angle by which an axis turns away from the lateral bud it has just passed, in degrees (δ).
    deflection_angle: f32,
    /// Share of vigor the main axis claims against its laterals (λ).
    apical_control: f32,
    /// Share of vigor the main axis claims when its plant is mature.
    mature_apical_control: f32,
    /// Steps after a plant's seed at which its apical control begins to change.
    maturity_start: u32,
    /// Steps over which apical control turns into that of maturity; 0 if it never does.
    maturity_steps: u32,
    /// Exponent of a bud's response to light (κ in Q = bL^κ).
    light_sensitivity: f32,
    /// Internodes the most vigorous enabled bud adds in one step (n_max).
    max_shoot_length: u32,
    /// Vigor per internode below which a branch is shed (Th).
    shedding_threshold: f32,
    /// Vigor the whole plant receives per unit of light at its base (α of Borchert-Honda).
    vigor_gain: f32,
    /// How vigor is shared out among branches.
    vigor_model: VigorModel,
    /// Least weight of the priority model, that of what ranks last on an axis (w_min).
    priority_least_weight: f32,
    /// Share of the ranking over which weight falls from 1 to the least (κ_p of the priority model).
    priority_decline: f32,
    /// Weight of an axis' present heading (α in H′ = αH + βT + γE).
    heading_weight: f32,
    /// Weight of tropism (β).
    tropism_weight: f32,
    /// Weight of the direction towards free space (γ).
    space_weight: f32,
    /// How far the direction of growth turns from free space towards the light, 0 to 1.
    phototropism: f32,
    /// Gravitropic set-point angle from the vertical, in degrees (θ).
    setpoint_angle: f32,
    /// The trunk tends upwards whatever the set-point angle is.
    trunk_upward: bool,
    /// The direction of a brush stroke takes the place of the set-point angle.
    tropism_from_stroke: bool,
    /// Vertical half-axis of the gravimorphism ellipse (s_v).
    gravimorphism_vertical: f32,
    /// Horizontal half-axis of the gravimorphism ellipse (s_p).
    gravimorphism_horizontal: f32,
    /// Shift of the gravimorphism ellipse, as a fraction of s_v: above 0 epitony, below 0 hypotony (e_v / s_v).
    gravimorphism_shift: f32,
    /// Markers the brush sows per cubic internode and step.
    marker_density: f32,
    /// Markers a bud perceives on average while growing without guidance.
    markers_per_bud: u32,
    /// Steps a brush marker lives.
    marker_max_age: u32,
    /// Shadow cast into the cubic internode around a metamer (a in a·b^-q); full light is 1.
    shadow_strength: f32,
    /// Factor by which a shadow fades with each internode of height (b).
    shadow_decay: f32,
    /// Internodes below a metamer that its shadow reaches (q_max).
    shadow_depth: u32,
    /// Exponent of da Vinci's rule for girth (n in d^n = Σ d_i^n).
    girth_exponent: f32,
    /// Diameter of a twig at its tip, in internodes (d_e).
    twig_diameter: f32,
    /// Leaves at each node of a twig.
    leaves_per_node: u32,
    /// Length of a leaf, in internodes.
    leaf_size: f32,
}
