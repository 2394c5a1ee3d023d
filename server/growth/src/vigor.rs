//! The extended Borchert-Honda model (Pałubicki et al. 2009 §4.2; TreeSketch §3.2 "Shoot growth").
//!
//! Light flows down: each bud puts in Q = bL^κ. Vigor flows up: v = α·Q at the base, and at each node the main
//! axis gets λQ_m against (1−λ)Q_l for the laterals, which share theirs in proportion to Q.

use espalier_plant::{AxisId, MetamerId, Plant};

use crate::{parameter_table::ParameterTable, parameters::Parameters};

/// Light and vigor at every metamer, for one step.
#[derive(Clone, Debug, Default)]
pub(crate) struct VigorFlow {
    /// Light from what continues the metamer: its successor or its axis' bud.
    light_main: Vec<f64>,
    /// Light from the laterals at its node.
    light_lateral: Vec<f64>,
    /// Vigor that enters the metamer.
    vigor: Vec<f64>,
    /// Living metamers from it on upwards.
    size: Vec<u32>,
}

impl VigorFlow {
    /// Computes both passes from what each bud puts in (`input[axis]`, only living axes are read).
    pub(crate) fn compute(&mut self, plant: &Plant, input: &[f32], parameters: &ParameterTable) {
        let count = plant.metamer_count();
        for column in [&mut self.light_main, &mut self.light_lateral, &mut self.vigor] {
            column.clear();
            column.resize(count, 0.0);
        }
        self.size.clear();
        self.size.resize(count, 0);
        for (index, &light) in input.iter().enumerate().take(plant.axis_count()) {
            let axis = AxisId::new(index);
            if !plant.is_axis_alive(axis) {
                continue;
            }
            match plant.axes().last(axis) {
                Some(tip) => self.light_main[tip.index()] += f64::from(light),
                None => self.light_lateral[plant.bud_node(axis).index()] += f64::from(light),
            }
        }
        self.gather_light(plant);
        self.distribute_vigor(plant, parameters);
    }

    /// Tips before bases.
    fn gather_light(&mut self, plant: &Plant) {
        let metamers = plant.metamers();
        for index in (0..plant.metamer_count()).rev() {
            let id = MetamerId::new(index);
            if !plant.is_alive(id) {
                continue;
            }
            let Some(parent) = metamers.parent(id) else { continue };
            self.size[index] += 1;
            self.size[parent.index()] += self.size[index];
            let light = self.light_main[index] + self.light_lateral[index];
            let column = if metamers.axis(id) == metamers.axis(parent) {
                &mut self.light_main
            } else {
                &mut self.light_lateral
            };
            column[parent.index()] += light;
        }
    }

    /// Bases before tips.
    fn distribute_vigor(&mut self, plant: &Plant, parameters: &ParameterTable) {
        let metamers = plant.metamers();
        for index in 0..plant.metamer_count() {
            let id = MetamerId::new(index);
            if !plant.is_alive(id) {
                continue;
            }
            let light = self.light_main[index] + self.light_lateral[index];
            self.vigor[index] = match metamers.parent(id) {
                None => f64::from(parameters.scene().vigor_gain) * light,
                Some(parent) if metamers.axis(id) == metamers.axis(parent) => {
                    self.to_main(parent, parameters.of(metamers.axis(parent)))
                }
                Some(parent) => self.to_lateral(parent, light, parameters.of(metamers.axis(parent))),
            };
        }
    }

    /// Vigor that goes on along the axis beyond a node.
    fn to_main(&self, node: MetamerId, parameters: &Parameters) -> f64 {
        let lambda = f64::from(parameters.apical_control);
        let main = lambda * self.light_main[node.index()];
        let all = main + (1.0 - lambda) * self.light_lateral[node.index()];
        if all > 0.0 { self.vigor[node.index()] * main / all } else { 0.0 }
    }

    /// Vigor that goes to a lateral that brings so much light.
    fn to_lateral(&self, node: MetamerId, light: f64, parameters: &Parameters) -> f64 {
        let laterals = self.light_lateral[node.index()];
        if laterals <= 0.0 {
            return 0.0;
        }
        let lambda = f64::from(parameters.apical_control);
        let share = (1.0 - lambda) * laterals;
        let all = lambda * self.light_main[node.index()] + share;
        if all > 0.0 { self.vigor[node.index()] * share / all * (light / laterals) } else { 0.0 }
    }

    /// Vigor of the bud of a living axis, which put in `light`.
    pub(crate) fn of_bud(&self, plant: &Plant, axis: AxisId, light: f32, parameters: &ParameterTable) -> f64 {
        let node = plant.bud_node(axis);
        let parameters = parameters.of(plant.metamers().axis(node));
        match plant.axes().last(axis) {
            Some(_) => self.to_main(node, parameters),
            None => self.to_lateral(node, f64::from(light), parameters),
        }
    }

    /// Vigor that enters a metamer.
    pub(crate) fn of_metamer(&self, id: MetamerId) -> f64 {
        self.vigor[id.index()]
    }

    /// Living metamers from this one on upwards, itself included.
    pub(crate) fn size(&self, id: MetamerId) -> u32 {
        self.size[id.index()]
    }
}
