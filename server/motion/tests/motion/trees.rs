//! Trees to sway: grown ones, and rows laid down by hand.

use espalier_growth::{NoObserver, ParameterValues, Parameters, Simulation, StepInput, species};
use espalier_mesh::{RingTable, Style, StyleOptions};
use espalier_motion::{Joints, Limbs, Row, Rows, Scale, Wood};

/// A tree with all that is made of its rows.
pub struct Tree {
    pub name: &'static str,
    pub rows: Rows,
    pub scale: Scale,
    pub limbs: Limbs,
    pub wood: Wood,
    pub joints: Joints,
}

impl Tree {
    pub fn of(name: &'static str, rows: Rows, scale: Scale) -> Self {
        let (limbs, wood, joints) = Joints::grown(&rows, &scale, 1.0);
        Self { name, rows, scale, limbs, wood, joints }
    }
}

/// A tree that has grown on its own to so many metamers; of a species, or of no species in particular.
pub fn grown(slug: &'static str, metamers: u32) -> Tree {
    let values = match species::find(slug) {
        Some(species) => species.parameters.clone(),
        None => ParameterValues::default(),
    };
    let mut simulation = Simulation::new(1, Parameters::new(values.clone()).expect("they are in range"));
    for _ in 0..400 {
        if simulation.plant().living_count() >= metamers {
            break;
        }
        simulation.step(&StepInput { autonomous: true, ..StepInput::default() }, &mut NoObserver);
    }
    assert!(simulation.plant().living_count() >= metamers, "{slug} grows so large");
    let style = Style::new(StyleOptions {
        girth_exponent: values.girth_exponent,
        twig_diameter: values.twig_diameter,
        leaves_per_node: values.leaves_per_node as u8,
        leaf_size: values.leaf_size,
    });
    let mut table = RingTable::new();
    table.sync(simulation.plant(), &style, 1);
    let scale = Scale {
        internode_length: f64::from(values.internode_length),
        leaf_size: f64::from(values.leaf_size),
    };
    Tree::of(slug, Rows::of(&table), scale)
}

/// Trees of unlike habits, of some thousand metamers each.
pub fn unlike() -> Vec<Tree> {
    ["default", "oak", "weeping-willow", "scots-pine"].map(|slug| grown(slug, 3000)).into()
}

/// A seed at the origin.
pub const SEED: Row = Row { parent: None, starts_axis: false, position: [0; 3], radius: 0, leaves: 0 };

/// The code of a radius in internodes.
pub fn code(radius: f64) -> u16 {
    espalier_mesh::radius_code::encode(radius as f32)
}

/// A pole of so many internodes that runs along `step`, in steps of 1/256 internode, with radii by share of its length.
pub fn pole(pieces: u32, step: [i32; 3], radius: impl Fn(f64) -> f64) -> Tree {
    let row = |at: u32| Row {
        parent: Some(at - 1),
        starts_axis: at == 1,
        position: step.map(|step| step * at as i32),
        radius: code(radius(f64::from(at) / f64::from(pieces))),
        leaves: 0,
    };
    let rows =
        Rows::new([SEED].into_iter().chain((1..=pieces).map(row))).expect("each stands on the one before");
    Tree::of("pole", rows, Scale { internode_length: 0.1, leaf_size: 1.0 })
}
