//! What rows are made of, in metres, kilogrammes and seconds.

use std::f64::consts::PI;

use glam::DVec3;

use crate::{
    Limbs,
    radii::radii,
    {NONE, Rows},
};

/// Mass of green wood with its water, kg/m³. Species lie between 700 and 1,100.
const WOOD_DENSITY: f64 = 950.0;
/// Mass of a leaf's area, kg/m².
const LEAF_DENSITY: f64 = 0.2;
/// Area of a leaf as a share of its length squared.
pub(crate) const LEAF_FORM: f64 = 0.4;
/// Share of a leaf's area that the wind takes hold of: blades turn out of it.
pub(crate) const LEAF_DRAG: f64 = 0.2;
/// Young's modulus of green wood along the grain, Pa; species lie between 5 and 11 GPa. Each plant's is calibrated.
pub(crate) const STIFFNESS: f64 = 7e9;
/// How much less a rod of wood resists being twisted than being bent: EJ / GJp with E/G = 12 and Jp = 2J.
pub(crate) const TWIST: f64 = 6.0;

/// Lengths that rows are measured in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// Metres in one internode.
    pub internode_length: f64,
    /// Middle length of a leaf, in internodes.
    pub leaf_size: f64,
}

/// The wood and leaves of each row; nothing for seeds and the dead.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wood {
    /// The row each grows from.
    pub(crate) parent: Vec<u32>,
    /// Where each ends, in metres.
    pub(crate) place: Vec<DVec3>,
    /// Its radius on average, in metres.
    pub(crate) radius: Vec<f64>,
    /// Its length, in metres.
    pub(crate) length: Vec<f64>,
    /// Its mass with its leaves, in kg.
    pub(crate) mass: Vec<f64>,
    /// Its area to the wind with its leaves, times the coefficient of drag, in m².
    pub(crate) drag_area: Vec<f64>,
}

impl Wood {
    /// A metamer that goes on in its limb is as thick as both its ends on average; the first of a limb has no end of its
    /// own below.
    pub fn of(rows: &Rows, limbs: &Limbs, scale: &Scale) -> Self {
        let radii = radii(rows.radius.iter().copied().max().unwrap_or(0));
        let radius = |row: usize| scale.internode_length * radii[usize::from(rows.radius[row])];
        let leaf_length = scale.leaf_size * scale.internode_length;
        let leaf_area = LEAF_FORM * leaf_length * leaf_length;
        let mut wood = Self { parent: rows.parent.clone(), ..Self::default() };
        for row in 0..rows.len() {
            let place = rows.place(row) * scale.internode_length;
            let [mut mean, mut length, mut mass, mut drag_area] = [0.0; 4];
            if let Some(limb) = limbs.limb(row as u32) {
                let node = rows.parent[row];
                let below = if limbs.limb(node) == Some(limb) { node as usize } else { row };
                let leaves = f64::from(rows.leaves[row]) * leaf_area;
                mean = 0.5 * (radius(below) + radius(row));
                length = (place - wood.place[node as usize]).length();
                mass = WOOD_DENSITY * PI * mean * mean * length + LEAF_DENSITY * leaves;
                drag_area = 2.0 * mean * length + LEAF_DRAG * leaves;
            }
            wood.place.push(place);
            wood.radius.push(mean);
            wood.length.push(length);
            wood.mass.push(mass);
            wood.drag_area.push(drag_area);
        }
        wood
    }

    /// How many rows there are.
    pub fn len(&self) -> usize {
        self.place.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.place.is_empty()
    }

    /// Where a row's node is at rest, in metres.
    pub fn place(&self, row: u32) -> DVec3 {
        self.place[row as usize]
    }

    /// Mass of a row with its leaves, kg.
    pub fn mass(&self, row: u32) -> f64 {
        self.mass[row as usize]
    }

    /// Drag area of a row with its leaves, m².
    pub fn drag_area(&self, row: u32) -> f64 {
        self.drag_area[row as usize]
    }

    /// How much a row bends under a moment of 1 Nm before calibration, in radians.
    pub fn softness_of(&self, row: u32) -> f64 {
        self.softness(row as usize)
    }

    /// The way from the node below a row to its own, in metres; none for a seed.
    pub(crate) fn way(&self, row: usize) -> DVec3 {
        match self.parent[row] {
            NONE => DVec3::ZERO,
            node => self.place[row] - self.place[node as usize],
        }
    }

    /// The middle of a row.
    pub(crate) fn middle(&self, row: usize) -> DVec3 {
        self.place[row] - 0.5 * self.way(row)
    }

    /// How much a row bends under a moment of 1 Nm, in radians: ℓ/EJ. Seeds and the dead are stiff.
    pub(crate) fn softness(&self, row: usize) -> f64 {
        let squared = self.radius[row] * self.radius[row];
        if squared == 0.0 { 0.0 } else { self.length[row] / (STIFFNESS * (0.25 * PI) * squared * squared) }
    }
}
