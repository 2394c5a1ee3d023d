//! Sessions: making one, its socket, its tree as a file.

use axum::{
    Extension, Json,
    extract::{
        Path, State, WebSocketUpgrade,
        ws::{WebSocket, rejection::WebSocketUpgradeRejection},
    },
    http::{StatusCode, header},
    response::{IntoResponse, Response},
};
use espalier_proto::{
    library::{NewSession, SessionCreated},
    version::CloseCode,
};
use espalier_session::{DocumentError, Principal, RestoreError, Session};

use super::{
    Shared,
    failure::{Body, Failure},
};
use crate::{
    SIMULATION_VERSION,
    authority::{Action, Object},
    document,
    live::{self, OpenError, REFUSED_MESSAGE_BYTES, SessionHandle, Sessions},
    name,
    store::{self, Store, StoreError},
};

/// Bytes read from a socket at once.
const READ_BUFFER: usize = 8 * 1024;
/// Frames are written one at a time, so this only has to hold the largest one.
const MAX_WRITE_BUFFER: usize = espalier_proto::frame::MAX_BODY_BYTES + 1024 * 1024;

/// What a session's tree is downloaded as.
#[derive(Clone, Copy, Debug)]
pub(super) struct Download {
    pub format: document::Format,
    pub ending: &'static str,
    pub media_type: &'static str,
}

pub(super) async fn create(
    State(shared): State<Shared>,
    Extension(principal): Extension<Principal>,
    Body(new): Body<NewSession>,
) -> Result<impl IntoResponse, Failure> {
    let seed = new.seed.unwrap_or_else(rand::random);
    let snapshot = match new.tree {
        None => Session::seedling(seed, shared.metamer_budget),
        Some(id) => {
            shared.ask(&principal, Action::OpenTree, Object::Tree(&id))?;
            planted(&shared, &id).await?
        }
    };
    let session = name::unguessable();
    let (simulation_version, snapshot) = (SIMULATION_VERSION, Some(snapshot));
    let made = store::NewSession { name: session.clone(), seed, simulation_version, snapshot };
    shared.store.create_session(made).await?;
    Ok((StatusCode::CREATED, Json(SessionCreated { session })))
}

pub(super) async fn find(
    State(shared): State<Shared>,
    Path(session): Path<String>,
) -> Result<impl IntoResponse, Failure> {
    if shared.store.has_session(&session).await? {
        Ok(Json(SessionCreated { session }))
    } else {
        Err(Failure::not_found("session"))
    }
}

pub(super) async fn export(
    State(shared): State<Shared>,
    Path(session): Path<String>,
    Download { format, ending, media_type }: Download,
) -> Result<impl IntoResponse, Failure> {
    let document = open(&shared, &session).await?.read().await?;
    let file = shared.pool.run(move || document::export(&document.bytes, format)).await?;
    let file = file.map_err(|error| {
        tracing::error!(session, %error, "a document cannot be exported");
        Failure::unavailable("The tree cannot be exported.")
    })?;
    let headers = [
        (header::CONTENT_TYPE, media_type.to_owned()),
        (header::CONTENT_DISPOSITION, format!("attachment; filename=\"tree.{ending}\"")),
    ];
    Ok((headers, file))
}

pub(super) async fn socket(
    State(shared): State<Shared>,
    Path(name): Path<String>,
    upgrade: Result<WebSocketUpgrade, WebSocketUpgradeRejection>,
) -> Response {
    let upgrade = match upgrade {
        Ok(upgrade) => upgrade,
        Err(rejection) => return rejection.into_response(),
    };
    let Some(place) = shared.sessions.place() else {
        return Failure::unavailable("Too many people are here already.").into_response();
    };
    upgrade
        .read_buffer_size(READ_BUFFER)
        .max_message_size(REFUSED_MESSAGE_BYTES)
        .max_frame_size(REFUSED_MESSAGE_BYTES)
        .max_write_buffer_size(MAX_WRITE_BUFFER)
        .on_upgrade(async move |socket| {
            shared.sessions.run_socket(place, connect(socket, &shared.sessions, &name)).await;
        })
}

async fn connect(socket: WebSocket, sessions: &Sessions, name: &str) {
    let (code, sentence) = match sessions.open(name).await {
        Ok(Some(session)) => return live::serve(socket, session).await,
        Ok(None) => (CloseCode::UnknownSession, "There is no such session."),
        Err(OpenError::Stopping) => (CloseCode::GoingAway, "The server is stopping."),
        Err(error) => {
            tracing::error!(session = name, %error, "a session could not be opened");
            if error.is_final() {
                return live::turn_away(socket, CloseCode::CannotOpen, &error.to_string()).await;
            }
            (CloseCode::InternalError, "The session cannot be opened now.")
        }
    };
    live::turn_away(socket, code, sentence).await;
}

/// A snapshot of a new session that goes on with a saved tree.
async fn planted(shared: &Shared, tree: &str) -> Result<Vec<u8>, Failure> {
    let document = match shared.store.tree_document(tree).await {
        Ok(document) => document.ok_or_else(|| Failure::not_found("tree"))?,
        Err(StoreError::Damaged(what)) => return Err(unreadable(tree, &what)),
        Err(error) => return Err(error.into()),
    };
    let version = document.simulation_version;
    if version > SIMULATION_VERSION {
        return Err(Failure::conflict(format!(
            "A newer Espalier saved this tree (simulation {version}; this one has {SIMULATION_VERSION}): update the server."
        )));
    }
    let budget = shared.metamer_budget;
    let planted = shared.pool.run(move || Session::first_snapshot(&document.bytes, budget)).await?;
    planted.map_err(|error| match error {
        RestoreError::Document(DocumentError::Later(what)) => {
            Failure::conflict(format!("A newer Espalier saved this tree ({what}): update the server."))
        }
        RestoreError::Document(error) => unreadable(tree, &error),
        error => unreadable(tree, &error),
    })
}

fn unreadable(tree: &str, error: &dyn std::fmt::Display) -> Failure {
    tracing::error!(tree, %error, "a saved tree cannot be read");
    Failure::conflict(format!("The tree cannot be read: {error}."))
}

/// A live session for a request.
pub(super) async fn open(shared: &Shared, name: &str) -> Result<SessionHandle, Failure> {
    shared.sessions.open(name).await?.ok_or_else(|| Failure::not_found("session"))
}
