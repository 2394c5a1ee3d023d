//! What buds have claimed in one step: the markers nearest to them, added up to a direction.

use espalier_plant::AxisId;
use glam::Vec3;

/// Steps of a unit vector's coordinate: sums of whole numbers are the same in any order.
const UNIT: f32 = 32_768.0;

/// Sums of unit vectors, bud by bud.
#[derive(Clone, Debug, Default)]
pub(crate) struct Claims {
    /// Where each axis' claim stands, if the claim there says so too.
    slots: Vec<u32>,
    claims: Vec<Claim>,
}

#[derive(Clone, Copy, Debug)]
struct Claim {
    axis: AxisId,
    sum: [i32; 3],
}

impl Claims {
    /// Starts anew for a plant with so many axes.
    pub(crate) fn clear(&mut self, axes: usize) {
        self.claims.clear();
        self.slots.resize(axes, 0);
    }

    /// A bud claims a marker that lies this way.
    pub(crate) fn add(&mut self, axis: AxisId, towards: Vec3) {
        let Some(unit) = towards.try_normalize() else { return };
        let slot = &mut self.slots[axis.index()];
        if self.claims.get(*slot as usize).is_none_or(|claim| claim.axis != axis) {
            *slot = self.claims.len() as u32;
            self.claims.push(Claim { axis, sum: [0; 3] });
        }
        let sum = &mut self.claims[*slot as usize].sum;
        for (sum, along) in sum.iter_mut().zip(unit.to_array()) {
            *sum += (along * UNIT) as i32;
        }
    }

    /// Each bud that claims anything, and the direction E of what it claims; where that cancels out, none.
    pub(crate) fn directions(&self) -> impl Iterator<Item = (AxisId, Vec3)> + '_ {
        self.claims.iter().filter_map(|claim| {
            let [x, y, z] = claim.sum.map(|sum| sum as f32);
            Some((claim.axis, (Vec3::new(x, y, z) * (1.0 / UNIT)).try_normalize()?))
        })
    }
}
