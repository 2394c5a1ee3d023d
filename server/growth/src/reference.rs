//! The step as it is defined: plain loops over everything, nothing kept from one step to the next.
//!
//! The simulation must grow the same plants, bit for bit; it only may not take as long. Shared with it are the
//! formulas themselves (direction, propensity, the split of vigor, a shoot's growth); its own are all searches,
//! sums and orders.

use espalier_plant::{AxisId, MetamerId, Plant};
use glam::Vec3;

use crate::{
    BrushPiece, StepInput,
    claims::{Claimed, Claims},
    field::Lattice,
    gravimorphism::propensity,
    light::ShadowGrid,
    markers::MarkerSource,
    obstacles::Obstacles,
    parameter_table::ParameterTable,
    parameters::VigorModel,
    shoot::Aim,
    simulation::Simulation,
    space::Cone,
    vigor::{self, Flow, Split},
};

/// Light and vigor of a plant, by the definitions.
struct Vigor {
    flows: Vec<Flow>,
    light: Vec<f32>,
    sizes: Vec<u32>,
    /// Steps of growth each metamer has lived through.
    ages: Vec<u32>,
    /// Under the priority model, vigor of each axis.
    of_axes: Vec<f64>,
}

/// One step of a simulation whose caches are thrown away first.
pub(crate) fn step(simulation: &mut Simulation, input: &StepInput) {
    let state = simulation.state();
    let mut plain = Simulation::from_state(simulation.plant.clone(), state);
    plain.tick = plain.tick.wrapping_add(1);
    let vigor = Vigor::of(&plain.plant, &plain.parameters, &plain.obstacles);
    plain.plant.begin_step();
    for axis in all_axes(&plain.plant) {
        if plain.plant.is_standing(axis) && vigor.condemns(&plain.plant, axis, &plain.parameters) {
            plain.plant.shed(&[axis]);
        }
    }
    let claims = claims(&mut plain, input);
    // Growth asks space whether a place is taken, and light for the way to it: both made afresh.
    plain.rebuild();
    let stroke = input.pieces.iter().find_map(BrushPiece::direction);
    let mut shoots: Vec<(u32, AxisId, Claimed)> = Vec::new();
    let vigors: Vec<(AxisId, Claimed, f64)> = claims
        .iter()
        .map(|(axis, claimed)| (axis, claimed, vigor.of_bud(&plain.plant, axis, &plain.parameters)))
        .collect();
    let greatest = vigors.iter().map(|&(.., vigor)| vigor).fold(0.0, f64::max);
    for (axis, claimed, vigor) in vigors.into_iter().filter(|&(.., vigor)| vigor > 0.0) {
        let parameters = plain.parameters.of(axis);
        let length = claimed.limit(vigor::shoot_length(vigor, greatest, parameters), parameters);
        shoots.push((length, axis, claimed));
    }
    shoots.sort_by_key(|&(length, axis, _)| (core::cmp::Reverse(length), axis));
    for (length, axis, Claimed { space, envelope }) in shoots {
        plain.grow_shoot(
            axis,
            length,
            Aim { space: Some(plain.lit_side(axis, space)), stroke, is_enclosed: envelope.is_some() },
        );
    }
    plain.plant.end_step();
    let state = plain.state();
    *simulation = Simulation::from_state(plain.plant, state);
}

fn all_axes(plant: &Plant) -> impl Iterator<Item = AxisId> + use<> {
    (0..plant.axis_count()).map(AxisId::new)
}

fn living_nodes(plant: &Plant) -> Vec<MetamerId> {
    (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id)).collect()
}

/// Every marker goes to the nearest bud that perceives it.
fn claims(plain: &mut Simulation, input: &StepInput) -> Claims {
    let parameters = plain.parameters.scene().clone();
    let tick = plain.tick;
    for piece in &input.pieces {
        piece.sow(&mut plain.markers, plain.seed, tick, &parameters);
    }
    let plant = &plain.plant;
    let nodes: Vec<Vec3> = living_nodes(plant).into_iter().map(|id| plant.metamers().end(id)).collect();
    let zone = parameters.occupancy_radius * parameters.occupancy_radius;
    let obstacles = &plain.obstacles;
    let is_free = |place: Vec3| {
        !obstacles.contains(place) && nodes.iter().all(|node| node.distance_squared(place) > zone)
    };
    plain.markers.clear(tick, parameters.marker_max_age, is_free);
    let mut markers: Vec<(Vec3, MarkerSource)> =
        plain.markers.as_slice().iter().map(|marker| (marker.position, marker.source)).collect();
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
                    if let Some(marker) = marker.filter(|marker| marker.y > 0.0 && is_free(*marker)) {
                        markers.push((marker, MarkerSource::Brush));
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
    let mut claims = Claims::default();
    claims.clear(plant.axis_count());
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
                MarkerSource::Brush => claims.add(axis, offset),
                MarkerSource::Lasso => claims.add_in_envelope(axis, offset),
            }
        }
    }
    claims
}

impl Vigor {
    fn of(plant: &Plant, parameters: &ParameterTable, obstacles: &Obstacles) -> Self {
        let count = plant.metamer_count();
        let mut shadows = ShadowGrid::new(parameters.scene());
        let nodes = living_nodes(plant);
        for &id in nodes.iter().filter(|&&id| !plant.is_seed(id)) {
            shadows.cast(plant.metamers().end(id));
        }
        let mut vigor = Self {
            flows: vec![Flow::default(); count],
            light: vec![0.0; count],
            sizes: vec![0; count],
            ages: (0..count).map(|index| plant.age(MetamerId::new(index))).collect(),
            of_axes: Vec::new(),
        };
        for &id in &nodes {
            let node = plant.metamers().end(id);
            vigor.light[id.index()] = shadows.exposure(node) * obstacles.sky_share(node);
        }
        for axis in all_axes(plant).filter(|&axis| plant.is_axis_alive(axis)) {
            let flow = &mut vigor.flows[plant.bud_node(axis).index()];
            let light = vigor.light[plant.bud_node(axis).index()];
            match plant.axes().last(axis) {
                Some(_) => flow.main += bud_input(plant, axis, light, parameters),
                None => flow.lateral += bud_input(plant, axis, light, parameters),
            }
        }
        for &id in nodes.iter().rev() {
            let Some(parent) = plant.metamers().parent(id) else { continue };
            let light = vigor.flows[id.index()].light();
            let below = &mut vigor.flows[parent.index()];
            let continues = plant.metamers().axis(parent) == plant.metamers().axis(id);
            *(if continues { &mut below.main } else { &mut below.lateral }) += light;
            vigor.sizes[id.index()] += 1;
            vigor.sizes[parent.index()] += vigor.sizes[id.index()];
        }
        if parameters.scene().vigor_model == VigorModel::Priority {
            vigor.share_by_rank(plant, parameters);
            return vigor;
        }
        for &id in &nodes {
            let light = vigor.flows[id.index()].light();
            vigor.flows[id.index()].vigor = match plant.metamers().parent(id) {
                None => f64::from(parameters.scene().vigor_gain) / vigor::UNIT * light as f64,
                Some(parent) => {
                    let axis = plant.metamers().axis(parent);
                    let split =
                        Split::new(&vigor.flows[parent.index()], lambda(plant, id, parameters, &vigor.ages));
                    if axis == plant.metamers().axis(id) { split.to_main() } else { split.to_lateral(light) }
                }
            };
        }
        vigor
    }

    /// Vigor by the priority model (Pałubicki et al. 2009 §4.2). Light has flowed down.
    fn share_by_rank(&mut self, plant: &Plant, parameters: &ParameterTable) {
        let nodes = living_nodes(plant);
        let mut buds = vec![0u128; plant.metamer_count()];
        for axis in all_axes(plant).filter(|&axis| plant.is_axis_alive(axis)) {
            buds[plant.bud_node(axis).index()] += 1;
        }
        for &id in nodes.iter().rev() {
            if let Some(parent) = plant.metamers().parent(id) {
                buds[parent.index()] += buds[id.index()];
            }
        }
        self.of_axes = vec![0.0; plant.axis_count()];
        for axis in all_axes(plant) {
            let on_axis = |id: &&MetamerId| plant.metamers().axis(**id) == axis;
            let nodes: Vec<MetamerId> = nodes.iter().filter(on_axis).copied().collect();
            let Some(&first) = nodes.first() else { continue };
            if plant.is_seed(first) {
                let gain = f64::from(parameters.scene().vigor_gain) / vigor::UNIT;
                self.of_axes[axis.index()] = gain * self.flows[first.index()].light() as f64;
            }
            let lambda = lambda(plant, first, parameters, &self.ages);
            // Who claims a share: whether it comes first, its light, its buds, its axis, and where it is borne.
            let mut claimants: Vec<(bool, u64, u128, AxisId, usize)> = Vec::new();
            for (place, &id) in nodes.iter().enumerate() {
                let borne = all_axes(plant).filter(|&lateral| plant.axes().bearer(lateral) == Some(id));
                for lateral in borne.filter(|&lateral| plant.is_standing(lateral)) {
                    let (light, buds) = match plant.axes().first(lateral) {
                        Some(wood) => (self.flows[wood.index()].light(), buds[wood.index()]),
                        None => (bud_input(plant, lateral, self.light[id.index()], parameters), 1),
                    };
                    claimants.push((false, light, buds, lateral, place));
                }
                if plant.is_axis_alive(axis) && plant.bud_node(axis) == id {
                    let light = bud_input(plant, axis, self.light[id.index()], parameters);
                    claimants.push((lambda >= 0.5, light, 1, axis, place));
                }
            }
            claimants.retain(|&(_, _, buds, ..)| buds > 0);
            claimants.sort_by(|a, b| {
                let share = (u128::from(b.1) * a.2).cmp(&(u128::from(a.1) * b.2));
                b.0.cmp(&a.0).then(share).then(b.3.cmp(&a.3))
            });
            let values = parameters.of(axis);
            let last = (claimants.len().max(2) - 1) as f64;
            let (least, decline) =
                (f64::from(values.priority_least_weight), f64::from(values.priority_decline));
            let weight = |rank: usize| {
                let x = rank as f64 / last;
                if x < decline { 1.0 + (least - 1.0) * x / decline } else { least }
            };
            let shares: Vec<f64> = claimants
                .iter()
                .enumerate()
                .map(|(rank, claimant)| claimant.1 as f64 * weight(rank))
                .collect();
            let all: f64 = shares.iter().sum();
            let rate = if all > 0.0 { self.of_axes[axis.index()] / all } else { 0.0 };
            let mut spent = vec![0.0; nodes.len()];
            for (&(.., lateral, place), share) in claimants.iter().zip(shares) {
                self.of_axes[lateral.index()] = rate * share;
                spent[place] += rate * share;
            }
            let mut left: f64 = spent.iter().sum();
            for (id, spent) in nodes.into_iter().zip(spent) {
                self.flows[id.index()].vigor = left;
                left = (left - spent).max(0.0);
            }
        }
    }

    fn of_bud(&self, plant: &Plant, axis: AxisId, parameters: &ParameterTable) -> f64 {
        if let Some(&vigor) = self.of_axes.get(axis.index()) {
            return vigor;
        }
        let node = plant.bud_node(axis);
        let split = Split::new(&self.flows[node.index()], lambda(plant, node, parameters, &self.ages));
        match plant.axes().last(axis) {
            Some(_) => split.to_main(),
            None => split.to_lateral(bud_input(plant, axis, self.light[node.index()], parameters)),
        }
    }

    fn condemns(&self, plant: &Plant, axis: AxisId, parameters: &ParameterTable) -> bool {
        let Some(first) = plant.axes().first(axis).filter(|_| plant.axes().order(axis) > 0) else {
            return false;
        };
        let threshold =
            f64::from(parameters.scene().vigor_gain) * f64::from(parameters.of(axis).shedding_threshold);
        plant.age(first) >= 3
            && self.flows[first.index()].vigor < threshold * f64::from(self.sizes[first.index()])
    }
}

/// λ of the plant that a metamer belongs to.
fn lambda(plant: &Plant, id: MetamerId, parameters: &ParameterTable, ages: &[u32]) -> f64 {
    let seed = core::iter::successors(Some(id), |&id| plant.metamers().parent(id)).last().unwrap_or(id);
    f64::from(parameters.scene().apical_control_at(ages[seed.index()]))
}

/// Q = bL^κ (TreeSketch §3.2).
fn bud_input(plant: &Plant, axis: AxisId, light: f32, parameters: &ParameterTable) -> u64 {
    let parameters = parameters.of(axis);
    let kappa = parameters.light_sensitivity;
    let response = if kappa == 1.0 { light } else { libm::powf(light, kappa) };
    let node = plant.bud_node(axis);
    let b = match plant.axes().last(axis) {
        Some(_) => 1.0,
        None => propensity(plant.heading(node), plant.axes().direction(axis), parameters),
    };
    vigor::quantised(response * b)
}

mod tests {
    use espalier_plant::Motion;
    use glam::{Quat, Vec2};
    use proptest::prelude::*;

    use super::*;
    use crate::{
        BrushSample, Envelope, NoObserver, Obstacle, Original, ParameterValues, Parameters, Plane, Shape,
        StrokeId,
    };

    /// What the two are made to do side by side.
    #[derive(Clone, Debug)]
    enum Event {
        Grow,
        Brush(Vec3, f32),
        Back(u32),
        Sow(Vec3),
        Shedding(f32),
        Light(f32, f32),
        Select(u32),
        Obstacle(Vec3, f32),
        Enclose(Vec3, f32),
        /// Cuts off some wood.
        Prune(u32),
        /// Turns some branch upside down about its foot.
        Turn(u32),
        /// Grafts some branch onto some wood; every other time the branch itself goes.
        Graft(u32, u32),
    }

    /// Some living wood.
    fn wood(plant: &Plant, pick: u32) -> Option<MetamerId> {
        let wood: Vec<_> = living_nodes(plant).into_iter().filter(|&id| !plant.is_seed(id)).collect();
        wood.get(pick as usize % wood.len().max(1)).copied()
    }

    /// Half a turn about where a branch begins, and what begins there to stand there.
    fn half_turn(plant: &Plant, branch: MetamerId, to: Option<MetamerId>) -> Motion {
        let foot = plant.metamers().parent(branch).map_or(Vec3::ZERO, |foot| plant.metamers().end(foot));
        let to = to.map_or(foot, |onto| plant.metamers().end(onto));
        Motion { rotation: Quat::from_xyzw(0.6, 0.0, 0.8, 0.0), from: foot, to }
    }

    fn edit(simulation: &mut Simulation, event: &Event) {
        let plant = &simulation.plant;
        match *event {
            Event::Prune(pick) => {
                let cuts: Vec<_> = wood(plant, pick).into_iter().collect();
                simulation.prune(&cuts);
            }
            Event::Turn(pick) => {
                let Some(branch) = wood(plant, pick) else { return };
                let motion = half_turn(plant, branch, None);
                simulation.carry(&[branch], &[motion]).expect("it stays in the world");
            }
            Event::Graft(pick, onto) => {
                let (Some(branch), Some(onto)) = (wood(plant, pick), wood(plant, onto)) else { return };
                if plant.above(branch).contains(&onto) {
                    return;
                }
                let motion = half_turn(plant, branch, Some(onto));
                let original = if pick % 2 == 0 { Original::Goes } else { Original::Stays };
                let room =
                    plant.metamer_count() + plant.above(branch).len() <= simulation.metamer_budget as usize;
                let grafted = simulation.graft(branch, onto, &motion, original);
                assert_eq!(grafted.is_ok(), room);
            }
            _ => {}
        }
    }

    fn events() -> impl Strategy<Value = Vec<Event>> {
        let place = (-8f32..8.0, 2f32..14.0, -8f32..8.0).prop_map(Vec3::from).boxed();
        let event = prop_oneof![
            6 => Just(Event::Grow),
            3 => (place.clone(), 2.5f32..6.0).prop_map(|(at, radius)| Event::Brush(at, radius)),
            1 => (1u32..4).prop_map(Event::Back),
            1 => (-9f32..9.0, -9f32..9.0).prop_map(|(x, z)| Event::Sow(Vec3::new(x, 0.0, z))),
            1 => (0f32..0.4).prop_map(Event::Shedding),
            1 => any::<u32>().prop_map(Event::Select),
            1 => (place.clone(), 2f32..6.0).prop_map(|(centre, radius)| Event::Enclose(centre, radius)),
            1 => (place, 0.5f32..4.0).prop_map(|(centre, radius)| Event::Obstacle(centre, radius)),
            1 => any::<u32>().prop_map(Event::Prune),
            1 => any::<u32>().prop_map(Event::Turn),
            1 => any::<(u32, u32)>().prop_map(|(branch, onto)| Event::Graft(branch, onto)),
            1 => (0f32..0.9, 0.5f32..3.0).prop_map(|(a, kappa)| Event::Light(a, kappa)),
        ];
        prop::collection::vec(event, 8..22)
    }

    fn parameters() -> impl Strategy<Value = ParameterValues> {
        let angles = (20f32..360.0, 0f32..100.0, 0f32..180.0);
        let model = prop_oneof![2 => Just(VigorModel::BorchertHonda), 1 => Just(VigorModel::Priority)];
        let ageing = (0u32..6, 0u32..8, 0.45f32..0.6, 0f32..1.0, model);
        (0.5f32..3.0, 1f32..4.0, angles, 1u32..4, 1u32..6, (0.45f32..0.6, ageing), -0.9f32..0.9).prop_map(
            |(r, d, (zeta, psi, theta), buds, longest, (lambda, ageing), shift)| ParameterValues {
                maturity_start: ageing.0,
                maturity_steps: ageing.1,
                mature_apical_control: ageing.2,
                phototropism: ageing.3,
                vigor_model: ageing.4,
                occupancy_radius: r,
                perception_depth: d,
                perception_angle: zeta,
                branching_angle: psi,
                setpoint_angle: theta,
                buds_per_node: buds,
                max_shoot_length: longest,
                apical_control: lambda,
                gravimorphism_shift: shift,
                ..ParameterValues::default()
            },
        )
    }

    fn set(simulations: [&mut Simulation; 2], change: impl Fn(&mut ParameterValues)) {
        for simulation in simulations {
            let mut values = simulation.parameters().values().clone();
            change(&mut values);
            simulation.set_parameters(Parameters::new(values).expect("in range"));
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(96))]

        #[test]
        fn plants_equal_the_definition_bit_for_bit(
            seed: u32, values in parameters(), is_flat in prop::bool::weighted(0.2), events in events(),
        ) {
            let parameters = Parameters::new(values).expect("in range");
            let parameters = if is_flat { parameters.flat() } else { parameters };
            let mut fast = Simulation::new(seed, parameters);
            fast.set_metamer_budget(900);
            let mut plain = fast.clone();
            let mut chosen = None;
            for (number, event) in events.iter().enumerate() {
                match *event {
                    Event::Grow | Event::Brush(..) => {
                        let pieces = match *event {
                            Event::Brush(position, radius) => {
                                let sample = BrushSample { position, radius };
                                vec![BrushPiece { stroke: StrokeId(number as u32), samples: vec![sample] }]
                            }
                            _ => Vec::new(),
                        };
                        // A lasso's markers are grown into without more, by the brush's steps.
                        let input = StepInput { autonomous: pieces.is_empty() && number % 3 > 0, pieces, chosen };
                        fast.step(&input, &mut NoObserver);
                        step(&mut plain, &input);
                    }
                    Event::Select(n) => {
                        let metamers = fast.plant().metamer_count() as u32;
                        chosen = (n % 2 == 0).then(|| MetamerId::new((n % metamers) as usize));
                    }
                    Event::Enclose(origin, radius) => {
                        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
                        let square = corners.map(|(x, y)| Vec2::new(x, y) * radius);
                        let plane = Plane { origin, right: Vec3::X, up: Vec3::Y };
                        let envelope = Envelope::inflate(&square, plane, 1.0, 1.5).expect("a square");
                        fast.enclose(&envelope);
                        plain.enclose(&envelope);
                    }
                    Event::Obstacle(centre, radius) => {
                        let ball = Obstacle::new(Shape::Sphere { centre, radius }).expect("a ball");
                        fast.set_obstacles(vec![ball.clone()]);
                        plain.set_obstacles(vec![ball]);
                    }
                    Event::Prune(_) | Event::Turn(_) | Event::Graft(..) => {
                        edit(&mut fast, event);
                        edit(&mut plain, event);
                    }
                    Event::Back(steps) => {
                        let to = fast.plant().step().saturating_sub(steps);
                        fast.go_to(to);
                        plain.go_to(to);
                    }
                    Event::Sow(place) => {
                        fast.sow(place);
                        plain.sow(place);
                    }
                    Event::Shedding(threshold) => {
                        set([&mut fast, &mut plain], |values| values.shedding_threshold = threshold);
                    }
                    Event::Light(strength, kappa) => set([&mut fast, &mut plain], |values| {
                        (values.shadow_strength, values.light_sensitivity) = (strength, kappa);
                    }),
                }
                prop_assert_eq!(fast.plant().hash(), plain.plant().hash(), "after {:?}", event);
                prop_assert_eq!(fast.markers(), plain.markers());
                fast.show();
                plain.show();
                let looks = |simulation: &Simulation| -> Vec<_> {
                    let ids = living_nodes(simulation.plant());
                    ids.iter().map(|&id| simulation.plant().metamers().appearance(id)).collect()
                };
                prop_assert_eq!(looks(&fast), looks(&plain));
            }
        }
    }
}
