//! Rest shapes.

use espalier_plant::{Bend, Motion};
use glam::Vec3;

/// A path at rest.
#[derive(Clone)]
pub struct Shape {
    pub name: String,
    pub nodes: Vec<Vec3>,
    pub radii: Vec<f32>,
}

impl Shape {
    /// From the directions and lengths of its internodes.
    pub fn new(name: &str, internodes: usize, step: impl Fn(f32, usize) -> Vec3, tip: f32) -> Self {
        let share = |i: usize| i as f32 / internodes as f32;
        let mut nodes = vec![Vec3::new(3.0, 1.0, -2.0)];
        for i in 0..internodes {
            nodes.push(nodes[i] + step(share(i), i));
        }
        let radii = (0..internodes).map(|i| 0.5 * (1.0 + (tip - 1.0) * share(i))).collect();
        Self { name: format!("{name}, {internodes} internodes, tip {tip}"), nodes, radii }
    }

    pub fn straight(internodes: usize, tip: f32) -> Self {
        Self::new("straight", internodes, |_, _| Vec3::Y, tip)
    }

    pub fn curved(internodes: usize, tip: f32) -> Self {
        let step = |share: f32, _: usize| Vec3::new(libm::sinf(1.8 * share), libm::cosf(1.8 * share), 0.0);
        Self::new("curved", internodes, step, tip)
    }

    pub fn zigzag(internodes: usize, tip: f32) -> Self {
        let step =
            |share: f32, i: usize| Vec3::new(if i.is_multiple_of(2) { 0.5 } else { -0.4 }, 0.8, 0.3 * share);
        Self::new("zigzag", internodes, step, tip)
    }

    /// Wound, with internodes of different lengths.
    pub fn uneven(internodes: usize, tip: f32) -> Self {
        let step = |_: f32, i: usize| {
            let angle = 0.3 * i as f32;
            let length = [1.0, 0.3, 1.7, 0.05][i % 4];
            length * Vec3::new(0.5 * libm::sinf(angle), 0.8, 0.5 * libm::cosf(angle))
        };
        Self::new("uneven", internodes, step, tip)
    }

    /// One of each kind, with even radii and with falling ones.
    pub fn all(internodes: usize) -> Vec<Self> {
        let kinds = [Self::straight, Self::curved, Self::zigzag, Self::uneven];
        kinds.iter().flat_map(|kind| [kind(internodes, 1.0), kind(internodes, 0.15)]).collect()
    }

    pub fn last(&self) -> usize {
        self.radii.len() - 1
    }

    pub fn tip(&self) -> Vec3 {
        self.nodes[self.nodes.len() - 1]
    }

    /// Of the wood above the base internode.
    pub fn length(&self) -> f32 {
        self.nodes.windows(2).skip(1).map(|pair| pair[0].distance(pair[1])).sum()
    }

    pub fn bend(&self, stretch: f32) -> Bend {
        Bend::new(&self.nodes, &self.radii, stretch)
    }

    /// Length of the wood above the base in a bend.
    pub fn length_in(&self, motions: &[Motion]) -> f32 {
        motions.windows(2).map(|pair| pair[0].to.distance(pair[1].to)).sum()
    }

    /// How far the farthest node is from rest, as a share of the length.
    pub fn deviation(&self, motions: &[Motion]) -> f32 {
        motions.iter().map(|motion| motion.to.distance(motion.from)).fold(0.0, f32::max) / self.length()
    }
}

/// Where nodes are.
pub fn places(bend: &Bend) -> Vec<Vec3> {
    bend.motions().iter().map(|motion| motion.to).collect()
}

/// Brings the branch wholly to rest under touches that do not move any more.
pub fn settle(bend: &mut Bend, targets: &[(usize, Vec3)]) {
    bend.drag(targets);
    bend.relax();
    bend.relax();
}
