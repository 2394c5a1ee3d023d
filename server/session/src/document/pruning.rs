//! Cutting branches off (`PR`).

use std::collections::{BTreeMap, BTreeSet};

use espalier_growth::Simulation;
use espalier_plant::{MetamerId, Plant};
use espalier_proto::{Problem, Reason, Share};

use super::{Document, Generators, history::Kind, wood_of};
use crate::cause::Cause;

impl Document {
    pub(super) fn prune(&mut self, cause: Cause<'_>, rows: &[u32]) -> Result<(), Problem> {
        let cuts = cuts(self.plant(), rows)?;
        let lowest: Vec<u32> = cuts.iter().map(|cut| cut.raw()).collect();
        if let Some(designed) = self.designed(&lowest).filter(|designed| !designed.is_empty()) {
            return self.cut_designed(cause, &designed);
        }
        self.cut(cause, &cuts);
        Ok(())
    }

    pub(super) fn prune_dim(&mut self, cause: Cause<'_>, exposure: Share) -> Result<(), Problem> {
        let exposure = exposure.get();
        self.simulation.show();
        let cuts = dim_branches(self.plant(), exposure);
        if cuts.is_empty() {
            let message = format!("no lateral branch stands in so little light as {exposure}");
            return Err(Problem::new(Reason::NoDimBranch, message)
                .at("exposure", "the light of some lateral branch, or more"));
        }
        self.cut(cause, &cuts);
        Ok(())
    }

    fn cut(&mut self, cause: Cause<'_>, cuts: &[MetamerId]) {
        let now = self.plant().step();
        if !self.history.continues(&[Kind::Growth, Kind::Prune], cause, now) {
            self.record(Kind::Prune, cause);
        }
        self.simulation.prune(cuts);
        self.reach();
        self.release_lost_bends();
    }
}

/// Cuts branches off a copy of the simulation, for a prediction.
pub(crate) fn prune(simulation: &mut Simulation<Generators>, rows: &[u32]) -> Result<(), Problem> {
    let cuts = cuts(simulation.plant(), rows)?;
    if !cuts.is_empty() {
        simulation.prune(&cuts);
    }
    Ok(())
}

/// The lowest metamers of what is cut for some rows, in birth order.
fn cuts(plant: &Plant, rows: &[u32]) -> Result<Vec<MetamerId>, Problem> {
    let limbs = Limbs::of(plant);
    let mut cuts = BTreeSet::new();
    let mut asked = BTreeSet::new();
    for (index, &row) in rows.iter().enumerate().filter(|&(_, &row)| asked.insert(row)) {
        let field = format!("rows[{index}]");
        let metamer = wood_of(plant, &field, row)?;
        let found = limbs.cuts(metamer).map_err(|sentence| {
            Problem::new(Reason::TrunkCut, format!("row {row} cannot be cut: {sentence}"))
                .at(field, "rows of branches, or of wood above a width constraint")
        })?;
        cuts.extend(found);
    }
    Ok(cuts.into_iter().collect())
}

/// Where a plant branches and is held in width.
struct Limbs<'a> {
    plant: &'a Plant,
    /// How many living metamers grow from each node.
    bears: Vec<u32>,
    /// What grows from each metamer whose width is held.
    held: BTreeMap<MetamerId, Vec<MetamerId>>,
}

impl<'a> Limbs<'a> {
    fn of(plant: &'a Plant) -> Self {
        let mut bears = vec![0; plant.metamer_count()];
        let mut held: BTreeMap<MetamerId, Vec<MetamerId>> =
            plant.widths().map(|(id, _)| (id, Vec::new())).collect();
        for id in (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id)) {
            if let Some(parent) = plant.metamers().parent(id) {
                bears[parent.index()] += 1;
                if let Some(above) = held.get_mut(&parent) {
                    above.push(id);
                }
            }
        }
        Self { plant, bears, held }
    }

    /// What is cut for one row (`PR1`), or a sentence that says why nothing can be.
    fn cuts(&self, row: MetamerId) -> Result<Vec<MetamerId>, &'static str> {
        if let Some(above) = self.held.get(&row) {
            let nothing = "nothing stands above its width constraint";
            return if above.is_empty() { Err(nothing) } else { Ok(above.clone()) };
        }
        let mut cut = row;
        loop {
            let parent = self.plant.metamers().parent(cut).filter(|&parent| !self.plant.is_seed(parent));
            let parent = parent.ok_or("it belongs to a trunk, and nothing branches off below it")?;
            let axes = self.plant.metamers();
            let begins_axis = axes.axis(parent) != axes.axis(cut);
            if begins_axis || self.bears[parent.index()] > 1 || self.held.contains_key(&parent) {
                return Ok(vec![cut]);
            }
            cut = parent;
        }
    }
}

/// The first metamers of lateral branches that stand in no more light than this as a whole, and do not stand on
/// one of the same sort.
fn dim_branches(plant: &Plant, exposure: f32) -> Vec<MetamerId> {
    let count = plant.metamer_count();
    let mut lightest = vec![0u8; count];
    for index in (0..count).rev() {
        let id = MetamerId::new(index);
        if plant.is_alive(id) && !plant.is_seed(id) {
            lightest[index] = lightest[index].max(plant.metamers().condition(id).light);
            if let Some(parent) = plant.metamers().parent(id) {
                lightest[parent.index()] = lightest[parent.index()].max(lightest[index]);
            }
        }
    }
    let mut is_cut = vec![false; count];
    let mut cuts = Vec::new();
    for index in 0..count {
        let id = MetamerId::new(index);
        let Some(parent) = plant.metamers().parent(id).filter(|_| plant.is_alive(id)) else { continue };
        if is_cut[parent.index()] {
            is_cut[index] = true;
            continue;
        }
        let is_lateral = !plant.is_seed(parent) && plant.metamers().axis(parent) != plant.metamers().axis(id);
        if is_lateral && f32::from(lightest[index]) <= exposure * 255.0 {
            is_cut[index] = true;
            cuts.push(id);
        }
    }
    cuts
}
