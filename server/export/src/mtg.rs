//! Multiscale tree graphs as OpenAlea reads them: plants, axes and metamers, in metres, Z up.

use std::fmt::Arguments;

use espalier_mesh::Style;
use espalier_plant::{MetamerId, Plant, wood::as_written};

use crate::{
    ExportError, Origin, Sink,
    structure::{Structure, rounded, z_up},
};

const HEAD: &str = "\
CODE:\tFORM-A

CLASSES:
SYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\tDEFINITION
$\t0\tFREE\tFREE\tIMPLICIT
P\t1\tCONNECTED\tFREE\tEXPLICIT
A\t2\t<-LINEAR\tFREE\tEXPLICIT
M\t3\tNONE\tFREE\tEXPLICIT

DESCRIPTION:
LEFT\tRIGHT\tRELTYPE\tMAX
A\tA\t+\t?
M\tM\t<\t1
M\tM\t+\t?

FEATURES:
NAME\tTYPE
";

/// What is known of a component, and its type.
const FEATURES: [(&str, &str); 11] = [
    ("XX", "REAL"),
    ("YY", "REAL"),
    ("ZZ", "REAL"),
    ("TopDia", "REAL"),
    ("Birth", "INT"),
    ("Age", "INT"),
    ("Id", "INT"),
    ("Shed", "INT"),
    ("InternodeLength", "REAL"),
    ("Species", "ALPHA"),
    ("Seed", "INT"),
];

/// The living plants of the present; see `docs/formats.md`. The columns of the code are orders of branching.
///
/// # Errors
/// Where an internode cannot be as long as that, or the file cannot be written.
pub fn mtg(plant: &Plant, style: &Style, origin: &Origin<'_>, out: &mut dyn Sink) -> Result<(), ExportError> {
    let metres_per_internode = origin.parameters.internode_length;
    let structure = Structure::of(plant, style, metres_per_internode)?;
    let (wood, shed) = (structure.wood_of_axes(), structure.shed());
    let has_wood = |&(axis, _): &(_, &Vec<MetamerId>)| plant.has_living_wood(axis);
    let orders = structure.axes.iter().copied().zip(&wood).filter(has_wood);
    let columns = orders.map(|(axis, _)| plant.axes().order(axis) as usize + 1).max().unwrap_or(1);
    let mut file = Writer { structure: &structure, shed: &shed, columns, out };
    file.out.write_all(HEAD.as_bytes())?;
    for (name, kind) in FEATURES {
        file.line(format_args!("{name}\t{kind}"))?;
    }
    let names: Vec<_> = FEATURES.iter().map(|(name, _)| *name).collect();
    file.line(format_args!("\nMTG:\nTOPO{}{}", "\t".repeat(columns), names.join("\t")))?;
    let seeds = structure.metamers.iter().copied().filter(|&id| plant.is_seed(id));
    let (length, species) = (as_written(metres_per_internode), origin.species.unwrap_or_default());
    let grown_by = format!("{length}\t{species}\t{}", origin.seed);
    for (seed, number) in seeds.zip(1..) {
        file.component(0, format_args!("/P{number}"), seed, &grown_by)?;
        file.plant(seed, &wood)?;
    }
    Ok(())
}

struct Writer<'a> {
    structure: &'a Structure<'a>,
    /// Tips of twigs that each living metamer has shed.
    shed: &'a [u32],
    columns: usize,
    out: &'a mut dyn Sink,
}

impl Writer<'_> {
    fn line(&mut self, line: Arguments<'_>) -> Result<(), ExportError> {
        Ok(writeln!(self.out, "{line}")?)
    }

    /// The axes of a plant, each behind the metamer that bears it.
    fn plant(&mut self, seed: MetamerId, wood: &[Vec<MetamerId>]) -> Result<(), ExportError> {
        let Structure { plant, .. } = *self.structure;
        // Axes that are being written, and how many of their metamers are.
        let mut open = vec![(plant.metamers().axis(seed), 0usize)];
        while let Some((axis, written)) = open.last_mut() {
            let (axis, index) = (*axis, *written);
            *written += 1;
            let number = self.structure.axis_number(axis);
            let Some(&id) = wood[number as usize].get(index) else {
                open.pop();
                continue;
            };
            let column = plant.axes().order(axis) as usize;
            // What is known of a plant as a whole stands in its own line.
            let of_plant = "\t\t";
            match (index, column) {
                (0, 0) => self.component(column, format_args!("^/A{number}/M1"), id, of_plant)?,
                (0, _) => self.component(column, format_args!("+A{number}/M1"), id, of_plant)?,
                _ => self.component(column, format_args!("^<M{}", index + 1), id, of_plant)?,
            }
            let laterals: Vec<_> = plant.laterals(id).filter(|&axis| plant.has_living_wood(axis)).collect();
            open.extend(laterals.into_iter().rev().map(|axis| (axis, 0)));
        }
        Ok(())
    }

    /// A component, with the node of a metamer, and what is known of its plant.
    fn component(
        &mut self,
        column: usize,
        code: Arguments<'_>,
        id: MetamerId,
        of_plant: &str,
    ) -> Result<(), ExportError> {
        let Structure { plant, .. } = *self.structure;
        let [x, y, z] = z_up(self.structure.place(id)).to_array().map(rounded);
        let diameter = rounded(2.0 * self.structure.metres(self.structure.radius(id)));
        let (birth, age, number) = (plant.birth(id), plant.age(id), self.structure.number(id));
        let (before, after) = ("\t".repeat(column), "\t".repeat(self.columns - column));
        let shed = match self.shed[number as usize] {
            0 => String::new(),
            tips => tips.to_string(),
        };
        self.line(format_args!(
            "{before}{code}{after}{x}\t{y}\t{z}\t{diameter}\t{birth}\t{age}\t{number}\t{shed}\t{of_plant}"
        ))
    }
}
