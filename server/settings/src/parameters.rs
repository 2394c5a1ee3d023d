//! The parameters of growth.
//!
//! The order of the rows is that of the JSON, which the hash of a document is made of.

use crate::{
    choice::choices,
    setting::Unit::{Degrees, Internodes, Metres, Steps},
    table::settings,
};

choices! {
    /// How vigor is shared out among the branches of a plant.
    VigorModel {
        /// At each node between the axis and its laterals (the extended Borchert-Honda model, TreeSketch §3.2).
        BorchertHonda = "borchert_honda",
        /// Along each axis by rank: what has more light for each bud weighs more (the priority model).
        Priority = "priority",
    }
}

settings! {
    /// All parameters of growth, in range or not.
    #[schemars(rename = "Parameters")]
    #[ts(rename = "Parameters")]
    ParameterValues / ParametersPatch {
        /// Length of one internode, the simulation's unit of length, for exports.
        internode_length: f32 = 0.1,
            range(0.005, 1.0), step(0.005), symbol("l"), unit(Metres), group("wood");
        /// Radius of the zone a bud occupies (TreeSketch Figure 8).
        occupancy_radius: f32 = 1.5,
            range(0.5, 6.0), step(0.1), symbol("r"), unit(Internodes), group("perception");
        /// Depth of the volume a bud perceives beyond its zone.
        perception_depth: f32 = 3.0,
            range(0.5, 10.0), step(0.1), symbol("d"), unit(Internodes), group("perception");
        /// Full opening angle of the perception volume.
        perception_angle: f32 = 90.0,
            range(20.0, 360.0), step(1.0), symbol("ζ"), unit(Degrees), group("perception");
        /// Angle between successive lateral buds around their axis.
        phyllotactic_angle: f32 = 137.5,
            range(0.0, 180.0), step(0.5), symbol("φ"), unit(Degrees), group("buds");
        /// Lateral buds at each node: 1 alternate, 2 opposite, more whorled.
        buds_per_node: u32 = 1, range(1.0, 4.0), group("buds");
        /// Angle between a lateral bud and its bearing axis.
        branching_angle: f32 = 50.0,
            range(0.0, 120.0), step(1.0), symbol("ψ"), unit(Degrees), group("fork");
        /// Angle by which an axis turns away from the lateral bud it has just passed.
        deflection_angle: f32 = 5.0,
            range(0.0, 45.0), step(0.5), symbol("δ"), unit(Degrees), group("fork");
        /// Share of vigor the main axis claims against its laterals.
        apical_control: f32 = 0.52, range(0.4, 0.7), step(0.005), symbol("λ"), group("vigor");
        /// Share of vigor the main axis claims when its plant is mature.
        mature_apical_control: f32 = 0.52, range(0.4, 0.7), step(0.005), group("sharing");
        /// Steps after a plant's seed at which its apical control begins to change.
        maturity_start: u32 = 0, range(0.0, 500.0), unit(Steps), group("sharing");
        /// Steps over which apical control turns into that of maturity; 0 if it never does.
        maturity_steps: u32 = 0, range(0.0, 500.0), unit(Steps), group("sharing");
        /// Exponent of a bud's response to light (Q = bL^κ).
        light_sensitivity: f32 = 1.0, range(0.0, 6.0), step(0.1), symbol("κ"), group("vigor");
        /// Internodes the most vigorous enabled bud adds in one step.
        max_shoot_length: u32 = 4, range(1.0, 20.0), symbol("nₘₐₓ"), group("vigor");
        /// Vigor per internode, over the vigor gain, below which a branch is shed.
        shedding_threshold: f32 = 0.0, range(0.0, 1.0), travel(0.3, 0.6), symbol("Th"), group("vigor");
        /// Vigor the whole plant receives per unit of light at its base (α of Borchert-Honda).
        vigor_gain: f32 = 2.0, range(0.1, 10.0), step(0.1), group("sharing");
        /// How vigor is shared out among branches.
        vigor_model: VigorModel = VigorModel::BorchertHonda, group("sharing");
        /// Least weight of the priority model, that of what ranks last on an axis.
        priority_least_weight: f32 = 0.006, range(0.001, 1.0), step(0.001), symbol("wₘᵢₙ"), group("sharing");
        /// Share of the ranking over which weight falls from 1 to the least in the priority model.
        priority_decline: f32 = 0.5, range(0.05, 1.0), symbol("κₚ"), group("sharing");
        /// Weight of an axis' present heading (H′ = αH + βT + γE); the three weights sum to 1.
        heading_weight: f32 = 0.5, range(0.0, 1.0), symbol("α"), group("weights");
        /// Weight of tropism.
        tropism_weight: f32 = 0.25, range(0.0, 1.0), symbol("β"), group("weights");
        /// Weight of the direction towards free space.
        space_weight: f32 = 0.25, range(0.0, 1.0), symbol("γ"), group("weights");
        /// How far the direction of growth turns from free space towards the light (−∇s).
        phototropism: f32 = 0.0, range(0.0, 1.0), group("buds");
        /// Gravitropic set-point angle from the vertical.
        setpoint_angle: f32 = 0.0,
            range(0.0, 180.0), step(1.0), symbol("θ"), unit(Degrees), group("tropism");
        /// The trunk tends upwards whatever the set-point angle is (TreeSketch §3.4).
        trunk_upward: bool = true, group("tropism");
        /// The direction of a brush stroke takes the place of the set-point angle (TreeSketch §3.4).
        tropism_from_stroke: bool = false, group("brush");
        /// Vertical half-axis of the gravimorphism ellipse (TreeSketch Figure 10).
        gravimorphism_vertical: f32 = 1.0, range(0.05, 3.0), step(0.05), symbol("sᵥ"), group("sides");
        /// Horizontal half-axis of the gravimorphism ellipse.
        gravimorphism_horizontal: f32 = 1.0, range(0.05, 3.0), step(0.05), symbol("sₚ"), group("sides");
        /// Shift of the gravimorphism ellipse over its vertical half-axis: above 0 epitony, below 0 hypotony.
        gravimorphism_shift: f32 = 0.0, range(-0.99, 0.99), symbol("eᵥ / sᵥ"), group("sides");
        /// Markers the brush sows per cubic internode and step.
        marker_density: f32 = 0.15, range(0.01, 1.0), group("brush");
        /// Markers a bud perceives on average while growing without guidance.
        markers_per_bud: u32 = 6, range(1.0, 32.0), group("buds");
        /// Steps a brush marker lives.
        marker_max_age: u32 = 8, range(1.0, 60.0), unit(Steps), group("brush");
        /// Shadow cast into the cubic internode around a metamer (a·b^−q); full light is 1.
        shadow_strength: f32 = 0.12, range(0.0, 1.0), symbol("a"), group("shade");
        /// Factor by which a shadow fades with each internode of height.
        shadow_decay: f32 = 2.0, range(1.1, 4.0), step(0.1), symbol("b"), group("shade");
        /// Internodes below a metamer that its shadow reaches.
        shadow_depth: u32 = 6, range(0.0, 8.0), symbol("qₘₐₓ"), group("shade");
        /// Exponent of da Vinci's rule for girth (dⁿ = Σ dᵢⁿ).
        girth_exponent: f32 = 2.5, range(2.0, 3.0), step(0.05), symbol("n"), group("wood");
        /// Diameter of a twig at its tip.
        twig_diameter: f32 = 0.07, range(0.02, 0.3), symbol("dₑ"), unit(Internodes), group("wood");
        /// Leaves at each node of a twig.
        leaves_per_node: u32 = 4, range(0.0, 15.0), group("leaves");
        /// Length of a leaf.
        leaf_size: f32 = 1.0, range(0.1, 3.0), step(0.05), unit(Internodes), group("leaves");
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::Kind;

    fn patch(text: &str) -> Result<ParametersPatch, String> {
        serde_json::from_str(text).map_err(|error: serde_json::Error| error.to_string())
    }

    #[test]
    fn defaults_are_in_range() {
        assert_eq!(ParameterValues::default().check(), Ok(()));
    }

    #[test]
    fn every_number_refuses_beyond_its_ends() {
        let defaults = serde_json::to_value(ParameterValues::default()).expect("plain values");
        for row in ParameterValues::ROWS {
            let Kind::Number { least, most, .. } = row.kind else { continue };
            let is_whole = defaults[row.name].is_u64();
            let checked = |value: f32| {
                let value = if is_whole { json!(value as u32) } else { json!(value) };
                let text = json!({ row.name: value }).to_string();
                ParameterValues::default().patched(&patch(&text).expect("a number")).check()
            };
            assert_eq!((checked(least), checked(most)), (Ok(()), Ok(())), "{}", row.name);
            let beyond = if is_whole { 1.0 } else { 0.001 };
            for bad in [least - beyond, most + beyond].into_iter().filter(|bad| !is_whole || *bad >= 0.0) {
                let error = checked(bad).expect_err(row.name);
                assert_eq!((error.field.as_str(), error.allowed), (row.name, row.allowed()));
            }
        }
    }

    #[test]
    fn what_is_not_a_number_is_in_no_range() {
        for bad in [f32::NAN, f32::INFINITY] {
            let values = ParameterValues { leaf_size: bad, ..ParameterValues::default() };
            assert_eq!(values.check().expect_err("out of range").field, "leaf_size");
        }
    }

    #[test]
    fn what_cannot_be_read_says_what_is_allowed() {
        for (text, expected) in [
            (r#"{"apical_control":null}"#, "invalid type: null, expected 0.4 to 0.7"),
            (r#"{"apical_control":"NaN"}"#, r#"invalid type: string "NaN", expected 0.4 to 0.7"#),
            (r#"{"max_shoot_length":-3}"#, "invalid value: integer `-3`, expected 1 to 20"),
            (r#"{"max_shoot_length":1.5}"#, "invalid value: floating point `1.5`, expected 1 to 20"),
            (r#"{"max_shoot_length":4294967296}"#, "integer `4294967296`, expected 1 to 20"),
            (r#"{"trunk_upward":1}"#, "invalid type: integer `1`, expected true, false"),
            (r#"{"vigor_model":"priory"}"#, "unknown name `priory`, expected borchert_honda, priority"),
            (r#"{"vigor_model":3}"#, "invalid type: integer `3`, expected borchert_honda, priority"),
            (r#"{"sap":1}"#, "unknown field `sap`, expected one of `internode_length`, `occupancy_radius`"),
            (r#"{"leaf_size":1,"leaf_size":2}"#, "duplicate field `leaf_size`"),
            ("[]", "invalid type: sequence, expected an object with fields among internode_length, "),
        ] {
            let error = patch(text).expect_err(text);
            assert!(error.contains(expected), "{text}: {error}");
        }
    }

    #[test]
    fn a_number_beyond_all_numbers_is_in_no_range() {
        let patch = patch(r#"{"leaf_size":-1e300}"#).expect("a number");
        assert_eq!(patch.leaf_size, Some(f32::NEG_INFINITY));
        assert!(ParameterValues::default().patched(&patch).check().is_err());
    }

    #[test]
    fn all_values_are_read_only_if_all_are_there() {
        let all = ParameterValues { buds_per_node: 2, ..ParameterValues::default() };
        let mut json = serde_json::to_value(&all).expect("plain values");
        assert_eq!(serde_json::from_value::<ParameterValues>(json.clone()).expect("all are there"), all);
        json.as_object_mut().expect("an object").remove("leaf_size");
        let error = serde_json::from_value::<ParameterValues>(json).expect_err("one is missing");
        assert_eq!(error.to_string(), "missing field `leaf_size`");
    }

    #[test]
    fn every_row_says_what_it_is() {
        for row in ParameterValues::ROWS {
            assert!(row.sentence.len() > 10 && row.sentence.ends_with('.'), "{}: {}", row.name, row.sentence);
            assert!(row.group.is_some(), "{} stands in no panel", row.name);
        }
    }

    #[test]
    fn steps_reach_both_ends_of_a_range() {
        for row in ParameterValues::ROWS {
            if let Kind::Number { least, most, step } = row.kind {
                let steps = f64::from(most - least) / f64::from(step);
                assert!((steps - steps.round()).abs() < 1e-3, "{}: {steps} steps", row.name);
            }
        }
    }
}
