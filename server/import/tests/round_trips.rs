//! What the exporter writes becomes the same plant again.

#[path = "../../export/tests/main/saplings.rs"]
mod saplings;

use espalier_export::{ExportError, Origin, in_memory, mtg, qsm_csv, skeleton_json};
use espalier_growth::{Parameters, transplant};
use espalier_import::{FaultKind, Place, Units, WoodFile, WoodFormat, WoodOptions, read_wood};
use espalier_mesh::{
    Style, StyleOptions,
    leaves::{self, Leaf},
    ring_table::told,
};
use espalier_plant::{MetamerId, Organ, OrganKind, Plant, Widths, Wood, checks};
use espalier_settings::{Appearance, ParameterValues};
use proptest::prelude::*;

/// Not the default: a file that does not say it would come in at another scale.
const METRES: f32 = 0.3;
const NEAR: f32 = 1e-5;

fn style() -> Style {
    Style::new(StyleOptions { girth_exponent: 2.0, ..StyleOptions::default() })
}

fn options() -> WoodOptions {
    WoodOptions { internode_length: None, units: Units::of(1.0), shoot: 4, nodes: 100_000, extent: 1000.0 }
}

/// Internodes as long as they were, where the file itself does not say it.
fn known() -> WoodOptions {
    WoodOptions { internode_length: Some(METRES), ..options() }
}

fn skeleton(plant: &Plant) -> Vec<u8> {
    with_origin(|origin| in_memory(|out| skeleton_json(plant, &style(), origin, out)))
}

fn graph(plant: &Plant) -> Vec<u8> {
    with_origin(|origin| in_memory(|out| mtg(plant, &style(), origin, out)))
}

fn with_origin(write: impl FnOnce(&Origin<'_>) -> Result<Vec<u8>, ExportError>) -> Vec<u8> {
    let parameters = ParameterValues { internode_length: METRES, ..ParameterValues::default() };
    let looks = Appearance::default();
    let origin = Origin { species: Some("pear"), seed: 7, parameters: &parameters, looks: &looks };
    write(&origin).expect("it exports")
}

fn read(format: WoodFormat, bytes: &[u8]) -> WoodFile {
    read_wood(format, bytes, &options())
        .unwrap_or_else(|fault| panic!("{fault}: {}", String::from_utf8_lossy(bytes)))
}

fn planted(file: &WoodFile) -> Plant {
    let plant = transplant(&file.wood, &Parameters::default()).expect("it fits together");
    assert_eq!(checks::all(&plant), Ok(()));
    plant
}

/// Whether all that lives is there again, at the same places in the same order.
fn is_same(before: &Plant, after: &Plant) -> Result<(), TestCaseError> {
    let (old, new) = (saplings::living(before), saplings::living(after));
    prop_assert_eq!(old.len(), new.len());
    let style = style();
    let [before_widths, after_widths] = [before, after].map(|plant| Widths::of(plant, style.girth()));
    let number = |id: MetamerId| old.binary_search(&id).ok();
    let number_after = |id: MetamerId| new.binary_search(&id).ok();
    for (&old, &new) in old.iter().zip(&new) {
        let (was, is) = (before.metamers(), after.metamers());
        prop_assert!(was.end(old).distance(is.end(new)) < NEAR);
        let parent = was.parent(old);
        prop_assert_eq!(parent.and_then(number), is.parent(new).and_then(number_after));
        prop_assert_eq!(before.birth(old), after.birth(new));
        prop_assert_eq!(was.tips(old), is.tips(new));
        prop_assert_eq!(before.axes().order(was.axis(old)), after.axes().order(is.axis(new)));
        if let Some(parent) = parent {
            let radius = before_widths.radius(old);
            prop_assert!((radius - after_widths.radius(new)).abs() < NEAR * radius.max(1.0));
            let continues = is.axis(after.metamers().parent(new).expect("it has one")) == is.axis(new);
            prop_assert_eq!(was.axis(parent) == was.axis(old), continues);
        }
    }
    Ok(())
}

proptest! {
    #[test]
    fn a_skeleton_is_the_same_plant_again_with_its_buds(growth in saplings::growth()) {
        let before = saplings::grown(&growth);
        let bytes = skeleton(&before);
        let file = read(WoodFormat::Skeleton, &bytes);
        prop_assert_eq!((file.species.as_deref(), file.seed), (Some("pear"), Some(7)));
        prop_assert_eq!(file.parameters.internode_length, Some(METRES));
        let after = planted(&file);
        is_same(&before, &after)?;
        let normals = |plant: &Plant| {
            saplings::living(plant).iter().map(|&id| plant.metamers().normal(id)).collect::<Vec<_>>()
        };
        prop_assert!(normals(&before).iter().zip(normals(&after)).all(|(was, is)| was.distance(is) < NEAR));
        // Each leaf hangs where it did, whatever has died before it grew.
        let style = style();
        let leaves = |plant: &Plant| -> Vec<Leaf> {
            saplings::living(plant).iter().flat_map(|&id| leaves::of(plant, id, &style)).collect()
        };
        let (old, new) = (leaves(&before), leaves(&after));
        prop_assert_eq!(old.len(), new.len());
        for (was, is) in old.iter().zip(&new) {
            let vectors = [(was.base, is.base), (was.direction, is.direction), (was.normal, is.normal)];
            prop_assert!(vectors.iter().all(|(was, is)| was.distance(*is) < NEAR), "{:?} {:?}", was, is);
            prop_assert!((was.size - is.size).abs() < NEAR && was.random == is.random, "{:?} {:?}", was, is);
        }
        let buds = |plant: &Plant| {
            (0..plant.axis_count()).map(espalier_plant::AxisId::new).filter(|&axis| plant.is_axis_alive(axis)).count()
        };
        prop_assert_eq!(buds(&before), buds(&after));
    }

    #[test]
    fn a_graph_is_the_same_plant_again(growth in saplings::growth()) {
        let before = saplings::grown(&growth);
        let file = read(WoodFormat::Mtg, &graph(&before));
        prop_assert_eq!((file.species.as_deref(), file.seed), (Some("pear"), Some(7)));
        prop_assert_eq!(file.parameters.internode_length, Some(METRES));
        is_same(&before, &planted(&file))?;
    }

    #[test]
    fn a_model_has_the_same_cylinders_again(growth in saplings::growth()) {
        let before = saplings::grown(&growth);
        prop_assume!(before.living_count() > 0);
        let cylinders = |plant: &Plant| -> Vec<Vec<f64>> {
            let text = String::from_utf8(in_memory(|out| qsm_csv(plant, &style(), METRES, out)).expect("it exports")).expect("text");
            text.lines().skip(1).map(|line| line.split(',').map(|cell| cell.parse().expect("a number")).collect()).collect()
        };
        let bytes = in_memory(|out| qsm_csv(&before, &style(), METRES, out)).expect("it exports");
        let file = read_wood(WoodFormat::Qsm, &bytes, &known()).expect("cylinders");
        let after = planted(&file);
        let (old, new) = (cylinders(&before), cylinders(&after));
        prop_assert_eq!(old.len(), new.len());
        // Branches may be numbered otherwise: births are not in the file.
        for cylinder in &old {
            let is_there = new.iter().any(|other| {
                let near = |columns: std::ops::Range<usize>| {
                    cylinder[columns.clone()].iter().zip(&other[columns]).all(|(a, b)| (a - b).abs() < 1e-6)
                };
                near(0..8) && cylinder[11..13] == other[11..13]
            });
            prop_assert!(is_there, "{:?}", cylinder);
        }
    }
}

#[test]
fn organs_that_metamers_are_given_come_back_as_they_stood() {
    let mut before = saplings::fork();
    let ids = saplings::living(&before);
    let organ = |kind, azimuth| Organ {
        kind,
        azimuth,
        inclination: azimuth / 2 + 40,
        roll: azimuth / 5,
        length: azimuth,
    };
    let kinds = OrganKind::ALL;
    let azimuths = [3u8, 90, 200].into_iter().cycle();
    let given = ids[1..].iter().zip(azimuths).map(|(&id, azimuth)| {
        let organs = kinds.map(|kind| organ(kind, azimuth.wrapping_add(17 * kind as u8)));
        (id, Some(organs.as_slice().into()))
    });
    let given: Vec<_> = given.collect();
    before.begin_edit();
    before.give_organs(&given).expect("they live");
    before.end_step();
    let bytes = skeleton(&before);
    let after = planted(&read(WoodFormat::Skeleton, &bytes));
    let style = style();
    for &id in &ids[1..] {
        let stand = |plant: &Plant| leaves::of(plant, id, &style).collect::<Vec<_>>();
        assert_eq!((stand(&before), stand(&before).len()), (stand(&after), 1));
        assert_eq!(told(&before, id), told(&after, id), "flowers and fruits as well");
    }
    // What none can be is told with its place.
    let text = String::from_utf8(bytes).expect("text");
    for (bad, allowed) in
        [("[3,1,1,1,1]", "[kind, azimuth"), ("[0,1]", "[kind, azimuth"), ("[0,1,1,64,1]", "[kind, azimuth")]
    {
        let begin = text.find("\"organs\":[[").expect("organs") + "\"organs\":[".len();
        let end = begin + text[begin..].find(']').expect("it ends") + 1;
        let text = format!("{}{bad}{}", &text[..begin], &text[end..]);
        let fault = read_wood(WoodFormat::Skeleton, text.as_bytes(), &options()).expect_err("it is refused");
        let place = Some(Place::Member("metamers[1].organs[0]".into()));
        assert_eq!(fault.place, place, "{fault}");
        assert!(fault.allowed.as_ref().is_some_and(|said| said.starts_with(allowed)), "{fault}");
    }
    let row = text.replacen("{\"parent\":1", "{\"row\":1,\"parent\":1", 1);
    let fault = read_wood(WoodFormat::Skeleton, row.as_bytes(), &options()).expect_err("rows go on");
    assert_eq!(fault.kind, FaultKind::OutOfRange, "{fault}");
}

#[test]
fn rows_without_end_are_closed_up() {
    let text = String::from_utf8(skeleton(&saplings::fork())).expect("text");
    let [far, near] = [900_000_000, 9].map(|row| text.replacen("\"row\":4", &format!("\"row\":{row}"), 1));
    let wood = |text: &str| read(WoodFormat::Skeleton, text.as_bytes()).wood;
    assert_eq!(wood(&text).gaps, [(3, 1)]);
    assert_eq!(wood(&near), Wood { gaps: vec![(3, 6)], ..wood(&text) });
    assert_eq!(wood(&far), Wood { gaps: Vec::new(), ..wood(&text) });
}

#[test]
fn a_skeleton_of_version_1_is_read_in_internodes() {
    let text = r#"{"format":"espalier-skeleton","version":1,"unit":"internode","metamers":[
        {"parent":null,"position":[0.0,0.0,0.0],"radius":0.0,"order":0,"birth":0},
        {"parent":0,"position":[0.0,1.0,0.0],"radius":0.08660254,"order":0,"birth":1},
        {"parent":1,"position":[0.0,2.0,0.0],"radius":0.05,"order":0,"birth":1},
        {"parent":1,"position":[0.0,1.0,0.5],"radius":0.05,"order":1,"birth":2}]}"#;
    let plant = planted(&read(WoodFormat::Skeleton, text.as_bytes()));
    assert_eq!((plant.living_count(), plant.living_axes_count(), plant.step()), (3, 2, 2));
    assert_eq!(plant.metamers().end(MetamerId::new(3)), glam::Vec3::new(0.0, 1.0, 0.5));
    assert_eq!(plant.given_radius(MetamerId::new(1)), Some(0.08660254));
}

#[test]
fn cylinders_say_how_long_internodes_are() {
    let pole = saplings::pole(5);
    let bytes = in_memory(|out| qsm_csv(&pole, &style(), METRES, out)).expect("it exports");
    let file = read(WoodFormat::Qsm, &bytes);
    assert_eq!(file.parameters.internode_length, Some(METRES));
    let plant = planted(&file);
    assert_eq!((plant.living_count(), plant.living_axes_count()), (5, 1));
    assert!(plant.metamers().end(MetamerId::new(5)).distance(5.0 * glam::Vec3::Y) < NEAR);
}

#[test]
fn longer_cylinders_than_internodes_are_cut() {
    let pole = saplings::pole(3);
    let bytes = in_memory(|out| qsm_csv(&pole, &style(), METRES, out)).expect("it exports");
    let fine = WoodOptions { internode_length: Some(0.5 * METRES), ..options() };
    let plant = planted(&read_wood(WoodFormat::Qsm, &bytes, &fine).expect("cylinders"));
    assert_eq!((plant.living_count(), plant.living_axes_count()), (6, 1));
    assert!(plant.metamers().end(MetamerId::new(6)).distance(6.0 * glam::Vec3::Y) < NEAR);
    // A metamer of a graph is one, however long.
    let bytes = graph(&pole);
    let plant = planted(&read_wood(WoodFormat::Mtg, &bytes, &fine).expect("a graph"));
    assert_eq!(plant.living_count(), 3);
}

#[test]
fn a_graph_that_came_in_goes_out_as_it_was() {
    let bytes = graph(&saplings::fork());
    let plant = planted(&read(WoodFormat::Mtg, &bytes));
    let again = graph(&plant);
    // Radii come back near enough, not to the last digit.
    let cells = |bytes: Vec<u8>| -> Vec<Vec<String>> {
        let text = String::from_utf8(bytes).expect("text");
        let line = |line: &str| {
            let cells: Vec<String> = line.split('\t').map(str::to_owned).collect();
            cells.iter().enumerate().filter(|(at, _)| *at != 5).map(|(_, cell)| cell.clone()).collect()
        };
        text.lines().map(line).collect()
    };
    assert_eq!(cells(again), cells(bytes));
}
