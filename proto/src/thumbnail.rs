//! Pictures of saved trees, which come as data URLs.

use base64::{Engine, engine::general_purpose::STANDARD};

use crate::{problem::Problem, reason::Reason};

/// The most bytes of a picture, before it is base64.
pub const MAX_THUMBNAIL_BYTES: usize = 192 * 1024;
const ALLOWED: &str = "a PNG, JPEG or WebP picture as a base64 data URL";

/// A picture that a browser shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// `image/png`, `image/jpeg` or `image/webp`.
    pub media_type: String,
    /// The file.
    pub bytes: Vec<u8>,
}

/// Reads a data URL. What it claims to be must be what its first bytes say, since browsers will trust the claim.
///
/// # Errors
///
/// It is no such picture, or too large a one (`TooMany`).
pub fn from_data_url(url: &str) -> Result<Picture, Problem> {
    let (media_type, encoded) =
        url.strip_prefix("data:").and_then(|rest| rest.split_once(";base64,")).ok_or_else(refused)?;
    if encoded.len() > MAX_THUMBNAIL_BYTES.div_ceil(3) * 4 {
        return Err(too_large());
    }
    let bytes = STANDARD.decode(encoded).map_err(|_| refused())?;
    if bytes.len() > MAX_THUMBNAIL_BYTES {
        return Err(too_large());
    }
    let is_what_it_claims = match media_type {
        "image/png" => bytes.starts_with(b"\x89PNG\r\n\x1a\n"),
        "image/jpeg" => bytes.starts_with(b"\xff\xd8\xff"),
        "image/webp" => bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WEBP"),
        _ => false,
    };
    if is_what_it_claims { Ok(Picture { media_type: media_type.into(), bytes }) } else { Err(refused()) }
}

fn refused() -> Problem {
    let message = format!("thumbnail is not a picture; allowed: {ALLOWED}");
    Problem::new(Reason::ThumbnailKind, message).at("thumbnail", ALLOWED)
}

fn too_large() -> Problem {
    let allowed = format!("at most {} KiB", MAX_THUMBNAIL_BYTES / 1024);
    let message = format!("thumbnail is too large; allowed: {allowed}");
    Problem::new(Reason::LargeThumbnail, message).at("thumbnail", allowed)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn url(media_type: &str, bytes: &[u8]) -> String {
        format!("data:{media_type};base64,{}", STANDARD.encode(bytes))
    }

    #[test]
    fn pictures_of_three_kinds_are_taken() {
        for (media_type, bytes) in [
            ("image/png", b"\x89PNG\r\n\x1a\n...".as_slice()),
            ("image/jpeg", b"\xff\xd8\xff\xe0..."),
            ("image/webp", b"RIFF\x04\0\0\0WEBPVP8 "),
        ] {
            let picture = from_data_url(&url(media_type, bytes)).expect("it is a picture");
            assert_eq!((picture.media_type.as_str(), picture.bytes.as_slice()), (media_type, bytes));
        }
    }

    #[test]
    fn what_is_no_picture_is_refused() {
        let svg = url("image/svg+xml", b"<svg onload='alert(1)'/>");
        let disguised = url("image/png", b"<script>alert(1)</script>");
        let parameters = url("image/png;charset=utf-8", b"\x89PNG\r\n\x1a\n");
        for bad in [
            "",
            "data:",
            "https://example.org/a.png",
            "data:image/png;base64,&&&",
            &svg,
            &disguised,
            &parameters,
        ] {
            assert_eq!(from_data_url(bad), Err(refused()), "{bad}");
        }
    }

    #[test]
    fn the_size_is_limited_to_the_byte() {
        let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
        bytes.resize(MAX_THUMBNAIL_BYTES, 0);
        assert!(from_data_url(&url("image/png", &bytes)).is_ok());
        bytes.push(0);
        assert_eq!(from_data_url(&url("image/png", &bytes)), Err(too_large()));
        bytes.resize(2 * MAX_THUMBNAIL_BYTES, 0);
        assert_eq!(from_data_url(&url("image/png", &bytes)), Err(too_large()));
    }
}
