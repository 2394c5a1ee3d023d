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
use espalier_proto::{
    Problem, Reason,
    ranges::{Beyond, part},
};

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

fn beyond(length: u64) -> Response {
    let problem = Problem::out_of_range(
        "range",
        "behind the end",
        format!("bytes from 0 to {length}, without the last"),
    );
    let place = [(header::CONTENT_RANGE, format!("bytes */{length}"))];
    (StatusCode::RANGE_NOT_SATISFIABLE, place, Json(problem)).into_response()
}

/// The part that the request asks for; a condition (`If-Range`) asks for the whole.
fn wanted(asked: &HeaderMap, length: u64) -> Result<Option<Range<u64>>, Beyond> {
    let range = asked.get(header::RANGE).filter(|_| !asked.contains_key(header::IF_RANGE));
    range.and_then(|range| range.to_str().ok()).map_or(Ok(None), |range| part(range, length))
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;

    #[test]
    fn rg1_a_condition_asks_for_the_whole() {
        let asked = |more: &[(header::HeaderName, &str)]| {
            let more = more.iter().map(|(name, value)| (name.clone(), value.parse().unwrap()));
            wanted(&HeaderMap::from_iter(more), 10)
        };
        let range = (header::RANGE, "bytes=0-3");
        assert_eq!(asked(&[]), Ok(None));
        assert_eq!(asked(std::slice::from_ref(&range)), Ok(Some(0..4)));
        assert_eq!(asked(&[range, (header::IF_RANGE, "\"x\"")]), Ok(None));
        assert_eq!(asked(&[(header::RANGE, "bytes=10-")]), Err(Beyond));
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
