//! Skins and animations: bones stand where the wind has them, vertices rest where they grew.

use std::io::{Cursor, ErrorKind, Seek, SeekFrom, Write};

use espalier_export::{About, Detail, ExportError, Model, in_memory, joints_csv};
use espalier_growth::{Obstacle, Shape, species};
use espalier_mesh::RingTable;
use espalier_motion::{
    Joints, Node, Rig, Rows, Scale, Weather,
    clips::{Clip, Conditions, KEYS_A_SECOND, blow, clips, reaches},
    loads::{self, Loading},
    shelter::{Form, Solid},
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

/// The same wind over snow, wet leaves and wood that sags.
fn laden() -> Appearance {
    let wind = WindLook { snow: 0.12, rain: 0.8, sag: 0.3, rise: -2.0, ..windy().wind };
    Appearance { wind, ..looks() }
}

/// A wall upwind of a tree, somewhat lower than that and turned against it.
fn wall() -> (Obstacle, Solid) {
    let (place, half) = (Vec3::new(-40.0, 12.0, -14.0), Vec3::new(2.0, 12.0, 30.0));
    let turn = Quat::from_rotation_y(0.3);
    let shape = Shape::Box { centre: place, half_extents: half, rotation: turn };
    let solid = Solid::new(Form::Box(half.as_dvec3()), place.as_dvec3(), turn.as_dquat(), f64::from(METRES));
    (Obstacle::new(shape).expect("a box"), solid.expect("it stands"))
}

/// What motion itself says of the plant of the first seed: clips, where all bones stand at each key of both, how many bones there
/// are.
fn motion(plant: &Plant, looks: &Appearance, solids: &[Solid]) -> ([Clip; 2], Vec<Vec<Vec<Mat4>>>, usize) {
    let look = &looks.wind;
    let mut table = RingTable::new();
    table.sync(plant, &style(), 1);
    let leaf_size = f64::from(style().options().leaf_size);
    let scale = Scale { internode_length: f64::from(METRES), leaf_size };
    let rows = Rows::of(&table);
    let (limbs, wood, joints) = Joints::grown(&rows, &scale, 1.0);
    let blows = [look.speed, look.direction, look.rise].map(f64::from);
    let [sag, snow, rain] = [look.sag, look.snow, look.rain].map(f64::from);
    let loads = loads::turns(&rows, &limbs, &wood, &joints, &scale, &Loading { sag, snow, rain });
    let weather = Weather::blowing(blows, f64::from(look.turbulence), 7);
    let conditions = Conditions::new(&wood, weather, solids, loads);
    let mut clips = clips(&joints, &wood, &conditions);
    let reach = reaches(&clips, joints.all().len());
    let rig = Rig::of(&joints, &limbs, &wood, 0, &reach, BONES as usize);
    let [_, gust] = &mut clips;
    let plants = (&joints, &limbs, &wood);
    blow(gust, std::slice::from_ref(&rig), plants, &conditions, || Ok::<(), ()>(()))
        .expect("nothing ends it");
    let places = clips.iter().map(|clip| {
        let stands = |at: &Node| Mat4::from_rotation_translation(at.turn.as_quat(), at.place.as_vec3());
        let of = |key: &Vec<DVec3>| rig.stand(&joints, &wood, key).iter().map(stands).collect();
        clip.keys.iter().map(of).collect()
    });
    let places = places.collect();
    (clips, places, rig.bones().len())
}

fn usda(plant: &Plant, looks: &Appearance, model: &Model) -> String {
    let file =
        among(&[], |about| in_memory(|out| espalier_export::usda(plant, &style(), looks, about, model, out)));
    String::from_utf8(file.expect("it exports")).expect("it is text")
}

/// What is made of plants among obstacles.
fn among<T>(obstacles: &[Obstacle], make: impl FnOnce(&About<'_>) -> T) -> T {
    let parameters = ParameterValues { internode_length: METRES, ..ParameterValues::default() };
    let (program, simulation, species, seed, author, licence) = ("Espalier", 1, None, None, None, None);
    make(&About { program, simulation, species, seed, parameters: &parameters, obstacles, author, licence })
}

fn glb_among(plant: &Plant, looks: &Appearance, obstacles: &[Obstacle], model: &Model) -> Vec<u8> {
    let file = among(obstacles, |about| {
        in_memory(|out| espalier_export::glb(plant, &style(), looks, about, model, out))
    });
    file.expect("it exports")
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

fn turn(value: &Value) -> Quat {
    match value.as_array() {
        Some(parts) => Quat::from_slice(
            &parts.iter().map(|part| part.as_f64().unwrap_or_default() as f32).collect::<Vec<_>>(),
        ),
        None => Quat::IDENTITY,
    }
}

/// Where all nodes are at a key of an animation, be it one that a channel has left out; where they are by themselves where
/// there is none.
fn world(file: &[u8], root: &Value, key: Option<(&Value, usize)>) -> Vec<Mat4> {
    let nodes = root["nodes"].as_array().expect("nodes");
    let mut local: Vec<(Vec3, Quat)> =
        nodes.iter().map(|node| (vector(&node["translation"]), turn(&node["rotation"]))).collect();
    if let Some((animation, key)) = key {
        for channel in animation["channels"].as_array().expect("channels") {
            let sampler = &animation["samplers"][index(&channel["sampler"])];
            let (times, values) =
                (numbers(file, index(&sampler["input"])), numbers(file, index(&sampler["output"])));
            let now = key as f32 / KEYS_A_SECOND as f32;
            let next = times.iter().position(|&time| time >= now).expect("the clip has not ended");
            let last = next.saturating_sub(1);
            let share = if next > last { (now - times[last]) / (times[next] - times[last]) } else { 0.0 };
            let to = &mut local[index(&channel["target"]["node"])];
            if channel["target"]["path"] == "rotation" {
                let [from, onto] = [last, next].map(|key| Quat::from_slice(&values[4 * key..]));
                to.1 = from.normalize().lerp(onto.normalize(), share);
            } else {
                let [from, onto] = [last, next].map(|key| Vec3::from_slice(&values[3 * key..]));
                to.0 = from.lerp(onto, share);
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
    let (obstacle, solid) = wall();
    for (looks, obstacles, solids) in [
        (windy(), &[][..], &[][..]),
        (laden(), std::slice::from_ref(&obstacle), std::slice::from_ref(&solid)),
    ] {
        let file = glb_among(plant, &looks, obstacles, &sways(BONES));
        let root = root(&file);
        let (clips, places, bones) = motion(plant, &looks, solids);
        let joints = root["skins"][0]["joints"].as_array().expect("joints");
        assert_eq!(joints.len(), bones);
        assert!(bones > 10, "{bones} bones");
        let animations = root["animations"].as_array().expect("animations");
        assert_eq!(animations.len(), 2);
        let height = places[1][0].iter().fold(0.0, |top: f32, bone| top.max(bone.w_axis.y));
        let still = world(&file, &root, None);
        for (joint, &wanted) in joints.iter().zip(&places[1][0]) {
            let [found, wanted] = [still[index(joint)], wanted].map(|bone| bone.transform_point3(Vec3::ZERO));
            assert!(found.distance(wanted) < 1e-3, "by itself: {found} is not {wanted}");
        }
        for ((animation, clip), places) in animations.iter().zip(&clips).zip(&places) {
            assert!(animation["name"].as_str().is_some_and(|name| name.starts_with(clip.name)));
            let mut furthest = 0f32;
            for key in (0..clip.keys.len()).step_by(13).chain([clip.keys.len() - 1]) {
                let all = world(&file, &root, Some((animation, key)));
                for (joint, wanted) in joints.iter().zip(&places[key]) {
                    // A bone, and the tip of a leaf beside it.
                    for aside in [Vec3::ZERO, 2.0 * METRES * Vec3::X] {
                        let [found, wanted] =
                            [&all[index(joint)], wanted].map(|bone| bone.transform_point3(aside));
                        furthest = furthest.max(found.distance(wanted));
                    }
                }
            }
            assert!(furthest < 4e-4 * height, "{}: bones miss {furthest} m", clip.name);
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
}

/// How far bones stand from where they were bound, on average over some keys of the loop; and how far that is downwards.
fn bent(file: &[u8]) -> [f32; 2] {
    let root = root(file);
    let animation = &root["animations"][0];
    let joints = root["skins"][0]["joints"].as_array().expect("joints");
    let inverse = numbers(file, index(&root["skins"][0]["inverseBindMatrices"]));
    let mut sum = Vec3::ZERO;
    let keys = [0, 30, 60, 90, 120, 150, 180, 210];
    for key in keys {
        let all = world(file, &root, Some((animation, key)));
        for (joint, inverse) in joints.iter().zip(inverse.as_chunks::<16>().0) {
            let moved = all[index(joint)] * Mat4::from_cols_array(inverse);
            let bound = Mat4::from_cols_array(inverse).inverse().transform_point3(Vec3::ZERO);
            sum += moved.transform_point3(bound) - bound;
        }
    }
    let mean = sum / (keys.len() * joints.len()) as f32;
    [mean.with_y(0.0).length(), -mean.y]
}

#[test]
fn snow_bends_a_skin_down_and_a_wall_upwind_shelters_it_and_one_downwind_does_not() {
    let mut document = raised(species::find("oak").expect("there are oaks"), 4);
    let plant = document.portrait();
    let model = Model { quantised: false, ..sways(BONES) };
    let of = |looks: &Appearance, obstacles: &[Obstacle]| bent(&glb_among(plant, looks, obstacles, &model));
    let [open, _] = of(&windy(), &[]);
    let box_at = |centre: Vec3| {
        let rotation = Quat::from_rotation_y(-30f32.to_radians());
        Obstacle::new(Shape::Box { centre, half_extents: Vec3::new(2.0, 90.0, 200.0), rotation })
            .expect("a box")
    };
    let (sin, cos) = libm::sincosf(30f32.to_radians());
    let upwind = Vec3::new(-60.0 * cos, 90.0, -60.0 * sin);
    let [sheltered, _] = of(&windy(), &[box_at(upwind)]);
    let behind = of(&windy(), &[box_at(upwind * Vec3::new(-1.5, 1.0, -1.5))]);
    assert!(sheltered < 0.4 * open, "{sheltered} m behind a wall, {open} m in the open");
    assert_eq!(behind, of(&windy(), &[]));
    let snowy = Appearance { wind: WindLook { snow: 0.3, ..windy().wind }, ..looks() };
    let [[_, dry], [_, fallen]] = [of(&windy(), &[]), of(&snowy, &[])];
    assert!(fallen > dry + 0.01, "{fallen} m down under snow, {dry} m without");
    let plane = Obstacle::new(Shape::Plane { point: Vec3::Y * 20.0, normal: Vec3::Y }).expect("a plane");
    assert_eq!(of(&windy(), &[plane]), of(&windy(), &[]), "a plane is land");
}

/// A file that nobody wants any more after it was flushed so many times.
struct GivenUp {
    file: Cursor<Vec<u8>>,
    flushes: u32,
}

impl Write for GivenUp {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.flushes = self.flushes.checked_sub(1).ok_or(ErrorKind::ConnectionAborted)?;
        Ok(())
    }
}

impl Seek for GivenUp {
    fn seek(&mut self, to: SeekFrom) -> std::io::Result<u64> {
        self.file.seek(to)
    }
}

#[test]
fn a_skin_that_is_given_up_while_its_gust_is_stepped_ends_there_with_nothing_written() {
    let mut document = raised(species::find("oak").expect("there are oaks"), 4);
    let plant = document.portrait();
    for flushes in [0, 40] {
        let mut out = GivenUp { file: Cursor::default(), flushes };
        let done = among(&[], |about| {
            espalier_export::glb(plant, &style(), &windy(), about, &sways(BONES), &mut out)
        });
        assert_eq!(done, Err(ExportError::Write(ErrorKind::ConnectionAborted)));
        assert_eq!((out.file.get_ref().len(), out.flushes), (0, 0));
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

/// The bone that bears each bone of a skeleton of USD, by the paths that are their names.
fn parents_in(skeleton: &str) -> Vec<Option<usize>> {
    let names = skeleton.split("joints = [").nth(1).and_then(|rest| rest.split(']').next()).expect("names");
    let names: Vec<&str> = names.split(", ").map(|name| name.trim_matches('"')).collect();
    let parent = |name: &&str| {
        let (above, _) = name.rsplit_once('/')?;
        names.iter().position(|other| *other == above)
    };
    names.iter().map(parent).collect()
}

/// Where bones are whose places beside those that bear them are these.
fn composed(parents: &[Option<usize>], local: &dyn Fn(usize) -> Mat4) -> Vec<Mat4> {
    let mut all: Vec<Mat4> = Vec::new();
    for (bone, parent) in parents.iter().enumerate() {
        all.push(parent.map_or(Mat4::IDENTITY, |parent| all[parent]) * local(bone));
    }
    all
}

/// The matrices that follow a name in text.
fn matrices(text: &str, name: &str) -> Vec<Mat4> {
    list(text, name).as_chunks::<16>().0.iter().map(Mat4::from_cols_array).collect()
}

#[test]
fn a_skeleton_of_usd_stands_where_motion_has_it_and_its_loop_closes() {
    let mut document = raised(species::find("oak").expect("there are oaks"), 4);
    let plant = document.portrait();
    let text = usda(plant, &windy(), &sways(BONES));
    let (clips, places, bones) = motion(plant, &windy(), &[]);
    assert!(text.contains("def SkelRoot \"Tree\"") && text.contains("    endTimeCode = 240\n"));
    let skeleton = text.split("def Skeleton \"Bones\"").nth(1).expect("it has bones");
    let parents = parents_in(skeleton);
    assert_eq!(parents.len(), bones);
    assert_eq!(parents.iter().filter(|parent| parent.is_none()).count(), 1);
    let composed = |local: &dyn Fn(usize) -> Mat4| composed(&parents, local);
    let (bind, rest) = (matrices(skeleton, "bindTransforms = "), matrices(skeleton, "restTransforms = "));
    for (composed, bind) in composed(&|bone| rest[bone]).iter().zip(&bind) {
        assert!(composed.abs_diff_eq(*bind, 1e-4), "at rest a bone stands where its vertices are bound");
    }
    let heavy = usda(plant, &laden(), &sways(BONES));
    let heavy = heavy.split("def Skeleton \"Bones\"").nth(1).expect("it has bones");
    let (_, stands, count) = motion(plant, &laden(), &[]);
    let (under, rest) = (parents_in(heavy), matrices(heavy, "restTransforms = "));
    assert_eq!([under.len(), rest.len()], [count; 2]);
    for (composed, &wanted) in self::composed(&under, &|bone| rest[bone]).iter().zip(&stands[1][0]) {
        let [found, wanted] = [*composed, wanted].map(|bone| bone.transform_point3(Vec3::ZERO));
        assert!(found.distance(wanted) < 1e-3, "under snow at rest: {found} is not {wanted}");
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
            let [found, wanted] = [*matrix, wanted].map(|bone| bone.transform_point3(Vec3::ZERO));
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

/// The lines of a table of joints, below its head.
fn table(plant: &Plant, looks: &Appearance, obstacles: &[Obstacle]) -> (Vec<String>, Vec<Vec<String>>) {
    let file = in_memory(|out| joints_csv(plant, &style(), looks, obstacles, METRES, out));
    let text = String::from_utf8(file.expect("it is written")).expect("it is text");
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect());
    (lines.next().expect("a head"), lines.collect())
}

#[test]
fn joints_are_lines_of_numbers() {
    let mut document = raised(species::find("oak").expect("there are oaks"), 4);
    let plant = document.portrait();
    let (head, lines) = table(plant, &windy(), &[]);
    for (number, cells) in lines.iter().enumerate() {
        assert_eq!((cells.len(), cells[0].as_str()), (head.len(), number.to_string().as_str()));
        assert!(cells[1].is_empty() || cells[1].parse::<usize>().is_ok_and(|parent| parent < number));
        assert!(cells[2..].iter().all(|cell| cell.parse::<f64>().is_ok_and(f64::is_finite)), "{cells:?}");
    }
    assert!(lines.len() > 3);
}

#[test]
fn joints_have_the_wind_that_reaches_them_and_what_bends_them() {
    let mut document = raised(species::find("oak").expect("there are oaks"), 4);
    let plant = document.portrait();
    let (head, _) = table(plant, &windy(), &[]);
    let column = |looks: &Appearance, obstacles: &[Obstacle], name: &str| -> Vec<f64> {
        let at = head.iter().position(|column| column == name).expect("a column");
        let (_, lines) = table(plant, looks, obstacles);
        lines.iter().map(|cells| cells[at].parse().expect("a number")).collect()
    };
    let [open, behind] = [&[][..], &[wall().0][..]].map(|obstacles| column(&windy(), obstacles, "exposure"));
    assert!(open.iter().zip(&behind).all(|(open, behind)| behind <= open && *behind > 0.0));
    let sheltered = open.iter().zip(&behind).filter(|(open, behind)| **behind < 0.9 * **open).count();
    assert!(6 * sheltered > open.len(), "{sheltered} of {} behind the wall", open.len());
    for name in ["load_x", "load_y", "load_z"] {
        assert!(column(&windy(), &[], name).iter().all(|load| *load == 0.0));
        assert!(column(&laden(), &[], name).iter().any(|load| load.abs() > 1e-3), "{name}");
    }
}
