//! Figures of a tree's form. Heights and places are shares of its height, but for its extent.

use espalier_mesh::{Style, foliage};
use espalier_plant::{MetamerId, Plant};
use espalier_session::{Document, style_options};
use glam::Vec3;

/// A tree as numbers.
pub struct Form {
    /// Node, heading, and whether it bears leaves, of each living metamer.
    metamers: Vec<(Vec3, Vec3, bool)>,
    /// Cross-section of each.
    sections: Vec<f32>,
    /// Each living metamer from its lower to its upper end.
    wood: Vec<(f32, f32, f32)>,
    low: Vec3,
    high: Vec3,
    trunk_width: f32,
}

impl Form {
    pub fn of(document: &Document) -> Self {
        let style = Style::new(style_options(&document.parameters()));
        let plant: &Plant = document.plant();
        let ids = (0..plant.metamer_count()).map(MetamerId::new);
        let living: Vec<MetamerId> = ids.filter(|&id| plant.is_alive(id) && !plant.is_seed(id)).collect();
        let node = |id| plant.metamers().end(id);
        let metamers: Vec<(Vec3, Vec3, bool)> = living
            .iter()
            .map(|&id| (node(id), plant.heading(id), foliage::leaves(plant, id, &style) > 0))
            .collect();
        let wood = living.iter().filter_map(|&id| {
            let radius = style.girth().radius(plant.metamers().tips(id));
            Some((node(plant.metamers().parent(id)?).y, node(id).y, radius))
        });
        let radius = |id| style.girth().radius(plant.metamers().tips(id));
        let sections = living.iter().map(|&id| radius(id) * radius(id)).collect();
        let first = living.first().map_or(0.0, |&id| style.girth().radius(plant.metamers().tips(id)));
        let (low, high) = metamers
            .iter()
            .fold((Vec3::ZERO, Vec3::ZERO), |(low, high), &(node, ..)| (low.min(node), high.max(node)));
        Self { wood: wood.collect(), sections, low, high, trunk_width: 2.0 * first, metamers }
    }

    pub fn height(&self) -> f32 {
        self.high.y
    }

    /// From left to right.
    pub fn width(&self) -> f32 {
        self.high.x - self.low.x
    }

    /// From front to back.
    pub fn depth(&self) -> f32 {
        self.high.z - self.low.z
    }

    pub fn trunk_width(&self) -> f32 {
        self.trunk_width
    }

    fn foliage(&self) -> impl Iterator<Item = (Vec3, Vec3)> {
        self.metamers.iter().filter(|(.., leafy)| *leafy).map(|&(node, heading, _)| (node, heading))
    }

    fn share_of_foliage(&self, holds: impl Fn(Vec3, Vec3) -> bool) -> f32 {
        self.foliage().filter(|&(node, heading)| holds(node, heading)).count() as f32
            / self.foliage().count() as f32
    }

    pub fn share_of_hanging_twigs(&self) -> f32 {
        self.share_of_foliage(|_, heading| heading.y < -0.5)
    }

    pub fn share_of_level_twigs(&self) -> f32 {
        self.share_of_foliage(|_, heading| heading.y.abs() < 0.35)
    }

    pub fn mean_foliage_height(&self) -> f32 {
        self.foliage().map(|(node, _)| node.y).sum::<f32>() / self.foliage().count() as f32 / self.height()
    }

    /// Where the lowest twentieth of the foliage ends.
    pub fn foliage_from(&self) -> f32 {
        let mut heights: Vec<f32> = self.foliage().map(|(node, _)| node.y).collect();
        heights.sort_by(f32::total_cmp);
        heights[heights.len() / 20] / self.height()
    }

    /// How wide it is between two heights.
    pub fn width_at(&self, from: f32, to: f32) -> f32 {
        let between = self
            .metamers
            .iter()
            .map(|(node, ..)| node)
            .filter(|node| (from..to).contains(&(node.y / self.height())));
        let (low, high) =
            between.fold((0.0, 0.0), |(low, high): (f32, f32), node| (low.min(node.x), high.max(node.x)));
        high - low
    }

    /// How far wood heads away from the middle where the crown is, thick wood counting for more: 1 straight out, 0 around it.
    pub fn outwardness(&self) -> f32 {
        let level = |v: Vec3| v.with_y(0.0).normalize_or_zero();
        let crown = self.metamers.iter().zip(&self.sections);
        let (mut outwards, mut all) = (0.0, 0.0);
        for (&(node, heading, _), section) in
            crown.filter(|((node, ..), _)| node.with_y(0.0).length() > 0.15 * self.width())
        {
            outwards += section * level(heading).dot(level(node));
            all += section;
        }
        outwards / all
    }

    /// Metamers that pass a height and are at least a third as thick as the thickest of them.
    pub fn stems_at(&self, share: f32) -> usize {
        let height = share * self.height();
        let passing = || self.wood.iter().filter(|&&(from, to, _)| from < height && height <= to);
        let thickest = passing().map(|&(.., radius)| radius).fold(0.0, f32::max);
        passing().filter(|&&(.., radius)| radius > thickest / 3.0).count()
    }

    /// Share of squares of two internodes in the front view's box that hold some of it.
    pub fn share_of_box_filled(&self) -> f32 {
        let cells = |length: f32| (length / 2.0) as usize;
        let (across, up) = (cells(self.width()), cells(self.height()));
        let mut filled = vec![false; across * up];
        for (node, ..) in &self.metamers {
            let x = cells(node.x - self.low.x).min(across - 1);
            filled[cells(node.y).min(up - 1) * across + x] = true;
        }
        filled.iter().filter(|&&full| full).count() as f32 / filled.len() as f32
    }

    /// How far to the right of its foot the middle of its foliage is.
    pub fn lean(&self) -> f32 {
        self.foliage().map(|(node, _)| node.x).sum::<f32>() / self.foliage().count() as f32 / self.height()
    }

    /// The height of what is farthest to the right.
    pub fn height_of_outermost(&self) -> f32 {
        let farthest = self.metamers.iter().max_by(|a, b| a.0.x.total_cmp(&b.0.x));
        farthest.map_or(0.0, |(node, ..)| node.y) / self.height()
    }
}
