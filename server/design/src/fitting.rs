//! A design for a plant that grew: limbs by thickest heir, what they are like, and as little of it said as will do.

mod course;
mod cover;
mod going;
mod limbs;
mod outline;
mod shape;
mod sharing;
mod writing;

use espalier_plant::{Girth, MetamerId, Plant};
use glam::Vec3;

use self::{
    cover::Crown,
    limbs::Wood,
    writing::{Said, Wish, Writer},
};
use crate::{
    design::Design,
    generator::{Generator, MAX_INTERNODES},
    key::Key,
    refusal::{MAX_VALUES, Refusal},
};

/// The highest order of limbs that a design is fitted to.
pub const MOST_ORDERS: u8 = 3;
/// How much of the crown a value must bring to its place to be said.
const WORTH: f32 = 1.0 / 4000.0;
/// Values tried together at first.
const FIRST_ROUND: usize = 8;
/// Most values tried together: siblings are compared with each other.
const MOST_OF_ROUND: usize = 128;
/// Most designs that are tried.
const MOST_TRIALS: u32 = 40;
/// Values that limbs may say for the sake of the silhouette.
const KINDS: [Key; 5] = [Key::Reach, Key::Turn, Key::Axis, Key::Density, Key::Silhouette];

/// A design that was fitted to a plant.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// The design; its base is the seed's place.
    pub design: Design,
    /// How much the silhouettes of the crown that grew and of that of the design have in common: area in both over area
    /// in either, seen from the front and from the side, both views together. A silhouette is discs of radius 0.75
    /// internodes around all nodes, with gaps as wide as two internodes closed (docs/fidelity.md); pixels are a quarter
    /// of an internode wide, and wider for crowns of more than 256 internodes.
    pub overlap: f32,
    /// Values that are said in it.
    pub records: usize,
    /// Values that several limbs share.
    pub shares: usize,
}

/// Why a design cannot be fitted.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unfit {
    /// There is no such row, or it is no seed.
    #[error("row {0} is no seed")]
    NoSeed(u32),
    /// The seed is dead.
    #[error("the plant at row {0} is dead")]
    Dead(u32),
    /// Nothing has grown.
    #[error("the plant at row {0} has no wood yet")]
    NoWood(u32),
    /// So many orders there are not.
    #[error("orders is {found}, allowed is 1 to {MOST_ORDERS}")]
    Orders {
        /// What was asked for.
        found: u8,
    },
    /// The design would be refused.
    #[error("{0}")]
    Refused(Refusal),
}

/// Fits a design to the living wood of a seed, with limbs up to an order; what is above counts as foliage of that order.
/// Radii are those that the plant has by `girth`.
///
/// # Errors
/// Where there is no living wood, or the orders are out of range.
pub fn fit(plant: &Plant, girth: &Girth, seed: MetamerId, orders: u8) -> Result<Fitted, Unfit> {
    if !(1..=MOST_ORDERS).contains(&orders) {
        return Err(Unfit::Orders { found: orders });
    }
    if seed.index() >= plant.metamer_count() || !plant.is_seed(seed) {
        return Err(Unfit::NoSeed(seed.raw()));
    }
    if !plant.is_alive(seed) {
        return Err(Unfit::Dead(seed.raw()));
    }
    let wood = Wood::of(plant, girth, seed, orders).ok_or(Unfit::NoWood(seed.raw()))?;
    let base = wood.limbs[0].base();
    let nodes: Vec<Vec3> = wood.places.iter().map(|&place| place - base).collect();
    let crown = Crown::of(&nodes);
    let writer = Writer::new(&wood);
    let tried = |said: &Said| -> Result<(Fitted, Vec<Wish>), Unfit> {
        let (design, wishes) = writer.write(said).map_err(Unfit::Refused)?;
        let generated = Generator::default().generate(&design, MAX_INTERNODES);
        let nodes: Vec<Vec3> = generated.wood.nodes.iter().skip(1).map(|node| node.end).collect();
        let overlap = crown.overlap(&nodes);
        let (records, shares) = (design.graph().values(), design.graph().shares().count());
        Ok((Fitted { design, overlap, records, shares }, wishes))
    };
    let mut said = Said::default();
    let (mut best, wishes) = tried(&said)?;
    let (mut forms, mut others): (Vec<Wish>, Vec<Wish>) = wishes.into_iter().partition(Wish::is_of_form);
    // Round by round, for each value changes what others bring: the values of one kind that bring most to its place.
    let (mut count, mut trials) = (FIRST_ROUND, 0);
    while trials < MOST_TRIALS {
        let round = KINDS.iter().filter_map(|&kind| {
            let all = forms.iter().chain(&others).filter(|wish| wish.key == kind);
            let mut chosen: Vec<Wish> = all.copied().collect();
            chosen.sort_by(|a, b| b.gain.total_cmp(&a.gain).then(a.limb.cmp(&b.limb)));
            chosen.truncate(count);
            (!chosen.is_empty()).then_some(chosen)
        });
        let mut better: Option<(Fitted, Vec<Wish>, Said)> = None;
        let mut is_last = true;
        for chosen in round {
            is_last &= chosen.len() < count;
            trials += 1;
            let mut tried_said = said.clone();
            tried_said.add(&chosen);
            if best.records + chosen.len() > MAX_VALUES {
                continue;
            }
            // It may have more branches than a design has.
            let Ok((fitted, next)) = tried(&tried_said) else { continue };
            if score(&fitted) > better.as_ref().map_or(score(&best), |(better, ..)| score(better)) {
                better = Some((fitted, next, tried_said));
            }
        }
        match better {
            Some((fitted, next, now)) => {
                (best, others, said) = (fitted, next, now);
                forms.retain(|wish| !said.has(wish.limb, wish.key));
            }
            None if is_last || count >= MOST_OF_ROUND => break,
            None => count *= 2,
        }
    }
    // A silhouette does not show how thick limbs are.
    let thick = |wish: &&Wish| wish.key == Key::Girth && 2.0 * wish.gain > WORTH * crown.area();
    let girths: Vec<Wish> = forms.iter().filter(thick).copied().take(MAX_VALUES - best.records).collect();
    if girths.is_empty() {
        return Ok(best);
    }
    said.add(&girths);
    Ok(tried(&said).map_or(best, |(fitted, _)| fitted))
}

/// What speaks for a fitted design: its overlap, less what its values cost.
fn score(fitted: &Fitted) -> f32 {
    fitted.overlap - WORTH * fitted.records as f32
}
