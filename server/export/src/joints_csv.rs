//! The joints by which plants sway, as comma-separated values, for programs that move trees themselves.

use espalier_growth::Obstacle;
use espalier_mesh::Style;
use espalier_plant::Plant;
use espalier_settings::Appearance;
use glam::DVec3;

use crate::{ExportError, Sink, swaying::Grown};

/// The columns. Compliance: radians for each Pa of wind pressure along x, y and z, column by column.
const HEAD: &str = "joint,parent,row,first_row,level,x,y,z,frequency_hz,damping,drag_m2_per_kg,area_m2,softness,\
                    centre_x,centre_y,centre_z,c_xx,c_yx,c_zx,c_xy,c_yy,c_zy,c_xz,c_yz,c_zz,\
                    exposure,load_x,load_y,load_z\n";

/// One line for each joint, those that bear before those that are borne; lengths in metres.
///
/// # Errors
/// Where the file cannot be written.
pub fn joints_csv(
    plant: &Plant,
    style: &Style,
    appearance: &Appearance,
    around: &[Obstacle],
    metres: f32,
    out: &mut dyn Sink,
) -> Result<(), ExportError> {
    let grown = Grown::of(plant, style, &appearance.wind, metres);
    let conditions = grown.conditions(&appearance.wind, metres, around);
    let Grown { wood, joints, loads, .. } = &grown;
    let exposure = conditions.exposure(joints, wood);
    out.write_all(HEAD.as_bytes())?;
    for (number, joint) in joints.all().iter().enumerate() {
        let parent = joint.parent.map_or_else(String::new, |parent| parent.to_string());
        let place = wood.place(joint.node);
        write!(out, "{number},{parent},{},{},{}", joint.node, joint.first, joint.level)?;
        let numbers = [place.x, place.y, place.z, joint.frequency, joint.damping, joint.drag, joint.area];
        let more = [joint.softness, joint.centre.x, joint.centre.y, joint.centre.z];
        let load = loads.get(number).copied().unwrap_or(DVec3::ZERO);
        let last = [exposure.shares()[number], load.x, load.y, load.z];
        for number in numbers.into_iter().chain(more).chain(joint.compliance.to_cols_array()).chain(last) {
            write!(out, ",{number:e}")?;
        }
        writeln!(out)?;
    }
    Ok(out.flush()?)
}
