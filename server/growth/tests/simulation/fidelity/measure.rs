//! Measures of form: what a botanist would take down standing before the tree.

use core::f32::consts::PI;
use std::collections::BTreeMap;

use espalier_growth::{ParameterValues, Parameters, Simulation};
use espalier_plant::{AxisId, MetamerId, Plant};
use glam::Vec2;

/// A seedling with some values other than the defaults.
pub fn seedling(seed: u32, change: impl FnOnce(&mut ParameterValues)) -> Simulation {
    Simulation::new(seed, changed(change))
}

/// The defaults with some values changed.
pub fn changed(change: impl FnOnce(&mut ParameterValues)) -> Parameters {
    let mut values = ParameterValues::default();
    change(&mut values);
    Parameters::new(values).expect("in range")
}

/// Living metamers without the seeds.
pub fn wood(plant: &Plant) -> impl Iterator<Item = MetamerId> + '_ {
    let all = (0..plant.metamer_count()).map(MetamerId::new);
    all.filter(|&id| plant.is_alive(id) && !plant.is_seed(id))
}

/// Living axes that have grown.
pub fn grown_axes(plant: &Plant) -> impl Iterator<Item = AxisId> + '_ {
    let all = (0..plant.axis_count()).map(AxisId::new);
    all.filter(|&axis| plant.is_axis_alive(axis) && plant.has_grown(axis))
}

/// The axis that bears an axis.
pub fn bearing_axis(plant: &Plant, axis: AxisId) -> Option<AxisId> {
    plant.axes().bearer(axis).map(|bearer| plant.metamers().axis(bearer))
}

/// The trunk of the plant that an axis belongs to.
pub fn trunk_of(plant: &Plant, axis: AxisId) -> AxisId {
    core::iter::successors(Some(axis), |&axis| bearing_axis(plant, axis)).last().unwrap_or(axis)
}

/// How many living internodes each axis has.
pub fn internodes(plant: &Plant) -> Vec<u32> {
    let mut internodes = vec![0; plant.axis_count()];
    for id in wood(plant) {
        internodes[plant.metamers().axis(id).index()] += 1;
    }
    internodes
}

/// Height of the highest node.
pub fn height(plant: &Plant) -> f32 {
    wood(plant).fold(0.0, |top, id| top.max(plant.metamers().end(id).y))
}

/// Share of the tree's height that its trunk, the axis of the seed, reaches.
pub fn trunk_share(plant: &Plant) -> f32 {
    plant.bud_position(AxisId::new(0)).y / height(plant)
}

/// Share of the tree's twigs that an axis and all it bears carry.
fn tip_share(plant: &Plant, axis: AxisId) -> f32 {
    let tips = |id| plant.metamers().tips(id) as f32;
    plant.axes().first(axis).map_or(0.0, tips) / tips(MetamerId::new(0))
}

/// The shares of the laterals that carry at least so much of the tree's twigs.
pub fn limbs(plant: &Plant, least: f32) -> Vec<f32> {
    let laterals = grown_axes(plant).filter(|&axis| plant.axes().order(axis) > 0);
    laterals.map(|axis| tip_share(plant, axis)).filter(|&share| share >= least).collect()
}

/// Share of the tree's twigs that its strongest lateral carries.
pub fn largest_limb(plant: &Plant) -> f32 {
    limbs(plant, 0.0).into_iter().fold(0.0, f32::max)
}

/// Mean of what there is.
pub fn mean(values: impl IntoIterator<Item = f32>) -> f32 {
    let (count, sum) = values.into_iter().fold((0u32, 0.0), |(count, sum), value| (count + 1, sum + value));
    sum / count as f32
}

/// Mean horizontal distance of the wood from the seed.
pub fn spread(plant: &Plant) -> f32 {
    mean(wood(plant).map(|id| plant.metamers().end(id)).map(|end| Vec2::new(end.x, end.z).length()))
}

/// Of the twigs carried through a level, the share that goes through the strongest stem there: 1 below the
/// lowest branch, near 0 where a crown has dissolved into many.
pub fn leader_at(plant: &Plant, level: f32) -> f32 {
    let metamers = plant.metamers();
    let crossing = wood(plant).filter(|&id| {
        let below = metamers.parent(id).map_or(0.0, |parent| metamers.end(parent).y);
        below < level && metamers.end(id).y >= level
    });
    let tips: Vec<u32> = crossing.map(|id| metamers.tips(id)).collect();
    let strongest = tips.iter().max().copied().unwrap_or(0);
    strongest as f32 / tips.iter().sum::<u32>() as f32
}

/// Nodes per cubic internode in the inner and the outer part of the crown: up to half the crown's radius from
/// the seed's vertical, and beyond it, in layers of four internodes.
pub fn densities(plant: &Plant) -> (f32, f32) {
    const LAYER: f32 = 4.0;
    let mut layers: BTreeMap<u32, Vec<f32>> = BTreeMap::new();
    for end in wood(plant).map(|id| plant.metamers().end(id)) {
        layers.entry((end.y / LAYER) as u32).or_default().push(Vec2::new(end.x, end.z).length());
    }
    let (mut inner, mut outer, mut inner_volume, mut outer_volume) = (0, 0, 0.0, 0.0);
    for radii in layers.values() {
        let radius = radii.iter().copied().fold(0.0, f32::max);
        let within = radii.iter().filter(|&&r| r < 0.5 * radius).count();
        let volume = PI * radius * radius * LAYER;
        (inner, outer) = (inner + within, outer + radii.len() - within);
        (inner_volume, outer_volume) = (inner_volume + 0.25 * volume, outer_volume + 0.75 * volume);
    }
    (inner as f32 / inner_volume, outer as f32 / outer_volume)
}

/// How a tree seen from the front covers an outline, as areas in square internodes.
#[derive(Clone, Copy, Debug)]
pub struct Cover {
    /// Of outline and tree both.
    pub both: f32,
    /// Of the outline only: what was not filled.
    pub empty: f32,
    /// Of the tree only: what grew out of it.
    pub beyond: f32,
}

impl Cover {
    /// Compares the outline, filled by the even-odd rule, with discs of this radius around the nodes.
    pub fn of(plant: &Plant, outline: &[Vec2], radius: f32) -> Self {
        const PIXEL: f32 = 0.25;
        let discs: Vec<Vec2> = wood(plant).map(|id| plant.metamers().end(id).truncate()).collect();
        let (mut low, mut high) = (Vec2::ZERO, Vec2::ZERO);
        for &point in outline.iter().chain(&discs) {
            (low, high) = (low.min(point - radius), high.max(point + radius));
        }
        let pixels = |length: f32| (length / PIXEL).ceil().max(0.0) as usize;
        let (width, height) = (pixels(high.x - low.x) + 1, pixels(high.y - low.y) + 1);
        let centre = |x: usize, y: usize| low + Vec2::new(x as f32, y as f32) * PIXEL;
        let mut grown = vec![false; width * height];
        for &disc in &discs {
            let (first, last) = (disc - radius - low, disc + radius - low);
            for y in pixels(first.y)..pixels(last.y) {
                for x in pixels(first.x)..pixels(last.x) {
                    grown[y * width + x] |= centre(x, y).distance_squared(disc) <= radius * radius;
                }
            }
        }
        let (mut both, mut empty, mut beyond) = (0, 0, 0);
        for y in 0..height {
            for x in 0..width {
                match (is_inside(outline, centre(x, y)), grown[y * width + x]) {
                    (true, true) => both += 1,
                    (true, false) => empty += 1,
                    (false, true) => beyond += 1,
                    (false, false) => {}
                }
            }
        }
        let area = |pixels: u32| pixels as f32 * PIXEL * PIXEL;
        Self { both: area(both), empty: area(empty), beyond: area(beyond) }
    }

    /// Intersection over union.
    pub fn overlap(self) -> f32 {
        self.both / (self.both + self.empty + self.beyond)
    }
}

/// Whether a point lies in an outline by the even-odd rule.
pub fn is_inside(outline: &[Vec2], p: Vec2) -> bool {
    let ends = outline.iter().cycle().skip(1);
    let crossings = outline.iter().zip(ends).filter(|&(&a, &b)| {
        let is_level = (a.y > p.y) != (b.y > p.y);
        is_level && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
    });
    crossings.count() % 2 == 1
}

/// Mean light at the nodes, 0 to 1.
pub fn light(plant: &Plant) -> f32 {
    mean(wood(plant).map(|id| f32::from(plant.metamers().condition(id).light) / 255.0))
}
