//! Random lives: tables mirror the plant however it got where it is, clients mirror the tables, and meshes hold.

mod life;
mod mirror;
mod plain;

use std::collections::BTreeSet;

use espalier_mesh::{
    Detail, RingTable, Style, StyleOptions, checks, leaves, ring_table::CHUNK_ROWS, seeds, wood,
};
use espalier_plant::{AxisId, MetamerId, Plant};
use espalier_settings::BarkLook;
use glam::Vec3;
use life::{events, happen};
use mirror::{ByChanges, ByGenerations};
use plain::PlainTable;
use proptest::prelude::*;

fn styles() -> impl Strategy<Value = Style> {
    (2.0f32..3.0, 0.02f32..0.3, 0u8..=15, 0.1f32..3.0).prop_map(
        |(girth_exponent, twig_diameter, leaves, leaf_size)| {
            Style::new(StyleOptions { girth_exponent, twig_diameter, leaves_per_node: leaves, leaf_size })
        },
    )
}

proptest! {
    #[test]
    fn table_mirrors_the_plant_after_any_journey(events in events(), every in 1usize..6, styles in prop::array::uniform2(styles())) {
        let mut plant = Plant::new(Vec3::ZERO);
        let mut table = RingTable::new();
        let mut held = ByChanges::default();
        let mut idle = ByGenerations::default();
        for (count, event) in events.iter().enumerate() {
            happen(&mut plant, event);
            // Several events between two syncs let rows come back as others.
            if count % every == 0 {
                let style = &styles[count / 8 % 2];
                let sequence = count as u32 + 1;
                let changes = table.sync(&plant, style, sequence);
                prop_assert_eq!(checks::table(&table, &plant, style), Ok(()));
                held.apply(&changes, &table, sequence);
                prop_assert!(held.equals(&table));
                prop_assert!(table.sync(&plant, style, u32::MAX).is_empty());
            }
            if count % (3 * every) == 0 {
                idle.catch_up(&table);
                prop_assert!(idle.equals(&table));
            }
        }
    }

    /// In less detail rows may look otherwise, but nothing is missing, stands elsewhere or is dead; and whole again, all
    /// is as if it had always been.
    #[test]
    fn a_table_makes_up_for_what_it_left_out(
        events in events(),
        details in prop::collection::vec(prop::sample::select(vec![Detail::Form, Detail::Coarse, Detail::Whole]), 8),
        styles in prop::array::uniform2(styles()),
    ) {
        let mut plant = Plant::new(Vec3::ZERO);
        let (mut table, mut held) = (RingTable::new(), ByChanges::default());
        for (count, event) in events.iter().enumerate() {
            happen(&mut plant, event);
            let (detail, style) = (details[count % details.len()], &styles[count / 16 % 2]);
            let sequence = count as u32 + 1;
            let changes = table.sync_in(detail, &plant, style, sequence);
            held.apply(&changes, &table, sequence);
            prop_assert!(held.equals(&table));
            let mut fresh = RingTable::new();
            fresh.sync(&plant, style, 1);
            prop_assert_eq!(table.rows(), fresh.rows());
            for row in 0..table.rows() as u32 {
                let form = |table: &RingTable| (table.parent(row), table.position(row), table.born(row), table.radius(row) > 0);
                prop_assert_eq!(form(&table), form(&fresh));
            }
            if detail == Detail::Whole {
                prop_assert_eq!(checks::table(&table, &plant, style), Ok(()));
            }
        }
        let style = &styles[0];
        let changes = table.sync(&plant, style, u32::MAX);
        held.apply(&changes, &table, u32::MAX);
        prop_assert_eq!(checks::table(&table, &plant, style), Ok(()));
        prop_assert!(held.equals(&table));
    }

    #[test]
    fn columns_say_what_the_plain_comparison_says(
        events in events(),
        every in 1usize..4,
        styles in prop::array::uniform2(styles()),
    ) {
        let mut plant = Plant::new(Vec3::ZERO);
        let (mut table, mut plain) = (RingTable::new(), PlainTable::default());
        for (count, event) in events.iter().enumerate() {
            happen(&mut plant, event);
            if count % every == 0 {
                let (style, sequence) = (&styles[count / 8 % 2], count as u32 + 1);
                let changes = table.sync(&plant, style, sequence);
                prop_assert_eq!(changes, plain.sync(&plant, style, sequence));
                prop_assert!(plain.equals(&table));
            }
        }
    }

    #[test]
    fn whole_meshes_hold_and_repeat(
        events in events(),
        style in styles(),
        [collar, root_flare] in prop::array::uniform2(0.0f32..=2.0),
        smoothing in 0.0f32..=1.0,
    ) {
        let mut plant = Plant::new(Vec3::ZERO);
        for event in &events {
            happen(&mut plant, event);
        }
        let ids = (0..plant.metamer_count()).map(MetamerId::new);
        let leaves: Vec<_> = ids.flat_map(|id| leaves::of(&plant, id, &style)).collect();
        let look = BarkLook { collar, root_flare, smoothing, ..BarkLook::default() };
        let plants = wood(&plant, &style, &look);
        for wood in &plants {
            prop_assert_eq!(checks::wood(wood), Ok(()));
        }
        let of = seeds(&plant);
        let grown = (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id) && !plant.is_seed(id));
        let grown: BTreeSet<_> = grown.map(|id| of[id.index()]).collect();
        prop_assert!(plants.iter().map(|wood| wood.seed).eq(grown));
        prop_assert_eq!(&plants, &wood(&plant, &style, &look));
        let mut table = RingTable::new();
        table.sync(&plant, &style, 1);
        prop_assert_eq!(leaves.len(), table.leaves() as usize);
    }
}

/// A stem of one metamer that bears so many laterals; a branch on one of these, which bears one as well; some
/// metamers on `filling`, more than a chunk holds; and one more on axis 2.
fn with_axis_two(laterals: u8, branch: usize, filling: &[usize]) -> Plant {
    let mut plant = Plant::new(Vec3::ZERO);
    plant.begin_step();
    life::stack(&mut plant, AxisId::new(0), laterals);
    life::stack(&mut plant, AxisId::new(branch), 1);
    for &axis in filling {
        life::stack(&mut plant, AxisId::new(axis), 0);
    }
    life::stack(&mut plant, AxisId::new(2), 0);
    plant.end_step();
    plant
}

#[test]
fn axes_of_other_numbers_are_seen_through() {
    // Axis 2 is a lateral of the branch on axis 1, or it is the branch itself: its last metamer has the same
    // parent and the same number of an axis, and yet another link.
    let stem = vec![0; 2 * CHUNK_ROWS];
    let apart = with_axis_two(1, 1, &stem);
    let itself = with_axis_two(2, 2, &stem);
    let elsewhere = with_axis_two(1, 1, &vec![1; 2 * CHUNK_ROWS]);
    let style = Style::default();
    for lives in [[&apart, &itself, &apart, &itself], [&itself, &apart, &itself, &apart]]
        .into_iter()
        .chain([[&elsewhere, &itself, &apart, &itself], [&apart, &elsewhere, &itself, &apart]])
    {
        let (mut table, mut plain) = (RingTable::new(), PlainTable::default());
        for (sequence, plant) in (1..).zip(lives) {
            assert_eq!(table.sync(plant, &style, sequence), plain.sync(plant, &style, sequence));
            assert!(plain.equals(&table));
            assert_eq!(checks::table(&table, plant, &style), Ok(()));
        }
    }
}

#[test]
fn faint_changes_of_light_are_not_seen() {
    let (mut plant, mut table, style) = (life::sapling(), RingTable::new(), Style::default());
    table.sync(&plant, &style, 1);
    let mut look = |light, vigor| {
        life::look(&mut plant, 1, light, vigor);
        let changes = table.sync(&plant, &style, table.generations()[0] + 1);
        (changes.light, changes.foliage)
    };
    assert_eq!(look(248, 0xe0), (vec![], vec![]));
    assert_eq!(look(247, 0xdf), (vec![1], vec![1]));
    assert_eq!(look(240, 0xc0), (vec![], vec![]));
    assert_eq!(look(255, 0xf0), (vec![1], vec![1]));
}

#[test]
fn thicker_style_changes_only_radii() {
    let (plant, mut table) = (life::sapling(), RingTable::new());
    table.sync(&plant, &Style::default(), 1);
    let thick = Style::new(StyleOptions { twig_diameter: 0.2, ..StyleOptions::default() });
    let changes = table.sync(&plant, &thick, 2);
    assert_eq!(changes.radius, [1, 2, 3]);
    assert!(changes.appended.is_empty() && changes.foliage.is_empty() && changes.truncated.is_none());
    assert_eq!(table.generations(), [2]);
}

#[test]
fn ungrown_rows_are_truncated_and_the_chunk_marked() {
    let (mut plant, mut table, style) = (life::sapling(), RingTable::new(), Style::default());
    table.sync(&plant, &style, 1);
    plant.go_to(0);
    let changes = table.sync(&plant, &style, 2);
    assert_eq!((changes.truncated, changes.appended), (Some(1), 1..1));
    assert_eq!((table.rows(), table.generations(), table.leaves()), (1, &[2][..], 0));
}

fn widen(plant: &mut Plant, row: usize, diameter: Option<f32>) {
    plant.begin_edit();
    plant.set_width(MetamerId::new(row), diameter);
    plant.end_step();
}

#[test]
fn widths_change_radii_and_go_without_a_trace() {
    let (mut plant, mut table, style) = (life::sapling(), RingTable::new(), Style::default());
    table.sync(&plant, &style, 1);
    let radii = |table: &RingTable| [1, 2, 3].map(|row| table.radius(row));
    let unconstrained = radii(&table);
    widen(&mut plant, 2, Some(0.4));
    let changes = table.sync(&plant, &style, 2);
    // The tip is a twig still.
    assert_eq!((&changes.radius[..], changes.foliage.len(), changes.position.len()), (&[1, 2][..], 0, 0));
    let code = espalier_mesh::radius_code::encode(0.2);
    assert_eq!(radii(&table), [code, code, unconstrained[2]]);
    widen(&mut plant, 2, None);
    assert_eq!(table.sync(&plant, &style, 3).radius, [1, 2]);
    assert_eq!(radii(&table), unconstrained);
    assert!(table.sync(&plant, &style, 4).is_empty());
}

#[test]
fn chunks_beyond_a_constraint_stay_as_they_are() {
    let mut plant = Plant::new(Vec3::ZERO);
    plant.begin_step();
    let second = plant.sow(Vec3::X);
    for axis in [AxisId::new(0), second] {
        for _ in 0..CHUNK_ROWS {
            life::stack(&mut plant, axis, 0);
        }
    }
    plant.end_step();
    let (mut table, style) = (RingTable::new(), Style::default());
    table.sync(&plant, &style, 1);
    assert_eq!(table.generations(), [1, 1, 1]);
    // The second trunk begins in the second chunk; its constraint is in the last.
    widen(&mut plant, 2 * CHUNK_ROWS, Some(0.5));
    table.sync(&plant, &style, 2);
    assert_eq!(table.generations(), [1, 2, 2]);
    assert!(table.sync(&plant, &style, 3).is_empty());
    widen(&mut plant, 2 * CHUNK_ROWS + 1, Some(0.4));
    assert_eq!(table.sync(&plant, &style, 4).radius, [2 * CHUNK_ROWS as u32 + 1]);
    assert_eq!(table.generations(), [1, 2, 4]);
}
