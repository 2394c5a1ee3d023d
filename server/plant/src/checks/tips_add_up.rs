//! Each metamer carries as many tips as axes with wood begin on it or above, the shed ones included and those
//! pruned left out.

use super::{Failure, require};
use crate::{id::MetamerId, plant::Plant};

pub(super) fn check(plant: &Plant) -> Result<(), Failure> {
    let mut carried = vec![0u32; plant.metamer_count()];
    let mut is_cut = vec![false; plant.metamer_count()];
    plant.cuts().for_each(|cut| is_cut[cut.index()] = true);
    for (id, tips) in plant.scars() {
        carried[id.index()] = carried[id.index()].wrapping_add(tips);
    }
    for index in (0..plant.metamer_count()).rev() {
        let id = MetamerId::new(index);
        let m = plant.metamers();
        if plant.axes().last(m.axis(id)) == Some(id) && !plant.is_seed(id) {
            carried[index] = carried[index].wrapping_add(1);
        }
        if let Some(parent) = m.parent(id) {
            // Where an axis was cut its end is a tip again.
            let kept = if is_cut[index] { u32::from(m.axis(parent) == m.axis(id)) } else { carried[index] };
            let kept = if is_cut[index] && plant.is_seed(parent) { 0 } else { kept };
            carried[parent.index()] = carried[parent.index()].wrapping_add(kept);
        }
        require("tips_add_up", carried[index] == m.tips(id), || {
            format!("metamer {index} carries {} tips, not {}", carried[index], m.tips(id))
        })?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use crate::checks;

    #[test]
    fn forgotten_tip_fails() {
        let mut plant = checks::tests_support::sapling();
        plant.metamers.tips[1] += 1;
        assert_eq!(checks::all(&plant).map_err(|f| f.check), Err("tips_add_up"));
    }
}
