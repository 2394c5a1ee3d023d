//! Strokes and bends in progress.

use espalier_growth::{BrushSample, StrokeId};
use espalier_plant::{Bend, BendState, MetamerId, Plant};

use super::{
    DocumentError, damaged,
    fields::{Reader, Writer},
    names::Names,
};
use crate::{
    document::{
        bending::{OpenBend, OpenBends},
        strokes::{OpenStroke, OpenStrokes},
    },
    principal::Principal,
};

pub(super) fn write(out: &mut Writer, strokes: &OpenStrokes, bends: &OpenBends, names: &Names) {
    write_strokes(out, strokes, names);
    write_bends(out, bends, names);
}

pub(super) fn read(reader: &mut Reader<'_>) -> Result<(OpenStrokes, OpenBends), DocumentError> {
    reader.up_to(1)?;
    Ok((read_strokes(reader)?, read_bends(reader)?))
}

/// Checks that all of it is about wood of the plant.
pub(super) fn check(strokes: &OpenStrokes, bends: &OpenBends, plant: &Plant) -> Result<(), DocumentError> {
    let is_there = |id: MetamerId| id.index() < plant.metamer_count();
    if strokes.open.iter().filter_map(|stroke| stroke.chosen).any(|id| !is_there(id)) {
        return Err(damaged("a metamer is not there"));
    }
    let is_wood = |id: MetamerId| is_there(id) && plant.is_alive(id) && !plant.is_seed(id);
    let is_path = |path: &[MetamerId]| {
        path.len() > 1
            && path.iter().all(|&id| is_wood(id))
            && path.windows(2).all(|pair| plant.metamers().parent(pair[1]) == Some(pair[0]))
    };
    if bends.open.iter().all(|bend| is_path(&bend.path)) {
        Ok(())
    } else {
        Err(damaged("a bend follows no branch"))
    }
}

fn write_strokes(out: &mut Writer, strokes: &OpenStrokes, names: &Names) {
    out.u32(strokes.begun);
    out.list(&strokes.open, |out, stroke| {
        out.text(&names.of(&stroke.author));
        out.u32(stroke.number);
        out.u32(stroke.id.0);
        out.option(stroke.chosen.map(MetamerId::raw));
        out.list(stroke.last.as_slice(), |out, last| {
            out.vector(last.position);
            out.f32(last.radius);
        });
    });
}

fn read_strokes(reader: &mut Reader<'_>) -> Result<OpenStrokes, DocumentError> {
    let begun = reader.u32()?;
    let open = reader.list(|r| {
        let (author, number, id) = (Principal::named(r.text()?), r.u32()?, StrokeId(r.u32()?));
        let chosen = r.metamer()?;
        let last = r.list(|r| Ok(BrushSample { position: r.vector()?, radius: r.f32()? }))?;
        Ok(OpenStroke { author, number, id, chosen, last: last.first().copied() })
    })?;
    Ok(OpenStrokes { open, begun })
}

fn write_bends(out: &mut Writer, bends: &OpenBends, names: &Names) {
    out.u32(bends.begun);
    out.list(&bends.open, |out, bend| {
        out.text(&names.of(&bend.author));
        out.u32(bend.number);
        out.u32(bend.id);
        out.list(&bend.path, |out, row| out.u32(row.raw()));
        out.list(&bend.touches, |out, &touch| out.u32(touch as u32));
        out.u8(u8::from(bend.is_moved));
        out.option(bend.gesture);
        let state = bend.solver.state();
        out.vectors(&state.nodes);
        out.list(&state.radii, |out, &radius| out.f32(radius));
        out.f32(state.stretch);
        out.list(&state.prisms, |out, prism| prism.iter().for_each(|&c| out.f64(c)));
        out.list(&state.targets, |out, (at, place)| {
            out.u32(*at);
            place.iter().for_each(|&c| out.f64(c));
        });
    });
}

fn read_bends(reader: &mut Reader<'_>) -> Result<OpenBends, DocumentError> {
    let begun = reader.u32()?;
    let open = reader.list(|r| {
        let (author, number, id) = (Principal::named(r.text()?), r.u32()?, r.u32()?);
        let path = r.list(|r| r.row().map(|row| MetamerId::new(row as usize)))?;
        let touches = r.list(|r| r.u32().map(|touch| touch as usize))?;
        let is_moved = r.u8()? != 0;
        let gesture = r.option()?;
        let state = BendState {
            nodes: r.vectors()?,
            radii: r.list(Reader::f32)?,
            stretch: r.f32()?,
            prisms: r.list(read_all)?,
            targets: r.list(|r| Ok((r.u32()?, read_all(r)?)))?,
        };
        if state.radii.len() != path.len() || touches.iter().any(|&touch| touch >= path.len()) {
            return Err(damaged("a bend follows no branch"));
        }
        let solver = Bend::from_state(&state).ok_or_else(|| damaged("a bend cannot go on"))?;
        Ok(OpenBend { author, number, id, path, touches, solver, gesture, is_moved })
    })?;
    Ok(OpenBends { open, begun })
}

fn read_all<const N: usize>(reader: &mut Reader<'_>) -> Result<[f64; N], DocumentError> {
    let mut values = [0.0; N];
    for value in &mut values {
        *value = reader.f64()?;
    }
    Ok(values)
}
