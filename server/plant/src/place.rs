//! Whole columns of wood put elsewhere in one edit, as a generator needs that computes every place anew.

use glam::Vec3;

use crate::{
    checks::{is_across, is_unit},
    edits::{Carried, Edit, SHORTEST},
    id::MetamerId,
    plant::Plant,
};

/// Columns that a plant cannot take; nothing has changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("row {row}: {what}")]
pub struct BadColumns {
    /// The row of the metamer, or of the axis, at fault.
    pub row: u32,
    /// What is wrong with it.
    pub what: &'static str,
}

impl BadColumns {
    pub(crate) fn at(row: u32, what: &'static str) -> Self {
        Self { row, what }
    }
}

impl Plant {
    /// Puts wood where columns say, within a step: ends in internodes, unit normals, unit directions of buds.
    /// Rows that are not named stay. All of it is one edit, which time travel takes back bit for bit; rows that
    /// stand there already are left out of it, and where none moves there is no edit. Returns what moved and where
    /// it was. One pass over the metamers from the first row named on.
    ///
    /// # Errors
    /// Where columns differ in length, rows are out of birth order, dead, or born in this step, numbers are not
    /// finite, normals and directions not unit vectors, or a living internode would be shorter than 0.01 or not
    /// square to its normal (tolerance 0.001), which includes those that stand on what moves.
    pub fn place(&mut self, mut placed: Carried) -> Result<Vec<(MetamerId, Vec3)>, BadColumns> {
        debug_assert!(self.timeline.recording, "changes belong to a step");
        self.check_columns(&placed)?;
        placed.retain_if_changed(self);
        if placed.metamers.is_empty() && placed.axes.is_empty() {
            return Ok(Vec::new());
        }
        self.swap(&mut placed);
        if let Err(error) = self.check_orientations(&placed.metamers) {
            self.swap(&mut placed);
            return Err(error);
        }
        let moved = placed.metamers.iter().copied().zip(placed.ends.iter().copied()).collect();
        self.timeline.edits.push(Edit::Carried(Box::new(placed)));
        Ok(moved)
    }

    fn check_columns(&self, placed: &Carried) -> Result<(), BadColumns> {
        let Carried { metamers, ends, normals, axes, directions } = placed;
        if ends.len() != metamers.len() || normals.len() != metamers.len() || directions.len() != axes.len() {
            return Err(BadColumns::at(0, "the columns differ in length"));
        }
        if !metamers.is_sorted_by(|a, b| a < b) || !axes.is_sorted_by(|a, b| a < b) {
            return Err(BadColumns::at(0, "the rows are not in birth order, each once"));
        }
        // Within a step edits come before births: what is born in it has no other place to be put back to.
        let before = self.timeline.before(self.timeline.now);
        for ((&id, end), &normal) in metamers.iter().zip(ends).zip(normals) {
            if id.raw() >= before.metamers || !self.is_alive(id) {
                return Err(BadColumns::at(id.raw(), "no metamer that lives and was there before this step"));
            }
            if !end.is_finite() || !is_unit(normal) {
                return Err(BadColumns::at(id.raw(), "the end is not finite, or the normal no unit vector"));
            }
        }
        for (&axis, &direction) in axes.iter().zip(directions) {
            if axis.raw() >= before.axes || !self.is_standing(axis) {
                return Err(BadColumns::at(axis.raw(), "no axis that stands and was there before this step"));
            }
            if !is_unit(direction) {
                return Err(BadColumns::at(axis.raw(), "the direction is no unit vector"));
            }
        }
        Ok(())
    }

    /// Checks the orientations of these metamers, which are in birth order, and of all that stand on them.
    fn check_orientations(&self, placed: &[MetamerId]) -> Result<(), BadColumns> {
        let Some(first) = placed.first().map(|first| first.index()) else { return Ok(()) };
        let mut is_placed = vec![false; self.metamer_count() - first];
        for id in placed {
            is_placed[id.index() - first] = true;
        }
        let is_placed = |id: MetamerId| id.index().checked_sub(first).is_some_and(|at| is_placed[at]);
        for id in (first..self.metamer_count()).map(MetamerId::new).filter(|&id| self.is_alive(id)) {
            let Some(parent) = self.metamers.parent(id) else { continue };
            if !is_placed(id) && !is_placed(parent) {
                continue;
            }
            if self.metamers.end(id).distance(self.metamers.end(parent)) < SHORTEST {
                return Err(BadColumns::at(id.raw(), "the internode has no length"));
            }
            if !is_across(self.heading(id), self.metamers.normal(id)) {
                return Err(BadColumns::at(id.raw(), "the normal is not square to the internode"));
            }
        }
        Ok(())
    }
}

impl Carried {
    /// Leaves out what stands there already, bit for bit.
    fn retain_if_changed(&mut self, plant: &Plant) {
        let bits = |v: Vec3| v.to_array().map(f32::to_bits);
        let mut at = 0;
        for row in 0..self.metamers.len() {
            let (id, end, normal) = (self.metamers[row], self.ends[row], self.normals[row]);
            let is_there =
                bits(end) == bits(plant.metamers.end(id)) && bits(normal) == bits(plant.metamers.normal(id));
            (self.metamers[at], self.ends[at], self.normals[at]) = (id, end, normal);
            at += usize::from(!is_there);
        }
        self.metamers.truncate(at);
        self.ends.truncate(at);
        self.normals.truncate(at);
        let mut at = 0;
        for row in 0..self.axes.len() {
            let (axis, direction) = (self.axes[row], self.directions[row]);
            (self.axes[at], self.directions[at]) = (axis, direction);
            at += usize::from(bits(direction) != bits(plant.axes.direction(axis)));
        }
        self.axes.truncate(at);
        self.directions.truncate(at);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        checks::{self, tests_support::sapling},
        id::AxisId,
    };

    fn column(rows: &[usize], ends: &[Vec3], normals: &[Vec3]) -> Carried {
        let metamers = rows.iter().map(|&row| MetamerId::new(row)).collect();
        Carried { metamers, ends: ends.to_vec(), normals: normals.to_vec(), ..Carried::default() }
    }

    fn try_to(plant: &mut Plant, placed: Carried) -> Result<Vec<(MetamerId, Vec3)>, BadColumns> {
        plant.begin_edit();
        let moved = plant.place(placed);
        plant.end_step();
        moved
    }

    /// The upright sapling laid along z.
    fn laid_down() -> Carried {
        let ends = [Vec3::Z, Vec3::Z * 2.0, Vec3::Z * 3.0];
        Carried {
            axes: vec![AxisId::new(0)],
            directions: vec![Vec3::Z],
            ..column(&[1, 2, 3], &ends, &[Vec3::X; 3])
        }
    }

    #[test]
    fn columns_move_in_one_edit_and_back() {
        let mut plant = sapling();
        let before = plant.clone();
        let moved = try_to(&mut plant, laid_down()).expect("it fits");
        let was: Vec<_> = (1..=3).map(|row| (MetamerId::new(row), Vec3::Y * row as f32)).collect();
        assert_eq!(moved, was);
        assert_eq!((plant.step(), plant.to_parts().edits.len()), (2, 1));
        assert_eq!(
            (plant.heading(MetamerId::new(2)), plant.axes().direction(AxisId::new(0))),
            (Vec3::Z, Vec3::Z)
        );
        assert_eq!(checks::all(&plant), Ok(()));
        let after = plant.hash();
        plant.go_to(1);
        assert_eq!(plant.hash(), before.hash());
        plant.go_to(2);
        assert_eq!(plant.hash(), after);
    }

    #[test]
    fn what_stands_there_already_is_not_recorded() {
        let mut plant = sapling();
        try_to(&mut plant, laid_down()).expect("it fits");
        assert_eq!(try_to(&mut plant, laid_down()), Ok(Vec::new()));
        assert_eq!((plant.step(), plant.to_parts().edits.len()), (2, 1));
        // Only the tip is elsewhere.
        let ends = [Vec3::Z, Vec3::Z * 2.0, Vec3::Z * 4.0];
        let moved = try_to(&mut plant, column(&[1, 2, 3], &ends, &[Vec3::X; 3])).expect("it fits");
        assert_eq!(moved, [(MetamerId::new(3), Vec3::Z * 3.0)]);
    }

    #[test]
    fn bad_columns_are_refused_and_change_nothing() {
        let cases = [
            (column(&[1], &[], &[]), "the columns differ in length"),
            (column(&[2, 1], &[Vec3::Y; 2], &[Vec3::X; 2]), "the rows are not in birth order, each once"),
            (column(&[1, 1], &[Vec3::Y; 2], &[Vec3::X; 2]), "the rows are not in birth order, each once"),
            (column(&[9], &[Vec3::Y], &[Vec3::X]), "no metamer that lives and was there before this step"),
            (column(&[1], &[Vec3::NAN], &[Vec3::X]), "the end is not finite, or the normal no unit vector"),
            (column(&[1], &[Vec3::Y], &[Vec3::ZERO]), "the end is not finite, or the normal no unit vector"),
            (column(&[1], &[Vec3::Y], &[Vec3::Y]), "the normal is not square to the internode"),
            (column(&[2], &[Vec3::Y], &[Vec3::X]), "the internode has no length"),
            // The metamer above leans now, across its normal no longer.
            (
                column(&[2], &[Vec3::new(0.5, 2.0, 0.0)], &[Vec3::Z]),
                "the normal is not square to the internode",
            ),
            (
                Carried { axes: vec![AxisId::new(40)], directions: vec![Vec3::X], ..Carried::default() },
                "no axis that stands and was there before this step",
            ),
            (
                Carried { axes: vec![AxisId::new(1)], directions: vec![Vec3::X * 2.0], ..Carried::default() },
                "the direction is no unit vector",
            ),
        ];
        let mut plant = sapling();
        for (placed, what) in cases {
            let before = plant.clone();
            assert_eq!(try_to(&mut plant, placed).map_err(|error| error.what), Err(what));
            assert_eq!(plant, before);
        }
    }

    #[test]
    fn what_is_born_in_a_step_is_not_placed_in_it() {
        let mut plant = sapling();
        plant.begin_step();
        let internode = crate::Internode { end: Vec3::Y * 4.0, normal: Vec3::X, laterals: &[] };
        let born = plant.extend(AxisId::new(0), &internode);
        let error = plant.place(column(&[born.index()], &[Vec3::Y * 5.0], &[Vec3::X]));
        assert_eq!(error.map_err(|error| error.row), Err(born.raw()));
        plant.end_step();
        assert_eq!(checks::all(&plant), Ok(()));
    }
}
