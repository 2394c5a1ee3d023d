//! What went wrong, as a status and a [`Problem`]; causes go to the log and nowhere else.

use axum::{
    Json,
    extract::{
        FromRequest, Request,
        rejection::{BytesRejection, JsonRejection, QueryRejection},
    },
    http::StatusCode,
    response::{IntoResponse, Response},
};
use espalier_proto::{Problem, ProblemCode};
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

    /// What stands behind the question mark cannot be read.
    pub(super) fn bad_query(rejection: &QueryRejection) -> Self {
        Problem::new(
            ProblemCode::Malformed,
            format!("The request cannot be read: {}.", rejection.body_text()),
        )
        .into()
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

    pub(super) fn too_large(field: Option<&str>, allowed: &str, sentence: String) -> Self {
        let problem = Problem {
            code: ProblemCode::TooMany,
            field: field.map(str::to_owned),
            allowed: Some(allowed.to_owned()),
            message: sentence,
        };
        Self { status: StatusCode::PAYLOAD_TOO_LARGE, problem }
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
            StoreError::NotFound => return Self::not_found("tree, or no such version of it"),
            StoreError::Stale => {
                let sentence = "Somebody else has changed the tree meanwhile; look at it and try again.";
                return Problem::new(ProblemCode::Stale, sentence).into();
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
        let rejection = match Json::from_request(request, state).await {
            Ok(Json(body)) => return Ok(Self(body)),
            Err(rejection) => rejection,
        };
        if rejection.status() == StatusCode::PAYLOAD_TOO_LARGE {
            return Err(Failure::too_large(None, "a smaller body", "The request is too large.".into()));
        }
        let message = match rejection {
            JsonRejection::MissingJsonContentType(_) => "The request must be application/json.".into(),
            // The cause names the field and what was expected there.
            JsonRejection::JsonDataError(error) => cause(&error),
            JsonRejection::JsonSyntaxError(error) => cause(&error),
            other => other.body_text(),
        };
        Err(Problem::new(ProblemCode::Malformed, message).into())
    }
}

fn cause(error: &dyn std::error::Error) -> String {
    let mut cause = error;
    while let Some(source) = cause.source() {
        cause = source;
    }
    format!("The request cannot be read: {cause}.")
}

pub(super) async fn unknown_route() -> Failure {
    Failure::not_found("address")
}
