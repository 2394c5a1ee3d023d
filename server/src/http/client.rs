//! The tablet client, embedded by the build script: each file once, as gzip where that is shorter.

use std::io::{self, Read};

use axum::{
    body::Body,
    http::{HeaderMap, HeaderValue, StatusCode, Uri, header},
    response::{IntoResponse, Response},
};
use espalier_proto::Reason;
use flate2::read::GzDecoder;

use super::failure::Failure;

/// One embedded file.
struct File {
    /// Its path in the address, with a leading slash.
    path: &'static str,
    media_type: &'static str,
    /// Changes when the contents do; with quotes, as it travels.
    etag: &'static str,
    bytes: &'static [u8],
    /// Whether these are gzip of the file.
    is_packed: bool,
}

include!(concat!(env!("OUT_DIR"), "/client.rs"));

/// The page, whatever session it is for.
pub(super) async fn page(headers: HeaderMap) -> Response {
    answer("/index.html", &headers)
}

/// The page on which the API is read and tried.
pub(super) async fn api_page(headers: HeaderMap) -> Response {
    answer("/api.html", &headers)
}

/// Any other file.
pub(super) async fn file(uri: Uri, headers: HeaderMap) -> Response {
    answer(uri.path(), &headers)
}

fn answer(path: &str, headers: &HeaderMap) -> Response {
    let Ok(index) = FILES.binary_search_by(|file| file.path.cmp(path)) else {
        return Failure::no_address().into_response();
    };
    let file = &FILES[index];
    let mut response = Response::new(Body::empty());
    let answer = response.headers_mut();
    answer.insert(header::ETAG, HeaderValue::from_static(file.etag));
    answer.insert(header::VARY, HeaderValue::from_static("accept-encoding"));
    answer.insert(header::CACHE_CONTROL, HeaderValue::from_static(cache_control(file.path)));
    if mentions(headers, header::IF_NONE_MATCH, file.etag) {
        *response.status_mut() = StatusCode::NOT_MODIFIED;
        return response;
    }
    answer.insert(header::CONTENT_TYPE, HeaderValue::from_static(file.media_type));
    *response.body_mut() = if !file.is_packed {
        Body::from(file.bytes)
    } else if mentions(headers, header::ACCEPT_ENCODING, "gzip") {
        answer.insert(header::CONTENT_ENCODING, HeaderValue::from_static("gzip"));
        Body::from(file.bytes)
    } else {
        // Every browser takes gzip; for the few others it is unpacked each time.
        match unpacked(file.bytes) {
            Ok(bytes) => Body::from(bytes),
            Err(error) => {
                tracing::error!(path, %error, "a file of the page cannot be unpacked");
                return Failure::new(Reason::Failed, "The server failed to compute this.").into_response();
            }
        }
    };
    response
}

fn unpacked(gzip: &[u8]) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    GzDecoder::new(gzip).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Vite puts a hash of the contents into the names under `assets`; everything else is asked for anew.
fn cache_control(path: &str) -> &'static str {
    if path.starts_with("/assets/") { "public, max-age=31536000, immutable" } else { "no-cache" }
}

/// Whether one of the comma-separated values of a header is this one; weak tags count as well.
fn mentions(headers: &HeaderMap, name: header::HeaderName, wanted: &str) -> bool {
    headers
        .get_all(name)
        .iter()
        .filter_map(|value| value.to_str().ok())
        .flat_map(|value| value.split(','))
        .any(|value| {
            let (value, parameters) = value.split_once(';').unwrap_or((value, ""));
            let refused = parameters.trim().strip_prefix("q=").is_some_and(|q| q.parse() == Ok(0.0));
            value.trim().trim_start_matches("W/") == wanted && !refused
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn get(path: &str, header: Option<(header::HeaderName, &str)>) -> Response {
        let mut headers = HeaderMap::new();
        if let Some((name, value)) = header {
            headers.insert(name, HeaderValue::from_str(value).unwrap());
        }
        answer(path, &headers)
    }

    #[test]
    fn files_can_be_searched() {
        assert!(FILES.is_sorted_by_key(|file| file.path));
    }

    #[test]
    fn the_page_is_checked_for_changes_each_time() {
        let page = get("/index.html", None);
        assert_eq!(page.status(), StatusCode::OK);
        assert_eq!(page.headers()[header::CACHE_CONTROL], "no-cache");
        assert_eq!(page.headers()[header::CONTENT_TYPE], "text/html; charset=utf-8");
        let etag = page.headers()[header::ETAG].to_str().unwrap().to_owned();
        let again = get("/index.html", Some((header::IF_NONE_MATCH, &format!("\"other\", W/{etag}"))));
        assert_eq!(again.status(), StatusCode::NOT_MODIFIED);
    }

    #[test]
    fn the_page_of_the_api_is_embedded() {
        assert_eq!(get("/api.html", None).headers()[header::CONTENT_TYPE], "text/html; charset=utf-8");
    }

    #[test]
    fn hashed_files_never_change() {
        assert!(cache_control("/assets/index-5f3a.js").contains("immutable"));
        assert_eq!(cache_control("/favicon.svg"), "no-cache");
    }

    #[test]
    fn what_installs_the_page_is_checked_each_time() {
        for (path, media_type) in [
            ("/manifest.webmanifest", "application/manifest+json"),
            ("/sw.js", "text/javascript; charset=utf-8"),
            ("/icon-512.png", "image/png"),
        ] {
            let file = get(path, None);
            assert_eq!(file.status(), StatusCode::OK, "{path}");
            assert_eq!(file.headers()[header::CONTENT_TYPE], media_type, "{path}");
            assert_eq!(file.headers()[header::CACHE_CONTROL], "no-cache", "{path}");
        }
    }

    #[test]
    fn gzip_goes_only_to_who_accepts_it() {
        let accepts = |value| {
            let mut headers = HeaderMap::new();
            headers.insert(header::ACCEPT_ENCODING, HeaderValue::from_static(value));
            mentions(&headers, header::ACCEPT_ENCODING, "gzip")
        };
        assert!(accepts("gzip, deflate, br"));
        assert!(accepts("br;q=1.0, gzip;q=0.8"));
        assert!(!accepts("br, gzip;q=0"));
        assert!(!accepts("deflate"));
    }

    #[test]
    fn who_takes_no_gzip_gets_the_file_itself() {
        for file in FILES {
            let bytes = if file.is_packed { unpacked(file.bytes).unwrap() } else { file.bytes.to_vec() };
            let mut sum = flate2::Crc::new();
            sum.update(&bytes);
            assert_eq!(file.etag, format!("\"{:08x}-{:x}\"", sum.sum(), bytes.len()), "{}", file.path);
        }
        let plain = get("/index.html", None);
        assert_eq!(plain.headers().get(header::CONTENT_ENCODING), None);
    }

    #[test]
    fn an_unknown_file_is_not_found() {
        for path in ["/nothing.js", "/../Cargo.toml", "//", "/index.html/"] {
            assert_eq!(get(path, None).status(), StatusCode::NOT_FOUND, "{path}");
        }
    }
}
