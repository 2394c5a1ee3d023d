//! How much of the plant a table shows.

use espalier_plant::Condition;

/// Light and vigor that differ by less are not shown while the plant changes all the time.
const COARSE_LIGHT_STEP: u8 = 32;
const COARSE_VIGOR_STEP: u8 = 5 << 4;
/// Codes of radii that differ by less are not shown then; each is a hundredth more than the one before.
pub(super) const COARSE_RADIUS: u16 = 6;

/// How much of what older wood looks like is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// Where it is, and whether it lives.
    Form,
    /// What differs by much as well.
    Coarse,
    /// All that can be seen.
    Whole,
}

impl Detail {
    /// By how much light and vigor differ at least where they are shown.
    pub(super) fn steps(self) -> (u8, u8) {
        match self {
            Self::Form | Self::Coarse => (COARSE_LIGHT_STEP, COARSE_VIGOR_STEP),
            Self::Whole => (1, 1),
        }
    }
}

/// Light in 32 levels from 0 to 255, and vigor in 8 of the 16 in its high four bits: every shadow moves a little in every
/// step, and nobody sees it. It depends on the present alone, so that a table made anew is the same.
#[inline]
pub fn seen(Condition { light, vigor }: Condition) -> Condition {
    Condition { light: light & 0xf8 | light >> 5, vigor: vigor & 0xe0 | (vigor >> 3) & 0x10 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_seen_is_near_to_what_there_is() {
        for byte in 0..=255 {
            let present = Condition { light: byte, vigor: byte };
            let shown = seen(present);
            assert!(shown.light.abs_diff(byte) < 8 && (shown.vigor >> 4).abs_diff(byte >> 4) < 2, "{byte}");
            assert_eq!((seen(shown), shown.vigor & 0xf), (shown, 0), "seen again it is the same");
        }
        let ends = [0, 255].map(|byte| seen(Condition { light: byte, vigor: byte }));
        assert_eq!(ends, [Condition { light: 0, vigor: 0 }, Condition { light: 255, vigor: 0xf0 }]);
    }
}
