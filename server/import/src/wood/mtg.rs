//! Multiscale tree graphs: the head of the file, and its lines as components of a plant with places.

mod graph;

use std::{borrow::Cow, collections::BTreeSet};

use glam::DVec3;

use self::graph::{Component, Graph, Relation};
use super::{
    About, Fault, MAX_COLUMNS, MAX_SHED, Place, Units, WoodOptions, excerpt, internode, malformed, number,
    out_of_range,
    pieces::{Piece, y_up},
    too_many_columns,
};

/// The class of components that are one internode each, however long.
const METAMER: &str = "M";
/// Features that are the diameter at a component's top, the first that is there.
const DIAMETERS: [&str; 4] = ["TopDia", "TopDiameter", "Diameter", "diameter"];
const RADII: [&str; 2] = ["Radius", "radius"];

/// Lines with their numbers, cell by cell, comments left out.
struct Lines<'a> {
    lines: std::iter::Zip<std::str::Lines<'a>, std::ops::RangeFrom<u64>>,
}

impl<'a> Iterator for Lines<'a> {
    type Item = Result<(u64, Vec<&'a str>), Fault>;

    /// The next line that is not empty.
    fn next(&mut self) -> Option<Self::Item> {
        self.lines.by_ref().filter(|(line, _)| !line.starts_with('#')).find_map(|(line, number)| {
            let cells = line.split('\t').map(|cell| cell.split('#').next().unwrap_or_default().trim());
            let cells: Vec<_> = cells.take(MAX_COLUMNS + 1).collect();
            if cells.len() > MAX_COLUMNS {
                return Some(Err(too_many_columns(number)));
            }
            cells.iter().any(|cell| !cell.is_empty()).then_some(Ok((number, cells)))
        })
    }
}

/// What is known of a component: columns of the code section.
#[derive(Default)]
struct Features {
    place: Option<[usize; 3]>,
    /// The column, and what its number is multiplied with to be a radius.
    radius: Option<(usize, f64)>,
    birth: Option<usize>,
    id: Option<usize>,
    shed: Option<usize>,
    /// What is known of a plant as a whole, on its own line.
    length: Option<usize>,
    species: Option<usize>,
    seed: Option<usize>,
}

/// Text in UTF-8, or else, as older programs wrote it, in Latin-1, where each byte is a character.
fn text(bytes: &[u8]) -> Cow<'_, str> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => text.into(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect::<String>().into(),
    }
}

/// The pieces of wood of a file, which are the components of its finest scale that have places, and what it says of its
/// plants.
pub(super) fn read(bytes: &[u8], options: &WoodOptions) -> Result<(Vec<Piece>, About), Fault> {
    let text = text(bytes);
    let mut lines = Lines { lines: text.lines().zip(1..) };
    let mut section = String::new();
    let mut graph = Graph::new(options);
    let mut names: BTreeSet<&str> = BTreeSet::new();
    for cells in lines.by_ref() {
        let (line, cells) = cells?;
        let word: String = cells[0].chars().filter(|c| !c.is_whitespace()).collect();
        if let Some(name) = word.strip_suffix(':').filter(|name| name.chars().all(|c| c.is_ascii_uppercase()))
        {
            section = name.to_owned();
            match name {
                "CODE" if cells.get(1) != Some(&"FORM-A") => {
                    return Err(malformed(
                        Some(Place::Line(line)),
                        "its code is not FORM-A, which alone is read",
                    ));
                }
                "MTG" => break,
                _ => continue,
            }
        }
        match (&*section, &*cells) {
            ("CODE" | "DESCRIPTION", _) => {}
            ("CLASSES", ["SYMBOL", ..]) | ("FEATURES", ["NAME", ..]) => {}
            ("CLASSES", [symbol, scale, ..]) => graph.declare(symbol, scale, line)?,
            ("FEATURES", [name, ..]) => {
                names.insert(name);
                if names.len() > MAX_COLUMNS {
                    return Err(too_many_columns(line));
                }
            }
            _ => {
                return Err(malformed(
                    Some(Place::Line(line)),
                    "it is no MTG: a section CODE, CLASSES, DESCRIPTION, FEATURES or MTG must begin here",
                ));
            }
        }
    }
    if section != "MTG" {
        return Err(malformed(None, "it is no MTG: it has no section MTG"));
    }
    let Some((line, head)) = lines.next().transpose()? else {
        return Err(malformed(None, "the section MTG is empty"));
    };
    if !matches!(head[0], "TOPO" | "ENTITY-CODE") {
        return Err(malformed(Some(Place::Cell(line, 1)), "the first column must be TOPO or ENTITY-CODE"));
    }
    let codes = head.iter().position(|name| names.contains(name)).unwrap_or(head.len());
    let features = Features::of(&head, codes);
    let mut values: Vec<Values> = Vec::new();
    let mut about = About::default();
    // The least cells of a line, and the last line with its cells.
    let (mut fewest, mut last) = (head.len(), None);
    for cells in lines {
        let (line, cells) = cells?;
        if let Some((_, count)) = last.replace((line, cells.len())) {
            fewest = fewest.min(count);
        }
        let read = features.read(line, &cells, options.units)?;
        let code = &cells[..codes.min(cells.len())];
        let same_for_all = graph.follow(line, code)?;
        values.resize_with(graph.components.len(), Values::default);
        for at in same_for_all {
            let Component { parent, complex, .. } = graph.components[at];
            if parent.is_none() && complex.is_none() {
                features.read_about(line, &cells, options.units.length, &mut about)?;
            }
            values[at] = read;
        }
    }
    // Empty cells at the end of a line may be left out, so that in other lines fewer than in the head are none lost.
    if let Some((line, count)) = last.filter(|&(_, count)| count < fewest && !text.ends_with('\n')) {
        let what = format!("the file is cut off: the line has {count} cells, and no line end");
        return Err(malformed(Some(Place::Line(line)), what));
    }
    let thickness = features.radius.map_or(0, |(column, _)| column as u64 + 1);
    Ok((pieces(&graph, &values, thickness)?, about))
}

/// What a line says of a component.
#[derive(Clone, Copy, Default)]
struct Values {
    place: Option<DVec3>,
    radius: Option<f64>,
    birth: Option<u32>,
    id: Option<u32>,
    shed: Option<u32>,
}

impl Features {
    fn of(head: &[&str], codes: usize) -> Self {
        let find = |name: &str| (codes..head.len()).find(|&at| head[at] == name);
        let first = |names: &[&str], factor| names.iter().find_map(|name| Some((find(name)?, factor)));
        let place = || Some([find("XX")?, find("YY")?, find("ZZ")?]);
        Self {
            place: place(),
            radius: first(&DIAMETERS, 0.5).or_else(|| first(&RADII, 1.0)),
            birth: find("Birth"),
            id: find("Id"),
            shed: find("Shed"),
            length: find("InternodeLength"),
            species: find("Species"),
            seed: find("Seed"),
        }
    }

    /// Takes what the line of a plant says of it as a whole; the first plant that says something is believed.
    fn read_about(&self, line: u64, cells: &[&str], unit: f64, about: &mut About) -> Result<(), Fault> {
        let cell = |column: Option<usize>| {
            let column = column?;
            let cell = cells.get(column).copied().filter(|cell| !matches!(*cell, "" | "NA"))?;
            Some((cell, Place::Cell(line, column as u64 + 1)))
        };
        if let Some((cell, place)) = cell(self.length).filter(|_| about.internode_length.is_none()) {
            let length = (number(cell, place.clone(), "InternodeLength")? * unit) as f32;
            let [least, most] = internode::range();
            if !(least..=most).contains(&length) {
                let what = format!("InternodeLength is {length} m");
                return Err(out_of_range(Some(place), what, format!("{least} m to {most} m")));
            }
            about.internode_length = Some(length);
        }
        if let Some((cell, _)) = cell(self.species).filter(|_| about.species.is_none()) {
            about.species = Some(excerpt(cell));
        }
        if let Some((cell, place)) = cell(self.seed).filter(|_| about.seed.is_none()) {
            let seed = cell.parse().map_err(|_| {
                let what = format!("Seed is `{}`", excerpt(cell));
                out_of_range(Some(place), what, format!("whole numbers from 0 to {}", u32::MAX))
            })?;
            about.seed = Some(seed);
        }
        Ok(())
    }

    fn read(&self, line: u64, cells: &[&str], units: Units) -> Result<Values, Fault> {
        let place = |column: usize| Place::Cell(line, column as u64 + 1);
        let float = |column: usize, name: &str| match cells.get(column).copied().unwrap_or_default() {
            "" | "NA" => Ok(None),
            cell => number(cell, place(column), name).map(Some),
        };
        let count = |column: Option<usize>, name: &str| -> Result<Option<u32>, Fault> {
            let Some((column, value)) =
                column.map(|column| Ok((column, float(column, name)?))).transpose()?
            else {
                return Ok(None);
            };
            let Some(value) = value else { return Ok(None) };
            if value < 0.0 || value.fract() != 0.0 || value > f64::from(u32::MAX - 1) {
                let what = format!("{name} is {value}");
                return Err(out_of_range(Some(place(column)), what, "whole numbers from 0"));
            }
            Ok(Some(value as u32))
        };
        let mut at = None;
        if let Some([x, y, z]) = self.place {
            let [x, y, z] = [float(x, "XX")?, float(y, "YY")?, float(z, "ZZ")?];
            at = x.zip(y).zip(z).map(|((x, y), z)| y_up([x, y, z]) * units.length);
        }
        let mut radius = None;
        if let Some((column, factor)) = self.radius {
            radius = float(column, "the diameter")?.map(|thick| thick * factor);
            if let Some(thick) = radius.filter(|thick| *thick < 0.0) {
                let what = format!("the radius is {thick}");
                return Err(out_of_range(Some(place(column)), what, "0 and more"));
            }
        }
        let shed = count(self.shed, "Shed")?;
        if let Some(shed) = shed.filter(|&shed| shed > MAX_SHED) {
            let place = self.shed.map(place);
            return Err(out_of_range(place, format!("Shed is {shed}"), format!("0 to {MAX_SHED}")));
        }
        Ok(Values {
            place: at,
            radius: radius.map(|radius| radius * units.diameter),
            birth: count(self.birth, "Birth")?,
            id: count(self.id, "Id")?,
            shed,
        })
    }
}

/// The components with places as pieces of wood; what has none is passed over, and what stands on it stands on the
/// next one below.
fn pieces(graph: &Graph, values: &[Values], thickness: u64) -> Result<Vec<Piece>, Fault> {
    let is_placed = |(component, values): (&Component, &Values)| values.place.map(|_| component.scale);
    let Some(scale) = graph.components.iter().zip(values).filter_map(is_placed).max() else {
        return Err(malformed(None, "none of its components has a place (features XX, YY and ZZ)"));
    };
    let mut pieces: Vec<Piece> = Vec::new();
    // What stands for each component: a piece, and whether its axis goes on from there.
    let mut stands: Vec<Option<(u32, bool)>> = vec![None; graph.components.len()];
    for (at, (component, known)) in graph.components.iter().zip(values).enumerate() {
        let below = component.parent.and_then(|(parent, relation)| {
            let (piece, goes_on) = stands[parent as usize]?;
            Some((piece, goes_on && relation == Relation::Follows))
        });
        let base = || component.complex.and_then(|complex| stands[complex as usize]);
        let below = below.or_else(base);
        stands[at] = below;
        // A plant or growth unit with a place, and nothing below it, says where the seed is.
        let is_base = component.scale < scale && below.is_none();
        let Some(end) = known.place.filter(|_| component.scale == scale || is_base) else { continue };
        pieces.push(Piece {
            parent: below.map(|(piece, _)| piece),
            continues: below.is_some_and(|(_, goes_on)| goes_on),
            start: None,
            end,
            radius: known.radius.filter(|radius| *radius > 0.0),
            birth: known.birth,
            id: known.id,
            shed: known.shed.unwrap_or(0),
            is_whole: graph.name_of(component.class) == METAMER,
            line: component.line,
            thickness,
        });
        stands[at] = Some((pieces.len() as u32 - 1, true));
    }
    Ok(pieces)
}

/// A code that cannot be read.
fn bad_code(line: u64, column: usize, code: &str, what: &str) -> Fault {
    malformed(Some(Place::Cell(line, column as u64 + 1)), format!("{what}: `{}`", excerpt(code)))
}
