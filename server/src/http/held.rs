//! Answers for which memory is taken until they are sent.

use axum::body::{Body, Bytes};

use crate::memory::Claim;

struct Held<T> {
    bytes: T,
    _claim: Option<Claim>,
}

impl<T: AsRef<[u8]>> AsRef<[u8]> for Held<T> {
    fn as_ref(&self) -> &[u8] {
        self.bytes.as_ref()
    }
}

/// A body that gives back what was taken for it when nothing of it is left to be sent.
pub(super) fn body(bytes: impl AsRef<[u8]> + Send + 'static, claim: Option<Claim>) -> Body {
    Body::from(Bytes::from_owner(Held { bytes, _claim: claim }))
}
