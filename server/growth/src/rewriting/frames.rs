//! How wood that is drawn is oriented, and by what it has been turned since.

use espalier_plant::{MetamerId, Plant, Wood};
use glam::{Mat3, Quat, Vec3};

use super::Drawn;
use crate::direction::{across, transport};

/// A branch that leaves its bearer by less is no branch to one side: the sine, squared.
const STRAIGHT: f32 = 1e-6;

/// The normals that go with wood as it is drawn: carried along each axis, and begun away from what bears it.
pub(super) fn normals(wood: &Wood) -> Vec<Vec3> {
    let mut normals: Vec<Vec3> = Vec::with_capacity(wood.nodes.len());
    let mut headings: Vec<Vec3> = Vec::with_capacity(wood.nodes.len());
    for node in &wood.nodes {
        let Some(parent) = node.parent.map(|parent| parent as usize) else {
            normals.push(Vec3::X);
            headings.push(Vec3::Y);
            continue;
        };
        let heading = (node.end - wood.nodes[parent].end).normalize_or(Vec3::Y);
        let normal = match node.normal {
            Some(normal) => normal,
            None if wood.nodes[parent].axis == node.axis => {
                transport(normals[parent], headings[parent], heading)
            }
            // A branch that goes straight on from what bears it has no side of its own.
            None if headings[parent].cross(heading).length_squared() < STRAIGHT => normals[parent],
            None => headings[parent],
        };
        normals.push(across(normal, heading));
        headings.push(heading);
    }
    normals
}

/// The orientation of an internode.
pub(super) fn frame(heading: Vec3, normal: Vec3) -> Quat {
    let normal = across(normal, heading);
    Quat::from_mat3(&Mat3::from_cols(normal, heading, normal.cross(heading))).normalize()
}

/// How the wood was drawn before.
pub(super) struct Before {
    /// Names and orientations, in order of the names.
    frames: Vec<(u64, Quat)>,
}

impl Before {
    pub fn new(drawn: &Drawn<'_>) -> Self {
        let nodes = &drawn.wood.nodes;
        let normals = normals(drawn.wood);
        let oriented = |(number, &key): (usize, &u64)| {
            let parent = nodes[number].parent? as usize;
            let heading = (nodes[number].end - nodes[parent].end).try_normalize()?;
            Some((key, frame(heading, normals[number])))
        };
        let mut frames: Vec<(u64, Quat)> = drawn.keys.iter().enumerate().filter_map(oriented).collect();
        frames.sort_unstable_by_key(|&(key, _)| key);
        Self { frames }
    }

    /// By what a row is turned against how it was drawn.
    pub fn turn_of(&self, key: u64, plant: &Plant, row: MetamerId) -> Option<Quat> {
        let at = self.frames.binary_search_by_key(&key, |&(key, _)| key).ok()?;
        let now = frame(plant.heading(row), plant.metamers().normal(row));
        Some((now * self.frames[at].1.inverse()).normalize())
    }
}
