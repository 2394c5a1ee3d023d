//! What buds have claimed in one step: the markers nearest to them, added up to a direction.

use std::{cmp::Reverse, collections::BTreeMap};

use espalier_plant::AxisId;
use glam::Vec3;

use crate::{brush::StrokeId, cells::bits, markers::MarkerSource, parameters::Parameters, vigor};

/// Steps of a unit vector's coordinate: sums of whole numbers are the same in any order.
const UNIT: f32 = 32_768.0;

impl Claimed {
    /// The internodes that a bud with so much vigor grows, where the most vigorous has `greatest`. What a person asks
    /// for grows by one at least, and in an envelope a shoot ends where its markers do, with its own zone still inside.
    pub(crate) fn shoot_length(self, vigor: f64, greatest: f64, parameters: &Parameters) -> u32 {
        let length = if vigor > 0.0 { vigor::shoot_length(vigor, greatest, parameters) } else { 0 };
        match self.region {
            Region::Free => length,
            Region::Sweep => length.max(1),
            Region::Envelope { far } => {
                length.max(1).min(libm::ceilf(far - parameters.occupancy_radius).max(1.0) as u32)
            }
        }
    }
}

/// Where a shoot may grow, from what sowed the markers that its bud has claimed; of several the widest.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub(crate) enum Region {
    /// In an envelope, whose farthest marker among those claimed is this far away.
    Envelope { far: f32 },
    /// Where the brush has been.
    Sweep,
    /// Wherever there is space.
    Free,
}

/// Sums of unit vectors, bud by bud.
#[derive(Clone, Debug, Default)]
pub(crate) struct Claims {
    /// Axes that have claimed: one bit each.
    claimants: Vec<u64>,
    /// Where the claim of each of them stands.
    slots: Vec<u32>,
    claims: Vec<Claim>,
    /// Whether it is counted how many markers of which stroke each bud has claimed: where there is one stroke all are its.
    pub(crate) count_strokes: bool,
    strokes: BTreeMap<AxisId, BTreeMap<StrokeId, u32>>,
}

#[derive(Clone, Copy, Debug)]
struct Claim {
    sum: [i32; 3],
    region: Region,
}

/// What a bud has claimed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Claimed {
    /// The direction E to it.
    pub space: Vec3,
    /// Where it may grow to.
    pub region: Region,
}

impl Claims {
    /// Starts anew for a plant with so many axes.
    pub(crate) fn clear(&mut self, axes: usize) {
        self.claims.clear();
        self.strokes.clear();
        self.slots.resize(axes, 0);
        self.claimants.clear();
        self.claimants.resize(axes.div_ceil(64), 0);
    }

    /// A bud claims a marker that lies there, seen from it.
    pub(crate) fn add(&mut self, axis: AxisId, offset: Vec3) {
        self.add_in(Region::Free, axis, offset);
    }

    /// A bud claims a marker that something has sown.
    pub(crate) fn add_sown(&mut self, axis: AxisId, offset: Vec3, source: MarkerSource) {
        let region = match source {
            MarkerSource::Brush(_) => Region::Sweep,
            MarkerSource::Lasso => Region::Envelope { far: offset.length() },
        };
        self.add_in(region, axis, offset);
        if let MarkerSource::Brush(stroke) = source
            && self.count_strokes
        {
            *self.strokes.entry(axis).or_default().entry(stroke).or_default() += 1;
        }
    }

    /// The stroke of most of the markers that a bud has claimed, of equally many the oldest, if strokes are counted.
    pub(crate) fn stroke(&self, axis: AxisId) -> Option<StrokeId> {
        let counts = self.strokes.get(&axis)?;
        counts.iter().max_by_key(|&(&stroke, &count)| (count, Reverse(stroke))).map(|(&stroke, _)| stroke)
    }

    fn add_in(&mut self, region: Region, axis: AxisId, offset: Vec3) {
        let Some(unit) = offset.try_normalize() else { return };
        let (word, bit) = (&mut self.claimants[axis.index() / 64], 1 << (axis.index() % 64));
        let slot = &mut self.slots[axis.index()];
        if *word & bit == 0 {
            *word |= bit;
            *slot = self.claims.len() as u32;
            self.claims.push(Claim { sum: [0; 3], region });
        }
        let claim = &mut self.claims[*slot as usize];
        if region > claim.region {
            claim.region = region;
        }
        for (sum, along) in claim.sum.iter_mut().zip(unit.to_array()) {
            *sum += (along * UNIT) as i32;
        }
    }

    /// How many buds claim anything, but for those the directions of whose claims cancel out.
    pub(crate) fn count(&self) -> u32 {
        self.claims.iter().filter(|claim| claim.sum != [0; 3]).count() as u32
    }

    /// The buds that claim anything, but for those the directions of whose claims cancel out; the oldest first.
    pub(crate) fn claimants(&self) -> impl Iterator<Item = AxisId> + '_ {
        let words = self.claimants.iter().enumerate();
        let axes = words.flat_map(|(word, &axes)| bits(axes).map(move |bit| word * 64 + bit));
        axes.filter(|&axis| self.claims[self.slots[axis] as usize].sum != [0; 3]).map(AxisId::new)
    }

    /// What a bud has claimed, unless the directions to it cancel out.
    pub(crate) fn of(&self, axis: AxisId) -> Option<Claimed> {
        let word = self.claimants.get(axis.index() / 64)?;
        if word >> (axis.index() % 64) & 1 == 0 {
            return None;
        }
        let claim = &self.claims[self.slots[axis.index()] as usize];
        let [x, y, z] = claim.sum.map(|sum| sum as f32);
        let space = (Vec3::new(x, y, z) * (1.0 / UNIT)).try_normalize()?;
        Some(Claimed { space, region: claim.region })
    }

    /// Each of the claimants with its claim.
    #[cfg(test)]
    pub(crate) fn iter(&self) -> impl Iterator<Item = (AxisId, Claimed)> + '_ {
        self.claimants().filter_map(|axis| Some((axis, self.of(axis)?)))
    }
}
