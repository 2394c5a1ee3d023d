//! Random edits, from the first to the last.

use espalier_design::{
    Design, Edit, From, Key, Level, NodeId, Op, Owner, Setting, ShareId, Source, Visibility,
};
use proptest::prelude::*;

use crate::said::{constant, curved, envelope, scalar, span, vector};

/// An edit by numbers: which of the branches, which parameter, and how.
#[derive(Clone, Debug)]
pub(crate) struct Pick {
    who: u16,
    key: u8,
    how: u8,
    number: f32,
}

pub(crate) fn picks(most: usize) -> impl Strategy<Value = Vec<Pick>> {
    let pick = (any::<u16>(), any::<u8>(), any::<u8>(), 0.0f32..1.0)
        .prop_map(|(who, key, how, number)| Pick { who, key, how, number });
    prop::collection::vec(pick, 1..most)
}

const KEYS: [Key; 14] = [
    Key::Reach,
    Key::Density,
    Key::Girth,
    Key::Axis,
    Key::Taper,
    Key::Silhouette,
    Key::Roll,
    Key::BranchingAngle,
    Key::Pull,
    Key::Zone,
    Key::Orders,
    Key::Whorl,
    Key::Phyllotaxis,
    Key::Irregularity,
];

/// All branches that stand.
pub(crate) fn nodes(design: &Design) -> Vec<NodeId> {
    let mut nodes = Vec::new();
    design.root().walk(&mut |branch| nodes.push(branch.id()));
    nodes
}

/// A small plant, so that many lives are tried.
pub(crate) fn sapling() -> Design {
    crate::said::designed(&[
        crate::said::set(crate::said::on("/"), Key::Density, constant(5.0)),
        crate::said::set(crate::said::on("/"), Key::Orders, scalar(2.0)),
    ])
}

impl Pick {
    /// The edit that it stands for; it may be refused.
    pub(crate) fn edit(&self, design: &Design) -> Edit {
        let all = nodes(design);
        // Half of the picks are of limbs, of which there are few.
        let limbs: Vec<_> = all.iter().copied().filter(|node| node.order() <= 1).collect();
        let of = if self.who.is_multiple_of(2) { &limbs } else { &all };
        let node = of[usize::from(self.who / 2) % of.len()];
        let key = KEYS[usize::from(self.key) % KEYS.len()];
        let owner = match self.how % 8 {
            0 => Owner::Level(Level::new(1 + self.key % 2).expect("an order")),
            _ => Owner::Node(node),
        };
        let value = self.value(key);
        match self.how % 32 {
            0..4 => return Edit::Clear { owner, key },
            4 => return Edit::Forget { node },
            5 => return Edit::Anchor { node, at: (self.number < 0.8).then_some(self.number) },
            6 => {
                let share = ShareId(u32::from(self.key) % 3);
                return Edit::Share { share, key, value, members: vec![node] };
            }
            7 => return Edit::Copy { from: node, to: of[usize::from(self.key) % of.len()] },
            _ => {}
        }
        let source = match self.how / 32 {
            0 | 1 if key.row().kind.is_relative() => {
                Source::Relative(if self.how.is_multiple_of(3) { Op::Add } else { Op::Multiply }, value)
            }
            2 => Source::Inherited,
            _ => Source::Explicit(value),
        };
        let visibility = if self.how.is_multiple_of(5) { Visibility::Private } else { Visibility::Public };
        let from = if self.how.is_multiple_of(7) { From::Below } else { From::Bearer };
        Edit::Set { owner, key, setting: Setting { source, visibility, from } }
    }

    fn value(&self, key: Key) -> espalier_design::Held {
        let number = self.number;
        match key {
            Key::Reach => scalar(0.3 + number),
            Key::Density => constant(9.0 * number),
            Key::Girth => scalar(0.1 + number),
            Key::Taper => constant(0.1 + 0.9 * number),
            Key::Axis => curved(),
            Key::Silhouette => {
                let radii = [0.2 + number, 0.3, 0.4, 0.1 + number];
                envelope(espalier_design::Envelope { radii, upper: 0.5 + 2.0 * number, ..Default::default() })
            }
            Key::Roll | Key::Phyllotaxis => scalar(180.0 * number),
            Key::BranchingAngle => constant(120.0 * number),
            Key::Pull => vector(number, 1.0 - number, -number),
            Key::Zone => span(0.3 * number, 1.0 - 0.3 * number),
            Key::Orders | Key::Whorl => scalar((1.0 + 2.0 * number).trunc()),
            _ => scalar(number),
        }
    }
}
