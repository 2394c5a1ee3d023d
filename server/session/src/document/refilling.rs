//! A limb that grew fills another outline (`DS12`): it is cut back, and grows into what is free.

mod hull;
mod limb;

use espalier_design::Envelope;
use espalier_growth::REACH;
use espalier_plant::AxisId;
use espalier_proto::{DesignValue, LimbLength, Problem, Reason, UnitRotation, version::MAX_OUTLINE_STEPS};

use self::{
    hull::Hull,
    limb::{CutBack, Keeps},
};
use super::{Document, growing::Pending, hints::OpenLasso, history::Kind};
use crate::cause::Cause;

/// The part of the metamers that a document may still hold which an outline may take.
const SHARE_OF_ROOM: f64 = 0.25;

/// What a limb is to fill.
pub(super) struct Outline<'a> {
    pub envelope: &'a DesignValue,
    pub rotation: UnitRotation,
    pub length: LimbLength,
    /// Whether all above the first fork goes.
    pub anew: bool,
}

impl Document {
    pub(super) fn refill(
        &mut self,
        cause: Cause<'_>,
        row: u32,
        outline: &Outline<'_>,
    ) -> Result<(), Problem> {
        self.require_nobody_draws()?;
        self.require_room()?;
        let first = self.wood("row", row)?;
        if self.is_designed(row) {
            let message = "this wood follows a design; say its silhouette there (edit_design)";
            return Err(Problem::new(Reason::DesignRefused, message).at("row", "wood that no design made"));
        }
        let envelope = Envelope::from_json(outline.envelope.get())
            .map_err(|refusal| Problem::from(refusal).within("envelope"))?;
        let plant = self.plant();
        let base = plant
            .metamers()
            .parent(first)
            .map_or_else(|| plant.metamers().end(first), |bearer| plant.metamers().end(bearer));
        let hull = Hull::new(envelope, base, outline.rotation.get(), outline.length.get());
        let zone = self.simulation.parameters().occupancy_radius;
        let body = hull.body(zone).map_err(|error| {
            Problem::new(Reason::NoRoom, format!("nothing can grow into this: {error}"))
                .at("envelope", "an outline around some room within the world")
        })?;
        let room = self.simulation.scene().metamer_budget() - plant.metamer_count() as u32;
        let most = SHARE_OF_ROOM * f64::from(room);
        if body.wood() > most {
            let message = format!("some {:.0} metamers would fill this outline", body.wood());
            return Err(Problem::new(Reason::TreeFull, message)
                .at("envelope", format!("an outline for {most:.0} metamers at most")));
        }
        let keeps = match outline.anew {
            true => Keeps::BelowFork,
            false => Keeps::Within(&hull),
        };
        let cut_back = CutBack::of(plant, first, &keeps);
        let is_near = |place| body.contains(place) || body.distance_to_box(place) <= REACH;
        let mut buds = (0..plant.axis_count())
            .map(AxisId::new)
            .filter(|&axis| plant.is_axis_alive(axis) && cut_back.keeps(plant.bud_node(axis)));
        let sprouts = cut_back.sprout.is_some_and(|end| is_near(plant.metamers().end(end)));
        if !sprouts && !buds.any(|axis| is_near(plant.bud_position(axis))) {
            let message = format!("no bud of the limb is within {REACH} internodes of this outline");
            return Err(Problem::new(Reason::NoRoom, message).at("envelope", "an outline around the limb"));
        }
        self.record(Kind::Refill, cause);
        let changes = !cut_back.cuts.is_empty();
        if changes || cut_back.sprout.is_some() {
            self.simulation.cut_back(&cut_back.cuts, cut_back.sprout);
            self.reach();
            self.release_lost_bends();
        }
        self.simulation.enclose(&body);
        // Where something was cut that alone may be what was wanted.
        let lasso = (!changes).then(|| OpenLasso::around_limb(body, hull.tip(), self.plant()));
        self.pending.push_back(Pending::Lasso { left: MAX_OUTLINE_STEPS, chosen: Some(first), lasso });
        Ok(())
    }
}
