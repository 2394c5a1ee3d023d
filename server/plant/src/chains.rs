//! Axes of columns from outside: each is one chain of metamers at any time, though not always the same one.

use crate::{edits::Edit, parts::BrokenPlant};

/// Checks that every metamer grows from the bud of its axis, which is at the axis' last metamer, or at its bearer while
/// it has none. Rows and ends are raw; `chains` are the first and the last row of each axis where the first step begins.
///
/// `ends` are metamers, axes, edits and steps of growth where the first step begins, and at the end of each; rows are
/// known to be in range.
pub(crate) fn check_chains(
    ends: &[[u32; 4]],
    edits: &[Edit],
    mut chains: Vec<[u32; 2]>,
    parent: impl Fn(u32) -> u32,
    axis: impl Fn(u32) -> u32,
    bearer: impl Fn(u32) -> u32,
) -> Result<(), BrokenPlant> {
    let resettles = edits.iter().any(|edit| matches!(edit, Edit::Resettled(_)));
    let rows = if resettles { ends.last().map_or(0, |end| end[0]) } else { 0 };
    let mut founders: Vec<u32> = Vec::with_capacity(rows as usize);
    for row in 0..rows {
        let below = founders.get(parent(row) as usize).filter(|_| axis(parent(row)) == axis(row));
        founders.push(below.copied().unwrap_or(row));
    }
    let first_edit = ends.first().map_or(0, |end| end[2]);
    for step in ends.windows(2) {
        for edit in &edits[(step[0][2] - first_edit) as usize..(step[1][2] - first_edit) as usize] {
            if let Edit::Resettled(resettled) = edit {
                resettled.check_ends(&mut chains, &founders)?;
            }
        }
        for row in step[0][0]..step[1][0] {
            let of = axis(row);
            let [first, last] = &mut chains[of as usize];
            let bud = if *last == u32::MAX { bearer(of) } else { *last };
            if parent(row) != bud {
                return Err(BrokenPlant("a metamer does not grow from the bud of its axis".to_owned()));
            }
            if *first == u32::MAX {
                *first = row;
            }
            *last = row;
        }
    }
    Ok(())
}
