//! An axis is one chain of metamers from its bearer to its bud.

use super::{Failure, require};
use crate::{
    id::{AxisId, MetamerId},
    plant::Plant,
};

pub(super) fn check(plant: &Plant) -> Result<(), Failure> {
    let mut tip = vec![None; plant.axis_count()];
    for index in 0..plant.metamer_count() {
        let id = MetamerId::new(index);
        let axis = plant.metamers().axis(id);
        let from = plant.metamers().parent(id);
        let expected = tip[axis.index()].or(plant.axes().bearer(axis));
        require("axis_continuity", from == expected, || {
            format!("metamer {index} does not continue its axis")
        })?;
        if tip[axis.index()].is_none() {
            let first = plant.axes().first(axis);
            require("axis_continuity", first == Some(id), || {
                format!("axis {} lost its first metamer", axis.index())
            })?;
        }
        tip[axis.index()] = Some(id);
    }
    for (index, tip) in tip.into_iter().enumerate() {
        let last = plant.axes().last(AxisId::new(index));
        require("axis_continuity", last == tip, || {
            format!("axis {index} ends elsewhere than its last metamer")
        })?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use crate::{checks, id::MetamerId};

    #[test]
    fn bud_astray_fails() {
        let mut plant = checks::tests_support::sapling();
        plant.axes.last[0] = MetamerId::new(1);
        assert_eq!(checks::all(&plant).map_err(|f| f.check), Err("axis_continuity"));
    }
}
