//! Numbers by which shaders move vertices in the wind.

use espalier_export::{Detail, Model};
use espalier_growth::species;
use serde_json::Value;

use crate::{METRES, looks, model, models::numbers, root, species::raised, style};

fn index(value: &Value) -> usize {
    value.as_u64().expect("an index") as usize
}

#[test]
fn each_vertex_says_how_it_moves() {
    let mut document = raised(species::find("oak").expect("there are oaks"), 4);
    let plant = document.portrait();
    let plain = Model { wind_weights: true, ..Model::default() };
    let all = [
        plain,
        Model { quantised: true, ..plain },
        Model { lightmap: Some(512), ..plain },
        Model { sway: Some(64), by_limb: true, ..plain },
        Model { detail: Detail::Set, ..plain },
    ];
    for options in all {
        let file = model(plant, &style(), &looks(), METRES, &options).expect("it exports");
        let root = root(&file);
        let mut seen = [0; 2];
        for mesh in root["meshes"].as_array().expect("meshes") {
            let name = mesh["name"].as_str().expect("a name");
            for primitive in mesh["primitives"].as_array().expect("primitives") {
                let attributes = &primitive["attributes"];
                if name.contains("Billboard") {
                    assert!(attributes["TEXCOORD_2"].is_null() && mesh["extras"]["wind"].is_null());
                    continue;
                }
                // Sets are numbered without a gap, whatever else there is.
                assert!(!attributes["TEXCOORD_0"].is_null() && !attributes["TEXCOORD_1"].is_null(), "{name}");
                let has_map = attributes["TEXCOORD_0"] != attributes["TEXCOORD_1"];
                assert_eq!(has_map, options.lightmap.is_some());
                let [far, flutter] =
                    ["TEXCOORD_2", "TEXCOORD_3"].map(|set| numbers(&file, index(&attributes[set])));
                assert_eq!(far.len(), flutter.len());
                assert!(far.iter().chain(&flutter).all(|number| (0.0..=1.0).contains(number)), "{name}");
                let flutters = flutter.as_chunks::<2>().0.iter().map(|[_, flutter]| *flutter);
                let (least, most) =
                    flutters.fold((1.0f32, 0.0f32), |(least, most), own| (least.min(own), most.max(own)));
                let is_wood = name.contains("Wood");
                assert_eq!((least, most), (0.0, if is_wood { 0.0 } else { 1.0 }), "{name}");
                seen[usize::from(is_wood)] += 1;
            }
            if !name.contains("Billboard") {
                let wind = &mesh["extras"]["wind"];
                for measure in ["trunk_metres", "limb_metres", "trunk_hertz"] {
                    assert!(wind[measure].as_f64() > Some(0.0), "{wind}");
                }
                assert!(wind["limb_hertz"].as_f64() > wind["trunk_hertz"].as_f64(), "{wind}");
            }
        }
        assert!(seen[0] > 0 && seen[1] > 0);
    }
}

#[test]
fn the_foot_of_a_trunk_stands_still_and_its_top_moves_most() {
    let mut document = raised(species::find("spruce").expect("there are spruces"), 2);
    let options = Model { wind_weights: true, ..Model::default() };
    let file = model(document.portrait(), &style(), &looks(), METRES, &options).expect("it exports");
    let root = root(&file);
    let mesh = root["meshes"].as_array().expect("meshes").iter();
    let wood = mesh.clone().find(|mesh| mesh["name"].as_str().is_some_and(|name| name.ends_with("Wood")));
    let attributes = &wood.expect("wood")["primitives"][0]["attributes"];
    let [places, far] = ["POSITION", "TEXCOORD_2"].map(|set| numbers(&file, index(&attributes[set])));
    let trunk = |vertex: usize| far[2 * vertex];
    let height = |vertex: &usize| places[3 * vertex + 1];
    let by_height = |a: &usize, b: &usize| height(a).total_cmp(&height(b));
    let vertices = 0..places.len() / 3;
    let [foot, top] =
        [vertices.clone().min_by(by_height), vertices.max_by(by_height)].map(|at| at.expect("wood"));
    assert!(trunk(foot) < 0.02, "{}", trunk(foot));
    assert!(trunk(top) > 0.9, "{}", trunk(top));
}
