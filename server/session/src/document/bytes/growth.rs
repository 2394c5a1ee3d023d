//! What the next step of growth depends on beside plant and obstacles, as bytes.

use std::collections::BTreeMap;

use espalier_growth::{BrushSample, Guide, Marker, MarkerSource, SimulationState, StrokeId, Sweep, Waypoint};
use espalier_plant::{AxisId, MetamerId, Plant};

use super::{
    DocumentError, damaged,
    fields::{Reader, Writer},
    settings,
};

/// Flags of a stroke in progress.
const CONNECTING: u8 = 1;
const OUT_OF_REACH: u8 = 2;

/// All but the obstacles, which stand in a section of their own.
pub(super) fn write(out: &mut Writer, state: &SimulationState) {
    out.u32(state.seed);
    out.u32(state.metamer_budget);
    out.u32(state.tick);
    settings::write_json(out, state.parameters.values());
    out.list(&state.markers, |out, marker| {
        out.vector(marker.position);
        out.u32(marker.born);
        out.u8(match marker.source {
            MarkerSource::Brush(_) => 0,
            MarkerSource::Lasso => 1,
        });
        if let MarkerSource::Brush(stroke) = marker.source {
            out.u32(stroke.0);
        }
    });
    let guides: Vec<_> = state.guides.iter().collect();
    out.list(&guides, |out, (stroke, guide)| {
        out.u32(stroke.0);
        out.option(guide.leader.map(AxisId::raw));
        let path: Vec<_> = guide.path.iter().collect();
        out.list(&path, |out, waypoint| {
            out.vector(waypoint.position);
            out.f32(waypoint.weight);
        });
    });
}

pub(super) fn read(reader: &mut Reader<'_>) -> Result<SimulationState, DocumentError> {
    let version = reader.up_to(2)?;
    let (seed, metamer_budget, tick) = (reader.u32()?, reader.u32()?, reader.u32()?);
    let parameters = settings::read_set(reader)?;
    let markers = reader.list(|r| {
        let (position, born) = (r.vector()?, r.u32()?);
        let source = match r.u8()? {
            // Before version 2 nobody noted whose a marker is: of no stroke that goes on.
            0 => MarkerSource::Brush(StrokeId(if version < 2 { 0 } else { r.u32()? })),
            1 => MarkerSource::Lasso,
            _ => return Err(damaged("a marker of unknown source")),
        };
        Ok(Marker { position, born, source })
    })?;
    let guides = reader.list(|r| {
        let stroke = StrokeId(r.u32()?);
        let leader = r.axis()?;
        let path = r.list(|r| Ok(Waypoint { position: r.vector()?, weight: r.f32()? }))?;
        // What it has swept stands in a section of its own.
        Ok((stroke, Guide { leader, path: path.into(), ..Guide::new(0) }))
    })?;
    Ok(SimulationState {
        seed,
        parameters,
        markers,
        guides: BTreeMap::from_iter(guides),
        // Lassos are done between two commands.
        enclosures: Vec::new(),
        obstacles: Vec::new(),
        metamer_budget,
        tick,
    })
}

/// What the brushes of strokes in progress have swept, and since when.
pub(super) fn write_sweeps(out: &mut Writer, guides: &BTreeMap<StrokeId, Guide>) {
    let guides: Vec<_> = guides.iter().collect();
    out.list(&guides, |out, (stroke, guide)| {
        out.u32(stroke.0);
        out.u32(guide.first_born.raw());
        out.list(guide.sweep.places(), |out, place| {
            out.vector(place.position);
            out.f32(place.radius);
        });
        let flag = |is_set: bool, flag: u8| if is_set { flag } else { 0 };
        out.u8(flag(guide.is_connecting, CONNECTING) | flag(guide.is_out_of_reach, OUT_OF_REACH));
    });
}

/// Reads that into the guides.
pub(super) fn read_sweeps(
    reader: &mut Reader<'_>,
    guides: &mut BTreeMap<StrokeId, Guide>,
) -> Result<(), DocumentError> {
    let version = reader.up_to(2)?;
    let read = reader.list(|r| {
        let (stroke, first_born) = (StrokeId(r.u32()?), r.u32()?);
        if first_born == u32::MAX {
            return Err(damaged("a metamer is not there"));
        }
        let first_born = MetamerId::new(first_born as usize);
        let places = r.list(|r| Ok(BrushSample { position: r.vector()?, radius: r.f32()? }))?;
        // The first version has no flags: a stroke is as it was begun.
        let flags = if version > 1 { r.u8()? } else { CONNECTING };
        if let Some(guide) = guides.get_mut(&stroke) {
            guide.first_born = first_born;
            guide.sweep = Sweep::from_places(places);
            guide.is_connecting = flags & CONNECTING != 0;
            guide.is_out_of_reach = flags & OUT_OF_REACH != 0;
        }
        Ok(())
    });
    read.map(drop)
}

/// Checks that every guide is about wood of the plant.
pub(super) fn check(state: &SimulationState, plant: &Plant) -> Result<(), DocumentError> {
    let is_there = |guide: &Guide| {
        guide.leader.is_none_or(|axis| axis.index() < plant.axis_count())
            && guide.first_born.index() <= plant.metamer_count()
    };
    if state.guides.values().all(is_there) {
        Ok(())
    } else {
        Err(damaged("a stroke follows what is not there"))
    }
}
