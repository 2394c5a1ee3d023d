//! Each metamer carries the tips of all wood that grows from it, the shed included and the cut left out, and one of its
//! own where its axis does not go on.

use super::{Failure, require};
use crate::{
    id::MetamerId,
    plant::Plant,
    tips::{scars, severed},
};

pub(super) fn check(plant: &Plant) -> Result<(), Failure> {
    let severed = severed(plant.past_edits(), plant.metamer_count());
    // What each metamer carries for others is taken off, so that its own is left.
    let mut own: Vec<i64> =
        (0..plant.metamer_count()).map(|row| i64::from(plant.metamers.tips[row])).collect();
    let mut going_on = vec![0u32; plant.metamer_count()];
    for (id, tips) in scars(plant.past_edits()) {
        own[id.index()] -= i64::from(tips);
    }
    let attached = (0..plant.metamer_count()).filter(|&row| !severed[row]).map(MetamerId::new);
    for id in attached {
        let Some(parent) = plant.metamers().parent(id) else { continue };
        own[parent.index()] -= i64::from(plant.metamers().tips(id));
        going_on[parent.index()] += u32::from(plant.metamers().axis(parent) == plant.metamers().axis(id));
    }
    for (row, own) in own.into_iter().enumerate() {
        let (id, going_on) = (MetamerId::new(row), going_on[row]);
        let wanted = i64::from(going_on == 0 && !plant.is_seed(id));
        require("tips_add_up", own == wanted, || {
            format!("metamer {row} carries {own} tips of its own, not {wanted}")
        })?;
        require("tips_add_up", going_on <= 1, || format!("the axis of metamer {row} goes on twice"))?;
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
