//! The step as it is defined: plain loops over everything, nothing kept from one step to the next.
//!
//! The simulation must grow the same plants, bit for bit; it only may not take as long. Shared with it are the
//! formulas themselves (direction, propensity, the split of vigor, a shoot's growth); its own are all searches,
//! sums and orders.

mod tests;
mod vigor;

use espalier_plant::{AxisId, MetamerId, Plant};
use glam::Vec3;

use self::vigor::Vigor;
use crate::{
    BrushPiece, StepInput,
    claims::{Claimed, Claims},
    field::Lattice,
    growth::Growth,
    markers::{Marker, MarkerSource},
    scene::Scene,
    selection::Selection,
    shoot::Aim,
    simulation::Simulation,
    space::Cone,
};

/// One step of a simulation whose caches are thrown away first.
pub(crate) fn step(simulation: &mut Simulation, input: &StepInput) {
    let state = simulation.state();
    let Simulation { mut scene, generator: mut plain } =
        Simulation::from_state(simulation.plant().clone(), state);
    plain.tick = plain.tick.wrapping_add(1);
    let vigor = Vigor::of(&scene.plant, &plain.parameters, &scene.obstacles);
    scene.plant.begin_step();
    let goes = plain.spares(&scene.plant);
    let judged = all_axes(&scene.plant).filter(goes).filter(|_| plain.sheds(input));
    for axis in judged {
        if scene.plant.is_standing(axis) && vigor.condemns(&scene.plant, axis, &plain.parameters) {
            scene.plant.shed(&[axis]);
        }
    }
    // Growth asks space whether a place is taken, and light for the way to it: both made afresh.
    scene.rebuild(plain.parameters());
    let selection = Selection::new(&scene.plant, input.chosen);
    plain.take_in_strokes(&scene, input, &selection);
    plain.claims = claims(&mut plain, &scene, input);
    let stroke = input.pieces.iter().find_map(BrushPiece::direction);
    let born = scene.plant.metamer_count();
    let led = plain.grow_leaders(&mut scene, stroke, &selection);
    for id in (born..scene.plant.metamer_count()).map(MetamerId::new) {
        scene.space.occupy(id, scene.plant.metamers().end(id));
    }
    let mut shoots: Vec<(u32, AxisId, Claimed)> = Vec::new();
    let claims = std::mem::take(&mut plain.claims);
    let vigors: Vec<(AxisId, Claimed, f64)> = claims
        .iter()
        .filter(|(axis, _)| !led.contains(axis))
        .map(|(axis, claimed)| (axis, claimed, vigor.of_bud(&scene.plant, axis, &plain.parameters)))
        .collect();
    let greatest = vigors.iter().map(|&(.., vigor)| vigor).fold(0.0, f64::max);
    for (axis, claimed, vigor) in vigors {
        let length = claimed.region.shoot_length(vigor, greatest, plain.parameters.of(axis));
        shoots.push((length, axis, claimed));
    }
    shoots.sort_by_key(|&(length, axis, _)| (core::cmp::Reverse(length), axis));
    for (length, axis, claimed) in shoots {
        let lit = plain.lit_side(&scene, axis, claimed);
        let aim = Aim { space: Some(lit), stroke, region: claimed.region };
        plain.grow_shoot(&mut scene, axis, length, aim);
    }
    scene.plant.end_step();
    let ended = Simulation { scene, generator: plain };
    let state = ended.state();
    *simulation = Simulation::from_state(ended.scene.plant, state);
}

fn all_axes(plant: &Plant) -> impl Iterator<Item = AxisId> + use<> {
    (0..plant.axis_count()).map(AxisId::new)
}

fn living_nodes(plant: &Plant) -> Vec<MetamerId> {
    (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id)).collect()
}

/// Every marker goes to the nearest bud that perceives it.
fn claims(plain: &mut Growth, scene: &Scene, input: &StepInput) -> Claims {
    let parameters = plain.parameters.scene().clone();
    let tick = plain.tick;
    for piece in &input.pieces {
        piece.sow(&mut plain.markers, plain.seed, tick, &parameters);
    }
    plain.sow_envelopes(scene);
    let plant = &scene.plant;
    let nodes: Vec<Vec3> = living_nodes(plant).into_iter().map(|id| plant.metamers().end(id)).collect();
    let obstacles = &scene.obstacles;
    let mut markers = core::mem::take(&mut plain.markers);
    let is_free = |place: Vec3, zone: f32| {
        !obstacles.contains(place) && nodes.iter().all(|node| node.distance_squared(place) > zone * zone)
    };
    let max_age = if input.pieces.is_empty() { u32::MAX } else { parameters.marker_max_age };
    let zone = parameters.occupancy_radius;
    markers.clear(tick, max_age, |&Marker { position, source, .. }| match source {
        MarkerSource::Brush(_) => is_free(position, zone),
        MarkerSource::Lasso => is_free(position, plain.zone_at(position, zone)),
    });
    plain.markers = markers;
    let mut markers: Vec<(Vec3, Option<MarkerSource>)> =
        plain.markers.as_slice().iter().map(|marker| (marker.position, Some(marker.source))).collect();
    if input.autonomous {
        let lattice = Lattice::new(plain.seed, &parameters);
        let edge = lattice.spacing;
        let reach = Vec3::splat(parameters.perception_radius());
        let low = nodes.iter().fold(Vec3::INFINITY, |low, &node| low.min(node)) - reach;
        let high = nodes.iter().fold(Vec3::NEG_INFINITY, |high, &node| high.max(node)) + reach;
        let cells =
            |low: f32, high: f32| libm::floorf(low / edge) as i32 - 1..=libm::floorf(high / edge) as i32 + 1;
        for x in cells(low.x, high.x) {
            for y in cells(low.y, high.y) {
                for z in cells(low.z, high.z) {
                    let marker = lattice.marker_in([x, y, z]);
                    if let Some(marker) = marker.filter(|marker| marker.y > 0.0 && is_free(*marker, zone)) {
                        markers.push((marker, None));
                    }
                }
            }
        }
    }
    let descends = |axis: AxisId| {
        let mut below = core::iter::successors(Some(plant.bud_node(axis)), |&id| plant.metamers().parent(id));
        input.chosen.is_none_or(|chosen| {
            chosen.index() < plant.metamer_count() && plant.is_alive(chosen) && below.any(|id| id == chosen)
        })
    };
    let buds: Vec<AxisId> =
        all_axes(plant).filter(|&axis| plant.is_axis_alive(axis) && descends(axis)).collect();
    let (mut sown, mut free) = (Vec::new(), Vec::new());
    for (marker, source) in markers {
        let nearest = buds
            .iter()
            .filter_map(|&axis| {
                let bud = plant.bud_position(axis);
                let distance_squared = (marker - bud).length_squared();
                let dot = (marker - bud).dot(plant.bud_direction(axis));
                let perceives = Cone::new(plain.parameters.of(axis)).holds(distance_squared, dot);
                (perceives && !obstacles.hides(bud, marker)).then_some((distance_squared, axis))
            })
            .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        if let Some((_, axis)) = nearest {
            let offset = marker - plant.bud_position(axis);
            match source {
                None => free.push((axis, offset)),
                Some(source) => sown.push(((axis, offset), source)),
            }
        }
    }
    Claims::gather(plant.axis_count(), &sown, &[free], false)
}
