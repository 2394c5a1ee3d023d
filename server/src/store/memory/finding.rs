//! Finding trees in the model.

use std::collections::{BTreeMap, BTreeSet};

use super::{
    super::{
        Collection, CollectionChange, Finding, Library, Missing, StoreError, StoredTree, TreeQuery,
        folding::{alternatives, folded, searched, uncased},
    },
    MemoryStore,
};

/// Whether a tree is one of those that are wanted, but for its place in the list.
pub(super) fn is_wanted(
    tree: &StoredTree,
    query: &TreeQuery,
    by: &str,
    favourites: &BTreeSet<(String, String)>,
) -> bool {
    let species = tree.head.species.as_deref();
    let text = searched(&tree.name, &tree.tags, &tree.note, species);
    let is_in =
        |wanted: &Option<String>, found: Option<&str>| wanted.as_deref().is_none_or(|it| found == Some(it));
    tree.deleted_at.is_some() == query.is_deleted
        && query.is_template.is_none_or(|wanted| tree.is_template == wanted)
        && query.words.iter().all(|word| alternatives(word).iter().any(|part| text.contains(part)))
        && query.tags.iter().all(|tag| tree.tags.iter().any(|other| uncased(other) == uncased(tag)))
        && query.collection.as_ref().is_none_or(|wanted| tree.collection == *wanted)
        && query.favourites_of.as_ref().is_none_or(|who| favourites.contains(&(who.clone(), tree.id.clone())))
        && query.saved_by.as_deref().is_none_or(|wanted| wanted == by)
        && query.only.as_ref().is_none_or(|id| tree.id == *id)
        && is_in(&query.species, species)
        && is_in(&query.author, tree.head.author.as_deref())
        && query.metamers.contains(&tree.head.metamers)
        && query.saved_from.as_ref().is_none_or(|from| tree.head.saved_at >= *from)
        && query.saved_before.as_ref().is_none_or(|before| tree.head.saved_at < *before)
}

/// Each text once, with how often it came.
fn counted(texts: impl Iterator<Item = String>) -> Vec<(String, u32)> {
    let mut counts = BTreeMap::new();
    texts.for_each(|text| *counts.entry(text).or_insert(0) += 1);
    counts.into_iter().collect()
}

impl Finding for MemoryStore {
    async fn collections(&self) -> Result<Vec<Collection>, StoreError> {
        let kept = self.kept();
        let mut all: Vec<Collection> = kept.collections.values().cloned().collect();
        for collection in &mut all {
            let lies_there = |tree: &&super::library::Tree| {
                tree.deleted_at.is_none() && tree.collection.as_ref() == Some(&collection.id)
            };
            collection.trees = kept.trees.values().filter(lies_there).count() as u32;
        }
        all.sort_by_key(|collection| (folded(&collection.name), collection.id.clone()));
        Ok(all)
    }

    async fn add_collection(&self, new: Collection) -> Result<(), StoreError> {
        let mut kept = self.writing()?;
        if new.parent.as_ref().is_some_and(|parent| !kept.collections.contains_key(parent)) {
            return Err(StoreError::NotFound(Missing::Parent));
        }
        kept.collections.insert(new.id.clone(), new);
        Ok(())
    }

    async fn change_collection(&self, id: &str, change: CollectionChange) -> Result<(), StoreError> {
        let mut kept = self.writing()?;
        if !kept.collections.contains_key(id) {
            return Err(StoreError::NotFound(Missing::Collection));
        }
        let mut above = change.parent.clone().flatten();
        while let Some(at) = above {
            if at == id {
                return Err(StoreError::Cycle);
            }
            above = kept.collections.get(&at).ok_or(StoreError::NotFound(Missing::Parent))?.parent.clone();
        }
        let collection = kept.collections.get_mut(id).ok_or(StoreError::NotFound(Missing::Collection))?;
        collection.name = change.name.unwrap_or_else(|| collection.name.clone());
        collection.parent = change.parent.unwrap_or_else(|| collection.parent.clone());
        Ok(())
    }

    async fn delete_collection(&self, id: &str) -> Result<(), StoreError> {
        let mut kept = self.writing()?;
        let parent = kept.collections.remove(id).ok_or(StoreError::NotFound(Missing::Collection))?.parent;
        let is_it = |lies_in: &&mut Option<String>| lies_in.as_deref() == Some(id);
        let inner = kept.collections.values_mut().map(|inner| &mut inner.parent);
        inner.filter(is_it).for_each(|lies_in| lies_in.clone_from(&parent));
        let trees = kept.trees.values_mut().map(|tree| &mut tree.collection);
        trees.filter(is_it).for_each(|lies_in| lies_in.clone_from(&parent));
        kept.forget_gifts(|gift| gift.is_collection(id));
        Ok(())
    }

    async fn tags(&self) -> Result<Vec<(String, u32)>, StoreError> {
        let kept = self.kept();
        let trees = kept.trees.values().filter(|tree| tree.deleted_at.is_none());
        Ok(counted(trees.flat_map(|tree| tree.tags.clone())))
    }

    async fn authors(&self) -> Result<Vec<(String, u32)>, StoreError> {
        let all = self.trees(&TreeQuery::default()).await?;
        Ok(counted(all.into_iter().filter_map(|tree| tree.head.author)))
    }

    async fn favourites(&self, principal: &str) -> Result<BTreeSet<String>, StoreError> {
        let kept = self.kept();
        let of = kept.favourites.iter().filter(|(who, _)| who == principal);
        Ok(of.map(|(_, tree)| tree.clone()).collect())
    }

    async fn set_favourite(&self, principal: &str, tree: &str, is_one: bool) -> Result<(), StoreError> {
        let mut kept = self.writing()?;
        if !kept.trees.contains_key(tree) {
            return Err(StoreError::NotFound(Missing::Tree));
        }
        let favourite = (principal.to_owned(), tree.to_owned());
        if is_one {
            kept.favourites.insert(favourite);
        } else {
            kept.favourites.remove(&favourite);
        }
        Ok(())
    }
}
