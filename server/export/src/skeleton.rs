//! The skeleton as JSON: living metamers, their radii and how they hang together.

use espalier_mesh::Style;
use espalier_plant::{MetamerId, Plant, Widths};
use serde::{Serialize, Serializer, ser::SerializeSeq};

/// The version of the format; it changes when a reader must.
pub const VERSION: u32 = 1;

/// The living metamers of the present, seeds included, in birth order; see `docs/formats.md`.
pub fn skeleton_json(plant: &Plant, style: &Style) -> Vec<u8> {
    let file = File {
        format: "espalier-skeleton",
        version: VERSION,
        unit: "internode",
        metamers: Living { plant, widths: Widths::of(plant, style.girth()) },
    };
    let mut bytes = Vec::new();
    // Writing to memory does not fail, and all keys are strings.
    serde_json::to_writer(&mut bytes, &file).expect("a skeleton is always JSON");
    bytes
}

#[derive(Serialize)]
struct File<'a> {
    format: &'static str,
    version: u32,
    unit: &'static str,
    metamers: Living<'a>,
}

#[derive(Serialize)]
struct Metamer {
    parent: Option<u32>,
    position: [f32; 3],
    radius: f32,
    order: u32,
    birth: u32,
}

/// Writes one metamer after the other, so that only the text is held in memory.
struct Living<'a> {
    plant: &'a Plant,
    widths: Widths<'a>,
}

impl Serialize for Living<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut list = serializer.serialize_seq(None)?;
        // Dead rows are left out, so those after them move up.
        let mut place_of_row = vec![0; self.plant.metamer_count()];
        let living =
            (0..self.plant.metamer_count()).map(MetamerId::new).filter(|&id| self.plant.is_alive(id));
        for (place, id) in living.enumerate() {
            place_of_row[id.index()] = place as u32;
            list.serialize_element(&self.metamer(id, &place_of_row))?;
        }
        list.end()
    }
}

impl Living<'_> {
    fn metamer(&self, id: MetamerId, place_of_row: &[u32]) -> Metamer {
        let metamers = self.plant.metamers();
        let is_seed = self.plant.is_seed(id);
        Metamer {
            parent: metamers.parent(id).map(|parent| place_of_row[parent.index()]),
            position: metamers.end(id).to_array(),
            radius: if is_seed { 0.0 } else { self.widths.radius(id) },
            order: self.plant.axes().order(metamers.axis(id)),
            birth: self.plant.birth(id),
        }
    }
}
