//! What the exporter writes, with each of its options, is the same body as an obstacle.

#[allow(dead_code, reason = "some saplings are for others")]
#[path = "../../export/tests/main/saplings.rs"]
mod saplings;

use std::io::Cursor;

use espalier_export::{About, Detail, Model, glb, in_memory, obj};
use espalier_import::{ImportError, Limits, Size, Triangles, read_model};
use espalier_mesh::{Style, StyleOptions};
use espalier_plant::Plant;
use espalier_settings::{Appearance, ParameterValues};
use glam::{Mat4, Vec3};
use proptest::prelude::*;
use saplings::Edit;

const METRES: f32 = 0.1;
const LIMITS: Limits = Limits { vertices: 1_000_000, triangles: 1_000_000, most_triangles: 1_000_000 };
const PLAIN: Model = Model {
    detail: Detail::Level(0),
    quantised: false,
    compressed: false,
    instanced: false,
    hull: false,
    by_limb: false,
    lightmap: None,
    sway: None,
    wind_weights: false,
};

type Export = fn(
    &Plant,
    &Style,
    &Appearance,
    &About<'_>,
    &Model,
    &mut dyn espalier_export::Sink,
) -> Result<(), espalier_export::ExportError>;

fn file(export: Export, plant: &Plant, model: &Model) -> Vec<u8> {
    let parameters = ParameterValues { internode_length: METRES, ..ParameterValues::default() };
    let about = About {
        program: "Espalier",
        simulation: 1,
        species: Some("Oak"),
        seed: Some(7),
        parameters: &parameters,
        obstacles: &[],
        author: None,
        licence: None,
    };
    let style = Style::new(StyleOptions {
        girth_exponent: 2.0,
        twig_diameter: 0.1,
        leaves_per_node: 2,
        leaf_size: 0.5,
    });
    in_memory(|out| export(plant, &style, &Appearance::default(), &about, model, out)).expect("it exports")
}

fn read(bytes: &[u8]) -> Triangles {
    let model = read_model(&mut Cursor::new(bytes), &LIMITS).expect("a model");
    assert_eq!(model.simplified_from, None);
    model.triangles
}

fn bounds(mesh: &Triangles) -> [Vec3; 2] {
    [Vec3::min, Vec3::max].map(|of| mesh.vertices.iter().copied().reduce(of).expect("vertices"))
}

/// Triangles and bounds as another reader has them: three corners at different places each.
fn oracle(bytes: &[u8]) -> (usize, [Vec3; 2]) {
    fn visit(node: &gltf::Node<'_>, above: Mat4, blob: &[u8], corners: &mut Vec<Vec3>) {
        let world = above * Mat4::from_cols_array_2d(&node.transform().matrix());
        for primitive in node.mesh().iter().flat_map(gltf::Mesh::primitives) {
            let reader = primitive.reader(|_| Some(blob));
            let places: Vec<Vec3> = reader
                .read_positions()
                .expect("positions")
                .map(|place| world.transform_point3(Vec3::from(place)))
                .collect();
            corners.extend(
                reader.read_indices().expect("indices").into_u32().map(|index| places[index as usize]),
            );
        }
        node.children().for_each(|child| visit(&child, world, blob, corners));
    }
    let model = gltf::Gltf::from_slice(bytes).expect("glTF");
    let mut corners = Vec::new();
    let blob = model.blob.as_deref().expect("a binary part");
    for node in model.default_scene().or_else(|| model.scenes().next()).expect("a scene").nodes() {
        visit(&node, Mat4::IDENTITY, blob, &mut corners);
    }
    let whole =
        |corners: &&[Vec3]| corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0];
    let low = corners.iter().copied().reduce(Vec3::min).expect("corners");
    let high = corners.iter().copied().reduce(Vec3::max).expect("corners");
    (corners.chunks(3).filter(whole).count(), [low, high])
}

/// Whether a mesh is another one, but for places that are off by so much.
fn is_same(found: &Triangles, wanted: &Triangles, off: f32) -> Result<(), TestCaseError> {
    let (found_count, wanted_count) = (found.corners.len(), wanted.corners.len());
    if off == 0.0 {
        prop_assert_eq!(found_count, wanted_count);
    } else {
        // Some corners come to one place.
        prop_assert!(found_count.abs_diff(wanted_count) <= wanted_count / 50, "{found_count} {wanted_count}");
    }
    for (found, wanted) in bounds(found).into_iter().zip(bounds(wanted)) {
        prop_assert!((found - wanted).abs().max_element() <= off + 1e-5, "{found} {wanted}");
    }
    Ok(())
}

/// The extent of what is shown.
fn extent(mesh: &Triangles) -> f32 {
    let [low, high] = bounds(mesh);
    (high - low).max_element()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(8) })]

    #[test]
    fn ob6_every_option_of_our_own_files_gives_the_same_body(growth in saplings::growth()) {
        // Limbs much thicker than internodes are long reach beyond what quantised files measure.
        let usual = |edit: Edit| matches!(edit, Edit::Shed(_) | Edit::Prune(_));
        let plant = saplings::grown(
            &growth.into_iter().map(|(buds, edit)| (buds, edit.filter(|&edit| usual(edit)))).collect(),
        );
        prop_assume!(plant.living_count() > 0);
        let bytes = file(glb, &plant, &PLAIN);
        let plain = read(&bytes);
        let (count, [low, high]) = oracle(&bytes);
        prop_assert_eq!(plain.corners.len(), count);
        prop_assert!(bounds(&plain).into_iter().zip([low, high]).all(|(a, b)| a.distance(b) < 1e-5));
        // The exporter leaves room for leaves.
        let steps = (extent(&plain) + 10.0 * METRES) / 30_000.0;
        for (model, off) in [
            (Model { quantised: true, ..PLAIN }, steps),
            (Model { compressed: true, ..PLAIN }, 0.0),
            (Model { quantised: true, compressed: true, ..PLAIN }, steps),
            (Model { hull: true, ..PLAIN }, 0.0),
            (Model { by_limb: true, ..PLAIN }, 0.0),
            (Model { by_limb: true, quantised: true, compressed: true, ..PLAIN }, steps),
            // Of a set the finest level alone is read.
            (Model { detail: Detail::Set, ..PLAIN }, 0.0),
            (Model { detail: Detail::Set, hull: true, quantised: true, compressed: true, ..PLAIN }, steps),
        ] {
            is_same(&read(&file(glb, &plant, &model)), &plain, off)?;
        }
        // Instances have one bow for all leaves, so that they reach a little farther or less.
        for model in [
            Model { instanced: true, ..PLAIN },
            Model { instanced: true, quantised: true, compressed: true, ..PLAIN },
        ] {
            let mesh = read(&file(glb, &plant, &model));
            is_same(&mesh, &plain, METRES)?;
        }
        for model in [PLAIN, Model { detail: Detail::Set, hull: true, ..PLAIN }] {
            is_same(&read(&file(obj, &plant, &model)), &plain, 0.0)?;
        }
    }
}

/// A plant of some hundred metamers.
fn bush() -> Plant {
    let bud = |step: u16, i: u16| (step * 37 + i * 101, (i * 53 % 200) as i8, (i * 29 + step) as i8);
    saplings::grown(&(0..30).map(|step| ((0..20).map(|i| bud(step, i)).collect(), None)).collect())
}

#[test]
fn ob6_what_has_more_than_a_mesh_may_have_is_simplified() {
    let limits = Limits { vertices: 3000, triangles: 5000, most_triangles: 1_000_000 };
    let bush = bush();
    let whole = read(&file(glb, &bush, &PLAIN));
    assert!(whole.corners.len() > 3 * limits.triangles, "{}", whole.corners.len());
    let size = Size { vertices: whole.vertices.len(), triangles: whole.corners.len() };
    for bytes in [
        file(glb, &bush, &PLAIN),
        file(glb, &bush, &Model { compressed: true, by_limb: true, ..PLAIN }),
        file(obj, &bush, &PLAIN),
    ] {
        let model = read_model(&mut Cursor::new(&bytes), &limits).expect("a model");
        let from = model.simplified_from.expect("it is simplified");
        assert_eq!(from.triangles, size.triangles);
        assert!(from.vertices.abs_diff(size.vertices) < size.vertices / 10, "{from:?} {size:?}");
        let Triangles { vertices, corners } = &model.triangles;
        assert!(vertices.len() <= limits.vertices && corners.len() <= limits.triangles);
        assert!(corners.len() > limits.triangles / 4, "no more is lost than must be: {}", corners.len());
        for (found, wanted) in bounds(&model.triangles).into_iter().zip(bounds(&whole)) {
            assert!((found - wanted).abs().max_element() < 0.1 * extent(&whole), "{found} {wanted}");
        }
        let again = read_model(&mut Cursor::new(&bytes), &limits).expect("a model");
        assert_eq!(model, again, "the same file gives the same mesh");
    }
    let few = Limits { most_triangles: size.triangles - 1, ..limits };
    for bytes in [file(glb, &bush, &PLAIN), file(obj, &bush, &PLAIN)] {
        assert_eq!(read_model(&mut Cursor::new(&bytes), &few), Err(ImportError::TooLarge(few)));
    }
}
