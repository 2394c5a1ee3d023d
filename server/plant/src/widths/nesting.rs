//! Which constraints lie above which, and the wood between them.

use super::Width;
use crate::{girth::Girth, id::MetamerId, plant::Plant};

/// Nothing is drawn wider, in internodes: a radius stays finite however many such wood bears.
const WIDEST: f32 = 1e6;
/// A twig without any width would have no logarithm.
const THINNEST_TWIG: f32 = 1e-6;

/// What a special metamer is.
#[derive(Clone, Copy)]
pub(super) enum Role {
    /// It is constrained, by the constraint with this place in birth order; a subtree has the number of the
    /// constraint at its root.
    Constrained(usize),
    /// Its radius is given: ln of it.
    Given(f64),
    /// It bears some of these.
    Bearer,
}

/// A constrained metamer, the lowest one of a given radius, or one that bears such.
pub(super) struct Special {
    pub metamer: MetamerId,
    pub role: Role,
    /// The subtree that it is part of; a constrained one, the root of its own, is a leaf of that below, as is one
    /// of a given radius.
    pub within: usize,
    /// The special metamer that it grows from; none at the base of a trunk, or on wood of a given radius.
    pub parent: Option<usize>,
    /// Tips above it, without those above further constraints and given radii.
    pub tips: u32,
}

/// The constraints of a plant.
pub(super) struct Nesting {
    /// In birth order.
    pub constraints: Vec<Width>,
    /// In birth order. No other metamer bears a constraint without wood of a given radius between.
    pub specials: Vec<Special>,
    /// Living metamers with radii given and no constraint on them, in birth order, and their radii.
    pub given: Vec<(MetamerId, f32)>,
}

impl Nesting {
    pub(super) fn of(plant: &Plant, wanted: &[(MetamerId, f32)], girth: &Girth) -> Self {
        debug_assert!(wanted.is_sorted_by(|a, b| a.0 < b.0), "constraints are in birth order");
        let wanted: Vec<_> =
            wanted.iter().copied().filter(|&(id, _)| plant.is_alive(id) && !plant.is_seed(id)).collect();
        let is_free = |id: &MetamerId| wanted.binary_search_by_key(id, |&(id, _)| id).is_err();
        let drawn = |(id, radius): (MetamerId, f32)| (id, radius.clamp(THINNEST_TWIG, 0.5 * WIDEST));
        let given = plant.given_radii().filter(|(id, _)| !plant.is_seed(*id) && is_free(id));
        let given: Vec<_> = given.map(drawn).collect();
        if wanted.is_empty() && given.is_empty() {
            return Self { constraints: Vec::new(), specials: Vec::new(), given };
        }
        let mut specials = specials(plant, &wanted, &given);
        let mut constraints: Vec<Width> =
            wanted.iter().map(|&(metamer, wanted)| Width { metamer, wanted, effective: 0.0 }).collect();
        raise(&mut specials, &mut constraints, girth);
        Self { constraints, specials, given }
    }

    /// The number of the subtree below all constraints.
    pub(super) fn base(&self) -> usize {
        self.constraints.len()
    }

    /// ln of the radius at the root of a constraint's subtree.
    pub(super) fn log_root(&self, constraint: usize) -> f64 {
        log(0.5 * self.constraints[constraint].effective)
    }

    /// The first metamer whose radius does not follow from its tips alone, but for those that bear others.
    pub(super) fn first(&self) -> Option<MetamerId> {
        let constrained = self.constraints.first().map(|width| width.metamer);
        constrained.into_iter().chain(self.given.first().map(|&(id, _)| id)).min()
    }

    /// The subtrees of all metamers from the [first](Self::first) on; each root belongs to its own.
    pub(super) fn subtrees(&self, plant: &Plant, first: usize) -> Vec<u32> {
        let parents = plant.columns(first..plant.metamer_count()).parent;
        let mut subtrees = Vec::with_capacity(parents.len());
        let mut roots =
            self.constraints.iter().map(|width| width.metamer.index() - first).zip(0..).peekable();
        let mut given = self.given.iter().map(|(id, _)| id.index() - first).peekable();
        for (row, parent) in parents.iter().enumerate() {
            // The parent of a seed lies beyond all rows.
            let inherited =
                parent.index().checked_sub(first).and_then(|parent| subtrees.get(parent).copied());
            let own = roots.next_if(|&(root, _)| root == row).map(|(_, constraint)| constraint);
            // What grows on wood of a given radius follows from its tips again.
            let own = own.or_else(|| given.next_if_eq(&row).map(|_| self.base() as u32));
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

/// ln of a radius.
pub(super) fn log(radius: f32) -> f64 {
    libm::log(f64::from(radius))
}

/// The special metamers and how they hang together.
fn specials(plant: &Plant, wanted: &[(MetamerId, f32)], given: &[(MetamerId, f32)]) -> Vec<Special> {
    let given_to = |id: MetamerId| {
        let at = given.binary_search_by_key(&id, |&(id, _)| id).ok()?;
        Some(given[at].1)
    };
    // Wood of a given radius hides what it bears from what bears it.
    let bears = |id: MetamerId| !plant.is_seed(id) && given_to(id).is_none();
    let is_lowest = |&&(id, _): &&(MetamerId, f32)| plant.metamers().parent(id).is_some_and(bears);
    // One more than the place of each special metamer.
    let mut places = vec![0u32; plant.metamer_count()];
    let mut rows: Vec<MetamerId> =
        wanted.iter().chain(given.iter().filter(is_lowest)).map(|&(id, _)| id).collect();
    let leaves = rows.len();
    for id in &rows {
        places[id.index()] = 1;
    }
    for leaf in 0..leaves {
        let mut at = plant.metamers().parent(rows[leaf]);
        while let Some(id) = at.filter(|&id| places[id.index()] == 0 && bears(id)) {
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
            match parent.role {
                Role::Constrained(of) => of,
                Role::Given(_) => wanted.len(),
                Role::Bearer => parent.within,
            }
        });
        let constraint = constrained.next_if(|&(_, id)| id == metamer).map(|(of, _)| Role::Constrained(of));
        let radius = || given_to(metamer).map(|radius| Role::Given(log(radius)));
        let role = constraint.or_else(radius).unwrap_or(Role::Bearer);
        let tips = plant.metamers().tips(metamer);
        specials.push(Special { metamer, role, within, parent, tips });
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
        match special.role {
            Role::Constrained(of) => {
                let width = &mut constraints[of];
                // Written so that what is no number counts as no wish.
                width.effective = width.wanted.max(leaf).min(WIDEST);
                (leaf, gone) = (width.effective, all_tips);
            }
            Role::Given(log) => (leaf, gone) = (2.0 * libm::exp(log) as f32, all_tips),
            Role::Bearer => {}
        }
        if let Some(parent) = special.parent {
            thickest[parent] = leaf.max(thickest[parent]);
            taken[parent] += gone;
        }
    }
}
