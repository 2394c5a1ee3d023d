//! Names of branches: the way to them from the root.

use std::{fmt, ops::RangeInclusive, str::FromStr};

use espalier_reading::NotAllowed;

/// The highest order of branching.
pub const MAX_ORDER: u8 = 4;
/// The highest number of a lateral of one axis.
pub const MAX_ORDINAL: u16 = 4095;
const BITS: u32 = 16;

/// A branch, by the numbers of the laterals on the way to it: `/3/0` is lateral 0 of lateral 3 of the plant's own axis,
/// which is `/`. In order, a branch stands before all that it bears, and these before the next branch.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct NodeId(u64);

impl NodeId {
    /// The plant's own axis.
    pub const ROOT: Self = Self(0);

    /// Its order of branching: 0 for the root.
    pub fn order(self) -> u8 {
        (u64::BITS - self.0.trailing_zeros().min(u64::BITS)).div_ceil(BITS) as u8
    }

    /// A lateral of it; none beyond the highest order and number.
    pub fn child(self, ordinal: u16) -> Option<Self> {
        let order = self.order();
        (order < MAX_ORDER && ordinal <= MAX_ORDINAL)
            .then(|| Self(self.0 | (u64::from(ordinal) + 1) << Self::shift(order + 1)))
    }

    /// The branch that bears it, and its number there; none for the root.
    pub fn bearer(self) -> Option<(Self, u16)> {
        let order = self.order();
        let shift = Self::shift(order.max(1));
        (order > 0).then(|| (Self(self.0 & !(0xffff << shift)), (self.0 >> shift) as u16 - 1))
    }

    /// It and what bears it, from the root upwards.
    pub fn path(self) -> impl Iterator<Item = Self> {
        (0..=self.order()).map(move |order| self.up_to(order))
    }

    /// The branch of this order on the way to it.
    pub fn up_to(self, order: u8) -> Self {
        match order {
            0 => Self::ROOT,
            order => Self(self.0 & (u64::MAX << Self::shift(order))),
        }
    }

    /// Whether another branch is this one, or borne by it or by what it bears.
    pub fn holds(self, other: Self) -> bool {
        self.subtree().contains(&other)
    }

    /// This branch and all that can stand on it.
    pub fn subtree(self) -> RangeInclusive<Self> {
        let free = match self.order() {
            0 => u64::MAX,
            order => (1u64 << Self::shift(order)) - 1,
        };
        self..=Self(self.0 | free)
    }

    /// The same branch with `from` replaced by `to` on the way to it; none where it is not on the way, or too high.
    pub fn moved(self, from: Self, to: Self) -> Option<Self> {
        if !from.holds(self) {
            return None;
        }
        let mut moved = to;
        for order in from.order() + 1..=self.order() {
            moved = moved.child(self.up_to(order).bearer()?.1)?;
        }
        Some(moved)
    }

    /// As a number, for hashes and draws.
    pub fn raw(self) -> u64 {
        self.0
    }

    fn shift(order: u8) -> u32 {
        BITS * u32::from(MAX_ORDER - order)
    }
}

impl fmt::Display for NodeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if *self == Self::ROOT {
            return f.write_str("/");
        }
        self.path().filter_map(Self::bearer).try_for_each(|(_, ordinal)| write!(f, "/{ordinal}"))
    }
}

impl fmt::Debug for NodeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl FromStr for NodeId {
    type Err = NotAllowed;

    fn from_str(text: &str) -> Result<Self, NotAllowed> {
        let refused = || NotAllowed::new(text, "/, or the way to a branch, as /3 or /3/0");
        if text == "/" {
            return Ok(Self::ROOT);
        }
        let parts = text.strip_prefix('/').ok_or_else(refused)?;
        let mut node = Self::ROOT;
        for part in parts.split('/') {
            let is_plain =
                part == "0" || (!part.starts_with('0') && part.bytes().all(|byte| byte.is_ascii_digit()));
            let ordinal = part.parse().ok().filter(|_| is_plain);
            node = ordinal.and_then(|ordinal| node.child(ordinal)).ok_or_else(refused)?;
        }
        Ok(node)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn node(text: &str) -> NodeId {
        text.parse().expect("it is a way")
    }

    #[test]
    fn ways_have_orders_bearers_and_subtrees() {
        let twig = node("/3/0/12/4095");
        assert_eq!((twig.order(), twig.child(0)), (4, None));
        assert_eq!(twig.bearer(), Some((node("/3/0/12"), 4095)));
        assert_eq!(twig.path().collect::<Vec<_>>(), ["/", "/3", "/3/0", "/3/0/12", "/3/0/12/4095"].map(node));
        assert!(node("/3").holds(twig) && NodeId::ROOT.holds(twig) && twig.holds(twig));
        assert!(!node("/2").holds(twig) && !node("/3/1").holds(twig) && !twig.holds(node("/3")));
        assert_eq!(twig.moved(node("/3"), node("/7")), Some(node("/7/0/12/4095")));
        assert_eq!(twig.moved(node("/3"), node("/7/1")), None);
        assert_eq!(NodeId::ROOT.bearer(), None);
    }

    #[test]
    fn what_is_no_way_is_refused() {
        for text in ["", "3", "//", "/3/", "/-1", "/+1", "/01", "/4096", "/99999", "/1/2/3/4/5", "/a"] {
            assert!(text.parse::<NodeId>().is_err(), "{text}");
        }
    }

    proptest! {
        #[test]
        fn a_way_is_read_as_it_is_written(ordinals in prop::collection::vec(0u16..=MAX_ORDINAL, 0..=4)) {
            let id = ordinals.iter().try_fold(NodeId::ROOT, |id, &ordinal| id.child(ordinal)).expect("it fits");
            prop_assert_eq!(id.to_string().parse::<NodeId>(), Ok(id));
            prop_assert_eq!(usize::from(id.order()), ordinals.len());
        }
    }
}
