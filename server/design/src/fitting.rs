//! A design for a plant that grew: limbs by thickest heir, what they are like, and as little of it said as will do.

mod course;
mod cover;
mod going;
mod grown;
mod limbs;
mod outline;
mod search;
mod shape;
mod sharing;
mod writing;

use espalier_plant::{Girth, MetamerId, Plant};
use glam::Vec3;

pub use self::grown::GrownLimb;
use self::{
    cover::Crown,
    limbs::Wood,
    search::{Search, Tried},
    sharing::share,
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
/// How much of the crown a thickness must bring to its place to be said.
const GIRTH_WORTH: f32 = 1.0 / 4000.0;

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
    /// The least design of it has more wood than there may be.
    #[error("its design would have {found} internodes, and there is room for {allowed}")]
    NoRoom {
        /// Internodes that it has.
        found: usize,
        /// As many as there may be.
        allowed: usize,
    },
    /// The least design of it has a longer text than may be kept.
    #[error("its design would have {found} bytes, allowed are {allowed}")]
    TooLong {
        /// Bytes that it has.
        found: usize,
        /// As many as there may be.
        allowed: usize,
    },
}

/// How large a fitted design may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Internodes of its wood.
    pub internodes: usize,
    /// Bytes of its text.
    pub bytes: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self { internodes: MAX_INTERNODES, bytes: usize::MAX }
    }
}

/// A design that is being fitted, one trial after another.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitting {
    trials: Trials,
    search: Search,
}

#[derive(Clone, Debug, PartialEq)]
struct Trials {
    writer: Writer,
    crown: Crown,
    limits: Limits,
}

impl Trials {
    /// The design in which limbs say these things, and what they might say besides.
    fn of(&self, said: &Said) -> Result<Tried, Unfit> {
        let (design, wishes) = self.writer.write(said).map_err(Unfit::Refused)?;
        let nodes = nodes(&design);
        let Limits { internodes, bytes } = self.limits;
        if nodes.len() > internodes {
            return Err(Unfit::NoRoom { found: nodes.len(), allowed: internodes });
        }
        let found = if bytes < usize::MAX { design.to_json().len() } else { 0 };
        if found > bytes {
            return Err(Unfit::TooLong { found, allowed: bytes });
        }
        let overlap = self.crown.overlap(&nodes);
        let records = design.graph().values();
        Ok((Fitted { design, overlap, records, shares: 0 }, wishes))
    }
}

/// Where the wood of a design stands.
fn nodes(design: &Design) -> Vec<Vec3> {
    let generated = Generator::default().generate(design, MAX_INTERNODES);
    generated.wood.nodes.iter().skip(1).map(|node| node.end).collect()
}

impl Fitting {
    /// Begins to fit a design to the living wood of a seed, with limbs up to an order; what is above counts as foliage of
    /// that order. Radii are those that the plant has by `girth`.
    ///
    /// # Errors
    /// Where there is no living wood, the orders are out of range, or the design in which no limb says anything is too
    /// large.
    pub fn new(
        plant: &Plant,
        girth: &Girth,
        seed: MetamerId,
        orders: u8,
        limits: Limits,
    ) -> Result<Self, Unfit> {
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
        let trials = Trials { writer: Writer::new(wood), crown: Crown::of(&nodes), limits };
        let search = Search::new(trials.of(&Said::default())?);
        Ok(Self { trials, search })
    }

    /// Tries one more design; false when there is none.
    pub fn step(&mut self) -> bool {
        self.search.step(|said| self.trials.of(said))
    }

    /// The best design so far.
    pub fn best(&self) -> &Fitted {
        self.search.best()
    }

    /// Designs that are still to be tried, at most.
    pub fn left(&self) -> u32 {
        self.search.left()
    }

    /// The best design of those that were tried, with the widths of limbs.
    pub fn found(self) -> Fitted {
        let Self { trials, search } = self;
        let (best, mut said, forms) = search.found();
        // A silhouette does not show how thick limbs are.
        let thick =
            |wish: &&Wish| wish.key == Key::Girth && 2.0 * wish.gain > GIRTH_WORTH * trials.crown.area();
        let girths: Vec<Wish> =
            forms.iter().filter(thick).copied().take(MAX_VALUES.saturating_sub(best.records)).collect();
        said.add(&girths);
        let best = trials.of(&said).map_or(best, |(fitted, _)| fitted);
        let mut graph = best.design.graph().clone();
        share(&mut graph);
        // Shared values are a little more to write down.
        let Limits { bytes, .. } = trials.limits;
        let fits = |design: &Design| bytes == usize::MAX || design.to_json().len() <= bytes;
        let design = Design::of(graph).ok().filter(fits).unwrap_or(best.design);
        let (records, shares) = (design.graph().values(), design.graph().shares().count());
        Fitted { overlap: trials.crown.overlap(&nodes(&design)), design, records, shares }
    }
}

/// Fits a design to the living wood of a seed, all at once (see [`Fitting::new`]).
///
/// # Errors
/// Where there is no living wood, or the orders are out of range.
pub fn fit(plant: &Plant, girth: &Girth, seed: MetamerId, orders: u8) -> Result<Fitted, Unfit> {
    let mut fitting = Fitting::new(plant, girth, seed, orders, Limits::default())?;
    while fitting.step() {}
    Ok(fitting.found())
}
