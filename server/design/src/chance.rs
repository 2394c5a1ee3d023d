//! Chance that depends on whom it concerns and on what it is for, never on who drew before.

use espalier_plant::hash::StableHash;

use crate::node::NodeId;

/// What a draw is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// Bends of an axis.
    Bend = 1,
    /// How a branch leaves its bearer.
    Direction = 2,
    /// Where along its bearer a branch stands.
    Place = 3,
}

/// A stream of draws for one branch and purpose.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chance(StableHash);

impl Chance {
    pub(crate) fn new(seed: u32, node: NodeId, purpose: Purpose) -> Self {
        let mut hash = StableHash::default();
        hash.word(u64::from(seed) | (purpose as u64) << 32);
        hash.word(node.raw());
        Self(hash)
    }

    /// Draw number `count`, from -1 to 1.
    pub(crate) fn signed(self, count: u32) -> f32 {
        let mut hash = self.0;
        hash.word(count.into());
        (hash.finish() >> 40) as f32 * (2.0 / 16_777_216.0) - 1.0
    }
}
