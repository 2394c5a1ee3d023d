//! Grammars with what they have written, and which of them each state has.

use std::sync::Arc;

use super::{
    Container, DocumentError, damaged,
    fields::{Reader, Writer},
    sections,
    settings::{read_json, write_json},
};
use crate::document::{
    futures::{Futures, all_states},
    grammars::{InForce, Source, Written},
    history::History,
};

/// Whether any state has a grammar.
pub(super) fn are_there(history: &History, futures: &Futures) -> bool {
    all_states(history, futures).any(|mark| mark.state.written.0.is_some())
}

pub(super) fn write(out: &mut Writer, history: &History, futures: &Futures) {
    let mut sources: Vec<&Arc<Source>> = Vec::new();
    let mut all: Vec<(&Arc<Written>, u32)> = Vec::new();
    let mut states: Vec<Option<u32>> = Vec::new();
    for mark in all_states(history, futures) {
        let number = mark.state.written.0.as_ref().map(|written| {
            // States that share one follow each other, but for those of futures.
            if let Some(known) = all.iter().rposition(|(there, _)| Arc::ptr_eq(there, written)) {
                return known as u32;
            }
            let known = sources.iter().rposition(|there| Arc::ptr_eq(there, &written.source));
            let source = known.unwrap_or(sources.len());
            if source == sources.len() {
                sources.push(&written.source);
            }
            all.push((written, source as u32));
            all.len() as u32 - 1
        });
        states.push(number);
    }
    out.list(&sources, |out, source| {
        out.text(&source.text);
        out.list(&source.values, |out, (name, value)| {
            out.text(name);
            out.f64(*value);
        });
        out.u32(source.seed);
        out.vector(source.at);
        out.u8(u8::from(source.within.is_some()));
        if let Some((body, _)) = &source.within {
            write_json(out, body);
        }
    });
    out.list(&all, |out, (written, source)| {
        out.u32(*source);
        out.u32(written.depth);
        out.list(&written.answers, |out, answers| out.list(answers, |out, &answer| out.f64(answer)));
        out.list(&written.rows, |out, &(key, row)| {
            out.u64(key);
            out.u32(row);
        });
        out.u32(written.step);
        out.u8(u8::from(written.is_edited));
        out.u32(written.begun);
        out.list(&written.ends, |out, &(row, axis)| {
            out.u32(row);
            out.u32(axis);
        });
    });
    out.list(&states, |out, &number| out.option(number));
}

pub(super) fn read(
    container: &Container,
    history: &mut History,
    futures: &mut Futures,
) -> Result<(), DocumentError> {
    let Some(states) = container.read(&sections::GRAMMARS, read_states)? else { return Ok(()) };
    let marks = history.states.iter_mut().chain(futures.all.iter_mut().flat_map(|future| &mut future.states));
    for (mark, written) in marks.zip(states) {
        mark.state.written = written;
    }
    Ok(())
}

fn read_states(r: &mut Reader<'_>) -> Result<Vec<InForce>, DocumentError> {
    let version = r.up_to(2)?;
    let sources = r.list(read_source)?;
    let all = r.list(|r| read_written(r, &sources, version))?;
    r.list(|r| {
        let Some(number) = r.option()? else { return Ok(InForce(None)) };
        let written = all.get(number as usize).ok_or_else(|| damaged("a grammar is missing"))?;
        Ok(InForce(Some(Arc::clone(written))))
    })
}

fn read_source(r: &mut Reader<'_>) -> Result<Arc<Source>, DocumentError> {
    let text = r.text()?.to_owned();
    let values = r.list(|r| Ok((r.text()?.to_owned(), r.f64()?)))?;
    let (seed, at) = (r.u32()?, r.vector()?);
    let within = match r.u8()? {
        0 => None,
        _ => Some(read_json(r)?),
    };
    let source = Source::new(&text, values, |_| seed, at, within.as_ref());
    source.map(Arc::new).map_err(|problem| damaged(problem.message))
}

fn read_written(
    r: &mut Reader<'_>,
    sources: &[Arc<Source>],
    version: u16,
) -> Result<Arc<Written>, DocumentError> {
    let source = sources.get(r.u32()? as usize).ok_or_else(|| damaged("the text of a grammar is missing"))?;
    let depth = r.u32()?;
    let answers = r.list(|r| Ok(r.list(Reader::f64)?.into()))?;
    let rows = r.list(|r| Ok((r.u64()?, r.row()?)))?;
    if !rows.is_sorted_by(|one, other| one.0 < other.0) {
        return Err(damaged("the names of a grammar are out of order"));
    }
    let (step, is_edited, begun) = (r.u32()?, r.u8()? > 0, r.u32()?);
    // The first version does not say what grammars have ended themselves: all counts as ended by hands.
    let ends = if version < 2 { Vec::new() } else { r.list(|r| Ok((r.row()?, r.u32()?)))? };
    if !ends.is_sorted_by(|one, other| one.0 < other.0) {
        return Err(damaged("what a grammar has ended is out of order"));
    }
    Ok(Arc::new(Written { source: Arc::clone(source), depth, answers, rows, ends, step, is_edited, begun }))
}
