//! Bones for programs that know of no joints like ours: a few nodes of limbs, between which vertices are blended.

use std::collections::BTreeMap;

use glam::{DQuat, DVec3};

use crate::{
    Limbs, NONE,
    joints::{Joint, Joints},
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
    /// At most so many bones, one at least, for the plant that grows from the seed: for the limbs that carry the most the
    /// furthest, each after those that bear it. `reach` says how far each joint turns at most, in radians.
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

    /// How far the nodes of what each bone carries lie from it, m: all that turns with it, what other bones above it carry
    /// as well.
    pub fn arms(&self, joints: &Joints, wood: &Wood) -> Vec<f64> {
        let mut arms = vec![0.0f64; self.bones.len()];
        let seed = self.bones[0].row;
        let mut own = vec![false; wood.len()];
        for row in 0..wood.len() as u32 {
            own[row as usize] = row == seed || joints.below(row).is_some_and(|below| own[below as usize]);
            if !own[row as usize] {
                continue;
            }
            for bone in self.bound(joints, row, 1.0).bones {
                let mut at = Some(bone);
                while let Some(bone) = at {
                    let arm = &mut arms[bone as usize];
                    *arm = arm.max(self.bones[bone as usize].rest.distance(wood.place(row)));
                    at = self.bones[bone as usize].parent;
                }
            }
        }
        arms
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

/// What bones of a joint are worth: squares of how far it moves what it carries, summed over rows.
struct Worth {
    /// All of it, which is missed where it has no bones.
    whole: f64,
    /// How far one straight piece misses the curve, and how many rows lie on that.
    sagitta: f64,
    rows: f64,
}

impl Worth {
    /// What one more than so many pieces gains: nothing where these are near enough.
    fn of_another(&self, pieces: usize, near: f64) -> f64 {
        let is_near = self.sagitta / (pieces * pieces) as f64 <= near;
        if is_near || pieces == MOST_PIECES { 0.0 } else { self.missed(pieces) - self.missed(pieces + 1) }
    }

    /// What so many straight pieces still miss.
    fn missed(&self, pieces: usize) -> f64 {
        let sagitta = self.sagitta / (pieces * pieces) as f64;
        self.rows * sagitta * sagitta
    }
}

/// What bones of each joint are worth, by joint.
fn worth(joints: &Joints, limbs: &Limbs, wood: &Wood, reach: &[f64]) -> Vec<Worth> {
    // Σ 1, Σ x and Σ |x|² over the rows that each joint carries.
    let mut sums = vec![(0.0, DVec3::ZERO, 0.0); joints.all().len()];
    for (row, ride) in joints.rides().iter().enumerate().filter(|(_, ride)| ride.joint != NONE) {
        let (count, first, second) = &mut sums[ride.joint as usize];
        let place = wood.place[row];
        (*count, *first, *second) = (*count + 1.0, *first + place, *second + place.length_squared());
    }
    let own: Vec<f64> = sums.iter().map(|&(count, ..)| count).collect();
    for (joint, at) in joints.all().iter().enumerate().rev() {
        if let Some(parent) = at.parent {
            let (count, first, second) = sums[joint];
            let below = &mut sums[parent as usize];
            *below = (below.0 + count, below.1 + first, below.2 + second);
        }
    }
    let of = |(number, joint): (usize, &Joint)| {
        let (count, first, second) = sums[number];
        let base = wood.place[joint.node as usize];
        let about = second - 2.0 * base.dot(first) + count * base.length_squared();
        let length: f64 = limbs.rows(joint.limb).iter().map(|&row| wood.length[row as usize]).sum();
        let reach = reach[number];
        Worth { whole: reach * reach * about.max(0.0), sagitta: reach * length / 8.0, rows: own[number] }
    };
    joints.all().iter().enumerate().map(of).collect()
}

/// Which joints are shown, in how many pieces each: bone by bone what is worth most, a joint after those that bear it.
fn shown(
    joints: &Joints,
    limbs: &Limbs,
    wood: &Wood,
    own: &[u32],
    reach: &[f64],
    near: f64,
    most: usize,
) -> BTreeMap<u32, usize> {
    let worth = worth(joints, limbs, wood, reach);
    let mut shown: BTreeMap<u32, usize> = BTreeMap::new();
    let mut left = most;
    loop {
        let mut best: (f64, Option<u32>) = (0.0, None);
        for &joint in own {
            let (gain, bones) = match shown.get(&joint) {
                Some(&pieces) => (worth[joint as usize].of_another(pieces, near), 1),
                None => bare(joints, &shown, joint).fold((0.0, 0), |(gain, bones), at| {
                    let worth = &worth[at as usize];
                    (gain + worth.whole - worth.missed(1), bones + 2)
                }),
            };
            // Of two alike the first.
            if bones as usize <= left && gain / f64::from(bones) > best.0 {
                best = (gain / f64::from(bones), Some(joint));
            }
        }
        let (_, Some(joint)) = best else { return shown };
        if let Some(pieces) = shown.get_mut(&joint) {
            *pieces += 1;
            left -= 1;
        } else {
            let chain: Vec<u32> = bare(joints, &shown, joint).collect();
            left = left.saturating_sub(2 * chain.len());
            shown.extend(chain.into_iter().map(|joint| (joint, 1)));
        }
    }
}

/// A joint and those of its bearers that are not shown either.
fn bare<'a>(
    joints: &'a Joints,
    shown: &'a BTreeMap<u32, usize>,
    joint: u32,
) -> impl Iterator<Item = u32> + 'a {
    std::iter::successors(Some(joint), |&at| joints.all()[at as usize].parent)
        .take_while(|at| !shown.contains_key(at))
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
