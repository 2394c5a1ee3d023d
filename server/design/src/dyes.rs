//! Which material each row of the wood of a design has.

use std::collections::BTreeMap;

use crate::{
    design::Design,
    generator::Generated,
    key::Key,
    node::NodeId,
    resolution::Branch,
    value::{Material, Value},
};

/// The materials of the wood of a design, beside that which changes nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dyes {
    /// Different ones, in the order of the branches that have them first.
    pub materials: Vec<Material>,
    /// How many rows after one another have which: 0 for none, else the place of the material counted from 1. From the
    /// first row of the wood on; empty where no row has any.
    pub runs: Vec<(u32, u16)>,
}

impl Dyes {
    /// Those of the wood of a design.
    pub fn of(design: &Design, generated: &Generated) -> Self {
        let mut dyes = Self::default();
        let mut of_branch: BTreeMap<NodeId, u16> = BTreeMap::new();
        dyes.note(design.root(), &mut BTreeMap::new(), &mut of_branch);
        if dyes.materials.is_empty() {
            return dyes;
        }
        let of_axis: Vec<u16> = generated
            .placed
            .iter()
            .map(|placed| of_branch.get(&placed.node).copied().unwrap_or_default())
            .collect();
        for node in &generated.wood.nodes {
            let dye = of_axis.get(node.axis as usize).copied().unwrap_or_default();
            match dyes.runs.last_mut() {
                Some((count, last)) if *last == dye => *count += 1,
                _ => dyes.runs.push((1, dye)),
            }
        }
        dyes
    }

    /// Notes what a branch has and all that it bears, with the materials that are known by the hashes of their bits.
    fn note(
        &mut self,
        branch: &Branch,
        known: &mut BTreeMap<u64, u16>,
        of_branch: &mut BTreeMap<NodeId, u16>,
    ) {
        let held = branch.values().value(Key::Material);
        let Value::Material(material) = held.get() else { return };
        if !material.is_plain() {
            let number = *known.entry(held.hash()).or_insert_with(|| {
                self.materials.push(*material);
                self.materials.len() as u16
            });
            of_branch.insert(branch.id(), number);
        }
        branch.laterals().iter().for_each(|lateral| self.note(lateral, known, of_branch));
    }
}
