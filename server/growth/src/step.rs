//! One step of the simulation, phase by phase, in the order of TreeSketch §3.2, but that buds growing without
//! guidance look for room after vigor is known (see `autonomous.rs`).

use std::collections::BTreeMap;

use espalier_plant::{Appearance, AxisId, MetamerId, Plant};
use glam::Vec3;
use rayon::prelude::*;

use crate::{
    autonomous::{self, Memory, Remembered},
    brush::BrushPiece,
    gravimorphism::propensity,
    observer::{Observer, Phase},
    parameters::Parameters,
    shedding,
    shoot::Aim,
    simulation::Simulation,
    vigor::VigorFlow,
};

/// What guides one step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StepInput {
    /// What the brushes do.
    pub pieces: Vec<BrushPiece>,
    /// Whether buds also look for room on their own.
    pub autonomous: bool,
}

/// What a step brought about.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StepOutcome {
    /// Metamers added.
    pub metamers_grown: u32,
    /// Buds that had markers to grow towards.
    pub buds_enabled: u32,
}

/// Columns that live only within a step, kept for their memory.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scratch {
    /// Light at each metamer's node.
    pub light: Vec<f32>,
    /// Q of each bud.
    pub input: Vec<f32>,
    pub flow: VigorFlow,
    pub memory: Memory,
}

/// Work smaller than this is not worth handing to other threads.
const PARALLEL_FROM: usize = 4096;
/// Candidates asked at once; a constant, so that the answer never depends on the number of threads.
const BLOCK: usize = 512;

impl Simulation {
    /// One step. A step in which nothing grows or is shed leaves no trace.
    pub fn step(&mut self, input: &StepInput, observer: &mut impl Observer) -> StepOutcome {
        self.budget_reached = false;
        self.tick = self.tick.wrapping_add(1);
        self.plant.begin_step();
        let before = self.plant.metamer_count();

        observer.enter(Phase::Space);
        self.sow_and_clear_markers(input);
        let mut enabled = self.associate_markers();
        observer.enter(Phase::Light);
        self.read_light();
        observer.enter(Phase::Vigor);
        self.distribute_vigor();
        observer.enter(Phase::Shedding);
        self.shed();

        observer.enter(Phase::Space);
        let stroke = input.pieces.iter().find_map(BrushPiece::direction);
        if input.autonomous {
            self.find_free_space(&mut enabled);
        }
        let buds_enabled = enabled.len() as u32;
        observer.enter(Phase::Growth);
        self.grow(enabled, stroke);
        observer.enter(Phase::Girth);
        self.plant.end_step();
        self.write_appearance();
        StepOutcome { metamers_grown: (self.plant.metamer_count() - before) as u32, buds_enabled }
    }

    fn sow_and_clear_markers(&mut self, input: &StepInput) {
        let tick = self.tick;
        let parameters = self.parameters.scene();
        for piece in &input.pieces {
            piece.sow(&mut self.markers, self.seed, tick, parameters);
            let guide = self.guides.entry(piece.stroke).or_default();
            for &sample in &piece.samples {
                guide.follow(sample, parameters.occupancy_radius);
            }
            guide.choose_leader(&self.space, 2.0 * parameters.perception_radius());
        }
        let (space, radius) = (&self.space, parameters.occupancy_radius);
        self.markers
            .clear(tick, parameters.marker_max_age, |place| !space.is_occupied(place, radius, |_| true));
    }

    /// Gives each marker to the nearest bud that perceives it; returns those buds with their direction E.
    fn associate_markers(&self) -> BTreeMap<AxisId, Vec3> {
        let mut claims: BTreeMap<AxisId, Vec3> = BTreeMap::new();
        for marker in self.markers.as_slice() {
            if let Some(axis) = self.space.nearest_perceiving(marker.position, &self.parameters) {
                let towards = (marker.position - self.plant.bud_position(axis)).normalize();
                *claims.entry(axis).or_insert(Vec3::ZERO) += towards;
            }
        }
        claims.into_iter().filter_map(|(axis, sum)| Some((axis, sum.try_normalize()?))).collect()
    }

    pub(crate) fn read_light(&mut self) {
        let (plant, shadows) = (&self.plant, &self.shadows);
        let count = plant.metamer_count();
        let light = &mut self.scratch.light;
        light.resize(count, 0.0);
        let read = |(index, light): (usize, &mut f32)| {
            let id = MetamerId::new(index);
            if plant.is_alive(id) {
                *light = shadows.exposure(plant.metamers().end(id));
            }
        };
        if count < PARALLEL_FROM {
            light.iter_mut().enumerate().for_each(read);
        } else {
            light.par_iter_mut().with_min_len(PARALLEL_FROM / 2).enumerate().for_each(read);
        }
    }

    pub(crate) fn distribute_vigor(&mut self) {
        let Scratch { light, input, flow, .. } = &mut self.scratch;
        let plant = &self.plant;
        input.resize(plant.axis_count(), 0.0);
        for (index, input) in input.iter_mut().enumerate() {
            let axis = AxisId::new(index);
            if plant.is_axis_alive(axis) {
                let node = plant.bud_node(axis);
                *input = bud_input(plant, axis, node, light[node.index()], self.parameters.of(axis));
            }
        }
        flow.compute(plant, input, &self.parameters);
    }

    fn shed(&mut self) {
        let condemned = shedding::condemned(&self.plant, &self.scratch.flow, &self.parameters);
        for axis in condemned {
            if !self.plant.is_axis_alive(axis) {
                continue;
            }
            self.scratch.memory.forget();
            let (_, axes) = self.plant.branch(axis);
            for axis in axes {
                self.space.remove_bud(axis);
            }
            for id in self.plant.shed(axis) {
                self.leave(id);
            }
        }
    }

    /// Lets buds look for room, the most vigorous first, until no internode can come of it.
    fn find_free_space(&mut self, enabled: &mut BTreeMap<AxisId, Vec3>) {
        let mut memory = core::mem::take(&mut self.scratch.memory);
        let node_of = |axis| self.plant.bud_node(axis).raw();
        let mut candidates: Vec<(f64, AxisId)> = (0..self.plant.axis_count())
            .map(AxisId::new)
            .filter(|&axis| self.plant.is_axis_alive(axis))
            .filter(|&axis| {
                memory.of(axis, node_of(axis)).closed != autonomous::all_markers(self.parameters.of(axis))
            })
            .map(|axis| (self.bud_vigor(axis), axis))
            .filter(|&(vigor, _)| vigor > 0.0)
            .collect();
        candidates.sort_unstable_by(by_vigor);
        let mut found: Vec<(f64, AxisId, Vec3)> = Vec::new();
        let mut greatest = enabled.keys().map(|&axis| self.bud_vigor(axis)).fold(0.0, f64::max);
        for block in candidates.chunks(BLOCK) {
            if self.shoot_length(block[0].0, greatest, block[0].1) == 0 {
                break;
            }
            let ask = |&(_, axis): &(f64, AxisId)| {
                let remembered = memory.of(axis, node_of(axis));
                autonomous::look_around(axis, remembered, &self.space, &self.parameters, self.seed)
            };
            let findings: Vec<(Option<Vec3>, Remembered)> =
                block.par_iter().with_min_len(64).map(ask).collect();
            for (&(vigor, axis), (space, remembered)) in block.iter().zip(findings) {
                memory.set(axis, remembered);
                if let Some(space) = space {
                    greatest = greatest.max(vigor);
                    found.push((vigor, axis, space));
                }
            }
        }
        self.scratch.memory = memory;
        // The last block holds some that are too weak; which ones must not depend on where blocks end.
        for (vigor, axis, space) in found {
            if self.shoot_length(vigor, greatest, axis) > 0 {
                enabled.entry(axis).or_insert(space);
            }
        }
    }

    fn bud_vigor(&self, axis: AxisId) -> f64 {
        self.scratch.flow.of_bud(&self.plant, axis, self.scratch.input[axis.index()], &self.parameters)
    }

    /// n = ⌊v / v_max · n_max⌋; the whole n_max while no bud is known to be enabled.
    fn shoot_length(&self, vigor: f64, greatest: f64, axis: AxisId) -> u32 {
        let longest = self.parameters.of(axis).max_shoot_length;
        if greatest <= 0.0 {
            return longest;
        }
        (vigor / greatest * f64::from(longest)).min(f64::from(longest)) as u32
    }

    fn grow(&mut self, mut enabled: BTreeMap<AxisId, Vec3>, stroke: Option<Vec3>) {
        let mut guides = core::mem::take(&mut self.guides);
        for guide in guides.values_mut() {
            let Some(leader) = guide.leader else { continue };
            if !self.plant.is_axis_alive(leader) {
                guide.restart();
                continue;
            }
            let aim = Aim { space: enabled.get(&leader).copied(), stroke };
            let longest = self.parameters.of(leader).max_shoot_length;
            if self.grow_guided(leader, longest, aim, |tip| guide.next_node(tip)) > 0 {
                enabled.remove(&leader);
            }
        }
        self.guides = guides;

        let mut shoots: Vec<(f64, AxisId, Vec3)> = enabled
            .into_iter()
            .filter(|&(axis, _)| self.plant.is_axis_alive(axis))
            .map(|(axis, space)| (self.bud_vigor(axis), axis, space))
            .collect();
        shoots.sort_unstable_by(|a, b| by_vigor(&(a.0, a.1), &(b.0, b.1)));
        let greatest = shoots.first().map_or(0.0, |shoot| shoot.0);
        let lengths: Vec<u32> = shoots
            .iter()
            .map(
                |&(vigor, axis, _)| if greatest > 0.0 { self.shoot_length(vigor, greatest, axis) } else { 0 },
            )
            .collect();
        for ((_, axis, space), length) in shoots.into_iter().zip(lengths) {
            self.grow_shoot(axis, length, Aim { space: Some(space), stroke });
        }
    }

    /// Hands light and vigor on to whoever draws the plant; this step's shoots look like they are in full light.
    pub(crate) fn write_appearance(&mut self) {
        let Scratch { light, flow, .. } = &self.scratch;
        let vigor_per_tip =
            |plant: &Plant, id| flow.of_metamer(id) / f64::from(plant.metamers().tips(id).max(1));
        let known = light.len().min(self.plant.metamer_count());
        let greatest =
            (0..known).map(MetamerId::new).map(|id| vigor_per_tip(&self.plant, id)).fold(0.0, f64::max);
        let scale = if greatest > 0.0 { 255.0 / greatest } else { 0.0 };
        for (index, &light) in light.iter().enumerate().take(known) {
            let id = MetamerId::new(index);
            // By way of u32: LLVM 22 crashes on a vectorised f64-to-u8 conversion.
            let vigor = (vigor_per_tip(&self.plant, id) * scale) as u32 as u8;
            self.plant.set_appearance(id, Appearance { light: (light * 255.0) as u32 as u8, vigor });
        }
    }
}

/// The most vigorous first; of equally vigorous ones the oldest.
fn by_vigor(a: &(f64, AxisId), b: &(f64, AxisId)) -> core::cmp::Ordering {
    b.0.total_cmp(&a.0).then(a.1.cmp(&b.1))
}

/// Q = bL^κ of a bud (TreeSketch §3.2). Gravimorphism concerns lateral buds that have not grown yet.
fn bud_input(plant: &Plant, axis: AxisId, node: MetamerId, light: f32, parameters: &Parameters) -> f32 {
    let kappa = parameters.light_sensitivity;
    let response = if kappa == 1.0 { light } else { libm::powf(light, kappa) };
    if plant.axes().last(axis).is_some() {
        return response;
    }
    response * propensity(plant.heading(node), plant.axes().direction(axis), parameters)
}
