//! What a plant bears, as triangles that show pictures: leaves, flowers and fruits, for files and for pictures alike.

pub(crate) mod cards;
pub(crate) mod leaf_look;
pub(crate) mod ornaments;

use espalier_mesh::{
    Bodies, Style, foliage,
    leaves::{self, Leaf},
    ring_table::told,
};
use espalier_plant::{MetamerId, Organ, OrganKind, Plant, Widths};
use espalier_settings::{Appearance, LeafLook};
use glam::Vec3;

use self::{
    cards::{Cards, LeafForm, LeafInstance},
    leaf_look::{LeafPainter, Shoot},
    ornaments::Bearer,
};

/// At each level of detail one of so many leaves is drawn, so large that they cover as much.
const ONE_OF: [u32; 3] = [1, 2, 6];

/// Leaves are divided into no more blades than this in all, or a file of a great tree would hold little else.
const MOST_BLADES: usize = 200_000;

/// What each metamer of a plant bears in a look.
pub(crate) struct Foliage<'a> {
    plant: &'a Plant,
    style: &'a Style,
    look: Appearance,
    /// The wood that bears it as it is drawn; none where it runs from node to node.
    wood: Option<Bodies>,
    widths: Widths<'a>,
    /// Which metamers their axis goes on beyond.
    goes_on: Vec<bool>,
    painter: LeafPainter,
    form: LeafForm,
    one_of: u32,
}

impl<'a> Foliage<'a> {
    /// At a level of detail, from 0, the finest.
    pub(crate) fn of(plant: &'a Plant, style: &'a Style, look: &'a Appearance, level: usize) -> Self {
        let leaves: usize = living(plant).map(|id| usize::from(foliage::leaves(plant, id, style))).sum();
        // Coarser levels are seen from where blades of a leaf run together.
        let room = MOST_BLADES.checked_div(leaves).unwrap_or(MOST_BLADES).max(1);
        let blades = if level == 0 { look.leaves.blades.min(room as u32) } else { 1 };
        Self {
            plant,
            style,
            look: with_given(plant, look),
            wood: None,
            widths: Widths::of(plant, style.girth()),
            goes_on: goes_on(plant),
            painter: LeafPainter::new(&LeafLook { blades, ..look.leaves }),
            form: LeafForm::new(look.leaves.shape, leaves * blades as usize, level),
            one_of: ONE_OF[level.min(ONE_OF.len() - 1)],
        }
    }

    /// The same on wood as it is drawn, of the same plant.
    pub(crate) fn upon(self, wood: &Bodies) -> Self {
        Self { wood: Some(wood.clone()), ..self }
    }

    /// Where a metamer begins and where it ends.
    pub(crate) fn ends(&self, id: MetamerId) -> [Vec3; 2] {
        let metamers = self.plant.metamers();
        let place = |id: MetamerId| match &self.wood {
            Some(wood) => wood.places()[id.index()],
            None => metamers.end(id),
        };
        [place(metamers.parent(id).unwrap_or(id)), place(id)]
    }

    /// The leaves of a metamer as they hang, and their colours.
    pub(crate) fn leaves(&self, id: MetamerId) -> impl Iterator<Item = (Leaf, Vec3)> {
        let shoot = Shoot::of(self.plant, id);
        let (larger, dye) = ((self.one_of as f32).sqrt(), self.style.dyes().of(id).leaves);
        let leaves = leaves::of_between(self.plant, id, self.style, self.ends(id));
        let all = (id.raw()..).zip(leaves);
        all.filter(|(number, _)| number % self.one_of == 0)
            .flat_map(move |(_, leaf)| self.painter.paint(Leaf { size: larger * leaf.size, ..leaf }, shoot))
            .map(move |(leaf, hue)| (leaf, hue * dye))
    }

    /// Adds the leaves of a metamer.
    pub(crate) fn add_leaves(&self, cards: &mut Cards, id: MetamerId) {
        for (leaf, hue) in self.leaves(id) {
            self.form.add(cards, &leaf, hue);
        }
    }

    /// The leaves of a metamer as places of few forms, and their colours.
    pub(crate) fn instances(&self, id: MetamerId) -> impl Iterator<Item = (LeafInstance, Vec3)> {
        self.leaves(id).map(|(leaf, hue)| (self.form.instance(&leaf), hue))
    }

    /// What all its leaves have in common.
    pub(crate) fn form(&self) -> &LeafForm {
        &self.form
    }

    /// Whether a metamer bears leaves in summer.
    pub(crate) fn is_leafy(&self, id: MetamerId) -> bool {
        foliage::leaves(self.plant, id, self.style) > 0
    }

    /// The radius of a metamer, in internodes.
    pub(crate) fn radius(&self, id: MetamerId) -> f32 {
        self.widths.radius(id)
    }

    /// The look that it has.
    pub(crate) fn look(&self) -> &Appearance {
        &self.look
    }

    /// Adds the flowers of a metamer.
    pub(crate) fn add_flowers(&self, cards: &mut Cards, id: MetamerId) {
        let organs = told(self.plant, id);
        ornaments::add_flowers(
            cards,
            &self.bearer(id, organs.as_deref().unwrap_or_default()),
            &self.look.flowers,
        );
    }

    /// Adds the fruits of a metamer.
    pub(crate) fn add_fruits(&self, cards: &mut Cards, id: MetamerId) {
        let organs = told(self.plant, id);
        ornaments::add_fruits(
            cards,
            &self.bearer(id, organs.as_deref().unwrap_or_default()),
            &self.look.fruits,
        );
    }

    fn bearer<'b>(&self, id: MetamerId, organs: &'b [Organ]) -> Bearer<'b> {
        Bearer {
            row: id.raw(),
            ends: self.ends(id),
            radius: self.radius(id),
            is_leafy: self.is_leafy(id),
            is_tip: !self.goes_on[id.index()],
            vigor: Shoot::of(self.plant, id).vigor,
            organs,
        }
    }
}

/// A look that shows flowers and fruits which metamers of the plant are given.
fn with_given(plant: &Plant, look: &Appearance) -> Appearance {
    let has = |kind| {
        let mut all = plant.organs().rows().filter_map(|(_, organs)| organs.as_ref());
        all.any(|organs| organs.iter().any(|organ| organ.kind == kind))
    };
    let [flowers, fruits] = [OrganKind::Flower, OrganKind::Fruit].map(has);
    Appearance {
        flowers: if flowers { look.flowers.with_given() } else { look.flowers },
        fruits: if fruits { look.fruits.with_given() } else { look.fruits },
        ..*look
    }
}

/// The living metamers that are no seeds, in birth order.
pub(crate) fn living(plant: &Plant) -> impl Iterator<Item = MetamerId> + '_ {
    (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id) && !plant.is_seed(id))
}

fn goes_on(plant: &Plant) -> Vec<bool> {
    let mut goes_on = vec![false; plant.metamer_count()];
    for id in living(plant) {
        let metamers = plant.metamers();
        if let Some(parent) = metamers.parent(id).filter(|&parent| metamers.axis(parent) == metamers.axis(id))
        {
            goes_on[parent.index()] = true;
        }
    }
    goes_on
}
