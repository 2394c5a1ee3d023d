//! Shoots: a bud adds internodes, and with each a node and its lateral buds (TreeSketch §3.2, Figure 8A).

use core::f32::consts::TAU;

use espalier_plant::{AxisId, Internode, MetamerId};
use glam::Vec3;

use crate::{
    direction::{Tropism, across, azimuth, next_heading, transport, turn},
    guide::Waypoint,
    obstacles::CLEARANCE,
    parameters::{MAX_LATERALS, Parameters},
    random::{Draw, Purpose},
    simulation::{Simulation, WORLD_EXTENT},
};

/// Nodes keep this far above the ground.
const GROUND_CLEARANCE: f32 = 0.2;

/// What draws a shoot.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Aim {
    /// The direction E to free space.
    pub space: Option<Vec3>,
    /// The direction of the stroke that guides this step.
    pub stroke: Option<Vec3>,
    /// Whether it fills an envelope.
    pub is_enclosed: bool,
}

/// Weights of heading, tropism and space in an envelope: its form is what was asked for, so the room that is left
/// in it counts for more than the habit of the plant.
const ENVELOPE_WEIGHTS: [f32; 3] = [0.45, 0.05, 0.5];

impl Aim {
    /// The weights α, β and γ (TreeSketch Figure 11).
    fn weights(&self, parameters: &Parameters) -> [f32; 3] {
        if self.is_enclosed && parameters.space_weight < ENVELOPE_WEIGHTS[2] {
            return ENVELOPE_WEIGHTS;
        }
        [parameters.heading_weight, parameters.tropism_weight, parameters.space_weight]
    }
}

/// Whether a leader turned aside by an obstacle still follows its path: neither straight past it nor back along
/// the surface it came by, or it would wander there for ever.
fn follows(turned: Vec3, heading: Vec3, before: Vec3) -> bool {
    turned.dot(heading) > 0.05 && turned.dot(before) > -0.2
}

impl Simulation {
    /// Lets a bud grow up to `count` internodes; fewer where it runs into another's zone.
    pub(crate) fn grow_shoot(&mut self, axis: AxisId, count: u32, aim: Aim) {
        let mut grown = 0;
        while grown < count && self.grow_internode(axis, aim, None) {
            grown += 1;
        }
    }

    /// Lets a leader grow along the path of its stroke, up to `count` internodes. Returns how many.
    pub(crate) fn grow_guided(
        &mut self,
        axis: AxisId,
        count: u32,
        aim: Aim,
        mut next: impl FnMut(Vec3, &dyn Fn(Vec3) -> bool) -> Option<Waypoint>,
    ) -> u32 {
        let mut grown = 0;
        while grown < count {
            let is_blocked = |place| self.obstacles.blocks(place, place, CLEARANCE);
            let Some(waypoint) = next(self.plant.bud_position(axis), &is_blocked) else { break };
            if !self.grow_internode(axis, aim, Some(waypoint)) {
                break;
            }
            grown += 1;
        }
        grown
    }

    fn grow_internode(&mut self, axis: AxisId, aim: Aim, waypoint: Option<Waypoint>) -> bool {
        if self.plant.metamer_count() as u32 >= self.metamer_budget {
            self.budget_reached = true;
            return false;
        }
        let node = self.plant.bud_node(axis);
        let base = self.plant.metamers().end(node);
        let parameters = self.parameters.of(axis);
        let before = self.plant.bud_direction(axis);
        let laid_down = self.laid_down_heading(axis, node, before);
        let mut heading =
            next_heading(laid_down, self.tropism(axis, aim), aim.space, aim.weights(parameters), parameters);
        if let Some(Waypoint { position, weight }) = waypoint {
            let towards = (position - base).try_normalize().unwrap_or(heading);
            heading = (heading * (1.0 - weight) + towards * weight).try_normalize().unwrap_or(towards);
        }
        // Who is led goes where the finger went, through others' zones as well.
        let is_led = waypoint.is_some();
        let free = self.obstacles.way_around(base, heading, || azimuth(self.chance(axis), parameters));
        let is_free = |free: &Vec3| *free == heading || waypoint.is_none() || follows(*free, heading, before);
        let Some(heading) = free.filter(is_free) else { return false };
        let end = base + heading;
        let in_world = end.abs().max_element() <= WORLD_EXTENT && end.y >= GROUND_CLEARANCE;
        if !in_world || (!is_led && self.is_taken(axis, node, end)) {
            return false;
        }

        let normal = self.next_normal(axis, node, before, heading);
        let (sin, cos) = parameters.branching;
        let mut laterals = [Vec3::ZERO; MAX_LATERALS];
        let buds = parameters.buds_per_node as usize;
        for (lateral, &around) in laterals.iter_mut().zip(&parameters.whorl).take(buds) {
            *lateral = (heading * cos + turn(normal, heading, around) * sin).normalize();
        }
        let id = self.plant.extend(axis, &Internode { end, normal, laterals: &laterals[..buds] });
        self.space.occupy(id, end);
        true
    }

    /// Where a bud points before forces act: its axis' heading, turned away from the lateral bud just passed.
    fn laid_down_heading(&self, axis: AxisId, node: MetamerId, heading: Vec3) -> Vec3 {
        let parameters = self.parameters.of(axis);
        // Opposite and whorled buds push an axis to no side.
        if !self.plant.has_grown(axis) || parameters.buds_per_node > 1 {
            return heading;
        }
        let (sin, cos) = parameters.deflection;
        heading * cos - self.plant.metamers().normal(node) * sin
    }

    fn tropism(&self, axis: AxisId, aim: Aim) -> Tropism {
        let parameters = self.parameters.of(axis);
        if parameters.trunk_upward && self.plant.axes().order(axis) == 0 {
            return Tropism::Towards(Vec3::Y);
        }
        if let Some(direction) = aim.stroke.filter(|_| parameters.tropism_from_stroke) {
            return Tropism::Towards(direction);
        }
        Tropism::SetPoint { chance: self.chance(axis) }
    }

    /// What decides where an axis turns if nothing else does.
    fn chance(&self, axis: AxisId) -> Draw {
        Draw::new(self.seed, Purpose::Azimuth, axis.raw(), 0)
    }

    /// The normal of a new internode: its axis' last one, carried along from the heading before and turned by the
    /// phyllotactic angle.
    fn next_normal(&self, axis: AxisId, node: MetamerId, before: Vec3, heading: Vec3) -> Vec3 {
        if self.plant.has_grown(axis) {
            let carried = transport(self.plant.metamers().normal(node), before, heading);
            return turn(across(carried, heading), heading, self.parameters.of(axis).phyllotaxis);
        }
        if self.parameters.of(axis).is_flat {
            let chance = Draw::new(self.seed, Purpose::Phyllotaxis, axis.raw(), 0);
            let side = if chance.unit(0) < 0.5 { Vec3::Z } else { Vec3::NEG_Z };
            return across(heading.cross(side), heading);
        }
        if self.plant.axes().order(axis) == 0 {
            let angle = TAU * Draw::new(self.seed, Purpose::Phyllotaxis, axis.raw(), 0).unit(0);
            let (sin, cos) = libm::sincosf(angle);
            return across(Vec3::new(cos, 0.0, sin), heading);
        }
        // A lateral starts with a bud to its side, so that distichous branches spread flat.
        across(heading.cross(Vec3::Y), heading)
    }

    /// Whether a node there would lie in the occupancy zone of one that is not its own kin.
    ///
    /// Nodes of one axis, and a young lateral and its bearer, are nearer to each other than a zone is wide. `base`
    /// is the node the bud sits at: either its own or its bearer, so that what says of the bearer what is young
    /// holds whenever the place is in its zone.
    fn is_taken(&self, axis: AxisId, base: MetamerId, place: Vec3) -> bool {
        let radius = self.parameters.of(axis).occupancy_radius;
        let (axes, metamers) = (self.plant.axes(), self.plant.metamers());
        let bearing_axis = |axis| axes.bearer(axis).map(|bearer| metamers.axis(bearer));
        let parent = bearing_axis(axis);
        let is_young = axes.bearer(axis).is_some_and(|bearer| {
            let zone = 2.0 * radius;
            metamers.end(bearer).distance_squared(place) < zone * zone
        });
        self.space.is_occupied(place, radius, |id| {
            if id == base {
                return false;
            }
            let other = metamers.axis(id);
            let is_own = other == axis || bearing_axis(other) == Some(axis);
            let is_kin = is_young && (Some(other) == parent || bearing_axis(other) == parent);
            !is_own && !is_kin
        })
    }
}
