//! What things take of memory, as it is counted before they are begun ([docs/reliability.md](../../../docs/reliability.md)).

/// A session of a seedling: chunks of space, tables, its task and queues.
const SESSION: u64 = 400_000;
/// A row of a document: plant, grids, canopy, markers, table (some 300 bytes), and its part of a snapshot while one is
/// written.
const ROW: u64 = 400;
/// A row of plants that grow ahead, without a session's table.
const FORESEEN_ROW: u64 = 300;
/// A byte of a document as it is stored: its row in a session, and the byte itself.
const STORED_BYTE: u64 = 6;
/// A socket: its buffers, and what is on its way to a client that reads.
pub const SOCKET: u64 = 64 * 1024;
/// A message that is not whole yet: what has come of the last frame, and the frames before it.
pub const MESSAGE: u64 = 512 * 1024;
/// A file that is made: what is written at once, and textures.
const EXPORT: u64 = 64 << 20;
/// A byte of a document that is exported: the document read again, and the scene of its foliage.
const EXPORTED_BYTE: u64 = 10;
/// A picture that is drawn: what the sun sees, samples, and textures.
const PICTURE: u64 = 128 << 20;
/// A byte of a document that is drawn: all its triangles at once.
const DRAWN_BYTE: u64 = 30;
/// A pixel of a picture: its samples and its colour.
const PIXEL: u64 = 24;
/// A byte of a model that is read: its triangles while they are simplified.
const MODEL_BYTE: u64 = 4;

/// Rows for which memory is taken at once, so that a session that grows asks now and then.
pub const STRIDE: u64 = 512;

/// A session whose document has so many rows.
pub fn session(rows: u64) -> u64 {
    SESSION + rows.saturating_mul(ROW)
}

/// A session that is made of so many bytes of a stored document.
pub fn restore(bytes: usize) -> u64 {
    SESSION + (bytes as u64).saturating_mul(STORED_BYTE)
}

/// Plants of so many rows that grow ahead.
pub fn prediction(rows: u64) -> u64 {
    rows.saturating_mul(FORESEEN_ROW)
}

/// An export of a document of so many bytes.
pub fn export(bytes: usize) -> u64 {
    EXPORT + (bytes as u64).saturating_mul(EXPORTED_BYTE)
}

/// A picture of so many pixels of a document of so many bytes.
pub fn picture(bytes: usize, pixels: usize) -> u64 {
    let drawn = (bytes as u64).saturating_mul(DRAWN_BYTE);
    PICTURE + drawn + (pixels as u64).saturating_mul(PIXEL)
}

/// What people say of a tree, so many bytes: as it is stored, as it is read, and as it is written.
pub fn comments(said: u64) -> u64 {
    said.saturating_mul(3)
}

/// The same as a page with so many bytes of pictures as text, which may have twice the room that it needs.
pub fn review(said: u64, pictures: u64) -> u64 {
    comments(said) + pictures.saturating_mul(3)
}

/// A file of so many bytes that is read.
pub fn upload(bytes: u64) -> u64 {
    bytes.saturating_mul(MODEL_BYTE)
}

/// A document that unpacks to so many bytes and is read, and written again to be kept.
pub fn unpacked(bytes: u64) -> u64 {
    bytes.saturating_mul(STORED_BYTE)
}

/// A tree of so many rows that a job grows.
pub fn job(rows: u64) -> u64 {
    SESSION + rows.saturating_mul(FORESEEN_ROW)
}
