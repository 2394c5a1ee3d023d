//! Growth without guidance: each bud has a few markers in its own perception volume (TreeSketch §3.2).
//!
//! A bud wins those of its markers that lie in no bud's occupancy zone and for which it is the nearest
//! perceiver; with none won it is not enabled. Buds are asked in descending vigor and only until the vigor
//! is too small for a single internode, for what a weaker bud sees cannot matter any more. The paper lets
//! every bud also claim markers sown by others; a bud's own markers fill its volume evenly already, so the
//! difference is one of density, and asking few buds instead of all is most of the speed.
//!
//! A bud keeps its markers as long as it stays where it is. So a marker found in an occupancy zone stays
//! there until some node goes, and a bud with no other markers need not be asked: most of a crown is closed.

use core::f32::consts::TAU;

use espalier_plant::AxisId;
use glam::Vec3;

use crate::{
    parameter_table::ParameterTable,
    parameters::Parameters,
    random::{Draw, Purpose},
    space::{Contest, Space},
};

/// What earlier looks around have taught about each bud. Forgetting it changes nothing but the time it takes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Memory {
    memories: Vec<Remembered>,
}

/// What is remembered of one bud.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Remembered {
    /// The node the bud was at; elsewhere its other markers make this worthless.
    node: u32,
    /// Markers known to be occupied, one bit each.
    pub closed: u32,
    /// The bud that last took a marker away, for it will often take the next.
    pub rival: Option<AxisId>,
}

impl Memory {
    /// What is remembered of a bud at a node.
    pub(crate) fn of(&self, axis: AxisId, node: u32) -> Remembered {
        let nothing = Remembered { node, closed: 0, rival: None };
        self.memories.get(axis.index()).filter(|memory| memory.node == node).copied().unwrap_or(nothing)
    }

    /// Remembers it.
    pub(crate) fn set(&mut self, axis: AxisId, memory: Remembered) {
        if axis.index() >= self.memories.len() {
            let nothing = Remembered { node: u32::MAX, closed: 0, rival: None };
            self.memories.resize(axis.index() + 1, nothing);
        }
        self.memories[axis.index()] = memory;
    }

    /// Forgets everything: some node has gone, or parameters are others.
    pub(crate) fn forget(&mut self) {
        self.memories.clear();
    }
}

/// All of a bud's markers, as bits.
pub(crate) fn all_markers(parameters: &Parameters) -> u32 {
    u32::MAX >> (32 - parameters.markers_per_bud)
}

/// Lets a bud look at those of its markers that are not known to be occupied. Returns the direction E towards
/// the free space it has won, if any, and what it has learnt.
pub(crate) fn look_around(
    axis: AxisId,
    memory: Remembered,
    space: &Space,
    parameters: &ParameterTable,
    seed: u32,
) -> (Option<Vec3>, Remembered) {
    let (closed, mut memory) = (memory.closed, memory);
    let Some(bud) = space.bud(axis) else { return (None, memory) };
    let own = parameters.of(axis);
    let draw = Draw::new(seed, Purpose::Autonomous, axis.raw(), memory.node);
    let (u, w) = bud.direction.any_orthonormal_pair();
    let mut sum = Vec3::ZERO;
    for marker in (0..own.markers_per_bud).filter(|marker| closed >> marker & 1 == 0) {
        let drawn = own.marker_offsets[draw.below(marker, OFFSETS as u32) as usize];
        let offset = u * drawn.x + bud.direction * drawn.y + w * drawn.z;
        let place = bud.position + offset;
        if memory.rival.is_some_and(|rival| space.outdoes(rival, axis, place, parameters)) {
            continue;
        }
        let contest = if place.y > 0.0 { space.contest(axis, place, parameters) } else { Contest::Occupied };
        match contest {
            Contest::Won => sum += offset.normalize(),
            Contest::LostTo(rival) => memory.rival = Some(rival),
            Contest::Occupied => memory.closed |= 1 << marker,
        }
    }
    (sum.try_normalize(), memory)
}

/// Markers to choose from. A power of two; so many that no two buds look alike.
const OFFSETS: usize = 2048;

/// Points uniform in the perception volume, a truncated cone with spherical base around the y axis.
///
/// Each bud draws its markers from these: a draw is then a look into a table instead of a cube root and a sine.
pub(crate) fn marker_offsets(near: f32, far: f32, cos_half_angle: f32) -> Vec<Vec3> {
    let draw = Draw::new(0, Purpose::Autonomous, 0, 0);
    let (near_cubed, far_cubed) = (near * near * near, far * far * far);
    (0..OFFSETS as u32)
        .map(|marker| {
            let unit = |i| draw.unit(3 * marker + i);
            let distance = libm::cbrtf(near_cubed + (far_cubed - near_cubed) * unit(0));
            let cos = 1.0 - (1.0 - cos_half_angle) * unit(1);
            let sin = (1.0 - cos * cos).max(0.0).sqrt();
            let (sin_azimuth, cos_azimuth) = libm::sincosf(TAU * unit(2));
            Vec3::new(distance * sin * cos_azimuth, distance * cos, distance * sin * sin_azimuth)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use espalier_plant::MetamerId;

    use super::*;

    #[test]
    fn markers_lie_in_the_perception_volume() {
        let parameters = Parameters::default();
        let (near, far) = (parameters.occupancy_radius, parameters.perception_radius());
        for place in parameters.marker_offsets.iter() {
            assert!((near - 1e-3..=far + 1e-3).contains(&place.length()));
            assert!(place.y / place.length() > parameters.cos_half_perception - 1e-4);
        }
    }

    #[test]
    fn a_crowded_bud_finds_no_room() {
        let parameters = ParameterTable::default();
        let mut space = Space::new();
        let axis = AxisId::new(0);
        space.place_bud(axis, Vec3::Y * 20.0, Vec3::Y);
        let blank = Memory::default().of(axis, 1);
        let look = |space: &Space| look_around(axis, blank, space, &parameters, 1);
        assert!(look(&space).0.is_some() && look(&space).1 == blank);
        let mut next = 0;
        for x in -4..=4 {
            for y in 0..=6 {
                for z in -4..=4 {
                    let place = Vec3::new(x as f32 * 1.5, 21.0 + y as f32 * 1.5, z as f32 * 1.5);
                    space.occupy(MetamerId::new(next), place);
                    next += 1;
                }
            }
        }
        let (found, memory) = look(&space);
        assert_eq!((found, memory.closed), (None, all_markers(parameters.scene())));
    }
}
