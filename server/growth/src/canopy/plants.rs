//! Which plant each node of a canopy belongs to.

use espalier_plant::MetamerId;

/// The plants, and the number of that of each node. While there is one plant only, no numbers are written down.
#[derive(Clone, Debug, Default)]
pub(super) struct Plants {
    /// Each plant's seed and its apical control λ.
    plants: Vec<(MetamerId, f64)>,
    /// Empty, or one for each node.
    numbers: Vec<u32>,
}

impl Plants {
    /// Takes in another plant; returns its number.
    pub fn add(&mut self, seed: MetamerId) -> u32 {
        self.plants.push((seed, 0.0));
        self.plants.len() as u32 - 1
    }

    /// The number of the plant of a node.
    pub fn number(&self, slot: usize) -> u32 {
        self.numbers.get(slot).copied().unwrap_or(0)
    }

    /// Says which plant the node in the next slot belongs to.
    pub fn push(&mut self, slot: usize, number: u32) {
        if number > 0 && self.numbers.is_empty() {
            self.numbers.resize(slot, 0);
        }
        if number > 0 || !self.numbers.is_empty() {
            self.numbers.push(number);
        }
    }

    /// Moves a node to another slot.
    pub fn shift(&mut self, from: usize, to: usize) {
        if !self.numbers.is_empty() {
            self.numbers[to] = self.numbers[from];
        }
    }

    /// Forgets all slots but the first so many.
    pub fn truncate(&mut self, slots: usize) {
        self.numbers.truncate(slots);
    }

    /// Forgets the plants whose seeds do not count.
    pub fn retain(&mut self, counts: impl Fn(MetamerId) -> bool) {
        self.plants.retain(|&(seed, _)| counts(seed));
    }

    /// Gives each plant its apical control.
    pub fn set_lambdas(&mut self, lambda: impl Fn(MetamerId) -> f64) {
        for (seed, of_plant) in &mut self.plants {
            *of_plant = lambda(*seed);
        }
    }

    /// Apical control λ at a node.
    #[inline(always)]
    pub fn lambda(&self, slot: usize) -> f64 {
        self.plants[self.number(slot) as usize].1
    }
}
