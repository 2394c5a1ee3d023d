//! Plants and their futures as bytes.

use espalier_plant::{AxisId, Carried, Edit, Future, FutureParts, MetamerId, PlantParts};

use super::{DocumentError, Reader, Writer, damaged};

pub(super) fn write_plant(out: &mut Writer, parts: &PlantParts) {
    out.u32(parts.now);
    write_ends(out, &parts.ends);
    write_edits(out, &parts.edits);
    out.list(&parts.widths, |out, &(row, diameter)| {
        out.u32(row);
        out.f32(diameter);
    });
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

pub(super) fn read_plant(reader: &mut Reader<'_>) -> Result<PlantParts, DocumentError> {
    Ok(PlantParts {
        now: reader.u32()?,
        ends: read_ends(reader)?,
        edits: reader.list(read_edit)?,
        widths: reader.list(|r| Ok((r.u32()?, r.f32()?)))?,
        parent: reader.list(Reader::u32)?,
        axis: reader.list(Reader::u32)?,
        death: reader.list(Reader::u32)?,
        end: reader.list(Reader::vector)?,
        normal: reader.list(Reader::vector)?,
        bearer: reader.list(Reader::u32)?,
        direction: reader.list(Reader::vector)?,
        axis_death: reader.list(Reader::u32)?,
    })
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
        parent: reader.list(Reader::u32)?,
        axis: reader.list(Reader::u32)?,
        death: reader.list(Reader::u32)?,
        lateral: reader.list(Reader::u32)?,
        end: reader.list(Reader::vector)?,
        normal: reader.list(Reader::vector)?,
        direction: reader.list(Reader::vector)?,
        bearer: reader.list(Reader::u32)?,
        order: reader.list(Reader::u32)?,
        axis_death: reader.list(Reader::u32)?,
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
            ends: reader.list(Reader::vector)?,
            normals: reader.list(Reader::vector)?,
            axes: reader.list(|r| r.row().map(axis))?,
            directions: reader.list(Reader::vector)?,
        })),
        4 => Edit::Width(metamer(row), reader.option()?.map(f32::from_bits)),
        5 => Edit::Scarred(metamer(row), reader.u32()?),
        _ => return Err(damaged("an edit of unknown kind")),
    })
}
