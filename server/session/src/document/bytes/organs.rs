//! Organs that metamers are given, as bytes. Programs that do not know of them are told so by their section, which is
//! there wherever an edit gives some.

use espalier_plant::{Edit, Given, MetamerId, Organ, Organs, PlantParts, given::GivenColumn};

use super::{
    DocumentError, damaged,
    fields::{Reader, Writer},
};
use crate::document::Futures;

/// Whether metamers are given any, or were.
pub(super) fn are_there(plant: &PlantParts, futures: &Futures) -> bool {
    let gives = |edit: &Edit| match edit {
        Edit::Borne(_) => true,
        Edit::Resettled(edit) => !edit.organs.metamers.is_empty(),
        _ => false,
    };
    !plant.given_organs.is_empty()
        || plant.edits.iter().any(gives)
        || futures.all.iter().any(|future| future.rows.edits().iter().any(gives))
}

/// Those of the present.
pub(super) fn write(out: &mut Writer, plant: &PlantParts) {
    out.list(&plant.given_organs, |out, (row, organs)| {
        out.u32(*row);
        write_organs(out, organs);
    });
}

pub(super) fn read(reader: &mut Reader<'_>) -> Result<Vec<(u32, Organs)>, DocumentError> {
    reader.up_to(1)?;
    reader.list(|r| Ok((r.u32()?, read_organs(r)?)))
}

/// What an edit changes.
pub(super) fn write_given(out: &mut Writer, given: &Given<Option<Organs>>) {
    out.list(&given.metamers, |out, id| out.u32(id.raw()));
    out.list(&given.values.0, |out, organs| {
        out.u8(u8::from(organs.is_some()));
        if let Some(organs) = organs {
            write_organs(out, organs);
        }
    });
}

pub(super) fn read_given(reader: &mut Reader<'_>) -> Result<Given<Option<Organs>>, DocumentError> {
    let metamers = reader.list(|r| r.row().map(|raw| MetamerId::new(raw as usize)))?;
    let values = reader.list(|r| match r.u8()? {
        0 => Ok(None),
        1 => Ok(Some(read_organs(r)?)),
        _ => Err(damaged("organs are neither given nor not")),
    })?;
    Ok(Given { metamers, values: GivenColumn(values) })
}

fn write_organs(out: &mut Writer, organs: &Organs) {
    out.list(organs, |out, organ| out.u32(organ.to_number()));
}

fn read_organs(reader: &mut Reader<'_>) -> Result<Organs, DocumentError> {
    let organs =
        reader.list(|r| Organ::from_number(r.u32()?).ok_or_else(|| damaged("an organ of no kind")))?;
    Ok(organs.into())
}
