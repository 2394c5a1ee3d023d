//! Radii under width constraints (TreeSketch §3.3, figure 13).
//!
//! Constraints cut the wood into subtrees. The root of one is a constrained metamer, or the base of a trunk; its
//! leaves are twig tips, those of shed branches included, and the constrained metamers above. Above each
//! constraint the exponent n of d^n = Σ d_i^n is the one that gives its root the diameter asked for; at the base
//! it is the parameter. Where there is none between 1 and 8, radii are fitted otherwise (see `fit`), and no
//! constraint makes wood thinner than what it bears.
//!
//! A radius that is [given](crate::given) stays as it is, unless a constraint is on the same metamer. To what
//! bears such wood it is a leaf, and what grows on it follows from its tips.
//!
//! Sums of powers are kept as logarithms of radii: a metamer that bears no constraint has ln r = ln r_e + ln t / n
//! for its t tips, so that a pass over all wood computes no power.

mod fit;
mod logarithms;
mod nesting;
mod taper;

use self::{
    fit::{Fit, Leaves},
    logarithms::Logarithms,
    nesting::{Nesting, Role},
};
use crate::{girth::Girth, id::MetamerId, plant::Plant};

/// In place of a logarithm: the radius follows from the tips alone.
const BY_TIPS: f32 = f32::NAN;

/// One width constraint in force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Width {
    /// The metamer that it holds.
    pub metamer: MetamerId,
    /// The diameter asked for, in internodes.
    pub wanted: f32,
    /// The diameter at the metamer's node: larger where a twig or a constraint above is thicker than what is wanted.
    pub effective: f32,
}

/// The radii of a plant's living metamers.
#[derive(Clone, Debug)]
pub struct Widths<'a> {
    plant: &'a Plant,
    girth: &'a Girth,
    constraints: Vec<Width>,
    /// For each metamer ln of its radius, or [`BY_TIPS`]; empty without constraints and given radii.
    logs: Vec<f32>,
}

/// The plant's constraints in force, in birth order: what is wanted and what comes of it.
pub fn in_force(plant: &Plant, girth: &Girth) -> Vec<Width> {
    let wanted: Vec<_> = plant.widths().collect();
    Nesting::of(plant, &wanted, girth).constraints
}

impl<'a> Widths<'a> {
    /// The radii of the present under the plant's own constraints. Without any it costs nothing.
    pub fn of(plant: &'a Plant, girth: &'a Girth) -> Self {
        let wanted: Vec<_> = plant.widths().collect();
        Self::solve(plant, &wanted, girth)
    }

    /// The radii of the present with these diameters of metamers, which are in birth order. Seeds and the dead
    /// have none, so theirs are passed over.
    pub fn solve(plant: &'a Plant, wanted: &[(MetamerId, f32)], girth: &'a Girth) -> Self {
        let nesting = Nesting::of(plant, wanted, girth);
        let Some(first) = nesting.first() else {
            return Self { plant, girth, constraints: Vec::new(), logs: Vec::new() };
        };
        let logs = logs(plant, first.index(), &nesting, &fits(&nesting, girth));
        Self { plant, girth, constraints: nesting.constraints, logs }
    }

    /// Radius in internodes of a living metamer at its node.
    pub fn radius(&self, id: MetamerId) -> f32 {
        match self.log_radius(id) {
            Some(log) => libm::expf(log),
            None => self.girth.radius(self.plant.metamers().tips(id)),
        }
    }

    /// Natural logarithm of the same; none where the radius follows from the tips alone, by the [`Girth`].
    pub fn log_radius(&self, id: MetamerId) -> Option<f32> {
        self.logs.get(id.index()).copied().filter(|log| !log.is_nan())
    }

    /// Whether all radii follow from the tips alone, by the [`Girth`].
    pub fn follow_from_tips(&self) -> bool {
        self.logs.is_empty()
    }

    /// The constraints, in birth order.
    pub fn constraints(&self) -> &[Width] {
        &self.constraints
    }

    /// The diameter that a constrained metamer has.
    pub fn effective(&self, id: MetamerId) -> Option<f32> {
        let at = self.constraints.binary_search_by_key(&id, |width| width.metamer).ok()?;
        Some(self.constraints[at].effective)
    }
}

/// How each constraint's subtree is fitted, and behind these the base.
fn fits(nesting: &Nesting, girth: &Girth) -> Vec<Fit> {
    let twig = nesting::log_twig(girth);
    let none = || Leaves { tips: 0, twig, others: Vec::new() };
    let mut leaves: Vec<_> = nesting.constraints.iter().map(|_| none()).chain([none()]).collect();
    for special in &nesting.specials {
        match special.role {
            Role::Constrained(of) => {
                leaves[of].tips = special.tips;
                leaves[special.within].others.push(nesting.log_root(of));
            }
            Role::Given(log) => leaves[special.within].others.push(log),
            Role::Bearer => {}
        }
    }
    let fit = |(subtree, leaves)| match subtree {
        subtree if subtree == nesting.base() => {
            Fit::by_exponent(leaves, 1.0 / f64::from(girth.inverse_exponent()))
        }
        subtree => Fit::to_root(leaves, nesting.log_root(subtree)),
    };
    leaves.iter().enumerate().map(fit).collect()
}

/// Logarithms of all radii; `first` is the row of the first constraint or given radius.
fn logs(plant: &Plant, first: usize, nesting: &Nesting, fits: &[Fit]) -> Vec<f32> {
    let count = plant.metamer_count();
    let mut logs = vec![BY_TIPS; count];
    let subtrees = nesting.subtrees(plant, first);
    let rise = taper::rise(plant, first, &subtrees, |subtree| fits[subtree].tapers());
    let rise_of =
        |row: usize| row.checked_sub(first).and_then(|at| rise.get(at)).copied().unwrap_or_default();
    // Wood that bears no constraint.
    let logarithms = Logarithms::get();
    let tips = plant.columns(first..count).tips;
    for (row, (&subtree, &tips)) in (first..).zip(subtrees.iter().zip(tips)) {
        if subtree as usize != nesting.base() {
            logs[row] = fits[subtree as usize].of_tips(logarithms.of(tips), rise_of(row));
        }
    }
    for &(id, radius) in &nesting.given {
        logs[id.index()] = nesting::log(radius) as f32;
    }
    // Wood that bears some, tips first.
    let mut sums = vec![0.0; nesting.specials.len()];
    for (at, special) in nesting.specials.iter().enumerate().rev() {
        let (row, fit) = (special.metamer.index(), &fits[special.within]);
        let passed_on = match special.role {
            Role::Constrained(of) => {
                logs[row] = nesting.log_root(of) as f32;
                fit.weight(nesting.log_root(of))
            }
            Role::Given(log) => fit.weight(log),
            Role::Bearer => {
                logs[row] = fit.of_sum(special.tips, sums[at], rise_of(row));
                sums[at]
            }
        };
        if let Some(parent) = special.parent {
            sums[parent] += passed_on;
        }
    }
    logs
}
