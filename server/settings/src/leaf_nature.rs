//! What a kind of leaf is by nature, and what the seasons make of it: for every client and every export.

use serde::Serialize;
use ts_rs::TS;

use crate::{looks::LeafKind, value::Tint};

/// What stands to reason of a kind of leaf.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct LeafNature {
    /// Whether many small ones stand on a twig together and are drawn as one spray.
    pub is_spray: bool,
    /// How far it lies along its twig, 0 as `LF2` has it to 1 along the twig.
    pub lean: f32,
    /// How much it bows, folds or sags: long and heavy ones hang.
    pub bend: f32,
    /// How much it flutters in the wind beside leaves of most kinds: needles and scales are stiff, round blades hang on
    /// long stalks.
    pub flutter: f32,
    /// The sRGB colours that it turns into: at first, at last, and dead.
    pub autumn: [Tint; 3],
    /// How large it is, 0 to 1.
    pub unfolded: Course,
    /// The share of the leaves that are there.
    pub present: Course,
    /// How young its green is, 0 to 1.
    pub fresh: Course,
    /// How far the colours of autumn have come, 0 to 1.
    pub turned: Course,
    /// How far it has died, 0 to 1.
    pub withered: Course,
}

/// A number over the seasons, from 0 at bud burst to 3 in winter.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct Course {
    /// What it is at bud burst.
    pub start: f32,
    /// What is added to it.
    pub changes: Vec<Change>,
}

/// A smooth change over part of the year.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, TS)]
pub struct Change {
    /// The season in which it begins.
    pub from: f32,
    /// The season in which it ends.
    pub to: f32,
    /// How much it adds in all.
    pub by: f32,
}

impl Course {
    /// What it is in a season.
    pub fn at(&self, season: f32) -> f32 {
        self.changes.iter().fold(self.start, |sum, &Change { from, to, by }| {
            let t = ((season - from) / (to - from)).clamp(0.0, 1.0);
            sum + by * (t * t * (3.0 - 2.0 * t))
        })
    }
}

impl LeafKind {
    /// What this kind is by nature.
    pub fn nature(self) -> LeafNature {
        let [lean, kept] = match self {
            Self::Needle => [0.6, 1.0],
            Self::Scale => [0.72, 1.0],
            // Oaks keep some dead leaves until spring, beeches a few.
            Self::Lobed => [0.0, 0.06],
            Self::Ovate => [0.0, 0.03],
            _ => [0.0, 0.0],
        };
        let course = |start, changes: &[[f32; 3]]| Course {
            start,
            changes: changes.iter().map(|&[from, to, by]| Change { from, to, by }).collect(),
        };
        let bend = match self {
            Self::Compound => 1.4,
            Self::Lanceolate => 1.3,
            Self::Palmate => 0.9,
            Self::Fan => 0.5,
            Self::Needle => 0.3,
            _ => 1.0,
        };
        let flutter = match self {
            Self::Needle | Self::Scale => 0.2,
            Self::Round => 1.5,
            _ => 1.0,
        };
        let is_spray = self.is_evergreen();
        let autumn = self.autumn();
        if is_spray {
            // New shoots are lighter for a while, and the cold dulls the old ones.
            return LeafNature {
                is_spray,
                lean,
                bend,
                flutter,
                autumn,
                unfolded: course(0.94, &[[0.0, 0.95, 0.06]]),
                present: course(kept, &[]),
                fresh: course(0.5, &[[0.0, 0.95, -0.5]]),
                turned: course(0.0, &[]),
                withered: course(0.0, &[[1.9, 2.9, 0.16]]),
            };
        }
        LeafNature {
            is_spray,
            lean,
            bend,
            flutter,
            autumn,
            unfolded: course(0.24, &[[0.0, 0.85, 0.76]]),
            present: course(0.4, &[[0.0, 0.6, 0.6], [1.5, 2.0, -0.2], [2.0, 2.85, kept - 0.8]]),
            fresh: course(1.0, &[[0.0, 0.95, -1.0]]),
            turned: course(0.0, &[[1.1, 2.2, 1.0]]),
            withered: course(0.0, &[[1.9, 2.9, 1.0]]),
        }
    }

    /// The sRGB colours that leaves turn into: at first, at last, and dead.
    fn autumn(self) -> [Tint; 3] {
        match self {
            Self::Ovate => [[222, 176, 50], [192, 96, 34], [124, 82, 50]],
            Self::Round => [[236, 194, 54], [220, 152, 38], [120, 88, 50]],
            Self::Lanceolate => [[224, 200, 84], [206, 160, 62], [124, 98, 58]],
            Self::Lobed => [[190, 142, 60], [142, 80, 42], [116, 78, 48]],
            Self::Palmate => [[240, 164, 38], [190, 44, 28], [130, 70, 44]],
            Self::Fan => [[246, 208, 54], [242, 188, 40], [150, 112, 56]],
            Self::Compound => [[232, 182, 50], [208, 92, 36], [122, 82, 48]],
            Self::Needle => [[170, 140, 60], [160, 110, 50], [122, 96, 60]],
            Self::Scale => [[150, 140, 66], [150, 120, 60], [112, 96, 62]],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn courses_go_smoothly_from_0_to_1() {
        for &kind in LeafKind::ALL {
            let LeafNature { unfolded, present, fresh, turned, withered, .. } = kind.nature();
            for course in [unfolded, present, fresh, turned, withered] {
                let year: Vec<f32> = (0..=300).map(|day| course.at(day as f32 / 100.0)).collect();
                assert!(year.iter().all(|share| (-1e-6..=1.000_001).contains(share)), "{kind:?}: {course:?}");
                assert!(year.windows(2).all(|days| (days[1] - days[0]).abs() < 0.03), "{kind:?}: {course:?}");
            }
        }
    }

    #[test]
    fn leaves_burst_turn_and_fall() {
        let maple = LeafKind::Palmate.nature();
        assert!(maple.unfolded.at(0.0) < 0.3 && maple.present.at(0.0) < 0.5 && maple.fresh.at(0.0) == 1.0);
        assert!(maple.turned.at(2.0) > 0.8 && maple.present.at(2.0) > 0.7, "they turn before they fall");
        assert!(maple.present.at(3.0).abs() < 1e-6);
        let oak = LeafKind::Lobed.nature();
        assert!((0.02..0.1).contains(&oak.present.at(3.0)) && oak.withered.at(3.0) == 1.0);
    }

    #[test]
    fn evergreens_hardly_change() {
        for kind in [LeafKind::Needle, LeafKind::Scale] {
            let LeafNature { unfolded, present, turned, withered, .. } = kind.nature();
            for season in [0.0, 0.7, 1.0, 2.0, 3.0] {
                assert!(unfolded.at(season) > 0.9 && withered.at(season) < 0.2);
                assert_eq!([present.at(season), turned.at(season)], [1.0, 0.0]);
            }
        }
    }
}
