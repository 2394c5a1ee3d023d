//! Plants and their futures as bytes.

use espalier_growth::WORLD_EXTENT;
use espalier_plant::{AxisId, Carried, Edit, Future, FutureParts, Given, GivenRadii, MetamerId, PlantParts};
use glam::Vec3;

use super::{
    DocumentError, damaged,
    fields::{Reader, Writer},
};

/// The columns of metamers and axes.
pub(super) fn write_columns(out: &mut Writer, parts: &PlantParts) {
    for column in [&parts.parent, &parts.axis, &parts.death] {
        out.numbers(column);
    }
    for column in [&parts.end, &parts.normal] {
        out.vectors(column);
    }
    out.numbers(&parts.bearer);
    out.vectors(&parts.direction);
    out.numbers(&parts.axis_death);
}

/// A plant of these columns, without time, widths and given radii.
pub(super) fn read_columns(reader: &mut Reader<'_>) -> Result<PlantParts, DocumentError> {
    reader.up_to(1)?;
    Ok(PlantParts {
        parent: reader.numbers()?,
        axis: reader.numbers()?,
        death: reader.numbers()?,
        end: read_places(reader)?,
        normal: reader.vectors()?,
        bearer: reader.numbers()?,
        direction: reader.vectors()?,
        axis_death: reader.numbers()?,
        ..PlantParts::default()
    })
}

pub(super) fn write_timeline(out: &mut Writer, parts: &PlantParts) {
    out.u32(parts.now);
    write_ends(out, &parts.ends);
    write_edits(out, &parts.edits);
}

/// The present step, where steps end, and what was done to wood; without rows.
pub(super) fn read_timeline(reader: &mut Reader<'_>) -> Result<PlantParts, DocumentError> {
    reader.up_to(1)?;
    let (now, ends, edits) = (reader.u32()?, read_ends(reader)?, reader.list(read_edit)?);
    Ok(PlantParts { now, ends, edits, ..PlantParts::default() })
}

pub(super) fn write_widths(out: &mut Writer, parts: &PlantParts) {
    out.list(&parts.widths, |out, &(row, diameter)| {
        out.u32(row);
        out.f32(diameter);
    });
}

pub(super) fn read_widths(reader: &mut Reader<'_>) -> Result<Vec<(u32, f32)>, DocumentError> {
    reader.up_to(1)?;
    reader.list(|r| Ok((r.u32()?, r.f32()?)))
}

pub(super) fn write_given_radii(out: &mut Writer, parts: &PlantParts) {
    out.list(&parts.given_radii, |out, &(row, radius)| {
        out.u32(row);
        out.f32(radius);
    });
}

pub(super) fn read_given_radii(reader: &mut Reader<'_>) -> Result<Vec<(u32, f32)>, DocumentError> {
    reader.up_to(1)?;
    reader.list(|r| Ok((r.u32()?, r.f32()?)))
}

pub(super) fn write_future(out: &mut Writer, future: &Future) {
    let parts = future.to_parts();
    out.u32(parts.step);
    write_ends(out, &parts.ends);
    write_edits(out, &parts.edits);
    for column in [&parts.parent, &parts.axis, &parts.death, &parts.lateral] {
        out.numbers(column);
    }
    for column in [&parts.end, &parts.normal, &parts.direction] {
        out.vectors(column);
    }
    for column in [&parts.bearer, &parts.order, &parts.axis_death] {
        out.numbers(column);
    }
    for deaths in [&parts.deaths, &parts.axis_deaths] {
        out.list(deaths, |out, &(row, step)| {
            out.u32(row);
            out.u32(step);
        });
    }
}

pub(super) fn read_future(reader: &mut Reader<'_>) -> Result<Future, DocumentError> {
    let (step, ends, edits) = (reader.u32()?, read_ends(reader)?, reader.list(read_edit)?);
    let deaths = |r: &mut Reader<'_>| r.list(|r| Ok((r.u32()?, r.u32()?)));
    let parts = FutureParts {
        step,
        ends,
        edits,
        parent: reader.numbers()?,
        axis: reader.numbers()?,
        death: reader.numbers()?,
        lateral: reader.numbers()?,
        end: read_places(reader)?,
        normal: reader.vectors()?,
        direction: reader.vectors()?,
        bearer: reader.numbers()?,
        order: reader.numbers()?,
        axis_death: reader.numbers()?,
        deaths: deaths(reader)?,
        axis_deaths: deaths(reader)?,
    };
    Future::from_parts(parts).map_err(|error| damaged(error.to_string()))
}

fn write_ends(out: &mut Writer, ends: &[[u32; 4]]) {
    out.list(ends, |out, end| end.iter().for_each(|&n| out.u32(n)));
}

fn read_ends(reader: &mut Reader<'_>) -> Result<Vec<[u32; 4]>, DocumentError> {
    reader.list(|r| Ok([r.u32()?, r.u32()?, r.u32()?, r.u32()?]))
}

/// Places of wood, which lie in the world.
fn read_places(reader: &mut Reader<'_>) -> Result<Vec<Vec3>, DocumentError> {
    let places = reader.vectors()?;
    if places.iter().any(|place| place.abs().max_element() > WORLD_EXTENT) {
        return Err(damaged("wood stands outside the world"));
    }
    Ok(places)
}

fn write_edits(out: &mut Writer, edits: &[Edit]) {
    out.list(edits, |out, edit| match edit {
        Edit::Shed(axis) => out.tagged(0, axis.raw()),
        Edit::Pruned(cut) => out.tagged(1, cut.raw()),
        Edit::Grafted(axis) => out.tagged(2, axis.raw()),
        Edit::Carried(carried) => {
            out.tagged(3, carried.metamers.len() as u32);
            out.list(&carried.metamers, |out, id| out.u32(id.raw()));
            out.vectors(&carried.ends);
            out.vectors(&carried.normals);
            out.list(&carried.axes, |out, id| out.u32(id.raw()));
            out.vectors(&carried.directions);
        }
        Edit::Scarred(id, tips) => {
            out.tagged(5, id.raw());
            out.u32(*tips);
        }
        Edit::Width(id, diameter) => {
            out.tagged(4, id.raw());
            out.option(diameter.map(f32::to_bits));
        }
        Edit::Given(given) => {
            out.tagged(6, given.metamers.len() as u32);
            out.list(&given.metamers, |out, id| out.u32(id.raw()));
            // Some are not numbers.
            out.list(&given.radii.0, |out, radius| out.u32(radius.to_bits()));
        }
    });
}

fn read_edit(reader: &mut Reader<'_>) -> Result<Edit, DocumentError> {
    let (tag, row) = (reader.u8()?, reader.u32()?);
    let metamer = |raw: u32| MetamerId::new(raw as usize);
    let axis = |raw: u32| AxisId::new(raw as usize);
    if row == u32::MAX {
        return Err(damaged("an edit concerns nothing"));
    }
    Ok(match tag {
        0 => Edit::Shed(axis(row)),
        1 => Edit::Pruned(metamer(row)),
        2 => Edit::Grafted(axis(row)),
        3 => Edit::Carried(Box::new(Carried {
            metamers: reader.list(|r| r.row().map(metamer))?,
            ends: read_places(reader)?,
            normals: reader.vectors()?,
            axes: reader.list(|r| r.row().map(axis))?,
            directions: reader.vectors()?,
        })),
        4 => Edit::Width(metamer(row), reader.option()?.map(f32::from_bits)),
        5 => Edit::Scarred(metamer(row), reader.u32()?),
        6 => Edit::Given(Box::new(Given {
            metamers: reader.list(|r| r.row().map(metamer))?,
            radii: GivenRadii(reader.numbers()?.into_iter().map(f32::from_bits).collect()),
        })),
        _ => return Err(damaged("an edit of unknown kind")),
    })
}
