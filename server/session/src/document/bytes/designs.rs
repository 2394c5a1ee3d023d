//! Designs: which of them each operation leaves in force, and of which that were let go wood has colours.

use std::{collections::BTreeMap, sync::Arc};

use super::{
    Container, DocumentError, Writer, damaged,
    fields::Reader,
    sections::{DESIGNS, LET_GO},
    settings::MOST,
};
use crate::document::{
    Designed,
    designing::MOST_LET_GO,
    futures::Futures,
    history::{History, Operation, Setting},
};

/// All settings, in one order.
fn settings<'a>(history: &'a History, futures: &'a Futures) -> impl Iterator<Item = &'a Setting> {
    let ahead = futures.all.iter().flat_map(|future| &future.operations);
    let of = |operation: &'a Operation| &operation.after;
    std::iter::once(&history.initial).chain(history.operations.iter().chain(ahead).map(of))
}

/// The same to be changed, each with the last step of its operation.
fn settings_mut<'a>(
    history: &'a mut History,
    futures: &'a mut Futures,
) -> impl Iterator<Item = (u32, &'a mut Setting)> {
    let ahead = futures.all.iter_mut().flat_map(|future| &mut future.operations);
    let operations = history.operations.iter_mut().chain(ahead);
    let of = operations.map(|operation| (operation.last, &mut operation.after));
    std::iter::once((0, &mut history.initial)).chain(of)
}

/// Whether any operation holds a design.
pub(super) fn are_there(history: &History, futures: &Futures) -> bool {
    settings(history, futures).any(|setting| setting.design.is_some())
}

pub(super) fn write(out: &mut Writer, history: &History, futures: &Futures) {
    let mut all: Vec<&Arc<Designed>> = Vec::new();
    let mut numbers = Vec::new();
    for Setting { design, .. } in settings(history, futures) {
        numbers.push(design.as_ref().map(|design| number(&mut all, design, Arc::ptr_eq)));
    }
    out.list(&all, |out, design| write_design(out, design));
    out.list(&numbers, |out, &number| out.option(number));
}

/// Puts designs where operations hold them.
pub(super) fn read(
    container: &Container,
    history: &mut History,
    futures: &mut Futures,
) -> Result<(), DocumentError> {
    let read = container.read(&DESIGNS, |r| {
        r.up_to(1)?;
        let all = r.list_up_to(MOST, read_design)?;
        Ok((all, r.list(|r| r.option())?))
    })?;
    let Some((all, numbers)) = read else { return Ok(()) };
    for ((last, setting), number) in settings_mut(history, futures).zip(numbers) {
        let Some(number) = number else { continue };
        setting.design = Some(numbered(&all, number, last)?);
    }
    Ok(())
}

/// Whether wood has colours of any design that was let go.
pub(super) fn are_let_go(history: &History, futures: &Futures) -> bool {
    settings(history, futures).any(|setting| !setting.let_go.is_empty())
}

pub(super) fn write_let_go(out: &mut Writer, history: &History, futures: &Futures) {
    let mut all: Vec<&Arc<Designed>> = Vec::new();
    let mut sets: Vec<&Arc<[Arc<Designed>]>> = Vec::new();
    let mut numbers = Vec::new();
    for Setting { let_go, .. } in settings(history, futures) {
        numbers.push((!let_go.is_empty()).then(|| number(&mut sets, let_go, Arc::ptr_eq)));
    }
    let sets: Vec<Vec<u32>> = sets
        .into_iter()
        .map(|set| set.iter().map(|design| number(&mut all, design, Arc::ptr_eq)).collect())
        .collect();
    out.list(&all, |out, design| write_design(out, design));
    out.list(&sets, |out, set| out.list(set, |out, &number| out.u32(number)));
    out.list(&numbers, |out, &number| out.option(number));
}

/// Puts designs that were let go where operations hold them.
pub(super) fn read_let_go(
    container: &Container,
    history: &mut History,
    futures: &mut Futures,
) -> Result<(), DocumentError> {
    let read = container.read(&LET_GO, |r| {
        r.up_to(1)?;
        let all = r.list_up_to(MOST, read_design)?;
        let sets = r.list_up_to(MOST, |r| r.list_up_to(MOST_LET_GO, |r| r.u32()))?;
        Ok((all, sets, r.list(|r| r.option())?))
    })?;
    let Some((all, sets, numbers)) = read else { return Ok(()) };
    let mut known: BTreeMap<u32, Arc<[Arc<Designed>]>> = BTreeMap::new();
    for ((last, setting), number) in settings_mut(history, futures).zip(numbers) {
        let Some(number) = number else { continue };
        let set = sets.get(number as usize).ok_or_else(|| damaged("designs are missing"))?;
        let of_set: Result<Vec<_>, _> = set.iter().map(|&number| numbered(&all, number, last)).collect();
        setting.let_go = Arc::clone(known.entry(number).or_insert(of_set?.into()));
    }
    Ok(())
}

/// The place of something among all that are written; where it is not there yet it is put there.
fn number<'a, T>(all: &mut Vec<&'a T>, wanted: &'a T, is_same: impl Fn(&T, &T) -> bool) -> u32 {
    // What is looked for was mostly put there last.
    let there = all.iter().rposition(|there| is_same(there, wanted));
    there.unwrap_or_else(|| {
        all.push(wanted);
        all.len() - 1
    }) as u32
}

/// The design with a number, whose wood stands after a step.
fn numbered(all: &[Arc<Designed>], number: u32, last: u32) -> Result<Arc<Designed>, DocumentError> {
    let of = all.get(number as usize).ok_or_else(|| damaged("a design is missing"))?;
    if of.step == 0 || of.step > last {
        return Err(damaged("a design has wood of a step that is not there"));
    }
    Ok(Arc::clone(of))
}

fn write_design(out: &mut Writer, design: &Designed) {
    out.text(&design.text);
    out.vector(design.at);
    out.u32(design.step);
}

fn read_design(r: &mut Reader<'_>) -> Result<Arc<Designed>, DocumentError> {
    let (text, at, step) = (r.text()?.to_owned(), r.vector()?, r.u32()?);
    let design = Designed { text, at, step };
    design.read().map_err(|_| damaged("a design cannot be read"))?;
    Ok(Arc::new(design))
}
