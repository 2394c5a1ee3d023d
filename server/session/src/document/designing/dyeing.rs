//! The colours that designs say of branches, on the rows that these are (`DS14`).

use std::sync::Arc;

use espalier_design::Dyes as OfWood;
use espalier_mesh::{Dye, Dyes, Style, dyes::DyedRows};
use espalier_plant::Plant;
use glam::Vec3;

use super::{
    Designed, Document,
    wood::{first_of, made},
};
use crate::to_proto::style_options;

/// Designs that were let go, and whose wood keeps its colours, at most: the oldest goes first (`DS14`).
pub(in crate::document) const MOST_LET_GO: usize = 8;

/// Where wood of designs stands that were let go, and its colours: they follow from the designs, but not in no time.
#[derive(Clone, Debug, Default)]
pub(super) struct LetGo {
    /// Each with the first row of its wood: on another line it may be another one.
    of: Vec<(Arc<Designed>, u32)>,
    dyed: Vec<Dyed>,
}

/// The colours of the wood of one design.
#[derive(Clone, Debug)]
struct Dyed {
    /// Its first row.
    first: u32,
    dyes: OfWood,
}

impl Document {
    /// The colours of branches in the present.
    pub fn dyes(&mut self) -> Dyes {
        let let_go = self.let_go();
        if let_go != self.designs.let_go.of {
            let dyed = let_go.iter().filter_map(|(of, _)| dyed(of, self.simulation.plant())).collect();
            self.designs.let_go = LetGo { of: let_go, dyed };
        }
        let mut all = self.designs.let_go.dyed.clone();
        if let Some(design) = self.design_in_force().filter(|design| design.says_colours()).map(Arc::clone)
            && let Some(shown) = self.shown(&design)
        {
            all.push(Dyed { first: shown.first, dyes: OfWood::of(&shown.design, &shown.generated) });
        }
        all.sort_by_key(|dyed| dyed.first);
        let mut dyes = Dyes::default();
        for Dyed { first, dyes: OfWood { materials, runs } } in &all {
            let of_material = materials.iter().map(|material| {
                let [bark, leaves] = [material.bark, material.leaves].map(Vec3::from_array);
                dyes.number(Dye { bark, leaves })
            });
            let numbers: Vec<u8> = std::iter::once(0).chain(of_material).collect();
            let mut first = *first;
            for &(count, material) in runs {
                dyes.push(DyedRows { first, count, dye: numbers[usize::from(material)] });
                first += count;
            }
        }
        dyes
    }

    /// Designs that were let go and whose wood stands, each with the first row of it.
    pub(super) fn let_go(&self) -> Vec<(Arc<Designed>, u32)> {
        let plant = self.simulation.plant();
        let standing = self.history.setting().let_go.iter().filter(|of| of.step <= plant.step());
        standing.map(|of| (Arc::clone(of), first_of(plant, of.step))).collect()
    }

    /// How its plants are drawn in files and pictures.
    pub fn style(&mut self) -> Style {
        let style = Style::new(style_options(&self.parameters()));
        style.dyed(self.dyes().by_rows(self.simulation.plant()))
    }
}

impl Designed {
    /// Whether it may say colours of any branch.
    fn says_colours(&self) -> bool {
        self.text.contains("\"material\"")
    }
}

fn dyed(of: &Arc<Designed>, plant: &Plant) -> Option<Dyed> {
    let shown = made(of, plant)?;
    Some(Dyed { first: shown.first, dyes: OfWood::of(&shown.design, &shown.generated) })
}

/// Designs that are let go once another one is in force than before, or none.
pub(in crate::document) fn let_go_after(
    let_go: &Arc<[Arc<Designed>]>,
    was: Option<&Arc<Designed>>,
    is: Option<&Arc<Designed>>,
) -> Arc<[Arc<Designed>]> {
    let is_of = |design: &Arc<Designed>| is.is_some_and(|is| is.step == design.step);
    let gone = was.filter(|was| was.says_colours() && !is_of(was));
    if gone.is_none() && !let_go.iter().any(is_of) {
        return Arc::clone(let_go);
    }
    let all: Vec<_> = let_go.iter().chain(gone).filter(|design| !is_of(design)).map(Arc::clone).collect();
    all[all.len().saturating_sub(MOST_LET_GO)..].into()
}
