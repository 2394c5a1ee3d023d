//! Parents stand before their children and are not born after them.

use super::{Failure, require};
use crate::{id::MetamerId, plant::Plant};

pub(super) fn check(plant: &Plant) -> Result<(), Failure> {
    for index in 0..plant.metamer_count() {
        let id = MetamerId::new(index);
        let Some(parent) = plant.metamers().parent(id) else { continue };
        let holds = parent < id && plant.birth(parent) <= plant.birth(id);
        require("birth_order", holds, || {
            format!("metamer {index} is older than its parent {}", parent.index())
        })?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use crate::{checks, plant::Plant};

    #[test]
    fn seed_alone_is_in_order() {
        assert_eq!(checks::all(&Plant::new(glam::Vec3::ZERO)), Ok(()));
    }

    #[test]
    fn child_that_is_its_own_parent_fails() {
        let mut plant = checks::tests_support::sapling();
        let own = crate::id::MetamerId::new(1);
        plant.metamers.parent[1] = own;
        assert_eq!(checks::all(&plant).map_err(|f| f.check), Err("birth_order"));
    }
}
