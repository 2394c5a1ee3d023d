//! Nothing alive stands on something dead.

use super::{Failure, require};
use crate::{
    id::{AxisId, MetamerId},
    plant::Plant,
};

pub(super) fn check(plant: &Plant) -> Result<(), Failure> {
    let mut living = 0;
    for index in 0..plant.metamer_count() {
        let id = MetamerId::new(index);
        if !plant.is_alive(id) {
            continue;
        }
        living += u32::from(!plant.is_seed(id));
        let rooted = plant.metamers().parent(id).is_none_or(|parent| plant.is_alive(parent));
        require("death_reaches_tips", rooted, || format!("metamer {index} lives on a dead one"))?;
    }
    for index in 0..plant.axis_count() {
        let id = AxisId::new(index);
        require(
            "death_reaches_tips",
            !plant.is_axis_alive(id) || plant.is_alive(plant.bud_node(id)),
            || format!("the bud of axis {index} outlives its node"),
        )?;
    }
    require("death_reaches_tips", living == plant.living_count(), || {
        format!("{living} metamers live but {} are counted", plant.living_count())
    })
}

#[cfg(test)]
mod tests {
    use crate::checks;

    #[test]
    fn life_on_dead_wood_fails() {
        let mut plant = checks::tests_support::sapling();
        plant.metamers.death.set(1, 1);
        assert_eq!(checks::all(&plant).map_err(|f| f.check), Err("death_reaches_tips"));
    }
}
