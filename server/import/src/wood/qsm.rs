//! Quantitative structure models: a line for each cylinder, with the columns of one of the programs that make them.

use std::collections::{BTreeMap, BTreeSet};

use csv::{ErrorKind, ReaderBuilder, StringRecord};
use glam::DVec3;

use super::{
    Fault, MAX_COLUMNS, Place, Units, WoodOptions, excerpt, malformed, number, out_of_range,
    pieces::{Piece, y_up},
    too_many, too_many_columns,
};

/// How a program names its columns.
struct Dialect {
    name: &'static str,
    /// Numbers of cylinders; those of the lines, from 1, where there is no such column.
    id: Option<&'static str>,
    parent: &'static str,
    start: [&'static str; 3],
    axis: [&'static str; 3],
    end: [&'static str; 3],
    radius: &'static str,
    length: &'static str,
    branch: &'static str,
    order: &'static str,
}

impl Dialect {
    /// Whether a column of this name is read.
    fn reads(&self, name: &str) -> bool {
        let vectors = [self.start, self.axis, self.end].into_iter().flatten();
        let plain = [self.parent, self.radius, self.length, self.branch, self.order].into_iter();
        vectors.chain(plain).chain(self.id).any(|column| column == name)
    }
}

const DIALECTS: [Dialect; 5] = [
    Dialect {
        name: "TreeQSM",
        id: None,
        parent: "parent",
        start: ["start.x", "start.y", "start.z"],
        axis: ["axis.x", "axis.y", "axis.z"],
        end: ["end.x", "end.y", "end.z"],
        radius: "radius",
        length: "length",
        branch: "branch",
        order: "BranchOrder",
    },
    Dialect {
        name: "rTwig",
        id: Some("id"),
        parent: "parent",
        start: ["start_x", "start_y", "start_z"],
        axis: ["axis_x", "axis_y", "axis_z"],
        end: ["end_x", "end_y", "end_z"],
        radius: "radius",
        length: "length",
        branch: "branch",
        order: "branch_order",
    },
    Dialect {
        name: "SimpleForest",
        id: Some("ID"),
        parent: "parentID",
        start: ["startX", "startY", "startZ"],
        axis: ["axisX", "axisY", "axisZ"],
        end: ["endX", "endY", "endZ"],
        radius: "radius",
        length: "length",
        branch: "branchID",
        order: "branchOrder",
    },
    Dialect {
        name: "Treegraph",
        id: Some("p1"),
        parent: "p2",
        start: ["sx", "sy", "sz"],
        axis: ["ax", "ay", "az"],
        end: ["ex", "ey", "ez"],
        radius: "radius",
        length: "length",
        branch: "nbranch",
        order: "branch_order",
    },
    Dialect {
        name: "aRchi",
        id: Some("cyl_ID"),
        parent: "parent_ID",
        start: ["startX", "startY", "startZ"],
        axis: ["axisX", "axisY", "axisZ"],
        end: ["endX", "endY", "endZ"],
        radius: "radius_cyl",
        length: "length",
        branch: "branch_ID",
        order: "branching_order",
    },
];

/// The cylinders of a file.
pub(super) fn read(bytes: &[u8], options: &WoodOptions) -> Result<Vec<Piece>, Fault> {
    // A mark that some programs put before text.
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let head = bytes.split(|&byte| byte == b'\n').next().unwrap_or_default();
    let count = |mark: u8| head.iter().filter(|&&byte| byte == mark).count();
    let delimiter =
        [b',', b';', b'\t'].into_iter().max_by_key(|&mark| (count(mark), mark == b',')).unwrap_or(b',');
    // Before cells are made of them; those that quotes hold together count as well.
    if count(delimiter) >= MAX_COLUMNS {
        return Err(too_many_columns(1));
    }
    let mut reader = ReaderBuilder::new().delimiter(delimiter).from_reader(bytes);
    let table = Table::of(reader.headers().map_err(|error| unreadable(&error))?)?;
    let mut rows = Vec::new();
    let mut record = StringRecord::new();
    while reader.read_record(&mut record).map_err(|error| unreadable(&error))? {
        if rows.len() >= options.nodes {
            let line = record.position().map(|position| Place::Line(position.line()));
            return Err(too_many(line, options));
        }
        if delimiter != b',' {
            record = with_points(&record);
        }
        rows.push(table.row(&record, options.units, rows.len())?);
    }
    pieces(&rows)
}

/// A line whose numbers have points, which many programs write as commas where commas do not separate cells.
fn with_points(record: &StringRecord) -> StringRecord {
    let mut pointed: StringRecord = record.iter().map(|cell| cell.replace(',', ".")).collect();
    pointed.set_position(record.position().cloned());
    pointed
}

fn unreadable(error: &csv::Error) -> Fault {
    let place = error.position().map(|position| Place::Line(position.line()));
    match error.kind() {
        ErrorKind::UnequalLengths { expected_len, len, .. } => {
            malformed(place, format!("it has {len} cells, and the head has {expected_len}"))
        }
        ErrorKind::Utf8 { .. } => malformed(place, "it is not text in UTF-8"),
        _ => malformed(place, "it is no table of comma-separated values"),
    }
}

/// Where the columns are.
struct Table {
    dialect: &'static Dialect,
    id: Option<usize>,
    parent: usize,
    start: [usize; 3],
    end: End,
    radius: usize,
    branch: Option<usize>,
    order: Option<usize>,
}

/// How a file says where a cylinder ends.
enum End {
    At([usize; 3]),
    Along([usize; 3], usize),
}

/// One line.
struct Row {
    line: u64,
    id: i64,
    parent: Option<i64>,
    start: DVec3,
    end: DVec3,
    radius: f64,
    /// The column of the radius, from 1.
    thickness: u64,
    branch: Option<i64>,
    order: Option<i64>,
}

impl Table {
    fn of(head: &StringRecord) -> Result<Self, Fault> {
        if head.len() > MAX_COLUMNS {
            return Err(too_many_columns(1));
        }
        let mut tables = DIALECTS.iter().filter_map(|dialect| Self::by(dialect, head));
        let table = tables.next().ok_or_else(|| {
            if head.iter().all(|name| name.trim().is_empty()) {
                return malformed(Some(Place::Line(1)), "it has no columns; the first line must name them");
            }
            let names = DIALECTS.each_ref().map(|dialect| dialect.name).join(", ");
            let found: Vec<_> = head.iter().take(12).map(|name| format!("`{}`", excerpt(name))).collect();
            let what = format!("its columns are not those of a QSM by {names}: {}", found.join(", "));
            malformed(Some(Place::Line(1)), what)
        })?;
        // Which of two columns is meant nobody can say.
        let mut before = BTreeSet::new();
        for (at, name) in head.iter().enumerate() {
            let is_second = !before.insert(name.trim());
            if is_second && table.dialect.reads(name.trim()) {
                let what = format!("there are two columns `{}`", excerpt(name.trim()));
                return Err(malformed(Some(Place::Cell(1, at as u64 + 1)), what));
            }
        }
        Ok(table)
    }

    fn by(dialect: &'static Dialect, head: &StringRecord) -> Option<Self> {
        let find = |name: &str| head.iter().position(|column| column.trim() == name);
        let three = |[x, y, z]: [&str; 3]| Some([find(x)?, find(y)?, find(z)?]);
        let id = match dialect.id {
            Some(name) => Some(find(name)?),
            None => None,
        };
        let along = || Some(End::Along(three(dialect.axis)?, find(dialect.length)?));
        Some(Self {
            dialect,
            id,
            parent: find(dialect.parent)?,
            start: three(dialect.start)?,
            end: three(dialect.end).map(End::At).or_else(along)?,
            radius: find(dialect.radius)?,
            branch: find(dialect.branch),
            order: find(dialect.order),
        })
    }

    fn row(&self, record: &StringRecord, units: Units, above: usize) -> Result<Row, Fault> {
        let line = record.position().map_or(0, csv::Position::line);
        let place = |column: usize| Place::Cell(line, column as u64 + 1);
        let cell = |column: usize| record.get(column).unwrap_or_default();
        let float = |column: usize, name: &str| number(cell(column), place(column), name);
        let whole = |column: usize, name: &str| -> Result<Option<i64>, Fault> {
            // R writes NA for what is not there.
            if matches!(cell(column).trim(), "" | "NA") {
                return Ok(None);
            }
            let read = float(column, name)?;
            if read.fract() != 0.0 || read.abs() > 1e15 {
                let what = format!("{name} is {read}");
                return Err(out_of_range(Some(place(column)), what, "whole numbers"));
            }
            Ok(Some(read as i64))
        };
        let vector = |columns: [usize; 3], names: [&str; 3]| -> Result<DVec3, Fault> {
            let [x, y, z] = [0, 1, 2].map(|axis| float(columns[axis], names[axis]));
            Ok(y_up([x?, y?, z?]))
        };
        let Dialect { id, parent, start, axis, end, radius, length, branch, order, .. } = *self.dialect;
        let from = vector(self.start, start)?;
        let to = match self.end {
            End::At(columns) => vector(columns, end)?,
            End::Along(columns, column) => {
                let (along, far) = (vector(columns, axis)?, float(column, length)?);
                if far < 0.0 {
                    let what = format!("{length} is {far}");
                    return Err(out_of_range(Some(place(column)), what, "0 and more"));
                }
                if far > 0.0 && along.length_squared() <= 0.0 {
                    let allowed = "a unit vector from its start to its end";
                    return Err(out_of_range(Some(place(columns[0])), "its axis is 0, 0, 0", allowed));
                }
                from + along * far
            }
        };
        let thick = float(self.radius, radius)?;
        if thick <= 0.0 {
            let what = format!("{radius} is {thick}");
            return Err(out_of_range(Some(place(self.radius)), what, "more than 0"));
        }
        let own = match self.id {
            Some(column) => whole(column, id.unwrap_or_default())?,
            None => None,
        };
        let known = |column: Option<usize>, name: &str| column.map_or(Ok(None), |column| whole(column, name));
        Ok(Row {
            line,
            id: own.unwrap_or(above as i64 + 1),
            parent: whole(self.parent, parent)?,
            start: from * units.length,
            end: to * units.length,
            radius: thick * units.diameter,
            thickness: self.radius as u64 + 1,
            branch: known(self.branch, branch)?,
            order: known(self.order, order)?,
        })
    }
}

/// The rows with their parents found, and who continues whom.
fn pieces(rows: &[Row]) -> Result<Vec<Piece>, Fault> {
    let mut places: BTreeMap<i64, u32> = BTreeMap::new();
    for (row, at) in rows.iter().zip(0..) {
        if places.insert(row.id, at).is_some() {
            return Err(malformed(
                Some(Place::Line(row.line)),
                format!("cylinder {} is there twice", row.id),
            ));
        }
    }
    let parent = |row: &Row| match row.parent {
        // Numbers begin at 0 or 1; what is below is none.
        Some(id) => match places.get(&id) {
            Some(&parent) => Ok(Some(parent)),
            None if id <= 0 => Ok(None),
            None => {
                let what = format!("its parent {id} is not there");
                Err(malformed(Some(Place::Line(row.line)), what))
            }
        },
        None => Ok(None),
    };
    let mut pieces = Vec::with_capacity(rows.len());
    // For each cylinder the one that continues it, so far.
    let mut next: Vec<Option<u32>> = vec![None; rows.len()];
    for (row, at) in rows.iter().zip(0u32..) {
        let parent = parent(row)?;
        if let Some(below) = parent {
            // Without branches the thickest goes on.
            let is_one = |at: u32| {
                let (other, below) = (&rows[at as usize], &rows[below as usize]);
                other.branch == below.branch && other.order == below.order
            };
            let rank = |at: u32| (is_one(at), rows[at as usize].radius);
            let best = &mut next[below as usize];
            if is_one(at) && best.is_none_or(|best| rank(at) > rank(best)) {
                *best = Some(at);
            }
        }
        pieces.push(Piece {
            parent,
            continues: false,
            start: Some(row.start),
            end: row.end,
            radius: Some(row.radius),
            birth: None,
            id: None,
            shed: 0,
            is_whole: false,
            line: row.line,
            thickness: row.thickness,
        });
    }
    for at in next.into_iter().flatten() {
        pieces[at as usize].continues = true;
    }
    Ok(pieces)
}
