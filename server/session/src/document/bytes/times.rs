//! The present line of time and all others.

use espalier_growth::StrokeId;
use espalier_plant::Plant;
use espalier_proto::version::MAX_FUTURES;

use super::{
    DocumentError, damaged,
    fields::{Reader, Writer},
    names::Names,
    settings::Pool,
    wood::{read_future, write_future},
};
use crate::{
    document::{
        futures::{Fork, Future, Futures},
        history::{Before, History, Kind, Latest, Operation},
        parts::{MAX_PARTS, Parts, Run},
    },
    principal::Principal,
};

pub(super) fn write_history(out: &mut Writer, history: &History, pool: &Pool, names: &Names) {
    pool.write_setting(out, &history.initial);
    out.u32(history.done as u32);
    write_operations(out, &history.operations, pool, names);
    write_latest(out, history.latest);
    out.list(history.before.as_slice(), |out, before| {
        out.u32(before.done as u32);
        write_latest(out, before.latest);
        out.option(before.left);
    });
}

fn write_latest(out: &mut Writer, latest: Option<Latest>) {
    out.list(latest.as_slice(), |out, latest| {
        out.u32(latest.step);
        out.u32(latest.row);
        out.list(latest.rotation.as_slice(), |out, &rotation| out.rotation(rotation));
    });
}

fn read_latest(reader: &mut Reader<'_>) -> Result<Option<Latest>, DocumentError> {
    let latest = reader.list(|r| {
        let (step, row) = (r.u32()?, r.u32()?);
        let rotation = r.list(Reader::rotation)?;
        Ok(Latest { step, row, rotation: rotation.first().copied() })
    })?;
    Ok(latest.first().copied())
}

pub(super) fn read_history(reader: &mut Reader<'_>, pool: &Pool) -> Result<History, DocumentError> {
    let version = reader.up_to(3)?;
    let initial = pool.read_setting(reader)?;
    let done = reader.u32()? as usize;
    let operations = read_operations(reader, pool, version)?;
    if done > operations.len() {
        return Err(damaged("more operations are in force than there are"));
    }
    let latest = read_latest(reader)?;
    let before = reader
        .list(|r| Ok(Before { done: r.u32()? as usize, latest: read_latest(r)?, left: r.option()? }))?;
    let before = before.first().copied();
    if before.is_some_and(|before| before.done >= operations.len()) {
        return Err(damaged("the last operation began after itself"));
    }
    Ok(History { operations, done, initial, latest, states: Vec::new(), before })
}

pub(super) fn write_futures(out: &mut Writer, futures: &Futures, pool: &Pool, names: &Names) {
    out.u32(futures.present);
    out.u32(futures.newest);
    out.list(&futures.all, |out, future| {
        out.u32(future.line);
        out.option(future.on);
        out.u32(future.fork.shared as u32);
        out.u32(future.fork.step);
        write_operations(out, &future.operations, pool, names);
        write_future(out, &future.rows);
    });
}

pub(super) fn read_futures(reader: &mut Reader<'_>, pool: &Pool) -> Result<Futures, DocumentError> {
    let version = reader.up_to(3)?;
    let (present, newest) = (reader.u32()?, reader.u32()?);
    let all = reader.list_up_to(MAX_FUTURES, |r| {
        let (line, on) = (r.u32()?, r.option()?);
        let fork = Fork { shared: r.u32()? as usize, step: r.u32()? };
        let operations = read_operations(r, pool, version)?;
        let rows = read_future(r)?;
        if rows.step() != fork.step {
            return Err(damaged("a future begins elsewhere than its rows"));
        }
        if operations.iter().any(|operation| operation.last > fork.step.saturating_add(rows.steps())) {
            return Err(damaged("an operation of a future spans steps that are not there"));
        }
        Ok(Future { line, on, fork, operations, states: Vec::new(), rows })
    })?;
    Ok(Futures { all, present, newest })
}

/// Checks that every operation spans steps of the plant.
pub(super) fn check_history(history: &History, plant: &Plant) -> Result<(), DocumentError> {
    if history.operations.iter().any(|operation| operation.last > plant.last_step()) {
        return Err(damaged("an operation spans steps that are not there"));
    }
    Ok(())
}

/// Checks that the lines are a tree, and that each leaves the other where that has steps and operations.
pub(super) fn check_futures(
    Futures { all, present, newest }: &Futures,
    history: &History,
    plant: &Plant,
) -> Result<(), DocumentError> {
    let (operations, steps) = (history.operations.len(), plant.last_step() as usize);
    let find = |line: u32| all.iter().find(|future| future.line == line);
    if present > newest {
        return Err(damaged("the present line has no number"));
    }
    for (index, future) in all.iter().enumerate() {
        let is_taken = future.line == *present || all[..index].iter().any(|other| other.line == future.line);
        if is_taken || future.line > *newest {
            return Err(damaged("two lines of time have one number"));
        }
        let mut below = future.on;
        for _ in all {
            let Some(line) = below else { break };
            below = find(line).ok_or_else(|| damaged("a future hangs on nothing"))?.on;
        }
        if below.is_some() {
            return Err(damaged("futures hang on one another in a ring"));
        }
        let (operations, steps) = match future.on.and_then(find) {
            Some(on) if on.fork > future.fork => {
                return Err(damaged("a future leaves a line before it begins"));
            }
            Some(on) => {
                let steps = on.fork.step as usize + on.rows.steps() as usize;
                (on.fork.shared + on.operations.len(), steps)
            }
            None => (operations, steps),
        };
        if future.fork.shared > operations || future.fork.step as usize > steps {
            return Err(damaged("a future leaves a line beyond its end"));
        }
    }
    Ok(())
}

fn write_operations(out: &mut Writer, operations: &[Operation], pool: &Pool, names: &Names) {
    out.list(operations, |out, operation| {
        out.u8(operation.kind as u8);
        out.text(&names.of(&operation.author));
        out.option(operation.gesture);
        out.u32(operation.first);
        out.u32(operation.last);
        out.u32(operation.places);
        pool.write_setting(out, &operation.after);
        out.option(operation.deed);
        let has_parts = operation.parts != Parts::default();
        let flags = [operation.is_joint, operation.is_chosen, has_parts, operation.part > 0];
        out.u8(flags.iter().rev().fold(0, |bits, &flag| bits << 1 | u8::from(flag)));
        if has_parts {
            write_parts(out, &operation.parts, names);
        }
        if operation.part > 0 {
            out.u8(operation.part);
        }
    });
}

fn write_parts(out: &mut Writer, parts: &Parts, names: &Names) {
    out.list(&parts.others, |out, other| out.text(&names.of(other)));
    out.list(&parts.strokes, |out, &(stroke, part)| {
        out.u32(stroke.0);
        out.u8(part);
    });
    out.list(&parts.runs, |out, run| {
        out.u32(run.first);
        out.u8(run.part);
        out.u8(u8::from(run.by_hand));
    });
    let (part, by_hand) = parts.asked;
    out.u8(part);
    out.u8(u8::from(by_hand));
}

fn read_parts(reader: &mut Reader<'_>) -> Result<Parts, DocumentError> {
    let others = reader.list(|r| Ok(Principal::named(r.text()?)))?;
    if others.len() >= MAX_PARTS {
        return Err(damaged("an operation of too many parts"));
    }
    let part = |r: &mut Reader<'_>| match r.u8()? {
        part if usize::from(part) <= others.len() => Ok(part),
        _ => Err(damaged("a part that is not there")),
    };
    let flag = |r: &mut Reader<'_>| match r.u8()? {
        flag @ (0 | 1) => Ok(flag == 1),
        _ => Err(damaged("neither by a hand nor not")),
    };
    let strokes = reader.list(|r| Ok((StrokeId(r.u32()?), part(r)?)))?;
    let runs = reader.list(|r| Ok(Run { first: r.u32()?, part: part(r)?, by_hand: flag(r)? }))?;
    if runs.windows(2).any(|pair| pair[0].first >= pair[1].first) {
        return Err(damaged("wood of parts in disorder"));
    }
    let asked = (part(reader)?, flag(reader)?);
    Ok(Parts { others, strokes, runs, asked })
}

/// Operations; before version 2 nobody took back deeds among others', before version 3 joint ones cannot be told apart.
fn read_operations(
    reader: &mut Reader<'_>,
    pool: &Pool,
    version: u16,
) -> Result<Vec<Operation>, DocumentError> {
    reader.list(|r| {
        let kind = Kind::from_code(r.u8()?).ok_or_else(|| damaged("an operation of unknown kind"))?;
        let (author, gesture) = (Principal::named(r.text()?), r.option()?);
        let (first, last) = (r.u32()?, r.u32()?);
        if first > last {
            return Err(damaged("an operation ends before it begins"));
        }
        let places = r.u32()?;
        let after = pool.read_setting(r)?;
        let (deed, flags) = if version < 2 { (None, 0) } else { (r.option()?, r.u8()?) };
        if deed.is_some() != kind.is_switch() || flags > if version < 3 { 3 } else { 15 } {
            return Err(damaged("an operation takes back what is no deed"));
        }
        let (is_joint, is_chosen) = (flags & 1 > 0, flags & 2 > 0);
        let parts = if flags & 4 > 0 { read_parts(r)? } else { Parts::default() };
        let part = if flags & 8 > 0 { r.u8()? } else { 0 };
        if usize::from(part) >= MAX_PARTS {
            return Err(damaged("a part that is not there"));
        }
        Ok(Operation {
            kind,
            author,
            gesture,
            first,
            last,
            places,
            after,
            deed,
            part,
            is_joint,
            parts,
            is_chosen,
        })
    })
}
