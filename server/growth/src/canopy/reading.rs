//! Light is read at the canopy's nodes.
//!
//! Only where buds sit does it count for growth. While a whole crown grows, what the others get is left for whoever
//! draws the plant.

use espalier_plant::{Plant, reserve};
use glam::Vec3;

use super::{Canopy, NODES_IN_SHADOW, node::Node, response, wood::Slotted};
use crate::{
    cells::bits,
    light::{ShadowGrid, Spot},
    parameter_table::ParameterTable,
    scene::Scene,
    side_by_side::Run,
    vigor::{self, Sums},
};

/// Nodes that are looked at together: one bit each.
const GROUP: usize = 64;
/// Nodes that one thread looks at at a time.
const BATCH: usize = if cfg!(test) { GROUP } else { 32 * GROUP };

/// What light at the nodes follows from.
#[derive(Clone, Copy)]
struct Reader<'a> {
    plant: &'a Plant,
    wood: Slotted<'a>,
    shadows: &'a ShadowGrid,
    sky: &'a [f32],
    propensities: &'a [f32],
    parameters: &'a ParameterTable,
}

/// Nodes that are read together.
struct Group<'a> {
    /// Slot of the first.
    first: usize,
    nodes: &'a [Node],
    spots: &'a [Spot],
    light: &'a mut [f32],
    sums: &'a mut [Sums],
}

impl Reader<'_> {
    fn place(self, slot: usize) -> Vec3 {
        self.plant.metamers().end(self.wood.id(slot))
    }

    #[inline(always)]
    fn light(self, slot: usize, spot: &Spot) -> f32 {
        let exposure = self.shadows.exposure_at(spot, || self.place(slot));
        self.sky.get(slot).map_or(exposure, |sky| exposure * sky)
    }

    /// Q = bL^κ of the buds at a node, of which the lateral ones have these propensities in all.
    #[inline(always)]
    fn input(self, slot: usize, node: Node, propensities: f32, light: f32) -> Sums {
        let axis = self.plant.metamers().axis(self.wood.id(slot));
        let response = response(light, self.parameters.of(axis));
        let main = if node.is_tip() { vigor::quantised(response) } else { 0 };
        Sums { main, lateral: vigor::quantised(response * propensities) }
    }

    /// Puts in what the buds at those nodes of a group make of light, which is read before if `reads` holds.
    #[inline(never)]
    fn put_in(self, group: Group<'_>, which: u64, reads: bool) {
        let Group { first, nodes, spots, light, sums } = group;
        sums.fill(Sums::default());
        // All as long as each other, so that one look at a number says that it belongs to all of them.
        let count = nodes.len();
        let (spots, propensities) = (&spots[..count], &self.propensities[first..][..count]);
        let (light, sums) = (&mut light[..count], &mut sums[..count]);
        // Bit by bit rather than node by node: whether a node bears buds cannot be foreseen.
        for at in bits(which) {
            if at >= count {
                break;
            }
            if reads {
                light[at] = self.light(first + at, &spots[at]);
            }
            sums[at] = self.input(first + at, nodes[at], propensities[at], light[at]);
        }
    }
}

impl Canopy {
    /// Reads the light: where shadows have come or gone at these nodes, or everywhere. Puts in what all buds make of it.
    pub(crate) fn read_light(
        &mut self,
        scene: &Scene,
        changed: &[Vec3],
        parameters: &ParameterTable,
        run: &Run<'_>,
    ) {
        let Scene { plant, space, shadows, obstacles, .. } = scene;
        let Self { nodes, propensities, wood, spots, sky, light, sums, slots, .. } = self;
        let is_new = spots.is_empty();
        let wood = wood.of(plant);
        let place = |slot: usize| plant.metamers().end(wood.id(slot));
        let new = spots.len()..nodes.len();
        reserve(spots, new.len());
        spots.extend(new.map(|slot| shadows.spot(place(slot))));
        if !obstacles.is_empty() {
            let new = sky.len()..nodes.len();
            sky.extend(new.map(|slot| obstacles.sky_share(place(slot))));
        }
        let reader = Reader { plant, wood, shadows, sky, propensities, parameters };
        let are_few = changed.len() * NODES_IN_SHADOW < nodes.len();
        let reads_all = !are_few || is_new || self.is_partly_read;
        if !reads_all {
            let boxes = changed.iter().map(|&place| shadows.reach(place));
            space.nodes_around(boxes, |id| {
                let slot = slots.of(id) as usize;
                if let Some(light) = light.get_mut(slot) {
                    *light = reader.light(slot, &spots[slot]);
                }
            });
        }
        self.is_partly_read = !are_few;
        type Columns<'a> = (((&'a [Node], &'a [Spot]), &'a mut [f32]), &'a mut [Sums]);
        let put_in = |(number, (((nodes, spots), light), sums)): (usize, Columns<'_>)| {
            let groups = nodes.chunks(GROUP).zip(spots.chunks(GROUP));
            let groups = groups.zip(light.chunks_mut(GROUP)).zip(sums.chunks_mut(GROUP));
            for (group, (((nodes, spots), light), sums)) in groups.enumerate() {
                let which = if are_few { u64::MAX } else { bearing(nodes) };
                let first = number * BATCH + group * GROUP;
                reader.put_in(Group { first, nodes, spots, light, sums }, which, reads_all);
            }
        };
        let batches = nodes.chunks(BATCH).zip(spots.chunks(BATCH));
        let batches = batches.zip(light.chunks_mut(BATCH)).zip(sums.chunks_mut(BATCH));
        run.each(batches.enumerate(), put_in);
    }

    /// Reads the light that has been left for whoever draws the plant.
    pub(super) fn read_rest(&mut self, scene: &Scene, parameters: &ParameterTable) {
        if !core::mem::take(&mut self.is_partly_read) {
            return;
        }
        let Scene { plant, shadows, .. } = scene;
        let Self { nodes, propensities, wood, spots, sky, light, .. } = self;
        let reader = Reader { plant, wood: wood.of(plant), shadows, sky, propensities, parameters };
        for (slot, ((node, spot), light)) in nodes.iter().zip(spots).zip(light).enumerate() {
            if !node.has_buds() {
                *light = reader.light(slot, spot);
            }
        }
    }
}

/// Which of a group of nodes bear buds.
#[inline(always)]
fn bearing(nodes: &[Node]) -> u64 {
    nodes.iter().enumerate().fold(0, |bits, (at, node)| bits | u64::from(node.has_buds()) << at)
}
