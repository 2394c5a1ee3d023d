//! What holds for every request: where it may come from, who asks, how long it may take, what the browser may do with
//! the answer.

use std::time::Duration;

use axum::{
    extract::{RawPathParams, Request, State},
    http::{HeaderMap, HeaderName, HeaderValue, Method, StatusCode, header},
    middleware::Next,
    response::{IntoResponse, Response},
};

use espalier_proto::{Problem, Reason};
use espalier_session::Principal;

use super::failure::Failure;
use crate::authority::{Action, Authority, Object};

/// The key of the client that asks, as in its hello.
pub(super) const CLIENT: HeaderName = HeaderName::from_static("espalier-client");

/// A request whose body or answer takes longer is dropped.
const TIME_LIMIT: Duration = Duration::from_secs(30);

/// Scripts come from this server only. Styles may stand in the page, pictures may be made by the page itself.
const CONTENT_SECURITY_POLICY: &str = "default-src 'self'; \
    script-src 'self'; \
    style-src 'self' 'unsafe-inline'; \
    img-src 'self' data: blob:; \
    connect-src 'self' data: blob:; \
    worker-src 'self' blob:; \
    object-src 'none'; \
    base-uri 'none'; \
    form-action 'self'; \
    frame-ancestors 'none'";

/// A session's link is its key, so it must not travel to other sites as a referrer.
const HEADERS: [(HeaderName, HeaderValue); 5] = [
    (header::CONTENT_SECURITY_POLICY, HeaderValue::from_static(CONTENT_SECURITY_POLICY)),
    (header::X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff")),
    (header::REFERRER_POLICY, HeaderValue::from_static("same-origin")),
    (HeaderName::from_static("cross-origin-opener-policy"), HeaderValue::from_static("same-origin")),
    (HeaderName::from_static("cross-origin-resource-policy"), HeaderValue::from_static("same-origin")),
];

pub(super) async fn headers(mut response: Response) -> Response {
    for (name, value) in HEADERS {
        response.headers_mut().insert(name, value);
    }
    // Answers of the API change all the time; whoever knows better has said so.
    response.headers_mut().entry(header::CACHE_CONTROL).or_insert(HeaderValue::from_static("no-store"));
    response
}

pub(super) async fn time_limit(request: Request, next: Next) -> Response {
    match tokio::time::timeout(TIME_LIMIT, next.run(request)).await {
        Ok(response) => response,
        Err(_) => Failure::new(Reason::Late, "The request took too long.").into_response(),
    }
}

/// What is asked for at an address.
#[derive(Clone, Copy, Debug)]
pub(super) struct Asked {
    pub(super) authority: Authority,
    pub(super) action: Action,
}

/// Finds out who asks, and whether they may do what this address does to what it names.
pub(super) async fn ask(
    State(asked): State<Asked>,
    params: RawPathParams,
    mut request: Request,
    next: Next,
) -> Response {
    let principal = match principal(request.headers()) {
        Ok(principal) => principal,
        Err(problem) => return Failure::from(problem).into_response(),
    };
    let named = |name| params.iter().find(|(other, _)| *other == name).map(|(_, value)| value);
    let object = named("session").map(Object::Session).or_else(|| named("tree").map(Object::Tree));
    if !(asked.authority)(&principal, asked.action, object.unwrap_or(Object::Server)) {
        return Failure::from(espalier_session::forbidden()).into_response();
    }
    request.extensions_mut().insert(principal);
    next.run(request).await
}

fn principal(headers: &HeaderMap) -> Result<Principal, Problem> {
    let Some(key) = headers.get(CLIENT) else { return Ok(Principal::visitor()) };
    key.to_str().ok().and_then(Principal::client).ok_or_else(|| {
        Problem::new(Reason::Malformed, "The request cannot be read: its client key is none.")
            .at(CLIENT.as_str(), "8 to 64 letters, digits, - and _")
    })
}

/// Another site's page may neither open a socket (browsers allow that across sites) nor change anything here.
pub(super) async fn same_origin(request: Request, next: Next) -> Response {
    let reads = matches!(*request.method(), Method::GET | Method::HEAD) && !is_upgrade(request.headers());
    if reads || is_same_origin(request.headers()) {
        return next.run(request).await;
    }
    (StatusCode::FORBIDDEN, "This request comes from another site.").into_response()
}

fn is_upgrade(headers: &HeaderMap) -> bool {
    headers.contains_key(header::UPGRADE)
}

/// Programs that are no browsers send no origin, and nobody can make them act against their will.
fn is_same_origin(headers: &HeaderMap) -> bool {
    let Some(origin) = headers.get(header::ORIGIN) else { return true };
    let (Ok(origin), Some(Ok(host))) = (origin.to_str(), headers.get(header::HOST).map(HeaderValue::to_str))
    else {
        return false;
    };
    let origin = origin.strip_prefix("http://").or_else(|| origin.strip_prefix("https://"));
    origin.is_some_and(|origin| origin.eq_ignore_ascii_case(host))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn allowed(origin: Option<&'static str>, host: &'static str) -> bool {
        let mut headers = HeaderMap::new();
        headers.insert(header::HOST, HeaderValue::from_static(host));
        if let Some(origin) = origin {
            headers.insert(header::ORIGIN, HeaderValue::from_static(origin));
        }
        is_same_origin(&headers)
    }

    #[test]
    fn a_client_key_that_is_none_is_named_with_what_is_allowed() {
        let headers = HeaderMap::from_iter([(CLIENT, HeaderValue::from_static("seven_7"))]);
        let problem = principal(&headers).expect_err("it is too short");
        assert_eq!((problem.field.as_deref(), problem.allowed.is_some()), (Some("espalier-client"), true));
    }

    #[test]
    fn only_the_same_host_and_port_may_connect() {
        assert!(allowed(Some("http://192.168.1.7:7700"), "192.168.1.7:7700"));
        assert!(allowed(Some("https://trees.example"), "trees.example"));
        assert!(allowed(Some("https://Trees.example"), "trees.example"));
        assert!(allowed(None, "trees.example"));
        assert!(!allowed(Some("http://192.168.1.7:8080"), "192.168.1.7:7700"));
        assert!(!allowed(Some("https://evil.example"), "trees.example"));
        assert!(!allowed(Some("https://trees.example.evil"), "trees.example"));
        assert!(!allowed(Some("null"), "trees.example"));
        assert!(!allowed(Some("file://"), ""));
    }
}
