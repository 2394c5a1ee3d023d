//! How fast the trees that ship swing, as `docs/wind.md` has it.
//!
//! `cargo test -p espalier-export --test main frequencies -- --nocapture` prints the table; after a deliberate change
//! `UPDATE_GOLDEN=1` before it writes the table into the page.

use std::{fmt::Write, fs, path::PathBuf};

use espalier_growth::species::{self, Species};
use espalier_mesh::{RingTable, Style, radius_code};
use espalier_motion::{
    Joints, Pose, Rows, Scale, Weather,
    clips::{Conditions, clips},
};
use espalier_session::style_options;
use espalier_settings::looks::WindLook;
use glam::DVec3;

use crate::species::raised;

/// Where foresters measure how thick a trunk is, m.
const BREAST: f64 = 1.3;
const BEGINS: &str = "<!-- frequencies begin -->\n";
const ENDS: &str = "<!-- frequencies end -->\n";

/// The rows of a species at the end of its schedule.
fn grown(species: &Species) -> (Rows, Scale) {
    let mut document = raised(species, 1);
    let parameters = document.parameters();
    let style = Style::new(style_options(&parameters));
    let mut rings = RingTable::new();
    rings.sync(document.portrait(), &style, 1);
    let scale = Scale {
        internode_length: f64::from(parameters.internode_length),
        leaf_size: f64::from(parameters.leaf_size),
    };
    (Rows::of(&rings), scale)
}

/// A line for each species: its height, how thick its trunk is at breast height, or at a tenth of its height where that is
/// lower, how much of its wood is in branches, its frequency, the same without leaves, that which trees of its height are
/// observed to have, and how stiff its wood is taken for.
fn table() -> String {
    let mut table = String::from(
        "| | height, m | trunk, cm | wood in branches, % | here, Hz | without leaves, Hz | 2.4/√H, Hz | ratio | wood, GPa |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    for species in species::all() {
        let (rows, scale) = grown(species);
        let (limbs, wood, joints) = Joints::grown(&rows, &scale, 1.0);
        let standing = (0..rows.len() as u32).filter(|&row| limbs.limb(row).is_some());
        let top = standing.map(|row| wood.place(row).y).fold(0.0, f64::max);
        let trunk = joints.all().first().expect("it has a trunk");
        let base = wood.place(trunk.node).y;
        let height = top - base;
        let breast = BREAST.min(0.1 * height);
        let trunk_rows = limbs.rows(trunk.limb);
        let thick =
            trunk_rows.iter().find(|&&row| wood.place(row).y - base >= breast).expect("it is as high");
        let radius = radius_code::decode(rows.row(*thick).radius);
        let thick = 200.0 * scale.internode_length * f64::from(radius);
        let (_, bare_wood, bare) = Joints::grown(&rows, &Scale { leaf_size: 0.0, ..scale }, 1.0);
        let whole: f64 = (0..rows.len() as u32).map(|row| bare_wood.mass(row)).sum();
        let own: f64 = trunk_rows.iter().map(|&row| bare_wood.mass(row)).sum();
        let branches = 100.0 * (1.0 - own / whole);
        // Wood stays as stiff as it was taken for with leaves.
        let bare = bare.all()[0];
        let winter = bare.frequency * (bare.softness / trunk.softness).sqrt();
        let observed = 2.4 / height.sqrt();
        let (found, ratio, modulus) = (trunk.frequency, trunk.frequency / observed, 7.0 / trunk.softness);
        writeln!(
            table,
            "| {} | {height:.1} | {thick:.1$} | {branches:.0} | {found:.2} | {winter:.2} | {observed:.2} | {ratio:.2} | {modulus:.1} |",
            species.name,
            if thick < 10.0 { 1 } else { 0 },
        )
        .expect("a string takes it");
    }
    table
}

#[test]
fn frequencies_of_all_species_are_those_in_the_docs() {
    let table = table();
    println!("{table}");
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/wind.md");
    let page = fs::read_to_string(&file).expect("the page can be read");
    let (before, rest) = page.split_once(BEGINS).expect("the table begins");
    let (written, after) = rest.split_once(ENDS).expect("the table ends");
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        fs::write(&file, format!("{before}{BEGINS}\n{table}\n{ENDS}{after}"))
            .expect("the page can be written");
        return;
    }
    assert_eq!(written.trim(), table.trim(), "docs/wind.md has other frequencies");
    let ratios = table.lines().skip(2).map(|line| {
        let cell = line.split('|').nth(8).map(str::trim).and_then(|cell| cell.parse::<f64>().ok());
        cell.expect("a ratio")
    });
    let ratios: Vec<f64> = ratios.collect();
    let is_observed = |&&ratio: &&f64| (0.7..1.01).contains(&ratio);
    assert!(4 * ratios.iter().filter(is_observed).count() > 3 * ratios.len(), "{ratios:?}");
    assert!(ratios.iter().all(|ratio| (0.4..3.01).contains(ratio)), "{ratios:?}");
}

/// `cargo test -p espalier-export --test main in_a_breeze -- --nocapture` prints how far.
#[test]
fn in_a_breeze_a_cherry_moves_its_shoots_by_centimetres() {
    let (rows, scale) = grown(species::find("cherry").expect("there are cherries"));
    let (_, wood, joints) = Joints::grown(&rows, &scale, 1.0);
    let turbulence = f64::from(WindLook::default().turbulence);
    let breeze = Conditions::open(&wood, Weather::blowing([4.0, 30.0, 0.0], turbulence, 7));
    let [sway, _] = clips(&joints, &wood, &breeze);
    let mut reached = vec![(DVec3::INFINITY, DVec3::NEG_INFINITY); wood.len()];
    for key in &sway.keys {
        let pose = Pose::of(&joints, &wood, key);
        for (row, (low, high)) in reached.iter_mut().enumerate() {
            let place = pose.node(&joints, &wood, row as u32).place;
            (*low, *high) = (low.min(place), high.max(place));
        }
    }
    let mut far: Vec<f64> = reached.iter().map(|(low, high)| low.distance(*high)).collect();
    far.sort_by(f64::total_cmp);
    let [half, most, all] = [far[far.len() / 2], far[far.len() * 9 / 10], far[far.len() - 1]];
    println!(
        "within the loop half of the nodes move by {half:.3} m, nine in ten by {most:.3}, all by {all:.3}"
    );
    assert!((0.003..0.03).contains(&half) && (0.03..0.12).contains(&most), "{half} m and {most} m");
    assert!((0.08..0.3).contains(&all), "{all} m");
}
