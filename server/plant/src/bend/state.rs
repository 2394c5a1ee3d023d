//! A bend as plain data, for snapshots.

use glam::{DQuat, DVec3, Vec3};

use super::{Bend, chain::Chain, energy::Prism};

/// Everything a [`Bend`] knows; a bend made of it goes on bit for bit as the one it was taken from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BendState {
    /// The path's nodes at rest, one more than internodes.
    pub nodes: Vec<Vec3>,
    /// The radius of each internode.
    pub radii: Vec<f32>,
    /// 0, stiff in length, to 1.
    pub stretch: f32,
    /// For each prism its centre, then its rotation's x, y, z, w.
    pub prisms: Vec<[f64; 7]>,
    /// Touched internodes from the base upwards, with where each is pulled.
    pub targets: Vec<(u32, [f64; 3])>,
}

impl Bend {
    /// What it takes to go on later.
    pub fn state(&self) -> BendState {
        let prism = |&Prism { centre, rotation }: &Prism| {
            let ([x, y, z], [i, j, k, w]) = (centre.to_array(), rotation.to_array());
            [x, y, z, i, j, k, w]
        };
        BendState {
            nodes: self.chain.nodes().to_vec(),
            radii: self.chain.radii().to_vec(),
            stretch: self.chain.stretch(),
            prisms: self.prisms.iter().map(prism).collect(),
            targets: self.targets.iter().map(|&(at, target)| (at as u32, target.to_array())).collect(),
        }
    }

    /// Goes on from there. None if its parts do not fit together, or hold what is no number.
    pub fn from_state(state: &BendState) -> Option<Self> {
        let BendState { nodes, radii, stretch, prisms, targets } = state;
        if radii.is_empty() || nodes.len() != radii.len() + 1 || !nodes.iter().all(|node| node.is_finite()) {
            return None;
        }
        let chain = Chain::new(nodes, radii, *stretch);
        let numbers = prisms.as_flattened().iter().chain(targets.iter().flat_map(|(_, target)| target));
        let is_in_order = targets.windows(2).all(|pair| pair[0].0 < pair[1].0)
            && targets.iter().all(|&(at, _)| at > 0 && (at as usize) < radii.len());
        let is_turn = |&[_, _, _, i, j, k, w]: &[f64; 7]| DQuat::from_xyzw(i, j, k, w).is_normalized();
        let is_whole = prisms.len() == chain.prisms()
            && prisms.iter().all(is_turn)
            && numbers.copied().all(f64::is_finite);
        if !is_whole || !is_in_order {
            return None;
        }
        let prism = |&[x, y, z, i, j, k, w]: &[f64; 7]| Prism {
            centre: DVec3::new(x, y, z),
            rotation: DQuat::from_xyzw(i, j, k, w),
        };
        Some(Self {
            chain,
            prisms: prisms.iter().map(prism).collect(),
            targets: targets.iter().map(|&(at, target)| (at as usize, DVec3::from_array(target))).collect(),
        })
    }
}
