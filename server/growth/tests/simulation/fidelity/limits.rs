//! Parameters at the ends of their ranges, alone and together, and a tree at the end of its budget.

use espalier_growth::{ParameterValues, Parameters, VigorModel};
use espalier_plant::checks;
use espalier_settings::Kind;
use proptest::prelude::*;

use super::*;

/// Every number, with its least and its greatest value.
fn ranges() -> impl Iterator<Item = (&'static str, f32, f32)> {
    ParameterValues::ROWS.iter().filter_map(|row| match row.kind {
        Kind::Number { least, most, .. } => Some((row.name, least, most)),
        _ => None,
    })
}

/// Sets a number by its name.
fn set(values: &mut ParameterValues, name: &str, value: f32) {
    let mut json = serde_json::to_value(&*values).expect("plain values");
    let is_whole = json[name].is_u64();
    json[name] = if is_whole { (value as u32).into() } else { value.into() };
    *values = serde_json::from_value(json).expect("numbers of the right type");
}

/// Makes the three weights sum to 1, keeping `kept` if it is one of them.
fn balance(values: &mut ParameterValues, kept: &str) {
    let mut weights = [values.heading_weight, values.tropism_weight, values.space_weight];
    let kept = ["heading_weight", "tropism_weight", "space_weight"].iter().position(|&name| name == kept);
    let fixed = kept.map_or(0.0, |kept| weights[kept]);
    let others: f32 = weights.iter().sum::<f32>() - fixed;
    for (i, weight) in weights.iter_mut().enumerate().filter(|&(i, _)| Some(i) != kept) {
        *weight = if others > 0.0 { *weight / others * (1.0 - fixed) } else { f32::from(i == 0) };
    }
    [values.heading_weight, values.tropism_weight, values.space_weight] = weights;
}

/// Grows by itself and under the brush; returns what is wrong with the plant.
fn grown(values: ParameterValues, seed: u32) -> Result<Simulation, String> {
    let mut tree = Simulation::new(seed, Parameters::new(values).map_err(|error| error.to_string())?);
    tree.set_metamer_budget(3000);
    grow(&mut tree, 6);
    brush(&mut tree, 1, &[(Vec3::Y * 3.0, 4.0), (Vec3::Y * 7.0, 2.0)]);
    checks::all(tree.plant()).map_err(|failure| format!("{failure:?}"))?;
    let is_sound = |node: &Vec3| node.is_finite() && node.y >= 0.0;
    if !nodes(&tree).iter().all(is_sound) {
        return Err("a node is nowhere or underground".to_owned());
    }
    Ok(tree)
}

/// Each parameter at its least and its greatest value, the others at their defaults, grows a sound plant, and not
/// an empty one.
#[test]
fn every_range_end_grows_a_sound_plant() {
    for (name, low, high) in ranges() {
        for value in [low, high] {
            let mut values = ParameterValues::default();
            if name.starts_with("priority") {
                values.vigor_model = VigorModel::Priority;
            }
            set(&mut values, name, value);
            balance(&mut values, name);
            match grown(values, 1) {
                Ok(tree) => {
                    let count = tree.plant().living_count();
                    assert!(count >= 6, "{name} = {value}: {count} metamers");
                }
                Err(reason) => panic!("{name} = {value}: {reason}"),
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// All parameters at one end of their ranges or the other at once.
    #[test]
    fn every_corner_of_the_ranges_is_sound(seed: u32, ends in any::<u64>(), choices in any::<u8>()) {
        let mut values = ParameterValues::default();
        for (i, (name, low, high)) in ranges().enumerate() {
            set(&mut values, name, if ends >> i & 1 == 0 { low } else { high });
        }
        balance(&mut values, "");
        values.trunk_upward = choices & 1 == 0;
        values.tropism_from_stroke = choices & 2 == 0;
        if choices & 4 == 0 {
            values.vigor_model = VigorModel::Priority;
        }
        if let Err(reason) = grown(values.clone(), seed) {
            return Err(TestCaseError::fail(format!("{reason}: {values:?}")));
        }
    }
}

/// At the budget growth stops, says so, and goes on where it stopped once there is more.
#[test]
fn a_spent_budget_stops_growth_and_loses_nothing() {
    let mut tree = simulation(1);
    tree.set_metamer_budget(1000);
    while !tree.is_out_of_budget() {
        grow(&mut tree, 1);
    }
    assert_eq!(tree.plant().metamer_count(), 1000);
    let (hash, step) = (tree.plant().hash(), tree.plant().step());
    grow(&mut tree, 3);
    assert!(tree.is_out_of_budget());
    assert_eq!(
        (tree.plant().hash(), tree.plant().step()),
        (hash, step),
        "steps without growth leave no trace"
    );
    // What it holds is what an unbounded tree holds, but for the step that was cut short.
    let mut unbounded = simulation(1);
    grow(&mut unbounded, step);
    tree.go_to(step - 1);
    unbounded.go_to(step - 1);
    assert_eq!(nodes(&tree), nodes(&unbounded));
    tree.go_to(step);
    assert_eq!(tree.plant().hash(), hash);
    tree.set_metamer_budget(1200);
    grow(&mut tree, 1);
    assert!(tree.plant().metamer_count() > 1000);
    assert_eq!(checks::all(tree.plant()), Ok(()));
}
