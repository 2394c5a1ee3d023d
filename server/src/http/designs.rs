//! The design in force, for programs: asked for, and put in its place (`DS11`).

use axum::{Extension, Json, extract::State, http::StatusCode};
use espalier_proto::{Action, DesignInForce, PutDesign};
use espalier_session::Principal;

use super::{
    Shared,
    failure::{Body, Failure, Path},
    sessions,
};
use crate::access::Caller;

/// The design as clients were told it last.
pub(super) async fn find(
    State(shared): State<Shared>,
    Path(session): Path<String>,
) -> Result<Json<DesignInForce>, Failure> {
    let session = sessions::open(&shared, &session).await?;
    let design = session.design().await?;
    design.map(Json).ok_or_else(|| {
        Failure::none_such("design", "session", "the name of a session in which a design is in force")
    })
}

/// Does what `new_design` does with a graph, and answers once that is durable.
pub(super) async fn put(
    State(shared): State<Shared>,
    Extension(principal): Extension<Principal>,
    caller: Caller,
    Path(session): Path<String>,
    Body(PutDesign { graph, position }): Body<PutDesign>,
) -> Result<StatusCode, Failure> {
    let session = sessions::open(&shared, &session).await?;
    let action = Action::NewDesign { position, template: None, graph: Some(graph) };
    session.act(principal, caller.entrant(), action.into()).await??;
    Ok(StatusCode::NO_CONTENT)
}
