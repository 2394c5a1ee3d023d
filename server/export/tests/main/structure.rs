//! Files of structure say what lives, in metres.

use std::collections::BTreeMap;

use espalier_export::{ExportError, Origin, Sampling, in_memory, mtg, ply, qsm_csv, skeleton_json};
use espalier_plant::{MetamerId, Plant, Widths, wood::as_written};
use espalier_settings::{Appearance, FlowerKind, FlowerLook, FruitKind, FruitLook, ParameterValues, Place};
use glam::{DVec3, Vec3};
use proptest::prelude::*;
use serde_json::Value;

use crate::{METRES, looks, saplings, style};

/// The skeleton of a plant, as any reader of JSON sees it.
pub fn skeleton(plant: &Plant) -> Value {
    let file = with_origin(|origin| in_memory(|out| skeleton_json(plant, &style(), origin, out)));
    serde_json::from_slice(&file.expect("it exports")).expect("it is JSON")
}

fn graph(plant: &Plant) -> Result<Vec<u8>, ExportError> {
    with_origin(|origin| in_memory(|out| mtg(plant, &style(), origin, out)))
}

fn with_origin<T>(write: impl FnOnce(&Origin<'_>) -> T) -> T {
    let parameters = ParameterValues { internode_length: METRES, ..ParameterValues::default() };
    let looks = looks();
    write(&Origin { species: Some("pear"), seed: 7, parameters: &parameters, looks: &looks })
}

/// The radius in metres of a metamer in the skeleton.
pub fn radius_of(plant: &Plant, metamer: usize) -> Option<f64> {
    skeleton(plant)["metamers"][metamer]["radius"].as_f64()
}

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

fn place(value: &Value) -> DVec3 {
    let parts: Vec<f64> = list(value).iter().map(|part| part.as_f64().expect("a number")).collect();
    DVec3::from_slice(&parts)
}

/// A place in metres as internodes.
fn internodes(place: DVec3) -> Vec3 {
    (place / as_written(METRES)).as_vec3()
}

/// From Z up to Y up.
fn y_up(place: DVec3) -> DVec3 {
    DVec3::new(place.x, place.z, -place.y)
}

fn text(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes).expect("it is UTF-8")
}

proptest! {
    #[test]
    fn any_skeleton_holds_the_living_in_order(growth in saplings::growth()) {
        let (plant, style) = (saplings::grown(&growth), style());
        let file = skeleton(&plant);
        let (metamers, axes) = (list(&file["metamers"]), list(&file["axes"]));
        let (living, widths) = (saplings::living(&plant), Widths::of(&plant, style.girth()));
        prop_assert_eq!(metamers.len(), living.len());
        for (at, (read, &id)) in metamers.iter().zip(&living).enumerate() {
            let parent = read["parent"].as_u64().map(|parent| parent as usize);
            prop_assert!(parent.is_none_or(|parent| parent < at));
            prop_assert_eq!(parent.map(|parent| living[parent]), plant.metamers().parent(id));
            let radius = if parent.is_none() { 0.0 } else { widths.radius(id) };
            let read_radius = (read["radius"].as_f64().expect("a number") / as_written(METRES)) as f32;
            prop_assert_eq!(read_radius, radius);
            prop_assert_eq!(internodes(place(&read["position"])), plant.metamers().end(id));
            prop_assert_eq!(read["birth"].as_u64(), Some(u64::from(plant.birth(id))));
            let axis = &axes[read["axis"].as_u64().expect("a number") as usize];
            prop_assert_eq!(axis["order"].as_u64(), Some(u64::from(plant.axes().order(plant.metamers().axis(id)))));
            prop_assert_eq!(axis["bud"].as_bool(), Some(plant.is_axis_alive(plant.metamers().axis(id))));
        }
        prop_assert!(axes.iter().all(|axis| axis["bearer"].as_u64().is_none_or(|bearer| (bearer as usize) < living.len())));
        let is_wood = |leaf: &Value| leaf["metamer"].as_u64().is_some_and(|at| !metamers[at as usize]["parent"].is_null());
        prop_assert!(list(&file["leaves"]).iter().all(is_wood));
    }

    #[test]
    fn any_graph_names_each_living_metamer_once_behind_what_bears_it(growth in saplings::growth()) {
        let plant = saplings::grown(&growth);
        let file = text(graph(&plant).expect("it exports"));
        let (_, code) = file.split_once("\nMTG:\n").expect("a graph");
        let mut lines = code.lines();
        let head: Vec<&str> = lines.next().expect("a head").split('\t').collect();
        let column = |name: &str| head.iter().position(|head| *head == name).expect("a feature");
        let (x, id) = (column("XX"), column("Id"));
        let living = saplings::living(&plant);
        let mut seen = vec![false; living.len()];
        // What was written last in each column.
        let mut last: Vec<MetamerId> = Vec::new();
        for line in lines {
            let cells: Vec<&str> = line.split('\t').collect();
            prop_assert_eq!(cells.len(), head.len());
            let order = cells.iter().position(|cell| !cell.is_empty()).expect("a code");
            prop_assert!(order < x);
            let number: usize = cells[id].parse().expect("a number");
            prop_assert!(!std::mem::replace(&mut seen[number], true));
            let metamer = living[number];
            if let Some(parent) = plant.metamers().parent(metamer) {
                let above = if cells[order].starts_with('^') { last[order] } else { last[order - 1] };
                prop_assert_eq!(above, parent, "{}", line);
            }
            let parts: Vec<f64> = cells[x..x + 3].iter().map(|cell| cell.parse().expect("a number")).collect();
            prop_assert_eq!(internodes(y_up(DVec3::from_slice(&parts))), plant.metamers().end(metamer));
            last.truncate(order);
            last.push(metamer);
        }
        prop_assert!(seen.into_iter().all(|seen| seen));
    }

    #[test]
    fn any_model_has_a_cylinder_for_each_living_metamer(growth in saplings::growth()) {
        let plant = saplings::grown(&growth);
        let file = text(in_memory(|out| qsm_csv(&plant, &style(), METRES, out)).expect("it exports"));
        let mut lines = file.lines();
        let head: Vec<&str> = lines.next().expect("a head").split(',').collect();
        let rows: Vec<BTreeMap<&str, f64>> = lines
            .map(|line| head.iter().copied().zip(line.split(',').map(|cell| cell.parse().expect("a number"))).collect())
            .collect();
        prop_assert_eq!(rows.len() as u32, plant.living_count());
        let vector = |row: &BTreeMap<&str, f64>, name: &str| {
            DVec3::from_array(["x", "y", "z"].map(|axis| row[&*format!("{name}.{axis}")]))
        };
        let end = |row| vector(row, "start") + vector(row, "axis") * row["length"];
        for (row, number) in rows.iter().zip(1..) {
            let parent = row["parent"] as usize;
            prop_assert!(parent < number);
            if let Some(parent) = parent.checked_sub(1).map(|parent| &rows[parent]) {
                prop_assert!(end(parent).distance(vector(row, "start")) < 1e-8);
                let continues = parent["branch"] == row["branch"];
                prop_assert_eq!(continues, parent["extension"] as usize == number);
                prop_assert_eq!(row["BranchOrder"], parent["BranchOrder"] + f64::from(u8::from(!continues)));
            }
            let mut ends = saplings::living(&plant).into_iter().map(|id| plant.metamers().end(id));
            prop_assert!(ends.any(|node| node.distance(internodes(y_up(end(row)))) < 1e-5));
        }
    }
}

/// A point of a cloud.
struct Point {
    place: DVec3,
    normal: DVec3,
    label: u8,
    metamer: u32,
}

fn cloud(plant: &Plant, points: u32, seed: u32) -> Vec<Point> {
    cloud_of(plant, &looks(), points, seed)
}

fn cloud_of(plant: &Plant, looks: &Appearance, points: u32, seed: u32) -> Vec<Point> {
    let sampling = Sampling { points, seed };
    let file = in_memory(|out| ply(plant, &style(), looks, METRES, sampling, out)).expect("it exports");
    let end = b"end_header\n";
    let at = file.windows(end.len()).position(|window| window == end).expect("a head") + end.len();
    let head = std::str::from_utf8(&file[..at]).expect("text");
    let float = |bytes: &[u8]| f64::from(f32::from_le_bytes(bytes.try_into().expect("four bytes")));
    let vector = |bytes: &[u8]| DVec3::new(float(&bytes[..4]), float(&bytes[4..8]), float(&bytes[8..12]));
    let points: Vec<Point> = (file[at..].chunks(29))
        .map(|row| Point {
            place: vector(row),
            normal: vector(&row[12..]),
            label: row[24],
            metamer: u32::from_le_bytes(row[25..].try_into().expect("four bytes")),
        })
        .collect();
    assert!(head.contains(&format!("element vertex {}\n", points.len())), "{head}");
    points
}

#[test]
fn points_lie_on_what_they_say_with_normals_outward() {
    let plant = saplings::fork();
    let living = saplings::living(&plant);
    let points = cloud(&plant, 5000, 3);
    assert_eq!(points.len(), 5000);
    let (wood, leaves): (Vec<_>, Vec<_>) = points.iter().partition(|point| point.label == 0);
    assert!(!wood.is_empty() && !leaves.is_empty());
    let widths = style();
    let widths = Widths::of(&plant, widths.girth());
    for point in &points {
        assert!((point.normal.length() - 1.0).abs() < 1e-5);
        let id = living[point.metamer as usize];
        let parent = plant.metamers().parent(id).expect("wood");
        let [from, to] = [parent, id].map(|id| plant.metamers().end(id).as_dvec3() * as_written(METRES));
        if point.label == 0 {
            let place = y_up(point.place);
            let along = ((place - from).dot(to - from) / (to - from).length_squared()).clamp(0.0, 1.0);
            let outward = place - from.lerp(to, along);
            let thickest = f64::from(widths.radius(id).max(if plant.is_seed(parent) {
                0.0
            } else {
                widths.radius(parent)
            }));
            assert!(outward.length() <= thickest * as_written(METRES) + 1e-6);
            assert!(outward.dot(y_up(point.normal)) > 0.0);
        }
    }
}

#[test]
fn points_lie_on_flowers_and_fruits_as_well() {
    let plant = saplings::fork();
    let living = saplings::living(&plant);
    let labels = |looks: &Appearance| -> [usize; 4] {
        let points = cloud_of(&plant, looks, 8000, 3);
        for point in points.iter().filter(|point| point.label >= 2) {
            assert!((point.normal.length() - 1.0).abs() < 1e-5);
            // No longer than its stalk and itself from the internode that bears it.
            let id = living[point.metamer as usize];
            let ends = [plant.metamers().parent(id).expect("wood"), id].map(|id| plant.metamers().end(id));
            let [from, to] = ends.map(|end| end.as_dvec3() * as_written(METRES));
            let place = y_up(point.place);
            let along = ((place - from).dot(to - from) / (to - from).length_squared()).clamp(0.0, 1.0);
            assert!(place.distance(from.lerp(to, along)) < 2.0 * f64::from(METRES), "{place}");
        }
        [0, 1, 2, 3].map(|label| points.iter().filter(|point| point.label == label).count())
    };
    let bare = looks();
    let place = Place::Twigs;
    let flowers = FlowerLook { kind: FlowerKind::Rosette, share: 1.0, place, size: 0.5, ..bare.flowers };
    let fruits = FruitLook { kind: FruitKind::Round, share: 1.0, place, size: 0.5, ..bare.fruits };
    let in_flower = Appearance { flowers, ..bare };
    let [wood, leaves, none, nothing] = labels(&bare);
    assert!(wood > 0 && leaves > 0 && none == 0 && nothing == 0);
    let [_, _, blossom, nothing] = labels(&in_flower);
    assert!(blossom > 100 && nothing == 0, "{blossom} {nothing}");
    let all = labels(&Appearance { fruits, ..in_flower });
    assert!(all.iter().all(|&count| count > 100) && all.iter().sum::<usize>() == 8000, "{all:?}");
    // Twice as long, four times the area, beside the same leaves.
    let larger = Appearance { flowers: FlowerLook { size: 1.0, ..flowers }, ..bare };
    let [small, large] = [in_flower, larger].map(|looks| {
        let [_, leaves, flowers, _] = labels(&looks);
        flowers as f64 / leaves as f64
    });
    assert!((large / small / 4.0 - 1.0).abs() < 0.1, "{small} {large}");
}

#[test]
fn a_cloud_depends_on_its_seed_alone() {
    let plant = saplings::fork();
    let places = |seed| cloud(&plant, 100, seed).iter().map(|point| point.place).collect::<Vec<_>>();
    assert_eq!(places(1), places(1));
    assert_ne!(places(1), places(2));
    assert!(cloud(&Plant::new(Vec3::ZERO), 100, 1).is_empty(), "a seed has no surface");
}

#[test]
fn skeleton_of_a_fork_is_this() {
    let file = skeleton(&saplings::fork());
    let head = ["format", "version", "unit", "species", "seed"].map(|name| file[name].to_string());
    assert_eq!(head, [r#""espalier-skeleton""#, "2", r#""metre""#, r#""pear""#, "7"]);
    assert_eq!(file["parameters"]["internode_length"].as_f64().map(|l| l as f32), Some(METRES));
    let text = file["metamers"].to_string();
    let expected = concat!(
        r#"[{"axis":0,"birth":0,"normal":[1.0,0.0,0.0],"parent":null,"position":[0.0,0.0,0.0],"radius":0.0},"#,
        r#"{"axis":0,"birth":1,"normal":[1.0,0.0,0.0],"parent":0,"position":[0.0,0.1,0.0],"radius":0.008660253882,"shed":1},"#,
    );
    assert!(text.starts_with(expected), "{text}");
    assert_eq!(list(&file["axes"]).iter().filter(|axis| axis["bearer"].is_null()).count(), 1);
}

#[test]
fn graph_of_a_fork_is_this_text() {
    let file = text(graph(&saplings::fork()).expect("it exports"));
    let (_, code) = file.split_once("\nMTG:\n").expect("a graph");
    let expected = "\
TOPO\t\tXX\tYY\tZZ\tTopDia\tBirth\tAge\tId\tShed\tInternodeLength\tSpecies\tSeed
/P1\t\t0\t0\t0\t0\t0\t2\t0\t\t0.1\tpear\t7
^/A0/M1\t\t0\t0\t0.1\t0.01732050776\t1\t1\t1\t1\t\t\t
\t+A1/M1\t0\t-0.05\t0.1\t0.01000000015\t2\t0\t3\t\t\t\t
^<M2\t\t0\t0\t0.2\t0.01000000015\t1\t1\t2\t\t\t\t
";
    assert_eq!(code, expected);
}
