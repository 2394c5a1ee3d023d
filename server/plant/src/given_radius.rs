//! Radii that whoever grows the wood gives, in place of those that follow from its tips: those of a grammar, say.
//!
//! They are wood like any other for what bears them ([`crate::widths`]), and a width constraint on the same metamer
//! goes before.

use crate::{edits::Edit, id::MetamerId, place::BadColumns, plant::Plant};

/// Radii of neighbouring rows in internodes, NaN where none is given; compared bit by bit.
#[derive(Clone, Debug, Default)]
pub struct GivenRadii(pub Vec<f32>);

/// What one edit changes of the radii given: those on the other side of its step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Given {
    /// Whose radii change, in birth order.
    pub metamers: Vec<MetamerId>,
    /// Their radii.
    pub radii: GivenRadii,
}

impl PartialEq for GivenRadii {
    fn eq(&self, other: &Self) -> bool {
        let bits = |radii: &Self| radii.0.iter().map(|radius| radius.to_bits()).collect::<Vec<_>>();
        bits(self) == bits(other)
    }
}

impl GivenRadii {
    /// No radius is given.
    pub const NONE: f32 = f32::NAN;

    /// A column that is written down as far as the last row with a radius.
    pub(crate) fn from_rows(rows: &[(u32, f32)]) -> Self {
        let mut column = Self::default();
        for &(row, radius) in rows {
            column.replace(row as usize, radius);
        }
        column
    }

    /// The rows with a radius.
    pub(crate) fn rows(&self) -> impl Iterator<Item = (usize, f32)> + '_ {
        self.0.iter().copied().enumerate().filter(|(_, radius)| !radius.is_nan())
    }

    /// The radius given to a row.
    pub(crate) fn of(&self, row: usize) -> Option<f32> {
        self.0.get(row).copied().filter(|radius| !radius.is_nan())
    }

    /// Puts another radius in place of a row's; returns the one that was.
    fn replace(&mut self, row: usize, radius: f32) -> f32 {
        if row >= self.0.len() {
            if radius.is_nan() {
                return Self::NONE;
            }
            self.0.resize(row + 1, Self::NONE);
        }
        std::mem::replace(&mut self.0[row], radius)
    }

    fn trim(&mut self) {
        let last = self.0.iter().rposition(|radius| !radius.is_nan());
        self.0.truncate(last.map_or(0, |last| last + 1));
    }
}

impl Given {
    /// Whether each row is below `end`, and its radius is one that can be given, or none.
    pub(crate) fn is_sound(&self, end: u32) -> bool {
        let radii = &self.radii.0;
        self.metamers.len() == radii.len()
            && self.metamers.is_sorted_by(|a, b| a < b)
            && self.metamers.last().is_none_or(|last| last.raw() < end)
            && radii.iter().all(|&radius| radius.is_nan() || is_radius(radius))
    }
}

/// Whether a radius can be given.
pub(crate) fn is_radius(radius: f32) -> bool {
    radius.is_finite() && radius > 0.0
}

impl Plant {
    /// Gives radii to living metamers, or takes them away, within a step: radii in internodes at their nodes, for
    /// rows in birth order, those born in this step included. All of it is one edit, which time travel takes back
    /// bit for bit.
    ///
    /// # Errors
    /// Where a row is dead, a seed, or out of order, or a radius is not finite and above 0.
    pub fn give_radii(&mut self, radii: &[(MetamerId, Option<f32>)]) -> Result<(), BadColumns> {
        debug_assert!(self.timeline.recording, "changes belong to a step");
        if !radii.is_sorted_by(|a, b| a.0 < b.0) {
            return Err(BadColumns::at(0, "the rows are not in birth order, each once"));
        }
        for &(id, radius) in radii {
            if id.index() >= self.metamer_count() || self.is_seed(id) || !self.is_alive(id) {
                return Err(BadColumns::at(id.raw(), "no living wood"));
            }
            if radius.is_some_and(|radius| !is_radius(radius)) {
                return Err(BadColumns::at(id.raw(), "the radius is not finite and above 0"));
            }
        }
        let changed: Vec<_> =
            radii.iter().filter(|&&(id, radius)| self.given_radius(id) != radius).copied().collect();
        if !changed.is_empty() {
            let mut given = Given {
                metamers: changed.iter().map(|&(id, _)| id).collect(),
                radii: GivenRadii(
                    changed.iter().map(|&(_, radius)| radius.unwrap_or(GivenRadii::NONE)).collect(),
                ),
            };
            self.swap_given(&mut given);
            self.timeline.edits.push(Edit::Given(Box::new(given)));
        }
        Ok(())
    }

    /// The radius given to a metamer, in internodes.
    pub fn given_radius(&self, id: MetamerId) -> Option<f32> {
        self.metamers.given_radius.of(id.index())
    }

    /// Living metamers with a radius given, in birth order.
    pub(crate) fn given_radii(&self) -> impl Iterator<Item = (MetamerId, f32)> + '_ {
        let rows = self.metamers.given_radius.rows().map(|(row, radius)| (MetamerId::new(row), radius));
        rows.take_while(|(id, _)| id.index() < self.metamer_count()).filter(|&(id, _)| self.is_alive(id))
    }

    /// Changes what an edit keeps for what is in force.
    pub(crate) fn swap_given(&mut self, given: &mut Given) {
        let column = &mut self.metamers.given_radius;
        for (id, radius) in given.metamers.iter().zip(&mut given.radii.0) {
            *radius = column.replace(id.index(), *radius);
        }
        column.trim();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        AxisId, Girth, Internode, Widths,
        checks::{self, tests_support::sapling},
    };

    fn give(plant: &mut Plant, radii: &[(usize, Option<f32>)]) -> Result<(), BadColumns> {
        let radii: Vec<_> = radii.iter().map(|&(row, radius)| (MetamerId::new(row), radius)).collect();
        plant.begin_edit();
        let given = plant.give_radii(&radii);
        plant.end_step();
        given
    }

    #[test]
    fn radii_are_given_and_taken_back_by_time() {
        let mut plant = sapling();
        let plain = plant.clone();
        give(&mut plant, &[(1, Some(0.5)), (3, Some(0.25))]).expect("living wood");
        give(&mut plant, &[(1, None), (2, None), (3, Some(0.75))]).expect("living wood");
        let of = |plant: &Plant| [1, 2, 3].map(|row| plant.given_radius(MetamerId::new(row)));
        assert_eq!(of(&plant), [None, None, Some(0.75)]);
        plant.go_to(2);
        assert_eq!(of(&plant), [Some(0.5), None, Some(0.25)]);
        plant.go_to(1);
        assert_eq!((plant.hash(), &plant.metamers), (plain.hash(), &plain.metamers));
        plant.go_to(3);
        assert_eq!(of(&plant), [None, None, Some(0.75)]);
        let again = Plant::from_parts(plant.to_parts()).expect("it fits together");
        assert_eq!(again, plant);
    }

    #[test]
    fn a_radius_that_is_given_already_is_no_edit() {
        let mut plant = sapling();
        give(&mut plant, &[(2, Some(0.5))]).expect("living wood");
        give(&mut plant, &[(1, None), (2, Some(0.5))]).expect("living wood");
        assert_eq!(plant.step(), 2);
    }

    #[test]
    fn only_radii_change_the_hash() {
        let (mut thin, mut thick) = (sapling(), sapling());
        give(&mut thin, &[(2, Some(0.5))]).expect("living wood");
        give(&mut thick, &[(2, Some(0.75))]).expect("living wood");
        assert_ne!(thin.hash(), thick.hash());
    }

    #[test]
    fn bad_radii_are_refused_and_change_nothing() {
        let mut plant = sapling();
        for (radii, row) in [
            (vec![(0, Some(1.0))], 0),
            (vec![(1, Some(1.0)), (9, Some(1.0))], 9),
            (vec![(1, Some(1.0)), (2, Some(0.0))], 2),
            (vec![(1, Some(f32::NAN))], 1),
            (vec![(1, Some(f32::INFINITY))], 1),
            (vec![(2, Some(1.0)), (1, Some(1.0))], 0),
        ] {
            let before = plant.clone();
            assert_eq!(give(&mut plant, &radii).map_err(|error| error.row), Err(row));
            assert_eq!(plant, before);
        }
    }

    #[test]
    fn what_is_born_in_a_step_may_be_given_a_radius_in_it() {
        let mut plant = sapling();
        plant.begin_step();
        let internode = Internode { end: glam::Vec3::Y * 4.0, normal: glam::Vec3::X, laterals: &[] };
        let born = plant.extend(AxisId::new(0), &internode);
        plant.give_radii(&[(born, Some(2.0))]).expect("living wood");
        plant.end_step();
        assert_eq!(plant.step(), 2);
        plant.go_to(1);
        assert_eq!(plant.given_radii().count(), 0);
        let future = plant.stash_future();
        assert!(plant.metamers.given_radius.0.is_empty(), "the radius went with its future");
        plant.take_future(future).expect("it is taken where it was cut off");
        plant.go_to(2);
        assert_eq!(plant.given_radius(born), Some(2.0));
        assert_eq!(checks::all(&plant), Ok(()));
    }

    #[test]
    fn a_graft_keeps_the_radii_of_what_it_is_copied_from() {
        let mut plant = sapling();
        give(&mut plant, &[(3, Some(0.5))]).expect("living wood");
        plant.begin_edit();
        let rest =
            crate::Motion { rotation: glam::Quat::IDENTITY, from: glam::Vec3::Y * 2.0, to: glam::Vec3::Y };
        let axis = plant.graft(MetamerId::new(3), MetamerId::new(1), &rest);
        plant.end_step();
        let copy = plant.axes().first(axis).expect("wood");
        assert_eq!(plant.given_radius(copy), Some(0.5));
        let girth = Girth::new(2.5, 0.1);
        assert!((Widths::of(&plant, &girth).radius(copy) - 0.5).abs() < 1e-6);
    }
}
