//! Species: sets of parameters with a name, and how a tree of that form grows up.
//!
//! [`Species::parameters`] are ordinary parameters, good for brush and autonomous growth alike. [`Species::schedule`] is a
//! whole life that begins with them and ends in the tree of the contact sheet, for one set of parameters from seed to age
//! does not make every form (TreeSketch §3.4 and Figure 17, trees A3 and C1). Who picks a species puts both into force.

mod broadleaves;
mod conifers;
mod shaped;

use std::sync::LazyLock;

use espalier_settings::{
    Appearance, FlowerKind, FlowerLook, FruitKind, FruitLook, ParameterValues, Place, Tint,
};
use glam::Vec3;

use crate::brush::BrushSample;

/// A form of growth with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Species {
    /// Short name for links and the command line: small letters and hyphens.
    pub slug: &'static str,
    /// Name as people say it.
    pub name: &'static str,
    /// Botanical name, or what the style is called.
    pub botanical: &'static str,
    /// What tells it from others, in one sentence.
    pub sentence: &'static str,
    /// What it looks like; its background and wind are the default ones and are not applied.
    pub appearance: Appearance,
    /// What it stands on in a picture.
    pub stand: Stand,
    /// The parameters it begins with.
    pub parameters: ParameterValues,
    /// Its life, stage by stage.
    pub schedule: Vec<Stage>,
}

/// One stage of a life.
#[derive(Clone, Debug, PartialEq)]
pub enum Stage {
    /// So many steps without guidance.
    Grow(u32),
    /// From here on these parameters.
    Change(Box<ParameterValues>),
    /// Another seed of the same kind, on the ground at x and z.
    Sow(f32, f32),
    /// One stroke of the brush, which moves from each place to the next, or rests where a place is repeated.
    Brush(Vec<BrushSample>),
}

/// What a plant stands on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Stand {
    /// Open ground.
    #[default]
    Ground,
    /// A shallow tray.
    Tray,
    /// A tall pot.
    Pot,
}

/// All species, in the order of the contact sheet.
pub fn all() -> &'static [Species] {
    static ALL: LazyLock<Vec<Species>> =
        LazyLock::new(|| [broadleaves::all(), conifers::all(), shaped::all()].concat());
    &ALL
}

/// The species with a slug.
pub fn find(slug: &str) -> Option<&'static Species> {
    all().iter().find(|species| species.slug == slug)
}

/// The default parameters, some of them changed.
fn with(change: impl FnOnce(&mut ParameterValues)) -> ParameterValues {
    let mut values = ParameterValues::default();
    change(&mut values);
    values
}

/// These values, some of them changed.
fn changed(values: &ParameterValues, change: impl FnOnce(&mut ParameterValues)) -> ParameterValues {
    let mut values = values.clone();
    change(&mut values);
    values
}

/// From here on these values, some of them changed.
fn turn(values: &ParameterValues, change: impl FnOnce(&mut ParameterValues)) -> Stage {
    Stage::Change(Box::new(changed(values, change)))
}

/// Flowers on all shoots alike.
fn flower(kind: FlowerKind, tint: Tint, size: f32, share: f32, place: Place) -> FlowerLook {
    FlowerLook { kind, tint, size, share, place, vigor: 0.0 }
}

/// Fruits, rather on the more vigorous shoots.
fn fruit(kind: FruitKind, tint: Tint, size: f32, share: f32, place: Place) -> FruitLook {
    FruitLook { kind, tint, size, share, place, vigor: 0.25 }
}

/// A bare pole first, then the rest of its life.
fn life(first: [Stage; 3], rest: impl IntoIterator<Item = Stage>) -> Vec<Stage> {
    first.into_iter().chain(rest).collect()
}

/// Sets α, β and γ, which belong together: they sum to 1.
fn weigh(values: &mut ParameterValues, heading: f32, tropism: f32) {
    values.heading_weight = heading;
    values.tropism_weight = tropism;
    values.space_weight = 1.0 - heading - tropism;
}

/// A stroke through places (x, y, z, radius).
fn stroke(places: &[(f32, f32, f32, f32)]) -> Stage {
    let sample =
        |&(x, y, z, radius): &(f32, f32, f32, f32)| BrushSample { position: Vec3::new(x, y, z), radius };
    Stage::Brush(places.iter().map(sample).collect())
}

/// Strokes of the brush outwards, as the ribs of an umbrella go: a canopy of some height and reach, whose rim is lower by
/// `droop`. The brush is so wide at the rim, and three quarters of it where a rib begins.
fn canopy(ribs: u8, [height, droop]: [f32; 2], reach: f32, radius: f32) -> Vec<Stage> {
    /// Where a rib begins, as a share of the reach, and how many places it has.
    const BEGIN: f32 = 0.28;
    const PLACES: u8 = 3;
    let rib = |rib: u8| {
        let (sin, cos) = libm::sincosf(core::f32::consts::TAU * f32::from(rib) / f32::from(ribs));
        let places = (0..PLACES).map(|place| {
            let gone = f32::from(place) / f32::from(PLACES - 1);
            let out = BEGIN + (1.0 - BEGIN) * gone;
            let position = Vec3::new(reach * out * cos, height - droop * out * out, reach * out * sin);
            BrushSample { position, radius: radius * (0.75 + 0.25 * gone) }
        });
        Stage::Brush(places.collect())
    };
    (0..ribs).map(rib).collect()
}

/// Grows a bare pole first: laterals are given up as soon as they are judged.
fn pole(parameters: &ParameterValues, steps: u32) -> [Stage; 3] {
    let young = turn(parameters, |p| {
        p.shedding_threshold = 0.9;
        p.apical_control = 0.5;
        p.shadow_strength = 0.2;
        p.light_sensitivity = 1.0;
        p.max_shoot_length = 4;
        p.trunk_upward = true;
    });
    [young, Stage::Grow(steps), Stage::Change(Box::new(parameters.clone()))]
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::{NoObserver, Parameters, Simulation, StepInput};

    #[test]
    fn slugs_are_unique_and_plain() {
        let slugs: BTreeSet<&str> = all().iter().map(|species| species.slug).collect();
        assert!(slugs.len() == all().len() && slugs.len() >= 22, "{} of {}", slugs.len(), all().len());
        for slug in slugs {
            assert!(slug.bytes().all(|b| b.is_ascii_lowercase() || b == b'-') && !slug.is_empty(), "{slug}");
            assert_eq!(find(slug).map(|species| species.slug), Some(slug));
        }
        assert_eq!(find("triffid"), None);
    }

    #[test]
    fn every_species_says_what_it_is() {
        for species in all() {
            assert!(!species.name.is_empty() && !species.botanical.is_empty(), "{}", species.slug);
            assert!(species.sentence.len() > 40 && species.sentence.ends_with('.'), "{}", species.slug);
        }
    }

    #[test]
    fn appearances_of_all_species_are_in_range() {
        for species in all() {
            assert_eq!(species.appearance.check(), Ok(()), "{}", species.slug);
        }
    }

    #[test]
    fn parameters_of_every_stage_are_in_range() {
        for species in all() {
            let changes = species.schedule.iter().filter_map(|stage| match stage {
                Stage::Change(values) => Some(&**values),
                _ => None,
            });
            for values in changes.chain([&species.parameters]) {
                assert_eq!(Parameters::new(values.clone()).err(), None, "{}", species.slug);
            }
        }
    }

    #[test]
    fn every_species_grows_on_its_own() {
        for species in all() {
            let parameters = Parameters::new(species.parameters.clone()).expect("in range");
            let mut simulation = Simulation::new(1, parameters);
            for _ in 0..6 {
                simulation.step(&StepInput { autonomous: true, ..StepInput::default() }, &mut NoObserver);
            }
            let grown = simulation.plant().living_count();
            assert!(grown >= 10, "{} has {grown} metamers", species.slug);
        }
    }
}
