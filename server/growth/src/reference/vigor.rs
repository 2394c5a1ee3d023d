//! Light and vigor as they are defined: how light flows down and vigor up, and what has too little of it.

use espalier_plant::{AxisId, MetamerId, Plant};
use espalier_settings::VigorModel;

use super::{all_axes, living_nodes};
use crate::{
    gravimorphism::propensity,
    light::ShadowGrid,
    obstacles::Obstacles,
    parameter_table::ParameterTable,
    vigor::{self, Split, Sums},
};

/// Light and vigor of a plant, by the definitions.
pub(super) struct Vigor {
    sums: Vec<Sums>,
    vigors: Vec<f64>,
    light: Vec<f32>,
    sizes: Vec<u32>,
    /// Steps of growth each metamer has lived through.
    ages: Vec<u32>,
    /// Under the priority model, vigor of each axis.
    of_axes: Vec<f64>,
}

impl Vigor {
    pub fn of(plant: &Plant, parameters: &ParameterTable, obstacles: &Obstacles) -> Self {
        let count = plant.metamer_count();
        let mut shadows = ShadowGrid::new(parameters.scene());
        let nodes = living_nodes(plant);
        for &id in nodes.iter().filter(|&&id| !plant.is_seed(id)) {
            shadows.cast(plant.metamers().end(id));
        }
        let mut vigor = Self {
            sums: vec![Sums::default(); count],
            vigors: vec![0.0; count],
            light: vec![0.0; count],
            sizes: vec![0; count],
            ages: (0..count).map(|index| plant.age(MetamerId::new(index))).collect(),
            of_axes: Vec::new(),
        };
        for &id in &nodes {
            let node = plant.metamers().end(id);
            vigor.light[id.index()] = shadows.exposure(node) * obstacles.sky_share(node);
        }
        for axis in all_axes(plant).filter(|&axis| plant.is_axis_alive(axis)) {
            let sums = &mut vigor.sums[plant.bud_node(axis).index()];
            let light = vigor.light[plant.bud_node(axis).index()];
            match plant.axes().last(axis) {
                Some(_) => sums.main += bud_input(plant, axis, light, parameters),
                None => sums.lateral += bud_input(plant, axis, light, parameters),
            }
        }
        for &id in nodes.iter().rev() {
            let Some(parent) = plant.metamers().parent(id) else { continue };
            let light = vigor.sums[id.index()].light();
            let below = &mut vigor.sums[parent.index()];
            let continues = plant.metamers().axis(parent) == plant.metamers().axis(id);
            *(if continues { &mut below.main } else { &mut below.lateral }) += light;
            vigor.sizes[id.index()] += 1;
            vigor.sizes[parent.index()] += vigor.sizes[id.index()];
        }
        if parameters.scene().vigor_model == VigorModel::Priority {
            vigor.share_by_rank(plant, parameters);
            return vigor;
        }
        for &id in &nodes {
            let light = vigor.sums[id.index()].light();
            vigor.vigors[id.index()] = match plant.metamers().parent(id) {
                None => f64::from(parameters.scene().vigor_gain) / vigor::UNIT * light as f64,
                Some(parent) => {
                    let axis = plant.metamers().axis(parent);
                    let (vigor_below, sums) = (vigor.vigors[parent.index()], vigor.sums[parent.index()]);
                    let split = Split::new(vigor_below, sums, lambda(plant, id, parameters, &vigor.ages));
                    if axis == plant.metamers().axis(id) { split.to_main() } else { split.to_lateral(light) }
                }
            };
        }
        vigor
    }

    /// Vigor by the priority model (Pałubicki et al. 2009 §4.2). Light has flowed down.
    fn share_by_rank(&mut self, plant: &Plant, parameters: &ParameterTable) {
        let nodes = living_nodes(plant);
        let mut buds = vec![0u128; plant.metamer_count()];
        for axis in all_axes(plant).filter(|&axis| plant.is_axis_alive(axis)) {
            buds[plant.bud_node(axis).index()] += 1;
        }
        for &id in nodes.iter().rev() {
            if let Some(parent) = plant.metamers().parent(id) {
                buds[parent.index()] += buds[id.index()];
            }
        }
        self.of_axes = vec![0.0; plant.axis_count()];
        for axis in all_axes(plant) {
            let on_axis = |id: &&MetamerId| plant.metamers().axis(**id) == axis;
            let nodes: Vec<MetamerId> = nodes.iter().filter(on_axis).copied().collect();
            let Some(&first) = nodes.first() else { continue };
            if plant.is_seed(first) {
                let gain = f64::from(parameters.scene().vigor_gain) / vigor::UNIT;
                self.of_axes[axis.index()] = gain * self.sums[first.index()].light() as f64;
            }
            let lambda = lambda(plant, first, parameters, &self.ages);
            // Who claims a share: whether it comes first, its light, its buds, its axis, and where it is borne.
            let mut claimants: Vec<(bool, u64, u128, AxisId, usize)> = Vec::new();
            for (place, &id) in nodes.iter().enumerate() {
                let borne = all_axes(plant).filter(|&lateral| plant.axes().bearer(lateral) == Some(id));
                for lateral in borne.filter(|&lateral| plant.is_standing(lateral)) {
                    let (light, buds) = match plant.axes().first(lateral) {
                        Some(wood) => (self.sums[wood.index()].light(), buds[wood.index()]),
                        None => (bud_input(plant, lateral, self.light[id.index()], parameters), 1),
                    };
                    claimants.push((false, light, buds, lateral, place));
                }
                if plant.is_axis_alive(axis) && plant.bud_node(axis) == id {
                    let light = bud_input(plant, axis, self.light[id.index()], parameters);
                    claimants.push((lambda >= 0.5, light, 1, axis, place));
                }
            }
            claimants.retain(|&(_, _, buds, ..)| buds > 0);
            claimants.sort_by(|a, b| {
                let share = (u128::from(b.1) * a.2).cmp(&(u128::from(a.1) * b.2));
                b.0.cmp(&a.0).then(share).then(b.3.cmp(&a.3))
            });
            let values = parameters.of(axis);
            let last = (claimants.len().max(2) - 1) as f64;
            let (least, decline) =
                (f64::from(values.priority_least_weight), f64::from(values.priority_decline));
            let weight = |rank: usize| {
                let x = rank as f64 / last;
                if x < decline { 1.0 + (least - 1.0) * x / decline } else { least }
            };
            let shares: Vec<f64> = claimants
                .iter()
                .enumerate()
                .map(|(rank, claimant)| claimant.1 as f64 * weight(rank))
                .collect();
            let all: f64 = shares.iter().sum();
            let rate = if all > 0.0 { self.of_axes[axis.index()] / all } else { 0.0 };
            let mut spent = vec![0.0; nodes.len()];
            for (&(.., lateral, place), share) in claimants.iter().zip(shares) {
                self.of_axes[lateral.index()] = rate * share;
                spent[place] += rate * share;
            }
            let mut left: f64 = spent.iter().sum();
            for (id, spent) in nodes.into_iter().zip(spent) {
                self.vigors[id.index()] = left;
                left = (left - spent).max(0.0);
            }
        }
    }

    pub fn of_bud(&self, plant: &Plant, axis: AxisId, parameters: &ParameterTable) -> f64 {
        if let Some(&vigor) = self.of_axes.get(axis.index()) {
            return vigor;
        }
        let node = plant.bud_node(axis);
        let (vigor, sums) = (self.vigors[node.index()], self.sums[node.index()]);
        let split = Split::new(vigor, sums, lambda(plant, node, parameters, &self.ages));
        match plant.axes().last(axis) {
            Some(_) => split.to_main(),
            None => split.to_lateral(bud_input(plant, axis, self.light[node.index()], parameters)),
        }
    }

    pub fn condemns(&self, plant: &Plant, axis: AxisId, parameters: &ParameterTable) -> bool {
        let Some(first) = plant.axes().first(axis).filter(|_| plant.axes().order(axis) > 0) else {
            return false;
        };
        let threshold =
            f64::from(parameters.scene().vigor_gain) * f64::from(parameters.of(axis).shedding_threshold);
        plant.age(first) >= 3 && self.vigors[first.index()] < threshold * f64::from(self.sizes[first.index()])
    }
}

/// λ of the plant that a metamer belongs to.
fn lambda(plant: &Plant, id: MetamerId, parameters: &ParameterTable, ages: &[u32]) -> f64 {
    let seed = core::iter::successors(Some(id), |&id| plant.metamers().parent(id)).last().unwrap_or(id);
    f64::from(parameters.scene().apical_control_at(ages[seed.index()]))
}

/// Q = bL^κ (TreeSketch §3.2).
fn bud_input(plant: &Plant, axis: AxisId, light: f32, parameters: &ParameterTable) -> u64 {
    let parameters = parameters.of(axis);
    let kappa = parameters.light_sensitivity;
    let response = if kappa == 1.0 { light } else { libm::powf(light, kappa) };
    let node = plant.bud_node(axis);
    let b = match plant.axes().last(axis) {
        Some(_) => 1.0,
        None => propensity(plant.heading(node), plant.axes().direction(axis), parameters),
    };
    vigor::quantised(response * b)
}
