//! How fast the trees that ship swing, as `docs/wind.md` has it.
//!
//! `cargo test -p espalier-export --test main frequencies -- --nocapture` prints the table; after a deliberate change
//! `UPDATE_GOLDEN=1` before it writes the table into the page.

use std::{fmt::Write, fs, path::PathBuf};

use espalier_growth::species;
use espalier_mesh::{RingTable, Style};
use espalier_motion::{Joints, Rows, Scale};
use espalier_session::style_options;

use crate::species::raised;

const BEGINS: &str = "<!-- frequencies begin -->\n";
const ENDS: &str = "<!-- frequencies end -->\n";

/// A line for each species: its height, its frequency and that which trees of its height are observed to have.
fn table() -> String {
    let mut table = String::from("| | height, m | here, Hz | 2.4/√H, Hz | ratio |\n|---|---|---|---|---|\n");
    for species in species::all() {
        let mut document = raised(species, 1);
        let parameters = document.parameters();
        let style = Style::new(style_options(&parameters));
        let mut rings = RingTable::new();
        rings.sync(document.portrait(), &style, 1);
        let scale = Scale {
            internode_length: f64::from(parameters.internode_length),
            leaf_size: f64::from(parameters.leaf_size),
        };
        let rows = Rows::of(&rings);
        let (limbs, wood, joints) = Joints::grown(&rows, &scale, 1.0);
        let standing = (0..rows.len() as u32).filter(|&row| limbs.limb(row).is_some());
        let top = standing.map(|row| wood.place(row).y).fold(0.0, f64::max);
        let trunk = joints.all().first().expect("it has a trunk");
        let height = top - wood.place(trunk.node).y;
        let observed = 2.4 / height.sqrt();
        let (found, ratio) = (trunk.frequency, trunk.frequency / observed);
        writeln!(table, "| {} | {height:.1} | {found:.2} | {observed:.2} | {ratio:.2} |", species.name)
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
        let cell = line.split('|').nth(5).map(str::trim).and_then(|cell| cell.parse::<f64>().ok());
        cell.expect("a ratio")
    });
    assert!(ratios.clone().count() >= 10 && ratios.clone().all(|ratio| ratio < 3.01));
}
