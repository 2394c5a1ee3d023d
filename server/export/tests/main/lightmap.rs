//! Places in a light map: nothing lies on anything else, and everything is about as large as on the tree.

use std::collections::BTreeMap;

use espalier_export::{Detail, Model};
use espalier_growth::species;
use espalier_mesh::Style;
use espalier_plant::{MetamerId, Plant};
use espalier_settings::{Appearance, LeafKind};
use glam::{Vec2, Vec3};
use proptest::prelude::*;

use crate::{METRES, looks, model, reader, reader::ReadMesh, root, saplings, species::raised, style};

const TEXELS: u32 = 1024;
/// Samples along a side of the texture, at which triangles are looked for.
const SAMPLES: usize = 2048;

fn lit(plant: &Plant, style: &Style, looks: &Appearance, options: Model) -> Vec<ReadMesh> {
    let options = Model { lightmap: Some(TEXELS), ..options };
    reader::read(&model(plant, style, looks, METRES, &options).expect("it exports"))
}

/// The pieces of a mesh, by their vertices: what hangs together by indices.
fn pieces(mesh: &ReadMesh) -> Vec<Vec<[usize; 3]>> {
    let mut of: Vec<usize> = (0..mesh.positions.len()).collect();
    fn root(of: &mut [usize], mut vertex: usize) -> usize {
        while of[vertex] != vertex {
            of[vertex] = of[of[vertex]];
            vertex = of[vertex];
        }
        vertex
    }
    let triangles =
        || mesh.indices.as_chunks::<3>().0.iter().map(|corners| corners.map(|corner| corner as usize));
    for [a, b, c] in triangles() {
        for other in [b, c] {
            let [a, other] = [a, other].map(|vertex| root(&mut of, vertex));
            of[other] = a;
        }
    }
    let mut pieces: BTreeMap<usize, Vec<[usize; 3]>> = BTreeMap::new();
    for corners in triangles() {
        pieces.entry(root(&mut of, corners[0])).or_default().push(corners);
    }
    pieces.into_values().collect()
}

/// Nothing lies outside the texture, on anything else, or within a texel of another piece.
fn is_apart(mesh: &ReadMesh) {
    assert_eq!(mesh.lit.len(), mesh.positions.len(), "{}", mesh.name);
    let inside = |place: &Vec2| place.min_element() >= 0.0 && place.max_element() <= 1.0;
    assert!(mesh.lit.iter().all(inside), "{}", mesh.name);
    // Of which piece a sample is, and of which triangle.
    let mut samples = vec![(usize::MAX, usize::MAX); SAMPLES * SAMPLES];
    let mut number = 0;
    for (piece, triangles) in pieces(mesh).iter().enumerate() {
        for corners in triangles {
            number += 1;
            let [a, b, c] = corners.map(|corner| mesh.lit[corner] * SAMPLES as f32);
            let area = (b - a).perp_dot(c - a);
            assert!(area != 0.0, "{}: a triangle at {a} has no area", mesh.name);
            let low = (a.min(b).min(c) - 1.0).max(Vec2::ZERO);
            let high = (a.max(b).max(c) + 1.0).min(Vec2::splat(SAMPLES as f32));
            for y in low.y as usize..high.y as usize {
                for x in low.x as usize..high.x as usize {
                    let at = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                    let weights =
                        [(b - at).perp_dot(c - at), (c - at).perp_dot(a - at), (a - at).perp_dot(b - at)];
                    if weights.iter().all(|weight| weight / area > 1e-3) {
                        let before = std::mem::replace(&mut samples[y * SAMPLES + x], (piece, number));
                        assert_eq!(before, (usize::MAX, usize::MAX), "{}: two at {at}", mesh.name);
                    }
                }
            }
        }
    }
    // Two texels are four samples: two samples beside one another in any direction are of one piece.
    for y in 0..SAMPLES - 2 {
        for x in 0..SAMPLES - 2 {
            let here = samples[y * SAMPLES + x].0;
            for (dx, dy) in [(1, 0), (2, 0), (0, 1), (0, 2), (1, 1), (2, 2)] {
                let beside = samples[(y + dy) * SAMPLES + x + dx].0;
                assert!(
                    here == beside || here == usize::MAX || beside == usize::MAX,
                    "{} at {x}, {y}",
                    mesh.name
                );
            }
        }
    }
}

/// How much larger a triangle is in the texture than on the tree, with its area there.
fn enlargements(mesh: &ReadMesh) -> Vec<(f32, f32)> {
    let triangles =
        mesh.indices.as_chunks::<3>().0.iter().map(|corners| corners.map(|corner| corner as usize));
    triangles
        .map(|[a, b, c]| {
            let (place, lit) = (&mesh.positions, &mesh.lit);
            let area = 0.5 * (place[b] - place[a]).cross(place[c] - place[a]).length();
            let shown = 0.5 * (lit[b] - lit[a]).perp_dot(lit[c] - lit[a]).abs();
            ((shown / area).sqrt(), area)
        })
        .collect()
}

/// The share of the surface whose scale is within a factor of that of the mesh as a whole.
fn share_within(mesh: &ReadMesh, factor: f32) -> f32 {
    let all = enlargements(mesh);
    let total: f32 = all.iter().map(|(_, area)| area).sum();
    let mean = (all.iter().map(|(scale, area)| scale * scale * area).sum::<f32>() / total).sqrt();
    let even = all.iter().filter(|(scale, _)| (mean / factor..mean * factor).contains(scale));
    even.map(|(_, area)| area).sum::<f32>() / total
}

/// No edge is open where vertices at one place count as one.
fn is_closed(wood: &ReadMesh) {
    let bits = |corner: u32| wood.positions[corner as usize].to_array().map(f32::to_bits);
    let mut runs: BTreeMap<_, i32> = BTreeMap::new();
    for corners in wood.indices.as_chunks::<3>().0 {
        for [from, to] in [[0, 1], [1, 2], [2, 0]] {
            let (from, to) = (bits(corners[from]), bits(corners[to]));
            *runs.entry((from.min(to), from.max(to))).or_default() += if from < to { 1 } else { -1 };
        }
    }
    assert!(runs.values().all(|&balance| balance == 0));
}

fn surface(mesh: &ReadMesh) -> f32 {
    let area = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize]);
        0.5 * (b - a).cross(c - a).length()
    };
    mesh.indices.as_chunks::<3>().0.iter().map(area).sum()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn no_piece_of_any_plant_lies_on_another(growth in saplings::growth()) {
        let plant = saplings::grown(&growth);
        let plain = reader::read(&model(&plant, &style(), &looks(), METRES, &Model::default()).expect("it exports"));
        let meshes = lit(&plant, &style(), &looks(), Model::default());
        prop_assert_eq!(plain.len(), meshes.len());
        for (mesh, plain) in meshes.iter().zip(&plain) {
            is_apart(mesh);
            let [one, other] = [mesh, plain].map(surface);
            prop_assert!((one - other).abs() < 1e-2 * other.max(1e-3), "{} has {} of {}", mesh.name, one, other);
            if mesh.name == "Wood" {
                is_closed(mesh);
            }
        }
    }
}

#[test]
fn a_long_trunk_is_cut_into_pieces() {
    let mut pole = saplings::pole(60);
    let [plain] = &reader::read(&bare(&pole, Model::default()))[..] else { panic!("wood alone") };
    let [wood] = &reader::read(&bare(&pole, Model { lightmap: Some(TEXELS), ..Model::default() }))[..] else {
        panic!("wood alone")
    };
    assert!(pieces(wood).len() > 10 && wood.positions.len() > plain.positions.len());
    is_apart(wood);
    is_closed(wood);
    assert!(share_within(wood, 1.2) > 0.95, "{}", share_within(wood, 1.2));
    // Its rings are far apart then, so it is cut between them.
    let coarse = Model { detail: Detail::Level(2), lightmap: Some(TEXELS), ..Model::default() };
    pole.begin_edit();
    let thick: Vec<_> = (1..=60).map(|row| (MetamerId::new(row), Some(0.5))).collect();
    pole.give_radii(&thick).expect("living wood");
    pole.end_step();
    let [wood] = &reader::read(&bare(&pole, coarse))[..] else { panic!("wood alone") };
    is_apart(wood);
    is_closed(wood);
    assert!(pieces(wood).len() > 5);
}

fn bare(plant: &Plant, options: Model) -> Vec<u8> {
    let bare = looks().leafy(LeafKind::Round, [88, 128, 52]).turned(0.0, 3.0, 0.0);
    model(plant, &style(), &bare, METRES, &options).expect("it exports")
}

#[test]
fn texels_are_even_over_a_tree_and_there_are_as_many_as_it_says() {
    let cherry = species::find("cherry").expect("a species");
    let mut cherry = raised(cherry, 1);
    let style = Style::new(espalier_session::style_options(&cherry.parameters()));
    let looks = *cherry.appearance();
    for level in [1, 3] {
        let options = Model { detail: Detail::Level(level), lightmap: Some(TEXELS), ..Model::default() };
        let file = model(cherry.portrait(), &style, &looks, METRES, &options).expect("it exports");
        let root = root(&file);
        for (number, mesh) in reader::read(&file).iter().enumerate() {
            let said = &root["meshes"][number]["extras"]["lightmap"];
            let (texels, density) = (said["texels"].as_f64(), said["texels_per_metre"].as_f64());
            let (Some(texels), Some(density)) = (texels, density) else {
                panic!("{} says {said}", mesh.name)
            };
            assert!(said["gutter"] == 2 && texels >= f64::from(TEXELS));
            let all = enlargements(mesh);
            let near = |scale: f32| (0.5..2.0).contains(&(f64::from(scale) * texels / density));
            let total: f32 = all.iter().map(|(_, area)| area).sum();
            let even: f32 = all.iter().filter(|(scale, _)| near(*scale)).map(|(_, area)| area).sum();
            assert!(even > 0.9 * total, "{}: only {} is near what it says", mesh.name, even / total);
        }
    }
}

#[test]
fn the_same_plant_has_the_same_places_and_instances_have_none() {
    let plant = saplings::fork();
    let options = Model { lightmap: Some(TEXELS), instanced: true, ..Model::default() };
    let [one, other] =
        [(); 2].map(|()| model(&plant, &style(), &looks(), METRES, &options).expect("it exports"));
    assert_eq!(one, other);
    let root = root(&one);
    for mesh in root["meshes"].as_array().into_iter().flatten() {
        let is_wood = mesh["name"] == "Tree Wood";
        for part in mesh["primitives"].as_array().into_iter().flatten() {
            assert_eq!(!part["attributes"]["TEXCOORD_1"].is_null(), is_wood, "{mesh}");
        }
    }
}

#[test]
fn quantised_places_are_those_of_the_others() {
    let plant = saplings::pole(20);
    let [plain, small] = [false, true].map(|quantised| {
        let options = Model { quantised, lightmap: Some(TEXELS), ..Model::default() };
        let file = model(&plant, &style(), &looks(), METRES, &options).expect("it exports");
        let root = root(&file);
        let meshes = root["meshes"].as_array().cloned().unwrap_or_default();
        let of = |mesh: &serde_json::Value| {
            let accessor = mesh["primitives"][0]["attributes"]["TEXCOORD_1"].as_u64().expect("places");
            crate::models::numbers(&file, accessor as usize)
        };
        meshes.iter().map(of).collect::<Vec<_>>()
    });
    for (plain, small) in plain.iter().flatten().zip(small.iter().flatten()) {
        assert!((plain - small).abs() < 1e-5, "{plain} is {small}");
    }
    assert_eq!(
        plain.iter().map(Vec::len).collect::<Vec<_>>(),
        small.iter().map(Vec::len).collect::<Vec<_>>()
    );
}

#[test]
fn a_cut_has_its_places_too() {
    let mut plant = saplings::pole(6);
    plant.begin_edit();
    plant.set_width(MetamerId::new(3), Some(0.5));
    plant.prune(&[MetamerId::new(4)]);
    plant.end_step();
    let options = Model { lightmap: Some(TEXELS), ..Model::default() };
    let file = model(&plant, &style(), &looks(), METRES, &options).expect("it exports");
    let root = root(&file);
    let cut = &root["meshes"][0]["primitives"][1]["attributes"];
    assert!(cut["TEXCOORD_0"].is_u64() && cut["TEXCOORD_1"].is_u64() && cut["COLOR_0"].is_null(), "{cut}");
    let meshes = reader::read(&file);
    is_apart(&meshes[0]);
    is_closed(&meshes[0]);
    assert!(meshes[0].positions.iter().all(|place: &Vec3| place.is_finite()));
}
