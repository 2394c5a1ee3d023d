//! Answers to requests whose head cannot be read. The library that reads HTTP gives them itself, without a body and
//! before anything of ours is asked, so they are known by their bytes where these leave.

use axum::http::StatusCode;
use espalier_proto::{PROBLEM_JSON, Problem, Reason};

use crate::problem_json;

/// The head of such an answer is short.
const LONGEST: usize = 512;

/// An answer that says what is at fault, where these bytes are one of the library's that does not.
pub(super) fn instead(written: &[u8]) -> Option<Vec<u8>> {
    let is_short = (1..=LONGEST).contains(&written.len());
    let head = written.strip_prefix(b"HTTP/1.1 ").filter(|_| is_short)?;
    let head = str::from_utf8(head).ok()?.strip_suffix("\r\n\r\n")?;
    let mut lines = head.split("\r\n");
    let status = lines.next()?;
    let status_code = StatusCode::from_bytes(status.split(' ').next()?.as_bytes()).ok()?;
    let (field, allowed, sentence) = match status_code.as_str() {
        "400" => ("request", "a request of HTTP/1.1", "The request cannot be read: it is none of HTTP/1.1."),
        "414" => ("path", "an address of at most 65534 bytes", "The address is too long."),
        "431" => (
            "headers",
            "at most 100 headers, of 32 KiB with the address",
            "The request has too many headers, or it is too long with its address.",
        ),
        _ => return None,
    };
    // Our own answers with these states have a body.
    let others: Vec<_> = lines.filter(|line| !line.eq_ignore_ascii_case("content-length: 0")).collect();
    if others.len() + 2 != head.split("\r\n").count() {
        return None;
    }
    let problem = Problem::new(Reason::Malformed, sentence).at(field, allowed);
    let body = problem_json::body(status_code, problem);
    let mut answer =
        format!("HTTP/1.1 {status}\r\ncontent-type: {PROBLEM_JSON}\r\ncontent-length: {}\r\n", body.len());
    for line in others {
        answer.push_str(line);
        answer.push_str("\r\n");
    }
    answer.push_str("\r\n");
    Some([answer.into_bytes(), body].concat())
}
