//! Growth without guidance: each bud sows a few markers in its own perception volume (TreeSketch §3.2).
//!
//! A bud keeps those of its markers that lie in no bud's occupancy zone and for which it is the nearest
//! perceiver; with none left it is not enabled. Buds are asked in descending vigor and only until the vigor
//! is too small for a single internode, for what a weaker bud sees cannot matter any more. The paper lets
//! every bud also claim markers sown by others; a bud's own markers fill its volume evenly already, so the
//! difference is one of density, and asking few buds instead of all is most of the speed.

use core::f32::consts::TAU;

use espalier_plant::AxisId;
use glam::Vec3;

use crate::{
    parameter_table::ParameterTable,
    parameters::Parameters,
    random::{Draw, Purpose},
    space::{Bud, BudGrid},
};

/// The direction E towards the free space a bud has won, if any.
pub(crate) fn free_space(
    axis: AxisId,
    buds: &BudGrid,
    parameters: &ParameterTable,
    seed: u32,
    step: u32,
) -> Option<Vec3> {
    let bud = buds.get(axis)?;
    let own = parameters.of(axis);
    let draw = Draw::new(seed, Purpose::Autonomous, axis.raw(), step);
    let mut sum = Vec3::ZERO;
    for marker in 0..own.markers_per_bud {
        let place = sow(bud, own, draw, marker);
        let is_won = place.y > 0.0 && buds.wins(axis, place, own);
        if is_won {
            sum += (place - bud.position).normalize();
        }
    }
    sum.try_normalize()
}

/// A marker uniform in the perception volume: a truncated cone with spherical base.
fn sow(bud: &Bud, parameters: &Parameters, draw: Draw, marker: u32) -> Vec3 {
    let unit = |i| draw.unit(3 * marker + i);
    let (near, far) = (parameters.occupancy_radius, parameters.perception_radius());
    let (near_cubed, far_cubed) = (near * near * near, far * far * far);
    let distance = libm::cbrtf(near_cubed + (far_cubed - near_cubed) * unit(0));
    let cos = 1.0 - (1.0 - parameters.cos_half_perception) * unit(1);
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    let (sin_azimuth, cos_azimuth) = libm::sincosf(TAU * unit(2));
    let (u, w) = bud.direction.any_orthonormal_pair();
    let direction = bud.direction * cos + (u * cos_azimuth + w * sin_azimuth) * sin;
    bud.position + direction * distance
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markers_lie_in_the_perception_volume() {
        let parameters = Parameters::default();
        let mut buds = BudGrid::new();
        buds.place(AxisId::new(0), Vec3::new(1.0, 5.0, 2.0), Vec3::new(0.6, 0.8, 0.0));
        let bud = *buds.get(AxisId::new(0)).expect("just placed");
        let draw = Draw::new(3, Purpose::Autonomous, 0, 1);
        for marker in 0..500 {
            let place = sow(&bud, &parameters, draw, marker);
            let distance = place.distance(bud.position);
            let (near, far) = (parameters.occupancy_radius, parameters.perception_radius());
            assert!((near - 1e-3..=far + 1e-3).contains(&distance));
            let cos = (place - bud.position).dot(bud.direction) / distance;
            assert!(cos > parameters.cos_half_perception - 1e-4);
        }
    }

    #[test]
    fn a_crowded_bud_finds_no_room() {
        let parameters = ParameterTable::default();
        let mut buds = BudGrid::new();
        buds.place(AxisId::new(0), Vec3::Y * 20.0, Vec3::Y);
        assert!(free_space(AxisId::new(0), &buds, &parameters, 1, 1).is_some());
        let mut next = 1;
        for x in -4..=4 {
            for y in 0..=6 {
                for z in -4..=4 {
                    let place = Vec3::new(x as f32 * 1.5, 21.0 + y as f32 * 1.5, z as f32 * 1.5);
                    buds.place(AxisId::new(next), place, Vec3::Y);
                    next += 1;
                }
            }
        }
        assert!(free_space(AxisId::new(0), &buds, &parameters, 1, 1).is_none());
    }
}
