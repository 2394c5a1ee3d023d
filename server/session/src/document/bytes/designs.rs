//! Designs, and which of them each operation leaves in force.

use std::sync::Arc;

use super::{Container, DocumentError, Writer, damaged, sections::DESIGNS, settings::MOST};
use crate::document::{
    Designed,
    futures::Futures,
    history::{History, Operation},
};

/// All settings that have a design, in one order.
fn designs<'a>(
    history: &'a History,
    futures: &'a Futures,
) -> impl Iterator<Item = Option<&'a Arc<Designed>>> {
    let ahead = futures.all.iter().flat_map(|future| &future.operations);
    let of = |operation: &'a Operation| operation.after.design.as_ref();
    std::iter::once(history.initial.design.as_ref()).chain(history.operations.iter().chain(ahead).map(of))
}

/// Whether any operation holds a design.
pub(super) fn are_there(history: &History, futures: &Futures) -> bool {
    designs(history, futures).any(|design| design.is_some())
}

pub(super) fn write(out: &mut Writer, history: &History, futures: &Futures) {
    let mut all: Vec<&Arc<Designed>> = Vec::new();
    let mut numbers = Vec::new();
    for design in designs(history, futures) {
        let number = design.map(|design| {
            // What is looked for was mostly put there last.
            all.iter().rposition(|there| Arc::ptr_eq(there, design)).unwrap_or_else(|| {
                all.push(design);
                all.len() - 1
            })
        });
        numbers.push(number.map(|number| number as u32));
    }
    out.list(&all, |out, design| {
        out.text(&design.text);
        out.vector(design.at);
        out.u32(design.step);
    });
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
        let all = r.list_up_to(MOST, |r| {
            let (text, at, step) = (r.text()?.to_owned(), r.vector()?, r.u32()?);
            let design = Designed { text, at, step };
            design.read().map_err(|_| damaged("a design cannot be read"))?;
            Ok(Arc::new(design))
        })?;
        Ok((all, r.list(|r| r.option())?))
    })?;
    let Some((all, numbers)) = read else { return Ok(()) };
    let ahead = futures.all.iter_mut().flat_map(|future| &mut future.operations);
    let operations = history.operations.iter_mut().chain(ahead);
    let settings = operations.map(|operation| (operation.last, &mut operation.after.design));
    let initial = std::iter::once((0, &mut history.initial.design));
    for ((last, design), number) in initial.chain(settings).zip(numbers) {
        let Some(number) = number else { continue };
        let of = all.get(number as usize).ok_or_else(|| damaged("a design is missing"))?;
        if of.step == 0 || of.step > last {
            return Err(damaged("a design has wood of a step that is not there"));
        }
        *design = Some(Arc::clone(of));
    }
    Ok(())
}
