//! What went wrong, as a status and a [`Problem`]; causes go to the log and nowhere else.

use axum::{
    Json,
    body::Bytes,
    extract::{FromRequest, FromRequestParts, Request, rejection::BytesRejection},
    http::{HeaderMap, StatusCode, header, request::Parts},
    response::{IntoResponse, Response},
};
use espalier_proto::{Problem, ProblemCode, reading};
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
    pub(super) fn not_found(what: &str) -> Self {
        Problem::new(ProblemCode::NotFound, format!("There is no such {what}.")).into()
    }

    pub(super) fn unavailable(sentence: &str) -> Self {
        Problem::new(ProblemCode::Unavailable, sentence).into()
    }

    pub(super) fn conflict(sentence: impl Into<String>) -> Self {
        Problem::new(ProblemCode::Refused, sentence).into()
    }

    pub(super) fn forbidden() -> Self {
        Self { status: StatusCode::FORBIDDEN, problem: espalier_session::forbidden() }
    }

    /// A file of which so many bytes are taken did not arrive.
    pub(super) fn unread(rejection: &BytesRejection, most: usize) -> Self {
        if rejection.status() == StatusCode::PAYLOAD_TOO_LARGE {
            let allowed = format!("{} MiB", most >> 20);
            let sentence = format!("The file is larger than {allowed}.");
            return Self::too_large(None, &allowed, sentence);
        }
        Problem::new(ProblemCode::Malformed, "The file did not arrive whole.").into()
    }

    fn too_large(field: Option<&str>, allowed: &str, sentence: String) -> Self {
        let problem = Problem {
            code: ProblemCode::TooMany,
            field: field.map(str::to_owned),
            allowed: Some(allowed.to_owned()),
            message: sentence,
        };
        Self { status: StatusCode::PAYLOAD_TOO_LARGE, problem }
    }

    /// A thumbnail that is none, or too large.
    pub(super) fn of_thumbnail(problem: Problem) -> Self {
        match problem.code {
            ProblemCode::TooMany => Self { status: StatusCode::PAYLOAD_TOO_LARGE, problem },
            _ => problem.into(),
        }
    }
}

impl From<Problem> for Failure {
    fn from(problem: Problem) -> Self {
        let status = match problem.code {
            ProblemCode::Malformed | ProblemCode::OutOfRange | ProblemCode::TooMany => {
                StatusCode::BAD_REQUEST
            }
            ProblemCode::Refused => StatusCode::CONFLICT,
            ProblemCode::NotFound => StatusCode::NOT_FOUND,
            ProblemCode::Stale => StatusCode::PRECONDITION_FAILED,
            ProblemCode::Unavailable => StatusCode::SERVICE_UNAVAILABLE,
        };
        Self { status, problem }
    }
}

impl From<StoreError> for Failure {
    fn from(error: StoreError) -> Self {
        match error {
            StoreError::NotFound => return Self::not_found("tree, version or collection"),
            StoreError::Stale => {
                let sentence = "Somebody else has changed the tree meanwhile; look at it and try again.";
                return Problem::new(ProblemCode::Stale, sentence).into();
            }
            StoreError::Cycle => return Self::conflict("A collection cannot lie in itself."),
            StoreError::Gone(_) => {
                tracing::error!(%error, "the store failed");
                return Self::unavailable(
                    "The server's database file has been moved, deleted or replaced; nothing was changed.",
                );
            }
            _ => {}
        }
        tracing::error!(%error, "the store failed");
        Self::unavailable("The server cannot use its database now; nothing was changed. Is its disk full?")
    }
}

impl From<OpenError> for Failure {
    fn from(error: OpenError) -> Self {
        match error {
            OpenError::Stopping => Self::unavailable("The server is stopping."),
            error if error.is_final() => {
                tracing::error!(%error, "a session cannot be opened");
                Self::conflict(error.to_string())
            }
            error => {
                tracing::error!(%error, "a session could not be opened");
                Self::unavailable("The session cannot be opened now.")
            }
        }
    }
}

impl From<Ended> for Failure {
    fn from(Ended: Ended) -> Self {
        Self::unavailable("The session has just ended; try again.")
    }
}

impl From<Panicked> for Failure {
    fn from(error: Panicked) -> Self {
        tracing::error!(%error, "a request failed");
        Self::unavailable("The server failed to compute this; nothing was changed.")
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
            let allowed = Some("application/json".into());
            let problem = Problem::new(ProblemCode::Malformed, "The request must be application/json.");
            return Err(Problem { allowed, ..problem }.into());
        }
        let bytes = Bytes::from_request(request, state).await.map_err(|rejection| {
            if rejection.status() == StatusCode::PAYLOAD_TOO_LARGE {
                return Failure::too_large(None, "a smaller body", "The request is too large.".into());
            }
            Problem::new(ProblemCode::Malformed, "The request cannot be read: it did not arrive whole.")
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
    Failure::not_found("address")
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
