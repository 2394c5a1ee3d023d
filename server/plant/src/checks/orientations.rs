//! Positions are finite; headings and normals of what lives are unit vectors across each other.

use glam::Vec3;

use super::{Failure, require};
use crate::{
    id::{AxisId, MetamerId},
    plant::Plant,
};

const TOLERANCE: f32 = 1e-3;

/// Whether a vector has length 1.
pub(crate) fn is_unit(v: Vec3) -> bool {
    (v.length_squared() - 1.0).abs() < TOLERANCE
}

/// Whether two unit vectors stand square to each other.
pub(crate) fn is_across(one: Vec3, other: Vec3) -> bool {
    one.dot(other).abs() < TOLERANCE
}

pub(super) fn check(plant: &Plant) -> Result<(), Failure> {
    for index in 0..plant.metamer_count() {
        let id = MetamerId::new(index);
        let (end, normal) = (plant.metamers().end(id), plant.metamers().normal(id));
        require("orientations", end.is_finite() && is_unit(normal), || {
            format!("metamer {index} has no orientation")
        })?;
        // What is dead stays where it died, whatever moves below it.
        if plant.is_seed(id) || !plant.is_alive(id) {
            continue;
        }
        let heading = plant.heading(id);
        let square = is_unit(heading) && is_across(heading, normal);
        require("orientations", square, || {
            format!("metamer {index}: heading {heading} and normal {normal}")
        })?;
    }
    for index in 0..plant.axis_count() {
        let direction = plant.axes().direction(AxisId::new(index));
        require("orientations", is_unit(direction), || format!("the bud of axis {index} points nowhere"))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use crate::checks;

    #[test]
    fn skewed_normal_fails() {
        let mut plant = checks::tests_support::sapling();
        plant.metamers.normal[2] = glam::Vec3::Y;
        assert_eq!(checks::all(&plant).map_err(|f| f.check), Err("orientations"));
    }
}
