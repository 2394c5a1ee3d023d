//! Pictures of saved trees, as data URLs.

use base64::{Engine, engine::general_purpose::STANDARD};
use espalier_proto::thumbnail::{Picture, from_data_url};

/// Reads a data URL; what was taken is small, and is a picture of the kind that it says.
pub fn read(bytes: &[u8]) -> bool {
    let Ok(url) = std::str::from_utf8(bytes) else { return false };
    match from_data_url(url) {
        Ok(picture) => {
            assert!(picture.bytes.len() < url.len() && url.contains(&picture.media_type), "{picture:?}");
            assert_eq!(from_data_url(&written(&picture)), Ok(picture));
            true
        }
        Err(problem) => {
            assert!(problem.field.is_some() && problem.allowed.is_some(), "{problem}");
            false
        }
    }
}

/// One of each kind.
pub fn seeds() -> Vec<Vec<u8>> {
    let kinds: [(&str, &[u8]); 3] = [
        ("image/png", b"\x89PNG\r\n\x1a\n and so on"),
        ("image/jpeg", b"\xff\xd8\xff\xe0 and so on"),
        ("image/webp", b"RIFF\x04\0\0\0WEBPVP8 and so on"),
    ];
    let picture =
        |(media_type, bytes): (&str, &[u8])| Picture { media_type: media_type.into(), bytes: bytes.into() };
    kinds.map(|kind| written(&picture(kind)).into_bytes()).to_vec()
}

fn written(Picture { media_type, bytes }: &Picture) -> String {
    format!("data:{media_type};base64,{}", STANDARD.encode(bytes))
}
