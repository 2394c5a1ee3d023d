//! Selective growth (TreeSketch §3.2, Figure 9): one chosen branch grows, everyone keeps their place.

use espalier_plant::{AxisId, Plant};

use super::*;

/// A small crown to choose in.
fn crown() -> Simulation {
    let mut simulation = simulation(9);
    grow(&mut simulation, 6);
    simulation
}

fn is_borne_on(plant: &Plant, mut axis: AxisId, chosen: AxisId) -> bool {
    loop {
        if axis == chosen {
            return true;
        }
        match plant.axes().bearer(axis) {
            Some(bearer) => axis = plant.metamers().axis(bearer),
            None => return false,
        }
    }
}

/// A living axis of first order that has grown and whose tip is highest.
fn lobe(simulation: &Simulation) -> AxisId {
    let plant = simulation.plant();
    (0..plant.axis_count())
        .map(AxisId::new)
        .filter(|&axis| plant.is_axis_alive(axis) && plant.axes().order(axis) == 1 && plant.has_grown(axis))
        .max_by(|&a, &b| plant.bud_position(a).y.total_cmp(&plant.bud_position(b).y))
        .expect("a tree of six steps has limbs")
}

/// The first metamer of an axis: all of it and what it bears is above.
fn first(simulation: &Simulation, axis: AxisId) -> Option<MetamerId> {
    simulation.plant().axes().first(axis)
}

fn sphere_of_brush(centre: Vec3, radius: f32, chosen: Option<MetamerId>) -> StepInput {
    let samples = vec![BrushSample { position: centre, radius }];
    StepInput { pieces: vec![BrushPiece { stroke: StrokeId(1), samples }], chosen, ..StepInput::default() }
}

fn check_only_the_chosen_grew(name: &str, input: impl Fn(Option<MetamerId>, Vec3) -> StepInput) {
    let mut simulation = crown();
    let chosen = lobe(&simulation);
    let before = simulation.plant().metamer_count();
    for _ in 0..4 {
        let tip = simulation.plant().bud_position(chosen);
        simulation.step(&input(first(&simulation, chosen), tip), &mut NoObserver);
    }
    let plant = simulation.plant();
    let grown = before..plant.metamer_count();
    assert!(grown.len() > 3, "{name}: the chosen branch grew {}", grown.len());
    for id in grown.map(MetamerId::new) {
        assert!(is_borne_on(plant, plant.metamers().axis(id), chosen), "{name}: {id:?} is on another branch");
    }
    let mut freely = crown();
    let tip = freely.plant().bud_position(chosen);
    freely.step(&input(None, tip), &mut NoObserver);
    let plant = freely.plant();
    let elsewhere = (before..plant.metamer_count())
        .map(MetamerId::new)
        .filter(|&id| !is_borne_on(plant, plant.metamers().axis(id), chosen))
        .count();
    assert!(elsewhere > 0, "{name}: without a choice others grow too");
}

#[test]
fn only_the_chosen_branch_is_brushed() {
    check_only_the_chosen_grew("brush", |chosen, tip| sphere_of_brush(tip, 12.0, chosen));
}

#[test]
fn only_the_chosen_branch_grows_by_itself() {
    check_only_the_chosen_grew("autonomous", |chosen, _| StepInput {
        autonomous: true,
        chosen,
        ..StepInput::default()
    });
}

#[test]
fn buds_not_chosen_still_clear_markers() {
    let mut simulation = crown();
    let chosen = lobe(&simulation);
    let base = simulation.plant().metamers().end(simulation.plant().bud_node(AxisId::new(0)));
    let chosen = first(&simulation, chosen);
    simulation.step(&sphere_of_brush(base, 6.0, chosen), &mut NoObserver);
    let radius = simulation.parameters().occupancy_radius;
    // Markers were cleared before this step's growth, so the nodes that stood before count.
    let nodes = nodes(&crown());
    assert!(!simulation.markers().is_empty());
    for marker in simulation.markers() {
        assert!(nodes.iter().all(|node| node.distance(marker.position) > radius));
    }
}

#[test]
fn choosing_what_is_gone_grows_nothing() {
    let mut simulation = crown();
    let present = simulation.plant().metamer_count();
    for chosen in [MetamerId::new(present), MetamerId::new(present + 1000)] {
        let input = StepInput { autonomous: true, chosen: Some(chosen), ..StepInput::default() };
        assert_eq!(simulation.step(&input, &mut NoObserver).metamers_grown, 0);
    }
    let chosen = lobe(&simulation);
    let birth = simulation.plant().axis_birth(chosen);
    let chosen = first(&simulation, chosen);
    simulation.go_to(birth - 1);
    let input = StepInput { autonomous: true, chosen, ..StepInput::default() };
    assert_eq!(simulation.step(&input, &mut NoObserver).metamers_grown, 0);
}

#[test]
fn a_sketch_starts_at_the_chosen_branch() {
    let mut simulation = crown();
    let chosen = lobe(&simulation);
    let tip = simulation.plant().bud_position(chosen);
    let before = simulation.plant().metamer_count();
    for i in 0..4 {
        let at = |t: f32| BrushSample { position: tip + Vec3::new(1.0, 1.0, 0.0) * t, radius: 0.0 };
        let samples = vec![at(3.0 * i as f32), at(3.0 * (i + 1) as f32)];
        let piece = BrushPiece { stroke: StrokeId(1), samples };
        let input =
            StepInput { pieces: vec![piece], chosen: first(&simulation, chosen), ..StepInput::default() };
        simulation.step(&input, &mut NoObserver);
    }
    let plant = simulation.plant();
    assert!(plant.metamer_count() > before + 5);
    for id in (before..plant.metamer_count()).map(MetamerId::new) {
        assert!(is_borne_on(plant, plant.metamers().axis(id), chosen));
    }
}

#[test]
fn what_lies_below_the_chosen_node_rests() {
    let mut simulation = crown();
    let plant = simulation.plant();
    let trunk: Vec<MetamerId> = (0..plant.metamer_count())
        .map(MetamerId::new)
        .filter(|&id| plant.metamers().axis(id) == AxisId::new(0))
        .collect();
    let middle = trunk[trunk.len() / 2];
    let before = plant.metamer_count();
    for _ in 0..4 {
        let input = StepInput { autonomous: true, chosen: Some(middle), ..StepInput::default() };
        simulation.step(&input, &mut NoObserver);
    }
    let plant = simulation.plant();
    assert!(plant.metamer_count() > before + 20);
    for id in (before..plant.metamer_count()).map(MetamerId::new) {
        let mut below = std::iter::successors(Some(id), |&id| plant.metamers().parent(id));
        assert!(below.any(|id| id == middle), "{id:?} grew below the chosen node");
    }
}
