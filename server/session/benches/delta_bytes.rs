//! What a session of 235 strokes sends to somebody who is in step with it: bytes of mesh deltas for each new metamer, by
//! what they are about. A clock of its own runs with the strokes, so it prints the same on every machine.
//!
//! With `-- --learn` it draws other trees instead, and writes what is usual in their frames into
//! `proto/priors.txt`, from which frames are packed (`FR9`).

use std::{fmt::Debug, path::Path};

use espalier_growth::species::{self, Species};
use espalier_plant::MetamerId;
use espalier_proto::{
    Action, ChunkChange, ClientMessage, Frame, FrameKind,
    access::Role,
    frame::{Column, HEADER_BYTES},
    packing::Tally,
    varint,
    version::PROTOCOL_VERSION,
};
use espalier_session::{ClientId, Entrant, Input, Output, Session, Work, script};
use glam::Vec3;
use serde_json::{Value, json};

const STROKES: u32 = 235;
/// A page sends parts of strokes so often, in milliseconds.
const TICK_MS: u64 = 33;
/// What a hand does between two strokes.
const PAUSES_MS: [u64; 5] = [400, 900, 600, 2_500, 700];
/// How long the disk and a slice of work take.
const WRITE_MS: u64 = 5;
const WORK_MS: u64 = 3;
/// Radii of brushes, by turns; 0 is a pencil.
const RADII: [f32; 6] = [3.0, 2.0, 0.0, 4.0, 2.5, 1.5];
/// Lengths of strokes.
const LENGTHS: [f32; 4] = [12.0, 8.0, 18.0, 10.0];
/// How fast a hand is, in internodes a second.
const SPEED: f32 = 20.0;

/// The seed of the tree that is measured.
const MEASURED: u32 = 7;
/// Others, to learn from: so many of the species, each with a seed of its own.
const LEARNED: usize = 8;

fn main() -> std::io::Result<()> {
    if !std::env::args().any(|argument| argument == "--learn") {
        let (before, sent) = measured();
        sent.report(&before);
        return Ok(());
    }
    let mut tally = Tally::default();
    for (number, species) in species::all().iter().take(LEARNED).enumerate() {
        tally.add(&draw(Some(species), MEASURED + 1 + number as u32).1.tally);
    }
    let priors = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../proto/priors.txt");
    std::fs::write(priors, tally.priors())
}

/// What is sent of the tree that is measured: before the first stroke, and with all of them.
pub(crate) fn measured() -> (Sent, Sent) {
    draw(None, MEASURED)
}

/// What was sent before the first stroke, and with all of them.
fn draw(species: Option<&Species>, seed: u32) -> (Sent, Sent) {
    let mut studio = Studio::open(seed);
    // What a picker sets, without the growth to its age.
    for action in species.map(script).iter().flatten().filter(|action| !matches!(action, Action::Grow { .. }))
    {
        studio.command(&json!(action));
    }
    studio.command(&json!({ "kind": "grow", "steps": 6 }));
    studio.pass(2_000);
    let before = studio.sent.clone();
    for stroke in 0..STROKES {
        studio.draw(stroke);
        studio.pass(PAUSES_MS[stroke as usize % PAUSES_MS.len()]);
        if stroke % 40 == 39 {
            studio.command(&json!({ "kind": "undo" }));
            studio.pass(700);
        }
    }
    studio.pass(5_000);
    (before, studio.sent)
}

/// Bytes, by what they are about.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sent {
    frames: u64,
    /// As they travel, with headers.
    bytes: u64,
    /// As they travel, without them.
    bodies: u64,
    appended_rows: u64,
    appended: u64,
    /// Of each column: values, and bytes before deflating with what says which rows they are of.
    patched: [(u64, u64); 6],
    other: u64,
    tally: Tally,
}

impl Sent {
    fn take(&mut self, bytes: &[u8]) {
        let frame = Frame::decode(bytes).expect("every frame is valid");
        self.frames += 1;
        self.bytes += bytes.len() as u64;
        self.bodies += (bytes.len() - header_of(bytes)) as u64;
        frame.count_into(&mut self.tally);
        for change in frame.changes {
            let alone = Frame { changes: vec![change.clone()], ..Frame { changes: Vec::new(), ..frame } };
            let length = alone.body().len() as u64;
            match change {
                ChunkChange::Append { rows, .. } => {
                    self.appended += length;
                    self.appended_rows += rows.len() as u64;
                }
                ChunkChange::Patch { values, .. } => {
                    let (count, bytes) = &mut self.patched[values.column() as usize];
                    *count += values.len() as u64;
                    *bytes += length;
                }
                ChunkChange::Truncate { .. } | ChunkChange::Replace { .. } => self.other += length,
            }
        }
    }

    /// So many bytes for each metamer that is new since then.
    pub(crate) fn a_metamer(&self, before: &Self, bytes: u64) -> f64 {
        bytes as f64 / (self.appended_rows - before.appended_rows) as f64
    }

    /// Bytes that travelled since then.
    pub(crate) fn bytes_since(&self, before: &Self) -> u64 {
        self.bytes - before.bytes
    }

    fn report(&self, before: &Self) {
        let rows = self.appended_rows - before.appended_rows;
        let line = |what: &str, bytes: u64| {
            println!("  {what:<34} {bytes:>9} {:>7.2}", self.a_metamer(before, bytes));
        };
        println!(
            "{STROKES} strokes, {rows} new metamers, {} frames     bytes  a metamer",
            self.frames - before.frames
        );
        line("all, as it travels", self.bytes_since(before));
        line("  of which headers", (self.bytes - self.bodies) - (before.bytes - before.bodies));
        line("  of which bodies", self.bodies - before.bodies);
        println!("bodies before deflating, by what they are about");
        line("new rows", self.appended - before.appended);
        for column in [Column::Position, Column::Radius, Column::Foliage, Column::Light] {
            let ((count, bytes), (earlier, less)) =
                (self.patched[column as usize], before.patched[column as usize]);
            line(&format!("{column:?} of {} older rows", count - earlier), bytes - less);
        }
        line("other", self.other - before.other);
    }
}

/// The length of what comes before the body of a frame.
fn header_of(frame: &[u8]) -> usize {
    let mut rest = &frame[HEADER_BYTES..];
    let [_sequence, _length] = [(); 2].map(|()| varint::read(&mut rest).expect("a varint"));
    frame.len() - rest.len()
}

/// A session in which one person draws.
struct Studio {
    session: Session,
    now: u64,
    writing: Option<(u64, u64)>,
    working: Option<(u64, Box<Work>)>,
    wake_at: Option<u64>,
    next: u32,
    answers: Vec<Input>,
    sent: Sent,
}

const HAND: ClientId = ClientId(1);

impl Studio {
    fn open(seed: u32) -> Self {
        let session = Session::restore("bench", 1, None, seed, []).expect("a seedling");
        let mut studio = Self {
            session,
            now: 0,
            writing: None,
            working: None,
            wake_at: None,
            next: 1,
            answers: Vec::new(),
            sent: Sent::default(),
        };
        studio.handle(Input::Connected(HAND, Entrant::new("hand", Role::Editor)));
        studio.say(&json!(ClientMessage::Hello {
            protocol: PROTOCOL_VERSION,
            client: "bench-01".into(),
            resume: None
        }));
        studio
    }

    /// A stroke that begins at the outermost wood in some direction and leads outwards and upwards.
    fn draw(&mut self, stroke: u32) {
        let outwards = direction(stroke);
        let from = self.outermost(outwards, stroke);
        let aside = outwards.cross(Vec3::Y).normalize_or_zero();
        let bow = [-0.35, 0.2, 0.0, 0.35, -0.15][stroke as usize % 5];
        let radius = RADII[stroke as usize % RADII.len()];
        let length = LENGTHS[stroke as usize % LENGTHS.len()];
        let parts = (1e3 * length / SPEED / TICK_MS as f32) as u32;
        self.command(&json!({ "kind": "stroke_begin", "stroke": stroke }));
        for part in 0..=parts {
            let share = part as f32 / parts as f32;
            let way = outwards * share * length + (aside + 0.3 * Vec3::Y) * bow * length * share * share;
            let place = from + way;
            let place = [place.x, place.y.max(0.5), place.z];
            let samples = json!([{ "position": place, "radius": radius }]);
            self.command(&json!({ "kind": "stroke_move", "stroke": stroke, "samples": samples }));
            self.pass(TICK_MS);
        }
        self.command(&json!({ "kind": "stroke_end", "stroke": stroke }));
    }

    /// Somewhere outside on the living wood, not always at the very end.
    fn outermost(&self, outwards: Vec3, stroke: u32) -> Vec3 {
        let plant = self.session.document().expect("nothing is under way").plant();
        let mut ends: Vec<Vec3> = (0..plant.metamer_count())
            .map(MetamerId::new)
            .filter(|&id| plant.is_alive(id))
            .map(|id| plant.metamers().end(id))
            .collect();
        ends.sort_by(|a, b| b.dot(outwards).total_cmp(&a.dot(outwards)));
        ends[(ends.len() - 1).min(3 * (stroke as usize % 7))]
    }

    fn command(&mut self, command: &Value) {
        let id = self.next;
        self.next += 1;
        self.say(&json!({ "type": "command", "id": id, "command": command }));
    }

    fn say(&mut self, message: &Value) {
        self.handle(Input::Text(HAND, message.to_string()));
    }

    fn handle(&mut self, input: Input) {
        self.session.handle(self.now, input);
        while let Some(output) = self.session.poll_output() {
            match output {
                Output::Text(..) => self.answers.push(Input::Written(HAND, 1)),
                Output::Frame(_, bytes) => {
                    if FrameKind::of(&bytes) == Some(FrameKind::MeshDelta) {
                        self.sent.take(&bytes);
                    }
                    let (kind, sequence) = (FrameKind::of(&bytes), FrameKind::sequence_of(&bytes));
                    let answer = json!({ "type": "received", "sequence": sequence, "kind": kind });
                    self.answers.push(Input::Text(HAND, answer.to_string()));
                }
                Output::Volatile(_, bytes) => {
                    let answer =
                        json!({ "type": "received", "sequence": FrameKind::sequence_of(&bytes), "kind": 4 });
                    self.answers.push(Input::Text(HAND, answer.to_string()));
                }
                Output::Journal(entries) => {
                    self.writing = entries.last().map(|entry| (self.now + WRITE_MS, entry.number));
                }
                Output::Work(work) => self.working = Some((self.now + WORK_MS, work)),
                Output::Snapshot { through, .. } => self.answers.push(Input::SnapshotKept(through)),
                Output::Ping(client) => self.answers.push(Input::Heard(client)),
                Output::WakeAt(at) => self.wake_at = Some(at),
                Output::Close(_, code, reason) => panic!("closed: {code:?}, {reason}"),
                _ => {}
            }
        }
    }

    /// Lets time pass, and after it what is still under way.
    fn pass(&mut self, ms: u64) {
        let end = self.now + ms;
        loop {
            if let Some(answer) = self.answers.pop() {
                self.handle(answer);
                continue;
            }
            let write = self.writing.map(|(due, _)| due);
            let work = self.working.as_ref().map(|(due, _)| *due);
            let next = [write, work, self.wake_at].into_iter().flatten().min();
            let Some(due) = next.filter(|&due| due <= end || work.is_some()) else { break };
            self.now = self.now.max(due);
            if write == Some(due) {
                let through = self.writing.take().map_or(0, |(_, through)| through);
                self.handle(Input::Journaled(through));
            } else if work == Some(due) {
                let Some((_, mut work)) = self.working.take() else { break };
                work.run(|| false);
                self.handle(Input::Worked(work));
            } else {
                self.wake_at = None;
                self.handle(Input::Woken);
            }
        }
        self.now = self.now.max(end);
    }
}

/// The k-th of directions around, upwards by turns.
fn direction(k: u32) -> Vec3 {
    let (sin, cos) = libm::sincosf(2.399_963_2 * k as f32);
    let rise = [0.2, 0.7, 0.4, 1.2, 0.1, 0.9][k as usize % 6];
    Vec3::new(cos, rise, sin).normalize()
}
