//! Pivot Painter 2: each vertex finds its element in both textures, and each element its bearer.

use std::collections::BTreeSet;

use espalier_export::{About, Model, in_memory, pivots};
use espalier_growth::species;
use espalier_plant::Plant;
use espalier_settings::ParameterValues;
use glam::Vec3;
use half::f16;

use crate::{METRES, looks, models::numbers, root, scenes::members, species::raised, style};

/// Bytes of a row of an EXR file before its numbers: which it is, and how many bytes follow.
const BEFORE_ROW: usize = 8;

fn exported(plant: &Plant) -> [Vec<u8>; 3] {
    let parameters = ParameterValues { internode_length: METRES, ..ParameterValues::default() };
    let (program, simulation, species, seed, author, licence) = ("Espalier", 1, None, None, None, None);
    let about = About {
        program,
        simulation,
        species,
        seed,
        parameters: &parameters,
        obstacles: &[],
        author,
        licence,
    };
    let zip = in_memory(|out| pivots(plant, &style(), &looks(), &about, &Model::default(), out));
    let members = members(&zip.expect("it exports"));
    ["tree.glb", "tree_pivot_index.exr", "tree_xvector_extent.png"].map(|name| members[name].1.clone())
}

/// Texels across, and the four numbers of each as bits, red first.
fn texels(exr: &[u8]) -> (usize, Vec<[u16; 4]>) {
    let window = exr.windows(6).position(|at| at == b"box2i\0").expect("a window") + 10;
    let word = |at: usize| u32::from_le_bytes(exr[at..at + 4].try_into().expect("four bytes")) as usize;
    let [across, down] = [word(window + 8) + 1, word(window + 12) + 1];
    let size = BEFORE_ROW + 8 * across;
    let first = exr.len() - down * size;
    let mut texels = vec![[0; 4]; across * down];
    for row in 0..down {
        let start = first + row * size;
        assert_eq!((word(start), word(start + 4)), (row, 8 * across));
        for (channel, at) in [(3, 0), (2, 1), (1, 2), (0, 3)] {
            for x in 0..across {
                let place = start + BEFORE_ROW + 2 * (at * across + x);
                texels[row * across + x][channel] = u16::from_le_bytes([exr[place], exr[place + 1]]);
            }
        }
    }
    (across, texels)
}

#[test]
fn elements_turn_about_where_they_leave_what_bears_them() {
    let mut document = raised(species::find("oak").expect("there are oaks"), 4);
    let [glb, exr, png] = exported(document.portrait());
    let (across, texels) = texels(&exr);
    let down = texels.len() / across;
    let parent = |element: usize| usize::from(texels[element][3]) - 1024;
    let pivot = |element: usize| {
        let [x, y, z] = [0, 1, 2].map(|part| f16::from_bits(texels[element][part]).to_f32() / 100.0);
        // Back from Z up and left-handed.
        Vec3::new(x, z, y)
    };

    // Each vertex stands in the middle of a texel.
    let root = root(&glb);
    let mut found: Vec<Vec<Vec3>> = vec![Vec::new(); texels.len()];
    for mesh in root["meshes"].as_array().expect("meshes") {
        let attributes = &mesh["primitives"][0]["attributes"];
        let of = |name: &str| numbers(&glb, attributes[name].as_u64().expect("an accessor") as usize);
        let (places, texels) = (of("POSITION"), of("TEXCOORD_1"));
        for (place, at) in places.as_chunks::<3>().0.iter().zip(texels.as_chunks::<2>().0) {
            let [x, y] = [at[0] * across as f32, at[1] * down as f32];
            assert!((x.fract() - 0.5).abs() < 1e-3 && (y.fract() - 0.5).abs() < 1e-3, "{at:?}");
            found[y as usize * across + x as usize].push(Vec3::from_array(*place));
        }
    }
    let count = found.iter().filter(|places| !places.is_empty()).count();
    assert!(count > 50, "{count} elements");
    assert!(found[..count].iter().all(|places| !places.is_empty()), "each element has vertices");

    assert_eq!((parent(0), pivot(0)), (0, Vec3::ZERO), "the trunk stands on the ground");
    let mut levels = BTreeSet::new();
    for element in 0..count {
        let (mut at, mut level) = (element, 0);
        while parent(at) != at {
            assert!(parent(at) < at, "who bears stands before");
            (at, level) = (parent(at), level + 1);
        }
        levels.insert(level);
        let nearest = |of: usize| found[of].iter().map(|place| place.distance(pivot(element)));
        // A pivot lies within the wood of what bears it, on its axis.
        let away = nearest(parent(element)).fold(f32::INFINITY, f32::min);
        assert!(away < 0.5, "element {element} turns {away} m beside what bears it");
    }
    assert_eq!(levels, BTreeSet::from([0, 1, 2, 3]), "four levels, as the engine's shader goes up");

    let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().expect("a picture");
    let mut bytes = vec![0; reader.output_buffer_size().expect("it fits")];
    let info = reader.next_frame(&mut bytes).expect("it is whole");
    assert_eq!([info.width as usize, info.height as usize], [across, down]);
    for element in 0..count {
        let [x, y, z, reach] = *bytes[4 * element..].first_chunk().expect("a texel");
        let way = Vec3::new(f32::from(x), f32::from(z), f32::from(y)) / 127.5 - 1.0;
        assert!((way.length() - 1.0).abs() < 0.02, "{way} is a unit vector");
        // Bytes tell lengths in 256 steps of 8 cm.
        let tip = pivot(element) + way * (f32::from(reach) / 255.0 * 20.48);
        let away = found[element].iter().map(|place| place.distance(tip)).fold(f32::INFINITY, f32::min);
        assert!(away < 0.6, "element {element} ends {away} m from its tip");
    }
}

#[test]
fn what_is_no_tree_has_one_texel() {
    let [_, exr, _] = exported(&Plant::new(Vec3::ZERO));
    assert_eq!(texels(&exr), (1, vec![[0, 0, 0, 1024]]));
}
