//! Documents of the first released version, 0.1.0: one deflated piece, whose parts are those of today's sections.
//!
//! Frozen: this finds where one part ends and the next begins, and puts each into the first version of its section.

use espalier_plant::hash::StableHash;

use super::{
    DocumentError,
    container::{Container, MAGIC, Section},
    damaged,
    fields::Reader,
    gestures, growth,
    packing::inflate,
    programmes::Programmes,
    sections::{self, Kind},
    settings::{self, Pool},
    times, wood,
};

const FORMAT: u32 = 4;

/// The same document in sections; nothing if the bytes are not of this format.
pub(super) fn upgrade(bytes: &[u8]) -> Result<Option<Container>, DocumentError> {
    let Some(fields) = bytes.strip_prefix(&MAGIC) else { return Ok(None) };
    let mut header = Reader::new(fields);
    if header.u32()? != FORMAT {
        return Ok(None);
    }
    let (simulation, expected) = (header.u32()?, header.u64()?);
    let most = sections::RELEASED.iter().map(|kind| kind.most).sum();
    let body = unpacked(header.rest(), most)?;
    if checksum(&body) != expected {
        return Err(damaged("its checksum differs"));
    }
    Ok(Some(Container { simulation, writer: None, sections: to_sections(&body)? }))
}

/// The body, if it is no longer than that.
fn unpacked(packed: &[u8], most: u64) -> Result<Vec<u8>, DocumentError> {
    inflate(packed, most)?.ok_or_else(|| damaged("it is longer than any document can be"))
}

fn to_sections(body: &[u8]) -> Result<Vec<Section>, DocumentError> {
    // Whatever later versions of the sections hold, these are the first.
    let mut parts = Parts(Reader::of_version(body, 1));
    let (_, timeline) = parts.next(wood::read_timeline)?;
    let (_, widths) = parts.next(wood::read_widths)?;
    let (_, plant) = parts.next(wood::read_columns)?;
    let (_, state) = parts.next(growth::read)?;
    let (all_parameters, parameters) = parts.next(settings::read_parameters)?;
    let (all_looks, looks) = parts.next(settings::read_looks)?;
    let (all_sets, obstacles) = parts.next(settings::read_obstacles)?;
    let (_, standing) = parts.next(|r| Ok((r.u32()?, r.u32()?)))?;
    let (_, look) = parts.next(Reader::u32)?;
    let pool = Pool::new(Programmes::default().schedules(&all_parameters)?, all_looks, all_sets);
    let (_, history) = parts.next(|r| times::read_history(r, &pool))?;
    let (_, futures) = parts.next(|r| times::read_futures(r, &pool))?;
    let (_, gestures) = parts.next(gestures::read)?;
    let (_, steps_begun) = parts.next(Reader::u32)?;
    parts.0.end()?;
    let section = |kind: &Kind, parts: &[&[u8]]| Section::raw(kind, 1, parts.concat());
    Ok(vec![
        section(&sections::PLANT, &[plant]),
        section(&sections::TIMELINE, &[timeline]),
        section(&sections::WIDTHS, &[widths]),
        section(&sections::GROWTH, &[state, steps_begun]),
        section(&sections::PARAMETERS, &[parameters]),
        section(&sections::LOOKS, &[looks, look]),
        section(&sections::OBSTACLES, &[obstacles, standing]),
        section(&sections::HISTORY, &[history]),
        section(&sections::FUTURES, &[futures]),
        section(&sections::GESTURES, &[gestures]),
    ])
}

/// Bytes that are taken part by part.
struct Parts<'a>(Reader<'a>);

impl<'a> Parts<'a> {
    /// What this reads, and the bytes that it read.
    fn next<T>(
        &mut self,
        read: impl FnOnce(&mut Reader<'a>) -> Result<T, DocumentError>,
    ) -> Result<(T, &'a [u8]), DocumentError> {
        let before = self.0.rest();
        let value = read(&mut self.0)?;
        Ok((value, &before[..before.len() - self.0.rest().len()]))
    }
}

/// Of the body, eight bytes at a time.
fn checksum(body: &[u8]) -> u64 {
    let mut hash = StableHash::default();
    hash.word(body.len() as u64);
    for chunk in body.chunks(8) {
        hash.word(chunk.iter().rev().fold(0, |word, &byte| word << 8 | u64::from(byte)));
    }
    hash.finish()
}

#[cfg(test)]
mod tests {
    use super::{super::packing::deflate, *};

    #[test]
    fn a_body_that_unpacks_to_too_much_is_refused() {
        let packed = deflate(&[0; 5000]);
        let error = unpacked(&packed, 4999).expect_err("one byte too many").to_string();
        assert_eq!(error, "the document is damaged: it is longer than any document can be");
        assert_eq!(unpacked(&packed, 5000), Ok(vec![0; 5000]));
    }
}
