//! One step of the simulation, phase by phase.
//!
//! The order is that of TreeSketch §3.2, turned so that a step ends where the paper's begins anew: light and
//! vigor are read last. They are then always those of the plant as it is, for whoever draws it and for the
//! next step alike.

use std::{collections::BTreeSet, ops::Range};

use espalier_plant::{AxisId, MetamerId, Plant};
use glam::Vec3;

use crate::{
    brush::BrushPiece,
    claims::{Claimed, Claims, Region},
    field::MarkerField,
    generator::{Change, Generator, StepOutcome},
    growth::Growth,
    guide::{Guide, Waypoint},
    markers::{Marker, MarkerSource},
    nearby_order::nearby_order,
    observer::{Observer, Phase},
    scene::Scene,
    selection::Selection,
    shedding,
    side_by_side::{Run, Work},
    space::Bud,
};

/// New nodes whose buds one thread describes at a time.
const BATCH: usize = if cfg!(test) { 4 } else { 256 };

/// Buds that have claimed something, and all that follows from that in a step: one kind of work, for a second thread keeps
/// the first waiting even after it has done its part.
static GROWING: Work = Work::new(4096);

/// A limb through an envelope begins once there is wood this near to its beginning, in internodes.
const BEGUN: f32 = 2.0;

/// What guides one step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StepInput {
    /// What the brushes do.
    pub pieces: Vec<BrushPiece>,
    /// Whether buds also look for room on their own.
    pub autonomous: bool,
    /// Selective growth: only the buds at this metamer's node and those above it, however far up, grow; every
    /// bud still keeps its zone free.
    pub chosen: Option<MetamerId>,
}

impl Generator for Growth {
    type Input = StepInput;

    fn step(&mut self, scene: &mut Scene, input: &StepInput, observer: &mut impl Observer) -> StepOutcome {
        self.look(scene);
        self.tick = self.tick.wrapping_add(1);
        scene.begin_step();
        let born = scene.plant.metamer_count();

        observer.enter(Phase::Shedding);
        let mut changed = if self.sheds(input) { self.shed(scene) } else { Vec::new() };
        observer.enter(Phase::Space);
        let selection = Selection::new(&scene.plant, input.chosen);
        self.take_in_strokes(scene, input, &selection);
        self.sow_and_clear_markers(scene, input);
        self.claim_markers(scene, input, &selection);
        let buds_enabled = self.claims.count();

        observer.enter(Phase::Growth);
        let run = GROWING.begin(buds_enabled as usize);
        let stroke = input.pieces.iter().find_map(BrushPiece::direction);
        let unentered = self.grow(scene, stroke, &selection, &run);
        let shares = self.shares(&scene.plant, born);
        self.claims = Claims::default();
        observer.enter(Phase::Girth);
        scene.plant.end_step();
        observer.enter(Phase::Space);
        changed.extend(self.settle(scene, born, &unentered, &run));
        self.see_light(scene, &changed, observer, &run);
        run.end();
        StepOutcome { metamers_grown: (scene.plant.metamer_count() - born) as u32, buds_enabled, shares }
    }

    fn follow(&mut self, scene: &Scene, change: &Change) {
        self.take_in(scene, change);
    }
}

impl Growth {
    /// Takes in where the brushes are, and chooses who follows them.
    pub(crate) fn take_in_strokes(&mut self, scene: &Scene, input: &StepInput, selection: &Selection) {
        let Self { parameters, guides, enclosures, .. } = self;
        let Scene { plant, space, obstacles, .. } = scene;
        let zone = parameters.scene().occupancy_radius;
        for piece in &input.pieces {
            let guide = guides.entry(piece.stroke).or_insert_with(|| Guide::new(plant.metamer_count()));
            for &sample in &piece.samples {
                if !obstacles.contains(sample.position) {
                    guide.follow(sample, zone);
                }
            }
        }
        for guide in guides.values_mut() {
            guide.leader = guide.leader.filter(|&leader| plant.is_axis_alive(leader));
            guide.skip_filled(space, zone);
        }
        let mut leading: BTreeSet<AxisId> = guides.values().filter_map(|guide| guide.leader).collect();
        let leaderless = guides.iter().filter(|(_, guide)| guide.leader.is_none());
        for stroke in leaderless.map(|(&stroke, _)| stroke).collect::<Vec<_>>() {
            let Some(mut guide) = guides.remove(&stroke) else { continue };
            if !guide.runs_along(guides.values()) {
                guide.choose_leader(space, obstacles, zone, |axis| selection.includes(axis), &leading);
                leading.extend(guide.leader);
            }
            guides.insert(stroke, guide);
        }
        // Nobody leads along two limbs, or it would go to and fro between them for ever.
        for limbs in enclosures.iter_mut().map(|one| one.lead(scene, selection, zone)) {
            leading.extend(limbs.iter().filter_map(|limb| limb.leader));
            // A limb waits for the one it begins on, and for buds that lead no other; if all of them wait, the first that
            // anybody can lead goes on from the nearest bud. One that has come to its end, or that nobody can lead, is done.
            let mut are_waiting = limbs.iter().all(|limb| limb.leader.is_none());
            let is_begun = |begin: &Waypoint| space.is_occupied(begin.position, BEGUN, |_| true);
            limbs.retain_mut(|limb| {
                limb.leader = limb.leader.filter(|&leader| plant.is_axis_alive(leader));
                if limb.leader.is_none() && !limb.path.front().is_some_and(is_begun) && !are_waiting {
                    return true;
                }
                limb.skip_filled(space, zone);
                limb.choose_leader(space, obstacles, zone, |axis| selection.includes(axis), &leading);
                if limb.is_waiting() && !are_waiting {
                    return true;
                }
                leading.extend(limb.leader);
                let goes_on = limb.leader.is_some_and(|leader| limb.is_ahead(plant.bud_position(leader)));
                are_waiting &= !goes_on;
                goes_on
            });
        }
    }

    fn sow_and_clear_markers(&mut self, scene: &Scene, input: &StepInput) {
        let tick = self.tick;
        let parameters = self.parameters.scene();
        let (space, obstacles, radius) = (&scene.space, &scene.obstacles, parameters.occupancy_radius);
        for piece in &input.pieces {
            piece.sow(&mut self.markers, self.seed, tick, parameters);
        }
        self.sow_envelopes(scene);
        let parameters = self.parameters.scene();
        // Markers that nobody sows beside any more last until growth has come to an end.
        let max_age = if input.pieces.is_empty() { u32::MAX } else { parameters.marker_max_age };
        let mut markers = core::mem::take(&mut self.markers);
        markers.clear(tick, max_age, |&Marker { position, source, .. }| {
            let zone = match source {
                MarkerSource::Brush(_) => radius,
                MarkerSource::Lasso => self.zone_at(position, radius),
            };
            !obstacles.contains(position) && !space.is_occupied(position, zone, |_| true)
        });
        self.markers = markers;
    }

    /// Gives each marker to the nearest bud that perceives it.
    fn claim_markers(&mut self, scene: &mut Scene, input: &StepInput, selection: &Selection) {
        if input.autonomous {
            self.make_field(scene);
        }
        let is_shared = self.is_shared(input);
        let Self { markers, parameters, field, .. } = self;
        let Scene { plant, space, obstacles, .. } = scene;
        let claim_sown = |&Marker { position: marker, source, .. }: &Marker| {
            let sees = |axis| space.bud(axis).is_some_and(|bud| !obstacles.hides(bud.position, marker));
            let counts = |axis| selection.includes(axis) && (obstacles.is_empty() || sees(axis));
            let (axis, _) = space.nearest_perceiving(marker, parameters, counts)?;
            Some(((axis, marker - plant.bud_position(axis)), source))
        };
        let sown: Vec<_> = markers.as_slice().iter().filter_map(claim_sown).collect();
        let mut free = Vec::new();
        if let Some(field) = field.as_mut().filter(|_| input.autonomous) {
            free = field.resolve(space, parameters, obstacles);
            space.forget_moves();
            if !selection.is_everyone() {
                let axes = (0..plant.axis_count()).map(AxisId::new).filter(|&axis| selection.includes(axis));
                let buds = axes.filter_map(|axis| Some((axis, space.bud(axis)?)));
                free = vec![field.claims_among(buds, parameters, obstacles)];
            }
        }
        self.claims = Claims::gather(plant.axis_count(), &sown, &free, is_shared);
    }

    /// Makes the field, if there is none.
    fn make_field(&mut self, scene: &Scene) {
        let Self { parameters, seed, .. } = self;
        let Scene { plant, space, obstacles, .. } = scene;
        self.field.get_or_insert_with(|| {
            let mut field = MarkerField::new(*seed, parameters.scene());
            for id in (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id)) {
                field.settle(plant.metamers().end(id), &[], parameters, obstacles);
            }
            for axis in (0..plant.axis_count()).map(AxisId::new) {
                if let Some(bud) = space.bud(axis) {
                    field.settle(bud.position, &[(axis, bud)], parameters, obstacles);
                }
            }
            field
        });
    }

    /// Whether a step judges the branches. One that only a hand guides does not: nothing but what is drawn grows in it, so
    /// that a crown would lose branches and get none.
    pub(crate) fn sheds(&self, input: &StepInput) -> bool {
        let mut strokes = self.guides.keys().chain(input.pieces.iter().map(|piece| &piece.stroke));
        input.autonomous || strokes.any(|stroke| stroke.is_of_programme())
    }

    /// Sheds what does not pay; returns the nodes that went.
    fn shed(&mut self, scene: &mut Scene) -> Vec<Vec3> {
        let mut condemned = shedding::condemned(&scene.plant, &self.canopy, &self.parameters);
        if !condemned.is_empty() {
            condemned.retain(self.spares(&scene.plant));
        }
        if condemned.is_empty() {
            return Vec::new();
        }
        let (metamers, axes) = scene.plant.shed(&condemned);
        axes.into_iter().for_each(|axis| scene.space.remove_bud(axis));
        let nodes: Vec<Vec3> = metamers.iter().map(|&id| scene.plant.metamers().end(id)).collect();
        let radius = self.parameters().occupancy_radius;
        for (&id, &node) in metamers.iter().zip(&nodes) {
            scene.leave(id, node);
            if let Some(field) = &mut self.field {
                field.vacate(node, radius, &scene.space, &scene.obstacles);
            }
        }
        self.canopy.bury(&scene.plant, &metamers);
        nodes
    }

    /// Which axes may be shed: not those that lead a stroke or a lasso, nor those born since somebody began to draw, nor
    /// those to be kept, nor what bears any of them.
    pub(crate) fn spares(&self, plant: &Plant) -> impl Fn(&AxisId) -> bool + use<> {
        let mut spared = BTreeSet::new();
        let limbs = self.enclosures.iter().flat_map(|one| one.limbs.iter().flatten());
        let leaders = self.guides.values().chain(limbs).filter_map(|guide| guide.leader);
        let by_hand = self.guides.iter().filter(|(stroke, _)| !stroke.is_of_programme());
        let enclosed = self.enclosures.iter().map(|one| one.first_born);
        let first_born = by_hand.map(|(_, guide)| guide.first_born).chain(enclosed).min();
        let is_drawn = |&axis: &AxisId| {
            let Some(first) = plant.axes().first(axis) else { return false };
            first_born.is_some_and(|born| first >= born) || self.keeps(plant, first)
        };
        let drawn = (0..plant.axis_count()).map(AxisId::new).filter(is_drawn);
        for drawn in leaders.chain(drawn) {
            let mut axis = Some(drawn);
            while let Some(bearing) = axis.filter(|&axis| spared.insert(axis)) {
                axis = plant.axes().bearer(bearing).map(|bearer| plant.metamers().axis(bearer));
            }
        }
        move |axis| !spared.contains(axis)
    }

    /// Whether an axis that begins with this metamer is one of those to be kept.
    fn keeps(&self, plant: &Plant, first: MetamerId) -> bool {
        if self.kept.is_empty() {
            return false;
        }
        let birth = plant.birth(first);
        let ended_before = self.kept.partition_point(|&(_, upto)| upto < birth);
        self.kept.get(ended_before).is_some_and(|&(after, _)| after < birth)
    }

    /// E, turned towards the light as far as phototropism has it; where a hand drew, E goes to what it drew.
    pub(crate) fn lit_side(&self, scene: &Scene, axis: AxisId, claimed: Claimed) -> Vec3 {
        let Claimed { space, region } = claimed;
        let (weight, is_flat) = (self.parameters.of(axis).phototropism, self.parameters.of(axis).is_flat);
        if weight == 0.0 || region != Region::Free {
            return space;
        }
        let Some(light) = scene.towards_light(scene.plant.bud_position(axis)) else { return space };
        // A canopy's shadow ends some way below it, so it is lighter farther down; but no light comes from there.
        let light = Vec3::new(light.x, light.y.max(0.0), if is_flat { 0.0 } else { light.z });
        (space * (1.0 - weight) + light * weight).try_normalize().unwrap_or(space)
    }

    /// Enters what has grown into light and space: the rows from `born` on, into space those that are not in it yet.
    /// Returns their nodes.
    fn settle(
        &mut self,
        scene: &mut Scene,
        born: usize,
        unentered: &Range<usize>,
        run: &Run<'_>,
    ) -> Vec<Vec3> {
        let Self { parameters, field, .. } = self;
        let Scene { plant, space, shadows, obstacles, .. } = scene;
        let plant = &*plant;
        // What lies together is entered together: all that is written to is larger than a cache, and neighbours
        // write to the same places.
        let place = |row: usize| plant.metamers().end(MetamerId::new(row));
        let new = nearby_order((born..plant.metamer_count()).map(|row| (row, place(row))));
        let id = |row: u32| MetamerId::new(row as usize);
        let nodes = || new.iter().map(|&row| (id(row), plant.metamers().end(id(row))));
        nodes().for_each(|(_, node)| obstacles.survey_sky(node));
        let obstacles = &*obstacles;
        let buds_at = |rows: &[u32]| {
            let mut buds = Vec::with_capacity(rows.len() * 2);
            for id in rows.iter().map(|&row| id(row)) {
                let axis = plant.metamers().axis(id);
                let tip = (plant.axes().last(axis) == Some(id)).then_some(axis);
                for axis in tip.into_iter().chain(plant.laterals(id)) {
                    let position = plant.metamers().end(id);
                    buds.push((axis, Bud { position, direction: plant.bud_direction(axis) }));
                }
            }
            buds
        };
        // Node by node, in batches of as many nodes.
        let buds: Vec<Vec<(AxisId, Bud)>> = run.each(new.chunks(BATCH), buds_at);
        let update_shadows = || shadows.cast_all(nodes().map(|(_, node)| node));
        let update_space = || {
            let unentered = nodes().filter(|(id, _)| unentered.contains(&id.index()));
            unentered.for_each(|(id, node)| space.occupy(id, node));
            buds.iter().flatten().for_each(|&(axis, bud)| space.place_bud(axis, bud));
        };
        let update_field = || {
            let Some(field) = field else { return };
            for (nodes, mut buds) in new.chunks(BATCH).zip(buds.iter().map(Vec::as_slice)) {
                for node in nodes.iter().map(|&row| plant.metamers().end(id(row))) {
                    let own = buds.iter().take_while(|(_, bud)| bud.position == node).count();
                    field.settle(node, &buds[..own], parameters, obstacles);
                    buds = &buds[own..];
                }
            }
        };
        run.both(update_field, || run.both(update_space, update_shadows));
        nodes().map(|(_, node)| node).collect()
    }
}

#[cfg(test)]
mod tests {
    use glam::Quat;

    use super::*;
    use crate::{Obstacle, ParameterValues, Parameters, Shape, Simulation};

    #[test]
    fn light_is_sought_away_from_a_wall() {
        let values = ParameterValues { phototropism: 0.5, ..ParameterValues::default() };
        let mut simulation = Simulation::new(1, Parameters::new(values).expect("in range"));
        let side = |simulation: &Simulation| {
            let free = Claimed { space: Vec3::Y, region: Region::Free };
            simulation.generator.lit_side(&simulation.scene, AxisId::new(0), free)
        };
        assert_eq!(side(&simulation), Vec3::Y, "there is nothing to turn away from");
        let wall = Shape::Box {
            centre: Vec3::new(4.0, 0.0, 0.0),
            half_extents: Vec3::new(1.0, 20.0, 20.0),
            rotation: Quat::IDENTITY,
        };
        simulation.set_obstacles(vec![Obstacle::new(wall).expect("a wall")]);
        let turned = side(&simulation);
        assert!(turned.x < -0.3 && turned.y > 0.3 && turned.z.abs() < 0.1, "{turned}");
    }
}
