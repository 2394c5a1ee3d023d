//! The simulation: a plant and its surroundings. What happens within a step stands in `step.rs`.

use std::collections::BTreeMap;

use espalier_plant::{AxisId, MetamerId, Plant};
use glam::Vec3;

use crate::{
    brush::StrokeId,
    guide::Guide,
    light::ShadowGrid,
    markers::{Marker, Markers},
    parameter_table::ParameterTable,
    parameters::Parameters,
    space::Space,
    step::Scratch,
};

/// Growth stays within this distance of the origin on each axis, in internodes.
pub const WORLD_EXTENT: f32 = 1000.0;
/// Metamers a scene may hold, dead ones and the undone future included, unless told otherwise.
pub const DEFAULT_METAMER_BUDGET: u32 = 1_000_000;

/// Everything the next step depends on beside the plant.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulationState {
    /// Seed of all randomness.
    pub seed: u32,
    /// The parameters.
    pub parameters: Parameters,
    /// Brush markers still alive.
    pub markers: Vec<Marker>,
    /// Paths of strokes in progress.
    pub guides: BTreeMap<StrokeId, Guide>,
    /// Metamers the scene may hold.
    pub metamer_budget: u32,
    /// Steps ever begun, those included in which nothing grew: the age of markers and the key of their sowing.
    pub tick: u32,
}

/// A scene that grows.
#[derive(Clone, Debug)]
pub struct Simulation {
    pub(crate) seed: u32,
    pub(crate) plant: Plant,
    pub(crate) parameters: ParameterTable,
    pub(crate) shadows: ShadowGrid,
    pub(crate) space: Space,
    pub(crate) metamer_budget: u32,
    pub(crate) budget_reached: bool,
    pub(crate) tick: u32,
    pub(crate) markers: Markers,
    pub(crate) guides: BTreeMap<StrokeId, Guide>,
    pub(crate) scratch: Scratch,
}

impl Simulation {
    /// A seedling: one seed at the origin.
    pub fn new(seed: u32, parameters: Parameters) -> Self {
        let state = SimulationState {
            seed,
            parameters,
            markers: Vec::new(),
            guides: BTreeMap::new(),
            metamer_budget: DEFAULT_METAMER_BUDGET,
            tick: 0,
        };
        Self::from_state(Plant::new(Vec3::ZERO), state)
    }

    /// Takes a plant up again.
    pub fn from_state(plant: Plant, state: SimulationState) -> Self {
        let mut simulation = Self {
            seed: state.seed,
            plant,
            shadows: ShadowGrid::new(&state.parameters),
            parameters: ParameterTable::new(state.parameters),
            space: Space::new(),
            metamer_budget: state.metamer_budget,
            budget_reached: false,
            tick: state.tick,
            markers: Markers::from_vec(state.markers),
            guides: state.guides,
            scratch: Scratch::default(),
        };
        simulation.rebuild();
        simulation
    }

    /// What [`Simulation::from_state`] needs beside the plant.
    pub fn state(&self) -> SimulationState {
        SimulationState {
            seed: self.seed,
            parameters: self.parameters.scene().clone(),
            markers: self.markers.as_slice().to_vec(),
            guides: self.guides.clone(),
            metamer_budget: self.metamer_budget,
            tick: self.tick,
        }
    }

    /// The plant.
    pub fn plant(&self) -> &Plant {
        &self.plant
    }

    /// The parameters in force.
    pub fn parameters(&self) -> &Parameters {
        self.parameters.scene()
    }

    /// Seed of all randomness.
    pub fn seed(&self) -> u32 {
        self.seed
    }

    /// Brush markers still alive.
    pub fn markers(&self) -> &[Marker] {
        self.markers.as_slice()
    }

    /// Metamers the scene may hold.
    pub fn metamer_budget(&self) -> u32 {
        self.metamer_budget
    }

    /// Sets how many metamers the scene may hold.
    pub fn set_metamer_budget(&mut self, budget: u32) {
        self.metamer_budget = budget;
    }

    /// Whether the last step had to stop at the budget.
    pub fn is_out_of_budget(&self) -> bool {
        self.budget_reached
    }

    /// Changes the parameters; growth from here on uses them.
    pub fn set_parameters(&mut self, parameters: Parameters) {
        self.scratch.memory.forget();
        let same_shadows = self.parameters().casts_like(&parameters);
        self.parameters = ParameterTable::new(parameters);
        if !same_shadows {
            self.rebuild();
        }
    }

    /// Plants another seed, in a step of its own.
    pub fn sow(&mut self, position: Vec3) {
        self.plant.begin_step();
        let axis = self.plant.sow(position);
        self.plant.end_step();
        self.space.place_bud(axis, position, Vec3::Y);
        self.enter(self.plant.bud_node(axis));
    }

    /// Forgets what guided growth so far: markers and strokes. Time travel and stroke ends call for it.
    pub fn drop_guidance(&mut self) {
        self.markers.remove_all();
        self.guides.clear();
    }

    /// Forgets the path of one stroke.
    pub fn end_stroke(&mut self, stroke: StrokeId) {
        self.guides.remove(&stroke);
    }

    /// Whether there is anything for a bud to grow towards: markers, or path ahead of a leader.
    pub fn has_guidance(&self) -> bool {
        let is_led = |guide: &Guide| {
            guide
                .leader
                .is_some_and(|leader| guide.clone().next_node(self.plant.bud_position(leader)).is_some())
        };
        !self.markers.as_slice().is_empty() || self.guides.values().any(is_led)
    }

    /// Goes to a recorded step, back or forth; shadows and buds follow exactly.
    pub fn go_to(&mut self, step: u32) {
        self.drop_guidance();
        self.scratch.memory.forget();
        let shift = self.plant.go_to(step);
        // First in, then out: a long way back revives what was shed before it unmakes it.
        for &id in &shift.metamers_in {
            self.enter(id);
        }
        for &id in &shift.metamers_out {
            self.leave(id);
        }
        for &axis in &shift.axes {
            self.replace_bud(axis);
        }
        self.read_light();
        self.distribute_vigor();
        self.write_appearance();
    }

    /// Casts the shadow of a living metamer and occupies its node.
    fn enter(&mut self, id: MetamerId) {
        let node = self.plant.metamers().end(id);
        self.space.occupy(id, node);
        if !self.plant.is_seed(id) {
            self.shadows.cast(node);
        }
    }

    /// Undoes [`Simulation::enter`].
    pub(crate) fn leave(&mut self, id: MetamerId) {
        let node = self.plant.metamers().end(id);
        self.space.vacate(id, node);
        if !self.plant.is_seed(id) {
            self.shadows.uncast(node);
        }
    }

    /// Makes everything that follows from the plant afresh.
    fn rebuild(&mut self) {
        self.shadows = ShadowGrid::new(self.parameters.scene());
        self.space = Space::new();
        for index in 0..self.plant.metamer_count() {
            let id = MetamerId::new(index);
            if self.plant.is_alive(id) {
                self.enter(id);
            }
        }
        for index in 0..self.plant.axis_count() {
            self.replace_bud(AxisId::new(index));
        }
    }

    /// Puts the bud of an axis where the plant says it is now, or nowhere.
    fn replace_bud(&mut self, axis: AxisId) {
        let is_present = axis.index() < self.plant.axis_count() && self.plant.is_axis_alive(axis);
        if is_present {
            self.space.place_bud(axis, self.plant.bud_position(axis), self.plant.bud_direction(axis));
        } else {
            self.space.remove_bud(axis);
        }
    }
}
