//! Where wood is drawn, as clients draw it (`client/src/scene/table/course.ts`, `client/src/scene/glsl/branch.ts`).
//!
//! What is known of a tree are its nodes; where its girth is large for how sharply they turn, a tube through them would
//! fold through itself, so that it runs along a curve beside them. Wood goes along limbs: at a fork it continues into
//! what is thickest, whichever axis that belongs to. `golden/course.json` holds both languages to the same places.

pub(crate) mod course;
pub(crate) mod curve;
mod frames;
mod girth;
#[cfg(test)]
mod golden_tests;
mod limb_curve;

use glam::{DVec3, Vec3};

use self::{girth::Girth, limb_curve::LimbCurve};
pub(crate) use limb_curve::RISES;

use crate::{Limb, Limbs, Rows};

/// How wood is shaped.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    /// How far trunks spread at their feet.
    pub root_flare: f32,
    /// Whether wood may leave its nodes where it would fold.
    pub is_rounded: bool,
}

/// What is drawn of each row.
#[derive(Debug, Default)]
pub(crate) struct Drawn {
    /// Where its node is; of the dead where it was.
    pub places: Vec<Vec3>,
    /// Unit vector across which its ring lies.
    pub directions: Vec<Vec3>,
    /// Unit vector across that, from which turns around the wood are counted.
    pub normals: Vec<Vec3>,
    /// Length along the limb from where it begins, along what is drawn.
    pub arc: Vec<f32>,
    /// How thick the wood is there, without what spreads at a foot.
    pub radii: Vec<f32>,
    /// How fast that changes, as a share of itself per internode.
    pub slopes: Vec<f32>,
}

impl Drawn {
    /// Of rows at such places and so thick.
    pub(crate) fn of(rows: &Rows, limbs: &Limbs, places: &[Vec3], radii: &[f32], shape: Shape) -> Self {
        let Girth { radius, slope } = Girth::of(rows, limbs, radii, &arcs(rows, limbs, places));
        let mut drawn = Self {
            places: places.to_vec(),
            directions: vec![Vec3::Y; rows.len()],
            normals: vec![frames::any(Vec3::Y); rows.len()],
            arc: vec![0.0; rows.len()],
            radii: radius,
            slopes: slope,
        };
        let mut curve = LimbCurve::default();
        for (number, limb) in (0..).zip(limbs.all()) {
            drawn.draw(&mut curve, limb, (limbs, limbs.rows(number)), places, shape);
        }
        drawn
    }

    /// Draws a limb, whose bearer is drawn already.
    fn draw(
        &mut self,
        curve: &mut LimbCurve,
        limb: &Limb,
        (limbs, rows): (&Limbs, &[u32]),
        places: &[Vec3],
        shape: Shape,
    ) {
        let origin = limb.node as usize;
        let rises = limb.bearer.is_none();
        curve.clear();
        // Wood begins as thick as its first node.
        curve.push(places[origin].as_dvec3(), f64::from(self.radii[limb.first as usize]));
        for &row in rows {
            curve.push(places[row as usize].as_dvec3(), f64::from(self.radii[row as usize]));
        }
        if rises {
            spread(curve, f64::from(shape.root_flare));
            curve.fit(DVec3::ZERO, 0.0, rises, shape.is_rounded);
            // A seed looks as the first trunk that it bears does.
            if limbs.onward(limb.node) == Some(limb.first) {
                self.directions[origin] = curve.directions[0].as_vec3();
                self.normals[origin] = frames::any(self.directions[origin]);
            }
        } else {
            let offset = self.places[origin].as_dvec3() - places[origin].as_dvec3();
            curve.fit(offset, f64::from(self.radii[origin]), rises, shape.is_rounded);
        }
        let (mut below, mut length) = (origin, 0.0);
        for (i, &row) in (1..).zip(rows) {
            let at = row as usize;
            self.places[at] = curve.places[i].as_vec3();
            self.directions[at] = curve.directions[i].as_vec3();
            length += self.places[at].as_dvec3().distance(self.places[below].as_dvec3());
            self.arc[at] = length as f32;
            self.normals[at] = self.normal([below, at], rises && i == 1, i > 1);
            below = at;
        }
    }

    /// The normal of a row above another one; one that begins a limb keeps its bearer's as far as it can.
    fn normal(&self, [below, row]: [usize; 2], from_seed: bool, goes_on: bool) -> Vec3 {
        let direction = self.directions[row];
        if from_seed {
            return frames::any(direction);
        }
        let normal = self.normals[below];
        let carried = if goes_on {
            let step = self.places[row] - self.places[below];
            frames::transported(normal, step, [self.directions[below], direction])
        } else {
            normal
        };
        frames::across(carried, direction)
    }
}

/// Roots make a foot as thick for a fold as the wood they spread from.
fn spread(curve: &mut LimbCurve, flare: f64) {
    let foot = curve.radii[0] + 0.05;
    let along = curve.measure().to_vec();
    for (radius, along) in curve.radii.iter_mut().zip(along) {
        let height = along / foot;
        *radius *= 1.0 + flare * (0.22 * libm::exp(-0.7 * height) + 0.5 * libm::exp(-1.6 * height));
    }
}

/// Lengths along limbs, from node to node.
fn arcs(rows: &Rows, limbs: &Limbs, places: &[Vec3]) -> Vec<f32> {
    let mut arcs = vec![0.0; rows.len()];
    for (number, limb) in (0..).zip(limbs.all()) {
        let mut below = limb.node as usize;
        let mut reached = 0.0f32;
        for &row in limbs.rows(number) {
            let length = places[row as usize].as_dvec3().distance(places[below].as_dvec3());
            reached = (length + f64::from(reached)) as f32;
            arcs[row as usize] = reached;
            below = row as usize;
        }
    }
    arcs
}
