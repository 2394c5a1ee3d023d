//! An axis is one chain of metamers from its bearer to its bud, and what lives of it is part of that chain. Rows that
//! fell when it was settled anew which wood stands may hang beside it.

use super::{Failure, require};
use crate::{
    id::{AxisId, MetamerId},
    plant::Plant,
};

pub(super) fn check(plant: &Plant) -> Result<(), Failure> {
    let count = plant.metamer_count();
    // The first row of the chain that each row is part of.
    let mut founders: Vec<MetamerId> = Vec::with_capacity(count);
    for id in (0..count).map(MetamerId::new) {
        let axis = plant.metamers().axis(id);
        let from = plant.metamers().parent(id);
        let continued = from.filter(|&from| from < id && plant.metamers().axis(from) == axis);
        let holds = continued.is_some() || from == plant.axes().bearer(axis);
        require("axis_continuity", holds, || format!("metamer {} does not continue its axis", id.index()))?;
        founders.push(continued.map_or(id, |from| founders[from.index()]));
    }
    let mut is_in_chain = vec![false; count];
    for axis in (0..plant.axis_count()).map(AxisId::new) {
        let (first, last) = (plant.axes().first(axis), plant.axes().last(axis));
        let is_here = |last: MetamerId| last.index() < count && plant.metamers().axis(last) == axis;
        let holds = match last {
            Some(last) => is_here(last) && first == Some(founders[last.index()]),
            None => first.is_none(),
        };
        require("axis_continuity", holds, || {
            format!("axis {} ends elsewhere than at its last metamer", axis.index())
        })?;
        last.into_iter().for_each(|last| is_in_chain[last.index()] = true);
    }
    for id in (0..count).rev().map(MetamerId::new) {
        let Some(from) = plant.metamers().parent(id).filter(|_| is_in_chain[id.index()]) else { continue };
        is_in_chain[from.index()] |= plant.metamers().axis(from) == plant.metamers().axis(id);
    }
    for id in (0..count).map(MetamerId::new).filter(|&id| plant.is_alive(id)) {
        require("axis_continuity", is_in_chain[id.index()], || {
            format!("metamer {} lives beside its axis", id.index())
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
