//! Parts of files that are kept whole (`RG1`).

use std::{
    io::{Read, Seek, SeekFrom},
    ops::Range,
};

use axum::{
    Json,
    http::{HeaderMap, StatusCode, header},
    response::{IntoResponse, IntoResponseParts, Response},
};
use espalier_proto::{Problem, Reason};

use super::{exports, failure::Failure};

/// Answers with a file of so many bytes, or with the part of it that is asked for.
pub(super) fn answer(
    asked: &HeaderMap,
    said: impl IntoResponseParts,
    mut file: impl Read + Seek + Send + 'static,
    length: u64,
) -> Result<Response, Failure> {
    let Ok(part) = wanted(asked, length) else { return Ok(beyond(length)) };
    let status = if part.is_some() { StatusCode::PARTIAL_CONTENT } else { StatusCode::OK };
    let place = part
        .clone()
        .map(|part| [(header::CONTENT_RANGE, format!("bytes {}-{}/{length}", part.start, part.end - 1))]);
    let Range { start, end } = part.unwrap_or(0..length);
    file.seek(SeekFrom::Start(start)).map_err(|error| {
        tracing::error!(%error, "a file that is kept cannot be read");
        Failure::new(Reason::NotExported, "The file cannot be read.")
    })?;
    let size =
        [(header::ACCEPT_RANGES, "bytes".to_owned()), (header::CONTENT_LENGTH, (end - start).to_string())];
    Ok((status, said, size, place, exports::body_of(file.take(end - start))).into_response())
}

/// What is asked for begins behind the end.
#[derive(Debug, PartialEq, Eq)]
struct Beyond;

fn beyond(length: u64) -> Response {
    let problem = Problem::out_of_range(
        "range",
        "behind the end",
        format!("bytes from 0 to {length}, without the last"),
    );
    let place = [(header::CONTENT_RANGE, format!("bytes */{length}"))];
    (StatusCode::RANGE_NOT_SATISFIABLE, place, Json(problem)).into_response()
}

/// The part that `Range` asks for. Several parts, other units, and a condition (`If-Range`) ask for the whole, which
/// RFC 9110 (14.2) leaves to the server.
fn wanted(asked: &HeaderMap, length: u64) -> Result<Option<Range<u64>>, Beyond> {
    let range = asked.get(header::RANGE).filter(|_| !asked.contains_key(header::IF_RANGE));
    let range = range.and_then(|range| range.to_str().ok()?.split_once('='));
    let range = range
        .filter(|(unit, _)| unit.eq_ignore_ascii_case("bytes"))
        .and_then(|(_, range)| range.split_once('-'));
    let Some((first, last)) = range else { return Ok(None) };
    // A number of any length is one; no file is as long as the greatest that there is room for.
    let number = |text: &str| {
        let is_number = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
        is_number.then(|| text.parse::<u64>().unwrap_or(u64::MAX))
    };
    let part = match (first.trim(), last.trim()) {
        ("", last) => number(last).map(|last| length.saturating_sub(last)..length),
        (first, "") => number(first).map(|first| first..length),
        (first, last) => number(first)
            .zip(number(last))
            .filter(|(first, last)| first <= last)
            .map(|(first, last)| first..length.min(last.saturating_add(1))),
    };
    if part.as_ref().is_some_and(Range::is_empty) { Err(Beyond) } else { Ok(part) }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;

    #[test]
    fn rg1_a_part_is_told_by_its_ends_or_by_one_of_them() {
        let found = |range: &'static str| {
            wanted(&HeaderMap::from_iter([(header::RANGE, range.parse().unwrap())]), 10)
        };
        for (range, part) in [
            ("bytes=0-3", Some(0..4)),
            ("bytes=4-", Some(4..10)),
            ("bytes=9-99", Some(9..10)),
            ("bytes=-3", Some(7..10)),
            ("bytes=-30", Some(0..10)),
            ("Bytes=0-3", Some(0..4)),
            ("bytes=5-4", None),
            ("bytes=+1-3", None),
            ("bytes=1-2,4-5", None),
            ("bytes=x-", None),
            ("lines=1-2", None),
            ("bytes", None),
        ] {
            assert_eq!(found(range), Ok(part), "{range}");
        }
        for range in ["bytes=10-", "bytes=10-12", "bytes=-0", "bytes=99999999999999999999-"] {
            assert_eq!(found(range), Err(Beyond), "{range}");
        }
        let both = [(header::RANGE, "bytes=0-3"), (header::IF_RANGE, "\"x\"")];
        let both = HeaderMap::from_iter(both.map(|(name, value)| (name, value.parse().unwrap())));
        assert_eq!(wanted(&both, 10), Ok(None));
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
                Cursor::new("0123456789"),
                10,
            )
            .unwrap();
            let headers = answer.headers();
            assert_eq!(answer.status(), status);
            assert_eq!(headers[header::ACCEPT_RANGES], "bytes");
            assert_eq!(headers.get(header::CONTENT_RANGE).map(|place| place.to_str().unwrap()), place);
            assert_eq!(headers[header::CONTENT_LENGTH], text.len().to_string());
            let body = axum::body::to_bytes(answer.into_body(), 100).await.unwrap();
            assert_eq!(body, text.as_bytes());
        }
        let asked = HeaderMap::from_iter([(header::RANGE, "bytes=10-".parse().unwrap())]);
        let said = [(header::CONTENT_TYPE, "text/plain")];
        let refused = answer(&asked, said, Cursor::new("0123456789"), 10).unwrap();
        assert_eq!(refused.status(), StatusCode::RANGE_NOT_SATISFIABLE);
        assert_eq!(refused.headers()[header::CONTENT_RANGE], "bytes */10");
    }
}
