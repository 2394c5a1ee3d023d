//! Bones for programs that know of no joints like ours: a few nodes of slow limbs, between which vertices are blended.

use std::collections::BTreeMap;

use glam::{DQuat, DVec3};

use crate::{
    Limbs, NONE,
    joints::Joints,
    pose::{Node, Pose},
    wood::Wood,
};

/// A piece of a limb between two bones misses its curve by about a turn × its length / 8; by so much at most, in metres
/// and as a share of the plant's height, as long as there are bones left.
const NEAR: f64 = 0.004;
const NEAR_OF_HEIGHT: f64 = 0.001;
/// The most pieces of one limb.
const MOST_PIECES: usize = 6;

/// One bone: the node of a row, with how that turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bone {
    /// The bone below it, which stands before it; none for the ground.
    pub parent: Option<u32>,
    /// Whose node it is.
    pub row: u32,
    /// Where that is at rest, m.
    pub rest: DVec3,
    /// How far along its limb's bend it stands: 0 at the base, where it turns with its bearer.
    pub weight: f64,
}

/// How a vertex goes along: with two bones, so much with the second one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// The bones.
    pub bones: [u32; 2],
    /// The share of the second, 0 to 1.
    pub share: f64,
}

/// The bones of one plant, and which of its joints they show.
#[derive(Clone, Debug, PartialEq)]
pub struct Rig {
    bones: Vec<Bone>,
    /// The bones of each joint that is shown, base first.
    of_joint: BTreeMap<u32, Vec<u32>>,
}

impl Rig {
    /// At most so many bones, one at least, for the plant that grows from the seed. The slowest limbs come first, each after
    /// those that bear it. `reach` says how far each joint turns at most, in radians.
    pub fn of(joints: &Joints, limbs: &Limbs, wood: &Wood, seed: u32, reach: &[f64], most: usize) -> Self {
        let own = of_seed(joints, wood, seed);
        let top = own
            .iter()
            .flat_map(|&joint| rows_of(joints, limbs, joint))
            .map(|row| wood.place[*row as usize].y);
        let height = top.fold(0.0, f64::max) - wood.place[seed as usize].y;
        let near = NEAR.max(NEAR_OF_HEIGHT * height);
        let shown = shown(joints, limbs, wood, &own, reach, near, most.max(1) - 1);
        let ground = Bone { parent: None, row: seed, rest: wood.place[seed as usize], weight: 0.0 };
        let mut rig = Self { bones: vec![ground], of_joint: BTreeMap::new() };
        for (&joint, &pieces) in &shown {
            rig.add(joints, limbs, wood, joint, pieces);
        }
        rig
    }

    /// Bones of a joint: at its base, and at the end of each piece.
    fn add(&mut self, joints: &Joints, limbs: &Limbs, wood: &Wood, joint: u32, pieces: usize) {
        let node = joints.all()[joint as usize].node;
        let carrier = self.bound(joints, node, 1.0).bones[0];
        let mut last = self.bones.len() as u32;
        self.bones.push(Bone { parent: Some(carrier), row: node, rest: wood.place(node), weight: 0.0 });
        let mut own = vec![last];
        for row in anchors(joints, limbs, wood, joint, pieces) {
            let weight = joints.rides()[row as usize].weight;
            if weight > self.bones[last as usize].weight {
                self.bones.push(Bone { parent: Some(last), row, rest: wood.place(row), weight });
                last = self.bones.len() as u32 - 1;
                own.push(last);
            }
        }
        self.of_joint.insert(joint, own);
    }

    /// All of them, each after the one below it. The first is the ground.
    pub fn bones(&self) -> &[Bone] {
        &self.bones
    }

    /// Whether it shows how a joint turns.
    pub fn shows(&self, joint: u32) -> bool {
        self.of_joint.contains_key(&joint)
    }

    /// The rows at whose nodes the pieces of a joint end, base first; none where it has no bones.
    pub fn ends(&self, joint: u32) -> impl Iterator<Item = u32> {
        let own = self.of_joint.get(&joint).map_or(&[][..], |own| &own[1..]);
        own.iter().map(|&bone| self.bones[bone as usize].row)
    }

    /// What goes along with a row, at a share of the way from the node below it to its own. What its joint does is left
    /// out where that has no bones: then it is carried by what bears the joint.
    pub fn bound(&self, joints: &Joints, row: u32, share: f64) -> Bound {
        let mut ride = joints.rides()[row as usize];
        let mut weight = ride.weight;
        if share < 1.0 && ride.joint != NONE {
            let joint = joints.all()[ride.joint as usize];
            let below = joints.below(row).filter(|&below| below != joint.node);
            let below =
                below.map(|below| joints.rides()[below as usize]).filter(|below| below.joint == ride.joint);
            let base = below.map_or(if row == joint.first { 0.0 } else { weight }, |below| below.weight);
            weight = base + share.max(0.0) * (weight - base);
        }
        while ride.joint != NONE && !self.shows(ride.joint) {
            ride = joints.rides()[joints.all()[ride.joint as usize].node as usize];
            weight = ride.weight;
        }
        let Some(own) = self.of_joint.get(&ride.joint) else { return Bound { bones: [0, 0], share: 0.0 } };
        let above = own.iter().position(|&bone| self.bones[bone as usize].weight >= weight);
        let above = above.unwrap_or(own.len() - 1);
        let pair = [own[above.saturating_sub(1)], own[above]];
        let [from, to] = pair.map(|bone| self.bones[bone as usize].weight);
        let share = if to > from { ((weight - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
        Bound { bones: pair, share }
    }

    /// Where all bones are when joints are turned by `bends`; those of joints that are not shown do not count.
    pub fn stand(&self, joints: &Joints, wood: &Wood, bends: &[DVec3]) -> Vec<Node> {
        let shown =
            |(joint, &bend): (usize, &DVec3)| if self.shows(joint as u32) { bend } else { DVec3::ZERO };
        let bends: Vec<DVec3> = bends.iter().enumerate().map(shown).collect();
        let pose = Pose::of(joints, wood, &bends);
        let ground = Node { place: self.bones[0].rest, turn: DQuat::IDENTITY };
        let above = self.bones[1..].iter().map(|bone| pose.node(joints, wood, bone.row));
        [ground].into_iter().chain(above).collect()
    }
}

/// The joints of the plant that grows from a seed.
fn of_seed(joints: &Joints, wood: &Wood, seed: u32) -> Vec<u32> {
    let grows = |joint: &u32| {
        let mut row = joints.all()[*joint as usize].node;
        while wood.parent[row as usize] != NONE {
            row = wood.parent[row as usize];
        }
        row == seed
    };
    (0..joints.all().len() as u32).filter(grows).collect()
}

fn rows_of<'a>(joints: &Joints, limbs: &'a Limbs, joint: u32) -> &'a [u32] {
    limbs.rows(joints.all()[joint as usize].limb)
}

/// Which joints are shown, in how many pieces each.
fn shown(
    joints: &Joints,
    limbs: &Limbs,
    wood: &Wood,
    own: &[u32],
    reach: &[f64],
    near: f64,
    most: usize,
) -> BTreeMap<u32, usize> {
    let mut order = own.to_vec();
    let frequency = |joint: u32| joints.all()[joint as usize].frequency;
    order.sort_by(|&a, &b| frequency(a).total_cmp(&frequency(b)).then(a.cmp(&b)));
    let mut shown = BTreeMap::new();
    let mut left = most;
    for joint in order {
        let (mut needed, mut at) = (Vec::new(), Some(joint));
        while let Some(one) = at.filter(|one| !shown.contains_key(one)) {
            let length: f64 = rows_of(joints, limbs, one).iter().map(|&row| wood.length[row as usize]).sum();
            let pieces = (reach[one as usize] * length / (8.0 * near)).sqrt().ceil();
            needed.push((one, (pieces as usize).clamp(1, MOST_PIECES)));
            at = joints.all()[one as usize].parent;
        }
        let bones: usize = needed.iter().map(|(_, pieces)| pieces + 1).sum();
        if bones > left {
            continue;
        }
        left -= bones;
        shown.extend(needed);
    }
    shown
}

/// The rows of a joint's limb at whose nodes its pieces end: at even shares of what it bends.
fn anchors(joints: &Joints, limbs: &Limbs, wood: &Wood, joint: u32, pieces: usize) -> Vec<u32> {
    let rows = rows_of(joints, limbs, joint);
    let whole: f64 = rows.iter().map(|&row| wood.length[row as usize]).sum();
    let end = rows.last().map_or(0.0, |&row| joints.rides()[row as usize].weight);
    // Halfway between even lengths and even turns: a thin tip that turns far has its bones, and so has a long base.
    let gone = rows.iter().scan(0.0, |gone, &row| {
        *gone += wood.length[row as usize];
        let along = if whole > 0.0 { *gone / whole } else { 1.0 };
        let bent = if end > 0.0 { joints.rides()[row as usize].weight / end } else { 1.0 };
        Some((row, 0.5 * (along + bent)))
    });
    let mut anchors = Vec::with_capacity(pieces);
    for (row, gone) in gone {
        if gone * pieces as f64 >= (anchors.len() + 1) as f64 - 1e-9 && anchors.len() < pieces {
            anchors.push(row);
        }
    }
    match (rows.last(), anchors.last()) {
        (Some(&last), Some(&highest)) if highest != last && anchors.len() == pieces => {
            anchors.pop();
            anchors.push(last);
        }
        (Some(&last), highest) if highest != Some(&last) => anchors.push(last),
        _ => {}
    }
    anchors
}
