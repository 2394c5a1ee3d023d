//! The priority model of vigor (Pałubicki et al. 2009 §4.2), the alternative to Borchert and Honda's.
//!
//! Along each axis its terminal bud and its laterals are ranked by how much light each of their buds gets. What
//! ranks first weighs 1, the weight falls in a straight line to `w_min` at the share κ of the ranking, and vigor is
//! shared out in proportion to weight and light. As long as apical control λ is at least ½, the terminal bud ranks
//! first whatever its light.

use espalier_plant::{AxisId, MetamerId, Plant};

use super::{Canopy, NOWHERE};
use crate::{parameter_table::ParameterTable, parameters::Parameters, vigor};

/// What an axis shares its vigor among.
#[derive(Clone, Copy, Debug)]
struct Claimant {
    /// The lateral; for the terminal bud the axis itself.
    axis: AxisId,
    /// Slot of the node it sits at.
    node: usize,
    light: u64,
    buds: u32,
    is_first: bool,
}

impl Canopy {
    /// Shares vigor out by rank. Light has been gathered.
    pub(super) fn distribute_by_priority(&mut self, plant: &Plant, parameters: &ParameterTable) {
        let buds = self.count_buds(plant);
        self.bud_vigors.clear();
        self.bud_vigors.resize(plant.axis_count(), 0.0);
        // An axis is born after the one that bears it, and its nodes stand in order.
        let wood = self.wood.of(plant);
        let axis_of = |slot: usize| plant.metamers().axis(wood.id(slot));
        let mut slots: Vec<usize> = (0..self.nodes.len()).collect();
        slots.sort_by_key(|&slot| axis_of(slot));
        let gain = f64::from(parameters.scene().vigor_gain) / vigor::UNIT;
        let mut claimants = Vec::new();
        let axes: Vec<Vec<usize>> =
            slots.chunk_by(|&a, &b| axis_of(a) == axis_of(b)).map(<[usize]>::to_vec).collect();
        for slots in axes {
            let wood = self.wood.of(plant);
            let (first, axis) = (slots[0], plant.metamers().axis(wood.id(slots[0])));
            if wood.parent(first) == NOWHERE {
                self.bud_vigors[axis.index()] = gain * self.sums[first].light() as f64;
            }
            let vigor = self.bud_vigors[axis.index()];
            let lambda = self.plants.lambda(first);
            claimants.clear();
            for &slot in &slots {
                self.claimants_at(slot, plant, parameters, &buds, lambda >= 0.5, &mut claimants);
            }
            rank(&mut claimants);
            let weights = weights(claimants.len(), parameters.of(axis));
            let shares = || claimants.iter().zip(&weights).map(|(c, weight)| c.light as f64 * weight);
            let all: f64 = shares().sum();
            let rate = if all > 0.0 { vigor / all } else { 0.0 };
            let mut left_at = vec![0.0; slots.len()];
            for (claimant, share) in claimants.iter().zip(shares()) {
                self.bud_vigors[claimant.axis.index()] = rate * share;
                let along = slots.partition_point(|&slot| slot < claimant.node);
                left_at[along] += rate * share;
            }
            let mut left: f64 = left_at.iter().sum();
            for (&slot, spent) in slots.iter().zip(&left_at) {
                self.vigors[slot] = left;
                left = (left - spent).max(0.0);
            }
        }
    }

    /// Living buds from each node on upwards.
    fn count_buds(&self, plant: &Plant) -> Vec<u32> {
        let wood = self.wood.of(plant);
        let mut buds = vec![0; self.nodes.len()];
        for (slot, node) in self.nodes.iter().enumerate().rev() {
            buds[slot] += u32::from(node.is_tip()) + dormant(plant, wood.id(slot)).count() as u32;
            let parent = wood.parent(slot);
            if parent != NOWHERE {
                buds[parent as usize] += buds[slot];
            }
        }
        buds
    }

    fn claimants_at(
        &self,
        slot: usize,
        plant: &Plant,
        parameters: &ParameterTable,
        buds: &[u32],
        terminal_first: bool,
        claimants: &mut Vec<Claimant>,
    ) {
        let id = self.wood.of(plant).id(slot);
        for axis in plant.laterals(id).filter(|&axis| plant.is_standing(axis)) {
            let (light, buds) = match plant.axes().first(axis) {
                Some(first) => {
                    let first = self.slots.of(first) as usize;
                    (self.sums[first].light(), buds[first])
                }
                None => (self.lateral_input(plant, axis, id, parameters), 1),
            };
            // A stump without buds has no rank.
            if buds > 0 {
                claimants.push(Claimant { axis, node: slot, light, buds, is_first: false });
            }
        }
        if self.nodes[slot].is_tip() {
            let (axis, light) = (plant.metamers().axis(id), self.sums[slot].main);
            claimants.push(Claimant { axis, node: slot, light, buds: 1, is_first: terminal_first });
        }
    }
}

/// Lateral buds at a node that have not grown.
fn dormant(plant: &Plant, id: MetamerId) -> impl Iterator<Item = AxisId> + '_ {
    plant.laterals(id).filter(|&axis| plant.is_axis_alive(axis) && plant.axes().last(axis).is_none())
}

/// Those with the most light for each bud first. Of equal ones the youngest: the terminal bud, whose axis is older
/// than those it bears, leads only where it is put first or has the most light.
fn rank(claimants: &mut [Claimant]) {
    claimants.sort_by(|a, b| {
        // Compared as products, for a quotient would be rounded.
        let (ours, theirs) =
            (u128::from(a.light) * u128::from(b.buds), u128::from(b.light) * u128::from(a.buds));
        b.is_first.cmp(&a.is_first).then(theirs.cmp(&ours)).then(b.axis.cmp(&a.axis))
    });
}

/// The weight of each rank, best first.
fn weights(count: usize, parameters: &Parameters) -> Vec<f64> {
    let least = f64::from(parameters.priority_least_weight);
    let decline = f64::from(parameters.priority_decline);
    let last = count.saturating_sub(1).max(1) as f64;
    (0..count)
        .map(|rank| {
            let x = rank as f64 / last;
            if x < decline { 1.0 + (least - 1.0) * x / decline } else { least }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use espalier_settings::{ParameterValues, VigorModel};

    #[test]
    fn weight_falls_to_the_least() {
        let values = ParameterValues { priority_decline: 0.5, ..ParameterValues::default() };
        let weights = weights(5, &Parameters::new(values).expect("in range"));
        let expected = [1.0, 0.503, 0.006, 0.006, 0.006];
        assert!(weights.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{weights:?}");
    }

    #[test]
    fn the_best_lit_bud_ranks_first() {
        let claimant = |axis, light, buds, is_first| Claimant {
            axis: AxisId::new(axis),
            node: 0,
            light,
            buds,
            is_first,
        };
        let mut claimants =
            vec![claimant(1, 10, 10, false), claimant(2, 6, 2, false), claimant(0, 1, 1, true)];
        rank(&mut claimants);
        assert_eq!(claimants.iter().map(|c| c.axis.index()).collect::<Vec<_>>(), [0, 2, 1]);
        claimants.iter_mut().for_each(|c| c.is_first = false);
        rank(&mut claimants);
        assert_eq!(claimants[0].axis.index(), 2);
    }

    #[test]
    fn no_vigor_is_lost_on_the_way() {
        let values = ParameterValues {
            vigor_model: VigorModel::Priority,
            priority_least_weight: 0.2,
            ..ParameterValues::default()
        };
        let mut simulation = crate::Simulation::new(5, Parameters::new(values).expect("in range"));
        for _ in 0..10 {
            let input = crate::StepInput { autonomous: true, ..crate::StepInput::default() };
            simulation.step(&input, &mut crate::NoObserver);
        }
        let (plant, canopy) = (simulation.plant(), &simulation.generator.canopy);
        assert!(plant.living_count() > 30);
        let at_base = canopy.vigors[0];
        let buds = (0..plant.axis_count()).map(AxisId::new).filter(|&axis| plant.is_axis_alive(axis));
        let in_buds: f64 =
            buds.map(|axis| canopy.bud_vigor(plant, axis, &simulation.generator.parameters)).sum();
        assert!((in_buds / at_base - 1.0).abs() < 1e-9, "{in_buds} of {at_base}");
    }
}
