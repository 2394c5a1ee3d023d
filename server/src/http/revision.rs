//! Revisions of trees, users and groups, as `ETag` and `If-Match` have them.

use axum::{
    extract::{FromRequestParts, Request},
    http::{HeaderName, HeaderValue, header, request::Parts},
    middleware::Next,
    response::{IntoResponse, Response},
};
use espalier_proto::{Problem, Reason};

use super::failure::Failure;

/// Refuses a change that holds for one revision alone where nothing has revisions: it must not be made all the same.
pub(super) async fn none_here(request: Request, next: Next) -> Response {
    let holds_for = request.headers().get(header::IF_MATCH).filter(|value| *value != "*");
    if holds_for.is_none() || request.method().is_safe() {
        return next.run(request).await;
    }
    let sentence = "The request cannot be done: If-Match asks for a revision, and nothing here has one.";
    let problem = Problem::new(Reason::Malformed, sentence).at(header::IF_MATCH.as_str(), "none, or *");
    Failure::from(problem).into_response()
}

/// The header that names a revision.
pub(super) fn tag(revision: u64) -> [(HeaderName, HeaderValue); 1] {
    let value = HeaderValue::try_from(format!("\"{revision}\""));
    [(header::ETAG, value.unwrap_or(HeaderValue::from_static("\"\"")))]
}

/// The revision that a request changes; none if it changes whichever there is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Expected(pub(super) Option<u64>);

impl<S: Sync> FromRequestParts<S> for Expected {
    type Rejection = Failure;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Failure> {
        let Some(value) = parts.headers.get(header::IF_MATCH) else { return Ok(Self(None)) };
        let text = value.to_str().unwrap_or_default().trim();
        if text == "*" {
            return Ok(Self(None));
        }
        let number = text.strip_prefix('"').and_then(|rest| rest.strip_suffix('"'));
        let revision = number.and_then(|number| number.parse().ok());
        let problem = || {
            Problem::new(Reason::Malformed, format!("The request cannot be read: If-Match is {text}."))
                .at(header::IF_MATCH.as_str(), "an ETag of what is changed, as \"3\"")
        };
        revision.map(|revision| Self(Some(revision))).ok_or_else(|| problem().into())
    }
}
