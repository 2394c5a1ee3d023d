//! What went wrong, as a status and a [`Problem`]; causes go to the log and nowhere else.

use std::{fmt, time::Duration};

use axum::{
    Extension,
    body::Bytes,
    extract::{
        self, DefaultBodyLimit, FromRequest, FromRequestParts, Request, path::ErrorKind,
        rejection::PathRejection,
    },
    http::{HeaderMap, HeaderValue, StatusCode, Uri, header, request::Parts},
    middleware::Next,
    response::{IntoResponse, Response},
};
use espalier_proto::{Problem, ProblemCode, Reason, reading};
use serde::{Deserialize, de::DeserializeOwned};

use crate::{
    access::{self, Unknown},
    formats::FormatRow,
    live::{Ended, OpenError, Unread},
    memory::{AGAIN, Full},
    pool::Panicked,
    problem_json,
    similar::asked_for,
    store::{Missing, StoreError},
};

/// A request that could not be done.
#[derive(Debug, PartialEq, Eq)]
pub struct Failure {
    status: StatusCode,
    problem: Problem,
    /// Seconds to wait before trying again, where they are known.
    wait: Option<u16>,
}

impl Failure {
    pub(super) fn new(reason: Reason, sentence: impl Into<String>) -> Self {
        Problem::new(reason, sentence).into()
    }

    pub(super) fn status(&self) -> StatusCode {
        self.status
    }

    /// The same may be tried again after so long.
    pub(super) fn after(self, wait: Duration) -> Self {
        Self { wait: Some(whole_seconds(wait)), ..self }
    }

    /// What `field` asks for was asked for too often; it can be asked for again after so long.
    pub(super) fn too_often(field: &str, sentence: &str, wait: Duration) -> Self {
        let problem = Problem::new(Reason::TooOften, sentence)
            .at(field, format!("another try after {} s", whole_seconds(wait)));
        Self::from(problem).after(wait)
    }

    /// There is no such thing as `field` names; `allowed` there is what is.
    pub(super) fn none_such(what: &str, field: &str, allowed: &str) -> Self {
        Problem::new(Reason::NoneSuch, format!("There is no such {what}.")).at(field, allowed).into()
    }

    pub(super) fn no_address() -> Self {
        Self::none_such("address", "path", "one of those in /api/v1/openapi.json")
    }

    /// The address takes these methods, and not the one that was tried.
    pub(super) fn wrong_method(allowed: &str) -> Self {
        let sentence = format!("This address does not take this method; allowed: {allowed}.");
        Problem::new(Reason::WrongMethod, sentence).at("method", allowed).into()
    }

    pub(super) fn no_tree(more: &str) -> Self {
        let end = if more.ends_with('?') { "" } else { "." };
        let problem = Problem::new(Reason::NoTree, format!("There is no such tree{more}{end}"));
        problem.at(Missing::Tree.field(), "the identifier of a tree in the library").into()
    }

    pub(super) fn no_version() -> Self {
        Self::none_such("version", Missing::Version.field(), "the number of a version of the tree")
    }

    pub(super) fn no_session() -> Self {
        let problem = Problem::new(Reason::NoSession, "There is no such session.");
        problem.at("session", "the name of a session").into()
    }

    /// What is wrong, where asking again is of no use.
    pub(super) fn final_problem(self) -> Result<Problem, Self> {
        if self.status.is_client_error() { Ok(self.problem) } else { Err(self) }
    }
}

impl From<Problem> for Failure {
    fn from(problem: Problem) -> Self {
        let status = match (problem.reason, problem.code) {
            (
                Reason::Forbidden
                | Reason::OtherSite
                | Reason::TreeLocked
                | Reason::Removed
                | Reason::RemovedGuest,
                _,
            ) => StatusCode::FORBIDDEN,
            (Reason::WrongMethod, _) => StatusCode::METHOD_NOT_ALLOWED,
            (Reason::TooOften, _) => StatusCode::TOO_MANY_REQUESTS,
            (Reason::NotLetIn | Reason::WrongPassword, _) => StatusCode::UNAUTHORIZED,
            (Reason::KeyOfAnother, _) => StatusCode::UNPROCESSABLE_ENTITY,
            (Reason::UnknownHost, _) => StatusCode::MISDIRECTED_REQUEST,
            (Reason::PackedRequest, _) => StatusCode::UNSUPPORTED_MEDIA_TYPE,
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
        Self { status, problem, wait: None }
    }
}

impl From<Unknown> for Failure {
    fn from(unknown: Unknown) -> Self {
        match unknown {
            Unknown::NotLetIn => access::not_let_in().into(),
            Unknown::Twofold => Problem::new(Reason::Malformed, "The request has a token and a cookie.")
                .at("authorization", "a token, or a cookie, and not both")
                .into(),
            Unknown::Store(error) => error.into(),
        }
    }
}

impl From<StoreError> for Failure {
    fn from(error: StoreError) -> Self {
        match error {
            StoreError::NotFound(missing) => return missing.into(),
            StoreError::Stale => {
                let sentence = "Somebody else has changed it meanwhile; look at it and try again.";
                let problem = Problem::new(Reason::Stale, sentence);
                return problem.at(header::IF_MATCH.as_str(), "the ETag of it as it is now").into();
            }
            StoreError::Full => {
                return Problem::new(Reason::TooMany, "There is no room for more of this.")
                    .at(BODY, "fewer of them")
                    .into();
            }
            StoreError::NotDeleted => {
                let problem = Problem::new(Reason::NotDeleted, "The tree is not deleted.");
                return problem.at(Missing::Tree.field(), "a tree that is deleted").into();
            }
            StoreError::Taken => {
                let problem =
                    Problem::new(Reason::NameTaken, "Somebody or something goes by this name already.");
                return problem.at("name", "a name that is not taken").into();
            }
            StoreError::LastAdmin => {
                let sentence = "Nobody else is an administrator: make somebody else one first.";
                let problem = Problem::new(Reason::LastAdmin, sentence);
                return problem.at("user", "somebody who is not the last administrator").into();
            }
            StoreError::Cycle => {
                let problem = Problem::new(Reason::CollectionInItself, "A collection cannot lie in itself.");
                return problem.at("parent", "a collection that does not lie in this one").into();
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

impl From<Missing> for Failure {
    fn from(missing: Missing) -> Self {
        match missing {
            Missing::Tree => Self::no_tree(""),
            Missing::Version => Self::no_version(),
            Missing::User => Self::none_such("user", missing.field(), "the name of somebody who can log in"),
            Missing::Group => Self::none_such("group", missing.field(), "the name of a group"),
            Missing::Pass => access::not_let_in().into(),
            Missing::Collection | Missing::Parent => {
                let problem = Problem::new(Reason::NoCollection, "There is no such collection.");
                problem.at(missing.field(), "the identifier of a collection").into()
            }
        }
    }
}

impl From<OpenError> for Failure {
    fn from(error: OpenError) -> Self {
        match error {
            OpenError::Store(_) => {
                tracing::error!(%error, "a session could not be opened");
                Self::new(Reason::NotOpened, "The session cannot be opened now.")
            }
            OpenError::Memory(full) => full.into(),
            OpenError::Ended | OpenError::Stopping => error.problem().into(),
            error => {
                tracing::error!(%error, "a session cannot be opened");
                error.problem().into()
            }
        }
    }
}

impl From<Full> for Failure {
    fn from(Full: Full) -> Self {
        let sentence = "The server has no memory left for this now; nothing was changed. Try again.";
        Self::new(Reason::MemoryFull, sentence).after(AGAIN)
    }
}

impl From<Ended> for Failure {
    fn from(Ended: Ended) -> Self {
        Self::new(Reason::SessionEnded, "The session has just ended; try again.")
    }
}

impl From<Unread> for Failure {
    fn from(unread: Unread) -> Self {
        match unread {
            Unread::Ended => Ended.into(),
            Unread::Memory(full) => full.into(),
        }
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
        let is_no_tree = self.problem.reason == Reason::NoTree;
        let mut response = problem_json::answer(self.status, self.problem);
        if is_no_tree {
            response.extensions_mut().insert(NoTree);
        }
        if self.status == StatusCode::UNAUTHORIZED {
            // How a program comes in; a page has a cookie.
            response.headers_mut().insert(header::WWW_AUTHENTICATE, HeaderValue::from_static("Bearer"));
        }
        if let Some(wait) = self.wait {
            response.headers_mut().insert(header::RETRY_AFTER, wait.into());
        }
        response
    }
}

/// Marks the answer to whoever asked for a tree that is not there.
#[derive(Clone, Copy, Debug)]
pub(super) struct NoTree;

fn whole_seconds(wait: Duration) -> u16 {
    let seconds = wait.as_secs() + u64::from(wait.subsec_nanos() > 0);
    seconds.try_into().unwrap_or(u16::MAX)
}

/// The most bytes that the body of a request may have.
#[derive(Clone, Copy, Debug)]
pub(super) struct MostBytes(usize);

impl Default for MostBytes {
    /// What is taken where no [`body_limit`] is set.
    fn default() -> Self {
        Self(2 << 20)
    }
}

impl MostBytes {
    /// How many.
    pub(super) const fn bytes(self) -> usize {
        self.0
    }

    /// The most for the body of this request.
    pub(super) fn of(request: &Request) -> Self {
        request.extensions().get().copied().unwrap_or_default()
    }

    /// Whether a request says that its body has more, so that nobody need wait for it.
    pub(super) fn are_exceeded(self, headers: &HeaderMap) -> bool {
        let said = headers.get(header::CONTENT_LENGTH).and_then(|said| said.to_str().ok());
        said.and_then(|said| said.parse::<u64>().ok()).is_some_and(|said| said > self.0 as u64)
    }

    /// The problem with a body that has more.
    pub(super) fn exceeded(self) -> Problem {
        let problem = Problem::new(Reason::LargeRequest, format!("The request is larger than {self}."));
        problem.at(BODY, self.to_string())
    }
}

impl fmt::Display for MostBytes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(bytes) = self;
        if bytes % (1 << 20) == 0 {
            write!(f, "{} MiB", bytes >> 20)
        } else {
            write!(f, "{} KiB", bytes >> 10)
        }
    }
}

/// Refuses bodies with more bytes; the refusal says how many are taken.
pub(super) fn body_limit(most: usize) -> (DefaultBodyLimit, Extension<MostBytes>) {
    (DefaultBodyLimit::max(most), Extension(MostBytes(most)))
}

/// The field of a problem with a body as a whole.
pub(super) const BODY: &str = "body";

/// The bytes of a body.
async fn arrived<S: Send + Sync>(request: Request, state: &S) -> Result<Bytes, Failure> {
    let most = MostBytes::of(&request);
    if most.are_exceeded(request.headers()) {
        return Err(most.exceeded().into());
    }
    Bytes::from_request(request, state).await.map_err(|rejection| {
        let problem = if rejection.status() == StatusCode::PAYLOAD_TOO_LARGE {
            most.exceeded()
        } else {
            Problem::new(Reason::Malformed, "The request did not arrive whole.").at(BODY, "a whole request")
        };
        problem.into()
    })
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
        let bytes = arrived(request, state).await?;
        let text =
            str::from_utf8(&bytes).map_err(|_| reading::unexpected(BODY, "no text", "JSON in UTF-8"))?;
        // A problem with no part of the body is one with all of it.
        let named = |problem: Problem| Problem { field: problem.field.or(Some(BODY.into())), ..problem };
        Ok(Self(reading::from_json(text).map_err(named)?))
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

/// Nothing stands behind the question mark.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Nothing {}

/// Refuses a query where none is read, so that a name that is mistyped is not taken for one that was obeyed.
pub(super) async fn without_query(_: Query<Nothing>, request: Request, next: Next) -> Response {
    next.run(request).await
}

/// What stands in the path of an address where its row has names, or a problem that says what is wrong with it.
#[derive(Debug)]
pub(super) struct Path<T>(pub(super) T);

impl<T: DeserializeOwned + Send, S: Send + Sync> FromRequestParts<S> for Path<T> {
    type Rejection = Failure;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Failure> {
        let named = extract::Path::<Vec<(String, String)>>::from_request_parts(parts, state).await;
        let names = named.map_err(|rejection| unread_path(&[], rejection))?.0;
        let read = extract::Path::<T>::from_request_parts(parts, state).await;
        read.map(|path| Self(path.0)).map_err(|rejection| unread_path(&names, rejection))
    }
}

fn unread_path(names: &[(String, String)], rejection: PathRejection) -> Failure {
    let PathRejection::FailedToDeserializePathParams(error) = rejection else { return Failure::no_address() };
    let at = |index: usize| names.get(index).map(|(name, _)| name.clone());
    let (field, found, expected) = match error.into_kind() {
        ErrorKind::InvalidUtf8InPathParam { key } => (Some(key), "no text".into(), reading::ENCODED),
        ErrorKind::ParseErrorAtIndex { index, value, expected_type } => (at(index), value, expected_type),
        ErrorKind::ParseError { value, expected_type } => (at(0), value, expected_type),
        _ => return Failure::no_address(),
    };
    field.map_or_else(Failure::no_address, |field| reading::unexpected(&field, &found, expected).into())
}

/// Refuses what is packed (`Content-Encoding`): nothing here unpacks it, and it would be read as what it is not.
pub(super) async fn unpacked(request: Request, next: Next) -> Response {
    let packed = request.headers().get_all(header::CONTENT_ENCODING).iter();
    let mut packed = packed.filter(|coding| !coding.as_bytes().eq_ignore_ascii_case(b"identity"));
    let Some(coding) = packed.next() else { return next.run(request).await };
    let coding: String = String::from_utf8_lossy(coding.as_bytes()).chars().take(LONGEST_CODING).collect();
    let problem = Problem::new(
        Reason::PackedRequest,
        format!("The request is packed ({coding:?}), and is read as it is alone."),
    );
    let problem = Problem { cause: Some(coding), ..problem };
    Failure::from(problem.at(header::CONTENT_ENCODING.as_str(), "identity, or no such header"))
        .into_response()
}

/// As much of a name of a packing as a sentence tells again.
const LONGEST_CODING: usize = 40;

/// Refuses a path that cannot be read, before anybody else looks at it.
pub(super) async fn legible(_: Path<Vec<(String, String)>>, request: Request, next: Next) -> Response {
    next.run(request).await
}

pub(super) async fn unknown_route(address: Uri) -> Failure {
    let file = address.path().rsplit('/').next().and_then(|file| file.strip_prefix("tree."));
    let Some(ending) = file else { return Failure::no_address() };
    let sentence = format!("There is no such format{}.", asked_for(ending, FormatRow::endings()));
    let all: Vec<_> = FormatRow::endings().map(|ending| format!("tree.{ending}")).collect();
    Problem::new(Reason::NoneSuch, sentence).at("path", all.join(", ")).into()
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

    async fn answer(address: &str, body: impl Into<Bytes>) -> (StatusCode, Value) {
        let request = Request::post(address).header(header::CONTENT_TYPE, "application/json; charset=utf-8");
        let response = router().oneshot(request.body(body.into()).unwrap()).await.unwrap();
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
            ("/import?name=A+tall%20tree&format=MTG", Value::Null),
        ] {
            let (status, said) = answer(address, body.to_string()).await;
            assert_eq!(status, StatusCode::OK, "{address}: {said}");
        }
    }

    #[tokio::test]
    async fn what_is_no_json_is_said_to_be_none() {
        for (text, allowed) in [
            (&b""[..], "JSON"),
            (b"{", "JSON"),
            (b"seed=1", "JSON"),
            (b"\"x\"", "an object"),
            (b"null", "an object"),
            (b"{\"name\":\"\xff\"}", "JSON in UTF-8"),
        ] {
            let (status, problem) = answer("/tree", text).await;
            let found = ["field", "allowed"].map(|name| problem[name].as_str());
            assert_eq!(
                (status, found),
                (StatusCode::BAD_REQUEST, [Some("body"), Some(allowed)]),
                "{problem}"
            );
        }
        let request = Request::post("/sessions").body(Bytes::from("{}")).unwrap();
        assert_eq!(router().oneshot(request).await.unwrap().status(), StatusCode::BAD_REQUEST);
    }
}
