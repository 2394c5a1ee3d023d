//! Sessions, page by page (`LB11`).

use axum::{Json, extract::State, http::StatusCode};
use base64::{Engine, engine::general_purpose::URL_SAFE_NO_PAD};
use espalier_proto::{
    Problem, Reason,
    access::Role,
    library::{ListedSession, SessionPage, TreeOfSession},
};
use futures_util::future::join_all;
use schemars::JsonSchema;
use serde::Deserialize;

use super::{
    Shared,
    failure::{Failure, Path, Query},
    limit::Limit,
};
use crate::{
    access::Caller,
    store::{LineTree, SessionLine, SessionPlace, SessionQuery, Visits},
};

/// Sessions in one answer.
const MAX_SESSIONS: u32 = 200;

/// Which sessions to list (`LB11`).
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub(super) struct Page {
    /// How many at most, 1 to 200.
    #[serde(default)]
    limit: Limit<MAX_SESSIONS>,
    /// The `next` of the page before.
    after: Option<String>,
    /// Those that are saved as they are, or those that are not.
    saved: Option<bool>,
    /// Only those that whoever asks has begun or been in.
    #[serde(default)]
    mine: bool,
}

/// Whose sessions somebody may see: nobody's in particular, where they see all.
fn seen_by(caller: &Caller) -> Option<String> {
    let sees_all = caller.role() >= Role::Owner && caller.only_tree().is_none();
    (!sees_all).then(|| caller.person())
}

pub(super) async fn list(
    State(shared): State<Shared>,
    caller: Caller,
    Query(page): Query<Page>,
) -> Result<Json<SessionPage>, Failure> {
    let query = SessionQuery {
        person: if page.mine { Some(caller.person()) } else { seen_by(&caller) },
        tree: caller.only_tree().map(str::to_owned),
        seen_by: (!caller.sees_all() && caller.only_tree().is_none()).then(|| caller.person()),
        is_saved: page.saved,
        limit: page.limit.get(),
        after: page.after.as_deref().map(read_place).transpose()?,
    };
    let lines = shared.store.sessions(&query).await?;
    let last = lines.last().filter(|_| lines.len() == query.limit as usize);
    let next = last.map(|line| write_place(&line.place()));
    let sessions = join_all(lines.into_iter().map(|line| to_proto(&shared, line))).await;
    Ok(Json(SessionPage { sessions, next }))
}

/// Takes a session off the list of whoever asks, or off everybody's where they see all.
pub(super) async fn forget(
    State(shared): State<Shared>,
    caller: Caller,
    Path(session): Path<String>,
) -> Result<StatusCode, Failure> {
    match shared.store.forget_session(&session, seen_by(&caller).as_deref()).await? {
        true => Ok(StatusCode::NO_CONTENT),
        false => Err(Failure::no_session()),
    }
}

/// A line, with what is known of the session while it is in memory.
async fn to_proto(shared: &Shared, line: SessionLine) -> ListedSession {
    let figures = shared.sessions.figures(&line.name).await;
    let SessionLine { name, tree, is_saved, metamers, used_at } = line;
    ListedSession {
        session: name,
        tree: tree.map(|LineTree { id, name, version }| TreeOfSession { id, name, version }),
        saved: is_saved,
        metamers: figures.map_or(metamers, |figures| figures.metamers),
        people: figures.map_or(0, |figures| figures.people),
        used_at,
    }
}

/// A place in a list, as whoever lists hands it back unread.
fn write_place(place: &SessionPlace) -> String {
    URL_SAFE_NO_PAD.encode(format!("{}\0{}", place.used_at, place.name))
}

fn read_place(text: &str) -> Result<SessionPlace, Problem> {
    let bytes = URL_SAFE_NO_PAD.decode(text).ok();
    let read = bytes.and_then(|bytes| String::from_utf8(bytes).ok());
    let parts = read.as_deref().and_then(|read| read.split_once('\0'));
    let place = parts.map(|(used_at, name)| SessionPlace { used_at: used_at.into(), name: name.into() });
    place.ok_or_else(|| {
        Problem::new(Reason::Malformed, "after is not the next of a page")
            .at("after", "the next of the page before")
    })
}
