//! A glTF file taken apart: its JSON, and where its buffers lie (glTF 2.0 specification, §3.6 and §4).

use base64::{Engine, engine::general_purpose::STANDARD};
use espalier_reading::{Refusal, Unread, from_slice};

use super::{ImportError, damaged, document::Document, source::Source};

const MAGIC: &[u8] = b"glTF";
const JSON_CHUNK: u32 = 0x4e4f_534a;
const BINARY_CHUNK: u32 = 0x004e_4942;
/// Bytes of the header of a file, and of a chunk.
const HEADER: usize = 12;
const CHUNK_HEADER: usize = 8;
/// The most bytes of JSON, buffers inside included: it is held in memory.
const MAX_JSON_BYTES: usize = 16 << 20;
/// The most bytes that a deflated OBJ file may have: as many as any other file.
const MAX_TEXT_BYTES: u64 = 256 << 20;
/// Extensions that are read.
const READ: [&str; 4] = [
    "KHR_mesh_quantization",
    "EXT_meshopt_compression",
    "KHR_meshopt_compression",
    "EXT_mesh_gpu_instancing",
];
/// What such a required extension adds does not concern triangles.
const HARMLESS: [&str; 5] =
    ["KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_punctual", "MSFT_texture_dds"];

/// What a file is read as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Gltf,
    /// Lines, as OBJ has them.
    Text,
}

/// What a file begins as.
pub(super) fn kind(source: &mut Source<'_>) -> Result<Kind, ImportError> {
    const LOOKED_AT: u64 = 256;
    let begin = source.bytes(0, source.length().min(LOOKED_AT) as usize)?;
    if begin.starts_with(b"PK\x03\x04") {
        let Member { start, kept, size, is_deflated } = first_obj(&begin)
            .ok_or_else(|| ImportError::NotModel("it is a ZIP file; unpack it first".to_owned()))?;
        source.narrow(start, kept)?;
        if is_deflated {
            if size > MAX_TEXT_BYTES {
                return Err(ImportError::NotModel("its OBJ file has more than 256 MiB".to_owned()));
            }
            source.deflated(size);
        }
        return Ok(Kind::Text);
    }
    let text = begin.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&begin).trim_ascii_start();
    Ok(if begin.starts_with(MAGIC) || text.starts_with(b"{") { Kind::Gltf } else { Kind::Text })
}

/// A member of a ZIP file: where its data begin, and how many bytes it has there and in all.
struct Member {
    start: u64,
    kept: u64,
    size: u64,
    is_deflated: bool,
}

/// The OBJ file that is the first member of a ZIP file, stored or deflated, as our own are.
fn first_obj(header: &[u8]) -> Option<Member> {
    const NAME: usize = 30;
    const STORED: u16 = 0;
    const DEFLATED: u16 = 8;
    /// The bit that says that the size stands behind the data.
    const SIZE_LATER: u16 = 1 << 3;
    let short = |at: usize| Some(u16::from_le_bytes(*header.get(at..)?.first_chunk()?));
    let (flags, method, name, extra) = (short(6)?, short(8)?, short(26)?, short(28)?);
    let is_obj = header.get(NAME..NAME + usize::from(name))?.to_ascii_lowercase().ends_with(b".obj");
    let start = NAME as u64 + u64::from(name) + u64::from(extra);
    let is_known = is_obj && [STORED, DEFLATED].contains(&method) && flags & SIZE_LATER == 0;
    let [kept, size] = [18, 22].map(|at| u64::from(word(&header[at..])));
    is_known.then_some(Member { start, kept, size, is_deflated: method == DEFLATED })
}

/// JSON and buffers.
pub(super) struct File<'a> {
    pub(super) document: Document,
    pub(super) data: Data<'a>,
}

/// The buffers of a file.
pub(super) struct Data<'a> {
    pub(super) source: Source<'a>,
    pub(super) buffers: Vec<Buffer>,
}

/// Where the bytes of a buffer are.
pub(super) enum Buffer {
    /// So many of the file, from there on.
    InFile { start: u64, length: usize },
    /// They were inside the JSON.
    Held(Vec<u8>),
    /// Nowhere: all that it has lies elsewhere in a compressed form.
    Fallback,
}

/// Takes a file apart.
pub(super) fn open(mut source: Source<'_>) -> Result<File<'_>, ImportError> {
    let head = source.bytes(0, source.length().min(MAGIC.len() as u64) as usize)?;
    let (json, binary) = if head == MAGIC { chunks(&mut source)? } else { (0..source.length(), None) };
    let length = usize::try_from(json.end - json.start).unwrap_or(usize::MAX);
    if length > MAX_JSON_BYTES {
        let most = MAX_JSON_BYTES >> 20;
        return Err(damaged(format!("its JSON has more than {most} MiB; export it as .glb")));
    }
    let json = source.bytes(json.start, length)?;
    let document: Document =
        from_slice(json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&json)).map_err(|unread| match unread {
            Unread::NotJson { line, column, what } => {
                ImportError::NotGltf(format!("{what} at line {line} column {column}"))
            }
            Unread::Refused(Refusal { field, what, .. }) if field.is_empty() => ImportError::NotGltf(what),
            Unread::Refused(Refusal { field, what, allowed, .. }) => ImportError::Member {
                field,
                what,
                allowed: allowed.unwrap_or_else(|| "what glTF 2.0 says".into()),
            },
        })?;
    drop(json);
    if !document.asset.version.starts_with("2.") {
        return Err(ImportError::Version(document.asset.version));
    }
    for name in &document.extensions_required {
        if !READ.contains(&name.as_str()) && !HARMLESS.iter().any(|harmless| name.starts_with(harmless)) {
            return Err(ImportError::Unsupported(format!("the extension {name}")));
        }
    }
    let mut buffers = Vec::with_capacity(document.buffers.len());
    for (number, buffer) in document.buffers.iter().enumerate() {
        let data = match (&buffer.uri, &binary) {
            (Some(uri), _) => Buffer::Held(embedded(uri, number)?),
            (None, Some(binary)) if number == 0 => {
                let length = usize::try_from(binary.end - binary.start).unwrap_or(usize::MAX);
                Buffer::InFile { start: binary.start, length }
            }
            _ if buffer.is_fallback() => Buffer::Fallback,
            _ => return Err(damaged(format!("buffer {number} has no data"))),
        };
        let held = match &data {
            Buffer::InFile { length, .. } => *length,
            Buffer::Held(bytes) => bytes.len(),
            Buffer::Fallback => usize::MAX,
        };
        // A GLB's buffer may be followed by padding, but none may be shorter than it says.
        if held < buffer.byte_length {
            return Err(damaged(format!("buffer {number} is cut short")));
        }
        buffers.push(data);
    }
    Ok(File { document, data: Data { source, buffers } })
}

type Range = std::ops::Range<u64>;

/// Where the JSON and the binary chunk of a GLB file lie.
fn chunks(source: &mut Source<'_>) -> Result<(Range, Option<Range>), ImportError> {
    let version = word(&source.bytes(4, 4)?);
    if version != 2 {
        return Err(ImportError::Version(version.to_string()));
    }
    let length = source.length();
    let mut chunk = |at: u64| -> Result<(u32, Range), ImportError> {
        let header = source.bytes(at, CHUNK_HEADER)?;
        let start = at + CHUNK_HEADER as u64;
        let end = start + u64::from(word(&header));
        if end > length {
            return Err(damaged("it is cut short"));
        }
        Ok((word(&header[4..]), start..end))
    };
    let (kind, json) = chunk(HEADER as u64)?;
    if kind != JSON_CHUNK {
        return Err(damaged("its first chunk is not JSON"));
    }
    // Chunks begin at multiples of four bytes.
    let next = json.start + (json.end - json.start).next_multiple_of(4);
    let binary = if next < length { Some(chunk(next)?) } else { None };
    Ok((json, binary.filter(|&(kind, _)| kind == BINARY_CHUNK).map(|(_, data)| data)))
}

/// The first four bytes as a number.
fn word(bytes: &[u8]) -> u32 {
    bytes.first_chunk().map_or(0, |word| u32::from_le_bytes(*word))
}

/// The bytes of a data URI.
fn embedded(uri: &str, number: usize) -> Result<Vec<u8>, ImportError> {
    let data = uri.strip_prefix("data:").ok_or(ImportError::ExternalBuffer(number))?;
    let (_, text) =
        data.split_once(";base64,").ok_or_else(|| damaged(format!("buffer {number} is not in base64")))?;
    STANDARD.decode(text).map_err(|error| damaged(format!("buffer {number}: {error}")))
}
