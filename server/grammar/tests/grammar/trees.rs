//! What the turtle draws is wood that growth makes a plant of.

use espalier_grammar::{Drawn, OpenSky, WoodOptions};
use espalier_growth::{ParameterValues, Parameters, transplant};
use espalier_plant::{DormantBuds, Plant, checks};
use glam::Vec3;

use crate::words::derivation;

const OPTIONS: WoodOptions = WoodOptions { nodes: 1_000_000, extent: 10_000, twig_radius: 0.03 };

pub fn drawn(text: &str, depth: u32) -> Drawn {
    derivation(text, depth).1.draw(&OpenSky, OPTIONS).expect("it is small")
}

/// A plant of what is drawn, with every invariant checked in every step of its life.
pub fn planted(drawn: &Drawn) -> Plant {
    let parameters = Parameters::new(ParameterValues::default()).expect("defaults are in range");
    let mut plant = transplant(&drawn.wood, &parameters).expect("it is wood");
    for step in (0..=plant.last_step()).rev() {
        plant.go_to(step);
        assert_eq!(checks::all(&plant), Ok(()), "step {step}");
    }
    plant.go_to(plant.last_step());
    plant
}

/// Nodes as parent, axis and rounded place.
fn nodes(drawn: &Drawn) -> Vec<(Option<u32>, u32, [f32; 3])> {
    drawn
        .wood
        .nodes
        .iter()
        .map(|node| (node.parent, node.axis, (node.end * 100.0).round().to_array()))
        .collect()
}

#[test]
fn brackets_are_laterals_and_lines_go_on() {
    let found = drawn("axiom: F[+(90)FF]F", 0);
    let wanted = [
        (None, 0, [0.0, 0.0, 0.0]),
        (Some(0), 0, [0.0, 100.0, 0.0]),
        (Some(1), 1, [-100.0, 100.0, 0.0]),
        (Some(2), 1, [-200.0, 100.0, 0.0]),
        (Some(1), 0, [0.0, 200.0, 0.0]),
    ];
    assert_eq!(nodes(&found), wanted);
    assert_eq!(found.wood.axes[1].bearer, Some(1));
    let plant = planted(&found);
    assert_eq!((plant.living_count(), plant.living_axes_count()), (4, 2));
}

#[test]
fn long_lines_are_cut_and_short_ones_joined() {
    let found = drawn("axiom: F(4.4)[+(90)F(0.1)F(0.1)F(0.1)F(0.1)]F(0.005)", 0);
    let lengths: Vec<f32> = (found.wood.nodes.iter())
        .filter_map(|node| Some(node.end.distance(found.wood.nodes[node.parent? as usize].end)))
        .collect();
    let wanted = [1.1, 1.1, 1.1, 1.1, 0.3, 0.1];
    assert_eq!(lengths.len(), wanted.len(), "what is shorter than wood can be is left out: {lengths:?}");
    assert!(lengths.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-5), "{lengths:?}");
    planted(&found);
}

#[test]
fn modules_that_grow_are_buds() {
    let text = "buds: grammar\nangle: 40\naxiom: F[+A]F[-FA][&B]F[C]A\nA --> FA\nB --> B\nC --> F";
    let found = drawn(text, 0);
    // The laterals A, FA, B and C, and the trunk; `C` will draw, so that it is a bud as well.
    assert_eq!((found.growing, found.wood.axes.len()), (5, 5));
    assert!(found.wood.axes.iter().all(|axis| axis.has_bud));
    let plant = planted(&found);
    assert_eq!(
        (0..plant.axis_count())
            .filter(|&axis| plant.is_axis_alive(espalier_plant::AxisId::new(axis)))
            .count(),
        5
    );
    // Without apices nothing grows, unless nodes are filled with buds.
    let still = drawn("buds: grammar\naxiom: FF[+(30)F]F", 0);
    assert!(still.wood.axes.iter().all(|axis| !axis.has_bud) && still.wood.buds == DormantBuds::Known);
    let filled = drawn("axiom: FF[+(30)F]F", 0);
    assert!(filled.wood.axes.iter().all(|axis| axis.has_bud) && filled.wood.buds == DormantBuds::Everywhere);
    assert!(planted(&filled).axis_count() > 4);
    // What was cut has no bud in either.
    let cut = drawn("axiom: FF[+(30)FF%FFA]F\nA --> F", 0);
    assert_eq!(cut.wood.axes.iter().map(|axis| axis.has_bud).collect::<Vec<_>>(), [true, false]);
    assert_eq!(cut.wood.nodes.len(), 6);
}

/// What hangs from a stem after each of four quarter rolls, seen from above with north up and east to the right: `/`
/// rolls the turtle to its right, which is counter-clockwise for who looks at it from the front, and `\\` to its left.
#[test]
fn rolls_lead_around_the_stem_to_the_side_of_their_sign() {
    let around = |roll: &str| {
        let text = format!("angle: 90\naxiom: F{}", format!("[&F]{roll}").repeat(4));
        let found = drawn(&text, 0);
        let tip =
            |node: &espalier_plant::WoodNode| (node.end * 100.0).to_array().map(|part| part.round() as i32);
        found.wood.nodes[2..].iter().map(tip).collect::<Vec<_>>()
    };
    let (north, west, south, east) = ([0, 100, -100], [-100, 100, 0], [0, 100, 100], [100, 100, 0]);
    assert_eq!(around("/"), [north, west, south, east]);
    assert_eq!(around("\\"), [north, east, south, west]);
    // A spiral of the golden angle, as phyllotaxis has it: each branch stands as far on as the sign says.
    let found = drawn(&format!("axiom: {}", "F[&(90)F]/(137.5)".repeat(5)), 0);
    let sides: Vec<f32> = (found.wood.axes[1..].iter())
        .map(|axis| {
            let node = |row: u32| found.wood.nodes[row as usize].end;
            let bearer = axis.bearer.expect("a branch");
            let tip = found.wood.nodes.iter().find(|node| node.parent == Some(bearer) && node.axis != 0);
            let side = tip.expect("it has wood").end - node(bearer);
            libm::atan2f(-side.x, -side.z).to_degrees().rem_euclid(360.0)
        })
        .collect();
    for (number, side) in sides.iter().enumerate() {
        let wanted = (137.5 * number as f32).rem_euclid(360.0);
        assert!((side - wanted).abs() < 1e-2, "branch {number}: {side} is not {wanted}");
    }
    assert_eq!(sides.len(), 5);
}

#[test]
fn wood_that_stands_apart_is_a_plant_of_its_own() {
    let found = drawn("axiom: FFf(3)FF[+(90)f(2)F]@M(5,0,0)F", 0);
    let seeds: Vec<Vec3> =
        (found.wood.nodes.iter()).filter(|node| node.parent.is_none()).map(|node| node.end).collect();
    let wanted = [Vec3::ZERO, Vec3::new(0.0, 5.0, 0.0), Vec3::new(-2.0, 7.0, 0.0), Vec3::new(5.0, 0.0, 0.0)];
    assert!(seeds.iter().zip(wanted).all(|(seed, wanted)| seed.distance(wanted) < 1e-5), "{seeds:?}");
    assert_eq!(seeds.len(), 4);
    planted(&found);
    // Several stems from one place, and a gap that is none.
    let stems = drawn("axiom: [+(20)FF][-(20)FF]F@Di(0.05)f@Dd(0.05)F", 0);
    assert_eq!(stems.wood.nodes.iter().filter(|node| node.parent.is_none()).count(), 3);
    planted(&stems);
}

#[test]
fn surfaces_draw_no_wood() {
    let found = drawn("axiom: F[{+(30)F-(60)F}]F", 0);
    assert_eq!(found.wood.nodes.len(), 3);
    planted(&found);
}

#[test]
fn widths_become_radii_and_the_thinnest_is_a_twig() {
    let found = drawn("axiom: !(8)F[+(30)!(2)F]!(4)F", 0);
    let radii: Vec<Option<f32>> = found.wood.nodes.iter().map(|node| node.radius).collect();
    assert_eq!(radii, [None, Some(0.12), Some(0.03), Some(0.06)]);
    let plant = planted(&found);
    assert_eq!(plant.given_radius(espalier_plant::MetamerId::new(1)), Some(0.12));
    let by_twigs = drawn("widths: pipe\naxiom: !(8)F[+(30)!(2)F]!(4)F", 0);
    assert!(by_twigs.wood.nodes.iter().all(|node| node.radius.is_none()));
    // A width that is none is left to the twigs.
    assert_eq!(drawn("axiom: !(0)F!(2)F", 0).wood.nodes[1].radius, None);
}

#[test]
fn steps_of_growth_are_steps_of_the_derivation() {
    let found = drawn("axiom: A\nA --> F[+(50)FA]A", 4);
    let plant = planted(&found);
    assert_eq!(plant.last_step(), 4);
    // 0, 2, 6, 14 and 30 lines after as many steps; none of them is drawn anew.
    assert_eq!(plant.births(), [1, 3, 7, 15, 31]);
    // Where the axiom draws, it is the first step.
    assert_eq!(planted(&drawn("axiom: FA\nA --> FA", 3)).births(), [1, 2, 3, 4, 5]);
    // Steps in which nothing is drawn are steps as well.
    assert_eq!(
        planted(&drawn("axiom: A(0)\nA(n) : n < 3 --> A(n+1)\nA(n) --> FA(0)", 8)).births(),
        [1, 1, 1, 1, 2, 2, 2, 2, 3]
    );
}

#[test]
fn drawing_in_slices_does_not_show() {
    let (_, derivation) = derivation("axiom: A\nA --> F(1.3)[&(50)A]/(90)A", 6);
    let mut drawing = derivation.drawing(OPTIONS);
    while !drawing.advance(&derivation, &OpenSky, 5).expect("it is small") {}
    assert_eq!(drawing.finish(), derivation.draw(&OpenSky, OPTIONS));
}

#[test]
fn nothing_drawn_is_a_seed() {
    let found = drawn("axiom: A\nA --> F", 0);
    assert_eq!(found.wood.nodes.len(), 1);
    assert_eq!(planted(&found).living_count(), 0);
}

#[test]
fn looking_in_a_direction_is_a_frame_with_the_up_that_is_said() {
    // What turns and pitches lead to afterwards shows the whole frame: left is up × heading.
    let end = |turtle: &str| {
        let found = drawn(&format!("axiom: F(1){turtle}F(1)"), 0);
        (found.wood.nodes.last().expect("a line").end - Vec3::Y)
            .to_array()
            .map(|part| (part * 1000.0).round() + 0.0)
    };
    // To the east, with up upwards: left is the north.
    assert_eq!(end("@R(1,0,0,0,1,0)"), [1000.0, 0.0, 0.0]);
    assert_eq!(end("@R(1,0,0,0,1,0)+(90)"), [0.0, 0.0, -1000.0]);
    assert_eq!(end("@R(1,0,0,0,1,0)^(90)"), [0.0, 1000.0, 0.0]);
    assert_eq!(end("@R(1,0,0,0,1,0)&(90)"), [0.0, -1000.0, 0.0]);
    // A length means nothing, and an up that leans is set upright on the heading.
    assert_eq!(end("@R(5,0,0,3,2,0)^(90)"), [0.0, 1000.0, 0.0]);
    // Without an up the turtle's own is kept as far as it can be.
    assert_eq!(end("@R(1,0,0)^(90)"), [0.0, 0.0, 1000.0]);
    // No direction at all, and an up along the heading, are nothing to turn to.
    assert_eq!(end("@R(0,0,0)"), [0.0, 1000.0, 0.0]);
    assert_eq!(end("@R(1,0,0,1,0,0)"), [1000.0, 0.0, 0.0]);
    // After any other turns it is the same.
    assert_eq!(end("+(33)&(12)/(70)@R(0,0,1,0,1,0)^(90)"), [0.0, 1000.0, 0.0]);
}
