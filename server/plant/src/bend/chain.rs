//! The rest shape: prisms, what holds them together, and where the path's nodes are among them.

use glam::{DQuat, DVec3, Vec3};

use super::energy::Prism;

/// Beyond so many internodes a prism stands for several of them, so that an event takes a finger no time.
const MOST_PRISMS: usize = 300;
/// Resistance to bending over that to stretching and the square of the length, for a stiff branch and for rubber.
/// A bend of some radians stretches wood by a few times this.
const STIFF: f64 = 5e-4;
const RUBBER: f64 = 0.2;
/// Stiffness of joints, as multiples of that of the base: no twig is limp, no constraint makes wood rigid.
const STIFFNESS: [f64; 2] = [0.03, 4.0];
/// The shortest distance between joints, as a share of the mean.
const SHORTEST: f64 = 0.25;

/// Where something stands between the middles of a prism (share 0) and the next one (share 1).
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub prism: usize,
    pub share: f64,
}

/// What holds a prism to the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct Joint {
    /// Where it is, from the centre of the prism below and of that above.
    pub below: DVec3,
    pub above: DVec3,
    /// Energy of a gap of one internode, and half that of a turn, per radian squared.
    pub gap: f64,
    pub turn: f64,
}

/// The rest shape of a path. Lengths are in internodes; energy is in units of what doubles the length.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    nodes: Vec<Vec3>,
    radii: Vec<f32>,
    stretch: f32,
    /// Length along the wood from the base internode's end to each node; that itself is second.
    along: Vec<f64>,
    length: f64,
    group: usize,
    centres: Vec<DVec3>,
    joints: Vec<Joint>,
}

impl Chain {
    pub fn new(nodes: &[Vec3], radii: &[f32], stretch: f32) -> Self {
        assert!(
            !radii.is_empty() && nodes.len() == radii.len() + 1,
            "each internode has two ends and a radius"
        );
        let internodes = radii.len();
        let group = (internodes - 1).div_ceil(MOST_PRISMS).max(1);
        let mut along = vec![0.0; nodes.len()];
        for i in 2..nodes.len() {
            along[i] = along[i - 1] + nodes[i].as_dvec3().distance(nodes[i - 1].as_dvec3());
        }
        let length = along[internodes];
        let length = if length > 0.0 { length } else { 1.0 };
        let mut chain = Self {
            nodes: nodes.to_vec(),
            radii: radii.to_vec(),
            stretch,
            along,
            length,
            group,
            centres: Vec::new(),
            joints: Vec::new(),
        };
        let prisms = 1 + (internodes - 1).div_ceil(group);
        let ends = |prism| {
            let [first, last] = chain.members(prism);
            [chain.node(first), chain.node(last + 1)]
        };
        chain.centres = (0..prisms).map(|prism| 0.5 * (ends(prism)[0] + ends(prism)[1])).collect();
        chain.joints = (1..prisms).map(|prism| chain.joint(prism)).collect();
        chain
    }

    /// First and last internode of a prism. The base has one of its own.
    fn members(&self, prism: usize) -> [usize; 2] {
        match prism {
            0 => [0, 0],
            _ => [1 + (prism - 1) * self.group, (prism * self.group).min(self.internodes() - 1)],
        }
    }

    /// What holds a prism to the one below.
    fn joint(&self, prism: usize) -> Joint {
        let [first, last] = self.members(prism);
        let [below, _] = self.members(prism - 1);
        let node = self.node(first);
        let lower =
            if prism == 1 { self.node(0).distance(node) } else { self.along[first] - self.along[below] };
        let mean = self.length / (self.centres.len() - 1) as f64;
        let distance = (0.5 * (lower + self.along[last + 1] - self.along[first])).max(SHORTEST * mean);
        let stretch = f64::from(self.stretch).clamp(0.0, 1.0);
        let resistance = STIFF * libm::pow(RUBBER / STIFF, stretch) * self.length;
        Joint {
            below: node - self.centres[prism - 1],
            above: node - self.centres[prism],
            gap: 1.0 / (self.length * distance),
            turn: resistance * self.stiffness(first) / (2.0 * distance),
        }
    }

    /// Resistance to bending where an internode begins, as a multiple of that at the base: thick wood bends less.
    fn stiffness(&self, internode: usize) -> f64 {
        let radius = f64::from(0.5 * (self.radii[internode - 1] + self.radii[internode]));
        let ratio = radius / f64::from(self.radii[0]);
        if ratio.is_finite() { (ratio * ratio).clamp(STIFFNESS[0], STIFFNESS[1]) } else { 1.0 }
    }

    pub fn internodes(&self) -> usize {
        self.radii.len()
    }

    pub fn node(&self, index: usize) -> DVec3 {
        self.nodes[index].as_dvec3()
    }

    pub fn prisms(&self) -> usize {
        self.centres.len()
    }

    pub fn nodes(&self) -> &[Vec3] {
        &self.nodes
    }

    pub fn radii(&self) -> &[f32] {
        &self.radii
    }

    pub fn stretch(&self) -> f32 {
        self.stretch
    }

    /// Length of the wood above the base internode; 1 if it has none.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Length along the wood from the end of the base internode to a node above.
    pub fn along(&self, node: usize) -> f64 {
        self.along[node]
    }

    /// Where a prism stands at rest.
    pub fn centre(&self, prism: usize) -> DVec3 {
        self.centres[prism]
    }

    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// The prisms at rest.
    pub fn rest(&self) -> Vec<Prism> {
        self.centres.iter().map(|&centre| Prism { centre, rotation: DQuat::IDENTITY }).collect()
    }

    /// Where the far end of an internode is. That of the base moves no more than the base.
    pub fn end(&self, internode: usize) -> Place {
        if internode == 0 { Place { prism: 0, share: 0.0 } } else { self.at(internode as f64 + 0.5) }
    }

    /// Where the middle of an internode is.
    pub fn middle(&self, internode: usize) -> Place {
        self.at(internode as f64)
    }

    /// Counted in internodes from the middle of the base.
    fn at(&self, place: f64) -> Place {
        let last = self.centres.len() - 1;
        let middle = |prism| {
            let [first, last] = self.members(prism);
            0.5 * (first + last) as f64
        };
        if place >= middle(last) {
            return Place { prism: last, share: 0.0 };
        }
        let beyond = (place - middle(1)) / self.group as f64;
        let prism = if beyond < 0.0 { 0 } else { 1 + beyond as usize };
        let share = (place - middle(prism)) / (middle(prism + 1) - middle(prism));
        Place { prism, share }
    }
}
