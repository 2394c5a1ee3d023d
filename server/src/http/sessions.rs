//! Sessions: making one, its socket.

use std::{
    collections::BTreeMap,
    future::pending,
    sync::{Arc, Mutex, PoisonError},
    time::{Duration, Instant},
};

use axum::{
    Extension, Json,
    extract::{
        State, WebSocketUpgrade,
        ws::{WebSocket, rejection::WebSocketUpgradeRejection},
    },
    http::{StatusCode, header},
    response::{IntoResponse, Response},
};
use espalier_proto::{
    Problem, Reason,
    access::Role,
    library::{NewSession, SessionCreated, SessionTree},
    version::{CloseCode, MAX_MESSAGE_BYTES},
};
use espalier_session::{DocumentError, Entrant, Principal, RestoreError, Session};

use tokio::{
    sync::{Mutex as OneAtATime, OwnedMutexGuard},
    time::interval,
};
use tracing::Instrument;

use super::{
    Shared, addresses,
    failure::{Body, Failure, Path},
    guard::Named,
    removals, replays, trees,
};
use crate::{
    SIMULATION_VERSION,
    access::{self, Action, Caller, Peer, Rate, SecretHash},
    listener::Unfinished,
    live::{self, Grants, OpenError, SessionHandle},
    memory::{self, Full, Growing, Need, Use},
    name,
    pool::Class,
    store::{self, Gifts, Library, Room, Standings, Store, StoreError, StoredTree, TreeDocument, Visits},
    time::now,
};

/// Sessions that somebody from elsewhere begins in two minutes.
const BEGUN_OF: u32 = 20;
const BEGUN_TIME: Duration = Duration::from_mins(2);

/// How many sessions were begun, by whom (`LM17`).
#[derive(Debug)]
pub struct SessionsBegun(Rate<SecretHash>);

impl Default for SessionsBegun {
    fn default() -> Self {
        Self(Rate::new(BEGUN_OF, BEGUN_TIME))
    }
}

/// Trees that are being opened: one at a time of each.
#[derive(Debug, Default)]
pub struct Opening(Mutex<BTreeMap<String, Arc<OneAtATime<()>>>>);

impl Opening {
    /// Waits until nobody else opens this tree; what is given is held meanwhile.
    pub(super) async fn of(&self, tree: &str) -> OwnedMutexGuard<()> {
        let one = {
            let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
            all.retain(|_, one| Arc::strong_count(one) > 1);
            Arc::clone(all.entry(tree.to_owned()).or_default())
        };
        one.lock_owned().await
    }
}

/// How often it is looked whether somebody is still let in.
const LOOKING: Duration = Duration::from_secs(1);
/// Bytes read from a socket at once.
const READ_BUFFER: usize = 8 * 1024;
/// Frames are written one at a time, so this only has to hold the largest one.
const MAX_WRITE_BUFFER: usize = espalier_proto::frame::MAX_BODY_BYTES + 1024 * 1024;

pub(super) async fn create(
    State(shared): State<Shared>,
    Extension(principal): Extension<Principal>,
    caller: Caller,
    Body(new): Body<NewSession>,
) -> Result<impl IntoResponse, Failure> {
    check(&new)?;
    if new.tree.is_none() || new.template {
        shared.ask(&caller, Action::BeginSession, Named::Server).await?;
    }
    let Some(tree) = new.tree else {
        count(&shared, &caller)?;
        let seed = new.seed.unwrap_or_else(rand::random);
        let snapshot = Session::seedling(seed, shared.metamer_budget);
        let name = name::unguessable();
        return Ok((
            StatusCode::CREATED,
            begin(&shared, Beginner(&principal, &caller), name, seed, (snapshot, 0), None).await?,
        ));
    };
    shared.ask(&caller, Action::OpenTree, Named::Tree(&tree)).await?;
    // Two who open a tree at once come into one session: the second reads which one the first has begun.
    let _one = shared.opening.of(&tree).await;
    let stored = trees::stored(&shared, &tree).await?;
    if stored.deleted_at.is_some() {
        return Err(deleted());
    }
    if new.version.is_none()
        && !new.template
        && let Some(session) = to_join(&shared, &principal, &stored).await?
    {
        return Ok((StatusCode::OK, Json(session)));
    }
    count(&shared, &caller)?;
    let is_beside = is_in_work(&shared, &principal, &stored).await?;
    let version = new.version.unwrap_or(stored.head.number);
    let name = name::unguessable();
    let (mut session, snapshot, room) = planted(&shared, &name, &tree, version).await?;
    let of = (!new.template).then_some(((tree.clone(), version), is_beside));
    // It is drawn while it is made durable.
    let drawing = shared.pool.run(Class::Whole, tree.as_str().into(), move |_| {
        session.draw_whole();
        session
    });
    // What an earlier version holds is counted with the first snapshot.
    let start = (snapshot, stored.head.metamers);
    let begun = begin(&shared, Beginner(&principal, &caller), name.clone(), 0, start, of);
    let (begun, session) = tokio::join!(begun, drawing);
    let begun = begun?;
    shared.sessions.seat(&name, session?, room).await;
    Ok((StatusCode::CREATED, begun))
}

/// Refuses what would have no effect: without a tree there is no version, and a tree has its own seed.
fn check(new: &NewSession) -> Result<(), Problem> {
    let of_tree = "nothing without a tree";
    let (field, allowed) = match new {
        NewSession { tree: None, version: Some(_), .. } => ("version", of_tree),
        NewSession { tree: None, template: true, .. } => ("template", of_tree),
        NewSession { tree: Some(_), seed: Some(_), .. } => {
            ("seed", "nothing beside a tree, which has its own")
        }
        _ => return Ok(()),
    };
    let message = format!("{field} would have no effect; allowed: {allowed}");
    Err(Problem::new(Reason::Malformed, message).at(field, allowed))
}

/// Counts that somebody begins a session (`LM17`).
fn count(shared: &Shared, caller: &Caller) -> Result<(), Failure> {
    let Some(by) = caller.counted_as() else { return Ok(()) };
    let counted = shared.sessions_begun.0.count(by, Instant::now());
    counted.map_err(|wait| Failure::too_often("body", "Too many sessions were begun.", wait))
}

/// Who begins a session: their client, and as whom they were let in.
struct Beginner<'a>(&'a Principal, &'a Caller);

/// Begins a session with a snapshot, and its living metamers; of a tree, perhaps beside others who work on it.
async fn begin(
    shared: &Shared,
    Beginner(principal, caller): Beginner<'_>,
    name: String,
    seed: u32,
    (snapshot, metamers): (Vec<u8>, u32),
    tree: Option<((String, u32), bool)>,
) -> Result<Json<SessionCreated>, Failure> {
    let (tree, is_beside) = tree.map_or((None, false), |(tree, is_beside)| (Some(tree), is_beside));
    let new = store::NewSession {
        name: name.clone(),
        seed,
        simulation_version: SIMULATION_VERSION,
        snapshot: Some(snapshot),
        principal: Some(principal.to_string()),
        person: Some(caller.person()),
        metamers,
        tree,
        is_beside,
    };
    shared.store.create_session(new).await?;
    Ok(Json(described(shared, name).await?))
}

/// The session of a tree, if somebody else is working there, or if it is as the tree was saved last (`LB3`).
async fn to_join(
    shared: &Shared,
    principal: &Principal,
    tree: &StoredTree,
) -> Result<Option<SessionCreated>, Failure> {
    let Some(session) = &tree.session else { return Ok(None) };
    let found = described(shared, session.clone()).await?;
    let is_saved = found.tree.as_ref().is_some_and(|of| of.saved && of.version == tree.head.number);
    let is_theirs = found.tree.as_ref().is_some_and(|of| of.id == tree.id);
    Ok((is_theirs && is_saved || is_in_work(shared, principal, tree).await?).then_some(found))
}

/// Whether somebody else is in the session of a tree, which was not saved as another one since.
async fn is_in_work(shared: &Shared, principal: &Principal, tree: &StoredTree) -> Result<bool, Failure> {
    let Some(session) = &tree.session else { return Ok(false) };
    let is_theirs = shared.store.tree_of(session).await?.is_some_and(|of| of.id == tree.id);
    Ok(is_theirs && shared.sessions.people(session).await.iter().any(|other| other != principal))
}

/// A session with the tree that it belongs to.
async fn described(shared: &Shared, session: String) -> Result<SessionCreated, Failure> {
    let tree = shared.store.tree_of(&session).await?;
    let tree = tree.map(|tree| SessionTree { id: tree.id, version: tree.version, saved: tree.is_saved });
    Ok(SessionCreated { session, tree })
}

pub(super) async fn find(
    State(shared): State<Shared>,
    Path(session): Path<String>,
) -> Result<impl IntoResponse, Failure> {
    if shared.store.has_session(&session).await? {
        Ok(Json(described(&shared, session).await?))
    } else {
        Err(Failure::no_session())
    }
}

/// Has that go on which the server did not outlive (`OP5`).
pub(super) async fn resume(
    State(shared): State<Shared>,
    Path(session): Path<String>,
) -> Result<StatusCode, Failure> {
    let goes_on = match shared.sessions.open(&session).await {
        Err(OpenError::Waits) => shared.sessions.open_anew(&session).await?.is_some(),
        opened => opened?.ok_or_else(Failure::no_session)?.go_on().await?,
    };
    if goes_on {
        return Ok(StatusCode::NO_CONTENT);
    }
    let problem = Problem::new(Reason::NothingWaits, "Nothing in this session waits to go on.");
    Err(problem.at("session", "one whose `state` is paused by crashes").into())
}

/// What somebody connects with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum With {
    Session,
    /// A copy of it, to play it in (`RP1`).
    Replay,
}

pub(super) async fn socket(
    shared: State<Shared>,
    name: Path<String>,
    caller: Result<Caller, Failure>,
    peer: Option<Extension<Peer>>,
    unfinished: Option<Extension<Unfinished>>,
    upgrade: Result<WebSocketUpgrade, WebSocketUpgradeRejection>,
) -> Response {
    upgraded(With::Session, shared, name, caller, peer, unfinished, upgrade).await
}

pub(super) async fn replay(
    shared: State<Shared>,
    name: Path<String>,
    caller: Result<Caller, Failure>,
    peer: Option<Extension<Peer>>,
    unfinished: Option<Extension<Unfinished>>,
    upgrade: Result<WebSocketUpgrade, WebSocketUpgradeRejection>,
) -> Response {
    upgraded(With::Replay, shared, name, caller, peer, unfinished, upgrade).await
}

async fn upgraded(
    with: With,
    State(shared): State<Shared>,
    Path(name): Path<String>,
    caller: Result<Caller, Failure>,
    peer: Option<Extension<Peer>>,
    unfinished: Option<Extension<Unfinished>>,
    upgrade: Result<WebSocketUpgrade, WebSocketUpgradeRejection>,
) -> Response {
    let upgrade = match upgrade {
        Ok(upgrade) => upgrade,
        Err(rejection) => {
            let problem =
                Problem::new(Reason::Malformed, format!("This is the address of a WebSocket: {rejection}."));
            return Failure::from(problem.at(header::UPGRADE.as_str(), "websocket")).into_response();
        }
    };
    let Some(place) = shared.sessions.place(access::address(peer.as_deref())) else {
        return Failure::new(Reason::ManyPeople, "Too many people are here already.").into_response();
    };
    let admitted = match admit(&shared, caller, &name).await.map_err(Failure::final_problem) {
        Ok(admitted) => Ok(admitted),
        Err(Ok(problem)) => Err(removals::close_of(&problem)),
        Err(Err(failure)) => return failure.into_response(),
    };
    let unfinished = unfinished.map(|Extension(unfinished)| unfinished).unwrap_or_default();
    unfinished.count_in(shared.memory.clone());
    let claim = shared.memory.take(Use::Socket, Need::Other, memory::SOCKET);
    let admitted =
        admitted.and_then(|admitted| claim.map(|claim| (admitted, claim)).map_err(|full| no_memory(&full)));
    // The lines of the log that a socket causes are those of its request, and name its session.
    let span = tracing::info_span!("socket", session = name);
    upgrade
        .read_buffer_size(READ_BUFFER)
        .max_message_size(MAX_MESSAGE_BYTES)
        .max_frame_size(MAX_MESSAGE_BYTES)
        .max_write_buffer_size(MAX_WRITE_BUFFER)
        .on_upgrade(async move |socket| {
            let begun = Instant::now();
            let connected = async {
                match admitted {
                    Ok((admitted, _claim)) => {
                        connect((socket, unfinished), &shared, (with, &name), admitted).await
                    }
                    Err((code, sentence)) => live::turn_away(socket, code, &sentence).await,
                }
                shared.requests.socket_ended(begun.elapsed());
            };
            shared.sessions.run_socket(place, connected.instrument(span)).await;
        })
}

/// How a socket closes for which there is no memory.
fn no_memory(full: &Full) -> (CloseCode, String) {
    let problem = OpenError::Memory(*full).problem();
    (CloseCode::TryAgainLater, problem.in_close())
}

/// Somebody who may join a session.
async fn admit(shared: &Shared, caller: Result<Caller, Failure>, session: &str) -> Result<Caller, Failure> {
    let caller = caller?;
    shared.ask(&caller, addresses::OF_SOCKETS, Named::Session(session)).await?;
    Ok(caller)
}

async fn connect(
    (mut socket, unfinished): (WebSocket, Unfinished),
    shared: &Shared,
    (with, name): (With, &str),
    caller: Caller,
) {
    let opened = live::open(&mut socket, &shared.sessions, name).await;
    let opened = match (with, opened) {
        (With::Replay, Ok(Some(session))) => replays::copied(shared, name, &session).await.map(Some),
        (_, opened) => opened,
    };
    let (code, sentence) = match opened {
        Ok(Some(session)) => {
            // On a full disk one comes in all the same.
            if let Err(error) = shared.store.visit(name, &caller.person()).await {
                tracing::warn!(%error, session = name, "that somebody was in the session is not kept");
            }
            // Where it cannot be read now, they are told what they may as soon as it can.
            let role =
                shared.role_at(&caller, Named::Session(name)).await.map_or(caller.role(), |(role, _)| role);
            let entrant = Entrant { role, ..caller.entrant() };
            let let_out = |grants| let_out(shared, name, caller, grants, role);
            return live::serve(socket, unfinished, session, entrant, let_out).await;
        }
        Ok(None) => (CloseCode::UnknownSession, "There is no such session."),
        Err(OpenError::Memory(full)) => {
            let (code, sentence) = no_memory(&full);
            return live::turn_away(socket, code, &sentence).await;
        }
        Err(OpenError::Stopping) => (CloseCode::GoingAway, "The server is stopping."),
        Err(OpenError::Ended) => (CloseCode::GoingAway, "The session is being put away; come back."),
        Err(error) => {
            tracing::error!(session = name, %error, "a session could not be opened");
            if error.is_final() {
                let sentence = error.problem().in_close();
                return live::turn_away(socket, CloseCode::CannotOpen, &sentence).await;
            }
            let reason = if let OpenError::Store(error) = &error { error.in_words() } else { "try again" };
            let sentence = format!("The session cannot be opened now: {reason}.");
            return live::turn_away(socket, CloseCode::InternalError, &sentence).await;
        }
    };
    live::turn_away(socket, code, sentence).await;
}

/// Waits until somebody is let in no longer (`AC4`) or removed (`AC17`), and says so; tells meanwhile what they may do when
/// that changes (`AU3`).
async fn let_out(
    shared: &Shared,
    session: &str,
    caller: Caller,
    grants: Grants,
    mut role: Role,
) -> (CloseCode, String) {
    if !caller.is_revocable() {
        return pending().await;
    }
    let mut changes = shared.standings.subscribe();
    let mut ticks = interval(LOOKING);
    // As they came in.
    let person = caller.person();
    loop {
        let caller = caller.now(&*shared.store).await;
        // A database that cannot be read locks nobody out.
        let standing =
            shared.store.standing(Room::Session(session), &person, &now()).await.unwrap_or_default();
        let own = caller.as_ref().ok().and_then(Option::as_ref).map(Caller::role);
        if let Some(removed) = standing.removed.as_ref().filter(|_| own < Some(Role::Owner)) {
            // What they draw ends where it is.
            grants.grant(Role::Viewer).await;
            return removals::close_of(&removals::problem(removed));
        }
        match caller {
            // As whoever they are called from now on, so that what they do counts for them.
            Ok(Some(caller)) if caller.person() != person => {
                return (CloseCode::GoingAway, "You have another name; come back.".into());
            }
            Ok(Some(caller)) => {
                let given = match standing.is_heir {
                    true => Ok(Role::Owner),
                    false => shared.store.role_given(Room::Session(session), &person).await,
                };
                let room = Room::Session(session);
                let own = given.map_or(role, |given| caller.role_in(room, given, &standing));
                if own == Role::None {
                    grants.grant(Role::Viewer).await;
                    return removals::close_of(&no_longer_theirs());
                }
                let now = if standing.locked_by.is_some() { own.under_lock() } else { own };
                if now != role {
                    grants.grant(now).await;
                    role = now;
                }
            }
            Err(_) => {}
            Ok(None) => return (CloseCode::CannotOpen, access::not_let_in().in_close()),
        }
        tokio::select! {
            _ = ticks.tick() => {}
            // The sender lives as long as the server.
            _ = changes.changed() => {}
        }
    }
}

/// What somebody is told to whom a tree was given that is theirs no longer.
fn no_longer_theirs() -> Problem {
    Problem::new(Reason::NoSession, "There is no such session, or not for you any more.")
        .at("session", "the name of a session")
}

/// What was saved of a tree, for whoever takes or opens it: not of one that is deleted (`LB6`).
pub(super) async fn saved_document(
    shared: &Shared,
    tree: &str,
    version: u32,
) -> Result<TreeDocument, Failure> {
    let stored = trees::stored(shared, tree).await?;
    if stored.deleted_at.is_some() {
        return Err(deleted());
    }
    kept_document(shared, tree, version).await
}

/// What is asked for is of a tree that was deleted.
fn deleted() -> Failure {
    Failure::no_tree(" any more: it was deleted, and can be taken back")
}

/// What was saved of a tree, of which it may be that only pictures are still to be seen.
pub(super) async fn kept_document(
    shared: &Shared,
    tree: &str,
    version: u32,
) -> Result<TreeDocument, Failure> {
    match shared.store.document(tree, version).await {
        Ok(Some(document)) => Ok(document),
        Ok(None) => Err(trees::stored(shared, tree).await.err().unwrap_or_else(Failure::no_version)),
        Err(StoreError::Damaged(what)) => Err(unreadable(tree, &what)),
        Err(error) => Err(error.into()),
    }
}

/// A new session of this name that goes on with a saved tree, and its first snapshot.
async fn planted(
    shared: &Shared,
    name: &str,
    tree: &str,
    version: u32,
) -> Result<(Session, Vec<u8>, Growing), Failure> {
    let document = saved_document(shared, tree, version).await?;
    let room =
        Growing::new(shared.memory.take_soon(Use::Session, memory::restore(document.bytes.len())).await?);
    let (name, epoch, budget) = (name.to_owned(), rand::random(), shared.metamer_budget);
    let planted = shared
        .pool
        .run(Class::Whole, tree.into(), move |_| Session::of_tree(name, epoch, &document.bytes, budget));
    let planted = planted.await?.map(|(session, snapshot)| (session, snapshot, room));
    planted.map_err(|error| match error {
        error @ RestoreError::Document(DocumentError::Later(_)) => OpenError::from(error).into(),
        RestoreError::Document(error) => unreadable(tree, &error),
        error => unreadable(tree, &error),
    })
}

pub(super) fn unreadable(tree: &str, error: &dyn std::fmt::Display) -> Failure {
    tracing::error!(tree, %error, "a saved tree cannot be read");
    Failure::new(Reason::TreeDamaged, format!("The tree cannot be read: {error}."))
}

/// A live session for a request.
pub(super) async fn open(shared: &Shared, name: &str) -> Result<SessionHandle, Failure> {
    shared.sessions.open(name).await?.ok_or_else(Failure::no_session)
}
