//! A quantitative structure model: cylinders as comma-separated values, with the columns that TreeQSM's have in R.

use espalier_mesh::Style;
use espalier_plant::{MetamerId, Plant};

use crate::{
    ExportError, Sink,
    structure::{Structure, rounded, z_up},
};

/// The columns, as `import_treeqsm` of rTwig names them.
const HEAD: &str = "radius,length,start.x,start.y,start.z,axis.x,axis.y,axis.z,parent,extension,branch,BranchOrder,\
PositionInBranch,added,UnmodRadius\n";

/// A cylinder for each living metamer, in metres, Z up; see `docs/formats.md`. Branches follow one another whole, none
/// before that which bears it.
///
/// # Errors
/// Where an internode cannot be as long as that, or the file cannot be written.
pub fn qsm_csv(
    plant: &Plant,
    style: &Style,
    metres_per_internode: f32,
    out: &mut dyn Sink,
) -> Result<(), ExportError> {
    let structure = Structure::of(plant, style, metres_per_internode)?;
    let wood = structure.wood_of_axes();
    // Cylinders and branches are counted from 1; 0 is none.
    let mut cylinder = vec![0usize; plant.metamer_count()];
    for (id, number) in wood.iter().flatten().zip(1..) {
        cylinder[id.index()] = number;
    }
    out.write_all(HEAD.as_bytes())?;
    let branches = wood.iter().zip(&structure.axes).filter(|(metamers, _)| !metamers.is_empty());
    for ((metamers, &axis), branch) in branches.zip(1..) {
        let order = plant.axes().order(axis);
        for (&id, position) in metamers.iter().zip(1..) {
            let extension = metamers.get(position).map_or(0, |next| cylinder[next.index()]);
            let parent = plant.metamers().parent(id).map_or(0, |parent| cylinder[parent.index()]);
            let Cylinder { start, axis, length, radius } = Cylinder::of(&structure, id);
            let [[x, y, z], [u, v, w]] = [start, axis];
            writeln!(
                out,
                "{radius},{length},{x},{y},{z},{u},{v},{w},{parent},{extension},{branch},{order},{position},0,{radius}"
            )?;
        }
    }
    Ok(())
}

struct Cylinder {
    start: [f64; 3],
    axis: [f64; 3],
    length: f64,
    radius: f64,
}

impl Cylinder {
    fn of(structure: &Structure<'_>, id: MetamerId) -> Self {
        let end = structure.place(id);
        let start = structure.plant.metamers().parent(id).map_or(end, |parent| structure.place(parent));
        let length = start.distance(end);
        Self {
            start: z_up(start).to_array().map(rounded),
            axis: z_up((end - start) / length).to_array().map(rounded),
            length: rounded(length),
            radius: rounded(structure.metres(structure.radius(id))),
        }
    }
}
