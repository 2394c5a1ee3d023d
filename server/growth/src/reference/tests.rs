//! Random scenes are grown both ways, side by side, and must be the same after whatever happens to them.

use espalier_plant::{AxisId, Carried, Claim, MetamerId, Motion, Plant};
use glam::{Quat, Vec2, Vec3};
use proptest::prelude::*;

use super::{living_nodes, step};
use crate::{
    BrushPiece, BrushSample, Envelope, NoObserver, Obstacle, Original, ParameterValues, Parameters, Plane,
    Shape, Simulation, StepInput, StrokeId, VigorModel,
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
    /// Shrinks some branch, by whole columns.
    Place(u32),
    /// Grafts some branch onto some wood; every other time the branch itself goes.
    Graft(u32, u32),
    /// Settles which wood stands with these steps in force, and these drawn by a hand.
    Settle(u64, u64),
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

/// A branch nine tenths as large, its buds turned the other way.
fn shrunk(plant: &Plant, branch: MetamerId) -> Carried {
    let foot = plant.metamers().parent(branch).map_or(Vec3::ZERO, |foot| plant.metamers().end(foot));
    let metamers = plant.above(branch);
    let is_borne = |&axis: &AxisId| {
        let bearer = plant.axes().bearer(axis);
        plant.is_standing(axis) && bearer.is_some_and(|bearer| metamers.contains(&bearer))
    };
    let axes: Vec<AxisId> = (0..plant.axis_count()).map(AxisId::new).filter(is_borne).collect();
    Carried {
        ends: metamers.iter().map(|&id| foot + 0.9 * (plant.metamers().end(id) - foot)).collect(),
        normals: metamers.iter().map(|&id| plant.metamers().normal(id)).collect(),
        directions: axes.iter().map(|&axis| -plant.axes().direction(axis)).collect(),
        metamers,
        axes,
    }
}

fn edit(simulation: &mut Simulation, event: &Event) {
    let plant = simulation.plant();
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
        Event::Place(pick) => {
            let Some(branch) = wood(plant, pick) else { return };
            simulation.place(shrunk(plant, branch)).expect("it fits");
        }
        Event::Graft(pick, onto) => {
            let (Some(branch), Some(onto)) = (wood(plant, pick), wood(plant, onto)) else { return };
            if plant.above(branch).contains(&onto) {
                return;
            }
            let motion = half_turn(plant, branch, Some(onto));
            let original = if pick % 2 == 0 { Original::Goes } else { Original::Stays };
            let room = plant.metamer_count() + plant.above(branch).len()
                <= simulation.scene.metamer_budget() as usize;
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
        1 => any::<u32>().prop_map(Event::Place),
        1 => any::<(u32, u32)>().prop_map(|(branch, onto)| Event::Graft(branch, onto)),
        1 => (0f32..0.9, 0.5f32..3.0).prop_map(|(a, kappa)| Event::Light(a, kappa)),
        2 => any::<(u64, u64)>().prop_map(|(force, hand)| Event::Settle(force, hand)),
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
                Event::Prune(_) | Event::Turn(_) | Event::Place(_) | Event::Graft(..) => {
                    edit(&mut fast, event);
                    edit(&mut plain, event);
                }
                Event::Back(steps) => {
                    let to = fast.plant().step().saturating_sub(steps);
                    fast.go_to(to);
                    plain.go_to(to);
                }
                Event::Settle(force, hand) => {
                    let bit = |bits: u64, step: u32| step == 0 || bits >> (step % 64) & 1 > 0;
                    let claim = |step| Claim { in_force: bit(force, step), by_hand: bit(hand, step) };
                    let claims: Vec<Claim> = (0..=fast.plant().step()).map(claim).collect();
                    fast.stash_future();
                    plain.stash_future();
                    prop_assert_eq!(fast.settle(&claims.clone().into()), plain.settle(&claims.clone().into()));
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
                ids.iter().map(|&id| simulation.plant().metamers().condition(id)).collect()
            };
            prop_assert_eq!(looks(&fast), looks(&plain));
        }
    }
}
