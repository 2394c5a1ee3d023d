//! Names of authors in the model.

use espalier_session::{Named, Principal};

use super::{
    super::{Authors, StoreError},
    MemoryStore,
};

impl Authors for MemoryStore {
    async fn name_author(&self, named: &Named, at: &str) -> Result<(), StoreError> {
        self.writing()?.authors.insert(named.author.clone(), (at.to_owned(), named.clone()));
        Ok(())
    }

    async fn named_authors(&self, authors: &[Principal]) -> Result<Vec<Named>, StoreError> {
        let kept = self.kept();
        let mut all: Vec<_> = authors.iter().filter_map(|author| kept.authors.get(author)).collect();
        all.sort_by(|(one, _), (other, _)| one.cmp(other));
        Ok(all.into_iter().map(|(_, named)| named.clone()).collect())
    }
}
