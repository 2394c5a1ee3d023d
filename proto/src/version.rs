//! The protocol's version, its limits, and the codes a socket closes with.

/// The version of everything in this crate; a client states it in its hello (`HS1`).
pub const PROTOCOL_VERSION: u32 = 4;

/// The largest WebSocket message a client may send, in bytes (`LM1`).
pub const MAX_MESSAGE_BYTES: usize = 256 * 1024;

/// The largest number of samples in one `stroke_move` (`LM2`).
pub const MAX_STROKE_SAMPLES: usize = 256;

/// The largest number of steps in one `grow` or `ungrow` (`LM3`).
pub const MAX_STEPS_PER_COMMAND: u32 = 1000;

/// The fewest points of a lasso's outline (`LM5`).
pub const MIN_OUTLINE_POINTS: usize = 3;

/// The most points of a lasso's outline (`LM5`).
pub const MAX_OUTLINE_POINTS: usize = 4096;

/// The most steps that one outline grows for, and a stroke after its end (`LA1`, `CM6`).
pub const MAX_OUTLINE_STEPS: u32 = 400;

/// The most characters of a tree's name (`LM4`).
pub const MAX_NAME_CHARACTERS: usize = 80;

/// The most characters of a note on a tree or a version (`LB5`).
pub const MAX_NOTE_CHARACTERS: usize = 2000;

/// The highest order up to which the limbs of a plant are described by a design (`DS10`).
pub const MAX_LIMB_ORDERS: u32 = 3;

/// The longest that a link may let in, in hours (`AC12`).
pub const MAX_LINK_HOURS: u32 = 365 * 24;

/// Hours for which somebody who was removed is kept out (`AC17`).
pub const KEPT_OUT_HOURS: u32 = 12;

/// Minutes for which a comment may be changed by whoever wrote it (`CT5`).
pub const COMMENT_MINUTES: u32 = 15;

/// Days for which a deleted tree can be taken back (`LB6`).
pub const KEPT_DAYS: u32 = 30;
/// Pictures of a turntable, from all around a tree (`LB9`).
pub const TURNTABLE_PICTURES: u16 = 12;

/// The most touches of one bend (`LM7`).
pub const MAX_BEND_TOUCHES: usize = 8;

/// The thinnest width that can be asked for, as a diameter in internode lengths (`LM8`).
pub const MIN_DIAMETER: f32 = 0.01;

/// The thickest width that can be asked for, as a diameter in internode lengths (`LM8`).
pub const MAX_DIAMETER: f32 = 100.0;

/// The most rows in one `prune` or `predict` (`LM9`).
pub const MAX_PRUNED_ROWS: usize = 1024;

/// The most steps that can be predicted (`LM10`).
pub const MAX_PREDICTED_STEPS: u32 = 100;

/// The most lines of time that are kept beside the present one (`LM11`).
pub const MAX_FUTURES: usize = 64;

/// The most stages of a programme (`LM13`).
pub const MAX_STAGES: usize = 128;

/// The greatest age that a stage of a programme can have (`LM13`).
pub const MAX_AGE: u32 = 10_000;

/// The most places of what somebody shows others while they draw it (`LM20`).
pub const MAX_SKETCH_PLACES: usize = 48;

/// The most devices that people are shown of each other (`LM20`).
pub const MAX_SHOWN_DEVICES: usize = 64;

/// The most obstacles in a scene (`LM6`).
pub const MAX_OBSTACLES: usize = 64;

/// The most vertices of one mesh (`LM6`).
pub const MAX_MESH_VERTICES: usize = 65_536;

/// The most triangles of one mesh (`LM6`).
pub const MAX_MESH_TRIANGLES: usize = 131_072;

/// The largest file that can be posted as an obstacle, in bytes (`LM6`).
pub const MAX_MODEL_BYTES: usize = 256 * 1024 * 1024;

/// The most triangles of a file that is posted as an obstacle; it is simplified to what one mesh may have (`LM6`).
pub const MAX_MODEL_TRIANGLES: usize = 6_000_000;

/// The largest file that can be posted to become a tree, in bytes (`LM14`).
pub const MAX_WOOD_BYTES: usize = 64 * 1024 * 1024;

/// The most tags of a tree (`LB7`).
pub const MAX_TAGS: usize = 32;

/// The most characters of a comment (`LM22`).
pub const MAX_COMMENT_CHARACTERS: usize = 4_000;

/// The most people that a comment names (`LM22`).
pub const MAX_MENTIONS: usize = 16;

/// The most lines of a sketch over a view (`LM22`).
pub const MAX_COMMENT_LINES: usize = 32;

/// The most places of one of them (`LM22`).
pub const MAX_LINE_PLACES: usize = 256;

/// Why the server closes a socket. Standard codes below 4000 keep their meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u16)]
pub enum CloseCode {
    /// The server is stopping; reconnect with backoff.
    GoingAway = 1001,
    /// What came breaks the rules of WebSockets (RFC 6455).
    ProtocolError = 1002,
    /// A text was not UTF-8.
    NotText = 1007,
    /// A message was larger than [`MAX_MESSAGE_BYTES`].
    MessageTooBig = 1009,
    /// The server failed to keep the session; reconnect with backoff.
    InternalError = 1011,
    /// The server has no memory for this now; reconnect with backoff.
    TryAgainLater = 1013,
    /// The client speaks another protocol version: load the page again.
    VersionMismatch = 4000,
    /// The first message was not a hello, or none came in time.
    HelloExpected = 4001,
    /// The client does not read its control messages.
    TooSlow = 4002,
    /// There is no such session.
    UnknownSession = 4003,
    /// The same client key connected again; this older socket ends.
    Replaced = 4004,
    /// An owner has removed this person: they may not come back for now (`AC17`).
    Removed = 4005,
    /// The session cannot be opened by this server, however often one asks: it needs a newer program, or is damaged;
    /// or this client may not join it.
    CannotOpen = 4007,
    /// There was no sign of the other side for too long, not even an answer to a ping; reconnect with backoff.
    Silent = 4008,
}

impl From<CloseCode> for u16 {
    fn from(code: CloseCode) -> Self {
        code as Self
    }
}
