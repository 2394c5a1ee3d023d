//! The scene: plants, what stands in their way, and the light and free space between.

mod recording;

use espalier_plant::{AxisId, MetamerId, Plant, TimeShift};
use glam::Vec3;

pub use self::recording::Recording;
use crate::{
    light::ShadowGrid,
    nearby_order::nearby_order,
    obstacles::{CLEARANCE, Obstacle, Obstacles},
    parameters::Parameters,
    side_by_side::Work,
    space::{Bud, Space},
};

/// Metamers a scene may hold, dead ones included, unless another limit is set. What was undone does not count.
pub const DEFAULT_METAMER_BUDGET: u32 = 1_000_000;

/// Nodes that come or go in time.
static MOVING: Work = Work::new(2048);

/// Plants among obstacles. Light and space are those of the plants as they stand, after every step, edit and move in
/// time.
#[derive(Clone, Debug)]
pub struct Scene {
    pub(crate) plant: Plant,
    pub(crate) obstacles: Obstacles,
    pub(crate) shadows: ShadowGrid,
    pub(crate) space: Space,
    pub(crate) metamer_budget: u32,
    pub(crate) budget_reached: bool,
}

impl Scene {
    /// A scene whose wood casts shadows by these parameters.
    pub fn new(plant: Plant, obstacles: Vec<Obstacle>, metamer_budget: u32, shade: &Parameters) -> Self {
        let mut scene = Self {
            plant,
            obstacles: Obstacles::new(obstacles),
            shadows: ShadowGrid::new(shade),
            space: Space::new(),
            metamer_budget,
            budget_reached: false,
        };
        scene.rebuild(shade);
        scene
    }

    /// The plants.
    pub fn plant(&self) -> &Plant {
        &self.plant
    }

    /// What stands in the way of growth and light.
    pub fn obstacles(&self) -> &[Obstacle] {
        self.obstacles.as_slice()
    }

    /// Whether a place lies in an obstacle, or so close below one's surface that no bud gets out.
    pub fn is_solid(&self, place: Vec3) -> bool {
        self.obstacles.contains(place) || self.obstacles.contains(place + CLEARANCE * Vec3::Y)
    }

    /// The light at a place, from 0 in full shade to 1 under the open sky.
    pub fn exposure(&self, place: Vec3) -> f32 {
        self.shadows.exposure(place) * self.obstacles.sky_share(place)
    }

    /// Whether no node lies within a radius of a place, in internodes, and no obstacle holds it.
    pub fn is_free(&self, place: Vec3, radius: f32) -> bool {
        !self.obstacles.contains(place) && !self.space.is_occupied(place, radius, |_| true)
    }

    /// Whether no node of another axis than that of the nearest node lies within a radius of a place, and no obstacle
    /// holds it.
    pub fn is_free_of_others(&self, place: Vec3, radius: f32) -> bool {
        if self.obstacles.contains(place) {
            return false;
        }
        let Some(own) = self.nearest_node(place, radius) else { return true };
        let own = self.plant.metamers().axis(own);
        !self.space.is_occupied(place, radius, |id| self.plant.metamers().axis(id) != own)
    }

    /// The node nearest to a place, if one lies within a radius of it; of equally near ones the oldest.
    pub fn nearest_node(&self, place: Vec3, radius: f32) -> Option<MetamerId> {
        let nearest = std::cell::Cell::new(None::<(f32, MetamerId)>);
        // Nothing counts, so that all are seen.
        self.space.is_occupied(place, radius, |id| {
            let here = (self.plant.metamers().end(id).distance_squared(place), id);
            if nearest.get().is_none_or(|best| here.0 < best.0 || here.0 == best.0 && here.1 < best.1) {
                nearest.set(Some(here));
            }
            false
        });
        nearest.get().map(|(_, id)| id)
    }

    /// Whether an obstacle, by its place among all, holds a place.
    pub fn is_in_obstacle(&self, number: usize, place: Vec3) -> bool {
        self.obstacles.holds(number, place)
    }

    /// The unit direction towards more light: that in which shadows end, and the sky past obstacles opens. None where
    /// it is equally light all around.
    pub fn towards_light(&self, place: Vec3) -> Option<Vec3> {
        if self.obstacles.is_empty() {
            return self.shadows.towards_light(place);
        }
        let difference = |axis: Vec3| self.exposure(place + axis) - self.exposure(place - axis);
        Vec3::new(difference(Vec3::X), difference(Vec3::Y), difference(Vec3::Z)).try_normalize()
    }

    /// Sets how many metamers the scene may hold.
    pub fn set_metamer_budget(&mut self, budget: u32) {
        self.metamer_budget = budget;
    }

    /// Metamers the scene may hold.
    pub fn metamer_budget(&self) -> u32 {
        self.metamer_budget
    }

    /// Whether the last step of growth had to stop at the budget.
    pub fn is_out_of_budget(&self) -> bool {
        self.budget_reached
    }

    /// Whether the scene holds all the metamers it may, which is noted for [`Scene::is_out_of_budget`].
    pub(crate) fn is_full(&mut self) -> bool {
        let is_full = self.plant.metamer_count() as u32 >= self.metamer_budget;
        self.budget_reached |= is_full;
        is_full
    }

    /// Begins a step of growth.
    pub(crate) fn begin_step(&mut self) {
        self.budget_reached = false;
        self.plant.begin_step();
    }

    /// Puts obstacles in place of those there were. Wood that has grown where they stand stays.
    pub(crate) fn set_obstacles(&mut self, obstacles: Vec<Obstacle>) {
        self.obstacles = Obstacles::new(obstacles);
        for id in (0..self.plant.metamer_count()).map(MetamerId::new) {
            if self.plant.is_alive(id) {
                self.obstacles.survey_sky(self.plant.metamers().end(id));
            }
        }
    }

    /// Goes to a recorded step, back or forth; shadows and buds follow exactly.
    pub(crate) fn go_to(&mut self, step: u32) -> TimeShift {
        let shift = self.plant.go_to(step);
        let moved = || shift.moved.iter().copied();
        let went = shift.metamers_out.iter().chain(&shift.moved).copied().collect();
        let came = shift.metamers_in.iter().copied().chain(moved().map(|(id, _)| id)).collect();
        self.update(went, came, shift.axes.iter().copied());
        shift
    }

    /// Lets light and space follow what has happened to the plants: nodes that were here and are not, metamers whose nodes
    /// are here now, and axes whose buds came, went or moved.
    fn update(
        &mut self,
        went: Vec<(MetamerId, Vec3)>,
        came: Vec<MetamerId>,
        axes: impl Iterator<Item = AxisId> + Send,
    ) {
        let Self { plant, space, shadows, obstacles, .. } = self;
        let plant = &*plant;
        // In the order of their places, for the same reason as what has grown (see `Growth::settle`).
        let went = nearest_together(went);
        let came = nearest_together(came.into_iter().map(|id| (id, plant.metamers().end(id))).collect());
        came.iter().for_each(|&(_, node)| obstacles.survey_sky(node));
        let is_wood = |&&(id, _): &&(MetamerId, Vec3)| !plant.is_seed(id);
        let update_shadows = || {
            shadows.uncast_all(went.iter().filter(is_wood).map(|&(_, node)| node));
            shadows.cast_all(came.iter().filter(is_wood).map(|&(_, node)| node));
        };
        let update_space = || {
            went.iter().for_each(|&(id, node)| space.vacate(id, node));
            came.iter().for_each(|&(id, node)| space.occupy(id, node));
            axes.for_each(|axis| replace_bud(plant, space, axis));
        };
        MOVING.both(went.len() + came.len(), update_shadows, update_space);
    }

    /// Lets a metamer leave whose node was here.
    pub(crate) fn leave(&mut self, id: MetamerId, node: Vec3) {
        self.space.vacate(id, node);
        if !self.plant.is_seed(id) {
            self.shadows.uncast(node);
        }
    }

    /// Makes light and space afresh.
    pub(crate) fn rebuild(&mut self, shade: &Parameters) {
        self.shadows = ShadowGrid::new(shade);
        self.space = Space::new();
        let rows = (0..self.plant.metamer_count()).map(MetamerId::new);
        let living = rows.filter(|&id| self.plant.is_alive(id)).collect();
        let axes = (0..self.plant.axis_count()).map(AxisId::new);
        self.update(Vec::new(), living, axes);
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
fn nearest_together(nodes: Vec<(MetamerId, Vec3)>) -> Vec<(MetamerId, Vec3)> {
    let order = nearby_order(nodes.iter().enumerate().map(|(i, &(_, node))| (i, node)));
    order.into_iter().map(|i| nodes[i as usize]).collect()
}
