//! The edit that settles anew which wood stands: some rows fall, others rise, and no row gets another number.

use crate::{
    edits::Carried,
    given::{Given, is_radius},
    id::{AxisId, MetamerId},
    organs::Organs,
    parts::BrokenPlant,
    plant::Plant,
    time_travel::Journey,
};

/// What one edit changes of which wood stands. All but the ends of axes is what is on the other side of its step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Resettled {
    /// Steps of death of the metamers that fall or rise, in birth order; `u32::MAX` for the living.
    pub metamers: Vec<(MetamerId, u32)>,
    /// The same of axes whose bud falls or rises.
    pub axes: Vec<(AxisId, u32)>,
    /// The first and the last metamer of each axis that begins or ends elsewhere, before the step and after it.
    pub ends: Vec<AxisEnds>,
    /// Metamers that no longer count for the girth of the wood below, or count for it again, in birth order.
    pub severed: Vec<MetamerId>,
    /// Where wood stands.
    pub carried: Carried,
    /// Width constraints: diameters of metamers, in birth order.
    pub widths: Vec<(MetamerId, Option<f32>)>,
    /// Radii given.
    pub given: Given,
    /// Organs given.
    pub organs: Given<Option<Organs>>,
}

/// Where an axis begins and ends; none while it is a bud.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AxisEnds {
    /// The axis.
    pub axis: AxisId,
    /// Its first and last metamer before the step.
    pub before: Option<(MetamerId, MetamerId)>,
    /// The same after the step.
    pub after: Option<(MetamerId, MetamerId)>,
}

impl Resettled {
    /// Whether nothing changes.
    pub(crate) fn is_empty(&self) -> bool {
        let Self { metamers, axes, ends, severed, carried, widths, given, organs } = self;
        let nobody = metamers.is_empty() && axes.is_empty() && ends.is_empty() && severed.is_empty();
        let nothing = carried.metamers.is_empty() && carried.axes.is_empty() && widths.is_empty();
        nobody && nothing && given.metamers.is_empty() && organs.metamers.is_empty()
    }

    /// Whether everything named is one of the metamers and axes that there are, once and in order, and every number
    /// one that can stand there.
    pub(crate) fn is_sound(
        &self,
        [metamers, axes]: [u32; 2],
        parent: impl Fn(MetamerId) -> u32,
        axis: impl Fn(MetamerId) -> u32,
    ) -> bool {
        let is_row = |id: MetamerId| id.raw() < metamers;
        let are_ends = |ends: &AxisEnds| {
            let sides = [ends.before, ends.after].into_iter().flatten();
            let mut rows = sides.flat_map(|(first, last)| [first, last]);
            ends.axis.raw() < axes && rows.all(|id| is_row(id) && axis(id) == ends.axis.raw())
        };
        let is_width =
            |&(id, diameter): &(MetamerId, Option<f32>)| is_row(id) && diameter.is_none_or(is_radius);
        self.metamers.is_sorted_by(|a, b| a.0 < b.0)
            && self.metamers.iter().all(|&(id, _)| is_row(id))
            && self.axes.is_sorted_by(|a, b| a.0 < b.0)
            && self.axes.iter().all(|(axis, _)| axis.raw() < axes)
            && self.ends.is_sorted_by(|a, b| a.axis < b.axis)
            && self.ends.iter().all(are_ends)
            && self.severed.is_sorted_by(|a, b| a < b)
            && self.severed.iter().all(|&id| is_row(id) && parent(id) != u32::MAX)
            && self.carried.is_sound([metamers, axes])
            && self.widths.is_sorted_by(|a, b| a.0 < b.0)
            && self.widths.iter().all(is_width)
            && self.given.is_sound(metamers)
            && self.organs.is_sound(metamers)
    }

    /// Checks that each axis begins and ends where this edit finds it, and will do so at rows of its own that hang
    /// together. `chains` are the raw first and last rows of all axes, `founders` the first row of the chain that each
    /// row is part of.
    pub(crate) fn check_ends(&self, chains: &mut [[u32; 2]], founders: &[u32]) -> Result<(), BrokenPlant> {
        let raw = |side: Option<(MetamerId, MetamerId)>| match side {
            Some((first, last)) => [first.raw(), last.raw()],
            None => [u32::MAX; 2],
        };
        for ends in &self.ends {
            let chain = &mut chains[ends.axis.index()];
            let hangs_together = ends.after.is_none_or(|(first, last)| founders[last.index()] == first.raw());
            if *chain != raw(ends.before) || !hangs_together {
                return Err(BrokenPlant("an axis ends where it never was".to_owned()));
            }
            *chain = raw(ends.after);
        }
        Ok(())
    }
}

impl Plant {
    /// Changes what an edit of a step keeps for what is in force, but for tips.
    pub(crate) fn resettled(
        &mut self,
        edit: &mut Resettled,
        step: u32,
        is_back: bool,
        journey: &mut Journey,
    ) {
        for (id, death) in &mut edit.metamers {
            let was = self.metamers.death.replace(id.index(), *death);
            let (stood, stands) = (was > step, *death > step);
            *death = was;
            let wood = u32::from(!self.is_seed(*id));
            if stands && !stood {
                self.living = self.living.wrapping_add(wood);
                journey.came.push(*id);
            } else if stood && !stands {
                self.living = self.living.wrapping_sub(wood);
                journey.went.push(*id);
            }
            journey.note_axis(self.metamers.axis(*id));
        }
        self.swap_axis_deaths(edit);
        journey.axes.extend(edit.axes.iter().map(|&(axis, _)| axis));
        for ends in &edit.ends {
            let side = if is_back { ends.before } else { ends.after };
            let (first, last) = side.unwrap_or((MetamerId::NONE, MetamerId::NONE));
            self.axes.first[ends.axis.index()] = first;
            self.axes.last[ends.axis.index()] = last;
            journey.axes.push(ends.axis);
        }
        self.carry_over(&mut edit.carried, journey);
        // Buds go with what bears them, also those that point where they did.
        for &id in &edit.carried.metamers {
            journey.axes.extend(self.laterals(id));
        }
        self.swap_fields(edit);
    }

    /// Puts back, in a plant without a present yet, what was there before an edit.
    pub(crate) fn forget(&mut self, edit: &mut Resettled) {
        for (id, death) in &mut edit.metamers {
            *death = self.metamers.death.replace(id.index(), *death);
        }
        self.swap_axis_deaths(edit);
        self.swap(&mut edit.carried);
        self.swap_fields(edit);
    }

    fn swap_axis_deaths(&mut self, edit: &mut Resettled) {
        for (axis, death) in &mut edit.axes {
            *death = self.axes.death.replace(axis.index(), *death);
        }
        self.axes.death.trim();
        self.metamers.death.trim();
    }

    fn swap_fields(&mut self, edit: &mut Resettled) {
        for (id, diameter) in &mut edit.widths {
            *diameter = self.replace_width(*id, *diameter);
        }
        self.metamers.given_radius.swap(&mut edit.given);
        self.metamers.given_organs.swap(&mut edit.organs);
    }
}
