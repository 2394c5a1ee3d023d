//! The canopy: the wood that light still reaches, and the light and vigor that flow through it.
//!
//! Light and vigor concern only nodes that get some light, and the wood that bears them. While shadows only
//! deepen, a branch in full shade stays without vigor for ever, so it is left out until something gives light
//! back. What is left lies packed in birth order: parents stand before what they bear.

mod node;
mod plants;
mod priority;
mod reading;
mod slots;
mod waves;
mod wood;

use espalier_plant::{AxisId, Condition, MetamerId, Plant, reserve};
use espalier_settings::VigorModel;

use crate::{
    gravimorphism::propensity,
    light::Spot,
    parameter_table::ParameterTable,
    parameters::Parameters,
    scene::Scene,
    side_by_side::Run,
    vigor::{self, Split, Sums},
};
use node::Node;
use plants::Plants;
use slots::Slots;
use waves::{Flow, Waves};
use wood::Wood;

/// The canopy is packed anew when one part in so many of it has gone dark.
const DARK_SHARE: usize = 16;
/// Nodes whose light one more shadow may change, roughly: only speed depends on it. Few in tests, so that small
/// plants go both ways.
const NODES_IN_SHADOW: usize = if cfg!(test) { 3 } else { 50 };
const NOWHERE: u32 = u32::MAX;

/// Light and vigor of the present.
#[derive(Clone, Debug, Default)]
pub(crate) struct Canopy {
    nodes: Vec<Node>,
    /// Propensities of the lateral buds at each node that have not grown (TreeSketch Figure 10), added up.
    propensities: Vec<f32>,
    /// The metamer of each node, and the node of its parent.
    wood: Wood,
    waves: Waves,
    /// How many of the nodes are dead.
    dead: usize,
    /// Where light is read, up to those nodes that are new.
    spots: Vec<Spot>,
    /// The share of the sky that is seen past obstacles; empty where there are none.
    sky: Vec<f32>,
    /// Light at each node, 0 to 1.
    light: Vec<f32>,
    /// Whether that of nodes without buds is older than the others'.
    is_partly_read: bool,
    /// Light that flows down into each node; from its own buds alone between reading and adding up.
    sums: Vec<Sums>,
    /// Vigor that enters each metamer.
    vigors: Vec<f64>,
    plants: Plants,
    /// Vigor of each axis' bud under the priority model; empty under the other.
    bud_vigors: Vec<f64>,
    /// Living metamers from each node on upwards; empty while nothing can be shed.
    sizes: Vec<u32>,
    /// Where each metamer of the plant stands in the canopy.
    slots: Slots,
    /// Nodes that have gone dark since conditions were last written.
    darkened: Vec<MetamerId>,
    /// Whether living nodes have been left out.
    has_left_out: bool,
    /// Whether all must be made afresh.
    outdated: bool,
}

impl Canopy {
    /// Light came back, or parameters changed: everything counts again.
    pub(crate) fn forget(&mut self) {
        self.outdated = true;
    }

    /// Takes in what has grown since the last time; what has died must have been [buried](Self::bury).
    pub(crate) fn follow(&mut self, plant: &Plant, parameters: &ParameterTable) {
        let known = self.slots.len();
        let bears_new = |id: &MetamerId| {
            let parent = plant.metamers().parent(*id).filter(|parent| parent.index() < known);
            parent.is_some_and(|parent| self.slots.of(parent) == NOWHERE)
        };
        // A stroke can wake a branch that was left out.
        let mut grown = (known..plant.metamer_count()).map(MetamerId::new);
        if self.outdated || known > plant.metamer_count() || grown.any(|id| bears_new(&id)) {
            *self = Self::default();
        }
        let metamers = plant.metamers();
        let more = plant.metamer_count() - self.slots.len();
        self.slots.reserve(more);
        self.wood.reserve(more);
        reserve(&mut self.nodes, more);
        reserve(&mut self.propensities, more);
        for index in self.slots.len()..plant.metamer_count() {
            let id = MetamerId::new(index);
            if !plant.is_alive(id) {
                self.slots.push(NOWHERE);
                continue;
            }
            let slot = self.nodes.len();
            let parent = metamers.parent(id).map_or(NOWHERE, |parent| self.slots.of(parent));
            let (mut is_main, mut of_plant) = (true, None);
            if (parent as usize) < slot {
                of_plant = Some(self.plants.number(parent as usize));
                let below = self.wood.of(plant).id(parent as usize);
                is_main = metamers.axis(below) == metamers.axis(id);
                if is_main {
                    self.nodes[parent as usize].set_tip(false);
                } else {
                    self.count_laterals(parent as usize, plant, parameters);
                }
            }
            let of_plant = of_plant.unwrap_or_else(|| self.plants.add(id));
            self.slots.push(slot as u32);
            self.waves.add(slot as u32, parent);
            self.wood.push(slot, id, parent, plant);
            self.plants.push(slot, of_plant);
            let mut node = Node::new(is_main);
            // An axis that was cut has no bud any more.
            node.set_tip(plant.is_axis_alive(metamers.axis(id)));
            self.nodes.push(node);
            self.propensities.push(0.0);
            self.count_laterals(slot, plant, parameters);
        }
        reserve(&mut self.light, more);
        reserve(&mut self.sums, more);
        reserve(&mut self.vigors, more);
        self.light.resize(self.nodes.len(), 0.0);
        self.sums.resize(self.nodes.len(), Sums::default());
        self.vigors.resize(self.nodes.len(), 0.0);
    }

    /// Takes in which lateral buds at a node have not grown.
    fn count_laterals(&mut self, slot: usize, plant: &Plant, parameters: &ParameterTable) {
        let propensity = propensity_of_buds(plant, self.wood.of(plant).id(slot), parameters);
        self.propensities[slot] = propensity;
        self.nodes[slot].set_laterals(propensity > 0.0);
    }

    /// Goes back to where the plant has gone back to: its latest metamers are no more, and it has lost none of
    /// the others. Fails if light comes back to what was left out.
    pub(crate) fn retreat(&mut self, plant: &Plant, parameters: &ParameterTable) {
        let count = plant.metamer_count();
        if self.outdated || self.has_left_out || count > self.slots.len() {
            return self.forget();
        }
        let wood = self.wood.of(plant);
        let kept = wood.partition(self.nodes.len(), |id| id.index() < count);
        let orphaned: Vec<u32> = (kept..self.nodes.len())
            .map(|slot| wood.parent(slot))
            .filter(|&parent| (parent as usize) < kept)
            .collect();
        self.dead -= self.nodes[kept..].iter().filter(|node| node.is_dead()).count();
        self.nodes.truncate(kept);
        self.propensities.truncate(kept);
        self.wood.truncate(kept);
        self.waves.truncate(kept as u32);
        self.spots.truncate(kept);
        self.sky.truncate(kept);
        self.slots.truncate(count);
        self.plants.truncate(kept);
        self.plants.retain(|seed| seed.index() < count);
        for parent in orphaned {
            let id = self.wood.of(plant).id(parent as usize);
            let axis = plant.metamers().axis(id);
            let is_tip = plant.axes().last(axis) == Some(id) && plant.is_axis_alive(axis);
            self.nodes[parent as usize].set_tip(is_tip);
            self.count_laterals(parent as usize, plant, parameters);
        }
    }

    /// Lets light flow down and vigor up.
    pub(crate) fn distribute_vigor(&mut self, plant: &Plant, parameters: &ParameterTable, run: &Run<'_>) {
        let lambda = |seed| f64::from(parameters.scene().apical_control_at(plant.age(seed)));
        self.plants.set_lambdas(lambda);
        let dark = self.gather_light(plant, parameters);
        if parameters.scene().vigor_model == VigorModel::Priority {
            return self.distribute_by_priority(plant, parameters);
        }
        // With shedding, size counts in the dark as well.
        let may_pack = parameters.scene().shedding_threshold == 0.0;
        if may_pack && dark * DARK_SHARE > self.nodes.len() {
            self.has_left_out = true;
            self.pack(plant, |_, sums| sums.light() > 0);
        }
        self.bud_vigors.clear();
        let gain = f64::from(parameters.scene().vigor_gain) / vigor::UNIT;
        let Self { nodes, wood, sums, vigors, plants, waves, .. } = self;
        let flow = Flow { nodes, wood: wood.of(plant), sums, plants, gain };
        waves.share_out(flow, vigors, run);
    }

    /// Tips before bases. Returns how many nodes no light flows through.
    fn gather_light(&mut self, plant: &Plant, parameters: &ParameterTable) -> usize {
        let counts_size = parameters.scene().shedding_threshold > 0.0;
        self.sizes.clear();
        self.sizes.resize(if counts_size { self.nodes.len() } else { 0 }, 0);
        let mut dark = 0;
        let wood = self.wood.of(plant);
        let (nodes, sums) = (&self.nodes[..], &mut self.sums[..]);
        for slot in (0..nodes.len()).rev() {
            let (node, through) = (nodes[slot], sums[slot].light());
            dark += usize::from(through == 0);
            let parent = wood.parent(slot);
            if parent == NOWHERE {
                continue;
            }
            let below = &mut sums[parent as usize];
            *(if node.is_main() { &mut below.main } else { &mut below.lateral }) += through;
            if counts_size {
                self.sizes[slot] += u32::from(!node.is_dead());
                self.sizes[parent as usize] += self.sizes[slot];
            }
        }
        dark
    }

    /// Takes out what has died, as light and space see it. Its rows go when they have become many.
    pub(crate) fn bury(&mut self, plant: &Plant, dead: &[MetamerId]) {
        for id in dead {
            let slot = self.slots.of(*id);
            self.slots.set(*id, NOWHERE);
            if let Some(node) = self.nodes.get_mut(slot as usize) {
                node.die();
                self.propensities[slot as usize] = 0.0;
                self.darkened.push(*id);
                self.dead += 1;
            }
        }
        if self.dead * DARK_SHARE > self.nodes.len() {
            self.pack(plant, |node, _| !node.is_dead());
        }
    }

    /// Keeps the nodes for which `stays` holds; what they bear stays only with them.
    fn pack(&mut self, plant: &Plant, stays: impl Fn(&Node, &Sums) -> bool) {
        let mut kept = 0;
        self.wood.write_down(self.nodes.len(), plant);
        self.waves.clear();
        self.dead = 0;
        for slot in 0..self.nodes.len() {
            let (node, sums) = (self.nodes[slot], self.sums[slot]);
            let id = self.wood.of(plant).id(slot);
            if !stays(&node, &sums) {
                if !node.is_dead() {
                    self.slots.set(id, NOWHERE);
                    self.darkened.push(id);
                }
                continue;
            }
            let parent = plant.metamers().parent(id).map_or(NOWHERE, |parent| self.slots.of(parent));
            self.slots.set(id, kept as u32);
            self.waves.add(kept as u32, parent);
            self.wood.set(kept, id, parent);
            self.nodes[kept] = node;
            self.propensities[kept] = self.propensities[slot];
            self.plants.shift(slot, kept);
            self.spots[kept] = self.spots[slot];
            if let Some(&sky) = self.sky.get(slot) {
                self.sky[kept] = sky;
            }
            self.light[kept] = self.light[slot];
            self.sums[kept] = sums;
            self.vigors[kept] = self.vigors[slot];
            kept += 1;
        }
        self.nodes.truncate(kept);
        self.propensities.truncate(kept);
        self.plants.truncate(kept);
        self.wood.truncate(kept);
        self.spots.truncate(kept);
        self.sky.truncate(kept);
        self.light.truncate(kept);
        self.sums.truncate(kept);
        self.vigors.truncate(kept);
    }

    /// Vigor of the bud of a living axis.
    pub(crate) fn bud_vigor(&self, plant: &Plant, axis: AxisId, parameters: &ParameterTable) -> f64 {
        let node = plant.bud_node(axis);
        if let Some(&vigor) = self.bud_vigors.get(axis.index()) {
            return vigor;
        }
        let slot = self.slots.of(node) as usize;
        let Some(&vigor) = self.vigors.get(slot) else { return 0.0 };
        let split = Split::new(vigor, self.sums[slot], self.plants.lambda(slot));
        if plant.axes().last(axis).is_some() {
            return split.to_main();
        }
        split.to_lateral(self.lateral_input(plant, axis, node, parameters))
    }

    /// Q = bL^κ of a lateral bud that has not grown, at a node of the canopy.
    fn lateral_input(
        &self,
        plant: &Plant,
        axis: AxisId,
        node: MetamerId,
        parameters: &ParameterTable,
    ) -> u64 {
        let light = self.light[self.slots.of(node) as usize];
        let propensity = propensity_of(plant, axis, node, parameters);
        vigor::quantised(response(light, parameters.of(axis)) * propensity)
    }

    /// Axes whose branches get less vigor for each metamer than their thresholds, as far as they are `old` enough;
    /// who is older than another is old enough if the other is.
    pub(crate) fn starving(
        &self,
        plant: &Plant,
        is_old: impl Fn(MetamerId) -> bool,
        threshold: impl Fn(AxisId) -> f64,
    ) -> Vec<AxisId> {
        let wood = self.wood.of(plant);
        let old = wood.partition(self.nodes.len(), is_old);
        let starve = |slot: usize| {
            let axis = plant.metamers().axis(wood.id(slot));
            let (vigor, size) = (self.vigors[slot], self.sizes[slot]);
            (vigor < threshold(axis) * f64::from(size)).then_some(axis)
        };
        (0..old).filter(|&slot| !self.nodes[slot].is_main()).filter_map(starve).collect()
    }

    /// The vigor that flows through a node for each tip above it; none where no light comes from.
    pub(crate) fn vigor_per_tip(&self, plant: &Plant, id: MetamerId) -> f32 {
        self.vigors.get(self.slots.of(id) as usize).map_or(0.0, |&vigor| per_tip(plant, id, vigor))
    }

    /// The greatest of these of all nodes.
    pub(crate) fn greatest_vigor(&self, plant: &Plant) -> f32 {
        let wood = self.wood.of(plant);
        let vigors = self.vigors.iter().enumerate();
        vigors.map(|(slot, &vigor)| per_tip(plant, wood.id(slot), vigor)).fold(0.0, f32::max)
    }

    /// Hands light and vigor on to whoever draws the plant.
    pub(crate) fn write_conditions(&mut self, scene: &mut Scene, parameters: &ParameterTable) {
        self.read_rest(scene, parameters);
        let plant = &mut scene.plant;
        let count = plant.metamer_count();
        for id in self.darkened.drain(..).filter(|id| id.index() < count) {
            plant.set_condition(id, Condition { light: 0, vigor: 0 });
        }
        let greatest = self.greatest_vigor(plant);
        let scale = if greatest > 0.0 { 255.0 / greatest } else { 0.0 };
        for (slot, (sums, light)) in self.sums.iter().zip(&self.light).enumerate() {
            let id = self.wood.of(plant).id(slot);
            // By way of i32: LLVM 22 crashes on a vectorised conversion of floats to bytes.
            let byte = |x: f32| x as i32 as u8;
            let vigor = per_tip(plant, id, self.vigors[slot]) * scale;
            // Wood that bears only buds in the dark is drawn as what has been left out, which it soon will be.
            let light = if sums.light() > 0 { *light } else { 0.0 };
            let condition = Condition { light: byte(light * 255.0), vigor: byte(vigor) };
            plant.set_condition(id, condition);
        }
    }
}

fn per_tip(plant: &Plant, id: MetamerId, vigor: f64) -> f32 {
    vigor as f32 / plant.metamers().tips(id).max(1) as i32 as f32
}

/// L^κ (TreeSketch §3.2).
#[inline]
fn response(light: f32, parameters: &Parameters) -> f32 {
    let kappa = parameters.light_sensitivity;
    if kappa == 1.0 { light } else { libm::powf(light, kappa) }
}

/// Propensities of the lateral buds at a node, added up.
fn propensity_of_buds(plant: &Plant, node: MetamerId, parameters: &ParameterTable) -> f32 {
    plant
        .laterals(node)
        .filter(|&axis| plant.axes().last(axis).is_none() && plant.is_axis_alive(axis))
        .map(|axis| propensity_of(plant, axis, node, parameters))
        .sum()
}

/// Propensity b of a lateral bud (TreeSketch §3.2, Figure 10). Buds that have grown do not feel gravimorphism.
fn propensity_of(plant: &Plant, axis: AxisId, node: MetamerId, parameters: &ParameterTable) -> f32 {
    let parameters = parameters.of(axis);
    if !parameters.is_gravimorphic {
        return 1.0;
    }
    propensity(plant.heading(node), plant.axes().direction(axis), parameters)
}
