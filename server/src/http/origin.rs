//! Where a request may come from: under a name of this server, and from its own pages.

use axum::{
    extract::{Request, State},
    http::{HeaderMap, HeaderName, HeaderValue, header},
    middleware::Next,
    response::{IntoResponse, Response},
};
use espalier_proto::{Problem, Reason};

use super::failure::Failure;
use crate::hosts::Hosts;

/// What browsers say of the page that asks; over plain http only to localhost.
const SEC_FETCH_SITE: HeaderName = HeaderName::from_static("sec-fetch-site");
/// What they say of pages of this server, and where somebody follows a bookmark.
const OWN_SITES: [&str; 2] = ["same-origin", "none"];

/// A request under a name that is not this server's own is not for it (`GU1`): a page of another site may have had its
/// name lead here, and would then pass for a page of this server.
pub(super) async fn known_host(State(hosts): State<Hosts>, request: Request, next: Next) -> Response {
    let all = request.headers().get_all(header::HOST).iter();
    if all.count() > 1 {
        let problem = Problem::new(Reason::Malformed, "The request has two Host headers.");
        return Failure::from(problem.at(header::HOST.as_str(), "one")).into_response();
    }
    let host = request.headers().get(header::HOST).and_then(|host| host.to_str().ok()).unwrap_or_default();
    if hosts.have(host) {
        return next.run(request).await;
    }
    let sentence =
        format!("This server is not known as {host:?}; `espalier serve --host-name` gives it more names.");
    let problem = Problem::new(Reason::UnknownHost, sentence);
    Failure::from(problem.at(header::HOST.as_str(), "an address or a name of this server")).into_response()
}

/// Where figures of the server are, for programs that expect them there.
pub(super) const METRICS: &str = "/metrics";

/// Pages of other sites may neither change anything here, nor open a socket, which browsers allow across sites, nor read
/// what the API says (`GU2`). Links to pages and files are free.
pub(super) async fn same_site(request: Request, next: Next) -> Response {
    let path = request.uri().path();
    let is_free = request.method().is_safe()
        && !request.headers().contains_key(header::UPGRADE)
        && !path.starts_with("/api/")
        && path != METRICS;
    match check_site(request.headers()) {
        Err(problem) if !is_free => Failure::from(problem).into_response(),
        _ => next.run(request).await,
    }
}

/// Programs that are no browsers say nothing of where they ask from, and nobody can make them act against their will.
fn check_site(headers: &HeaderMap) -> Result<(), Problem> {
    let (name, allowed, is_own) = if let Some(site) = headers.get(SEC_FETCH_SITE) {
        (SEC_FETCH_SITE, OWN_SITES.join(", "), OWN_SITES.iter().any(|own| site == own))
    } else if let Some(origin) = headers.get(header::ORIGIN) {
        let text = |value: &HeaderValue| value.to_str().ok().map(str::to_owned);
        let (origin, host) = (text(origin), headers.get(header::HOST).and_then(text));
        let origin = origin
            .as_deref()
            .and_then(|origin| origin.strip_prefix("http://").or_else(|| origin.strip_prefix("https://")));
        let is_own =
            origin.zip(host.as_deref()).is_some_and(|(origin, host)| origin.eq_ignore_ascii_case(host));
        (header::ORIGIN, "http:// or https:// and the host that is asked".to_owned(), is_own)
    } else {
        return Ok(());
    };
    let problem = || Problem::new(Reason::OtherSite, "This request comes from another site.");
    if is_own { Ok(()) } else { Err(problem().at(name.as_str(), allowed)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(from: &[(HeaderName, &'static str)], host: &'static str) -> Option<Problem> {
        let mut headers = HeaderMap::new();
        headers.insert(header::HOST, HeaderValue::from_static(host));
        headers.extend(from.iter().map(|(name, value)| (name.clone(), HeaderValue::from_static(value))));
        check_site(&headers).err()
    }

    fn allowed(from: &[(HeaderName, &'static str)], host: &'static str) -> bool {
        refused(from, host).is_none()
    }

    #[test]
    fn gu2_the_header_that_says_so_is_named() {
        let from = |name: HeaderName, value| refused(&[(name, value)], "localhost:7700");
        let at = |problem: Option<Problem>| problem.and_then(|problem| problem.field.zip(problem.allowed));
        let site = at(from(SEC_FETCH_SITE, "cross-site"));
        assert_eq!(site, Some(("sec-fetch-site".into(), "same-origin, none".into())));
        let origin = at(from(header::ORIGIN, "http://evil.example"));
        assert_eq!(origin.map(|(field, _)| field).as_deref(), Some("origin"));
    }

    #[test]
    fn gu2_only_pages_of_the_same_host_and_port_may_ask() {
        let from = |origin| allowed(&[(header::ORIGIN, origin)], "192.168.1.7:7700");
        assert!(from("http://192.168.1.7:7700"));
        assert!(!from("http://192.168.1.7:8080"));
        assert!(!from("https://evil.example"));
        assert!(!from("null"));
        let from = |origin| allowed(&[(header::ORIGIN, origin)], "trees.example");
        assert!(from("https://trees.example") && from("https://Trees.example"));
        assert!(!from("https://trees.example.evil"));
        assert!(allowed(&[], "trees.example"));
        assert!(!allowed(&[(header::ORIGIN, "file://")], ""));
    }

    #[test]
    fn gu2_what_the_browser_says_of_the_page_counts_first() {
        let own = (header::ORIGIN, "http://localhost:7700");
        for (site, expected) in
            [("same-origin", true), ("none", true), ("same-site", false), ("cross-site", false)]
        {
            assert_eq!(allowed(&[(SEC_FETCH_SITE, site), own.clone()], "localhost:7700"), expected, "{site}");
        }
    }
}
