//! The colours that designs say of branches, on the rows that these are (`DS14`).

use std::sync::Arc;

use espalier_design::Dyes as OfWood;
use espalier_mesh::{Dye, Dyes, Style, dyes::DyedRows};
use espalier_plant::Plant;
use glam::Vec3;

use super::{Designed, Document, wood::made};
use crate::to_proto::style_options;

/// Designs that were let go, and whose wood keeps its colours, at most: the oldest goes first (`LM11`).
pub(in crate::document) const MOST_LET_GO: usize = 8;

/// Where wood of designs stands that were let go, and its colours: they follow from the designs, but not in no time.
#[derive(Clone, Debug, Default)]
pub(super) struct LetGo {
    of: Vec<Arc<Designed>>,
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
        let plant = self.simulation.plant();
        let stands = |of: &&Arc<Designed>| of.step <= plant.step();
        let let_go: Vec<_> = self.history.setting().let_go.iter().filter(stands).map(Arc::clone).collect();
        if let_go != self.designs.let_go.of {
            let dyed = let_go.iter().filter_map(|of| dyed(of, plant)).collect();
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

    /// How its plants are drawn in files and pictures.
    pub fn style(&mut self) -> Style {
        let style = Style::new(style_options(&self.parameters()));
        style.dyed(self.dyes().by_rows(self.simulation.plant()))
    }

    /// Designs that were let go, and the one in force with them, which is about to be.
    pub(super) fn with_present_let_go(&self) -> Arc<[Arc<Designed>]> {
        let let_go = &self.history.setting().let_go;
        let Some(present) = self.design_in_force().filter(|design| design.says_colours()) else {
            return Arc::clone(let_go);
        };
        let all: Vec<_> = let_go.iter().chain([present]).map(Arc::clone).collect();
        all[all.len().saturating_sub(MOST_LET_GO)..].into()
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

/// Designs that were let go, with what another deed changed of that before it.
pub(in crate::document) fn fold_let_go(
    folded: Arc<[Arc<Designed>]>,
    before: &Arc<[Arc<Designed>]>,
    after: &Arc<[Arc<Designed>]>,
) -> Arc<[Arc<Designed>]> {
    if before == after {
        return folded;
    }
    if folded == *before {
        return Arc::clone(after);
    }
    let is_in = |all: &[Arc<Designed>], one: &Arc<Designed>| all.iter().any(|there| there.step == one.step);
    let stays = folded.iter().filter(|one| !is_in(before, one) || is_in(after, one));
    let comes = after.iter().filter(|one| !is_in(before, one) && !is_in(&folded, one));
    stays.chain(comes).map(Arc::clone).collect()
}
