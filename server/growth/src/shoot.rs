//! Shoots: a bud adds internodes, and with each a node and its lateral buds (TreeSketch §3.2, Figure 8A).

use core::f32::consts::TAU;

use espalier_plant::{AxisId, Internode, MetamerId, Plant};
use glam::Vec3;

use crate::{
    claims::Region,
    direction::{Tropism, across, azimuth, next_heading, transport, turn},
    growth::Growth,
    guide::Waypoint,
    obstacles::Obstacles,
    parameters::{MAX_LATERALS, Parameters},
    random::{Draw, Purpose},
    scene::Scene,
    world::is_in_world,
};

/// Nodes keep this far above the ground.
pub(crate) const GROUND_CLEARANCE: f32 = 0.2;
/// Nodes that a brush calls for lie no farther outside its sweep than this.
const SWEEP_MARGIN: f32 = 0.5;

/// What draws a shoot.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Aim {
    /// The direction E to free space.
    pub space: Option<Vec3>,
    /// The direction of the stroke that guides this step.
    pub stroke: Option<Vec3>,
    /// Where it may grow.
    pub region: Region,
}

/// Weights of heading, tropism and space where a person says what is to be filled: that form was asked for, so the
/// space that is left in it counts for more than the habit of the plant.
const GUIDED_WEIGHTS: [f32; 3] = [0.45, 0.05, 0.5];

impl Aim {
    /// The weights α, β and γ (TreeSketch Figure 11).
    fn weights(&self, parameters: &Parameters) -> [f32; 3] {
        let own = [parameters.heading_weight, parameters.tropism_weight, parameters.space_weight];
        // A tropism along the stroke is a form asked for as well.
        let is_along_stroke = self.stroke.is_some() && parameters.tropism_from_stroke;
        let is_guided = self.region != Region::Free && own[2] < GUIDED_WEIGHTS[2] && !is_along_stroke;
        if is_guided { GUIDED_WEIGHTS } else { own }
    }
}

/// The heading nearest to `heading` that keeps an internode from `base` above the ground; `aside` where it points
/// straight down.
fn along_ground(base: Vec3, heading: Vec3, aside: impl Fn() -> Vec3) -> Vec3 {
    // A hair higher, against rounding.
    let rise = (GROUND_CLEARANCE + 1e-4 - base.y).clamp(-1.0, 1.0);
    let level = heading.with_y(0.0).try_normalize().unwrap_or_else(aside);
    level * (1.0 - rise * rise).sqrt() + Vec3::Y * rise
}

/// An internode that would grow if nobody took its place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Draft {
    /// The axis that it continues.
    pub axis: AxisId,
    /// Where its node would be.
    pub end: Vec3,
    /// How near to it no other may lie.
    pub zone: f32,
    heading: Vec3,
    normal: Vec3,
}

/// The end of an axis, as its next internode finds it.
#[derive(Clone, Copy, Debug)]
struct Tip {
    base: Vec3,
    heading: Vec3,
    /// The normal of the axis' last internode, once it has one.
    normal: Option<Vec3>,
}

impl Tip {
    fn of(axis: AxisId, plant: &Plant) -> Self {
        let normal = plant.has_grown(axis).then(|| plant.metamers().normal(plant.bud_node(axis)));
        Self { base: plant.bud_position(axis), heading: plant.bud_direction(axis), normal }
    }

    fn after(self, draft: &Draft) -> Self {
        let Draft { end, normal, .. } = *draft;
        Self { base: end, heading: (end - self.base).normalize(), normal: Some(normal) }
    }
}

impl Growth {
    /// Lets a bud grow up to `count` internodes, and enters them into space; fewer where it runs into another's zone.
    pub(crate) fn grow_shoot(&self, scene: &mut Scene, axis: AxisId, count: u32, aim: Aim) {
        let mut tip = Tip::of(axis, &scene.plant);
        for _ in 0..count {
            if scene.is_full() {
                break;
            }
            let Some(draft) = self.draft_freely(scene, axis, tip, aim) else { break };
            tip = tip.after(&draft);
            let id = self.add(scene, &draft);
            scene.space.occupy(id, draft.end);
        }
    }

    /// Drafts what a bud would grow into the space there is now.
    pub(crate) fn draft_shoot(
        &self,
        scene: &Scene,
        axis: AxisId,
        count: u32,
        aim: Aim,
        drafts: &mut Vec<Draft>,
    ) {
        let mut tip = Tip::of(axis, &scene.plant);
        for _ in 0..count {
            let Some(draft) = self.draft_freely(scene, axis, tip, aim) else { break };
            tip = tip.after(&draft);
            drafts.push(draft);
        }
    }

    /// The next internode at the tip of an axis, unless something stops it or its place is taken.
    #[inline]
    fn draft_freely(&self, scene: &Scene, axis: AxisId, tip: Tip, aim: Aim) -> Option<Draft> {
        let draft = self.draft(scene, axis, tip, aim, None)?;
        if aim.region == Region::Sweep && !self.stays_in_sweep(tip.base, draft.end) {
            return None;
        }
        if matches!(aim.region, Region::Envelope { .. }) && self.leaves_outline(tip.base, draft.end) {
            return None;
        }
        // Mostly it is the only one near.
        let own = scene.plant.bud_node(axis);
        let is_other = |id| id != own && !self.is_kin(scene, axis, draft.end, id);
        let is_taken = scene.space.is_occupied(draft.end, draft.zone, is_other);
        (!is_taken).then_some(draft)
    }

    /// Whether an internode lies where a brush has been, or on the way to where a wide one has been.
    fn stays_in_sweep(&self, base: Vec3, end: Vec3) -> bool {
        let zone = self.parameters.scene().occupancy_radius;
        self.guides.values().any(|guide| {
            let outside = guide.sweep.outside(end);
            outside <= SWEEP_MARGIN || (guide.is_wide(zone) && outside < guide.sweep.outside(base))
        })
    }

    /// Lets a leader grow along the path of its stroke, up to `count` internodes; it goes where the finger went,
    /// through others' zones as well. Returns how many.
    pub(crate) fn grow_guided(
        &self,
        scene: &mut Scene,
        axis: AxisId,
        count: u32,
        aim: Aim,
        mut next: impl FnMut(Vec3, &Obstacles) -> Option<Waypoint>,
    ) -> u32 {
        let mut grown = 0;
        while grown < count {
            let Some(waypoint) = next(scene.plant.bud_position(axis), &scene.obstacles) else { break };
            if scene.is_full() {
                break;
            }
            let draft = self.draft(scene, axis, Tip::of(axis, &scene.plant), aim, Some(waypoint));
            let Some(draft) = draft else { break };
            self.add(scene, &draft);
            grown += 1;
        }
        grown
    }

    /// Lets an internode grow.
    pub(crate) fn add(&self, scene: &mut Scene, draft: &Draft) -> MetamerId {
        let Draft { axis, end, heading, normal, .. } = *draft;
        let parameters = self.parameters.of(axis);
        let (sin, cos) = parameters.branching;
        let mut laterals = [Vec3::ZERO; MAX_LATERALS];
        let buds = parameters.buds_per_node as usize;
        for (lateral, &around) in laterals.iter_mut().zip(&parameters.whorl).take(buds) {
            *lateral = (heading * cos + turn(normal, heading, around) * sin).normalize();
        }
        scene.plant.extend(axis, &Internode { end, normal, laterals: &laterals[..buds] })
    }

    /// The next internode at the tip of an axis, unless the ground, an obstacle or the end of the world stops it.
    fn draft(
        &self,
        scene: &Scene,
        axis: AxisId,
        tip: Tip,
        aim: Aim,
        waypoint: Option<Waypoint>,
    ) -> Option<Draft> {
        let parameters = self.parameters.of(axis);
        let Tip { base, heading: before, .. } = tip;
        let laid_down = self.laid_down_heading(axis, tip);
        let mut heading = next_heading(
            laid_down,
            self.tropism(scene, axis, aim),
            aim.space,
            aim.weights(parameters),
            parameters,
            || self.chance(axis),
        );
        if let Some(Waypoint { position, weight }) = waypoint {
            let towards = (position - base).try_normalize().unwrap_or(heading);
            heading = (heading * (1.0 - weight) + towards * weight).try_normalize().unwrap_or(towards);
        }
        if aim.region == Region::Sweep && base.y + heading.y < GROUND_CLEARANCE {
            heading = along_ground(base, heading, || azimuth(self.chance(axis), parameters));
        }
        let turned = self.way_around(scene, axis, base, heading)?;
        // A leader goes neither straight past its path nor back along the surface it came by, or it would wander there
        // for ever.
        let wanders = turned != heading && (turned.dot(heading) <= 0.05 || turned.dot(before) <= -0.2);
        if waypoint.is_some() && wanders {
            return None;
        }
        let heading = turned;
        let end = base + heading;
        let in_world = is_in_world(end) && end.y >= GROUND_CLEARANCE;
        let zone = match aim.region {
            Region::Envelope { .. } => self.zone_at(end, parameters.occupancy_radius),
            Region::Sweep | Region::Free => parameters.occupancy_radius,
        };
        let normal = || self.next_normal(scene, axis, tip, heading);
        in_world.then(|| Draft { axis, end, zone, heading, normal: normal() })
    }

    /// The heading of an internode that would go one way: along the surface of what is in its way.
    fn way_around(&self, scene: &Scene, axis: AxisId, base: Vec3, heading: Vec3) -> Option<Vec3> {
        let aside = || azimuth(self.chance(axis), self.parameters.of(axis));
        scene.obstacles.way_around(base, heading, aside)
    }

    /// Where a bud points before forces act: its axis' heading, turned away from the lateral bud just passed.
    fn laid_down_heading(&self, axis: AxisId, Tip { heading, normal, .. }: Tip) -> Vec3 {
        let parameters = self.parameters.of(axis);
        // Opposite and whorled buds push an axis to no side.
        let Some(normal) = normal.filter(|_| parameters.buds_per_node == 1) else { return heading };
        let (sin, cos) = parameters.deflection;
        heading * cos - normal * sin
    }

    fn tropism(&self, scene: &Scene, axis: AxisId, aim: Aim) -> Tropism {
        let parameters = self.parameters.of(axis);
        if parameters.trunk_upward && scene.plant.axes().order(axis) == 0 {
            return Tropism::Towards(Vec3::Y);
        }
        if let Some(direction) = aim.stroke.filter(|_| parameters.tropism_from_stroke) {
            return Tropism::Towards(direction);
        }
        Tropism::SetPoint
    }

    /// What decides where an axis turns if nothing else does.
    fn chance(&self, axis: AxisId) -> Draw {
        Draw::new(self.seed, Purpose::Azimuth, axis.raw(), 0)
    }

    /// The normal of a new internode: its axis' last one, carried along from the heading before and turned by the
    /// phyllotactic angle.
    fn next_normal(&self, scene: &Scene, axis: AxisId, tip: Tip, heading: Vec3) -> Vec3 {
        if let Some(normal) = tip.normal {
            let carried = transport(normal, tip.heading, heading);
            return turn(across(carried, heading), heading, self.parameters.of(axis).phyllotaxis);
        }
        if self.parameters.of(axis).is_flat {
            let chance = Draw::new(self.seed, Purpose::Phyllotaxis, axis.raw(), 0);
            let side = if chance.unit(0) < 0.5 { Vec3::Z } else { Vec3::NEG_Z };
            return across(heading.cross(side), heading);
        }
        if scene.plant.axes().order(axis) == 0 {
            let angle = TAU * Draw::new(self.seed, Purpose::Phyllotaxis, axis.raw(), 0).unit(0);
            let (sin, cos) = libm::sincosf(angle);
            return across(Vec3::new(cos, 0.0, sin), heading);
        }
        // A lateral starts with a bud to its side, so that distichous branches spread flat.
        across(heading.cross(Vec3::Y), heading)
    }

    /// Whether a metamer's node never takes a place that an axis may grow to.
    ///
    /// Nodes of one axis, and a young lateral and its bearer, are nearer to each other than a zone is wide. The
    /// node the bud sits at is either its own or its bearer, so that what says of the bearer what is young holds
    /// whenever the place is in its zone.
    pub(crate) fn is_kin(&self, scene: &Scene, axis: AxisId, place: Vec3, id: MetamerId) -> bool {
        let (axes, metamers) = (scene.plant.axes(), scene.plant.metamers());
        let bearing_axis = |axis| axes.bearer(axis).map(|bearer| metamers.axis(bearer));
        let other = metamers.axis(id);
        if id == scene.plant.bud_node(axis) || other == axis || bearing_axis(other) == Some(axis) {
            return true;
        }
        let Some(bearer) = axes.bearer(axis) else { return false };
        let zone = 2.0 * self.parameters.of(axis).occupancy_radius;
        let is_young = metamers.end(bearer).distance_squared(place) < zone * zone;
        let parent = Some(metamers.axis(bearer));
        is_young && (Some(other) == parent || bearing_axis(other) == parent)
    }
}
