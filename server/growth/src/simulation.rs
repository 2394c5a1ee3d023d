//! The simulation: a plant and its surroundings. What happens within a step stands in `step.rs`.

use std::collections::BTreeMap;

use espalier_plant::{AxisId, MetamerId, Plant, TimeShift};
use glam::Vec3;

use crate::{
    brush::StrokeId,
    canopy::{Canopy, Surroundings},
    claims::Claims,
    field::MarkerField,
    guide::Guide,
    lasso::Envelope,
    light::ShadowGrid,
    markers::{Marker, MarkerSource, Markers},
    nearby_order::nearby_order,
    observer::{NoObserver, Observer, Phase},
    obstacles::{CLEARANCE, Obstacle, Obstacles},
    parameter_table::ParameterTable,
    parameters::Parameters,
    random::{Draw, Purpose},
    space::{Bud, Space},
};

/// Metamers a scene may hold, dead ones included, unless told otherwise. What was undone does not count.
pub const DEFAULT_METAMER_BUDGET: u32 = 1_000_000;

/// Markers of an envelope per cubic internode, at least: with fewer a narrow neck may have a gap that no bud sees
/// across.
const LEAST_LASSO_DENSITY: f32 = 0.25;
/// Lasso markers a scene holds at most; a larger envelope is filled more thinly.
const MAX_LASSO_MARKERS: usize = 200_000;

/// Everything the next step depends on beside the plant.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulationState {
    /// Seed of all randomness.
    pub seed: u32,
    /// The parameters.
    pub parameters: Parameters,
    /// Markers of brush and lasso still alive.
    pub markers: Vec<Marker>,
    /// Paths of strokes in progress.
    pub guides: BTreeMap<StrokeId, Guide>,
    /// What stands in the way.
    pub obstacles: Vec<Obstacle>,
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
    pub(crate) obstacles: Obstacles,
    /// Markers for growth without guidance; made when they are needed.
    pub(crate) field: Option<MarkerField>,
    pub(crate) canopy: Canopy,
    pub(crate) claims: Claims,
}

impl Simulation {
    /// A seedling: one seed at the origin.
    pub fn new(seed: u32, parameters: Parameters) -> Self {
        let state = SimulationState {
            seed,
            parameters,
            markers: Vec::new(),
            guides: BTreeMap::new(),
            obstacles: Vec::new(),
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
            obstacles: Obstacles::new(state.obstacles),
            field: None,
            canopy: Canopy::default(),
            claims: Claims::default(),
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
            obstacles: self.obstacles.as_slice().to_vec(),
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

    /// Markers of brush and lasso still alive.
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
        let same_shadows = self.parameters().casts_like(&parameters);
        self.parameters = ParameterTable::new(parameters);
        self.field = None;
        self.canopy.forget();
        if same_shadows {
            self.see_light(&[], &mut NoObserver);
        } else {
            self.rebuild();
        }
    }

    /// Plants another seed, in a step of its own.
    pub fn sow(&mut self, position: Vec3) {
        self.plant.begin_edit();
        let axis = self.plant.sow(position);
        self.plant.end_step();
        self.field = None;
        self.enter(self.plant.bud_node(axis));
        self.replace_bud(axis);
        self.see_light(&[position], &mut NoObserver);
    }

    /// Forgets what guided growth so far: markers and strokes. Time travel and stroke ends call for it.
    pub fn drop_guidance(&mut self) {
        self.markers.remove_all();
        self.guides.clear();
    }

    /// Sows lasting markers in an envelope, as densely as the brush does or more, and above ground.
    pub fn enclose(&mut self, envelope: &Envelope) {
        let density = self.parameters().marker_density.max(LEAST_LASSO_DENSITY);
        let wanted = envelope.volume() * f64::from(density);
        let room = MAX_LASSO_MARKERS.saturating_sub(self.markers.count(MarkerSource::Lasso));
        // At least one: a speck of an envelope still says where to grow.
        let count = (wanted.round() as usize).max(1).min(room);
        if count == 0 {
            return;
        }
        // A second envelope in the same tick must not repeat the pattern of the first.
        let draw = Draw::new(self.seed, Purpose::Lasso, self.tick, self.markers.as_slice().len() as u32);
        for position in envelope.places(count, draw) {
            if position.y > 0.0 && !self.obstacles.contains(position) {
                let marker = Marker { position, born: self.tick, source: MarkerSource::Lasso };
                self.markers.sow(marker);
            }
        }
    }

    /// Forgets the markers of envelopes, for nothing grows into them any more.
    pub fn drop_envelopes(&mut self) {
        self.markers.remove(MarkerSource::Lasso);
    }

    /// What stands in the way of growth and light.
    pub fn obstacles(&self) -> &[Obstacle] {
        self.obstacles.as_slice()
    }

    /// Whether a place lies in an obstacle, or so close below one's surface that no bud gets out.
    pub fn is_solid(&self, place: Vec3) -> bool {
        self.obstacles.contains(place) || self.obstacles.contains(place + CLEARANCE * Vec3::Y)
    }

    /// Puts obstacles in place of those there were. Wood that has grown where they stand stays.
    pub fn set_obstacles(&mut self, obstacles: Vec<Obstacle>) {
        self.obstacles = Obstacles::new(obstacles);
        self.field = None;
        for id in (0..self.plant.metamer_count()).map(MetamerId::new) {
            if self.plant.is_alive(id) {
                self.obstacles.survey_sky(self.plant.metamers().end(id));
            }
        }
        self.canopy.forget();
        self.see_light(&[], &mut NoObserver);
    }

    /// Forgets the path of one stroke.
    pub fn end_stroke(&mut self, stroke: StrokeId) {
        self.guides.remove(&stroke);
    }

    /// Whether there is anything for a bud to grow towards: markers, or path ahead of a leader.
    pub fn has_guidance(&self) -> bool {
        let is_blocked = |place| self.obstacles.blocks(place, place, CLEARANCE);
        let is_led = |guide: &Guide| {
            guide.leader.is_some_and(|leader| {
                guide.clone().next_node(self.plant.bud_position(leader), is_blocked).is_some()
            })
        };
        !self.markers.as_slice().is_empty() || self.guides.values().any(is_led)
    }

    /// Goes to a recorded step, back or forth; shadows and buds follow exactly.
    pub fn go_to(&mut self, step: u32) {
        self.drop_guidance();
        self.field = None;
        let before = self.plant.metamer_count();
        let shift = self.plant.go_to(step);
        self.follow_in_time(&shift);
        if shift.is_edited {
            self.canopy.forget();
        } else if self.plant.metamer_count() < before {
            self.canopy.retreat(&self.plant, &self.parameters);
        }
        let gone = shift.metamers_out.iter().map(|&(_, place)| place);
        let changed: Vec<Vec3> =
            gone.chain(shift.metamers_in.iter().map(|&id| self.plant.metamers().end(id))).collect();
        self.see_light(&changed, &mut NoObserver);
    }

    /// Tells shadows and space, side by side, of what has come, gone and moved.
    fn follow_in_time(&mut self, shift: &TimeShift) {
        let Self { plant, space, shadows, obstacles, .. } = self;
        let plant = &*plant;
        let moved = shift.moved.iter().map(|&(id, _)| (id, plant.metamers().end(id)));
        let came = shift.metamers_in.iter().map(|&id| (id, plant.metamers().end(id)));
        // In the order of their places, for the same reason as what has grown (see `settle`).
        let went = nearest_together(shift.metamers_out.iter().chain(&shift.moved).copied());
        let came = nearest_together(came.chain(moved));
        came.iter().for_each(|&(_, node)| obstacles.survey_sky(node));
        let is_wood = |&&(id, _): &&(MetamerId, Vec3)| !plant.is_seed(id);
        let tell_shadows = || {
            shadows.uncast_all(went.iter().filter(is_wood).map(|&(_, node)| node));
            shadows.cast_all(came.iter().filter(is_wood).map(|&(_, node)| node));
        };
        let tell_space = || {
            went.iter().for_each(|&(id, node)| space.vacate(id, node));
            came.iter().for_each(|&(id, node)| space.occupy(id, node));
            shift.axes.iter().for_each(|&axis| replace_bud(plant, space, axis));
        };
        rayon::join(tell_shadows, tell_space);
    }

    /// Makes light and vigor those of the present, after shadows have come or gone at these nodes. Where the
    /// canopy was forgotten, everything is read.
    pub(crate) fn see_light(&mut self, changed: &[Vec3], observer: &mut impl Observer) {
        let Self { plant, space, shadows, obstacles, canopy, parameters, .. } = self;
        observer.enter(Phase::Light);
        canopy.follow(plant, parameters);
        canopy.read_light(&Surroundings { plant, space, shadows, obstacles }, changed);
        observer.enter(Phase::Vigor);
        canopy.distribute_vigor(plant, parameters);
    }

    /// Writes light and vigor of the present into the plant's appearance, for whoever draws it. Growth itself has
    /// no use for it, and steps are many.
    pub fn show(&mut self) {
        self.canopy.write_appearance(&mut self.plant);
    }

    /// Casts the shadow of a living metamer and occupies its node.
    pub(crate) fn enter(&mut self, id: MetamerId) {
        let node = self.plant.metamers().end(id);
        self.space.occupy(id, node);
        self.obstacles.survey_sky(node);
        if !self.plant.is_seed(id) {
            self.shadows.cast(node);
        }
    }

    /// Undoes [`Simulation::enter`], for a metamer whose node was here.
    pub(crate) fn leave(&mut self, id: MetamerId, node: Vec3) {
        self.space.vacate(id, node);
        if let Some(field) = &mut self.field {
            let radius = self.parameters.scene().occupancy_radius;
            field.vacate(node, radius, &self.space, &self.obstacles);
        }
        if !self.plant.is_seed(id) {
            self.shadows.uncast(node);
        }
    }

    /// Makes everything that follows from the plant afresh.
    pub(crate) fn rebuild(&mut self) {
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
        self.canopy.forget();
        self.see_light(&[], &mut NoObserver);
    }

    /// Puts the bud of an axis where the plant says it is now, or nowhere.
    pub(crate) fn replace_bud(&mut self, axis: AxisId) {
        replace_bud(&self.plant, &mut self.space, axis);
    }
}

/// Puts the bud of an axis where the plant says it is now, or nowhere.
fn replace_bud(plant: &Plant, space: &mut Space, axis: AxisId) {
    if axis.index() < plant.axis_count() && plant.is_axis_alive(axis) {
        let (position, direction) = (plant.bud_position(axis), plant.bud_direction(axis));
        space.place_bud(axis, Bud { position, direction });
    } else {
        space.remove_bud(axis);
    }
}

/// Nodes in the order of their places.
fn nearest_together(nodes: impl Iterator<Item = (MetamerId, Vec3)>) -> Vec<(MetamerId, Vec3)> {
    let nodes: Vec<(MetamerId, Vec3)> = nodes.collect();
    let order = nearby_order(nodes.iter().enumerate().map(|(i, &(_, node))| (i, node)));
    order.into_iter().map(|i| nodes[i as usize]).collect()
}
