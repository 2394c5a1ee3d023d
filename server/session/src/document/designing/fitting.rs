//! A design for a plant that grew: its wood takes the place of what grew (`DS10`).

use std::collections::BTreeMap;

use espalier_design::{Design, Fitted, Fitting, Limits, MOST_ORDERS, Unfit};
use espalier_plant::{MetamerId, Plant};
use espalier_proto::{LimbOrders, MAX_DESIGN_BYTES, Problem, Reason, version::MAX_LIMB_ORDERS};

use crate::{
    cause::Cause,
    document::{Document, growing::Pending, living},
    principal::Principal,
};

/// Up to which order limbs are described where nobody says it.
const USUAL_ORDERS: u8 = MOST_ORDERS;
const _: () = assert!(MAX_LIMB_ORDERS == MOST_ORDERS as u32);

impl Document {
    /// Begins to fit a design, if the first one that is tried could be planted.
    pub(in crate::document) fn fit_design(
        &mut self,
        cause: Cause<'_>,
        row: Option<u32>,
        orders: Option<LimbOrders>,
    ) -> Result<(), Problem> {
        // What would be refused in the end is not fitted first.
        self.require_nobody_draws()?;
        self.require_room()?;
        let plant = self.plant();
        let seed = match row {
            Some(row) => seed_of(plant, living(plant, "row", row)?),
            None => largest(plant).ok_or_else(nothing_grew)?,
        };
        let orders = orders.map_or(USUAL_ORDERS, |orders| orders.get() as u8);
        let budget = self.simulation.scene().metamer_budget() as usize;
        let limits =
            Limits { internodes: budget.saturating_sub(plant.metamer_count() + 1), bytes: MAX_DESIGN_BYTES };
        let fitting = Fitting::new(plant, &self.girth(), seed, orders, limits).map_err(unfit)?;
        self.require_design_bytes(fitting.best().design.to_json().len())?;
        let (author, gesture) = (cause.author.clone(), cause.gesture);
        self.pending.push_back(Pending::Fit(Box::new(Underway { fitting, seed, author, gesture })));
        Ok(())
    }

    /// Designs that are still to be tried, at most, while one is fitted; otherwise 0.
    pub(in crate::document) fn trials(&self) -> u32 {
        match self.pending.front() {
            Some(Pending::Fit(underway)) => underway.fitting.left(),
            _ => 0,
        }
    }

    /// Tries one more design, and plants the best one after the last. A stop ends it, and nothing has happened.
    pub(in crate::document) fn go_on_fitting(&mut self, mut underway: Box<Underway>) {
        if self.is_stopped() {
            self.outcome = Some(Err(stopped()));
            return;
        }
        // They count, so that a stop is where it was when this is done again (ST1).
        self.steps_begun = self.steps_begun.wrapping_add(1);
        if underway.fitting.step() {
            self.pending.push_front(Pending::Fit(underway));
            return;
        }
        let planted = self.plant_fitted(*underway);
        if planted.is_ok() {
            self.forget_futures();
        }
        self.outcome = Some(planted);
    }

    fn plant_fitted(&mut self, underway: Underway) -> Result<(), Problem> {
        let Underway { fitting, seed, author, gesture, .. } = underway;
        let Fitted { design, overlap, .. } = fitting.found();
        // It is read again whenever the document is opened.
        let design = read_again(&design)?;
        let plant = self.plant();
        let rows = (0..plant.metamer_count()).map(MetamerId::new);
        let stands_on_seed = |id: &MetamerId| plant.metamers().parent(*id) == Some(seed);
        let cuts: Vec<MetamerId> = rows.filter(|id| stands_on_seed(id) && plant.is_alive(*id)).collect();
        let at = plant.metamers().end(seed);
        let of = self.plant_design(Cause { author: &author, gesture }, design, at, &cuts)?;
        self.designs.fitted = Some((of, overlap));
        Ok(())
    }
}

/// A design that is being fitted for somebody, one trial at a time.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::document) struct Underway {
    fitting: Fitting,
    seed: MetamerId,
    author: Principal,
    gesture: Option<u32>,
}

/// A design as it comes back from what documents and files keep of it.
fn read_again(design: &Design) -> Result<Design, Problem> {
    let text = design.to_json();
    if text.len() > MAX_DESIGN_BYTES {
        let message = format!("its design would have {} bytes", text.len());
        return Err(Problem::new(Reason::DesignRefused, message)
            .at("kind", format!("a plant whose design has {MAX_DESIGN_BYTES} bytes at most")));
    }
    Design::from_json(&text).map_err(|_| {
        let message = "its design would be none that can be kept";
        Problem::new(Reason::DesignRefused, message).at("kind", "a plant that a design can describe")
    })
}

/// The seed of the plant that a metamer belongs to.
fn seed_of(plant: &Plant, metamer: MetamerId) -> MetamerId {
    let mut at = metamer;
    while let Some(parent) = plant.metamers().parent(at) {
        at = parent;
    }
    at
}

/// The seed of the plant with most living metamers, the first of several; none where nothing has grown.
fn largest(plant: &Plant) -> Option<MetamerId> {
    let mut seeds: Vec<MetamerId> = Vec::with_capacity(plant.metamer_count());
    let mut counts: BTreeMap<MetamerId, u32> = BTreeMap::new();
    for id in (0..plant.metamer_count()).map(MetamerId::new) {
        let parent = plant.metamers().parent(id);
        let seed = parent.map_or(id, |parent| seeds[parent.index()]);
        seeds.push(seed);
        if parent.is_some() && plant.is_alive(id) {
            *counts.entry(seed).or_default() += 1;
        }
    }
    counts.into_iter().rev().max_by_key(|&(_, count)| count).map(|(seed, _)| seed)
}

fn nothing_grew() -> Problem {
    Problem::new(Reason::DesignRefused, "nothing has grown yet that a design could describe")
        .at("kind", "a design of a plant with wood")
}

fn stopped() -> Problem {
    Problem::new(Reason::FitStopped, "somebody has stopped it; the plant is as it was")
        .at("kind", "a design that is fitted to its end")
}

fn unfit(unfit: Unfit) -> Problem {
    match &unfit {
        Unfit::NoSeed(_) | Unfit::Dead(_) | Unfit::NoWood(_) => {
            Problem::new(Reason::DesignRefused, unfit.to_string()).at("row", "a plant with wood")
        }
        Unfit::NoRoom { allowed, .. } => Problem::new(Reason::TreeFull, unfit.to_string())
            .at("kind", format!("a plant whose design has {allowed} internodes at most")),
        Unfit::Orders { .. } | Unfit::Refused(_) | Unfit::TooLong { .. } => {
            Problem::new(Reason::DesignRefused, unfit.to_string())
                .at("kind", "a plant that a design can describe")
        }
    }
}
