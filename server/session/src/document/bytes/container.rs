//! The outside of a document: a header, a table of sections, and the sections, each packed and with a checksum.
//!
//! `docs/document.md` has the layout. What a section holds is of no concern here.

use std::borrow::Cow;

use flate2::Crc;

use super::{
    DocumentError, damaged,
    fields::{Reader, Writer},
    later,
    packing::{deflate, inflate},
    sections::{Kind, Release, WRITER},
};

pub(crate) const MAGIC: [u8; 8] = *b"ESPALIER";
/// The container's own format. The one before it, 4, was one piece.
const FORMAT: u32 = 5;
const HEADER: usize = 28;
const ENTRY: usize = 28;
/// No document has more sections.
const MAX_SECTIONS: usize = 256;
/// It carries along so many sections that this program does not know, so that there is room for its own.
const MAX_UNKNOWN: usize = 64;

const REQUIRED: u8 = 1;
const RAW: u8 = 0;
const DEFLATED: u8 = 1;

/// A section as it lies in the container.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Section {
    pub(crate) tag: [u8; 4],
    pub(crate) version: u16,
    pub(crate) flags: u8,
    pub(crate) codec: u8,
    /// How long it is when it is unpacked.
    pub(crate) unpacked: u64,
    pub(crate) packed: Vec<u8>,
}

/// A container that is sound from the outside: every section is there once, whole, and of a known version or optional.
#[derive(Clone, Debug)]
pub(crate) struct Container {
    /// The version of the simulation that was at work when it was written.
    pub(crate) simulation: u32,
    /// The program that wrote it, where it was read and says so.
    pub(super) writer: Option<Release>,
    pub(crate) sections: Vec<Section>,
}

impl Section {
    /// A section of this kind that holds these bytes, not packed.
    pub(crate) fn new(kind: &Kind, bytes: Vec<u8>) -> Self {
        Self::raw(kind, kind.version, bytes)
    }

    /// The same in any version, not packed.
    pub(crate) fn raw(kind: &Kind, version: u16, bytes: Vec<u8>) -> Self {
        let unpacked = bytes.len() as u64;
        let flags = if kind.is_required { REQUIRED } else { 0 };
        Self { tag: kind.tag, version, flags, codec: RAW, unpacked, packed: bytes }
    }

    /// The same section with what it holds, unpacked.
    pub(super) fn unpacked(&self, bytes: Vec<u8>) -> Self {
        let Self { tag, version, flags, .. } = *self;
        Self { tag, version, flags, codec: RAW, unpacked: bytes.len() as u64, packed: bytes }
    }

    /// Packs it, if that makes it shorter and it is not packed yet.
    pub(crate) fn pack(&mut self) {
        if self.codec == RAW {
            let deflated = deflate(&self.packed);
            if deflated.len() < self.packed.len() {
                (self.codec, self.packed) = (DEFLATED, deflated);
            }
        }
    }

    pub(super) fn is_packed(&self) -> bool {
        self.codec != RAW
    }

    /// What it holds, within what was announced.
    pub(crate) fn unpack(&self) -> Result<Cow<'_, [u8]>, DocumentError> {
        let bytes = match self.codec {
            RAW => Some(Cow::Borrowed(&*self.packed)),
            DEFLATED => inflate(&self.packed, self.unpacked)?.map(Cow::Owned),
            codec => return Err(later(format!("it is packed by codec {codec}"))),
        };
        let whole = bytes.filter(|bytes| bytes.len() as u64 == self.unpacked);
        whole.ok_or_else(|| damaged("it has another length"))
    }

    fn is_required(&self) -> bool {
        self.flags & REQUIRED != 0
    }

    fn name(&self) -> String {
        Kind::of(self.tag).map_or_else(|| self.tag.escape_ascii().to_string(), |kind| kind.name.to_owned())
    }
}

impl Container {
    /// The same with each section packed that gets shorter by it.
    pub(crate) fn packed(mut self) -> Self {
        self.sections.iter_mut().for_each(Section::pack);
        self
    }

    /// The container as bytes; the same container always gives the same.
    pub(crate) fn to_bytes(&self) -> Vec<u8> {
        let known = self.sections.iter().filter_map(|section| Kind::of(section.tag));
        let needs = known.map(|kind| kind.since).max().unwrap_or_default();
        let mut out = Writer::default();
        MAGIC.into_iter().for_each(|byte| out.u8(byte));
        out.u32(FORMAT);
        out.u32(needs.to_number());
        out.u32(self.simulation);
        out.u32(self.sections.len() as u32);
        let mut table = Writer::default();
        for section in &self.sections {
            section.tag.into_iter().for_each(|byte| table.u8(byte));
            table.u32(
                u32::from(section.version) | u32::from(section.flags) << 16 | u32::from(section.codec) << 24,
            );
            table.u64(section.packed.len() as u64);
            table.u64(section.unpacked);
            table.u32(checksum(&[&section.packed]));
        }
        let (mut bytes, table) = (out.into_bytes(), table.into_bytes());
        bytes.extend_from_slice(&checksum(&[&bytes, &table]).to_le_bytes());
        bytes.extend_from_slice(&table);
        self.sections.iter().for_each(|section| bytes.extend_from_slice(&section.packed));
        bytes
    }

    /// Reads a container; any bytes at all give one or an error.
    pub(crate) fn from_bytes(bytes: &[u8]) -> Result<Self, DocumentError> {
        let mut reader = Reader::new(bytes);
        let magic: [u8; 8] = reader.array().map_err(|_| DocumentError::NotADocument)?;
        if magic != MAGIC {
            return Err(DocumentError::NotADocument);
        }
        let (format, needs) = (reader.u32()?, Release::from_number(reader.u32()?));
        if format > FORMAT {
            return Err(later(format!("it has format {format}, which version {needs} and later ones read")));
        }
        if format < FORMAT {
            return Err(damaged(format!("it has format {format}, which no released version wrote")));
        }
        let (simulation, count, sum) = (reader.u32()?, reader.u32()? as usize, reader.u32()?);
        if count > MAX_SECTIONS {
            return Err(damaged(format!("it has {count} sections, and at most {MAX_SECTIONS} are possible")));
        }
        let table = reader.slice(count * ENTRY)?;
        if checksum(&[&bytes[..HEADER - 4], table]) != sum {
            return Err(damaged("the checksum of its table of sections differs"));
        }
        let mut entries = Reader::new(table);
        let mut sections: Vec<Section> = Vec::with_capacity(count);
        for _ in 0..count {
            let section = read_section(&mut entries, &mut reader)?;
            if sections.iter().any(|other| other.tag == section.tag) {
                return Err(damaged(format!("its section {} is there twice", section.name())));
            }
            let kind = Kind::of(section.tag);
            if kind.map_or(section.is_required(), |kind| section.version > kind.version) {
                let (name, version) = (section.name(), section.version);
                return Err(later(format!(
                    "it has a section {name} of version {version}, which version {needs} and later ones read"
                )));
            }
            if let Some(kind) = kind.filter(|kind| section.unpacked > kind.most) {
                return Err(damaged(format!(
                    "its section {} announces {} bytes, and at most {} are possible",
                    kind.name, section.unpacked, kind.most
                )));
            }
            sections.push(section);
        }
        reader.end()?;
        if sections.iter().filter(|section| Kind::of(section.tag).is_none()).count() > MAX_UNKNOWN {
            return Err(damaged(format!("it has more than {MAX_UNKNOWN} unknown sections")));
        }
        let mut container = Self { simulation, writer: None, sections };
        container.writer = container.read(&WRITER, |r| {
            r.up_to(1)?;
            r.u32().map(Release::from_number)
        })?;
        Ok(container)
    }

    /// What a section of this kind holds; nothing if it is not there. All of it must be read.
    pub(crate) fn read<T>(
        &self,
        kind: &Kind,
        read: impl FnOnce(&mut Reader<'_>) -> Result<T, DocumentError>,
    ) -> Result<Option<T>, DocumentError> {
        let Some(section) = self.sections.iter().find(|section| section.tag == kind.tag) else {
            return Ok(None);
        };
        let within = |error: DocumentError| self.with_writer(error.within(kind.name));
        let bytes = section.unpack().map_err(within)?;
        let mut reader = Reader::of_version(&bytes, section.version);
        let value = read(&mut reader).map_err(within)?;
        reader.end().map_err(within)?;
        Ok(Some(value))
    }

    /// Names the program that wrote what this one does not know.
    fn with_writer(&self, error: DocumentError) -> DocumentError {
        match (error, self.writer) {
            (DocumentError::Later(what), Some(writer)) => {
                later(format!("{what}, which version {writer} and later ones read"))
            }
            (error, _) => error,
        }
    }

    /// The same of a section that every document has.
    pub(crate) fn require<T>(
        &self,
        kind: &Kind,
        read: impl FnOnce(&mut Reader<'_>) -> Result<T, DocumentError>,
    ) -> Result<T, DocumentError> {
        self.read(kind, read)?.ok_or_else(|| damaged(format!("its section {} is missing", kind.name)))
    }

    /// The sections that this program does not know: it carries them along.
    pub(crate) fn unknown(&self) -> Vec<Section> {
        self.sections.iter().filter(|section| Kind::of(section.tag).is_none()).cloned().collect()
    }
}

/// Bytes to which the sections of a container that this program reads unpack, as its table says; nothing is unpacked. 0 where
/// there is no such table, or it is damaged.
pub fn announced_bytes(bytes: &[u8]) -> u64 {
    let announced = || {
        let mut reader = Reader::new(bytes);
        let magic: [u8; 8] = reader.array().ok()?;
        let [_format, _needs, _simulation] = [reader.u32().ok()?, reader.u32().ok()?, reader.u32().ok()?];
        let (count, _sum) = (reader.u32().ok()? as usize, reader.u32().ok()?);
        let table = reader.slice(count.min(MAX_SECTIONS) * ENTRY).ok()?;
        let mut entries = Reader::new(table);
        let mut all = 0_u64;
        for _ in 0..count.min(MAX_SECTIONS) {
            let (tag, _version, _length) = (entries.array().ok()?, entries.u32().ok()?, entries.u64().ok()?);
            let (unpacked, _sum) = (entries.u64().ok()?, entries.u32().ok()?);
            // What is beyond the most is refused before it is unpacked.
            all += Kind::of(tag).map_or(0, |kind| unpacked.min(kind.most));
        }
        (magic == MAGIC).then_some(all)
    };
    announced().unwrap_or(0)
}

/// Reads one entry of the table, and the section it speaks of.
fn read_section(entries: &mut Reader<'_>, sections: &mut Reader<'_>) -> Result<Section, DocumentError> {
    let tag = entries.array()?;
    let [low, high, flags, codec] = entries.array()?;
    let version = u16::from_le_bytes([low, high]);
    let (length, unpacked, sum) = (entries.u64()?, entries.u64()?, entries.u32()?);
    let mut section = Section { tag, version, flags, codec, unpacked, packed: Vec::new() };
    let within = |what: &str| damaged(format!("its section {} {what}", section.name()));
    let length = usize::try_from(length).map_err(|_| within("is cut short"))?;
    let packed = sections.slice(length).map_err(|_| within("is cut short"))?;
    if checksum(&[packed]) != sum {
        return Err(within("differs from its checksum"));
    }
    section.packed = packed.to_vec();
    Ok(section)
}

fn checksum(parts: &[&[u8]]) -> u32 {
    let mut sum = Crc::new();
    parts.iter().for_each(|part| sum.update(part));
    sum.sum()
}
