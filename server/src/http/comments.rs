//! What people say of trees (`CT`).

use std::{
    collections::BTreeMap,
    time::{Duration, Instant, SystemTime},
};

use axum::{
    Extension, Json,
    extract::State,
    http::{StatusCode, header},
    response::{IntoResponse, Response},
};
use espalier_proto::{
    Problem, Reason,
    comment::{
        Bookmark, ChangeComment, ChangeThread, Comment, NewComment, NewPin, NewThread, Resolved, Seen,
        SketchNote, Thread, ThreadPlace,
    },
    thumbnail,
    version::COMMENT_MINUTES,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    Shared,
    audit::Made,
    failure::{Body, Failure, Path, Query},
    guard::Named,
    held,
    limit::Limit,
    mentions::{self, Called},
    sessions, trees,
};
use crate::{
    access::{Action, Caller, Rate, SecretHash},
    live::{StoredPin, pins_of},
    memory::{self, Claim, Use},
    store::{self, CommentChange, Comments, Library, StoreError, StoredThread},
    time::{now, written},
};

/// Threads in one answer.
const MAX_THREADS: u32 = 200;
/// Memory is taken for what people say of a tree from so many bytes on.
const COUNTED_FROM: u64 = 1 << 20;
/// For so long a comment may be changed by whoever wrote it.
const CHANGED_WITHIN: Duration = Duration::from_mins(COMMENT_MINUTES as u64);
/// Comments that somebody writes in a minute.
const WRITTEN: u32 = 60;
const WRITTEN_TIME: Duration = Duration::from_mins(1);
/// What somebody is called who has no name.
pub(super) const UNNAMED: &str = "Guest";

/// How many comments were written, by whom (`LM22`).
#[derive(Debug)]
pub struct CommentsWritten(Rate<SecretHash>);

impl Default for CommentsWritten {
    fn default() -> Self {
        Self(Rate::new(WRITTEN, WRITTEN_TIME))
    }
}

/// Which threads to list.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(inline)]
pub(super) struct Page {
    /// How many at most, 1 to 200.
    #[serde(default)]
    limit: Limit<MAX_THREADS>,
    /// Those before this number.
    before: Option<u32>,
}

/// What a comment says, as the store keeps it.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct Said {
    pub(crate) text: String,
    #[serde(default)]
    pub(crate) mentions: Vec<Called>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) bookmark: Option<Bookmark>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    sketch: Option<SketchNote>,
}

impl Said {
    pub(crate) fn from_json(json: &str) -> Result<Self, StoreError> {
        serde_json::from_str(json)
            .map_err(|error| StoreError::Damaged(format!("a comment is damaged: {error}")))
    }

    fn to_json(&self) -> String {
        // Texts and numbers always have a JSON form.
        serde_json::to_string(self).unwrap_or_default()
    }
}

pub(super) async fn list(
    State(shared): State<Shared>,
    Path(tree): Path<String>,
    Query(page): Query<Page>,
    caller: Caller,
) -> Result<Response, Failure> {
    trees::stored(&shared, &tree).await?;
    let bytes = shared.store.comment_bytes(&tree).await?;
    let claim = room(&shared, memory::comments(bytes.said)).await?;
    let seen = seen(&shared, &tree, &caller).await?;
    let threads = shared.store.threads(&tree, page.limit.get(), page.before).await?;
    let threads: Result<Vec<Thread>, _> =
        threads.into_iter().map(|thread| told(thread, &caller, &seen)).collect();
    // Texts and numbers always have a JSON form.
    let json = serde_json::to_vec(&threads?).unwrap_or_default();
    Ok(([(header::CONTENT_TYPE, "application/json")], held::body(json, claim)).into_response())
}

/// Memory for what people say of a tree, where that is much.
pub(super) async fn room(shared: &Shared, bytes: u64) -> Result<Option<Claim>, Failure> {
    if bytes < COUNTED_FROM {
        return Ok(None);
    }
    Ok(Some(shared.memory.take_soon(Use::Export, bytes).await?))
}

pub(super) async fn find(
    State(shared): State<Shared>,
    Path((tree, thread)): Path<(String, u32)>,
    caller: Caller,
) -> Result<Json<Thread>, Failure> {
    trees::stored(&shared, &tree).await?;
    Ok(Json(of(&shared, &tree, thread, &caller).await?))
}

pub(super) async fn begin(
    State(shared): State<Shared>,
    Path(tree): Path<String>,
    caller: Caller,
    Body(NewThread { pin, comment }): Body<NewThread>,
) -> Result<impl IntoResponse, Failure> {
    there(&shared, &tree).await?;
    count(&shared, &caller)?;
    let comment = kept(&shared, &tree, comment, &caller).await?;
    let session = pin.as_ref().map(|pin| pin.session.clone());
    let pin = match pin {
        Some(pin) => Some(pinned(&shared, &tree, &caller, pin).await?.to_json()),
        None => None,
    };
    let thread = shared.store.add_thread(&tree, pin, comment).await.map_err(full)?;
    shared.store.see_thread(&tree, &caller.person(), thread, 1).await?;
    tell(&shared, &tree, session.as_deref(), thread).await?;
    let begun = of(&shared, &tree, thread, &caller).await?;
    Ok((StatusCode::CREATED, Extension(Made(thread.to_string())), Json(begun)))
}

pub(super) async fn reply(
    State(shared): State<Shared>,
    Path((tree, thread)): Path<(String, u32)>,
    caller: Caller,
    Body(comment): Body<NewComment>,
) -> Result<impl IntoResponse, Failure> {
    there(&shared, &tree).await?;
    count(&shared, &caller)?;
    let comment = kept(&shared, &tree, comment, &caller).await?;
    let added = shared.store.add_comment(&tree, thread, comment).await.map_err(full)?;
    let number = added.ok_or_else(no_thread)?;
    shared.store.see_thread(&tree, &caller.person(), thread, number).await?;
    tell(&shared, &tree, None, thread).await?;
    Ok((StatusCode::CREATED, Json(of(&shared, &tree, thread, &caller).await?)))
}

pub(super) async fn change(
    State(shared): State<Shared>,
    Path((tree, thread)): Path<(String, u32)>,
    caller: Caller,
    Body(ChangeThread { resolved }): Body<ChangeThread>,
) -> Result<Json<Thread>, Failure> {
    there(&shared, &tree).await?;
    let resolved = resolved.then(|| (called(&caller, None), now()));
    if !shared.store.resolve_thread(&tree, thread, resolved).await? {
        return Err(no_thread());
    }
    tell(&shared, &tree, None, thread).await?;
    Ok(Json(of(&shared, &tree, thread, &caller).await?))
}

pub(super) async fn edit(
    State(shared): State<Shared>,
    Path((tree, thread, comment)): Path<(String, u32, u32)>,
    caller: Caller,
    Body(ChangeComment { text }): Body<ChangeComment>,
) -> Result<Json<Thread>, Failure> {
    there(&shared, &tree).await?;
    let found = comment_of(&shared, &tree, thread, comment).await?;
    if found.person != caller.person() {
        return Err(espalier_session::forbidden().into());
    }
    if found.written_at < written(SystemTime::now() - CHANGED_WITHIN) {
        let sentence = format!("A comment is changed within {COMMENT_MINUTES} minutes alone.");
        let problem = Problem::new(Reason::CommentStays, sentence);
        return Err(problem.at("comment", format!("one of the last {COMMENT_MINUTES} minutes")).into());
    }
    let said = Said { text: text.into(), ..Said::from_json(&found.said)? };
    let edited = CommentChange::Edited { said: said.to_json(), at: now() };
    if !shared.store.change_comment(&tree, thread, comment, edited).await.map_err(full)? {
        return Err(no_comment());
    }
    tell(&shared, &tree, None, thread).await?;
    Ok(Json(of(&shared, &tree, thread, &caller).await?))
}

pub(super) async fn delete(
    State(shared): State<Shared>,
    Path((tree, thread, comment)): Path<(String, u32, u32)>,
    caller: Caller,
) -> Result<StatusCode, Failure> {
    there(&shared, &tree).await?;
    let found = comment_of(&shared, &tree, thread, comment).await?;
    if found.person != caller.person() {
        shared.ask(&caller, Action::ShareTree, Named::Tree(&tree)).await?;
    }
    if !shared.store.change_comment(&tree, thread, comment, CommentChange::Deleted).await? {
        return Err(no_comment());
    }
    tell(&shared, &tree, None, thread).await?;
    Ok(StatusCode::NO_CONTENT)
}

pub(super) async fn see(
    State(shared): State<Shared>,
    Path((tree, thread)): Path<(String, u32)>,
    caller: Caller,
    Body(Seen { comment }): Body<Seen>,
) -> Result<StatusCode, Failure> {
    trees::stored(&shared, &tree).await?;
    let is_there = shared.store.see_thread(&tree, &caller.person(), thread, comment).await?;
    if is_there { Ok(StatusCode::NO_CONTENT) } else { Err(no_thread()) }
}

pub(super) async fn picture(
    State(shared): State<Shared>,
    Path((tree, thread, comment)): Path<(String, u32, u32)>,
) -> Result<Response, Failure> {
    trees::stored(&shared, &tree).await?;
    comment_of(&shared, &tree, thread, comment).await?;
    let found = shared.store.comment_picture(&tree, thread, comment).await?;
    let picture = found.ok_or_else(|| Failure::none_such("picture", "comment", "one that has a picture"))?;
    let headers = [
        (header::CONTENT_TYPE, picture.media_type),
        // A comment that is deleted takes its picture along, so it may not be shown for ever.
        (header::CACHE_CONTROL, "private, max-age=3600".to_owned()),
    ];
    Ok((headers, picture.bytes).into_response())
}

/// Nobody says anything of a tree that is deleted.
async fn there(shared: &Shared, tree: &str) -> Result<(), Failure> {
    let found = trees::stored(shared, tree).await?;
    if found.deleted_at.is_some() { Err(store::Missing::Tree.into()) } else { Ok(()) }
}

/// A thread as whoever asks is told of it.
async fn of(shared: &Shared, tree: &str, thread: u32, caller: &Caller) -> Result<Thread, Failure> {
    let found = shared.store.thread(tree, thread).await?.ok_or_else(no_thread)?;
    Ok(told(found, caller, &seen(shared, tree, caller).await?)?)
}

async fn seen(shared: &Shared, tree: &str, caller: &Caller) -> Result<BTreeMap<u32, u32>, Failure> {
    Ok(shared.store.seen_threads(tree, &caller.person()).await?.into_iter().collect())
}

fn told(thread: StoredThread, caller: &Caller, seen: &BTreeMap<u32, u32>) -> Result<Thread, StoreError> {
    let StoredThread { number, pin, resolved, comments } = thread;
    let at: Option<ThreadPlace> =
        pin.map(|json| StoredPin::from_json(number, &json).map(|pin| pin.at)).transpose()?;
    let own = caller.person();
    let comments: Result<Vec<_>, StoreError> = comments
        .into_iter()
        .map(|comment| {
            let Said { text, mentions, bookmark, sketch } = Said::from_json(&comment.said)?;
            Ok(Comment {
                comment: comment.number,
                author: comment.author,
                own: comment.person == own,
                written_at: comment.written_at,
                edited_at: comment.edited_at,
                text,
                mentions: mentions.into_iter().map(|one| one.told(caller)).collect(),
                bookmark,
                sketch,
                picture: comment.has_picture,
            })
        })
        .collect();
    Ok(Thread {
        thread: number,
        at,
        resolved: resolved.map(|(by, at)| Resolved { by, at }),
        seen: seen.get(&number).copied().unwrap_or(0),
        comments: comments?,
    })
}

async fn comment_of(
    shared: &Shared,
    tree: &str,
    thread: u32,
    comment: u32,
) -> Result<store::StoredComment, Failure> {
    let found = shared.store.thread(tree, thread).await?.ok_or_else(no_thread)?;
    found.comments.into_iter().find(|one| one.number == comment).ok_or_else(no_comment)
}

/// What whoever asks is called, even where nobody knows.
pub(super) fn called(caller: &Caller, said: Option<String>) -> String {
    caller.called(said).unwrap_or_else(|| UNNAMED.to_owned())
}

/// A comment as the store keeps it.
async fn kept(
    shared: &Shared,
    tree: &str,
    new: NewComment,
    caller: &Caller,
) -> Result<store::NewComment, Failure> {
    let NewComment { text, author, mentions, session, bookmark, sketch, picture } = new;
    if let Some(session) = &session {
        require_session(shared, tree, caller, session, "comment.session").await?;
    }
    let picture = picture.as_deref().map(thumbnail::from_data_url).transpose();
    let picture = picture.map_err(|problem| Problem { field: Some("picture".into()), ..problem })?;
    let mentions = mentions::found(shared, tree, session.as_deref(), mentions.into()).await?;
    let said = Said { text: text.into(), mentions, bookmark, sketch };
    Ok(store::NewComment {
        person: caller.person(),
        author: called(caller, author.map(String::from)),
        written_at: now(),
        said: said.to_json(),
        picture,
    })
}

/// The place that a thread is pinned to, as the session of the tree has it.
async fn pinned(shared: &Shared, tree: &str, caller: &Caller, pin: NewPin) -> Result<StoredPin, Failure> {
    let NewPin { session, at } = pin;
    require_session(shared, tree, caller, &session, "pin.session").await?;
    let anchor = sessions::open(shared, &session).await?.anchor(at.row).await?;
    let anchor = anchor.ok_or_else(|| {
        Problem::new(Reason::BranchGone, format!("There is no living metamer with the row {}.", at.row))
            .at("pin.at.row", "the row of a living metamer")
    })?;
    let at = ThreadPlace { along: at.along, offset: at.offset, place: at.place };
    Ok(StoredPin { at, anchor })
}

/// Fails where the tree has no such session, or whoever asks may not be in it.
async fn require_session(
    shared: &Shared,
    tree: &str,
    caller: &Caller,
    session: &str,
    field: &str,
) -> Result<(), Failure> {
    shared.ask(caller, Action::JoinSession, Named::Session(session)).await?;
    let of = shared.store.tree_of(session).await?;
    if of.is_some_and(|of| of.id == tree) {
        return Ok(());
    }
    let problem = Problem::new(Reason::NoSession, "The tree has no such session.");
    Err(problem.at(field, "the name of a session of the tree").into())
}

/// Counts that somebody writes a comment (`LM22`).
fn count(shared: &Shared, caller: &Caller) -> Result<(), Failure> {
    let Some(by) = caller.counted_as() else { return Ok(()) };
    let counted = shared.comments_written.0.count(by, Instant::now());
    counted.map_err(|wait| Failure::too_often("body", "Too many comments were written.", wait))
}

fn full(error: StoreError) -> Failure {
    match error {
        StoreError::Full => {
            let sentence = "The tree has as many comments, or as much in them, as it may.";
            let allowed = "1,000 threads of 200 comments each, 64 MiB of pictures, 64 MiB of words and lines";
            Problem::new(Reason::TooMany, sentence).at("tree", allowed).into()
        }
        error => error.into(),
    }
}

/// Tells those who have the tree open that a thread has changed.
async fn tell(shared: &Shared, tree: &str, also: Option<&str>, thread: u32) -> Result<(), Failure> {
    let pins = pins_of(tree, &*shared.store).await?;
    let stored = trees::stored(shared, tree).await?;
    let session = stored.session.as_deref();
    let others = also.filter(|also| Some(*also) != session);
    for session in session.into_iter().chain(others) {
        shared.sessions.comment(session, pins.clone(), vec![thread]).await;
    }
    Ok(())
}

fn no_thread() -> Failure {
    Failure::none_such("thread", "thread", "the number of a thread of this tree")
}

fn no_comment() -> Failure {
    Failure::none_such("comment", "comment", "the number of a comment of this thread")
}
