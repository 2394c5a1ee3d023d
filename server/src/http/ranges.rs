//! Files that are downloaded, whole or in parts (`RG1`).

use std::{
    io::{Cursor, Read, Seek, SeekFrom},
    ops::Range,
};

use axum::{
    body::Body,
    http::{HeaderMap, StatusCode, header},
    response::{IntoResponse, IntoResponseParts, Response},
};
use espalier_proto::{
    Problem, Reason,
    ranges::{Beyond, part},
};
use sha2::{Digest, Sha256};

use super::{exports, failure::Failure};
use crate::problem_json;

/// Bytes of the hash in a tag.
const TAG_BYTES: usize = 16;

/// The `ETag` of a file that is the same wherever these are.
pub(super) fn tag(parts: &[&[u8]]) -> String {
    let mut hash = Sha256::new();
    for part in parts {
        hash.update((part.len() as u64).to_le_bytes());
        hash.update(part);
    }
    let hash: String = hash.finalize().iter().take(TAG_BYTES).map(|byte| format!("{byte:02x}")).collect();
    format!("\"{hash}\"")
}

/// Answers with a file of so many bytes, or with the part of it that is asked for.
pub(super) fn answer(
    asked: &HeaderMap,
    said: impl IntoResponseParts,
    tag: &str,
    mut file: impl Read + Seek + Send + 'static,
    length: u64,
) -> Result<Response, Failure> {
    if is_known(asked, tag) {
        return Ok(not_modified(said, tag));
    }
    let Ok(part) = wanted(asked, tag, length) else { return Ok(beyond(length)) };
    let status = if part.is_some() { StatusCode::PARTIAL_CONTENT } else { StatusCode::OK };
    let place = part
        .clone()
        .map(|part| [(header::CONTENT_RANGE, format!("bytes {}-{}/{length}", part.start, part.end - 1))]);
    let Range { start, end } = part.unwrap_or(0..length);
    file.seek(SeekFrom::Start(start)).map_err(|error| {
        tracing::error!(%error, "a file that is kept cannot be read");
        Failure::new(Reason::NotExported, "The file cannot be read.")
    })?;
    let size = [
        (header::ACCEPT_RANGES, "bytes".to_owned()),
        (header::CONTENT_LENGTH, (end - start).to_string()),
        (header::ETAG, tag.to_owned()),
    ];
    Ok((status, said, size, place, exports::body_of(file.take(end - start))).into_response())
}

/// The same with bytes, which tell their tag.
pub(super) fn answer_with(
    asked: &HeaderMap,
    said: impl IntoResponseParts,
    bytes: Vec<u8>,
) -> Result<Response, Failure> {
    let (tag, length) = (tag(&[&bytes]), bytes.len() as u64);
    answer(asked, said, &tag, Cursor::new(bytes), length)
}

/// Answers with a file whose length nobody knows yet. Where it is cut off, the rest can be asked for as a part.
pub(super) fn begun(said: impl IntoResponseParts, tag: &str, body: Body) -> Response {
    let known = [(header::ACCEPT_RANGES, "bytes".to_owned()), (header::ETAG, tag.to_owned())];
    (said, known, body).into_response()
}

/// Whether whoever asks has the file of this tag already (`If-None-Match`).
pub(super) fn is_known(asked: &HeaderMap, tag: &str) -> bool {
    let tags = asked.get_all(header::IF_NONE_MATCH).iter().filter_map(|tags| tags.to_str().ok());
    let bare = |tag: &str| tag.trim().trim_start_matches("W/").to_owned();
    tags.flat_map(|tags| tags.split(',')).any(|one| one.trim() == "*" || bare(one) == bare(tag))
}

/// Says that the file is still the one that whoever asks has.
pub(super) fn not_modified(said: impl IntoResponseParts, tag: &str) -> Response {
    (StatusCode::NOT_MODIFIED, said, [(header::ETAG, tag.to_owned())]).into_response()
}

fn beyond(length: u64) -> Response {
    let problem = Problem::out_of_range(
        "range",
        "behind the end",
        format!("bytes from 0 to {length}, without the last"),
    );
    let place = [(header::CONTENT_RANGE, format!("bytes */{length}"))];
    (place, problem_json::answer(StatusCode::RANGE_NOT_SATISFIABLE, problem)).into_response()
}

/// The part that the request asks for; the whole where it is for another file than the one of this tag (`If-Range`).
fn wanted(asked: &HeaderMap, tag: &str, length: u64) -> Result<Option<Range<u64>>, Beyond> {
    let is_of_this = asked.get_all(header::IF_RANGE).iter().all(|other| other == tag);
    let range = asked.get(header::RANGE).filter(|_| is_of_this);
    range.and_then(|range| range.to_str().ok()).map_or(Ok(None), |range| part(range, length))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rg1_a_part_of_another_file_is_not_sent() {
        let asked = |more: &[(header::HeaderName, &str)]| {
            let more = more.iter().map(|(name, value)| (name.clone(), value.parse().unwrap()));
            wanted(&HeaderMap::from_iter(more), "\"x\"", 10)
        };
        let range = (header::RANGE, "bytes=0-3");
        assert_eq!(asked(&[]), Ok(None));
        assert_eq!(asked(std::slice::from_ref(&range)), Ok(Some(0..4)));
        let condition = |tag| asked(&[range.clone(), (header::IF_RANGE, tag)]);
        assert_eq!(condition("\"x\""), Ok(Some(0..4)));
        for other in ["\"y\"", "W/\"x\"", "Sat, 23 May 2026 10:00:00 GMT", "x"] {
            assert_eq!(condition(other), Ok(None), "{other}");
        }
        assert_eq!(asked(&[(header::RANGE, "bytes=10-")]), Err(Beyond));
    }

    #[test]
    fn rg2_who_has_a_file_is_not_sent_it_again() {
        for (tags, expected) in [
            (&[][..], false),
            (&["\"x\""], true),
            (&["W/\"x\""], true),
            (&["\"y\", \"x\""], true),
            (&["\"y\"", "*"], true),
            (&["\"xy\"", "x"], false),
        ] {
            let asked = tags.iter().map(|tag| (header::IF_NONE_MATCH, tag.parse().unwrap()));
            let mut headers = HeaderMap::new();
            for (name, value) in asked {
                headers.append(name, value);
            }
            assert_eq!(is_known(&headers, "\"x\""), expected, "{tags:?}");
        }
    }

    #[tokio::test]
    async fn rg1_a_part_is_sent_with_its_place() {
        for (range, status, place, text) in [
            (Some("bytes=2-4"), StatusCode::PARTIAL_CONTENT, Some("bytes 2-4/10"), "234"),
            (None, StatusCode::OK, None, "0123456789"),
        ] {
            let asked = range.map(|range| (header::RANGE, range.parse().unwrap()));
            let answer = answer(
                &HeaderMap::from_iter(asked),
                [(header::CONTENT_TYPE, "text/plain")],
                "\"x\"",
                Cursor::new("0123456789"),
                10,
            )
            .unwrap();
            let headers = answer.headers();
            assert_eq!(answer.status(), status);
            assert_eq!(headers[header::ACCEPT_RANGES], "bytes");
            assert_eq!(headers[header::ETAG], "\"x\"");
            assert_eq!(headers.get(header::CONTENT_RANGE).map(|place| place.to_str().unwrap()), place);
            assert_eq!(headers[header::CONTENT_LENGTH], text.len().to_string());
            let body = axum::body::to_bytes(answer.into_body(), 100).await.unwrap();
            assert_eq!(body, text.as_bytes());
        }
        let asked = HeaderMap::from_iter([(header::RANGE, "bytes=10-".parse().unwrap())]);
        let said = [(header::CONTENT_TYPE, "text/plain")];
        let refused = answer(&asked, said, "\"x\"", Cursor::new("0123456789"), 10).unwrap();
        assert_eq!(refused.status(), StatusCode::RANGE_NOT_SATISFIABLE);
        assert_eq!(refused.headers()[header::CONTENT_RANGE], "bytes */10");
        assert_eq!(refused.headers()[header::CONTENT_TYPE], espalier_proto::PROBLEM_JSON);
    }
}
