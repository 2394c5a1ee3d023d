//! Plants and their futures as bytes.

use espalier_growth::WORLD_EXTENT;
use espalier_plant::{
    AxisEnds, AxisId, Carried, Edit, Future, FutureParts, Given, MetamerId, PlantParts, Resettled,
    given::GivenColumn,
};
use glam::Vec3;

use super::{
    DocumentError, damaged,
    fields::{Reader, Writer},
    organs,
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
            write_carried(out, carried);
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
            write_given(out, given);
        }
        Edit::Borne(given) => {
            out.tagged(8, given.metamers.len() as u32);
            organs::write_given(out, given);
        }
        Edit::Resettled(resettled) => {
            let has_organs = !resettled.organs.metamers.is_empty();
            out.tagged(if has_organs { 9 } else { 7 }, resettled.metamers.len() as u32);
            write_resettled(out, resettled);
            if has_organs {
                organs::write_given(out, &resettled.organs);
            }
        }
    });
}

fn write_carried(out: &mut Writer, carried: &Carried) {
    out.list(&carried.metamers, |out, id| out.u32(id.raw()));
    out.vectors(&carried.ends);
    out.vectors(&carried.normals);
    out.list(&carried.axes, |out, id| out.u32(id.raw()));
    out.vectors(&carried.directions);
}

fn write_given(out: &mut Writer, given: &Given) {
    out.list(&given.metamers, |out, id| out.u32(id.raw()));
    // Some are not numbers.
    out.list(&given.values.0, |out, radius| out.u32(radius.to_bits()));
}

fn write_resettled(out: &mut Writer, resettled: &Resettled) {
    let Resettled { metamers, axes, ends, severed, carried, widths, given, organs: _ } = resettled;
    out.list(metamers, |out, &(id, death)| {
        out.u32(id.raw());
        out.u32(death);
    });
    out.list(axes, |out, &(axis, death)| {
        out.u32(axis.raw());
        out.u32(death);
    });
    out.list(ends, |out, ends| {
        out.u32(ends.axis.raw());
        for side in [ends.before, ends.after] {
            out.option(side.map(|(first, _)| first.raw()));
            out.option(side.map(|(_, last)| last.raw()));
        }
    });
    out.list(severed, |out, id| out.u32(id.raw()));
    write_carried(out, carried);
    out.list(widths, |out, &(id, diameter)| {
        out.u32(id.raw());
        out.option(diameter.map(f32::to_bits));
    });
    write_given(out, given);
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
        3 => Edit::Carried(Box::new(read_carried(reader)?)),
        4 => Edit::Width(metamer(row), reader.option()?.map(f32::from_bits)),
        5 => Edit::Scarred(metamer(row), reader.u32()?),
        6 => Edit::Given(Box::new(read_given(reader)?)),
        7 => Edit::Resettled(Box::new(read_resettled(reader)?)),
        8 => Edit::Borne(Box::new(organs::read_given(reader)?)),
        9 => {
            let resettled = read_resettled(reader)?;
            Edit::Resettled(Box::new(Resettled { organs: organs::read_given(reader)?, ..resettled }))
        }
        _ => return Err(damaged("an edit of unknown kind")),
    })
}

fn read_metamer(reader: &mut Reader<'_>) -> Result<MetamerId, DocumentError> {
    reader.row().map(|raw| MetamerId::new(raw as usize))
}

fn read_axis(reader: &mut Reader<'_>) -> Result<AxisId, DocumentError> {
    reader.row().map(|raw| AxisId::new(raw as usize))
}

fn read_carried(reader: &mut Reader<'_>) -> Result<Carried, DocumentError> {
    Ok(Carried {
        metamers: reader.list(read_metamer)?,
        ends: read_places(reader)?,
        normals: reader.vectors()?,
        axes: reader.list(read_axis)?,
        directions: reader.vectors()?,
    })
}

fn read_given(reader: &mut Reader<'_>) -> Result<Given, DocumentError> {
    Ok(Given {
        metamers: reader.list(read_metamer)?,
        values: GivenColumn(reader.numbers()?.into_iter().map(f32::from_bits).collect()),
    })
}

fn read_resettled(reader: &mut Reader<'_>) -> Result<Resettled, DocumentError> {
    let side = |r: &mut Reader<'_>| match (r.option()?, r.option()?) {
        (None, None) => Ok(None),
        (Some(first), Some(last)) if first.max(last) < u32::MAX => {
            Ok(Some((MetamerId::new(first as usize), MetamerId::new(last as usize))))
        }
        _ => Err(damaged("an axis has one end")),
    };
    Ok(Resettled {
        metamers: reader.list(|r| Ok((read_metamer(r)?, r.u32()?)))?,
        axes: reader.list(|r| Ok((read_axis(r)?, r.u32()?)))?,
        ends: reader.list(|r| Ok(AxisEnds { axis: read_axis(r)?, before: side(r)?, after: side(r)? }))?,
        severed: reader.list(read_metamer)?,
        carried: read_carried(reader)?,
        widths: reader.list(|r| Ok((read_metamer(r)?, r.option()?.map(f32::from_bits))))?,
        given: read_given(reader)?,
        organs: Given::default(),
    })
}

#[cfg(test)]
mod tests {
    use espalier_plant::{Claim, Internode, Motion, Organ, OrganKind, Plant, checks};
    use glam::Quat;

    use super::*;

    /// A stem of three, turned at its second metamer, whose last one falls, and its bud with it.
    fn settled() -> Plant {
        let mut plant = Plant::new(Vec3::ZERO);
        let stem = AxisId::new(0);
        for height in 1..=3u8 {
            plant.begin_step();
            let end = Vec3::Y * f32::from(height);
            plant.extend(stem, &Internode { end, normal: Vec3::X, laterals: &[Vec3::X] });
            plant.end_step();
        }
        plant.begin_edit();
        let rotation = Quat::from_xyzw(0.0, 0.0, 0.6, 0.8);
        plant.carry(&[MetamerId::new(2)], &[Motion { rotation, from: Vec3::Y, to: Vec3::Y }]);
        plant.set_width(MetamerId::new(1), Some(0.5));
        plant.give_radii(&[(MetamerId::new(2), Some(0.25))]).expect("living wood");
        let leaf = Organ { kind: OrganKind::Flower, azimuth: 9, inclination: 99, roll: 5, length: 0 };
        plant.give_organs(&[(MetamerId::new(2), Some([leaf].into()))]).expect("living wood");
        plant.end_step();
        let claim = |step: u32| Claim { in_force: step < 3, by_hand: true };
        let settled = plant.settle(&(0..=plant.step()).map(claim).collect::<Vec<_>>().into());
        assert_eq!(settled.falls, [MetamerId::new(3)]);
        plant.go_to(plant.last_step());
        plant
    }

    #[test]
    fn what_was_settled_is_read_as_it_was_written() {
        let mut plant = settled();
        let has_all = |edit: &Edit| {
            let Edit::Resettled(edit) = edit else { return false };
            let Resettled { metamers, axes, ends, severed, carried, widths, given, organs } = &**edit;
            let rows = [metamers.len(), ends.len(), severed.len(), carried.metamers.len(), widths.len()];
            rows.iter().all(|&len| len > 0)
                && !axes.is_empty()
                && !given.metamers.is_empty()
                && !organs.metamers.is_empty()
        };
        assert!(plant.to_parts().edits.iter().any(has_all), "each part of the edit is written");
        let written = plant.to_parts();
        let (mut columns, mut timeline) = (Writer::default(), Writer::default());
        write_columns(&mut columns, &written);
        write_timeline(&mut timeline, &written);
        let (columns, timeline) = (columns.into_bytes(), timeline.into_bytes());
        let rows = read_columns(&mut Reader::new(&columns)).expect("columns");
        let time = read_timeline(&mut Reader::new(&timeline)).expect("a timeline");
        let PlantParts { widths, given_radii, given_organs, .. } = written.clone();
        let PlantParts { now, ends, edits, .. } = time;
        let read = PlantParts { now, ends, edits, widths, given_radii, given_organs, ..rows };
        assert_eq!(read, written);
        assert_eq!(Plant::from_parts(read).as_ref(), Ok(&plant));
        plant.go_to(4);
        let future = plant.stash_future();
        let mut out = Writer::default();
        write_future(&mut out, &future);
        let future = read_future(&mut Reader::new(&out.into_bytes())).expect("a future");
        plant.take_future(future).expect("it is taken where it was cut off");
        plant.go_to(plant.last_step());
        assert_eq!((checks::all(&plant), plant.to_parts()), (Ok(()), written));
    }
}
