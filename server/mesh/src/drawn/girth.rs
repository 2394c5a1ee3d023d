//! Wood as thick as it is drawn. At a fork a limb may lose much of its girth at one node; what goes on takes over some of
//! that and loses it within a radius or two, so that no ledge shows. Twigs, whose internodes are long beside their
//! radii, are as the plant has them. Clients draw the same (`client/src/scene/table/girth.ts`).

use crate::{Limbs, NONE, Rows};

/// Wood that has more girth than it should loses at most this much of its radius over an equal length.
const STEEPEST: f64 = 0.3;
/// Near what it should be it comes to it by and by, over so many of its own radii.
const EASES_OVER: f64 = 0.8;
/// A share of the radius that is too small to be seen.
const UNSEEN: f64 = 0.01;

/// Radii and slopes row by row.
#[derive(Debug, Default)]
pub(super) struct Girth {
    /// In internodes; 0 for the dead and for seeds.
    pub(super) radius: Vec<f32>,
    /// How fast it changes at a node, as a share of itself per internode.
    pub(super) slope: Vec<f32>,
}

impl Girth {
    /// Of rows that have such radii, and such lengths along their limbs.
    pub(super) fn of(rows: &Rows, limbs: &Limbs, own: &[f32], arc: &[f32]) -> Self {
        let mut radius: Vec<f32> = Vec::with_capacity(rows.len());
        for row in 0..rows.len() {
            let below = rows.parent[row];
            let goes_on = rows.is_wood(row) && goes_on(limbs, row as u32, below);
            radius.push(if goes_on {
                let (mine, thick) = (f64::from(own[row]), f64::from(radius[below as usize]));
                let left = excess(thick - mine, f64::from(arc[row]) - f64::from(arc[below as usize]), thick);
                if left < UNSEEN * mine { own[row] } else { (mine + left) as f32 }
            } else {
                own[row]
            });
        }
        let slope = (0..rows.len()).map(|row| incline(rows, limbs, &radius, arc, row)).collect();
        Self { radius, slope }
    }
}

/// Whether a row goes on as the limb of the one below it.
fn goes_on(limbs: &Limbs, row: u32, below: u32) -> bool {
    below != NONE && limbs.limb(below).is_some_and(|limb| limbs.limb(row) == Some(limb))
}

/// The slope that passes smoothly from the metamer below a node to the one above it, and never beyond either.
fn incline(rows: &Rows, limbs: &Limbs, radius: &[f32], arc: &[f32], row: usize) -> f32 {
    let below = rows.parent[row];
    let Some(above) = limbs.onward(row as u32).filter(|_| rows.is_wood(row)) else { return 0.0 };
    // Wood begins as thick as its first node, and ends as its cone or its cut does.
    if !goes_on(limbs, row as u32, below) {
        return 0.0;
    }
    let slope = |from: u32, to: u32| {
        let [from, to] = [from, to].map(|row| row as usize);
        let length = f64::from(arc[to]) - f64::from(arc[from]);
        (f64::from(radius[to]) - f64::from(radius[from])) / length.max(1e-3)
    };
    let (before, after) = (slope(below, row as u32), slope(row as u32, above));
    if before * after > 0.0 {
        ((2.0 * before * after) / (before + after) / f64::from(radius[row])) as f32
    } else {
        0.0
    }
}

/// What is left of too much girth after a length of wood that began with it at such a radius.
fn excess(much: f64, length: f64, radius: f64) -> f64 {
    if much <= 0.0 || length > 10.0 * radius {
        return 0.0;
    }
    let knee = STEEPEST * EASES_OVER * radius;
    let straight = length.min((much - knee).max(0.0) / STEEPEST);
    let left = much - STEEPEST * straight;
    left * libm::exp((straight - length) / (EASES_OVER * radius))
}
