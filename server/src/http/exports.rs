//! The tree as a file, in any format: made on disk beneath those who draw, sent as it is read from there.

use std::{
    collections::BTreeMap,
    fs::File,
    io::{self, Read},
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicU64, Ordering},
    },
};

use axum::{
    Json,
    body::{Body, Bytes},
    extract::{FromRequestParts, State},
    http::{HeaderMap, HeaderName, header, request::Parts},
    response::Response,
};
use espalier_proto::{
    Problem, Reason,
    library::{ExportFormat, ExportProgress},
    reading,
};
use futures_util::stream;
use serde::Deserialize;
use tokio::{
    runtime::Handle,
    sync::{oneshot, watch},
    task::spawn_blocking,
};
use tokio_util::sync::CancellationToken;

use super::{
    Shared,
    failure::{Failure, Path},
    file_name, ranges,
    sending::{Made, Ready, Sending},
    sessions::{open, saved_document, unreadable},
    trees,
    turns::{Place, Turn},
};
use crate::{
    access::Caller,
    document::{FileError, Stored},
    export_options::{ExportOptions, NotOfFormat, option},
    formats::{FORMATS, FormatRow},
    memory::{Memory, Use},
    spool::{InRoom, Room, Rooms, Spool},
    store::Library,
};

/// Bytes read from the disk at once.
pub(super) const PIECE: usize = 256 * 1024;
/// Bytes of files on the disk that are made for one person and sent to them,
const BYTES_OF_ONE: u64 = 12 << 30;
/// and for all.
const MOST_BYTES: u64 = 16 << 30;
/// Pixels of all pictures of a file together: nobody waits for hours for those of another.
const MOST_DRAWN: u64 = 400_000_000;
/// Characters of a ticket: so many that nobody guesses one.
const TICKET: std::ops::RangeInclusive<usize> = 16..=64;

/// How far exports are, by the ticket that was given with each.
#[derive(Clone, Debug, Default)]
pub struct Progresses(Arc<Mutex<BTreeMap<String, Arc<Progress>>>>);

/// Bytes of a file that is being made.
#[derive(Debug)]
struct Progress {
    written: watch::Sender<u64>,
    expected: AtomicU64,
    /// Where it stands among those that are to be made.
    place: Place,
}

/// Room on the disk for what is downloaded.
pub fn rooms() -> Rooms {
    Rooms::new(BYTES_OF_ONE, MOST_BYTES)
}

/// Takes a ticket back when the export is done or given up.
struct Held(Progresses, String);

impl Drop for Held {
    fn drop(&mut self) {
        self.0.lock().remove(&self.1);
    }
}

impl Progresses {
    fn lock(&self) -> std::sync::MutexGuard<'_, BTreeMap<String, Arc<Progress>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn hold(&self, ticket: Option<String>, place: Place) -> Result<(Arc<Progress>, Option<Held>), Failure> {
        let (written, expected) = (watch::Sender::default(), AtomicU64::default());
        let progress = Arc::new(Progress { written, expected, place });
        let Some(ticket) = ticket else { return Ok((progress, None)) };
        if !TICKET.contains(&ticket.len()) || self.lock().contains_key(&ticket) {
            let allowed =
                format!("{} to {} characters that no other export has", TICKET.start(), TICKET.end());
            return Err(Problem::out_of_range("ticket", "of no use", allowed).into());
        }
        self.lock().insert(ticket.clone(), Arc::clone(&progress));
        Ok((progress, Some(Held(self.clone(), ticket))))
    }
}

/// What stands behind the question mark of a download: options of its format, and by which name the client asks how far
/// it is (`EX3`).
#[derive(Default)]
pub(super) struct Wish {
    options: ExportOptions,
    ticket: Option<String>,
}

#[derive(Deserialize)]
struct Ticket {
    ticket: Option<String>,
}

impl<S: Send + Sync> FromRequestParts<S> for Wish {
    type Rejection = Failure;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Failure> {
        let query = parts.uri.query().unwrap_or_default();
        let is_ticket = |part: &&str| part.split('=').next() == Some("ticket");
        let (tickets, options): (Vec<&str>, Vec<&str>) = query.split('&').partition(is_ticket);
        let Ticket { ticket } = reading::from_query(&tickets.join("&"))?;
        Ok(Self { options: reading::from_query(&options.join("&"))?, ticket })
    }
}

/// What can be asked for (`EX1`).
pub(super) async fn formats() -> Json<Vec<ExportFormat>> {
    Json(FORMATS.iter().map(FormatRow::described).collect())
}

/// How far an export of a session is (`EX3`).
pub(super) async fn progress(
    State(shared): State<Shared>,
    Path((_, ticket)): Path<(String, String)>,
) -> Result<Json<ExportProgress>, Failure> {
    progress_of(&shared, &ticket)
}

/// How far an export of a version is (`EX3`).
pub(super) async fn progress_of_version(
    State(shared): State<Shared>,
    Path((_, _, ticket)): Path<(String, u32, String)>,
) -> Result<Json<ExportProgress>, Failure> {
    progress_of(&shared, &ticket)
}

fn progress_of(shared: &Shared, ticket: &str) -> Result<Json<ExportProgress>, Failure> {
    let found = shared.progresses.lock().get(ticket).cloned();
    let found = found.ok_or_else(|| {
        Failure::none_such("export", "ticket", "the ticket of an export that is being made")
    })?;
    let written = *found.written.borrow();
    let expected = found.expected.load(Ordering::Relaxed).max(written);
    let ahead = u32::try_from(found.place.ahead()).unwrap_or(u32::MAX);
    Ok(Json(ExportProgress { written, expected, ahead }))
}

/// A session's tree as a file (`EX2`).
pub(super) async fn take(
    State(shared): State<Shared>,
    Path(session): Path<String>,
    caller: Caller,
    (wish, asked): (Wish, HeaderMap),
    row: &'static FormatRow,
) -> Result<Response, Failure> {
    let wanted = Wanted::of(&shared, &caller, row, wish)?;
    let turn = wanted.progress.place.turn().await;
    let document = open(&shared, &session).await?.read().await?;
    let tree = match shared.store.tree_of(&session).await? {
        Some(tree) => shared.store.tree(&tree.id).await?.map(|tree| tree.name),
        None => None,
    };
    wanted.sent(&shared, turn, (&session, &tree.unwrap_or_default()), document.bytes, &asked).await
}

/// A version of a saved tree as a file (`EX4`).
pub(super) async fn take_version(
    State(shared): State<Shared>,
    Path((tree, number)): Path<(String, u32)>,
    caller: Caller,
    (wish, asked): (Wish, HeaderMap),
    row: &'static FormatRow,
) -> Result<Response, Failure> {
    let wanted = Wanted::of(&shared, &caller, row, wish)?;
    let turn = wanted.progress.place.turn().await;
    let document = saved_document(&shared, &tree, number).await?;
    let name = name_of(&shared, &tree, number).await?;
    wanted.sent(&shared, turn, (&tree, &name), document.bytes, &asked).await
}

/// What files of a version are called: as the tree, with the number where it is not the newest.
pub(super) async fn name_of(shared: &Shared, tree: &str, number: u32) -> Result<String, Failure> {
    let tree = trees::stored(shared, tree).await?;
    Ok(if tree.head.number == number { tree.name } else { format!("{} v{number}", tree.name) })
}

/// A file that is asked for.
struct Wanted {
    row: &'static FormatRow,
    options: ExportOptions,
    progress: Arc<Progress>,
    held: Option<Held>,
    /// What it takes of the disk.
    room: Arc<Room>,
}

impl Wanted {
    fn of(shared: &Shared, caller: &Caller, row: &'static FormatRow, wish: Wish) -> Result<Self, Failure> {
        let Wish { options, ticket } = wish;
        let pixels = checked(row, &options)?;
        let place = shared.turns.come(caller.person(), pixels);
        let (progress, held) = shared.progresses.hold(ticket, place)?;
        let room = shared.rooms.of(caller.person());
        Ok(Self { row, options, progress, held, room })
    }

    /// Makes it of the bytes of a document, which the server and people call so, and sends it.
    async fn sent(
        self,
        shared: &Shared,
        turn: Turn,
        (name, tree): (&str, &str),
        bytes: impl AsRef<[u8]> + Send + 'static,
        asked: &HeaderMap,
    ) -> Result<Response, Failure> {
        let Self { row, options, progress, held, room } = self;
        let claim = shared.memory.take_soon(Use::Export, row.weight(bytes.as_ref().len(), &options)).await?;
        // The same program makes the same file of the same document.
        let said = format!("{options:?}");
        let program = env!("CARGO_PKG_VERSION");
        let tag = ranges::tag(&[program.as_bytes(), row.ending.as_bytes(), said.as_bytes(), bytes.as_ref()]);
        let headers = headers(row, tree);
        if ranges::is_known(asked, &tag) {
            return Ok(ranges::not_modified(headers, &tag));
        }
        let (out, reader) = on_disk(row.format.is_forward() && !asked.contains_key(header::RANGE))
            .map_err(|error| not_made(name, &error.into()))?;
        // Whoever goes away takes this along, and with it what is being made.
        let stop = CancellationToken::new();
        let gone = stop.clone().drop_guard();
        let (made, whether_made) = oneshot::channel();
        let sending = Sending {
            written: progress.written.subscribe(),
            made: whether_made,
            gone,
            room: Arc::clone(&room),
        };
        let of_writer = Arc::clone(&room);
        let (pool, memory, of_tree) = (shared.pool.clone(), shared.memory.clone(), name.to_owned());
        spawn_blocking(move || {
            let out = Spool::new(out, pool, stop, progress.written.clone()).in_room(of_writer);
            let file = make(bytes.as_ref(), row, &options, (&progress.expected, &memory), out);
            drop((bytes, held, claim, progress, turn));
            if let Err(Err(error)) = made.send(file) {
                tracing::debug!(name = of_tree, %error, "an export was given up");
            }
        });
        match sending.ready(reader).await {
            Ready::Whole(Ok(Ok((file, length)))) => {
                ranges::answer(asked, headers, &tag, InRoom::new(file, room), length)
            }
            Ready::Whole(Ok(Err(FileError::Document(error)))) => Err(unreadable(name, &error)),
            Ready::Whole(Ok(Err(FileError::Memory(full)))) => Err(full.into()),
            Ready::Whole(Ok(Err(error))) => Err(not_made(name, &error)),
            Ready::Whole(Err(_)) => Err(crate::pool::Panicked.into()),
            Ready::Begun(body) => Ok(ranges::begun(headers, &tag, body)),
        }
    }
}

fn not_made(name: &str, error: &FileError) -> Failure {
    tracing::error!(name, %error, "a document cannot be exported");
    if error.on_disk() == Some(io::ErrorKind::QuotaExceeded) {
        let [one, all] = [BYTES_OF_ONE, MOST_BYTES].map(|bytes| bytes >> 30);
        let sentence = format!(
            "The tree cannot be exported now: files that you download have {one} GiB on the server's disk, or those of \
             all {all} GiB; try again when they have arrived."
        );
        return Failure::new(Reason::NotExported, sentence);
    }
    if error.on_disk() == Some(io::ErrorKind::StorageFull) {
        return Failure::new(
            Reason::NotExported,
            "The tree cannot be exported: the disk of the server is full.",
        );
    }
    Failure::new(Reason::NotExported, "The tree cannot be exported.")
}

/// An empty file that is gone with its handles, and where it is sent while it is written another handle to read it by.
pub(super) fn on_disk(is_sent_meanwhile: bool) -> io::Result<(File, Option<File>)> {
    if !is_sent_meanwhile {
        return Ok((tempfile::tempfile()?, None));
    }
    let named = tempfile::NamedTempFile::new()?;
    let reader = named.reopen()?;
    let (file, path) = named.into_parts();
    path.close()?;
    Ok((file, Some(reader)))
}

/// What is said of a file of this tree that is sent.
pub(super) fn headers(row: &FormatRow, tree: &str) -> [(HeaderName, String); 2] {
    [
        (header::CONTENT_TYPE, row.media_type.to_owned()),
        (header::CONTENT_DISPOSITION, file_name::attachment(tree, row.ending)),
    ]
}

/// What is read, as the body of an answer: a piece at a time, when the one before has been taken. No thread waits for
/// whoever reads slowly.
pub(super) fn body_of(file: impl Read + Send + 'static) -> Body {
    Body::from_stream(stream::try_unfold(file, async |file| {
        let (piece, file) = piece_of(file, PIECE as u64).await?;
        Ok::<_, io::Error>((!piece.is_empty()).then_some((piece, file)))
    }))
}

/// What is read next, so many bytes at most; none at the end.
pub(super) async fn piece_of<F: Read + Send + 'static>(mut file: F, most: u64) -> io::Result<(Bytes, F)> {
    let read = spawn_blocking(move || {
        let mut piece = vec![0; usize::try_from(most).map_or(PIECE, |most| most.min(PIECE))];
        let count = file.read(&mut piece)?;
        piece.truncate(count);
        Ok((Bytes::from(piece), file))
    });
    read.await.map_err(io::Error::other)?
}

fn make(
    bytes: &[u8],
    row: &FormatRow,
    options: &ExportOptions,
    (expected, memory): (&AtomicU64, &Memory),
    mut out: Spool,
) -> Made {
    let mut stored = Stored::read(bytes)?;
    expected.store(stored.expected(row, options), Ordering::Relaxed);
    let held = stored.held(row, options);
    let _held = Handle::current().block_on(memory.take_soon(Use::Export, held))?;
    stored.write(row.format, options, &mut out)?;
    Ok(out.into_file()?)
}

/// Checks that a format has these options, and that no more is drawn for a file than may be (`EX6`); how many pixels are.
pub(super) fn checked(row: &FormatRow, options: &ExportOptions) -> Result<u64, Problem> {
    options.check(row.options).map_err(|error| not_of(row, &error))?;
    let pixels = row.pixels(options);
    if pixels > MOST_DRAWN {
        let allowed = format!("so many pictures that all together have {MOST_DRAWN} pixels at most");
        return Err(Problem::out_of_range(option::FRAMES, format!("too many for {pixels} pixels"), allowed));
    }
    Ok(pixels)
}

fn not_of(row: &FormatRow, error: &NotOfFormat) -> Problem {
    let allowed = if row.options.is_empty() { "no option".to_owned() } else { row.options.join(", ") };
    let message = format!("The export cannot be done: {error}; allowed: {allowed}.");
    Problem::new(Reason::NoSuchOption, message).at(error.option(), allowed)
}
