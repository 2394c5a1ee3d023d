//! The rule of which wood stands, as it is said, row by row.

use std::collections::{BTreeMap, BTreeSet};

use espalier_plant::{AxisId, Claim, Edit, MetamerId, Plant};

/// What stands of a plant by the rule.
pub struct Rule<'a> {
    plant: &'a Plant,
    claims: &'a [Claim],
    /// Edits of the past and their steps.
    edits: Vec<(u32, Edit)>,
    axis_deaths: Vec<u32>,
    deaths: Vec<u32>,
}

impl<'a> Rule<'a> {
    pub fn new(plant: &'a Plant, claims: &'a [Claim]) -> Self {
        let parts = plant.to_parts();
        let mut edits = Vec::new();
        for step in 1..=plant.step() {
            let (from, to) = (parts.ends[step as usize - 1][2], parts.ends[step as usize][2]);
            edits.extend(parts.edits[from as usize..to as usize].iter().map(|edit| (step, edit.clone())));
        }
        Self { plant, claims, edits, axis_deaths: parts.axis_death, deaths: parts.death }
    }

    fn in_force(&self, step: u32) -> bool {
        self.claims[step as usize].in_force
    }

    /// A metamer and all below it.
    fn way(&self, id: MetamerId) -> Vec<MetamerId> {
        std::iter::successors(Some(id), |&id| self.plant.metamers().parent(id)).collect()
    }

    /// The last cut in force at one of some wood, later than a step.
    fn is_cut(&self, way: &[MetamerId], since: u32) -> bool {
        self.edits.iter().any(|&(step, ref edit)| {
            let hits = match *edit {
                Edit::Pruned(cut) => way.contains(&cut),
                Edit::Shed(axis) => way.iter().any(|&id| self.plant.metamers().axis(id) == axis),
                _ => false,
            };
            hits && step > since && self.in_force(step)
        })
    }

    /// In force and not cut.
    fn is_whole(&self, id: MetamerId) -> bool {
        let birth = self.plant.birth(id);
        let lived = self.deaths[id.index()] > birth;
        lived && self.in_force(birth) && !self.is_cut(&self.way(id), birth)
    }

    fn is_drawn(&self, id: MetamerId) -> bool {
        self.claims[self.plant.birth(id) as usize].by_hand
    }

    /// The metamers that stand.
    pub fn standing(&self) -> BTreeSet<MetamerId> {
        let rows = || (0..self.plant.metamer_count()).map(MetamerId::new);
        let own: BTreeSet<MetamerId> = rows().filter(|&id| self.is_whole(id) && self.is_drawn(id)).collect();
        let holding: BTreeSet<MetamerId> = own.iter().flat_map(|&id| self.way(id)).collect();
        let is_free = |id: MetamerId| self.is_whole(id) && !self.is_drawn(id);
        let place = |id: MetamerId| (self.plant.metamers().parent(id), self.plant.metamers().axis(id));
        let mut rivals: BTreeMap<_, Vec<MetamerId>> = BTreeMap::new();
        for id in rows().filter(|&id| holding.contains(&id) || is_free(id)) {
            rivals.entry(place(id)).or_default().push(id);
        }
        let wins = |id: MetamerId| {
            let rank = |id: MetamerId| (holding.contains(&id), self.plant.is_alive(id), id);
            rivals[&place(id)].iter().all(|&rival| rank(rival) <= rank(id))
        };
        let stands = |id: MetamerId| (holding.contains(&id) || is_free(id)) && wins(id);
        rows().filter(|&id| self.way(id).into_iter().all(stands)).collect()
    }

    /// The axes whose bud lives, and the metamers their buds sit on.
    pub fn buds(&self, standing: &BTreeSet<MetamerId>) -> BTreeMap<AxisId, MetamerId> {
        let mut buds = BTreeMap::new();
        let grafts: Vec<AxisId> = self
            .edits
            .iter()
            .filter_map(|(_, edit)| if let Edit::Grafted(axis) = edit { Some(*axis) } else { None })
            .collect();
        for axis in (0..self.plant.axis_count()).map(AxisId::new) {
            let birth = self.plant.axis_birth(axis);
            let wood = standing.iter().rev().find(|&&id| self.plant.metamers().axis(id) == axis);
            let bearer = self.plant.axes().bearer(axis);
            let Some(node) = wood.copied().or(bearer.filter(|bearer| standing.contains(bearer))) else {
                continue;
            };
            let was_made = wood.is_some() || !grafts.contains(&axis) || self.in_force(birth);
            let was_cut = self.edits.iter().any(|&(step, ref edit)| {
                let hits = match *edit {
                    Edit::Pruned(cut) => self.plant.metamers().axis(cut) == axis,
                    Edit::Shed(shed) => shed == axis,
                    _ => false,
                };
                hits && step > birth && self.in_force(step)
            });
            let below = bearer.map_or(Vec::new(), |bearer| self.way(bearer));
            let stillborn = self.axis_deaths[axis.index()] <= birth;
            if was_made && !was_cut && !self.is_cut(&below, birth) && !stillborn {
                buds.insert(axis, node);
            }
        }
        buds
    }
}
