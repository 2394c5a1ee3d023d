//! What went wrong, as a status and a [`Problem`]; causes go to the log and nowhere else.

use axum::{
    Json,
    body::Bytes,
    extract::{FromRequest, FromRequestParts, Request, rejection::BytesRejection},
    http::{HeaderMap, StatusCode, header, request::Parts},
    response::{IntoResponse, Response},
};
use espalier_proto::{Problem, ProblemCode, Reason, reading};
use serde::de::DeserializeOwned;

use crate::{
    live::{Ended, OpenError},
    pool::Panicked,
    store::StoreError,
};

/// A request that could not be done.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Failure {
    status: StatusCode,
    problem: Problem,
}

impl Failure {
    pub(super) fn new(reason: Reason, sentence: impl Into<String>) -> Self {
        Problem::new(reason, sentence).into()
    }

    /// There is no such thing at this address.
    pub(super) fn none_such(what: &str) -> Self {
        Self::new(Reason::NoneSuch, format!("There is no such {what}."))
    }

    pub(super) fn no_tree(more: &str) -> Self {
        Self::new(Reason::NoTree, format!("There is no such tree{more}."))
    }

    /// No collection has the identifier in this field.
    pub(super) fn no_collection(field: &str) -> Self {
        let problem = Problem::new(Reason::NoCollection, "There is no such collection.");
        problem.at(field, "the identifier of a collection").into()
    }

    pub(super) fn no_session() -> Self {
        Self::new(Reason::NoSession, "There is no such session.")
    }

    /// A file of which so many bytes are taken did not arrive.
    pub(super) fn unread(rejection: &BytesRejection, most: usize) -> Self {
        if rejection.status() == StatusCode::PAYLOAD_TOO_LARGE {
            let allowed = format!("{} MiB", most >> 20);
            let problem = Problem::new(Reason::LargeFile, format!("The file is larger than {allowed}."));
            return problem.at("body", allowed).into();
        }
        Problem::new(Reason::FileCutOff, "The file did not arrive whole.").at("body", "a whole file").into()
    }
}

impl From<Problem> for Failure {
    fn from(problem: Problem) -> Self {
        let status = match (problem.reason, problem.code) {
            (Reason::Forbidden, _) => StatusCode::FORBIDDEN,
            (Reason::LargeFile | Reason::LargeRequest | Reason::LargeThumbnail, _) => {
                StatusCode::PAYLOAD_TOO_LARGE
            }
            (_, ProblemCode::Malformed | ProblemCode::OutOfRange | ProblemCode::TooMany) => {
                StatusCode::BAD_REQUEST
            }
            (_, ProblemCode::Refused) => StatusCode::CONFLICT,
            (_, ProblemCode::NotFound) => StatusCode::NOT_FOUND,
            (_, ProblemCode::Stale) => StatusCode::PRECONDITION_FAILED,
            (_, ProblemCode::Unavailable) => StatusCode::SERVICE_UNAVAILABLE,
        };
        Self { status, problem }
    }
}

impl From<StoreError> for Failure {
    fn from(error: StoreError) -> Self {
        match error {
            StoreError::NotFound => return Self::no_tree(" or version"),
            StoreError::Stale => {
                let sentence = "Somebody else has changed the tree meanwhile; look at it and try again.";
                return Self::new(Reason::Stale, sentence);
            }
            StoreError::Cycle => {
                return Self::new(Reason::CollectionInItself, "A collection cannot lie in itself.");
            }
            StoreError::Gone(_) => {
                tracing::error!(%error, "the store failed");
                return Self::new(
                    Reason::DatabaseGone,
                    "The server's database file has been moved, deleted or replaced; nothing was changed.",
                );
            }
            _ => {}
        }
        tracing::error!(%error, "the store failed");
        let sentence = "The server cannot use its database now; nothing was changed. Is its disk full?";
        Self::new(Reason::DatabaseFailed, sentence)
    }
}

impl From<OpenError> for Failure {
    fn from(error: OpenError) -> Self {
        match error {
            OpenError::Store(_) => {
                tracing::error!(%error, "a session could not be opened");
                Self::new(Reason::NotOpened, "The session cannot be opened now.")
            }
            OpenError::Stopping => error.problem().into(),
            error => {
                tracing::error!(%error, "a session cannot be opened");
                error.problem().into()
            }
        }
    }
}

impl From<Ended> for Failure {
    fn from(Ended: Ended) -> Self {
        Self::new(Reason::SessionEnded, "The session has just ended; try again.")
    }
}

impl From<Panicked> for Failure {
    fn from(error: Panicked) -> Self {
        tracing::error!(%error, "a request failed");
        Self::new(Reason::Failed, "The server failed to compute this; nothing was changed.")
    }
}

impl IntoResponse for Failure {
    fn into_response(self) -> Response {
        (self.status, Json(self.problem)).into_response()
    }
}

/// The body of a request, or a problem that says what is wrong with it.
#[derive(Debug)]
pub(super) struct Body<T>(pub(super) T);

impl<T: DeserializeOwned, S: Send + Sync> FromRequest<S> for Body<T> {
    type Rejection = Failure;

    async fn from_request(request: Request, state: &S) -> Result<Self, Failure> {
        if !is_json(request.headers()) {
            let problem = Problem::new(Reason::Malformed, "The request must be application/json.");
            return Err(problem.at("content-type", "application/json").into());
        }
        let bytes = Bytes::from_request(request, state).await.map_err(|rejection| -> Failure {
            if rejection.status() == StatusCode::PAYLOAD_TOO_LARGE {
                let problem = Problem::new(Reason::LargeRequest, "The request is too large.");
                return problem.at("body", "a smaller body").into();
            }
            Problem::new(Reason::Malformed, "The request cannot be read: it did not arrive whole.")
                .at("body", "a whole body")
                .into()
        })?;
        // Bytes that are no text are no JSON, and the reader says so.
        Ok(Self(reading::from_json(&String::from_utf8_lossy(&bytes))?))
    }
}

fn is_json(headers: &HeaderMap) -> bool {
    let found = headers.get(header::CONTENT_TYPE).and_then(|value| value.to_str().ok()).unwrap_or_default();
    let essence = found.split(';').next().unwrap_or_default().trim();
    essence.eq_ignore_ascii_case("application/json")
}

/// What stands behind the question mark of an address, or a problem that says what is wrong with it.
#[derive(Debug)]
pub(super) struct Query<T>(pub(super) T);

impl<T: DeserializeOwned, S: Send + Sync> FromRequestParts<S> for Query<T> {
    type Rejection = Failure;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Failure> {
        Ok(Self(reading::from_query(parts.uri.query().unwrap_or_default())?))
    }
}

pub(super) async fn unknown_route() -> Failure {
    Failure::none_such("address")
}

#[cfg(test)]
mod tests {
    use axum::{Router, body::Body as Bytes, routing::post};
    use espalier_proto::library::{CopyTree, NewSession};
    use espalier_settings::ParameterValues;
    use serde_json::{Value, json};
    use tower::ServiceExt;

    use super::*;
    use crate::http::{imports::Upload, trees::Page};

    async fn take<T>(_: Body<T>) {}
    async fn ask<T>(_: Query<T>) {}

    /// Addresses for some of the bodies and queries that the API reads.
    fn router() -> Router {
        Router::new()
            .route("/sessions", post(take::<NewSession>))
            .route("/tree", post(take::<CopyTree>))
            .route("/schematic", post(take::<ParameterValues>))
            .route("/list", post(ask::<Page>))
            .route("/import", post(ask::<Upload>))
    }

    async fn answer(address: &str, body: String) -> (StatusCode, Value) {
        let request = Request::post(address).header(header::CONTENT_TYPE, "application/json; charset=utf-8");
        let response = router().oneshot(request.body(Bytes::from(body)).unwrap()).await.unwrap();
        let status = response.status();
        let bytes = axum::body::to_bytes(response.into_body(), usize::MAX).await.unwrap();
        (status, serde_json::from_slice(&bytes).unwrap_or_default())
    }

    #[tokio::test]
    async fn what_is_right_is_taken() {
        for (address, body) in [
            ("/sessions", json!({})),
            ("/tree", json!({ "name": "5" })),
            ("/schematic", json!(ParameterValues::default())),
            ("/list", Value::Null),
            ("/list?limit=5", Value::Null),
            ("/import?name=5&format=mtg&unit=0.5&internode_length=1", Value::Null),
            ("/import?name=A+tall%20tree&format=true", Value::Null),
        ] {
            let (status, said) = answer(address, body.to_string()).await;
            assert_eq!(status, StatusCode::OK, "{address}: {said}");
        }
    }

    #[tokio::test]
    async fn what_is_no_json_is_said_to_be_none() {
        for text in ["", "{", "seed=1"] {
            let (status, problem) = answer("/sessions", text.into()).await;
            assert_eq!((status, problem["allowed"].as_str()), (StatusCode::BAD_REQUEST, Some("JSON")));
        }
        let request = Request::post("/sessions").body(Bytes::from("{}")).unwrap();
        assert_eq!(router().oneshot(request).await.unwrap().status(), StatusCode::BAD_REQUEST);
    }
}
