//! The faces of OBJ files (Wavefront, "Advanced Visualizer" appendix B1), line by line. Units are metres, Y is up.

use std::io::{BufRead, BufReader, Read};

use glam::Vec3;

use super::{
    ImportError,
    budget::Budget,
    levels,
    polygon::Cutter,
    source::{Source, unread},
    weld::Gathered,
};

/// The most bytes of a line, those that it goes on in included.
const MAX_LINE: usize = 256 * 1024;
/// Keywords of the format whose lines say nothing of faces.
const PASSED_OVER: [&str; 38] = [
    "vt",
    "vn",
    "vp",
    "l",
    "p",
    "s",
    "mg",
    "mtllib",
    "usemtl",
    "maplib",
    "usemap",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
    "ctech",
    "stech",
    "cstype",
    "deg",
    "bmat",
    "step",
    "curv",
    "curv2",
    "surf",
    "parm",
    "trim",
    "hole",
    "scrv",
    "sp",
    "end",
    "con",
    "call",
    "csh",
    "bsp",
    "bzp",
    "res",
];

/// All faces of a file, in triangles.
pub(super) fn triangles(source: Source<'_>, budget: &mut Budget) -> Result<Gathered, ImportError> {
    let mut lines =
        Lines { from: BufReader::new(source.into_reader()?), read: 0, first: 0, text: Vec::new() };
    let mut reader = Reader::default();
    while lines.next(reader.is_obj)? {
        let mut words = lines.text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        let Some(keyword) = words.next() else { continue };
        reader.line(keyword, words, budget).map_err(|fault| fault.at(lines.first))?;
    }
    if reader.is_obj { Ok(reader.gathered) } else { Err(ImportError::NotModel("it is empty".to_owned())) }
}

/// Lines, of which one is held at a time.
struct Lines<R> {
    from: BufReader<R>,
    /// How many were read.
    read: u64,
    /// The number of the present one, or of the first where it goes on in others.
    first: u64,
    text: Vec<u8>,
}

impl<R: Read> Lines<R> {
    /// Goes on to the next line, if there is one.
    fn next(&mut self, is_obj: bool) -> Result<bool, ImportError> {
        self.text.clear();
        self.first = self.read + 1;
        loop {
            let room = MAX_LINE + 1 - self.text.len();
            let mut some = self.from.by_ref().take(room as u64);
            if some.read_until(b'\n', &mut self.text).map_err(unread)? == 0 {
                return Ok(!self.text.is_empty());
            }
            if self.text.len() > MAX_LINE {
                if !is_obj {
                    return Err(ImportError::NotModel(format!("line {} is too long", self.first)));
                }
                let allowed = format!("up to {} KiB", MAX_LINE >> 10);
                return Err(Fault::Line("it is too long".to_owned(), allowed).at(self.first));
            }
            self.read += 1;
            let length = self.text.trim_ascii_end().len();
            self.text.truncate(length);
            if self.text.starts_with(b"#") || self.text.pop_if(|last| *last == b'\\').is_none() {
                return Ok(true);
            }
            self.text.push(b' ');
        }
    }
}

/// What is wrong with a line, and what is allowed there; or with the file.
enum Fault {
    Line(String, String),
    NotObj(String),
    File(ImportError),
}

impl Fault {
    fn at(self, line: u64) -> ImportError {
        match self {
            Self::Line(what, allowed) => ImportError::Line { line, what, allowed },
            Self::NotObj(word) => ImportError::NotModel(format!("line {line} begins with `{word}`")),
            Self::File(error) => error,
        }
    }
}

impl From<ImportError> for Fault {
    fn from(error: ImportError) -> Self {
        match error {
            ImportError::NotFinite => {
                Self::Line("a vertex is not at a finite place".to_owned(), "finite numbers".to_owned())
            }
            other => Self::File(other),
        }
    }
}

#[derive(Default)]
struct Reader {
    gathered: Gathered,
    cutter: Cutter,
    /// Whether a line was one of this format.
    is_obj: bool,
    /// Whether there are levels of detail: then the finest alone is read.
    has_levels: bool,
    /// Whether the object, and the group, are passed over.
    hides_object: bool,
    hides_group: bool,
    /// The corners of the present face, and where they are.
    corners: Vec<u32>,
    places: Vec<Vec3>,
    triangles: Vec<[usize; 3]>,
}

impl Reader {
    fn line<'a>(
        &mut self,
        keyword: &[u8],
        words: impl Iterator<Item = &'a [u8]>,
        budget: &mut Budget,
    ) -> Result<(), Fault> {
        // Editors of text put a mark before the first one.
        match keyword.strip_prefix(b"\xef\xbb\xbf").unwrap_or(keyword) {
            b"v" => self.vertex(words, budget)?,
            b"f" | b"fo" => self.face(words, budget)?,
            b"o" => self.hides_object = self.hides(words),
            b"g" => self.hides_group = self.hides(words),
            _ if keyword.starts_with(b"#") => return Ok(()),
            _ if self.is_obj || PASSED_OVER.iter().any(|known| known.as_bytes() == keyword) => {}
            _ => return Err(Fault::NotObj(excerpt(keyword))),
        }
        self.is_obj = true;
        Ok(())
    }

    /// A place, and perhaps a weight or a colour.
    fn vertex<'a>(
        &mut self,
        mut words: impl Iterator<Item = &'a [u8]>,
        budget: &mut Budget,
    ) -> Result<(), Fault> {
        let mut place = [0.0; 3];
        for part in &mut place {
            let word = words.next().unwrap_or_default();
            let number = str::from_utf8(word).ok().and_then(|word| word.parse().ok());
            *part = number.ok_or_else(|| {
                Fault::Line(
                    format!("a vertex has `{}`, which is no number", excerpt(word)),
                    "three numbers".to_owned(),
                )
            })?;
        }
        budget.spend(1)?;
        self.gathered.vertex(Vec3::from(place), budget)?;
        Ok(())
    }

    /// The corners of a face: numbers of vertices, which may be followed by others.
    fn face<'a>(&mut self, words: impl Iterator<Item = &'a [u8]>, budget: &mut Budget) -> Result<(), Fault> {
        if self.hides_object || self.hides_group {
            return Ok(());
        }
        let vertices = self.gathered.vertices();
        self.corners.clear();
        self.places.clear();
        for word in words {
            let number = word.split(|&letter| letter == b'/').next().unwrap_or_default();
            let number: Option<i64> = str::from_utf8(number).ok().and_then(|number| number.parse().ok());
            let index = number.and_then(|number| match number {
                // From the last one back.
                ..0 => vertices.len().checked_sub(usize::try_from(number.unsigned_abs()).ok()?),
                _ => usize::try_from(number).ok()?.checked_sub(1),
            });
            let place = index.and_then(|index| Some((index, *vertices.get(index)?)));
            let (index, place) = place.ok_or_else(|| {
                let allowed = format!("1 to {0}, or -1 to -{0}", vertices.len());
                Fault::Line(format!("a face has corner `{}`", excerpt(word)), allowed)
            })?;
            self.corners.push(index as u32);
            self.places.push(place);
        }
        if self.corners.len() < 3 {
            return Err(Fault::Line(
                format!("a face has {} corners", self.corners.len()),
                "at least three corners".to_owned(),
            ));
        }
        budget.spend(self.corners.len())?;
        self.gathered.check_room(self.corners.len() - 2, budget)?;
        self.cutter.cut(&self.places, &mut self.triangles);
        for corners in &self.triangles {
            self.gathered.triangle(corners.map(|corner| self.corners[corner]), budget)?;
        }
        Ok(())
    }

    /// Whether what has this name is passed over.
    fn hides<'a>(&mut self, words: impl Iterator<Item = &'a [u8]>) -> bool {
        let names: Vec<_> = words.map(String::from_utf8_lossy).collect();
        let levels = || names.iter().filter_map(|name| levels::level(name));
        self.has_levels |= levels().any(|level| level == 0);
        names.iter().any(|name| levels::is_hull(name)) || self.has_levels && levels().any(|level| level > 0)
    }
}

/// As much of a word as a message tells again.
fn excerpt(word: &[u8]) -> String {
    const LONGEST: usize = 40;
    String::from_utf8_lossy(&word[..word.len().min(LONGEST)]).chars().filter(|c| !c.is_control()).collect()
}
