//! Which constraints lie above which, and the wood between them.

use super::Width;
use crate::{girth::Girth, id::MetamerId, plant::Plant};

/// Nothing is drawn wider, in internodes: a radius stays finite however many such wood bears.
const WIDEST: f32 = 1e6;
/// A twig without any width would have no logarithm.
const THINNEST_TWIG: f32 = 1e-6;

/// A constrained metamer, or one that bears constraints.
pub(super) struct Special {
    pub metamer: MetamerId,
    /// The constraint on it, by its place in birth order; a subtree has the number of the constraint at its root.
    pub constraint: Option<usize>,
    /// The subtree that it is part of; a constrained one, the root of its own, is a leaf of that below.
    pub within: usize,
    /// The special metamer that it grows from; none at the base of a trunk.
    pub parent: Option<usize>,
    /// Tips above it, without those above further constraints.
    pub tips: u32,
}

/// The constraints of a plant.
pub(super) struct Nesting {
    /// In birth order.
    pub constraints: Vec<Width>,
    /// In birth order. No other metamer bears a constraint.
    pub specials: Vec<Special>,
}

impl Nesting {
    pub(super) fn of(plant: &Plant, wanted: &[(MetamerId, f32)], girth: &Girth) -> Self {
        debug_assert!(wanted.is_sorted_by(|a, b| a.0 < b.0), "constraints are in birth order");
        let wanted: Vec<_> =
            wanted.iter().copied().filter(|&(id, _)| plant.is_alive(id) && !plant.is_seed(id)).collect();
        if wanted.is_empty() {
            return Self { constraints: Vec::new(), specials: Vec::new() };
        }
        let mut specials = specials(plant, &wanted);
        let mut constraints: Vec<Width> =
            wanted.iter().map(|&(metamer, wanted)| Width { metamer, wanted, effective: 0.0 }).collect();
        raise(&mut specials, &mut constraints, girth);
        Self { constraints, specials }
    }

    /// The number of the subtree below all constraints.
    pub(super) fn base(&self) -> usize {
        self.constraints.len()
    }

    /// ln of the radius at the root of a constraint's subtree.
    pub(super) fn log_root(&self, constraint: usize) -> f64 {
        log(0.5 * self.constraints[constraint].effective)
    }

    /// The subtrees of all metamers from the first constrained one on; each root belongs to its own.
    pub(super) fn subtrees(&self, plant: &Plant, first: usize) -> Vec<u32> {
        let parents = plant.columns(first..plant.metamer_count()).parent;
        let mut subtrees = Vec::with_capacity(parents.len());
        let mut roots =
            self.constraints.iter().map(|width| width.metamer.index() - first).zip(0..).peekable();
        for (row, parent) in parents.iter().enumerate() {
            // The parent of a seed lies beyond all rows.
            let inherited =
                parent.index().checked_sub(first).and_then(|parent| subtrees.get(parent).copied());
            let own = roots.next_if(|&(root, _)| root == row).map(|(_, constraint)| constraint);
            subtrees.push(own.or(inherited).unwrap_or(self.base() as u32));
        }
        subtrees
    }
}

/// ln of the radius of a twig's tip.
pub(super) fn log_twig(girth: &Girth) -> f64 {
    log(twig_radius(girth))
}

fn twig_radius(girth: &Girth) -> f32 {
    girth.twig_radius().clamp(THINNEST_TWIG, 0.5 * WIDEST)
}

fn log(radius: f32) -> f64 {
    libm::log(f64::from(radius))
}

/// The special metamers and how they hang together.
fn specials(plant: &Plant, wanted: &[(MetamerId, f32)]) -> Vec<Special> {
    // One more than the place of each special metamer.
    let mut places = vec![0u32; plant.metamer_count()];
    let mut rows: Vec<MetamerId> = wanted.iter().map(|&(id, _)| id).collect();
    for id in &rows {
        places[id.index()] = 1;
    }
    for &(id, _) in wanted {
        let mut at = plant.metamers().parent(id);
        while let Some(id) = at.filter(|&id| !plant.is_seed(id) && places[id.index()] == 0) {
            places[id.index()] = 1;
            rows.push(id);
            at = plant.metamers().parent(id);
        }
    }
    rows.sort_unstable();
    let mut constrained = wanted.iter().map(|&(id, _)| id).enumerate().peekable();
    let mut specials: Vec<Special> = Vec::with_capacity(rows.len());
    for (place, &metamer) in rows.iter().enumerate() {
        places[metamer.index()] = place as u32 + 1;
        let below = plant.metamers().parent(metamer).map_or(0, |parent| places[parent.index()]);
        let parent = (below as usize).checked_sub(1);
        let within = parent.map_or(wanted.len(), |parent| {
            let parent = &specials[parent];
            parent.constraint.unwrap_or(parent.within)
        });
        let constraint = constrained.next_if(|&(_, id)| id == metamer).map(|(constraint, _)| constraint);
        let tips = plant.metamers().tips(metamer);
        specials.push(Special { metamer, constraint, within, parent, tips });
    }
    specials
}

/// Takes off the tips that belong to further subtrees, and widens what is thinner than what it bears.
fn raise(specials: &mut [Special], constraints: &mut [Width], girth: &Girth) {
    let mut taken = vec![0; specials.len()];
    let mut thickest = vec![2.0 * twig_radius(girth); specials.len()];
    for (at, special) in specials.iter_mut().enumerate().rev() {
        let (all_tips, mut leaf) = (special.tips, thickest[at]);
        special.tips = all_tips.saturating_sub(taken[at]);
        let mut gone = taken[at];
        if let Some(of) = special.constraint {
            let width = &mut constraints[of];
            // Written so that what is no number counts as no wish.
            width.effective = width.wanted.max(leaf).min(WIDEST);
            (leaf, gone) = (width.effective, all_tips);
        }
        if let Some(parent) = special.parent {
            thickest[parent] = leaf.max(thickest[parent]);
            taken[parent] += gone;
        }
    }
}
