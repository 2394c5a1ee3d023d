//! Grammars: those that come with the program, texts that are checked, and which rule made what (`GR6` to `GR8`).

use std::time::Duration;

use axum::{
    Json,
    extract::State,
    http::HeaderMap,
    response::{IntoResponse, Response},
};
use espalier_grammar::SHIPPED;
use espalier_proto::{CheckGrammar, GrammarOrigins, GrammarReport, Reason, ShippedGrammar};
use espalier_session::{Document, check_grammar, wire_grammar};
use tokio::time::timeout;

use crate::{
    pool::{Class, Person},
    portrait::Sitter,
};

use super::{
    Shared,
    failure::{Body, Failure, Path},
    sessions, species,
};

/// Whoever types has written more by then.
const TIME_LIMIT: Duration = Duration::from_secs(5);

pub(super) async fn list() -> impl IntoResponse {
    let listed = |shipped: &espalier_grammar::Shipped| {
        wire_grammar(shipped, format!("/api/v1/grammars/{}/picture", shipped.name))
    };
    let all: Vec<ShippedGrammar> = SHIPPED.iter().map(listed).collect();
    Json(all)
}

pub(super) async fn picture(
    State(shared): State<Shared>,
    Path(name): Path<String>,
    asked: HeaderMap,
) -> Result<Response, Failure> {
    let print = species::print(&shared, Sitter::Grammar(&name)).await?;
    let print =
        print.ok_or_else(|| Failure::none_such("grammar", "name", "the name of one of /api/v1/grammars"))?;
    species::answer(&print, &asked)
}

/// What there is to say of a text (`GR6`).
pub(super) async fn check(
    State(shared): State<Shared>,
    Body(wanted): Body<CheckGrammar>,
) -> Result<Json<GrammarReport>, Failure> {
    let checked = shared.pool.run(Class::Drawing, Person::default(), move |_| check_grammar(&wanted));
    let sentence = "The server is busy growing trees; the check took too long.";
    let late = |_| Failure::new(Reason::Busy, sentence);
    Ok(Json(timeout(TIME_LIMIT, checked).await.map_err(late)???))
}

/// Which rule made each row of the grammar in force (`GR8`).
pub(super) async fn origins(
    State(shared): State<Shared>,
    Path(session): Path<String>,
) -> Result<Json<GrammarOrigins>, Failure> {
    let read = sessions::open(&shared, &session).await?.read().await?;
    let found = shared.pool.run(Class::Whole, Person::default(), move |_| {
        Document::from_bytes(&read.bytes).map(|document| document.grammar_origins())
    });
    let found = found.await?.map_err(|error| {
        tracing::error!(session, %error, "a session cannot be read");
        Failure::new(Reason::Failed, "The session cannot be read.")
    })?;
    found.map(Json).ok_or_else(|| Failure::new(Reason::NoGrammar, "No grammar is in force in this session."))
}
