//! A document as bytes and back, for snapshots and saved trees.
//!
//! Layout: magic, format version, simulation version, checksum, then the deflated body. The body holds the
//! plant's columns, the simulation's state and the history, all little-endian; parameters as JSON, so that
//! a document written before a parameter existed gets its default.

mod hands;
mod settings;
mod times;
mod wood;

use std::{
    collections::BTreeMap,
    io::{Read, Write},
};

use espalier_growth::{
    Guide, Marker, MarkerSource, Parameters, SIMULATION_VERSION, Simulation, SimulationState, StrokeId,
    Waypoint, appearance::Appearance,
};
use espalier_plant::{AxisId, MetamerId, Plant, hash::StableHash};
use espalier_proto::{AppearancePatch, ParametersPatch};
use flate2::{Compression, read::DeflateDecoder, write::DeflateEncoder};
use glam::Vec3;

use self::{
    settings::Shelf,
    wood::{read_plant, write_plant},
};
use super::{Document, futures::Futures, obstacles::Obstacles, parameters};
use crate::appearance::{self, AppearanceChange};

const MAGIC: &[u8; 8] = b"ESPALIER";
const FORMAT: u32 = 4;
const HEADER: usize = 24;
/// No document is larger than this: the budget's metamers with all their columns fit many times over.
const MAX_BODY: u64 = 4 << 30;

/// Bytes are not a document.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DocumentError {
    /// Not written by this program.
    #[error("this is not an Espalier document")]
    NotADocument,
    /// Written by a later program.
    #[error("the document has format {0}; this program reads format 4")]
    Format(u32),
    /// Cut short or changed since it was written.
    #[error("the document is damaged: {0}")]
    Damaged(String),
}

impl Document {
    /// The whole document, its history and futures included. Steps still pending are run first by the caller.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.write(&self.futures)
    }

    /// The document with its present line of time alone, for keeping as a tree (`TT3`).
    pub fn to_saved_bytes(&self) -> Vec<u8> {
        self.write(&Futures::default())
    }

    fn write(&self, futures: &Futures) -> Vec<u8> {
        debug_assert!(self.pending.is_empty(), "a document is written between two actions");
        let mut body = Writer::default();
        write_plant(&mut body, &self.simulation.plant().to_parts());
        write_state(&mut body, &self.simulation.state());
        let shelf = Shelf::of(&self.history, futures, &self.setting());
        shelf.write(&mut body);
        body.u32(shelf.set_number(&self.obstacles.standing));
        body.u32(self.obstacles.placed);
        body.u32(shelf.looks_number(&self.appearance));
        times::write_history(&mut body, &self.history, &shelf);
        times::write_futures(&mut body, futures, &shelf);
        hands::write_strokes(&mut body, &self.strokes);
        hands::write_bends(&mut body, &self.bends);
        body.u32(self.steps_begun);
        sealed(&body.0)
    }

    /// Reads a document; any bytes at all give a document or an error.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, DocumentError> {
        let (header, packed) = bytes.split_at_checked(HEADER).ok_or(DocumentError::NotADocument)?;
        if &header[..8] != MAGIC {
            return Err(DocumentError::NotADocument);
        }
        let mut fields = Reader(&header[8..]);
        let format = fields.u32()?;
        if format != FORMAT {
            return Err(DocumentError::Format(format));
        }
        let _simulation_version = fields.u32()?;
        let expected = fields.u64()?;
        let mut body = Vec::new();
        DeflateDecoder::new(packed)
            .take(MAX_BODY)
            .read_to_end(&mut body)
            .map_err(|_| damaged("it does not unpack"))?;
        if checksum(&body) != expected {
            return Err(damaged("its checksum differs"));
        }
        let mut reader = Reader(&body);
        let plant =
            Plant::from_parts(read_plant(&mut reader)?).map_err(|error| damaged(error.to_string()))?;
        let mut state = read_state(&mut reader, &plant)?;
        let shelf = Shelf::read(&mut reader)?;
        let obstacles = Obstacles { standing: shelf.read_set(&mut reader)?, placed: reader.u32()? };
        if obstacles.standing.last().is_some_and(|last| last.id > obstacles.placed) {
            return Err(damaged("an obstacle was never placed"));
        }
        state.obstacles = Obstacles::solids(&obstacles.standing);
        let appearance = shelf.read_looks(&mut reader)?;
        let history = times::read_history(&mut reader, &plant, &shelf)?;
        let futures = times::read_futures(&mut reader, &plant, &history, &shelf)?;
        let strokes = hands::read_strokes(&mut reader, &plant)?;
        let bends = hands::read_bends(&mut reader, &plant)?;
        let steps_begun = reader.u32()?;
        if !reader.0.is_empty() {
            return Err(damaged("something follows its end"));
        }
        Ok(Self {
            simulation: Simulation::from_state(plant, state),
            history,
            futures,
            strokes,
            bends,
            obstacles,
            appearance,
            pending: Default::default(),
            steps_begun,
            stop_at: None,
        })
    }
}

/// A body behind its header, packed.
pub(super) fn sealed(body: &[u8]) -> Vec<u8> {
    let mut out = Vec::with_capacity(HEADER + body.len() / 2);
    out.extend_from_slice(MAGIC);
    out.extend_from_slice(&FORMAT.to_le_bytes());
    out.extend_from_slice(&SIMULATION_VERSION.to_le_bytes());
    out.extend_from_slice(&checksum(body).to_le_bytes());
    let mut deflate = DeflateEncoder::new(out, Compression::new(3));
    // Writing into memory does not fail.
    let _ = deflate.write_all(body);
    deflate.finish().unwrap_or_default()
}

fn damaged(what: impl Into<String>) -> DocumentError {
    DocumentError::Damaged(what.into())
}

fn checksum(body: &[u8]) -> u64 {
    let mut hash = StableHash::default();
    hash.word(body.len() as u64);
    for chunk in body.chunks(8) {
        hash.word(chunk.iter().rev().fold(0, |word, &byte| word << 8 | u64::from(byte)));
    }
    hash.finish()
}

fn write_state(out: &mut Writer, state: &SimulationState) {
    out.u32(state.seed);
    out.u32(state.metamer_budget);
    out.u32(state.tick);
    out.parameters(&state.parameters);
    out.list(&state.markers, |out, marker| {
        out.vector(marker.position);
        out.u32(marker.born);
        out.0.push(match marker.source {
            MarkerSource::Brush => 0,
            MarkerSource::Lasso => 1,
        });
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

fn read_state(reader: &mut Reader<'_>, plant: &Plant) -> Result<SimulationState, DocumentError> {
    let (seed, metamer_budget, tick) = (reader.u32()?, reader.u32()?, reader.u32()?);
    let parameters = reader.parameters()?;
    let markers = reader.list(|r| {
        let (position, born) = (r.vector()?, r.u32()?);
        let source = match r.u8()? {
            0 => MarkerSource::Brush,
            1 => MarkerSource::Lasso,
            _ => return Err(damaged("a marker of unknown source")),
        };
        Ok(Marker { position, born, source })
    })?;
    let guides = reader.list(|r| {
        let stroke = StrokeId(r.u32()?);
        let leader = r.axis(plant)?;
        let path = r.list(|r| Ok(Waypoint { position: r.vector()?, weight: r.f32()? }))?;
        Ok((stroke, Guide { leader, path: path.into() }))
    })?;
    Ok(SimulationState {
        seed,
        parameters,
        markers,
        guides: BTreeMap::from_iter(guides),
        // They are on the shelf.
        obstacles: Vec::new(),
        metamer_budget,
        tick,
    })
}

#[derive(Default)]
struct Writer(Vec<u8>);

impl Writer {
    fn u32(&mut self, value: u32) {
        self.0.extend_from_slice(&value.to_le_bytes());
    }

    fn f32(&mut self, value: f32) {
        self.u32(value.to_bits());
    }

    fn f64(&mut self, value: f64) {
        self.0.extend_from_slice(&value.to_bits().to_le_bytes());
    }

    fn vector(&mut self, v: Vec3) {
        v.to_array().into_iter().for_each(|c| self.f32(c));
    }

    fn option(&mut self, value: Option<u32>) {
        self.0.push(u8::from(value.is_some()));
        self.u32(value.unwrap_or(0));
    }

    fn tagged(&mut self, tag: u8, row: u32) {
        self.0.push(tag);
        self.u32(row);
    }

    fn numbers(&mut self, column: &[u32]) {
        self.list(column, |out, &value| out.u32(value));
    }

    fn vectors(&mut self, column: &[Vec3]) {
        self.list(column, |out, &v| out.vector(v));
    }

    fn text(&mut self, text: &str) {
        self.list(text.as_bytes(), |out, &byte| out.0.push(byte));
    }

    fn parameters(&mut self, set: &Parameters) {
        // Plain numbers and switches always have a JSON form.
        self.text(&serde_json::to_string(&parameters::to_proto(set.values())).unwrap_or_default());
    }

    fn appearance(&mut self, looks: &Appearance) {
        self.text(&serde_json::to_string(&appearance::to_proto(looks)).unwrap_or_default());
    }

    fn list<T>(&mut self, items: &[T], mut write: impl FnMut(&mut Self, &T)) {
        self.u32(items.len() as u32);
        for item in items {
            write(self, item);
        }
    }
}

struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], DocumentError> {
        let (taken, rest) = self.0.split_first_chunk::<N>().ok_or_else(|| damaged("it is cut short"))?;
        self.0 = rest;
        Ok(*taken)
    }

    fn u8(&mut self) -> Result<u8, DocumentError> {
        self.take::<1>().map(|[byte]| byte)
    }

    fn u32(&mut self) -> Result<u32, DocumentError> {
        self.take().map(u32::from_le_bytes)
    }

    fn u64(&mut self) -> Result<u64, DocumentError> {
        self.take().map(u64::from_le_bytes)
    }

    fn f32(&mut self) -> Result<f32, DocumentError> {
        let value = f32::from_bits(self.u32()?);
        if value.is_finite() { Ok(value) } else { Err(damaged("a number is not finite")) }
    }

    fn f64(&mut self) -> Result<f64, DocumentError> {
        let value = f64::from_bits(self.u64()?);
        if value.is_finite() { Ok(value) } else { Err(damaged("a number is not finite")) }
    }

    fn vector(&mut self) -> Result<Vec3, DocumentError> {
        Ok(Vec3::new(self.f32()?, self.f32()?, self.f32()?))
    }

    fn option(&mut self) -> Result<Option<u32>, DocumentError> {
        let (is_some, value) = (self.u8()?, self.u32()?);
        Ok((is_some != 0).then_some(value))
    }

    /// A row, which is never the greatest number.
    fn row(&mut self) -> Result<u32, DocumentError> {
        Some(self.u32()?).filter(|&row| row != u32::MAX).ok_or_else(|| damaged("a row is none"))
    }

    /// An axis of the plant, or none.
    fn axis(&mut self, plant: &Plant) -> Result<Option<AxisId>, DocumentError> {
        match self.option()?.map(|axis| axis as usize) {
            Some(axis) if axis >= plant.axis_count() => Err(damaged("an axis is not there")),
            axis => Ok(axis.map(AxisId::new)),
        }
    }

    fn metamer(&mut self, plant: &Plant) -> Result<Option<MetamerId>, DocumentError> {
        match self.option()?.map(|metamer| metamer as usize) {
            Some(metamer) if metamer >= plant.metamer_count() => Err(damaged("a metamer is not there")),
            metamer => Ok(metamer.map(MetamerId::new)),
        }
    }

    fn text(&mut self) -> Result<String, DocumentError> {
        let bytes = self.list(Self::u8)?;
        String::from_utf8(bytes).map_err(|_| damaged("a text is not UTF-8"))
    }

    fn parameters(&mut self) -> Result<Parameters, DocumentError> {
        let text = self.text()?;
        let patch: ParametersPatch =
            serde_json::from_str(&text).map_err(|error| damaged(format!("its parameters: {error}")))?;
        let defaults = parameters::to_proto(Parameters::default().values());
        parameters::parse(&defaults.patched(&patch)).map_err(|problem| damaged(problem.message))
    }

    fn appearance(&mut self) -> Result<Appearance, DocumentError> {
        let text = self.text()?;
        let patch: AppearancePatch =
            serde_json::from_str(&text).map_err(|error| damaged(format!("its looks: {error}")))?;
        let change = AppearanceChange::parse(&patch).map_err(|problem| damaged(problem.message))?;
        Ok(change.applied_to(&Appearance::default()))
    }

    fn list<T>(
        &mut self,
        mut read: impl FnMut(&mut Self) -> Result<T, DocumentError>,
    ) -> Result<Vec<T>, DocumentError> {
        let len = self.u32()? as usize;
        // Every item takes a byte at least, so a length beyond the rest is a lie not worth allocating for.
        if len > self.0.len() {
            return Err(damaged("a list is longer than what is left"));
        }
        let mut items = Vec::with_capacity(len.min(1 << 20));
        for _ in 0..len {
            items.push(read(self)?);
        }
        Ok(items)
    }
}
