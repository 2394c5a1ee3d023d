//! Which metamers bear leaves, and how many.

use espalier_plant::{MetamerId, OrganKind, Organs, Plant};

use crate::style::Style;

/// Wood that has carried more tips than this has lost its leaves.
///
/// Leaves sit on the youngest wood. Counting tips instead of comparing diameters keeps the rule exact and the
/// same for every girth exponent: the limit is where a twig has forked once.
pub const MOST_TIPS_WITH_LEAVES: u32 = 2;

/// Leaves at the node of a metamer: those that it is given, else none on seeds, dead wood and old wood.
pub fn leaves(plant: &Plant, id: MetamerId, style: &Style) -> u8 {
    if plant.is_seed(id) || !plant.is_alive(id) {
        0
    } else {
        leaves_of_living(plant.metamers().tips(id), plant.given_organs(id), style)
    }
}

/// The same for a living metamer that is known to be no seed.
pub(crate) fn leaves_of_living(tips: u32, organs: Option<&Organs>, style: &Style) -> u8 {
    if let Some(organs) = organs {
        return organs.iter().filter(|organ| organ.kind == OrganKind::Leaf).count() as u8;
    }
    if tips <= MOST_TIPS_WITH_LEAVES { style.options().leaves_per_node } else { 0 }
}
