//! Beams bend as theory has it, and trees in balance.

use std::f64::consts::PI;

use espalier_motion::statics::{deflections, in_even_wind};
use glam::DVec3;

use crate::trees::{pole, unlike};

const STIFFNESS: f64 = 7e9;
const RADIUS: f64 = 0.5;

fn fourth(x: f64) -> f64 {
    x * x * x * x
}

/// A pole of three metres, its flexural rigidity and its length.
fn beam(pieces: u32) -> (crate::trees::Tree, f64, f64) {
    let tree = pole(pieces, [0, (30 * 256 / pieces) as i32, 0], |_| RADIUS);
    // The radius as its code has it.
    let radius = 0.1 * f64::from(espalier_mesh::radius_code::decode(crate::trees::code(RADIUS)));
    (tree, STIFFNESS * 0.25 * PI * fourth(radius), 3.0)
}

#[test]
fn a_cantilever_bends_by_wl4_over_8ej_under_an_even_load() {
    for (pieces, tolerance) in [(10, 5e-3), (20, 2e-3), (30, 1e-3)] {
        let (tree, rigidity, length) = beam(pieces);
        let weights = vec![100.0 / f64::from(pieces); tree.rows.len()];
        let weights: Vec<f64> =
            weights.into_iter().enumerate().map(|(row, w)| if row == 0 { 0.0 } else { w }).collect();
        let tip = deflections(&tree.wood, &weights, DVec3::X)[pieces as usize];
        let load = 100.0 / length;
        let shift = load * fourth(length) / (8.0 * rigidity);
        assert!((tip.shift.x / shift - 1.0).abs() < tolerance, "{pieces}: {} for {shift}", tip.shift.x);
        let turn = load * length * length * length / (6.0 * rigidity);
        assert!((-tip.turn.z / turn - 1.0).abs() < 1e-4, "{pieces}: {} for {turn}", tip.turn.z);
    }
}

#[test]
fn a_load_at_the_tip_of_a_cone_bends_it_as_theory_has_it() {
    // A cone cut off at half its radius: y = PL³ / 3EJ₀ · (r₀ / r₁) for a load at the tip.
    let tree = pole(60, [0, 128, 0], |at| RADIUS * (1.0 - 0.5 * at));
    let mut weights = vec![0.0; 61];
    weights[60] = 1.0;
    let tip = deflections(&tree.wood, &weights, DVec3::X)[60];
    let exact = 27.0 / (3.0 * STIFFNESS * 0.25 * PI * fourth(0.1 * RADIUS)) * 2.0;
    assert!((tip.shift.x / exact - 1.0).abs() < 0.03, "{} for {exact}", tip.shift.x);
}

#[test]
fn a_crank_is_twisted() {
    // A load at the end of a level arm twists the pole that bears it six times as far as it would bend it.
    let tree = pole(20, [0, 256, 0], |_| RADIUS);
    let mut rows: Vec<_> = (0..21).map(|row| tree.rows.row(row)).collect();
    let tip = rows[20];
    rows.push(espalier_motion::Row { parent: Some(20), position: [512, tip.position[1], 0], ..tip });
    let tree = crate::trees::Tree::of(
        "crank",
        espalier_motion::Rows::new(rows).expect("it stands on the pole"),
        tree.scale,
    );
    let mut weights = vec![0.0; 22];
    weights[21] = 1.0;
    let at_elbow = deflections(&tree.wood, &weights, DVec3::Z)[20].turn;
    // The load acts in the middle of the arm, 0.1 m out, over 2 m of pole.
    let rigidity =
        STIFFNESS * 0.25 * PI * fourth(0.1 * f64::from(espalier_mesh::radius_code::decode(tip.radius)));
    let twist = 6.0 * 0.1 * 2.0 / rigidity;
    assert!((at_elbow.y / -twist - 1.0).abs() < 1e-6, "{} for {twist}", at_elbow.y);
}

#[test]
fn turns_of_grown_trees_are_those_of_each_row_s_own_balance() {
    // The definition, row by row: the moment of everything above about the row's middle. Quadratic, so on one row in 50.
    for tree in unlike() {
        let wind = DVec3::new(3.0, 0.5, -2.0);
        let found = in_even_wind(&tree.wood, wind);
        let count = tree.rows.len();
        for row in (1..count).step_by(50) {
            let Some(parent) = tree.rows.row(row as u32).parent else { continue };
            let node = tree.wood.place(row as u32);
            let way = node - tree.wood.place(parent);
            let mut is_above = vec![false; count];
            let mut moment = DVec3::ZERO;
            for above in row + 1..count {
                let Some(parent) = tree.rows.row(above as u32).parent else { continue };
                is_above[above] = parent as usize == row || is_above[parent as usize];
                if is_above[above] {
                    let middle = 0.5 * (tree.wood.place(parent) + tree.wood.place(above as u32));
                    moment += (middle - (node - 0.5 * way)).cross(tree.wood.drag_area(above as u32) * wind);
                }
            }
            moment += way.cross(tree.wood.drag_area(row as u32) * wind) / 6.0;
            let turn = found[row].turn - found[parent as usize].turn;
            let along = way.normalize_or_zero();
            let exact = tree.wood.softness_of(row as u32) * (moment + 5.0 * along * along.dot(moment));
            assert!(
                turn.distance(exact) <= 1e-9 * exact.length() + 1e-15,
                "{} row {row}: {turn} for {exact}",
                tree.name
            );
        }
    }
}
