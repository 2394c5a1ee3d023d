//! All files of a job as one ZIP file (`JB9`). Nothing is packed, so that its length and every byte of it are known
//! before it is read, and a part of it can be asked for.

use std::{
    fs::File,
    io::{self, Read, Seek, SeekFrom},
    sync::Arc,
};

use axum::{
    extract::State,
    http::{HeaderMap, header},
    response::Response,
};

use super::no_job;
use crate::{
    access::Caller,
    http::{
        Shared,
        failure::{Failure, Path},
        file_name, ranges,
    },
    jobs::{Grown, Job},
};

/// What a number of 32 bits has where a longer one stands elsewhere.
const ELSEWHERE: u32 = u32::MAX;
/// The version of the format that reads longer numbers, and the one that reads all else.
const LONG: u16 = 45;
const PLAIN: u16 = 10;
/// The extra field with longer numbers.
const LONG_FIELD: u16 = 1;
/// The format counts from 1980, and files of a job have no other day.
const DAY: u16 = 0x21;

/// All files of a job so far (`JB9`).
pub(in crate::http) async fn archive(
    State(shared): State<Shared>,
    caller: Caller,
    Path(id): Path<String>,
    asked: HeaderMap,
) -> Result<Response, Failure> {
    let (job, _) = shared.jobs.find(&id, &caller).ok_or_else(no_job)?;
    let grown = job.progress().grown;
    if grown.is_empty() {
        return Err(Failure::none_such("file", "job", "a job that has made a file"));
    }
    let sums: Vec<u8> = grown.iter().flat_map(|one| [one.seed, one.sum]).flat_map(u32::to_le_bytes).collect();
    let tag = ranges::tag(&[id.as_bytes(), &sums]);
    let headers = [
        (header::CONTENT_TYPE, "application/zip".to_owned()),
        (header::CONTENT_DISPOSITION, file_name::attachment("trees", "zip")),
    ];
    let members: Vec<Member> = grown
        .iter()
        .map(|&Grown { seed, bytes, sum, .. }| Member { seed, name: job.file_name(seed), bytes, sum })
        .collect();
    let archive = Archive::of(&members, move |seed| open(&job, seed));
    let length = archive.length();
    ranges::answer(&asked, headers, &tag, archive, length)
}

fn open(job: &Arc<Job>, seed: u32) -> io::Result<File> {
    // Whoever gives a job up takes its files away.
    Ok(job.open(seed)?.ok_or(io::ErrorKind::NotFound)?.0)
}

/// A file that goes into an archive.
struct Member {
    seed: u32,
    name: String,
    bytes: u64,
    /// CRC-32.
    sum: u32,
}

/// A ZIP file that is read without being written anywhere.
struct Archive<Open> {
    /// What follows what, with where each begins.
    pieces: Vec<(u64, Piece)>,
    length: u64,
    at: u64,
    open: Open,
    /// The file that is being read, by its piece.
    file: Option<(usize, File)>,
}

enum Piece {
    Bytes(Vec<u8>),
    /// The file of a seed.
    File(u32),
}

impl<Open: FnMut(u32) -> io::Result<File>> Archive<Open> {
    fn of(members: &[Member], open: Open) -> Self {
        let mut pieces = Vec::new();
        let (mut at, mut list) = (0, Vec::new());
        let mut add = |piece, length: u64| {
            pieces.push((at, piece));
            at += length;
            at
        };
        let mut start = 0;
        for member in members {
            let head = head(member);
            let length = head.len() as u64;
            listed(&mut list, member, start);
            add(Piece::Bytes(head), length);
            start = add(Piece::File(member.seed), member.bytes);
        }
        end(&mut list, members.len() as u16, start);
        let length = list.len() as u64;
        let length = add(Piece::Bytes(list), length);
        Self { pieces, length, at: 0, open, file: None }
    }

    fn length(&self) -> u64 {
        self.length
    }
}

impl<Open: FnMut(u32) -> io::Result<File>> Read for Archive<Open> {
    fn read(&mut self, to: &mut [u8]) -> io::Result<usize> {
        if self.at >= self.length {
            return Ok(0);
        }
        let which = self.pieces.partition_point(|(start, _)| *start <= self.at) - 1;
        let (start, piece) = &self.pieces[which];
        let end = self.pieces.get(which + 1).map_or(self.length, |(next, _)| *next);
        let (within, left) = (self.at - start, end - self.at);
        let most = usize::try_from(left).map_or(to.len(), |left| left.min(to.len()));
        let count = match piece {
            Piece::Bytes(bytes) => (&bytes[within as usize..]).read(&mut to[..most])?,
            &Piece::File(seed) => {
                let mut file = match self.file.take() {
                    Some((open, file)) if open == which => file,
                    _ => (self.open)(seed)?,
                };
                file.seek(SeekFrom::Start(within))?;
                let count = file.read(&mut to[..most])?;
                self.file = Some((which, file));
                if count == 0 && most > 0 {
                    // Shorter than it was: the rest would stand where nobody looks for it.
                    return Err(io::ErrorKind::UnexpectedEof.into());
                }
                count
            }
        };
        self.at += count as u64;
        Ok(count)
    }
}

impl<Open> Seek for Archive<Open> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let at = match to {
            SeekFrom::Start(at) => Some(at),
            SeekFrom::End(by) => self.length.checked_add_signed(by),
            SeekFrom::Current(by) => self.at.checked_add_signed(by),
        };
        self.at = at.ok_or(io::ErrorKind::InvalidInput)?;
        Ok(self.at)
    }
}

/// A number as 32 bits; one that is too long for them stands in the extra field.
fn short(number: u64, long: &mut Vec<u8>) -> u32 {
    let fits = u32::try_from(number).ok().filter(|number| *number != ELSEWHERE);
    fits.unwrap_or_else(|| {
        long.extend(number.to_le_bytes());
        ELSEWHERE
    })
}

/// The version that reads these longer numbers, and the extra field that has them.
fn extra(long: &[u8]) -> (u16, Vec<u8>) {
    if long.is_empty() {
        return (PLAIN, Vec::new());
    }
    let mut field = Vec::new();
    words(&mut field, &[LONG_FIELD, long.len() as u16]);
    field.extend(long);
    (LONG, field)
}

/// What stands before a file.
fn head(Member { name, bytes, sum, .. }: &Member) -> Vec<u8> {
    let mut long = Vec::new();
    let sizes = [short(*bytes, &mut long), short(*bytes, &mut long)];
    let (version, extra) = extra(&long);
    let mut head = b"PK\x03\x04".to_vec();
    words(&mut head, &[version, 0, 0, 0, DAY]);
    head.extend([*sum, sizes[0], sizes[1]].map(u32::to_le_bytes).as_flattened());
    words(&mut head, &[name.len() as u16, extra.len() as u16]);
    head.extend(name.bytes());
    head.extend(extra);
    head
}

/// What the list at the end says of a file whose head begins at `start`.
fn listed(list: &mut Vec<u8>, Member { name, bytes, sum, .. }: &Member, start: u64) {
    let mut long = Vec::new();
    let sizes = [short(*bytes, &mut long), short(*bytes, &mut long)];
    let start = short(start, &mut long);
    let (version, extra) = extra(&long);
    list.extend(b"PK\x01\x02");
    words(list, &[version, version, 0, 0, 0, DAY]);
    list.extend([*sum, sizes[0], sizes[1]].map(u32::to_le_bytes).as_flattened());
    words(list, &[name.len() as u16, extra.len() as u16, 0, 0, 0, 0, 0]);
    list.extend(start.to_le_bytes());
    list.extend(name.bytes());
    list.extend(extra);
}

/// What stands behind the list, which begins at `start`.
fn end(list: &mut Vec<u8>, count: u16, start: u64) {
    let length = list.len() as u64;
    let mut long = Vec::new();
    let (short_length, short_start) = (short(length, &mut long), short(start, &mut long));
    if !long.is_empty() {
        let end = start + length;
        list.extend(b"PK\x06\x06");
        // Its own length without what has been said so far.
        list.extend(44u64.to_le_bytes());
        words(list, &[LONG, LONG]);
        list.extend([0u32, 0].map(u32::to_le_bytes).as_flattened());
        let numbers = [u64::from(count), u64::from(count), length, start];
        list.extend(numbers.map(u64::to_le_bytes).as_flattened());
        list.extend(b"PK\x06\x07");
        list.extend(0u32.to_le_bytes());
        list.extend(end.to_le_bytes());
        list.extend(1u32.to_le_bytes());
    }
    list.extend(b"PK\x05\x06");
    words(list, &[0, 0, count, count]);
    list.extend([short_length, short_start].map(u32::to_le_bytes).as_flattened());
    words(list, &[0]);
}

fn words(bytes: &mut Vec<u8>, words: &[u16]) {
    bytes.extend(words.iter().flat_map(|word| word.to_le_bytes()));
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::*;

    fn member(seed: u32, contents: &[u8]) -> Member {
        let (name, bytes) = (format!("{seed}.mtg"), contents.len() as u64);
        Member { seed, name, bytes, sum: crc32fast::hash(contents) }
    }

    fn file_of(contents: &[u8]) -> io::Result<File> {
        let mut file = tempfile::tempfile()?;
        file.write_all(contents)?;
        Ok(file)
    }

    fn contents(seed: u32) -> Vec<u8> {
        seed.to_string().repeat(1000 * seed as usize).into_bytes()
    }

    fn archive(seeds: &[u32]) -> Archive<impl FnMut(u32) -> io::Result<File>> {
        let members: Vec<Member> = seeds.iter().map(|&seed| member(seed, &contents(seed))).collect();
        Archive::of(&members, |seed| file_of(&contents(seed)))
    }

    #[test]
    fn jb9_an_archive_has_the_length_that_it_says_and_any_part_is_that_of_the_whole() {
        let mut whole = Vec::new();
        let mut read = archive(&[7, 1, 30]);
        read.read_to_end(&mut whole).unwrap();
        assert_eq!(whole.len() as u64, read.length());
        for seed in [7, 1, 30] {
            let contents = contents(seed);
            assert!(whole.windows(contents.len()).any(|part| part == contents), "{seed}");
        }
        for (from, to) in [(0, 3), (20, 40), (7000, 7100), (whole.len() - 30, whole.len())] {
            let mut part = vec![0; to - from];
            let mut read = archive(&[7, 1, 30]);
            read.seek(SeekFrom::Start(from as u64)).unwrap();
            read.read_exact(&mut part).unwrap();
            assert_eq!(part, whole[from..to], "{from} to {to}");
        }
    }

    #[test]
    fn jb9_an_archive_of_files_that_are_gone_ends_with_an_error() {
        let member = member(1, b"contents");
        let mut gone = Archive::of(&[member], |_| Err(io::ErrorKind::NotFound.into()));
        let error = gone.read_to_end(&mut Vec::new()).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::NotFound);
        let member = self::member(1, b"contents");
        let mut short = Archive::of(&[member], |_| file_of(b"con"));
        assert_eq!(short.read_to_end(&mut Vec::new()).unwrap_err().kind(), io::ErrorKind::UnexpectedEof);
    }

    #[test]
    fn jb9_numbers_beyond_32_bits_stand_in_fields_of_their_own() {
        let large = |seed| Member { seed, name: format!("{seed}.ply"), bytes: 5 << 30, sum: 1 };
        let archive = Archive::of(&[large(1), large(2)], |_| file_of(b""));
        let Some((start, Piece::Bytes(list))) = archive.pieces.last() else { panic!("a list comes last") };
        let long = |at: usize| u64::from_le_bytes(list[at..at + 8].try_into().unwrap());
        // Of the second file: 46 bytes and its name, then the field with its two sizes and its start.
        let second = 46 + 5 + 20 + 46 + 5;
        assert_eq!(list[second..second + 4], [1, 0, 24, 0]);
        assert_eq!([long(second + 4), long(second + 12)], [5 << 30; 2]);
        assert_eq!(long(second + 20), (5 << 30) + 30 + 5 + 20);
        let end = list.len() - 22 - 20 - 56;
        assert_eq!(list[end..end + 4], *b"PK\x06\x06");
        assert_eq!([long(end + 24), long(end + 48)], [2, *start]);
        assert_eq!(long(list.len() - 22 - 12), start + end as u64);
    }
}
