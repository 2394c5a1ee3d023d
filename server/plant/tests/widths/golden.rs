//! Clients preview a width before the server answers: both must find the radii in `golden/widths.json`.
//!
//! After a deliberate change: `UPDATE_GOLDEN=1 cargo test -p espalier-plant --test widths`.

use std::{fs, path::PathBuf};

use serde_json::{Value, json};

use super::*;

const EXPONENT: f32 = 2.5;

/// A tree in which every bud has grown now and then.
fn tree() -> Plant {
    let mut plant = Plant::new(Vec3::ZERO);
    plant.begin_step();
    plant.sow(Vec3::X);
    plant.end_step();
    for round in 0..12u16 {
        let picks = (0..10).map(|pick| (pick * 7 + round * 3, 140)).collect();
        happen(&mut plant, &Event::Grow(picks));
    }
    plant
}

/// From `id` down to the base of its trunk.
fn below(plant: &Plant, id: MetamerId) -> Vec<MetamerId> {
    let parent = |id: &MetamerId| plant.metamers().parent(*id).filter(|&parent| !plant.is_seed(parent));
    std::iter::successors(parent(&id), parent).collect()
}

/// One limb at several widths: the radii of what it bears and of what bears it, before and after.
fn samples() -> Value {
    let (plant, girth) = (tree(), Girth::new(EXPONENT, TWIG));
    let plain = Widths::solve(&plant, &[], &girth);
    let wood = wood(&plant);
    let limb = wood.iter().copied().filter(|&id| below(&plant, id).len() >= 3);
    let limb = limb.max_by_key(|&id| (plant.metamers().tips(id), id)).expect("a limb");
    let before = plain.radius(limb);
    let change = |share: f32| {
        let after = Widths::solve(&plant, &[(limb, 2.0 * share * before)], &girth);
        let radii = |ids: &[MetamerId]| -> Vec<[f32; 2]> {
            ids.iter().map(|&id| [plain.radius(id), after.radius(id)]).collect()
        };
        let borne: Vec<_> = wood.iter().copied().filter(|&id| below(&plant, id).contains(&limb)).collect();
        let (above, below) = (radii(&borne), radii(&below(&plant, limb)));
        json!({ "before": before, "after": share * before, "above": above, "below": below })
    };
    let samples = [0.8, 1.3, 2.0].map(change);
    json!({ "exponent": EXPONENT, "twigDiameter": TWIG, "samples": samples })
}

#[test]
fn widths_are_as_they_were_written_down() {
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("golden/widths.json");
    let written = format!("{}\n", samples());
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        fs::write(&file, &written).expect("the samples can be written");
    }
    assert!(fs::read_to_string(&file).is_ok_and(|stored| stored == written), "widths differ");
}
