//! Secrets that let somebody in.

use base64::{Engine, prelude::BASE64_URL_SAFE_NO_PAD};
use sha2::{Digest, Sha256};

/// What is kept of a secret: its SHA-256. A secret has so many random bits that none can be found from it, nor from how
/// long a search for it takes.
pub type SecretHash = [u8; 32];

/// A random secret, as text for a link, a cookie or a header. It is shown once and kept nowhere.
#[derive(Clone)]
pub struct Secret(String);

impl Secret {
    /// One of 128 bits, short enough for a QR code.
    pub fn short() -> Self {
        Self(BASE64_URL_SAFE_NO_PAD.encode(rand::random::<[u8; 16]>()))
    }

    /// One of 256 bits that begins with these letters, by which people and programs tell what it is.
    pub fn long(begins: &str) -> Self {
        Self(format!("{begins}{}", BASE64_URL_SAFE_NO_PAD.encode(rand::random::<[u8; 32]>())))
    }

    /// Its text.
    pub fn text(&self) -> &str {
        &self.0
    }

    /// What is kept of it.
    pub fn hash(&self) -> SecretHash {
        hash(&self.0)
    }
}

/// What would be kept of a text if it were a secret.
pub fn hash(text: &str) -> SecretHash {
    Sha256::digest(text).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn secrets_differ_and_fit_into_a_link() {
        let (a, b) = (Secret::short(), Secret::short());
        assert_ne!(a.text(), b.text());
        assert_eq!((a.text().len(), Secret::long("esp_").text().len()), (22, 47));
        let fits = |byte: u8| byte.is_ascii_alphanumeric() || b"-_".contains(&byte);
        assert!(a.text().bytes().chain(Secret::long("esp_").text().bytes()).all(fits));
        assert_eq!(a.hash(), hash(a.text()));
        assert_ne!(a.hash(), b.hash());
    }
}
