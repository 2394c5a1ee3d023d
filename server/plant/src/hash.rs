//! A hash that is the same on every machine and in every release, for comparing plants.

/// Mixes words into 64 bits. Not for secrets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StableHash(u64);

impl Default for StableHash {
    fn default() -> Self {
        Self(0x6573_7061_6c69_6572)
    }
}

impl StableHash {
    /// Takes in one word.
    pub fn word(&mut self, word: u64) {
        // The finaliser of SplitMix64 over a running sum: every input bit reaches every output bit.
        let mut z = self.0.wrapping_add(word).wrapping_add(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        self.0 = z ^ (z >> 31);
    }

    /// Takes in a vector, bit by bit.
    pub fn vector(&mut self, v: glam::Vec3) {
        self.word(u64::from(v.x.to_bits()) | u64::from(v.y.to_bits()) << 32);
        self.word(u64::from(v.z.to_bits()));
    }

    /// The hash of everything taken in.
    pub fn finish(self) -> u64 {
        self.0
    }
}
