//! A glTF file taken apart: its JSON and its buffers (glTF 2.0 specification, §3.6 and §4).

use std::borrow::Cow;

use base64::{Engine, engine::general_purpose::STANDARD};
use espalier_reading::{Refusal, Unread, from_slice};

use crate::{ImportError, damaged, document::Document};

const MAGIC: &[u8] = b"glTF";
const JSON_CHUNK: u32 = 0x4e4f_534a;
const BINARY_CHUNK: u32 = 0x004e_4942;
/// What such a required extension adds does not concern triangles.
const HARMLESS: [&str; 4] = ["KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_punctual"];

/// JSON and buffers.
pub(crate) struct File<'a> {
    pub document: Document,
    pub buffers: Vec<Cow<'a, [u8]>>,
}

/// Takes a file apart.
pub(crate) fn open(bytes: &[u8]) -> Result<File<'_>, ImportError> {
    let (json, binary) = if bytes.starts_with(MAGIC) { chunks(bytes)? } else { (bytes, None) };
    let document: Document = from_slice(json).map_err(|unread| match unread {
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
    if !document.asset.version.starts_with("2.") {
        return Err(ImportError::Version(document.asset.version));
    }
    for name in &document.extensions_required {
        if !HARMLESS.iter().any(|harmless| name.starts_with(harmless)) {
            return Err(ImportError::Unsupported(format!("the extension {name}")));
        }
    }
    let mut buffers = Vec::with_capacity(document.buffers.len());
    for (number, buffer) in document.buffers.iter().enumerate() {
        let data = match (&buffer.uri, binary) {
            (Some(uri), _) => Cow::Owned(embedded(uri, number)?),
            (None, Some(binary)) if number == 0 => Cow::Borrowed(binary),
            _ => return Err(damaged(format!("buffer {number} has no data"))),
        };
        // A GLB's buffer may be followed by padding, but none may be shorter than it says.
        if data.len() < buffer.byte_length {
            return Err(damaged(format!("buffer {number} is cut short")));
        }
        buffers.push(data);
    }
    Ok(File { document, buffers })
}

/// The JSON and the binary chunk of a GLB file.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), ImportError> {
    let word = |at: usize| {
        let word = bytes.get(at..at + 4).and_then(|word| word.try_into().ok());
        word.map(u32::from_le_bytes).ok_or_else(|| damaged("it is cut short"))
    };
    let version = word(4)?;
    if version != 2 {
        return Err(ImportError::Version(version.to_string()));
    }
    let chunk = |at: usize| -> Result<(u32, &[u8]), ImportError> {
        let end = (at + 8).checked_add(word(at)? as usize);
        let data = end.and_then(|end| bytes.get(at + 8..end)).ok_or_else(|| damaged("it is cut short"))?;
        Ok((word(at + 4)?, data))
    };
    let (kind, json) = chunk(12)?;
    if kind != JSON_CHUNK {
        return Err(damaged("its first chunk is not JSON"));
    }
    // Chunks begin at multiples of four bytes.
    let next = 20 + json.len().next_multiple_of(4);
    let binary = if next < bytes.len() { Some(chunk(next)?) } else { None };
    Ok((json, binary.filter(|&(kind, _)| kind == BINARY_CHUNK).map(|(_, data)| data)))
}

/// The bytes of a data URI.
fn embedded(uri: &str, number: usize) -> Result<Vec<u8>, ImportError> {
    let data = uri.strip_prefix("data:").ok_or(ImportError::ExternalBuffer(number))?;
    let (_, text) =
        data.split_once(";base64,").ok_or_else(|| damaged(format!("buffer {number} is not in base64")))?;
    STANDARD.decode(text).map_err(|error| damaged(format!("buffer {number}: {error}")))
}
