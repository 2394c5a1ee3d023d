//! What people are called who have done something.

use espalier_session::{Named, Principal};

use super::StoreError;

/// Keeps what authors are called, by the key under which journals and lines of time know them.
pub trait Authors {
    /// Somebody is called so from now on; times are as those of saved trees.
    async fn name_author(&self, named: &Named, at: &str) -> Result<(), StoreError>;

    /// Those of these authors who have a name, in the order in which they got it.
    async fn named_authors(&self, authors: &[Principal]) -> Result<Vec<Named>, StoreError>;
}
