//! `espalier species`: the list, and the contact sheet.

use std::{fs, io::Write, path::Path};

use espalier_export::picture::{self, Cell};
use espalier_growth::species::{self, Species};
use rayon::prelude::*;

use super::HeadlessError;
use crate::{cli, output::OutputError, pool::SimulationPool, portrait::portrait, progress::Bar};

/// Pixels of one picture of the sheet, and pictures in a row.
const CELL: (usize, usize) = (300, 310);
const COLUMNS: usize = 7;

/// `espalier species`.
pub fn species(options: &cli::Species) -> Result<(), HeadlessError> {
    if options.json {
        let all: Vec<_> = species::all().iter().map(espalier_session::wire_species).collect();
        // Plain values always have a JSON form.
        let text = serde_json::to_string_pretty(&all).unwrap_or_default();
        let _ = writeln!(std::io::stdout(), "{text}");
        return Ok(());
    }
    match &options.sheet {
        None => {
            let mut out = std::io::stdout();
            for species in species::all() {
                let Species { slug, name, botanical, sentence, .. } = species;
                // A reader that has gone, as `head` may, is no error of ours.
                let _ = writeln!(out, "{slug:22} {name} ({botanical}). {sentence}");
            }
            Ok(())
        }
        Some(path) => {
            let bytes = SimulationPool::new(options.threads)?.block_on(|| sheet(options.seed));
            write(path, &bytes?)
        }
    }
}

/// All species at their age, as a PNG file.
fn sheet(seed: u32) -> Result<Vec<u8>, HeadlessError> {
    let bar = Bar::of(species::all().len(), "species");
    let cells: Result<Vec<Cell>, HeadlessError> =
        species::all().par_iter().map(|species| cell(species, seed).inspect(|_| bar.step())).collect();
    Ok(picture::sheet(&cells?, COLUMNS).png())
}

fn cell(species: &Species, seed: u32) -> Result<Cell, HeadlessError> {
    Ok(Cell {
        picture: portrait(species, seed, CELL).map_err(HeadlessError::Parameters)?,
        title: species.name.to_owned(),
        subtitle: species.botanical.to_owned(),
    })
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), HeadlessError> {
    Ok(fs::write(path, bytes).map_err(|cause| OutputError::Write { path: path.to_owned(), cause })?)
}
