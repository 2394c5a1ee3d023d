//! The skeleton as JSON: axes and buds, metamers with their radii, leaves, and what the plant grew by.

use std::cell::Cell;

use espalier_growth::simulation_version;
use espalier_mesh::{Style, ring_table::told};
use espalier_plant::{AxisId, MetamerId, Organ, Plant};
use espalier_settings::{Appearance, ParameterValues};
use glam::DVec3;
use serde::{Serialize, Serializer};

use crate::{
    ExportError, Sink,
    foliage::{Foliage, living},
    structure::{Structure, rounded},
};

/// The version of the format; it changes when a reader must.
pub const VERSION: u32 = 2;

/// Where a plant comes from, as far as files say it.
#[derive(Clone, Copy, Debug)]
pub struct Origin<'a> {
    /// The short name of its species, if it is one.
    pub species: Option<&'a str>,
    /// The seed of all randomness.
    pub seed: u32,
    /// The parameters in force.
    pub parameters: &'a ParameterValues,
    /// How it looks.
    pub looks: &'a Appearance,
}

/// The living plants of the present, in metres; see `docs/formats.md`.
///
/// # Errors
/// Where an internode cannot be as long as the parameters say, or the file cannot be written.
pub fn skeleton_json(
    plant: &Plant,
    style: &Style,
    origin: &Origin<'_>,
    out: &mut dyn Sink,
) -> Result<(), ExportError> {
    let structure = Structure::of(plant, style, origin.parameters.internode_length)?;
    let foliage = Foliage::of(plant, style, origin.looks, 0);
    let shed = structure.shed();
    let mut next = 0;
    let file = File {
        format: "espalier-skeleton",
        version: VERSION,
        unit: "metre",
        generator: concat!("Espalier ", env!("CARGO_PKG_VERSION")),
        simulation: simulation_version(),
        species: origin.species,
        seed: origin.seed,
        parameters: origin.parameters,
        axes: Each::of(structure.axes.iter().map(|&id| axis(&structure, id))),
        metamers: Each::of(structure.metamers.iter().zip(shed).map(|(&id, shed)| {
            let row = Some(id.raw()).filter(|&row| row != next);
            next = id.raw() + 1;
            Metamer { row, ..metamer(&structure, id, shed) }
        })),
        leaves: Each::of(living(plant).flat_map(|id| {
            let structure = &structure;
            foliage.leaves(id).map(move |(leaf, _)| Leaf {
                metamer: structure.number(id),
                position: place(leaf.base.as_dvec3() * structure.metres(1.0)),
                direction: leaf.direction.to_array(),
                normal: leaf.normal.to_array(),
                length: rounded(structure.metres(leaf.size)),
            })
        })),
    };
    Ok(serde_json::to_writer(out, &file)?)
}

#[derive(Serialize)]
#[serde(bound = "")]
struct File<'a, A: Iterator<Item: Serialize>, M: Iterator<Item: Serialize>, L: Iterator<Item: Serialize>> {
    format: &'static str,
    version: u32,
    unit: &'static str,
    generator: &'static str,
    simulation: u32,
    species: Option<&'a str>,
    seed: u32,
    parameters: &'a ParameterValues,
    axes: Each<A>,
    metamers: Each<M>,
    leaves: Each<L>,
}

#[derive(Serialize)]
struct Axis {
    bearer: Option<u32>,
    order: u32,
    direction: [f32; 3],
    bud: bool,
}

#[derive(Serialize)]
struct Metamer {
    /// Where it is not the next one.
    #[serde(skip_serializing_if = "Option::is_none")]
    row: Option<u32>,
    parent: Option<u32>,
    axis: u32,
    position: [f64; 3],
    normal: [f32; 3],
    radius: f64,
    birth: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    width: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    shed: Option<u32>,
    /// Kinds, azimuths, inclinations, rolls and codes of lengths of organs that it is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    organs: Option<Vec<[u8; 5]>>,
}

#[derive(Serialize)]
struct Leaf {
    metamer: u32,
    position: [f64; 3],
    direction: [f32; 3],
    normal: [f32; 3],
    length: f64,
}

/// A list that is made while it is written, so that only the text is held in memory.
struct Each<I>(Cell<Option<I>>);

impl<I> Each<I> {
    fn of(items: I) -> Self {
        Self(Cell::new(Some(items)))
    }
}

impl<I: Iterator<Item: Serialize>> Serialize for Each<I> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.take().into_iter().flatten())
    }
}

fn axis(structure: &Structure<'_>, id: AxisId) -> Axis {
    let (plant, axes) = (structure.plant, structure.plant.axes());
    Axis {
        bearer: axes.bearer(id).map(|bearer| structure.number(bearer)),
        order: axes.order(id),
        direction: axes.direction(id).to_array(),
        bud: plant.is_axis_alive(id),
    }
}

fn metamer(structure: &Structure<'_>, id: MetamerId, shed: u32) -> Metamer {
    let (plant, metamers) = (structure.plant, structure.plant.metamers());
    let numbers = |organ: &Organ| {
        let Organ { kind, azimuth, inclination, roll, length } = *organ;
        [kind as u8, azimuth, inclination, roll, length]
    };
    Metamer {
        row: None,
        organs: told(plant, id).map(|organs| organs.iter().map(numbers).collect()),
        parent: metamers.parent(id).map(|parent| structure.number(parent)),
        axis: structure.axis_number(metamers.axis(id)),
        position: place(structure.place(id)),
        normal: metamers.normal(id).to_array(),
        radius: rounded(structure.metres(structure.radius(id))),
        birth: plant.birth(id),
        width: structure.wanted(id).map(|diameter| rounded(structure.metres(diameter))),
        shed: Some(shed).filter(|&shed| shed > 0),
    }
}

fn place(place: DVec3) -> [f64; 3] {
    place.to_array().map(rounded)
}
