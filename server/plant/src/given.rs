//! What rows are given by whoever lays them down, in place of what would follow from the plant: radii of a grammar or a
//! scan, organs of a grammar.
//!
//! A radius given is wood like any other for what bears it ([`crate::widths`]), and a width constraint on the same
//! metamer goes before. Where organs are given, their leaves are all that the metamer bears ([`crate::organs`]).

use std::fmt::Debug;

use crate::{
    edits::Edit,
    id::MetamerId,
    organs::{MOST_ORGANS, Organs},
    place::BadColumns,
    plant::Plant,
};

/// A value that a row can be given.
pub trait GivenValue: Clone + Debug {
    /// Nothing is given.
    const NONE: Self;

    /// Whether something is given.
    fn is_given(&self) -> bool;

    /// Whether two are equal to the bit.
    fn is_same(&self, other: &Self) -> bool;

    /// Whether it can be given.
    fn is_sound(&self) -> bool;
}

/// In internodes, NaN where none is given.
impl GivenValue for f32 {
    const NONE: Self = Self::NAN;

    fn is_given(&self) -> bool {
        !self.is_nan()
    }

    fn is_same(&self, other: &Self) -> bool {
        self.to_bits() == other.to_bits()
    }

    fn is_sound(&self) -> bool {
        is_radius(*self)
    }
}

impl GivenValue for Option<Organs> {
    const NONE: Self = None;

    fn is_given(&self) -> bool {
        self.is_some()
    }

    fn is_same(&self, other: &Self) -> bool {
        self == other
    }

    fn is_sound(&self) -> bool {
        self.as_ref().is_some_and(|organs| organs.len() <= MOST_ORGANS)
    }
}

/// What neighbouring rows are given, written down as far as the last that is given something.
#[derive(Clone, Debug)]
pub struct GivenColumn<T>(pub Vec<T>);

/// Radii that rows are given, in internodes.
pub type GivenRadii = GivenColumn<f32>;
/// Organs that rows are given.
pub type GivenOrgans = GivenColumn<Option<Organs>>;

/// What one edit changes of what rows are given: what is on the other side of its step.
#[derive(Clone, Debug, PartialEq)]
pub struct Given<T: GivenValue = f32> {
    /// Which rows, in birth order.
    pub metamers: Vec<MetamerId>,
    /// What they are given.
    pub values: GivenColumn<T>,
}

impl<T> Default for GivenColumn<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<T: GivenValue> Default for Given<T> {
    fn default() -> Self {
        Self { metamers: Vec::new(), values: GivenColumn::default() }
    }
}

impl<T: GivenValue> PartialEq for GivenColumn<T> {
    fn eq(&self, other: &Self) -> bool {
        self.0.len() == other.0.len() && self.0.iter().zip(&other.0).all(|(a, b)| a.is_same(b))
    }
}

impl<T: GivenValue> GivenColumn<T> {
    /// A column that is written down as far as the last row that is given something.
    pub(crate) fn from_rows(rows: impl IntoIterator<Item = (u32, T)>) -> Self {
        let mut column = Self::default();
        for (row, value) in rows {
            column.replace(row as usize, value);
        }
        column
    }

    /// The rows that are given something.
    pub fn rows(&self) -> impl Iterator<Item = (usize, &T)> + '_ {
        self.0.iter().enumerate().filter(|(_, value)| value.is_given())
    }

    /// What a row is given.
    pub fn of(&self, row: usize) -> Option<&T> {
        self.0.get(row).filter(|value| value.is_given())
    }

    /// Gives a row something else; returns what it was given.
    pub fn replace(&mut self, row: usize, value: T) -> T {
        if row >= self.0.len() {
            if !value.is_given() {
                return T::NONE;
            }
            self.0.resize(row + 1, T::NONE);
        }
        std::mem::replace(&mut self.0[row], value)
    }

    /// Forgets what rows from one on are given.
    pub fn truncate(&mut self, rows: usize) {
        self.0.truncate(rows);
        self.trim();
    }

    /// Whether no row is given anything.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    fn trim(&mut self) {
        let last = self.0.iter().rposition(T::is_given);
        self.0.truncate(last.map_or(0, |last| last + 1));
    }

    /// Changes what an edit keeps for what is in force.
    pub(crate) fn swap(&mut self, given: &mut Given<T>) {
        for (id, value) in given.metamers.iter().zip(&mut given.values.0) {
            *value = self.replace(id.index(), value.clone());
        }
        self.trim();
    }

    /// The edit that gives rows in birth order something else, for those to which it is something else; none where
    /// that is none of them.
    fn edit(&self, rows: &[(MetamerId, T)]) -> Option<Given<T>> {
        let none = T::NONE;
        let now = |id: MetamerId| self.0.get(id.index()).unwrap_or(&none);
        let (metamers, values): (Vec<_>, Vec<_>) =
            rows.iter().filter(|(id, value)| !now(*id).is_same(value)).cloned().unzip();
        (!metamers.is_empty()).then_some(Given { metamers, values: GivenColumn(values) })
    }
}

impl GivenRadii {
    /// No radius is given.
    pub const NONE: f32 = f32::NAN;
}

impl<T: GivenValue> Given<T> {
    /// Whether each row is below `end`, and is given what can be given, or nothing.
    pub(crate) fn is_sound(&self, end: u32) -> bool {
        self.metamers.len() == self.values.0.len()
            && self.metamers.is_sorted_by(|a, b| a < b)
            && self.metamers.last().is_none_or(|last| last.raw() < end)
            && self.values.0.iter().all(|value| !value.is_given() || value.is_sound())
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
        if let Some((id, _)) =
            radii.iter().find(|(_, radius)| radius.is_some_and(|radius| !is_radius(radius)))
        {
            return Err(BadColumns::at(id.raw(), "the radius is not finite and above 0"));
        }
        let radii: Vec<_> = radii.iter().map(|&(id, radius)| (id, radius.unwrap_or(f32::NONE))).collect();
        self.check_givable(&radii)?;
        if let Some(mut given) = self.metamers.given_radius.edit(&radii) {
            self.metamers.given_radius.swap(&mut given);
            self.timeline.edits.push(Edit::Given(Box::new(given)));
        }
        Ok(())
    }

    /// Gives organs to living metamers within a step, as [`Plant::give_radii`] does radii; none takes back what was
    /// given, so that the metamer bears again what grows on such wood.
    ///
    /// # Errors
    /// Where a row is dead, a seed, or out of order, or there are more organs than a metamer can bear.
    pub fn give_organs(&mut self, organs: &[(MetamerId, Option<Organs>)]) -> Result<(), BadColumns> {
        let is_much = |organs: &&(MetamerId, Option<Organs>)| organs.1.is_given() && !organs.1.is_sound();
        if let Some((id, _)) = organs.iter().find(is_much) {
            return Err(BadColumns::at(id.raw(), "there are more organs than a metamer can bear"));
        }
        self.check_givable(organs)?;
        if let Some(mut given) = self.metamers.given_organs.edit(organs) {
            self.metamers.given_organs.swap(&mut given);
            self.timeline.edits.push(Edit::Borne(Box::new(given)));
        }
        Ok(())
    }

    fn check_givable<T>(&self, rows: &[(MetamerId, T)]) -> Result<(), BadColumns> {
        debug_assert!(self.timeline.recording, "changes belong to a step");
        if !rows.is_sorted_by(|a, b| a.0 < b.0) {
            return Err(BadColumns::at(0, "the rows are not in birth order, each once"));
        }
        let is_wood =
            |id: MetamerId| id.index() < self.metamer_count() && !self.is_seed(id) && self.is_alive(id);
        match rows.iter().find(|(id, _)| !is_wood(*id)) {
            Some((id, _)) => Err(BadColumns::at(id.raw(), "no living wood")),
            None => Ok(()),
        }
    }

    /// The radius given to a metamer, in internodes.
    pub fn given_radius(&self, id: MetamerId) -> Option<f32> {
        self.metamers.given_radius.of(id.index()).copied()
    }

    /// The organs given to a metamer; none where it bears what grows on such wood.
    pub fn given_organs(&self, id: MetamerId) -> Option<&Organs> {
        self.metamers.given_organs.of(id.index())?.as_ref()
    }

    /// All that is given of organs in the present.
    pub fn organs(&self) -> &GivenOrgans {
        &self.metamers.given_organs
    }

    /// Living metamers with a radius given, in birth order.
    pub(crate) fn given_radii(&self) -> impl Iterator<Item = (MetamerId, f32)> + '_ {
        let rows = self.metamers.given_radius.rows().map(|(row, radius)| (MetamerId::new(row), *radius));
        rows.take_while(|(id, _)| id.index() < self.metamer_count()).filter(|&(id, _)| self.is_alive(id))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        AxisId, Girth, Internode, Organ, OrganKind, Widths,
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

    #[test]
    fn organs_are_given_and_taken_back_by_time() {
        let leaf = |azimuth| Organ { kind: OrganKind::Leaf, azimuth, inclination: 80, roll: 0, length: 9 };
        let give = |plant: &mut Plant, organs: &[(usize, Option<Organs>)]| {
            let organs: Vec<_> =
                organs.iter().map(|(row, organs)| (MetamerId::new(*row), organs.clone())).collect();
            plant.begin_edit();
            let given = plant.give_organs(&organs);
            plant.end_step();
            given
        };
        let mut plant = sapling();
        let plain = plant.clone();
        give(&mut plant, &[(1, Some([].into())), (3, Some([leaf(1), leaf(2)].into()))]).expect("living wood");
        give(&mut plant, &[(1, None), (3, Some([leaf(2)].into()))]).expect("living wood");
        let counts = |plant: &Plant| {
            [1, 2, 3].map(|row| plant.given_organs(MetamerId::new(row)).map(|organs| organs.len()))
        };
        assert_eq!(counts(&plant), [None, None, Some(1)]);
        let one = plant.hash();
        plant.go_to(2);
        assert_eq!(counts(&plant), [Some(0), None, Some(2)]);
        assert_ne!(plant.hash(), one);
        plant.go_to(1);
        assert_eq!((plant.hash(), &plant.metamers), (plain.hash(), &plain.metamers));
        plant.go_to(3);
        let again = Plant::from_parts(plant.to_parts()).expect("it fits together");
        assert_eq!(again, plant);
        for (organs, row) in [(vec![(0, Some([].into()))], 0), (vec![(2, Some([leaf(0); 16].into()))], 2)] {
            let before = plant.clone();
            assert_eq!(give(&mut plant, &organs).map_err(|error| error.row), Err(row));
            assert_eq!(plant, before);
        }
    }
}
