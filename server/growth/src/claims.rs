//! What buds have claimed in one step: the markers nearest to them, added up to a direction.

use std::{cmp::Reverse, collections::BTreeMap};

use espalier_plant::AxisId;
use glam::Vec3;

use crate::{brush::StrokeId, cells::bits, markers::MarkerSource, parameters::Parameters, vigor};

/// Steps of a unit vector's coordinate: sums of whole numbers are the same in any order.
const UNIT: f32 = 32_768.0;

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

impl Region {
    /// The internodes that a bud with so much vigor grows there, where the most vigorous has `greatest`. What a person
    /// asks for grows by one at least, and in an envelope a shoot ends where its markers do, with its own zone still
    /// inside.
    pub(crate) fn shoot_length(self, vigor: f64, greatest: f64, parameters: &Parameters) -> u32 {
        let length = if vigor > 0.0 { vigor::shoot_length(vigor, greatest, parameters) } else { 0 };
        match self {
            Self::Free => length,
            Self::Sweep => length.max(1),
            Self::Envelope { far } => {
                length.max(1).min(libm::ceilf(far - parameters.occupancy_radius).max(1.0) as u32)
            }
        }
    }
}

/// A marker that a bud has claimed, and where it lies, seen from there.
pub(crate) type Sighting = (AxisId, Vec3);

/// Sums of unit vectors, bud by bud.
#[derive(Clone, Debug, Default)]
pub(crate) struct Claims {
    /// Axes that have claimed: one bit each.
    claimants: Vec<u64>,
    /// How many there are in all words before each of those.
    before: Vec<u32>,
    /// The claim of each of them, the oldest first.
    claims: Vec<Claim>,
    /// Markers of each stroke that each bud has claimed, if they are counted: where there is one stroke all are its.
    strokes: Option<BTreeMap<AxisId, BTreeMap<StrokeId, u32>>>,
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
    /// What the buds of a plant with so many axes claim: of markers that something has sown, and, in batches, of others.
    pub(crate) fn gather(
        axes: usize,
        sown: &[(Sighting, MarkerSource)],
        free: &[Vec<Sighting>],
        counts_strokes: bool,
    ) -> Self {
        let mut claims = Self { claimants: vec![0; axes.div_ceil(64)], ..Self::default() };
        // All claimants are known before anything is added up, so that no place of a claim need be written down.
        let mut note =
            |&(axis, _): &Sighting| claims.claimants[axis.index() / 64] |= 1 << (axis.index() % 64);
        sown.iter().for_each(|(seen, _)| note(seen));
        free.iter().for_each(|batch| batch.iter().for_each(&mut note));
        let mut count = 0;
        claims.before.extend(claims.claimants.iter().map(|axes| {
            let before = count;
            count += axes.count_ones();
            before
        }));
        let least = Region::Envelope { far: 0.0 };
        claims.claims.resize(count as usize, Claim { sum: [0; 3], region: least });
        for &((axis, offset), source) in sown {
            let region = match source {
                MarkerSource::Brush(_) => Region::Sweep,
                MarkerSource::Lasso => Region::Envelope { far: offset.length() },
            };
            claims.add(region, axis, offset);
        }
        for batch in free {
            batch.iter().for_each(|&(axis, offset)| claims.add(Region::Free, axis, offset));
        }
        claims.strokes = counts_strokes.then(|| count_strokes(sown));
        claims
    }

    fn add(&mut self, region: Region, axis: AxisId, offset: Vec3) {
        let Some(unit) = offset.try_normalize() else { return };
        let place = self.place(axis);
        let claim = &mut self.claims[place];
        if region > claim.region {
            claim.region = region;
        }
        for (sum, along) in claim.sum.iter_mut().zip(unit.to_array()) {
            *sum += (along * UNIT) as i32;
        }
    }

    /// Where the claim of an axis stands that has one, or would.
    #[inline(always)]
    fn place(&self, axis: AxisId) -> usize {
        let (word, bit) = (axis.index() / 64, axis.index() % 64);
        let older = self.claimants[word] & ((1 << bit) - 1);
        (self.before[word] + older.count_ones()) as usize
    }

    /// Whether it is counted how many markers of which stroke each bud has claimed.
    pub(crate) fn counts_strokes(&self) -> bool {
        self.strokes.is_some()
    }

    /// The stroke of most of the markers that a bud has claimed, of equally many the oldest, if strokes are counted.
    pub(crate) fn stroke(&self, axis: AxisId) -> Option<StrokeId> {
        let counts = self.strokes.as_ref()?.get(&axis)?;
        counts.iter().max_by_key(|&(&stroke, &count)| (count, Reverse(stroke))).map(|(&stroke, _)| stroke)
    }

    /// How many buds claim anything, but for those the directions of whose claims cancel out.
    pub(crate) fn count(&self) -> u32 {
        self.claims.iter().filter(|claim| claim.sum != [0; 3]).count() as u32
    }

    /// The buds that claim anything, but for those the directions of whose claims cancel out, and where they may grow;
    /// the oldest first.
    pub(crate) fn claimants(&self) -> impl Iterator<Item = (AxisId, Region)> + '_ {
        let words = self.claimants.iter().enumerate();
        let axes = words.flat_map(|(word, &axes)| bits(axes).map(move |bit| AxisId::new(word * 64 + bit)));
        let claims = axes.zip(&self.claims).filter(|(_, claim)| claim.sum != [0; 3]);
        claims.map(|(axis, claim)| (axis, claim.region))
    }

    /// What a bud has claimed, unless the directions to it cancel out.
    pub(crate) fn of(&self, axis: AxisId) -> Option<Claimed> {
        let word = self.claimants.get(axis.index() / 64)?;
        if word >> (axis.index() % 64) & 1 == 0 {
            return None;
        }
        let claim = &self.claims[self.place(axis)];
        let [x, y, z] = claim.sum.map(|sum| sum as f32);
        let space = (Vec3::new(x, y, z) * (1.0 / UNIT)).try_normalize()?;
        Some(Claimed { space, region: claim.region })
    }

    /// Each of the claimants with its claim.
    #[cfg(test)]
    pub(crate) fn iter(&self) -> impl Iterator<Item = (AxisId, Claimed)> + '_ {
        self.claimants().filter_map(|(axis, _)| Some((axis, self.of(axis)?)))
    }
}

/// How many of the markers that something has sown each bud claims of each stroke.
fn count_strokes(sown: &[(Sighting, MarkerSource)]) -> BTreeMap<AxisId, BTreeMap<StrokeId, u32>> {
    let mut strokes: BTreeMap<AxisId, BTreeMap<StrokeId, u32>> = BTreeMap::new();
    for &((axis, _), source) in sown {
        if let MarkerSource::Brush(stroke) = source {
            *strokes.entry(axis).or_default().entry(stroke).or_default() += 1;
        }
    }
    strokes
}
