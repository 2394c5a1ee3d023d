//! What is laid down together, of columns from outside.

use std::ops::Range;

use crate::{
    edits::Edit,
    id::{AxisId, MetamerId},
    parts::{BrokenPlant, check_edit},
};

/// Rows of some steps as raw columns; `u32::MAX` stands for none. Rows of earlier steps are known as well.
pub(crate) struct Births<'a, Parent, Axis, Bearer> {
    /// Metamers, axes, edits and steps of growth where the first step begins, and at the end of each.
    pub ends: &'a [[u32; 4]],
    /// The edits of these steps.
    pub edits: &'a [Edit],
    /// A metamer's parent.
    pub parent: Parent,
    /// A metamer's axis.
    pub axis: Axis,
    /// The metamer that bears an axis.
    pub bearer: Bearer,
}

impl<Parent, Axis, Bearer> Births<'_, Parent, Axis, Bearer>
where
    Parent: Fn(u32) -> u32,
    Axis: Fn(u32) -> u32,
    Bearer: Fn(u32) -> u32,
{
    /// The first of the lateral axes that each metamer lays down.
    ///
    /// A metamer lays down its laterals in its own step and one after another, and a seed its trunk; only what is
    /// grafted joins older wood. In every step of the past, therefore, what is there has what it stands on.
    pub fn laterals(&self) -> Result<Vec<AxisId>, BrokenPlant> {
        let first_row = self.ends.first().map_or(0, |end| end[0]);
        let last_row = self.ends.last().map_or(0, |end| end[0]);
        let mut laterals = vec![AxisId::NONE; (last_row - first_row) as usize];
        for pair in self.ends.windows(2) {
            let grafts = self.grafts(pair[0], pair[1])?;
            let (rows, axes) = (pair[0][0]..pair[1][0], pair[0][1]..pair[1][1]);
            self.check_seeds(&rows, &axes)?;
            let mut beside = u32::MAX;
            for axis in axes {
                let bearer = (self.bearer)(axis);
                if bearer == u32::MAX || grafts.binary_search(&axis).is_ok() {
                    if bearer != u32::MAX && bearer >= rows.end {
                        return Err(broken("a graft is older than what bears it"));
                    }
                    beside = u32::MAX;
                    continue;
                }
                if !rows.contains(&bearer) {
                    return Err(broken("a bud is not laid down with the metamer that bears it"));
                }
                let first = &mut laterals[(bearer - first_row) as usize];
                match *first == AxisId::NONE {
                    true => *first = AxisId::new(axis as usize),
                    false if beside == bearer => {}
                    false => return Err(broken("the buds of a metamer are not laid down together")),
                }
                beside = bearer;
            }
        }
        Ok(laterals)
    }

    /// Checks the edits of a step; returns what it grafts, in order.
    fn grafts(&self, before: [u32; 4], end: [u32; 4]) -> Result<Vec<u32>, BrokenPlant> {
        let first = self.ends[0][2];
        let edits = &self.edits[(before[2] - first) as usize..(end[2] - first) as usize];
        let mut grafts = Vec::new();
        for edit in edits {
            let (parent, axis) =
                (|id: MetamerId| (self.parent)(id.raw()), |id: MetamerId| (self.axis)(id.raw()));
            check_edit(edit, before, end, parent, axis, |axis| (self.bearer)(axis.raw()))?;
            if let Edit::Grafted(axis) = edit {
                grafts.push(axis.raw());
            }
        }
        grafts.sort_unstable();
        Ok(grafts)
    }

    /// Checks that a step's metamers have an axis by then, and that its trunks are those of its seeds.
    fn check_seeds(&self, rows: &Range<u32>, axes: &Range<u32>) -> Result<(), BrokenPlant> {
        if rows.clone().any(|row| (self.axis)(row) >= axes.end) {
            return Err(broken("a metamer is older than its axis"));
        }
        let seeds = rows.clone().filter(|&row| (self.parent)(row) == u32::MAX).map(&self.axis);
        let trunks = axes.clone().filter(|&axis| (self.bearer)(axis) == u32::MAX);
        if !seeds.eq(trunks) {
            return Err(broken("a trunk is not laid down with its seed"));
        }
        Ok(())
    }
}

fn broken(what: &str) -> BrokenPlant {
    BrokenPlant(what.to_owned())
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use crate::{
        checks::tests_support::sapling,
        future::Future,
        parts::PlantParts,
        plant::{Internode, Plant},
    };

    /// A sapling whose three metamers have grown in two steps.
    fn in_two_steps() -> PlantParts {
        let mut parts = sapling().to_parts();
        parts.ends = vec![[1, 1, 0, 0], [3, 3, 0, 1], [4, 4, 0, 2]];
        parts.now = 2;
        parts
    }

    fn refusal(change: impl FnOnce(&mut PlantParts)) -> String {
        let mut parts = in_two_steps();
        assert!(Plant::from_parts(parts.clone()).is_ok());
        change(&mut parts);
        Plant::from_parts(parts).expect_err("it is refused").0
    }

    #[test]
    fn laterals_of_another_step_are_refused() {
        // Back in step 1, the second metamer would have laterals that are not there yet.
        let late = refusal(|parts| parts.ends[1][1] = 2);
        assert_eq!(late, "a bud is not laid down with the metamer that bears it");
        let early = refusal(|parts| parts.ends[1][1] = 4);
        assert_eq!(early, "a bud is not laid down with the metamer that bears it");
    }

    #[test]
    fn a_whorl_in_two_parts_is_refused() {
        let mut plant = Plant::new(Vec3::ZERO);
        plant.begin_step();
        for height in 1..=2 {
            let end = Vec3::Y * height as f32;
            let internode = Internode { end, normal: Vec3::X, laterals: &[Vec3::X, Vec3::NEG_X] };
            plant.extend(crate::AxisId::new(0), &internode);
        }
        plant.end_step();
        let mut parts = plant.to_parts();
        parts.bearer.swap(2, 3);
        let error = Plant::from_parts(parts).expect_err("it is refused");
        assert_eq!(error.0, "the buds of a metamer are not laid down together");
    }

    #[test]
    fn a_trunk_without_its_seed_is_refused() {
        let alone = refusal(|parts| {
            parts.bearer.push(u32::MAX);
            parts.direction.push(Vec3::Y);
            parts.axis_death.push(u32::MAX);
            parts.ends[2][1] += 1;
        });
        assert_eq!(alone, "a trunk is not laid down with its seed");
        assert_eq!(refusal(|parts| parts.ends[0][0] = 0), "a trunk is not laid down with its seed");
    }

    #[test]
    fn a_metamer_older_than_its_axis_is_refused() {
        let early = refusal(|parts| {
            parts.axis[3] = 2;
            parts.parent[3] = parts.bearer[2];
            parts.bearer[3] = 3;
            parts.ends[1] = [4, 2, 0, 1];
        });
        assert_eq!(early, "a metamer is older than its axis");
    }

    #[test]
    fn a_future_with_other_laterals_is_refused() {
        let mut plant = Plant::from_parts(in_two_steps()).expect("a plant");
        plant.go_to(1);
        let parts = plant.stash_future().to_parts();
        let mut fits = plant.clone();
        let whole = Future::from_parts(parts.clone()).expect("equal columns");
        assert_eq!(fits.take_future(whole), Ok(()));
        for lateral in [2, u32::MAX] {
            let mut changed = parts.clone();
            changed.lateral = vec![lateral];
            let future = Future::from_parts(changed).expect("equal columns");
            assert!(plant.clone().take_future(future).is_err());
        }
        let mut late = parts;
        late.bearer = vec![1];
        let future = Future::from_parts(late).expect("equal columns");
        let error = plant.take_future(future).expect_err("it is refused");
        assert_eq!(error.0, "a bud is not laid down with the metamer that bears it");
    }
}
