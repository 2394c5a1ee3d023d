//! Randomness that depends on what it is for, never on who drew before.
//!
//! Every draw is a hash of the seed and of keys (an axis, a step, a purpose, a count). So growth is the same
//! on any number of threads, after undo and after replay, and an edit here does not change chance elsewhere.

use crate::rules;

/// What a draw is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum Purpose {
    /// Markers sown by the brush.
    Brush = 1,
    /// Markers sown in a bud's perception volume.
    Autonomous = 2,
    /// The vertical plane in which a vertical axis bends.
    Azimuth = 3,
    /// How the first node of a trunk is turned.
    Phyllotaxis = 4,
    /// Markers sown in a lasso's envelope.
    Lasso = 5,
}

/// A stream of numbers for one purpose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Draw(u64);

impl Draw {
    /// The stream for `purpose` with two more keys.
    pub fn new(seed: u32, purpose: Purpose, first: u32, second: u32) -> Self {
        let base = mix((u64::from(seed) | u64::from(purpose as u32) << 32) ^ rules::salt());
        Self(mix(base ^ (u64::from(first) | u64::from(second) << 32)))
    }

    /// Number `count` of the stream, uniform in [0, 1).
    pub fn unit(self, count: u32) -> f32 {
        (self.bits(count) >> 40) as f32 * (1.0 / 16_777_216.0)
    }

    /// Number `count` of the stream, uniform among the whole numbers below `bound`.
    pub fn below(self, count: u32, bound: u32) -> u32 {
        (((self.bits(count) >> 32) * u64::from(bound)) >> 32) as u32
    }

    fn bits(self, count: u32) -> u64 {
        mix(self.0.wrapping_add(u64::from(count).wrapping_mul(0x9e37_79b9_7f4a_7c15)))
    }
}

/// The finaliser of SplitMix64.
fn mix(mut z: u64) -> u64 {
    z = z.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_fill_the_unit_interval_evenly() {
        let mut bins = [0u32; 16];
        for key in 0..64 {
            let draw = Draw::new(7, Purpose::Brush, key, 3);
            for count in 0..256 {
                bins[(draw.unit(count) * 16.0) as usize] += 1;
            }
        }
        // 1024 expected in each; six standard deviations are about 190.
        assert!(bins.iter().all(|n| (834..1214).contains(n)), "{bins:?}");
    }

    #[test]
    fn keys_make_different_streams() {
        let a = Draw::new(1, Purpose::Brush, 2, 3).unit(0);
        for other in [
            Draw::new(2, Purpose::Brush, 2, 3),
            Draw::new(1, Purpose::Azimuth, 2, 3),
            Draw::new(1, Purpose::Brush, 3, 2),
        ] {
            assert_ne!(a, other.unit(0));
        }
    }
}
