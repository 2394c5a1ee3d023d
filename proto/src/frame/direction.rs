//! How a metamer runs, told by how its parent does (`FR10`): internodes of a plant are mostly equally long, so two
//! coordinates nearly tell the third; and where an axis goes on it hardly turns.

/// The square of an internode's usual length, in steps of the position grid.
const USUAL_SQUARE: i64 = 256 * 256;
/// What the square of a length is off by when its ends are rounded, and some more.
const ROUNDED: i64 = 1024;

/// What is told of a metamer whose parent runs along `parents`; `way` is the difference to the parent's position.
pub fn tell(way: [i32; 3], parents: [i32; 3], goes_on: bool) -> [i32; 3] {
    let Axes { along, across } = Axes::of(parents);
    let [u, v] = across.map(|axis| way[axis].wrapping_sub(if goes_on { parents[axis] } else { 0 }));
    let expected = expected(parents, along, across.map(|axis| way[axis]));
    [u, v, way[along].wrapping_sub(expected)]
}

/// The difference to the parent's position, of what [`tell`] has told.
pub fn follow(told: [i32; 3], parents: [i32; 3], goes_on: bool) -> [i32; 3] {
    let Axes { along, across } = Axes::of(parents);
    let mut way = [0; 3];
    for (axis, told) in across.into_iter().zip(told) {
        way[axis] = told.wrapping_add(if goes_on { parents[axis] } else { 0 });
    }
    way[along] = told[2].wrapping_add(expected(parents, along, across.map(|axis| way[axis])));
    way
}

/// Which coordinate of a metamer follows from the others.
struct Axes {
    along: usize,
    across: [usize; 2],
}

impl Axes {
    /// The one along which its parent goes farthest, the first of equal ones.
    fn of(parents: [i32; 3]) -> Self {
        let [x, y, z] = parents.map(i32::unsigned_abs);
        let along = match () {
            () if x >= y && x >= z => 0,
            () if y >= z => 1,
            () => 2,
        };
        Self { along, across: [(along + 1) % 3, (along + 2) % 3] }
    }
}

/// How far a metamer goes along an axis if it is as long as its parent and goes so far across.
fn expected(parents: [i32; 3], along: usize, across: [i32; 2]) -> i32 {
    let square = |length: i32| i64::from(length) * i64::from(length);
    let parents_square = parents.map(square).into_iter().fold(0, i64::saturating_add);
    let is_usual = parents_square == 0 || (parents_square - USUAL_SQUARE).abs() <= ROUNDED;
    let whole = if is_usual { USUAL_SQUARE } else { parents_square };
    let left = across.map(square).into_iter().fold(whole, i64::saturating_sub);
    // The nearest whole number to the root: half of the root of four times as much, rounded up.
    let root = (left.clamp(0, i64::MAX / 4).cast_unsigned() * 4).isqrt().div_ceil(2) as i32;
    if parents[along] < 0 { root.wrapping_neg() } else { root }
}

#[cfg(test)]
mod tests {
    use proptest::{array::uniform3, prelude::*};

    use super::*;

    fn any_way() -> impl Strategy<Value = [i32; 3]> {
        prop_oneof![uniform3(-300..300), any::<[i32; 3]>()]
    }

    proptest! {
        #[test]
        fn what_is_told_leads_to_the_same_place(way in any_way(), parents in any_way(), goes_on: bool) {
            prop_assert_eq!(follow(tell(way, parents, goes_on), parents, goes_on), way);
        }

        #[test]
        fn an_expected_length_is_the_nearest_whole_one(across in -400..400i32, parents in -400..400i32) {
            let square = parents * parents;
            let whole = if (square - 65_536).abs() <= 1024 || square == 0 { 65_536 } else { square };
            let root = f64::from((whole - across * across).max(0)).sqrt().round();
            let sign = if parents < 0 { -1.0 } else { 1.0 };
            prop_assert_eq!(f64::from(expected([parents, 0, 0], 0, [across, 0])), sign * root);
        }
    }

    #[test]
    fn fr10_a_straight_shoot_of_usual_internodes_tells_nothing_but_zeros() {
        for parents in [[0, 256, 0], [0, 0, -256], [148, -148, 147], [90, 210, 116], [30, 40, 0]] {
            assert_eq!(tell(parents, parents, true), [0; 3], "{parents:?}");
        }
    }

    #[test]
    fn fr10_a_lateral_tells_where_it_goes_across() {
        assert_eq!(tell([181, 181, 3], [0, 256, 0], false), [3, 181, 0]);
        assert_eq!(tell([181, 181, 3], [0, -256, 0], false), [3, 181, 362]);
        assert_eq!(tell([10, 70, -20], [0, 70, 0], false), [-20, 10, 4]);
        // The first wood above a seed has nothing to go by.
        assert_eq!(tell([3, 256, 0], [0; 3], true), [256, 0, 3]);
    }
}
