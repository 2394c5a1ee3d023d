//! Organs as they are told: by the heading of their metamer alone, for clients do not know how a metamer is rolled.

use espalier_plant::{MetamerId, Organs, Plant, organs};
use glam::Vec3;

/// The organs that a living metamer is given, as clients and files place them (`LF5`).
pub fn told(plant: &Plant, id: MetamerId) -> Option<Organs> {
    let given = plant.given_organs(id).filter(|_| !plant.is_seed(id))?;
    Some(Told::of(plant, id, given).organs)
}

/// What was told of a row, and what of.
#[derive(Clone, Debug)]
struct Told {
    given: Organs,
    heading: Vec3,
    normal: Vec3,
    organs: Organs,
}

impl Told {
    fn of(plant: &Plant, id: MetamerId, given: &Organs) -> Self {
        let (heading, normal) = (plant.heading(id), plant.metamers().normal(id));
        let (own, shortest) = (organs::own_sides(heading, normal), organs::shortest_sides(heading));
        let organs = given.iter().map(|organ| organ.seen_from(heading, own, shortest)).collect();
        Self { given: given.clone(), heading, normal, organs }
    }

    /// Whether the plant has it as it was.
    fn is_of(&self, plant: &Plant, id: MetamerId, given: &Organs) -> bool {
        std::sync::Arc::ptr_eq(&self.given, given)
            && self.heading == plant.heading(id)
            && self.normal == plant.metamers().normal(id)
    }
}

/// What was told of all rows, as far as the last that is given organs.
#[derive(Clone, Debug, Default)]
pub(super) struct ToldOrgans(Vec<Option<Told>>);

impl ToldOrgans {
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub fn of(&self, row: usize) -> Option<&Organs> {
        self.0.get(row)?.as_ref().map(|told| &told.organs)
    }

    /// Whether a row may have to be told anew.
    pub fn is_stale(&self, plant: &Plant, row: usize) -> bool {
        let id = MetamerId::new(row);
        match (self.0.get(row).and_then(Option::as_ref), plant.given_organs(id)) {
            (None, None) => false,
            (Some(told), Some(given)) => !told.is_of(plant, id, given),
            _ => true,
        }
    }

    /// Takes over what a row is given; returns whether that is to be told.
    pub fn follow(&mut self, plant: &Plant, row: usize) -> bool {
        if !self.is_stale(plant, row) {
            return false;
        }
        let id = MetamerId::new(row);
        let now = plant.given_organs(id).map(|given| Told::of(plant, id, given));
        if row >= self.0.len() {
            if now.is_none() {
                return false;
            }
            self.0.resize(row + 1, None);
        }
        let differs = self.of(row) != now.as_ref().map(|now| &now.organs);
        self.0[row] = now;
        differs
    }

    pub fn truncate(&mut self, rows: usize) {
        self.0.truncate(rows);
    }
}
