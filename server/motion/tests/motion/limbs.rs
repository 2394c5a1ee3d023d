//! Limbs by the rule of clients: the cases of `client/src/scene/table/limbs.test.ts`, its ties, and whole trees.

use espalier_motion::{Limbs, Row, Rows};

use crate::trees::{SEED, code, grown};

fn twig(parent: u32, [x, y]: [f64; 2], radius: u16, starts_axis: bool) -> Row {
    let steps = |length: f64| (256.0 * length) as i32;
    Row { parent: Some(parent), starts_axis, position: [steps(x), steps(y), 0], radius, leaves: 0 }
}

/// A trunk of three (1 to 3) that goes on as a twig (4, 5), and a lateral from row 3 (6, 7) of some girth and direction.
fn forked(lateral: u16, [x, y]: [f64; 2]) -> Vec<Row> {
    let trunk = (1..=3).map(|at| twig(at - 1, [0.0, f64::from(at)], code(1.0), at == 1));
    let twigs = (4..=5).map(|at| twig(at - 1, [0.0, f64::from(at)], code(0.5), false));
    let laterals = [twig(3, [x, 3.0 + y], lateral, true), twig(6, [2.0 * x, 3.0 + 2.0 * y], lateral, false)];
    [SEED].into_iter().chain(trunk).chain(twigs).chain(laterals).collect()
}

fn limbs(rows: Vec<Row>) -> Limbs {
    Limbs::of(&Rows::new(rows).expect("parents stand below"))
}

fn trunk(limbs: &Limbs) -> &[u32] {
    limbs.rows(limbs.limb(1).expect("it has a trunk"))
}

#[test]
fn a_limb_goes_on_into_a_lateral_that_leads() {
    let limbs = limbs(forked(code(0.9), [1.0, 1.0]));
    assert_eq!(trunk(&limbs), [1, 2, 3, 6, 7]);
    assert_eq!(limbs.rows(limbs.limb(4).expect("wood")), [4, 5]);
    let twig = limbs.all()[limbs.limb(5).expect("wood") as usize];
    assert_eq!((twig.first, twig.node, twig.bearer, twig.level), (4, 3, limbs.limb(1), 1));
}

#[test]
fn a_limb_stays_with_its_axis_where_both_are_much_alike_or_the_lateral_doubles_back() {
    assert_eq!(trunk(&limbs(forked(code(0.55), [1.0, 1.0]))), [1, 2, 3, 4, 5]);
    assert_eq!(trunk(&limbs(forked(code(0.9), [1.0, -0.5]))), [1, 2, 3, 4, 5]);
}

#[test]
fn a_limb_goes_on_around_the_corner_where_its_axis_was_cut() {
    let cut = |lateral| {
        let mut rows = forked(lateral, [1.0, 0.0]);
        rows[4].radius = 0;
        rows[5].radius = 0;
        limbs(rows)
    };
    assert_eq!(trunk(&cut(code(0.8))), [1, 2, 3, 6, 7]);
    assert_eq!(trunk(&cut(code(0.3))), [1, 2, 3]);
    assert_eq!(cut(code(0.8)).limb(4), None);
}

#[test]
fn a_lead_begins_with_a_quarter_more_girth() {
    let twig = code(0.5);
    assert_eq!(trunk(&limbs(forked(twig + 23, [1.0, 1.0]))), [1, 2, 3, 6, 7]);
    assert_eq!(trunk(&limbs(forked(twig + 22, [1.0, 1.0]))), [1, 2, 3, 4, 5]);
}

#[test]
fn of_laterals_as_thick_the_lower_row_leads() {
    let mut rows = forked(code(0.9), [1.0, 1.0]);
    rows.push(twig(3, [-1.0, 4.0], code(0.9), true));
    assert_eq!(trunk(&limbs(rows.clone())), [1, 2, 3, 6, 7]);
    rows[8].radius += 1;
    assert_eq!(trunk(&limbs(rows)), [1, 2, 3, 8]);
}

#[test]
fn a_lateral_one_code_short_of_the_lead_has_it_if_its_row_is_lower() {
    // The client compares with the least code that leads, less one, as if the axis had it; a tie goes to the lower row.
    let rows = |first: bool| {
        let mut rows = vec![SEED, twig(0, [0.0, 1.0], 700, true)];
        let (axis, lateral) = (twig(1, [0.0, 2.0], 600, false), twig(1, [1.0, 2.0], 622, true));
        rows.extend(if first { [lateral, axis] } else { [axis, lateral] });
        rows
    };
    assert_eq!(trunk(&limbs(rows(true))), [1, 2]);
    assert_eq!(trunk(&limbs(rows(false))), [1, 2]);
    assert!(
        rows(true)[2].starts_axis && !rows(false)[2].starts_axis,
        "one is the lateral, the other the axis"
    );
}

#[test]
fn what_grows_from_a_seed_first_is_the_trunk() {
    let limbs = limbs(vec![
        SEED,
        twig(0, [0.0, 1.0], code(0.2), true),
        twig(0, [1.0, 1.0], code(0.9), true),
        twig(1, [0.0, 2.0], code(0.2), false),
    ]);
    assert_eq!(limbs.onward(0), Some(1));
    assert_eq!([limbs.rows(0), limbs.rows(1)], [&[1, 3][..], &[2]]);
    assert_eq!(limbs.all()[1].bearer, None);
}

#[test]
fn every_row_of_grown_trees_is_in_one_limb_and_bearers_come_first() {
    for slug in ["default", "weeping-willow"] {
        let tree = grown(slug, 1500);
        let mut seen = vec![0; tree.rows.len()];
        for (limb, at) in tree.limbs.all().iter().enumerate() {
            let rows = tree.limbs.rows(limb as u32);
            assert_eq!(rows[0], at.first);
            assert!(at.bearer.is_none_or(|bearer| (bearer as usize) < limb));
            assert_eq!(tree.limbs.limb(at.node), at.bearer);
            for pair in rows.windows(2) {
                assert_eq!(tree.limbs.onward(pair[0]), Some(pair[1]));
                assert_eq!(tree.rows.row(pair[1]).parent, Some(pair[0]));
            }
            rows.iter().for_each(|&row| seen[row as usize] += 1);
        }
        for (row, &seen) in seen.iter().enumerate() {
            let Row { parent, radius, .. } = tree.rows.row(row as u32);
            assert_eq!(seen, u32::from(parent.is_some() && radius != 0), "row {row} of {slug}");
        }
    }
}
