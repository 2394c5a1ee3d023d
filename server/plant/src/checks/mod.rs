//! Invariants of a plant, one a file. Property tests run all of them after every command.

mod axis_continuity;
mod birth_order;
mod death_reaches_tips;
mod orientations;
mod tips_add_up;

pub(crate) use self::orientations::{is_across, is_unit};

use crate::plant::Plant;

/// An invariant that does not hold.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{check}: {detail}")]
pub struct Failure {
    /// The invariant.
    pub check: &'static str,
    /// Where it fails, and how.
    pub detail: String,
}

/// Runs every check on the present.
pub fn all(plant: &Plant) -> Result<(), Failure> {
    birth_order::check(plant)?;
    axis_continuity::check(plant)?;
    death_reaches_tips::check(plant)?;
    orientations::check(plant)?;
    tips_add_up::check(plant)
}

/// One check's verdict over all rows.
fn require(check: &'static str, holds: bool, detail: impl FnOnce() -> String) -> Result<(), Failure> {
    if holds { Ok(()) } else { Err(Failure { check, detail: detail() }) }
}

#[cfg(test)]
pub(crate) mod tests_support {
    use glam::Vec3;

    use crate::plant::{Internode, Plant};

    /// Three upright metamers, each with one lateral bud.
    pub(crate) fn sapling() -> Plant {
        let mut plant = Plant::new(Vec3::ZERO);
        plant.begin_step();
        let trunk = crate::AxisId::new(0);
        for height in 1..=3 {
            let end = Vec3::Y * height as f32;
            plant.extend(trunk, &Internode { end, normal: Vec3::X, laterals: &[Vec3::X] });
        }
        plant.end_step();
        plant
    }
}
