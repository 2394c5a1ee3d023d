//! Passwords: what is kept of them, and whether one is right.

use argon2::{
    Argon2,
    password_hash::{self, PasswordHasher, PasswordVerifier},
};
use tokio::{sync::Semaphore, task::spawn_blocking};
use unicode_normalization::UnicodeNormalization;

/// Characters of a password: fewer are guessed,
const LEAST: usize = 8;
/// and more are no longer typed.
const MOST: usize = 200;
/// Each check takes 19 MiB, and some ten milliseconds of a core.
const AT_ONCE: usize = 2;

/// What is kept where nobody goes by a name: no password is right, and that takes as long as for any other.
const NOBODY: &str =
    "$argon2id$v=19$m=19456,t=2,p=1$AAAAAAAAAAAAAAAAAAAAAA$AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA";

/// A password to be kept.
#[derive(Clone)]
pub struct Password(String);

impl Password {
    /// What may stand there.
    pub const ALLOWED: &str = "8 to 200 characters";

    /// Any 8 to 200 characters; an error says so.
    pub fn parse(text: &str) -> Result<Self, String> {
        if (LEAST..=MOST).contains(&text.chars().count()) {
            Ok(Self(plain(text)))
        } else {
            Err(format!("a password has {LEAST} to {MOST} characters"))
        }
    }

    /// What is kept of it: its hash by Argon2id with a random salt.
    pub fn kept(&self) -> Result<String, password_hash::Error> {
        let salt: [u8; 16] = rand::random();
        Ok(Argon2::default().hash_password_with_salt(self.0.as_bytes(), &salt)?.to_string())
    }
}

/// Why a password cannot be kept.
#[derive(Debug, thiserror::Error)]
pub enum KeepError {
    /// It cannot be hashed.
    #[error(transparent)]
    Hash(#[from] password_hash::Error),
    /// Nobody hashes it any more.
    #[error("the server is stopping")]
    Stopping,
}

/// Checks passwords, a few at once.
#[derive(Debug)]
pub struct Passwords(Semaphore);

impl Default for Passwords {
    fn default() -> Self {
        Self(Semaphore::new(AT_ONCE))
    }
}

impl Passwords {
    /// What is kept of a password.
    pub async fn kept(&self, password: Password) -> Result<String, KeepError> {
        let _place = self.0.acquire().await.map_err(|_| KeepError::Stopping)?;
        let kept = spawn_blocking(move || password.kept()).await.map_err(|_| KeepError::Stopping)?;
        Ok(kept?)
    }

    /// Whether a password is the one of which this is kept; where nothing is, none is.
    pub async fn is_right(&self, password: &str, kept: Option<String>) -> bool {
        let Ok(_place) = self.0.acquire().await else { return false };
        let password = plain(password);
        let check = spawn_blocking(move || {
            let kept = kept.as_deref().unwrap_or(NOBODY);
            Argon2::default().verify_password(password.as_bytes(), kept)
        });
        check.await.is_ok_and(|checked| checked.is_ok())
    }
}

/// The same text from every keyboard.
fn plain(text: &str) -> String {
    text.nfc().collect()
}

#[cfg(test)]
mod tests {
    use argon2::{Params, password_hash::phc::PasswordHash};

    use super::*;

    #[tokio::test]
    async fn ac9_a_password_is_right_for_what_was_kept_of_it() {
        let passwords = Passwords::default();
        let kept = Password::parse("müde Eiche").unwrap().kept().unwrap();
        assert!(!kept.contains("Eiche"));
        assert_ne!(kept, Password::parse("müde Eiche").unwrap().kept().unwrap(), "salts differ");
        for (text, expected) in
            [("müde Eiche", true), ("mu\u{308}de Eiche", true), ("müde eiche", false), ("", false)]
        {
            assert_eq!(passwords.is_right(text, Some(kept.clone())).await, expected, "{text}");
        }
        assert!(!passwords.is_right("müde Eiche", Some("no hash".into())).await);
        assert!(!passwords.is_right("müde Eiche", None).await);
    }

    #[test]
    fn ac9_a_name_of_nobody_takes_as_long() {
        let costs = |kept: &str| {
            let kept = PasswordHash::new(kept).unwrap();
            (kept.algorithm, Params::try_from(&kept).unwrap(), kept.hash.unwrap().len())
        };
        assert_eq!(costs(NOBODY), costs(&Password::parse("whatever").unwrap().kept().unwrap()));
    }

    #[test]
    fn ac9_passwords_have_8_to_200_characters() {
        assert!(Password::parse(&"ö".repeat(8)).is_ok() && Password::parse(&"ö".repeat(200)).is_ok());
        for text in ["", "1234567", &"x".repeat(201)] {
            assert_eq!(Password::parse(text).err().unwrap(), "a password has 8 to 200 characters");
        }
    }
}
