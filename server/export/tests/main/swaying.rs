//! Skins and animations: bones stand where the wind has them, vertices rest where they grew.

use espalier_export::{About, Detail, Model, in_memory, joints_csv};
use espalier_growth::species;
use espalier_mesh::RingTable;
use espalier_motion::{
    Joints, Rig, Rows, Scale, Weather,
    clips::{Clip, blow, clips, reaches},
};
use espalier_plant::Plant;
use espalier_settings::{Appearance, ParameterValues, looks::WindLook};
use glam::{DVec3, Mat4, Quat, Vec3};
use serde_json::Value;

use crate::{METRES, glb, looks, model, models::numbers, reader, root, saplings, species::raised, style};

const BONES: u32 = 64;

fn windy() -> Appearance {
    let wind = WindLook { speed: 12.0, direction: 30.0, ..WindLook::default() };
    Appearance { wind, ..looks() }
}

fn sways(most: u32) -> Model {
    Model { sway: Some(most), ..Model::default() }
}

/// What motion itself says of the plant of the first seed.
fn motion(plant: &Plant) -> ([Clip; 2], Vec<Vec<Vec<Vec3>>>, usize) {
    let mut table = RingTable::new();
    table.sync(plant, &style(), 1);
    let leaf_size = f64::from(style().options().leaf_size);
    let scale = Scale { internode_length: f64::from(METRES), leaf_size };
    let (limbs, wood, joints) = Joints::grown(&Rows::of(&table), &scale, 1.0);
    let (sin, cos) = libm::sincos(30f64.to_radians());
    let velocity = DVec3::new(12.0 * cos, 0.0, 12.0 * sin);
    let turbulence = f64::from(WindLook::default().turbulence);
    let weather = Weather { velocity, turbulence, seed: 7 };
    let mut clips = clips(&joints, &wood, &weather);
    let reach = reaches(&clips, joints.all().len());
    let rig = Rig::of(&joints, &limbs, &wood, 0, &reach, BONES as usize);
    let [_, gust] = &mut clips;
    blow(gust, std::slice::from_ref(&rig), &joints, &limbs, &wood, &weather);
    let places = clips.iter().map(|clip| {
        let of =
            |key: &Vec<DVec3>| rig.stand(&joints, &wood, key).iter().map(|at| at.place.as_vec3()).collect();
        clip.keys.iter().map(of).collect()
    });
    let places = places.collect();
    (clips, places, rig.bones().len())
}

fn usda(plant: &Plant, looks: &Appearance, model: &Model) -> String {
    let parameters = ParameterValues { internode_length: METRES, ..ParameterValues::default() };
    let (program, simulation, species, seed, author, licence) = ("Espalier", 1, None, None, None, None);
    let about = About { program, simulation, species, seed, parameters: &parameters, author, licence };
    let file = in_memory(|out| espalier_export::usda(plant, &style(), looks, &about, model, out));
    String::from_utf8(file.expect("it exports")).expect("it is text")
}

fn index(value: &Value) -> usize {
    value.as_u64().expect("an index") as usize
}

fn vector(value: &Value) -> Vec3 {
    let parts: Vec<f32> = value.as_array().map_or(vec![0.0; 3], |parts| {
        parts.iter().map(|part| part.as_f64().unwrap_or_default() as f32).collect()
    });
    Vec3::from_slice(&parts)
}

/// Where all nodes are at a key of an animation; at rest where there is none.
fn world(file: &[u8], root: &Value, key: Option<(&Value, usize)>) -> Vec<Mat4> {
    let nodes = root["nodes"].as_array().expect("nodes");
    let mut local: Vec<(Vec3, Quat)> =
        nodes.iter().map(|node| (vector(&node["translation"]), Quat::IDENTITY)).collect();
    if let Some((animation, key)) = key {
        for channel in animation["channels"].as_array().expect("channels") {
            let sampler = &animation["samplers"][index(&channel["sampler"])];
            let values = numbers(file, index(&sampler["output"]));
            let to = &mut local[index(&channel["target"]["node"])];
            match channel["target"]["path"].as_str() {
                Some("rotation") => to.1 = Quat::from_slice(&values[4 * key..]),
                _ => to.0 = Vec3::from_slice(&values[3 * key..]),
            }
        }
    }
    let mut all = vec![Mat4::IDENTITY; nodes.len()];
    let mut left: Vec<(usize, Mat4)> = root["scenes"][0]["nodes"]
        .as_array()
        .expect("nodes")
        .iter()
        .map(|node| (index(node), Mat4::IDENTITY))
        .collect();
    while let Some((node, below)) = left.pop() {
        let (place, turn) = local[node];
        all[node] = below * Mat4::from_rotation_translation(turn, place);
        for child in nodes[node]["children"].as_array().into_iter().flatten() {
            left.push((index(child), all[node]));
        }
    }
    all
}

#[test]
fn bones_stand_where_motion_has_them_at_each_key() {
    let mut document = raised(species::find("oak").expect("there are oaks"), 4);
    let plant = document.portrait();
    let file = model(plant, &style(), &windy(), METRES, &sways(BONES)).expect("it exports");
    let root = root(&file);
    let (clips, places, bones) = motion(plant);
    let joints = root["skins"][0]["joints"].as_array().expect("joints");
    assert_eq!(joints.len(), bones);
    assert!(bones > 10, "{bones} bones");
    let animations = root["animations"].as_array().expect("animations");
    assert_eq!(animations.len(), 2);
    for ((animation, clip), places) in animations.iter().zip(&clips).zip(&places) {
        assert!(animation["name"].as_str().is_some_and(|name| name.starts_with(clip.name)));
        for key in [0, 1, 50, 133, clip.keys.len() - 1] {
            let all = world(&file, &root, Some((animation, key)));
            for (joint, &wanted) in joints.iter().zip(&places[key]) {
                let found = all[index(joint)].transform_point3(Vec3::ZERO);
                assert!(found.distance(wanted) < 1e-3, "{}, key {key}: {found} is not {wanted}", clip.name);
            }
        }
        // The loop closes to the bit.
        for sampler in animation["samplers"].as_array().expect("samplers") {
            let times = numbers(&file, index(&sampler["input"]));
            let values = numbers(&file, index(&sampler["output"]));
            let each = values.len() / times.len();
            assert_eq!(times.last().copied(), Some(clip.length as f32));
            assert_eq!(values[..each], values[values.len() - each..]);
        }
    }
}

#[test]
fn at_rest_a_skin_shows_the_plant_as_it_grew() {
    let mut document = raised(species::find("oak").expect("there are oaks"), 4);
    let plant = document.portrait();
    for quantised in [false, true] {
        let options = Model { quantised, ..sways(BONES) };
        let file = model(plant, &style(), &windy(), METRES, &options).expect("it exports");
        let still = reader::read(&glb(plant, &style(), &windy(), METRES).expect("it exports"));
        let root = root(&file);
        let all = world(&file, &root, None);
        let mut seen = 0;
        for node in root["nodes"].as_array().expect("nodes").iter().filter(|node| !node["skin"].is_null()) {
            let skin = &root["skins"][index(&node["skin"])];
            let inverse = numbers(&file, index(&skin["inverseBindMatrices"]));
            let bones: Vec<Mat4> = skin["joints"]
                .as_array()
                .expect("joints")
                .iter()
                .zip(inverse.as_chunks::<16>().0)
                .map(|(joint, inverse)| all[index(joint)] * Mat4::from_cols_array(inverse))
                .collect();
            let attributes = &root["meshes"][index(&node["mesh"])]["primitives"][0]["attributes"];
            let of = |name: &str| numbers(&file, index(&attributes[name]));
            let (places, which, shares) = (of("POSITION"), of("JOINTS_0"), of("WEIGHTS_0"));
            let name = node["name"].as_str().unwrap_or_default();
            let source =
                still.iter().find(|mesh| name.ends_with(&mesh.name)).expect("it is there without a skin");
            assert_eq!(3 * source.positions.len(), places.len());
            for (vertex, wanted) in source.positions.iter().enumerate() {
                let place = Vec3::from_slice(&places[3 * vertex..]);
                let (which, shares) = (&which[4 * vertex..][..4], &shares[4 * vertex..][..4]);
                assert!((shares.iter().sum::<f32>() - 1.0).abs() < 1e-6);
                let found: Vec3 = which
                    .iter()
                    .zip(shares)
                    // `numbers` has them as shares of 65,535.
                    .map(|(bone, share)| {
                        *share * bones[(bone * 65535.0).round() as usize].transform_point3(place)
                    })
                    .sum();
                assert!(found.distance(*wanted) < 2e-3, "{name}: {found} is not {wanted}");
            }
            seen += 1;
        }
        assert_eq!(seen, still.len());
    }
}

#[test]
fn what_hardly_is_a_tree_and_several_of_them_sway_as_well() {
    for plant in [Plant::new(Vec3::ZERO), saplings::fork()] {
        for most in [2, 1024] {
            let file = model(&plant, &style(), &looks(), METRES, &sways(most)).expect("it exports");
            let still = reader::read(&glb(&plant, &style(), &looks(), METRES).expect("it exports"));
            assert_eq!(root(&file)["skins"].as_array().map_or(0, Vec::len), still.len());
        }
    }
}

/// The numbers of a list that follows a name in text.
fn list(text: &str, name: &str) -> Vec<f32> {
    let list = text.split(name).nth(1).and_then(|rest| rest.split(']').next()).unwrap_or_default();
    let words = list.split(|letter: char| "[(), ".contains(letter)).filter(|word| !word.is_empty());
    words.map(|word| word.parse().unwrap_or_else(|_| panic!("{name}: {word} is no number"))).collect()
}

#[test]
fn a_skeleton_of_usd_stands_where_motion_has_it_and_its_loop_closes() {
    let mut document = raised(species::find("oak").expect("there are oaks"), 4);
    let plant = document.portrait();
    let text = usda(plant, &windy(), &sways(BONES));
    let (clips, places, bones) = motion(plant);
    assert!(text.contains("def SkelRoot \"Tree\"") && text.contains("    endTimeCode = 240\n"));
    let skeleton = text.split("def Skeleton \"Bones\"").nth(1).expect("it has bones");
    let names = skeleton.split("joints = [").nth(1).and_then(|rest| rest.split(']').next()).expect("names");
    let names: Vec<&str> = names.split(", ").map(|name| name.trim_matches('"')).collect();
    assert_eq!(names.len(), bones);
    let parent = |name: &str| {
        let (above, _) = name.rsplit_once('/')?;
        names.iter().position(|other| *other == above)
    };
    let parents: Vec<Option<usize>> = names.iter().map(|name| parent(name)).collect();
    assert_eq!(parents.iter().filter(|parent| parent.is_none()).count(), 1);
    let composed = |local: &dyn Fn(usize) -> Mat4| {
        let mut all: Vec<Mat4> = Vec::new();
        for (bone, parent) in parents.iter().enumerate() {
            all.push(parent.map_or(Mat4::IDENTITY, |parent| all[parent]) * local(bone));
        }
        all
    };
    let matrices = |name: &str| -> Vec<Mat4> {
        let values = list(skeleton, name);
        values.as_chunks::<16>().0.iter().map(Mat4::from_cols_array).collect()
    };
    let (bind, rest) = (matrices("bindTransforms = "), matrices("restTransforms = "));
    for (composed, bind) in composed(&|bone| rest[bone]).iter().zip(&bind) {
        assert!(composed.abs_diff_eq(*bind, 1e-4), "at rest a bone stands where its vertices are bound");
    }
    let keys = |name: &str| -> Vec<Vec<f32>> {
        let samples = skeleton.split(name).nth(1).and_then(|rest| rest.split('}').next()).expect("samples");
        samples.split('\n').filter(|line| line.contains(": [")).map(|line| list(line, ": ")).collect()
    };
    let (moves, turns) = (keys("translations.timeSamples"), keys("rotations.timeSamples"));
    assert_eq!([moves.len(), turns.len()], [clips[0].keys.len(); 2]);
    for key in [0, 1, 50, 133, 240] {
        let local = |bone: usize| {
            let [w, x, y, z] = *turns[key][4 * bone..].first_chunk().expect("four numbers");
            Mat4::from_rotation_translation(
                Quat::from_xyzw(x, y, z, w),
                Vec3::from_slice(&moves[key][3 * bone..]),
            )
        };
        for (matrix, &wanted) in composed(&local).iter().zip(&places[0][key]) {
            let found = matrix.transform_point3(Vec3::ZERO);
            assert!(found.distance(wanted) < 1e-3, "key {key}: {found} is not {wanted}");
        }
    }
    assert_eq!((&moves[0], &turns[0]), (&moves[240], &turns[240]), "the loop has no seam");
    assert_ne!(turns[0], turns[100]);
    let mut parts = 0;
    for part in text.split("def Mesh ").skip(1) {
        let points = list(part, "point3f[] points = ").len() / 3;
        let (which, shares) = (list(part, "jointIndices = "), list(part, "jointWeights = "));
        assert_eq!([which.len(), shares.len()], [2 * points; 2]);
        assert!(which.iter().all(|&bone| (bone as usize) < bones));
        assert!(shares.as_chunks::<2>().0.iter().all(|[one, other]| (one + other - 1.0).abs() < 1e-6));
        assert!(which.iter().any(|&bone| bone > 10.0), "it goes along with many of them");
        parts += 1;
    }
    assert_eq!(parts, 2, "wood and leaves");
}

#[test]
fn bones_of_usd_go_with_levels_limbs_and_hulls_and_stand_in_a_plant_that_has_none() {
    let plain = Plant::new(Vec3::ZERO);
    assert!(usda(&plain, &looks(), &sways(2)).contains("def SkelRoot"));
    let mut document = raised(species::find("oak").expect("there are oaks"), 4);
    let options = Model { detail: Detail::Set, hull: true, by_limb: true, ..sways(BONES) };
    let text = usda(document.portrait(), &windy(), &options);
    for part in text.split("def Mesh ").skip(1) {
        let part = part.split("def Xform").next().expect("it is there");
        let stands = part.starts_with("\"UCX_") || part.starts_with("\"Billboard");
        assert_eq!(part.contains("SkelBindingAPI"), !stands, "hulls and billboards stand still");
        assert_eq!(part.contains("rel skel:skeleton = </Plants/Tree/Bones>"), !stands);
    }
    assert!(!usda(document.portrait(), &windy(), &Model::default()).contains("Skel"));
}

#[test]
fn joints_are_lines_of_numbers() {
    let mut document = raised(species::find("oak").expect("there are oaks"), 4);
    let plant = document.portrait();
    let file = in_memory(|out| joints_csv(plant, &style(), &windy(), METRES, out)).expect("it is written");
    let text = String::from_utf8(file).expect("it is text");
    let mut lines = text.lines();
    let columns = lines.next().expect("a head").split(',').count();
    let mut count = 0;
    for (number, line) in lines.enumerate() {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!((cells.len(), cells[0]), (columns, number.to_string().as_str()));
        assert!(cells[1].is_empty() || cells[1].parse::<usize>().is_ok_and(|parent| parent < number));
        assert!(cells[2..].iter().all(|cell| cell.parse::<f64>().is_ok_and(f64::is_finite)), "{line}");
        count += 1;
    }
    assert!(count > 3);
}
