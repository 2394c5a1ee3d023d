//! What lies on trees and bends them: more of their own weight, snow, rain.

use glam::DVec3;

use crate::{
    Limbs, Rows,
    joints::Joints,
    statics::deflections,
    wood::{LEAF_DRAG, LEAF_FORM, Scale, Wood},
};

const GRAVITY: f64 = 9.81;
/// Fresh snow, kg/m³.
const SNOW_DENSITY: f64 = 100.0;
/// A film of 0.2 mm on leaves that rain has wetted, kg/m².
const FILM: f64 = 0.2;
/// Share of a leaf's area that snow lies on: blades overlap, and not all are level.
const LEVEL: f64 = 0.35;
/// Cosines of the slopes on which snow begins to slide off wood, and on which none stays: 40° and 55°.
const HOLDS: f64 = 0.77;
const SLIDES: f64 = 0.57;

/// How much lies on trees.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Loading {
    /// How much more they weigh than they grew under: 1 is their own weight once more.
    pub sag: f64,
    /// How deep fresh snow lies, m.
    pub snow: f64,
    /// From dry leaves, 0, to wet ones.
    pub rain: f64,
}

/// How each joint turns under all of it, radians: the part that its shape can show. Nothing where nothing lies on trees.
pub fn turns(
    rows: &Rows,
    limbs: &Limbs,
    wood: &Wood,
    joints: &Joints,
    scale: &Scale,
    loading: &Loading,
) -> Vec<DVec3> {
    if *loading == Loading::default() {
        return Vec::new();
    }
    let masses = masses(rows, wood, scale, loading);
    let turned: Vec<DVec3> =
        deflections(wood, &masses, DVec3::NEG_Y * GRAVITY).into_iter().map(|row| row.turn).collect();
    let of_joint = |joint: &crate::Joint| {
        let (mut sum, mut squares) = (DVec3::ZERO, 0.0);
        for &row in limbs.rows(joint.limb) {
            let weight = joints.rides()[row as usize].weight;
            let counts = wood.length[row as usize] * weight;
            squares += counts * weight;
            sum += counts * (turned[row as usize] - turned[joint.node as usize]);
        }
        if squares > 0.0 { sum * (joint.softness / squares) } else { DVec3::ZERO }
    };
    joints.all().iter().map(of_joint).collect()
}

/// What it weighs on each row, kg.
fn masses(rows: &Rows, wood: &Wood, scale: &Scale, loading: &Loading) -> Vec<f64> {
    let leaf_length = scale.leaf_size * scale.internode_length;
    let of_row = |row: usize| {
        let long = wood.length[row];
        if long <= 0.0 {
            return 0.0;
        }
        let leaves = f64::from(rows.leaves[row]) * LEAF_FORM * leaf_length * leaf_length;
        let way = wood.way(row);
        let level = (way.x * way.x + way.z * way.z).sqrt() / long;
        let holds = ((level - SLIDES) / (HOLDS - SLIDES)).clamp(0.0, 1.0);
        let bare = (wood.drag_area[row] - LEAF_DRAG * leaves).max(0.0);
        let snow = SNOW_DENSITY * (bare * level * holds + LEVEL * leaves);
        loading.sag * wood.mass[row] + loading.snow * snow + loading.rain * FILM * leaves
    };
    (0..wood.len()).map(of_row).collect()
}
